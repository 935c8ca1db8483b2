"""Compare two builds of midplane bit by bit on the scenes of the gallery.

Every array of every .vtu (points, cells, point, cell and field data), every number of history.csv, the .pvd and every number
of summary.json but times and memory must be identical. Texts of the summary are not compared, nor is the order of its keys.
Exit code 1 if anything differs, with the first difference of every file.
"""

import argparse
import json
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import numpy as np
from midplane.vtu import Array, Vtu

FORMS = ["as it is", "condensed", "blocks", "plain"]
APART = {"time", "peak_memory_bytes", "version"}


def scenes(folder: Path | str) -> list[Path]:
    """Scene files below a folder."""
    files = sorted(Path(folder).rglob("*.json"))
    return [file for file in files if '"subdomains"' in file.read_text() and '"steps"' in file.read_text()]


def run(program: Any, scene: Path, form: str, out: Path) -> int:
    """Runs a scene into a folder and returns the exit code."""
    command = [program, "run", "--quiet", scene, "-o", out]
    if form != "as it is":
        command += ["--set", f"solution.strategy={form}"]
    return subprocess.run(command, capture_output=True, check=False).returncode


def arrays(file: Path) -> dict[str, Any]:
    """All arrays of a .vtu by name."""
    mesh = Vtu(file)
    found = {"points": mesh.points}
    for kind in ("cells", "point_data", "cell_data", "field_data"):
        found |= {f"{kind} {name}": array for name, array in getattr(mesh, kind).items()}
    return found


def fields_differ(before: Path, after: Path) -> str | None:
    """The first difference of two .vtu files, or nothing."""
    were, are = arrays(before), arrays(after)
    if list(were) != list(are):
        return f"arrays {list(were)} became {list(are)}"
    for name, old in were.items():
        new = are[name]
        if old.dtype != new.dtype or old.shape != new.shape or old.tobytes() != new.tobytes():
            return f"{name}: {old.dtype}{old.shape} became {new.dtype}{new.shape}, {distance(old, new)}"
    return None


def distance(old: Array, new: Array) -> str:
    """Largest difference of two arrays in words."""
    if old.shape != new.shape or old.dtype.kind not in "fiu":
        return "not comparable"
    return f"largest difference {np.max(np.abs(old.astype(float) - new.astype(float))):.3e}"


def numbers(value: Any, path: str = "") -> Iterator[tuple[str, Any]]:
    """All numbers, flags and absent values of a summary with their keys; texts and lengths of lists of texts do not count."""
    if isinstance(value, dict):
        for key, inner in value.items():
            if key not in APART:
                yield from numbers(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for at, inner in enumerate(value):
            yield from numbers(inner, f"{path}[{at}]")
    elif not isinstance(value, str):
        yield path, value


def texts_differ(before: Path, after: Path) -> str | None:
    """The first line in which two texts differ, or nothing."""
    old, new = before.read_text().splitlines(), after.read_text().splitlines()
    for at, (a, b) in enumerate(zip(old, new, strict=False)):
        if a != b:
            return f"line {at + 1}: {a} became {b}"
    return None if len(old) == len(new) else f"{len(old)} lines became {len(new)}"


def summaries_differ(before: Path, after: Path) -> str | None:
    """The first number in which two summaries differ, or nothing."""
    old, new = (dict(numbers(json.loads(file.read_text()))) for file in (before, after))
    for key in sorted(old.keys() | new.keys()):
        if old.get(key, "absent") != new.get(key, "absent"):
            return f"{key}: {old.get(key, 'absent')} became {new.get(key, 'absent')}"
    return None


def compare(before: Path, after: Path) -> tuple[list[str], int]:
    """All differences of two results folders; and how many files were compared."""
    readers = {".vtu": fields_differ, ".csv": texts_differ, ".pvd": texts_differ, ".json": summaries_differ}
    listed = [sorted(str(file.relative_to(of)) for file in of.rglob("*") if file.suffix in readers and "mesh" not in file.parts) for of in (before, after)]
    if listed[0] != listed[1]:
        return [f"files {sorted(set(listed[0]) ^ set(listed[1]))} are on one side only"], 0
    found = [(name, readers[Path(name).suffix](before / name, after / name)) for name in listed[0]]
    return [f"{name}: {why}" for name, why in found if why], len(found)


def main() -> None:
    """Runs and compares."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("before", help="program of the commit before")
    parser.add_argument("after", help="program of this commit")
    parser.add_argument("folders", nargs="*", default=["geo"], help="folders with scenes")
    parser.add_argument("--forms", nargs="*", default=FORMS[:1], choices=FORMS, help="strategies")
    options = parser.parse_args()
    failed, compared, runs = False, 0, 0
    for scene in [scene for folder in options.folders for scene in scenes(folder)]:
        for form in options.forms:
            with tempfile.TemporaryDirectory() as folder:
                out = [Path(folder) / side / "out" for side in ("before", "after")]
                programs = (options.before, options.after)
                codes = [run(program, scene, form, at) for program, at in zip(programs, out, strict=True)]
                differences, count = compare(*out) if all(at.is_dir() for at in out) else ([], 0)
            if codes[0] != codes[1]:
                differences.insert(0, f"exit code {codes[0]} became {codes[1]}")
            runs, compared = runs + 1, compared + count
            failed |= bool(differences)
            print(f"{'DIFFERS' if differences else 'same bits'}  {scene} {form}: {count} files, exit {codes[1]}", flush=True)
            print("".join(f"    {difference}\n" for difference in differences[:10]), end="", flush=True)
    if compared == 0:
        sys.exit("nothing was compared")
    print(f"{runs} runs, {compared} files: {'DIFFERENT' if failed else 'identical bits'}")
    sys.exit(failed)


if __name__ == "__main__":
    main()
