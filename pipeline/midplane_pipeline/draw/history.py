"""Draw one column of history.csv over another, other runs beside it, the exact curve beneath: RESULTS/pictures/history.png.

The columns, their labels and the exact solution (midplane_pipeline.exact.solutions) of a scene stand in geo/<scene>/history.args. A label
that ends in a unit, such as "force [MN]", may be shown in a power of 1000 of it. Measured values (--measured) are a band
between the lowest and the highest, from a CSV with the columns x, low, high in the folder of the scene.
"""

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from midplane import scene_file
from midplane.names import unknown
from midplane.pictures import labels, page
from midplane.pictures.page import DASHES, GREY, MARKERS, PALE, RUNS, SOFT
from midplane.pictures.results import Results
from midplane.vtu import Array

from midplane_pipeline.exact.solutions import SOLUTIONS
from midplane_pipeline.results.columns import Columns, read_columns, until
from midplane_pipeline.results.told import told

from . import measured

Pair = tuple[tuple[str, str], tuple[str, str]]  # (name, label) of the abscissa and of the ordinate

LEVELS = [DASHES, (0, (1, 2)), (0, (6, 2, 1, 2))]


def deviation(run: Columns, solution: Any, x: str, y: str) -> float:
    """Largest distance of the run from the exact curve, each way over the largest exact value: the curve may turn back."""
    size = [np.abs(solution.history[name]).max() for name in (x, y)]
    curve = np.column_stack([solution.history[name] for name in (x, y)]) / size
    points = np.column_stack([run[name] for name in (x, y)]) / size
    start, along = curve[:-1], np.diff(curve, axis=0)
    square = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)

    def distance(point: Array) -> float:
        foot = np.clip(((point - start) * along).sum(axis=1) / square, 0, 1)
        return np.hypot(*(point - start - foot[:, None] * along).T).min()

    return max(distance(point) for point in points)


def difference_at_the_end(run: Columns, solution: Any, x: str, y: str) -> float:
    """Relative distance of the last point from the solution at its ordinate."""
    order = np.argsort(solution.history[y])
    exact = np.interp(run[y][-1], solution.history[y][order], solution.history[x][order])
    return abs(run[x][-1] / exact - 1)


def ends(values: list[Array]) -> tuple[float, float]:
    """From the smallest to the largest, zero within."""
    return min(0.0, *(value.min() for value in values)), max(0.0, *(value.max() for value in values))


def draw(
    axis: Axes,
    runs: list[tuple[str, Columns]],
    solution: Any,
    columns: Pair,
    levels: Sequence[tuple[float, str]] = (),
    band: tuple[Path, str] | None | None = None,
) -> None:
    """The graph: `columns` are (name, label) of the abscissa and of the ordinate, `levels` (value, text), `band` (path, text)."""
    (x, x_label), (y, y_label) = columns
    if solution:
        exact_curve = [solution.history[name] for name in (x, y)]
        axis.plot(*exact_curve, color=PALE, linewidth=5, solid_capstyle="butt", label=solution.name, zorder=1)
    for order, (label, run) in enumerate(runs):
        mark = MARKERS[order % len(MARKERS)]
        look: dict[str, Any] = {"color": RUNS[order % len(RUNS)], "marker": mark, "markersize": 3.0, "zorder": 5 - 0.1 * order}
        line = "none" if solution and solution.name == "exact" else "-"
        axis.plot(run[x], run[y], linewidth=1.2, linestyle=line, label=label, clip_on=False, **look)
    for style, (value, text) in zip(LEVELS * len(levels), levels, strict=False):
        axis.axhline(value, color=GREY, linewidth=0.9, linestyle=style, zorder=2, label=text)
    low, high = ends([run[x] for _, run in runs])
    if band:
        values = measured.read(band[0])
        _, factor, unit = page.unit_of(x_label, max(-low, high))
        beyond = f", to {values.x.max() / factor:.3g} {unit}".rstrip() if values.x.max() > high else ""
        measured.draw_measured(axis, values, band[1] + beyond)
    axis.set_xlim(low, high if high > low else low + 1.0)
    bottom, top = axis.get_ylim()
    smallest, largest = ends([run[y] for _, run in runs])
    below = smallest < -1e-6 * largest
    axis.set_ylim(min(bottom, 0.0) if below else 0.0, max(top, 0.0))
    if low < 0 < high:
        axis.axvline(0, color=GREY, linewidth=0.6, zorder=0.5)
    if below:
        axis.axhline(0, color=GREY, linewidth=0.6, zorder=0.5)
    axis.grid(axis="y")
    axis.tick_params(color=GREY)
    page.scale_axis(axis.xaxis, x_label, max(-low, high))
    page.scale_axis(axis.yaxis, y_label, np.abs(axis.get_ylim()).max())
    if solution and solution.marks:
        draw_marks(axis, runs, solution, x, y)


