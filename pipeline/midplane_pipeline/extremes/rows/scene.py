"""Rows on the scene file: groups, supports, free bodies, bad values."""

import json
from typing import Any

import numpy as np

from ..layers import FIX, KN, REMOVED, P, changed, good, off
from ..msh import Mesh
from ..row import Trial, row
from ..scenes import coulomb, cracking, elastic


@row(
    "B30",
    "groups: missing, doubled, unused, empty, one name in two dimensions, a curve in two groups",
    "errors name the groups; unused ones are a warning of `check`; what has one meaning is accepted",
)
def groups(t: Trial) -> None:
    t.refused(
        "no group of that name",
        t.program.run(*changed("interfaces/joint/side_b", "b.botom")),
        'no group "botom"',
        'Did you mean "bottom"?',
    )
    t.refused(
        "a point where a curve is needed",
        t.program.run(*changed("interfaces/joint/side_b", "b.sw")),
        "sw",
        "point",
    )
    text, meshes = good()
    t.warned("groups that nothing uses", t.program.run(text, meshes, command="check").need(), "W09")
    mesh = meshes["b"]

    def with_names(change: Any) -> str:
        """Mesh b with its physical names edited."""
        lines = mesh.text().split("\n")
        start, end = lines.index("$PhysicalNames"), lines.index("$EndPhysicalNames")
        names = change([line.split(" ", 2) for line in lines[start + 2 : end]])
        names = [" ".join(name) for name in names]
        return "\n".join([*lines[: start + 1], str(len(names)), *names, *lines[end:]])

    def renamed(old: Any, new: Any) -> Any:
        return lambda names: [[d, tag, f'"{new}"' if name == f'"{old}"' else name] for d, tag, name in names]

    run = t.program.run(text, {**meshes, "b": with_names(renamed("right", "bottom"))})
    t.refused("two curves of one name", run, "bottom")
    run = t.program.run(text, {**meshes, "b": with_names(renamed("body", "bottom"))})
    t.holds("a curve and a surface of one name", run.good, f"exit {run.code}", "a side is the curve")
    run = t.program.run(text, {**meshes, "b": with_names(lambda names: [n for n in names if n[2] != '"bottom"'])})
    t.refused("the name is missing", run, "bottom")
    run = t.program.run(text, {**meshes, "b": with_names(lambda names: [*names, ["1", "77", '"ghost"']])})
    t.holds(
        "an empty group that nothing uses",
        run.good or "ghost" in run.message,
        f"exit {run.code}",
        "accepted or named",
    )
    text["steps"][0]["load"] = {"b.ghost": {"pressure": P}}
    run = t.program.run(text, {**meshes, "b": with_names(lambda names: [*names, ["1", "77", '"ghost"']])})
    t.refused("a load on an empty group", run, "ghost")
    text, meshes = good()
    twice = Mesh(mesh.points, [*mesh.blocks, *((d, "second", k, n) for d, g, k, n in mesh.blocks if g == "bottom")])
    text["interfaces"]["joint"]["side_b"] = ["b.bottom", "b.second"]
    t.refused("a curve in two groups, both joined", t.program.run(text, {**meshes, "b": twice}), "joint")


@row(
    "B31",
    "unknown boundary; two conditions on one dof; a corner in two supports",
    "equal values are fine, different ones refused",
)
def conditions(t: Trial) -> None:
    t.refused("unknown group", t.program.run(*changed("steps/0/fix", {**FIX, "a.botom": ["y"]})), "botom")
    t.refused("unknown body", t.program.run(*changed("steps/0/fix", {**FIX, "c.bottom": ["y"]})), "c")
    run = t.program.run(*changed("steps/0/fix", {**FIX, "a.bottom": ["x", "y"]})).need()
    t.below("a corner fixed twice: traction", off(run), 1e-10)
    text, meshes = changed("steps/0/displace", {"a.left": {"x": 1e-3}})
    text["steps"][0]["fix"] = {"a.bottom": ["x", "y"], "b.left": ["x"]}
    t.refused("two values at one corner", t.program.run(text, meshes), "a.left", "a.bottom")
    text, meshes = changed("steps/0/displace", {"a.left": {"x": "0*y"}})
    del text["steps"][0]["fix"]["a.left"]
    text["steps"][0]["fix"]["a.bottom"] = ["x", "y"]
    t.below("the same value twice: traction", off(t.program.run(text, meshes).need()), 1e-10)


@row("B32", "a body that nothing holds", "named, with its free motion; nothing is solved")
def free(t: Trial) -> None:
    t.refused(
        "no support at all",
        t.program.run(*changed("steps/0/fix", {"a.bottom": ["y"]})),
        "can move freely",
        "translation",
    )
    for law, name in (
        (elastic(KN, 0.0), "K_T = 0"),
        (elastic(0.0, KN), "K_N = 0"),
        (elastic(0.0, 0.0), "K = 0"),
    ):
        text, meshes = changed("interfaces/joint/law", law)
        text["steps"][0]["fix"] = {"a.bottom": ["x", "y"]}
        t.refused(
            f"b held by the joint alone, {name}",
            t.program.run(text, meshes),
            "subdomain b",
            "can move freely",
        )
    text, meshes = good()
    del text["interfaces"]["joint"]
    text["steps"][0]["fix"] = {"a.bottom": ["x", "y"]}
    t.refused("b without a joint", t.program.run(text, meshes), "subdomain b", "can move freely")


