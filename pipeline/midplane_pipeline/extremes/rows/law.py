"""Rows on the laws: friction from none to a lot, no strength, energies tiny and huge, reversal and closing."""

from typing import Any

import numpy as np

from ..blocks import blocks, peak, pulled, sheared, way
from ..msh import even, rectangle
from ..row import Trial, row
from ..scenes import coulomb, cracking, scene

COMPRESSED = ("stress", -10.0)


@row(
    "B13",
    "friction 0, 1e-12, 1, 10; friction angle 0 in the cracking law",
    "0 carries no shear, 10 sticks on every slope below 84.29°; tan φ = 0 is refused by the cracking law: no tensile limit",
)
def friction(t: Trial) -> None:
    t.note("The hyperbola at tan φ = 0 is a strip that no tension leaves: the cracking law refuses it, Coulomb's law is for μ = 0.")
    for mu in (0.0, 1e-12, 1.0, 10.0):
        run = t.program.run(sheared(coulomb(1e6, 1e4, mu), 2.0, [3e-4, -3e-4, 3e-4]), blocks()).need()
        for number, sign in ((2, 1), (3, -1)):
            # 3 MPa if it sticks, ± 2 μ if it slips; back by as much
            limit = sign * min(2.0 * mu, 3.0)
            tau = run.traction(number=number)[:, 1]
            t.below(f"μ = {mu:g}, step {number}: |τ − limit| / 2 MPa", np.abs(tau - limit).max() / 2, 1e-10)
    # a block on an incline: gravity turns, not the block; it slips where tan(slope) > μ
    for degrees, stands in ((45.0, True), (84.0, True), (84.5, False)):
        run = t.program.run(*incline(10.0, degrees))
        if stands:
            angle = np.radians(degrees)
            joint = run.need().joint()
            force = (joint["length"].ravel()[:, None] * joint["traction"]).sum(0)
            error = np.abs(force - [-0.02 * np.cos(angle), -0.02 * np.sin(angle)]).max() / 0.02
            t.below(f"μ = 10 on {degrees:g}°: resultant", error, 1e-9)
        else:
            t.refused(f"μ = 10 on {degrees:g}°: no equilibrium", run, "no equilibrium", code=3)
    t.refused(
        "cracking law, tan φ = 0",
        t.program.law(cracking(tan_friction=0.0), way(((1e-6, 0.0), 2))),
        "tan_friction",
    )
    for tan in (1e-12, 10.0):
        law = cracking(tan_friction=tan, cohesion=3.0 * max(tan, 1.0))
        run = t.program.law(law, way(((COMPRESSED, 0.0), 1), ((COMPRESSED, 2 * peak(law, -10) / 1e7), 2000))).need()
        # the path is stored in steps of a thousandth, and integrated to law_tolerance · c₀
        off, limit = (
            abs(run.rows()["traction_t"].max() - peak(law, -10)),
            1e-3 * peak(law, -10) + 1e-4 * law["cohesion"],
        )
        t.below(f"cracking law, tan φ = {tan:g}: error of the peak [MPa]", off, limit)
        before = run.rows()["jump_t"] < 0.999 * peak(law, -10) / 1e7
        elastic = run.rows()["traction_t"][before] - 1e7 * run.rows()["jump_t"][before]
        t.below(
            f"cracking law, tan φ = {tan:g}: elastic up to the peak",
            np.abs(elastic).max() / peak(law, -10),
            1e-9,
        )


def incline(mu: Any, degrees: Any) -> tuple[Any, dict[str, Any]]:
    """A flat block of weight 0.02 per thickness on a held base; both stiff."""
    angle = np.radians(degrees)
    law = coulomb(1e3, 1e3, mu)
    step = {"fix": {"a": ["x", "y"]}, "body_force": {"b": [-np.sin(angle), -np.cos(angle)]}}
    text = scene({"a": (1e7, 0.0), "b": (1e7, 0.0)}, {"joint": ("a.top", "b.bottom", law)}, [step])
    a = rectangle(even(0, 1, 7), even(-0.1, 0, 1), "Q4")
    return text, {"a": a, "b": rectangle(even(0, 1, 11), even(0, 0.02, 1), "Q4")}


