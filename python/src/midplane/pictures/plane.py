"""Pictures of the plane at true proportions: one page or two beside each other, and VTK's rendering on it."""

from __future__ import annotations

import math
import os
import subprocess
import sys
from collections.abc import Iterable, Iterator, Sequence
from contextlib import contextmanager
from functools import cache
from typing import Any

import numpy as np
import pyvista
from matplotlib.axes import Axes
from matplotlib.cm import ScalarMappable
from matplotlib.colors import Colormap, Normalize
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from ..vtu import Array
from . import page
from .page import BOTTOM, HEIGHT, LEFT, RIGHT, TOP, WIDTH

Bounds = tuple[tuple[float, float], tuple[float, float]]  # smallest and largest x, then y

# in inches
BAR = 0.75  # more room on the right, for a colour bar
NARROWEST = 4.5  # of a heading
LOWEST = 1.3  # of a colour bar
APART = 0.35  # of pictures beside or above each other
TALLER = 1.3  # what pictures above each other may be higher than one

FINE = 0.08  # cells smaller than this get paler edges
OVERSAMPLE = 2  # rendered pixels per printed pixel, averaged on the page
PROBE = """
import vtkmodules.vtkRenderingOpenGL2
from vtkmodules.vtkRenderingCore import vtkRenderer, vtkRenderWindow
window = vtkRenderWindow()
window.OffScreenRenderingOn()
window.AddRenderer(vtkRenderer())
window.Render()
raise SystemExit(not window.SupportsOpenGL())
"""


WINDOW = "VTK_DEFAULT_OPENGL_WINDOW"  # by which VTK is told how to render


@cache
def window() -> str | None:
    """The first way of off-screen rendering that works; tried in a child, as VTK crashes without."""
    for way in ("vtkOSOpenGLRenderWindow", "vtkEGLRenderWindow"):
        child = subprocess.run([sys.executable, "-c", PROBE], env={**os.environ, WINDOW: way}, capture_output=True, check=False)
        if child.returncode == 0:
            return way
    return None


def can_render() -> bool:
    """Whether meshes can be rendered."""
    return window() is not None


@contextmanager
def off_screen() -> Iterator[None]:
    """VTK renders off-screen, and afterwards as before."""
    before = os.environ.get(WINDOW)
    os.environ[WINDOW] = window() or ""
    try:
        yield
    finally:
        if before is None:
            del os.environ[WINDOW]
        else:
            os.environ[WINDOW] = before


