"""A front on moved nodes and turned axes, and the instructions of its points.

Every point of a front is run again with the nodes of both sides of its joint moved by seeded fractions of an edge, with the
whole scene turned, and under a counter of instructions. The first two give errors, which need no quiet machine; the third
gives a time that does not depend on one."""

import copy
import csv
import json
import os
import re
import subprocess
from collections.abc import Callable
from typing import Any

from midplane_pipeline.places import ROOT

from .front import label
from .history import read_history
from .move import Move, moved, offset, turn
from .scenes import settings
from .turn import Turn, taken

SEEDS = (1, 2, 3)


def put(scene: Any, key: str, value: Any) -> None:
    """Sets a value of a scene: a path with dots, or a JSON pointer."""
    names = key[1:].split("/") if key.startswith("/") else key.split(".")
    at = scene
    for name in names[:-1]:
        at = at[int(name)] if isinstance(at, list) else at.setdefault(name, {})
    at[names[-1]] = value


class Front:
    """The points of a front with meshes that can be moved."""

    def __init__(self, campaign: Any, rows: list[dict[str, Any]]) -> None:
        self.campaign, self.scene, self.rows = campaign, campaign.scene, rows
        self.here = campaign.out / "robust"
        self.settings = [settings(self.scene, row["labels"]) for row in rows]
        self.text = json.loads((ROOT / self.scene.folder / "scene.json").read_text())
        for k, values in enumerate(self.settings):
            folder = self.here / f"{k:02}"
            folder.mkdir(parents=True, exist_ok=True)
            sets = [f"--set={key}={value}" for key, value in values.items() if key.startswith("subdomains.")]
            mesh = [campaign.program, "mesh", ROOT / self.scene.folder, "-q", "-o", folder, *sets]
            subprocess.run(mesh, check=True)

    def moved(self, k: int, name: str, move: Callable[[str], Move]) -> dict[str, Any]:
        """The subdomains of a point with meshes moved by move(side) and written under a name."""
        subdomains = {}
        for side in self.scene.sides:
            (mesh,) = (self.here / f"{k:02}" / "mesh").glob(f"{side}-*.msh")
            file = self.here / f"{k:02}" / f"{side}_{name}.msh"
            file.write_bytes(moved(mesh.read_bytes(), move(side)))
            path = os.path.relpath(file, ROOT / self.scene.folder)
            subdomains[side] = {"msh": path, "material": self.text["subdomains"][side]["material"]}
        return {"subdomains": subdomains}

    def others(self, k: int) -> dict[str, Any]:
        """The settings of a point that are not those of its meshes."""
        return {key: v for key, v in self.settings[k].items() if not key.startswith("subdomains.")}

    def offsets(self) -> list[list[float | None]]:
        """The errors of every point with the nodes moved, one for every seed."""

        def of(k: int, seed: int) -> dict[str, Any]:
            edges = {side: self.settings[k][f"subdomains.{side}.parameters.edges"] for side in self.scene.sides}
            name = self.scene.name
            return self.moved(k, f"seed{seed}", lambda side: offset(name, edges[side], seed, side)) | self.others(k)

        points = [(row["labels"], of(k, seed)) for k, row in enumerate(self.rows) for seed in SEEDS]
        errors = [row["error"] for row in self.campaign.study("offsets", points, self.scene.measures)]
        return [errors[k : k + len(SEEDS)] for k in range(0, len(errors), len(SEEDS))]

    def turned(self) -> tuple[int, list[float | None]]:
        """The angle, and the error of every point of the scene turned by it."""
        scenes = []
        for k in range(len(self.rows)):
            scene = copy.deepcopy(self.text)
            for key, value in self.others(k).items():
                put(scene, key, value)
            scenes.append(scene)
        turned = Turn(self.text)
        exact = {name: measure for name, measure in self.scene.measures.items() if name in self.scene.errors}
        fields = {name: turned.measure(m) for name, m in exact.items() if m["take"] == "error"}
        scalars = {name: m for name, m in exact.items() if m["take"] != "error"}
        probe = {n: self.text["output"]["history"].get(m["of"], m["of"]) for n, m in scalars.items()}
        columns = {c: c for name in scalars for c in turned.columns(probe[name])}
        points = []
        for k, scene in enumerate(scenes):
            mesh = self.moved(k, "turned", lambda _: turn(turned.cosine, turned.sine))
            output = {"fields": "none", "history": columns}
            steps = [turned.step(step) for step in scene["steps"]]
            inside = {key: v for key, v in self.others(k).items() if not re.match(r"/?(steps|output)\b", key)}
            points.append((self.rows[k]["labels"], mesh | inside | {"steps": steps, "output": output}))
        rows = self.campaign.study("turned", points, fields)
        result = []
        for k, row in enumerate(rows):
            folder = self.campaign.out / "turned" / "out" / "points" / f"{k:04}"
            errors = [row["errors"][name] for name in fields]
            if row["status"] == "done":
                table = read_history(folder)
                for name, m in scalars.items():
                    value = taken(m, turned.along(table, probe[name]))
                    errors.append(abs(value - m["reference"]) / abs(m["reference"]))
            result.append(max(errors) if row["status"] == "done" and None not in errors else None)
        return turned.degrees, result

    def instructions(self) -> tuple[str, list[float | None]]:
        """The counter that was there, and the instructions of every point, in billions."""
        name, count = counter()
        counted = []
        for k, values in enumerate(self.settings):
            sets = [f"--set={key}={value}" for key, value in values.items()]
            here = self.here / f"{k:02}"
            options = ["-q", "-o", here, "--threads", "1", "--gmsh", self.campaign.gmsh]
            run = [self.campaign.program, "run", ROOT / self.scene.folder, *options, *sets]
            counted.append(count(run) if count else None)
        return name, counted


