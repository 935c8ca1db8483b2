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
import csv
import json
import sys
import xml.etree.ElementTree as ElementTree
from fnmatch import fnmatch
from pathlib import Path

import meshio
import numpy as np
import pyvista
from midplane import scene_file
from midplane.vtu import Vtu

from energies import check_energies
from joints import entry_of
from known import Every, Expected, Like, argument, rows_of
from statics import check_balance
from told import told

# name -> components
SUBDOMAIN_POINTS = {"displacement": 3, "stress": 6, "von_mises": 1}
SUBDOMAIN_CELLS = {"stress": 6, "von_mises": 1, "principal_stress": 3}
INTERFACE_POINTS = {
    "displacement": 3,
    "displacement_a": 3,
    "displacement_b": 3,
    "jump": 2,
    "jump_plastic": 2,
    "traction": 2,
    "status": 1,
    "condition": 1,
    "length": 1,
    "normal": 3,
}
WATER_POINTS = {"pressure": 1, "traction_total": 2}
FLOW_POINTS = {"rate": 1, "hydraulic_aperture": 1}
FIELD_DATA = ["TimeValue", "step", "load_factor", "energy_stored", "energy_dissipated", "energy_released", "work_external"]
MIDPLANE_POINTS = {"arc_length": 1}
MIDPLANE_CELLS = {"kind": 1, "edge_a": 1, "edge_b": 1}

HISTORY_COLUMNS = ["step", "increment", "load_factor", "iterations", "residual"]
ENERGY_BALANCE = 1e-8  # where geo/<scene>/check.args says nothing: work − stored − dissipated − released, of the largest of them so far
SUMMARY_KEYS = {"title", "sizes", "variables", "solution", "equilibrium", "time", "warnings"}
STATUSES = range(-1, 7)
ABSENT = -1  # a part of the interface is not there
CONDITIONS = range(-1, 6)
FREE = 5  # condition of faces that are apart and free of stress
OPEN, CLOSED, TIED = 4, 5, 6  # free of stress; the faces touch; open, but not free
LENGTH = 1e-9  # what the law points leave out of an interface
KINK = 0.5  # two cells of the grid that turn by more meet at a corner [rad]
ROUND_OFF = 1e-12  # of the quantity compared
GAP = 1e-9  # of the largest jump or irreversible jump: less is rounding
SEEN, FOLLOWED = 0.05, 0.1  # a jump that is so much of the displacements is in the mean that of the sides but for so much of it
NOTHING = 1e-9  # of the largest traction of an interface: less is rounding


class Faults(list):
    """The faults found so far; every check adds to it and goes on."""

    def expect(self, good, text):
        if not good:
            self.append(text)
        return good


def read_thrice(path, faults):
    """The file as pyvista reads it, after meshio and the reader of the package have agreed; None if it cannot be read."""
    try:
        other = meshio.read(path)
        grid = pyvista.read(path)
        ours = Vtu(path)
    except Exception as error:  # foreign readers, each with its own exceptions
        faults.append(f"{path}: cannot be read: {error}")
        return None
    meshio_cells = {name: np.concatenate(blocks) for name, blocks in other.cell_data.items()}
    corners = np.concatenate([block.data.ravel() for block in other.cells])
    sizes = np.array([block.data.shape[1] for block in other.cells for _ in block.data])
    cells = (ours.cells["connectivity"], np.diff(ours.cells["offsets"], prepend=0))
    agree(path, "meshio", (other.points, corners, sizes, other.point_data, meshio_cells), grid, faults)
    agree(path, "midplane", (ours.points, *cells, dict(ours.point_data), dict(ours.cell_data)), grid, faults)
    faults.expect(np.isfinite(grid.points).all(), f"{path}: a point is not finite")
    missing = [name for name in FIELD_DATA if grid.field_data.get(name) is None] if "fields" in path.parts else []
    faults.expect(not missing, f"{path}: no field data {missing}")
    return grid


def agree(path, reader, read, grid, faults):
    """What another reader has found, points, corners of cells, their numbers, arrays, is what VTK has."""
    points, corners, sizes, *arrays = read
    faults.expect(np.array_equal(points, grid.points), f"{path}: {reader} and VTK read different points")
    same = np.array_equal(corners, grid.cell_connectivity) and np.array_equal(sizes, np.diff(grid.cell_offsets))
    faults.expect(same, f"{path}: {reader} and VTK read different cells")
    for place, ours, theirs in zip(("point", "cell"), arrays, (grid.point_data, grid.cell_data), strict=True):
        names = sorted(ours), sorted(theirs.keys())
        if faults.expect(names[0] == names[1], f"{path}: {place} arrays differ, {reader} {names[0]}, VTK {names[1]}"):
            for name, values in ours.items():
                same = np.array_equal(values.ravel(), theirs[name].ravel(), equal_nan=True)
                faults.expect(same, f"{path}: {reader} and VTK read different {place} {name}")


