"""Keys of a scene written in one line: names with dots between, or a JSON pointer."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NoReturn

from .errors import InputError
from .names import unknown

GROUPS = ("fix", "hold", "release", "displace", "load")  # of a step: under them stand groups, SUBDOMAIN.GROUP
NOTHING = object()


def parts(key: Any, scene: Any) -> list[str]:
    """The names in a key, outermost first. A name may have dots of its own, such as a group: the longest that is there counts."""
    if not isinstance(key, str):
        raise InputError(f'a key is a text such as "steps.0.increments", not {key!r}')
    if key.startswith("/"):
        return [part.replace("~1", "/").replace("~0", "~") for part in key[1:].split("/")]
    content, words, found = scene, key.split("."), list[str]()
    while words:
        held = content if isinstance(content, dict) else {}
        there = (n for n in range(len(words), 0, -1) if ".".join(words[:n]) in held)
        count = next(there, 2 if is_group(found, words, scene) else 1)
        found.append(".".join(words[:count]))
        words = words[count:]
        content = child(content, found[-1])
    return found


def is_group(found: Sequence[str], words: Sequence[str], scene: Any) -> bool:
    """Whether two words are a group that a step does not have yet."""
    under = len(found) == 3 and found[0] == "steps" and found[2] in GROUPS
    return under and len(words) > 1 and words[0] in (child(scene, "subdomains") or ())


def child(content: Any, part: str) -> Any:
    """What an object or a list has under a name or a number; NOTHING if there is no such thing."""
    if isinstance(content, dict):
        return content.get(part, NOTHING)
    if isinstance(content, list) and part.isdecimal() and int(part) < len(content):
        return content[int(part)]
    return NOTHING


def pointer(names: Sequence[str]) -> str:
    """The JSON pointer of a key."""
    return "".join("/" + name.replace("~", "~0").replace("/", "~1") for name in names)


def option(pointer: str) -> str:
    """A key as the program's options take it: with dots, where that is the same."""
    dotted = pointer[1:].replace("/", ".")
    return pointer if any(letter in pointer for letter in ".~=") else dotted


def has(content: Any, key: str) -> bool:
    """Whether there is such a key."""
    for part in parts(key, content):
        content = child(content, part)
    return content is not NOTHING


def get(content: Any, key: str, place: str) -> Any:
    """The value of a key. Raises InputError that tells what there is."""
    at: list[str] = []
    for part in parts(key, content):
        inner = child(content, part)
        if inner is NOTHING:
            missing(content, part, f"{place} {'.'.join(at)}".rstrip())
        content = inner
        at.append(part)
    return content


def missing(content: Any, part: str, where: str) -> NoReturn:
    """Tells that there is no such key or entry."""
    if isinstance(content, dict):
        raise InputError(unknown(where, "key", part, content))
    if isinstance(content, list):
        name = where.rpartition(" ")[2]
        more = f'; scene["{name}"] = scene["{name}"] + […] adds one' if part == str(len(content)) else ""
        raise InputError(f"{where}: there is no entry {part}; there are {len(content)}, counted from 0{more}")
    raise InputError(f"{where}: is {content!r}, which holds no {part!r}")


def put(content: Any, names: Sequence[str], value: Any, place: str) -> None:
    """Puts a value into an object of objects and lists; objects on the way that are not there are made."""
    for count, part in enumerate(names[:-1]):
        inner = child(content, part)
        if inner is NOTHING and isinstance(content, dict):
            inner = content[part] = {}
        elif inner is NOTHING:
            missing(content, part, f"{place} {'.'.join(names[:count])}".rstrip())
        content = inner
    last = names[-1]
    if isinstance(content, dict):
        content[last] = value
    elif child(content, last) is NOTHING:
        missing(content, last, f"{place} {'.'.join(names[:-1])}".rstrip())
    else:
        content[int(last)] = value


def without(content: Any, key: str, place: str) -> list[str]:
    """Takes a key out; its names."""
    get(content, key, place)
    *names, last = parts(key, content)
    for part in names:
        content = child(content, part)
    del content[int(last) if isinstance(content, list) else last]
    return [*names, last]


class Seen(dict[str, Any]):
    """An object of a scene as it is read: a copy, so what is put into it would be lost, and is refused."""

    place = ""

    def refuse(self, *_: Any, **__: Any) -> NoReturn:
        """Tells how a value is changed."""
        raise InputError(f'this is a copy of a part of the scene; scene["{self.place}.…"] = … changes it')

    __setitem__ = __delitem__ = update = pop = popitem = clear = setdefault = __ior__ = refuse


class SeenList(list[Any]):
    """The same for a list."""

    place = ""

    def refuse(self, *_: Any, **__: Any) -> NoReturn:
        """Tells how a value is changed."""
        name = self.place
        raise InputError(f'this is a copy of a part of the scene; scene["{name}.0"] = … changes an entry, scene["{name}"] = scene["{name}"] + […] adds one')

    __setitem__ = __delitem__ = append = extend = insert = pop = remove = clear = sort = reverse = __iadd__ = __imul__ = refuse


def seen(content: Any, place: str) -> Any:
    """A value of a scene as it is read."""
    if isinstance(content, dict):
        inner = Seen((name, seen(value, f"{place}.{name}".lstrip("."))) for name, value in content.items())
        inner.place = place
        return inner
    if isinstance(content, list):
        entries = SeenList(seen(value, f"{place}.{number}") for number, value in enumerate(content))
        entries.place = place
        return entries
    return content
