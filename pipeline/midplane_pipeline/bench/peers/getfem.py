"""GetFEM with MUMPS, by its own model, assembly and Newton's method.

    python -m midplane_pipeline.bench.peers.getfem elastic|friction FOLDER OUT

The joint is a mesh of the segments between projected nodes, on which terms interpolate from the meshes of both bodies.
MUMPS analyses in every iteration: GetFEM does not keep that. A body has a file of its own."""

import sys

from . import common

clock = common.Clock()
import getfem as gf
import numpy as np

from . import meshes

clock.end("import")

OUTWARD = {"left": (1, [-1, 0]), "right": (2, [1, 0]), "bottom": (3, [0, -1]), "top": (4, [0, 1])}
LEFT, RIGHT, BOTTOM, TOP = (region for region, _ in OUTWARD.values())

LAME = common.YOUNG * common.POISSON / ((1 + common.POISSON) * (1 - 2 * common.POISSON))
SHEAR = common.YOUNG / (2 * (1 + common.POISSON))
JUMP = "(Interpolate(u_b, to_b) - Interpolate(u_a, to_a))"
TEST = "(Interpolate(Test_u_b, to_b) - Interpolate(Test_u_a, to_a))"
STICK = f"{common.TANGENTIAL_STIFFNESS}*({JUMP}(1) - slip)"
PRESS = f"{common.NORMAL_STIFFNESS}*neg_part({JUMP}(2))"
SLIDE = f"min(max({STICK}, -{common.FRICTION}*{PRESS}), {common.FRICTION}*{PRESS})"
# tractions (t, n), as x and y
SPRINGS = f"[{common.TANGENTIAL_STIFFNESS}*{JUMP}(1); {common.NORMAL_STIFFNESS}*{JUMP}(2)]"
COULOMB = f"[{SLIDE}; -{PRESS}]"


def body(points, cells):
    """The mesh of a layer with regions for its outer sides."""
    mesh = gf.Mesh("empty", 2)
    mesh.add_convex(gf.GeoTrans("GT_QK(2,1)"), points[cells[:, [0, 1, 3, 2]]].transpose(2, 1, 0))
    for region, outward in OUTWARD.values():
        mesh.set_region(region, mesh.outer_faces_with_direction(outward, 0.1))
    return mesh


def segments(layers):
    """The mesh of the segments between both sides of the joint."""
    ends = common.cuts(*(points[common.on_joint(points), 0] for points, _ in layers))
    ends = np.stack([ends[:-1], ends[1:]])
    mesh = gf.Mesh("empty", 2)
    mesh.add_convex(gf.GeoTrans("GT_PK(1,1)"), np.stack([ends, np.zeros_like(ends)]))
    return mesh


class Joined:
    """The bodies a and b, and between them a law at two Gauss points of every segment."""

    def __init__(self, layers, law):
        self.model = gf.Model("real")
        joint = segments(layers)
        self.mesh, self.fem, self.inside = {}, {}, {}
        for side, layer in zip("ab", layers, strict=True):
            mesh = self.mesh[side] = body(*layer)
            self.fem[side] = gf.MeshFem(mesh, 2)
            self.fem[side].set_fem(gf.Fem("FEM_QK(2,1)"))
            self.inside[side] = gf.MeshIm(mesh, gf.Integ("IM_GAUSS_PARALLELEPIPED(2,3)"))
            u = f"u_{side}"
            self.model.add_fem_variable(u, self.fem[side])
            self.model.add_isotropic_linearized_elasticity_brick(self.inside[side], u, str(LAME), str(SHEAR))
            self.model.add_interpolate_transformation_from_expression(f"to_{side}", joint, mesh, "X")
        self.joint = gf.MeshIm(joint, gf.Integ("IM_GAUSS1D(3)"))
        self.law_points = gf.MeshImData(self.joint, -1)
        self.model.add_im_data("slip", self.law_points)
        if law == SPRINGS:
            self.model.add_linear_term(self.joint, f"{law}.{TEST}", -1, True, True)
        else:
            self.model.add_nonlinear_term(self.joint, f"{law}.{TEST}")

    def pull(self, side, region, traction):
        """A traction on a region of a body."""
        self.model.add_source_term_brick(self.inside[side], f"u_{side}", traction, region)

    def hold(self, side, region, *outwards):
        """The displacement along the outward normal, by multipliers: zero or the model's data of that name."""
        where = (self.inside[side], f"u_{side}", 1, region)
        self.model.add_normal_Dirichlet_condition_with_multipliers(*where, *outwards)

    def solve(self):
        """Iterations, each with one factorisation. Of GetFEM's line searches this one needs the fewest."""
        options = dict(max_res=common.TOLERANCE, max_iter=50, lsolver="mumps", lsearch="basic")
        iterations, converged = self.model.solve(*(part for option in options.items() for part in option))
        if not converged:
            raise SystemExit(f"no equilibrium in {iterations} iterations")
        return iterations

    def at_points(self, expression):
        """An expression at the law points."""
        return self.model.interpolation(expression, self.law_points)


