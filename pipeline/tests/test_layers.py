"""The solutions that the campaign of extremes measures against: patches, bending, the strip, rings, Gauss in long numbers."""

import numpy as np
import pytest
from independent import gradient, out_of_balance, runge_kutta, stress_of

from midplane_pipeline.extremes import layers
from midplane_pipeline.extremes.msh import even, rectangle
from midplane_pipeline.extremes.precise import WIDE, derivatives, eliminate, stiffness
from midplane_pipeline.extremes.solutions import Bending, Patch, Strip, exponential


def field(solution, side):
    return lambda x, y: solution.u(side, np.array([[x, y]]))[0]


@pytest.mark.parametrize("plane", ["strain", "stress"])
def test_a_patch_has_one_traction_and_opens_by_its_springs(plane):
    patch = Patch(plane=plane, origin=(0.3, -0.2), size=2.0)
    angle = np.radians(patch.theta)
    n, t = np.array([-np.sin(angle), np.cos(angle)]), np.array([np.cos(angle), np.sin(angle)])
    place = np.array(patch.origin) + 0.4 * t
    for side in (0, 1):
        xx, yy, xy = stress_of(field(patch, side), patch.e[side], patch.nu[side], 1e-3, plane)(*place)
        sigma = np.array([[xx, xy], [xy, yy]])
        assert sigma == pytest.approx(patch.sigma(side), rel=1e-9)
        assert (n @ sigma @ n, n @ sigma @ t) == pytest.approx((patch.snn, patch.snt), rel=1e-9)
    jump = field(patch, 1)(*place) - field(patch, 0)(*place)
    assert (jump @ n, jump @ t) == pytest.approx((patch.snn / patch.kn, patch.snt / patch.kt), rel=1e-9)


def test_the_formulas_of_a_patch_are_its_field():
    patch = Patch(origin=(0.3, -0.2))
    for side in (0, 1):
        x, y = 0.7, 0.1
        assert [eval(text, {"x": x, "y": y}) for text in patch.formulas(side)] == pytest.approx(field(patch, side)(x, y), rel=1e-12)


def test_bending_is_in_equilibrium_and_opens_by_its_springs():
    bending = Bending()
    for side in (0, 1):
        stress = stress_of(field(bending, side), bending.e, bending.nu, 1e-4, "stress")
        for x, y in ((0.03, 0.05), (-0.08, -0.02)):
            assert stress(x, y) == pytest.approx([0, bending.sm + bending.sg * x / bending.a, 0], abs=1e-7)
            assert np.abs(out_of_balance(stress, x, y, 1e-3)).max() < 1e-4
    x = 0.04
    jump = field(bending, 1)(x, 0.0) - field(bending, 0)(x, 0.0)
    assert jump == pytest.approx([0, (bending.sm + bending.sg * x / bending.a) / bending.kn], abs=1e-15)


def by_airy(strip):
    """Amplitudes of the strip by Airy's function f(y) cos kx in both layers: top, normal and shear traction of the joint."""
    k = strip.k

    def rows(layer, y):
        """f, f', σ_yy, σ_xy, U, V of the four terms; derivatives of f by hand."""
        e, nu = strip.e[layer], strip.nu[layer]
        c, s = np.cosh(k * y), np.sinh(k * y)
        f = np.array(
            [
                [c, y * c, s, y * s],
                [k * s, c + k * y * s, k * c, s + k * y * c],
                [k**2 * c, 2 * k * s + k**2 * y * c, k**2 * s, 2 * k * c + k**2 * y * s],
                [k**3 * s, 3 * k**2 * c + k**3 * y * s, k**3 * c, 3 * k**2 * s + k**3 * y * c],
            ]
        )
        along = ((1 - nu**2) * f[2] + nu * (1 + nu) * k**2 * f[0]) / (e * k)
        change = ((1 - nu**2) * f[3] + nu * (1 + nu) * k**2 * f[1]) / (e * k)
        up = (change - 2 * (1 + nu) * k * f[1] / e) / k
        return -(k**2) * f[0], k * f[1], along, up

    none = np.zeros(4)
    (_, _, u, v), below, above, top = rows(0, -strip.h[0]), rows(0, 0.0), rows(1, 0.0), rows(1, strip.h[1])
    matrix = [
        [*u, *none],
        [*v, *none],
        [*below[0], *-above[0]],
        [*below[1], *-above[1]],
        [*-below[2] - below[1] / strip.kt, *above[2]],
        [*-below[3] - below[0] / strip.kn, *above[3]],
        [*none, *top[0]],
        [*none, *top[1]],
    ]
    matrix = np.array(matrix)
    right = np.array([0, 0, 0, 0, 0, 0, -strip.p0, 0.0])
    size = np.abs(matrix).max(axis=1)
    unknown = np.linalg.solve(matrix / size[:, None], right / size)
    return top[3] @ unknown[4:], below[0] @ unknown[:4], below[1] @ unknown[:4]


