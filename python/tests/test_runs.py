"""Runs that are watched, interrupted, gone on with; studies and laws."""

from __future__ import annotations

import json
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
import pytest
from conftest import PRESSURE, content

import midplane

LONG = 3000  # increments of a run that is interrupted


def long(scene: midplane.Scene) -> midplane.Scene:
    scene["steps.1.increments"] = LONG
    return scene


def test_a_run_of_a_file_is_that_of_the_program(place: Path) -> None:
    (place / "scene.json").write_text(json.dumps(content()))
    run = midplane.Scene(place).run(progress=False)
    assert run.folder == Path("results") / place.name
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
    rows = 0
    while run.running and rows < 3:
        time.sleep(0.02)
        if (run.folder / "history.csv").is_file():
            rows = len(run.history)
    assert 3 <= rows <= LONG
    assert run.running
    assert run.interface("joint")["traction_n"].notna().all()
    assert run.fields[-1].keys() == ["lower", "upper", "joint"]
    assert "goes on" in repr(run)
    run.stop()
    assert not run.running
    assert 3 <= len(run.history) < LONG


def test_an_interrupted_run_goes_on_to_the_same_end(scene: midplane.Scene) -> None:
    scene["steps.1.increments"] = 400
    whole = scene.run("whole", progress=False)
    run = scene.run("part", progress=False, wait=False)
    while not (run.folder / "history.csv").is_file() or len(run.history) < 3:
        time.sleep(0.01)
    run.stop()
    assert len(run.history) < len(whole.history)
    again = midplane.Run("part").resume(progress=False)
    assert again.history.equals(whole.history)


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
    until = time.monotonic() + 30
    while time.monotonic() < until:
        try:
            run = midplane.Scene(content(), folder=place).run(place / "out", progress=False)
        except midplane.MachineError:
            time.sleep(0.1)
            continue
        assert len(run.history) == 8
        return
    raise AssertionError("a run of a dead kernel is still at work")


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
