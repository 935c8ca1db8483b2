"""An exact solution as pictures and checks take it, from the numbers of a scene and the sizes of its meshes."""

from dataclasses import dataclass, field
from typing import Any

import numpy as np
from midplane.vtu import Array

MANY = 4000  # points of a curve

Curve = tuple[Any, Any]  # places and values


@dataclass
class Exact:
    """Columns of the history as curves, tractions along the joint in the last increment, and what to point out."""

    history: dict[str, Array]  # column -> values
    traction: dict[str, Curve]  # "n" or "t" -> (distance along the joint, values)
    marks: list[tuple[dict[str, float], str]] = field(default_factory=list)  # (column -> value, text)
    levels: list[tuple[float, str]] = field(default_factory=list)  # bounds: (value of the ordinate, text)
    name: str = "exact"  # of the curve


def sizes(mesh: Any) -> tuple[float, float]:
    """Width and height of a body."""
    return np.ptp(mesh.points[:, 0]), np.ptp(mesh.points[:, 1])
