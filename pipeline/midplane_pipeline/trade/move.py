"""Nodes of a .msh moved in place: along the joint by seeded fractions of an edge, or turned about the origin.

    side of a joint, 4 edges    +-----+-----+-----+-----+
    moved                       +---+-------+----+------+    by at most a quarter of an edge, ends kept

A whole column of nodes goes with its node of the joint, so that edges stay straight and mid nodes stay in the middle.
Only coordinates change: nodes, cells and groups are those of the mesher."""

import math
import random
import struct
from collections.abc import Callable
from typing import Any

import numpy as np
from midplane.vtu import Array

Places = tuple[Array, Array]  # x and y
Move = Callable[[Array, Array], Any]

# largest move, of the length of an edge
MOST = 0.25

# Coordinates that follow the joint: (x, y) -> (s, t), s from 0 to 1 along it, and back.
ALONG: dict[str, tuple[Callable[[Any, Any], Any], Callable[[Any, Any], Any]]] = {
    "strip": (lambda x, y: (x, y), lambda s, t: (s, t)),
    "friction": (lambda x, y: (x / 2, y), lambda s, t: (2 * s, t)),
    "dcb": (lambda x, y: ((x - 0.03) / 0.07, y), lambda s, t: (0.03 + 0.07 * s, t)),
    "cook": (
        lambda x, y: ((y - 44 * x / 48) / (44 - 28 * x / 48), x),
        lambda s, t: (t, 44 * t / 48 + s * (44 - 28 * t / 48)),
    ),
    "ring": (
        lambda x, y: (np.arctan2(y, x) / (math.pi / 2), np.hypot(x, y)),
        lambda s, t: (t * np.cos(math.pi / 2 * s), t * np.sin(math.pi / 2 * s)),
    ),
}
# nodes that carry a point of the scene stay
KEPT: dict[str, tuple[float, ...]] = {"cook": (0.5,)}


def offset(scene: str, edges: int, seed: int, side: str) -> Move:
    """The move of a side with so many edges: (x, y) -> (x, y)."""
    to_local, to_global = ALONG[scene]
    draw = random.Random(f"{seed} {side}")
    nodes = np.arange(edges + 1) / edges
    moves = np.array([draw.uniform(-MOST, MOST) / edges for _ in nodes])
    for kept in (0.0, 1.0, *KEPT.get(scene, ())):
        moves[np.abs(nodes - kept) < 1e-9] = 0.0

    def move(x: Array, y: Array) -> Places:
        s, t = to_local(x, y)
        inside = (s > 0) & (s < 1)
        new_x, new_y = to_global(np.where(inside, s + np.interp(s, nodes, moves), s), t)
        return np.where(inside, new_x, x), np.where(inside, new_y, y)

    return move


def turn(cosine: float, sine: float) -> Move:
    """The turn about the origin."""
    return lambda x, y: (cosine * x - sine * y, sine * x + cosine * y)


def moved(data: bytes, move: Move) -> bytes:
    """The bytes of a binary mesh (MSH 4.1) with its nodes moved."""
    if not data.startswith(b"$MeshFormat\n4.1 1 8\n"):
        raise ValueError("no binary mesh in format 4.1")
    changed = bytearray(data)
    at = data.index(b"\n$Nodes\n") + len(b"\n$Nodes\n")
    (blocks,) = struct.unpack_from("=Q", changed, at)
    at += 4 * 8
    for _ in range(blocks):
        _, _, parametric, count = struct.unpack_from("=iiiQ", changed, at)
        if parametric:
            raise ValueError("a mesh with parametric coordinates")
        at += 3 * 4 + 8 + 8 * count
        places = np.frombuffer(changed, dtype="=f8", count=3 * count, offset=at).reshape(count, 3)
        places[:, 0], places[:, 1] = move(places[:, 0].copy(), places[:, 1].copy())
        at += 3 * 8 * count
    return bytes(changed)
