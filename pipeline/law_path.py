#!/usr/bin/env python3
"""Draw the path of one law point: on the evolving cracking surface (paper, figure 3) and as traction-jump curves.

Reads the CSV that `midplane law SCENE INTERFACE PATH.json` prints. With --scene the fracture energies of that
interface scale the colours (1 is G_I spent); without it the colours are the work itself.

    midplane law geo/shear joint path.json > path.csv
    python3 pipeline/law_path.py path.csv --scene geo/shear/scene.json --interface joint -o path.png

Needs numpy and matplotlib.
"""

import argparse
import json
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize

STATUS = {0: "elastic or stick", 1: "T: tension", 2: "C: compression or slip", 3: "Z: σ held at 0", 4: "A: open"}
COLOUR = {0: "0.6", 1: "tab:red", 2: "tab:blue", 3: "tab:purple", 4: "tab:green"}


def read(csv):
    """The columns of the CSV by name; empty fields (the elastic law has no strength) are NaN."""
    rows = np.genfromtxt(csv, delimiter=",", names=True, dtype=float)
    return np.atleast_1d(rows)


def energies(scene, interface):
    """Fracture energies (mode I, mode IIa) of an interface of a scene, None where there are none."""
    interfaces = json.loads(Path(scene).read_text())["interfaces"]
    if interface not in interfaces:
        raise SystemExit(f"{scene}: no interface \"{interface}\"; there is {', '.join(interfaces)}")
    law = interfaces[interface]["law"]
    return law.get("fracture_energy_i"), law.get("fracture_energy_iia")


def hyperbola(row, sigma):
    """|tau| on the surface of one row: the square root of (c - sigma t)^2 - (c - chi t)^2 for sigma up to chi."""
    chi, c, t = row["tensile_strength"], row["cohesion"], row["tan_friction"]
    inside = t * (chi - sigma) * (2 * c - t * (chi + sigma))
    return np.where(sigma <= chi, np.sqrt(np.maximum(inside, 0)), np.nan)


def stages(rows, count):
    """Indices of rows that spread evenly over the loss of strength, the first and the last included."""
    strength = rows["tensile_strength"] + rows["cohesion"] + rows["tan_friction"]
    lost = strength[0] - strength
    if lost[-1] <= 0:
        return [0]
    wanted = np.linspace(0, lost[-1], count)
    return sorted({int(np.argmin(np.abs(lost - value))) for value in wanted})


def draw_stress_plane(axes, rows, work, norm, cmap):
    """The surfaces at a few stages, and the path coloured by the work spent."""
    sigma, tau = rows["traction_n"], rows["traction_t"]
    chi = np.nan_to_num(rows["tensile_strength"]).max()
    reach = max(sigma.max() - sigma.min(), np.abs(tau).max(), chi, 1e-300)
    low, high = min(sigma.min(), 0) - 0.25 * reach, max(sigma.max(), chi) + 0.05 * reach
    if np.isfinite(rows["cohesion"]).all():
        for k in stages(rows, 6):
            row = rows[k]
            points = row["tensile_strength"] - (row["tensile_strength"] - low) * np.linspace(0, 1, 400) ** 2
            limit = hyperbola(row, points)
            for side in (limit, -limit):
                axes.plot(points, side, color=cmap(norm(work[k])), lw=1.0, alpha=0.85, zorder=1)
    points = np.column_stack([sigma, tau])
    line = LineCollection(np.stack([points[:-1], points[1:]], axis=1), cmap=cmap, norm=norm, lw=2.6, zorder=3)
    line.set_array(0.5 * (work[:-1] + work[1:]))
    axes.add_collection(line)
    axes.plot(sigma[0], tau[0], "o", color="k", ms=5, zorder=4, label="start")
    axes.plot(sigma[-1], tau[-1], "s", color="k", ms=5, zorder=4, label="end")
    axes.axhline(0, color="0.85", lw=0.8, zorder=0)
    axes.axvline(0, color="0.85", lw=0.8, zorder=0)
    limit = 1.12 * max(np.abs(tau).max(), 0.6 * reach)
    bottom = -limit if tau.min() < -0.02 * limit else -0.12 * limit
    axes.set(xlim=(low, high), ylim=(bottom, limit), xlabel="normal traction σ", ylabel="shear traction τ")
    axes.set_title("path on the cracking surface")
    axes.legend(loc="upper right", frameon=False)
    return line


def draw_curve(axes, rows, component, name, symbol):
    """One traction against its jump, coloured by what the point does on the way to each row."""
    jump, traction = rows[f"jump_{component}"], rows[f"traction_{component}"]
    status = rows["status"].astype(int)
    axes.axhline(0, color="0.85", lw=0.8, zorder=0)
    for kind, colour in COLOUR.items():
        x, y = np.full((2, 3 * len(jump)), np.nan)
        for k in np.flatnonzero(status[1:] == kind) + 1:
            x[3 * k : 3 * k + 2], y[3 * k : 3 * k + 2] = jump[k - 1 : k + 1], traction[k - 1 : k + 1]
        if np.isfinite(x).any():
            axes.plot(x, y, color=colour, lw=1.8, label=STATUS[kind])
    if len(jump) <= 60:
        axes.plot(jump, traction, ".", color="k", ms=3, zorder=3)
    axes.ticklabel_format(axis="x", style="sci", scilimits=(-2, 3))
    axes.set(xlabel=f"{name} jump", ylabel=f"{name} traction {symbol}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("csv", help="the rows of the path; - reads standard input")
    parser.add_argument("--scene", help="scene.json with the law of the point")
    parser.add_argument("--interface", help="name of the interface in that scene")
    parser.add_argument("-o", "--output", help="picture to write (default: the CSV's name with .png)")
    parser.add_argument("--title", default="", help="title of the picture")
    arguments = parser.parse_args()
    if bool(arguments.scene) != bool(arguments.interface):
        parser.error("--scene and --interface go together")

    rows = read("/dev/stdin" if arguments.csv == "-" else arguments.csv)
    if len(rows) < 2:
        raise SystemExit(f"{arguments.csv}: a path needs two rows or more")
    scale, label = 1.0, "fracture work $W$"
    if arguments.scene:
        mode_i, _ = energies(arguments.scene, arguments.interface)
        if mode_i:
            scale, label = mode_i, "fracture work $W / G_I$"
    work = rows["fracture_work"] / scale
    cmap, norm = matplotlib.colormaps["viridis"], Normalize(0, max(work.max(), 1e-300))

    figure = plt.figure(figsize=(11, 5.2), layout="constrained")
    grid = figure.add_gridspec(2, 2, width_ratios=(1.25, 1))
    plane = figure.add_subplot(grid[:, 0])
    line = draw_stress_plane(plane, rows, work, norm, cmap)
    figure.colorbar(line, ax=plane, label=label, pad=0.02)
    top, bottom = figure.add_subplot(grid[0, 1]), figure.add_subplot(grid[1, 1])
    draw_curve(top, rows, "n", "normal", "σ")
    draw_curve(bottom, rows, "t", "shear", "τ")
    handles = {text: handle for axes in (top, bottom) for handle, text in zip(*axes.get_legend_handles_labels())}
    top.legend(handles.values(), handles.keys(), fontsize="small", frameon=False, ncols=2, loc="lower center",
               bbox_to_anchor=(0.5, 1.0))
    if arguments.title:
        figure.suptitle(arguments.title)
    output = arguments.output or ("path.png" if arguments.csv == "-" else str(Path(arguments.csv).with_suffix(".png")))
    figure.savefig(output, dpi=150)


if __name__ == "__main__":
    main()
