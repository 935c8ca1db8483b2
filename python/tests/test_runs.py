"""Runs that are watched, interrupted, gone on with; studies and laws."""

from __future__ import annotations

import contextlib
import json
import os
import pickle
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import PRESSURE, content

import midplane

LONG = 200_000  # increments of a run that is interrupted


def long(scene: midplane.Scene) -> midplane.Scene:
    scene["steps.1.increments"] = LONG
    return scene


def first_rows(run: midplane.Run) -> int:
    """Waits for the first three rows, or the end."""
    rows = 0
    while run.running and rows < 3:
        time.sleep(0.02)
        with contextlib.suppress(midplane.ResultsError):  # no row yet
            rows = len(run.history)
    return rows


def test_a_run_of_a_file_is_that_of_the_program(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    run = midplane.Scene(place).run(progress=False)
    assert run.folder == Path("results").absolute() / place.name
    subprocess.run([midplane.program(), "run", "scene.json", "-o", "other", "--quiet"], check=True)
    assert midplane.Run("other").history.equals(run.history)


def test_a_change_reaches_the_run(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    scene = midplane.Scene(place)
    scene["interfaces.joint.law.friction_coefficient"] = 0.3
    scene["steps.0.load.upper.top.pressure"] = 2 * PRESSURE
    run = scene.run(progress=False)
    assert run.history["force"].iloc[-1] == pytest.approx(0.3 * 2 * PRESSURE * 0.4, rel=1e-6)


def test_progress_goes_from_nothing_to_all(scene: midplane.Scene, capsys: pytest.CaptureFixture[str]) -> None:
    scene.run()
    shown = capsys.readouterr().err
    assert "blocks" in shown and "100%" in shown and "push 1.000" in shown


def test_results_can_be_read_while_the_run_goes_on(scene: midplane.Scene) -> None:
    run = long(scene).run(progress=False, wait=False)
    rows = first_rows(run)
    for _ in range(20):
        frame = run.interface("joint")
        assert frame["traction_n"].notna().all() and frame.attrs["side_b"] == "upper"
        assert sorted(run.fields[-1].keys()) == ["joint", "lower", "upper"]
        time.sleep(0.01)
    assert len(run.history) > rows >= 3
    assert run.running
    run.crack_map(subdomains=["lower"])
    assert "goes on" in repr(run)
    run.stop()
    assert not run.running
    assert 3 <= len(run.history) < LONG


def test_an_interrupted_run_goes_on_to_the_same_end(scene: midplane.Scene) -> None:
    scene["steps.1.increments"] = 400
    whole = scene.run("whole", progress=False)
    run = scene.run("part", progress=False, wait=False)
    assert first_rows(run) >= 3
    run.stop()
    assert len(run.history) < len(whole.history)
    again = midplane.Run("part").resume(progress=False)
    assert again.history.equals(whole.history)
    assert again.summary["resumed"]


SCRIPT = """
import sys
sys.path[:0] = {path!r}
from conftest import content
import midplane
scene = midplane.Scene(content(), name="blocks")
scene["steps.1.increments"] = {count}
try:
    scene.run("out", progress=False)
except KeyboardInterrupt as stopped:
    print(type(stopped).__name__, len(stopped.run.history), stopped, flush=True)
"""


def started(place: Path) -> subprocess.Popen[str]:
    """A notebook's kernel, as far as it matters here: Python that waits for a run."""
    path = [str(Path(__file__).parent), *sys.path]
    script = SCRIPT.format(path=path, count=LONG)
    return subprocess.Popen([sys.executable, "-c", script], cwd=place, stdout=subprocess.PIPE, text=True, start_new_session=True)


def rows_come(place: Path) -> None:
    until = time.monotonic() + 60
    while time.monotonic() < until:
        path = place / "out" / "history.csv"
        if path.is_file() and len(path.read_text().splitlines()) > 5:
            return
        time.sleep(0.02)
    raise AssertionError("no rows")


def test_an_interrupt_ends_the_run_cleanly(place: Path) -> None:
    kernel = started(place)
    rows_come(place)
    kernel.send_signal(signal.SIGINT)
    shown, _ = kernel.communicate(timeout=60)
    kind, rows, _, *_ = shown.split()
    assert kind == "Interrupted"
    assert 5 <= int(rows) < LONG
    assert "resume()" in shown
    assert (place / "out" / "summary.json").is_file()
    # nobody is at work in the folder any more
    run = midplane.Scene(content(), folder=place).run(place / "out", progress=False)
    assert len(run.history) == 8


@pytest.mark.skipif(sys.platform != "linux", reason="Linux tells a program that its parent is gone")
def test_a_kernel_that_dies_takes_its_run_along(place: Path) -> None:
    kernel = started(place)
    rows_come(place)
    kernel.kill()
    kernel.wait()
    summary = place / "out" / "summary.json"
    until = time.monotonic() + 60
    while time.monotonic() < until and not summary.is_file():
        time.sleep(0.05)
    run = midplane.Run(place / "out")
    assert "SIGTERM" in run.summary["stopped"]
    assert len(run.history) < LONG


def test_a_second_run_in_a_folder_is_told_who_is_there(scene: midplane.Scene) -> None:
    run = long(scene).run("out", progress=False, wait=False)
    while not (run.folder / "history.csv").is_file():
        time.sleep(0.02)
    with pytest.raises(midplane.MachineError, match="another run"):
        scene.run("out", progress=False)
    run.stop()


def test_a_study_of_twelve_points_is_one_call_and_goes_on_where_it_was(scene: midplane.Scene) -> None:
    axes = {"interfaces.joint.law.friction_coefficient": [0.1, 0.2, 0.3, 0.4, 0.5, 0.6], "upper.edges": np.array([5, 9])}
    measures = {"force": "joint.resultant_t", "most": ("peak", "joint.resultant_t")}
    table = scene.study(axes, measures, progress=False)
    assert len(table) == 12
    assert (table["status"] == "done").all()
    friction = np.repeat(axes["interfaces.joint.law.friction_coefficient"], 2)
    assert table["force"].to_numpy() == pytest.approx(friction * PRESSURE * 0.4, rel=1e-6)
    points = sorted(Path(table.attrs["folder"]).glob("points/*.json"))
    times = [path.stat().st_mtime_ns for path in points]
    assert len(times) == 12
    # after a restart of the kernel: a call by another process finds what is done
    script = f"import sys\nsys.path[:0] = {[str(Path(__file__).parent), *sys.path]!r}\nfrom conftest import content\nimport midplane, numpy as np\n"
    script += f"print(len(midplane.Scene(content(), name='blocks').study({axes!r}, {measures!r}, progress=False)))"
    script = script.replace("array(", "np.array(")
    ended = subprocess.run([sys.executable, "-c", script], check=True, capture_output=True, text=True)
    assert ended.stdout.strip() == "12"
    assert [path.stat().st_mtime_ns for path in points] == times


def test_a_study_of_a_changed_file_has_the_change(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    scene = midplane.Scene(place)
    scene["steps.0.load.upper.top.pressure"] = 2 * PRESSURE
    table = scene.study({"materials.rock.young": [1e4, 2e4]}, {"force": "joint.resultant_t"}, progress=False)
    assert table["force"].to_numpy() == pytest.approx(0.6 * 2 * PRESSURE * 0.4, rel=1e-6)


def test_one_point_of_a_law(scene: midplane.Scene) -> None:
    """Friction under a constant traction: linear, then the coefficient times it."""
    pressed = {"control": "stress", "start": 0, "end": -2.0}
    held = {"control": "stress", "start": -2.0, "end": -2.0}
    still, sheared = ({"control": "displacement", "start": 0, "end": end} for end in (0, 4e-6))
    path = {"program": [{"n": pressed, "t": still, "points": 1}, {"n": held, "t": sheared, "points": 8}]}
    frame = midplane.law(scene, "joint", path)
    shear = frame["traction_t"].to_numpy()
    assert shear == pytest.approx(np.minimum(1e6 * frame["jump_t"], 0.6 * 2.0), rel=1e-6, abs=1e-9)
    assert frame["traction_t"].equals(scene.law("joint", path)["traction_t"])


def test_check_tells_sizes(scene: midplane.Scene) -> None:
    check = scene.check()
    assert "joint" in check.text and "lower" in repr(check)


def test_the_program_is_found(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    real = midplane.program()
    link = tmp_path / "midplane"
    os.symlink(real, link)
    monkeypatch.setenv("MIDPLANE", str(link))
    assert midplane.program() == link
    monkeypatch.delenv("MIDPLANE")
    monkeypatch.setattr("midplane.binary.BESIDE", [])
    monkeypatch.setenv("PATH", str(tmp_path))
    assert midplane.program() == link
    monkeypatch.setenv("PATH", "/nowhere")
    with pytest.raises(midplane.MachineError, match="not in PATH"):
        midplane.program()


def test_a_scene_and_its_run_are_where_they_were_whatever_the_folder_of_the_notebook(place: Path, tmp_path_factory: pytest.TempPathFactory) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    elsewhere = tmp_path_factory.mktemp("elsewhere")
    (elsewhere / "scene.json").write_text(json.dumps(content() | {"title": "another"}))
    scene = midplane.Scene("scene.json")
    scene["steps.1.increments"] = 400
    run = scene.run("out", progress=False, wait=False)
    os.chdir(elsewhere)
    assert scene["title"] == "Two blocks"
    while not (run.folder / "notebook.json").is_file():
        time.sleep(0.01)
    run.stop()
    rows = len(run.history)
    assert run.resume(progress=False).history["step"].tolist().count("push") == 400 > rows
    assert sorted(path.name for path in elsewhere.iterdir()) == ["scene.json"]


def test_a_preset_is_the_same_for_files_and_dictionaries(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    rows = []
    for scene in (midplane.Scene("scene.json"), midplane.Scene(content())):
        scene["steps.1.increments"] = 8
        rows.append(len(scene.run(accuracy="draft", progress=False).history))
    assert rows == [10, 10]


def test_files_of_others_stay(scene: midplane.Scene, place: Path) -> None:
    own = "// mine\n" + json.dumps(content())
    for name in ("scene.json", "request.json"):
        (place / name).write_text(own)
    scene.run(".", progress=False)
    scene.study({"steps.1.increments": [1]}, {"f": "joint.resultant_t"}, out=".", progress=False)
    assert (place / "scene.json").read_text() == own
    assert (place / "request.json").read_text() == own


def test_a_run_by_the_program_itself_is_not_taken_for_that_of_the_notebook(scene: midplane.Scene, place: Path) -> None:
    scene.run("out", progress=False)
    other = content()
    other["subdomains"] = {"below": other["subdomains"]["lower"], "above": other["subdomains"]["upper"]}
    text = (
        json.dumps(other)
        .replace("lower.top", "below.top")
        .replace("lower.bottom", "below.bottom")
        .replace("upper.", "above.")
        .replace("above.geo", "upper.geo")
    )
    (place / "other.json").write_text(text)
    subprocess.run([midplane.program(), "run", "other.json", "-o", "out", "--quiet"], check=True)
    run = midplane.Run("out")
    assert run.scene is None
    run.plot()


def test_runs_and_scenes_can_be_pickled(scene: midplane.Scene) -> None:
    run = scene.run()
    assert pickle.loads(pickle.dumps(run)).history.equals(run.history)
    assert pickle.loads(pickle.dumps(scene)).data == scene.data


def test_a_run_may_be_started_in_a_thread(scene: midplane.Scene) -> None:
    from concurrent.futures import ThreadPoolExecutor

    with ThreadPoolExecutor(2) as pool:
        runs = list(pool.map(lambda out: scene.run(out, progress=False), ["one", "two"]))
    assert runs[0].history.equals(runs[1].history)


def test_progress_counts_steps_of_one_increment() -> None:
    bar = midplane.scene.Progress({"steps": [{"name": name} for name in ("a", "b", "c", "d")]}, "staged")
    shares = []
    for step in ("a", "b", "c", "d"):
        bar.line(f"{step}     1/1   1.000000      3    1.2e-16      0.0e0")
        shares.append(bar.bar.n / bar.bar.total)
    bar.close(False)
    assert shares == [0.25, 0.5, 0.75, 1.0]


def test_a_title_in_any_language_under_any_locale(place: Path) -> None:
    script = """
import sys
sys.path[:0] = PATH
from conftest import content
import midplane
scene = midplane.Scene(content() | {"title": "Gr\\u00f6\\u00dfe \\u5927"}, name="blocks")
run = scene.run(progress=False)
assert run.summary["title"] == scene["title"] and repr(run)
"""
    script = script.replace("PATH", ascii([str(Path(__file__).parent), *sys.path]))
    environment = os.environ | {"LC_ALL": "C", "PYTHONUTF8": "0", "PYTHONCOERCECLOCALE": "0"}
    subprocess.run([sys.executable, "-c", script], check=True, env=environment)


def test_long_changes_and_keys_that_options_cannot_say(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    scene = midplane.Scene("scene.json")
    scene["output.history.a=b"] = "joint.resultant_t"
    run = scene.run(progress=False)
    assert run.history["a=b"].equals(run.history["force"])
    step = content()["steps"][1] | {"increments": 1}
    scene["steps"] = [content()["steps"][0], *({**step, "name": f"push {number}"} for number in range(600))]
    assert len(scene.run(progress=False).history) == 602
