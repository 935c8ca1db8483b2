"""Draw the results of one scene: pictures for a reader, one idea each, into RESULTS/pictures/.

  displacement.png         the deformed mesh, enlarged by the factor it states, coloured by displacement
  principal_stress.png     principal stresses as crosses in their directions, coloured by sign
  traction_INTERFACE.png   both components of the traction along the joint
  coupling_INTERFACE.png   the two meshes face to face, and between them how they are joined

All show the last increment stored. Meshes are rendered off-screen by VTK (through pyvista); without a library for
that (libosmesa6 or libegl1) only the graphs are drawn, which one line says.
"""

import argparse
import json
import math
import os
import subprocess
import sys
from pathlib import Path

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
import pyvista
from matplotlib.collections import LineCollection
from matplotlib.ticker import MaxNLocator
from PIL import Image

# Okabe and Ito's colours, told apart by everyone
BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
INK, GREY, PALE, FACE = "#222222", "#777777", "#C9C9C6", "#F3F3F1"
COMPARED = [VERMILLION, GREEN, ORANGE]

STYLE = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.axisbelow": True,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "grid.color": "#E6E6E3",
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "legend.handletextpad": 0.5,
    "legend.columnspacing": 1.6,
    "figure.dpi": 180,
}
WIDTH, HEIGHT = 6.2, 3.8  # room for the plane on a page [in]
LEFT, RIGHT, TOP, BOTTOM = 0.75, 0.25, 0.62, 0.5  # margins around it [in]
BAR = 0.75  # more room on the right for a colour bar, and below for a key [in]
KEY = 0.3
OVERSAMPLE = 2  # rendered pixels per printed pixel, averaged on the page
PROBE = "import pyvista; p = pyvista.Plotter(off_screen=True); p.add_mesh(pyvista.Sphere()); p.screenshot(None)"
FEW = 60  # segments that one picture can show


class Results:
    """The last stored increment of one results folder."""

    def __init__(self, folder, scene):
        self.folder = folder
        self.last = max(int(path.stem.rpartition("_")[2]) for path in folder.glob("fields/*_*.vtu"))
        names = [path.stem.rpartition("_")[0] for path in sorted(folder.glob(f"fields/*_{self.last:04d}.vtu"))]
        self.subdomains = {name: self.field(name) for name in names if name in scene["subdomains"]}
        self.interfaces = {name: self.field(name) for name in names if name not in scene["subdomains"]}

    def field(self, name):
        return pyvista.read(self.folder / "fields" / f"{name}_{self.last:04d}.vtu")

    def midplane(self, name):
        """Mid-plane of an interface: its line, the ends of the segments, their parents, the cells of the grid."""
        grid = pyvista.read(self.folder / "midplane" / f"{name}.vtu")
        lines = grid.cell_connectivity.reshape(-1, 2)
        return grid, lines[grid["kind"] == 0], lines[grid["kind"] == 1]


# ---- the page: what all pictures have in common ----------------------------------------------------------------


def can_render():
    """Set up the first way of off-screen rendering that works; tried in a child, because VTK crashes without one."""
    for window in ("vtkOSOpenGLRenderWindow", "vtkEGLRenderWindow"):
        environment = {**os.environ, "VTK_DEFAULT_OPENGL_WINDOW": window}
        child = subprocess.run([sys.executable, "-c", PROBE], env=environment, capture_output=True)
        if child.returncode == 0:
            os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = window
            return True
    return False


