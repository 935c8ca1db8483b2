"""Draw what `midplane check SCENE --plot` wrote: how the parts are joined, before anything is solved.

  quality.png      all meshes, their cells coloured by quality (scaled Jacobian, 1 is best), and the joints
  INTERFACE.png    side A and side B moved apart along the normals, the segments of the mid-plane between
                   them with their feet on both sides, its grid, its law points and their normals

FOLDER is results/<scene>/check; the pictures go there.
"""

import argparse
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.collections import LineCollection
from midplane.pictures import page, plane
from midplane.pictures.page import BLUE, FACE, GREEN, INK, MAP, PALE, VERMILLION, sign
from midplane.pictures.plane import Page
from midplane.vtu import Array, Vtu

from midplane_pipeline.results.told import told

SEGMENT, GRID, EDGE_A, EDGE_B, FOOT_A, FOOT_B, LAW_POINT = range(7)
APART = 0.05  # of the interface's extent: how far each side is moved


class Joint:
    """The lines and points of one interface by their kind."""

    def __init__(self, path: Path) -> None:
        self.name = path.stem
        grid = Vtu(path).grid()
        kinds, points = grid["kind"], grid.points[:, :2]
        cells = np.split(grid.cell_connectivity, grid.cell_offsets[1:-1])
        self.lines = {kind: [points[cells[i]] for i in np.flatnonzero(kinds == kind)] for kind in range(LAW_POINT)}
        at = np.concatenate([cells[i] for i in np.flatnonzero(kinds == LAW_POINT)])
        self.law_points, self.normals = points[at], grid["normal"][at, :2]
        self.parents = {EDGE_A: set(grid["edge_a"][kinds == SEGMENT]), EDGE_B: set(grid["edge_b"][kinds == SEGMENT])}
        self.ends = np.concatenate(self.lines[SEGMENT])
        self.extent = np.ptp(self.ends, axis=0).max()

    def normal(self, points: Array) -> Array:
        """At points, the normal of the nearest law point."""
        distance = np.linalg.norm(points[:, None] - self.law_points[None], axis=2)
        return self.normals[distance.argmin(axis=1)]

    def moved(self, line: Array, shift: float) -> Array:
        """A line moved along the normals."""
        return line + shift * self.normal(line)


def draw_joint(joint: Joint, meshes: list[Any], units: str, folder: Path) -> None:
    """Both sides pulled apart along the normals; between them segments, grid and law points."""
    shift = APART * joint.extent
    count = {kind: len(lines) for kind, lines in joint.lines.items()}
    subtitle = f"{count[SEGMENT]} segments, {count[GRID]} cells of the grid, {len(joint.law_points)} law points"
    points = np.concatenate([joint.ends, joint.law_points])
    air = 3 * shift
    (x0, y0), (x1, y1) = points.min(axis=0) - air, points.max(axis=0) + air
    sheet = Page(((x0, x1), (y0, y1)), joint.name, subtitle)
    sheet.label(units)
    sheet.render(meshes, "#DCDCD9", color=FACE)
    axis = sheet.axis
    feet: dict[str, Any] = {"linewidths": 0.6, "zorder": 3}
    for kind, foot, colour, way in ((EDGE_A, FOOT_A, BLUE, -shift), (EDGE_B, FOOT_B, VERMILLION, shift)):
        for joined, alpha in ((True, 1.0), (False, 0.35)):
            numbered = enumerate(joint.lines[kind])
            chosen = [line for number, line in numbered if (number in joint.parents[kind]) == joined]
            lines = [joint.moved(line, way) for line in chosen]
            axis.add_collection(LineCollection(lines, colors=colour, linewidths=1.1, alpha=alpha, zorder=5))
            ends = np.array([line[i] for line in lines for i in (0, -1)]).reshape(-1, 2)
            axis.plot(*ends.T, linestyle="", marker="o", markersize=3.2, color=colour, alpha=alpha, zorder=6)
        lines = [np.stack([line[0], joint.moved(line[1:], way)[0]]) for line in joint.lines[foot]]
        axis.add_collection(LineCollection(lines, colors=colour, linestyles=(0, (3, 2)), **feet))
    axis.add_collection(LineCollection(joint.lines[SEGMENT], colors=PALE, linewidths=4, zorder=4))
    posts = np.array([line[i] for line in joint.lines[GRID] for i in (0, -1)]).reshape(-1, 2)
    if len(posts):
        across = 0.35 * shift * joint.normal(posts)
        posts = np.stack([posts - across, posts + across], axis=1)
        axis.add_collection(LineCollection(list(posts), colors=INK, linewidths=1.4, zorder=7))
    axis.plot(*joint.law_points.T, linestyle="", marker="o", markersize=3, color=GREEN, zorder=8)
    arrows = np.stack([joint.law_points, joint.law_points + 0.6 * shift * joint.normals], axis=1)
    axis.add_collection(LineCollection(list(arrows), colors=GREEN, linewidths=0.8, zorder=8))
    post: dict[str, Any] = {"linestyle": "", "marker": "|", "markersize": 9, "markeredgewidth": 1.6}
    dots: dict[str, Any] = {"marker": "o", "markersize": 3.6}
    keys = [
        sign("side A", BLUE, linewidth=1.1, **dots),
        sign("side B", VERMILLION, linewidth=1.1, **dots),
        sign("segments", PALE, linewidth=4),
        *([sign("grid", INK, **post)] if len(posts) else []),
        sign("law points, normals", GREEN, linewidth=0.8, **dots),
    ]
    sheet.key(keys)
    page.save(sheet.figure, folder / f"{joint.name}.png")


def draw_quality(joints: list[Joint], meshes: list[Any], units: str, folder: Path) -> None:
    """The meshes, coloured by the quality of their cells, and the joints."""
    worst = min(mesh["quality"].min() for mesh in meshes)
    levels, colours = np.linspace(0, 1, 11), plt.get_cmap(MAP, 10)
    subtitle = f"scaled Jacobian of the cells, the worst {worst:.2f}; joints in orange"
    sheet = Page(plane.frame(meshes), "quality of the meshes", subtitle, bar=plane.BAR)
    sheet.label(units)
    sheet.render(meshes, "#2B2B2B", scalars="quality", cmap=colours, clim=(0, 1))
    sheet.colour_bar(levels, colours, "quality")
    for joint in joints:
        sheet.axis.add_collection(LineCollection(joint.lines[SEGMENT], colors=VERMILLION, linewidths=1.6, zorder=3))
    page.save(sheet.figure, folder / "quality.png")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path, help="such as results/compression/check")
    parser.add_argument("--units", default="m", help="unit of length, default: m")
    arguments = parser.parse_args()
    plt.rcParams.update(page.STYLE)
    files = sorted(arguments.folder.glob("*.vtu"))
    if not files:
        parser.error(f"{arguments.folder} holds no .vtu: run midplane check SCENE --plot")
    if not plane.can_render():
        print("no library for off-screen rendering (libosmesa6 or libegl1): nothing drawn")
        return
    grids = {path: Vtu(path).grid() for path in files}
    meshes = [grid for grid in grids.values() if "quality" in grid.cell_data]
    joints = [Joint(path) for path, grid in grids.items() if "kind" in grid.cell_data]
    draw_quality(joints, meshes, arguments.units, arguments.folder)
    for joint in joints:
        draw_joint(joint, meshes, arguments.units, arguments.folder)


if __name__ == "__main__":
    told(main)