def check_arrays(path, place, data, wanted, faults):
    """Exactly the wanted arrays, each with its components and finite. True if they can be used further."""
    good = faults.expect(
        set(data.keys()) == set(wanted),
        f"{path}: {place} arrays are {sorted(data.keys())}, should be {sorted(wanted)}",
    )
    for name, components in wanted.items():
        if name in set(data.keys()):
            values = data[name]
            found = 1 if values.ndim == 1 else values.shape[1]
            good &= faults.expect(
                found == components,
                f"{path}: {place} {name} has {found} components, should have {components}",
            )
            good &= faults.expect(np.isfinite(values).all(), f"{path}: {place} {name} is not finite")
    return good


def check_subdomain(path, grid, name, scene, faults):
    """Displacements and stresses of a subdomain, and what its scene gives it; the principal stresses belong to the stresses."""
    warms, strains = ({sub for step in scene["steps"] for sub in step.get(key, {})} for key in ("temperature", "strain"))
    points = SUBDOMAIN_POINTS | ({"temperature": 1} if name in warms else {})
    cells = SUBDOMAIN_CELLS | ({"own_strain": 6} if name in warms | strains else {})
    cells |= {"present": 1} if has_stages(scene) else {}
    good = check_arrays(path, "point", grid.point_data, points, faults)
    good &= check_arrays(path, "cell", grid.cell_data, cells, faults)
    if not good:
        return
    xx, yy, zz, xy, yz, xz = grid.cell_data["stress"].T
    first, second, third = grid.cell_data["principal_stress"].T
    size = max(np.abs(grid.cell_data["stress"]).max(), np.finfo(float).tiny)

    def close(a, b):
        return np.abs(a - b).max() <= ROUND_OFF * size

    faults.expect((first >= second).all(), f"{path}: principal_stress is not in order s1 >= s2")
    faults.expect(
        close(first + second, xx + yy)
        and close(first - second, np.hypot(xx - yy, 2 * xy))
        and close(third, zz),
        f"{path}: principal_stress does not belong to stress",
    )
    faults.expect(not yz.any() and not xz.any(), f"{path}: stress yz or xz in a plane scene")
    # the distance of the principal stresses from their mean is that of von Mises
    deviator = np.stack([first, second, third]) - (first + second + third) / 3
    faults.expect(
        close(grid.cell_data["von_mises"], np.sqrt(1.5 * (deviator**2).sum(axis=0))),
        f"{path}: von_mises does not belong to stress",
    )


def water_of(scene, name):
    """Pressures that steps give an interface, by its name, its entry or a pattern."""
    keys = (name, name.partition("~")[0])
    loads = [item for step in scene["steps"] for item in step.get("load", {}).items()]
    return [load["pressure"] for key, load in loads if "pressure" in load and "." not in key and (key in keys or fnmatch(name, key))]


def check_moves(path, grid, faults):
    """The sides move apart as the jump says, where it is no small part of what they move. Points of the law carry what the coupling makes
    of the sides, which on an interface of two segments is far from their own distance at a crack's end, but has the same mean."""
    normal = grid["normal"][:, :2]
    tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
    apart = (grid["displacement_b"] - grid["displacement_a"])[:, :2]
    own = np.column_stack([(apart * normal).sum(axis=1), (apart * tangent).sum(axis=1)])

    def mean(field):
        return grid["length"] @ np.linalg.norm(field, axis=1)

    jump = mean(grid["jump"])
    if jump > SEEN * max(mean(grid["displacement_a"]), mean(grid["displacement_b"])):
        lacking = np.linalg.norm(grid["length"] @ (own - grid["jump"]))
        faults.expect(lacking <= FOLLOWED * jump, f"{path}: the sides do not move apart by the jump")


