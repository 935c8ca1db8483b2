"""What is known of a scene, statics and energies, on rows made by hand."""

from types import SimpleNamespace

import numpy as np
import pytest
import pyvista

from midplane_pipeline.check.energies import check_energies
from midplane_pipeline.check.faults import Faults
from midplane_pipeline.check.known import Every, Expected, Formula, Like, argument, value_of
from midplane_pipeline.check.statics import check_balance, resultant
from midplane_pipeline.draw.history import deviation, difference_at_the_end

ROWS = [
    {"step": "press", "force": 1.0, "u": 0.0},
    {"step": "press", "force": 4.0, "u": 1.0},
    {"step": "pull", "force": 3.0, "u": 2.0},
]


@pytest.mark.parametrize(
    ("text", "row", "value"),
    [
        ("force*2 - u**2", {"force": 3.0, "u": 2.0}, 2.0),
        ("max(force, u, 0) / sqrt(4)", {"force": 3.0, "u": 9.0}, 4.5),
        ("-'reaction:a:x' + abs(u)", {"reaction:a:x": -2.0, "u": -1.0}, 3.0),
    ],
)
def test_formulas_of_columns(text, row, value):
    assert Formula(text)(row) == pytest.approx(value)


@pytest.mark.parametrize("text", ["__import__('os')", "force.real", "force if u else 1", "[1]"])
def test_what_is_no_formula_is_refused(text):
    with pytest.raises(ValueError, match="no part of a formula"):
        Formula(text)


def test_values_of_a_history():
    assert value_of("force", ROWS, {}) == 3.0
    assert value_of("max:force", ROWS, {}) == 4.0
    assert value_of("min:u", ROWS, {}) == 0.0
    assert value_of("force@end:press", ROWS, {}) == 4.0
    assert value_of("force@u=0.25", ROWS, {}) == pytest.approx(1.75)
    assert value_of("force@u=3", [*ROWS, {"step": "pull", "force": 5.0, "u": 4.0}], {}) == pytest.approx(4.0)
    assert value_of("nothing", ROWS, {}) is None
    field = {"length": np.array([0.1, 0.2, 0.3]), "status": np.array([0, 4, 4])}
    assert value_of("joint#4", ROWS, {"joint": field}) == pytest.approx(0.5)


def test_a_peak_between_rows_is_that_of_the_parabola():
    rows = [{"step": "pull", "u": u, "force": 5 - (u - 1.3) ** 2} for u in (0.0, 1.0, 2.0)]
    assert value_of("u@max:force", rows, {}) == pytest.approx(1.3)


def test_expectations_are_met_or_told():
    faults = Faults()
    Expected.parse("force=3~0.1").check("here", ROWS, {}, faults)
    Expected.parse("max:force=3.5:4").check("here", ROWS, {}, faults)
    Like.parse("other:force~1e-3").check("here", ROWS, lambda _: ROWS, faults)
    Every.parse("u=u*1~1e-12@pull").check("here", ROWS, faults)
    assert faults == []
    Expected.parse("force=3.2~0.1").check("here", ROWS, {}, faults)
    Like.parse("other:force~1e-3").check("here", ROWS, lambda _: ROWS[:2], faults)
    Every.parse("force=4*u~1e-12").check("here", ROWS, faults)
    Every.parse("none=u~1").check("here", ROWS, faults)
    assert [fault.partition(": ")[2].split()[0] for fault in faults] == ["force", "force", "force", "no"]
    with pytest.raises(Exception, match="is not"):
        argument(Expected)("force")


def law_points(traction):
    """Four law points along y = 0 from 0 to 1, n upwards."""
    x = np.array([0.125, 0.375, 0.625, 0.875])
    grid = pyvista.PolyData(np.column_stack([x, 0 * x, 0 * x]))
    grid["normal"] = np.tile([0.0, 1.0, 0.0], (4, 1))
    grid["length"] = np.full(4, 0.25)
    grid["traction"] = np.asarray(traction(x), float).T
    grid["jump"] = np.zeros((4, 2))
    return grid


