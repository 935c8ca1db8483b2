"""The scenes of `make trade`: what is measured, how refinements and elements are set, which knobs are swept.

Every scene has two sides, A and B, with counts per side that scale with its refinement; a refinement of 1 is the scene as its
files have it. `ratio` is edges of A over edges of B; where it changes, their product stays. Sides never match: B then has an edge more.
"""

import math
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

Settings = dict[str, Any]  # values by key

ELEMENTS = {"T3": (1, 1), "Q4": (1, 0), "T6": (2, 1), "Q8": (2, 0)}
RATIOS = {"own": None, "1:1": 1.0, "2:3": 2 / 3, "1:4": 0.25, "1:10": 0.1}


@dataclass
class Scene:
    """A scene of the campaign."""

    name: str
    folder: str
    case: str
    joint: str
    sides: tuple[str, str]  # names of the subdomains A and B
    counts: tuple[dict[str, int], dict[str, int]]  # per side: parameter -> value in its .geo
    measures: dict[str, dict[str, Any]]
    errors: tuple[str, ...]  # the measures that decide: the largest of their errors is the error of a run
    refinements: tuple[float, ...]  # levels, 1 is that of the scene's own files
    settings: Settings = field(default_factory=dict)
    knobs: dict[str, dict[str, Settings]] = field(default_factory=dict)  # further knobs: name -> {label: settings}
    floor: float = 0.0  # what the reference is uncertain by, relative
    nonlinear: bool = False
    steps: tuple[tuple[str, int], ...] = ()  # (key, increments in the scene's file) of the steps that have several
    without: tuple[tuple[str, str], ...] = ()  # (knob, label) that would take hours; the initial tangent then neither
    even: tuple[str, ...] = ()  # parameters that must be even
    swept: tuple[str, ...] = ()  # of a scene whose runs are long: the knobs that are swept, each point once; all if empty
    usual: dict[str, str] = field(default_factory=dict)  # labels of its reference setting that are its own
    plotted: tuple[tuple[str, str, str], ...] = ()  # curves: (title, x column, y column) of the history


def rounded(value: float, even: bool) -> int:
    """A count of at least one, or an even one."""
    step = 2 if even else 1
    return max(step, step * round(value / step))


def mesh(scene: Scene, refinement: float = 1.0, ratio: str = "own", element: str = "Q8") -> Settings:
    """Settings of a mesh."""
    order, triangles = ELEMENTS[element]
    own = scene.counts[0]["edges"] / scene.counts[1]["edges"]
    wanted = RATIOS[ratio]
    factor = 1.0 if wanted is None else math.sqrt(wanted / own)
    settings: Settings = {}
    for side, counts, of_side in zip(scene.sides, scene.counts, (factor, 1 / factor), strict=True):
        for name, count in counts.items():
            value = rounded(count * refinement * of_side, f"{side}.{name}" in scene.even)
            settings[f"subdomains.{side}.parameters.{name}"] = value
        settings[f"subdomains.{side}.parameters.order"] = order
        settings[f"subdomains.{side}.parameters.triangles"] = triangles
    # sides that happen to match would flatter every method
    a, b = (f"subdomains.{side}.parameters.edges" for side in scene.sides)
    if settings[a] == settings[b]:
        settings[b] += 2 if f"{scene.sides[1]}.edges" in scene.even else 1
    return settings


def coupling(scene: Scene, kind: str, quadrature: str = "gauss") -> Settings:
    """Settings of a coupling."""
    return {f"interfaces.{scene.joint}.coupling": kind, f"interfaces.{scene.joint}.quadrature": quadrature}


