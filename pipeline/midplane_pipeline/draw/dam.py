"""Draw how far the crack under a dam has come and how far its crest has moved over the water level: RESULTS/pictures/dam.png.

Runs of other files of the scene stand beside it, and crack lengths that were published for such a dam. Force and moment of the joint, water
included, are compared with statics at every row whose fields are stored.
"""

import argparse
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from midplane import scene_file
from midplane.pictures import page
from midplane.pictures.page import GREY, INK, RUNS
from midplane.vtu import Vtu

from midplane_pipeline.results.columns import Columns, read
from midplane_pipeline.results.told import told

# what the files of the scene are, for the key
NAMES = {"scene": "pressure by opening", "flow": "flow with a drain", "workshop": "loads of the workshop"}
# tip of the crack from the heel [m] over the level [m], or 80 m times the share of the full reservoir: Valente et al., Frattura ed Integrità
# Strutturale 35 (2016), page 310
PUBLISHED = [(0.70 * 80, 7.2), (0.80 * 80, 12.0), (0.9496 * 80, 18.0), (80.28, 24.0)]
BASE, CREST, HEIGHT = 60.0, 5.0, 80.0  # dam.geo [m]
WATER, GRAVITY = 9.81e-3, 9.81  # weight of water [MN/m³], acceleration [m/s²]


def weight(scene: dict[str, Any]) -> tuple[float, float]:
    """Weight of the dam and its moment about the heel: a rectangle as wide as the crest and a triangle beside it."""
    heavy = GRAVITY * scene["materials"]["concrete"]["density"]
    strip, rest = CREST * HEIGHT, 0.5 * (BASE - CREST) * HEIGHT
    return heavy * (strip + rest), heavy * (strip * 0.5 * CREST + rest * (CREST + (BASE - CREST) / 3))


def push(level: float) -> tuple[float, float]:
    """Force of the water on the upstream face, above the crest too, and its moment about the heel."""
    top = min(level, HEIGHT)
    return WATER * top * (level - 0.5 * top), WATER * top**2 * (0.5 * level - top / 3)


def pushes(scene: dict[str, Any], run: Columns) -> list[Any]:
    """The same at every row: by its level, or as a share of the full reservoir where the pressures are stated without load_factor."""
    faces = [step.get("load", {}).get("dam.upstream") for step in scene["steps"]]
    by_level = any("load_factor" in face["pressure"] for face in faces if face)
    full = np.array(push(HEIGHT))
    return [push(level) if by_level else level / HEIGHT * full for level in run["level"]]


def off_statics(scene: dict[str, Any], folder: Path, run: Columns) -> float:
    """Largest error of normal force, shear force and moment about the heel over the rows stored, of the dam's weight and its moment."""
    own, turned = weight(scene)
    largest, compared = 0.0, 0
    for row, (thrust, moment) in enumerate(pushes(scene, run)):
        path = folder / "fields" / f"base_{row:04d}.vtu"
        # before the dam has its weight there is nothing to compare
        if run["normal"][row] > -0.5 * own or not path.is_file():
            continue
        field = Vtu(path)
        normal, shear = field.point_data["traction_total"].T
        length = field.point_data["length"]
        errors = (
            (length @ normal + own) / own,
            (length @ shear - thrust) / own,
            (length @ (normal * field.points[:, 0]) + turned + moment) / turned,
        )
        largest, compared = max(largest, *np.abs(errors)), compared + 1
    if not compared:
        sys.exit(f"{folder}: no row to compare with statics")
    return largest


def slides(scene: dict[str, Any], uplift: float) -> float:
    """The level at which friction alone no longer holds, the uplift being a share of that of the full pressure everywhere."""
    friction = scene["interfaces"]["base"]["law"]["tan_friction"]
    own, _ = weight(scene)
    # ½ γ h² = tan φ (W − u γ h B)
    b = friction * uplift * BASE
    return -b + np.sqrt(b**2 + 2 * friction * own / WATER)


def tips(scene: dict[str, Any]) -> float:
    """The level at which a rigid dam tips about its toe, the joint open and full of water."""
    own, turned = weight(scene)
    holds = own * BASE - turned
    levels = np.linspace(0, 2 * HEIGHT, 16001)
    loads = [push(level)[1] + 0.5 * WATER * level * BASE**2 for level in levels]
    return np.interp(holds, loads, levels)


