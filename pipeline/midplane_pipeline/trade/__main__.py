"""Measure speed against accuracy: the campaign behind `make trade`, written to results/trade/trade.json.

Every scene is run around a reference setting one knob at a time, at a Latin hypercube over all knobs, at all combinations
of the two knobs that move its front, and with the presets; points on the front or near it are repeated, all in turn, round
after round. Every run is a process of its own on one thread; its time is the processor's for the whole process, without
the mesher, which does not count what others on the machine make it wait, and of the repeats the fastest counts: a slower
one has shared its caches with others. What fails counts as infinitely wrong. `midplane study` does the runs, so an interrupted
campaign goes on where it was."""

import argparse
import csv
import json
import os
import random
import shutil
import statistics
import subprocess
import time
from pathlib import Path
from typing import Any

from midplane_pipeline.places import ROOT

from .compare import repeatability, together
from .extras import features, penalty, refinements
from .front import MARGINS, Row, candidates, front, label, tie
from .history import curves
from .machine import machine, mesher, pin
from .robust import robustness
from .scenes import SCENES, Scene, knobs, reference, settings

PRESETS = ("draft", "normal", "fine")
# points of the hypercube, rounds of the front in each of two measurements, scenes, those whose front is run moved and turned
FORMS = {
    "reduced": (4, 5, ("strip", "cook", "friction", "ring"), ("cook", "ring")),
    "usual": (16, 7, tuple(SCENES), ()),
    "full": (64, 7, tuple(SCENES), tuple(SCENES)),
}
# the largest refinement of the reduced form
SMALL = 1


