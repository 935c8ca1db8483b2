"""Draw the tables of scenes.py and peers/compare.py: time against dofs, cost of an iteration against dofs.

    .venv/bin/python benches/plot.py results/bench/scenes.csv [results/bench/peers.csv ...] -o docs/bench.png"""

import argparse
import csv
from collections import defaultdict
from pathlib import Path

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402

COLOURS = {"elastic": "tab:blue", "friction": "tab:orange", "cracking": "tab:red"}
MARKERS = {"NGSolve": "s", "scikit-fem": "^", "GetFEM": "D", "CalculiX": "v"}


def read(path):
    lines = Path(path).read_text().splitlines()
    about = lines[0].removeprefix("# ")
    return about, list(csv.DictReader(line for line in lines if not line.startswith("#")))


def curves(rows, y, scale=1.0):
    """Points (dofs, y) by scene, those without a value left out."""
    found = defaultdict(list)
    for row in rows:
        if row[y] not in ("", "0"):
            found[row["scene"]].append((int(row["dofs"]), scale * float(row[y])))
    return {scene: sorted(points) for scene, points in found.items()}


def fastest(peers, y):
    """The fastest program of every peer by scene, and size: (scene, peer) to {dofs: value}."""
    found = defaultdict(dict)
    for row in peers:
        if not row["program"].startswith("midplane") and row[y]:
            by_size, value = found[row["scene"], row["program"].split()[0]], float(row[y])
            by_size[int(row["dofs"])] = min(value, by_size.get(int(row["dofs"]), value))
    return found


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scenes")
    parser.add_argument("peers", nargs="*")
    parser.add_argument("-o", "--out", default="results/bench/bench.png")
    options = parser.parse_args()
    about, rows = read(options.scenes)
    peers = [row for path in options.peers for row in read(path)[1]]

    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 4.6), layout="constrained")
    for scene, points in curves(rows, "seconds").items():
        left.plot(*zip(*points), "o-", color=COLOURS[scene], label=f"midplane, {scene}")
    for (scene, peer), points in fastest(peers, "seconds").items():
        style = dict(color=COLOURS[scene], marker=MARKERS[peer], linestyle="--", markerfacecolor="none")
        left.plot(*zip(*sorted(points.items())), **style, label=f"{peer}, {scene}")
    left.plot(*zip(*curves(rows, "factor")["elastic"]), ":", color="grey", label="one factorisation")
    left.set(ylabel="whole process [s]", title="From .msh to .vtu")

    for scene, points in curves(rows, "iteration", 1e3).items():
        right.plot(*zip(*points), "o-", color=COLOURS[scene], label=f"midplane, {scene}")
    for (scene, peer), points in fastest(peers, "iteration").items():
        style = dict(color=COLOURS[scene], marker=MARKERS[peer], linestyle="--", markerfacecolor="none")
        points = [(dofs, 1e3 * seconds) for dofs, seconds in sorted(points.items())]
        right.plot(*zip(*points), **style, label=f"{peer}, {scene}")
    right.plot(*zip(*curves(rows, "factor", 1e3)["elastic"]), ":", color="grey", label="one factorisation")
    right.set(ylabel="one Newton iteration [ms]", title="Cost of an iteration")
    for axes in (left, right):
        axes.set(xscale="log", yscale="log", xlabel="dofs")
        axes.grid(True, which="both", alpha=0.2)
        axes.legend(fontsize=8)
    figure.supxlabel(about, fontsize=6, color="grey")
    figure.savefig(options.out, dpi=120)


if __name__ == "__main__":
    main()
