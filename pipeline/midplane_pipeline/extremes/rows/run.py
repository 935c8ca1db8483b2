"""Rows on whole runs: units, huge steps, nothing at all, size, repetition."""

import hashlib
import os
from collections.abc import Iterator
from typing import Any

import numpy as np

from ..blocks import blocks, pulled, sheared, way
from ..layers import YOUNG, pressed, ring_under_pressure
from ..msh import even, rectangle
from ..references import case_3
from ..row import Curve, Trial, row
from ..scenes import coulomb, cracking, elastic, relative, scene
from ..solutions import Bending, Patch, Strip
from ..units import converted, converted_mesh

UNITS = {"Pa, m": (1.0, 1e6), "MPa, mm": (1e3, 1.0)}  # against MPa, m


def cases() -> Iterator[Any]:
    """Scenes of every kind, with their meshes."""
    strip = Strip()
    patch, bending = Patch(), Bending()
    bar = {"normal_stiffness": 1e6, "tangential_stiffness": 1e6}
    yield "case 1b", patch.scene(), patch.meshes(7, 11, "Q4")
    yield "case 2", bending.scene(), bending.meshes(3, 5, "Q8")
    yield "case 3", *case_3(2e4)
    yield "case 5b", strip.scene(), strip.meshes(8, 12, "T6", (4, 4))
    # to 2.5e-4 m: beyond, at 1/300 of the strength, rounding is of the size of the tolerance and may cost an iteration
    yield "case 7, path", *pulled(cracking(**bar), 2.5e-4, 10, control="auto")
    yield "case 8a", sheared(coulomb(1e6, 1e4, 0.6), 2.0, [3e-4, -3e-4, 3e-4], 5), blocks()
    yield "case 11", sheared(cracking(), 10.0, [2e-4], 20), blocks()
    yield "shear box, friction", *shear_box(coulomb(1e7, 1e7, 0.8785))
    yield "shear box, cracking", *shear_box(cracking())


def shear_box(law: dict[str, Any], edges: Any = (12, 8), increments: int = 10) -> tuple[Any, dict[str, Any]]:
    """Two layers under 10 MPa, the upper one pushed at its sides: slip comes in from both ends."""
    steps = [
        {
            "fix": {"a.bottom": ["x", "y"]},
            "displace": {"b.left": {"x": 0.0}, "b.right": {"x": 0.0}},
            "load": {"b.top": {"pressure": 10.0}},
        },
        {"increments": increments, "displace": {"b.left": {"x": 3e-4}, "b.right": {"x": 3e-4}}},
    ]
    text = scene({"a": (YOUNG, 0.2), "b": (YOUNG, 0.2)}, {"joint": ("a.top", "b.bottom", law)}, steps)
    text["output"] = {
        "fields": "step",
        "history": {"tau": "joint.resultant_t", "dissipated": "energy.dissipated"},
    }
    return text, {
        "a": rectangle(even(0, 1, edges[0]), even(-0.3, 0, 4), "Q4"),
        "b": rectangle(even(0, 1, edges[1]), even(0, 0.3, 3), "Q4"),
    }


def iterations(run: Any) -> Any:
    return run.history()["iterations"].astype(int).tolist()


@row(
    "B8",
    "every case in three unit systems: MPa·m, Pa·m, MPa·mm; powers of two from 2^-60 to 2^60",
    "the same after scaling: displacements to 1e-12, tractions to 1e-9, as many iterations; bit for bit with powers of two",
)
def unit_systems(t: Trial) -> None:
    for name, text, meshes in cases():
        base = t.program.run(text, meshes).need()
        for unit, (length, stress) in UNITS.items():
            run = in_units(t, text, meshes, length, stress)
            u = max(relative(run.displacement(b) / length, base.displacement(b), largest(base)) for b in "ab")
            t.below(f"{name}, {unit}: displacement", u, 1e-12)
            t.below(f"{name}, {unit}: traction", relative(run.traction() / stress, base.traction()), 1e-9)
            t.equal(f"{name}, {unit}: iterations", iterations(run), iterations(base))
        for length, stress in ((2.0**20, 2.0**-40), (2.0**-60, 2.0**60), (2.0**-60, 2.0**-60)):
            run = in_units(t, text, meshes, length, stress)
            same = all(np.array_equal(run.displacement(b) / length, base.displacement(b)) for b in "ab")
            same = same and np.array_equal(run.traction() / stress, base.traction())
            t.holds(f"{name}, lengths × {length:.0e}, stresses × {stress:.0e}: bit for bit", same)


