"""Draws the curves of a row."""

from itertools import cycle
from pathlib import Path
from typing import Any

import matplotlib.pyplot as pyplot
import numpy as np
from midplane.pictures import page

from .row import Curve

FLOOR = 1e-18  # what is exactly zero is drawn here


def draw(curve: Curve, path: Path) -> None:
    """One graph, both axes logarithmic unless x is not positive."""
    pyplot.rcParams.update(page.STYLE)
    figure, (axis,) = page.graphs(1, 3.6)
    looks = cycle(zip(page.RUNS, page.MARKERS, strict=True))
    for (label, x, y), (colour, marker) in zip(curve.series, looks, strict=False):
        y = np.maximum(np.abs(np.asarray(y, float)), FLOOR)
        axis.plot(x, y, color=colour, marker=marker, markersize=3.2, linewidth=1.2, label=label)
    if curve.line is not None:
        look: dict[str, Any] = {"color": page.GREY, "linestyle": page.DASHES, "linewidth": 0.9}
        axis.axhline(curve.line, label=f"limit {curve.line:g}", **look)
    axis.set_yscale("log")
    if all(np.min(x) > 0 for _, x, _ in curve.series):
        axis.set_xscale("log")
    axis.set(xlabel=curve.x_label, ylabel=curve.y_label)
    axis.grid(axis="y")
    page.heading(axis, curve.title, "")
    page.key_below(figure, axis.get_legend_handles_labels()[0])
    page.save(figure, path)