class Page:
    """A picture of the plane at true proportions: heading, axis, margins of fixed width, a row for a key below."""

    def __init__(self, bounds, title, subtitle, bar=0.0, key=0.0):
        (x0, x1), (y0, y1) = bounds
        self.inch = max((x1 - x0) / WIDTH, (y1 - y0) / HEIGHT)  # length that one inch stands for
        width, height = (x1 - x0) / self.inch, (y1 - y0) / self.inch
        self.size = (LEFT + max(width, 4.5 - bar) + bar + RIGHT, key + BOTTOM + height + TOP)
        self.figure = plt.figure(figsize=self.size)
        self.box = (LEFT, key + BOTTOM, width, height)
        self.axis = self.place(*self.box)
        self.axis.set(xlim=(x0, x1), ylim=(y0, y1))
        self.axis.locator_params(nbins=6)
        self.axis.xaxis.set_major_formatter("{x:g}")
        self.axis.yaxis.set_major_formatter("{x:g}")
        heading(self.axis, title, subtitle)

    def place(self, left, bottom, width, height):
        """An axis at a place given in inches."""
        across, up = self.size
        return self.figure.add_axes((left / across, bottom / up, width / across, height / up))

    def colour_bar(self, levels, colours, label):
        """A colour bar as high as the plane, to the right of it, with a band between every two levels."""
        left, bottom, width, height = self.box
        axis = self.place(left + width + 0.1, bottom, 0.13, height)
        scale = plt.cm.ScalarMappable(plt.Normalize(levels[0], levels[-1]), colours)
        bar = self.figure.colorbar(scale, cax=axis, label=label, ticks=levels, format="{x:.12g}")
        bar.outline.set_visible(False)
        bar.ax.tick_params(length=0)

    def key(self, handles):
        """A legend in the row below the axis."""
        self.figure.legend(
            handles=handles, loc="lower left", bbox_to_anchor=(LEFT / self.size[0], 0), ncols=len(handles), borderaxespad=0.3
        )

    def render(self, meshes, edge, **look):
        """Let VTK draw the cells of the meshes and their edges into the axis, seen straight from above."""
        (x0, x1), (y0, y1) = self.axis.get_xlim(), self.axis.get_ylim()
        pixels = np.array([x1 - x0, y1 - y0]) / self.inch * self.figure.dpi * OVERSAMPLE
        plotter = pyvista.Plotter(off_screen=True, window_size=np.ceil(pixels).astype(int).tolist())
        for mesh in meshes:
            plotter.add_mesh(mesh, lighting=False, show_scalar_bar=False, **look)
            edges = mesh.extract_all_edges().translate((0, 0, 1e-3 * (x1 - x0)))
            plotter.add_mesh(edges, color=edge, line_width=1.1 * OVERSAMPLE, lighting=False)
        centre = ((x0 + x1) / 2, (y0 + y1) / 2)
        plotter.enable_parallel_projection()
        plotter.camera_position = [(*centre, x1 - x0), (*centre, 0), (0, 1, 0)]
        plotter.camera.parallel_scale = (y1 - y0) / 2
        plotter.camera.clipping_range = (1e-2 * (x1 - x0), 2 * (x1 - x0))
        image = plotter.screenshot(None, transparent_background=True, return_img=True)
        plotter.close()
        self.axis.imshow(image, extent=(x0, x1, y0, y1), interpolation="antialiased", aspect="auto", zorder=1)


def heading(axis, title, subtitle):
    """Title and, in a smaller and lighter line below it, what the picture shows."""
    above = {"xy": (0, 1), "xycoords": "axes fraction", "textcoords": "offset points"}
    axis.annotate(title, xytext=(0, 23), fontsize=10.5, fontweight="bold", **above)
    axis.annotate(subtitle, xytext=(0, 9), color="#555555", **above)


def save(figure, path):
    """Write the picture with a palette of 256 colours, which makes it three times smaller."""
    path.parent.mkdir(exist_ok=True)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[:, :, :3])
    image.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE).save(path, optimize=True)
    plt.close(figure)
    print(path)


def frame(meshes, margin=0.04):
    """Bounds that hold the meshes and some air around them."""
    low = np.min([mesh.points[:, :2].min(axis=0) for mesh in meshes], axis=0)
    high = np.max([mesh.points[:, :2].max(axis=0) for mesh in meshes], axis=0)
    air = margin * (high - low).max()
    return (low[0] - air, high[0] + air), (low[1] - air, high[1] + air)


