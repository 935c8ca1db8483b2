"""A scene and a mesh turned, and turned back."""

import math
import struct

import numpy as np
import pytest

from midplane_pipeline.trade.move import ALONG, MOST, moved, offset, turn
from midplane_pipeline.trade.turn import Turn, taken

CLAMPED = {
    "steps": [
        {
            "name": "push",
            "increments": 3,
            "fix": {"left.end": ["x", "y"]},
            "displace": {"right.end": {"x": 0.01, "y": -0.002}},
            "load": {"right.top": {"traction": [1.0, -2.0]}, "right.hole": {"pressure": "3*x + y"}},
        }
    ]
}
ROLLERS = {"steps": [{"name": "press", "fix": {"base.bottom": ["y"], "base.left": ["x"]}, "load": {"base.top": {"pressure": 2.0}}}]}


def test_a_clamped_scene_turns_by_30_degrees_and_one_on_rollers_by_90():
    assert Turn(CLAMPED).degrees == 30
    assert Turn(ROLLERS).degrees == 90


@pytest.mark.parametrize("scene", [CLAMPED, ROLLERS])
def test_vectors_turn_and_turn_back(scene):
    there = Turn(scene)
    for x, y in ((1.0, 0.0), (-0.3, 2.0)):
        turned = there.vector(x, y)
        assert math.hypot(*turned) == pytest.approx(math.hypot(x, y))
        assert there.back(*turned) == pytest.approx((x, y), abs=1e-15)


@pytest.mark.parametrize(("scene", "times"), [(CLAMPED, 12), (ROLLERS, 4)])
def test_a_step_that_is_turned_all_around_is_as_it_was(scene, times):
    there, step = Turn(scene), scene["steps"][0]
    whole = {"displace": {}} | step
    for _ in range(times):
        step = there.step(step)
    assert {group: sorted(held) for group, held in step["fix"].items()} == {group: sorted(held) for group, held in whole["fix"].items()}
    for group, given in whole["displace"].items():
        assert step["displace"][group] == pytest.approx(given)
    for group, load in whole["load"].items():
        if "traction" in load:
            assert step["load"][group]["traction"] == pytest.approx(load["traction"])
    assert step.get("increments") == whole.get("increments")


def test_rollers_go_to_the_other_direction():
    step = Turn(ROLLERS).step(ROLLERS["steps"][0])
    assert step["fix"] == {"base.bottom": ["x"], "base.left": ["y"]}
    assert step["load"]["base.top"]["pressure"] == 2.0


def test_formulas_have_at_the_turned_place_what_they_had():
    there = Turn(CLAMPED)
    for x, y in ((0.4, -0.7), (2.0, 1.0)):
        new = dict(zip("xy", there.vector(x, y), strict=True))
        assert eval(there.formula("3*x + y"), new) == pytest.approx(3 * x + y)
        assert eval(there.measure({"exact": ["x*y", 0]})["exact"][0], new) == pytest.approx(x * y)
        field = [eval(text, new) for text in there.vector("x + 1", "y*y")]
        assert field == pytest.approx(there.vector(x + 1, y * y))


def test_columns_are_read_in_the_old_axes():
    there = Turn(CLAMPED)
    x, y = np.array([1.0, 2.0]), np.array([0.0, -1.0])
    columns = dict(zip(("a.top.displacement_x", "a.top.displacement_y"), np.transpose([there.vector(*pair) for pair in zip(x, y, strict=True)]), strict=True))
    assert there.along(columns, "a.top.displacement_y") == pytest.approx(y)
    assert there.columns("a.top.displacement_y") == list(columns)
    assert taken({"take": "last"}, [1.0, -3.0, 2.0]) == 2.0
    assert taken({"take": "peak"}, [1.0, -3.0, 2.0]) == -3.0


def test_what_is_not_turned_yet_is_told():
    with pytest.raises(ValueError, match="gravity"):
        Turn(CLAMPED).step({"name": "weight", "gravity": [0, -9.81]})


def mesh(points):
    """A binary MSH 4.1 with a block of nodes, and something behind it."""
    nodes = struct.pack("=QQQQ", 1, len(points), 1, len(points)) + struct.pack("=iiiQ", 2, 1, 0, len(points))
    nodes += struct.pack(f"={len(points)}Q", *range(1, len(points) + 1)) + np.asarray(points, "=f8").tobytes()
    return b"$MeshFormat\n4.1 1 8\n" + struct.pack("=i", 1) + b"\n$EndMeshFormat\n$Nodes\n" + nodes + b"\n$EndNodes\n$Elements\nx\n$EndElements\n"


POINTS = [[0.0, 0.0, 0.0], [1.0, 0.25, 0.0], [-2.0, 3.0, 0.5]]


def test_nodes_turn_and_turn_back_and_nothing_else_changes():
    data, angle = mesh(POINTS), math.radians(30)
    there = moved(data, turn(math.cos(angle), math.sin(angle)))
    start = data.index(np.asarray(POINTS, "=f8").tobytes())
    places = np.frombuffer(there, "=f8", 9, start).reshape(3, 3)
    assert places[1, :2] == pytest.approx([math.cos(angle) - 0.25 * math.sin(angle), math.sin(angle) + 0.25 * math.cos(angle)])
    assert places[:, 2].tolist() == [0.0, 0.0, 0.5]
    assert (there[:start], there[start + 72 :]) == (data[:start], data[start + 72 :])
    back = np.frombuffer(moved(there, turn(math.cos(angle), -math.sin(angle))), "=f8", 9, start).reshape(3, 3)
    assert back == pytest.approx(np.array(POINTS), abs=1e-15)
    with pytest.raises(ValueError, match="binary mesh"):
        moved(b"$MeshFormat\n4.1 0 8\n", turn(1, 0))


@pytest.mark.parametrize("scene", ["strip", "cook", "ring", "dcb"])
def test_nodes_move_along_the_joint_by_less_than_their_distance(scene):
    to_local, to_global = ALONG[scene]
    s = np.linspace(0, 1, 9)
    x, y = to_global(s, 0.0 * s + 1.0)
    move = offset(scene, 8, 1, "lower")
    new, t = to_local(*move(x, y))
    assert np.abs(new - s).max() <= MOST / 8 * (1 + 1e-9)
    assert np.abs(new - s).max() > 0.01 / 8
    assert (np.diff(new) > 0).all()
    assert (new[[0, -1]], t) == (pytest.approx([0, 1], abs=1e-12), pytest.approx(np.ones(9)))
    assert np.array_equal(move(x, y), offset(scene, 8, 1, "lower")(x, y))
    assert not np.array_equal(move(x, y), offset(scene, 8, 2, "lower")(x, y))
