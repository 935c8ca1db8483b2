"""Keys of a scene: read, changed, taken out."""

from __future__ import annotations

import json
from pathlib import Path

import numpy as np
import pytest
from conftest import content

import midplane
from midplane import keys


def test_keys_have_dots_or_are_pointers(scene: midplane.Scene) -> None:
    assert scene["materials.rock.young"] == 1e4
    assert scene["/materials/rock/young"] == 1e4
    assert scene["steps.1.increments"] == 6


def test_a_name_may_have_dots(scene: midplane.Scene) -> None:
    scene["steps.0.load.upper.top.pressure"] = 7.0
    assert scene.data["steps"][0]["load"] == {"upper.top": {"pressure": 7.0}}


@pytest.mark.parametrize("names", [["a/b", "c~d"], ["", "x"], ["~1", "0"]])
def test_pointers_are_read_as_they_are_written(names: list[str]) -> None:
    assert keys.parts(keys.pointer(names), {}) == names


def test_values_may_be_numbers_of_numpy_and_tuples(scene: midplane.Scene) -> None:
    scene["interfaces.joint.initial_traction"] = (np.float64(-1.0), np.int64(0))
    assert scene["interfaces.joint.initial_traction"] == [-1.0, 0]


def test_a_file_stays_as_it_is_and_its_own_changes_count(place: Path) -> None:
    file = place / "scene.json"
    text = "\ufeff// with a byte order mark and comments\n" + json.dumps(content())
    file.write_text(text, encoding="utf-8")
    scene = midplane.Scene(file)
    scene["steps.1.increments"] = 2
    assert scene["steps.1.increments"] == 2
    assert file.read_text(encoding="utf-8") == text
    file.write_text(text.replace("Two blocks", "Other blocks"), encoding="utf-8")
    assert scene["title"] == "Other blocks"
    assert scene["steps.1.increments"] == 2


def test_a_key_can_be_taken_out(scene: midplane.Scene) -> None:
    del scene["output.history.slide"]
    assert list(scene["output.history"]) == ["force"]


def test_copies_are_their_own(scene: midplane.Scene) -> None:
    other = scene.copy()
    other["materials.rock.young"] = 5.0
    assert scene["materials.rock.young"] == 1e4


def test_data_is_a_copy(scene: midplane.Scene) -> None:
    scene.data["materials"]["rock"]["young"] = 1.0
    assert scene["materials.rock.young"] == 1e4


def test_names_of_scenes_and_their_results(place: Path) -> None:
    folder = place / "blocks"
    folder.mkdir()
    for name in ("scene", "steep"):
        (folder / f"{name}.json").write_text(json.dumps(content()))
    results = Path("results").absolute()
    assert midplane.Scene(folder).results(None) == results / "blocks"
    assert midplane.Scene(folder / "steep.json").results(None) == results / "blocks_steep"
    changed = [midplane.Scene(folder), midplane.Scene(folder)]
    changed[0]["materials.rock.young"] = 2e4
    changed[1]["materials.rock.young"] = 3e4
    places = {scene.results(None) for scene in changed}
    assert len(places) == 2
    assert all(path.name.startswith("blocks-") for path in places)
    changed[1]["materials.rock.young"] = 2e4
    assert len({scene.results(None) for scene in changed}) == 1


def test_the_last_of_several_changes_counts(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    for scene in (midplane.Scene(place), midplane.Scene(content())):
        law = dict(scene["interfaces.joint.law"])
        scene["interfaces.joint.law.friction_coefficient"] = 0.3
        scene["interfaces.joint.law"] = law | {"friction_coefficient": 0.5}
        scene["interfaces.joint.law.friction_coefficient"] = 0.2
        assert scene["interfaces.joint.law.friction_coefficient"] == 0.2
        scene["interfaces.joint.law"] = law
        assert scene["interfaces.joint.law.friction_coefficient"] == 0.6


def test_what_is_read_is_a_copy_and_says_so(scene: midplane.Scene) -> None:
    with pytest.raises(midplane.InputError, match=r'scene\["interfaces.joint.law.…"\] = … changes it'):
        scene["interfaces"]["joint"]["law"]["friction_coefficient"] = 0.1
    with pytest.raises(midplane.InputError, match="adds one"):
        scene["steps"].append({})
    scene["steps"] = [*scene["steps"], {"name": "wait"}]
    assert len(scene["steps"]) == 3


def test_a_new_group_is_one_name(scene: midplane.Scene) -> None:
    scene["steps.1.load.upper.top.pressure"] = 2.0
    scene["steps.1.hold.lower.right"] = ["y"]
    assert scene.data["steps"][1]["load"] == {"upper.top": {"pressure": 2.0}}
    assert scene.data["steps"][1]["hold"] == {"lower.right": ["y"]}


def test_keys_that_are_there(scene: midplane.Scene) -> None:
    assert "steps.1.increments" in scene
    assert "steps.1.control" not in scene
    assert "title" in list(scene)
    scene["description"] = None
    assert "description" in scene
    del scene["description"]
    assert "description" not in scene


def test_a_scene_may_come_with_numbers_of_numpy_paths_and_tuples() -> None:
    own = content()
    own["steps"] = tuple(own["steps"])
    own["steps"][1]["increments"] = np.int64(3)
    own["subdomains"]["lower"]["geo"] = Path("lower.geo")
    scene = midplane.Scene(own)
    assert scene["steps.1.increments"] == 3
    assert scene["subdomains.lower.geo"] == "lower.geo"


def test_incomplete_scenes_can_be_looked_at() -> None:
    assert "Scene" in repr(midplane.Scene({"steps": None, "subdomains": [1]}))
    assert "?" in repr(midplane.Scene({"steps": [1]}))


def test_a_scene_of_a_scene_is_its_own(scene: midplane.Scene) -> None:
    other = midplane.Scene(scene)
    other["title"] = "other"
    assert scene["title"] == "Two blocks"