def outlines(mesh):
    """The boundary of a mesh as line segments."""
    edges = mesh.extract_feature_edges(
        boundary_edges=True, feature_edges=False, non_manifold_edges=False, manifold_edges=False
    )
    return edges.points[edges.lines.reshape(-1, 3)[:, 1:], :2]


def round_down(value):
    """The largest of 1, 2, 5 times a power of ten that is not above the value."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * max(digit for digit in (1, 2, 5) if digit * power <= value * (1 + 1e-12))


def scaled(size, unit):
    """A power of 1000 to divide by so that the size reads well, and the unit that says so."""
    exponent = 3 * math.floor(math.log10(size) / 3) if size > 0 else 0
    if exponent in (0, -3) and size >= 0.1:
        exponent = 0
    return (1.0, unit) if exponent == 0 else (10.0**exponent, f"$10^{{{exponent}}}$ {unit}")


# ---- the pictures ----------------------------------------------------------------------------------------------


def draw_displacement(results, title, units):
    """The deformed mesh over the outline of the undeformed one."""
    meshes = results.subdomains.values()
    (x0, x1), (y0, y1) = frame(meshes, 0.0)
    size = max(x1 - x0, y1 - y0)
    largest = max(np.linalg.norm(mesh["displacement"], axis=1).max() for mesh in meshes)
    factor = round_down(0.1 * size / largest) if largest > 0 else 1.0
    unit, label = scaled(largest, units.length)
    deformed = []
    for mesh in meshes:
        moved = mesh.copy()
        moved.points = mesh.points + factor * mesh["displacement"]
        moved["magnitude"] = np.linalg.norm(mesh["displacement"], axis=1) / unit
        deformed.append(moved)
    page = Page(
        frame([*meshes, *deformed]),
        title,
        f"deformed mesh, displacements enlarged {factor:,.15g} times; dashed: before loading",
        bar=BAR,
    )
    levels = MaxNLocator(12).tick_values(0, largest / unit or 1.0)
    colours = plt.get_cmap("viridis", len(levels) - 1)
    page.axis.set(xlabel=f"x [{units.length}]", ylabel=f"y [{units.length}]")
    page.render(deformed, scalars="magnitude", cmap=colours, clim=(levels[0], levels[-1]), edge="#2B2B2B")
    for mesh in meshes:
        lines = LineCollection(outlines(mesh), colors=GREY, linewidths=0.8, linestyles=(0, (4, 3)), zorder=0)
        page.axis.add_collection(lines)
    page.colour_bar(levels, colours, f"displacement [{label}]")
    save(page.figure, results.folder / "pictures" / "displacement.png")


def spread(centres, most=60):
    """Indices of cells, at most one in each square of a grid that has `most` squares along its longer side."""
    side = np.ptp(centres, axis=0).max() / most or 1.0
    squares = np.floor((centres - centres.min(axis=0)) / side).astype(int)
    return np.sort(np.unique(squares, axis=0, return_index=True)[1]), side


def draw_principal_stress(results, title, units):
    """A cross in each cell: arms along the principal directions, as long as the stress is large."""
    meshes = results.subdomains.values()
    centres = np.vstack([mesh.cell_centers().points[:, :2] for mesh in meshes])
    stress = np.vstack([mesh.cell_data["stress"] for mesh in meshes])
    principal = np.vstack([mesh.cell_data["principal_stress"] for mesh in meshes])[:, :2]
    area = np.concatenate([mesh.compute_cell_sizes(length=False, volume=False)["Area"] for mesh in meshes])
    shown, side = spread(centres)
    angle = 0.5 * np.arctan2(2 * stress[:, 3], stress[:, 0] - stress[:, 1])
    size = np.abs(principal).max(axis=1)
    usual = np.percentile(size, 98) or size.max()
    length = 0.95 * max(side, np.sqrt(np.median(area))) / usual if usual > 0 else 0.0  # of an arm per stress

    page = Page(frame(meshes), title, "principal stresses in the plane, at the centres of the cells", key=KEY)
    page.axis.set(xlabel=f"x [{units.length}]", ylabel=f"y [{units.length}]")
    page.render(meshes, color=FACE, edge="#DCDCD9")
    for column, turn in ((0, 0.0), (1, np.pi / 2)):
        direction = np.column_stack([np.cos(angle + turn), np.sin(angle + turn)])[shown]
        value = principal[shown, column]
        arm = 0.5 * length * np.abs(value)[:, None] * direction
        lines = np.stack([centres[shown] - arm, centres[shown] + arm], axis=1)
        visible = np.abs(value) > 1e-6 * usual
        for sign, colour in ((-1, BLUE), (1, VERMILLION)):
            here = visible & (np.sign(value) == sign)
            page.axis.add_collection(LineCollection(lines[here], colors=colour, linewidths=0.9, zorder=2))
    handles = [
        plt.Line2D([], [], color=BLUE, linewidth=1.4, label="compression"),
        plt.Line2D([], [], color=VERMILLION, linewidth=1.4, label="tension"),
    ]
    page.key(handles)
    if usual > 0:
        value = round_down(usual)
        stretch = length * value / page.inch
        x, y = LEFT + 2.4, 0.15
        page.figure.add_artist(
            plt.Line2D([x, x + stretch], [y, y], color=INK, linewidth=1.4, transform=page.figure.dpi_scale_trans)
        )
        page.figure.text(
            x + stretch + 0.07, y, f"{value:.15g} {units.stress}", va="center", transform=page.figure.dpi_scale_trans
        )
    save(page.figure, results.folder / "pictures" / "principal_stress.png")


def arc_length(points, start):
    """Distance of points from the start, measured along them."""
    steps = np.linalg.norm(np.diff(np.vstack([start, points]), axis=0), axis=1)
    return np.cumsum(steps)


def draw_traction(results, name, label, others, exact, title, units):
    """Normal and tangential traction along one interface, beside those of other runs and exact values."""
    figure, axes = plt.subplots(2, 1, figsize=(LEFT + WIDTH + RIGHT, 4.2), sharex=True)
    figure.subplots_adjust(
        left=LEFT / figure.get_figwidth(), right=1 - RIGHT / figure.get_figwidth(), top=1 - TOP / 4.2, bottom=BOTTOM / 4.2
    )
    runs = [(label, BLUE, results)] + [(text, colour, run) for (text, run), colour in zip(others, COMPARED)]
    for order, (text, colour, run) in enumerate(runs):
        field = run.interfaces[name]
        plane, segments, _ = run.midplane(name)
        s = arc_length(field.points, plane.points[segments[0, 0]])
        for component, axis in enumerate(axes):
            look = {"color": colour, "linewidth": 1.0, "marker": "o", "markersize": 2.3, "zorder": 5 - order}
            axis.plot(s, field["traction"][:, component], label=text, **look)
    length = np.linalg.norm(np.diff(plane.points[segments], axis=1), axis=2).sum()
    for component, value, start, end in exact:
        start, end = (0.0, length) if start is None else (start, end)
        look = {"color": PALE, "linewidth": 5, "solid_capstyle": "butt", "zorder": 1}
        axes["nt".index(component)].plot([start, end], [value, value], label="exact", **look)
    size = np.abs(results.interfaces[name]["traction"]).max() or 1.0
    for axis, component in zip(axes, ("normal $t_n$", "tangential $t_t$")):
        axis.set(xlim=(0, length), ylabel=f"{component} [{units.stress}]")
        axis.grid(axis="y")
        axis.xaxis.set_major_formatter("{x:g}")
        axis.margins(y=0.08)
        low, high = axis.get_ylim()
        if high - low < 1e-6 * size:  # do not magnify round-off: a constant line shall look constant
            axis.set_ylim((low + high) / 2 - 0.1 * size, (low + high) / 2 + 0.1 * size)
    axes[1].set(xlabel=f"distance along {name} [{units.length}]")
    axes[0].legend(loc="lower right", bbox_to_anchor=(1, 1), ncols=4, borderaxespad=0.2)
    figure.align_ylabels(axes)
    heading(axes[0], title, f"traction along {name} at its law points, tension positive")
    save(figure, results.folder / "pictures" / f"traction_{name}.png")


def face_to_face(plane, segments):
    """Origin and rows of the rotation that lay a mid-plane along the first axis; a closed one stays as it is."""
    start, end = plane.points[segments[0, 0], :2], plane.points[segments[-1, 1], :2]
    along = end - start
    reach = np.ptp(plane.points[:, :2], axis=0).max()
    along = along / np.linalg.norm(along) if np.linalg.norm(along) > 1e-6 * reach else np.array([1.0, 0.0])
    return start, np.array([along, [-along[1], along[0]]])


def draw_coupling(results, name, scene, title, units):
    """Side A below, side B above, pulled apart; between them the mid-plane with segments, grid and law points."""
    interface = scene["interfaces"].get(name)
    if interface is None or not (results.folder / "midplane" / f"{name}.vtu").is_file():
        return
    plane, segments, cells = results.midplane(name)
    origin, rotation = face_to_face(plane, segments)
    turned = (plane.points[:, :2] - origin) @ rotation.T
    shown = segments[:FEW]
    start, end = turned[shown, 0].min(), turned[shown, 0].max()
    gap, depth = 0.13 * (end - start), 0.14 * (end - start)

    parts = {}
    for side, shift in (("side_a", -gap / 2), ("side_b", gap / 2)):
        groups = [interface[side]] if isinstance(interface[side], str) else interface[side]
        for subdomain in {group.partition(".")[0] for group in groups}:
            mesh = results.subdomains[subdomain].copy()
            mesh.points[:, :2] = (mesh.points[:, :2] - origin) @ rotation.T + (0, shift)
            parts[subdomain] = mesh
    air = 0.03 * (end - start)
    reach = gap / 2 + depth
    bounds = (start - air, end + air), (turned[shown, 1].min() - reach, turned[shown, 1].max() + reach)
    edges_a, edges_b = (len(np.unique(plane[array][plane["kind"] == 0])) for array in ("edge_a", "edge_b"))
    law_points = results.interfaces[name]
    subtitle = (
        f"coupling of {name}: {edges_a} edges of A and {edges_b} of B make {len(segments)} segments, "
        + (f"{len(cells)} cells of the grid, " if len(cells) else "")
        + f"{law_points.n_points} law points"
        + (f"; the first {len(shown)} segments" if len(shown) < len(segments) else "")
    )
    page = Page(bounds, title, subtitle, key=KEY)
    axis = page.axis
    axis.set(xlabel=f"distance along {name} [{units.length}]", yticks=[])
    axis.spines["left"].set_visible(False)
    page.render(list(parts.values()), color=FACE, edge="#9A9A97")

    # a node of A or B lies wherever the parent edge changes from one segment to the next
    for array, colour, shift in (("edge_a", BLUE, -gap / 2), ("edge_b", VERMILLION, gap / 2)):
        parents = plane[array][plane["kind"] == 0]
        nodes = np.concatenate([[segments[0, 0]], segments[1:, 0][np.diff(parents) != 0], [segments[-1, 1]]])
        feet = turned[nodes]
        lines = np.stack([feet, feet + (0, shift)], axis=1)
        axis.add_collection(LineCollection(lines, colors=colour, linewidths=0.7, linestyles=(0, (3, 2)), zorder=3))
        axis.plot(*(feet + (0, shift)).T, "o", color=colour, markersize=3.6, zorder=4)
    axis.add_collection(LineCollection(turned[segments], colors=PALE, linewidths=6, zorder=5))
    ends = np.array([[0, -0.06 * gap], [0, 0.06 * gap]])
    axis.add_collection(LineCollection(turned[segments[1:, :1]] + ends, colors="white", linewidths=1.2, zorder=5))
    posts = turned[np.unique(cells)][:, None]
    axis.add_collection(LineCollection(posts + 2 * ends, colors=INK, linewidths=1.6, zorder=6))
    places = (law_points.points[:, :2] - origin) @ rotation.T
    dots = {"linestyle": "", "marker": "o", "color": GREEN, "markeredgecolor": "white", "markeredgewidth": 0.5}
    axis.plot(*places.T, markersize=np.clip(40 * WIDTH / len(places), 2.2, 4.2), zorder=7, **dots)
    nodes = {"marker": "o", "markersize": 3.6, "linestyle": "--", "linewidth": 0.7}
    handles = [
        plt.Line2D([], [], color=VERMILLION, label="nodes of B", **nodes),
        plt.Line2D([], [], color=BLUE, label="nodes of A", **nodes),
        plt.Line2D([], [], color=PALE, linewidth=6, solid_capstyle="butt", label="segments"),
        plt.Line2D([], [], color=INK, marker="|", markersize=9, markeredgewidth=1.6, linestyle="", label="grid"),
        plt.Line2D([], [], markersize=4.8, label="law points", **dots),
    ]
    page.key(handles if len(cells) else handles[:3] + handles[4:])
    save(page.figure, results.folder / "pictures" / f"coupling_{name}.png")


def parse_exact(text):
    """COMPONENT=VALUE[@FROM:TO], such as t=-1.5@0.6:1.4."""
    try:
        component, _, rest = text.partition("=")
        value, _, interval = rest.partition("@")
        start, end = map(float, interval.split(":")) if interval else (None, None)
        if component not in ("n", "t"):
            raise ValueError
        return component, float(value), start, end
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not n=VALUE or t=VALUE, with or without @FROM:TO") from None


def main():
    parser = argparse.ArgumentParser(
        description=__doc__,
        formatter_class=argparse.RawDescriptionHelpFormatter,
        fromfile_prefix_chars="@",
        epilog="An argument @FILE stands for the arguments in that file, one a line.",
    )
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/compression/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/compression")
    parser.add_argument("--units", nargs=2, default=("MPa", "m"), metavar=("STRESS", "LENGTH"), help="default: MPa m")
    parser.add_argument(
        "--compare", action="append", default=[], metavar="LABEL=RESULTS", help="another run, for the tractions"
    )
    parser.add_argument(
        "--exact",
        action="append",
        default=[],
        type=parse_exact,
        metavar="n=VALUE[@FROM:TO]",
        help="an exact traction (n or t), over part of the joint if FROM and TO are given",
    )
    arguments = parser.parse_args()
    stress, length = arguments.units
    units = argparse.Namespace(stress=stress, length=length)
    scene = json.loads(arguments.scene.read_text())
    title = scene.get("title", arguments.results.name)
    plt.rcParams.update(STYLE)

    results = Results(arguments.results, scene)
    others = [text.partition("=") for text in arguments.compare]
    others = [(label, Results(Path(folder), scene)) for label, _, folder in others]
    for name in results.interfaces:
        label = scene["interfaces"].get(name, {}).get("coupling", "projected")
        draw_traction(results, name, label, others, arguments.exact, title, units)
    if not can_render():
        print("no library for off-screen rendering: pictures of meshes skipped; install libosmesa6 or libegl1")
        return
    draw_displacement(results, title, units)
    draw_principal_stress(results, title, units)
    for name in results.interfaces:
        draw_coupling(results, name, scene, title, units)


if __name__ == "__main__":
    main()
