"""The fields of an interface and its mid-plane: what law points carry, and what faces may do."""

from fnmatch import fnmatch
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from midplane.vtu import Array

from midplane_pipeline.check.faults import Faults

from .readers import read_thrice
from .subdomain import ROUND_OFF, check_arrays

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
MIDPLANE_POINTS = {"arc_length": 1}
MIDPLANE_CELLS = {"kind": 1, "edge_a": 1, "edge_b": 1}
STATUSES = range(-1, 7)
ABSENT = -1  # a part of the interface is not there
CONDITIONS = range(-1, 6)
FREE = 5  # condition of faces that are apart and free of stress
OPEN, CLOSED, TIED = 4, 5, 6  # free of stress; the faces touch; open, but not free
KINK = 0.5  # two cells of the grid that turn by more meet at a corner [rad]
GAP = 1e-9  # of the largest jump or irreversible jump: less is rounding
SEEN, FOLLOWED = 0.05, 0.1  # a jump that is so much of the displacements is in the mean that of the sides but for so much of it
NOTHING = 1e-9  # of the largest traction of an interface: less is rounding


def water_of(scene: dict[str, Any], name: str) -> list[Any]:
    """Pressures that steps give an interface, by its name, its entry or a pattern."""
    keys = (name, name.partition("~")[0])
    loads = [item for step in scene["steps"] for item in step.get("load", {}).items()]
    return [load["pressure"] for key, load in loads if "pressure" in load and "." not in key and (key in keys or fnmatch(name, key))]


def check_moves(path: Path, grid: Any, faults: Faults) -> None:
    """The sides move apart as the jump says, where it is no small part of what they move. Points of the law carry what the coupling makes
    of the sides, which on an interface of two segments is far from their own distance at a crack's end, but has the same mean."""
    normal = grid["normal"][:, :2]
    tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
    apart = (grid["displacement_b"] - grid["displacement_a"])[:, :2]
    own = np.column_stack([(apart * normal).sum(axis=1), (apart * tangent).sum(axis=1)])

    def mean(field: Array) -> float:
        return grid["length"] @ np.linalg.norm(field, axis=1)

    jump = mean(grid["jump"])
    if jump > SEEN * max(mean(grid["displacement_a"]), mean(grid["displacement_b"])):
        lacking = np.linalg.norm(grid["length"] @ (own - grid["jump"]))
        faults.expect(lacking <= FOLLOWED * jump, f"{path}: the sides do not move apart by the jump")


def check_interface(path: Path, grid: Any, law: dict[str, Any], variables: list[str], water: list[Any], moves: bool, faults: Faults) -> None:
    """Law points in order along the mid-plane, with lengths, unit normals, known statuses and the variables of the laws, none ever negative.

    Where it `moves` from the start its sides move apart by the jump; with water its pressure is what the total traction lacks, and apertures are above
    those of closed faces."""
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


def check_faces(path: Path, grid: Any, faults: Faults) -> None:
    """Open faces carry no traction, closed ones no tension, and faces that are apart no compression. In every law but the
    elastic one these are apart where the normal jump is above its irreversible part."""
    status, traction = grid["status"], grid["traction"]
    sigma = traction[:, 0]
    gap = grid["jump"][:, 0] - grid["jump_plastic"][:, 0]
    nothing = NOTHING * np.abs(traction).max(initial=0.0)
    narrow = GAP * max(np.abs(grid[name]).max(initial=0.0) for name in ("jump", "jump_plastic"))

    def expect_none(wrong: Array, text: str) -> None:
        faults.expect(not wrong.any(), f"{path}: {text} at {wrong.sum()} of {len(wrong)} law points")

    expect_none((status == OPEN) & (np.abs(traction) > nothing).any(axis=1), "traction across open faces")
    expect_none((status == OPEN) & (gap < -narrow), "open faces that overlap")
    expect_none((status == CLOSED) & (sigma > nothing), "tension across closed faces")
    expect_none((status == TIED) & (gap < -narrow), "tied faces that overlap")
    expect_none((gap > narrow) & (sigma < -nothing), "compression through a gap")


def check_midplane(path: Path, faults: Faults) -> None:
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