@row(
    "B34",
    "NaN, inf, 1e400, wrong signs, wrong types, unknown and missing keys, no JSON",
    "refused before meshing, with the path of the key",
)
def bad_values(t: Trial) -> None:
    raw = json.dumps(good()[0])

    def text(what: str, old: Any, new: Any, *expected: Any) -> None:
        assert old in raw, old
        t.refused(what, t.program.run(raw.replace(old, new, 1), good()[1]), *expected)

    for bad in ("NaN", "Infinity", "1e400", "-1e400", "nul", '"ten"', "null", "[1]", "true"):
        text(f"young: {bad}", '"young": 10000.0', f'"young": {bad}', "scene.json")
    text("empty file", raw, "", "scene.json")
    text("{}", raw, "{}", "scene.json", "missing")
    text("half a file", raw, raw[: len(raw) // 2], "scene.json")
    text("unknown key", '"steps"', '"stepz"', "stepz")
    text("a key twice", '"plane": "strain"', '"plane": "strain", "plane": "stress"', "plane")
    refusals: list[Any] = [
        ("materials/a/young", -1.0, "materials.a.young"),
        ("materials/a/young", 0.0, "materials.a.young"),
        ("materials/a/poisson", 0.5, "materials.a.poisson"),
        ("materials/a/poisson", -1.0, "materials.a.poisson"),
        ("materials/a/poisson", 0.7, "materials.a.poisson"),
        ("thickness", 0.0, "thickness"),
        ("thickness", -1.0, "thickness"),
        ("interfaces/joint/law/normal_stiffness", -1.0, "interfaces.joint.law", "normal_stiffness"),
        (
            "interfaces/joint/law",
            cracking(fracture_energy_i=0.0),
            "interfaces.joint.law",
            "fracture_energy_i",
        ),
        ("interfaces/joint/law", cracking(tensile_strength=-3.0), "tensile_strength"),
        ("interfaces/joint/law", coulomb(1e6, 1e6, -0.1), "friction_coefficient"),
        ("interfaces/joint/law", {"type": "glue"}, "glue"),
        ("interfaces/joint/law", REMOVED, "law"),
        ("interfaces/joint/coupling", "nodal", "nodal"),
        ("steps/0/increments", 0, "increments"),
        ("steps/0/increments", -1, "increments"),
        ("steps/0/increments", 1.5, "increments"),
        ("steps", [], "steps"),
        ("steps/0/load", {"b.top": {"pressure": "1/0"}}, "steps.0.load.b.top"),
        ("steps/0/load", {"b.top": {"pressure": "sqrt(-1-x)"}}, "steps.0.load.b.top"),
        ("steps/0/load", {"b.top": {"pressure": "2*("}}, "steps.0.load.b.top"),
        ("steps/0/load", {"b.top": {"pressure": 1.0, "traction": [0, 1]}}, "steps.0.load.b.top"),
        ("subdomains/a/msh", "nowhere.msh", "nowhere.msh"),
        ("subdomains", {}, "subdomain"),
        ("plane", "oblique", "oblique"),
    ]
    for path, value, *expected in refusals:
        shown = "removed" if value is REMOVED else json.dumps(value)[:40]
        t.refused(f"{path}: {shown}", t.program.run(*changed(path, value)), *expected)
    run = t.program.run(*good(), "--set", "materials.a.young=NaN")
    t.refused("--set materials.a.young=NaN", run, "young")


@row("B41", '`"plane": "axisymmetric"`', "refused, with strain and stress as what there is")
def axisymmetric(t: Trial) -> None:
    t.refused("axisymmetric", t.program.run(*changed("plane", "axisymmetric")), "axisymmetric", "strain", "stress")


@row(
    "B44",
    "loads, moduli, stiffnesses and thicknesses near the ends of the range of numbers, 1e±300 and beyond",
    "answered as exactly as any other, or refused with the reason; never a number that is none",
)
def ends_of_the_range(t: Trial) -> None:
    for path, values in {
        "steps/0/load/b.top/pressure": (1e-320, 1e-300, 1e150, 1e300, 1.7e308),
        "materials/a/young": (1e-300, 1e-150, 1e150, 1e300, 1.7e308),
        "interfaces/joint/law/normal_stiffness": (5e-324, 1e-300, 1e-150),
        "thickness": (1e-300, 1e-150, 1e150, 1e300),
    }.items():
        for value in values:
            run = t.program.run(*changed(path, value))
            what = f"{path.rsplit('/', 1)[-1]} = {value:g}"
            if run.good:
                p = value if path.endswith("pressure") else P
                digits = max(1e-10, 5e-324 / p)  # below 1e-308 numbers have fewer
                t.below(f"{what}: traction", np.abs(run.traction()[:, 0] / -p - 1).max(), digits)
            else:
                t.refused(what, run, code=run.code)
