"""What all pictures have in common: colours, type, a page that shows the plane, VTK's rendering on it."""

import math
import os
import subprocess
import sys

import matplotlib

matplotlib.use("agg")
import matplotlib.pyplot as plt
import numpy as np
import pyvista
from PIL import Image

# Okabe and Ito's colours, told apart by everyone
BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
RUNS = [BLUE, VERMILLION, GREEN, ORANGE]  # a run and those beside it
INK, GREY, PALE, FACE = "#222222", "#777777", "#C9C9C6", "#F3F3F1"

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
# in inches
WIDTH, HEIGHT = 6.2, 3.8  # room for the plane
LEFT, RIGHT, TOP, BOTTOM = 0.75, 0.25, 0.62, 0.5  # margins around it
BAR = 0.75  # more room on the right, for a colour bar
KEY = 0.3  # more room below, for a key
NARROWEST = 4.5  # of a heading
LOWEST = 1.3  # of a colour bar

FINE = 0.08  # cells smaller than this get paler edges
OVERSAMPLE = 2  # rendered pixels per printed pixel, averaged on the page
PROBE = "import pyvista as p; q = p.Plotter(off_screen=True); q.add_mesh(p.Sphere()); q.screenshot(None)"


def can_render():
    """Set up the first way of off-screen rendering that works; tried in a child, as VTK crashes without."""
    for window in ("vtkOSOpenGLRenderWindow", "vtkEGLRenderWindow"):
        environment = {**os.environ, "VTK_DEFAULT_OPENGL_WINDOW": window}
        child = subprocess.run([sys.executable, "-c", PROBE], env=environment, capture_output=True)
        if child.returncode == 0:
            os.environ["VTK_DEFAULT_OPENGL_WINDOW"] = window
            return True
    return False


class Page:
    """A picture of the plane at true proportions, with a heading, and room for a colour bar or a key."""

    def __init__(self, bounds, title, subtitle, bar=0.0, key=0.0):
        (x0, x1), (y0, y1) = bounds
        self.inch = max((x1 - x0) / WIDTH, (y1 - y0) / HEIGHT)  # length that one inch stands for
        air = max(0.0, LOWEST * self.inch - (y1 - y0)) / 2
        y0, y1 = y0 - air, y1 + air
        width, height = (x1 - x0) / self.inch, (y1 - y0) / self.inch
        self.size = (LEFT + max(width, NARROWEST - bar) + bar + RIGHT, key + BOTTOM + height + TOP)
        self.box = (LEFT, key + BOTTOM, width, height)
        self.figure = plt.figure(figsize=self.size)
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

    def render(self, meshes, edge, **look):
        """Let VTK draw the cells of the meshes and their edges into the axis, seen straight from above."""
        (x0, x1), (y0, y1) = self.axis.get_xlim(), self.axis.get_ylim()
        pixels = np.array([x1 - x0, y1 - y0]) / self.inch * self.figure.dpi * OVERSAMPLE
        cells = sum(mesh.n_cells for mesh in meshes)
        cell = math.sqrt(sum(mesh.area for mesh in meshes) / cells) / self.inch  # size of one on paper
        plotter = pyvista.Plotter(off_screen=True, window_size=np.ceil(pixels).astype(int).tolist())
        for mesh in meshes:
            plotter.add_mesh(mesh, lighting=False, show_scalar_bar=False, **look)
            edges = mesh.extract_all_edges().translate((0, 0, 1e-3 * (x1 - x0)))
            ink = {"color": edge, "opacity": min(1.0, cell / FINE), "line_width": 1.1 * OVERSAMPLE}
            plotter.add_mesh(edges, lighting=False, **ink)
        centre = ((x0 + x1) / 2, (y0 + y1) / 2)
        plotter.enable_parallel_projection()
        plotter.camera_position = [(*centre, x1 - x0), (*centre, 0), (0, 1, 0)]
        plotter.camera.parallel_scale = (y1 - y0) / 2
        plotter.camera.clipping_range = (1e-2 * (x1 - x0), 2 * (x1 - x0))
        image = plotter.screenshot(None, transparent_background=True, return_img=True)
        plotter.close()
        place = {"extent": (x0, x1, y0, y1), "aspect": "auto", "zorder": 1}
        self.axis.imshow(image, interpolation="antialiased", **place)

    def colour_bar(self, levels, colours, label):
        """A colour bar as high as the plane, to the right of it, with a band between every two levels."""
        left, bottom, width, height = self.box
        axis = self.place(left + width + 0.1, bottom, 0.13, height)
        scale = plt.cm.ScalarMappable(plt.Normalize(levels[0], levels[-1]), colours)
        ticks = levels[:: math.ceil(0.15 * len(levels) / height)]
        bar = self.figure.colorbar(scale, cax=axis, label=label, ticks=ticks, format="{x:.12g}")
        bar.outline.set_visible(False)
        axis.tick_params(length=0)

    def key(self, handles):
        """A legend in the row below the axis."""
        key_below(self.figure, handles)

    def scale_bar(self, left, length, label):
        """A bar of a length in the plane, with its meaning, in the row below the axis."""
        inches = {"transform": self.figure.dpi_scale_trans}
        right, y = left + length / self.inch, KEY / 2
        self.figure.add_artist(plt.Line2D([left, right], [y, y], color=INK, linewidth=1.4, **inches))
        self.figure.text(right + 0.07, y, label, va="center", **inches)


