"""Check the results of one scene from outside, with programs that know nothing of midplane.

Every VTU is read by meshio, by VTK (through pyvista) and by the package, and all must find the same points, cells and
arrays, of the shapes and names the README promises, and finite. Faces of cracks and of Coulomb joints that are
apart must not press on each other. The .pvd must name exactly the files there are, history.csv must hold a row
per increment, and its energies must be right. Then statics at the last increment: the loads and reactions of
the whole model balance, and so do those of each subdomain together with the tractions of its interfaces, which
are integrated here from the VTUs.

One line per scene if all is well; otherwise a line per fault, and exit code 1.
"""

import argparse
import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path
from typing import Any

from midplane import scene_file
from midplane.stored import Stored

from midplane_pipeline.results.entries import entry_of
from midplane_pipeline.results.told import told

from .energies import check_energies
from .faults import Faults
from .history import read_history
from .interface import check_interface, check_midplane, water_of
from .known import Every, Expected, Like, argument, rows_of
from .readers import read_thrice
from .statics import check_balance
from .subdomain import check_subdomain, has_stages

ENERGY_BALANCE = 1e-8  # where geo/<scene>/check.args says nothing: work − stored − dissipated − released, of the largest of them so far
SUMMARY_KEYS = {"title", "sizes", "variables", "solution", "equilibrium", "time", "warnings"}
LENGTH = 1e-9  # what the law points leave out of an interface


def collection(path: Path, faults: Faults) -> tuple[list[Path], list[int]]:
    """The files that the .pvd names, which must be all there are in fields/, and their times."""
    named: list[str] = []
    times: list[int] = []
    last = 0.0
    for dataset in ElementTree.parse(path).iter("DataSet"):
        named.append(dataset.get("file", ""))
        time = float(dataset.get("timestep", "nan"))
        # the number of the row, whatever the load does
        row = int(Path(named[-1]).stem.rpartition("_")[2])
        faults.expect(time == row and time >= last, f"{path}: time {time:g} at {named[-1]}")
        last = time
        times.append(row)
    present = {f"fields/{file.name}" for file in path.parent.glob("fields/*")}
    faults.expect(len(named) == len(set(named)), f"{path}: names a file twice")
    faults.expect(set(named) == present, f"{path}: names and files differ: {sorted(set(named) ^ present)}")
    return [path.parent / file for file in named if file in present], sorted(set(times))


def check(results: Path, scene: dict[str, Any], energy: float, known: argparse.Namespace, faults: Faults) -> str:
    """All checks of one results folder, and what is known of it. Returns the sentence for the user."""
    for name in ("history.csv", "summary.json"):
        if not faults.expect((results / name).is_file(), f"{results}: no {name}"):
            return ""
    collections = list(results.glob("*.pvd"))
    stored = scene.get("output", {}).get("fields", "every") != "none"
    if not faults.expect(len(collections) == stored, f"{results}: {len(collections)} .pvd files, not {int(stored)}"):
        return ""
    summary = Stored(results).summary()
    missing = SUMMARY_KEYS - summary.keys()
    if not faults.expect(not missing, f"{results}/summary.json: no {sorted(missing)}"):
        return ""

    rows = read_history(results / "history.csv", scene, faults)
    solution = summary["solution"]
    files, times = collection(collections[0], faults) if stored else ([], [])
    every = scene.get("output", {}).get("fields", "every") == "every"
    faults.expect(
        not every or times == [row["increment"] for row in rows],
        f"{results}: the .pvd has the times {times}, history.csv {len(rows)} rows",
    )
    faults.expect(
        [solution["rows"], solution["fields"]] == [len(rows), len(times)],
        f"{results}: summary.json has {solution['rows']} rows and {solution['fields']} fields, not {len(rows)}, {len(times)}",
    )
    rows = rows[1:]  # beyond the unloaded state
    variables = [variable["name"] for variable in summary["variables"]]
    interfaces: dict[int, dict[str, Any]] = {}
    last = 0
    for path in files:
        name, _, number = path.stem.rpartition("_")
        last = max(last, int(number))
        grid = read_thrice(path, faults)
        if grid is None:
            continue
        if name in scene["subdomains"]:
            check_subdomain(path, grid, name, scene, faults)
        else:
            law, water = entry_of(scene, name)["law"], water_of(scene, name)
            check_interface(path, grid, law, variables, water, not has_stages(scene), faults)
            interfaces.setdefault(int(number), {})[name] = grid
    for path in results.glob("midplane/*.vtu"):
        check_midplane(path, faults)
    faults.expect(
        last == len(rows) or not stored,
        f"{results}: fields up to increment {last}, history up to {len(rows)}",
    )
    for name, grid in interfaces.get(last, {}).items():
        along, whole = grid["length"].sum(), summary["sizes"]["interfaces"][name]["length"]
        faults.expect(
            abs(along - whole) <= LENGTH * whole,
            f"{results}: the law points of {name} stand for {along:.9g} of its {whole:.9g}",
        )
    if faults:
        return ""
    energies = check_energies(results / "history.csv", scene, results, summary, rows, energy, faults)
    fields = interfaces.get(last, {})
    whole, part = check_balance(results, scene, summary, rows, fields, faults)
    check_known(results, rows, fields, known, faults)
    return (
        f"{len(files)} VTU files, increments: {len(rows)}; loads and reactions balance to {whole:.1e}, "
        + ("" if part is None else f"subdomains with their interfaces to {part:.1e}, ")
        + energies
    )


def check_known(results: Path, rows: list[dict[str, Any]], fields: dict[str, Any], known: argparse.Namespace, faults: Faults) -> None:
    """All that is known of the scene."""

    def others(name: str) -> list[dict[str, Any]]:
        """The rows of another file of the scene, whose results lie beside these."""
        folder = results.parent / known.scene.parent.name
        path = (folder if name == "scene" else folder.with_name(f"{folder.name}_{name}")) / "history.csv"
        if not faults.expect(path.is_file(), f"{results}: no {path} to compare with"):
            return []
        return rows_of(path)

    for expected in known.expect:
        expected.check(results, rows, fields, faults)
    for like in known.like:
        like.check(results, rows, others, faults)
    for every in known.every:
        every.check(results, rows, faults)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(
        prog="python -m midplane_pipeline.check",
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        fromfile_prefix_chars="@",
    )
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/compression/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/compression")
    parser.add_argument(
        "--energy",
        type=float,
        default=ENERGY_BALANCE,
        help="largest |work − stored − dissipated − released|, over the largest of them so far (default: %(default)g)",
    )
    for option, form, meaning in (
        ("--expect", Expected, "what is known of a value"),
        ("--like", Like, "a value is as in the run of another file of the scene, part of it"),
        ("--every", Every, "a column is what others make it"),
    ):
        many: dict[str, Any] = {"action": "append", "default": [], "metavar": str(form.__doc__).partition(",")[0]}
        parser.add_argument(option, type=argument(form), help=meaning, **many)
    arguments = parser.parse_args()
    faults = Faults()
    scene = scene_file.read(arguments.scene)
    sentence = check(arguments.results, scene, arguments.energy, arguments, faults)
    for fault in faults:
        print(fault, file=sys.stderr)
    if faults:
        sys.exit(1)
    print(f"{arguments.results}: {sentence}")


if __name__ == "__main__":
    told(main)
