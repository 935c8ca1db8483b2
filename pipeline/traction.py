"""The picture of both components of the traction along an interface."""

import numpy as np

import page
from page import DASHES, GREEN, GREY, INK, MARKERS, PALE, RUNS


def draw_traction(results, name, law, label, others, exact, title, view):
    """Normal and tangential traction along one interface, beside those of other runs and exact values.

    `exact` are (component, places or None for all of the interface, values). Where the law is Coulomb's its limit is
    drawn too: there the joint slips.
    """
    figure, axes = page.graphs(2, 4.2)
    runs = [(label, results), *((text, run) for text, run in others if name in run.interfaces)]
    for order, (text, run) in enumerate(runs):
        points, segments, _, _ = run.midplane(name)
        field = run.interfaces[name]
        s = arc_length(field.points[:, :2], points[segments[0, 0]])
        size = 2.3 if len(s) < 300 else 1.2
        for component, axis in enumerate(axes):
            look = {"linewidth": 1.0, "marker": MARKERS[order % len(MARKERS)], "markersize": size, "zorder": 5 - 0.1 * order}
            axis.plot(s, field["traction"][:, component], color=RUNS[order % len(RUNS)], label=text, **look)
    points, segments, _, _ = results.midplane(name)
    s = arc_length(results.interfaces[name].points[:, :2], points[segments[0, 0]])
    draw_water(axes[0], results.interfaces[name], s if len(runs) == 1 else None)
    length = np.linalg.norm(np.diff(points[segments], axis=1), axis=2).sum()
    for component, places, values in exact:
        look = {"color": PALE, "linewidth": 5, "solid_capstyle": "butt", "zorder": 1}
        places = [0.0, length] if places is None else places
        axes["nt".index(component)].plot(places, values, label="exact", **look)
    if law["type"] == "coulomb":
        draw_limit(axes[1], results, name, law)
    size = np.abs(results.interfaces[name]["traction"]).max() or 1.0
    for axis, component in zip(axes, ("normal $t_n$", "tangential $t_t$"), strict=True):
        axis.set(xlim=(0, length))
        axis.grid(axis="y")
        axis.axhline(0, color=GREY, linewidth=0.6, zorder=0.5)
        with_zero(axis, size)
        axis.locator_params(axis="x", nbins=8)
        page.scale_axis(axis.yaxis, f"{component} [{view.stress}]", np.abs(axis.get_ylim()).max())
    page.scale_axis(axes[1].xaxis, f"distance along {name} [{view.length}]", length)
    ends = (points[at] for at in (segments[0, 0], segments[-1, 1]))
    page.mark_ends(axes[1], *(f"@{end} {place_text(place, points)}" for end, place in enumerate(ends)))
    handles = {line.get_label(): line for axis in axes for line in axis.get_legend_handles_labels()[0]}
    if len(handles) > 1:
        page.key_below(figure, list(handles.values()))
    figure.align_ylabels(axes)
    page.heading(axes[0], title, f"traction along {name} at its law points, tension positive")
    page.save(figure, results.pictures / f"traction_{name}.png")


def place_text(place, points):
    """A place as (x, y), without round-off of the size of the interface."""
    fine = 1e-9 * np.abs(points).max()
    return "({:.4g}, {:.4g})".format(*(0.0 if abs(x) < fine else x for x in place)).replace("-", "−")


def deviation(results, name, exact):
    """Largest difference from exact tractions at the law points, over the largest of these."""
    points, segments, _, _ = results.midplane(name)
    field, largest, size = results.interfaces[name], 0.0, 0.0
    s = arc_length(field.points[:, :2], points[segments[0, 0]])
    for component, places, values in exact:
        there = (s >= places[0]) & (s <= places[-1]) if places is not None else np.full(len(s), True)
        wanted = np.interp(s, places, values) if places is not None else np.full(len(s), values[0])
        off = np.abs(field["traction"][:, "nt".index(component)] - wanted)
        largest, size = max(largest, off[there].max()), max(size, np.abs(values).max())
    return largest / size


def draw_water(axis, field, s):
    """The pressure between the sides, as a traction; with the effective traction it makes the total one."""
    if s is not None and "pressure" in field.array_names and field["pressure"].any():
        axis.fill_between(s, -field["pressure"], 0, color=GREEN, alpha=0.18, linewidth=0, label="water $-p$")
        axis.plot(s, field["traction_total"][:, 0], color=GREEN, linewidth=1.0, label="total $t_n - p$", zorder=4)


def draw_limit(axis, results, name, law):
    """The largest friction under the normal traction there is, on the side to which most of the joint is pushed."""
    field, (points, segments, _, _) = results.interfaces[name], results.midplane(name)
    s = arc_length(field.points[:, :2], points[segments[0, 0]])
    normal, tangential = field["traction"].T
    limit = law.get("cohesion", 0.0) + law["friction_coefficient"] * np.maximum(-normal, 0.0)
    text = "friction limit $" + ("c + " if law.get("cohesion") else "") + "\\mu\\,|t_n|$"
    look = {"color": INK, "linewidth": 0.8, "linestyle": DASHES, "zorder": 6}
    axis.plot(s, np.copysign(limit, field["length"] @ tangential), label=text, **look)


def arc_length(points, start):
    """Distance of points from the start, measured along them."""
    return np.cumsum(np.linalg.norm(np.diff(points, axis=0, prepend=start[None]), axis=1))


def with_zero(axis, size):
    """Bounds that hold zero; a line that is zero but for round-off shall look so."""
    axis.margins(y=0.08)
    low, high = axis.get_ylim()
    if max(abs(low), abs(high)) < 1e-6 * size:
        low, high = -0.1 * size, 0.1 * size
    axis.set_ylim(min(low, 0.0), max(high, 0.0))
