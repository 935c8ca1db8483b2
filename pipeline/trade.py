"""Measure speed against accuracy: the campaign behind `make trade`, written to results/trade/trade.json.

Every scene is run around a reference setting one knob at a time, at a Latin hypercube over all knobs, at all combinations
of the two knobs that move its front, and with the presets; the points of the front are repeated. Every run is a process
of its own on one thread; its time is the processor's for the whole process, without the mesher, which does not count what
others on the machine make it wait. What fails counts as infinitely wrong. `midplane study` does the runs, so an interrupted campaign goes on where it was."""

import argparse
import json
import os
import random
import shutil
import statistics
import subprocess
import time
from pathlib import Path

from trade_extras import densities, features, penalty
from trade_front import front, known
from trade_machine import machine
from trade_scenes import SCENES, knobs, reference, settings

ROOT = Path(__file__).resolve().parent.parent
PRESETS = ("draft", "normal", "fine")
# points of the hypercube, repeats of the front, scenes
FORMS = {
    "reduced": (4, 5, ("strip", "cook", "friction", "ring")),
    "usual": (16, 5, tuple(SCENES)),
    "full": (64, 7, tuple(SCENES)),
}
# a density and an element at most for the reduced form
SMALL = 1


class Campaign:
    """The runs of a scene."""

    def __init__(self, program, scene, out, form):
        self.program, self.scene, self.form = program, scene, form
        self.out = out / scene.name
        self.points = []

    def study(self, phase, labelled, repeat=1):
        """Runs settings {label: settings} as one study, and returns its points as rows."""
        folder = self.out / phase
        folder.mkdir(parents=True, exist_ok=True)
        study = {
            "title": f"{self.scene.case}: {phase}",
            "scene": os.path.relpath(ROOT / self.scene.folder / "scene.json", folder),
            "axes": {"setting": {"values": [value for _, value in labelled]}},
            "measures": self.scene.measures,
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
        command = [self.program, "study", folder / "study.json", "-o", folder / "out", "--threads", "1", "-q"]
        subprocess.run(command, check=True)
        done = json.loads((folder / "out" / "study.json").read_text())
        rows = [self.row(phase, labels, point) for (labels, _), point in zip(labelled, done["points"])]
        shutil.copyfile(folder / "out" / "study.csv", self.out / f"{phase}.csv")
        return rows

    def row(self, phase, labels, point):
        """What the campaign keeps of a point."""
        stages = {name: statistics.median(s.get(name, 0.0) for s in point["stages"]) for name in point["stages"][0]}
        wall = [s - stage.get("mesh", 0.0) for s, stage in zip(point["seconds"], point["stages"])]
        run = point["processor"] or wall
        errors = point["errors"]
        deciding = [errors[name] for name in self.scene.errors]
        failed = point["status"] != "done" or any(error is None for error in deciding)
        return {
            "phase": phase,
            "labels": labels,
            "status": point["status"],
            "message": point["message"],
            "error": None if failed else max(deciding),
            "errors": errors,
            "values": point["values"],
            "time": statistics.median(run),
            "times": run,
            "wall": statistics.median(wall),
            "whole": point["seconds"],
            "stages": stages,
            "peak_memory": point["peak_memory"],
            "strategy": point["strategy"],
            "settings": [s for s in point["settings"] if "study:" not in s],
        } | {
            name: point["counts"].get(name)
            for name in ("dofs", "iterations", "increments", "halved", "factor_entries", "stiffness_number")
        }

    def add(self, rows):
        self.points += rows
        return rows

    def labelled(self, labels):
        return labels, settings(self.scene, labels)

    def table(self):
        table = knobs(self.scene)
        if self.form == "reduced":
            table["density"] = {k: v for k, v in table["density"].items() if v <= SMALL}
        return table

    def sweep(self):
        """One knob at a time around the reference; returns {knob: ratio of its largest to its smallest error}."""
        table = self.table()
        chosen, seen = [{}], [settings(self.scene, {})]
        for name, values in table.items():
            for label in values:
                setting = settings(self.scene, {name: label})
                # the reference has its label once, as a point of every knob
                if setting not in seen:
                    seen.append(setting)
                    chosen.append({name: label})
        rows = self.add(self.study("sweep", [self.labelled(labels) for labels in chosen]))
        spans = {}
        for name in table:
            errors = [
                max(r["error"], 1e-16)
                for r in rows
                if (name in r["labels"] or not r["labels"]) and r["error"] is not None
            ]
            spans[name] = max(errors) / min(errors) if len(errors) > 1 else 1.0
        return spans

    def hypercube(self, count, seed=1):
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
        return self.add(self.study("hypercube", [self.labelled(labels) for labels in chosen]))

    def factorial(self, phase, names):
        """All combinations of two knobs."""
        a, b = names
        table = self.table()
        chosen = [{a: x, b: y} for x in table[a] for y in table[b]]
        return self.add(self.study(phase, [self.labelled(labels) for labels in chosen]))

    def presets(self, repeat):
        """The scene as its files have it, with every preset."""
        labelled = [({"accuracy": name}, self.scene.settings | {"accuracy": name}) for name in PRESETS]
        return self.study("presets", labelled, repeat)

    def repeats(self, phase, chosen, repeat):
        """The points of the front again."""
        return self.study(phase, [self.labelled(row["labels"]) for row in chosen], repeat)


def write_whole(path, text):
    aside = path.with_suffix(".writing")
    aside.write_text(text)
    aside.replace(path)


def run_scene(program, scene, out, form):
    """All phases of a scene."""
    count, repeat, _ = FORMS[form]
    campaign = Campaign(program, scene, out, form)
    start = time.monotonic()
    spans = campaign.sweep()
    campaign.hypercube(count)
    knob_pair = ["density", "element"]
    candidates = {name: span for name, span in spans.items() if name not in knob_pair}
    movers = sorted(spans, key=spans.get, reverse=True)[:2]
    campaign.factorial("factorial", knob_pair)
    if set(movers) != set(knob_pair) and form != "reduced":
        campaign.factorial("factorial of the two that move most", movers)
    first = front(campaign.points, scene.floor)
    # the same front measured twice, one after the other
    halves = [campaign.repeats(phase, first, repeat) for phase in ("repeats", "repeats again")]
    times = {}
    for row in halves[0] + halves[1]:
        times.setdefault(tuple(row["settings"]), []).extend(row["times"])
    for row in campaign.points:
        if tuple(row["settings"]) in times:
            row["time"] = statistics.median(times[tuple(row["settings"])])
    presets = campaign.presets(repeat)
    print(
        f"{scene.name:10} {len(campaign.points)} points, front of {len(first)}, {time.monotonic() - start:.0f} s",
        flush=True,
    )
    return {
        "case": scene.case,
        "folder": scene.folder,
        "deciding": scene.errors,
        "floor": scene.floor,
        "nonlinear": scene.nonlinear,
        "exact": scene.measures[scene.errors[0]].get("reference"),
        "reference": reference(scene),
        "spans": spans,
        "movers": movers,
        "other": max(candidates, key=candidates.get) if candidates else None,
        "points": campaign.points,
        "front": front(halves[0], scene.floor),
        "front_again": front(halves[1], scene.floor),
        "repeated": halves,
        "presets": presets,
        "curves": curves(scene, campaign),
    }


def curves(scene, campaign):
    """Histories of the densities of the sweep."""
    result = []
    for title, x, y in scene.plotted:
        for row, k in zip(campaign.points, range(10**6)):
            if row["phase"] != "sweep" or list(row["labels"]) not in (["density"], ["increments"]):
                continue
            file = campaign.out / "sweep" / "out" / "points" / f"{k:04}" / "history.csv"
            columns = known(file, (x, y))
            if columns:
                result.append({"title": title, "labels": row["labels"], "x": columns[0], "y": columns[1]})
    return result


def same(front, other, spread):
    """Whether every point of a front is on the other or beaten there by less than the spread."""

    def beaten(row):
        return not any(r["error"] <= row["error"] and r["time"] <= (1 + spread) * row["time"] for r in other)

    return not any(beaten(row) for row in front)


def repeatability(scenes):
    """How far the two measurements of every front agree."""
    rows = {}
    for name, scene in scenes.items():
        ratios, spreads = [], []
        for a, b in zip(*scene["repeated"]):
            ratios.append(max(a["time"], b["time"]) / min(a["time"], b["time"]))
            spreads.append(max((max(r["times"]) - min(r["times"])) / r["time"] for r in (a, b)))
        spread = statistics.median(spreads)
        a, b = scene["front"], scene["front_again"]
        rows[name] = {
            "points": len(ratios),
            "same_front": same(a, b, spread) and same(b, a, spread),
            "largest_ratio": max(ratios),
            "median_spread": spread,
            "within_spread": sum(ratio - 1 <= spread for ratio, spread in zip(ratios, spreads)),
        }
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/trade"))
    parser.add_argument("--form", choices=FORMS, default="usual")
    parser.add_argument("--scenes", nargs="+", choices=SCENES)
    parser.add_argument("--fresh", action="store_true", help="forget what an earlier campaign has measured")
    options = parser.parse_args()
    program = options.program.resolve()
    out = options.out
    if options.fresh:
        shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True, exist_ok=True)
    start, before = time.monotonic(), os.getloadavg()
    chosen = options.scenes or FORMS[options.form][2]
    scenes = {name: run_scene(program, SCENES[name], out, options.form) for name in chosen}
    extras = {"penalty": penalty(program, out, options.form)}
    if options.form != "reduced":
        extras |= {"densities": densities(program, out), "features": features(program, out)}
    result = {
        "machine": machine(program),
        "form": options.form,
        "load_before": before,
        "load_after": os.getloadavg(),
        "minutes": (time.monotonic() - start) / 60,
        "repeatability": repeatability(scenes),
        "scenes": scenes,
    } | extras
    write_whole(out / "trade.json", json.dumps(result, indent=1))
    print(f"wrote {out / 'trade.json'} after {result['minutes']:.1f} minutes")


if __name__ == "__main__":
    main()
