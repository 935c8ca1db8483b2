"""Rows on the other laws: the cohesive zone at the ends of its parameters, and joints that close on a hyperbola."""

import numpy as np

from ..blocks import blocks, pulled, sheared, way
from ..row import Trial, row
from ..scenes import closing, cohesive

KN, KT, FT, FS, GI, GII = 1e7, 1e7, 3.0, 5.0, 2e-4, 6e-4
BROKEN = 1e-3  # a slip beyond the final one, 2 G_II/f_s = 2.4e-4


@row(
    "B47",
    "`cohesive`: friction 0, 1e-12, 1, 10; strengths of 1e-12 and 0; energies at the least, huge, G_II < G_I",
    "exact peak, plateau, areas and friction; what snaps back at a point is refused with the least stiffness",
)
def cohesive_parameters(t: Trial) -> None:
    for mu in (0.0, 1e-12, 1.0, 10.0):
        path = way(((0.0, BROKEN), 100), ((-1e-6, BROKEN), 2), ((-1e-6, 2 * BROKEN), 20), ((-1e-6, -BROKEN), 40))
        rows = t.program.law(cohesive(friction_coefficient=mu), path).need().rows()
        for s, sign in ((3.0, 1), (4.0, -1)):
            tau = rows["traction_t"][rows["s"] == s][0]
            t.below(f"μ = {mu:g}, broken, under 10 MPa, s = {s:g}: |τ ∓ μ|σ||", abs(tau - sign * mu * 10.0), 1e-9)
    for strength in (1e-12, 1e-6):
        law = cohesive(tensile_strength=strength)
        rows = t.program.law(law, way(((strength / KN, 0.0), 4), ((1e-5, 0.0), 20))).need().rows()
        # 1 − D is a difference
        rounding = 4 * np.finfo(float).eps * KN * 1e-5 / strength
        t.below(f"f_t = {strength:g}: |peak/f_t − 1|", abs(rows["traction_n"].max() / strength - 1), max(1e-9, rounding))
    for key in ("tensile_strength", "shear_strength", "fracture_energy_i", "fracture_energy_ii"):
        t.refused(f"{key} = 0", t.program.law(cohesive(**{key: 0.0}), way(((1e-6, 0.0), 2))), key)
    # K_N > f²/(2 G) of the linear softening: G = 4.5e-7
    t.refused("G_I just too small", t.program.law(cohesive(fracture_energy_i=4.4e-7), way(((1e-6, 0.0), 2))), "do not fit each other", "normal_stiffness")
    rows = t.program.law(cohesive(fracture_energy_i=4.6e-7), way(((3e-7, 0.0), 3), ((4e-7, 0.0), 400))).need().rows()
    t.below("G_I just large enough: |peak/f_t − 1|", abs(rows["traction_n"].max() / FT - 1), 1e-9)
    t.holds("softens without a leap upwards", np.diff(rows["traction_n"][4:]).max() <= 0)
    for name, more, end in (("I", {}, (2e-4, 0.0)), ("II", {}, (0.0, 3e-4)), ("II below I", {"fracture_energy_ii": 5e-5}, (0.0, 3e-5))):
        law = cohesive(**more)
        rows = t.program.law(law, way((end, 4000))).need().rows()
        along = "n" if end[1] == 0.0 else "t"
        energy = law["fracture_energy_i" if along == "n" else "fracture_energy_ii"]
        area = np.trapezoid(rows[f"traction_{along}"], rows[f"jump_{along}"])
        t.below(f"area of mode {name}: |A/G − 1|", abs(area / energy - 1), 1e-4)
    tough = cohesive(fracture_energy_i=1e6, fracture_energy_ii=1e6)
    run = t.program.run(*pulled(tough, 1e-2, 20)).need()
    t.below("G = 1e6, a pulled bar: |σ/f_t − 1|", np.abs(run.traction()[:, 0] / FT - 1).max(), 1e-6)
    t.below("G = 1e6: iterations", run.history()["iterations"].max(), 8)


