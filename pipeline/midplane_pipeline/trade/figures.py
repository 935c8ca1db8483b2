"""The figures of the trade page: plotly for the page, matplotlib for the PNGs."""

import math
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import plotly.graph_objects as go
from matplotlib.axes import Axes
from matplotlib.ticker import NullFormatter
from midplane.pictures import page
from midplane.pictures.page import BLUE, GREEN, INK, MARKERS, ORANGE, PALE, PURPLE, RUNS, SKY, VERMILLION
from plotly.subplots import make_subplots

from .front import FLOOR, Row, error_of, label

PHASES = {
    "sweep": BLUE,
    "hypercube": ORANGE,
    "factorial": SKY,
    "factorial of the two that move most": PURPLE,
}
ANSWERED = ("tolerance", "increments", "refinement")
FRONT, FAILED, PRESET = GREEN, INK, VERMILLION
LAYOUT: dict[str, Any] = {"template": "plotly_white", "margin": {"l": 70, "r": 20, "t": 50, "b": 60}, "font": {"size": 13}}
LAYOUT["colorway"] = RUNS


def log_axis(title: str) -> dict[str, Any]:
    """A logarithmic axis of plotly."""
    return {"type": "log", "title": title, "exponentformat": "power", "dtick": 1}


def hover(row: Row) -> str:
    """Text of a point."""
    lines = [label(row), f"error {row['error']:.3g}" if row["error"] is not None else row["message"][:120]]
    lines += [f"{row['time']:.3g} s", f"{row['dofs'] or 0:.0f} dofs"]
    return "<br>".join(lines)


def top_of(scene: dict[str, Any]) -> float:
    """Height of failed points."""
    known = [row["error"] for row in scene["points"] if row["error"] is not None]
    return 4 * max(known, default=1.0)


def shown(row: Row, floor: float = 0.0) -> float:
    """Height of a point by its error."""
    return max(error_of(row, floor), 1e-12)


def against_time(rows: list[Row], **options: Any) -> Any:
    """A trace of plotly: error against time, with the setting of every point."""
    places: dict[str, Any] = {"x": [row["time"] for row in rows], "y": [shown(row) for row in rows], "mode": "markers"}
    return places | {"hovertext": [hover(row) for row in rows], "hoverinfo": "text"} | options


def split(rows: list[Row]) -> tuple[list[Any], list[Any]]:
    """Those that are done and those that failed."""
    return [row for row in rows if row["error"] is not None], [row for row in rows if row["error"] is None]


def time_and_error(figure: Any, title: str) -> None:
    """Both axes of a figure of errors against time."""
    time = log_axis("time [s]") | {"dtick": "D2"}
    figure.update_layout(title=title, xaxis=time, yaxis=log_axis("relative error"), **LAYOUT)


def front_figure(scene: dict[str, Any]) -> Any:
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
    figure.add_scatter(**against_time(presets, mode="markers+text", name="presets", text=names, textposition="top right", marker=star))
    if failed:
        cross = {"size": 9, "symbol": "x", "color": FAILED}
        figure.add_scatter(**against_time(failed, y=[top_of(scene)] * len(failed), name="failed", marker=cross))
    if scene["floor"]:
        figure.add_hrect(y0=1e-13, y1=FLOOR * scene["floor"], fillcolor="#ddd", opacity=0.5, line_width=0)
    time_and_error(figure, "Error against time")
    lowest = min([error_of(row, scene["floor"]) for row in scene["points"]] + [1.0])
    figure.update_yaxes(range=[math.log10(max(lowest, 1e-12)) - 0.5, math.log10(top_of(scene)) + 0.3])
    return figure


def knob_figure(scene: dict[str, Any]) -> Any:
    """Error against time of the sweep, a line a knob through its points and the reference setting."""
    figure = go.Figure()
    sweep = [row for row in split(scene["points"])[0] if row["phase"] == "sweep"]
    for name in dict.fromkeys(n for row in sweep for n in row["labels"]):
        rows = [row for row in sweep if name in row["labels"] or not row["labels"]]
        rows.sort(key=lambda row: row["time"])
        values = [row["labels"].get(name, scene["reference"][name]) for row in rows]
        text: dict[str, Any] = {"text": values, "textposition": "top center", "textfont": {"size": 10}}
        figure.add_scatter(**against_time(rows, mode="lines+markers+text", name=name, **text))
    time_and_error(figure, "One knob at a time")
    return figure


def answer_figure(scene: dict[str, Any]) -> Any:
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
            figure.add_hline(y=scene["exact"], line_dash="dot", line_color=FRONT, row=1, col=column)
        figure.update_xaxes(type="log", row=1, col=column)
    title = f"{name} against tolerance, increments (× those of the scene) and refinement"
    figure.update_layout(title=title, **LAYOUT | {"margin": LAYOUT["margin"] | {"t": 90}})
    return figure


