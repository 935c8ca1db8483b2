"""A disc in a plate: equilibrium by differences, the rim, infinity and the limit of one body."""

import numpy as np
import pytest
from independent import out_of_balance, stress_of

from midplane_pipeline.exact.inclusion import disc

A, S, D = 0.7, 0.5, 0.5
MATERIAL = {"a": (3e4, 0.2), "b": (1e4, 0.3)}
KN, KT = 4e4, 1e4


def displacement(found, body):
    """The field in x, y."""

    def u(x, y):
        r, angle = np.hypot(x, y), np.arctan2(y, x)
        u0, u2, v2 = found["u"](r, body)
        radial, around = u0 + u2 * np.cos(2 * angle), v2 * np.sin(2 * angle)
        c, s = x / r, y / r
        return np.array([c * radial - s * around, s * radial + c * around])

    return u


def on_rim(stress, angle):
    """σ_rr and σ_rθ at the rim."""
    c, s = np.cos(angle), np.sin(angle)
    xx, yy, xy = stress(A * c, A * s)
    return c * c * xx + s * s * yy + 2 * c * s * xy, c * s * (yy - xx) + (c * c - s * s) * xy


@pytest.fixture
def found():
    return disc(A, *MATERIAL["a"], *MATERIAL["b"], KN, KT, S, D)


@pytest.mark.parametrize(("body", "radius"), [("a", 0.3), ("a", 0.6), ("b", 0.8), ("b", 2.0)])
def test_both_bodies_are_in_equilibrium(found, body, radius):
    stress = stress_of(displacement(found, body), *MATERIAL[body], 1e-4)
    for angle in (0.3, 1.2, 2.5):
        x, y = radius * np.cos(angle), radius * np.sin(angle)
        size = np.abs(stress(x, y)).max() / radius
        assert np.abs(out_of_balance(stress, x, y, 1e-3)).max() < 1e-4 * size


def test_the_rim_carries_one_traction_and_opens_by_its_springs(found):
    inside, outside = (stress_of(displacement(found, body), *MATERIAL[body], 1e-5) for body in "ab")
    for angle in (0.1, 0.9, 2.0):
        normal = found["n0"] + found["n2"] * np.cos(2 * angle)
        shear = found["t2"] * np.sin(2 * angle)
        assert on_rim(inside, angle) == pytest.approx((normal, shear), abs=1e-7)
        assert on_rim(outside, angle) == pytest.approx((normal, shear), abs=1e-7)
        jump = displacement(found, "b")(A * np.cos(angle), A * np.sin(angle)) - displacement(found, "a")(A * np.cos(angle), A * np.sin(angle))
        c, s = np.cos(angle), np.sin(angle)
        assert (c * jump[0] + s * jump[1], c * jump[1] - s * jump[0]) == pytest.approx((normal / KN, shear / KT), rel=1e-9)


def test_far_away_nothing_is_known_of_the_disc(found):
    stress = stress_of(displacement(found, "b"), *MATERIAL["b"], 1e-2)
    assert stress(200.0, 300.0) == pytest.approx([S + D, S - D, 0.0], abs=1e-4)


def test_of_one_material_and_stiffly_joined_it_is_one_plate():
    found = disc(A, 2e4, 0.25, 2e4, 0.25, 1e14, 1e14, S, D)
    assert [found[name] for name in ("n0", "n2", "t2")] == pytest.approx([S, D, -D], rel=1e-7)
