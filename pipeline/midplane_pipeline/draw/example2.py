"""Shear stress over tangential jump of the paper's Example 2 (its figure 8), at several pressures.

Runs every scene given at 1, 5 and 20 MPa, drives one point of its law along the same jumps, and draws the runs over
the curves of the point: RESULTS/pictures/example2.png. The runs stay in RESULTS/<scene file>_<pressure>/.
"""

import argparse
import json
import subprocess
import sys
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from midplane.pictures import page
from midplane.pictures.page import DASHES, GREY, PALE, RUNS, sign
from midplane.vtu import Array, Vtu

from midplane_pipeline.results.columns import Columns, read
from midplane_pipeline.results.told import told

PRESSURES = [1, 5, 20]
MM = 1e-3  # m


def run(program: str, scene: Path, pressure: float, folder: Path) -> tuple[Columns, float]:
    """The scene at a pressure: its history, and the largest difference of two law points at any time [stress]."""
    setting = f"/steps/0/load/upper.top/pressure={pressure}"
    subprocess.run([program, "run", scene, "-o", folder, "--set", setting, "--quiet"], check=True)
    pressed = json.loads(scene.read_text())  # for the check
    pressed["steps"][0]["load"]["upper.top"]["pressure"] = pressure
    (folder / "scene.json").write_text(json.dumps(pressed, indent=2))
    fields = (Vtu(path).point_data["traction"] for path in folder.glob("fields/joint_*.vtu"))
    return read(folder), max(np.ptp(field, axis=0).max() for field in fields)


def drive(program: str, scene: Path, path: Path, pressure: float, folder: Path) -> tuple[Array, Array]:
    """One point of the law along the path, under another pressure: jump and shear stress."""
    program_at = json.loads(path.read_text())
    for segment in program_at["program"]:
        segment["n"].update({end: -pressure for end in ("start", "end") if segment["n"][end]})
    (folder / "path.json").write_text(json.dumps(program_at, indent=2))
    command: list[str | Path] = [program, "law", scene, "joint", folder / "path.json", "--tolerance", "1e-8"]
    csv = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    (folder / "point.csv").write_text(csv)
    rows = np.genfromtxt(folder / "point.csv", delimiter=",", names=True)
    return rows["jump_t"], rows["traction_t"]


def draw(axis: Axes, runs: list[Any], friction: float) -> None:
    """The runs of one scene: (pressure, history, curve of the point)."""
    for colour, (pressure, history, (jump, stress)) in zip(RUNS, runs, strict=False):
        axis.plot(jump / MM, stress, color=PALE, linewidth=5, solid_capstyle="butt", zorder=1)
        dots: dict[str, Any] = {"marker": "o", "markersize": 2.6, "linestyle": "none", "clip_on": False, "zorder": 5}
        axis.plot(history["jump_t"] / MM, history["tau"], color=colour, **dots)
        axis.axhline(friction * pressure, color=GREY, linewidth=0.8, linestyle=DASHES, zorder=2)
        text = f"$\\sigma$ = −{pressure} MPa"
        place: dict[str, Any] = {"xytext": (0, 7), "textcoords": "offset points", "ha": "right", "color": colour}
        axis.annotate(text, (jump[-1] / MM, stress[-1]), **place)
    axis.set(xlim=(0, jump[-1] / MM), xlabel="tangential jump $\\delta_t$ [mm]")
    axis.grid(axis="y")
    axis.xaxis.set_major_formatter("{x:g}")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", help="midplane")
    parser.add_argument("path", type=Path, help="path of the point, such as geo/shear/path.json")
    parser.add_argument("results", type=Path, help="where to leave all, such as results/shear")
    parser.add_argument("scenes", type=Path, nargs=2, help="scene files, a panel each")
    within = "what the runs may be off the curves of one point, of the peak"
    parser.add_argument("--within", type=float, help=within)
    arguments = parser.parse_args()
    plt.rcParams.update(page.STYLE)

    figure, axes = page.graphs(1, 3.9, columns=2)
    spread = deviation = 0.0
    for axis, scene in zip(axes, arguments.scenes, strict=True):
        law = json.loads(scene.read_text())["interfaces"]["joint"]["law"]
        runs = []
        for pressure in PRESSURES:
            folder = arguments.results / f"{scene.stem}_{pressure}"
            history, apart = run(arguments.program, scene, pressure, folder)
            curve = drive(arguments.program, scene, arguments.path, pressure, folder)
            runs.append((pressure, history, curve))
            shear = history["jump_t"] > 0
            exact = np.interp(history["jump_t"][shear], *curve)
            spread = max(spread, apart / curve[1].max())
            deviation = max(deviation, np.abs(history["tau"][shear] - exact).max() / curve[1].max())
        draw(axis, runs, law["tan_friction"])
        energies = [law["fracture_energy_i"], law["fracture_energy_iia"]]
        text = "$G_I$ = {:g}, $G_{{IIa}}$ = {:g} MPa·m".format(*energies)
        axis.annotate(text, (0.03, 0.95), xycoords="axes fraction")
    print(f"{arguments.results}: off the curves of one point by {deviation:.1e} of the peak")
    if arguments.within is not None and max(spread, deviation) > arguments.within:
        sys.exit(f"{arguments.results}: that, or {spread:.1e} between law points, is more than {arguments.within:g}")
    axes[0].set(ylim=(0, 26), ylabel="shear stress $\\tau$ [MPa]")
    title = "The mesh carries the curve of one point"
    subtitle = f"Example 2: law points apart by at most {page.power_of_ten(spread)} of the peak, from the curve of one point by {page.power_of_ten(deviation)}"
    page.heading(axes[0], title, subtitle)
    page.key_below(
        figure,
        [
            sign("two unmatched layers", RUNS[0], marker="o", markersize=2.6, linestyle="none"),
            sign("one point of the law", PALE, linewidth=5),
            sign("friction $|\\sigma|\\,\\tan\\varphi_0$", GREY, linewidth=0.8, linestyle=DASHES),
        ],
    )
    page.save(figure, arguments.results / "pictures" / "example2.png")


if __name__ == "__main__":
    told(main)
