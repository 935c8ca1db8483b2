"""Files of runs: whole or broken, and alike but for measured values; meshers that are still at work."""

import csv
import json
import xml.etree.ElementTree as xml
from pathlib import Path
from typing import Any


def digest(path: Path) -> Any:
    """The bytes of a file, without what differs between two runs that do the same."""
    data = path.read_bytes()
    if path.name in ("summary.json", "study.json") or path.parent.name == "points":
        content = json.loads(data)
        return json.dumps(timeless(content), sort_keys=True)
    if path.name == "study.csv":
        rows = list(csv.DictReader(data.decode().splitlines()))
        return json.dumps([{k: v for k, v in row.items() if not is_measured(k)} for row in rows])
    if path.name == "manifest":
        # ends of steps are kept as often as time allows
        return [line for line in data.decode().splitlines() if not line.startswith("checkpoint/")]
    return data


def is_measured(key: str) -> bool:
    """Quantities of the process, not of the model; one that goes on factors once more."""
    names = (
        "time",
        "peak_memory_bytes",
        "resumed",
        "factorisations",
        "seconds",
        "processor",
        "stages",
        "peak_memory",
        "reused",
        "load_average",
        "seconds_min",
        "seconds_median",
        "seconds_spread",
        "processor_seconds",
    )
    return key in names or key.startswith("seconds.")


def timeless(value: Any) -> Any:
    """A content without what is measured."""
    if isinstance(value, dict):
        return {key: timeless(below) for key, below in value.items() if not is_measured(key)}
    return [timeless(below) for below in value] if isinstance(value, list) else value


def contents(folder: Path) -> dict[str, Any]:
    """All files below a folder by name, hidden ones too, but for its checkpoints."""
    files = [path for path in sorted(folder.rglob("*")) if path.is_file()]
    return {str(path.relative_to(folder)): digest(path) for path in files if not is_checkpoint(path)}


def is_checkpoint(path: Path) -> bool:
    """True of a whole file among the checkpoints."""
    return path.parent.name == "checkpoint" and not path.name.startswith(".")


def broken(folder: Path) -> str | None:
    """The first file in the folder of an ended run that is not whole, none if all are."""
    for path in folder.rglob("*"):
        if not path.is_file() or path.name.startswith(".midplane-") or ".midplane-" in str(path.parent):
            continue
        data = path.read_bytes()
        try:
            if path.suffix == ".json":
                json.loads(data)
            elif path.suffix == ".csv":
                rows = list(csv.reader(data.decode().splitlines()))
                assert data.endswith(b"\n") and len({len(row) for row in rows}) == 1, "rows differ in length"
            elif path.suffix == ".pvd":
                for entry in xml.fromstring(data).iter("DataSet"):
                    file = entry.get("file", "none")
                    assert (folder / file).is_file(), f"{file} is not there"
            elif path.suffix == ".vtu":
                assert data.rstrip().endswith(b"</VTKFile>"), "no end"
            elif path.suffix == ".msh":
                assert data.rstrip().endswith(b"$EndElements") or b"$End" in data[-64:], "no end"
        except (AssertionError, ValueError, xml.ParseError) as why:
            return f"{path.relative_to(folder)}: {why}"
    return None


def meshers(folder: Path) -> list[int]:
    """Processes of the mesher that work in a folder."""
    found = []
    for entry in Path("/proc").glob("[0-9]*"):
        try:
            command = (entry / "cmdline").read_bytes()
            if str(folder).encode() in command and b"gmsh" in command.split(b"\0")[0] + command.split(b"\0")[1]:
                found.append(int(entry.name))
        except (OSError, IndexError):
            pass
    return found