def graphs(rows, height, columns=1):
    """A figure as wide as the others, with graphs that share their axes and room for a key; the graphs in a list."""
    width = LEFT + WIDTH + RIGHT
    share = {"sharex": True, "sharey": "row", "squeeze": False}
    figure, axes = plt.subplots(rows, columns, figsize=(width, height), **share)
    sides = {"left": LEFT / width, "right": 1 - RIGHT / width}
    figure.subplots_adjust(top=1 - TOP / height, bottom=(BOTTOM + KEY) / height, wspace=0.08, **sides)
    return figure, list(axes.flat)


def key_below(figure, handles):
    """A legend in the row below the axes."""
    place = {"loc": "lower left", "bbox_to_anchor": (LEFT / figure.get_figwidth(), 0), "borderaxespad": 0.3}
    figure.legend(handles=handles, ncols=len(handles), **place)


def heading(axis, title, subtitle):
    """Title and, in a smaller and lighter line below it, what the picture shows."""
    above = {"xy": (0, 1), "xycoords": "axes fraction", "textcoords": "offset points"}
    axis.annotate(title, xytext=(0, 23), fontsize=10.5, fontweight="bold", **above)
    axis.annotate(subtitle, xytext=(0, 9), color="#555555", **above)


def sign(label, colour, **look):
    """An entry of a key."""
    return plt.Line2D([], [], label=label, color=colour, solid_capstyle="butt", **look)


def save(figure, path):
    """Write the picture with a palette of 256 colours, which makes it three times smaller."""
    path.parent.mkdir(exist_ok=True)
    figure.canvas.draw()
    image = Image.fromarray(np.asarray(figure.canvas.buffer_rgba())[:, :, :3])
    image = image.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE)
    image.save(path, optimize=True)
    plt.close(figure)
    print(path)


def frame(meshes, margin=0.04):
    """Bounds that hold the meshes and some air around them."""
    low = np.min([mesh.points[:, :2].min(axis=0) for mesh in meshes], axis=0)
    high = np.max([mesh.points[:, :2].max(axis=0) for mesh in meshes], axis=0)
    air = margin * (high - low).max()
    return (low[0] - air, high[0] + air), (low[1] - air, high[1] + air)


def round_down(value):
    """The largest of 1, 2, 5 times a power of ten that is not above the value."""
    power = 10.0 ** math.floor(math.log10(value))
    return power * max(digit for digit in (1, 2, 5) if digit * power <= value * (1 + 1e-12))


def power_of_ten(value):
    """One digit and its power of ten, for a text."""
    digit, _, exponent = f"{value:.0e}".partition("e")
    return f"${digit}\\times 10^{{{int(exponent)}}}$"


def scaled(size, unit):
    """A power of 1000 to divide by so that the size reads well, and the unit that says so."""
    exponent = 0 if size == 0 or 0.1 <= size < 1 else 3 * math.floor(math.log10(size) / 3)
    return (1.0, unit) if exponent == 0 else (10.0**exponent, f"$10^{{{exponent}}}$ {unit}")
