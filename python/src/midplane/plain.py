"""Values of Python as JSON has them."""

from __future__ import annotations

import hashlib
import json
import os
from typing import Any

from .errors import InputError


def to_plain(value: Any, key: str) -> Any:
    """A value as JSON has it: numbers and arrays of NumPy, tuples and paths too. Raises InputError."""
    try:
        return json.loads(json.dumps(value, default=other, allow_nan=False))
    except (TypeError, ValueError, RecursionError) as error:
        kind = type(value).__name__
        what = f"{value!r} ({kind})" if len(repr(value)) < 200 else f"a {kind}"
        raise InputError(f"{key}: {what} is nothing a scene can hold: numbers, text, true, false, lists, objects ({error})") from None


def other(value: Any) -> Any:
    """What JSON has for a value of another kind."""
    if isinstance(value, os.PathLike):
        return os.fspath(value)
    if hasattr(value, "tolist"):
        return value.tolist()
    raise TypeError(f"{type(value).__name__} has no counterpart")


def text_of(content: Any) -> str:
    """A content as the text of a file."""
    return json.dumps(content, indent=2, ensure_ascii=False) + "\n"


def digest(content: Any) -> str:
    """Eight letters that stand for a content."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:8]
