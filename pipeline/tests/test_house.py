"""Small things that decide: versions, licences, arrays of tasks, pages, damage."""

import random

import pytest

from midplane_pipeline.draw.page_text import page_text
from midplane_pipeline.house.advisories import fits
from midplane_pipeline.house.licences import is_taken
from midplane_pipeline.robust.array import task_ids
from midplane_pipeline.robust.damage import damaged
from midplane_pipeline.robust.files import timeless
from midplane_pipeline.trade.scenes import SCENES, knobs, mesh, reference, settings


@pytest.mark.parametrize(
    ("version", "requirement", "good"),
    [
        ("1.4.2", ">= 1.4.0", True),
        ("1.4.2", ">= 1.2, < 1.4", False),
        ("0.8.3", "^0.8", True),
        ("0.9.0", "^0.8", False),
        ("2.0.0", "^1.5", False),
        ("1.5.9", "~1.5", True),
        ("1.6.0", "~1.5", False),
        ("1.0.0-beta.1", ">= 1.0.0", False),
        ("1.0.0", "=1.0.0", True),
    ],
)
def test_versions_fit_requirements(version, requirement, good):
    assert fits(version, requirement) is good


@pytest.mark.parametrize(
    ("licence", "good"),
    [
        ("MIT", True),
        ("GPL-3.0", False),
        ("GPL-3.0 OR MIT", True),
        ("MIT AND GPL-3.0", False),
        ("(MIT OR GPL-3.0) AND Zlib", True),
        ("MIT/Apache-2.0", True),
        ("MIT/GPL-3.0", True),
        ("none", False),
    ],
)
def test_licences_leave_a_choice(licence, good):
    assert is_taken(licence) is good


def test_arrays_of_tasks():
    assert task_ids("0-3") == [0, 1, 2, 3]
    assert task_ids("1,4") == [1, 4]
    assert task_ids("0-6:2%2") == [0, 2, 4, 6]


def test_nothing_on_a_page_is_markup_or_turns_the_writing():
    assert page_text("<b>\u202e\x1b") == "&lt;b&gt;\ufffd\ufffd"
    assert page_text("a\nb") == "a\nb"


def test_damage_is_the_same_from_the_same_seed():
    data = b'{"a": 1.5, "b": [1, 2]}\n' * 20
    changed = [damaged(data, random.Random(seed)) for seed in range(20)]
    assert changed == [damaged(data, random.Random(seed)) for seed in range(20)]
    assert sum(one != data for one in changed) > 15


def test_what_is_measured_is_left_out_of_a_comparison():
    assert timeless({"time": 1, "a": [{"seconds.solve": 2, "b": 3}]}) == {"a": [{"b": 3}]}


@pytest.mark.parametrize("name", SCENES)
def test_sides_of_a_scene_never_match(name):
    scene = SCENES[name]
    for level in scene.refinements:
        for ratio in ("own", "1:1", "1:4"):
            edges = [mesh(scene, level, ratio)[f"subdomains.{side}.parameters.edges"] for side in scene.sides]
            assert edges[0] != edges[1]


@pytest.mark.parametrize("name", SCENES)
def test_settings_differ_from_the_reference_by_the_knobs_that_are_turned(name):
    scene = SCENES[name]
    usual = settings(scene, {})
    assert settings(scene, reference(scene)) == usual
    for knob, values in knobs(scene).items():
        others = [value for value in values if value != reference(scene)[knob]]
        assert any(settings(scene, {knob: value}) != usual for value in others)
