"""Are the energies of history.csv right: their balance, and the work of loads and reactions, from its other columns.

The balance is work − stored − dissipated − released over the largest of the four so far. It is an error estimate: it
goes to zero with the scene's path_tolerance.

Work is that of reactions over displacements that the scene prescribes, and of loads over the mean displacements of
their groups where these are columns, by the trapezoidal rule over the rows. Increments are left out of the sum where
work is done that is not known so, as by formulas, body forces and groups that are let go, where a snap changes forces
between two rows, and where forces change so much while something cracks or slides that the rule says nothing. Groups
that share nodes and move in the same direction would count a reaction twice; the gallery has none.
"""

import contextlib
import io
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import meshio
import numpy as np
from midplane import scene_file
from midplane.vtu import Array, Vtu

from midplane_pipeline.check.faults import Faults

PROBES = ["work.external", "energy.stored", "energy.dissipated", "energy.released"]
ROUND_OFF = 1e-9  # of the quantity compared
TRAPEZOIDAL = 2e-3  # of the largest energy of the run: forces bend between two rows


def check_energies(
    path: Path | str, scene: dict[str, Any], results: Path, summary: dict[str, Any], rows: list[dict[str, Any]], allowed: float, faults: Faults
) -> str:
    """The balance as told, as it follows from the energies, and their work. Returns the words for the user."""
    for number, row in enumerate(rows, 1):
        left = row["energy_balance"]
        faults.expect(
            abs(left) <= allowed,
            f"{path}: row {number}, energies leave {left:.1e} of the largest, more than {allowed:g}",
        )
    said = f"energies to {max((abs(row['energy_balance']) for row in rows), default=0.0):.1e}"
    columns = {probe: name for name, probe in scene_file.probes(scene).items()}
    if not rows or any(probe not in columns for probe in PROBES):
        return said
    energies = np.array([[row[columns[probe]] for probe in PROBES] for row in rows])
    largest = np.maximum.accumulate(np.abs(energies).max(axis=1)).clip(min=np.finfo(float).tiny)
    lefts = (energies @ [1, -1, -1, -1]) / largest
    for number, (left, row) in enumerate(zip(lefts, rows, strict=True), 1):
        faults.expect(
            abs(left - row["energy_balance"]) <= ROUND_OFF,
            f"{path}: row {number}, energies leave {left:.6e} of the largest, not {row['energy_balance']:.6e}",
        )
    worst, known = check_work(path, scene, results, summary, rows, energies / largest[-1], largest[-1], faults)
    return f"{said}, work to {worst:.1e} in {known} increments" if known else said


def check_work(
    path: Path | str, scene: dict[str, Any], results: Path, summary: dict[str, Any], rows: list[dict[str, Any]], energies: Array, size: float, faults: Faults
) -> tuple[float, int]:
    """Work against the trapezoidal rule, both over `size`. Returns the largest difference, and of how many rows."""
    snaps = {snap["increment"] for snap in summary["solution"]["snaps"]}
    columns = {probe: name for name, probe in scene_file.probes(scene).items()}
    gains = np.diff(energies, axis=0, prepend=0.0)
    off, worst, known = 0.0, 0.0, 0
    for number, (gain, done) in enumerate(zip(gains, increases(scene, results, rows, columns), strict=True), 1):
        # a stretch that is too small to be told as a snap shows in what is released
        if done is None or number in snaps or gain[3] > ROUND_OFF:
            continue
        trapezoid, bend = np.array(done) / size
        if bend > TRAPEZOIDAL and gain[2] > ROUND_OFF:
            continue
        off, known = off + gain[0] - trapezoid, known + 1
        worst = max(worst, abs(off))
        faults.expect(
            abs(off) <= TRAPEZOIDAL,
            f"{path}: row {number}, work is off that of loads and reactions by {off:.1e} of the largest energy",
        )
    return worst, known


def increases(scene: dict[str, Any], results: Path, rows: list[dict[str, Any]], columns: dict[str, str]) -> Iterator[tuple[float, float] | None]:
    """Work of every increment by the trapezoidal rule, and half of change of force × way; none if it is not known."""
    before = start = dict.fromkeys(rows[0], 0.0)
    held: dict[tuple[str, str], Any] = {}
    loads: dict[str, Any] = {}
    for step in scene["steps"]:
        first = before is start
        ways, held = motions(step, held, before, columns, first)
        last, loads = loads, loads | given(step, scene, results)
        ramps = ramped(last, loads, columns)
        known = ways is not None and ramps is not None and not step.get("release")
        # initial tractions: reactions before the first row
        known &= not (first and any("initial_traction" in own for own in scene["interfaces"].values()))
        # forces that are held, stresses from before, and what warms a body, work too
        known &= not any(key in own for own in scene["steps"] for key in ("deactivate", "temperature", "strain"))
        known &= not any("initial_stress" in own for own in scene["subdomains"].values())
        level = 0.0
        for row in (row for row in rows if row["step"] == step["name"]):
            now = row["load_factor"]
            done = [(before[name], row[name], (now - level) * way) for name, way in (ways or {}).items()]
            done += [(a + (b - a) * level, a + (b - a) * now, row[name] - before[name]) for name, a, b in ramps or []]
            work = sum(0.5 * (f + g) * way for f, g, way in done)
            yield (work, sum(0.5 * abs((g - f) * way) for f, g, way in done)) if known else None
            before, level = row, now


