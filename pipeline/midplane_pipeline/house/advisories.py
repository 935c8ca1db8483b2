"""The RustSec advisories of the crates in Cargo.lock: copied from a clone of their list, or checked against that copy.

    python -m midplane_pipeline.house.advisories check                      offline: every crate of Cargo.lock against the copy
    python -m midplane_pipeline.house.advisories renew <advisory-db clone>  writes the copy, advisories.json beside this file, with the date of the clone

An advisory that concerns a version in Cargo.lock fails the check, unless `settled` in the file says why it does not matter.
"""

import json
import re
import subprocess
import sys
import tomllib
from pathlib import Path

from midplane_pipeline.places import ROOT

COPY = Path(__file__).resolve().parent / "advisories.json"


def locked() -> list[tuple[str, str, bool]]:
    """(name, version, whether it comes from elsewhere) of the crates of Cargo.lock."""
    lock = tomllib.loads((ROOT / "Cargo.lock").read_text())
    return [(package["name"], package["version"], "source" in package) for package in lock["package"]]


def number(version: str) -> tuple[int, ...]:
    """A version to compare by: a release is above its candidates."""
    core = re.split(r"[-+]", version)[0].split(".")
    return (*(int(part) for part in [*core, "0", "0"][:3]), 0 if "-" in version else 1)


def fits(version: str, requirement: str) -> bool:
    """True if a version fits a requirement such as ">= 1.2.3, < 2" or "^0.8"."""
    for part in requirement.split(","):
        found = re.match(r"\s*([<>=^~]*)\s*([0-9][^\s]*)", part)
        if found is None:
            raise ValueError(f"{requirement} is no requirement")
        sign, wanted = found.groups()
        have, want = number(version), number(wanted)
        if sign in ("^", "~", ""):
            parts = wanted.split(".")
            lead = next((k for k, p in enumerate(parts) if p != "0"), len(parts) - 1) if sign != "~" else min(1, len(parts) - 1)
            good = have >= want and have[: lead + 1] == want[: lead + 1]
        else:
            good = {"<": have < want, "<=": have <= want, ">": have > want, ">=": have >= want, "=": have == want}[sign]
        if not good:
            return False
    return True


def renew(clone: str) -> None:
    """Writes the copy from a clone of the list."""

    def git(*arguments: str) -> str:
        return subprocess.run(["git", "-C", clone, *arguments], check=True, capture_output=True, text=True).stdout

    names = {name for name, _, _ in locked()}
    found = []
    for path in git("ls-tree", "-r", "--name-only", "HEAD", "crates").split():
        if path.split("/")[1] not in names:
            continue
        text = git("show", f"HEAD:{path}")
        front = tomllib.loads("".join(re.findall(r"```toml\n(.*?)```", text, re.S)[:1]))
        advisory, versions = front["advisory"], front.get("versions", {})
        if advisory.get("withdrawn"):
            continue
        found.append(
            {
                "id": advisory["id"],
                "crate": advisory["package"],
                "kind": advisory.get("informational", "vulnerability"),
                "patched": versions.get("patched", []),
                "unaffected": versions.get("unaffected", []),
            }
        )
    before = json.loads(COPY.read_text()) if COPY.exists() else {"settled": {}}
    date = git("log", "-1", "--format=%cs").strip()
    content = {"date": date, "settled": before["settled"], "advisories": sorted(found, key=lambda one: one["id"])}
    COPY.write_text(json.dumps(content, indent=1) + "\n")
    print(f"{len(found)} advisories of {len(names)} crates, {date}")


def check() -> None:
    """Ends with 1 where an advisory is open, or one that is settled is none."""
    copy = json.loads(COPY.read_text())
    open_ones = []
    for name, version, foreign in locked():
        for one in copy["advisories"]:
            if one["crate"] != name or not foreign:
                continue  # a crate of this repository stands in for the one of that name
            if any(fits(version, good) for good in one["patched"] + one["unaffected"]):
                continue
            if one["id"] not in copy["settled"]:
                open_ones.append(f"{one['id']} ({one['kind']}) concerns {name} {version}")
    unused = [one for one in copy["settled"] if one not in {own["id"] for own in copy["advisories"]}]
    for line in open_ones + [f"{one} is settled and is no advisory" for one in unused]:
        print(line)
    print(f"advisories of {copy['date']}: {len(copy['advisories'])} of these crates, {len(open_ones)} open")
    sys.exit(1 if open_ones or unused else 0)


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "renew":
        renew(sys.argv[2])
    elif sys.argv[1:] == ["check"]:
        check()
    else:
        sys.exit(__doc__)