@row(
    "B14",
    "no tensile strength",
    "tension carries nothing from the start: stress ≤ 1e-12 c₀; the vertex is the origin",
)
def no_tensile_strength(t: Trial) -> None:
    law = cracking(tensile_strength=0.0, fracture_energy_i=0.0)
    rows = t.program.law(law, way(((1e-5, 0.0), 5), ((2e-5, 1e-5), 5), ((3e-5, 1e-4), 5))).need().rows()
    t.below("opening: |t| / c₀", np.hypot(rows["traction_n"], rows["traction_t"]).max() / 4.0, 1e-12)
    run = t.program.run(*pulled(law, 1e-4, 4)).need()
    t.below("a pulled bar: |t| / c₀", np.abs(run.traction()).max() / 4.0, 1e-12)
    for chi in (1e-12, 1e-6):
        small = cracking(tensile_strength=chi)
        rows = t.program.law(small, way(((1e-4, 0.0), 20))).need().rows()
        t.below(f"χ₀ = {chi:g}: tensile stress over χ₀", rows["traction_n"].max() / chi, 1 + 1e-9)


@row("B15", "no strength at all", "Coulomb friction; nothing is divided by the gradient at the vertex")
def no_strength(t: Trial) -> None:
    zero = {"tensile_strength": 0.0, "cohesion": 0.0, "fracture_energy_i": 0.0, "fracture_energy_iia": 0.0}
    law = cracking(tangential_stiffness=1e4, normal_stiffness=1e6, tan_friction=0.6, **zero)
    run = t.program.run(sheared(law, 2.0, [3e-4, -3e-4, 3e-4]), blocks()).need()
    for number, tau in ((2, 1.2), (3, -1.2), (4, 1.2)):
        t.below(f"case 8a, step {number}: τ", np.abs(run.traction(number=number)[:, 1] / tau - 1).max(), 1e-10)
    exact = [0.0, 2.16e-4, 6.48e-4, 1.08e-3]
    t.below("case 8a: dissipated energy", np.abs(run.history()["dissipated"] - exact).max() / 1.08e-3, 1e-9)
    rows = t.program.law(law, way(((0.0, 1e-6), 3), ((1e-6, 1e-6), 3), ((0.0, 0.0), 3), ((-1e-6, 0.0), 3))).need().rows()
    at_vertex = np.abs(rows["traction_n"][:7]).max() + np.abs(rows["traction_t"][:7]).max()
    t.below("slip and opening from the vertex carry nothing", at_vertex, 0.0)


@row(
    "B16",
    "c₀ < χ₀ tan φ₀: the centre of the hyperbola beyond its vertex",
    "refused at input, with the numbers",
)
def vertex_outside(t: Trial) -> None:
    t.refused(
        "law",
        t.program.law(cracking(cohesion=2.0), way(((1e-6, 0.0), 2))),
        "cohesion",
        "do not fit each other",
        "2.6355",
    )
    text, meshes = pulled(cracking(cohesion=2.0), 1e-4)
    t.refused("run", t.program.run(text, meshes), "interfaces.joint.law.cohesion", "2.6355")
    cone = t.program.law(cracking(cohesion=3.0 * 0.8785), way(((5e-5, 5e-6), 20))).need().rows()
    t.holds("c₀ = χ₀ tan φ₀, a cone, is answered", np.isfinite(cone["traction_n"]).all())


@row("B17", "G_I so small that K_N G_I ≤ χ₀²", "refused, with the least admissible K_N")
def brittle(t: Trial) -> None:
    text, meshes = pulled(cracking(fracture_energy_i=8e-7), 1e-4)
    # χ₀²/G_I = 9 / 8e-7
    t.refused("K_N = 1e7", t.program.run(text, meshes), "normal_stiffness", "1.125e7", "do not fit each other")
    law = cracking(fracture_energy_i=8e-7, normal_stiffness=1.126e7)
    rows = t.program.law(law, way(((3 / 1.126e7, 0.0), 10), ((3e-6, 0.0), 300))).need().rows()
    t.below("just above: |peak / χ₀ − 1|", abs(rows["traction_n"].max() / 3 - 1), 1e-9)
    t.holds("just above: softens without a leap upwards", np.diff(rows["traction_n"][11:]).max() <= 0)
    soft = t.program.law(cracking(tangential_stiffness=5e4), way(((1e-6, 0.0), 2)))
    t.holds("K_T = 5e4: the law is driven", soft.good)
    text, meshes = pulled(cracking(tangential_stiffness=5e4), 1e-6)
    t.warned("K_T = 5e4 in a scene", t.program.run(text, meshes).need(), "W06")


