"""The documents: keys from the schema, commands as a reader types them."""