def knobs(scene: Scene) -> dict[str, dict[str, Any]]:
    """All knobs of a scene: name -> {label: settings}; the first label of each is the reference setting."""
    coarse_to_fine = {f"{d:g}": d for d in scene.refinements}
    table: dict[str, dict[str, Any]] = {
        "refinement": coarse_to_fine,
        "element": {name: name for name in ELEMENTS},
        "ratio": {name: name for name in RATIOS},
        "coupling": {
            "projected": coupling(scene, "projected"),
            "pointwise": coupling(scene, "pointwise"),
            "projected, lobatto": coupling(scene, "projected", "lobatto"),
            "pointwise, lobatto": coupling(scene, "pointwise", "lobatto"),
        },
        "output": {
            "last": {"output.fields": "last"},
            "none": {"output.fields": "none"},
            "every": {"output.fields": "every"},
        },
        "strategy": {
            "auto": {"solution.strategy": "auto"},
            "condensed": {"solution.strategy": "condensed"},
            "plain": {"solution.strategy": "plain"},
        },
    }
    for name, label in scene.without:
        del table[name][label]
    if scene.nonlinear:
        table["tolerance"] = {t: {"solution.tolerance": float(t)} for t in ("1e-8", "1e-3", "1e-4", "1e-6", "1e-10", "1e-12")}
        factors = {"1": 1, "0.125": 0.125, "0.25": 0.25, "0.5": 0.5, "2": 2, "4": 4}

        def increments(factor: float) -> Settings:
            return {key: max(1, math.ceil(n * factor)) for key, n in scene.steps}

        table["path_tolerance"] = {t: {"solution.path_tolerance": float(t)} for t in ("1e-3", "1e-1", "1e-2", "1e-4")}
        table["increments"] = {label: increments(factor) for label, factor in factors.items()}
        if not scene.without:
            table["tangent"] = {name: {"solution.tangent": name} for name in ("consistent", "initial")}
    return table | scene.knobs


def reference(scene: Scene) -> dict[str, str]:
    """The label of every knob at the reference setting."""
    usual = REFERENCE | scene.usual
    return {name: usual.get(name, next(iter(values))) for name, values in knobs(scene).items()}


REFERENCE = {"refinement": "1", "element": "Q8", "ratio": "own"}


def settings(scene: Scene, labels: Mapping[str, str]) -> Settings:
    """The settings of labels {knob: label}; knobs that are not named are at their reference."""
    table = knobs(scene)
    chosen = reference(scene) | dict(labels)
    result = dict(scene.settings)
    result |= mesh(scene, table["refinement"][chosen["refinement"]], chosen["ratio"], chosen["element"])
    for name, label in chosen.items():
        if name not in REFERENCE:
            result |= table[name][label]
    return result


def last(of: str, reference: float) -> dict[str, Any]:
    """A measure: the last value, beside a reference."""
    return {"take": "last", "of": of, "reference": reference}


def traction(normal: Any, tangential: Any) -> dict[str, Any]:
    """The L2 error of the tractions of the joint."""
    return {"take": "error", "field": "traction", "of": "joint", "exact": [normal, tangential]}


STRIP = Scene(
    name="strip",
    folder="geo/strip",
    case="smooth: two layers under a harmonic pressure",
    joint="joint",
    sides=("lower", "upper"),
    counts=({"edges": 8, "rows": 6}, {"edges": 12, "rows": 7}),
    refinements=(0.25, 0.5, 1, 2, 4, 8),
    measures={
        "crest": last("crest", -0.000713658366),
        "energy": last("stored", 0.0008920729575),
        "traction": traction("-2.406874455*cos(pi*x)", "1.170396232*sin(pi*x)"),
    },
    errors=("crest", "energy", "traction"),
    floor=5e-10,
)

COOK = Scene(
    name="cook",
    folder="geo/cook",
    case="corner: Cook's membrane with a cut",
    joint="cut",
    sides=("left", "right"),
    counts=({"edges": 24, "rows": 12}, {"edges": 40, "rows": 20}),
    refinements=(0.0625, 0.125, 0.25, 0.5, 1, 2, 4),
    measures={"tip": last("tip", 27.588303311771824), "energy": last("stored", 13.830648685)},
    errors=("tip", "energy"),
    floor=1e-6,
    even=("right.edges",),
)

