"""Read a scene as people write it: a byte order mark and comments are no part of JSON."""

import json
import re

TOKENS = re.compile(r'("(?:\\.|[^"\\])*")|//[^\n]*|/\*.*?\*/', re.DOTALL)


def read(path):
    """The scene of a file as a dictionary."""
    text = path.read_text(encoding="utf-8-sig")
    return json.loads(TOKENS.sub(lambda found: found.group(1) or " ", text))


def probes(scene):
    """Columns of the history that are probes, by name; formulas over other columns are left out."""
    history = scene.get("output", {}).get("history", {})
    return {name: probe for name, probe in history.items() if isinstance(probe, str)}


def constants(path):
    """The numbers of a `.geo` by name."""
    return {name: float(value) for name, value in re.findall(r"(\w+)\s*=\s*\{([-\d.]+),", path.read_text())}
