"""Draw the tables of scenes.py and peers/compare.py: time against dofs, cost of an iteration against dofs.

    .venv/bin/python benches/plot.py results/bench/scenes.csv [results/bench/peers.csv ...] -o docs/bench.png"""

import argparse
import csv
import sys
from collections import defaultdict
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "pipeline"))

import matplotlib.pyplot as plt  # noqa: E402

from midplane.pictures import page  # noqa: E402
from midplane.pictures.page import BLUE, GREY, ORANGE, VERMILLION, sign  # noqa: E402

COLOURS = {"elastic": BLUE, "friction": ORANGE, "cracking": VERMILLION}
OURS = {"marker": "o", "markersize": 4.5, "linewidth": 1.4}
MARKERS = {"NGSolve": "s", "scikit-fem": "^", "GetFEM": "D", "CalculiX": "v"}
THEIRS = {"linestyle": "--", "markerfacecolor": "none", "markersize": 4.5, "linewidth": 1.0}
FACTOR = {"linestyle": ":", "linewidth": 1.2, "marker": "."}


def read(path):
    lines = Path(path).read_text().splitlines()
    about = lines[0].removeprefix("# ")
    return about, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def curves(rows, y):
    """Points (dofs, y) by scene, those without a value left out."""
    found = defaultdict(list)
    for row in rows:
        if row[y] not in ("", "0"):
            found[row["scene"]].append((int(row["dofs"]), float(row[y])))
    return {scene: sorted(points) for scene, points in found.items()}


def fastest(peers, y):
    """The fastest program of every peer by scene, and size: (scene, peer) to {dofs: value}."""
    found = defaultdict(dict)
    for row in peers:
        if not row["program"].startswith("midplane") and row[y]:
            by_size, value = found[row["scene"], row["program"].split()[0]], float(row[y])
            by_size[int(row["dofs"])] = min(value, by_size.get(int(row["dofs"]), value))
    return found


def draw(axis, rows, peers, y, text):
    """One time against dofs: this program, its peers, one factorisation."""
    for scene, points in curves(rows, y).items():
        axis.plot(*zip(*points), color=COLOURS[scene], zorder=3, **OURS)
    for (scene, peer), points in fastest(peers, y).items():
        axis.plot(*zip(*sorted(points.items())), color=COLOURS[scene], marker=MARKERS[peer], **THEIRS)
    axis.plot(*zip(*curves(rows, "factor")["elastic"]), color=GREY, **FACTOR)
    axis.set(xscale="log", yscale="log", xlabel="dofs")
    axis.grid(True, which="major")
    page.caption(axis, text)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes", help="the table of scenes.py")
    parser.add_argument("peers", nargs="*", help="tables of peers/compare.py")
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
