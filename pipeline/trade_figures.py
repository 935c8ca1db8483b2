"""The figures of the trade page: plotly for the page, matplotlib for the PNGs."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import plotly.graph_objects as go
from plotly.subplots import make_subplots

from trade_front import FLOOR, error_of, label

PHASES = {
    "sweep": "#4477aa",
    "hypercube": "#ccbb44",
    "factorial": "#66ccee",
    "factorial of the two that move most": "#aa3377",
}
ANSWERED = ("tolerance", "increments", "density")
FRONT, FAILED = "#228833", "#cc3311"
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


def front_figure(scene):
    """Error against time, every point labelled, the front as a line, failed points at the top."""
    figure = go.Figure()
    for phase, colour in PHASES.items():
        rows = [row for row in scene["points"] if row["phase"] == phase and row["error"] is not None]
        if rows:
            figure.add_scatter(
                x=[row["time"] for row in rows],
                y=[max(row["error"], 1e-12) for row in rows],
                mode="markers",
                name=phase,
                text=[hover(row) for row in rows],
                hoverinfo="text",
                marker={"size": 8, "color": colour, "line": {"width": 0.5, "color": "#333"}},
            )
    rows = scene["front"]
    figure.add_scatter(
        x=[row["time"] for row in rows],
        y=[error_of(row, scene["floor"]) for row in rows],
        mode="lines+markers+text",
        name="front, repeated",
        text=[label(row) for row in rows],
        textposition="middle right",
        textfont={"size": 10, "color": FRONT},
        hovertext=[hover(row) for row in rows],
        hoverinfo="text",
        line={"color": FRONT, "shape": "vh"},
        marker={"size": 10, "symbol": "diamond"},
        error_x={
            "type": "data",
            "symmetric": False,
            "array": [max(row["times"]) - row["time"] for row in rows],
            "arrayminus": [row["time"] - min(row["times"]) for row in rows],
        },
    )
    presets = [row for row in scene["presets"] if row["error"] is not None]
    figure.add_scatter(
        x=[row["time"] for row in presets],
        y=[max(row["error"], 1e-12) for row in presets],
        mode="markers+text",
        name="presets",
        text=[row["labels"]["accuracy"] for row in presets],
        textposition="top right",
        marker={"size": 11, "symbol": "star", "color": "#ee6677"},
    )
    failed = [row for row in scene["points"] if row["error"] is None]
    if failed:
        figure.add_scatter(
            x=[row["time"] for row in failed],
            y=[top_of(scene)] * len(failed),
            mode="markers",
            name="failed",
            text=[hover(row) for row in failed],
            hoverinfo="text",
            marker={"size": 9, "symbol": "x", "color": FAILED},
        )
    if scene["floor"]:
        figure.add_hrect(y0=1e-13, y1=FLOOR * scene["floor"], fillcolor="#ddd", opacity=0.5, line_width=0)
    figure.update_layout(
        title="Error against time", xaxis=log_axis("time [s]"), yaxis=log_axis("relative error"), **LAYOUT
    )
    lowest = min([error_of(row, scene["floor"]) for row in scene["points"]] + [1.0])
    figure.update_yaxes(range=[math.log10(max(lowest, 1e-12)) - 0.5, math.log10(top_of(scene)) + 0.3])
    return figure


def knob_figure(scene):
    """Error against time of the sweep, a line a knob."""
    figure = go.Figure()
    sweep = [row for row in scene["points"] if row["phase"] == "sweep" and row["error"] is not None]
    for name in dict.fromkeys(n for row in sweep for n in row["labels"]):
        rows = [row for row in sweep if name in row["labels"]]
        figure.add_scatter(
            x=[row["time"] for row in rows],
            y=[max(row["error"], 1e-12) for row in rows],
            mode="lines+markers+text",
            name=name,
            text=[row["labels"][name] for row in rows],
            textposition="top center",
            textfont={"size": 10},
            hovertext=[hover(row) for row in rows],
            hoverinfo="text",
        )
    figure.update_layout(
        title="One knob at a time", xaxis=log_axis("time [s]"), yaxis=log_axis("relative error"), **LAYOUT
    )
    return figure


def answer_figure(scene):
    """The answer against tolerance, increments and density, each alone; a line is the exact one."""
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
    figure.update_layout(title=f"{name} against tolerance, increments (× those of the scene) and density", **LAYOUT)
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
        known = [row for row in scene["points"] if row["error"] is not None]
        failed = [row for row in scene["points"] if row["error"] is None]
        axis.loglog(
            [r["time"] for r in known],
            [max(r["error"], 1e-12) for r in known],
            ".",
            color="#99b",
            ms=4,
            label="all points",
        )
        front = scene["front"]
        axis.loglog(
            [r["time"] for r in front],
            [error_of(r, scene["floor"]) for r in front],
            "-D",
            color=FRONT,
            ms=4,
            lw=1.2,
            label="front",
        )
        presets = [r for r in scene["presets"] if r["error"] is not None]
        axis.loglog(
            [r["time"] for r in presets],
            [max(r["error"], 1e-12) for r in presets],
            "*",
            color="#ee6677",
            ms=9,
            label="presets",
        )
        for row in presets:
            axis.annotate(
                row["labels"]["accuracy"],
                (row["time"], max(row["error"], 1e-12)),
                fontsize=7,
                xytext=(4, 3),
                textcoords="offset points",
            )
        if failed:
            axis.loglog(
                [r["time"] for r in failed], [top_of(scene)] * len(failed), "x", color=FAILED, ms=5, label="failed"
            )
        axis.set_title(f"{name}: {scene['case'].split(':')[0]}", fontsize=9)
        axis.set_xlabel("time [s]", fontsize=8)
        axis.tick_params(labelsize=7)
        axis.grid(True, which="major", alpha=0.3)
    axes[0][0].set_ylabel("relative error", fontsize=8)
    axes[0][0].legend(fontsize=7, loc="lower left")
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
