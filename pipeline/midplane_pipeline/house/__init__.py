"""What the project takes from others: advisories, licences, hashes."""
