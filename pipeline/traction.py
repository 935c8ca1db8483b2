"""The picture of both components of the traction along an interface."""

import numpy as np

import page
from page import GREEN, INK, PALE, RUNS


def draw_traction(results, name, law, label, others, exact, title, units):
    """Normal and tangential traction along one interface, beside those of other runs and exact values.

    `exact` are (component, places or None for all of the interface, values). Where the law is Coulomb's its limit is
    drawn too: there the joint slips.
    """
    figure, axes = page.graphs(2, 4.2 + page.KEY)
    runs = [(label, results), *others]
    for order, (text, run) in enumerate(runs):
        points, segments, _, _ = run.midplane(name)
        field = run.interfaces[name]
        s = arc_length(field.points[:, :2], points[segments[0, 0]])
        for component, axis in enumerate(axes):
            look = {"linewidth": 1.0, "marker": "o", "markersize": 2.3, "zorder": 5 - order}
            axis.plot(s, field["traction"][:, component], color=RUNS[order], label=text, **look)
    draw_water(axes[0], results.interfaces[name], s if len(runs) == 1 else None)
    length = np.linalg.norm(np.diff(points[segments], axis=1), axis=2).sum()
    for component, places, values in exact:
        look = {"color": PALE, "linewidth": 5, "solid_capstyle": "butt", "zorder": 1}
        places = [0.0, length] if places is None else places
        axes["nt".index(component)].plot(places, values, label="exact", **look)
    size = np.abs(results.interfaces[name]["traction"]).max() or 1.0
    for axis, component in zip(axes, ("normal $t_n$", "tangential $t_t$"), strict=True):
        axis.set(xlim=(0, length), ylabel=f"{component} [{units.stress}]")
        axis.grid(axis="y")
        axis.xaxis.set_major_formatter("{x:g}")
        do_not_magnify_round_off(axis, size)
    if law["type"] == "coulomb":
        draw_limit(axes[1], results, name, law)
    start, end = (f"({points[at][0]:.4g}, {points[at][1]:.4g})" for at in (segments[0, 0], segments[-1, 1]))
    axes[1].set(xlabel=f"distance along {name} [{units.length}], from @0 at {start} to @1 at {end}")
    handles = {line.get_label(): line for axis in axes for line in axis.get_legend_handles_labels()[0]}
    if len(handles) > 1:
        page.key_below(figure, list(handles.values()))
    figure.align_ylabels(axes)
    page.heading(axes[0], title, f"traction along {name} at its law points, tension positive")
    page.save(figure, results.pictures / f"traction_{name}.png")


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
    look = {"color": INK, "linewidth": 0.8, "linestyle": (0, (4, 3)), "zorder": 6}
    axis.plot(s, np.copysign(limit, field["length"] @ tangential), label=text, **look)


def arc_length(points, start):
    """Distance of points from the start, measured along them."""
    return np.cumsum(np.linalg.norm(np.diff(points, axis=0, prepend=start[None]), axis=1))


def do_not_magnify_round_off(axis, size):
    """A line that is constant but for round-off shall look constant."""
    axis.margins(y=0.08)
    low, high = axis.get_ylim()
    if high - low < 1e-6 * size:
        axis.set_ylim((low + high) / 2 - 0.1 * size, (low + high) / 2 + 0.1 * size)
