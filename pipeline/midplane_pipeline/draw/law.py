"""Draw the path of one law point: traction-jump curves, the evolving cracking surface (paper, figure 3), the gap.

Reads the CSV that `midplane law SCENE INTERFACE PATH.json` prints. Colours tell the status, numbers the ends of the
path's segments. The gap, r_n - r_n^p, has a graph of its own where the faces part. With --scene the fracture energy
of that interface scales the work of the surfaces (1 is G_I spent); without it they show the work itself.

    midplane law geo/shear joint path.json > path.csv
    python -m midplane_pipeline.draw.law path.csv --scene geo/shear/scene.json --interface joint -o path.png
"""

import argparse
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.colors import LinearSegmentedColormap, Normalize
from matplotlib.figure import Figure
from midplane import scene_file
from midplane.names import unknown
from midplane.pictures import labels, page
from midplane.pictures.page import DASHES, INK, OPEN, PALE, STATUS, TIED, sign
from midplane.vtu import Array

from midplane_pipeline.results.told import told

WORK = LinearSegmentedColormap.from_list("work", ["#5E5E5A", "#D5D5D1"])  # surfaces, the later the paler
SURFACES = 5
TOGETHER = 0.03  # of a graph: ends of segments that are closer share a label
WIDTH, HEIGHT = page.LEFT + page.WIDTH + page.RIGHT, 5.6  # of the page [inch]


def read(csv: str) -> Array:
    """The columns of the CSV by name; empty fields (the elastic law has no strength) are NaN."""
    rows = np.genfromtxt(csv, delimiter=",", names=True, dtype=float)
    return np.atleast_1d(rows)


def energy_i(scene: str, interface: str) -> float | None:
    """Fracture energy in mode I of an interface of a scene, None where there is none."""
    interfaces = scene_file.read(Path(scene))["interfaces"]
    if interface not in interfaces:
        raise SystemExit(unknown(scene, "interface", interface, interfaces))
    return interfaces[interface]["law"].get("fracture_energy_i")


def hyperbola(row: Any, sigma: Array) -> Array:
    """|tau| on the surface of one row: the square root of (c - sigma t)^2 - (c - chi t)^2 for sigma up to chi."""
    chi, c, t = row["tensile_strength"], row["cohesion"], row["tan_friction"]
    inside = t * (chi - sigma) * (2 * c - t * (chi + sigma))
    return np.where(sigma <= chi, np.sqrt(np.maximum(inside, 0)), np.nan)


def stages(rows: Array, count: int) -> list[int]:
    """Indices of rows that spread evenly over the loss of strength, the first and the last included."""
    strength = rows["tensile_strength"] + rows["cohesion"] + rows["tan_friction"]
    lost = strength[0] - strength
    if lost[-1] <= 0:
        return [0]
    wanted = np.linspace(0, lost[-1], count)
    return sorted({int(np.argmin(np.abs(lost - value))) for value in wanted})


def trace(axes: Any, x: Array, y: Array, status: Array) -> None:
    """A line through the rows, every piece in the colour of what the point does on the way to its end."""
    for kind, (_, colour) in STATUS.items():
        ends = np.flatnonzero(status[1:] == kind) + 1
        for run in np.split(ends, np.flatnonzero(np.diff(ends) > 1) + 1) if len(ends) else ():
            way = slice(run[0] - 1, run[-1] + 1)
            axes.plot(x[way], y[way], color=colour, linewidth=1.9, solid_capstyle="round", zorder=3)


def listed(numbers: list[int]) -> str:
    """0, 3–5"""
    runs: list[list[int]] = []
    for number in numbers:
        if runs and number == runs[-1][-1] + 1:
            runs[-1].append(number)
        else:
            runs.append([number])
    return ", ".join(f"{run[0]}–{run[-1]}" if len(run) > 2 else ", ".join(map(str, run)) for run in runs)


