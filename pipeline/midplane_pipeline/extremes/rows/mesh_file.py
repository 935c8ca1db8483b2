"""Rows on damaged mesh files."""

import os
from typing import Any

import numpy as np

from ..layers import good, off
from ..msh import Mesh, even, rectangle
from ..row import Trial, row


@row(
    "B35",
    "damaged meshes: cut, MSH 2.2, wrong counts, dangling and repeated tags, 2^63, NaN, zero area, …",
    "refused; memory below twice the file and a constant",
)
def damaged(t: Trial) -> None:
    text, meshes = good()
    whole = meshes["b"].text()
    lines = whole.split("\n")
    base = t.program.run(text, meshes).need()
    t.below("the undamaged mesh: traction", off(base), 1e-10)

    def swap(old: Any, new: Any, count: int = 1) -> str:
        assert old in whole, old
        return whole.replace(old, new, count)

    node = lines[lines.index("$Nodes") + 1]
    element = lines[lines.index("$Elements") + 1]
    entities = lines[lines.index("$Entities") + 1]
    # of the block of quadrilaterals: its head, and its first element
    quads = next(i for i, line in enumerate(lines) if line.startswith("2 1 3 "))
    head, first = lines[quads], lines[quads + 1]
    # the first coordinates of the block of nodes
    at = next(i for i, line in enumerate(lines) if line.startswith("2 1 0 "))
    n = int(lines[at].split()[3])
    place = lines[at + 1 + n]
    tags = first.split()
    damages = {
        **{f"cut after {part:.0%}": whole[: int(len(whole) * part)] for part in np.arange(0.02, 0.99, 0.12 if t.quick else 0.04)},
        "empty": "",
        "not a mesh": "solid cube\n" * 50,
        "random bytes": np.random.default_rng(1).bytes(4000),
        "MSH 2.2": swap("4.1 0 8", "2.2 0 8"),
        "said to be binary": swap("4.1 0 8", "4.1 1 8"),
        "data size 4": swap("4.1 0 8", "4.1 0 4"),
        "more nodes than there are": swap(node, node.replace(str(n), str(n + 7))),
        "2^63 nodes": swap(node, f"1 {2**63} 1 {2**63}"),
        "2^63 nodes in a block": swap(lines[at], f"2 1 0 {2**63}"),
        "2^40 elements": swap(element, f"{element.split()[0]} {2**40} 1 {2**40}"),
        "2^40 elements in a block": swap(head, f"2 1 3 {2**40}"),
        "-1 elements in a block": swap(head, "2 1 3 -1"),
        "2^62 entities": swap(entities, f"{2**62} 4 1 0"),
        "a node that is not there": swap(first, " ".join([*tags[:-1], "9999"])),
        "a node twice in a cell": swap(first, " ".join([*tags[:-1], tags[1]])),
        "a tag of a node twice": swap(f"\n{n - 1}\n{n}\n", f"\n{n}\n{n}\n"),
        "element of another type": swap(head, head.replace("2 1 3 ", "2 1 36 ")),
        "a coordinate NaN": swap(place, "nan 0.0 0.0"),
        "a coordinate inf": swap(place, "inf 0.0 0.0"),
        "a coordinate 1e400": swap(place, "1e400 0.0 0.0"),
        "a word for a coordinate": swap(place, "north 0.0 0.0"),
        "no elements": whole[: whole.index("$Elements")],
        "no nodes": whole[: whole.index("$Nodes")] + whole[whole.index("$Elements") :],
    }
    cells = next(block for block in meshes["b"].blocks if block[0] == 2)[3]
    flat = meshes["b"].points.copy()
    flat[cells[0][3]] = flat[cells[0][0]]
    flat[cells[0][2]] = flat[cells[0][1]]
    damages["a cell of no area"] = Mesh(flat, meshes["b"].blocks).text()
    for what, mesh in damages.items():
        run = t.program.run(text, {**meshes, "b": mesh})
        t.refused(what, run, "b.msh")
    # what the program takes for the undamaged mesh, and twice the file
    size, (_, usual) = len(whole), measured(t, text, meshes)
    for what in ("2^63 nodes", "2^63 nodes in a block", "2^40 elements", "2^40 elements in a block"):
        _, memory = measured(t, text, {**meshes, "b": damages[what]})
        t.below(f"{what}: memory [bytes]", memory, usual + 2 * size + 4e6)
    curved = rectangle(even(0, 1, 5), even(0, 0.5, 2), "Q8")
    inner = next(block for block in curved.blocks if block[0] == 2)[3][0]
    curved.points[inner[4]] = curved.points[inner[2]] + [0.5, 0.5]
    quadratic = rectangle(even(0, 1, 3), even(-0.5, 0, 2), "Q8")
    t.refused("a mid-node far off its edge", t.program.run(text, {"a": quadratic, "b": curved}), "b.msh")


def measured(t: Trial, text: Any, meshes: Any) -> tuple[Any, Any]:
    """A run and the memory it took, from the system."""
    place = t.program.write(text, meshes)
    pid = os.fork()
    if pid == 0:
        null = os.open(os.devnull, os.O_WRONLY)
        os.dup2(null, 1)
        os.dup2(null, 2)
        os.chdir(place)
        os.execv(t.program.path, [t.program.path, "run", ".", "-o", "out"])
    _, status, usage = os.wait4(pid, 0)
    return status, usage.ru_maxrss * 1024