def motions(
    step: dict[str, Any], held: dict[tuple[str, str], Any], before: dict[str, Any], columns: dict[str, str], first: bool
) -> tuple[dict[str, float] | None, dict[tuple[str, str], Any]]:
    """Way over a step by column of the reaction, none if one is not known; displacement at its end by group."""
    wanted = {(group, d): 0.0 for group, directions in step.get("fix", {}).items() for d in directions}
    wanted |= {(group, d): v for group, own in step.get("displace", {}).items() for d, v in own.items()}
    ways, known = {}, True
    for (group, direction), end in wanted.items():
        # a group that was free goes on from its mean
        mean = 0.0 if first else before.get(columns.get(f"{group}.displacement_{direction}", ""))
        start = held.get((group, direction), mean)
        if start is None or isinstance(start, str) or isinstance(end, str):
            known = False
        else:
            ways[f"reaction:{group}:{direction}"] = end - start
    released = {(group, d) for group, directions in step.get("release", {}).items() for d in directions}
    held = {place: value for place, value in (held | wanted).items() if place not in released}
    return ways if known else None, held


def given(step: dict[str, Any], scene: dict[str, Any], results: Path) -> dict[str, Any]:
    """Resultants (x, y) at the end of a step of the loads that it names; none for those that are not known."""
    loads = {group: resultant(group, load, scene, results) for group, load in step.get("load", {}).items()}
    return loads | {key: None for key in ("body_force", "gravity") if key in step}


def resultant(group: str, load: dict[str, Any], scene: dict[str, Any], results: Path) -> Array | None:
    """Resultant of a load; none if it has a formula, or if its group is not straight."""
    if any(isinstance(number, str) for value in load.values() for number in np.ravel(value).tolist()):
        return None
    if "force" in load:
        return np.array(load["force"])
    outward = area(group, scene, results)
    if outward is None:
        return None
    return -load["pressure"] * outward if "pressure" in load else np.hypot(*outward) * np.array(load["traction"])


def area(group: str, scene: dict[str, Any], results: Path) -> Array | None:
    """Outward normal of a group times its area, if the group is straight with all of its subdomain behind; else none."""
    subdomain, _, curve = group.partition(".")
    mesh = mesh_of(subdomain, results)
    if mesh is None or curve not in mesh.field_data:
        return None
    parts = zip(mesh.cells, mesh.cell_data["gmsh:physical"], strict=True)
    tag, dimension = mesh.field_data[curve]
    edges = [block.data[tags == tag, :2] for block, tags in parts if block.dim == dimension == 1]
    if not edges:
        return None
    ends = mesh.points[np.concatenate(edges), :2]
    along = ends[:, 1] - ends[:, 0]
    length = np.hypot(*along.T).sum()
    normal = np.array([along[0, 1], -along[0, 0]]) / np.hypot(*along[0])
    height = (mesh.points[:, :2] - ends[0, 0]) @ normal
    if height.max() > -height.min():
        normal, height = -normal, -height
    straight = max(height.max(), np.abs((ends - ends[0, 0]) @ normal).max()) <= ROUND_OFF * length
    return scene.get("thickness", 1.0) * length * normal if straight else None


def mesh_of(subdomain: str, results: Path) -> Any:
    """The mesh that the fields of a subdomain stand on; none if they are not stored."""
    fields = sorted(results.glob(f"fields/{subdomain}_*.vtu"))
    for path in sorted(results.glob(f"mesh/{subdomain}-*.msh")) if fields else []:
        with contextlib.redirect_stdout(io.StringIO()):  # the reader prints an empty line
            mesh = meshio.read(path)
        own, stored = (np.unique(grid.points, axis=0) for grid in (mesh, Vtu(fields[0])))
        if np.array_equal(own, stored):
            return mesh
    return None


def ramped(old: dict[str, Any], new: dict[str, Any], columns: dict[str, str]) -> list[tuple[str, float, float]] | None:
    """(Column of the displacement, force at the start of a step, at its end) of the loads; none if one is not known."""
    ramps = []
    for group, end in new.items():
        start = old.get(group, np.zeros(2))
        if start is None or end is None:
            return None
        size = np.abs([start, end]).max()
        for direction, a, b in zip("xy", start, end, strict=True):
            column = columns.get(f"{group}.displacement_{direction}")
            if column is not None:
                ramps.append((column, a, b))
            elif max(abs(a), abs(b)) > ROUND_OFF * size:
                return None
    return ramps