def in_units(t: Trial, text: Any, meshes: Any, length: float, stress: float) -> Any:
    meshes = {body: converted_mesh(mesh, length) for body, mesh in meshes.items()}
    return t.program.run(converted(text, length, stress), meshes).need()


def largest(run: Any) -> Any:
    return max(np.abs(run.displacement(body)).max() for body in "ab")


@row(
    "B33",
    "whole failure in one step, and steps 1e6 × too far",
    "exact in one step, the far branch of a snap and friction alone included",
)
def huge_steps(t: Trial) -> None:
    step_size(t)
    run = t.program.run(sheared(coulomb(1e6, 1e4, 0.6), 2.0, [3e-4, -3e-4, 3e-4], 1), blocks()).need()
    exact = [0.0, 2.16e-4, 6.48e-4, 1.08e-3]
    t.below(
        "case 8a, one increment a leg: energy",
        np.abs(run.history()["dissipated"] - exact).max() / exact[-1],
        1e-9,
    )
    run = t.program.run(sheared(coulomb(1e6, 1e4, 0.6), 2.0, [3e2], 1), blocks()).need()
    t.below("case 8a, 1e6 × too far: τ", np.abs(run.traction()[:, 1] / 1.2 - 1).max(), 1e-10)
    bar = cracking(normal_stiffness=1e6, tangential_stiffness=1e6)
    # L = 0.05: stable, the exact path u = σ (L/E + 1/K_N) − (G_I/χ₀) ln(σ/χ₀)
    text, meshes = pulled(bar, 3e-4, 1, length=0.05)
    run = t.program.run(text, meshes).need()
    sigma = run.history()["sigma"][-1]
    u = sigma * (0.05 / 1e4 + 1e-6) - 2e-4 / 3 * np.log(sigma / 3)
    t.below("case 7, stable, in one increment: |u − u(σ)| / u", abs(u / 3e-4 - 1), 1e-3)
    run = t.program.run(*pulled(bar, 4e-4, 1)).need()
    sigma = run.history()["sigma"][-1]
    u = sigma * (1 / 1e4 + 1e-6) - 2e-4 / 3 * np.log(sigma / 3)
    t.below("case 7, snap-back, in one increment: |u − u(σ)| / u", abs(u / 4e-4 - 1), 1e-3)
    run = t.program.run(*pulled(bar, 4e2, 1)).need()
    t.below("case 7, 1e6 × too far: σ / χ₀", abs(run.history()["sigma"][-1]) / 3, 1e-6)
    run = t.program.run(sheared(cracking(), 10.0, [1e3], 1), blocks()).need()
    t.below("case 11, 1e6 × too far: τ", np.abs(run.traction()[:, 1] / 8.785 - 1).max(), 1e-6)
    text, meshes = shear_box(cracking(), increments=1)
    for group in ("b.left", "b.right"):
        text["steps"][1]["displace"][group]["x"] = 3e2
    run = t.program.run(text, meshes).need()
    field = run.joint()
    pushed = (field["length"].ravel() * field["traction"][:, 1]).sum()
    pressed = -(field["length"].ravel() * field["traction"][:, 0]).sum()
    t.below("shear box, 1e6 × too far: T / tan φ N", abs(pushed / (0.8785 * pressed) - 1), 1e-6)
    text, meshes = pulled(bar, 4e-4, 20, control="auto")
    run = t.program.run(text, meshes).need()
    history = run.history()
    sigma, cracked = history["sigma"], history["dissipated"] > 0
    path = sigma * (1 / 1e4 + 1e-6) - np.where(cracked, 2e-4 / 3 * np.log(sigma / 3), 0.0)
    t.below("case 7, path followed: |u − u(σ)| / u_peak", np.abs(history["u"] - path).max() / 3.03e-4, 1e-3)


