"""Rows on the stiffness of the springs: from nothing to 1e18 E/h, and in one direction only."""

from typing import Any

import numpy as np

from ..msh import arc, even, rectangle
from ..references import case_3, case_9, references, round_off
from ..row import Curve, Trial, first_line, row
from ..scenes import elastic
from ..solutions import Patch, Strip

FLOOR = 1e-11  # round-off of `projected`, at every stiffness up to 1e16 E/h
EPS = np.finfo(float).eps


def numbers(t: Trial) -> Any:
    """K h/E."""
    return 10.0 ** np.arange(-2, 17, 3 if t.quick else 1)


@row(
    "B9",
    "K_N = K_T from 1e-10 to 1e18 E/h, and beyond what can be represented",
    "`projected`: round-off ≤ 1e-11 of u and t for K h/E = 1e-2 … 1e16 on cases 1, 1b, 3, 9; model error of slope −1, "
    "discretisation error flat in K; beyond: refused with the number",
)
def stiffness(t: Trial) -> None:
    curves: dict[str, list[Any]] = {}
    for name, patch in (("case 1", Patch(e=(1e4, 1e4), nu=(0.0, 0.0), snt=0.0, ett=0.0, theta=0.0, snn=-10.0)), ("case 1b", Patch())):
        for number in numbers(t):
            k = float(number) * min(patch.e) * 7
            patch.kn = patch.kt = k
            run = t.program.run(patch.loaded(), patch.meshes(7, 11, "Q4"))
            answered(t, curves, name, number, run, patch.errors if run.good else None)
    for name, stiff, text, meshes, precise in references(t, "projected"):
        for number in numbers(t):
            k = float(number) * stiff
            run = t.program.run(text(k), meshes)
            answered(t, curves, name, number, run, lambda run, k=k, precise=precise: round_off(run, *precise.solve(k)))
    for what, i in (("displacement", 0), ("traction", 1)):
        series = [(name, *zip(*((n, errors[i]) for n, errors in found), strict=True)) for name, found in curves.items() if found]
        t.curves.append(
            Curve(
                f"round_off_{what}",
                f"Round-off of the {what}, projected",
                "K h/E",
                "relative error",
                series,
                FLOOR,
            )
        )
    t.note(
        "Cases 9 and 3 are measured against the same discrete problem solved in 80-bit numbers by another route. Cases 1 and 1b "
        "are loaded by tractions: displacements prescribed on both sides of a joint's end are known to ε u, hence the traction "
        "there to ε K u, whoever solves it."
    )
    soft(t)
    beyond(t)
    floor_of_pointwise(t)
    model_error(t)
    discretisation(t)


def answered(t: Trial, curves: Any, name: str, number: Any, run: Any, errors: Any) -> None:
    """Up to 1e16 an answer below the floor is asked for."""
    found = curves.setdefault(name, [])
    if not run.good:
        t.holds(
            f"{name}, K h/E = {number:.0e}",
            False,
            f"exit {run.code}: {first_line(run.message)}",
            f"≤ {FLOOR:.0e}",
        )
        return
    u, traction = errors(run)
    t.below(f"{name}, K h/E = {number:.0e}: displacement", u, FLOOR)
    t.below(f"{name}, K h/E = {number:.0e}: traction", traction, FLOOR)
    found.append((number, (u, traction)))


def soft(t: Trial) -> None:
    for number in (1e-10, 1e-6):
        patch = Patch(snt=0.0)
        patch.kn = patch.kt = number * 4e3 * 7
        run = t.program.run(patch.scene(), patch.meshes(7, 11, "Q4")).need()
        u, traction = patch.errors(run)
        t.below(f"case 1b, K h/E = {number:.0e}: displacement", u, FLOOR)
        t.below(f"case 1b, K h/E = {number:.0e}: traction", traction, FLOOR)
    # a body that the joint alone holds is known to ε E/(K h)
    for number in (1e-4, 1e-8, 1e-10):
        patch = Patch()
        patch.kn = patch.kt = number * 4e3 * 7
        run = t.program.run(patch.loaded(), patch.meshes(7, 11, "Q4")).need()
        u, traction = patch.errors(run)
        t.below(f"on the joint alone, K h/E = {number:.0e}: displacement", u, FLOOR + 100 * EPS / number)
        t.below(f"on the joint alone, K h/E = {number:.0e}: traction", traction, FLOOR + 100 * EPS / number)
        (t.warned if number < 1e-6 else t.silent)(f"on the joint alone, K h/E = {number:.0e}", run, "W12")
    patch = Patch()
    patch.kn = patch.kt = 1e-14 * 4e3 * 7
    run = t.program.run(patch.loaded(), patch.meshes(7, 11, "Q4"))
    t.refused("on the joint alone, K h/E = 1e-14", run, "subdomain b", "can move freely")
    patch = Patch()
    text = patch.scene()
    text["interfaces"]["joint"]["law"] = elastic(0.0)
    text["steps"][0]["displace"] = {k: v for k, v in text["steps"][0]["displace"].items() if k.startswith("a")}
    t.refused(
        "K = 0 leaves a body free",
        t.program.run(text, patch.meshes(7, 11, "Q4")),
        "subdomain b",
        "can move freely",
    )


