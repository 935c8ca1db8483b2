"""The picture of the deformed mesh, coloured by displacement."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import matplotlib as mpl
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.colors import Colormap
from matplotlib.figure import Figure
from matplotlib.image import AxesImage
from matplotlib.ticker import MaxNLocator

from ..vtu import Array
from . import page, plane
from .page import DASHES, GREY, MAP
from .plane import Page
from .results import Runs, View

EDGE = "#2B2B2B"
SHOWN = 0.1  # the largest displacement as it is drawn, of the size of the picture


@dataclass
class Scale:
    """How displacements are drawn: enlarged by a factor, coloured between levels in a unit of its own."""

    factor: float
    unit: float
    label: str
    levels: Array

    @property
    def colours(self) -> Colormap:
        """A colour between every two levels."""
        return mpl.colormaps[MAP].resampled(len(self.levels) - 1)


def scale_of(bodies: Sequence[Any], view: View) -> Scale:
    """The scale for the largest displacement that is seen."""
    seen = [part for mesh in bodies if (part := view.seen(mesh)).n_cells]
    size = max(float(np.ptp(bounds)) for bounds in view.zoom or plane.frame(seen, margin=0.0))
    largest = max(float(magnitude(mesh).max()) for mesh in seen)
    factor = page.round_down(SHOWN * size / largest) if largest > 0 else 1.0
    unit, label = page.scaled(largest, view.length)
    return Scale(factor, unit, label, np.asarray(MaxNLocator(12).tick_values(0, largest / unit or 1.0)))


def magnitude(mesh: Any) -> Array:
    """Of the displacements of the nodes."""
    return np.asarray(np.linalg.norm(mesh["displacement"], axis=1))


def deformed(mesh: Any, scale: Scale) -> Any:
    """The mesh where its nodes have moved to, enlarged."""
    moved = mesh.copy()
    moved.points = mesh.points + scale.factor * mesh["displacement"]
    moved["magnitude"] = magnitude(mesh) / scale.unit
    return moved


def draw_displacement(runs: Runs, title: str, view: View) -> Figure:
    """The deformed mesh over the outline of the undeformed one; `runs` are one or two (caption, results)."""
    bodies = [list(results.bodies(view).values()) for _, results in runs]
    every = [mesh for meshes in bodies for mesh in meshes]
    scale = scale_of(every, view)
    moved = [[deformed(mesh, scale) for mesh in meshes] for meshes in bodies]
    bounds = view.zoom or plane.frame([*every, *(mesh for meshes in moved for mesh in meshes)])
    subtitle = f"{view.part()}deformed mesh, displacement {page.enlarged(scale.factor)}; dashed: before loading"
    captions = tuple(caption for caption, _ in runs)
    sheet = Page(bounds, title, subtitle, bar=plane.BAR, captions=captions, cut=view.zoom is not None)
    sheet.label(view.length)
    for axis, meshes, meshes_moved in zip(sheet.axes, bodies, moved, strict=True):
        draw_outlines(axis, meshes)
        draw_deformed(sheet, axis, meshes_moved, scale)
    sheet.colour_bar(scale.levels, scale.colours, f"displacement [{scale.label}]")
    return sheet.figure


def draw_outlines(axis: Axes, meshes: Sequence[Any]) -> None:
    """Dashed, what the parts were before loading."""
    axis.add_collection(LineCollection(plane.outline(*meshes), colors=GREY, linewidths=0.8, linestyles=[DASHES], zorder=0), autolim=False)


def draw_deformed(sheet: Page, axis: Axes, meshes: Sequence[Any], scale: Scale) -> AxesImage:
    """The deformed meshes in their colours."""
    levels = scale.levels
    return sheet.render(meshes, EDGE, axis, scalars="magnitude", cmap=scale.colours, clim=(levels[0], levels[-1]))
