"""Scenes as dictionaries."""

from typing import Any

import numpy as np


def elastic(kn: Any, kt: Any = None) -> dict[str, Any]:
    """Springs."""
    return {"type": "elastic", "normal_stiffness": kn, "tangential_stiffness": kn if kt is None else kt}


def coulomb(kn: Any, kt: Any, mu: Any, **more: Any) -> dict[str, Any]:
    """Coulomb's law."""
    return {
        "type": "coulomb",
        "normal_stiffness": kn,
        "tangential_stiffness": kt,
        "friction_coefficient": mu,
        **more,
    }


def cracking(**more: Any) -> dict[str, Any]:
    """The law of the paper's Example 2, its energies read in N/mm."""
    law = {
        "type": "cracking",
        "normal_stiffness": 1e7,
        "tangential_stiffness": 1e7,
        "tensile_strength": 3.0,
        "cohesion": 4.0,
        "tan_friction": 0.8785,
        "fracture_energy_i": 2e-4,
        "fracture_energy_iia": 2e-3,
        "dilatancy_stress": 0.0,
    }
    return {**law, **more}


def cohesive(**more: Any) -> dict[str, Any]:
    """A cohesive zone of the strength and the energy of `cracking` in tension."""
    law = {
        "type": "cohesive",
        "normal_stiffness": 1e7,
        "tangential_stiffness": 1e7,
        "tensile_strength": 3.0,
        "shear_strength": 5.0,
        "fracture_energy_i": 2e-4,
        "fracture_energy_ii": 6e-4,
    }
    return {**law, **more}


def closing(kind: str, stiffness: float, maximum: float, **more: Any) -> dict[str, Any]:
    """An elastic or a Coulomb law with a closure."""
    law = {
        "type": kind,
        "closure": {"initial_stiffness": stiffness, "maximum": maximum},
        "tangential_stiffness": stiffness,
    }
    return {**law, **({"friction_coefficient": 0.5} if kind == "coulomb" else {}), **more}


def scene(materials: dict[str, Any], joints: dict[str, Any], steps: list[dict[str, Any]], plane: str = "strain", **more: Any) -> dict[str, Any]:
    """Bodies by name with (E, ν), joints by name with (side_a, side_b, law) and more keys, steps."""
    interfaces = {}
    for name, (a, b, law, *keys) in joints.items():
        interfaces[name] = {"side_a": a, "side_b": b, "law": law, **(keys[0] if keys else {})}
    return {
        "plane": plane,
        "subdomains": {body: {"msh": f"{body}.msh", "material": body} for body in materials},
        "materials": {body: {"young": e, "poisson": nu} for body, (e, nu) in materials.items()},
        "interfaces": interfaces,
        "steps": [{"name": f"step {i + 1}", **step} for i, step in enumerate(steps)],
        **more,
    }


def number(x: float) -> str:
    """A number inside a formula, every digit kept."""
    return f"({float(x)!r})"


def relative(got: Any, exact: Any, scale: float | None = None) -> float:
    """Largest error, of the largest exact value."""
    got, exact = np.asarray(got, float), np.asarray(exact, float)
    return np.abs(got - exact).max() / (np.abs(exact).max() if scale is None else scale)
