"""Names that are chosen among those there are: patterns, and what to say of a name that is not there."""

import difflib
import fnmatch

MANY = 30  # names that a message lists


def unknown(place, what, name, names):
    """What to say where a name is none of those there are."""
    names = list(names)
    there = ", ".join(names[:MANY]) + (f" and {len(names) - MANY} more" if len(names) > MANY else "") or "none"
    near = difflib.get_close_matches(name, names, n=1, cutoff=0.5)
    return f'{place}: no {what} "{name}"; there is {there}' + (f'. Did you mean "{near[0]}"?' if near else "")


def chosen(place, what, patterns, names):
    """The names that fit one of the patterns, in their order; a pattern that fits none ends the program."""
    for pattern in patterns:
        if not any(fits(pattern, name) for name in names):
            raise SystemExit(unknown(place, what, pattern, names))
    return [name for name in names if any(fits(pattern, name) for pattern in patterns)]


def fits(pattern, name):
    """Whether a name fits a pattern: * is any text, ? any character, as in scenes."""
    return fnmatch.fnmatchcase(name, pattern.replace("[", "[[]"))


def grouped(names):
    """Names in few words."""
    return ", ".join(names) if len(names) <= 3 else f"{names[0]} and {len(names) - 1} more"