def number_ends(axes: Any, rows: Array, x: Array, y: Array) -> None:
    """Dots at the start and at the ends of the segments, numbered; those at one place share a label."""
    ends = np.flatnonzero(rows["s"] == np.round(rows["s"]))
    path = labels.in_axes(axes, x, y)
    places: dict[int, list[int]] = {}
    for number, end in enumerate(ends):
        near = (first for first in places if np.hypot(*(path[end] - path[first])) < TOGETHER)
        places.setdefault(next(near, int(end)), []).append(number)
    # a dot is worse than a line
    taken = np.concatenate([labels.along(path), np.repeat(path[list(places)], 50, axis=0)])
    for first, numbers in places.items():
        axes.plot(x[first], y[first], "o", color=INK, markersize=3.6, zorder=5, clip_on=False)
        taken = labels.place_label(axes, path[first], listed(numbers), taken, fontweight="bold")


def cross(axes: Any) -> None:
    """The two zero lines."""
    axes.axhline(0, color=PALE, linewidth=0.7, zorder=0)
    axes.axvline(0, color=PALE, linewidth=0.7, zorder=0)


def draw_stress_plane(axes: Any, rows: Array, work: Array, label: str, stress: str) -> None:
    """The surfaces at a few stages where they are hyperbolas, and the path."""
    sigma, tau = rows["traction_n"], rows["traction_t"]
    chi = np.nan_to_num(rows["tensile_strength"]).max()
    reach = max(np.ptp(sigma), np.abs(tau).max(), chi, 1e-300)
    low, high = min(sigma.min(), 0) - 0.2 * reach, max(sigma.max(), chi) + 0.08 * reach
    limit = 1.15 * max(np.abs(tau).max(), 0.6 * reach)
    bottom = -limit if tau.min() < -0.02 * limit else -0.12 * limit
    axes.set(xlim=(low, high), xlabel=f"normal traction σ [{stress}]")
    axes.set(ylim=(bottom, limit), ylabel=f"shear traction τ [{stress}]")
    cross(axes)
    if np.isfinite(rows["cohesion"]).all() and not has(rows, "damage"):
        norm = Normalize(0, max(work.max(), 1e-300))
        for k in stages(rows, SURFACES):
            row = rows[k]
            points = row["tensile_strength"] - (row["tensile_strength"] - low) * np.linspace(0, 1, 400) ** 2
            both = np.concatenate([-hyperbola(row, points)[::-1], hyperbola(row, points)])
            axes.plot(np.concatenate([points[::-1], points]), both, color=WORK(norm(work[k])), linewidth=1.0, zorder=1)
        for spent in np.unique([0.0, work.max()]):
            text = f"surface at {label}".replace("?", page.plain(float(f"{spent:.2g}")))
            axes.plot([], [], color=WORK(norm(spent)), linewidth=1.0, label=text)
    trace(axes, sigma, tau, rows["status"])
    number_ends(axes, rows, sigma, tau)


def draw_curve(axes: Any, rows: Array, component: str, names: tuple[str, str], units: tuple[str, str]) -> None:
    """One traction against its jump."""
    (stress, length), (traction, jump) = units, names
    x = rows[f"jump_{component}"]
    y = rows[f"traction_{component}"]
    cross(axes)
    trace(axes, x, y, rows["status"])
    axes.margins(0.08, 0.12)
    axes.locator_params(axis="x", nbins=6)
    axes.set_ylabel(f"{traction} [{stress}]")
    page.scale_axis(axes.xaxis, f"{jump} [{length}]", np.abs(x).max())
    number_ends(axes, rows, x, y)


def has(rows: Array, name: str) -> bool:
    """True of a column of the CSV."""
    return name in (rows.dtype.names or ())


def own(rows: Array, name: str) -> Array:
    """A variable of the law; zero where it has no such one."""
    return rows[name] if has(rows, name) else np.zeros(len(rows))


def gap_of(rows: Array) -> Array:
    """r_n - r_n^p: below zero the faces press on each other."""
    return rows["jump_n"] - rows["jump_n_plastic"]


