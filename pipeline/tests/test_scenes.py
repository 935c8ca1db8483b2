"""Scenes that programs write, and what is known of them."""

import argparse
import json
import math

import numpy as np
import pytest
from midplane.scene_file import without_comments

from midplane_pipeline.places import ROOT
from midplane_pipeline.scenes.bounds import resistance, stiffness, weakest_path
from midplane_pipeline.scenes.net import Net, area_and_centroid, is_convex, pairs
from midplane_pipeline.scenes.wall import JOINT, courses, ends, scene

LAW = {"tensile_strength": 2.0, "cohesion": 4.0, "tan_friction": 0.7}


@pytest.mark.parametrize(("opening", "slip"), [(1.0, 0.0), (1.0, 0.3), (0.9, -1.2)])
def test_resistance_is_the_most_that_tractions_on_the_hyperbola_do(opening, slip):
    chi, c, t = LAW["tensile_strength"], LAW["cohesion"], LAW["tan_friction"]
    sigma = chi - np.concatenate([[0.0], np.geomspace(1e-9, 1e3, 200001)])
    tau = np.sqrt(np.maximum((c - sigma * t) ** 2 - (c - chi * t) ** 2, 0.0))
    most = (sigma * opening + tau * abs(slip)).max()
    assert resistance(LAW, opening, slip) == pytest.approx(most, rel=1e-6)


def test_friction_without_opening_has_no_bound():
    assert resistance(LAW, 0.1, 1.0) == math.inf


@pytest.fixture(scope="module")
def net():
    return Net(3, 3, 0.1, 2)


def test_cells_of_a_net_fill_the_square(net):
    areas = [area_and_centroid([net.corners[c] for c in cell])[0] for cell in net.cells]
    assert sum(areas) == pytest.approx(0.01)
    assert min(areas) > 0
    assert all(map(is_convex, net.aggregates))
    assert len(net.aggregates) == 9
    assert Net(3, 3, 0.1, 2).aggregates == net.aggregates != Net(3, 3, 0.1, 3).aggregates


def concrete(factor=1.0):
    law = LAW | {"normal_stiffness": 1e6, "tangential_stiffness": 1e6}
    return {
        "subdomains": {"aggregates": {"material": "stone"}, "mortar": {"material": "mortar"}},
        "materials": {"stone": {"young": 7e4}, "mortar": {"young": 3e4}},
        "interfaces": {"rim": {"law": law | {"tensile_strength": factor * law["tensile_strength"]}}, "joint": {"law": law}},
    }


def test_a_modulus_lies_between_those_of_its_parts(net):
    share, soft, stiff = stiffness(net, concrete())
    assert 0.3 < share < 0.7
    assert 1e4 < soft < stiff < 7e4
    assert stiff == pytest.approx(share * 7e4 + (1 - share) * 3e4)


def test_the_weakest_path_is_weaker_than_a_straight_cut_and_gets_weaker_with_its_lines(net):
    straight = 0.1 * LAW["tensile_strength"]
    whole, half = (weakest_path(net, concrete(factor), (0.0, 1.0)) for factor in (1.0, 0.5))
    assert whole > straight * 0.99  # what is longer than the width resists more
    assert half < whole


def test_courses_of_a_wall_are_in_bond():
    assert ends(1, 4.5) == [0, 1, 2, 3, 4, 4.5]
    assert ends(2, 4.5) == [0, 0.5, 1.5, 2.5, 3.5, 4.5]
    assert ends(2, 3) == [0, 0.5, 1.5, 2.5, 3]


def wall(**more):
    usual = {"courses": 3, "bricks": 2.5, "top": "load", "pressure": 0.3, "push": 1e-3, "increments": 2, "control": "load", "split": False}
    usual |= {"edges": [1, 2], "rows": 1, "fields": "last", "geo": "brick.geo", "asked": "none"}
    return argparse.Namespace(**(usual | more))


def test_a_wall_is_a_scene_whose_bricks_fill_it():
    written = json.loads(without_comments(scene(wall())))
    parameters = [part["parameters"] for name, part in written["subdomains"].items() if name.startswith("course")]
    assert sum(part["width"] * part["height"] for part in parameters) == pytest.approx(3 * 2.5 * 0.22 * 0.062)
    assert len(parameters) == sum(len(course) for course in courses(wall()))
    assert written["interfaces"]["joint"]["law"]["cohesion"] == JOINT["cohesion"]
    assert "middle" in json.loads(without_comments(scene(wall(split=True))))["interfaces"]


def test_the_wall_of_the_gallery_is_what_its_program_writes():
    text = (ROOT / "geo/masonry_wall/scene.json").read_text()
    assert text == scene(wall(courses=16, bricks=4.5, edges=[2, 3], rows=2, push=3e-3, increments=30, fields="step")) + "\n"


def test_loops_have_neighbours():
    assert list(pairs([1, 2, 3])) == [(1, 2), (2, 3), (3, 1)]