@row(
    "B18",
    "G_I = 1e6 and G_IIa huge",
    "perfect plasticity, at most 5 iterations an increment, 8 in the one that is divided where it cracks",
)
def tough(t: Trial) -> None:
    law = cracking(fracture_energy_i=1e6, fracture_energy_iia=1e6)
    run = t.program.run(sheared(law, 10.0, [1e-3], 20), blocks()).need()
    tau = peak(law, -10.0)
    t.below("shear: |τ / plateau − 1|", np.abs(run.traction()[:, 1] / tau - 1).max(), 1e-6)
    t.below("shear: iterations", run.history()["iterations"].max(), 5)
    run = t.program.run(*pulled(law, 1e-2, 20)).need()
    t.below("tension: |σ / χ₀ − 1|", np.abs(run.traction()[:, 0] / 3.0 - 1).max(), 1e-6)
    first, *others = run.history()["iterations"]
    t.below("tension: iterations, where it cracks", first, 8)
    t.below("tension: iterations, beyond", max(others), 5)
    literal = cracking(fracture_energy_i=0.2, fracture_energy_iia=2.0)
    run = t.program.run(sheared(literal, 10.0, [1e-3], 20, law_tolerance=1e-6), blocks()).need()
    # case 11, the paper's energies read literally: closed form at u = 1e-3
    t.below(
        "case 11, literal: |τ(1e-3) / 12.699324 − 1|",
        np.abs(run.traction()[:, 1] / 12.69932364 - 1).max(),
        1e-6,
    )
    t.below("case 11, literal: iterations", run.history()["iterations"].max(), 5)


@row(
    "B19",
    "G_IIa < G_I: cohesion gone before the tensile strength",
    "refused where c < χ tan φ would come about; c ≥ χ tan φ all along any softening that is allowed",
)
def wrong_order(t: Trial) -> None:
    law = cracking(fracture_energy_i=2e-3, fracture_energy_iia=2e-4)
    t.refused("G_IIa = G_I / 10", t.program.law(law, way(((1e-6, 0.0), 2))), "fracture_energy_iia", "raise")
    equal = cracking(fracture_energy_iia=2e-4)
    for name, law in (("G_IIa = G_I", equal), ("G_IIa = 10 G_I", cracking())):
        for path in (way(((2e-4, 2e-4), 400)), way(((COMPRESSED, 0.0), 1), ((COMPRESSED, 1e-3), 400))):
            rows = t.program.law(law, path).need().rows()
            inside = rows["cohesion"] - rows["tensile_strength"] * rows["tan_friction"]
            t.holds(f"{name}: c − χ tan φ", inside.min() >= -4e-12, f"{inside.min():.1e}", "≥ −1e-12 c₀")


