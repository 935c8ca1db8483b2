"""Typical mistakes, and what is said of them."""

from __future__ import annotations

import json
import shutil
import subprocess
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import content

import midplane


def said(error: type[BaseException], do: object) -> str:
    """What an error says: one message for people, without a word of Rust or a traceback of ours."""
    with pytest.raises(error) as found:
        do()  # type: ignore[operator]
    text = str(found.value)
    assert "panicked" not in text
    assert "Traceback" not in text
    assert "\x1b" not in text
    return text


def test_no_such_scene(place: Path) -> None:
    text = said(midplane.InputError, lambda: midplane.Scene("geo/damm"))
    assert "geo/damm" in text and str(place) in text and "scene.json" in text


def test_a_misspelt_key_is_told_with_those_there_are(scene: midplane.Scene) -> None:
    text = said(midplane.InputError, lambda: scene["interfaces.joint.law.friction"])
    assert "friction_coefficient" in text and "interfaces.joint.law" in text


def test_a_misspelt_key_that_is_set_is_told_by_the_program(scene: midplane.Scene) -> None:
    scene["interfaces.joint.law.frction_coefficient"] = 0.5
    text = said(midplane.InputError, lambda: scene.run(progress=False))
    assert 'unknown key "frction_coefficient"' in text and "friction_coefficient," in text


def test_a_value_that_is_none_of_json(scene: midplane.Scene) -> None:
    text = said(midplane.InputError, lambda: scene.__setitem__("materials.rock.young", {1, 2}))
    assert "materials.rock.young" in text and "set" in text
    assert "materials.rock.young" in said(midplane.InputError, lambda: scene.__setitem__("materials.rock.young", float("nan")))


def test_an_entry_beyond_the_last_step(scene: midplane.Scene) -> None:
    text = said(midplane.InputError, lambda: scene["steps.2.increments"])
    assert 'scene["steps"] + […]' in text and "counted from 0" in text


def test_a_value_of_the_wrong_kind(scene: midplane.Scene) -> None:
    scene["materials.rock.young"] = "stiff"
    text = said(midplane.InputError, lambda: scene.check())
    assert "materials.rock.young" in text


def test_a_geometry_that_is_not_there(scene: midplane.Scene, place: Path) -> None:
    (place / "lower.geo").unlink()
    assert "lower.geo" in said(midplane.InputError, lambda: scene.check())


def test_a_scene_that_is_no_json(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content())[:-20])
    scene = midplane.Scene(place)
    assert "scene.json" in said(midplane.InputError, lambda: scene["title"])


def test_no_program(monkeypatch: pytest.MonkeyPatch, scene: midplane.Scene) -> None:
    monkeypatch.setenv("MIDPLANE", "/nowhere/midplane")
    assert "/nowhere/midplane" in said(midplane.MachineError, lambda: scene.run())


def test_no_gmsh(scene: midplane.Scene) -> None:
    assert "gmsh" in said(midplane.MachineError, lambda: scene.run(gmsh="/nowhere/gmsh", progress=False))


def test_a_program_of_another_version(monkeypatch: pytest.MonkeyPatch, place: Path, scene: midplane.Scene) -> None:
    other = place / "midplane"
    other.write_text("#!/bin/sh\necho midplane 9.3.0\n")
    other.chmod(0o755)
    monkeypatch.setenv("MIDPLANE", str(other))
    text = said(midplane.VersionError, lambda: scene.run())
    assert "9.3.0" in text and midplane.__version__ in text


def test_something_else_in_place_of_the_program(monkeypatch: pytest.MonkeyPatch, scene: midplane.Scene) -> None:
    monkeypatch.setenv("MIDPLANE", str(shutil.which("true")))
    assert "is not midplane" in said(midplane.MachineError, lambda: scene.run())


def test_no_such_results(place: Path) -> None:
    assert "results/<scene>" in said(midplane.ResultsError, lambda: midplane.Run("results/nothing"))


def test_a_folder_without_results(place: Path) -> None:
    assert "history.csv" in said(midplane.ResultsError, lambda: midplane.Run(place).history)


def test_a_misspelt_interface(done: midplane.Run) -> None:
    assert 'Did you mean "joint"?' in said(midplane.ResultsError, lambda: done.interface("jiont"))


def test_a_row_that_is_not_stored(done: midplane.Run) -> None:
    text = said(midplane.ResultsError, lambda: done.interface("joint", row=99))
    assert "0 to 7" in text and "output.fields" in text


def test_a_misspelt_picture(done: midplane.Run) -> None:
    assert 'Did you mean "displacement"?' in said(midplane.InputError, lambda: done.plot("displacements"))  # type: ignore[arg-type]
    assert "subdomains" in said(midplane.InputError, lambda: done.plot(subdomain="lower"))


def test_a_zoom_beside_everything(done: midplane.Run) -> None:
    assert "nothing lies in the zoom" in said(midplane.ResultsError, lambda: done.plot(zoom=((5, 6), (5, 6))))


