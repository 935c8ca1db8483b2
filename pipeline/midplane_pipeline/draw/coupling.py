"""The picture of how an interface is joined: side A below, side B above, between them segments, grid and law points."""

from collections.abc import Callable
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from midplane.pictures import page
from midplane.pictures.page import BLUE, FACE, GREEN, INK, PALE, VERMILLION, WIDTH, sign
from midplane.pictures.plane import Page
from midplane.pictures.results import Results, View
from midplane.vtu import Array

FEW = 60  # segments that one picture of a line can show; a closed one is shown all


def draw_coupling(results: Results, name: str, title: str, view: View) -> None:
    """Side A below, side B above, pulled apart; between them segments, grid and law points."""
    midplane = results.midplane(name)
    points, segments, cells, parents = midplane.points, midplane.segments, midplane.cells, midplane.parents
    law_points = results.interfaces[name].points[:, :2]
    pull = Pull(points[segments], np.ptp(points, axis=0).max())
    lay = (lambda places: places) if pull.closed else lying(points[segments[0, 0]], points[segments[-1, 1]])
    points = lay(points)
    shown = segments if pull.closed else segments[:FEW]
    (x0, y0), (x1, y1) = points[shown].min(axis=(0, 1)), points[shown].max(axis=(0, 1))
    gap, depth, air = 0.13 * (x1 - x0), 0.14 * (x1 - x0), 0.03 * (x1 - x0)
    if pull.closed:
        air = gap / 2 + depth
    pull.size = x1 - x0

    edges_a, edges_b = (len(np.unique(column)) for column in parents.T)
    subtitle = (
        f"coupling of {name}: {edges_a} edges of A and {edges_b} of B make {len(segments)} segments, "
        + (f"{len(cells)} cells of the grid, " if len(cells) else "")
        + f"{len(law_points)} law points"
    )
    bounds = (x0 - air, x1 + air), (y0 - gap / 2 - depth, y1 + gap / 2 + depth)
    sheet = Page(bounds, title, subtitle)
    part = f": the first {len(shown)} segments" if len(shown) < len(segments) else ""
    if pull.closed:
        sheet.label(view.length)
    else:
        sheet.axis.set(xlabel=f"distance from @0 of {name} [{view.length}]{part}", yticks=[])
        sheet.axis.spines["left"].set_visible(False)

    parts = []
    for subdomain, shift in zip(results.sides(name), (-gap / 2, gap / 2), strict=True):
        mesh = results.subdomains[str(subdomain)].copy()
        mesh.points[:, :2] = pull(lay(mesh.points[:, :2]), shift)
        parts.append(mesh)
    sheet.render(parts, "#9A9A97", color=FACE)
    nodes: dict[str, Any] = {"marker": "o", "markersize": 3.6, "linestyle": "--", "linewidth": 0.7}
    for column, colour, shift in ((0, BLUE, -gap / 2), (1, VERMILLION, gap / 2)):
        for foot in points[ends_of_edges(segments, parents[:, column])]:
            line = np.array([foot, pull(foot, shift)]).T
            sheet.axis.plot(*line, color=colour, markevery=[1], zorder=3, **nodes)
    draw_midplane(sheet.axis, points, segments, cells, 0.06 * gap)
    dots: dict[str, Any] = {"linestyle": "", "marker": "o", "markeredgecolor": "white", "markeredgewidth": 0.5}
    size = np.clip(40 * WIDTH / len(law_points), 2.2, 4.2)
    sheet.axis.plot(*lay(law_points).T, color=GREEN, markersize=size, zorder=7, **dots)

    post: dict[str, Any] = {"linestyle": "", "marker": "|", "markersize": 9, "markeredgewidth": 1.6}
    keys = [
        sign("nodes of B", VERMILLION, **nodes),
        sign("nodes of A", BLUE, **nodes),
        sign("segments", PALE, linewidth=6),
        *([sign("grid", INK, **post)] if len(cells) else []),
        sign("law points", GREEN, markersize=4.8, **dots),
    ]
    sheet.key(keys)
    page.save(sheet.figure, results.pictures / f"coupling_{name}.png")


def lying(start: Array, end: Array) -> Callable[[Array], Array]:
    """The map that lays a mid-plane from start to end along the first axis."""
    along = (end - start) / np.linalg.norm(end - start)
    rotation = np.array([along, [-along[1], along[0]]])
    return lambda points: (points - start) @ rotation.T


class Pull:
    """The map that pulls a side off the mid-plane: straight up, or out of the middle where it is closed."""

    def __init__(self, lines: Array, size: float) -> None:
        starts = lines[:, 0]
        self.closed = bool(np.linalg.norm(lines[-1, 1] - lines[0, 0]) < 1e-6 * size)
        self.centre, self.size = starts.mean(axis=0), size
        x, y = (starts - self.centre).T
        self.outward = -np.sign(x @ np.roll(y, -1) - y @ np.roll(x, -1))  # n is on the left of C

    def __call__(self, points: Array, shift: float) -> Array:
        """Points of a side, pulled by a shift."""
        if not self.closed:
            return np.add(points, (0, shift))
        return self.centre + (points - self.centre) * (1 + self.outward * shift / (0.5 * self.size))


def ends_of_edges(segments: Array, parents: Array) -> Array:
    """Points where the nodes of a side meet the mid-plane: there the parent edge changes."""
    change = np.flatnonzero(np.diff(parents)) + 1
    return np.concatenate([segments[[0], 0], segments[change, 0], segments[[-1], 1]])


def draw_midplane(axis: Axes, points: Array, segments: Array, cells: Array, half: float) -> None:
    """Segments as a bar with white joints, ends of grid cells as posts across it."""
    axis.add_collection(LineCollection(list(points[segments]), colors=PALE, linewidths=6, zorder=5), autolim=False)
    post = np.array([[0, -half], [0, half]])
    joints = points[segments[1:, :1]] + post
    axis.add_collection(LineCollection(list(joints), colors="white", linewidths=1.2, zorder=5), autolim=False)
    posts = points[np.unique(cells)][:, None] + 2 * post
    axis.add_collection(LineCollection(list(posts), colors=INK, linewidths=1.6, zorder=6), autolim=False)
