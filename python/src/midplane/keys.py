"""Keys of a scene written in one line: names with dots between, or a JSON pointer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from .errors import InputError
from .names import unknown


def parts(key: str, content: Any) -> list[str]:
    """The names in a key, outermost first. A name may have dots of its own, such as a group: the longest that is there counts."""
    if key.startswith("/"):
        return [part.replace("~1", "/").replace("~0", "~") for part in key[1:].split("/")]
    words, found = key.split("."), []
    while words:
        count = 1
        if isinstance(content, dict):
            there = (n for n in range(len(words), 0, -1) if ".".join(words[:n]) in content)
            count = next(there, 1)
        found.append(".".join(words[:count]))
        words = words[count:]
        content = child(content, found[-1])
    return found


def child(content: Any, part: str) -> Any:
    """What an object or a list has under a name or a number; None if nothing."""
    if isinstance(content, dict):
        return content.get(part)
    if isinstance(content, list) and part.isdecimal() and int(part) < len(content):
        return content[int(part)]
    return None


def pointer(names: Sequence[str]) -> str:
    """The JSON pointer of a key."""
    return "".join("/" + name.replace("~", "~0").replace("/", "~1") for name in names)


def get(content: Any, key: str, place: str) -> Any:
    """The value of a key. Raises InputError that tells what there is."""
    at: list[str] = []
    for part in parts(key, content):
        inner = child(content, part)
        if inner is None:
            where = f"{place} {'.'.join(at)}".rstrip()
            if isinstance(content, dict):
                raise InputError(unknown(where, "key", part, content))
            if isinstance(content, list):
                raise InputError(f"{where}: there is no entry {part}; there are {len(content)}, counted from 0")
            raise InputError(f"{where}: is {content!r}, which holds no {part!r}")
        content = inner
        at.append(part)
    return content


def put(content: Any, names: Sequence[str], value: Any, place: str) -> None:
    """Puts a value into an object of objects and lists; objects on the way that are not there are made."""
    for count, part in enumerate(names[:-1]):
        inner = child(content, part)
        if inner is None and isinstance(content, dict):
            inner = content[part] = {}
        if not isinstance(inner, dict | list):
            raise InputError(f"{place} {'.'.join(names[: count + 1])}: holds no keys, so there is no {names[count + 1]!r} to be set")
        content = inner
    last = names[-1]
    if isinstance(content, dict):
        content[last] = value
    elif last.isdecimal() and int(last) < len(content):
        content[int(last)] = value
    else:
        raise InputError(f"{place} {'.'.join(names[:-1])}: there is no entry {last}; there are {len(content)}, counted from 0")


def without(content: Any, key: str, place: str) -> None:
    """Takes a key out."""
    get(content, key, place)
    *names, last = parts(key, content)
    for part in names:
        content = child(content, part)
    del content[int(last) if isinstance(content, list) else last]
