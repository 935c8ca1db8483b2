"""scikit-fem with MKL PARDISO (pypardiso), or SuperLU where that is missing.

python -m midplane_pipeline.bench.peers.skfem elastic|friction FOLDER OUT"""

import sys

from . import common

clock = common.Clock()
import meshio
import numpy as np
import skfem
from skfem.helpers import ddot, sym_grad, trace
from skfem.models.elasticity import lame_parameters

from . import box, meshes

try:
    import pypardiso
except ImportError:
    pypardiso = None
clock.end("import")


def has_pardiso():
    """True if there is MKL PARDISO."""
    return pypardiso is not None


class Pardiso:
    """Analysis once, factor and solve for every call; symmetric positive definite matrices by their upper half."""

    def __init__(self, matrix, symmetric):
        from scipy.sparse import triu

        self.half = triu(matrix, format="csr") if symmetric else None
        self.matrix = matrix
        self.pardiso = pypardiso.PyPardisoSolver(mtype=2 if symmetric else 11)
        self.analysed = False

    def solve(self, data, b):
        """Factors the values and solves."""
        a = self.half
        if a is None:
            a = self.matrix
            a.data = data
        if not self.analysed:
            self.pardiso.set_phase(11)
            self.pardiso._call_pardiso(a, np.zeros((a.shape[0], 1)))
            self.analysed = True
        self.pardiso.set_phase(22)
        self.pardiso._call_pardiso(a, np.zeros((a.shape[0], 1)))
        self.pardiso.set_phase(33)
        return self.pardiso._call_pardiso(a, np.asfortranarray(b.reshape(-1, 1))).ravel()


class SuperLu:
    """scipy's splu, in symmetric mode."""

    def __init__(self, matrix, symmetric):
        self.matrix = matrix

    def solve(self, data, b):
        """Factors the values and solves."""
        from scipy.sparse.linalg import splu

        self.matrix.data = data
        options = dict(SymmetricMode=True)
        lu = splu(self.matrix.tocsc(), permc_spec="MMD_AT_PLUS_A", diag_pivot_thresh=0.01, options=options)
        return lu.solve(b)


def main(problem, folder, out):
    """The command."""
    layers = meshes.read(folder)
    shift = len(layers[0][0])
    points = np.vstack([layers[0][0], layers[1][0]])
    cells = np.vstack([layers[0][1], layers[1][1] + shift])
    clock.end("read")
    mesh = skfem.MeshQuad(points.T, cells.T)
    basis = skfem.Basis(mesh, skfem.ElementVector(skfem.ElementQuad1()), intorder=2)
    lam, mu = lame_parameters(common.YOUNG, common.POISSON)

    @skfem.BilinearForm
    def bodies(u, v, w):
        e, d = sym_grad(u), sym_grad(v)
        return 2 * mu * ddot(e, d) + lam * trace(e) * trace(d)

    k = bodies.assemble(basis).tocsr()

    def dof(node, direction):
        return basis.nodal_dofs[direction, node]

    clock.end("assemble")
    elastic = problem == "elastic"
    made = box.Box(layers, k, dof, elastic)
    solver = Pardiso if pypardiso else SuperLu
    u, answers = (box.elastic if elastic else box.friction)(made, solver, clock)
    gradient = np.asarray(basis.interpolate(u).grad)
    e = 0.5 * (gradient + gradient.swapaxes(0, 1)).mean(axis=-1)
    volume = lam * (e[0, 0] + e[1, 1])
    stress = np.column_stack([2 * mu * e[0, 0] + volume, 2 * mu * e[1, 1] + volume, 2 * mu * e[0, 1]])
    displacement = np.column_stack([u[dof(np.arange(len(points)), d)] for d in (0, 1)] + [np.zeros(len(points))])
    three = np.column_stack([points, np.zeros(len(points))])
    meshio.Mesh(three, [("quad", cells)], {"displacement": displacement}, {"stress": [stress]}).write(out)
    clock.end("write")
    name = "scikit-fem " + skfem.__version__ + (" + PARDISO" if pypardiso else " + SuperLU")
    clock.tell(peer=name, dofs=len(u), **answers)


if __name__ == "__main__":
    main(*sys.argv[1:4])