@pytest.mark.parametrize(("kn", "kt"), [(2e4, 1e4), (1e2, 1e6)])
def test_the_strip_is_that_of_airy(kn, kt):
    strip_of = Strip(kn=kn, kt=kt)
    found = strip_of.solve()
    assert [found[name] for name in ("q_top", "normal", "shear")] == pytest.approx(by_airy(strip_of), rel=1e-9)


def test_exponentials_of_matrices_are_those_of_an_equation():
    matrix = np.array([[0.3, 1.2, 0.0], [-2.0, 0.1, 0.4], [0.5, 0.0, -0.7]])
    wanted = np.column_stack([runge_kutta(lambda x, y: matrix @ y, unit, 0, 1, 4000)[-1] for unit in np.eye(3)])
    assert exponential(matrix) == pytest.approx(wanted, rel=1e-10)


def test_rings_under_pressure_solve_the_equation_of_lame():
    nu, e = 0.2, layers.YOUNG
    lam, mu = e * nu / ((1 + nu) * (1 - 2 * nu)), e / (2 * (1 + nu))

    def slope(r, y):
        u, radial = y
        du = (radial - lam * u / r) / (lam + 2 * mu)
        return [du, -(radial - (lam * du + (lam + 2 * mu) * u / r)) / r]

    def both(start):
        u, radial = runge_kutta(slope, start, 1.0, 1.5)[-1]
        return radial, runge_kutta(slope, [u + radial / layers.KN, radial], 1.5, 2.0)[-1][1]

    (t0, end0), (t1, end1) = both([0.0, -layers.P]), both([1e-3, -layers.P])
    share = end0 / (end0 - end1)
    assert layers.lame_rings() == pytest.approx(t0 + share * (t1 - t0), rel=1e-9)


def test_gauss_in_long_numbers_finds_what_it_started_from():
    rng = np.random.default_rng(3)
    matrix = (rng.normal(size=(30, 30)) * 10.0 ** rng.integers(-6, 6, (30, 1))).astype(WIDE)
    x = rng.normal(size=30).astype(WIDE)
    assert np.abs(eliminate(matrix, matrix @ x) - x).max() < 1e-14


@pytest.mark.parametrize("shape", ["T3", "Q4"])
def test_a_stiffness_gives_no_force_to_motions_and_the_energy_of_strains(shape):
    mesh = rectangle(even(0, 2, 3), even(0, 1, 2), shape)
    k = stiffness(mesh, 1e4, 0.3)
    x, y = mesh.points.T.astype(WIDE)
    for motion in (np.stack([x * 0 + 1, x * 0], -1), np.stack([-y, x], -1)):
        assert np.abs(k @ motion.ravel()).max() < 1e-13 * np.abs(k).max()
    u = np.stack([2e-3 * x, 1e-3 * y], -1).ravel()
    (gxx, _), (_, gyy) = gradient(lambda x, y: [2e-3 * x, 1e-3 * y], 0.3, 0.4, 0.1)
    lam, mu = 1e4 * 0.3 / (1.3 * 0.4), 1e4 / 2.6
    energy = 2.0 * (0.5 * lam * (gxx + gyy) ** 2 + mu * (gxx**2 + gyy**2))
    assert float(0.5 * u @ k @ u) == pytest.approx(energy, rel=1e-12)
    assert sum(float(weight) for _, weight in derivatives(shape)) == pytest.approx(0.5 if shape == "T3" else 4.0)
