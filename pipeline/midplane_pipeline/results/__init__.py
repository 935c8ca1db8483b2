"""What checks, pictures and tables need of a scene and its results, beside the reader of the package midplane."""
