"""Uniform scenes: two blocks that carry one state along their joint, and the paths of one law point.

 p p p p p
┌─┬──┬──┬─┐   b: every node is driven in x
├─┴─┬┴──┴─┤   joint
└───┴─────┘   a: every node is held in x, rollers below
"""

from collections.abc import Iterable
from typing import Any

import numpy as np

from .msh import Mesh, even, rectangle
from .scenes import scene

HEIGHT = 0.1


def blocks(edges: tuple[int, int] = (3, 5), shape: str = "Q4", width: float = 1.0) -> dict[str, Mesh]:
    """Bodies a and b."""
    a = rectangle(even(0, width, edges[0]), even(-HEIGHT, 0, 2), shape)
    return {"a": a, "b": rectangle(even(0, width, edges[1]), even(0, HEIGHT, 2), shape)}


def sheared(
    law: dict[str, Any], pressure: float, drives: Iterable[float], increments: int = 1, young: float = 1e6, solution: dict[str, Any] | None = None, **joint: Any
) -> dict[str, Any]:
    """Pressure first, then b is driven to every displacement of `drives` in turn."""
    more: dict[str, Any] = {"solution": solution} if solution else {}
    steps = [
        {
            "fix": {"a.bottom": ["y"], "a": ["x"]},
            "displace": {"b": {"x": 0.0}},
            "load": {"b.top": {"pressure": pressure}},
        }
    ]
    steps += [{"increments": increments, "displace": {"b": {"x": drive}}} for drive in drives]
    return scene(
        {"a": (young, 0.0), "b": (young, 0.0)},
        {"joint": ("a.top", "b.bottom", law, joint)},
        steps,
        output={
            "fields": "step",
            "history": {
                "dissipated": "energy.dissipated",
                "tau": "joint.traction_t@0.5",
                "jump": "joint.jump_t@0.5",
            },
        },
        **more,
    )


def pulled(
    law: dict[str, Any], end: float, increments: int = 1, length: float = 1.0, young: float = 1e4, control: str = "load", **more: Any
) -> tuple[dict[str, Any], dict[str, Mesh]]:
    """A bar of two bodies, ν = 0, its end pulled in y; everything is uniform."""
    step = {
        "increments": increments,
        "control": control,
        "fix": {"a.bottom": ["y"], "a.sw": ["x"], "b.nw": ["x"]},
        "displace": {"b.top": {"y": end}},
    }
    meshes = {
        "a": rectangle([0.0, 0.1], [-0.5 * length, 0.0], "Q4"),
        "b": rectangle([0.0, 0.1], [0.0, 0.5 * length], "Q4"),
    }
    probes = {"sigma": "joint.traction_n@0.5", "u": "b.top.displacement_y", "dissipated": "energy.dissipated"}
    bodies = {"a": (young, 0.0), "b": (young, 0.0)}
    history = {"fields": "last", "history": probes}
    return scene(bodies, {"joint": ("a.top", "b.bottom", law)}, [step], output=history, **more), meshes


def way(*corners: Any) -> list[dict[str, Any]]:
    """The program of a law point through corners ((n, t), points); n and t are displacements, or ("stress", value)."""
    program, before = [], [("displacement", 0.0), ("displacement", 0.0)]
    for corner, points in corners:
        now = [value if isinstance(value, tuple) else ("displacement", value) for value in corner]
        part = {}
        for name, (old_kind, old), (kind, value) in zip("nt", before, now, strict=True):
            part[name] = {"control": kind, "start": old if kind == old_kind else 0.0, "end": value}
        program.append({**part, "points": points})
        before = now
    return program


def peak(law: dict[str, Any], sigma: Any) -> Any:
    """Shear strength of the sound cracking law at a normal stress."""
    chi, c, tan = (law[key] for key in ("tensile_strength", "cohesion", "tan_friction"))
    # √((c − σ tan)² − (c − χ tan)²) without cancellation
    return np.sqrt((chi - sigma) * tan * (2 * c - (chi + sigma) * tan))
