"""Rows on ends of joints: next to supports that hold both sides, and in a field that passes a T or an X."""

from typing import Any

import numpy as np
from midplane.vtu import Array

from ..layers import block
from ..row import Trial, row
from ..scenes import elastic, scene

E, NU = 1e4, 0.3
LIMITS = (("Q4", 0.03), ("T3", 0.08), ("Q8", 0.02), ("T6", 0.02))
PAIRS = ((24, 25), (16, 17), (22, 23), (31, 32), (23, 37), (36, 25))


@row(
    "B45",
    "a joint that ends on nodes held on both sides, edges n : n + 1 and others, K h/E from 1e2 to 1e9",
    "next to the clamp no normal traction but that of the field, the same at any stiffness",
)
def held_ends(t: Trial) -> None:
    for shape in ("Q4",) if t.quick else ("Q4", "Q8", "T6"):
        for pair in PAIRS[:2] if t.quick else PAIRS:
            found = [clamped(t, pair, k, shape) for k in (1e7, 1e10, 1e14)]
            name = f"{shape}, {pair[0]}:{pair[1]}"
            for first, beyond, _ in found:
                t.below(f"{name}: |t_n| in the first cell [MPa]", first, 0.3)
                t.below(f"{name}: |t_n| up to 0.3 m beyond it [MPa]", beyond, 0.1)
            t.below(f"{name}: change from 1e10 to 1e14", abs(found[1][2] / found[2][2] - 1), 0.01)


def clamped(t: Trial, pair: Any, k: float, shape: str) -> tuple[Any, Any, Array]:
    """Largest |t_n| next to the clamp of a cantilever of two layers: in the first cell, beyond; and largest |t|."""
    rows = [max(round(n / 4), 2) for n in pair]
    meshes = {
        "a": block((0, 2), (0, 0.5), pair[0], rows[0], shape),
        "b": block((0, 2), (0.5, 1), pair[1], rows[1], shape),
    }
    step = {
        "fix": {f"{body}.left": ["x", "y"] for body in "ab"},
        "load": {f"{body}.right": {"traction": [0.0, -1.0]} for body in "ab"},
    }
    text = scene({body: (E, NU) for body in "ab"}, {"joint": ("a.top", "b.bottom", elastic(k))}, [step])
    text["plane"] = "strain"
    run = t.program.run(text, meshes).need()
    x, traction = run.joint()["place"][:, 0], run.traction()
    first, near = 2 / min(pair), x < 0.3
    normal = np.abs(traction[:, 0])
    beyond = normal[near & (x > first)]
    return normal[x < first].max(), beyond.max(initial=0), np.linalg.norm(traction[near], axis=1).max()


@row(
    "B46",
    "a stress that varies past a T and an X, blocks of different meshes, K h/E = 1e5 and 1e8",
    "tractions next to the point follow the field, the same at any stiffness",
)
def field_past_junctions(t: Trial) -> None:
    c, x, y = (1 + NU) / E, "(x-0.4)", "(y-0.7)"
    # Airy x³y − xy³ from (0.4, 0.7): σ_xx = −6xy, σ_yy = 6xy, σ_xy = 3y² − 3x²
    u = {"x": f"{c}*({y}^3 - 3*{x}^2*{y})", "y": f"{c}*(3*{x}*{y}^2 - {x}^3)"}
    low: dict[str, Any] = {
        "sw": ((0, 1), (0, 1), (6, 5), ("left", "bottom")),
        "se": ((1, 2), (0, 1), (7, 8), ("right", "bottom")),
    }
    over: dict[str, dict[str, Any]] = {
        "X": {
            "nw": ((0, 1), (1, 2), (5, 9), ("left", "top")),
            "ne": ((1, 2), (1, 2), (8, 6), ("right", "top")),
        },
        "T": {"top": ((0, 2), (1, 2), (11, 9), ("left", "right", "top"))},
    }
    for kind, upper in over.items():
        blocks = {**low, **upper}
        for shape, limit in LIMITS[:2] if t.quick else LIMITS:
            meshes = {name: block(xs, ys, edges[0], edges[1], shape) for name, (xs, ys, edges, _) in blocks.items()}
            held = [f"{name}.{side}" for name, (*_, sides) in blocks.items() for side in sides]
            step = {"displace": {group: u for group in held}}
            text = scene({name: (E, NU) for name in blocks}, {}, [step])
            text["plane"] = "stress"
            errors = []
            for k in (1e10, 1e13):
                text["interfaces"] = {"joints": {"between": ["*", "*"], "law": elastic(k)}}
                run = t.program.run(text, meshes).need()
                joints = sorted(path.stem for path in (run.out / "midplane").glob("joints*.vtu"))
                errors.append(max(next_to_point(run, joint) for joint in joints))
            t.below(f"{kind}, {shape}: traction within 0.3 of the point, of the largest stress", errors[0], limit)
            t.below(f"{kind}, {shape}: change of that by stiffness", abs(errors[1] / errors[0] - 1), 0.02)


def next_to_point(run: Any, joint: Any) -> Any:
    """Largest error of a joint's traction within 0.3 of (1, 1), of 6 MPa, the largest stress there is."""
    at = run.joint(joint)
    points, found, normal = at["place"], at["traction"], at["normal"][:, :2]
    near = np.linalg.norm(points - 1, axis=1) < 0.3
    x, y = (points[near] - [0.4, 0.7]).T
    stress = np.array([[-6 * x * y, 3 * y**2 - 3 * x**2], [3 * y**2 - 3 * x**2, 6 * x * y]])
    n = normal[near].T
    t = np.array([n[1], -n[0]])  # n stands to the left of t
    force = np.einsum("ijp,jp->ip", stress, n)
    exact = np.stack([(force * n).sum(0), (force * t).sum(0)], axis=1)
    return np.linalg.norm(found[near] - exact, axis=1).max(initial=0) / 6
