"""The same discrete problem solved in extended precision, by another route.

Stiffness and loads are assembled here, in 80-bit numbers (ε = 1e-19), from the same meshes. The coupling is asked of the
program: jumps at the law points for unit displacements of the nodes. Unknowns are displacements and tractions,

    K u + Jᵀ W Q s = f,    Qᵀ J u − s/k = 0,    t = Q s      (Q: an orthonormal basis of what J can give),

which is well conditioned at every stiffness k of the springs, as no difference of displacements is multiplied by k.
"""

from collections.abc import Callable
from typing import Any

import numpy as np
from midplane.vtu import Array

from .msh import Mesh
from .program import Program
from .scenes import elastic, number

WIDE = np.longdouble
EPS = float(np.finfo(WIDE).eps)
ROOT3 = 1 / np.sqrt(WIDE(3))
ROOT35 = np.sqrt(WIDE(3) / WIDE(5))
GAUSS_3 = [(-ROOT35, WIDE(5) / 9), (WIDE(0), WIDE(8) / 9), (ROOT35, WIDE(5) / 9)]


def stiffness(mesh: Mesh, e: Any, nu: Any) -> Array:
    """K of a body in plane strain, dense; T3 and Q4."""
    e, nu = WIDE(e), WIDE(nu)
    factor = e / ((1 + nu) * (1 - 2 * nu))
    c = np.array([[1 - nu, nu, 0], [nu, 1 - nu, 0], [0, 0, (1 - 2 * nu) / 2]], WIDE) * factor
    k = np.zeros((2 * len(mesh.points),) * 2, WIDE)
    points = mesh.points.astype(WIDE)
    for dimension, _, kind, cells in mesh.blocks:
        if dimension != 2:
            continue
        for nodes in cells:
            x = points[nodes] - points[nodes[0]]
            dofs = np.stack([2 * nodes, 2 * nodes + 1], -1).ravel()
            for dn, weight in derivatives(kind):
                jacobian = dn.T @ x  # by (ξ, η), of (x, y)
                (a, b), (d, g) = jacobian
                determinant = a * g - b * d
                inverse = np.array([[g, -b], [-d, a]], WIDE) / determinant
                gradient = dn @ inverse.T
                matrix = np.zeros((3, len(dofs)), WIDE)
                matrix[0, 0::2], matrix[1, 1::2] = gradient[:, 0], gradient[:, 1]
                matrix[2, 0::2], matrix[2, 1::2] = gradient[:, 1], gradient[:, 0]
                k[np.ix_(dofs, dofs)] += weight * determinant * (matrix.T @ c @ matrix)
    return k


def derivatives(kind: str) -> list[tuple[Array, Any]]:
    """∂N/∂(ξ, η) at the points of the rule, with weights."""
    if kind == "T3":
        return [(np.array([[-1, -1], [1, 0], [0, 1]], WIDE), WIDE(1) / 2)]
    corners = np.array([[-1, -1], [1, -1], [1, 1], [-1, 1]], WIDE)
    rule = []
    for xi in (-ROOT3, ROOT3):
        for eta in (-ROOT3, ROOT3):
            dn = np.stack([corners[:, 0] * (1 + corners[:, 1] * eta), corners[:, 1] * (1 + corners[:, 0] * xi)], -1) / 4
            rule.append((dn, WIDE(1)))
    return rule


def in_parts(rule: list[Any], parts: int = 64) -> list[Any]:
    """A rule on equal parts of the interval."""
    middles = [(2 * WIDE(part) + 1) / parts - 1 for part in range(parts)]
    return [(middle + xi / parts, weight / parts) for middle in middles for xi, weight in rule]


def pressed(mesh: Mesh, group: str, pressure: Callable[[Any, Any], Any]) -> Array:
    """Nodal forces of a pressure p(x, y) on a curve that the body lies to the left of, exact to the precision of its numbers."""
    f = np.zeros(2 * len(mesh.points), WIDE)
    points = mesh.points.astype(WIDE)
    edges = next(nodes for _, name, _, nodes in mesh.blocks if name == group)
    for first, last in edges:
        p, q = points[first], points[last]
        normal = np.array([q[1] - p[1], p[0] - q[0]]) / 2
        for xi, weight in in_parts(GAUSS_3):
            n = (1 - xi) / 2, (1 + xi) / 2
            value = weight * pressure(*(n[0] * p + n[1] * q))
            f[2 * first : 2 * first + 2] -= n[0] * value * normal
            f[2 * last : 2 * last + 2] -= n[1] * value * normal
    return f


