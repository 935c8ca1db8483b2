"""Rows on joints that meet: T, X, and a slit inside one body."""

from typing import Any

import numpy as np

from ..layers import YOUNG, P, block, off, pressed
from ..msh import Mesh, even, rectangle
from ..row import Trial, row
from ..scenes import elastic, scene


@row(
    "B26",
    "T-junction: one long side against two blocks",
    "exact; both pairs integrated, no double count at the joint",
)
def t_junction(t: Trial) -> None:
    for shape in ("Q4", "T6"):
        meshes = {
            "a": block((0, 1), (-0.5, 0), 7, shape=shape),
            "b": block((0, 0.45), (0, 0.5), 5, shape=shape),
            "c": block((0.45, 1), (0, 0.5), 4, shape=shape),
        }
        fix = {"a.bottom": ["y"], "a.left": ["x"], "b.left": ["x"], "c.right": ["x"]}
        layouts: dict[str, dict[str, Any]] = {
            "one interface": {"joint": ("a.top", ["b.bottom", "c.bottom"])},
            "two interfaces": {"joint": ("a.top", "b.bottom"), "other": ("a.top", "c.bottom")},
        }
        for name, joints in layouts.items():
            run = t.program.run(pressed("abc", joints, fix, ["b.top", "c.top"]), meshes).need()
            t.below(f"{shape}, {name}: traction", max(off(run, joint) for joint in joints), 1e-11)
            length = sum(np.diff(run.segments(joint), axis=1).sum() for joint in joints)
            t.below(f"{shape}, {name}: |Σ segments − 1|", abs(length - 1), 1e-14)


@row(
    "B27",
    "X-junction: four blocks that meet at a point; pairs that share a node; secondary nodes that coincide",
    "constant stress is exact, the four copies of the node are independent",
)
def x_junction(t: Trial) -> None:
    sx, sy, k = -3.0, -7.0, 1e5
    edges = {
        "sw": ((0, 0.5), (0, 0.5), 3),
        "se": ((0.5, 1), (0, 0.5), 5),
        "nw": ((0, 0.5), (0.5, 1), 4),
        "ne": ((0.5, 1), (0.5, 1), 7),
    }
    for shape in ("Q4", "T6"):
        meshes = {name: rectangle(even(*x, n), even(*y, n), shape) for name, (x, y, n) in edges.items()}
        text = scene(
            {name: (YOUNG, 0.25) for name in edges},
            {},
            [
                {
                    "fix": {"sw.left": ["x"], "nw.left": ["x"], "sw.bottom": ["y"], "se.bottom": ["y"]},
                    "load": {
                        f"{name}.{side}": {"traction": value}
                        for name, side, value in (
                            ("se", "right", [sx, 0.0]),
                            ("ne", "right", [sx, 0.0]),
                            ("nw", "top", [0.0, sy]),
                            ("ne", "top", [0.0, sy]),
                        )
                    },
                }
            ],
        )
        text["interfaces"] = {"joints": {"between": ["*", "*"], "law": elastic(k)}}
        run = t.program.run(text, meshes).need()
        stress = max(np.abs(run.stress(name) - [sx, sy, 0.0]).max() for name in edges) / abs(sy)
        t.below(f"{shape}: stress", stress, 1e-9)
        found = sorted(path.stem for path in (run.out / "midplane").glob("joints*.vtu"))
        t.equal(f"{shape}: interfaces", len(found), 4)
        for name in found:
            upright = {place[1] for place in name.split("~")[1:]} == {"w", "e"}
            error = np.abs(run.traction(name) - [sx if upright else sy, 0.0]).max() / abs(sy)
            t.below(f"{shape}: traction of {name}", error, 1e-9)
        middle = [run.displacement(name)[np.abs(run.points(name) - 0.5).max(1) < 1e-9][0] for name in edges]
        # compatible: each joint opens by σ/K
        opening = (middle[1] - middle[0])[0]
        t.below(f"{shape}: opening at the point", abs(opening / (sx / k) - 1), 1e-9)
    # three bodies along one line: the end node of one joint is the start node of the next, on one side and on both
    meshes = {
        "a": block((0, 1), (-0.5, 0), 6),
        "b": block((0, 0.5), (0, 0.5), 3),
        "c": block((0.5, 1), (0, 0.5), 3),
    }
    fix = {"a.bottom": ["y"], "a.left": ["x"], "b.left": ["x"], "c.right": ["x"]}
    pairs: dict[str, dict[str, Any]] = {
        "pairs that share a node of A": {"joint": ("a.top", "b.bottom"), "other": ("a.top", "c.bottom")},
        "the shared node on side B": {"joint": ("b.bottom", "a.top"), "other": ("c.bottom", "a.top")},
        "with the joint between b and c": {
            "joint": ("a.top", "b.bottom"),
            "other": ("a.top", "c.bottom"),
            "third": ("b.right", "c.left"),
        },
    }
    for name, joints in pairs.items():
        run = t.program.run(pressed("abc", joints, fix, ["b.top", "c.top"]), meshes).need()
        t.below(f"{name}: traction", max(off(run, joint) for joint in ("joint", "other")), 1e-9)
        if "third" in joints:
            t.below(f"{name}: nothing acts across b and c", np.abs(run.traction("third")).max() / P, 1e-9)


