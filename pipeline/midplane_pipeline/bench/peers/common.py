"""Common to all peers: the segments between the two meshes, the law, and how a run is timed and told.

Points along the joint carry the law: two Gauss points on every segment between two projected nodes, as `pointwise`."""

import json
import resource
import time

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
        """Ends a stage."""
        now = time.perf_counter()
        self.stages[stage] = self.stages.get(stage, 0.0) + now - self.since
        self.since = now

    def tell(self, **answers):
        """Prints times, memory and answers as one line of JSON."""
        peak = 1024 * max(resource.getrusage(who).ru_maxrss for who in (resource.RUSAGE_SELF, resource.RUSAGE_CHILDREN))
        total = time.perf_counter() - self.start
        print(json.dumps({"time": {**self.stages, "total": total}, "peak_memory_bytes": peak, **answers}))


def sides(layers):
    """Points of both layers together, and which of them are on the outer sides, by name."""
    points = np.vstack([layers[0][0], layers[1][0]])
    x, y = points.T
    lower = np.arange(len(x)) < len(layers[0][0])
    at = {"bottom": y < -0.5 + 1e-9, "top": y > 0.5 - 1e-9}
    for name, body in (("lower", lower), ("upper", ~lower)):
        at[f"{name}.left"] = body & (x < 1e-9)
        at[f"{name}.right"] = body & (x > 1 - 1e-9)
    return points, {name: np.flatnonzero(found) for name, found in at.items()}


def forces(points, nodes, along, traction):
    """Some nodes in order along their straight line, and the consistent forces of a uniform traction on it."""
    nodes = nodes[np.argsort(points[nodes, along])]
    half = 0.5 * traction * np.diff(points[nodes, along])
    return nodes, np.append(half, 0.0) + np.insert(half, 0, 0.0)


def on_joint(points):
    """Nodes at y = 0, from smaller to larger x."""
    nodes = np.flatnonzero(np.abs(points[:, 1]) < 1e-9)
    return nodes[np.argsort(points[nodes, 0])]


def cuts(xs_a, xs_b):
    """Ends of the segments between the projected nodes of both sides."""
    ends = np.unique(np.round(np.concatenate([xs_a, xs_b]), 12))
    return ends[np.concatenate([[True], np.diff(ends) > 1e-9])]


def law_points(xs_a, xs_b):
    """Two Gauss points per segment: weight, then for each side its edge and the share of the edge's second node."""
    ends = cuts(xs_a, xs_b)
    length = np.diff(ends)
    xi = 0.5 * (1 + np.array([-1, 1]) / np.sqrt(3))
    x = (ends[:-1, None] + length[:, None] * xi).ravel()
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
    matrix = csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), shape=(2 * len(x), size))
    return x, weight, matrix


def bent(points, end, deflection, x, jumps):
    """Answers of the bent layers: mean deflection of an end, traction (n, t) at mid-length. `deflection` is of all
    nodes, `jumps` of the law points at `x`."""
    nodes, shares = forces(points, end, 1, 1.0)
    tractions = jumps.reshape(-1, 2) * [NORMAL_STIFFNESS, TANGENTIAL_STIFFNESS]
    middle = [float(np.interp(0.5, x, tractions[:, i])) for i in (0, 1)]
    return {"tip": float(shares @ deflection[nodes] / shares.sum()), "traction": middle}


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
