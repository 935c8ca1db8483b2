"""Maps of the pictures: sides laid out and pulled apart, hyperbolas, runs of numbers."""

import numpy as np
import pytest

from midplane_pipeline.draw.coupling import Pull, ends_of_edges, lying
from midplane_pipeline.draw.law import hyperbola, listed
from midplane_pipeline.draw.view_options import parse_zoom


def test_a_straight_side_is_pulled_up():
    lines = np.array([[[0.0, 0.0], [1.0, 0.0]], [[1.0, 0.0], [2.0, 0.0]]])
    pull = Pull(lines, 2.0)
    assert not pull.closed
    assert pull(np.array([[0.5, 0.1], [1.0, 0.2]]), 0.3).tolist() == pytest.approx(np.array([[0.5, 0.4], [1.0, 0.5]]))


@pytest.mark.parametrize(("way", "grows"), [(1, -1), (-1, 1)])
def test_a_closed_side_is_pulled_along_its_normal(way, grows):
    angles = way * np.linspace(0, 2 * np.pi, 41)
    points = np.column_stack([3 + np.cos(angles), np.sin(angles)])
    pull = Pull(np.stack([points[:-1], points[1:]], axis=1), 2.0)
    assert pull.closed
    radius = np.hypot(*(pull(points, 0.1) - pull.centre).T)
    assert radius == pytest.approx(1 + 0.1 * grows, rel=1e-9)  # n is on the left: outwards where it runs clockwise


def test_an_interface_lies_along_the_first_axis():
    start, end = np.array([1.0, 1.0]), np.array([4.0, 5.0])
    lay = lying(start, end)
    assert lay(np.array([start, end, [1 - 0.8, 1 + 0.6]])) == pytest.approx(np.array([[0, 0], [5, 0], [0, 1.0]]))


def test_nodes_of_a_side_are_where_its_edges_change():
    segments = np.array([[0, 1], [1, 2], [2, 3]])
    assert ends_of_edges(segments, np.array([7, 7, 8])).tolist() == [0, 2, 3]


def test_the_hyperbola_begins_at_the_strength():
    row = {"tensile_strength": 2.0, "cohesion": 4.0, "tan_friction": 0.7}
    tau = hyperbola(row, np.array([2.0, -3.0, 2.1]))
    assert tau[0] == 0
    assert tau[1] == pytest.approx(np.sqrt((4 + 2.1) ** 2 - (4 - 1.4) ** 2))
    assert np.isnan(tau[2])


def test_numbers_in_a_row_are_listed_as_one():
    assert listed([0, 3, 4, 5, 8, 9]) == "0, 3–5, 8, 9"


def test_a_zoom_has_two_ends_each_way():
    assert parse_zoom("0:1:-2:3") == ((0, 1), (-2, 3))
    for text in ("1:0:0:1", "0:1", "a:b:c:d"):
        with pytest.raises(Exception, match="is not"):
            parse_zoom(text)
