"""The licences of all crates in Cargo.lock.

python -m midplane_pipeline.house.licences check    every crate may be used under one of those that this project takes, and docs/LICENCES.md lists it
python -m midplane_pipeline.house.licences write    writes docs/LICENCES.md
"""

import json
import re
import subprocess
import sys

from midplane_pipeline.places import ROOT

LIST = ROOT / "docs/LICENCES.md"
TAKEN = {
    "MIT",
    "Apache-2.0",
    "Apache-2.0 WITH LLVM-exception",
    "BSD-1-Clause",
    "BSD-2-Clause",
    "BSD-3-Clause",
    "ISC",
    "MIT-0",
    "Unicode-3.0",
    "Unlicense",
    "Zlib",
    "0BSD",
    "CC0-1.0",
    "BSL-1.0",
    "NCSA",
}


def crates() -> list[tuple[str, str, str]]:
    """(name, version, licence) of all crates from elsewhere."""
    command = ["cargo", "metadata", "--format-version", "1", "--locked"]
    data = json.loads(subprocess.run(command, cwd=ROOT, check=True, capture_output=True, text=True).stdout)
    packages = [package for package in data["packages"] if package["source"]]
    return sorted((package["name"], package["version"], package["license"] or "none") for package in packages)


def is_taken(licence: str) -> bool:
    """True if an SPDX expression leaves a choice that takes only licences of the list."""
    words = re.split(r"\s+(AND|OR)\s+|([()])", licence.replace("/", " OR "))
    said = [word.strip() for word in words if word and word.strip()]
    python = [word.lower() if word in ("AND", "OR") else word if word in "()" else str(word in TAKEN) for word in said]
    return bool(python) and eval(" ".join(python), {"__builtins__": {}})  # of True, False, and, or and parentheses only


def text(all_of: list[tuple[str, str, str]]) -> str:
    """docs/LICENCES.md."""
    lines = ["# Licences", "", "Of the crates that midplane is built from, written by `python -m midplane_pipeline.house.licences write`.", ""]
    lines += ["| crate | version | licence |", "|---|---|---|"]
    return "\n".join(lines + [f"| {name} | {version} | {licence} |" for name, version, licence in all_of]) + "\n"


def main() -> None:
    """The command."""
    all_of = crates()
    if sys.argv[1:] == ["write"]:
        LIST.write_text(text(all_of))
        return
    if sys.argv[1:] != ["check"]:
        sys.exit(__doc__)
    bad = [f"{name} {version}: {licence}" for name, version, licence in all_of if not is_taken(licence)]
    stale = not LIST.exists() or LIST.read_text() != text(all_of)
    print("\n".join(bad) or f"licences of {len(all_of)} crates are taken")
    if stale:
        print("docs/LICENCES.md is not that of Cargo.lock: python -m midplane_pipeline.house.licences write")
    sys.exit(1 if bad or stale else 0)


if __name__ == "__main__":
    main()
