"""The picture of principal stresses as crosses, on an even grid over the page whatever the meshes are.

A cross shows the stress of the cell under its centre. Parts too thin for the grid have crosses along their middle, as far
apart. Where the stresses in two materials differ by much, as in a lining and the ground, each has a scale of its own, told below.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from matplotlib.figure import Figure

from ..names import grouped
from ..vtu import Array
from . import page, plane
from .page import BLUE, FACE, VERMILLION, Bar, sign
from .plane import Bounds, Page
from .results import Runs, View

CROSSES = 500  # about so many on a page
CLOSEST, FARTHEST = 0.045, 0.2  # of two crosses [inch]
THIN = 0.9  # of that distance: a thinner part has crosses along its middle
FINE = 3  # places tried across a thin part, and along the distance of two crosses
MOST = 3000  # places tried in one thin part
ARM = 0.75  # the usual cross, of the distance of two
USUAL = 98  # percentile of the larger principal stress that counts as usual
LARGEST = 3.0  # an arm, of the usual one
APART = 4.0  # materials whose middle stresses differ by more have scales of their own
SCALES = 3  # at most
BAR = 12.0  # length of the bar that shows a scale, at least about [points]


@dataclass
class Crosses:
    """Places in one part, principal stresses there and their first direction."""

    places: Array
    principal: Array
    angle: Array

    @property
    def size(self) -> Array:
        """The larger principal stress of each."""
        return np.asarray(np.abs(self.principal).max(axis=1))


def draw_principal_stress(runs: Runs, title: str, view: View) -> Figure:
    """Crosses: arms along the principal directions, as long as the stress is large; `runs` are one or two (caption, results)."""
    bodies = [results.bodies(view) for _, results in runs]
    every = [mesh for meshes in bodies for mesh in meshes.values()]
    bounds = view.zoom or plane.frame(every)
    subtitle = f"{view.part()}principal stresses in the plane, of the cell under each cross"
    captions = tuple(caption for caption, _ in runs)
    sheet = Page(bounds, title, subtitle, captions=captions, cut=view.zoom is not None)
    sheet.label(view.length)
    inner = view.zoom or plane.frame(every, margin=0.0)
    apart = distance(bodies, inner, sheet.inch)
    crosses = [sample(meshes, inner, apart) for meshes in bodies]
    stress: dict[str, Array] = {}
    for (_, results), run in zip(runs, crosses, strict=True):
        for name, here in run.items():
            material = results.material(name)
            stress[material] = np.append(stress.get(material, np.array([])), here.size)
    groups = scales(stress)
    lengths = {material: ARM * apart / value for value, materials in groups for material in materials}  # per stress
    for axis, (_, results), meshes, run in zip(sheet.axes, runs, bodies, crosses, strict=True):
        sheet.render(list(meshes.values()), "#DCDCD9", axis, color=FACE)
        draw_crosses(axis, [(here, lengths[results.material(name)]) for name, here in run.items() if len(here.size)])
    signs: list[Any] = [sign("compression", BLUE, linewidth=1.4), sign("tension", VERMILLION, linewidth=1.4)]
    sheet.key(signs + scale_bars(groups, sheet.points(ARM * apart), view.stress))
    return sheet.figure


def distance(bodies: Sequence[Mapping[str, Any]], bounds: Bounds, inch: float) -> float:
    """Of two crosses in the plane: as many as a page bears."""
    area = max(sum(mesh.area for mesh in meshes.values()) for meshes in bodies)
    area = min(area, np.prod([np.ptp(range_) for range_ in bounds]))
    return inch * float(np.clip(np.sqrt(area / CROSSES) / inch, CLOSEST, FARTHEST))


def sample(bodies: Mapping[str, Any], bounds: Bounds, apart: float) -> dict[str, Crosses]:
    """Crosses by the name of the part, each place in one part only."""
    grid = even(bounds, apart)
    free = np.full(len(grid), True)
    found = {}
    for name, mesh in bodies.items():
        edge = plane.outline(mesh)
        if (thick := thickness(mesh, edge)) < THIN * apart:
            places, cells = along_the_middle(mesh, edge, thick, bounds, apart)
        else:
            at, cells = inside(mesh, grid[free])
            places = grid[free][at]
            free[np.flatnonzero(free)[at]] = False
        stress = mesh.cell_data["stress"][cells]
        angle = 0.5 * np.arctan2(2 * stress[:, 3], stress[:, 0] - stress[:, 1])
        found[name] = Crosses(places, mesh.cell_data["principal_stress"][cells][:, :2], angle)
    return found


def even(bounds: Sequence[Sequence[float]], apart: float) -> Array:
    """Points in the middle of the squares that the bounds are cut into."""
    lines = []
    for low, high in bounds:
        count = max(1, round((high - low) / apart))
        lines.append(low + (np.arange(count) + 0.5) * (high - low) / count)
    return np.stack(np.meshgrid(*lines), axis=-1).reshape(-1, 2)


def inside(mesh: Any, points: Array) -> tuple[Array, Array]:
    """Which of the points lie in the mesh, and the cells there."""
    (x0, x1, y0, y1, *_), low, high = mesh.bounds, points.min(axis=0, initial=0), points.max(axis=0, initial=0)
    if not len(points) or x1 < low[0] or x0 > high[0] or y1 < low[1] or y0 > high[1]:
        return np.array([], int), np.array([], int)
    near = np.flatnonzero(((points >= (x0, y0)) & (points <= (x1, y1))).all(axis=1))
    if not len(near):
        return near, near
    cells = np.atleast_1d(mesh.find_containing_cell(np.column_stack([points[near], np.zeros(len(near))])))
    return near[cells >= 0], cells[cells >= 0]


def thickness(mesh: Any, edge: Sequence[Array]) -> float:
    """About the thickness of a thin part: twice its area over its boundary."""
    return 2 * float(mesh.area) / sum(float(np.linalg.norm(np.diff(line, axis=0), axis=1).sum()) for line in edge)


def along_the_middle(mesh: Any, edge: Sequence[Array], thick: float, bounds: Bounds, apart: float) -> tuple[Array, Array]:
    """Places about the middle of a thin part, not closer than the crosses of the grid, and the cells there."""
    box = [mesh.bounds[:2], mesh.bounds[2:4]]
    fine = min(apart, thick) / FINE
    fine = max(fine, np.sqrt(np.prod([max(np.ptp(range_), fine) for range_ in box]) / (20 * MOST)))
    places = even(box, fine)
    at, cells = inside(mesh, places)
    places = places[at]
    seen = ((places >= np.array(bounds)[:, 0]) & (places <= np.array(bounds)[:, 1])).all(axis=1)
    step = max(1, seen.sum() // MOST)
    places, cells = places[seen][::step], cells[seen][::step]
    if not len(places):
        return places, cells
    border = np.concatenate([densely(line, fine) for line in edge])
    depth = np.array([np.hypot(*(border - place).T).min() for place in places])
    deepest = np.array([depth[np.hypot(*(places - place).T) < apart].max() for place in places])
    middle = np.flatnonzero(depth >= 0.8 * deepest)
    taken = middle[one_after_the_other(places[middle], 0.95 * apart)]
    return places[taken], cells[taken]


def densely(line: Array, fine: float) -> Array:
    """The points of a polyline and more between them."""
    parts = [np.linspace(a, b, 2 + int(np.hypot(*(b - a)) / fine)) for a, b in pairwise(line)]
    return np.concatenate(parts)


def one_after_the_other(places: Array, apart: float) -> list[int]:
    """Indices of places from one end on, each as near to those before as it may be."""
    taken = [int(np.lexsort(places.T[::-1])[0])]
    nearest = np.hypot(*(places - places[taken[0]]).T)
    while (nearest >= apart).any():
        taken.append(int(np.where(nearest >= apart, nearest, np.inf).argmin()))
        nearest = np.minimum(nearest, np.hypot(*(places - places[taken[-1]]).T))
    return taken


def scales(stress: Mapping[str, Array]) -> list[tuple[float, list[str]]]:
    """Materials by the stresses of their crosses: (stress of the usual arm, materials), from the largest down."""
    middle = {material: float(np.median(sizes)) for material, sizes in stress.items() if len(sizes)}
    groups: list[list[str]] = []
    for material in sorted(middle, key=lambda material: -middle[material]):
        largest = middle[groups[-1][0]] if groups else 0.0
        if not groups or (0 < middle[material] < largest / APART and len(groups) < SCALES):
            groups.append([])
        groups[-1].append(material)
    return [(usual(np.concatenate([stress[material] for material in group])), group) for group in groups]


def usual(sizes: Array) -> float:
    """The stress that most do not exceed, so large that no arm becomes too long."""
    return max(float(np.percentile(sizes, USUAL)), float(sizes.max()) / LARGEST) or 1.0


def scale_bars(groups: Sequence[tuple[float, list[str]]], length: float, unit: str) -> list[Bar]:
    """An entry of the key for every scale, of a round stress; with the materials where there are several."""
    bars = []
    for largest, materials in groups:
        value = page.round_down(max(1.0, BAR / length) * largest)
        where = f" in {grouped(materials)}" if len(groups) > 1 else ""
        bars.append(Bar(f"{page.plain(value)} {unit}{where}", length * value / largest))
    return bars


def draw_crosses(axis: Axes, crosses: Sequence[tuple[Crosses, float]]) -> None:
    """The arms of (crosses, length per stress) in the colour of their sign."""
    lines: dict[str, list[Array]] = {BLUE: [], VERMILLION: []}
    small = 1e-6 * max(float(here.size.max(initial=0.0)) for here, _ in crosses)
    for here, length in crosses:
        for column, turn in ((0, 0.0), (1, np.pi / 2)):
            direction = np.column_stack([np.cos(here.angle + turn), np.sin(here.angle + turn)])
            value = here.principal[:, column]
            arm = 0.5 * length * np.abs(value)[:, None] * direction
            ends = np.stack([here.places - arm, here.places + arm], axis=1)
            lines[BLUE].append(ends[value < -small])
            lines[VERMILLION].append(ends[value > small])
    for colour, parts in lines.items():
        axis.add_collection(LineCollection(list(np.concatenate(parts)), colors=colour, linewidths=0.9, zorder=2), autolim=False)
