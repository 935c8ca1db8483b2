"""The figures of the trade page: plotly for the page, matplotlib for the PNGs."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import plotly.graph_objects as go
from matplotlib.ticker import LogLocator, NullFormatter
from plotly.subplots import make_subplots

from trade_front import FLOOR, error_of, label

PHASES = {
    "sweep": "#4477aa",
    "hypercube": "#ccbb44",
    "factorial": "#66ccee",
    "factorial of the two that move most": "#aa3377",
}
ANSWERED = ("tolerance", "increments", "refinement")
FRONT, FAILED, PRESET = "#228833", "#cc3311", "#ee6677"
LAYOUT = {"template": "plotly_white", "margin": {"l": 70, "r": 20, "t": 50, "b": 60}, "font": {"size": 13}}


def log_axis(title):
    return {"type": "log", "title": title, "exponentformat": "power", "dtick": 1}


def hover(row):
    lines = [label(row), f"error {row['error']:.3g}" if row["error"] is not None else row["message"][:120]]
    lines += [f"{row['time']:.3g} s", f"{row['dofs'] or 0:.0f} dofs"]
    return "<br>".join(lines)


def top_of(scene):
    """Where failed points are shown."""
    known = [row["error"] for row in scene["points"] if row["error"] is not None]
    return 4 * max(known, default=1.0)


def shown(row, floor=0.0):
    """Where the error of a point is drawn."""
    return max(error_of(row, floor), 1e-12)


def against_time(rows, **options):
    """A trace of plotly: error against time, with the setting of every point."""
    places = {"x": [row["time"] for row in rows], "y": [shown(row) for row in rows], "mode": "markers"}
    return places | {"hovertext": [hover(row) for row in rows], "hoverinfo": "text"} | options


def split(rows):
    """Those that are done and those that failed."""
    return [row for row in rows if row["error"] is not None], [row for row in rows if row["error"] is None]


def time_and_error(figure, title):
    time = log_axis("time [s]") | {"dtick": "D2"}
    figure.update_layout(title=title, xaxis=time, yaxis=log_axis("relative error"), **LAYOUT)


def front_figure(scene):
    """Error against time, every point labelled, the front as a line, failed points at the top."""
    figure = go.Figure()
    known, failed = split(scene["points"])
    for phase, colour in PHASES.items():
        rows = [row for row in known if row["phase"] == phase]
        marker = {"size": 8, "color": colour, "line": {"width": 0.5, "color": "#333"}}
        if rows:
            figure.add_scatter(**against_time(rows, name=phase, marker=marker))
    rows = scene["front"]
    later = [max(row["times"]) - row["time"] for row in rows]
    figure.add_scatter(
        **against_time(
            rows,
            y=[shown(row, scene["floor"]) for row in rows],
            mode="lines+markers+text",
            name="front, repeated",
            text=[label(row) for row in rows],
            textposition="bottom right",
            textfont={"size": 10, "color": FRONT},
            # an error holds from its time on
            line={"color": FRONT, "shape": "hv"},
            marker={"size": 10, "symbol": "diamond"},
            error_x={"type": "data", "symmetric": False, "array": later, "arrayminus": [0.0] * len(rows)},
        )
    )
    presets = split(scene["presets"])[0]
    names = [row["labels"]["accuracy"] for row in presets]
    star = {"size": 11, "symbol": "star", "color": PRESET}
    figure.add_scatter(
        **against_time(presets, mode="markers+text", name="presets", text=names, textposition="top right", marker=star)
    )
    if failed:
        cross = {"size": 9, "symbol": "x", "color": FAILED}
        figure.add_scatter(**against_time(failed, y=[top_of(scene)] * len(failed), name="failed", marker=cross))
    if scene["floor"]:
        figure.add_hrect(y0=1e-13, y1=FLOOR * scene["floor"], fillcolor="#ddd", opacity=0.5, line_width=0)
    time_and_error(figure, "Error against time")
    lowest = min([error_of(row, scene["floor"]) for row in scene["points"]] + [1.0])
    figure.update_yaxes(range=[math.log10(max(lowest, 1e-12)) - 0.5, math.log10(top_of(scene)) + 0.3])
    return figure


def knob_figure(scene):
    """Error against time of the sweep, a line a knob through its points and the reference setting."""
    figure = go.Figure()
    sweep = [row for row in split(scene["points"])[0] if row["phase"] == "sweep"]
    for name in dict.fromkeys(n for row in sweep for n in row["labels"]):
        rows = [row for row in sweep if name in row["labels"] or not row["labels"]]
        rows.sort(key=lambda row: row["time"])
        values = [row["labels"].get(name, scene["reference"][name]) for row in rows]
        text = {"text": values, "textposition": "top center", "textfont": {"size": 10}}
        figure.add_scatter(**against_time(rows, mode="lines+markers+text", name=name, **text))
    time_and_error(figure, "One knob at a time")
    return figure


def answer_figure(scene):
    """The answer against tolerance, increments and refinement, each alone; a line is the exact one."""
    name = scene["deciding"][0]
    sweep = [row for row in scene["points"] if row["phase"] == "sweep" and row["values"].get(name) is not None]
    figure = make_subplots(rows=1, cols=3, shared_yaxes=True, subplot_titles=[f"{k}" for k in ANSWERED])
    for column, knob in enumerate(ANSWERED, 1):
        rows = [row for row in sweep if list(row["labels"]) == [knob]]
        reference = next((row for row in sweep if not row["labels"]), None)
        points = [(float(row["labels"][knob]), row) for row in rows]
        if reference:
            points.append((float(scene["reference"][knob]), reference))
        points.sort(key=lambda point: point[0])
        figure.add_scatter(
            x=[x for x, _ in points],
            y=[row["values"][name] for _, row in points],
            text=[hover(row) for _, row in points],
            hoverinfo="text",
            mode="lines+markers",
            showlegend=False,
            row=1,
            col=column,
        )
        if scene["exact"] is not None:
            figure.add_hline(y=scene["exact"], line_dash="dot", line_color="#228833", row=1, col=column)
        figure.update_xaxes(type="log", row=1, col=column)
    title = f"{name} against tolerance, increments (× those of the scene) and refinement"
    figure.update_layout(title=title, **LAYOUT | {"margin": LAYOUT["margin"] | {"t": 90}})
    return figure


def curve_figure(title, curves):
    """Histories over each other."""
    figure = go.Figure()
    for curve in curves:
        figure.add_scatter(x=curve["x"], y=curve["y"], mode="lines+markers", name=label(curve), marker={"size": 4})
    figure.update_layout(title=title, **LAYOUT)
    return figure


def groups(rows):
    table = {}
    for row in rows:
        if row["error"] is not None:
            table.setdefault((row["element"], row["edges"], row["coupling"]), []).append(row)
    return table


def penalty_figure(rows):
    """Traction error against stiffness."""
    figure = go.Figure()
    for (element, edges, coupling), group in groups(rows).items():
        figure.add_scatter(
            x=[row["stiffness_number"] for row in group],
            y=[row["error"] for row in group],
            mode="lines+markers",
            name=f"{element} {edges} {coupling}",
            line={"dash": "solid" if coupling == "projected" else "dot"},
        )
    figure.update_layout(
        title="L2 error of the tractions of the strip",
        xaxis=log_axis("K_N h/E"),
        yaxis=log_axis("relative error"),
        **LAYOUT,
    )
    return figure


def save_fronts(scenes, path):
    """All fronts in one picture, for the README."""
    figure, axes = plt.subplots(1, len(scenes), figsize=(3.4 * len(scenes), 3.6), squeeze=False)
    for axis, (name, scene) in zip(axes[0], scenes.items()):

        def draw(rows, style, at=shown, **options):
            axis.loglog([row["time"] for row in rows], [at(row) for row in rows], style, **options)

        known, failed = split(scene["points"])
        presets = split(scene["presets"])[0]
        draw(known, ".", color="#99b", ms=4, label="all points")
        level = lambda row: shown(row, scene["floor"])
        draw(scene["front"], "-D", level, color=FRONT, ms=4, lw=1.2, drawstyle="steps-post", label="front")
        draw(presets, "*", color=PRESET, ms=9, label="presets")
        for row in presets:
            place = {"xytext": (4, 3), "textcoords": "offset points", "fontsize": 7}
            axis.annotate(row["labels"]["accuracy"], (row["time"], shown(row)), **place)
        if failed:
            draw(failed, "x", lambda _: top_of(scene), color=FAILED, ms=5, label="failed")
        axis.set_title(f"{name}: {scene['case'].split(':')[0]}", fontsize=9)
        axis.set_xlabel("time [s]", fontsize=8)
        axis.tick_params(labelsize=7)
        axis.xaxis.set_major_locator(LogLocator(subs=(1, 2, 5)))
        axis.xaxis.set_major_formatter("{x:g}")
        axis.xaxis.set_minor_formatter(NullFormatter())
        axis.grid(True, which="major", alpha=0.3)
    axes[0][0].set_ylabel("relative error", fontsize=8)
    axes[0][0].legend(fontsize=7, loc="best")
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    plt.close(figure)


def save_penalty(rows, path):
    """Traction error against stiffness, for the README."""
    figure, axis = plt.subplots(figsize=(6.5, 4))
    colours = {}
    for (element, edges, coupling), group in groups(rows).items():
        colour = colours.setdefault((element, edges), f"C{len(colours)}")
        style = "-o" if coupling == "projected" else ":s"
        axis.loglog(
            [r["stiffness_number"] for r in group],
            [r["error"] for r in group],
            style,
            color=colour,
            ms=3,
            label=f"{element} {edges} {coupling}",
        )
    axis.set_xlabel("K_N h/E")
    axis.set_ylabel("L2 error of the tractions")
    axis.grid(True, alpha=0.3)
    axis.legend(fontsize=7)
    figure.tight_layout()
    figure.savefig(path, dpi=130)
    plt.close(figure)
