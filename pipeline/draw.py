"""Draw the results of one scene: pictures for a reader, one idea each, into RESULTS/pictures/.

  displacement.png         the deformed mesh, enlarged by the factor it states, coloured by displacement
  principal_stress.png     principal stresses as crosses in their directions, coloured by sign
  traction_INTERFACE.png   both components of the traction along the interface
  coupling_INTERFACE.png   the two meshes face to face, and between them how they are joined

All show the last increment stored. Meshes are rendered off-screen by VTK (through pyvista); without a
library for that (libosmesa6 or libegl1) only the graphs are drawn, and a line says so.
"""

import argparse
import json
import sys
from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator

import page
import scene_file
from exact import SOLUTIONS
from joints import entry_of
from page import BLUE, FACE, GREEN, GREY, INK, PALE, VERMILLION, Page, sign
from traction import deviation, draw_traction

ABSENT = -1  # status where a part is not there
FEW = 60  # segments that one picture can show


class Results:
    """The last stored increment of one results folder."""

    def __init__(self, folder, scene):
        self.folder = folder
        self.pictures = folder / "pictures"
        files = {path.stem.rpartition("_")[::2]: path for path in sorted(folder.glob("fields/*_*.vtu"))}
        last = max((number for _, number in files), key=int, default=None)
        fields = {name: pyvista.read(path) for (name, number), path in files.items() if number == last}
        self.subdomains = {name: field for name, field in fields.items() if name in scene["subdomains"]}
        self.interfaces = {name: field for name, field in fields.items() if name not in self.subdomains}

    def bodies(self, window=None):
        """The parts that are there, all of them or their cells in a window ((x0, x1), (y0, y1))."""
        there = [mesh for mesh in self.subdomains.values() if mesh.cell_data.get("present", np.ones(1)).any()]
        if window is None:
            return there
        low, high = np.transpose(window)

        def cut(mesh):
            centres = mesh.cell_centers().points[:, :2]
            return mesh.extract_cells(((low <= centres) & (centres <= high)).all(axis=1))

        return [part for part in map(cut, there) if part.n_cells]

    def sides(self, name):
        """The subdomains of side A and of side B, each as a list."""
        summary = json.loads((self.folder / "summary.json").read_text())
        return [[subdomain] for subdomain in summary["sizes"]["interfaces"][name]["subdomains"]]

    def midplane(self, name):
        """Mid-plane of an interface: its points, the ends of its segments and of its grid cells, parents."""
        grid = pyvista.read(self.folder / "midplane" / f"{name}.vtu")
        lines, kind = grid.cell_connectivity.reshape(-1, 2), grid["kind"]
        parents = np.column_stack([grid["edge_a"], grid["edge_b"]])[kind == 0]
        return grid.points[:, :2], lines[kind == 0], lines[kind == 1], parents


def draw_displacement(results, title, units, window):
    """The deformed mesh over the outline of the undeformed one."""
    meshes = results.bodies(window)
    size = max(np.ptp(bounds) for bounds in page.frame(meshes, margin=0.0))
    largest = max(np.linalg.norm(mesh["displacement"], axis=1).max() for mesh in meshes)
    factor = page.round_down(0.1 * size / largest) if largest > 0 else 1.0
    unit, label = page.scaled(largest, units.length)
    deformed = []
    for mesh in meshes:
        moved = mesh.copy()
        moved.points = mesh.points + factor * mesh["displacement"]
        moved["magnitude"] = np.linalg.norm(mesh["displacement"], axis=1) / unit
        deformed.append(moved)
    levels = MaxNLocator(12).tick_values(0, largest / unit or 1.0)
    colours = plt.get_cmap("viridis", len(levels) - 1)

    subtitle = f"deformed mesh, displacements enlarged {factor:,.15g} times; dashed: before loading"
    sheet = Page(page.frame([*meshes, *deformed]), title, subtitle, bar=page.BAR)
    sheet.axis.set(xlabel=f"x [{units.length}]", ylabel=f"y [{units.length}]")
    for mesh in meshes:
        dashes = {"colors": GREY, "linewidths": 0.8, "linestyles": (0, (4, 3)), "zorder": 0}
        sheet.axis.add_collection(LineCollection(outline(mesh), **dashes))
    sheet.render(deformed, "#2B2B2B", scalars="magnitude", cmap=colours, clim=(levels[0], levels[-1]))
    sheet.colour_bar(levels, colours, f"displacement [{label}]")
    page.save(sheet.figure, results.pictures / "displacement.png")


