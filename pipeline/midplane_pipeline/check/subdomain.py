"""The fields of a subdomain: arrays as the README promises them, stresses that belong together."""

from pathlib import Path
from typing import Any

import numpy as np
from midplane.vtu import Array

from midplane_pipeline.check.faults import Faults

# name -> components
SUBDOMAIN_POINTS = {"displacement": 3, "stress": 6, "von_mises": 1}
SUBDOMAIN_CELLS = {"stress": 6, "von_mises": 1, "principal_stress": 3}
ROUND_OFF = 1e-12  # of the quantity compared


def check_arrays(path: Path, place: str, data: Any, wanted: dict[str, int], faults: Faults) -> bool:
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


def check_subdomain(path: Path, grid: Any, name: str, scene: dict[str, Any], faults: Faults) -> None:
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

    def close(a: Array, b: Array) -> bool:
        return np.abs(a - b).max() <= ROUND_OFF * size

    faults.expect((first >= second).all(), f"{path}: principal_stress is not in order s1 >= s2")
    faults.expect(
        close(first + second, xx + yy) and close(first - second, np.hypot(xx - yy, 2 * xy)) and close(third, zz),
        f"{path}: principal_stress does not belong to stress",
    )
    faults.expect(not yz.any() and not xz.any(), f"{path}: stress yz or xz in a plane scene")
    # the distance of the principal stresses from their mean is that of von Mises
    deviator = np.stack([first, second, third]) - (first + second + third) / 3
    faults.expect(
        close(grid.cell_data["von_mises"], np.sqrt(1.5 * (deviator**2).sum(axis=0))),
        f"{path}: von_mises does not belong to stress",
    )


def has_stages(scene: dict[str, Any]) -> bool:
    """True if parts come or go."""
    return any(key in step for step in scene["steps"] for key in ("activate", "deactivate"))
