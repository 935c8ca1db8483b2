"""Bond and slip of a bar in closed form against Runge–Kutta."""

import numpy as np
import pytest
from independent import area, box, results, runge_kutta

from midplane_pipeline.exact.bond import Bond, pull_out

STRENGTH, FIRST, LAST, RIGIDITY, LENGTH = 6.0, 4e-5, 3e-4, 400.0, 0.25


@pytest.mark.parametrize("free", [1e-7, 3e-6, 3.9e-5, 1e-4, 2.5e-4])
def test_slip_along_the_bar_solves_its_equation(free):
    bond = Bond(RIGIDITY, LENGTH, STRENGTH, FIRST, LAST)

    def shear(s):
        return STRENGTH * s / FIRST if s < FIRST else max(STRENGTH * (LAST - s) / (LAST - FIRST), 0.0)

    steps = 5000
    found = runge_kutta(lambda x, y: [y[1], shear(y[0]) / RIGIDITY], [free, 0.0], 0, LENGTH, steps)
    x = np.linspace(0, LENGTH, steps + 1)
    slip, strain = bond.slip(free, x)
    assert np.allclose(slip, found[:, 0], rtol=1e-4)
    assert np.allclose(strain, found[:, 1], rtol=1e-4, atol=1e-9)
    assert np.allclose(bond.shear(slip), [shear(s) for s in slip], rtol=1e-9)


SCENE = {
    "thickness": 0.05,
    "materials": {"steel": {"young": 4e4}},
    "subdomains": {"bar": {"material": "steel"}},
    "interfaces": {"bond": {"law": {"shear_strength": STRENGTH, "fracture_energy_ii": 0.5 * STRENGTH * LAST, "tangential_stiffness": STRENGTH / FIRST}}},
    "steps": [{"displace": {"bar.right": {"x": 2.5e-4}}}],
}


def test_bond_stress_carries_the_force():
    exact = pull_out(SCENE, results({"bar": box(LENGTH, 0.01)}))
    moved, force = exact.history["displacement"], exact.history["force"]
    rising = slice(0, moved.argmax() + 1)
    s, shear = exact.traction["t"]
    assert 0.05 * area(s, shear) == pytest.approx(np.interp(2.5e-4, moved[rising], force[rising]), rel=1e-4)


def test_a_long_bond_holds_what_its_energy_allows():
    exact = pull_out(SCENE, results({"bar": box(5 * LENGTH, 0.01)}))
    limit, _ = exact.levels[0]
    assert exact.history["force"].max() == pytest.approx(limit, rel=1e-3)
    assert exact.history["force"].max() <= limit * (1 + 1e-9)


def test_pulling_out_spends_the_energy_of_the_bond():
    exact = pull_out(SCENE, results({"bar": box(LENGTH, 0.01)}))
    work = area(exact.history["displacement"], exact.history["force"])
    assert work == pytest.approx(0.05 * LENGTH * 0.5 * STRENGTH * LAST, rel=1e-4)