def draw_marks(axis: Axes, runs: list[tuple[str, Columns]], solution: Any, x: str, y: str) -> None:
    """Marks of the exact curve, beside it where there is room."""
    curves = [solution.history, *(run for _, run in runs)]
    taken = np.concatenate([labels.along(labels.in_axes(axis, curve[x], curve[y])) for curve in curves])
    for place, text in solution.marks:
        dot = labels.in_axes(axis, [place[x]], [place[y]])[0]
        look: dict[str, Any] = {"away": 12, "sides": labels.AROUND, "leader": True, "color": SOFT}
        taken = labels.place_label(axis, dot, text, taken, **look)


def column(text: str) -> tuple[str, str]:
    """COLUMN=LABEL"""
    name, _, label = text.partition("=")
    return name, label or name


def level(text: str) -> tuple[float, str]:
    """VALUE=TEXT"""
    value, _, name = text.partition("=")
    return float(value), name


def labelled_file(text: str) -> tuple[str, str]:
    """FILE=LABEL"""
    name, _, label = text.partition("=")
    return name, label or name


def parse(arguments: list[str] | None = None) -> argparse.Namespace:
    """The options; `arguments` in place of those of the command line."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, fromfile_prefix_chars="@")
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/tension/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/tension")
    axis: dict[str, Any] = {"type": column, "metavar": "COLUMN=LABEL", "required": True}
    parser.add_argument("--x", help="the abscissa", **axis)
    parser.add_argument("--y", help="the ordinate", **axis)
    parser.add_argument("--until", type=float, metavar="X", help="the last abscissa that is drawn, default: that of the run")
    parser.add_argument("--label", default="midplane", help="name of this run in the key")
    many: dict[str, Any] = {"action": "append", "default": []}
    parser.add_argument("--compare", help="another run", metavar="LABEL=RESULTS", **many)
    bound: dict[str, Any] = {"help": "a bound of the ordinate", "metavar": "VALUE=TEXT", "type": level}
    parser.add_argument("--level", **bound, **many)
    values: dict[str, Any] = {"help": "measured values, a CSV in the folder of the scene", "metavar": "FILE=LABEL", "type": labelled_file}
    parser.add_argument("--measured", **values)
    parser.add_argument("--solution", choices=SOLUTIONS, help="exact solution to compare with")
    parser.add_argument("--subtitle", default="", help="what the picture shows")
    within = "what the run may be off: an exact curve, of its size; another solution, in the last abscissa, relative"
    parser.add_argument("--within", type=float, help=within)
    return parser.parse_args(arguments)


def prepare(arguments: argparse.Namespace, scene: dict[str, Any]) -> tuple[list[tuple[str, Columns]], Any, Any, str]:
    """Runs as (label, columns), the solution or None, the band or None, the subtitle; ends where the run is off the solution."""
    names = arguments.x[0], arguments.y[0]
    runs = [(arguments.label, read_columns(arguments.results, names))]
    for other in arguments.compare:
        label, _, folder = other.partition("=")
        runs.append((label, read_columns(Path(folder), names)))
    subtitle, solution = arguments.subtitle, None
    if arguments.solution:
        solution = SOLUTIONS[arguments.solution](scene, Results(arguments.results, scene))
        arguments.level += solution.levels
        if set(names) - set(solution.history):
            missing = next(name for name in names if name not in solution.history)
            sys.exit(unknown(f"solution {arguments.solution}", "column", missing, solution.history))
        off = deviation if solution.name == "exact" else difference_at_the_end
        largest = off(runs[0][1], solution, *names)
        if arguments.within is not None and largest > arguments.within:
            sys.exit(f"{arguments.results}: off the solution by {largest:.1e}, more than {arguments.within:g}")
        print(f"{arguments.results}: off the solution by {largest:.1e}")
        if solution.name == "exact":
            subtitle += f"; off the exact curve by {page.power_of_ten(largest)} of its size"
    if arguments.until is not None:
        x = names[0]
        last = max(np.abs(run[x]).max() for _, run in runs)
        if abs(arguments.until) < last:
            _, factor, unit = page.unit_of(arguments.x[1], last)
            subtitle += f"; the run goes on to {last / factor:.3g} {unit}".rstrip()
        runs = [(label, until(run, x, arguments.until)) for label, run in runs]
    band = arguments.measured and (arguments.scene.parent / arguments.measured[0], arguments.measured[1])
    return runs, solution, band, subtitle


def main() -> None:
    """The command."""
    arguments = parse()
    scene = scene_file.read(arguments.scene)
    plt.rcParams.update(page.STYLE)
    runs, solution, band, subtitle = prepare(arguments, scene)
    figure, (axis,) = page.graphs(1, 3.6)
    draw(axis, runs, solution, (arguments.x, arguments.y), arguments.level, band)
    handles = axis.get_legend_handles_labels()[0]
    if len(handles) > 1:
        page.key_below(figure, handles)
    page.heading(axis, scene.get("title") or arguments.results.name, subtitle)
    page.save(figure, arguments.results / "pictures" / "history.png")


if __name__ == "__main__":
    told(main)