def perf(command: list[Any]) -> float | None:
    """Instructions of a command in user space, by the processor's own counter."""
    done = subprocess.run(["perf", "stat", "-x,", "-e", "instructions:u", *command], capture_output=True, text=True)
    found = re.search(r"^(\d+),[^\n]*instructions", done.stderr, re.MULTILINE)
    return float(found[1]) / 1e9 if found else None


def valgrind(command: list[Any]) -> float | None:
    """The same by simulation, on the processor that valgrind imitates."""
    tool = ["valgrind", "--tool=cachegrind", "--cache-sim=no", "--cachegrind-out-file=/dev/null"]
    done = subprocess.run([*tool, *command], capture_output=True, text=True)
    found = re.search(r"I +refs: +([\d,]+)", done.stderr)
    return float(found[1].replace(",", "")) / 1e9 if found else None


def counter() -> tuple[str, Callable[[list[Any]], float | None] | None]:
    """The first counter that works here: its name and what counts."""
    for name, count in (("perf", perf), ("valgrind", valgrind)):
        try:
            if count(["true"]):
                return name, count
        except OSError:
            continue
    return "none", None


def robustness(campaign: Any, rows: list[dict[str, Any]]) -> dict[str, Any]:
    """All of it for a front; written to robust.csv as well."""
    front = Front(campaign, rows)
    offsets, (degrees, turned), (name, counted) = front.offsets(), front.turned(), front.instructions()
    result = [
        {"labels": row["labels"], "error": row["error"], "offsets": a, "turned": b, "instructions": c}
        for row, a, b, c in zip(rows, offsets, turned, counted, strict=True)
    ]
    with open(campaign.out / "robust.csv", "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["setting", "error", *(f"seed {s}" for s in SEEDS), f"turned by {degrees}", f"1e9 instructions ({name})"])
        for row in result:
            table.writerow([label(row), row["error"], *row["offsets"], row["turned"], row["instructions"]])
    return {"degrees": degrees, "counter": name, "points": result}