class Campaign:
    """The runs of a scene."""

    def __init__(self, program: Path, scene: Scene, out: Path, form: str) -> None:
        self.program, self.scene, self.form = program, scene, form
        self.out = out / scene.name
        self.gmsh = mesher(out)
        self.points: list[Row] = []
        self.measured: dict[str, Row] = {}

    def study(self, phase: str, labelled: list[Any], measures: dict[str, Any] | None = None, repeat: int = 1) -> list[Row]:
        """Runs (labels, settings) as one study, and returns its points as rows."""
        folder = self.out / phase
        folder.mkdir(parents=True, exist_ok=True)
        study = {
            "title": f"{self.scene.case}: {phase}",
            "scene": os.path.relpath(ROOT / self.scene.folder / "scene.json", folder),
            "axes": {"setting": {"values": [value for _, value in labelled]}},
            "measures": self.scene.measures if measures is None else measures,
            "repeat": repeat,
            "process": "own",
        }
        write_whole(folder / "study.json", json.dumps(study, indent=1))
        meshes = self.out / "mesh"
        meshes.mkdir(exist_ok=True)
        link = folder / "out" / "mesh"
        link.parent.mkdir(exist_ok=True)
        if not link.exists():
            link.symlink_to(meshes.resolve())
        options: list[str | Path] = ["-o", folder / "out", "--threads", "1", "-q", "--gmsh", self.gmsh]
        subprocess.run([self.program, "study", folder / "study.json", *options], check=True)
        done = json.loads((folder / "out" / "study.json").read_text())
        return [self.row(phase, labels, point) for (labels, _), point in zip(labelled, done["points"], strict=True)]

    def keep(self, phase: str) -> None:
        """Its table beside the campaign's own."""
        shutil.copyfile(self.out / phase / "out" / "study.csv", self.out / f"{phase}.csv")

    def row(self, phase: str, labels: dict[str, Any], point: dict[str, Any]) -> Row:
        """A point as the campaign keeps it."""
        stages = {name: statistics.median(s.get(name, 0.0) for s in point["stages"]) for name in point["stages"][0]}
        wall = [s - stage.get("mesh", 0.0) for s, stage in zip(point["seconds"], point["stages"], strict=True)]
        run = point["processor"] or wall
        errors = point["errors"]
        deciding = [errors[name] for name in self.scene.errors if name in errors]
        failed = point["status"] not in ("done", "limit") or any(error is None for error in deciding)
        return {
            "phase": phase,
            "labels": labels,
            "status": point["status"],
            "message": point["message"],
            "error": None if failed else max(deciding, default=0.0),
            "errors": errors,
            "values": point["values"],
            "time": min(run),
            "times": run,
            "wall": statistics.median(wall),
            "whole": point["seconds"],
            "stages": stages,
            "peak_memory": point["peak_memory"],
            "strategy": point["strategy"],
            "settings": [s for s in point["settings"] if "study:" not in s],
        } | {name: point["counts"].get(name) for name in ("dofs", "iterations", "increments", "parts", "rejected", "factor_entries", "stiffness_number")}

    def labelled(self, labels: dict[str, Any]) -> tuple[dict[str, Any], dict[str, Any]]:
        """Labels and their settings."""
        return labels, settings(self.scene, labels)

    def measure(self, phase: str, chosen: list[Any]) -> list[Row]:
        """Runs settings by their labels; what an earlier phase has measured is not run again."""
        keys = [json.dumps(settings(self.scene, labels)) for labels in chosen]
        fresh = {key: labels for key, labels in zip(keys, chosen, strict=True) if key not in self.measured}
        if fresh:
            rows = self.study(phase, [self.labelled(labels) for labels in fresh.values()])
            self.keep(phase)
            self.measured |= dict(zip(fresh, rows, strict=True))
        rows = [self.measured[key] | {"phase": phase, "labels": labels} for key, labels in zip(keys, chosen, strict=True)]
        self.points += rows
        return rows

    def table(self) -> dict[str, dict[str, Any]]:
        """The knobs that this campaign turns."""
        table = knobs(self.scene)
        if self.scene.swept:
            table = {name: table[name] for name in self.scene.swept}
            table["element"] = {name: table["element"][name] for name in ("T6", "Q8")}
        if self.form == "reduced":
            table["refinement"] = {k: v for k, v in table["refinement"].items() if v <= SMALL}
        return table

    def sweep(self) -> dict[str, float]:
        """One knob at a time around the reference; returns {knob: ratio of its largest to its smallest error}."""
        table = self.table()
        chosen: list[dict[str, str]] = [{}]
        seen = [settings(self.scene, {})]
        for name, values in table.items():
            for level in values:
                setting = settings(self.scene, {name: level})
                # the reference has its label once, as a point of every knob
                if setting not in seen:
                    seen.append(setting)
                    chosen.append({name: level})
        rows = self.measure("sweep", chosen)
        spans = {}
        for name in table:
            errors = [max(r["error"], 1e-16) for r in rows if (name in r["labels"] or not r["labels"]) and r["error"] is not None]
            spans[name] = max(errors) / min(errors) if len(errors) > 1 else 1.0
        return spans

    def hypercube(self, count: int, seed: int = 1) -> list[Row]:
        """Every knob in as many strata as points, each taken once."""
        table, draw = self.table(), random.Random(seed)
        columns = {}
        for name, values in table.items():
            strata = list(range(count))
            draw.shuffle(strata)
            labels = list(values)
            columns[name] = [labels[int((k + draw.random()) / count * len(labels))] for k in strata]
        usual = reference(self.scene)
        chosen = [{name: c[k] for name, c in columns.items() if c[k] != usual[name]} for k in range(count)]
        return self.measure("hypercube", chosen)

    def factorial(self, phase: str, names: list[str]) -> list[Row]:
        """All combinations of two knobs."""
        a, b = names
        table = self.table()
        return self.measure(phase, [{a: x, b: y} for x in table[a] for y in table[b]])

    def presets(self, repeat: int) -> list[Row]:
        """The scene as its files have it, with every preset."""
        labelled = [({"accuracy": name}, self.scene.settings | {"accuracy": name}) for name in PRESETS]
        rows = self.study("presets", labelled, repeat=repeat)
        self.keep("presets")
        return rows

    def repeats(self, half: str, chosen: list[Any], rounds: int) -> list[Row]:
        """Points again, all in turn, round after round; the campaign keeps their fastest times."""
        labelled = [self.labelled(row["labels"]) for row in chosen]
        rows = [row | {"times": []} for row in chosen]
        for k in range(rounds):
            again = self.study(f"repeats/{half} {k}", labelled)
            rows = [together(a, b) if a["times"] else b for a, b in zip(rows, again, strict=True)]
        times = {tuple(row["settings"]): row["time"] for row in rows}
        for row in self.points:
            row["time"] = min(row["time"], times.get(tuple(row["settings"]), row["time"]))
        return rows


def write_whole(path: Path, text: str) -> None:
    """Writes a file that is never half there."""
    aside = path.with_suffix(".writing")
    aside.write_text(text)
    aside.replace(path)


