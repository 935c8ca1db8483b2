"""Measurements of `make trade` besides the fronts: the penalty, studies against single runs, the cost of features."""

import json
import os
import resource
import shutil
import statistics
import subprocess
import time
from pathlib import Path
from typing import Any

from midplane.stored import Stored

from midplane_pipeline.bench.scenes import SPRINGS, kept_below
from midplane_pipeline.bench.scenes import folder as box
from midplane_pipeline.extremes.solutions import Strip
from midplane_pipeline.places import ROOT

from .machine import mesher
from .scenes import STRIP, mesh


def study(program: Path, folder: Path, content: dict[str, Any], *options: str | Path) -> dict[str, Any]:
    """Runs a study and returns its study.json."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "study.json").write_text(json.dumps(content, indent=1))
    subprocess.run([program, "study", folder / "study.json", "-o", folder / "out", "-q", *options], check=True)
    return json.loads((folder / "out" / "study.json").read_text())


def penalty(program: Path, out: Path, form: str) -> list[dict[str, Any]]:
    """The strip at stiffnesses from soft to rigid, both couplings, on meshes that nearly match and that do not."""
    rows = []
    edges = {"16:24": (16, 24), "16:17": (16, 17)}
    elements = ("T3", "Q8") if form != "reduced" else ("T3",)
    for power in range(-1, 7) if form != "reduced" else (0, 2, 4):
        k = 10.0**power * 1e4 / 0.8
        found = Strip(kn=k, kt=k).solve()
        normal, shear = found["normal"], found["shear"]
        values, labels = [], []
        for element in elements:
            for name, (a, b) in edges.items():
                for coupling in ("projected", "pointwise"):
                    setting = mesh(STRIP, 1, "own", element)
                    for side, n, height in (("lower", a, 0.8), ("upper", b, 0.6)):
                        setting[f"subdomains.{side}.parameters.edges"] = n
                        setting[f"subdomains.{side}.parameters.rows"] = round(height * n)
                    setting["interfaces.joint.coupling"] = coupling
                    labels.append((element, name, coupling))
                    values.append(setting)
        stiffness = {f"interfaces.joint.law.{c}_stiffness": k for c in ("normal", "tangential")}
        exact = [f"({normal:.16e})*cos(pi*x)", f"({shear:.16e})*sin(pi*x)"]
        folder = out / "penalty" / f"1e{power}"
        content = {
            "scene": os.path.relpath(ROOT / "geo/strip/scene.json", folder),
            "set": stiffness,
            "axes": {"setting": {"values": values}},
            "measures": {"traction": {"take": "error", "field": "traction", "of": "joint", "exact": exact}},
            "process": "own",
            "repeat": 3,
        }
        for (element, name, coupling), point in zip(labels, study(program, folder, content, "--threads", "1", "--gmsh", mesher(out))["points"], strict=True):
            times = point["processor"]
            rows.append(
                {
                    "stiffness": 10.0**power,
                    "stiffness_number": point["counts"].get("stiffness_number"),
                    "element": element,
                    "edges": name,
                    "coupling": coupling,
                    "error": point["errors"]["traction"],
                    "time": min(times),
                    "spread": (max(times) - min(times)) / statistics.median(times),
                }
            )
    return rows


def spent(command: list[Any]) -> float:
    """Processor time of a command [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def refinements(program: Path, out: Path) -> dict[str, Any]:
    """The 6 x 6 study of the strip against 36 runs of its points, all meshed afresh, in one go."""
    folder = out / "refinements"
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    file = ROOT / "geo/strip/study.json"
    start, before = time.monotonic(), os.getloadavg()
    processor = [spent([program, "study", file, "-o", folder / "study", "-q"]), 0.0]
    shared = time.monotonic() - start
    points = json.loads((folder / "study" / "study.json").read_text())["points"]
    seconds = {}
    for kind in ("meshed afresh", "meshes there"):
        start = time.monotonic()
        for point in points:
            sets = [f"--set={s}" for s in point["settings"] if "study:" not in s]
            where = folder / f"run{point['point']}"
            used = spent([program, "run", "-q", ROOT / "geo/strip", "-o", where, *sets])
            processor[1] += used if kind == "meshed afresh" else 0.0
        seconds[kind] = time.monotonic() - start
    return {
        "points": len(points),
        "study": shared,
        "runs": seconds["meshed afresh"],
        "runs_with_meshes": seconds["meshes there"],
        "processor": processor,
        "ratio": shared / seconds["meshed afresh"],
        "load": [before, os.getloadavg()],
    }


def features(program: Path, out: Path, repeat: int = 5) -> list[dict[str, Any]]:
    """Time and memory of the shear box with every feature switched on: runs take turns, the processor's time counts."""
    here = box(program, "10k", out / "features")
    scene = json.loads((here / "cracking.json").read_text())
    cracking = scene["interfaces"]["joint"]["law"]
    coulomb = SPRINGS | {"type": "coulomb", "friction_coefficient": 0.8785}
    high, low = scene["steps"], kept_below(scene["steps"])
    history = scene["output"]["history"]
    few = dict(list(history.items())[:1])

    def variant(law: dict[str, Any], steps: list[Any] = low, fields: str = "last", columns: dict[str, Any] = few) -> dict[str, Any]:
        joint = scene["interfaces"]["joint"] | {"law": law}
        output = {"fields": fields, "history": columns}
        return scene | {"interfaces": {"joint": joint}, "steps": steps, "output": output}

    variants = {
        "springs": variant(SPRINGS),
        "springs, all columns of the history": variant(SPRINGS, columns=history),
        "springs, fields of every increment": variant(SPRINGS, fields="every"),
        "friction that sticks": variant(coulomb),
        "cracking law that stays elastic": variant(cracking),
        "friction that slides": variant(coulomb, high),
        "cracking law that cracks": variant(cracking, high),
        "cracking law that cracks, fields of every increment": variant(cracking, high, "every"),
    }
    files = {name: here / f"{k}.json" for k, name in enumerate(variants)}
    for name, content in variants.items():
        files[name].write_text(json.dumps(content))
    seconds: dict[str, list[float]] = {name: [] for name in variants}
    summaries: dict[str, dict[str, Any]] = {}
    for _ in range(repeat):
        for name, file in files.items():
            seconds[name].append(spent([program, "run", "-q", file, "-o", here / "out", "--threads", "1"]))
            summaries[name] = Stored(here / "out").summary()
            if summaries[name]["solution"]["increments"] != 51:
                raise RuntimeError(f"{name}: the run has not come to its end")
    base = statistics.median(seconds["springs"])
    return [
        {
            "feature": name,
            "median": statistics.median(times),
            "min": min(times),
            "spread": (max(times) - min(times)) / statistics.median(times),
            "ratio": statistics.median(times) / base,
            "ratio_of_minima": min(times) / min(seconds["springs"]),
            "memory": summaries[name]["peak_memory_bytes"],
            "dofs": summaries[name]["sizes"]["dofs"],
            "iterations": summaries[name]["solution"]["iterations"],
            "increments": summaries[name]["solution"]["increments"],
        }
        for name, times in seconds.items()
    ]
