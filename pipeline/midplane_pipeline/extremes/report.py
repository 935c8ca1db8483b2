"""The report of a campaign: a line per row on the terminal, Markdown for the docs, one HTML page with the curves in it."""

from __future__ import annotations

import base64
from dataclasses import dataclass
from pathlib import Path

from midplane_pipeline.draw.page_text import page_text

from . import curves
from .row import Claim, Trial


@dataclass
class Entry:
    """A row that was tried."""

    number: str
    tried: str
    expected: str
    trial: Trial
    seconds: float
    runs: int

    @property
    def good(self) -> bool:
        """True if there are claims and all of them hold."""
        return bool(self.trial.claims) and all(claim.good for claim in self.trial.claims)

    def closest(self) -> Claim | None:
        """The claim with the least margin: a missed one, else the number nearest to its limit."""
        missed = (claim for claim in self.trial.claims if not claim.good)
        measured = [(claim.margin, number) for number, claim in enumerate(self.trial.claims) if claim.margin is not None]
        first = self.trial.claims[min(measured)[1] if measured else 0] if self.trial.claims else None
        return next(missed, first)

    def margin(self) -> str:
        """Distance from the limit, in words."""
        claim = self.closest()
        if claim is None:
            return ""
        if not claim.good:
            return "missed"
        if claim.margin is None:
            return "as said"
        if claim.margin == float("inf"):
            return "exact"
        return f"{claim.margin:.0f} ×" if claim.margin >= 10 else f"{claim.margin:.1f} ×"


def line(entry: Entry) -> str:
    """A row on the terminal."""
    good = sum(claim.good for claim in entry.trial.claims)
    text = f"{entry.number:<4} {'as expected' if entry.good else 'MISSED':<12} {good:>4}/{len(entry.trial.claims):<4}"
    text += f" {entry.seconds:6.1f} s  {entry.tried}"
    for claim in entry.trial.claims:
        if not claim.good:
            text += f"\n     {claim.what}: {claim.got}; must be {claim.limit}"
    return text


def write(entries: list[Entry], out: Path, docs: Path | None) -> None:
    """Writes both forms; `docs`, if given, gets the Markdown and the curves."""
    out.mkdir(parents=True, exist_ok=True)
    pictures = {}
    for entry in entries:
        for curve in entry.trial.curves:
            name = f"extremes_{entry.number.lower()}_{curve.name}.png"
            curves.draw(curve, out / name)
            pictures[entry.number, curve.name] = name
    (out / "EXTREMES.md").write_text(markdown(entries, pictures, ""))
    (out / "report.html").write_text(page(entries, pictures, out))
    if docs:
        (docs / "EXTREMES.md").write_text(markdown(entries, pictures, "extremes/"))
        (docs / "extremes").mkdir(exist_ok=True)
        for name in pictures.values():
            (docs / "extremes" / name).write_bytes((out / name).read_bytes())


def head(entries: list[Entry]) -> str:
    """The result in a sentence."""
    missed = [entry.number for entry in entries if not entry.good]
    text = f"{len(entries) - len(missed)} of {len(entries)} rows as expected"
    return text + (f"; missed: {', '.join(missed)}." if missed else ".")


INTRODUCTION = """\
Written by `make extremes`, which tries every row through the command line alone. Each meets an accuracy that follows from a
formula or an exact solution, or is refused with a message that names its reason and an exit code other than 0. Never, in
any call: a panic, NaN in a file after exit code 0, a part of a joint dropped in silence, more than 60 s.

*Margin* is the least of limit over got among a row's numbers; *as said* stands for rows of texts and counts."""


def markdown(entries: list[Entry], pictures: dict[tuple[str, str], str], folder: str) -> str:
    """The table of all rows, then notes and curves."""
    parts = ["# Extremes", "", INTRODUCTION, "", f"**{head(entries)}**", ""]
    parts += [
        "| row | tried | expected | closest to its limit | got | limit | margin |",
        "|---|---|---|---|---|---|---|",
    ]
    for entry in entries:
        claim = entry.closest()
        cells = [entry.number, entry.tried, entry.expected]
        cells += [claim.what, claim.got, claim.limit, entry.margin()] if claim else [""] * 4
        parts.append("| " + " | ".join(cell.replace("|", "\\|").replace("\n", " ") for cell in cells) + " |")
    for entry in entries:
        if not (entry.trial.curves or entry.trial.notes):
            continue
        parts += ["", f"## {entry.number}: {entry.tried}", ""]
        parts += [note + "\n" for note in entry.trial.notes]
        parts += [f"![{c.title}]({folder}{pictures[entry.number, c.name]})\n" for c in entry.trial.curves]
    return "\n".join(parts).rstrip() + "\n"


STYLE = """\
body { font: 15px/1.45 sans-serif; max-width: 70em; margin: 2em auto; padding: 0 1em; color: #222 }
table { border-collapse: collapse; width: 100% } td, th { border-bottom: 1px solid #ddd; padding: .25em .5em; text-align: left;
vertical-align: top; overflow-wrap: anywhere } .missed { background: #fdd } img { max-width: 100% }
summary { cursor: pointer; padding: .3em; border-bottom: 1px solid #ddd } code { font-size: 13px }"""


def page(entries: list[Entry], pictures: dict[tuple[str, str], str], out: Path) -> str:
    """Everything in one file: every claim of every row, and the curves."""
    parts = [f"<!doctype html><html lang=en><meta charset=utf-8><title>Extremes</title><style>{STYLE}</style>"]
    parts += ["<h1>Extremes</h1>", *(f"<p>{page_text(text)}</p>" for text in INTRODUCTION.split("\n\n"))]
    parts.append(f"<p><strong>{page_text(head(entries))}</strong></p>")
    for entry in entries:
        state = "" if entry.good else " class=missed"
        title = page_text(f"{entry.number}  {entry.tried}")
        about = f"{entry.margin()}, {entry.runs} runs, {entry.seconds:.1f} s"
        opened = "" if entry.good and not entry.trial.curves else " open"
        parts.append(f"<details{opened}><summary{state}><strong>{title}</strong> ({page_text(about)})</summary>")
        parts.append(f"<p>Expected: {page_text(entry.expected)}</p>")
        parts += [f"<p>{page_text(note)}</p>" for note in entry.trial.notes]
        for curve in entry.trial.curves:
            data = base64.b64encode((out / pictures[entry.number, curve.name]).read_bytes()).decode()
            parts.append(f'<img alt="{page_text(curve.title)}" src="data:image/png;base64,{data}">')
        parts.append("<table><tr><th>claim<th>got<th>limit<th>margin</tr>")
        for claim in entry.trial.claims:
            margin = "" if claim.margin is None else f"{claim.margin:.2g}"
            cells = "".join(f"<td>{page_text(text)}" for text in (claim.what, claim.got, claim.limit, margin))
            parts.append(f"<tr{'' if claim.good else ' class=missed'}>{cells}</tr>")
        parts.append("</table></details>")
    return "\n".join(parts) + "\n"
