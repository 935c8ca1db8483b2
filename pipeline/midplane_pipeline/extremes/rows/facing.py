"""Rows on which side faces which: no common length, overlaps, gaps, arcs, directions, kinks."""

from typing import Any

import numpy as np

from ..layers import KN, P, block, lame_rings, off, pressed, ring_under_pressure, two
from ..msh import Mesh, arc, even, rectangle
from ..row import Trial, row
from ..scenes import relative
from ..solutions import Patch


@row("B22", "sides that touch at a point only, or not at all", "refused: no common length")
def touching(t: Trial) -> None:
    for x, text in (((1.0, 2.0), "touch at (1.000000, 0.000000)"), ((1.5, 2.5), "5.000e-1 apart")):
        run = two(t, block((0, 1), (-0.5, 0), 4), block(x, (0, 0.5), 3))
        t.refused(f"b from x = {x[0]}", run, "no common length", text)
    corner = rectangle(even(0, 1, 3), even(0, 0.5, 2), "Q4", lambda s, r: (1.0 + r, s))
    t.refused(
        "b stands on the corner, at a right angle",
        two(t, block((0, 1), (-0.5, 0), 4), corner),
        "interface joint",
    )


@row(
    "B23",
    "A longer than B: 0 … 1 on 0.3 … 1.7",
    "the common 0.7 is coupled and said; the rest is free of traction",
)
def partial(t: Trial) -> None:
    a, b = block((0.3, 1.7), (-0.5, 0), 9, 3), block((0, 1), (0, 0.5), 7, 3)
    run = two(t, a, b, fix={"a.bottom": ["x", "y"], "b.left": ["x"]}).need()
    t.below(
        "length of the joint: |L − 0.7| / 0.7",
        abs(run.summary()["sizes"]["interfaces"]["joint"]["length"] / 0.7 - 1),
        1e-14,
    )
    t.warned("partly joined", run, "W08")
    t.holds("both shares are said", "50.0000 % of side A" in run.stderr and "70.0000 % of side B" in run.stderr)
    joint = run.joint()
    total = (joint["length"].ravel() * joint["traction"][:, 0]).sum()
    t.below("resultant: all of the pressure", abs(total / -P - 1), 1e-10)
    place = joint["place"][:, 0]
    t.holds(
        "law points lie in 0.3 … 1",
        place.min() > 0.3 and place.max() < 1.0,
        f"{place.min():.3f} … {place.max():.3f}",
        "0.3 … 1",
    )


@row(
    "B24",
    "gap of 0.1 L, overlap of 0.1 L, small ones",
    "refused with size and place beyond 1e-3 L; within, no stress",
)
def apart(t: Trial) -> None:
    for gap, text in ((0.1, "gap of 1.000e-1"), (-0.1, "overlap of 1.000e-1"), (0.002, "gap of 2.000e-3")):
        t.refused(f"gap {gap:g}", two(t, block((0, 1), (-0.5, 0), 5), block((0, 1), (gap, 0.5), 8)), text, "near (")
    for gap in (9e-4, -9e-4):
        free = block((0, 1), (gap, 0.5), 8)
        run = two(t, block((0, 1), (-0.5, 0), 5), free).need()
        t.warned(f"gap {gap:g}", run, "W03")
        t.below(f"gap {gap:g}: traction is the pressure and nothing else", off(run), 1e-10)
        rest = pressed("ab", {"joint": ("a.top", "b.bottom")}, {"a.bottom": ["x", "y"]}, ["b.top"], 0.0)
        run = t.program.run(rest, {"a": block((0, 1), (-0.5, 0), 5), "b": free}).need()
        t.equal(f"gap {gap:g}, no load: traction", np.abs(run.traction()).max(), 0.0)


@row(
    "B25",
    "two polygons of one arc with different chords",
    "no load: tractions exactly 0; under pressure error falls with h²",
)
def arcs(t: Trial) -> None:
    def rings(n: Any, m: Any, rows: int = 3) -> dict[str, Any]:
        to = arc(np.pi / 2, np.pi / 2)
        a = rectangle(even(0, 1, n), even(1, 1.5, rows), "Q4", to)
        return {"a": a, "b": rectangle(even(0, 1, m), even(1.5, 2, rows), "Q4", to)}

    text = pressed("ab", {"joint": ("a.top", "b.bottom")}, {"a.bottom": ["x", "y"]}, ["b.top"], 0.0)
    run = t.program.run(text, rings(12, 17)).need()
    t.equal("no load: largest traction", np.abs(run.traction()).max(), 0.0)
    t.equal("no load: largest displacement", max(np.abs(run.displacement(body)).max() for body in "ab"), 0.0)
    # a small turn of everything: nothing may act
    small = {"x": "-0.01*y", "y": "0.01*x"}
    text["steps"] = [{"name": "turn", "displace": {"a.bottom": small, "b.top": small}}]
    run = t.program.run(text, rings(12, 17)).need()
    t.below("rigid rotation: traction / (K u)", np.abs(run.traction()).max() / (KN * 0.015), 1e-13)
    errors = []
    for i in (2, 4) if t.quick else (1, 2, 4, 8):
        joint = t.program.run(ring_under_pressure(), rings(12 * i, 17 * i, 3 * i)).need().joint()
        off = joint["traction"][:, 0] / lame_rings() - 1
        errors.append(np.sqrt(np.average(off**2, weights=joint["length"].ravel())))
    rates = np.log2(np.array(errors[:-1]) / errors[1:])
    t.within("under pressure: rate of the normal traction in L2", rates[-1], 1.8, 3.0)


