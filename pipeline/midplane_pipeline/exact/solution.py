"""An exact solution as pictures and checks take it, from the numbers of a scene and the sizes of its meshes."""

from dataclasses import dataclass, field

import numpy as np

MANY = 4000  # points of a curve


@dataclass
class Exact:
    """Columns of the history as curves, tractions along the joint in the last increment, and what to point out."""

    history: dict  # column -> values
    traction: dict  # "n" or "t" -> (distance along the joint, values)
    marks: list = field(default_factory=list)  # (column -> value, text)
    levels: list = field(default_factory=list)  # bounds: (value of the ordinate, text)
    name: str = "exact"  # of the curve


def sizes(mesh):
    """Width and height of a body."""
    return np.ptp(mesh.points[:, 0]), np.ptp(mesh.points[:, 1])
