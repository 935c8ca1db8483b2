"""Bars and blocks in closed form against the differential equations and the balances they solve."""

import numpy as np
import pytest
from independent import area, box, line, results, runge_kutta

from midplane_pipeline.exact.bars import dcb, friction_block, pull_bar, tension

STRETCHED = {
    "interfaces": {"joint": {"law": {"normal_stiffness": 1e6, "tensile_strength": 3.0, "fracture_energy_i": 2e-4}}},
    "materials": {"rock": {"young": 3e4}},
    "steps": [{"displace": {"upper.top": {"y": 4e-4}}}],
}


def stretched(length):
    return tension(STRETCHED, results({"lower": box(0.5, 0.4 * length), "upper": box(0.5, 0.6 * length)}))


@pytest.mark.parametrize("length", [0.1, 2.0])
def test_a_cracked_bar_follows_the_rate_of_its_law(length):
    exact = stretched(length)
    stress = exact.history["stress"]
    # dσ/dw = −(χ/G) σ from the strength on; the bar and the springs of the crack are in series with it
    opening = np.linspace(0, 3e-4, 4001)
    softening = runge_kutta(lambda w, s: -3.0 / 2e-4 * s, [3.0], 0, 3e-4, 4000)[:, 0]
    moved = softening * (length / 3e4 + 1 / 1e6) + opening
    inside = stress[1:] > softening[-1]
    wanted = np.interp(stress[1:][inside], softening[::-1], moved[::-1])
    assert np.allclose(exact.history["displacement"][1:][inside], wanted, rtol=1e-6)


def test_a_cracked_bar_spends_its_fracture_energy():
    exact = stretched(0.1)
    u, s = exact.history["displacement"], exact.history["stress"]
    stored = 0.5 * s[-1] ** 2 * (0.1 / 3e4 + 1 / 1e6)
    spent = 2e-4 * (1 - s[-1] / 3.0)
    assert area(u, s) == pytest.approx(stored + spent, rel=1e-5)
    assert u[-1] == pytest.approx(4e-4, rel=1e-9)
    assert exact.traction["n"][1] == pytest.approx([s[-1]] * 2)


def test_a_long_bar_turns_where_it_is_longest():
    exact = stretched(2.0)
    (peak, _), (turn, _) = exact.marks
    u, s = exact.history["displacement"], exact.history["stress"]
    before_it_cracks_on = s > 0.2 * turn["stress"]
    assert peak["stress"] == 3.0
    falling = np.flatnonzero((s < 3.0) & before_it_cracks_on)
    least = falling[u[falling].argmin()]
    assert s[least] == pytest.approx(turn["stress"], rel=2e-3)
    assert u[least] == pytest.approx(turn["displacement"], rel=1e-6)


BEAM = {
    "interfaces": {"joint": {"law": {"normal_stiffness": 1e5, "fracture_energy_i": 2.8e-4}}},
    "materials": {"aluminium": {"young": 7e4, "poisson": 0.3}},
}


def split_beam():
    return dcb(BEAM, results({"lower": box(0.12, 0.003)}, {"joint": line([0.03, 0], [0.12, 0])}))


def test_arms_of_a_split_beam_bend_on_their_springs():
    exact = split_beam()
    h, young = 0.003, 7e4
    bending = young * h**3 / 12
    springs = 1 / (1 / 2e5 + h / 2 / young)  # of an arm to the mid-plane: the joint's, twice as stiff by half its length, and half its height
    for at in (1, 1000, 3000):
        crack = np.linspace(0.03, 0.03 + 0.5 * (0.12 - 0.03), 4000)[at - 1]
        far = 14 / (springs / (4 * bending)) ** 0.25

        def slope(x, y, crack=crack):
            held = -springs * y[0] if x > crack else 0.0
            return [y[1], y[2] / bending, y[3], held]

        def end(start, crack=crack, slope=slope, far=far):
            free = runge_kutta(slope, start, 0, crack * (1 - 1e-15), 400)[-1]
            return runge_kutta(lambda x, y: slope(crack + x + 1e-12, y), free, 0, far, 4000)[-1]

        # unit force at the free end, deflection and slope there such that nothing moves far behind
        loaded, lifted, turned = end([0, 0, 0, 1.0]), end([1.0, 0, 0, 0]), end([0, 1.0, 0, 0])
        unknown = np.linalg.solve(np.column_stack([lifted[:2], turned[:2]]), -loaded[:2])
        shear = crack / (5 / 6 * young / 2.6 * h)
        compliance = 2 * (abs(unknown[0]) + shear)
        assert exact.history["opening"][at] / exact.history["force"][at] == pytest.approx(compliance, rel=1e-4)


def test_a_split_beam_spends_its_fracture_energy():
    exact = split_beam()
    u, f = (exact.history[name][1:] for name in ("opening", "force"))
    released = area(u, f) - 0.5 * (u[-1] * f[-1] - u[0] * f[0])
    assert released == pytest.approx(2.8e-4 * 0.5 * (0.12 - 0.03), rel=1e-6)


PUSHED = {
    "interfaces": {"joint": {"law": {"tangential_stiffness": 1e3, "friction_coefficient": 0.6}}},
    "steps": [{"load": {"block.top": {"pressure": 1.5}}}, {"load": {"block.left": {"traction": [2.6, 0.0]}}}],
}


def test_a_pushed_block_is_in_balance():
    exact = friction_block(PUSHED, results({"block": box(2.0, 0.5)}))
    (s, normal), (_, shear) = exact.traction["n"], exact.traction["t"]
    weight, push = 1.5 * 2.0, 2.6 * 0.5
    assert area(s, -normal) == pytest.approx(weight, rel=1e-6)
    assert area(s, shear) == pytest.approx(push, rel=1e-5)
    assert area(s, -normal * (s - 1.0)) == pytest.approx(push * 0.25, rel=1e-6)
    # it sticks or slips: springs up to the friction there is
    slide = np.interp(push, exact.history["push"], exact.history["slide"])
    assert np.allclose(shear, np.minimum(1e3 * slide, -0.6 * normal), rtol=1e-5)
    assert exact.levels[0][0] == pytest.approx(0.6 * weight)


PULLED = {
    "interfaces": {"joint": {"law": {"tangential_stiffness": 500.0, "friction_coefficient": 0.5}}},
    "materials": {"steel": {"young": 2e3}},
    "steps": [{"load": {"bar.top": {"pressure": 2.0}}}, {"load": {"bar.right": {"traction": [70.0, 0.0]}}}],
}


def test_a_pulled_bar_solves_its_equation():
    exact = pull_bar(PULLED, results({"bar": box(1.0, 0.01)}))
    rigidity, limit = 2e3 * 0.01, 1.0
    for free in (1e-4, 5e-4, 1.5e-3):

        def slope(x, y):
            return [y[1], min(500.0 * y[0], limit) / rigidity]

        end = runge_kutta(slope, [free, 0.0], 0, 1.0, 4000)[-1]
        force = rigidity * end[1]
        assert force > exact.history["force"][1]
        assert np.interp(force, exact.history["force"], exact.history["displacement"]) == pytest.approx(end[0], rel=1e-4)
        assert np.interp(force, exact.history["force"], exact.history["displacement_free"]) == pytest.approx(free, rel=1e-4)
    s, shear = exact.traction["t"]
    assert area(s, shear) == pytest.approx(70.0 * 0.01, rel=1e-4)
