"""Run the fuzz targets of tests/fuzz, which `make fuzz` has built, and report what they found.

    python -m midplane_pipeline.robust.fuzz <folder of the programs> [--runs 1500000 | --seconds 20] [--targets msh pairing] [-o results/fuzz]

Every target begins with scenes, meshes, studies and paths of the gallery and with what is kept in tests/fuzz/corpus, and
libFuzzer goes on from there. A panic, a signal, 10 s for one input or 1 GB is a fault: its input is left in the folder, the
target begins again, and the exit code is 1. `--minimise` puts what the targets have reached, in few small files, to
tests/fuzz/corpus.
"""

from __future__ import annotations

import argparse
import json
import os
import re
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from midplane import scene_file

from midplane_pipeline.places import ROOT

CORPUS = ROOT / "tests/fuzz/corpus"
CORPUS_FILES = 60  # of a target
TARGETS = ["msh", "scene", "study", "path", "expression", "bind", "pairing"]
# longest input [bytes], and the part of the runs that a target gets, by what one costs
LONGEST = {"msh": 8192, "scene": 4096, "study": 4096, "path": 2048, "expression": 128, "bind": 4096, "pairing": 512}
SHARE = {"msh": 1.0, "scene": 1.0, "study": 0.3, "path": 0.03, "expression": 3.2, "bind": 0.3, "pairing": 1.5}
LIMITS = ["-timeout=10", "-rss_limit_mb=1024", "-report_slow_units=10"]
# scenes with all that a scene can say, their meshes as coarse as they can be
SCENES = {
    "compression": {"lower": "edges=2", "upper": "edges=3"},
    "ring": {"inner": "edges=2 rows=1", "outer": "edges=3 rows=1"},
    "bar": {"lower": "edges=1 rows=2", "upper": "edges=2 rows=2"},
    "dam": {"dam": "edges=4 size=40", "rock": "edges=5 size=200"},
    "shear_box": {"lower": "edges=4 rows=2", "upper": "edges=3 rows=2"},
    "tunnel": {"core": "edges=2", "ground": "edges=2 rows=2"} | {f"segment{k}": "edges=2 rows=1" for k in range(1, 7)},
}
# most faults of one target before it is left
MOST_FAULTS = 20


def shrunk(scene: dict[str, Any]) -> str:
    """A scene without what is for people."""
    for key in ("$schema", "title", "description"):
        scene.pop(key, None)
    return json.dumps(scene)


class Seeds:
    """Inputs to begin with, in a folder for each target, and the folder in which scenes and studies stand."""

    def __init__(self, programs: Path, out: Path) -> None:
        self.folder, self.begin = out / "folder", out / "seeds"
        self.folder.mkdir(parents=True)
        for target in TARGETS:
            (self.begin / target).mkdir(parents=True)
        self.meshes(programs / "midplane", out / "meshes")
        laws: dict[str, Any] = {}
        paths = [scene_file.read(path) for path in sorted((ROOT / "geo").glob("*/path.json"))]
        for file in sorted((ROOT / "geo").glob("*/*.json")):
            content = scene_file.read(file)
            if file.name.endswith("study.json"):
                content["scene"] = "scene.json"
                self.add("study", file.parent.name, shrunk(content))
                (self.folder / "scene.json").write_text((file.parent / "scene.json").read_text())
            elif "subdomains" in content:
                self.add("scene", f"{file.parent.name}_{file.stem}", shrunk(content))
                laws |= {json.dumps(one): one for one in content.get("interfaces", {}).values() if "law" in one}
        for path in paths:
            for segment in path["program"]:
                segment["points"] = min(segment["points"], 5)
        for number, interface in enumerate(laws.values()):
            path = paths[number % len(paths)]  # a law takes long, all of them along all paths too long
            own = {key: interface[key] for key in interface if key not in ("side_a", "side_b", "sides", "between")}
            own |= {"side_a": "a.a", "side_b": "b.b"}
            self.add("path", f"{number}", f"{json.dumps(own)}\n---\n{json.dumps(path)}")

    def meshes(self, midplane: Path, out: Path) -> None:
        """Coarse meshes of the gallery, binary and as text, and scenes on them."""
        for name, coarse in SCENES.items():
            settings = [f"--set=subdomains.{part}.parameters.{one}" for part, all_of in coarse.items() for one in all_of.split()]
            subprocess.run([midplane, "mesh", ROOT / "geo" / name, "-o", out / name, "-q", *settings], check=True)
            scene = scene_file.read(ROOT / "geo" / name / "scene.json")
            made = {path.name.rsplit("-", 1)[0]: path for path in sorted((out / name / "mesh").glob("*.msh"))}
            for part, content in scene["subdomains"].items():
                own = made.get(part) or made[Path(content["geo"]).stem]
                shutil.copy(own, self.folder / f"{name}_{own.name.rsplit('-', 1)[0]}.msh")
                content.pop("geo", None), content.pop("parameters", None)
                content["msh"] = f"{name}_{own.name.rsplit('-', 1)[0]}.msh"
            self.add("bind", name, shrunk(scene))
            for path in made.values():
                self.add("msh", f"{name}_{path.stem}", path.read_bytes())
                text = out / name / f"{path.stem}.txt.msh"
                command: list[str | Path] = ["gmsh", path, "-save", "-format", "msh41", "-setnumber", "Mesh.Binary", "0", "-v", "0", "-o", text]
                subprocess.run(command, check=True)
                self.add("msh", f"{name}_{path.stem}_text", text.read_bytes())

    def add(self, target: str, name: str, content: str | bytes) -> None:
        """An input of a target."""
        content = content if isinstance(content, bytes) else content.encode()
        (self.begin / target / name).write_bytes(content)


