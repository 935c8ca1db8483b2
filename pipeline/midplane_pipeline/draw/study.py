"""Draw a study: errors, or values where nothing is known, against time and size, as one HTML page and a PNG.

Hover over a point for its settings. What failed stands at the top."""

import argparse
import json
import math
from collections.abc import Callable
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import plotly.graph_objects as go
from midplane.pictures import page
from midplane.pictures.page import INK, MARKERS, RUNS, VERMILLION
from plotly.offline import get_plotlyjs

from .page_text import page_text

Value = Callable[[dict[str, Any]], Any]

AGAINST: dict[str, Value] = {"time [s]": lambda point: point["seconds_median"], "dofs": lambda point: point["counts"].get("dofs")}


def ordinate(study: dict[str, Any], measure: str) -> tuple[str, Value]:
    """A name and a function of a point: its error where there is one, else its value."""
    if any(point["errors"].get(measure) is not None for point in study["points"]):
        return f"error of {measure}", lambda point: point["errors"].get(measure)
    return measure, lambda point: abs(point["values"].get(measure) or 0) or None


def setting(point: dict[str, Any]) -> str:
    """The axes of a point in words."""
    words = []
    for name, value in point["axes"].items():
        parts = value.items() if isinstance(value, dict) else [(name, value)]
        words += [f"{key.removeprefix('subdomains.')} = {part}" for key, part in parts if part is not None]
    return "<br>".join(words) or "the scene as it is"


def known(points: list[dict[str, Any]], of_x: Value, of_y: Value) -> list[tuple[float, float, dict[str, Any]]]:
    """Points that have both numbers: (x, y, point)."""
    found = [(of_x(p), of_y(p), p) for p in points if p["status"] == "done"]
    return [(x, y, p) for x, y, p in found if x and y and math.isfinite(y)]


def write_page(study: dict[str, Any], out: Path) -> None:
    """The page, a figure for time and one for size."""
    parts = [f"<h1>{page_text(study['title'] or study['study'])}</h1>"]
    for k, (title, of_x) in enumerate(AGAINST.items()):
        figure = go.Figure()
        top = 0.0
        for measure in study["points"][0]["values"] if study["points"] else []:
            name, of_y = ordinate(study, measure)
            rows = known(study["points"], of_x, of_y)
            top = max([top, *(y for _, y, _ in rows)])
            x, y, points = zip(*rows, strict=True) if rows else ((), (), ())
            text = [f"point {p['point']}<br>{setting(p)}" for p in points]
            figure.add_scatter(x=x, y=y, mode="markers", name=name, text=text, hoverinfo="text+x+y")
        failed = [p for p in study["points"] if p["status"] not in ("done", "limit") and of_x(p)]
        if failed:
            text = [f"point {p['point']}<br>{setting(p)}<br>{p['message']}" for p in failed]
            figure.add_scatter(
                x=[of_x(p) for p in failed],
                y=[3 * top] * len(failed),
                mode="markers",
                name="failed",
                text=text,
                hoverinfo="text",
                marker={"symbol": "x", "color": VERMILLION},
            )
        figure.update_layout(
            template="plotly_white",
            colorway=RUNS,
            xaxis={"type": "log", "title": title},
            yaxis={"type": "log", "exponentformat": "power"},
        )
        parts.append(f"<div id='f{k}' style='height:560px'></div><script>Plotly.newPlot('f{k}', {figure.to_json()}, {{}}, {{responsive: true}})</script>")
    head = f"<!DOCTYPE html><meta charset='utf-8'><title>{page_text(study['study'])}</title><script>{get_plotlyjs()}</script>"
    out.write_text(f"{head}<body style='font: 15px sans-serif; max-width: 1000px; margin: 2em auto'>{''.join(parts)}</body>")


def picture(study: dict[str, Any], out: Path) -> None:
    """Every measure against time and against size; failed points on the upper edge."""
    plt.rcParams.update(page.STYLE)
    figure, axes = page.graphs(1, 3.8, columns=len(AGAINST), sharex=False)
    measures = list(study["points"][0]["values"]) if study["points"] else []
    names = [ordinate(study, measure)[0] for measure in measures]
    failed = [point for point in study["points"] if point["status"] not in ("done", "limit")]
    for axis, (title, of_x) in zip(axes, AGAINST.items(), strict=True):
        for order, measure in enumerate(measures):
            name, of_y = ordinate(study, measure)
            rows = known(study["points"], of_x, of_y)
            look: dict[str, Any] = {"linestyle": "", "marker": MARKERS[order % len(MARKERS)], "markersize": 4, "label": name}
            axis.plot([x for x, _, _ in rows], [y for _, y, _ in rows], color=RUNS[order % len(RUNS)], **look)
        axis.set(xscale="log", yscale="log", xlabel=title)
        axis.grid(True, which="major")
        page.plain_log(axis.xaxis)
        places = [of_x(point) for point in failed if of_x(point)]
        if places:
            look = {"linestyle": "", "marker": "x", "markersize": 4, "label": "failed", "clip_on": False}
            axis.plot(places, [1.0] * len(places), color=INK, transform=axis.get_xaxis_transform(), **look)
    axes[0].set_ylabel(names[0] if len(names) == 1 else "errors" if all("error" in name for name in names) else "measures")
    keys = {line.get_label(): line for axis in axes for line in axis.get_legend_handles_labels()[0]}
    if len(keys) > 1:
        page.key_below(figure, list(keys.values()))
    page.heading(axes[0], study["title"] or study["study"], f"{len(study['points'])} points, {len(failed)} of them failed")
    page.save(figure, out)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("study", type=Path, help="study.json as `midplane study` has written it")
    options = parser.parse_args()
    study = json.loads(options.study.read_text())
    write_page(study, options.study.with_suffix(".html"))
    picture(study, options.study.with_suffix(".png"))
    print(options.study.with_suffix(".html"))


if __name__ == "__main__":
    main()
