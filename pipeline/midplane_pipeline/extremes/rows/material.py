"""Rows on the materials: incompressible, negative ν, stiff on soft, thin layers and slender cells."""

from typing import Any

import numpy as np
from midplane.vtu import Array

from midplane_pipeline.exact.inclusion import disc

from ..msh import arc, even, rectangle
from ..row import Curve, Trial, row
from ..scenes import elastic, number, scene
from ..solutions import Patch, Strip, lame

NU = (0.3, 0.45, 0.49, 0.499, 0.4999)


@row(
    "B11",
    "ν = 0.3 … 0.4999, 0.5, −0.99",
    "T6 and Q8 do not lock (energy within 0.5 %); linear elements are warned of above 0.49; 0.5 refused in plane strain, fine in plane stress",
)
def poisson(t: Trial) -> None:
    series: dict[str, Any] = {}
    for shape, n in (("T3", 16), ("Q4", 16), ("T6", 8), ("Q8", 8)):
        for nu in NU:
            strip = Strip(nu=(nu, nu))
            run = t.program.run(strip.scene(), strip.meshes(n, 3 * n // 2, shape, (n, n))).need()
            ratio = strip.errors(run)[0] + 1
            series.setdefault(shape, []).append(abs(ratio - 1))
            if shape in ("T6", "Q8"):
                t.within(f"{shape}, ν = {nu}: energy / exact", ratio, 0.995, 1.005)
                t.silent(f"{shape}, ν = {nu}", run, "W11")
            elif nu > 0.49:
                t.warned(f"{shape}, ν = {nu}", run, "W11")
                if nu == NU[-1]:
                    t.note(f"{shape} at ν = {nu}: energy {ratio:.4f} of the exact one.")
            else:
                t.silent(f"{shape}, ν = {nu}", run, "W11")
    t.note("T3 on alternating diagonals does not lock here; meshes that are not so regular may, so it is warned of all the same.")
    distance = [0.5 - nu for nu in NU]
    t.curves.append(
        Curve(
            "poisson",
            "Case 5b towards incompressibility",
            "1/2 − ν",
            "error of the energy",
            [(shape, distance, errors) for shape, errors in series.items()],
            5e-3,
        )
    )
    half = Strip(nu=(0.5, 0.5))
    t.refused(
        "ν = 0.5, plane strain",
        t.program.run(half.scene(), half.meshes(4, 6, "Q8", (3, 3))),
        "poisson",
        "plane stress",
    )
    for nu, plane in ((0.5, "stress"), (-0.5, "strain"), (-0.99, "strain"), (-0.99, "stress")):
        strip = Strip(nu=(nu, nu), plane=plane)
        run = t.program.run(strip.scene(), strip.meshes(8, 12, "Q8", (8, 8))).need()
        t.within(f"Q8, ν = {nu}, plane {plane}: energy / exact", strip.errors(run)[0] + 1, 0.995, 1.005)
    for nu in (0.4999, 0.499999999, -0.99):
        patch = Patch(nu=(nu, nu), ett=3e-4 if nu < 0 else 0.0)
        run = t.program.run(patch.scene(), patch.meshes(7, 11, "Q8")).need()
        # ε times the ratio of bulk to shear stiffness
        stiff = max(1.0, 1 / (1 - 2 * nu), 1 / (1 + nu))
        t.below(f"case 1b, ν = {nu}: displacement", patch.errors(run)[0], 1e-12 * stiff)
        t.below(f"case 1b, ν = {nu}: traction", patch.errors(run)[1], 1e-12 * stiff)


def rings(
    e: tuple[float, float],
    torque: float = 20.0,
    pressure: float = 10.0,
    radii: Any = (1.0, 1.5, 2.0),
    nu: tuple[float, float] = (0.2, 0.3),
    k: tuple[float, float] = (2e4, 1e4),
) -> dict[str, Any]:
    """Case 3: amplitudes of two joined rings, inner edge held against rotation."""
    (a, b, c), layers = radii, [lame(e[i], nu[i]) for i in (0, 1)]

    def stress(i: Any, r: Any) -> Array:
        lam, mu = layers[i]
        return np.array([2 * (lam + mu), -2 * mu / r**2])

    matrix, right = np.zeros((4, 4)), np.zeros(4)
    matrix[0, :2], right[0] = stress(0, a) / e[0], -pressure / e[0]
    matrix[1, 2:] = stress(1, c) / e[1]
    matrix[2, :2], matrix[2, 2:] = stress(0, b) / max(e), -stress(1, b) / max(e)
    matrix[3, 2:], matrix[3, :2] = (b, 1 / b), -np.array([b, 1 / b]) - stress(0, b) / k[0]
    scale = np.array([1 / e[0], 1 / e[0], 1 / e[1], 1 / e[1]])
    x = np.linalg.solve(matrix * scale, right) * scale
    m1, m2 = layers[0][1], layers[1][1]
    turn = [torque / (4 * np.pi * m1 * a * a)]
    slip = torque / (2 * np.pi * b * b * k[1])
    turn.append((turn[0] * b - torque / (4 * np.pi * m1 * b) + slip + torque / (4 * np.pi * m2 * b)) / b)
    return {
        "radial": stress(0, b) @ x[:2],
        "shear": torque / (2 * np.pi * b * b),
        "u": lambda i, r: (
            x[2 * i] * r + x[2 * i + 1] / r,
            turn[i] * r - torque / (4 * np.pi * layers[i][1] * r),
        ),
    }


@row("B12", "E ratio 1e-6 … 1e6 across a joint", "patch exact; case 3 within 1e-3; rigid inclusion and hole")
def modulus(t: Trial) -> None:
    ratios = [1e-6, 1e-3, 1.0, 1e3, 1e6]
    patches, ring_errors = [], []
    for ratio in ratios:
        # strains along the joint that load the stiffer body by stresses of the size of the others
        patch = Patch(e=(1e4, 1e4 * ratio), ett=3e-4 * min(1.0, 1 / ratio))
        run = t.program.run(patch.scene(), patch.meshes(7, 11, "Q4")).need()
        patches.append(patch.errors(run))
        t.below(f"case 1b, E_B/E_A = {ratio:g}: displacement", patches[-1][0], 1e-10)
        # the softer body feels the rounding of the stiffer one
        rounding = 4 * np.finfo(float).eps * max(ratio, 1 / ratio)
        t.below(f"case 1b, E_B/E_A = {ratio:g}: traction", patches[-1][1], max(1e-10, rounding))
        ring_errors.append(ring_error(t, ratio))
        t.below(f"case 3, E_B/E_A = {ratio:g}: displacement", ring_errors[-1][0], 1e-3)
        t.below(f"case 3, E_B/E_A = {ratio:g}: tractions", ring_errors[-1][1], 1e-3)
    series = [
        ("patch: displacement", ratios, [u for u, _ in patches]),
        ("patch: traction", ratios, [s for _, s in patches]),
    ]
    series += [
        ("case 3: displacement", ratios, [u for u, _ in ring_errors]),
        ("case 3: traction", ratios, [s for _, s in ring_errors]),
    ]
    t.curves.append(Curve("modulus", "Stiff on soft", "E_B / E_A", "relative error", series))
    for ratio, limit in ((1e6, "rigid"), (1e-6, "hole")):
        inclusion(t, ratio, limit)


def ring_error(t: Trial, ratio: Any) -> tuple[Any, Any]:
    """A quarter of the rings, the exact displacement on its cuts."""
    e = (3e4, 3e4 * ratio)
    exact = rings(e)
    n, m = (16, 23) if t.quick else (32, 46)
    meshes = {
        body: rectangle(even(0, 1, edges), even(*r, edges // 4), "Q8", arc(np.pi / 2, np.pi / 2))
        for body, edges, r in (("a", n, (1.0, 1.5)), ("b", m, (1.5, 2.0)))
    }
    displace: dict[str, Any] = {}
    for i, body in enumerate("ab"):
        (a1, b1), (a2, b2) = fitted(exact, i, 0), fitted(exact, i, 1)
        # u_r = a1 r + b1/r, u_t = a2 r + b2/r
        r2 = "(x*x + y*y)"
        radial, around = (f"({number(p)} + {number(q)}/{r2})" for p, q in ((a1, b1), (a2, b2)))
        x, y = f"{radial}*x - {around}*y", f"{radial}*y + {around}*x"
        groups = ("left", "right", "bottom") if i == 0 else ("left", "right", "top")
        displace |= {f"{body}.{group}": {"x": x, "y": y} for group in groups}
    text = scene(
        {"a": (e[0], 0.2), "b": (e[1], 0.3)},
        {"joint": ("a.top", "b.bottom", elastic(2e4, 1e4))},
        [{"displace": displace}],
    )
    run = t.program.run(text, meshes).need()
    error, scale = 0.0, 0.0
    for i, body in enumerate("ab"):
        points = run.points(body)
        r = np.hypot(*points.T)
        radial, around = exact["u"](i, r)
        u = (
            np.stack(
                [
                    radial * points[:, 0] - around * points[:, 1],
                    radial * points[:, 1] + around * points[:, 0],
                ],
                -1,
            )
            / r[:, None]
        )
        error, scale = max(error, np.abs(run.displacement(body) - u).max()), max(scale, np.abs(u).max())
    joint = run.joint()
    # n points outwards; t runs clockwise, as n lies on its left
    wanted = np.array([exact["radial"], -exact["shear"]])
    off = np.sqrt(np.average(((joint["traction"] - wanted) ** 2).sum(1), weights=joint["length"].ravel()))
    return error / scale, off / np.linalg.norm(wanted)


def fitted(exact: Any, i: Any, component: Any) -> Array:
    """a and b of a r + b/r."""
    (r1, r2) = (1.0, 2.0)
    v1, v2 = exact["u"](i, r1)[component], exact["u"](i, r2)[component]
    return np.linalg.solve([[r1, 1 / r1], [r2, 1 / r2]], [v1, v2])


def inclusion(
    t: Trial,
    ratio: Any,
    limit: str,
    a: float = 1.0,
    far: float = 3.0,
    core: float = 0.3,
    nu: tuple[float, float] = (0.2, 0.3),
    em: float = 1e4,
    kn: float = 1e8,
    kt: float = 1e8,
) -> None:
    """Case 4, an elastic disc bonded by stiff springs in a plate under tension: t_n at 0° and 90° on the joint."""
    ei = em * ratio
    exact = disc(a, ei, nu[0], em, nu[1], kn, kt)
    n, m = (24, 33) if t.quick else (48, 66)
    inner = rectangle(even(0, 1, n), core ** (1 - even(0, 1, n // 2)), "Q8", arc(np.pi / 2, np.pi / 2))
    outer = rectangle(even(0, 1, m), far ** even(0, 1, m // 2), "Q8", arc(np.pi / 2, np.pi / 2))
    groups = {}
    for body, group, r in (("a", "bottom", core), ("b", "top", far)):
        u0, u2, v2 = exact["u"](r, body)
        c2, s2 = "(x*x - y*y)/(x*x + y*y)", "2*x*y/(x*x + y*y)"
        radial, around = f"({number(u0 / r)} + {number(u2 / r)}*{c2})", f"({number(v2 / r)}*{s2})"
        groups[f"{body}.{group}"] = {"x": f"{radial}*x - {around}*y", "y": f"{radial}*y + {around}*x"}
    step = {"displace": groups, "fix": {"a.left": ["x"], "b.left": ["x"], "a.right": ["y"], "b.right": ["y"]}}
    run = t.program.run(
        scene({"a": (ei, nu[0]), "b": (em, nu[1])}, {"joint": ("a.top", "b.bottom", elastic(kn, kt))}, [step]),
        {"a": inner, "b": outer},
    ).need()
    joint = run.joint()
    x, y = joint["place"].T
    angle = np.arctan2(y, x)
    wanted = np.stack([exact["n0"] + exact["n2"] * np.cos(2 * angle), -exact["t2"] * np.sin(2 * angle)], -1)
    off = np.sqrt(np.average(((joint["traction"] - wanted) ** 2).sum(1), weights=joint["length"].ravel()))
    t.below(f"case 4, E_i/E_m = {ratio:g} ({limit}): traction in L2 over σ_∞", off, 1e-3)
    if limit == "hole":
        t.below("hole: exact answer, of σ_∞", abs(exact["n0"]) + abs(exact["n2"]), 1e-5)
    else:
        # a rigid disc in plane strain (Goodier): σ_rr at 0° by E_i → ∞ of the same solution
        rigid = disc(a, em * 1e14, nu[0], em, nu[1], 1e14 * em, 1e14 * em)
        t.below(
            "rigid: exact answer against its limit",
            abs(exact["n0"] + exact["n2"] - rigid["n0"] - rigid["n2"]),
            1e-3,
        )


@row(
    "B43",
    "a layer of thickness 1e-3 … 1e-6 L, cells 1e3 … 1e6 times longer than high",
    "patch exact but for ε times the slenderness",
)
def thin(t: Trial) -> None:
    slender, errors = [], []
    for height in (1e-1, 1e-3, 1e-4, 1e-6):
        patch = Patch(heights=(0.5, height), kn=2e5, kt=5e4)
        run = t.program.run(patch.scene(), patch.meshes(7, 11, "Q4", (3, 1))).need()
        ratio = 1 / (11 * height)
        slender.append(ratio)
        errors.append(patch.errors(run))
        limit = 1e-12 + 1e2 * np.finfo(float).eps * ratio
        t.below(f"layer of {height:g} L: displacement", errors[-1][0], limit)
        t.below(f"layer of {height:g} L: traction", errors[-1][1], limit)
    t.curves.append(
        Curve(
            "thin",
            "Case 1b with a thin layer, Q4 7:11",
            "length over height of the cells",
            "relative error",
            [
                ("displacement", slender, [u for u, _ in errors]),
                ("traction", slender, [s for _, s in errors]),
            ],
        )
    )
    for n in (10, 100, 1000):
        # slender across: many short edges, one row
        patch = Patch(heights=(0.5, 0.7))
        run = t.program.run(patch.scene(), patch.meshes(7, n, "Q4", (3, 1))).need()
        t.below(f"cells {0.7 * n:g} times higher than long: displacement", patch.errors(run)[0], 1e-10)
        t.below(f"cells {0.7 * n:g} times higher than long: traction", patch.errors(run)[1], 1e-10)
    strip = Strip(h=(0.8, 1e-3))
    run = t.program.run(strip.scene(), strip.meshes(16, 24, "Q8", (8, 1))).need()
    t.within("case 5b, a skin of 1e-3: energy / exact", strip.errors(run)[0] + 1, 0.995, 1.005)
