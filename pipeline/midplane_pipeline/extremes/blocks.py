"""Uniform scenes: two blocks that carry one state along their joint, and the paths of one law point.

 p p p p p
┌─┬──┬──┬─┐   b: every node is driven in x
├─┴─┬┴──┴─┤   joint
└───┴─────┘   a: every node is held in x, rollers below
"""

import numpy as np

from .msh import even, rectangle
from .scenes import scene

HEIGHT = 0.1


def blocks(edges=(3, 5), shape="Q4", width=1.0):
    """Bodies a and b."""
    a = rectangle(even(0, width, edges[0]), even(-HEIGHT, 0, 2), shape)
    return {"a": a, "b": rectangle(even(0, width, edges[1]), even(0, HEIGHT, 2), shape)}


def sheared(law, pressure, drives, increments=1, young=1e6, solution=None, **joint):
    """Pressure first, then b is driven to every displacement of `drives` in turn."""
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
        **({"solution": solution} if solution else {}),
    )


def pulled(law, end, increments=1, length=1.0, young=1e4, control="load", **more):
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


def way(*corners):
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


def peak(law, sigma):
    """Shear strength of the sound cracking law at a normal stress."""
    chi, c, tan = (law[key] for key in ("tensile_strength", "cohesion", "tan_friction"))
    # √((c − σ tan)² − (c − χ tan)²) without cancellation
    return np.sqrt((chi - sigma) * tan * (2 * c - (chi + sigma) * tan))
