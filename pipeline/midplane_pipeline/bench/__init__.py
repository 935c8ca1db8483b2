"""Times of whole runs of midplane."""
