"""Rows of the campaign: what is tried, what must happen, what was found, and how far that is from the limit."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

from .program import Program

Function = Callable[["Trial"], None]  # a row

ROWS: list[tuple[str, str, str, Function]] = []


@dataclass
class Claim:
    """One thing that a row asserts. `margin` is limit / got where both are numbers: above 1 is within."""

    what: str
    got: str
    limit: str
    good: bool
    margin: float | None = None


@dataclass
class Curve:
    """A graph of a row: series are (label, x, y); y is drawn on a logarithmic axis."""

    name: str
    title: str
    x_label: str
    y_label: str
    series: list[Any]
    line: float | None = None  # the limit, if it is the same everywhere


@dataclass
class Trial:
    """The program that a row is handed, and room for its findings."""

    program: Program
    quick: bool
    claims: list[Claim] = field(default_factory=list)
    curves: list[Curve] = field(default_factory=list)
    notes: list[str] = field(default_factory=list)

    def below(self, what: str, got: Any, limit: float) -> None:
        """A number must not exceed a limit; NaN does."""
        got = float(got)
        margin = float("inf") if got == 0 else limit / got
        self.claims.append(Claim(what, f"{got:.1e}", f"≤ {limit:.1e}", bool(got <= limit), margin))

    def within(self, what: str, got: Any, low: float, high: float) -> None:
        """A number must lie between two others."""
        good = bool(low <= got <= high)
        self.claims.append(Claim(what, f"{got:.6g}", f"{low:.6g} … {high:.6g}", good))

    def equal(self, what: str, got: Any, expected: Any) -> None:
        """Two values must be the same."""
        self.claims.append(Claim(what, str(got), str(expected), bool(got == expected)))

    def holds(self, what: str, good: Any, got: Any = "", limit: str = "yes") -> None:
        """Something must be true."""
        self.claims.append(Claim(what, str(got) or ("yes" if good else "no"), limit, bool(good)))

    def refused(self, what: str, run: Any, *texts: str, code: int = 2) -> None:
        """The program must refuse: exit code, one message, and in it the given texts; nothing may be written."""
        missing = [text for text in texts if text not in run.message]
        got = f"exit {run.code}: {first_line(run.message)}"
        if missing:
            got += f" (without {', '.join(map(repr, missing))})"
        good = run.code == code and not missing and (code != 2 or not run.wrote())
        self.claims.append(Claim(what, got, f"exit {code}" + "".join(f", “{t}”" for t in texts), good))

    def warned(self, what: str, run: Any, code: Any) -> None:
        """The program must warn with this code."""
        got = ", ".join(run.warning_codes()) or "no warning"
        self.claims.append(Claim(what, got, f"warns {code}", code in run.warning_codes()))

    def silent(self, what: str, run: Any, code: Any) -> None:
        """The program must not warn with this code."""
        got = ", ".join(run.warning_codes()) or "no warning"
        self.claims.append(Claim(what, got, f"no {code}", code not in run.warning_codes()))

    def note(self, text: str) -> None:
        """A line for the report: a measured value without a limit, or why an expectation was changed."""
        self.notes.append(text)


def first_line(text: str) -> str:
    """The first line of a message, without its beginning."""
    lines = text.strip().splitlines()
    return lines[0].removeprefix("error: ")[:120] if lines else ""


def row(number: str, tried: str, expected: str) -> Callable[[Function], Function]:
    """Registers a function as a row."""

    def register(function: Function) -> Function:
        ROWS.append((number, tried, expected, function))
        return function

    return register
