"""Parts from others: their advisories, licences, hashes."""
