"""A wall of midplane_pipeline.bench.wall as a plain sparse Newton's method on scikit-fem, with MKL PARDISO or scipy's SuperLU: all displacements as
unknowns, the whole matrix factored in every iteration, two Gauss points with Coulomb's law on every segment of a joint.

    python -m midplane_pipeline.bench.peers.wall SCENE MESH [pardiso|superlu] [most factorisations]

A run that ends at the most factorisations tells no push."""

import json
import re
import sys
from pathlib import Path
from typing import Any

from . import common

clock = common.Clock()
import meshio
import numpy as np
import skfem
from scipy.sparse import csr_matrix
from skfem.helpers import ddot, sym_grad, trace
from skfem.models.elasticity import lame_parameters

from . import box
from .skfem import Pardiso, SuperLu, has_pardiso

clock.end("import")

TOUCH = 1e-9


class Wall:
    """The part of `box.Box` that Newton's method uses."""

    k: Any
    b: Any
    weight: Any
    free: Any

    blocks = box.Box.blocks
    pattern = box.Box.pattern


def sides(bricks, points):
    """Sides of all bricks as (line, brick, outward sign, nodes in order): a line is an axis and a coordinate."""
    found: dict[tuple[int, float], list[Any]] = {}
    for brick, nodes in enumerate(bricks):
        for axis in (0, 1):
            x = points[nodes, axis]
            for end, sign in ((x.min(), -1), (x.max(), 1)):
                on = nodes[np.abs(x - end) < TOUCH]
                on = on[np.argsort(points[on, 1 - axis])]
                found.setdefault((axis, round(end, 9)), []).append((brick, sign, on))
    return found


def joints(bricks, points, dof, size):
    """B with jump = B u at every law point, rows (n, t) by turns, and the weights."""
    rows, columns, values, weights = [], [], [], []
    count = 0
    for (axis, _), all_sides in sides(bricks, points).items():
        lower = [side for side in all_sides if side[1] > 0]
        for _, _, nodes_b in (side for side in all_sides if side[1] < 0):
            for _, _, nodes_a in lower:
                xs = [points[nodes, 1 - axis] for nodes in (nodes_a, nodes_b)]
                low, high = max(x[0] for x in xs), min(x[-1] for x in xs)
                if high - low < TOUCH:
                    continue
                ends = np.unique(np.round(np.concatenate([[low, high], *xs]), 9))
                ends = ends[(ends >= low - TOUCH) & (ends <= high + TOUCH)]
                length = np.diff(ends)
                x = (ends[:-1, None] + length[:, None] * 0.5 * (1 + np.array([-1, 1]) / np.sqrt(3))).ravel()
                weights.append(np.repeat(0.5 * length, 2))
                for sign, nodes, along in ((-1.0, nodes_a, xs[0]), (1.0, nodes_b, xs[1])):
                    edge = np.clip(np.searchsorted(along, x) - 1, 0, len(along) - 2)
                    share = (x - along[edge]) / (along[edge + 1] - along[edge])
                    for end, value in ((0, 1 - share), (1, share)):
                        for row, direction in ((0, axis), (1, 1 - axis)):
                            rows.append(2 * (count + np.arange(len(x))) + row)
                            columns.append(dof(nodes[edge + end], direction))
                            values.append(sign * value)
                count += len(x)
    entries = (np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))
    return csr_matrix(entries, shape=(2 * count, size)), np.concatenate(weights)


