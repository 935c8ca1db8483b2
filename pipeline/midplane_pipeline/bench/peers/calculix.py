"""CalculiX with SPOOLES: the meshes become a deck, ccx runs once, its answers become a VTU.

    python -m midplane_pipeline.bench.peers.calculix elastic|friction FOLDER OUT

The joint is CalculiX's own face-to-face penalty contact between plane strain elements, TIED for `elastic`: K_N is the
slope of pressure over overclosure, K_T the stick slope, at Gauss points of its own. The contact follows the bodies, so
that a joint which slides by 1 mm is 1 mm shorter; ours keeps its length. Increments are CalculiX's own, tolerances too."""

import re
import subprocess
import sys
import tempfile
from pathlib import Path

from . import common

clock = common.Clock()
import meshio
import numpy as np

from . import meshes

clock.end("import")

ENDS = [f"{body}.{end}" for body in ("lower", "upper") for end in ("left", "right")]


def table(rows):
    """Rows of a deck."""
    return "\n".join(", ".join(map(str, row)) for row in rows)


def surface(name, points, cells, first):
    """The edges at y = 0 as faces S1 to S4 of the elements from number `first`."""
    low = np.isin(cells, common.on_joint(points))
    cell, face = np.nonzero(low & np.roll(low, -1, axis=1))
    return f"*SURFACE, NAME={name}\n" + table((c + first, f"S{f + 1}") for c, f in zip(cell, face, strict=True))


def loads(points, nodes, along, traction):
    """Forces along y."""
    nodes, forces = common.forces(points, nodes, along, traction)
    return table((node + 1, 2, force) for node, force in zip(nodes, forces, strict=True))


def model(layers, points, cells, at, behaviour):
    """Nodes, elements, material and joint of a deck."""
    yield "*NODE, NSET=ALL"
    yield table((number, x, y, 0.0) for number, (x, y) in enumerate(points.tolist(), 1))
    yield "*ELEMENT, TYPE=CPE4, ELSET=ROCK"
    yield table((number, *nodes) for number, nodes in enumerate((cells + 1).tolist(), 1))
    for name, nodes in at.items():
        yield f"*NSET, NSET={name}\n" + table((node + 1, "") for node in nodes)
    yield "*NSET, NSET=PUSHED\nupper.left, upper.right"
    (points_a, cells_a), (points_b, cells_b) = layers
    yield surface("SIDE_A", points_a, cells_a, 1)
    yield surface("SIDE_B", points_b, cells_b, 1 + len(cells_a))
    yield f"*MATERIAL, NAME=ROCK\n*ELASTIC\n{common.YOUNG}, {common.POISSON}"
    yield "*SOLID SECTION, ELSET=ROCK, MATERIAL=ROCK\n1.0"
    yield "*SURFACE INTERACTION, NAME=JOINT"
    yield f"*SURFACE BEHAVIOR, PRESSURE-OVERCLOSURE={behaviour}\n{common.NORMAL_STIFFNESS}"
    yield f"*FRICTION\n{common.FRICTION}, {common.TANGENTIAL_STIFFNESS}"
    yield "*CONTACT PAIR, INTERACTION=JOINT, TYPE=SURFACE TO SURFACE\nSIDE_A, SIDE_B"


def elastic(points, at):
    """The step that bends the layers."""
    yield "*BOUNDARY\nlower.left, 1, 2\nupper.left, 1, 2"
    yield "*STEP\n*STATIC, DIRECT\n1.0, 1.0\n*CLOAD"
    for end in ("lower.right", "upper.right"):
        yield loads(points, at[end], 1, -1.0)


def friction(points, at):
    """The steps that press the box and shear it."""
    yield "*BOUNDARY\nbottom, 2, 2\n" + table((end, 1, 1) for end in ENDS)
    yield "*STEP\n*STATIC, DIRECT\n1.0, 1.0\n*CLOAD\n" + loads(points, at["top"], 0, -common.PRESSURE)
    yield f"*END STEP\n*STEP, INC=1000\n*STATIC, DIRECT\n{1 / common.INCREMENTS}, 1.0"
    yield f"*BOUNDARY\nPUSHED, 1, 1, {common.SHIFT}"


LAST = """*NODE PRINT, NSET=PUSHED, TOTALS=ONLY, FREQUENCY=1000
RF
*NODE FILE, FREQUENCY=1000, OUTPUT=2D
U
*EL FILE, FREQUENCY=1000, OUTPUT=2D
S
*END STEP
"""


def run(deck):
    """Answers of ccx: fields at the nodes, total force on what is pushed, iterations."""
    with tempfile.TemporaryDirectory() as folder:
        job = Path(folder) / "job"
        job.with_suffix(".inp").write_text(deck)
        told = subprocess.run(["ccx", "-i", "job"], cwd=folder, capture_output=True, text=True)
        if told.returncode != 0 or "Job finished" not in told.stdout:
            raise SystemExit("ccx: " + " ".join(told.stdout.split()[-20:]))
        clock.end("solve")
        fields = job.with_suffix(".frd").read_bytes()
        total = job.with_suffix(".dat").read_text().split("PUSHED", 1)[1].splitlines()[2].split()
        steps = job.with_suffix(".cvg").read_text().splitlines()
    iterations = sum(re.match(r" +\d+ ", line) is not None for line in steps)
    version = re.findall(rb"Version ([\d.]+)", fields)[0].decode()
    return version, column(fields, "DISP")[:, :2], column(fields, "STRESS"), float(total[0]), iterations


def column(frd, name):
    """One field at all nodes: lines of ` -1`, a number in 10 characters and values in 12 each."""
    start = frd.index(b"\n -1", frd.index(f" -4  {name}".encode())) + 1
    end = frd.index(b"\n -3", start) + 1
    width = frd.index(b"\n", start) + 1 - start
    lines = np.frombuffer(frd[start:end], np.uint8).reshape(-1, width)
    return np.ascontiguousarray(lines[:, 13:-1]).view("S12").astype(float)


def main(problem, folder, out):
    """The command."""
    layers = meshes.read(folder)
    clock.end("read")
    points, at = common.sides(layers)
    cells = np.vstack([layers[0][1], layers[1][1] + len(layers[0][0])])
    behaviour, steps = ("TIED", elastic) if problem == "elastic" else ("LINEAR", friction)
    deck = "\n".join([*model(layers, points, cells, at, behaviour), *steps(points, at), LAST])
    clock.end("assemble")
    version, u, stress, shear, iterations = run(deck)
    three = np.pad(points, ((0, 0), (0, 1)))
    meshio.Mesh(three, [("quad", cells)], {"displacement": np.pad(u, ((0, 0), (0, 1))), "stress": stress}).write(out)
    clock.end("write")
    if problem == "elastic":
        x, _, jump = common.jump_operator(layers, lambda node, direction: 2 * np.asarray(node) + direction)
        answers = common.bent(points, at["upper.right"], u[:, 1], x, jump @ u.ravel())
    else:
        answers = {"shear": shear, "factorisations": iterations, "increments": common.INCREMENTS}
    clock.tell(peer=f"CalculiX {version} + SPOOLES", dofs=u.size, **answers)


if __name__ == "__main__":
    main(*sys.argv[1:4])
