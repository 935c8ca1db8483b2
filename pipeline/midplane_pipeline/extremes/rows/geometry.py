"""Rows on the mesh of a joint: ratios, offsets, tiny edges, sizes and places."""

from typing import Any

import numpy as np

from ..msh import even
from ..row import Curve, Trial, row
from ..scenes import relative
from ..solutions import Bending, Patch, Strip

EPS = np.finfo(float).eps
SHAPES = ("T3", "Q4", "T6", "Q8")


def try_patch(t: Trial, what: str, patch: Any, s_a: Any, s_b: Any, shape: str, limits: Any, **joint: Any) -> tuple[Any, Any]:
    """Runs a patch and claims both errors below their limits; the run and the errors."""
    run = t.program.run(patch.scene(**joint), patch.meshes(s_a, s_b, shape)).need()
    errors = patch.errors(run)
    t.below(f"{what}: displacement", errors[0], limits[0])
    t.below(f"{what}: traction", errors[1], limits[1])
    return run, errors


@row("B1", "mesh ratio 1:1000 and 2:2000", "exact patch; segments = edges of A + edges of B − common nodes")
def mesh_ratio(t: Trial) -> None:
    ratios = [1, 10, 100, 1000]
    u: list[float] = []
    tn: list[float] = []
    for m in ratios:
        for n, k in [(1, m), (m, 1), (7, m)]:
            run, errors = try_patch(t, f"case 1b, Q4, {n}:{k}", Patch(), n, k, "Q4", (1e-10, 1e-10))
            common = sum(1 for i in range(1, n) if i * k % n == 0)
            t.equal(f"segments of {n}:{k}", len(run.segments()), n + k - 1 - common)
            if k == m and n == 1 and len(u) < ratios.index(m) + 1:
                u.append(errors[0])
                tn.append(errors[1])
    t.curves.append(
        Curve(
            "ratio",
            "Case 1b, Q4: one edge against m",
            "m",
            "relative error",
            [("displacement", ratios, u), ("traction", ratios, tn)],
            1e-10,
        )
    )
    t.note(
        "Case 2 is asked for 1e-11 up to 2:500. At 2:2000, with cells 500 times higher than long, the numbers of an element "
        "differ by 500² and the line is 1e-10."
    )
    for shape in ("T6", "Q8"):
        for m, limit in ((200, 1e-11), (500, 1e-11)) if t.quick else ((500, 1e-11), (2000, 1e-10)):
            case = Bending()
            run = t.program.run(case.scene(), case.meshes(2, m, shape)).need()
            errors = case.errors(run)
            t.below(f"case 2, {shape}, 2:{m}: displacement", errors[0], limit)
            t.below(f"case 2, {shape}, 2:{m}: traction", errors[1], limit)
            t.equal(f"segments, {shape}, 2:{m}", len(run.segments()), m)


@row(
    "B2",
    "nodes offset by d L, d = 1e-3 … 1e-16",
    "exact at every d; segments add up to the joint; continuous in d",
)
def offset_nodes(t: Trial) -> None:
    ds = [1e-3, 1e-6, 1e-9, 1e-12, 1.1e-13, 0.9e-13, 1e-14, 1e-16]
    if not t.quick:
        ds = [10.0**-i for i in range(3, 17)] + [1.1e-13, 0.9e-13]
    u, tn, strip, steps = [], [], Strip(), []
    for d in sorted(ds, reverse=True):
        patch = Patch(theta=0.0)
        answers = []
        for factor in (1.0, 1.0 + 1e-3):
            s = even(-0.5, 0.5, 8)
            s[1:-1] += d * factor * np.where(np.arange(7) % 2 == 0, 1, -1)
            if factor == 1.0:
                run, errors = try_patch(t, f"d = {d:g}", patch, 8, s, "Q4", (1e-12, 1e-12))
                u.append(errors[0])
                tn.append(errors[1])
                pieces = run.segments()
                lengths = pieces[:, 1] - pieces[:, 0]
                t.below(f"d = {d:g}: |Σ segments − L| / L", abs(lengths.sum() - 1), 1e-14)
                t.holds(
                    f"d = {d:g}: every segment is longer than 0",
                    lengths.min() > 0,
                    f"{lengths.min():.1e}",
                    "> 0",
                )
            run = t.program.run(strip.scene(), strip.meshes(8, s + 0.5, "Q4", (6, 5))).need()
            answers.append(np.concatenate([run.displacement("a"), run.displacement("b")]))
        # du/dd is of the size of u/L, and 1e-12 is left for rounding
        steps.append(relative(answers[0], answers[1]))
        t.below(f"d and 1.001 d, d = {d:g}: change of case 5b", steps[-1], 1e-2 * d + 1e-12)
    x = sorted(ds, reverse=True)
    t.curves.append(
        Curve(
            "offset",
            "Case 1b, 8:8, every second node moved by ±d",
            "d / L",
            "relative error",
            [("displacement", x, u), ("traction", x, tn)],
            1e-12,
        )
    )