def outline(mesh):
    """The boundary of a mesh as polylines, so that dashes run on over its nodes."""
    edges = mesh.extract_feature_edges(
        boundary_edges=True, feature_edges=False, non_manifold_edges=False, manifold_edges=False
    )
    lines = edges.strip(join=True, max_length=edges.n_points + 1)
    return [line.points[:, :2] for line in lines.cell]


def draw_principal_stress(results, title, units, window):
    """A cross in each cell: arms along the principal directions, as long as the stress is large."""
    meshes = results.bodies(window)
    centres = np.vstack([mesh.cell_centers().points[:, :2] for mesh in meshes])
    stress = np.vstack([mesh.cell_data["stress"] for mesh in meshes])
    principal = np.vstack([mesh.cell_data["principal_stress"] for mesh in meshes])[:, :2]
    area = np.concatenate([mesh.compute_cell_sizes(length=False, volume=False)["Area"] for mesh in meshes])
    angle = 0.5 * np.arctan2(2 * stress[:, 3], stress[:, 0] - stress[:, 1])
    shown, room = spread(centres)
    room = max(room, np.sqrt(np.median(area)))
    size = np.abs(principal).max(axis=1)
    usual = np.percentile(size, 98) or size.max() or 1.0
    length = 0.8 * room / usual  # of an arm, per stress

    subtitle = "principal stresses in the plane, at the centres of the cells"
    sheet = Page(page.frame(meshes), title, subtitle, key=page.KEY)
    sheet.axis.set(xlabel=f"x [{units.length}]", ylabel=f"y [{units.length}]")
    sheet.render(meshes, "#DCDCD9", color=FACE)
    for column, turn in ((0, 0.0), (1, np.pi / 2)):
        direction = np.column_stack([np.cos(angle + turn), np.sin(angle + turn)])[shown]
        value = principal[shown, column]
        arm = 0.5 * length * np.abs(value)[:, None] * direction
        lines = np.stack([centres[shown] - arm, centres[shown] + arm], axis=1)
        for colour, here in ((BLUE, value < -1e-6 * usual), (VERMILLION, value > 1e-6 * usual)):
            sheet.axis.add_collection(LineCollection(lines[here], colors=colour, linewidths=0.9, zorder=2))
    sheet.key([sign("compression", BLUE, linewidth=1.4), sign("tension", VERMILLION, linewidth=1.4)])
    value = page.round_down(usual)
    sheet.scale_bar(page.LEFT + 2.4, length * value, f"{value:.15g} {units.stress}")
    page.save(sheet.figure, results.pictures / "principal_stress.png")


def spread(centres, most=32):
    """Cells, at most one per square of a grid of `most` squares along its longer side; the square's side."""
    side = np.ptp(centres, axis=0).max() / most or 1.0
    place = (centres - centres.min(axis=0)) / side
    nearest = np.argsort(np.linalg.norm(place % 1.0 - 0.5, axis=1))
    first = np.unique(np.floor(place[nearest]).astype(int), axis=0, return_index=True)[1]
    return nearest[first], side