def draw_gap(axes: Any, rows: Array, length: str) -> None:
    """The gap along the path, and the opening that the law keeps; the numbers are those of the other graphs."""
    gap, opening = gap_of(rows), own(rows, "opening")
    axes.axhline(0, color=PALE, linewidth=0.7, zorder=0)
    kept = opening - gap
    if opening.any() and kept.max() > TOGETHER * gap.max():
        axes.plot(rows["s"], opening, color=INK, linewidth=0.9, linestyle=DASHES, zorder=2, label="opening $o$ kept")
    trace(axes, rows["s"], gap, rows["status"])
    axes.set(xlabel="point of the path", xlim=(0, rows["s"][-1]))
    page.scale_axis(axes.yaxis, f"gap [{length}]", np.abs(gap).max())
    axes.set_xticks(np.arange(int(rows["s"][-1]) + 1))
    axes.grid(axis="x")


def draw(rows: Array, work: Array, label: str, units: tuple[str, str]) -> tuple[Figure, Axes]:
    """The page: curves, surface and, where the faces part, the gap."""
    parts = np.isin(rows["status"], (OPEN, TIED)).any() and gap_of(rows).max() > 0
    rooms: list[Any] = [["n", "t"], ["plane", "gap"]] if parts else [["plane", "n"], ["plane", "t"]]
    figure, axes = plt.subplot_mosaic(rooms, figsize=(WIDTH, HEIGHT))
    left, right = page.LEFT / WIDTH, 1 - page.RIGHT / WIDTH
    bottom, top = page.BOTTOM / HEIGHT, 1 - page.TOP / HEIGHT
    figure.subplots_adjust(left=left, right=right, bottom=bottom, top=top, wspace=0.28, hspace=0.3)
    draw_curve(axes["n"], rows, "n", ("normal traction σ", "normal jump $u_n$"), units)
    draw_curve(axes["t"], rows, "t", ("shear traction τ", "shear jump $u_t$"), units)
    draw_stress_plane(axes["plane"], rows, work, label, units[0])
    if parts:
        draw_gap(axes["gap"], rows, units[1])
    seen = [STATUS[kind] for kind in STATUS if (rows["status"][1:] == kind).any()]
    keys = [sign(text, colour, linewidth=2.4) for text, colour in seen]
    page.key_below(figure, keys + [line for axis in axes.values() for line in axis.get_legend_handles_labels()[0]])
    return figure, axes[rooms[0][0]]


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", help="the rows of the path; - reads standard input")
    parser.add_argument("--scene", help="scene.json with the law of the point")
    parser.add_argument("--interface", help="name of the interface in that scene")
    parser.add_argument("-o", "--output", type=Path, help="picture to write (default: the CSV's name with .png)")
    parser.add_argument("--title", default="One point of a law", help="title of the picture")
    parser.add_argument("--subtitle", default="", help="what the picture shows")
    units: dict[str, Any] = {"nargs": 2, "metavar": ("STRESS", "LENGTH"), "default": ("MPa", "m")}
    parser.add_argument("--units", help="what the numbers mean, default: MPa m", **units)
    arguments = parser.parse_args()
    if bool(arguments.scene) != bool(arguments.interface):
        parser.error("--scene and --interface go together")

    rows = read("/dev/stdin" if arguments.csv == "-" else arguments.csv)
    if len(rows) < 2:
        raise SystemExit(f"{arguments.csv}: a path needs two rows or more")
    stress, length = arguments.units
    scale, label = 1.0, f"W = ? {stress}·{length}"
    if arguments.scene:
        mode_i = energy_i(arguments.scene, arguments.interface)
        if mode_i:
            scale, label = mode_i, "$W / G_I$ = ?"
    plt.rcParams.update(page.STYLE)
    figure, corner = draw(rows, own(rows, "fracture_work") / scale, label, arguments.units)
    page.heading(corner, arguments.title, arguments.subtitle)
    beside = Path("path" if arguments.csv == "-" else arguments.csv).with_suffix(".png")
    page.save(figure, arguments.output or beside)


if __name__ == "__main__":
    told(main)