def test_the_resultant_of_tractions_and_its_moment():
    grid = law_points(lambda x: [-(2 + x), 0 * x + 0.5])
    # n = y, t = x
    assert resultant(grid, 2.0)[:2] == pytest.approx([2 * 0.5, -2 * 2.5])
    assert resultant(grid, 2.0)[2] == pytest.approx(-2 * 0.25 * (grid.points[:, 0] * (2 + grid.points[:, 0])).sum())


def summary(load=-1.0):
    def own(load, reaction):
        return {"load": [0.0, load], "reaction": [0.0, reaction], "moment": [0.5 * load, 0.5 * reaction]}

    return {
        "equilibrium": {**own(load, 1.0), "subdomains": {"a": own(0.0, 1.0), "b": own(load, 0.0)}},
        "sizes": {"interfaces": {"joint": {"subdomains": ["a", "b"], "length": 1.0}}},
    }


def test_forces_balance_on_the_whole_and_on_every_body():
    scene = {"interfaces": {"joint": {"law": {"normal_stiffness": 1e5}}}}
    rows = [{"residual": 1e-12, "reaction:a.bottom:y": 1.0}]
    faults, fields = Faults(), {"joint": law_points(lambda x: [0 * x - 1.0, 0 * x])}
    assert check_balance("here", scene, summary(), rows, fields, faults) == (pytest.approx(0, abs=1e-15), pytest.approx(0, abs=1e-15))
    assert faults == []
    check_balance("here", scene, summary(-1.001), rows, fields, faults)
    assert any("loads and reactions leave" in fault for fault in faults)
    faults.clear()
    check_balance("here", scene, summary(), rows, {"joint": law_points(lambda x: [-0.9 - 0 * x, 0 * x])}, faults)
    assert len([fault for fault in faults if "interface tractions on" in fault]) == 2


PULLED = {
    "steps": [{"name": "pull", "displace": {"b.top": {"y": 2e-3}}}],
    "interfaces": {"joint": {}},
    "subdomains": {"a": {}},
    "output": {"history": {"work": "work.external", "stored": "energy.stored", "lost": "energy.dissipated", "gone": "energy.released"}},
}


def spring(factor=1.0, lost=0.0, gone=0.0):
    """A spring of 5 MN/m, pulled by 2 mm in four increments; shares of its work that are dissipated and released."""
    rows = []
    for k in range(1, 5):
        u = 5e-4 * k
        row = {"step": "pull", "load_factor": k / 4, "reaction:b.top:y": 5 * u, "work": factor * 2.5 * u**2}
        shares = {"stored": 1 - lost - gone, "lost": lost, "gone": gone}
        rows.append(row | {name: share * row["work"] for name, share in shares.items()} | {"energy_balance": 0.0})
    return rows


def test_the_work_of_a_spring_is_that_of_its_forces(tmp_path):
    faults, told = Faults(), {"solution": {"snaps": []}}
    said = check_energies("here", PULLED, tmp_path, told, spring(), 1e-8, faults)
    assert faults == []
    assert "in 4 increments" in said
    check_energies("here", PULLED, tmp_path, told, spring(lost=0.3, gone=0.2), 1e-8, faults)
    assert faults == []
    check_energies("here", PULLED, tmp_path, told, spring(1.05), 1e-8, faults)
    assert any("work is off" in fault for fault in faults)
    faults.clear()
    rows = spring()
    rows[2]["lost"] = 0.1 * rows[2]["work"]
    check_energies("here", PULLED, tmp_path, told, rows, 1e-8, faults)
    assert any("energies leave" in fault for fault in faults)


def test_how_far_a_run_is_off_a_curve():
    solution = SimpleNamespace(history={"u": np.array([0.0, 1.0, 2.0]), "f": np.array([0.0, 4.0, 0.0])})
    run = {"u": np.array([0.5, 1.5]), "f": np.array([2.0, 2.0])}
    assert deviation(run, solution, "u", "f") == pytest.approx(0, abs=1e-15)
    off = {"u": np.array([1.0]), "f": np.array([4.4])}
    assert deviation(off, solution, "u", "f") == pytest.approx(0.1)
    rising = SimpleNamespace(history={"u": np.array([0.0, 1.0, 2.0]), "f": np.array([0.0, 4.0, 8.0])})
    assert difference_at_the_end({"u": np.array([1.1]), "f": np.array([4.0])}, rising, "u", "f") == pytest.approx(0.1)