@row(
    "B28",
    "self-interface: a slit inside one body, two curves of one surface",
    "allowed: closed by a stiff joint there is no slit",
)
def slit(t: Trial) -> None:
    mesh, whole = slit_mesh(6), slit_mesh(0)
    # the slit lies across a uniform compression; σ = −p with or without it
    step = {"fix": {"body.bottom": ["y"], "body.left": ["x"]}, "load": {"body.top": {"pressure": P}}}
    stiff = scene({"body": (YOUNG, 0.25)}, {"joint": ("body.lower", "body.upper", elastic(1e9))}, [step])
    none = scene({"body": (YOUNG, 0.25)}, {}, [step])
    run = t.program.run(stiff, {"body": mesh}).need()
    base = t.program.run(none, {"body": whole}).need()
    # the joint yields by p/K = 1e-8 m over a slit of 0.5 m: E p/K / 0.25 m is 4e-5 of p
    t.below("σ_yy of every cell", np.abs(run.stress("body")[:, 1] / -P - 1).max(), 1e-4)
    tops = [r.displacement("body")[r.points("body")[:, 1] == 0.5][:, 1].mean() for r in (run, base)]
    t.below("top against the body without a slit", abs(tops[0] / tops[1] - 1), 1e-5)
    t.refused(
        "one curve on both sides",
        t.program.run(
            scene({"body": (YOUNG, 0.25)}, {"joint": ("body.lower", "body.lower", elastic(1e9))}, [step]),
            {"body": mesh},
        ),
        "is on both sides",
    )


def slit_mesh(inside: Any, n: int = 12) -> Any:
    """A unit square, y from −0.5, its middle line doubled over `inside` of n edges; curves lower and upper on the slit."""
    x, first = even(0, 1, n), (n - inside) // 2
    low = rectangle(x, even(-0.5, 0, 4), "Q4", body="body")
    high = rectangle(x, even(0, 0.5, 4), "Q4", body="body")
    shift = len(low.points)
    # nodes of the upper half: those of the line outside the slit, and its tips, are those of the lower half
    number = np.arange(len(high.points)) + shift
    top, bottom = np.flatnonzero(low.points[:, 1] == 0), np.flatnonzero(high.points[:, 1] == 0)
    for i in range(n + 1):
        if not (inside and first < i < first + inside):
            number[bottom[i]] = top[i]
    points = np.concatenate([low.points, high.points])
    used = np.concatenate([np.arange(shift), number[number >= shift]])
    new = np.full(len(points), -1)
    new[np.unique(used)] = np.arange(len(np.unique(used)))
    blocks = []
    for dimension, group, kind, nodes in low.blocks:
        if group in ("bottom", "left", "body"):
            blocks.append((dimension, group, kind, new[nodes]))
    for dimension, group, kind, nodes in high.blocks:
        if group in ("top", "left", "body"):
            blocks.append((dimension, group, kind, new[number[nodes]]))
    if inside:
        curve = {group: nodes for _, group, _, nodes in low.blocks}["top"]
        middle = points[curve][:, :, 0].mean(1)
        on = np.sort(middle)[first : first + inside]
        blocks.append((1, "lower", "L2", new[curve[np.isin(middle, on)]]))
        curve = {group: nodes for _, group, _, nodes in high.blocks}["bottom"]
        middle = points[number[curve]][:, :, 0].mean(1)
        blocks.append((1, "upper", "L2", new[number[curve[np.isin(middle, on)]]]))
    merged: dict[Any, list[Any]] = {}
    for dimension, group, kind, nodes in blocks:
        merged.setdefault((dimension, group, kind), []).append(nodes)
    return Mesh(points[np.unique(used)], [(*key, np.concatenate(nodes)) for key, nodes in merged.items()])
