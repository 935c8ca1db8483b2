"""Faults of results, gathered."""

from typing import Any


class Faults(list[str]):
    """The faults found so far; every check adds to it and goes on."""

    def expect(self, good: Any, text: str) -> bool:
        """Adds the text where something is not good; returns whether it is."""
        if not good:
            self.append(text)
        return bool(good)
