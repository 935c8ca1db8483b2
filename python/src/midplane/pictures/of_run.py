"""The pictures of a run."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import matplotlib as mpl

from ..errors import InputError, MachineError, ResultsError
from ..names import unknown
from ..run import sides_in
from . import page, plane
from .displacement import draw_displacement
from .interfaces import draw_interfaces
from .picture import Picture
from .plane import Bounds
from .principal import draw_principal_stress
from .results import Results, View
from .traction import draw_along

if TYPE_CHECKING:
    from ..run import Run

DRAWN = {"displacement": draw_displacement, "principal_stress": draw_principal_stress, "interfaces": draw_interfaces}


def results_of(run: Run, row: int) -> Results:
    """The row of a run that is to be drawn."""
    return Results(run.folder, run.scene, run.stored.row(row), sides=lambda name: sides_in(run.scene or {"subdomains": {}, "interfaces": {}}, name))


def view_of(view: Mapping[str, Any]) -> View:
    """What the options of a picture say."""
    for name in view:
        if name not in View.__dataclass_fields__:
            raise InputError(unknown("picture", "option", name, View.__dataclass_fields__))
    if isinstance(view.get("subdomains"), str):
        view = {**view, "subdomains": [view["subdomains"]]}
    if view.get("zoom") is not None:
        view = {**view, "zoom": zoom_of(view["zoom"])}
    return View(**view)


def zoom_of(zoom: Any) -> Bounds:
    """((x0, x1), (y0, y1)) with ends in order. Raises InputError."""
    try:
        (x0, x1), (y0, y1) = ((float(low), float(high)) for low, high in zoom)
    except (TypeError, ValueError):
        raise InputError(f"zoom: {zoom!r} is not ((x0, x1), (y0, y1))") from None
    if not (x0 < x1 and y0 < y1):
        raise InputError(f"zoom: x0 is not below x1, or y0 not below y1, in {zoom!r}")
    return (x0, x1), (y0, y1)


def title_of(run: Run) -> str:
    """The title of the scene."""
    if run.scene is not None:
        return str(run.scene.get("title") or run.folder.name)
    return str(run.summary.get("title") or run.folder.name) if (run.folder / "summary.json").is_file() else run.folder.name


def draw(run: Run, field: str, row: int, view: Mapping[str, Any]) -> Picture:
    """One picture of the plane."""
    if not isinstance(field, str):
        raise InputError(f"plot: {field!r} is no picture; the row is told by its name, plot(row={field!r})")
    if field not in DRAWN:
        raise InputError(unknown("plot", "picture", field, DRAWN))
    if not plane.can_render() and field != "interfaces":
        raise MachineError("there is no library for off-screen rendering: install libosmesa6 or libegl1")
    asked = view_of(view)
    with mpl.rc_context(page.STYLE):
        results = results_of(run, row)
        figure = DRAWN[field]([("", results)], title_of(run), asked)
        if figure is None:
            results.bodies(asked)
            raise ResultsError(f"{run.folder}: no interface is there in row {results.row}" + (", in the zoom" if asked.zoom else ""))
        return Picture(figure)


def draw_traction(run: Run, name: str, row: int, view: Mapping[str, Any]) -> Picture:
    """Both components of the traction along an interface."""
    with mpl.rc_context(page.STYLE):
        results = results_of(run, row)
        entry = (run.scene or {}).get("interfaces", {}).get(name.partition("~")[0], {})
        label = entry.get("coupling", "projected")
        return Picture(draw_along(results, name, entry.get("law"), label, [], [], title_of(run), view_of(view)))
