"""A scene in other units: every number of it scaled by what it measures."""

import re
from typing import Any

from .msh import Mesh

# powers of (length, stress) of the numbers below a key
LAW = {
    "normal_stiffness": (-1, 1),
    "tangential_stiffness": (-1, 1),
    "tensile_strength": (0, 1),
    "cohesion": (0, 1),
    "fracture_energy_i": (1, 1),
    "fracture_energy_iia": (1, 1),
    "dilatancy_stress": (0, 1),
    "initial_gap": (1, 0),
}
KEYS = {"young": (0, 1), "pressure": (0, 1), "traction": (0, 1), "thickness": (1, 0), **LAW}


def converted(scene: dict[str, Any], length: float, stress: float) -> dict[str, Any]:
    """The scene with lengths and stresses in new units; its `force`s and body forces are not needed here."""

    def formula(text: str, factor: float) -> str:
        text = re.sub(r"\b([xy])\b", rf"(\1/{length!r})", text)
        return f"({text})*{factor!r}"

    def walk(value: Any, powers: tuple[int, int] | None) -> Any:
        if isinstance(value, dict):
            return {key: walk(item, powers_of(key, item, powers)) for key, item in value.items()}
        if isinstance(value, list):
            return [walk(item, powers) for item in value]
        if powers is None or isinstance(value, bool):
            return value
        factor = length ** powers[0] * stress ** powers[1]
        return formula(value, factor) if isinstance(value, str) else value * factor

    def powers_of(key: str, item: Any, powers: tuple[int, int] | None) -> tuple[int, int] | None:
        if key in ("x", "y") and not isinstance(item, (dict, list)):
            return (1, 0)  # a prescribed displacement
        return KEYS.get(key, None if powers is None else powers)

    return walk(scene, None)


def converted_mesh(mesh: Mesh, length: float) -> Mesh:
    """The mesh with lengths in a new unit."""
    return Mesh(mesh.points * length, mesh.blocks, mesh.corners)
