"""Cracks, contact and delamination: integral equations, turned tensors and balances of energy."""

import numpy as np
import pytest
from independent import area, box, line, results

from midplane_pipeline.exact.delamination import correction, curve, smeared
from midplane_pipeline.exact.fractures import hertz, inclined_crack, sneddon

ROCK = {"young": 2e4, "poisson": 0.25}


def principal_value(density, x, ends, count=400):
    """∫ density/(√(ends² − s²)) ds/(x − s) by Gauss and Chebyshev, x between its points."""
    s = ends * np.cos(np.pi * (2 * np.arange(1, count + 1) - 1) / (2 * count))
    return np.pi / count * (density(s) / (x - s)).sum()


def between(k, ends, count=400):
    return ends * np.cos(np.pi * k / count)


def test_a_pressed_crack_opens_so_that_its_faces_carry_the_pressure():
    half, pressure = 0.4, 3.0
    scene = {"materials": {"rock": ROCK}, "steps": [{"load": {"crack": {"pressure": pressure}}}]}
    exact = sneddon(scene, results(midplanes={"crack": line([-0.24, -0.32], [0.24, 0.32])}))
    middle = exact.history["opening"][-1]
    modulus = ROCK["young"] / (1 - ROCK["poisson"] ** 2)
    for k in (37, 160, 291):  # dislocations w' of the ellipse: σ = −E'/(4π) ∫ w'(s)/(x − s) ds
        x = between(k, half)
        stress = modulus / (4 * np.pi) * principal_value(lambda s: middle / half * s, x, half)
        assert abs(stress) == pytest.approx(pressure, rel=1e-9)


def test_an_inclined_crack_carries_what_the_turned_stress_leaves_it():
    angle, sigma, mu = np.radians(35), 4.0, 0.3
    scene = {"interfaces": {"crack": {"law": {"friction_coefficient": mu}}}, "steps": [{"load": {"plate.right": {"pressure": sigma}}}]}
    exact = inclined_crack(scene, results(midplanes={"crack": line([0, 0], [2 * np.cos(angle), 2 * np.sin(angle)])}))
    normal = np.array([-np.sin(angle), np.cos(angle)])
    traction = np.array([[-sigma, 0], [0, 0]]) @ normal
    assert exact.traction["n"][1] == pytest.approx([traction @ normal] * 2)
    assert exact.traction["t"][1] == pytest.approx([mu * abs(traction @ normal)] * 2)
    assert exact.traction["t"][0] == pytest.approx([0.1, 1.9])


def contact():
    scene = {
        "subdomains": {"disc": {"material": "rock"}, "block": {"material": "soft"}},
        "materials": {"rock": ROCK, "soft": {"young": 5e3, "poisson": 0.3}},
        "steps": [{"load": {"disc.top": {"pressure": 2.0}}}],
    }
    return hertz(scene, results({"disc": box(0.5, 0.5)}, {"joint": line([0, 0], [0.1, 0], [0.2, 0], [0.4, 0])}))


def test_pressure_between_disc_and_block_carries_the_force():
    exact = contact()
    s, normal = exact.traction["n"]
    assert 2 * area(s, -normal) == pytest.approx(exact.history["force"][-1], rel=1e-5)
    assert exact.history["force"][-1] == pytest.approx(2 * 2.0 * 0.5)
    assert -normal.min() == pytest.approx(exact.history["pressure"][-1])


def test_pressure_between_disc_and_block_makes_the_faces_fit():
    exact = contact()
    s, normal = exact.traction["n"]
    half = s[np.flatnonzero(normal < 0)[-1] + 1]
    together = 1 / ((1 - 0.25**2) / 2e4 + (1 - 0.3**2) / 5e3)
    peak = exact.history["pressure"][-1]
    for k in (45, 130, 170):  # slope of both faces: 2/(π E*) ∫ p(s)/(x − s) ds = x/R
        x = between(k, half)
        slope = 2 / (np.pi * together) * principal_value(lambda s: peak / half * (half**2 - s**2), x, half)
        assert slope == pytest.approx(x / 0.5, rel=1e-4)


LAYERS = {
    "thickness": 20.0,
    "materials": {"layer": {"young": 6e4}},
    "interfaces": {
        "lower": {"law": {"normal_stiffness": 1e5, "tangential_stiffness": 4e4}},
        "joint": {"law": {"fracture_energy_i": 0.3, "fracture_energy_ii": 0.8}},
    },
}
SIZES = {"height": 1.5, "crack": 40.0, "length": 120.0}


@pytest.mark.parametrize(("mode", "energy", "grown"), [("I", 0.3, 15.0), ("II", 0.8, 15.0)])
def test_a_growing_delamination_spends_its_energy(mode, energy, grown):
    x, force = curve(LAYERS, SIZES, mode)
    released = area(x, force) - 0.5 * (x[-1] * force[-1] - x[0] * force[0])
    assert released == pytest.approx(energy * 20.0 * grown, rel=1e-6)


def test_arms_of_stiff_layers_are_those_of_one_body():
    stiff = LAYERS | {"interfaces": {"lower": {"law": {"normal_stiffness": 1e12, "tangential_stiffness": 1e12}}}}
    along, across, shear = smeared(stiff, 0.5)
    assert (along, across, shear) == pytest.approx((6e4, 6e4, 3e4), rel=1e-6)
    # Williams: an isotropic arm of ν = 0 is longer by some 0.6 to 0.7 of its height
    assert 0.6 < correction(along, across, shear) < 0.7
