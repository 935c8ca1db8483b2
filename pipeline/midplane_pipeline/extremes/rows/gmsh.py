"""Rows on gmsh: a mesher that fails, and what its options make."""

import json
import stat
from typing import Any

import numpy as np

from ..layers import FIX, KN, YOUNG, P, good, lame_rings, off, ring_under_pressure
from ..msh import arc, even, rectangle
from ..row import Trial, first_line, row
from ..scenes import elastic, relative, scene

GEO = """\
DefineConstant[ n = {{{n}, Name "edges"}} ];
Point(1) = {{0, {y}, {z}}}; Point(2) = {{1, {y}, {z}}}; Point(3) = {{1, {top}, {z}}}; Point(4) = {{0, {top}, {z}}};
Line(1) = {{1, 2}}; Line(2) = {{2, 3}}; Line(3) = {{3, 4}}; Line(4) = {{4, 1}};
Curve Loop(1) = {{1, 2, 3, 4}}; Plane Surface(1) = {{1}};
Transfinite Curve {{1, 3}} = n + 1; Transfinite Curve {{2, 4}} = 3;
Physical Curve("bottom") = {{1}}; Physical Curve("right") = {{2}}; Physical Curve("top") = {{3}}; Physical Curve("left") = {{4}};
Physical Surface("body") = {{1}};
{more}
"""


def drawn(place: Any, a_more: str = "", b_more: str = "", b_z: float = 0) -> Any:
    """The good scene on two geometries, in a folder."""
    text, _ = good()
    place.mkdir(parents=True, exist_ok=True)
    for body, y, n, more, z in (("a", -0.5, 3, a_more, 0), ("b", 0, 5, b_more, b_z)):
        (place / f"{body}.geo").write_text(GEO.format(y=y, top=y + 0.5, n=n, more=more, z=z))
        text["subdomains"][body] = {"geo": f"{body}.geo", "material": body}
    (place / "scene.json").write_text(json.dumps(text))
    return place


@row(
    "B36",
    "gmsh missing, failing, hanging, killed; paths with spaces, quotes and a newline",
    "message with gmsh's exit code and last lines; a time limit; no shell reads a path",
)
def mesher(t: Trial) -> None:
    def call(place: Any, *more: Any) -> Any:
        return t.program.call(place, ["run", ".", "-o", "out", *more])

    base = call(drawn(t.program.place()))
    t.below("gmsh as it is: traction", off(base.need()), 1e-10)
    run = call(drawn(t.program.place()), "--gmsh", "/nowhere/gmsh")
    t.refused("missing", run, "gmsh", code=4)
    run = call(drawn(t.program.place(), b_more="Curv Loop(2) = {1};"))
    t.refused("a geometry that gmsh refuses", run, "b.geo", "gmsh ended with exit code 1", "yntax error")

    def fake(place: Any, script: Any) -> str:
        path = place / "fake"
        path.write_text(f"#!/bin/sh\ncase $1 in --version) echo 4.8.4 >&2; exit;; esac\n{script}\n")
        path.chmod(path.stat().st_mode | stat.S_IXUSR)
        return str(path)

    fakes: list[tuple[str, str, int | None, list[str]]] = [
        ("ends with code 7", "echo no licence >&2; exit 7", 2, ["exit code 7", "no licence"]),
        ("writes nothing", "exit 0", None, []),
        ("hangs", "exec sleep 50", 4, ["2 s"]),
        ("is killed", "kill -9 $$", 4, ["signal"]),
    ]
    for what, script, code, texts in fakes:
        place = drawn(t.program.place())
        run = call(place, "--gmsh", fake(place, script), "--gmsh-limit", "2")
        if code is None:
            t.holds(what, run.code in (2, 4), f"exit {run.code}: {first_line(run.message)}", "refused")
        else:
            t.refused(what, run, *texts, code=code)
        t.holds(f"{what}: at once", run.seconds < 10, f"{run.seconds:.1f} s", "< 10 s")
    for name in (
        "a folder",
        "quote\"s 'and'",
        "line\nbreak",
        "$(touch owned)",
        "-o",
        "ü‐ñ",
        "semi;colon && rm x",
    ):
        place = drawn(t.program.place() / name)
        run = call(place)
        t.below(f"folder {name!r}: traction", off(run.need()), 1e-10)
        t.holds(f"folder {name!r}: nothing was executed", not list(place.rglob("owned")))


@row(
    "B37",
    "mesh out of the plane; curved mid-nodes; mixed and recombined cells",
    "z refused; the others exact",
)
def gmsh_options(t: Trial) -> None:
    def call(place: Any) -> Any:
        return t.program.call(place, ["run", ".", "-o", "out"])

    t.refused("z = 0.1", call(drawn(t.program.place(), b_z=0.1)), "z")
    text, meshes = good()
    meshes["b"].z = 1e-20
    t.below("z = 1e-20: traction", off(t.program.run(text, meshes).need()), 1e-10)
    for what, more in {
        "unstructured triangles": "",
        "recombined": "Recombine Surface {1};",
        "recombined, mixed": "Mesh.RecombinationAlgorithm = 0; Recombine Surface {1};",
        "order 2": "Mesh.ElementOrder = 2;",
        "order 2, incomplete": "Recombine Surface {1}; Mesh.ElementOrder = 2; Mesh.SecondOrderIncomplete = 1;",
        "transfinite": "Transfinite Surface {1}; Recombine Surface {1};",
    }.items():
        run = call(drawn(t.program.place(), more, more)).need()
        t.below(f"{what}: traction", off(run), 1e-10)
    t.refused("order 3", call(drawn(t.program.place(), "Mesh.ElementOrder = 3;")), "a")
    # mid-nodes on a circle: pressed rings carry Lamé's stress, and a turn gives nothing
    to = arc(np.pi / 2, np.pi / 2)
    run = t.program.run(
        ring_under_pressure(),
        {
            "a": rectangle(even(0, 1, 12), even(1, 1.5, 4), "Q8", to),
            "b": rectangle(even(0, 1, 17), even(1.5, 2, 4), "Q8", to),
        },
    )
    t.below("curved Q8 rings: normal traction", relative(run.need().traction()[:, 0], [lame_rings()]), 1e-3)
    straight = scene(
        {"a": (YOUNG, 0.0), "b": (YOUNG, 0.0)},
        {"joint": ("a.top", "b.bottom", elastic(KN))},
        [{"fix": FIX, "load": {"b.top": {"pressure": P}}}],
    )
    shifted = rectangle(even(0, 1, 4), even(-0.5, 0, 2), "Q8")
    on = (shifted.points[:, 1] == 0) & (np.arange(len(shifted.points)) >= 15)
    shifted.points[on, 0] += 0.03 * np.where(np.arange(on.sum()) % 2 == 0, 1, -1)
    run = t.program.run(straight, {"a": shifted, "b": rectangle(even(0, 1, 7), even(0, 0.5, 2), "Q8")}).need()
    t.below("mid-nodes an eighth off the middle of straight edges: traction", off(run), 1e-3)
    t.note(
        "Mid-nodes off the middle of straight edges: shape functions are no polynomials along such an edge, so that the rule on "
        f"the segments is not exact. Shifted by an eighth of the edge, the traction of a uniform state is off by {off(run):.0e}."
    )
