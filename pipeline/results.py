"""The results of one scene as they are drawn: fields of one row of its history, mid-planes, the parts that are there."""

import argparse
import json
from dataclasses import dataclass, field

import numpy as np
import pyvista

from names import chosen
from page import ABSENT


class Results:
    """One stored row of one results folder, the last if none is named; beside others it may have parts that the scene has not."""

    def __init__(self, folder, scene, row=None, beside=False):
        self.folder, self.scene = folder, scene
        self.pictures = folder / "pictures"
        files = {path.stem.rpartition("_")[::2]: path for path in sorted(folder.glob("fields/*_*.vtu"))}
        self.rows = sorted({int(number) for _, number in files})
        self.row = row if row is not None or not self.rows else self.rows[-1]
        fields = {name: pyvista.read(path) for (name, number), path in files.items() if int(number) == self.row}
        self.interfaces = {name: points for name, points in fields.items() if "status" in points.array_names}
        self.subdomains = {name: mesh for name, mesh in fields.items() if name not in self.interfaces}
        strange = [name for name in self.subdomains if name not in scene["subdomains"]]
        if strange and not beside:
            raise SystemExit(f"{folder}: results of another scene, this one has no subdomain {strange[0]}")

    def has(self, view):
        """True if a part that the view asks for is there."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        return any(self.subdomains[name].cell_data.get("present", np.ones(1)).any() for name in names)

    def bodies(self, view):
        """The meshes of the parts that are there, those that the view asks for, by name."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        meshes = {name: self.subdomains[name] for name in names}
        there = {name: mesh for name, mesh in meshes.items() if mesh.cell_data.get("present", np.ones(1)).any()}
        if not there:
            raise SystemExit(f"{self.folder}: none of {', '.join(names)} is there in row {self.row}")
        if not any(view.seen(mesh).n_cells for mesh in there.values()):
            ends = np.array([mesh.bounds[:4] for mesh in there.values()])
            places = ":".join(f"{x:g}" for x in np.ravel([ends.min(axis=0)[::2], ends.max(axis=0)[1::2]], "F"))
            raise SystemExit(f"{self.folder}: nothing lies in the zoom; the parts lie in {places}")
        return there

    def material(self, subdomain):
        """The name of the material of a subdomain."""
        return self.scene["subdomains"][subdomain]["material"]

    def joined(self, view):
        """The interfaces that carry something, beside a subdomain and in the part of the plane that the view asks for."""
        names = chosen(self.folder, "subdomain", view.subdomains, self.subdomains)
        there = (name for name, points in self.interfaces.items() if (points["status"] != ABSENT).any() and view.holds(points).any())
        return [name for name in there if set(self.sides(name)) & set(names)]

    def sides(self, name):
        """The subdomains of side A and of side B."""
        if not hasattr(self, "summary"):
            self.summary = json.loads((self.folder / "summary.json").read_text())
        return self.summary["sizes"]["interfaces"][name]["subdomains"]

    def midplane(self, name):
        """Mid-plane of an interface: its points, the ends of its segments and of its grid cells, parents."""
        grid = pyvista.read(self.folder / "midplane" / f"{name}.vtu")
        lines, kind = grid.cell_connectivity.reshape(-1, 2), grid["kind"]
        parents = np.column_stack([grid["edge_a"], grid["edge_b"]])[kind == 0]
        return grid.points[:, :2], lines[kind == 0], lines[kind == 1], parents


@dataclass
class View:
    """What pictures of meshes show, and the units of their numbers."""

    stress: str = "MPa"
    length: str = "m"
    zoom: tuple | None = None  # ((x0, x1), (y0, y1)), None for all
    subdomains: list = field(default_factory=lambda: ["*"])  # patterns

    def part(self):
        """What a subtitle says of a part of the scene."""
        return "" if self.zoom is None and self.subdomains == ["*"] else "part of the scene: "

    def seen(self, mesh):
        """The cells that lie in the zoom at least in part."""
        if self.zoom is None:
            return mesh
        corners = np.array(self.zoom).T
        low, high = np.split(cell_bounds(mesh), 2, axis=1)
        return mesh.extract_cells(((low <= corners[1]) & (high >= corners[0])).all(axis=1))

    def holds(self, points):
        """Which of the points lie in the zoom."""
        low, high = np.array(self.zoom or [(-np.inf, np.inf)] * 2).T
        return ((points.points[:, :2] >= low) & (points.points[:, :2] <= high)).all(axis=1)


def cell_bounds(mesh):
    """Smallest x and y of every cell, largest x and y."""
    starts, places = mesh.cell_offsets[:-1], mesh.points[mesh.cell_connectivity, :2]
    return np.hstack([np.minimum.reduceat(places, starts), np.maximum.reduceat(places, starts)])


def add_arguments(parser):
    """The options that make a View."""
    units = {"nargs": 2, "metavar": ("STRESS", "LENGTH"), "default": ("MPa", "m")}
    parser.add_argument("--units", help="what the numbers mean, default: MPa m", **units)
    zoom = "the part of the plane that the pictures of meshes show"
    parser.add_argument("--zoom", help=zoom, metavar="X0:X1:Y0:Y1", type=parse_zoom)
    only = "draw only this subdomain, or those that fit a pattern (* any text, ? any character); may be repeated"
    parser.add_argument("--subdomain", help=only, metavar="NAME", action="append", dest="subdomains")


def parse_zoom(text):
    """X0:X1:Y0:Y1 as ((x0, x1), (y0, y1))."""
    try:
        x0, x1, y0, y1 = map(float, text.split(":"))
    except ValueError:
        raise argparse.ArgumentTypeError(f"{text} is not X0:X1:Y0:Y1") from None
    if not (x0 < x1 and y0 < y1):
        raise argparse.ArgumentTypeError(f"{text}: X0 is not below X1, or Y0 not below Y1")
    return (x0, x1), (y0, y1)


def view_of(arguments):
    """The View that the options ask for."""
    return View(*arguments.units, arguments.zoom, arguments.subdomains or ["*"])