def coupling(program: Program, scene: dict[str, Any], meshes: dict[str, Mesh]) -> tuple[Array, Array]:
    """Jumps at the law points (n, t by point) for unit displacements of every dof, and the weights of the points."""
    bodies = list(meshes)
    zero = {body: {"x": 0.0, "y": 0.0} for body in bodies}
    sides = {"a": "top", "b": "bottom"}
    steps, columns, first = [], [], 0
    for body in bodies:
        mesh = meshes[body]
        for node in mesh.group(sides[body]):
            x, y = mesh.points[node]
            for d, direction in enumerate("xy"):
                unit = f"if((x == {number(x)})*(y == {number(y)}), 1, 0)"
                steps.append(
                    {
                        "name": f"{body} {node} {direction}",
                        "displace": {**zero, body: {**zero[body], direction: unit}},
                    }
                )
                columns.append(first + 2 * node + d)
        first += 2 * len(mesh.points)
    scene = {**scene, "steps": steps, "output": {"fields": "step"}}
    joint = scene["interfaces"]["joint"]
    scene["interfaces"] = {"joint": {**joint, "law": elastic(1.0)}}
    run = program.run(scene, meshes).need()
    for body in bodies:
        if not np.array_equal(run.points(body), meshes[body].points):
            raise AssertionError(f"{body}: the program numbers its nodes otherwise")
    jumps = [run.joint(number=i + 1)["jump"].ravel() for i in range(len(steps))]
    j = np.zeros((len(jumps[0]), first))
    j[:, columns] = np.array(jumps).T
    return j, np.repeat(run.joint()["length"].ravel(), 2)


class Precise:
    """A scene of two bodies joined by springs of one stiffness in both directions."""

    def __init__(
        self, program: Program, scene: dict[str, Any], meshes: dict[str, Mesh], materials: dict[str, tuple[float, float]], force: Array, held: Array
    ) -> None:
        self.meshes = meshes
        blocks = [stiffness(meshes[body], *materials[body]) for body in meshes]
        n = sum(len(block) for block in blocks)
        self.k = np.zeros((n, n), WIDE)
        first = 0
        for block in blocks:
            self.k[first : first + len(block), first : first + len(block)] = block
            first += len(block)
        self.force, self.free = force, np.flatnonzero(~held)
        j, weights = coupling(program, scene, meshes)
        u, singular, _ = np.linalg.svd(j, full_matrices=False)
        self.q = u[:, singular > 1e-10 * singular[0]].astype(WIDE)
        # orthonormal to the last bit of the wide numbers
        for _ in range(2):
            gram = self.q.T @ self.q
            self.q = self.q @ (1.5 * np.eye(len(gram), dtype=WIDE) - gram / 2)
        self.j, self.w = j.astype(WIDE), weights.astype(WIDE)

    def solve(self, stiffness: float) -> tuple[dict[str, Array], Array]:
        """Displacements by body, and tractions (n, t) of the law points."""
        free, q, j = self.free, self.q, self.j[:, self.free]
        n, m = len(free), q.shape[1]
        scale = np.abs(self.k).max()  # of the tractions, so that all unknowns are of one size
        matrix = np.zeros((n + m, n + m), WIDE)
        matrix[:n, :n] = self.k[np.ix_(free, free)] / scale
        matrix[:n, n:] = j.T @ (self.w[:, None] * q)
        matrix[n:, :n] = q.T @ j
        matrix[n:, n:] = -scale / WIDE(stiffness) * np.eye(m, dtype=WIDE)
        right = np.concatenate([self.force[free] / scale, np.zeros(m, WIDE)])
        x = eliminate(matrix, right)
        u = np.zeros(len(self.k), WIDE)
        u[free] = x[:n]
        ends = np.cumsum([0] + [2 * len(mesh.points) for mesh in self.meshes.values()])
        bodies = {body: u[a:b].reshape(-1, 2) for body, a, b in zip(self.meshes, ends[:-1], ends[1:], strict=True)}
        return bodies, (q @ (scale * x[n:])).reshape(-1, 2)


def eliminate(matrix: Array, right: Array) -> Array:
    """Gauss with row pivots, one step of refinement."""
    n = len(matrix)
    lu, order = matrix.copy(), np.arange(n)
    lu /= (size := np.abs(lu).max(1))[:, None]
    for i in range(n):
        p = i + int(np.argmax(np.abs(lu[i:, i])))
        if p != i:
            lu[[i, p]], order[[i, p]] = lu[[p, i]], order[[p, i]]
        lu[i + 1 :, i] /= lu[i, i]
        below = np.flatnonzero(lu[i + 1 :, i]) + i + 1
        lu[below, i + 1 :] -= lu[below, i, None] * lu[i, i + 1 :]

    def solve(b: Array) -> Array:
        x = (b / size)[order]
        for i in range(n):
            x[i] -= lu[i, :i] @ x[:i]
        for i in reversed(range(n)):
            x[i] = (x[i] - lu[i, i + 1 :] @ x[i + 1 :]) / lu[i, i]
        return x

    x = solve(right)
    return x + solve(right - matrix @ x)
