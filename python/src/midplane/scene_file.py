"""Scenes as people write them: a byte order mark and comments are no part of JSON."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

TOKENS = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read(path: Path) -> dict[str, Any]:
    """The scene of a file as a dictionary. Raises ValueError for what is no JSON, OSError where there is no file."""
    content = json.loads(without_comments(path.read_text(encoding="utf-8-sig")))
    if not isinstance(content, dict):
        raise ValueError("a scene is an object { }")
    return content


def without_comments(text: str) -> str:
    """The text with comments replaced by blanks."""
    return TOKENS.sub(lambda found: found.group(1) or " ", text)


def probes(scene: dict[str, Any]) -> dict[str, str]:
    """Columns of the history that are probes, by name; formulas over other columns are left out."""
    history = scene.get("output", {}).get("history", {})
    return {name: probe for name, probe in history.items() if isinstance(probe, str)}


def constants(path: Path) -> dict[str, float]:
    """The numbers of a `.geo` by name."""
    return {name: float(value) for name, value in re.findall(r"(\w+)\s*=\s*\{([-\d.]+),", path.read_text(encoding="utf-8"))}
