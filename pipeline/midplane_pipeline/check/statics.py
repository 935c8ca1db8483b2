"""Do forces balance: loads, reactions and the tractions of the interfaces, integrated from the VTUs."""

from pathlib import Path
from typing import Any

import numpy as np
from midplane.vtu import Array

from midplane_pipeline.check.faults import Faults
from midplane_pipeline.results.entries import entry_of

STRAIGHT = 1e-9
BALANCE = 1e-10  # of the largest force; where the solution is iterated, no better than its own residual


def resultant(grid: Any, thickness: float) -> Array:
    """Force of side B on side A and its moment about the origin: the tractions summed over the law points."""
    normal = grid["normal"][:, :2]
    tangent = np.column_stack([normal[:, 1], -normal[:, 0]])
    traction = grid["traction"][:, :1] * normal + grid["traction"][:, 1:] * tangent
    force = thickness * grid["length"][:, None] * traction
    x, y = grid.points[:, :2].T
    return np.array([*force.sum(axis=0), x @ force[:, 1] - y @ force[:, 0]])


def is_straight(grid: Any) -> bool:
    """True if all normals are one: on a curve the law points lie beside the edges that carry their tractions."""
    return np.abs(grid["normal"] - grid["normal"][0]).max() < STRAIGHT


def summed(grid: Any, thickness: float) -> float:
    """The same by magnitude, with what water carries."""
    total = "traction_total" if "traction_total" in grid.array_names else "traction"
    return thickness * grid["length"] @ np.hypot(*grid[total].T)


def unseen(grid: Any, law: dict[str, Any], thickness: float) -> float:
    """A force of which rounding of the springs of a joint is as much as may be left: a crack that is wide open and almost free of stress
    has lost the digits of its tractions."""
    stated = [law.get(key) for key in ("normal_stiffness", "tangential_stiffness")]
    stiffness = max((value for value in stated if isinstance(value, (int, float))), default=0.0)
    return thickness * stiffness * np.finfo(float).eps / BALANCE * grid["length"] @ np.hypot(*grid["jump"].T)


def check_balance(
    results: Path | str, scene: dict[str, Any], summary: dict[str, Any], rows: list[dict[str, Any]], interfaces: dict[str, Any], faults: Faults
) -> tuple[float, float | None]:
    """Forces and moments on the whole model and on each subdomain sum to zero after the last of the rows, but for the residual it has and
    for the rounding of the largest reactions of all of them. Returns the largest error of either."""
    residual = rows[-1]["residual"] if rows else 0.0
    reactions = [abs(row[column]) for row in rows for column in row if column.startswith("reaction:")]
    allowed, equilibrium = max(BALANCE, residual), summary["equilibrium"]

    def acting(own: dict[str, Any]) -> list[Any]:
        return [np.array([*own[kind], own["moment"][k]]) for k, kind in enumerate(("load", "reaction"))]

    forces = {name: acting(own) for name, own in equilibrium["subdomains"].items()}
    # of a joint its tractions count, not their sum alone: that of a bent arm is a small part of what it carries
    thickness = scene.get("thickness", 1.0)
    joints = [summed(grid, thickness) for grid in interfaces.values()]
    joints += [unseen(grid, entry_of(scene, name)["law"], thickness) for name, grid in interfaces.items()]
    largest = np.abs([part[:2] for parts in forces.values() for part in parts])
    size = max(largest.max(initial=np.finfo(float).tiny), *joints, *reactions, 0.0)
    arm = max((np.abs(grid.points[:, :2]).max() for grid in interfaces.values()), default=1.0)
    sides = summary["sizes"]["interfaces"]
    curved = {subdomain for name, grid in interfaces.items() if not is_straight(grid) for subdomain in sides[name]["subdomains"]}

    def error(parts: list[Array], moments: bool = True) -> float:
        rest = np.abs(np.sum(parts, axis=0)) / [size, size, size * arm]
        return rest.max() if moments else rest[:2].max()

    whole = error(acting(equilibrium))
    faults.expect(whole <= allowed, f"{results}: loads and reactions leave {whole:.1e} of the largest force")
    for name, size_of in sides.items():
        if name not in interfaces:
            return whole, None  # not stored
        a, b = size_of["subdomains"]
        force = resultant(interfaces[name], scene.get("thickness", 1.0))
        forces[a].append(force)
        forces[b].append(-force)
    errors = {subdomain: error(parts, subdomain not in curved) for subdomain, parts in forces.items()}
    for subdomain, rest in errors.items():
        faults.expect(
            rest <= allowed,
            f"{results}: loads, reactions and interface tractions on {subdomain} leave {rest:.1e} of the largest force",
        )
    return whole, max(errors.values())
