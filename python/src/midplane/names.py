"""Names that are chosen among those there are: patterns, and what to say of a name that is not there."""

from __future__ import annotations

import difflib
import fnmatch
from collections.abc import Iterable, Sequence

from .errors import ResultsError

MANY = 30  # names that a message lists


def unknown(place: object, what: str, name: str, names: Iterable[str]) -> str:
    """What to say where a name is none of those there are."""
    names = list(names)
    there = ", ".join(names[:MANY]) + (f" and {len(names) - MANY} more" if len(names) > MANY else "") or "none"
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    return f'{place}: no {what} "{name}"; there is {there}' + (f'. Did you mean "{near[0]}"?' if near else "")


def chosen(place: object, what: str, patterns: Sequence[str], names: Iterable[str]) -> list[str]:
    """The names that fit one of the patterns, in their order. Raises ResultsError for a pattern that fits none."""
    names = list(names)
    for pattern in patterns:
        if not any(fits(pattern, name) for name in names):
            raise ResultsError(unknown(place, what, pattern, names))
    return [name for name in names if any(fits(pattern, name) for pattern in patterns)]


def fits(pattern: str, name: str) -> bool:
    """Whether a name fits a pattern: * is any text, ? any character, as in scenes."""
    return fnmatch.fnmatchcase(name, pattern.replace("[", "[[]"))


def grouped(names: Sequence[str]) -> str:
    """Names in few words."""
    return ", ".join(names) if len(names) <= 3 else f"{names[0]} and {len(names) - 1} more"
