"""What `midplane check` finds."""

from __future__ import annotations

import re
from dataclasses import dataclass

WARNING = re.compile(r"^warning: (W\d+) (.*?)(?:\n +help: (.*?))?$", re.MULTILINE)


@dataclass(frozen=True)
class Warned:
    """One warning: its code (docs/WARNINGS.md has a section for each), what it says, and what helps."""

    code: str
    text: str
    help: str = ""

    def __str__(self) -> str:
        return f"{self.code} {self.text}" + (f"\n    {self.help}" if self.help else "")


class Check:
    """The tables of sizes and interfaces (`text`) and the `warnings`; shown as both."""

    def __init__(self, text: str, told: str) -> None:
        self.text = text
        self.warnings = warnings_in(told)

    def __repr__(self) -> str:
        return "\n".join([self.text, *map(str, self.warnings)])


def warnings_in(told: str) -> list[Warned]:
    """The warnings among what the program says."""
    return [Warned(code, text, help_ or "") for code, text, help_ in WARNING.findall(told)]