class Page:
    """Pictures of the plane on one scale under a heading, with room for a colour bar and for what else stands below.

    Two captions make two pictures, side by side or one above the other, as they become larger.
    """

    def __init__(
        self, bounds: Bounds, title: str, subtitle: str, bar: float = 0.0, captions: tuple[str, ...] = ("",), below: float = 0.0, cut: bool = False
    ) -> None:
        (x0, x1), (y0, y1) = bounds
        count, top = len(captions), TOP if captions == ("",) else TOP + page.CAPTION
        rows = min((1, count), key=lambda rows: scale(bounds, rows, count // rows))
        columns = count // rows
        self.inch = scale(bounds, rows, columns)  # length that one inch stands for
        # a colour bar beside it needs its height, graphs beside each other something to stand on
        air = max(0.0, LOWEST * self.inch - (y1 - y0)) / 2 if rows == 1 else 0.0
        y0, y1 = y0 - air, y1 + air
        width, height = (x1 - x0) / self.inch, (y1 - y0) / self.inch
        whole = columns * (width + APART) - APART, rows * (height + APART) - APART
        text = max(page.text_width(title, page.TITLE[0], "bold"), page.text_width(subtitle, page.SUBTITLE[0]))
        needed = max(whole[0] + bar, min(max(NARROWEST, text), WIDTH))
        self.size = (LEFT + needed + RIGHT, below + BOTTOM + whole[1] + top)
        self.box = (LEFT, below + BOTTOM, *whole)
        self.figure = page.sheet(*self.size)
        self.axes: list[Axes] = []
        self.captions, self.cut = [], cut
        for number, caption in enumerate(captions):
            across, down = (number, 0) if rows == 1 else (0, number)
            left, up = across * (width + APART), (rows - 1 - down) * (height + APART)
            axis = self.place(LEFT + left, below + BOTTOM + up, width, height)
            axis.set(xlim=(x0, x1), ylim=(y0, y1))
            for line, room in ((axis.xaxis, width / 0.75), (axis.yaxis, height / 0.4)):
                line.set_major_locator(MaxNLocator(int(np.clip(room, 1, 6)), steps=[1, 2, 2.5, 5, 10]))
                line.set_major_formatter("{x:g}")
            axis.spines[["top", "right"]].set_visible(cut)
            axis.tick_params(labelbottom=down == rows - 1, labelleft=across == 0)
            self.captions.append(page.caption(axis, caption))
            self.axes.append(axis)
        self.axis = self.axes[0]
        page.heading(self.axis, title, subtitle, raised=top - TOP)

    def place(self, left: float, bottom: float, width: float, height: float) -> Axes:
        """An axis at a place given in inches."""
        across, up = self.size
        return self.figure.add_axes((left / across, bottom / up, width / across, height / up))

    def label(self, unit: str) -> None:
        """The names of the axes."""
        for axis in self.axes:
            shown_x, shown_y = (line.get_tick_params() or {} for line in (axis.xaxis, axis.yaxis))
            axis.set(xlabel=f"x [{unit}]" if shown_x["labelbottom"] else "")
            axis.set(ylabel=f"y [{unit}]" if shown_y["labelleft"] else "")

    def render(self, meshes: Sequence[Any], edge: str | None, axis: Axes | None = None, **look: Any) -> AxesImage:
        """Let VTK draw the cells of the meshes and their edges, if these have a colour, seen straight from above."""
        axis = axis or self.axis
        (x0, x1), (y0, y1) = axis.get_xlim(), axis.get_ylim()
        pixels = np.array([x1 - x0, y1 - y0]) / self.inch * self.figure.dpi * OVERSAMPLE
        whole = together(meshes)
        with off_screen():
            plotter = pyvista.Plotter(off_screen=True, window_size=np.ceil(pixels).astype(int).tolist())
        plotter.add_mesh(whole, lighting=False, show_scalar_bar=False, **look)
        if edge:
            cell = math.sqrt(whole.area / whole.n_cells) / self.inch  # size of one on paper
            edges = whole.extract_all_edges().translate((0, 0, 1e-3 * (x1 - x0)))
            ink = {"color": edge, "opacity": min(1.0, cell / FINE), "line_width": 1.1 * OVERSAMPLE}
            plotter.add_mesh(edges, lighting=False, **ink)
        centre = ((x0 + x1) / 2, (y0 + y1) / 2)
        plotter.enable_parallel_projection()
        plotter.camera_position = [(*centre, x1 - x0), (*centre, 0), (0, 1, 0)]
        plotter.camera.parallel_scale = (y1 - y0) / 2
        plotter.camera.clipping_range = (1e-2 * (x1 - x0), 2 * (x1 - x0))
        image = plotter.screenshot(None, transparent_background=True, return_img=True)
        plotter.close()
        return axis.imshow(image, interpolation="antialiased", extent=(x0, x1, y0, y1), aspect="auto", zorder=1)

    def colour_bar(self, levels: Array, colours: Colormap, label: str) -> None:
        """A colour bar as high as the pictures, to the right of them, with a band between every two levels."""
        left, bottom, width, height = self.box
        axis = self.place(left + width + 0.1, bottom, 0.13, height)
        colour_scale = ScalarMappable(Normalize(levels[0], levels[-1]), colours)
        ticks = levels[:: math.ceil(0.15 * len(levels) / height)]
        bar = self.figure.colorbar(colour_scale, cax=axis, label=label, ticks=ticks, format="{x:.12g}")
        outline: Any = bar.outline
        outline.set_visible(False)
        axis.tick_params(length=0)

    def key(self, handles: Sequence[Any]) -> None:
        """A legend below the axes."""
        page.key_below(self.figure, handles)

    def points(self, length: float) -> float:
        """A length of the plane on paper, in points."""
        return 72 * length / self.inch


def scale(bounds: Bounds, rows: int, columns: int) -> float:
    """The length that one inch stands for where pictures of the bounds stand in rows and columns."""
    width, height = (float(np.ptp(range_)) for range_ in bounds)
    up = HEIGHT if rows == 1 else TALLER * HEIGHT
    return max(columns * width / (WIDTH - APART * (columns - 1)), rows * height / (up - APART * (rows - 1)))


def largest_scale(bounds: Bounds, count: int) -> float:
    """The same for one picture, or for two in the way that makes them larger."""
    return min(scale(bounds, rows, count // rows) for rows in (1, count))


def frame(meshes: Sequence[Any], margin: float = 0.04) -> Bounds:
    """Bounds that hold the meshes and some air around them."""
    low = np.min([mesh.points[:, :2].min(axis=0) for mesh in meshes], axis=0)
    high = np.max([mesh.points[:, :2].max(axis=0) for mesh in meshes], axis=0)
    air = margin * (high - low).max()
    (x0, y0), (x1, y1) = (low - air).tolist(), (high + air).tolist()
    return (x0, x1), (y0, y1)


def outline(*meshes: Any) -> list[Array]:
    """The boundaries of meshes as polylines, so that dashes run on over their nodes."""
    mesh = together(meshes)
    kinds = {"feature_edges": False, "non_manifold_edges": False, "manifold_edges": False}
    edges = mesh.extract_feature_edges(boundary_edges=True, **kinds)
    lines = edges.strip(join=True, max_length=edges.n_points + 1)
    points, starts = lines.points[:, :2], lines.lines
    found = []
    while len(starts):
        found.append(points[starts[1 : 1 + starts[0]]])
        starts = starts[1 + starts[0] :]
    return found


def together(meshes: Iterable[Any]) -> Any:
    """Meshes as one, nodes that coincide left apart."""
    every = list(meshes)
    return pyvista.merge(every, merge_points=False) if len(every) > 1 else every[0]