def elastic(made):
    """Answers of the bent layers."""
    for side in "ab":
        # to take held dofs out of the matrix costs GetFEM more than the assembly
        made.model.add_Dirichlet_condition_with_multipliers(made.inside[side], f"u_{side}", 1, LEFT)
        made.pull(side, RIGHT, "[0; -1]")
    made.model.assembly("build_all")
    clock.end("assemble")
    made.solve()
    clock.end("solve")
    x = made.at_points("X(1)")
    middle = [float(np.interp(0.5, x, made.at_points(f"({SPRINGS})({row})"))) for row in (2, 1)]
    tip = gf.asm_generic(made.inside["b"], 0, "u_b(2)", RIGHT, made.model) / 0.5
    return {"tip": tip, "traction": middle}


def friction(made, increments=common.INCREMENTS):
    """Answers of the friction box."""
    model = made.model
    model.add_initialized_data("shift", 0.0)
    model.add_initialized_data("back", 0.0)
    made.hold("a", BOTTOM)
    for region, shift in ((LEFT, "back"), (RIGHT, "shift")):
        made.hold("a", region)
        made.hold("b", region, shift)
    made.pull("b", TOP, f"[0; -{common.PRESSURE}]")
    closed = model.variable("u_b")  # or else nothing would hold the upper body at first
    closed[1::2] = -common.PRESSURE / common.NORMAL_STIFFNESS
    model.set_variable("u_b", closed)
    clock.end("assemble")
    solves, now, before = 0, model.from_variables(), None
    for number in range(increments + 1):
        if number > 1:
            model.to_variables(2 * now - before)
        model.set_variable("shift", common.SHIFT * number / increments)
        model.set_variable("back", -common.SHIFT * number / increments)
        solves += made.solve()
        before, now = now, model.from_variables()
        model.set_variable("slip", made.at_points(f"{JUMP}(1) - {SLIDE}/{common.TANGENTIAL_STIFFNESS}"))
    clock.end("solve")
    shear = gf.asm_generic(made.joint, 0, SLIDE, -1, model)
    return {"shear": shear, "factorisations": solves, "increments": increments}


def write(made, side, out):
    """The fields of a body as VTU."""
    fem = made.fem[side]
    cells = gf.MeshFem(made.mesh[side], 4)
    cells.set_fem(gf.Fem("FEM_QK(2,0)"))
    strain = f"Sym(Grad_u_{side})"
    stress = made.model.interpolation(f"{LAME}*Trace({strain})*Id(2) + {2 * SHEAR}*{strain}", cells)
    u = made.model.variable(f"u_{side}")
    fem.export_to_vtu(out, fem, u, "displacement", cells, stress, "stress")


def main(problem, folder, out):
    """The command."""
    gf.util("trace level", 0)
    layers = meshes.read(folder)
    clock.end("read")
    law, solve = (SPRINGS, elastic) if problem == "elastic" else (COULOMB, friction)
    made = Joined(layers, law)
    answers = solve(made)
    for side in "ab":
        write(made, side, out.replace(".vtu", f"_{side}.vtu"))
    clock.end("write")
    dofs = sum(fem.nbdof() for fem in made.fem.values())
    clock.tell(peer=f"GetFEM {gf.getfem_env('version')} + MUMPS", dofs=dofs, **answers)


if __name__ == "__main__":
    main(*sys.argv[1:4])
