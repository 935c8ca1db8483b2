"""The two meshes, as every peer gets them."""

from pathlib import Path

import meshio
import numpy as np


def read(folder):
    """Points and quadrilaterals of the lower and of the upper layer."""
    layers = []
    for name in ("lower", "upper"):
        mesh = meshio.read(Path(folder) / f"{name}.msh", file_format="gmsh")
        layers.append((mesh.points[:, :2].copy(), mesh.cells_dict["quad"].astype(np.int64)))
    return layers