@row(
    "B48",
    "`cohesive`: unloading, reloading, reversal of shear, closing after opening",
    "secants through the origin, K_N closed; damage and dissipation never fall",
)
def cohesive_reversal(t: Trial) -> None:
    path = way(((8e-5, 0.0), 100), ((0.0, 0.0), 20), ((-1e-6, 0.0), 10), ((8e-5, 0.0), 50), ((2e-4, 0.0), 100))
    rows = t.program.law(cohesive(), path).need().rows()
    top = rows["traction_n"][rows["s"] == 1.0][0]
    apart = (rows["s"] > 1.0) & (rows["jump_n"] > 0) & (rows["jump_n"] <= 8e-5 * (1 - 1e-12))
    off = rows["traction_n"][apart] - top / 8e-5 * rows["jump_n"][apart]
    t.below("back and forth on one secant: |t − secant| / f_t", np.abs(off).max() / FT, 1e-12)
    closed = (rows["jump_n"] < 0) & (rows["s"] > 2.0)
    t.below("closed: |t/(K_N r) − 1|", np.abs(rows["traction_n"][closed] / (KN * rows["jump_n"][closed]) - 1).max(), 1e-12)
    t.holds("damage never falls", np.diff(rows["damage"]).min() >= 0)
    rows = t.program.law(cohesive(), way(((0.0, 1e-4), 100), ((0.0, -1e-4), 100))).need().rows()
    there = rows["s"] <= 1.0
    t.below(
        "reversal of shear: |τ(−r) + τ(r)| / f_s at the end",
        abs(rows["traction_t"][-1] + rows["traction_t"][there][-1]) / FS,
        1e-12,
    )
    law = cohesive(friction_coefficient=0.6)
    run = t.program.run(sheared(law, 10.0, [8e-5, -8e-5, 3e-4, -3e-4], 10), blocks()).need()
    t.holds("on a mesh: dissipation never falls", np.diff(run.history()["dissipated"]).min() >= -1e-15)
    # the bound of a step by its path_tolerance of 1e-3
    t.below("on a mesh: energy balance", abs(run.summary()["solution"]["energy_balance"]), 4.5e-3)


@row(
    "B49",
    "`closure`: K from 1e-3 to 1e12, V from 1e-9 to 1e6, pressures from 1e-6 to 1e6 K V",
    "the hyperbola σ = K u/(1 + u/V), at a point, on a mesh in one increment and back to nothing; V = 0 refused",
)
def closures(t: Trial) -> None:
    worst = 0.0
    for k in (1e-3, 1.0, 1e6, 1e12):
        for v in (1e-9, 1e-3, 1e6):
            for part in (1e-6, 1.0, 1e6):
                sigma = -part * k * v
                run = t.program.law(closing("elastic", k, v), way(((("stress", sigma), 0.0), 2)))
                rows = run.need().rows()
                worst = max(worst, abs(rows["jump_n"][-1] / (sigma / (k - sigma / v)) - 1))
    t.below("a point under stress: |u/exact − 1|", worst, 1e-9)
    for kind in ("elastic", "coulomb"):
        for v in (1e-9, 1e-5, 1e2):
            for part in (1e-3, 1.0, 1e3):
                pressure = part * 1e4 * v
                text = sheared(closing(kind, 1e4, v), pressure, [])
                text["steps"].append({"name": "off", "load": {"b.top": {"pressure": 0.0}}})
                run = t.program.run(text, blocks()).need()
                exact = -pressure / (1e4 + pressure / v)
                name = f"{kind}, V = {v:g}, p = {part:g} K V"
                traction = run.traction(number=1)[:, 0]
                t.below(f"{name}: |σ/p + 1|", np.abs(traction / pressure + 1).max(), 1e-9)
                jump = run.joint(number=1)["jump"][:, 0]
                t.below(f"{name}: |u/exact − 1|", np.abs(jump / exact - 1).max(), 1e-9)
                t.below(f"{name}: what is left without load, of p", np.abs(run.traction()[:, 0]).max() / pressure, 1e-9)
    for v in (0.0, -1e-3):
        run = t.program.law(closing("elastic", 1e4, v), way(((-1e-6, 0.0), 2)))
        t.refused(f"V = {v:g}", run, "closure.maximum")
    run = t.program.law(closing("elastic", 1e4, 1e-3), way(((-2e-3, 0.0), 4)))
    t.refused("u = −2 V", run, "maximum of 1e-3", code=3)


@row("B50", "`closure`: friction there and back at constant pressure", "case 8a: what rubs does not see the normal springs")
def closure_with_friction(t: Trial) -> None:
    for v in (1e-8, 1e-3):
        law = closing("coulomb", 1e6, v, tangential_stiffness=1e4, friction_coefficient=0.6)
        run = t.program.run(sheared(law, 2.0, [3e-4, -3e-4, 3e-4], 7), blocks()).need()
        dissipated = run.history()["dissipated"][[7, 14, 21]]
        t.below(f"V = {v:g}: dissipated energy", np.abs(dissipated - [2.16e-4, 6.48e-4, 1.08e-3]).max() / 1.08e-3, 1e-9)
        tau = run.traction()[:, 1]
        t.below(f"V = {v:g}: |τ/μp − 1|", np.abs(tau / 1.2 - 1).max(), 1e-9)
        # the way bends where slip begins within an increment
        t.below(f"V = {v:g}: energy balance", abs(run.summary()["solution"]["energy_balance"]), 1e-3)