RING = Scene(
    name="ring",
    folder="geo/ring",
    case="curved: two rings under pressure",
    joint="joint",
    sides=("inner", "outer"),
    counts=({"edges": 6, "rows": 2}, {"edges": 9, "rows": 2}),
    refinements=(0.25, 0.5, 1, 2, 4, 8),
    measures={
        "widening": last("inner.bore.displacement_x", 0.0007871783296),
        "energy": last("energy.stored", 0.5 * 10.0 * 0.0007871783296 * math.pi / 2),
        "traction": traction(-1.083521445, 0),
    },
    errors=("widening", "energy", "traction"),
    floor=1e-9,
)

FRICTION = Scene(
    name="friction",
    folder="geo/friction_block",
    case="friction: partial slip below a pushed block",
    joint="joint",
    sides=("base", "block"),
    counts=({"edges": 40, "rows": 10}, {"edges": 31, "rows": 8}),
    refinements=(0.0625, 0.125, 0.25, 0.5, 1, 2, 4),
    # bodies so stiff that they deviate from rigid ones by 1e-6; a push of 1.6 MN
    settings={
        "materials.stiff.young": 4.0e8,
        "/steps/1/load/block.left/traction": [3.2, 0.0],
        "output.fields": "last",
    },
    measures={
        "slide": last("slide", 0.0008101020514),
        "traction": traction("-1.4-0.6*x", "min(0.8101020514,0.7+0.3*x)"),
    },
    errors=("slide", "traction"),
    floor=2e-6,
    nonlinear=True,
    steps=(("/steps/1/increments", 18),),
    plotted=(("push against slide", "slide", "push"),),
)

DCB = Scene(
    name="dcb",
    folder="geo/dcb",
    case="cohesive peak load: double cantilever beam",
    joint="joint",
    sides=("lower", "upper"),
    counts=({"edges": 210, "free": 30, "rows": 1}, {"edges": 140, "free": 30, "rows": 1}),
    refinements=(0.125, 0.25, 0.5, 1),
    # to just beyond the peak
    settings={
        "output.fields": "last",
        "/steps/0/displace/upper.load/y": 3.4e-3,
        "/steps/0/increments": 34,
    },
    measures={
        "peak": {"take": "peak", "of": "reaction:upper.load:y", "reference": 0.002243647156},
        "opening": {
            "take": "at_peak",
            "of": "opening",
            "peak_of": "reaction:upper.load:y",
            "reference": 0.002922298141,
        },
    },
    # the load; its place is that of a flat peak, on which a per mille of the load is per cents of the opening
    errors=("peak",),
    # a half model of Q8, converged over three meshes
    floor=1e-5,
    nonlinear=True,
    without=(("strategy", "plain"),),
    steps=(("/steps/0/increments", 34),),
    knobs={
        "law_tolerance": {t: {"interfaces.joint.law_tolerance": float(t)} for t in ("1e-4", "1e-2", "1e-3", "1e-6")},
    },
    plotted=(("load against opening", "opening", "reaction:upper.load:y"),),
)

LIMIT = Scene(
    name="limit",
    folder="geo/dcb",
    case="limit load: double cantilever beam under a load that grows",
    joint="joint",
    sides=("lower", "upper"),
    counts=({"edges": 210, "free": 30, "rows": 1}, {"edges": 140, "free": 30, "rows": 1}),
    refinements=(0.125, 0.25, 0.5, 1),
    usual={"refinement": "0.5"},
    settings={
        "output.fields": "none",
        "/steps/0": {
            "name": "load",
            "increments": 34,
            "fix": {"lower.load": ["x", "y"], "upper.load": ["x"]},
            "load": {"upper.load": {"force": [0.0, 2.6e-3]}},
        },
    },
    measures={"limit": {"take": "reached", "reference": 0.002243647156 / 2.6e-3}},
    errors=("limit",),
    floor=1e-5,
    nonlinear=True,
    without=(("strategy", "plain"),),
    steps=(("/steps/0/increments", 34),),
    swept=("refinement", "element", "path_tolerance", "increments"),
)

SCENES = {scene.name: scene for scene in (STRIP, COOK, DCB, LIMIT, FRICTION, RING)}
