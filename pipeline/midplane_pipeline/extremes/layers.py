"""Layers on each other under pressure, ν = 0: every joint carries −p, whatever its meshes; and rings under pressure."""

from collections.abc import Iterable
from typing import Any

import numpy as np
from midplane.vtu import Array

from .msh import Mesh, even, rectangle
from .program import Run
from .row import Trial
from .scenes import elastic, scene

P, KN, YOUNG = 10.0, 1e6, 1e4
FIX = {"a.bottom": ["y"], "a.left": ["x"], "b.left": ["x"]}
REMOVED = object()  # in place of a value: the key is taken out


def pressed(bodies: Iterable[str], joints: dict[str, Any], fix: dict[str, Any], loaded: list[str], pressure: Any = P, **more: Any) -> dict[str, Any]:
    """Bodies with E = 1e4, ν = 0 under a pressure on some groups; every joint elastic, K = 1e6."""
    joints = {name: (a, b, elastic(KN)) for name, (a, b) in joints.items()}
    step = {"fix": fix, "load": {group: {"pressure": pressure} for group in loaded}}
    return scene({body: (YOUNG, 0.0) for body in bodies}, joints, [step], **more)


def two(t: Trial, a: Any, b: Any, fix: dict[str, Any] = FIX) -> Run:
    """Two bodies joined along a.top and b.bottom, under pressure."""
    text = pressed("ab", {"joint": ("a.top", "b.bottom")}, fix, ["b.top"])
    return t.program.run(text, {"a": a, "b": b})


def block(x: tuple[float, float], y: tuple[float, float], n: int, m: int = 2, shape: str = "Q4") -> Mesh:
    """A rectangle of n × m equal cells between two x and two y."""
    return rectangle(even(*x, n), even(*y, m), shape)


def off(run: Run, name: str = "joint") -> float:
    """Error of a joint's traction against uniform compression."""
    return np.abs(run.traction(name) - [-P, 0.0]).max() / P


def good() -> tuple[dict[str, Any], dict[str, Mesh]]:
    """A scene that runs, and its meshes."""
    return pressed("ab", {"joint": ("a.top", "b.bottom")}, FIX, ["b.top"]), {
        "a": block((0, 1), (-0.5, 0), 3),
        "b": block((0, 1), (0, 0.5), 5),
    }


def changed(path: str, value: Any) -> tuple[dict[str, Any], dict[str, Mesh]]:
    """The good scene with one value replaced; `path` with slashes."""
    text, meshes = good()
    place = text
    *way, last = path.split("/")
    for key in way:
        place = place[int(key)] if isinstance(place, list) else place[key]
    if value is REMOVED:
        del place[last]
    else:
        place[last] = value
    return text, meshes


def ring_under_pressure() -> dict[str, Any]:
    """A quarter of two rings, a inside b, under inner pressure."""
    step = {
        "fix": {**{f"{body}.left": ["x"] for body in "ab"}, **{f"{body}.right": ["y"] for body in "ab"}},
        "load": {"a.bottom": {"pressure": P}},
    }
    return scene({"a": (YOUNG, 0.2), "b": (YOUNG, 0.2)}, {"joint": ("a.top", "b.bottom", elastic(KN))}, [step])


def lame_rings(a: float = 1.0, b: float = 1.5, c: float = 2.0, nu: float = 0.2) -> float:
    """σ_rr at r = b of two rings under inner pressure, joined by springs."""
    lam, mu = YOUNG * nu / ((1 + nu) * (1 - 2 * nu)), YOUNG / (2 * (1 + nu))

    def stress(r: float) -> Array:
        return np.array([2 * (lam + mu), -2 * mu / r**2])

    matrix = np.zeros((4, 4))
    matrix[0, :2], matrix[1, 2:] = stress(a), stress(c)
    matrix[2, :2], matrix[2, 2:] = stress(b), -stress(b)
    matrix[3, :2], matrix[3, 2:] = -np.array([b, 1 / b]) - stress(b) / KN, (b, 1 / b)
    scale = np.array([YOUNG, YOUNG, YOUNG, 1.0])
    solution = np.linalg.solve(matrix / scale[:, None], np.array([-P, 0, 0, 0]) / scale)
    return float(stress(b) @ solution[:2])