def main(scene_file, mesh_file, library="pardiso", most="1000000"):
    """The command."""
    pardiso = library == "pardiso" and has_pardiso()
    scene = json.loads(Path(scene_file).read_text())
    law, material = scene["interfaces"]["joints"]["law"], scene["materials"]["brick"]
    common.NORMAL_STIFFNESS, common.TANGENTIAL_STIFFNESS = law["normal_stiffness"], law["tangential_stiffness"]
    common.FRICTION = law["friction_coefficient"]
    data = meshio.read(mesh_file)
    cells = data.cells_dict["quad"]
    number = data.cell_data_dict["gmsh:physical"]["quad"]
    points = data.points[:, :2]
    names = {tag: name for name, (tag, dimension) in data.field_data.items() if dimension == 2}
    bricks = [np.unique(cells[number == tag]) for tag in sorted(names, key=lambda tag: int(re.sub(r"\D", "", names[tag])))]
    clock.end("read")
    basis = skfem.Basis(skfem.MeshQuad(points.T, cells.T), skfem.ElementVector(skfem.ElementQuad1()), intorder=2)
    lam, mu = lame_parameters(material["young"], material["poisson"])

    @skfem.BilinearForm
    def bodies(u, v, w):
        e, d = sym_grad(u), sym_grad(v)
        return 2 * mu * ddot(e, d) + lam * trace(e) * trace(d)

    @skfem.LinearForm
    def weight(v, w):
        return -material["density"] * 9.81 * v[1]

    def dof(node, direction):
        return basis.nodal_dofs[direction, node]

    wall = Wall()
    wall.k = bodies.assemble(basis).tocsr()
    size = wall.k.shape[0]
    wall.b, wall.weight = joints(bricks, points, dof, size)
    y = points[:, 1]
    held = np.flatnonzero(y < TOUCH)
    free = np.ones(size, bool)
    free[np.concatenate([dof(held, 0), dof(held, 1)])] = False
    wall.free = np.flatnonzero(free)
    top = np.zeros((2, size))
    for nodes in bricks:
        on = nodes[y[nodes] > y.max() - TOUCH]
        if len(on):
            on, forces = common.forces(points, on, 0, 1.0)
            for direction in (0, 1):
                top[direction, dof(on, direction)] += forces
    shear, normal = next(iter(scene["steps"][1]["load"].values()))["traction"]
    loads = [weight.assemble(basis) + normal * top[1]]
    increments = scene["steps"][1]["increments"]
    loads += [loads[0] + shear * (k + 1) / increments * top[0] for k in range(increments)]
    clock.end("assemble")
    u, solves = newton(wall, loads, Pardiso if pardiso else SuperLu, int(most))
    clock.end("solve")
    first = next(nodes for nodes in bricks if (y[nodes] > y.max() - TOUCH).any())
    nodes, shares = common.forces(points, first[y[first] > y.max() - TOUCH], 0, 1.0)
    push = float(shares @ u[dof(nodes, 0)] / shares.sum()) if solves < int(most) else None
    name = "scikit-fem " + skfem.__version__ + (" + PARDISO" if pardiso else " + SuperLU")
    clock.tell(peer=name, dofs=size, push=push, factorisations=solves, solve=clock.stages["solve"], bricks=len(bricks))


def newton(wall, loads, solver, most):
    """Displacements after all loads, or at the most factorisations, and the number of factorisations; line search and start as in `box.friction`."""
    size = len(wall.weight)
    one = np.full(size, common.NORMAL_STIFFNESS)
    whole, fill = wall.pattern((one, 0.5 * one, 0.5 * one, one))
    factor = solver(whole, False)
    u, before = np.zeros((2, wall.k.shape[0]))
    slip, solves = np.zeros(size), 0

    def evaluate(u, f):
        tractions, tangents, plastic = common.coulomb((wall.b @ u).reshape(-1, 2), slip)
        inner = wall.b.T @ (tractions * wall.weight[:, None]).ravel()
        residual = (f - wall.k @ u - inner)[wall.free]
        return residual, np.linalg.norm(residual) / (np.linalg.norm(inner) + np.linalg.norm(f)), tangents, plastic

    for number, f in enumerate(loads):
        trial = u.copy() if number < 2 else 2 * u - before
        residual, error, tangents, plastic = evaluate(trial, f)
        if number == 0:
            tangents = box.springs(size)
        for iteration in range(60):
            if iteration > 0 and error <= common.TOLERANCE:
                break
            # open points keep a ten-thousandth of their stiffness in the tangent, so that no brick is loose in it
            nn, nt, tn, tt = tangents
            held = (np.maximum(nn, 1e-4 * common.NORMAL_STIFFNESS), nt, tn, np.maximum(tt, 1e-4 * common.TANGENTIAL_STIFFNESS))
            correction = factor.solve(fill(held), residual)
            solves += 1
            if solves >= most:
                return trial, solves
            step = 1.0
            best: Any = None
            for _ in range(6):
                there = trial.copy()
                there[wall.free] += step * correction
                found = evaluate(there, f)
                if best is None or found[1] < best[1][1]:
                    best = (there, found)
                if found[1] < error or number == 0:
                    break
                step *= 0.5
            trial, (residual, error, tangents, plastic) = best
        else:
            raise SystemExit(f"increment {number}: no equilibrium, residual {error:.1e}")
        before, u, slip = u, trial, plastic
    return u, solves


main(*sys.argv[1:])