@row(
    "B20",
    "no dilatancy, σ = 0: the flow direction is discontinuous",
    "case 11 at 45°: σ falls to 0 and stays there",
)
def no_dilatancy(t: Trial) -> None:
    law = cracking(normal_stiffness=1e6, tangential_stiffness=1e6, tan_friction_residual=0.6)
    for tolerance in (1e-4, 1e-6):
        run = t.program.law(law, way(((1e-4, 1e-4), 1000)), "--tolerance", f"{tolerance:g}").need()
        rows = run.rows()
        stuck = rows["s"] > 0.2920
        t.below(
            f"tolerance {tolerance:g}: |σ| / χ₀ after it fell",
            np.abs(rows["traction_n"][stuck]).max() / 3,
            1e-6,
        )
        for f, exact in ((0.4, 2.562452155), (0.5, 2.153330201), (0.7, 1.264514196), (0.9, 0.3182020031)):
            tau = np.interp(f, rows["s"], rows["traction_t"])
            t.below(f"tolerance {tolerance:g}: τ({f})", abs(tau - exact) / 4.0, 3 * tolerance)
    # on a mesh: Newton must not cycle there
    steps = [{"fix": {"a": ["x"], "a.bottom": ["y"]}, "displace": {"b": {"x": 1e-4, "y": 1e-4}}, "increments": 50}]
    text = scene({"a": (1e9, 0.0), "b": (1e9, 0.0)}, {"joint": ("a.top", "b.bottom", law)}, steps)
    text["steps"][0]["fix"] = {"a": ["x", "y"]}
    run = t.program.run(text, blocks()).need()
    t.below("two driven blocks: iterations", run.history()["iterations"].max(), 8)
    t.below("two driven blocks: |σ| / χ₀ at the end", np.abs(run.traction()[:, 0]).max() / 3, 1e-6)


@row(
    "B21",
    "unloading, reloading, reversal of shear, closing after opening",
    "elastic slopes; work and dissipation never fall",
)
def reversal(t: Trial) -> None:
    there = way(
        ((COMPRESSED, 0.0), 2),
        ((COMPRESSED, 1e-4), 200),
        ((COMPRESSED, 9.95e-5), 5),
        ((COMPRESSED, 1.5e-4), 100),
        ((COMPRESSED, -1.5e-4), 600),
    )
    rows = t.program.law(cracking(), there).need().rows()
    back = (rows["s"] > 2.1) & (rows["s"] <= 3.0)
    slope = np.diff(rows["traction_t"][back]) / np.diff(rows["jump_t"][back])
    t.below("unloading in shear: |slope / K_T − 1|", np.abs(slope / 1e7 - 1).max(), 1e-6)
    t.holds("shear: work never falls", np.diff(rows["fracture_work"]).min() >= 0)
    t.holds(
        "reversal yields on the other side",
        rows["traction_t"].min() < -8.0,
        f"{rows['traction_t'].min():.3f}",
        "< −8",
    )
    run = t.program.law(cracking(), way(((8e-5, 0.0), 100), ((0.0, 0.0), 100), ((-1e-6, 0.0), 10), ((1.2e-4, 0.0), 100)))
    rows = run.need().rows()
    closed = (rows["s"] >= 2.0) & (rows["s"] <= 3.0)
    slope = np.diff(rows["traction_n"][closed]) / np.diff(rows["jump_n"][closed])
    t.below("closing after opening: |slope / K_N − 1|", np.abs(slope / 1e7 - 1).max(), 1e-6)
    t.holds("tension: work never falls", np.diff(rows["fracture_work"]).min() >= 0)
    law = coulomb(1e6, 1e4, 0.6)
    run = t.program.run(sheared(law, 2.0, [3e-4, -3e-4, 3e-4, 1e-4, 3e-4], 7), blocks()).need()
    t.holds("case 8a: dissipation never falls", np.diff(run.history()["dissipated"]).min() >= -1e-18)
    # 8a: first slip at 1.2e-4; dissipated up to +A, −A, +A
    dissipated = run.history()["dissipated"][[7, 14, 21]]
    t.below("case 8a: dissipated energy", np.abs(dissipated - [2.16e-4, 6.48e-4, 1.08e-3]).max() / 1.08e-3, 1e-9)
    # slip begins inside an increment: some 1e-4
    t.below("case 8a: energy balance", abs(run.summary()["solution"]["energy_balance"]), 1e-3)
    run = t.program.run(sheared(cracking(), 10.0, [2e-5, -2e-5, 4e-5], 10), blocks()).need()
    t.holds("cracking on a mesh: dissipation never falls", np.diff(run.history()["dissipated"]).min() >= -1e-15)
    # an error of the parts, not of rounding: some 3e-6
    t.below("cracking on a mesh: energy balance", abs(run.summary()["solution"]["energy_balance"]), 1e-5)
