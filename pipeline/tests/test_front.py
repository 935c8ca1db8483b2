"""The Pareto front on made-up points."""

import math

import pytest

from midplane_pipeline.trade.compare import ratios, repeatability, together
from midplane_pipeline.trade.front import candidates, common, error_of, fastest_within, front, label, next_knob, once, spread, tie


def point(name, time, error, times=None, **more):
    return {"settings": [name], "labels": {"knob": name}, "time": time, "error": error, "times": times or [time]} | more


CLOUD = [
    point("fast", 1.0, 0.3),
    point("middle", 2.0, 0.05),
    point("beaten", 2.5, 0.2),
    point("slow", 8.0, 0.001),
    point("useless", 9.0, 0.05),
    point("failed", 0.1, None),
]


def names(rows):
    return [row["settings"][0] for row in rows]


def test_the_front_goes_from_fast_to_accurate():
    assert names(front(CLOUD, 0.0, 0.0)) == ["fast", "middle", "slow"]
    assert names(front(CLOUD[::-1], 0.0, 0.0)) == ["fast", "middle", "slow"]


def test_every_point_is_on_the_front_or_beaten_by_one_that_is():
    chosen = front(CLOUD, 0.0, 0.0)
    for row in CLOUD:
        if row["error"] is not None and row not in chosen:
            assert any(other["time"] <= row["time"] and other["error"] <= 1.01 * row["error"] for other in chosen)


def test_of_a_tie_the_more_accurate_is_on_the_front():
    rows = [point("a", 1.00, 0.3), point("b", 1.04, 0.1), point("c", 2.0, 0.05)]
    assert names(front(rows, 0.0, 0.1)) == ["b", "c"]
    assert names(front(rows, 0.0, 0.01)) == ["a", "b", "c"]


def test_errors_below_what_the_reference_knows_are_the_same():
    rows = [point("a", 1.0, 2e-6), point("b", 5.0, 1e-9)]
    assert names(front(rows, 1e-6, 0.0)) == ["a"]
    assert names(front(rows, 1e-10, 0.0)) == ["a", "b"]
    assert error_of(rows[1], 1e-6) == pytest.approx(3e-6)
    assert error_of(CLOUD[-1], 0.0) == math.inf


def test_candidates_are_those_that_noise_may_put_on_the_front():
    assert names(candidates(CLOUD, 0.0, 0.0)) == ["fast", "middle", "slow"]
    assert names(candidates(CLOUD, 0.0, 0.3)) == ["fast", "middle", "beaten", "slow"]


def test_a_setting_counts_once():
    again = CLOUD[0] | {"time": 7.0}
    assert sorted(row["time"] for row in once([CLOUD[0], CLOUD[1], again])) == [1.0, 2.0]


def test_repeats_have_a_spread_and_a_tie():
    row = point("a", 1.0, 0.1, times=[1.0, 1.2, 1.6])
    assert spread(row) == pytest.approx(0.5)
    assert tie(row) == pytest.approx(0.2)


def test_the_next_digit_names_the_knob_that_moves():
    assert fastest_within(CLOUD, 0.1)["settings"] == ["middle"]
    assert next_knob(CLOUD, 0.05) == ("knob", 4.0)
    assert next_knob(CLOUD, 1e-3) == ("none left", None)
    assert next_knob(CLOUD, 1e-9) == ("none left", None)
    assert label(CLOUD[0]) == "knob fast"
    assert label({"labels": {}}) == "the scene as it is"


def test_one_setting_for_all_scenes_is_good_on_every_one():
    def scene(fine, coarse):
        rows = [("1", "Q8", 1.0, coarse), ("2", "Q8", 3.0, fine), ("2", "T6", 2.0, 0.5)]
        return {"points": [{"phase": "factorial", "labels": {"refinement": r, "element": e}, "time": t, "error": x} for r, e, t, x in rows]}

    scenes = {"one": scene(0.001, 0.005), "two": scene(0.002, 0.05)}
    assert common(scenes, 0.1)[0] == ("1", "Q8")
    assert common(scenes, 0.01)[0] == ("2", "Q8")
    assert common(scenes, 1e-6) is None


def test_two_measurements_are_compared_at_the_errors_of_a_front():
    first = [point("a", 1.0, 0.3, [1.0, 1.1]), point("b", 2.0, 0.05, [2.0, 2.2])]
    second = [point("a", 1.1, 0.3, [1.1, 1.2]), point("b", 4.0, 0.05, [4.0, 4.1])]
    assert ratios(first, first, second, 0.0) == pytest.approx([1.1, 2.0])
    assert ratios([point("c", 1.0, 1e-3)], first, second, 0.0) == [math.inf]
    both = [together(a, b) for a, b in zip(first, second, strict=True)]
    assert both[0]["time"] == 1.0
    assert both[0]["times"] == [1.0, 1.1, 1.1, 1.2]
    found = repeatability(first, [first, second], both, 0.0)
    assert (found["points"], found["repeated"], found["agree"]) == (2, 2, 1)