def beyond(t: Trial) -> None:
    """An answer of the same accuracy, or a refusal that says how stiff it is."""
    for k in (1e18 * 4e3 * 7, 1e150, 1e300, 1.7e308):
        patch = Patch()
        patch.kn = patch.kt = k
        run = t.program.run(patch.loaded(), patch.meshes(7, 11, "Q4"))
        if run.good:
            t.below(f"K = {k:.1e}: displacement", patch.errors(run)[0], FLOOR)
            t.below(f"K = {k:.1e}: traction", patch.errors(run)[1], FLOOR)
        else:
            t.refused(f"K = {k:.1e}", run, "normal_stiffness", "K_N h/E")


def floor_of_pointwise(t: Trial) -> None:
    series: dict[str, list[Any]] = {}
    for name, stiff, text, meshes, precise in references(t, "pointwise"):
        for number in numbers(t):
            k = float(number) * stiff
            run = t.program.run(text(k), meshes)
            if run.good:
                u, traction = round_off(run, *precise.solve(k))
                # case 9: floors of a plain solve, 0.07 ε K H/E of u and 6 ε K L/E of t; 10 for both is asked for
                limit = FLOOR + 10 * EPS * number * 12
                t.below(f"pointwise, {name}, K h/E = {number:.0e}: displacement", u, limit)
                t.below(f"pointwise, {name}, K h/E = {number:.0e}: traction", traction, limit)
                series.setdefault(name, []).append((number, u, traction))
            else:
                t.refused(f"pointwise, {name}, K h/E = {number:.0e}", run, "K_N h/E")
    lines = []
    for name, found in series.items():
        n, us, tractions = zip(*found, strict=True)
        lines += [(f"{name}: displacement", n, us), (f"{name}: traction", n, tractions)]
        t.note(f"Floor of `pointwise`, {name}: traction {tractions[-1]:.0e}, displacement {us[-1]:.0e} at K h/E = {n[-1]:.0e}.")
    t.curves.append(Curve("pointwise", "Round-off of pointwise", "K h/E", "relative error", lines))


def model_error(t: Trial) -> None:
    """Deflection of the top against that of a bond 1e9 E/H: exact solution and program, K/(E/H) = 1e1 … 1e6."""
    unit = 1e4 / 0.8
    exact_bond = Strip(kn=np.inf, kt=np.inf).solve()["q_top"]

    def top(k: float) -> Any:
        strip, meshes = case_9(k, (16, 24), (13, 14))
        run = t.program.run(strip.scene(), meshes).need()
        return run.displacement("b")[run.points("b")[:, 1] == 0.6].min()

    bond, numbers = top(1e9 * unit), [1e1, 1e2, 1e3, 1e4, 1e5, 1e6]
    exact = [Strip(kn=n * unit, kt=n * unit).solve()["q_top"] / exact_bond - 1 for n in numbers]
    got = [top(n * unit) / bond - 1 for n in numbers]
    slopes = np.diff(np.log10(got))
    t.within("model error: least slope", slopes.min(), -1.05, -0.95)
    t.within("model error: largest slope", slopes.max(), -1.05, -0.95)
    t.below("model error against the exact one", np.abs(np.array(got) / exact - 1).max(), 0.05)
    t.curves.append(
        Curve(
            "model",
            "Case 9: deflection against that of a perfect bond",
            "K H/E",
            "relative difference",
            [("program, T3 16:24", numbers, got), ("exact", numbers, exact)],
        )
    )