@row("B29", "either or both curves reversed, A and B swapped, clockwise cells", "the same result to 1e-13")
def directions(t: Trial) -> None:
    patch = Patch()
    meshes = patch.meshes(7, 11, "Q4")
    base = t.program.run(patch.scene(), meshes).need()

    def changed(body: Any, curve: Any = None, clockwise: bool = False) -> Any:
        mesh = meshes[body]
        blocks = []
        for dimension, group, kind, nodes in mesh.blocks:
            if group == curve:
                nodes = nodes[::-1, ::-1]
            if dimension == 2 and clockwise:
                nodes = nodes[:, ::-1]
            blocks.append((dimension, group, kind, nodes))
        return Mesh(mesh.points, blocks)

    for what, some in {
        "curve of A reversed": {"a": changed("a", "top")},
        "curve of B reversed": {"b": changed("b", "bottom")},
        "both reversed": {"a": changed("a", "top"), "b": changed("b", "bottom")},
        "cells of A clockwise": {"a": changed("a", clockwise=True)},
        "cells of both clockwise": {body: changed(body, clockwise=True) for body in "ab"},
    }.items():
        run = t.program.run(patch.scene(), {**meshes, **some}).need()
        u = max(relative(run.displacement(body), base.displacement(body), 1e-3) for body in "ab")
        t.below(f"{what}: displacement", u, 1e-13)
        t.below(f"{what}: traction", relative(run.traction(), base.traction()), 1e-13)
    swapped = patch.scene()
    joint = swapped["interfaces"]["joint"]
    joint["side_a"], joint["side_b"] = joint["side_b"], joint["side_a"]
    run = t.program.run(swapped, meshes).need()
    # n turns round and so does the order of the points: (n, t) and the jump change sign twice
    t.below("A and B swapped: traction", relative(run.traction()[::-1], base.traction()), 1e-13)
    text = pressed("ab", {"joint": ("a.top", "b.bottom")}, {"a.bottom": ["x", "y"]}, ["b.top"])
    meshes = {
        "a": rectangle(even(0, 1, 12), even(1, 1.5, 3), "Q4", arc(2.0, 2.0)),
        "b": rectangle(even(0, 1, 17), even(1.5, 2, 3), "Q4", arc(2.0, 2.0)),
    }
    base = t.program.run(text, meshes).need()
    run = t.program.run(text, {"a": changed("a", "top", True), "b": changed("b", "bottom", True)}).need()
    t.below("case 3, all reversed: traction", relative(run.traction(), base.traction()), 1e-13)


@row(
    "B42",
    "kinks of 90°, 150° and 179.9° in a joint",
    "normals one-sided at the kink, forces balance to 1e-12 of the load",
)
def kinks(t: Trial) -> None:
    for inner in (90.0, 150.0, 179.9, -90.0):
        turn = np.radians(180 - abs(inner)) * np.sign(inner)

        def to(s: Any, r: Any, turn: Any = turn) -> tuple[Any, Any]:
            # a bent strip: beyond the mitre through the corner everything is turned by `turn`
            s, across = s - 1.0, r
            lean = np.tan(turn / 2)
            along = np.where(s <= 0, s - (1 + s) * r * lean, s + (1 - s) * r * lean)
            x = np.where(s <= 0, along, along * np.cos(turn) - across * np.sin(turn))
            y = np.where(s <= 0, across, along * np.sin(turn) + across * np.cos(turn))
            return x, y

        def strip(n: Any, r: Any) -> Any:
            s = np.concatenate([even(0, 1, n), even(1, 2, n + 2)[1:]])
            mesh = rectangle(s, r, "Q4", to)
            mesh.corners = [int(np.flatnonzero(np.abs(mesh.points).max(1) < 1e-12)[0])]
            return mesh

        a, b = strip(5, even(-0.3, 0, 2)), strip(8, even(0, 0.3, 2))
        text = pressed("ab", {"joint": ("a.top", "b.bottom")}, {"a.bottom": ["x", "y"]}, ["b.top"])
        run = t.program.run(text, {"a": a, "b": b}).need()
        joint = run.joint()
        place, normal = joint["place"], joint["normal"][:, :2]
        second = place @ [np.cos(turn / 2), np.sin(turn / 2)] > 0
        exact = np.where(second[:, None], [-np.sin(turn), np.cos(turn)], [0.0, 1.0])
        t.below(f"{inner:g}°: normals one-sided", np.abs(normal - exact).max(), 1e-12)
        balance = run.summary()["equilibrium"]
        tangent = np.stack([normal[:, 1], -normal[:, 0]], -1)
        traction = joint["traction"][:, :1] * normal + joint["traction"][:, 1:] * tangent
        across, load = joint["length"].ravel() @ traction, np.array(balance["subdomains"]["b"]["load"])
        t.below(f"{inner:g}°: tractions against load", np.abs(across - load).max() / np.abs(load).max(), 1e-12)
        t.below(f"{inner:g}°: loads and reactions", balance["imbalance"], 1e-12)
        t.below(f"{inner:g}°: |length − 2|", abs(np.diff(run.segments(), axis=1).sum() - 2), 1e-13)