def step_size(t: Trial) -> None:
    """Case 11 at σ = −10 to 1e-3 m: error against the step, by plain backward Euler and under error control."""
    exact, counts, program = 9.400468213, [1, 2, 5, 10, 20, 50, 100], []
    law = cracking()
    path = way(((("stress", -10.0), 0.0), 1), ((("stress", -10.0), 1e-3), 400))
    for count in counts:
        rows = t.program.law(law, path, "--substeps", str(count)).need().rows()
        program.append(abs(rows["traction_t"][-1] / exact - 1))
    steps = [1e-3 / (400 * count) for count in counts]
    orders = -np.diff(np.log(program)) / np.diff(np.log(counts))
    t.below("backward Euler, 400 steps: error", program[0], 1e-3)
    t.within("backward Euler: order in the step, over the last three", orders[-3:].mean(), 0.95, 1.2)
    increments = [1, 2, 5, 10, 20, 50]
    controlled: dict[str, Any] = {}
    for tolerance in (1e-4, 1e-6):
        for n in increments:
            run = t.program.run(sheared(law, 10.0, [1e-3], n, law_tolerance=tolerance), blocks()).need()
            error = np.abs(run.traction()[:, 1] / exact - 1).max()
            controlled.setdefault(f"error control {tolerance:g}", []).append(error)
            t.below(f"law_tolerance {tolerance:g}, {n} increments: error", error, tolerance)
    series = [("backward Euler, one point", steps, program)]
    series += [(label, [1e-3 / n for n in increments], errors) for label, errors in controlled.items()]
    t.curves.append(Curve("step", "Case 11, shear at −10 MPa to 1 mm", "step [m]", "relative error of τ", series))


