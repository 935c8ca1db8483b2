"""Rows on water in interfaces: pressures and flow at the ends of their numbers."""

from typing import Any

import numpy as np

from ..blocks import blocks
from ..row import Trial, row
from ..scenes import cohesive, coulomb, elastic, scene

JOINT = ("a.top", "b.bottom")


def joined(law: dict[str, Any], load: dict[str, Any], increments: int = 1, opening: Any = None, **more: Any) -> Any:
    """Two blocks on top of each other, the upper one driven or free to move up and down."""
    step = {"increments": increments, "fix": {"a": ["x", "y"] if opening else ["x"], "a.bottom": ["y"], "b": ["x"]}, "load": load}
    if opening:
        step["displace"] = {"b": {"y": opening}}
    probes = {"n": "joint.total_resultant_n", "q0": "joint.rate@0", "q1": "joint.rate@1", "uplift": "joint.uplift"}
    bodies = {"a": (1e4, 0.0), "b": (1e4, 0.0)}
    return scene(bodies, {"joint": (*JOINT, law)}, [step], output={"fields": "last", "history": probes}, **more)


def flow(aperture: Any, viscosity: Any, ends: Any, **more: Any) -> dict[str, Any]:
    return {"joint": {"pressure": {"flow": {"aperture": aperture, "viscosity": viscosity, "ends": ends, **more}}}}


@row(
    "B51",
    "flow: apertures from 1e-12 to 1e6, viscosities from 1e-15 to 1e12, a crack 1e9 times as wide as where it is closed",
    "pressures and rate of the closed form; one rate along the joint",
)
def flows(t: Trial) -> None:
    for aperture in (1e-12, 1e-3, 1e6):
        for viscosity in (1e-15, 1e-3, 1e12):
            run = t.program.run(joined(elastic(1.0), flow(aperture, viscosity, [3, -1]), opening="0"), blocks()).need()
            field = run.joint()
            name = f"w = {aperture:g}, μ = {viscosity:g}"
            t.below(f"{name}: p off the line, of 4", np.abs(field["pressure"] - (3 - 4 * run.points("joint")[:, 0])).max() / 4, 1e-9)
            q = 4 * aperture**3 / (12 * viscosity)
            row = run.history()
            t.below(f"{name}: |q/exact − 1|", abs(row["q0"][-1] / q - 1), 1e-9)
            t.below(f"{name}: |q1/q0 − 1|", abs(row["q1"][-1] / row["q0"][-1] - 1), 1e-12)
    for wide in (1.0, 1e3, 1e6, 1e9):
        a, b = 1e-9, wide * 1e-9
        run = t.program.run(joined(elastic(1.0), flow(a, 1e-3, [3, -1]), opening=f"{b - a!r}*x"), blocks()).need()
        whole = (1 / a**2 - 1 / b**2) / (2 * (b - a)) if wide > 1 else 1 / a**3
        # jumps are rounded, of the largest
        rounding = 4 * np.finfo(float).eps * b / a
        t.below(f"a wedge 1 : {wide:g}: |q/exact − 1|", abs(run.history()["q0"][-1] * 12e-3 * whole / 4 - 1), max(1e-8, rounding))
    for key, value in (("aperture", 0.0), ("aperture", -1e-3), ("viscosity", 0.0)):
        wrong = {"aperture": 1e-3, "viscosity": 1.0, key: value}
        run = t.program.run(joined(elastic(1.0), flow(wrong["aperture"], wrong["viscosity"], [1, 0]), opening="0"), blocks())
        t.refused(f"{key} = {value:g}", run, key)
    near = [{"at": 1e-9, "pressure": 1}, {"at": 0.5, "pressure": 2}, {"at": 1 - 1e-9, "pressure": 3}]
    run = t.program.run(joined(elastic(1.0), flow(1e-3, 1.0, ["wall", "wall"], drains=near), opening="0"), blocks()).need()
    t.below("drains beside walls: nothing flows in at the ends", np.abs([run.history()[q][-1] for q in ("q0", "q1")]).max(), 1e-20)


@row(
    "B52",
    "imposed pressures from 1e-12 to 1e12, steps for ramps, a pressure that lifts what lies on it",
    "total −P, effective p − P; steps are found; what nothing holds is told",
)
def pressures(t: Trial) -> None:
    for p in (1e-12, 1.0, 1e12):
        for law in (elastic(1e4), coulomb(1e4, 1e4, 0.5)):
            load: dict[str, Any] = {"b.top": {"pressure": 3 * p}, "joint": {"pressure": p}}
            run = t.program.run(joined(law, load), blocks()).need()
            t.below(f"{law['type']}, p = {p:g}: |t/(−2p) − 1|", np.abs(run.traction()[:, 0] / (-2 * p) - 1).max(), 1e-9)
            t.below(f"{law['type']}, p = {p:g}: |N/(−3p) − 1|", abs(run.history()["n"][-1] / (-3 * p) - 1), 1e-9)
    for ramp in ("ramp(opening, 0, 1e-3)", "ramp(opening, 1e-4, 1e-4)", "if(opening > 1e-4, 1, 0)", "ramp(opening, 1e-4, 1.0001e-4)"):
        load = {"b.top": {"pressure": -2.0}, "joint": {"pressure": f"{ramp}"}}
        run = t.program.run(joined(elastic(1e4), load, 4), blocks()).need()
        sigma, field = run.traction()[:, 0], run.joint()
        t.below(f"{ramp}: |t − p − 2|", np.abs(sigma - field["pressure"] - 2).max(), 1e-9)
    load = {"b.top": {"pressure": 1.0}, "joint": {"pressure": 2.0}}
    run = t.program.run(joined(coulomb(1e4, 1e4, 0.5), load, 2), blocks())
    t.refused("p above what lies on it", run, "no equilibrium", code=3)
    load = {"b.top": {"pressure": 1.0}, "joint": {"pressure": "0.9*damage"}}
    run = t.program.run(joined(cohesive(), load), blocks()).need()
    t.below("intact: p = 0", np.abs(run.joint()["pressure"]).max(), 1e-300)