def run_scene(program: Path, scene: Scene, out: Path, form: str, robust: bool) -> dict[str, Any]:
    """All phases of a scene."""
    count, rounds = FORMS[form][:2]
    campaign = Campaign(program, scene, out, form)
    start = time.monotonic()
    spans = campaign.sweep()
    if not scene.swept:
        campaign.hypercube(count)
    knob_pair = ["refinement", "element"]
    movers = sorted(spans, key=spans.__getitem__, reverse=True)[:2]
    campaign.factorial("factorial", knob_pair)
    if set(movers) != set(knob_pair) and form != "reduced" and not scene.swept:
        campaign.factorial("factorial of the two that move most", movers)
    if scene.swept:  # its points are too long to be repeated
        near = candidates(campaign.points, scene.floor, MARGINS[1])
        halves, rounds = [near, near], 1
    else:
        # a single run may have been cold, or disturbed
        campaign.repeats("again", candidates(campaign.points, scene.floor, MARGINS[0]), 1)
        near = candidates(campaign.points, scene.floor, MARGINS[1])
        # measured twice, one after the other
        halves = [campaign.repeats(half, near, rounds) for half in ("first", "second")]
    pooled = [together(a, b) for a, b in zip(*halves, strict=True)]
    repeats_csv(campaign.out / "repeats.csv", halves)
    chosen = front(pooled, scene.floor, statistics.median(tie(row) for row in pooled))
    presets = campaign.presets(rounds)
    more = {"robust": robustness(campaign, chosen)} if robust else {}
    counts = f"{len(campaign.points)} points, {len(near)} near the front, {len(chosen)} on it"
    print(f"{scene.name:10} {counts}, {time.monotonic() - start:.0f} s", flush=True)
    return {
        "case": scene.case,
        "folder": scene.folder,
        "deciding": scene.errors,
        "floor": scene.floor,
        "nonlinear": scene.nonlinear,
        "exact": scene.measures[scene.errors[0]].get("reference"),
        "reference": reference(scene),
        "points": campaign.points,
        "front": chosen,
        "repeated": halves,
        "repeatability": repeatability(chosen, halves, pooled, scene.floor),
        "presets": presets,
        "curves": curves(scene, campaign),
    } | more


def repeats_csv(path: Path, halves: list[list[Row]]) -> None:
    """The times of all repeats, a row a point and measurement."""
    with open(path, "w", newline="") as file:
        table = csv.writer(file, lineterminator="\n")
        table.writerow(["setting", "error", "measurement", "seconds"])
        for rows in zip(*halves, strict=True):
            for half, row in zip(("first", "second"), rows, strict=True):
                table.writerow([label(row), row["error"], half, *(f"{t:.6g}" for t in row["times"])])


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m midplane_pipeline.trade", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/trade"))
    parser.add_argument("--form", choices=FORMS, default="usual")
    parser.add_argument("--scenes", nargs="+", choices=SCENES)
    parser.add_argument(
        "--robust",
        action="store_true",
        help="move nodes, turn scenes, count instructions in every scene, as the full form does",
    )
    parser.add_argument("--fresh", action="store_true", help="forget what an earlier campaign has measured")
    options = parser.parse_args()
    program = options.program.resolve()
    out = options.out
    if options.fresh:
        shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True, exist_ok=True)
    start, before = time.monotonic(), os.getloadavg()
    chosen = options.scenes or FORMS[options.form][2]
    earlier = json.loads((out / "trade.json").read_text())["minutes"] if (out / "trade.json").is_file() else 0.0
    cores = pin() if options.form == "full" else None
    robust = chosen if options.robust else FORMS[options.form][3]
    scenes = {name: run_scene(program, SCENES[name], out, options.form, name in robust) for name in chosen}
    if cores:
        pin(cores)
    extras: dict[str, Any] = {"penalty": penalty(program, out, options.form)}
    if options.form != "reduced":
        extras |= {"refinements": refinements(program, out), "features": features(program, out)}
    result = {
        "machine": machine(program),
        "form": options.form,
        "load_before": before,
        "load_after": os.getloadavg(),
        "minutes": earlier + (time.monotonic() - start) / 60,
        "scenes": scenes,
    } | extras
    write_whole(out / "trade.json", json.dumps(result, indent=1))
    print(f"wrote {out / 'trade.json'} after {result['minutes']:.1f} minutes")


if __name__ == "__main__":
    main()