def draw(runs: list[tuple[str, Columns]], marks: list[tuple[float, str]], title: str) -> Figure:
    """Crack and crest over the level."""
    figure, axes = page.graphs(2, 5.6 + page.KEY)
    for order, (label, run) in enumerate(runs):
        # from the dam under its weight on; cracks while the water rises
        start, top = np.flatnonzero(run["normal"] < 0.5 * run["normal"].min())[0], run["level"].argmax()
        rising, all_of_it = slice(start, top + 1), slice(start, None)
        moved = 1e3 * (run["crest"] - run["crest"][start])
        look: dict[str, Any] = {"color": RUNS[order], "linewidth": 1.2, "zorder": 5 - order}
        dots: dict[str, Any] = {"marker": "o", "markersize": 2.3}
        axes[0].plot(run["level"][rising], run["cracked"][rising], label=label, **look, **dots)
        axes[0].plot(run["level"][rising], run["open"][rising], linestyle=(0, (3, 2)), **look)
        axes[1].plot(run["level"][all_of_it], moved[all_of_it], **look, **dots)
    diamonds: dict[str, Any] = {"color": INK, "marker": "D", "markersize": 4.5, "linestyle": "none", "zorder": 6}
    axes[0].plot(*zip(*PUBLISHED, strict=True), label="published", **diamonds)
    axes[0].set(ylabel="length of the crack [m]", ylim=(0, None))
    axes[1].set(ylabel="crest [mm], downstream", xlabel="water level [m], or 80 m × share of the full reservoir", xlim=(0, None))
    for axis in axes:
        axis.grid(axis="y")
        axis.margins(x=0.02)
        for level, _ in marks:
            axis.axvline(level, color=GREY, linewidth=0.7, linestyle=(0, (4, 3)), zorder=0)
    for level, text in marks:
        place: dict[str, Any] = {"xycoords": ("data", "axes fraction"), "textcoords": "offset points", "rotation": 90}
        look = {"ha": "right", "va": "top", "color": "#555555", "fontsize": 7.5}
        axes[0].annotate(text, (level, 1), (-2, -2), **place, **look)
    page.key_below(figure, axes[0].get_legend_handles_labels()[0])
    figure.align_ylabels(axes)
    page.heading(axes[0], title, "crack while the water rises, dashed: its open part; crest from the empty reservoir on, there and back")
    return figure


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="the scene file, geo/dam/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/dam")
    parser.add_argument("--label", default="scene", help="name of this run in the key")
    other = "the run of another file of the scene"
    parser.add_argument("--compare", action="append", default=[], help=other, metavar="FILE=RESULTS")
    parser.add_argument("--within", type=float, help="what force and moment of the joint may be off statics, of the weight")
    arguments = parser.parse_args()
    scene = scene_file.read(arguments.scene)
    plt.rcParams.update(page.STYLE)

    runs = [(arguments.label, scene, arguments.results)]
    for text in arguments.compare:
        label, _, folder = text.partition("=")
        runs.append((label, scene_file.read(arguments.scene.parent / f"{label}.json"), Path(folder)))
    columns = [read(folder) for _, _, folder in runs]
    for (_, own, folder), run in zip(runs, columns, strict=True):
        largest = off_statics(own, folder, run)
        highest, far = run["level"].max(), run["cracked"].max()
        print(f"{folder}: off statics by {largest:.1e}; filled to {highest:.2f} m, cracked over {far:.2f} m")
        if arguments.within is not None and largest > arguments.within:
            sys.exit(f"{folder}: more than {arguments.within:g}")
    marks = [(slides(scene, 0.5), "friction alone slides"), (tips(scene), "rigid dam tips")]  # under linear and under full uplift
    print(f"friction alone slides at {slides(scene, 1.0):.2f} m under full uplift, at {slides(scene, 0.5):.2f} m under linear uplift")
    print(f"a rigid dam tips at {tips(scene):.2f} m under full uplift")
    figure = draw([(NAMES.get(label, label), run) for (label, _, _), run in zip(runs, columns, strict=True)], marks, scene["title"])
    page.save(figure, arguments.results / "pictures" / "dam.png")


if __name__ == "__main__":
    told(main)