def dictionary(schemas: list[str], path: Path) -> None:
    """Words of a document for libFuzzer: keys and values of the schemas."""
    words = set()

    def walk(node: Any) -> None:
        if isinstance(node, dict):
            words.update(node.get("properties", {}))
            words.update(str(value) for value in [*node.get("enum", []), node.get("const")] if isinstance(value, str))
            for value in node.values():
                walk(value)
        elif isinstance(node, list):
            for value in node:
                walk(value)

    for schema in schemas:
        walk(json.loads((ROOT / "geo" / schema).read_text()))
    numbers = ["0", "-1", "1e308", "-1e-320", "1e18", "0.5", "null", "true", "{}", "[]"]
    entries = [f'"\\"{word}\\""' for word in sorted(words) if word.isascii() and '"' not in word] + [f'"{one}"' for one in numbers]
    path.write_text("\n".join(entries) + "\n")


class Target:
    """One target: its runs so far and its faults."""

    def __init__(self, programs: Path, out: Path, seeds: Seeds, name: str) -> None:
        self.program, self.name, self.seeds, self.out = programs / f"fuzz_{name}", name, seeds, out
        self.reached, self.faulty = out / "reached" / name, out / "faults"
        self.reached.mkdir(parents=True, exist_ok=True)
        self.runs, self.memory, self.slowest, self.seconds = 0, 0, 0, 0.0
        self.faults: list[dict[str, str | None]] = []

    def call(self, *arguments: str | Path) -> subprocess.CompletedProcess[bytes]:
        """Runs the target."""
        environment = os.environ | {"RAYON_NUM_THREADS": "1", "FUZZ_FOLDER": str(self.seeds.folder), "RUST_BACKTRACE": "1"}
        # mutants of a scene name files: in a folder of its own they find none
        return subprocess.run([self.program, *arguments], env=environment, cwd=self.seeds.folder, capture_output=True, check=False)

    def inputs(self) -> list[Path]:
        """Folders that it begins with."""
        return [self.seeds.begin / self.name] + [CORPUS / self.name] * (CORPUS / self.name).exists()

    def run(self, runs: int, seconds: float | None) -> Target:
        """Goes on until there were so many runs, or so many seconds; a fault ends libFuzzer, which then begins again."""
        begin = time.monotonic()
        while len(self.faults) < MOST_FAULTS:
            left = seconds - self.seconds if seconds else 0.0
            if self.runs >= runs or (seconds and left <= 0):
                break
            words = [f"-dict={self.out / 'words'}"] if self.name in ("scene", "study", "bind", "path") else []
            bound = [f"-runs={runs - self.runs}"] + ([f"-max_total_time={max(1, int(left))}"] if seconds else [])
            prefix = f"-artifact_prefix={self.faulty}/{self.name}-"
            seed = f"-seed={len(self.faults) + 1}"
            ended = self.call(*LIMITS, *words, *bound, prefix, seed, f"-max_len={LONGEST[self.name]}", "-print_final_stats=1", self.reached, *self.inputs())
            said = ended.stderr.decode(errors="replace")
            if "inline 8-bit counters" not in said:
                sys.exit(f"{self.program} has no counters: it was not built by make fuzz\n{said[-1000:]}")
            done = self.number(said, "number_of_executed_units")
            self.runs += done
            self.memory = max(self.memory, self.number(said, "peak_rss_mb"))
            self.slowest = max(self.slowest, self.number(said, "slowest_unit_time_sec"))
            self.seconds = time.monotonic() - begin
            if ended.returncode:
                self.faults.append(self.fault(said))
            elif not done:
                break
        return self

    @staticmethod
    def number(said: str, name: str) -> int:
        """A number of libFuzzer's statistics."""
        found = re.search(rf"stat::{name}:\s*(\d+)", said)
        return int(found[1]) if found else 0

    @staticmethod
    def fault(said: str) -> dict[str, str | None]:
        """The reason of an end, and its input."""
        panic = re.search(r"panicked at ([^\n]*)\n([^\n]*)", said)
        what = f"{panic[1]} {panic[2]}" if panic else "".join(re.findall(r"ERROR: libFuzzer: ([^\n]*)", said)[:1])
        file = re.search(r"Test unit written to (\S+)", said)
        return {"what": what or said[-300:], "input": file[1] if file else None}

    def report(self) -> dict[str, Any]:
        """Its runs and faults."""
        rate = round(self.runs / self.seconds) if self.seconds else 0
        return {
            "target": self.name,
            "runs": self.runs,
            "runs per second": rate,
            "most memory [MB]": self.memory,
            "slowest [s]": self.slowest,
            "faults": self.faults,
        }

    def minimise(self) -> None:
        """The smallest set of inputs that reaches as much, as far as small files do."""
        kept = CORPUS / self.name
        new = self.out / "minimised" / self.name
        new.mkdir(parents=True)
        self.call("-merge=1", *LIMITS, f"-max_len={LONGEST[self.name] // 4}", new, self.reached, *self.inputs())
        shutil.rmtree(kept, ignore_errors=True)
        kept.mkdir(parents=True)
        files = sorted(new.iterdir(), key=lambda file: file.stat().st_size)
        for k in range(min(CORPUS_FILES, len(files))):
            # short and long ones
            file = files[k * len(files) // min(CORPUS_FILES, len(files))]
            shutil.copy(file, kept / file.name[:12])


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("programs", type=Path)
    parser.add_argument("--runs", type=int, default=1_500_000, help="of a target, times its share")
    parser.add_argument("--seconds", type=float, help="of a target, at most")
    parser.add_argument("--targets", nargs="+", choices=TARGETS, default=TARGETS)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--minimise", action="store_true")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/fuzz"))
    options = parser.parse_args()
    out, programs = options.out.resolve(), options.programs.resolve()
    shutil.rmtree(out, ignore_errors=True)
    (out / "faults").mkdir(parents=True)
    dictionary(["scene.schema.json", "study.schema.json"], out / "words")
    seeds = Seeds(programs, out)
    with ThreadPoolExecutor(options.jobs) as pool:
        targets = list(pool.map(lambda name: Target(programs, out, seeds, name).run(int(options.runs * SHARE[name]), options.seconds), options.targets))
        if options.minimise:
            list(pool.map(Target.minimise, targets))
    report: dict[str, Any] = {"limits": LIMITS, "targets": [target.report() for target in targets]}
    (out / "report.json").write_text(json.dumps(report, indent=1) + "\n")
    faults = [f"{target.name}: {fault['what']}" for target in targets for fault in target.faults]
    for target in report["targets"]:
        speed = f"{target['runs']:>10} runs {target['runs per second']:>7}/s {target['most memory [MB]']:>5} MB"
        print(f"{target['target']:<12}{speed}, slowest {target['slowest [s]']} s, {len(target['faults'])} faults")
    print("\n".join(faults))
    print(f"{sum(target.runs for target in targets)} runs, {len(faults)} faults")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
