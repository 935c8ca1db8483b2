"""The results of one scene as they are drawn: fields of one row of its history, mid-planes, the parts that are there."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from ..errors import ResultsError
from ..names import chosen
from ..stored import Midplane, Stored
from ..vtu import Array
from .page import ABSENT


class Results:
    """One stored row of a results folder, the last if none is named; of a run beside others it may have parts that the scene has not."""

    def __init__(
        self,
        folder: Path,
        scene: Mapping[str, Any] | None,
        row: int | None = None,
        beside: bool = False,
        sides: Callable[[str], Sequence[str | None]] | None = None,
    ) -> None:
        self.folder, self.scene, self.stored = folder, scene, Stored(folder)
        self.told = sides
        self.pictures = folder / "pictures"
        files = self.stored.files()
        self.rows = sorted({number for _, number in files})
        self.row = row if row is not None or not self.rows else self.rows[-1]
        fields = {name: self.stored.grid(name, number) for name, number in files if number == self.row}
        self.interfaces: dict[str, Any] = {name: points for name, points in fields.items() if "status" in points.array_names}
        self.subdomains: dict[str, Any] = {name: mesh for name, mesh in fields.items() if name not in self.interfaces}
        strange = [name for name in self.subdomains if name not in scene["subdomains"]] if scene is not None else []
        if strange and not beside:
            raise ResultsError(f"{folder}: results of another scene, this one has no subdomain {strange[0]}")

    def has(self, view: View) -> bool:
        """True if a part that the view asks for is there."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        return any(is_there(self.subdomains[name]) for name in names)

    def bodies(self, view: View) -> dict[str, Any]:
        """The meshes of the parts that are there, those that the view asks for, by name."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        there = {name: self.subdomains[name] for name in names if is_there(self.subdomains[name])}
        if not there:
            raise ResultsError(f"{self.folder}: none of {', '.join(names)} is there in row {self.row}")
        if not any(view.seen(mesh).n_cells for mesh in there.values()):
            ends = np.array([mesh.bounds[:4] for mesh in there.values()])
            places = ":".join(f"{x:g}" for x in np.ravel([ends.min(axis=0)[::2], ends.max(axis=0)[1::2]], "F"))
            raise ResultsError(f"{self.folder}: nothing lies in the zoom; the parts lie in {places}")
        return there

    def material(self, subdomain: str) -> str:
        """The name of the material of a subdomain; where the scene is not known all are of one."""
        return str(self.scene["subdomains"][subdomain]["material"]) if self.scene is not None else ""

    def joined(self, view: View) -> list[str]:
        """The interfaces that carry something, beside a subdomain and in the part of the plane that the view asks for."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        there = (name for name, points in self.interfaces.items() if (points["status"] != ABSENT).any() and view.holds(points).any())
        return [name for name in there if view.subdomains == ["*"] or set(self.sides(name)) & set(names)]

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json."""
        return self.stored.summary()

    def sides(self, name: str) -> Sequence[str | None]:
        """The subdomains of side A and of side B: the summary's, or as they were told where a run has none yet."""
        if self.told is not None and not (self.folder / "summary.json").is_file():
            return self.told(name)
        sides: list[str] = self.summary["sizes"]["interfaces"][name]["subdomains"]
        return sides

    def midplane(self, name: str) -> Midplane:
        """The geometry of an interface."""
        return Midplane(self.folder / "midplane" / f"{name}.vtu")


Runs = Sequence[tuple[str, Results]]  # caption, results


def is_there(mesh: Any) -> bool:
    """Whether a part is there in this row."""
    return bool(mesh.cell_data.get("present", np.ones(1)).any())


@dataclass
class View:
    """What pictures of meshes show, and the units of their numbers."""

    stress: str = "MPa"
    length: str = "m"
    zoom: tuple[tuple[float, float], tuple[float, float]] | None = None  # ((x0, x1), (y0, y1)), None for all
    subdomains: list[str] = field(default_factory=lambda: ["*"])  # patterns

    def part(self) -> str:
        """What a subtitle says of a part of the scene."""
        return "" if self.zoom is None and self.subdomains == ["*"] else "part of the scene: "

    def seen(self, mesh: Any) -> Any:
        """The cells that lie in the zoom at least in part."""
        if self.zoom is None:
            return mesh
        corners = np.array(self.zoom).T
        low, high = np.split(cell_bounds(mesh), 2, axis=1)
        return mesh.extract_cells(((low <= corners[1]) & (high >= corners[0])).all(axis=1))

    def holds(self, points: Any) -> Array:
        """Which of the points lie in the zoom."""
        low, high = np.array(self.zoom or [(-np.inf, np.inf)] * 2).T
        return np.asarray(((points.points[:, :2] >= low) & (points.points[:, :2] <= high)).all(axis=1))


def cell_bounds(mesh: Any) -> Array:
    """Smallest x and y of every cell, largest x and y."""
    starts, places = mesh.cell_offsets[:-1], mesh.points[mesh.cell_connectivity, :2]
    return np.hstack([np.minimum.reduceat(places, starts), np.maximum.reduceat(places, starts)])
