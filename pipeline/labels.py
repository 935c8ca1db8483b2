"""Texts beside the points they belong to, where the fewest curves run."""

import numpy as np
from matplotlib.patheffects import withStroke

from page import GREY

CORNERS = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
AROUND = [*CORNERS, (1, 0), (-1, 0), (0, 1), (0, -1)]
HALO = [withStroke(linewidth=1.5, foreground="white")]


def in_axes(axis, x, y):
    """Points of the data in parts of the axes."""
    axis.autoscale_view()
    data = np.column_stack([np.asarray(x, float), np.asarray(y, float)])
    return axis.transAxes.inverted().transform(axis.transData.transform(data))


def along(path):
    """A path of points in parts of the axes, with points between."""
    return np.linspace(path[:-1], path[1:], 20).reshape(-1, 2)


def place_label(axis, dot, text, taken, size=8.0, away=2.5, sides=CORNERS, leader=False, **look):
    """A text beside its dot where the fewest points are taken; all that are taken then. Places are parts of the axes."""
    point = 1 / (72 * axis.get_window_extent().size / axis.figure.dpi)  # in parts of the axes
    half = size * np.array([0.3 * len(text), 0.6]) * point

    def middle(side):
        return dot + np.array(side) * (half + away * point)

    def crowd(side):
        off = np.abs(taken - middle(side)) / half
        outside = (np.abs(middle(side) - 0.5) + half > 0.52).any()
        return (off < 1).all(axis=1).sum() + 0.1 * (off < 2).all(axis=1).sum() + 1000 * outside

    best = middle(min(sides, key=crowd))
    place = {"transform": axis.transAxes, "ha": "center", "va": "center", "fontsize": size, "zorder": 6}
    axis.text(*best, text, path_effects=HALO, **place, **look)
    box = np.stack(np.meshgrid(*np.linspace(best - half, best + half, 8).T), axis=-1).reshape(-1, 2)
    if leader:
        foot = np.clip(dot, best - half, best + half)
        axis.plot(*np.array([dot, foot]).T, transform=axis.transAxes, color=GREY, linewidth=0.7, zorder=2)
    return np.concatenate([taken, np.repeat(box, 20, axis=0)])
