"""A VTU by three readers that know nothing of each other: meshio, VTK and the package midplane."""

from pathlib import Path
from typing import Any

import meshio
import numpy as np
import pyvista
from midplane.vtu import Vtu

from midplane_pipeline.check.faults import Faults

FIELD_DATA = ["TimeValue", "step", "load_factor", "energy_stored", "energy_dissipated", "energy_released", "work_external"]


def read_thrice(path: Path, faults: Faults) -> Any:
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


def agree(path: Path, reader: str, read: tuple[Any, ...], grid: Any, faults: Faults) -> None:
    """Points, corners of cells, their numbers and arrays of another reader are those of VTK."""
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
