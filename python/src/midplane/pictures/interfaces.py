"""The picture of all interfaces of a scene: opening as thickness, status as colour."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from matplotlib.artist import Artist
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.figure import Figure

from ..stored import Midplane
from ..vtu import Array
from . import labels, page, plane
from .page import ABSENT, FACE, GREY, INK, SOFT, STATUS, Bar, sign
from .plane import Page
from .results import Runs, View

INTACT, TOUCHING = 0.9, 1.8  # thickness of the lines where faces touch [points]
WIDEST = (0.05, 0.16)  # the largest opening on paper [inch], as interfaces are short or long
NAMED = 6  # interfaces whose names and ends are written at them
CLOSE = 0.25  # interfaces with names and marked ends are farther apart than this on paper [inch]
ROOM = 0.5  # an interface with marked ends is as long as this on paper [inch]


def draw_interfaces(runs: Runs, title: str, view: View) -> Figure | None:
    """Every interface along its undeformed line; `runs` are one or two (caption, results). None where no interface is there."""
    joined = [results.joined(view) for _, results in runs]
    if not any(joined):
        return None
    bodies = [list(results.bodies(view).values()) for _, results in runs]
    bounds = view.zoom or plane.frame([mesh for meshes in bodies for mesh in meshes], margin=0.1)
    fields = [[results.interfaces[name] for name in names] for (_, results), names in zip(runs, joined, strict=True)]
    every = [points for here in fields for points in here]
    largest = max(float(opening(points)[view.holds(points)].max()) for points in every)
    factor = factor_of(every, view, plane.largest_scale(bounds, len(runs)))
    names = max(joined, key=len)
    count = len(names)
    left = sum((points["status"] == ABSENT).all() for points in runs[0][1].interfaces.values())
    which = f"{count} interfaces" if count > 1 else names[0]
    subtitle = f"{view.part()}status of {which} as colour, "
    subtitle += f"opening as thickness, {page.enlarged(factor)}" if largest > 0 else "nowhere open"
    if left and len(runs) == 1 and view.subdomains == ["*"]:
        subtitle += f"; {left} absent"
    captions = tuple(caption for caption, _ in runs)
    sheet = Page(bounds, title, subtitle, captions=captions, cut=view.zoom is not None)
    sheet.label(view.length)
    for axis, meshes, here, names, (_, results) in zip(sheet.axes, bodies, fields, joined, runs, strict=True):
        if plane.can_render():
            sheet.render(meshes, None, axis, color=FACE)
        draw_outlines(axis, meshes)
        courses = {name: course(results.midplane(name)) for name in names}
        if here:
            draw_status(axis, here, courses.values(), factor, sheet.inch)
        for name in names if len(names) <= NAMED else ():
            draw_name(sheet, axis, name, courses)
    seen = np.unique(np.concatenate([points["status"][view.holds(points)] for points in every]))
    keys: list[Any] = [sign(text, colour, linewidth=1.2 if kind == 0 else 3) for kind, (text, colour) in STATUS.items() if kind in seen]
    if largest > 0:
        value = page.round_down(largest)
        size, unit = page.scaled(value, view.length)
        keys.append(Bar(f"opening of {page.plain(value / size)} {unit}", 14, sheet.points(factor * value), GREY))
    sheet.key(keys)
    return sheet.figure


def factor_of(fields: Sequence[Any], view: View, inch: float) -> float:
    """By how much openings are enlarged so that the largest is wide, but not on top of its neighbours."""
    largest = max(float(opening(points)[view.holds(points)].max()) for points in fields)
    short = np.median([points["length"].sum() for points in fields]) / inch
    return page.round_down(np.clip(0.25 * short, *WIDEST) * inch / largest) if largest > 0 else 1.0


def draw_outlines(axis: Axes, meshes: Sequence[Any]) -> list[Artist]:
    """The boundaries of the parts."""
    return [axis.add_collection(LineCollection(plane.outline(*meshes), colors="#B5B5B2", linewidths=0.6, zorder=2), autolim=False)]


def opening(points: Any) -> Array:
    """How far the faces are apart, 0 where they touch or where the interface is as it was: springs give way a little."""
    changed = (points["status"] > 0) | (points["condition"] > 0)
    meet = np.minimum(points["jump_plastic"][:, 0], 0.0)  # where there was a gap at the start
    return np.where(changed, np.maximum(points["jump"][:, 0] - meet, 0.0), 0.0)


def draw_status(axis: Axes, fields: Sequence[Any], courses: Iterable[Array], factor: float, inch: float) -> list[Artist]:
    """Interfaces as bands in the colours of their status; what was drawn."""
    every = np.concatenate([bands(points, line, factor, inch) for points, line in zip(fields, courses, strict=True)])
    status = np.concatenate([points["status"] for points in fields])
    drawn: list[Artist] = []
    for kind, (_, colour) in STATUS.items():
        look: dict[str, Any] = {"facecolors": colour, "linewidths": 0.2, "edgecolors": colour, "zorder": 3 if kind == 0 else 4}
        drawn.append(axis.add_collection(PolyCollection(every[status == kind], **look), autolim=False))
    return drawn


def bands(points: Any, line: Array, factor: float, inch: float) -> Array:
    """A band for every law point: its share of the interface, as thick as it is open."""
    bounds = np.append(0.0, np.cumsum(points["length"]))
    along = np.append(0.0, np.cumsum(np.hypot(*np.diff(line, axis=0).T)))
    ends = np.column_stack([np.interp(bounds, along * bounds[-1] / along[-1], x) for x in line.T])
    thinnest = np.where(points["status"] == 0, INTACT, TOUCHING) * inch / 72
    across = 0.5 * np.maximum(factor * opening(points), thinnest)[:, None] * points["normal"][:, :2]
    return np.stack([ends[:-1] - across, ends[1:] - across, ends[1:] + across, ends[:-1] + across], axis=1)


def course(midplane: Midplane) -> Array:
    """The mid-plane as one polyline from @0 to @1."""
    points, segments = midplane.points, midplane.segments
    return np.concatenate([points[segments[:, 0]], points[segments[-1:, 1]]])


def draw_name(sheet: Page, axis: Axes, name: str, courses: Mapping[str, Array]) -> None:
    """The name of an interface beside its middle and its ends @0 and @1, where there is room."""
    line, others = courses[name], [other for key, other in courses.items() if key != name]
    length = np.hypot(*np.diff(line, axis=0).T).sum()
    middle = line[len(line) // 2]
    crowded = any(np.hypot(*(other - middle).T).min() < CLOSE * sheet.inch for other in others)
    if length < ROOM * sheet.inch or crowded:
        return
    look: dict[str, Any] = {"fontsize": 7.5, "color": SOFT, "zorder": 6, "clip_on": sheet.cut, "path_effects": labels.HALO}
    if np.hypot(*(line[-1] - line[0])) < 1e-6 * length:
        ends = [("@0 = @1", line[0], line[0] - line.mean(axis=0))]
    else:
        ends = [("@0", line[0], line[0] - line[1]), ("@1", line[-1], line[-1] - line[-2])]
    for text, place, way in ends:
        axis.plot(*place, marker="o", markersize=2.6, color=INK, zorder=5, clip_on=sheet.cut)
        meets = any(np.hypot(*(other - place).T).min() < 0.1 * sheet.inch for other in others)
        draw_beside(axis, text, place, way, look, meets)
    if page.text_width(name, 7.5) < 0.6 * length / sheet.inch:
        k = len(line) // 2
        along = line[min(k + 1, len(line) - 1)] - line[k - 1]
        draw_beside(axis, name, middle, np.array([-along[1], along[0]]), look)


def draw_beside(axis: Axes, text: str, place: Array, way: Array, look: dict[str, Any], back: bool = False) -> None:
    """A text moved off a place in a direction, or back and aside where others meet there."""
    x, y = way / np.hypot(*way)
    place_of: dict[str, Any] = {"textcoords": "offset points"}
    if back:
        place_of |= {"xytext": (-20 * x - 8 * y, -20 * y + 8 * x), "ha": "center", "va": "center"}
    else:
        across = "center" if abs(x) < 0.5 else "left" if x > 0 else "right"
        up = "center" if abs(y) < 0.5 else "bottom" if y > 0 else "top"
        place_of |= {"xytext": (6 * x, 6 * y), "ha": across, "va": up}
    axis.annotate(text, (place[0], place[1]), **place_of, **look)