def curve_figure(title: str, curves: Any) -> Any:
    """Histories over each other."""
    figure = go.Figure()
    for curve in curves:
        figure.add_scatter(x=curve["x"], y=curve["y"], mode="lines+markers", name=label(curve), marker={"size": 4})
    figure.update_layout(title=title, **LAYOUT)
    return figure


def groups(rows: list[Row]) -> Any:
    """Points of the penalty by coupling, element and edges."""
    table: dict[tuple[str, str, str], list[Row]] = {}
    for row in rows:
        if row["error"] is not None:
            table.setdefault((row["element"], row["edges"], row["coupling"]), []).append(row)
    return table


def penalty_figure(rows: list[Row]) -> Any:
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


def save_fronts(scenes: dict[str, Any], path: Path) -> None:
    """All fronts in one picture, for the README."""
    plt.rcParams.update(page.STYLE)
    columns = min(3, len(scenes))
    rows = -(-len(scenes) // columns)
    figure, axes = page.graphs(rows, 0.9 + 2.4 * rows, columns, raised=page.CAPTION, sharex=False, sharey=False)
    figure.subplots_adjust(wspace=0.26, hspace=0.42)
    for axis in axes[len(scenes) :]:
        axis.remove()
    for axis, (name, scene) in zip(axes, scenes.items(), strict=False):
        draw_front(axis, scene)
        page.caption(axis, f"{name}: {scene['case'].split(':')[0]}")
    for number, axis in enumerate(axes[: len(scenes)]):
        axis.set(xlabel="time [s]", ylabel="relative error" if number % columns == 0 else "")
    keys = {line.get_label(): line for axis in axes[: len(scenes)] for line in axis.get_legend_handles_labels()[0]}
    page.key_below(figure, list(keys.values()))
    page.heading(axes[0], "Error against time", "all settings that were tried, and the fastest for every error", raised=page.CAPTION)
    page.save(figure, path)


def draw_front(axis: Axes, scene: dict[str, Any]) -> None:
    """All points of a scene, its front, its presets by name, failed points on the upper edge."""

    def draw(rows: list[Row], at: Any = shown, **look: Any) -> None:
        axis.plot([row["time"] for row in rows], [at(row) for row in rows], **look)

    known, failed = split(scene["points"])
    presets = split(scene["presets"])[0]
    alone = {"linestyle": ""}
    draw(known, marker="o", markersize=1.8, color=PALE, label="all points", zorder=1, **alone)

    def level(row: Row) -> Any:
        return shown(row, scene["floor"])

    front = {"marker": "D", "markersize": 3, "linewidth": 1.1, "drawstyle": "steps-post", "zorder": 3}
    draw(scene["front"], level, color=FRONT, label="front", **front)
    draw(presets, marker="*", markersize=7, color=PRESET, label="presets", zorder=4, **alone)
    for number, row in enumerate(presets):
        place: dict[str, Any] = {"xytext": (4, -9 if number % 2 else 4), "textcoords": "offset points", "fontsize": 7}
        axis.annotate(row["labels"]["accuracy"], (row["time"], shown(row)), **place)
    if failed:
        draw(failed, lambda _: top_of(scene), marker="x", markersize=4, color=FAILED, label="failed", **alone)
    axis.set(xscale="log", yscale="log")
    page.plain_log(axis.xaxis)
    axis.yaxis.set_minor_formatter(NullFormatter())
    axis.grid(True, which="major")


def save_penalty(rows: list[Row], path: Path) -> None:
    """Traction error against stiffness, for the README."""
    plt.rcParams.update(page.STYLE)
    figure, (axis,) = page.graphs(1, 4.2)
    meshes = list(dict.fromkeys(key[:2] for key in groups(rows)))
    for (element, edges, coupling), group in groups(rows).items():
        mesh = meshes.index((element, edges))
        axis.plot(
            [row["stiffness_number"] for row in group],
            [row["error"] for row in group],
            linestyle="-" if coupling == "projected" else ":",
            marker=MARKERS[mesh % len(MARKERS)],
            markersize=3,
            color=RUNS[mesh % len(RUNS)],
            linewidth=1.2,
            label=f"{element} {edges} {coupling}",
        )
    axis.set(xscale="log", yscale="log", xlabel="stiffness number $K_N h/E$", ylabel="relative error")
    axis.grid(True, which="major")
    page.key_below(figure, axis.get_legend_handles_labels()[0])
    page.heading(axis, "Stiff springs and two couplings", "L2 error of the tractions of the strip; dotted: pointwise")
    page.save(figure, path)
