"""What every peer shares: the two meshes, the segments between them, the law, and how a run is timed and told.

Points along the joint carry the law: two Gauss points on every segment between two projected nodes, as `pointwise`."""

import json
import resource
import time
from pathlib import Path

import meshio
import numpy as np

YOUNG, POISSON = 1.0e4, 0.2
NORMAL_STIFFNESS = TANGENTIAL_STIFFNESS = 1.0e7
FRICTION = 0.8785
PRESSURE, SHIFT, INCREMENTS = 10.0, 1.0e-3, 50
TOLERANCE = 1e-8


class Clock:
    """Seconds by stage since the process began to read."""

    def __init__(self):
        self.start = self.since = time.perf_counter()
        self.stages = {}

    def end(self, stage):
        now = time.perf_counter()
        self.stages[stage] = self.stages.get(stage, 0.0) + now - self.since
        self.since = now

    def tell(self, **answers):
        peak = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024
        total = time.perf_counter() - self.start
        print(json.dumps({"time": {**self.stages, "total": total}, "peak_memory_bytes": peak, **answers}))


def read(folder):
    """Points and quadrilaterals of the lower and of the upper layer."""
    layers = []
    for name in ("lower", "upper"):
        mesh = meshio.read(Path(folder) / f"{name}.msh", file_format="gmsh")
        layers.append((mesh.points[:, :2].copy(), mesh.cells_dict["quad"].astype(np.int64)))
    return layers


def on_joint(points):
    """Nodes at y = 0, from smaller to larger x."""
    nodes = np.flatnonzero(np.abs(points[:, 1]) < 1e-9)
    return nodes[np.argsort(points[nodes, 0])]


def law_points(xs_a, xs_b):
    """Two Gauss points per segment: weight, then for each side its edge and the share of the edge's second node."""
    cuts = np.unique(np.round(np.concatenate([xs_a, xs_b]), 12))
    cuts = cuts[np.concatenate([[True], np.diff(cuts) > 1e-9])]
    length = np.diff(cuts)
    xi = 0.5 * (1 + np.array([-1, 1]) / np.sqrt(3))
    x = (cuts[:-1, None] + length[:, None] * xi).ravel()
    weight = np.repeat(0.5 * length, 2)
    sides = []
    for xs in (xs_a, xs_b):
        edge = np.clip(np.searchsorted(xs, x) - 1, 0, len(xs) - 2)
        sides.append((edge, (x - xs[edge]) / (xs[edge + 1] - xs[edge])))
    return x, weight, sides


def jump_operator(layers, dof):
    """B with jump = B u at every law point, rows (n, t) by turns, and their weights. The normal points up: n = y, t = x.
    `dof(node, direction)` numbers nodes of both layers together."""
    from scipy.sparse import csr_matrix

    (points_a, _), (points_b, _) = layers
    nodes = [on_joint(points_a), on_joint(points_b)]
    xs = [points_a[nodes[0], 0], points_b[nodes[1], 0]]
    x, weight, sides = law_points(*xs)
    rows, columns, values = [], [], []
    for side, (edge, share) in enumerate(sides):
        shift = 0 if side == 0 else len(points_a)
        sign = -1.0 if side == 0 else 1.0
        for end, value in ((0, 1 - share), (1, share)):
            node = nodes[side][edge + end] + shift
            for row, direction in ((0, 1), (1, 0)):
                rows.append(2 * np.arange(len(x)) + row)
                columns.append(dof(node, direction))
                values.append(sign * value)
    size = 2 * (len(points_a) + len(points_b))
    matrix = csr_matrix(
        (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(2 * len(x), size)
    )
    return x, weight, matrix


def coulomb(jump, plastic):
    """Tractions (n, t), their derivatives (n n, n t, t n, t t) and irreversible slip for jumps (n, t): Coulomb's law
    without cohesion, return at constant normal traction, exact tangent."""
    normal = np.minimum(NORMAL_STIFFNESS * jump[:, 0], 0.0)
    closed = jump[:, 0] < 0.0
    trial = TANGENTIAL_STIFFNESS * (jump[:, 1] - plastic)
    most = -FRICTION * normal
    slides = np.abs(trial) > most
    tangential = np.where(slides, np.sign(trial) * most, trial)
    slip = np.where(slides, jump[:, 1] - tangential / TANGENTIAL_STIFFNESS, plastic)
    nn = np.where(closed, NORMAL_STIFFNESS, 0.0)
    tt = np.where(slides, 0.0, TANGENTIAL_STIFFNESS)
    tn = np.where(slides, -FRICTION * np.sign(trial) * nn, 0.0)
    return np.column_stack([normal, tangential]), (nn, np.zeros_like(nn), tn, tt), slip