def draw_coupling(results, name, sides, title, units):
    """Side A below, side B above, pulled apart; between them segments, grid and law points."""
    points, segments, cells, parents = results.midplane(name)
    law_points = results.interfaces[name].points[:, :2]
    lay = lying(points[segments[0, 0]], points[segments[-1, 1]], np.ptp(points, axis=0).max())
    points = lay(points)
    shown = segments[:FEW]
    (x0, y0), (x1, y1) = points[shown].min(axis=(0, 1)), points[shown].max(axis=(0, 1))
    gap, depth, air = 0.13 * (x1 - x0), 0.14 * (x1 - x0), 0.03 * (x1 - x0)
    pull = pulling(points[segments], x1 - x0)
    if pull.closed:
        air = 0.5 * (x1 - x0)

    edges_a, edges_b = (len(np.unique(column)) for column in parents.T)
    subtitle = (
        f"coupling of {name}: {edges_a} edges of A and {edges_b} of B make {len(segments)} segments, "
        + (f"{len(cells)} cells of the grid, " if len(cells) else "")
        + f"{len(law_points)} law points"
    )
    bounds = (x0 - air, x1 + air), (y0 - gap / 2 - depth, y1 + gap / 2 + depth)
    sheet = Page(bounds, title, subtitle, key=page.KEY)
    part = f": the first {len(shown)} segments" if len(shown) < len(segments) else ""
    sheet.axis.set(xlabel=f"distance along {name} [{units.length}]{part}", yticks=[])
    sheet.axis.spines["left"].set_visible(False)

    parts = []
    for side, shift in zip(sides, (-gap / 2, gap / 2), strict=True):
        for subdomain in side:
            mesh = results.subdomains[subdomain].copy()
            mesh.points[:, :2] = pull(lay(mesh.points[:, :2]), shift)
            parts.append(mesh)
    sheet.render(parts, "#9A9A97", color=FACE)
    nodes = {"marker": "o", "markersize": 3.6, "linestyle": "--", "linewidth": 0.7}
    for column, colour, shift in ((0, BLUE, -gap / 2), (1, VERMILLION, gap / 2)):
        feet = points[ends_of_edges(segments, parents[:, column])]
        for foot in feet:
            sheet.axis.plot(
                *np.array([foot, pull(foot, shift)]).T, color=colour, markevery=[1], zorder=3, **nodes
            )
    draw_midplane(sheet.axis, points, segments, cells, 0.06 * gap)
    dots = {"linestyle": "", "marker": "o", "markeredgecolor": "white", "markeredgewidth": 0.5}
    size = np.clip(40 * page.WIDTH / len(law_points), 2.2, 4.2)
    sheet.axis.plot(*lay(law_points).T, color=GREEN, markersize=size, zorder=7, **dots)

    post = {"linestyle": "", "marker": "|", "markersize": 9, "markeredgewidth": 1.6}
    keys = [
        sign("nodes of B", VERMILLION, **nodes),
        sign("nodes of A", BLUE, **nodes),
        sign("segments", PALE, linewidth=6),
        *([sign("grid", INK, **post)] if len(cells) else []),
        sign("law points", GREEN, markersize=4.8, **dots),
    ]
    sheet.key(keys)
    page.save(sheet.figure, results.pictures / f"coupling_{name}.png")


def lying(start, end, size):
    """The map that lays a mid-plane from start to end along the first axis; a closed one stays as it is."""
    along, length = end - start, np.linalg.norm(end - start)
    along = along / length if length > 1e-6 * size else np.array([1.0, 0.0])
    rotation = np.array([along, [-along[1], along[0]]])
    return lambda points: (points - start) @ rotation.T


def pulling(lines, size):
    """The map that pulls a side off the mid-plane: straight up, or out of the middle where it is closed."""
    starts = lines[:, 0]
    closed = np.linalg.norm(lines[-1, 1] - lines[0, 0]) < 1e-6 * size
    centre = starts.mean(axis=0)
    x, y = (starts - centre).T
    outward = -np.sign(x @ np.roll(y, -1) - y @ np.roll(x, -1))  # n is on the left of C

    def pull(points, shift):
        if not closed:
            return points + (0, shift)
        return centre + (points - centre) * (1 + outward * shift / (0.5 * size))

    pull.closed = closed
    return pull


def ends_of_edges(segments, parents):
    """Points where the nodes of a side meet the mid-plane: there the parent edge changes."""
    change = np.flatnonzero(np.diff(parents)) + 1
    return np.concatenate([segments[[0], 0], segments[change, 0], segments[[-1], 1]])


def draw_midplane(axis, points, segments, cells, half):
    """Segments as a bar with white joints, ends of grid cells as posts across it."""
    axis.add_collection(LineCollection(points[segments], colors=PALE, linewidths=6, zorder=5))
    post = np.array([[0, -half], [0, half]])
    joints = points[segments[1:, :1]] + post
    axis.add_collection(LineCollection(joints, colors="white", linewidths=1.2, zorder=5))
    posts = points[np.unique(cells)][:, None] + 2 * post
    axis.add_collection(LineCollection(posts, colors=INK, linewidths=1.6, zorder=6))


