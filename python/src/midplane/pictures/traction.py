"""The picture of both components of the traction along an interface."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure

from ..vtu import Array
from . import page
from .page import DASHES, GREEN, GREY, INK, MARKERS, PALE, RUNS
from .results import Results, Runs, View

Exact = Sequence[tuple[str, Sequence[float] | None, Sequence[float]]]  # component, places or None for all of the interface, values


def draw_along(results: Results, name: str, law: Mapping[str, Any] | None, label: str, others: Runs, exact: Exact, title: str, view: View) -> Figure:
    """Normal and tangential traction along one interface, beside those of other runs and exact values.

    Where the law is Coulomb's its limit is drawn too: there the joint slips.
    """
    figure, axes = page.graphs(2, 4.2)
    runs = [(label, results), *((text, run) for text, run in others if name in run.interfaces)]
    for order, (text, run) in enumerate(runs):
        s = distances(run, name)
        size = 2.3 if len(s) < 300 else 1.2
        for axis, component in zip(axes, (0, 1), strict=True):
            look: dict[str, Any] = {"linewidth": 1.0, "marker": MARKERS[order % len(MARKERS)], "markersize": size, "zorder": 5 - 0.1 * order}
            axis.plot(s, run.interfaces[name]["traction"][:, component], color=RUNS[order % len(RUNS)], label=text, **look)
    field, midplane = results.interfaces[name], results.midplane(name)
    draw_water(axes[0], field, distances(results, name) if len(runs) == 1 else None)
    for name_of, places, values in exact:
        look = {"color": PALE, "linewidth": 5, "solid_capstyle": "butt", "zorder": 1}
        axes["nt".index(name_of)].plot([0.0, midplane.length] if places is None else places, values, label="exact", **look)
    if law is not None and law.get("type") == "coulomb":
        draw_limit(axes[1], results, name, law)
    size = float(np.abs(field["traction"]).max()) or 1.0
    for axis, text in zip(axes, ("normal $t_n$", "tangential $t_t$"), strict=True):
        axis.set(xlim=(0, midplane.length))
        axis.grid(axis="y")
        axis.axhline(0, color=GREY, linewidth=0.6, zorder=0.5)
        with_zero(axis, size)
        axis.locator_params(axis="x", nbins=8)
        page.scale_axis(axis.yaxis, f"{text} [{view.stress}]", float(np.abs(axis.get_ylim()).max()))
    page.scale_axis(axes[1].xaxis, f"distance along {name} [{view.length}]", midplane.length)
    start, end = (f"@{k} {place_text(place, midplane.points)}" for k, place in enumerate((midplane.start, midplane.end)))
    page.mark_ends(axes[1], start, end)
    handles = {line.get_label(): line for axis in axes for line in axis.get_legend_handles_labels()[0]}
    if len(handles) > 1:
        page.key_below(figure, list(handles.values()))
    figure.align_ylabels(axes)
    page.heading(axes[0], title, f"traction along {name} at its law points, tension positive")
    return figure


def distances(results: Results, name: str) -> Array:
    """Of the law points from @0 on."""
    return results.midplane(name).distance(results.interfaces[name].points)


def place_text(place: Sequence[float], points: Array) -> str:
    """A place as (x, y), without round-off of the size of the interface."""
    fine = 1e-9 * np.abs(points).max()
    return "({:.4g}, {:.4g})".format(*(0.0 if abs(x) < fine else x for x in place)).replace("-", "−")


def draw_water(axis: Axes, field: Any, s: Array | None) -> None:
    """The pressure between the sides, as a traction; with the effective traction it makes the total one."""
    if s is not None and "pressure" in field.array_names and field["pressure"].any():
        axis.fill_between(s, -field["pressure"], 0, color=GREEN, alpha=0.18, linewidth=0, label="water $-p$")
        axis.plot(s, field["traction_total"][:, 0], color=GREEN, linewidth=1.0, label="total $t_n - p$", zorder=4)


def draw_limit(axis: Axes, results: Results, name: str, law: Mapping[str, Any]) -> None:
    """The largest friction under the normal traction there is, on the side to which most of the joint is pushed."""
    field, friction = results.interfaces[name], law["friction_coefficient"]
    if isinstance(friction, str) or isinstance(law.get("cohesion"), str):
        return  # formulas of the place
    normal, tangential = field["traction"].T
    limit = law.get("cohesion", 0.0) + friction * np.maximum(-normal, 0.0)
    text = "friction limit $" + ("c + " if law.get("cohesion") else "") + "\\mu\\,|t_n|$"
    limit = np.copysign(limit, field["length"] @ tangential)
    axis.plot(distances(results, name), limit, label=text, color=INK, linewidth=0.8, linestyle=DASHES, zorder=6)


def with_zero(axis: Axes, size: float) -> None:
    """Bounds that hold zero; a line that is zero but for round-off shall look so."""
    axis.margins(y=0.08)
    low, high = axis.get_ylim()
    if max(abs(low), abs(high)) < 1e-6 * size:
        low, high = -0.1 * size, 0.1 * size
    axis.set_ylim(min(low, 0.0), max(high, 0.0))
