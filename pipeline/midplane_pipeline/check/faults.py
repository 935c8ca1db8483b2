"""Faults of results, gathered."""


class Faults(list):
    """The faults found so far; every check adds to it and goes on."""

    def expect(self, good, text):
        """Adds the text where something is not good; returns whether it is."""
        if not good:
            self.append(text)
        return good