@row("B3", "two nodes of one side 1e-12 L apart", "accepted as far as coordinates resolve it, or refused")
def tiny_edge(t: Trial) -> None:
    for tiny in (1e-9, 1e-12):
        for shape in ("Q4", "T3"):
            s = np.insert(even(-0.5, 0.5, 4), 3, tiny)
            patch = Patch(theta=0.0)
            run = t.program.run(patch.scene(), patch.meshes(s, 7, shape))
            if run.good:
                # the edge is known to ε L, so is a strain in its cells
                limit = 10 * EPS / tiny
                errors = patch.errors(run)
                t.below(f"{shape}, {tiny:g} L: displacement", errors[0], limit)
                t.below(f"{shape}, {tiny:g} L: traction", errors[1], limit)
                t.warned(f"{shape}, {tiny:g} L", run, "W05") if shape == "T3" else None
            else:
                t.refused(f"{shape}, {tiny:g} L", run)


@row("B4", "one edge on one side, one on both", "exact")
def one_edge(t: Trial) -> None:
    for shape in SHAPES:
        for n in (1, 2):
            try_patch(t, f"case 1b, {shape}, 1:{n}", Patch(), 1, n, shape, (1e-12, 1e-12))
            try_patch(
                t,
                f"case 1, {shape}, 1:{n}",
                Patch(snt=0.0, ett=0.0, theta=0.0, e=(1e4, 1e4), nu=(0.0, 0.0)),
                1,
                n,
                shape,
                (1e-12, 1e-12),
            )
    for shape in ("T6", "Q8"):
        case = Bending()
        for n in (1, 2):
            run = t.program.run(case.scene(), case.meshes(1, n, shape)).need()
            t.below(f"case 2, {shape}, 1:{n}: displacement", case.errors(run)[0], 1e-12)
            t.below(f"case 2, {shape}, 1:{n}: traction", case.errors(run)[1], 1e-11)


@row("B5", "coordinates × 1e-6 and × 1e6", "exact: every tolerance is relative to the length of the joint")
def sizes(t: Trial) -> None:
    for size in (1e-6, 1e6):
        for shape in SHAPES:
            patch = Patch(size=size, kn=2e5 / size, kt=5e4 / size)
            try_patch(t, f"size {size:g}, {shape}, 5:8", patch, 5, 8, shape, (1e-12, 1e-12))


@row(
    "B6",
    "origin 1e3 and 1e6 m away, size 1 m; 1e6 m away, size 1e-3 m",
    "limited by the coordinates: ε offset/h; warned of from ε offset/h > 1e-10",
)
def far_away(t: Trial) -> None:
    offsets: list[float] = []
    u: list[float] = []
    tn: list[float] = []
    for offset, size in [(0.0, 1.0), (1e3, 1.0), (1e6, 1.0), (1e6, 1e-3)]:
        far(t, offset, size, offsets, u, tn)


@row("B7", "origin 1e9 m away, size 1 m", "limited by the coordinates, and warned of")
def very_far_away(t: Trial) -> None:
    offsets: list[float] = []
    u: list[float] = []
    tn: list[float] = []
    for offset in (1e0, 1e2, 1e4, 1e6, 1e8, 1e9):
        far(t, offset, 1.0, offsets, u, tn)
    line = [EPS * offset * 8 for offset in offsets]
    t.curves.append(
        Curve(
            "origin",
            "Case 1b, 5:8, at a distance from the origin",
            "offset / size",
            "relative error",
            [("displacement", offsets, u), ("traction", offsets, tn), ("ε offset/h", offsets, line)],
        )
    )


def far(t: Trial, offset: Any, size: float, offsets: Any, u: Any, tn: Any) -> None:
    """A patch at a distance; coordinates resolve ε offset of the smallest edge h = size/8."""
    resolved = EPS * offset * 8 / size
    patch = Patch(size=size, kn=2e5 / size, kt=5e4 / size, origin=(offset, 0.7 * offset))
    what = f"offset {offset:g}, size {size:g}"
    run, errors = try_patch(t, what, patch, 5, 8, "Q4", (1e-12 + resolved, 1e-12 + 10 * resolved))
    (t.warned if resolved > 1e-10 else t.silent)(what, run, "W04")
    offsets.append(offset / size)
    u.append(errors[0])
    tn.append(errors[1])