def check_interface(path, grid, law, variables, water, moves, faults):
    """Law points in order along the mid-plane, with lengths, unit normals, known statuses and the variables of the laws, none of
    which is ever negative; where it `moves` from the start its sides move apart by the jump; with water its pressure is what the total traction lacks, and apertures are above those of closed faces."""
    flows = [pressure["flow"] for pressure in water if isinstance(pressure, dict)]
    wanted = INTERFACE_POINTS | dict.fromkeys(variables, 1) | (WATER_POINTS if water else {}) | (FLOW_POINTS if flows else {})
    good = check_arrays(path, "point", grid.point_data, wanted, faults)
    good &= check_arrays(path, "cell", grid.cell_data, {}, faults)
    if not good:
        return
    faults.expect((grid.celltypes == pyvista.CellType.LINE).all(), f"{path}: not only lines")
    faults.expect((grid["length"] > 0).all(), f"{path}: a law point has no length")
    faults.expect(np.isin(grid["status"], STATUSES).all(), f"{path}: status not in {STATUSES[0]} ... {STATUSES[-1]}")
    faults.expect(np.isin(grid["condition"], CONDITIONS).all(), f"{path}: condition not in {CONDITIONS[0]} ... {CONDITIONS[-1]}")
    sides = [grid[f"displacement_{side}"] for side in "ab"]
    size = max(np.abs(sides).max(), np.finfo(float).tiny)
    middle = np.abs(grid["displacement"] - 0.5 * (sides[0] + sides[1])).max() <= ROUND_OFF * size
    faults.expect(middle, f"{path}: displacement is not the mean of those of the sides")
    if moves:
        check_moves(path, grid, faults)
    absent = grid["status"] == ABSENT
    faults.expect(((grid["condition"] == ABSENT) == absent).all(), f"{path}: status and condition differ in what is there")
    # across a gap at the start the irreversible jump is that at which the faces meet
    free = (grid["jump"][:, 0] > np.minimum(grid["jump_plastic"][:, 0], 0)) & (grid["traction"] == 0).all(axis=1) & ~absent
    # springs, however soft, do not come apart
    free &= law["type"] != "elastic"
    faults.expect(((grid["condition"] == FREE) == free).all(), f"{path}: condition of what is open is wrong")
    faults.expect(not absent.any() or absent.all(), f"{path}: a part of it is not there")
    faults.expect(not grid["traction"][absent].any(), f"{path}: traction where a part is not there")
    if water:
        total = grid["traction"][:, 0] - grid["pressure"]
        size = max(np.abs(grid["traction"]).max(), np.abs(grid["pressure"]).max(), np.finfo(float).tiny)
        close = np.abs(grid["traction_total"] - np.column_stack([total, grid["traction"][:, 1]])).max() <= ROUND_OFF * size
        faults.expect(close, f"{path}: traction_total is not traction less the pressure")
    if flows and grid["hydraulic_aperture"].any():
        least = min(flow["aperture"] for flow in flows)
        faults.expect((grid["hydraulic_aperture"] >= least).all(), f"{path}: an aperture below that of closed faces")
    for name in variables:
        faults.expect((grid[name] >= 0).all(), f"{path}: {name} is negative")
    if law["type"] != "elastic":
        check_faces(path, grid, faults)
    lengths = np.linalg.norm(grid["normal"], axis=1)
    faults.expect(np.abs(lengths - 1).max() <= ROUND_OFF, f"{path}: a normal is not of unit length")


def check_faces(path, grid, faults):
    """Open faces carry no traction, closed ones no tension, and faces that are apart no compression. In every law but the
    elastic one these are apart where the normal jump is above its irreversible part."""
    status, traction = grid["status"], grid["traction"]
    sigma = traction[:, 0]
    gap = grid["jump"][:, 0] - grid["jump_plastic"][:, 0]
    nothing = NOTHING * np.abs(traction).max(initial=0.0)
    narrow = GAP * max(np.abs(grid[name]).max(initial=0.0) for name in ("jump", "jump_plastic"))

    def expect_none(wrong, text):
        faults.expect(not wrong.any(), f"{path}: {text} at {wrong.sum()} of {len(wrong)} law points")

    expect_none((status == OPEN) & (np.abs(traction) > nothing).any(axis=1), "traction across open faces")
    expect_none((status == OPEN) & (gap < -narrow), "open faces that overlap")
    expect_none((status == CLOSED) & (sigma > nothing), "tension across closed faces")
    expect_none((status == TIED) & (gap < -narrow), "tied faces that overlap")
    expect_none((gap > narrow) & (sigma < -nothing), "compression through a gap")


def has_stages(scene):
    """True if parts come or go."""
    return any(key in step for step in scene["steps"] for key in ("activate", "deactivate"))


