"""What `make trade` measures besides the fronts: the penalty, studies against single runs, what a feature costs."""

import json
import math
import os
import resource
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path

import numpy as np

from trade_machine import mesher
from trade_scenes import STRIP, mesh

ROOT = Path(__file__).resolve().parent.parent
sys.path.append(str(ROOT / "benches"))
from scenes import SPRINGS, folder as box, kept_below  # noqa: E402


def exponential(a):
    """exp(a) of a small matrix."""
    scale = max(0, math.ceil(math.log2(max(1e-300, np.linalg.norm(a)))) + 4)
    a = a / 2**scale
    term, total = np.eye(len(a)), np.eye(len(a))
    for k in range(1, 20):
        term = term @ a / k
        total = total + term
    for _ in range(scale):
        total = total @ total
    return total


def strip(kn, kt):
    """Tractions (normal, shear) of the strip: amplitudes over cos πx and sin πx, by matrix exponentials."""
    k, p0 = math.pi, 5.0
    young, nu, heights = (1e4, 4e3), (0.2, 0.3), (0.8, 0.6)
    lame = [(e * n / ((1 + n) * (1 - 2 * n)), e / (2 * (1 + n))) for e, n in zip(young, nu)]

    def through(layer):
        l, m = lame[layer]
        c = l + 2 * m
        rows = [
            [0, 0, 1, 0],
            [0, 0, 0, 1],
            [c * k * k / m, 0, 0, k * (l + m) / m],
            [0, m * k * k / c, -k * (l + m) / c, 0],
        ]
        return exponential(np.array(rows) * heights[layer])

    def traction(layer, z):
        l, m = lame[layer]
        return np.array([m * (z[2] - k * z[1]), (l + 2 * m) * z[3] + l * k * z[0]])

    lower, upper = through(0), through(1)
    (l, m), columns = lame[1], []
    for i in (2, 3):
        below = lower[:, i]
        t = traction(0, below)
        p, q = below[0] + t[0] / kt, below[1] + t[1] / kn
        above = np.array([p, q, t[0] / m + k * q, (t[1] - l * k * p) / (l + 2 * m)])
        columns.append((t, traction(1, upper @ above)))
    slopes = np.linalg.solve(np.column_stack([top for _, top in columns]), [0.0, -p0])
    shear, normal = sum(slope * t for slope, (t, _) in zip(slopes, columns))
    return normal, shear


def study(program, folder, content, *options):
    """Runs a study and returns its study.json."""
    folder.mkdir(parents=True, exist_ok=True)
    (folder / "study.json").write_text(json.dumps(content, indent=1))
    subprocess.run([program, "study", folder / "study.json", "-o", folder / "out", "-q", *options], check=True)
    return json.loads((folder / "out" / "study.json").read_text())


def penalty(program, out, form):
    """The strip at stiffnesses from soft to rigid, both couplings, on meshes that nearly match and that do not."""
    rows = []
    edges = {"16:24": (16, 24), "16:17": (16, 17)}
    elements = ("T3", "Q8") if form != "reduced" else ("T3",)
    for power in range(-1, 7) if form != "reduced" else (0, 2, 4):
        k = 10.0**power * 1e4 / 0.8
        normal, shear = strip(k, k)
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
        for (element, name, coupling), point in zip(
            labels, study(program, folder, content, "--threads", "1", "--gmsh", mesher(out))["points"]
        ):
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


def spent(command):
    """Processor time of a command [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=False, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def refinements(program, out):
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


def features(program, out, repeat=5):
    """Time and memory of the shear box with every feature switched on: runs take turns, the processor's time counts."""
    here = box(program, "10k", out / "features")
    scene = json.loads((here / "cracking.json").read_text())
    cracking = scene["interfaces"]["joint"]["law"]
    coulomb = SPRINGS | {"type": "coulomb", "friction_coefficient": 0.8785}
    high, low = scene["steps"], kept_below(scene["steps"])
    history = scene["output"]["history"]
    few = dict(list(history.items())[:1])

    def variant(law, steps=low, fields="last", columns=few):
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
    seconds, summaries = {name: [] for name in variants}, {}
    for _ in range(repeat):
        for name, file in files.items():
            seconds[name].append(spent([program, "run", "-q", file, "-o", here / "out", "--threads", "1"]))
            summaries[name] = json.loads((here / "out" / "summary.json").read_text())
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
