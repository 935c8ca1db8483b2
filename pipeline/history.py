"""Draw one column of history.csv over another, other runs beside it, the exact curve beneath: RESULTS/pictures/history.png.

The columns, their labels and the exact solution (pipeline/exact.py) of a scene stand in geo/<scene>/history.args.
"""

import argparse
import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import exact
import page
import scene_file
from draw import Results
from page import GREY, INK, PALE, RUNS


def read(folder):
    """The columns of history.csv by name, from the unloaded state on."""
    with open(folder / "history.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    numbers = [name for name in rows[0] if name != "step"]
    return {name: np.array([float(row[name]) for row in rows]) for name in numbers}


def deviation(run, solution, x, y):
    """Largest distance of the run from the exact curve, each way over the largest exact value: the curve may turn back."""
    size = [np.abs(solution.history[name]).max() for name in (x, y)]
    curve = np.column_stack([solution.history[name] for name in (x, y)]) / size
    points = np.column_stack([run[name] for name in (x, y)]) / size
    start, along = curve[:-1], np.diff(curve, axis=0)
    square = np.maximum((along**2).sum(axis=1), np.finfo(float).tiny)

    def distance(point):
        foot = np.clip(((point - start) * along).sum(axis=1) / square, 0, 1)
        return np.hypot(*(point - start - foot[:, None] * along).T).min()

    return max(distance(point) for point in points)


def difference_at_the_end(run, solution, x, y):
    """How far the last point lies beside the solution at its ordinate, relative."""
    order = np.argsort(solution.history[y])
    exact = np.interp(run[y][-1], solution.history[y][order], solution.history[x][order])
    return abs(run[x][-1] / exact - 1)


def draw_exact(axis, solution, x, y):
    """The exact curve and what happens on it."""
    curve = solution.history
    axis.plot(curve[x], curve[y], color=PALE, linewidth=5, solid_capstyle="butt", label=solution.name, zorder=1)
    for place, text in solution.marks:
        here = (place[x], place[y])
        line = {"arrowstyle": "-", "color": GREY, "linewidth": 0.7, "shrinkB": 4}
        look = {"textcoords": "offset points", "va": "center", "color": "#555555", "arrowprops": line}
        side = -1 if here[0] > 0.7 * curve[x].max() else 1  # where there is room
        offset = (26 * side, -16 if solution.levels else 0)
        axis.annotate(text, here, xytext=offset, ha="left" if side > 0 else "right", **look)


def draw_level(axis, value, text):
    """A bound of the ordinate."""
    axis.axhline(value, color=GREY, linewidth=0.9, linestyle=(0, (4, 3)), zorder=2)
    axis.annotate(text, (0, value), xytext=(4, 4), textcoords="offset points", color="#555555")
    axis.set_ylim(top=max(axis.get_ylim()[1], 1.1 * value))


def ends(values):
    """From zero to the largest, or from the smallest where that is below."""
    return min(0.0, *(value.min() for value in values)), max(value.max() for value in values)


def draw(runs, solution, columns, levels, title, subtitle):
    """The picture: `columns` are (name, label) of the abscissa and of the ordinate, `levels` (value, text)."""
    (x, x_label), (y, y_label) = columns
    figure, (axis,) = page.graphs(1, 3.6 + page.KEY)
    if solution:
        draw_exact(axis, solution, x, y)
    for order, (label, run) in enumerate(runs):
        look = {"color": RUNS[order], "marker": "o", "markersize": 3.0, "zorder": 5 - order}
        line = "none" if solution and solution.name == "exact" else "-"
        axis.plot(run[x], run[y], linewidth=1.2, linestyle=line, label=label, clip_on=False, **look)
    axis.set(xlabel=x_label, ylabel=y_label, xlim=ends([run[x] for _, run in runs]))
    axis.set_ylim(bottom=min(0, *(run[y].min() for _, run in runs)))
    for level in levels:
        draw_level(axis, *level)
    axis.grid(axis="y")
    axis.ticklabel_format(axis="x", scilimits=(-3, 3), useMathText=True)
    axis.tick_params(color=INK)
    if len(runs) > 1 or solution:
        page.key_below(figure, axis.get_legend_handles_labels()[0])
    page.heading(axis, title, subtitle)
    return figure


def column(text):
    """COLUMN=LABEL"""
    name, _, label = text.partition("=")
    return name, label or name


def level(text):
    """VALUE=TEXT"""
    value, _, name = text.partition("=")
    return float(value), name


def main():
    parser = argparse.ArgumentParser(description=__doc__, fromfile_prefix_chars="@")
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/tension/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/tension")
    axis = {"type": column, "metavar": "COLUMN=LABEL", "required": True}
    parser.add_argument("--x", help="the abscissa", **axis)
    parser.add_argument("--y", help="the ordinate", **axis)
    parser.add_argument("--label", default="midplane", help="name of this run in the key")
    many = {"action": "append", "default": []}
    parser.add_argument("--compare", help="another run", metavar="LABEL=RESULTS", **many)
    bound = {"help": "a bound of the ordinate", "metavar": "VALUE=TEXT", "type": level}
    parser.add_argument("--level", **bound, **many)
    parser.add_argument("--solution", choices=exact.SOLUTIONS, help="exact solution to compare with")
    parser.add_argument("--subtitle", default="", help="what the picture shows")
    within = "what the run may be off: an exact curve, of its size; another solution, in the last abscissa, relative"
    parser.add_argument("--within", type=float, help=within)
    arguments = parser.parse_args()
    scene = scene_file.read(arguments.scene)
    plt.rcParams.update(page.STYLE)

    runs = [(arguments.label, read(arguments.results))]
    for other in arguments.compare:
        label, _, folder = other.partition("=")
        runs.append((label, read(Path(folder))))
    subtitle, solution = arguments.subtitle, None
    if arguments.solution:
        results = Results(arguments.results, scene)
        solution = exact.SOLUTIONS[arguments.solution](scene, results)
        if solution.name == "exact":
            largest = deviation(runs[0][1], solution, arguments.x[0], arguments.y[0])
        else:
            largest = difference_at_the_end(runs[0][1], solution, arguments.x[0], arguments.y[0])
        if arguments.within is not None and largest > arguments.within:
            sys.exit(f"{arguments.results}: off the solution by {largest:.1e}, more than {arguments.within:g}")
        print(f"{arguments.results}: off the solution by {largest:.1e}")
        if solution.name == "exact":
            subtitle += f"; off the exact curve by {page.power_of_ten(largest)} of its size"
        arguments.level += solution.levels
    columns = (arguments.x, arguments.y)
    figure = draw(runs, solution, columns, arguments.level, scene["title"], subtitle)
    page.save(figure, arguments.results / "pictures" / "history.png")


if __name__ == "__main__":
    main()