def check_midplane(path, faults):
    """Segments (kind 0) with their parent edges, and cells of the grid (kind 1)."""
    grid = read_thrice(path, faults)
    if grid is None:
        return
    good = check_arrays(path, "point", grid.point_data, MIDPLANE_POINTS, faults)
    if not (check_arrays(path, "cell", grid.cell_data, MIDPLANE_CELLS, faults) and good):
        return
    if not faults.expect((grid.celltypes == pyvista.CellType.LINE).all(), f"{path}: not only lines"):
        return
    kind = grid["kind"]
    faults.expect(np.isin(kind, (0, 1)).all(), f"{path}: kind is neither 0 nor 1")
    ends = grid.points[grid.cell_connectivity.reshape(-1, 2)]
    length = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    total = length[kind == 0].sum()
    faults.expect((length > 0).all(), f"{path}: a cell has no length")
    # no equality: the chords of the grid cut the corners of a curved mid-plane, by as much as its direction turns in a cell
    covered = length[kind == 1].sum()
    faults.expect(covered <= total * (1 + 1e-9), f"{path}: the grid is longer than its segments")
    direction = ((ends[:, 1] - ends[:, 0]) / length[:, None])[kind == 1]
    turns = np.linalg.norm(direction[1:] - direction[:-1], axis=1)
    cut = 0.5 * turns[turns < KINK].max(initial=0.0) ** 2
    pointwise = not (kind == 1).any()
    faults.expect(pointwise or covered >= total * (1 - 1e-9 - cut), f"{path}: the grid is shorter than its segments")


def supports(scene):
    """Columns of the reactions: whatever a step fixes, moves or holds."""
    columns = set()
    for step in scene["steps"]:
        for key in ("fix", "displace", "hold"):
            for group, directions in step.get(key, {}).items():
                columns.update(f"reaction:{group}:{direction}" for direction in directions)
    return columns


def read_history(path, scene, faults):
    """The rows of history.csv, numbers as numbers."""
    with open(path, newline="") as file:
        reader = csv.DictReader(file)
        rows = list(reader)
        columns = reader.fieldnames or []
    probes = list(scene.get("output", {}).get("history", {}))
    wanted = HISTORY_COLUMNS + probes
    faults.expect(
        columns[: len(wanted)] == wanted, f"{path}: columns are {columns}, should begin with {wanted}"
    )
    reactions = supports(scene)
    faults.expect(
        set(columns[len(wanted) : -1]) == reactions,
        f"{path}: reactions are {columns[len(wanted) : -1]}, should be {sorted(reactions)}",
    )
    if not faults.expect(columns[-1:] == ["energy_balance"], f"{path}: the last column is no energy_balance"):
        return rows
    for number, row in enumerate(rows):
        for column in columns:
            if column == "step":
                continue
            try:
                row[column] = float(row[column])
            except (TypeError, ValueError):
                row[column] = np.nan
            faults.expect(np.isfinite(row[column]), f"{path}: row {number}, {column} is not a finite number")
    steps = [step["name"] for step in scene["steps"]]
    seen = list(dict.fromkeys(row.get("step") for row in rows))
    faults.expect(seen == steps[: len(seen)], f"{path}: steps are {seen}, the scene's are {steps}")
    numbers = [row["increment"] for row in rows]
    faults.expect(numbers == list(range(len(rows))), f"{path}: increments do not count from 0: {numbers}")
    faults.expect(rows and rows[0]["load_factor"] == 0, f"{path}: no row of the unloaded state")
    return rows


def collection(path, faults):
    """The files that the .pvd names, which must be all there are in fields/, and their times."""
    named, times, last = [], [], 0.0
    for dataset in ElementTree.parse(path).iter("DataSet"):
        named.append(dataset.get("file"))
        time = float(dataset.get("timestep"))
        # the number of the row, whatever the load does
        row = int(Path(named[-1]).stem.rpartition("_")[2])
        faults.expect(time == row and time >= last, f"{path}: time {time:g} at {named[-1]}")
        last = time
        times.append(row)
    present = {f"fields/{file.name}" for file in path.parent.glob("fields/*")}
    faults.expect(len(named) == len(set(named)), f"{path}: names a file twice")
    faults.expect(set(named) == present, f"{path}: names and files differ: {sorted(set(named) ^ present)}")
    return [path.parent / file for file in named if file in present], sorted(set(times))


def check(results, scene, energy, known, faults):
    """All checks of one results folder, and what is known of it. Returns the sentence for the user."""
    for name in ("history.csv", "summary.json"):
        if not faults.expect((results / name).is_file(), f"{results}: no {name}"):
            return ""
    collections = list(results.glob("*.pvd"))
    stored = scene.get("output", {}).get("fields", "every") != "none"
    if not faults.expect(
        len(collections) == stored, f"{results}: {len(collections)} .pvd files, not {int(stored)}"
    ):
        return ""
    summary = json.loads((results / "summary.json").read_text())
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
    interfaces, last = {}, 0
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


def check_known(results, rows, fields, known, faults):
    """What is known of the scene."""

    def others(name):
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


def main():
    parser = argparse.ArgumentParser(
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
        many = {"action": "append", "default": [], "metavar": form.__doc__.partition(",")[0]}
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