@row(
    "B38",
    "a million dofs; 1e5 segments",
    "a joint is bound in linear time; that of 1e6 dofs in below 1 % of the run",
)
def large(t: Trial) -> None:
    for n in (120,) if t.quick else (120, 380):
        strip = Strip()
        meshes = strip.meshes(2 * n, 3 * n - 1, "Q4", (n, n // 2))
        run = t.program.run(strip.scene(), meshes, "--set", "output.fields=none").need()
        time, dofs = run.summary()["time"], run.summary()["sizes"]["dofs"]
        # relative error of the energy of linear elements: the square of h k, here π / 2n, to a factor of two
        error = abs(run.history()["stored"][-1] / strip.energy() - 1)
        t.below(f"{dofs} dofs: error of the energy", error, 2 * (np.pi / (2 * n)) ** 2)
        if n > 200:
            # the same bodies without the joint, the upper one held instead
            apart = {name: value for name, value in strip.scene().items() if name not in ("interfaces", "output")}
            apart["steps"][0]["fix"]["b.bottom"] = ["y"]
            options = (meshes, "--set", "output.fields=none")
            binding = [min(t.program.run(text, *options).need().summary()["time"]["bind"] for _ in range(2)) for text in (strip.scene(), apart)]
            share = max(binding[0] - binding[1], 0.0) / time["total"]
            t.below(f"{dofs} dofs: share of the joint, segments and operators", share, 0.01)
            t.note(f"{dofs} dofs: {time['total']:.1f} s; binding took {1e3 * binding[0]:.0f} ms, without the joint {1e3 * binding[1]:.0f} ms.")
    t.note("Joints of many segments are bound by `midplane check`, which does all but solve.")
    many, seconds = ([2500, 5000, 10000] if t.quick else [5000, 10000, 20000, 50000]), []
    for n in many:
        a = rectangle(even(0, 1, n), [-1 / n, 0.0], "Q4")
        b = rectangle(even(0, 1, n + n // 4), [0.0, 1 / n], "Q4")
        fix = {"a.bottom": ["x", "y"], "b.left": ["x"]}
        text = pressed("ab", {"joint": ("a.top", "b.bottom")}, fix, ["b.top"], output={"fields": "none"})
        run = t.program.run(text, {"a": a, "b": b}, command="check").need()
        seconds.append(run.seconds)
        row = next(line.split() for line in run.stdout.splitlines() if line.startswith("joint "))
        t.equal(f"{n}:{n + n // 4}, every fourth node common: segments", int(row[3]), 2 * n)
    growth = np.log(seconds[-1] / seconds[0]) / np.log(many[-1] / many[0])
    t.below("time of `midplane check` grows with the segments to the power", growth, 1.3)
    series = [("midplane check", 2 * np.array(many), seconds)]
    t.curves.append(Curve("size", "Reading and binding a joint of many segments", "segments", "seconds", series))


def files(run: Any) -> dict[str, Any]:
    """Checksums of the fields and the history."""
    names = [*sorted(run.out.glob("fields/*")), run.out / "history.csv", *sorted(run.out.glob("midplane/*"))]
    return {str(path.relative_to(run.out)): hashlib.sha256(path.read_bytes()).hexdigest() for path in names}


@row(
    "B39",
    "the same input twice; 1, 2 and 4 threads",
    "bit-equal with the same threads, 1e-12 between numbers of threads",
)
def repetition(t: Trial) -> None:
    for name, text, meshes in [*cases(), parts()]:
        if name == "in parts" and t.quick:
            continue
        first = {}
        for threads in (1, 2, 4):
            runs = [t.program.run(text, meshes, "--threads", str(threads)).need() for _ in range(2)]
            t.equal(f"{name}, {threads} threads, twice: files that differ", different(*map(files, runs)), [])
            first[threads] = runs[0]
        base = first[1]
        for threads in (2, 4):
            run = first[threads]
            u = max(relative(run.displacement(b), base.displacement(b), largest(base)) for b in "ab")
            t.below(f"{name}, {threads} against 1: displacement", u, 1e-12)
            t.below(f"{name}, {threads} against 1: traction", relative(run.traction(), base.traction()), 1e-12)
            t.equal(f"{name}, {threads} against 1: iterations", iterations(run), iterations(base))
    for variable in ("RAYON_NUM_THREADS",):
        text, meshes = shear_box(cracking())
        runs = [t.program.run(text, meshes, environment={variable: n}).need() for n in ("1", "3")]
        t.below(f"{variable} = 1 and 3: traction", relative(runs[0].traction(), runs[1].traction()), 1e-12)
    t.note(f"Measured on a machine of {os.cpu_count()} cores.")


def parts() -> tuple[str, Any, Any]:
    """Large enough to be factored in two parts side by side."""
    strip = Strip()
    return "in parts", strip.scene(), strip.meshes(160, 240, "Q4", (90, 60))


def different(one: Any, other: Any) -> list[Any]:
    return sorted(name for name in one.keys() | other.keys() if one.get(name) != other.get(name))


@row("B40", "no load, no displacement", "zeros exactly, one iteration at most, nothing divided by zero")
def nothing(t: Trial) -> None:
    laws = {"elastic": elastic(1e6), "coulomb": coulomb(1e6, 1e6, 0.5), "cracking": cracking()}
    for name, law in laws.items():
        for strategy in ("auto", "plain"):
            for control in ("load", "auto"):
                text, meshes = pulled(law, 0.0, 2, control=control, solution={"strategy": strategy})
                run = t.program.run(text, meshes).need()
                u = max(np.abs(run.displacement(body)).max() for body in "ab")
                what = f"{name}, {strategy}, control {control}"
                t.equal(f"{what}: largest u and t", (float(u), float(np.abs(run.traction()).max())), (0.0, 0.0))
                t.below(f"{what}: iterations", max(iterations(run)), 1)
                t.equal(f"{what}: energy balance", float(np.abs(run.history()["energy_balance"]).max()), 0.0)
    text = ring_under_pressure()
    text["steps"][0]["load"]["a.bottom"]["pressure"] = 0.0
    _, meshes = case_3()
    run = t.program.run(text, meshes).need()
    t.equal("rings: largest u and t", (float(largest(run)), float(np.abs(run.traction()).max())), (0.0, 0.0))
