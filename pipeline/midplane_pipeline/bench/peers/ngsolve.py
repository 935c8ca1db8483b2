"""NGSolve: python -m midplane_pipeline.bench.peers.ngsolve elastic|friction FOLDER OUT sparsecholesky|pardiso|umfpack"""

import sys

from . import common

clock = common.Clock()
import ngsolve
import numpy as np
from netgen.meshing import FaceDescriptor
from netgen.meshing import Mesh as Netgen
from ngsolve import la
from pyngcore import TaskManager
from scipy.sparse import csr_matrix, tril

from . import box, meshes

clock.end("import")


def mesh_of(points, cells):
    """A mesh of quadrilaterals."""
    net = Netgen(dim=2)
    net.AddPoints(np.ascontiguousarray(np.column_stack([points, np.zeros(len(points))])))
    face = net.Add(FaceDescriptor(bc=1, surfnr=1))
    net.AddElements(dim=2, index=face, data=np.ascontiguousarray(cells, dtype=np.int32), base=0)
    return ngsolve.Mesh(net)


def solver(kind):
    """The class that factors with a solver of that name."""

    class Solver:
        """One matrix whose values change; its inverse is updated, so that the analysis is done once."""

        def __init__(self, matrix, symmetric):
            half = symmetric and kind == "sparsecholesky"
            matrix = tril(matrix, format="csr") if half else matrix
            if half:
                matrix.sort_indices()
            n = matrix.shape[0]
            rows = np.repeat(np.arange(n, dtype=np.int32), np.diff(matrix.indptr))
            make = la.SparseMatrixSymmetricd if half else la.SparseMatrixd
            self.half = matrix.data if half else None
            self.matrix = make.CreateFromCOO(rows, matrix.indices.astype(np.int32), matrix.data, n, n)
            self.inverse = None
            self.b, self.x = self.matrix.CreateColVector(), self.matrix.CreateColVector()

        def solve(self, data, b):
            if self.half is None:
                self.matrix.AsVector().FV().NumPy()[:] = data
            if self.inverse is None:
                self.inverse = self.matrix.Inverse(inverse=kind)
            else:
                self.inverse.Update()
            self.b.FV().NumPy()[:] = b
            self.x.data = self.inverse * self.b
            return self.x.FV().NumPy().copy()

    return Solver


def main(problem, folder, out, kind):
    """The command."""
    layers = meshes.read(folder)
    shift = len(layers[0][0])
    points = np.vstack([layers[0][0], layers[1][0]])
    cells = np.vstack([layers[0][1], layers[1][1] + shift])
    clock.end("read")
    mesh = mesh_of(points, cells)
    fes = ngsolve.VectorH1(mesh, order=1)
    lam = common.YOUNG * common.POISSON / ((1 + common.POISSON) * (1 - 2 * common.POISSON))
    mu = common.YOUNG / (2 * (1 + common.POISSON))
    u, v = fes.TnT()

    def stress(w):
        e = ngsolve.Sym(ngsolve.Grad(w))
        return 2 * mu * e + lam * ngsolve.Trace(e) * ngsolve.Id(2)

    bodies = ngsolve.BilinearForm(fes)
    bodies += ngsolve.InnerProduct(stress(u), ngsolve.Grad(v)) * ngsolve.dx
    with TaskManager():
        bodies.Assemble()
    values, columns, offsets = bodies.mat.CSR()
    n = fes.ndof
    k = csr_matrix((np.asarray(values), np.asarray(columns), np.asarray(offsets)), shape=(n, n))
    k.sort_indices()

    def dof(node, direction):
        return np.asarray(node) + direction * len(points)

    clock.end("assemble")
    elastic = problem == "elastic"
    made = box.Box(layers, k, dof, elastic)
    found, answers = (box.elastic if elastic else box.friction)(made, solver(kind), clock)
    field = ngsolve.GridFunction(fes)
    field.vec.FV().NumPy()[:] = found
    fields = dict(coefs=[field, stress(field)], names=["displacement", "stress"])
    ngsolve.VTKOutput(mesh, filename=out.removesuffix(".vtu"), legacy=False, **fields).Do()
    clock.end("write")
    clock.tell(peer=f"NGSolve {ngsolve.__version__} + {kind}", dofs=n, **answers)


if __name__ == "__main__":
    main(*sys.argv[1:5])
