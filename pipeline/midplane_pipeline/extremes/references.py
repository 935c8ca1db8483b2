"""Cases 9 and 3 beside their solution in extended precision."""

from collections.abc import Callable, Iterator
from typing import Any

import numpy as np
from midplane.vtu import Array

from .msh import Mesh, arc, even, rectangle
from .precise import WIDE, Precise, pressed
from .program import Run
from .row import Trial
from .scenes import elastic, scene
from .solutions import Strip


def case_9(k: float = 1.0, n: tuple[int, int] = (8, 12), rows: tuple[int, int] = (6, 7)) -> tuple[Strip, dict[str, Mesh]]:
    """Case 5b with one stiffness in both directions, on unmatched T3 meshes."""
    strip = Strip(kn=k, kt=k)
    return strip, strip.meshes(*n, "T3", rows)


def case_3(k: float = 1.0) -> tuple[dict[str, Any], dict[str, Mesh]]:
    """A quarter of two rings, Q4 7:10, under inner pressure and a shear on the outer edge (what a torque gives)."""
    to = arc(np.pi / 2, np.pi / 2)
    meshes = {
        "a": rectangle(even(0, 1, 7), even(1, 1.5, 3), "Q4", to),
        "b": rectangle(even(0, 1, 10), even(1.5, 2, 3), "Q4", to),
    }
    step = {
        "fix": {"a.bottom": ["x", "y"]},
        "load": {"b.top": {"pressure": "10 + 3*x*y"}},
    }
    text = scene({"a": (3e4, 0.2), "b": (1e4, 0.3)}, {"joint": ("a.top", "b.bottom", elastic(k))}, [step])
    return text, meshes


def held(meshes: dict[str, Mesh], supports: dict[tuple[str, str], list[int]]) -> Array:
    """True for dofs that are held: {(body, group): directions}."""
    first, found = 0, []
    for body, mesh in meshes.items():
        of_body = np.zeros((len(mesh.points), 2), bool)
        for (name, group), directions in supports.items():
            if name == body:
                for d in directions:
                    of_body[mesh.group(group), d] = True
        found.append(of_body.ravel())
        first += of_body.size
    return np.concatenate(found)


def nothing_on(mesh: Mesh) -> Array:
    """No forces on a body."""
    return np.zeros(2 * len(mesh.points), WIDE)


def references(t: Trial, coupling: str) -> Iterator[tuple[str, float, Callable[[float], dict[str, Any]], dict[str, Mesh], Precise]]:
    """Cases 9 and 3 with their solution in extended precision: name, E/h, scene of a stiffness, meshes, reference."""
    strip, meshes = case_9()
    sides = {(body, side): [0] for body in "ab" for side in ("left", "right")}
    force = np.concatenate(
        [
            nothing_on(meshes["a"]),
            pressed(meshes["b"], "top", lambda x, y: WIDE(5) * np.cos(WIDE(strip.k) * x)),
        ]
    )
    precise = Precise(
        t.program,
        strip.scene(coupling=coupling),
        meshes,
        {"a": (1e4, 0.2), "b": (4e3, 0.3)},
        force,
        held(meshes, {**sides, ("a", "bottom"): [0, 1]}),
    )
    yield "case 9, T3 8:12", 4e3 * 8, lambda k: Strip(kn=k, kt=k).scene(coupling=coupling), meshes, precise
    text, meshes = case_3()
    force = np.concatenate([nothing_on(meshes["a"]), pressed(meshes["b"], "top", lambda x, y: 10 + 3 * x * y)])
    text["interfaces"]["joint"]["coupling"] = coupling
    precise = Precise(
        t.program,
        text,
        meshes,
        {"a": (3e4, 0.2), "b": (1e4, 0.3)},
        force,
        held(meshes, {("a", "bottom"): [0, 1]}),
    )

    def ring(k: float) -> dict[str, Any]:
        text = case_3(k)[0]
        text["interfaces"]["joint"]["coupling"] = coupling
        return text

    yield "case 3, Q4 7:10", 1e4 / (2 * 1.5 * np.sin(np.pi / 28)), ring, meshes, precise


def round_off(run: Run, bodies: dict[str, Array], traction: Array) -> tuple[float, float]:
    """Relative errors of displacement and traction against the reference."""
    scale = max(float(np.abs(u).max()) for u in bodies.values())
    u = max(float(np.abs(run.displacement(body) - u).max()) for body, u in bodies.items()) / scale
    return u, float(np.abs(run.traction() - traction).max() / np.abs(traction).max())
