"""The two benchmark problems for any peer: the bent elastic layers and the friction box, Newton's method included.

A peer brings the stiffness of the bodies `k` (rows and columns as its `dof` numbers them) and `solver(matrix, symmetric)`,
which makes an object whose `solve(data, b)` factors the values `data` on the pattern of `matrix` and solves. A Newton
iteration factors anew, symbolic analysis is done once where the peer's solver lets that be."""

from typing import Any

import numpy as np
from scipy.sparse import csr_matrix

from . import common


class Box:
    """Bodies and joint; held dofs go out of the matrix."""

    def __init__(self, layers, k, dof, elastic):
        self.k = k
        self.points, at = common.sides(layers)
        self.at, self.dof = at, dof
        self.x, self.weight, self.b = common.jump_operator(layers, dof)
        self.f = np.zeros(k.shape[0])
        sides = [at[n] for n in ("lower.left", "lower.right", "upper.left", "upper.right")]
        if elastic:
            held = [dof(s, d) for s in (sides[0], sides[2]) for d in (0, 1)]
            self.pull(sides[1], 1, 1, -1.0)
            self.pull(sides[3], 1, 1, -1.0)
        else:
            held = [dof(s, 0) for s in sides] + [dof(at["bottom"], 1)]
            self.pull(at["top"], 0, 1, -common.PRESSURE)
        free = np.ones(k.shape[0], bool)
        free[np.concatenate(held)] = False
        self.free = np.flatnonzero(free)
        self.pushed = np.concatenate([dof(sides[2], 0), dof(sides[3], 0)])

    def pull(self, nodes, along, direction, traction):
        """Adds a uniform traction on nodes that lie along an axis."""
        nodes, forces = common.forces(self.points, nodes, along, traction)
        self.f[self.dof(nodes, direction)] += forces

    def blocks(self, nn, nt, tn, tt):
        """B^T w D B by rows and columns: the values of every law point's block."""
        size = len(self.weight)
        rows = 2 * np.arange(size)
        d = csr_matrix(
            (
                np.concatenate([nn, nt, tn, tt]) * np.tile(self.weight, 4),
                (np.concatenate([rows, rows, rows + 1, rows + 1]), np.concatenate([rows, rows + 1] * 2)),
            ),
            shape=(2 * size, 2 * size),
        )
        b = self.b[:, self.free]
        return (b.T @ d @ b).tocoo()

    def pattern(self, ones):
        """Bodies and joint together on the free dofs, and a function that fills its values with other tangents."""
        k = self.k[self.free][:, self.free].tocsr()
        joint = self.blocks(*ones)
        whole = (k + joint.tocsr()).tocsr()
        whole.sort_indices()

        def places(rows, columns):
            return np.array(
                [whole.indptr[r] + np.searchsorted(whole.indices[whole.indptr[r] : whole.indptr[r + 1]], c) for r, c in zip(rows, columns, strict=True)],
                dtype=np.int64,
            )

        bare = whole.data.copy()
        where = places(joint.row, joint.col)
        bare[where] -= joint.data
        keys = joint.row.astype(np.int64) * whole.shape[0] + joint.col
        order = np.argsort(keys)
        keys, where = keys[order], where[order]

        def fill(tangents):
            now = self.blocks(*tangents)
            data = bare.copy()
            at = np.searchsorted(keys, now.row.astype(np.int64) * whole.shape[0] + now.col)
            data[where[at]] += now.data
            return data

        return whole, fill


def springs(size):
    """Tangents of springs at so many law points."""
    return (
        np.full(size, common.NORMAL_STIFFNESS),
        np.zeros(size),
        np.zeros(size),
        np.full(size, common.TANGENTIAL_STIFFNESS),
    )


def elastic(box, solver, clock):
    """Displacements, tip displacement and traction (n, t) at mid-length of the bent layers."""
    k = box.k[box.free][:, box.free].tocsr()
    matrix = (k + box.blocks(*springs(len(box.weight))).tocsr()).tocsr()
    matrix.sort_indices()
    clock.end("assemble")
    u = np.zeros(box.k.shape[0])
    factor = solver(matrix, True)
    u[box.free] = factor.solve(matrix.data, box.f[box.free])
    clock.end("solve")
    deflection = u[box.dof(np.arange(len(box.points)), 1)]
    return u, common.bent(box.points, box.at["upper.right"], deflection, box.x, box.b @ u)


def friction(box, solver, clock, increments=common.INCREMENTS):
    """Displacements and total shear after compression and `increments` of shear, with the number of factorisations."""
    size = len(box.weight)
    one = np.full(size, common.NORMAL_STIFFNESS)
    whole, fill = box.pattern((one, 0.5 * one, 0.5 * one, one))
    clock.end("assemble")
    factor = solver(whole, False)
    u, before = np.zeros((2, box.k.shape[0]))
    slip, solves = np.zeros(size), 0

    def evaluate(u):
        tractions, tangents, plastic = common.coulomb((box.b @ u).reshape(-1, 2), slip)
        inner = box.b.T @ (tractions * box.weight[:, None]).ravel()
        residual = (box.f - box.k @ u - inner)[box.free]
        scale = np.linalg.norm(inner) + np.linalg.norm(box.f)
        return residual, np.linalg.norm(residual) / scale, tractions, tangents, plastic

    for number in range(increments + 1):
        trial = u.copy() if number < 2 else 2 * u - before
        trial[box.pushed] = common.SHIFT * number / increments
        residual, error, tractions, tangents, plastic = evaluate(trial)
        if number == 0:  # nothing has been closed yet: start from springs
            tangents = springs(size)
        for iteration in range(50):
            if iteration > 0 and error <= common.TOLERANCE:
                break
            correction = factor.solve(fill(tangents), residual)
            solves += 1
            step = 1.0
            best: Any = None
            for _ in range(6):
                there = trial.copy()
                there[box.free] += step * correction
                found = evaluate(there)
                if best is None or found[1] < best[1][1]:
                    best = (there, found)
                if found[1] < error or number == 0:
                    break
                step *= 0.5
            trial, (residual, error, tractions, tangents, plastic) = best
        else:
            raise SystemExit(f"increment {number}: no equilibrium, residual {error:.1e}")
        before, u, slip = u, trial, plastic
    clock.end("solve")
    shear = float(box.weight @ tractions[:, 1])
    return u, {"shear": shear, "factorisations": solves, "increments": increments}