def parse_exact(text):
    """[INTERFACE.]COMPONENT=VALUE[@FROM:TO], such as t=-1.5@0.6:1.4: interface, component, both ends or None, values."""
    try:
        component, _, rest = text.partition("=")
        interface, _, component = component.rpartition(".")
        value, _, part = rest.partition("@")
        if component not in ("n", "t") or part.count(":") != bool(part):
            raise ValueError
        places = [float(end) for end in part.split(":")] if part else None
        return interface, component, places, [float(value)] * 2
    except ValueError:
        message = f"{text} is not n=VALUE or t=VALUE, perhaps with INTERFACE. before or @FROM:TO behind it"
        raise argparse.ArgumentTypeError(message) from None


def parse_window(text):
    """X0:X1:Y0:Y1 as ((x0, x1), (y0, y1))."""
    try:
        x0, x1, y0, y1 = map(float, text.split(":"))
        return (x0, x1), (y0, y1)
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not X0:X1:Y0:Y1") from None


def parse_arguments():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        fromfile_prefix_chars="@",
        epilog="An argument @FILE stands for the arguments in that file, one a line.",
    )
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/compression/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/compression")
    units = {"nargs": 2, "metavar": ("STRESS", "LENGTH"), "default": ("MPa", "m")}
    parser.add_argument("--units", help="what the numbers mean, default: MPa m", **units)
    many = {"action": "append", "default": []}
    parser.add_argument("--compare", help="another run, for the tractions", metavar="LABEL=RESULTS", **many)
    exact = "an exact traction (n or t), on part of the interface if FROM and TO are given"
    parser.add_argument("--exact", help=exact, metavar="[INTERFACE.]n=VALUE[@FROM:TO]", type=parse_exact, **many)
    solution = "the exact solution of this scene, for its tractions"
    parser.add_argument("--solution", help=solution, choices=SOLUTIONS)
    within = "what tractions may be off the exact ones, of the largest of these"
    parser.add_argument("--within", type=float, help=within)
    window = "the part of the scene that the pictures of meshes show"
    parser.add_argument("--window", help=window, metavar="X0:X1:Y0:Y1", type=parse_window)
    parser.add_argument("--label", help="name of this run beside others, default: its coupling")
    return parser.parse_args()


def main():
    arguments = parse_arguments()
    units = argparse.Namespace(stress=arguments.units[0], length=arguments.units[1])
    scene = scene_file.read(arguments.scene)
    title = scene.get("title") or arguments.results.name
    plt.rcParams.update(page.STYLE)

    results = Results(arguments.results, scene)
    if not results.subdomains:
        print(f"{arguments.results}: no fields stored, nothing to draw")
        return
    others = []
    for other in arguments.compare:
        label, _, folder = other.partition("=")
        others.append((label, Results(Path(folder), scene)))
    known = arguments.exact
    if arguments.solution:
        solution = SOLUTIONS[arguments.solution](scene, results)
        known += [("", component, *curve) for component, curve in solution.traction.items()]
    for name in results.interfaces:
        if (results.interfaces[name]["status"] == ABSENT).all():
            continue
        entry = entry_of(scene, name)
        label = arguments.label or entry.get("coupling", "projected")
        here = [values for interface, *values in known if interface in ("", name)]
        draw_traction(results, name, entry["law"], label, others, here, title, units)
        if here:
            largest = deviation(results, name, here)
            print(f"{arguments.results}: tractions of {name} are off the exact ones by {largest:.1e}")
            if arguments.within is not None and largest > arguments.within:
                sys.exit(f"{arguments.results}: that is more than {arguments.within:g}")
    if not page.can_render():
        print("no library for off-screen rendering (libosmesa6 or libegl1): pictures of meshes skipped")
        return
    draw_displacement(results, title, units, arguments.window)
    draw_principal_stress(results, title, units, arguments.window)
    for name in results.interfaces:
        draw_coupling(results, name, results.sides(name), title, units)


if __name__ == "__main__":
    main()
