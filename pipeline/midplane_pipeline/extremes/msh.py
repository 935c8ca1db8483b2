"""Meshes written straight as MSH 4.1 text, so that a thousand scenes need no mesher.

  top          a body of cells with the physical curves bottom, right, top, left of a rectangle in the
┌──┬───┐       parameters (s, r) that a function `to` carries into the plane, and its corners as points
├──┼───┤       sw, se, ne, nw
└──┴───┘
 bottom
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any

import numpy as np
from midplane.vtu import Array

Map = Callable[[Any, Any], tuple[Any, Any]]  # (s, r) to (x, y)

GMSH_TYPE = {"P": 15, "L2": 1, "L3": 8, "T3": 2, "T6": 9, "Q4": 3, "Q8": 16}


@dataclass
class Mesh:
    """Nodes from 0, blocks of elements with the physical group each belongs to."""

    points: Array
    blocks: list[tuple[int, str, str, Array]]  # (dimension, group, type, array of node numbers)
    corners: list[int] = field(default_factory=list)  # nodes on points of the geometry
    names: list[tuple[int, int, str]] | None = None  # (dimension, tag, name), in place of those of the blocks
    z: float = 0.0

    def text(self, version: str = "4.1") -> str:
        """The file."""
        order = sorted(self.blocks, key=lambda block: block[0])
        names: list[tuple[int, int, str]] = []
        entities: list[str] = []
        tags: dict[tuple[int, str], int] = {}
        for dimension, group, _, _ in order:
            if (dimension, group) not in tags:
                tags[dimension, group] = len(tags) + 1
                names.append((dimension, tags[dimension, group], group))
        counts = [0, 0, 0, 0]
        numbered = []
        for dimension, group, kind, nodes in order:
            counts[dimension] += 1
            numbered.append((dimension, counts[dimension], tags[dimension, group], kind, nodes))
        points = [number for dimension, number, *_ in numbered if dimension == 0]
        for i in range(len(self.corners)):
            entities.append(f"{len(points) + i + 1} 0 0 0 0")
        bare = [f"{number} 0 0 0 1 {tag}" for dimension, number, tag, *_ in numbered if dimension == 0]
        lines = [f"{number} 0 0 0 0 0 0 1 {tag} 0" for dimension, number, tag, *_ in numbered if dimension > 0]
        sizes = [len(bare) + len(entities), counts[1], counts[2], 0]
        parts = [f"$MeshFormat\n{version} 0 8\n$EndMeshFormat"]
        listed = names if self.names is None else self.names
        if listed:
            texts = [f'{dimension} {tag} "{name}"' for dimension, tag, name in listed]
            parts.append("\n".join(["$PhysicalNames", str(len(texts)), *texts, "$EndPhysicalNames"]))
        parts.append("\n".join(["$Entities", " ".join(map(str, sizes)), *bare, *entities, *lines, "$EndEntities"]))
        parts.append(self.node_text(len(points)))
        parts.append(element_text(numbered))
        return "\n".join(parts) + "\n"

    def node_text(self, before: int) -> str:
        """The section of the nodes."""
        inner = np.setdiff1d(np.arange(len(self.points)), self.corners)
        blocks: list[tuple[int, int, Any]] = [(0, before + i + 1, [node]) for i, node in enumerate(self.corners)]
        blocks.append((2, 1, inner))
        n = len(self.points)
        lines = ["$Nodes", f"{len(blocks)} {n} 1 {n}"]
        for dimension, tag, nodes in blocks:
            lines.append(f"{dimension} {tag} 0 {len(nodes)}")
            lines += [str(node + 1) for node in nodes]
            lines += [f"{x!r} {y!r} {self.z!r}" for x, y in self.points[nodes].tolist()]
        return "\n".join([*lines, "$EndNodes"])

    def group(self, name: str) -> Array:
        """Nodes of a group."""
        return np.unique(np.concatenate([nodes.ravel() for _, group, _, nodes in self.blocks if group == name]))


def element_text(numbered: list[Any]) -> str:
    """The section of the elements."""
    total = sum(len(nodes) for *_, nodes in numbered)
    lines, tag = ["$Elements", f"{len(numbered)} {total} 1 {total}"], 0
    for dimension, number, _, kind, nodes in numbered:
        lines.append(f"{dimension} {number} {GMSH_TYPE[kind]} {len(nodes)}")
        for row in nodes.tolist():
            tag += 1
            lines.append(f"{tag} " + " ".join(str(node + 1) for node in row))
    return "\n".join([*lines, "$EndElements"])


def even(a: float, b: float, n: int) -> Array:
    """n equal intervals, the ends exact."""
    x = a + (b - a) * np.arange(n + 1) / n
    x[-1] = b
    return x


def same(s: Any, r: Any) -> tuple[Any, Any]:
    """A place as its parameters."""
    return s, r


def rectangle(s: Any, r: Any, shape: str, to: Map = same, body: str = "body") -> Mesh:
    """A rectangle of cells between the given parameters; mid-nodes are carried by `to` as well."""
    s, r = np.asarray(s, float), np.asarray(r, float)
    n, m = len(s) - 1, len(r) - 1
    node = np.arange((n + 1) * (m + 1)).reshape(m + 1, n + 1)
    places = [(a, b) for b in r for a in s]
    sw, se, ne, nw = node[:-1, :-1], node[:-1, 1:], node[1:, 1:], node[1:, :-1]
    quads = np.stack([sw, se, ne, nw], -1).reshape(-1, 4)
    if shape in ("T3", "T6"):
        even_cell = (np.add.outer(np.arange(m), np.arange(n)) % 2 == 0).ravel()
        first = np.where(even_cell[:, None], quads[:, [0, 1, 2]], quads[:, [0, 1, 3]])
        second = np.where(even_cell[:, None], quads[:, [0, 2, 3]], quads[:, [1, 2, 3]])
        cells = np.stack([first, second], 1).reshape(-1, 3)
    else:
        cells = quads
    curves = {
        "bottom": np.stack([node[0, :-1], node[0, 1:]], -1),
        "right": np.stack([node[:-1, -1], node[1:, -1]], -1),
        "top": np.stack([node[-1, 1:], node[-1, :-1]], -1)[::-1],
        "left": np.stack([node[1:, 0], node[:-1, 0]], -1)[::-1],
    }
    line = "L2"
    if shape in ("T6", "Q8"):
        line, mids = "L3", {}

        def mid(a: int, b: int) -> int:
            key = (min(a, b), max(a, b))
            if key not in mids:
                mids[key] = len(places)
                places.append(tuple(0.5 * (places[key[0]][d] + places[key[1]][d]) for d in (0, 1)))
            return mids[key]

        def with_mids(rows: Array, closed: bool) -> Array:
            corners = rows.shape[1]
            return np.array([[*row, *(mid(row[i], row[(i + 1) % corners]) for i in range(corners if closed else 1))] for row in rows.tolist()])

        cells = with_mids(cells, True)
        curves = {name: with_mids(rows, False) for name, rows in curves.items()}
    x, y = to(*np.array(places).T)
    corner = {"sw": node[0, 0], "se": node[0, -1], "ne": node[-1, -1], "nw": node[-1, 0]}
    blocks = [(0, name, "P", np.array([[at]])) for name, at in corner.items()]
    blocks += [(1, name, line, rows) for name, rows in curves.items()]
    blocks.append((2, body, shape, cells))
    return Mesh(np.stack([x, y], -1), blocks)


def turned(degrees: float, origin: tuple[float, float] = (0.0, 0.0)) -> Map:
    """A rotation about the origin, then a shift."""
    cos, sin = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return lambda s, r: (origin[0] + cos * s - sin * r, origin[1] + sin * s + cos * r)


def arc(start: float, turn: float) -> Map:
    """(s, r) → a place at radius r; s from 0 to 1 runs clockwise from `start` over `turn`, both in radians."""
    return lambda s, r: (r * np.cos(start - turn * s), r * np.sin(start - turn * s))