def test_a_path_that_is_not_there(scene: midplane.Scene) -> None:
    assert "path.json" in said(midplane.InputError, lambda: scene.law("joint", "path.json"))


def test_an_interface_without_such_a_law(scene: midplane.Scene) -> None:
    path = {"program": [{part: {"control": "displacement", "start": 0, "end": -1e-6} for part in "nt"} | {"points": 2}]}
    assert "joint" in said(midplane.InputError, lambda: scene.law("jiont", path))


def test_results_that_were_not_run_from_a_notebook(scene: midplane.Scene) -> None:
    run = scene.run(progress=False)
    subprocess.run([midplane.program(), "run", next(run.folder.glob("notebook/*/*/scene.json")), "-o", run.folder, "--quiet"], check=True)
    assert "resume=True" in said(midplane.ResultsError, lambda: midplane.Run(run.folder).resume())


def test_more_than_friction_can_hold(scene: midplane.Scene) -> None:
    scene["steps.1"] = {"name": "push", "increments": 4, "release": {"upper.left": ["x"], "upper.right": ["x"]}, "load": {"upper.left": {"traction": [40, 0]}}}
    with pytest.raises(midplane.EquilibriumError) as found:
        scene.run(progress=False)
    assert "nothing holds what slides" in str(found.value)
    run = found.value.run
    assert run is not None and 1 < len(run.history) < 6
    assert "midplane.Run(" in str(found.value)


def test_what_is_refused_leaves_nothing(scene: midplane.Scene, place: Path) -> None:
    scene["materials.rock.young"] = -1.0
    before = sorted(place.rglob("*"))
    said(midplane.InputError, lambda: scene.run("out", progress=False))
    said(midplane.InputError, lambda: scene.study({"steps.1.increments": [1, 2]}, {"f": "nothing.at.all"}, out="out", progress=False))
    assert sorted(place.rglob("*")) == before


def test_a_run_without_a_row_does_not_show_those_of_an_earlier_one(scene: midplane.Scene) -> None:
    scene.run("out", progress=False)
    scene["steps.0.load.upper.top.pressure"] = "stiff"
    run = scene.run("out", progress=False, wait=False)
    with pytest.raises(midplane.InputError):
        run.wait()
    text = said(midplane.ResultsError, lambda: run.history)
    assert "earlier" in text and "pressure" in text
    assert "without a row" in repr(run)
    # who opens the folder sees what is there
    assert len(midplane.Run("out").history) == 8


def test_a_second_resume_of_a_run_that_goes_on(scene: midplane.Scene) -> None:
    scene["steps.1.increments"] = 3000
    run = scene.run("out", progress=False, wait=False)
    while not (run.folder / "notebook.json").is_file():
        time.sleep(0.01)
    assert "goes on" in said(midplane.MidplaneError, lambda: run.resume(progress=False))
    assert run.running
    run.stop()


def test_axes_and_measures_of_a_study(scene: midplane.Scene) -> None:
    assert "list of values" in said(midplane.InputError, lambda: scene.study({"interfaces.joint.coupling": "pointwise"}))
    assert "none of" in said(midplane.InputError, lambda: scene.study({"steps.1.increments": [1]}, {"f": ("peak", "a", "b")}))


def test_names_that_would_leave_the_folder(place: Path) -> None:
    assert "no name for a scene" in said(midplane.InputError, lambda: midplane.Scene(content(), name="../x"))
    (place / "scene.json").write_text(json.dumps(content()))
    (place / "below").mkdir()
    import os

    os.chdir(place / "below")
    assert midplane.Scene("..").name == place.name


def test_keys_that_are_no_text(scene: midplane.Scene) -> None:
    assert "a key is a text" in said(midplane.InputError, lambda: scene[0])  # type: ignore[index]


def test_zooms(done: midplane.Run) -> None:
    for zoom in [(0, 0.2, -0.1, 0.1), "all", ((1, 0), (0, 1)), ((0.1, 0.1), (0, 1))]:
        assert "zoom" in said(midplane.InputError, lambda zoom=zoom: done.plot(zoom=zoom))  # type: ignore[misc]
    assert "row=3" in said(midplane.InputError, lambda: done.plot(3))  # type: ignore[arg-type]


def test_a_law_that_cannot_follow_tells_the_rows_before(scene: midplane.Scene) -> None:
    still = {"control": "displacement", "start": 0, "end": 0}
    pulled = {"control": "stress", "start": 0, "end": 1.0}
    pressed = {"control": "stress", "start": 0, "end": -1.0}
    path = {"program": [{"n": pressed, "t": still, "points": np.int64(2)}, {"n": pulled | {"start": -1.0}, "t": still, "points": 4}]}
    with pytest.raises(midplane.EquilibriumError) as found:
        scene.law("joint", path)
    assert found.value.table is not None and len(found.value.table) >= 3
