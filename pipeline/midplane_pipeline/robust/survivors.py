"""The report of mutants: how many the tests notice, and the reasons of those that survive."""

import argparse
import json
import shutil
from pathlib import Path
from typing import Any

Site = dict[str, Any]  # a place of the sources


def same(reason: Site, site: Site) -> bool:
    """True if a reason is that of a place."""
    return all(reason[key] == site[key] for key in ("file", "function", "right", "wrong"))


def page(sites: list[Site], options: argparse.Namespace) -> str:
    """The report in Markdown."""
    areas = {site["area"]: None for site in sites}
    lines = ["# Mutants", "", f"Written by `make mutants`: {len(sites)} places, drawn with seed {options.seed}, each made wrong in turn.", ""]
    again = sum(site.get("again", False) for site in sites)
    if again:
        lines[-1:] = [f"{again} of them survived at first; tests were added, and these were tried once more (`make mutants again=1`).", ""]
    lines += ["| area | mutants | caught | of them by time | survive |", "|---|---|---|---|---|"]
    rows = [(area, [site for site in sites if site["area"] == area]) for area in areas] + [("all", sites)]
    for area, own in rows:
        caught = [site for site in own if site["caught"]]
        late = sum(site["caught"] == "time" for site in caught)
        lines.append(f"| {area} | {len(own)} | {len(caught)}, {100 * len(caught) / len(own):.0f} % | {late} | {len(own) - len(caught)} |")
    lines += ["", "Those that survive, and why:", "", "| place | right | wrong | reason |", "|---|---|---|---|"]

    def code(text: str) -> str:
        return "`" + " ".join(text.split()).replace("|", "\\|") + "`" if text else ""

    for site in sites:
        if not site["caught"]:
            place = f"{site['file'].removeprefix('src/')}, `{site['function']}`"
            lines.append(f"| {place} | {code(site['right'])} | {code(site['wrong'])} | {site['reason'] or '**none yet**'} |")
    return "\n".join(lines) + "\n"


def write(sites: list[Site], reasons: list[Site], out: Path, options: argparse.Namespace) -> None:
    """The report, and a line for the terminal."""
    for site in sites:
        site["reason"] = next((reason["reason"] for reason in reasons if same(reason, site)), "")
    (out / "report.json").write_text(json.dumps(sites, indent=1) + "\n")
    (out / "report.md").write_text(page(sites, options))
    if options.docs:
        shutil.copy(out / "report.md", options.docs / "MUTANTS.md")
    caught = sum(1 for site in sites if site["caught"])
    without = sum(1 for site in sites if not site["caught"] and not site["reason"])
    print(f"{caught} of {len(sites)} caught, {100 * caught / len(sites):.0f} %; {without} of the others without a reason")
