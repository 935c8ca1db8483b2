"""Draw the tables of bench.scenes and bench.peers.compare: time against dofs, cost of an iteration against dofs.

python -m midplane_pipeline.bench.plot results/bench/scenes.csv [results/bench/peers.csv ...] -o docs/bench.png"""

import argparse
from collections import defaultdict
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
from matplotlib.axes import Axes
from midplane.pictures import page
from midplane.pictures.page import BLUE, GREY, ORANGE, VERMILLION, sign

from .table import Row, read

COLOURS: dict[str, Any] = {"elastic": BLUE, "friction": ORANGE, "cracking": VERMILLION}
OURS: dict[str, Any] = {"marker": "o", "markersize": 4.5, "linewidth": 1.4}
MARKERS = {"NGSolve": "s", "scikit-fem": "^", "GetFEM": "D", "CalculiX": "v"}
THEIRS: dict[str, Any] = {"linestyle": "--", "markerfacecolor": "none", "markersize": 4.5, "linewidth": 1.0}
FACTOR: dict[str, Any] = {"linestyle": ":", "linewidth": 1.2, "marker": "."}


def curves(rows: list[Row], y: str) -> dict[str, list[tuple[int, float]]]:
    """Points (dofs, y) by scene, those without a value left out."""
    found: dict[str, list[tuple[int, float]]] = defaultdict(list)
    for row in rows:
        if row[y] not in ("", "0"):
            found[row["scene"]].append((int(row["dofs"]), float(row[y])))
    return {scene: sorted(points) for scene, points in found.items()}


def fastest(peers: list[Row], y: str) -> dict[tuple[str, str], dict[int, float]]:
    """The fastest program of every peer by scene, and size: (scene, peer) to {dofs: value}."""
    found: dict[tuple[str, str], dict[int, float]] = defaultdict(dict)
    for row in peers:
        if not row["program"].startswith("midplane") and row[y]:
            by_size, value = found[row["scene"], row["program"].split()[0]], float(row[y])
            by_size[int(row["dofs"])] = min(value, by_size.get(int(row["dofs"]), value))
    return found


def draw(axis: Axes, rows: list[Row], peers: list[Row], y: str, text: str) -> None:
    """One time against dofs: this program, its peers, one factorisation."""
    for scene, points in curves(rows, y).items():
        axis.plot(*zip(*points, strict=True), color=COLOURS[scene], zorder=3, **OURS)
    for (scene, peer), by_size in fastest(peers, y).items():
        axis.plot(*zip(*sorted(by_size.items()), strict=True), color=COLOURS[scene], marker=MARKERS[peer], **THEIRS)
    axis.plot(*zip(*curves(rows, "factor")["elastic"], strict=True), color=GREY, **FACTOR)
    axis.set(xscale="log", yscale="log", xlabel="dofs")
    axis.grid(True, which="major")
    page.caption(axis, text)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", help="the table of bench.scenes")
    parser.add_argument("peers", nargs="*", help="tables of bench.peers.compare")
    parser.add_argument("-o", "--out", type=Path, default="results/bench/bench.png")
    options = parser.parse_args()
    about, rows = read(options.scenes)
    peers = [row for path in options.peers for row in read(path)[1]]
    plt.rcParams.update(page.STYLE)
    figure, (left, right) = page.graphs(1, 4.2, columns=2, raised=page.CAPTION, sharey=False)
    figure.subplots_adjust(wspace=0.2)
    draw(left, rows, peers, "seconds", "from .msh to .vtu")
    draw(right, rows, peers, "iteration", "one iteration")
    left.set_ylabel("time [s]")
    scenes = dict.fromkeys(row["scene"] for row in [*rows, *peers])
    there = dict.fromkeys(peer for _, peer in fastest(peers, "seconds"))
    keys = [sign(scene, COLOURS[scene], linewidth=3) for scene in scenes]
    keys += [sign("midplane", GREY, **OURS), *(sign(peer, GREY, marker=MARKERS[peer], **THEIRS) for peer in there)]
    page.key_below(figure, [*keys, sign("one factorisation", GREY, **FACTOR)])
    page.heading(left, "Time against size", about, raised=page.CAPTION)
    page.save(figure, options.out)


if __name__ == "__main__":
    main()
