"""Texts beside the points they belong to, where the fewest curves run."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.patheffects import AbstractPathEffect, withStroke

from ..vtu import Array
from .page import GREY

Side = tuple[int, int]

CORNERS: list[Side] = [(1, 1), (1, -1), (-1, 1), (-1, -1)]
AROUND: list[Side] = [*CORNERS, (1, 0), (-1, 0), (0, 1), (0, -1)]
HALO: list[AbstractPathEffect] = [withStroke(linewidth=1.5, foreground="white")]


def in_axes(axis: Axes, x: Any, y: Any) -> Array:
    """Points of the data in parts of the axes."""
    axis.autoscale_view()
    data = np.column_stack([np.asarray(x, float), np.asarray(y, float)])
    return np.asarray(axis.transAxes.inverted().transform(axis.transData.transform(data)))


def along(path: Array) -> Array:
    """A path of points in parts of the axes, with points between."""
    return np.linspace(path[:-1], path[1:], 20).reshape(-1, 2)


def place_label(
    axis: Axes,
    dot: Array,
    text: str,
    taken: Array,
    size: float = 8.0,
    away: float = 2.5,
    sides: Sequence[Side] = CORNERS,
    leader: bool = False,
    **look: Any,
) -> Array:
    """A text beside its dot where the fewest points are taken; all that are taken then. Places are parts of the axes."""
    figure: Any = axis.figure
    point = 1 / (72 * np.asarray(axis.get_window_extent().size) / figure.dpi)  # in parts of the axes
    half = size * np.array([0.3 * len(text), 0.6]) * point

    def middle(side: Side) -> Array:
        return np.asarray(dot + np.array(side) * (half + away * point))

    def crowd(side: Side) -> float:
        off = np.abs(taken - middle(side)) / half
        outside = (np.abs(middle(side) - 0.5) + half > 0.52).any()
        crowded = (off < 1).all(axis=1).sum() + 0.1 * (off < 2).all(axis=1).sum() + 1000 * outside
        return float(crowded)

    best = middle(min(sides, key=crowd))
    place: dict[str, Any] = {"transform": axis.transAxes, "ha": "center", "va": "center", "fontsize": size, "zorder": 6}
    axis.text(best[0], best[1], text, path_effects=HALO, **place, **look)
    box = np.stack(np.meshgrid(*np.linspace(best - half, best + half, 8).T), axis=-1).reshape(-1, 2)
    if leader:
        foot = np.clip(dot, best - half, best + half)
        axis.plot(*np.array([dot, foot]).T, transform=axis.transAxes, color=GREY, linewidth=0.7, zorder=2)
    return np.concatenate([taken, np.repeat(box, 20, axis=0)])
