"""Results as checks, pictures and tables need them, beside the reader of the package midplane."""
