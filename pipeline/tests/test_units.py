"""A scene in other units, and back."""

import copy
import math

import numpy as np
import pytest

from midplane_pipeline.extremes.blocks import sheared
from midplane_pipeline.extremes.msh import even, rectangle
from midplane_pipeline.extremes.scenes import cracking
from midplane_pipeline.extremes.solutions import Patch, Strip
from midplane_pipeline.extremes.units import converted, converted_mesh

SCENES = [sheared(cracking(), 2.0, [1e-4, -1e-4]), Patch().scene(), Strip().scene()]
NAMES = {"cos": math.cos, "pi": math.pi}


def same(a, b):
    """True but for round-off; formulas are compared by their values."""
    if isinstance(a, dict):
        return a.keys() == b.keys() and all(same(a[key], b[key]) for key in a)
    if isinstance(a, list):
        return len(a) == len(b) and all(map(same, a, b))
    if isinstance(a, str) and any(sign in a for sign in "*+/"):
        return all(eval(a, NAMES | {"x": x, "y": y}) == pytest.approx(eval(b, NAMES | {"x": x, "y": y}), rel=1e-12) for x, y in ((0.3, 0.2), (-0.1, 0.7)))
    return b == pytest.approx(a, rel=1e-12) if isinstance(a, float) else a == b


@pytest.mark.parametrize("scene", SCENES)
@pytest.mark.parametrize(("length", "stress"), [(1e3, 1.0), (1e-3, 1e6), (39.37, 1.45e-4)])
def test_there_and_back_nothing_has_changed(scene, length, stress):
    before = copy.deepcopy(scene)
    there = converted(scene, length, stress)
    assert scene == before
    assert not same(there, scene)
    assert same(converted(there, 1 / length, 1 / stress), scene)


def test_every_number_scales_by_what_it_measures():
    there = converted(SCENES[0], 1e3, 1e-3)
    law, old = there["interfaces"]["joint"]["law"], cracking()
    assert law["normal_stiffness"] == pytest.approx(old["normal_stiffness"] * 1e-6)
    assert law["tensile_strength"] == pytest.approx(old["tensile_strength"] * 1e-3)
    assert law["fracture_energy_i"] == pytest.approx(old["fracture_energy_i"])
    assert law["tan_friction"] == old["tan_friction"]
    assert there["steps"][0]["load"]["b.top"]["pressure"] == pytest.approx(2e-3)
    assert there["steps"][1]["displace"]["b"]["x"] == pytest.approx(0.1)
    assert there["materials"]["a"]["poisson"] == SCENES[0]["materials"]["a"]["poisson"]


def test_a_formula_takes_places_in_the_new_unit():
    pressure = converted(SCENES[2], 1e3, 2.0)["steps"][0]["load"]["b.top"]["pressure"]
    old = SCENES[2]["steps"][0]["load"]["b.top"]["pressure"]
    assert eval(pressure, NAMES | {"x": 250.0}) == pytest.approx(2 * eval(old, NAMES | {"x": 0.25}))


def test_a_mesh_keeps_its_cells():
    mesh = rectangle(even(0, 1, 3), even(0, 2, 2), "Q8")
    there = converted_mesh(mesh, 1e3)
    back = converted_mesh(there, 1e-3)
    assert there.points.max() == 2e3
    assert np.allclose(back.points, mesh.points, rtol=1e-15)
    assert back.blocks is mesh.blocks