def discretisation(t: Trial) -> None:
    """Against the exact solution at the same stiffness."""
    numbers = [0.1, 1.0, 1e1, 1e2, 8e2, 1e4, 1e6, 1e8] if not t.quick else [1.0, 8e2, 1e6, 1e8]
    energy, traction = [], []
    for n in ((16, 24), (16, 17)):
        for coupling in ("projected", "pointwise"):
            found = []
            for number in numbers:
                strip, meshes = case_9(number * 1e4 * 16, n, (13, 14))
                run = t.program.run(strip.scene(coupling=coupling), meshes).need()
                found.append([abs(error) for error in strip.errors(run)])
                if coupling == "pointwise" and number > 1:
                    t.warned(f"pointwise {n[0]}:{n[1]}, K h/E = {number:g}", run, "W02")
            label = f"{n[0]}:{n[1]} {coupling}"
            energy.append((label, numbers, [e for e, _ in found]))
            traction.append((label, numbers, [e for _, e in found]))
            if coupling == "projected":
                t.below(f"{label}: traction at K h/E = 800", found[numbers.index(8e2)][1], 0.05)
                stiff = np.array([e for number, e in zip(numbers, found, strict=True) if number >= 8e2])
                spread = stiff.max(0) / stiff.min(0) - 1
                t.below(f"{label}: energy error, change over K h/E ≥ 800", spread[0], 0.01)
                t.below(f"{label}: traction error, change over K h/E ≥ 800", spread[1], 0.01)
    axis = "K h/E", "relative error"
    t.curves.append(Curve("traction", "Case 9, T3: discretisation error of the normal traction (L2)", *axis, traction))
    t.curves.append(Curve("energy", "Case 9, T3: discretisation error of the energy", *axis, energy))


@row(
    "B10",
    "K_T/K_N = 1e-12, 0, 1e12",
    "exact; K_T = 0 where the body is held otherwise; else named: refused where singular, warned of where only the polygon of an arc resists",
)
def one_direction(t: Trial) -> None:
    for ratio in (1e-12, 1e-6, 1e6, 1e12):
        for theta in (0.0, 30.0):
            patch = Patch(kt=2e5 * ratio, snt=0.0 if ratio < 1 else 2.5, theta=theta)
            # a body that next to nothing holds must be told where it is; a stiff joint must not
            text = patch.scene() if ratio < 1 else patch.loaded()
            what = f"case 1b, K_T/K_N = {ratio:g}, turned by {theta:g}°"
            run = t.program.run(text, patch.meshes(7, 11, "Q4"))
            if not run.good:
                t.holds(what, False, f"exit {run.code}: {first_line(run.message)}", "an answer")
                continue
            u, traction = patch.errors(run)
            t.below(f"{what}: displacement", u, 1e-10)
            # turned, a soft opening and a stiff slip share the components x and y of the jump: 10 ε K H/E, as case 1 has it
            limit = 1e-10 + (10 * EPS * max(patch.kn, patch.kt) * 1.2 / 4e3 if theta else 0.0)
            t.below(f"{what}: traction", traction, limit)
    patch = Patch(kt=0.0, snt=0.0)
    run = t.program.run(patch.scene(), patch.meshes(7, 11, "Q4")).need()
    t.below("case 1b, K_T = 0: displacement", patch.errors(run)[0], 1e-10)
    t.below("case 1b, K_T = 0: traction", patch.errors(run)[1], 1e-10)
    text, _ = case_3(2e4)
    text["interfaces"]["joint"]["law"] = elastic(2e4, 0.0)
    text["steps"][0]["load"] = {"b.top": {"pressure": 10.0}}
    halves = (("a", 14, (1.0, 1.5)), ("b", 20, (1.5, 2.0)))
    whole = {body: rectangle(even(0, 1, n), even(*r, 3), "Q4", arc(0.0, np.pi)) for body, n, r in halves}
    t.note(
        "Half a ring on a frictionless half ring was expected to be refused as singular. On meshes it is not: the bends between the "
        "edges of the joint resist a turn, by less the finer the mesh. So the program warns (W12) with body and motion."
    )
    # no exact singularity: bends between edges resist a turn by next to nothing, so the program warns
    run = t.program.run(text, whole)
    t.warned("half a ring on a frictionless half ring", run, "W12")
    t.holds("it names body and motion", "subdomain b is hardly held against a rotation about" in run.stderr)
    text["steps"][0]["fix"]["b.left"] = ["y"]
    run = t.program.run(text, whole).need()
    t.equal("held against rotation: shear traction", np.abs(run.traction()[:, 1]).max(), 0.0)
    text["interfaces"]["joint"]["law"] = elastic(2e4, 2e-8)
    run = t.program.run(text, whole).need()
    t.below("K_T/K_N = 1e-12: |shear| / pressure", np.abs(run.traction()[:, 1]).max() / 10, 1e-9)
