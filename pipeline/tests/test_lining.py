"""A lining in ground: Hooke's law and equilibrium of the harmonics, the free face, the springs, and limits."""

import numpy as np
import pytest

from midplane_pipeline.exact.lining import Harmonics, Lining

CONCRETE, GROUND = {"young": 3e4, "poisson": 0.2}, {"young": 200.0, "poisson": 0.35}
KN, KT = 5e3, 5e2
RADII = (2.7, 3.0, 30.0)


def scene(share=0.4, xx=-0.4, yy=-0.9):
    return {
        "materials": {"concrete": CONCRETE, "ground": GROUND},
        "subdomains": {"ground": {"initial_stress": {"xx": xx, "yy": yy}}},
        "interfaces": {"back": {"law": {"normal_stiffness": KN, "tangential_stiffness": KT}}},
        "steps": [{"name": "dig", "deactivate": {"core": share}}, {"name": "line"}],
    }


def slope(of, r, h=1e-4):
    return (of(r + h) - of(r - h)) / (2 * h)


@pytest.mark.parametrize("material", [CONCRETE, GROUND])
def test_harmonics_obey_hooke_and_equilibrium(material):
    body, r = Harmonics(material), 2.9
    nu = material["poisson"]
    mu = material["young"] / (2 * (1 + nu))
    lam = 2 * mu * nu / (1 - 2 * nu)
    for k in range(2):
        radial, hoop, u = (body.even(r)[row, k] for row in range(3))
        d = slope(body.even, r)[:, k]
        strains = d[2], u / r
        assert radial == pytest.approx(lam * sum(strains) + 2 * mu * strains[0], rel=1e-6)
        assert hoop == pytest.approx(lam * sum(strains) + 2 * mu * strains[1], rel=1e-6)
        assert d[0] + (radial - hoop) / r == pytest.approx(0, abs=1e-6 * abs(radial))
    for k in range(4):
        radial, hoop, u, shear, v = body.second(r)[:, k]
        d = slope(body.second, r)[:, k]
        strains = d[2], u / r + 2 * v / r
        size = np.abs(body.second(r)[[0, 1, 3], k]).max()
        assert radial == pytest.approx(lam * sum(strains) + 2 * mu * strains[0], abs=1e-6 * size)
        assert hoop == pytest.approx(lam * sum(strains) + 2 * mu * strains[1], abs=1e-6 * size)
        assert shear == pytest.approx(mu * (d[4] - v / r - 2 * u / r), abs=1e-6 * size)
        assert d[0] + 2 * shear / r + (radial - hoop) / r == pytest.approx(0, abs=1e-6 * size)
        assert d[3] - 2 * hoop / r + 2 * shear / r == pytest.approx(0, abs=1e-6 * size)


def test_the_inner_face_is_free_and_the_back_is_on_its_springs():
    solution = Lining(scene(), RADII)
    for angle in (0.0, 0.4, 1.3):
        radial, _, shear = solution.stress(solution.inner, angle)
        assert (radial, shear) == pytest.approx((0, 0), abs=1e-12)
        radial, _, shear = solution.stress(solution.outer, angle)
        moves = []
        for body, even, second in (
            (solution.ring, solution.of_ring_even, solution.of_ring_second),
            (solution.ground, solution.of_ground_even, solution.of_ground_second),
        ):
            zero, two = body.even(solution.outer)[2] @ even, body.second(solution.outer) @ second
            moves.append((zero + two[2] * np.cos(2 * angle), two[4] * np.sin(2 * angle)))
        (ring_r, ring_t), (ground_r, ground_t) = moves
        assert radial == pytest.approx(KN * (ground_r - ring_r), rel=1e-9)
        assert shear == pytest.approx(KT * (ground_t - ring_t), abs=1e-12)


def test_half_a_ring_is_in_balance():
    solution = Lining(scene(), RADII)
    angles = np.linspace(0, np.pi, 2001)
    pull = [solution.stress(solution.outer, angle) for angle in angles]
    up = [(radial * np.sin(angle) + shear * np.cos(angle)) * solution.outer for (radial, _, shear), angle in zip(pull, angles, strict=True)]
    total = np.trapezoid(up, angles)
    assert solution.section(0.0)[0] + solution.section(np.pi)[0] == pytest.approx(total, rel=1e-6)
    normal, _, shear = solution.section(0.7)
    assert normal < 0
    assert shear != 0


def test_where_all_is_let_go_before_nothing_is_left_for_the_lining():
    solution = Lining(scene(share=1.0), RADII)
    assert solution.section(0.3) == pytest.approx([0, 0, 0], abs=1e-12)
    assert solution.wall(0.3) == pytest.approx(solution.wall(0.3, lined=False), rel=1e-12)


def test_a_hole_in_ground_far_from_its_edge_closes_as_kirsch_says():
    solution = Lining(scene(share=1.0, xx=-0.7, yy=-0.7), (2.7, 3.0, 3e4))
    mu = GROUND["young"] / (2 * (1 + GROUND["poisson"]))
    assert solution.wall(0.2, lined=False) == pytest.approx(-0.7 * 3.0 / (2 * mu), rel=1e-6)
