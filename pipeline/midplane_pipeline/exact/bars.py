"""Exact solutions of bars and of a rigid block, from the numbers of the scene and the sizes of its meshes.

Each is a closed form that the plane model must show where its own assumptions, a uniform stress, a stiff block, a thin bar,
make it one. Where there is only a limit that the model comes close to, the curve bears its name.
"""

from typing import Any

import numpy as np
from midplane.pictures.results import Results

from .solution import MANY, Exact, sizes


def tension(scene: dict[str, Any], results: Results) -> Any:
    """u = s (L/E + 1/K_N) - (G_I / chi_0) ln(s / chi_0) once s has reached chi_0: a bar in series with its crack.

    Where L is so large that u falls first, the bar snaps back; it turns at s = G_I / (chi_0 (L/E + 1/K_N)).
    """
    law = scene["interfaces"]["joint"]["law"]
    kn, chi, energy = (law[k] for k in ("normal_stiffness", "tensile_strength", "fracture_energy_i"))
    length = sum(sizes(results.subdomains[name])[1] for name in ("lower", "upper"))
    compliance = length / scene["materials"]["rock"]["young"] + 1 / kn
    end = scene["steps"][-1]["displace"]["upper.top"]["y"]

    def stretch(s: Any) -> Any:
        return s * compliance - energy / chi * np.log(s / chi)

    # where the end has been pulled to: beyond the turning point stretch falls as s grows
    turn = energy / (chi * compliance)
    low, high = chi * np.exp(-end * chi / energy), min(chi, turn)
    for _ in range(200):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if stretch(middle) > end else (low, middle)
    stress = np.geomspace(chi, low, MANY)
    curve = {
        "displacement": np.append(0.0, stretch(stress)),
        "stress": np.append(0.0, stress),
    }
    width = sizes(results.subdomains["lower"])[0]
    traction = {"n": ([0.0, width], [low, low]), "t": ([0.0, width], [0.0, 0.0])}
    marks = [({"displacement": chi * compliance, "stress": chi}, f"tensile strength, {chi:g} MPa")]
    if turn < chi:
        marks.append(({"displacement": stretch(turn), "stress": turn}, f"the path turns, {turn:.3f} MPa"))
    return Exact(curve, traction, marks)


def dcb(scene: dict[str, Any], results: Results) -> Any:
    """Energy release of two arms on springs: d = C(a) P, and P = sqrt(2 G_I / C'(a)) where the crack a grows.

    C(a) = 2 ((b a)^3 + 3 (b a)^2 + 3 b a + 3/2) / (3 E I b^3) + 2 a / (5/6 mu h), b = (k / 4 E I)^(1/4) and
    1/k = 1/(2 K_N) + h/(2 E). The limit of a brittle bond; a strength that is finite lowers and rounds its peak.
    """
    law, material = scene["interfaces"]["joint"]["law"], scene["materials"]["aluminium"]
    young, energy = material["young"], law["fracture_energy_i"]
    length, height = sizes(results.subdomains["lower"])
    bending = young * height**3 / 12
    springs = 1 / (1 / (2 * law["normal_stiffness"]) + height / (2 * young))
    b = (springs / (4 * bending)) ** 0.25
    shear = 2 / (5 / 6 * young / (2 * (1 + material["poisson"])) * height)
    start = results.midplane("joint").points[:, 0].min()

    crack = np.linspace(start, start + 0.5 * (length - start), MANY)
    behind = b * crack
    compliance = 2 * (behind**3 + 3 * behind**2 + 3 * behind + 1.5) / (3 * bending * b**3) + shear * crack
    slope = 2 * (behind + 1) ** 2 / (bending * b**2) + shear
    force = np.sqrt(2 * energy / slope)
    curve = {"opening": np.append(0.0, compliance * force), "force": np.append(0.0, force)}
    return Exact(curve, {}, name="limit of a brittle bond")


def friction_block(scene: dict[str, Any], results: Results) -> Any:
    """A rigid block of weight N, pushed by H at a height: p = N/L + 12 H height x / L^3, tau = min(K_T D, mu p).

    It slips behind a front at the fraction (1 + xi) / 2 of its length, where K_T D = mu p. Then
    H = mu N / (1 + 3 mu height (1 - xi)^2 / 2 L).
    """
    law = scene["interfaces"]["joint"]["law"]
    kt, mu = law["tangential_stiffness"], law["friction_coefficient"]
    weight, push = (step["load"] for step in scene["steps"])
    length, tall = sizes(results.subdomains["block"])
    normal, height = weight["block.top"]["pressure"] * length, tall / 2
    end = push["block.left"]["traction"][0] * tall

    def pressure(force: Any, xi: Any) -> Any:
        return normal / length + 6 * force * height / length**2 * xi

    def force(xi: Any) -> Any:
        return mu * normal / (1 + 1.5 * mu * height * (1 - xi) ** 2 / length)

    xi = np.linspace(-1, 1, MANY)
    curve = {
        "push": np.append(0.0, force(xi)),
        "slide": np.append(0.0, mu * pressure(force(xi), xi) / kt),
    }
    front = 1 - np.sqrt((mu * normal / end - 1) * length / (1.5 * mu * height))
    place = np.linspace(-1, 1, MANY)
    shear = mu * pressure(end, np.minimum(place, front))
    s = 0.5 * (1 + place) * length
    traction = {"n": (s, -pressure(end, place)), "t": (s, shear)}
    first = {"push": force(-1.0), "slide": force(-1.0) / kt / length}
    bound = (mu * normal, "$\\mu N$: no equilibrium above")
    return Exact(curve, traction, [(first, "the heel slips")], [bound])


def pull_bar(scene: dict[str, Any], results: Results) -> Any:
    """A thin bar on a rigid base, K_T until mu p: shear lag with b = sqrt(K_T / E h) over the length that sticks.

    With a length a at the pulled end slipping, F = t0 (tanh(b (L - a)) / b + a), t0 = mu p.
    """
    law = scene["interfaces"]["joint"]["law"]
    kt, mu = law["tangential_stiffness"], law["friction_coefficient"]
    length, tall = sizes(results.subdomains["bar"])
    steps = scene["steps"]
    limit = mu * steps[0]["load"]["bar.top"]["pressure"]
    rigidity = scene["materials"]["steel"]["young"] * tall
    b = np.sqrt(kt / rigidity)
    end = steps[-1]["load"]["bar.right"]["traction"][0] * tall

    slip = np.linspace(0, length, MANY)
    behind = limit / b * np.tanh(b * (length - slip))  # force in the bar where it begins to slip
    force = behind + limit * slip
    moved = limit / kt + (behind + 0.5 * limit * slip) * slip / rigidity
    curve = {
        "force": np.append(0.0, force),
        "displacement": np.append(0.0, moved),
        "displacement_free": np.append(0.0, limit / kt / np.cosh(b * (length - slip))),
    }
    sticks = length - np.interp(end, force, slip)
    s = np.linspace(0, length, MANY)
    shear = limit * np.where(s < sticks, np.cosh(b * s) / np.cosh(b * sticks), 1.0)
    traction = {"n": (s, np.full_like(s, -limit / mu)), "t": (s, shear)}
    first = {"force": force[0], "displacement": moved[0]}
    bound = (limit * length, "$\\mu p L$: no equilibrium above")
    return Exact(curve, traction, [(first, "the pulled end slips")], [bound])
