"""Kill runs at random moments, go on with them, and compare what they leave with runs that were left alone.

    python -m midplane_pipeline.robust.kill <midplane> [-o results/kill-test] [--kills 200 --signals 60 --disks 20 --pairs 50] [--seed 1]

Every case must leave files that are whole, or absent, when the run ends; and the files of an undisturbed run, byte by byte,
after `--resume`: no file more, no file less. Summaries are compared without times, memory and the increments after which a
run was gone on with. Ends with exit code 1 if one case did not.
"""

from __future__ import annotations

import argparse
import json
import random
import shutil
import signal
import subprocess
import sys
import time
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from midplane_pipeline.places import ROOT

from .files import broken, contents, meshers

# what a run is disturbed in: a path that snaps, parts that come and go, friction, a linear scene with fields of every
# increment, a scene whose fields are stored at its end only
SCENES = {
    "bar": [],
    "lifts": ["--set=output.fields=every"],
    "friction_block": [],
    "compression": ["--set=steps.0.increments=40", "--set=output.fields=every"],
    "shear_box": ["--set=output.fields=last"],
}
STUDY = {
    "title": "Killed on purpose",
    "scene": str(ROOT / "geo/compression/scene.json"),
    "axes": {"young": {"values": [{"materials.rock.young": young} for young in (1e4, 2e4, 3e4, 4e4, 5e4, 6e4)]}},
    "measures": {"energy": {"take": "last", "of": "energy.stored"}},
}


@dataclass
class Case:
    """A command that is disturbed, its results when it is not, and its time then."""

    name: str
    arguments: list[Any]
    resume: list[str]
    files: dict[str, Any] = field(default_factory=dict)
    seconds: float = 0.0


class Test:
    """Runs that are disturbed, and what came of them."""

    def __init__(self, program: Path, out: Path, seed: int) -> None:
        self.program, self.out, self.random = Path(program).resolve(), out.resolve(), random.Random(seed)
        self.failures: list[str] = []
        self.counts: dict[str, tuple[int, int]] = {}

    def start(self, arguments: list[Any], folder: Path) -> subprocess.Popen[str]:
        """Starts the program."""
        command = [self.program, *arguments, "-o", folder]
        return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, cwd=self.out, text=True)

    def cases(self) -> list[Case]:
        """All cases, each run once without disturbance."""
        shutil.rmtree(self.out, ignore_errors=True)
        self.out.mkdir(parents=True)
        study = self.out / "six_study.json"
        study.write_text(json.dumps(STUDY))
        cases = [Case(name, ["run", ROOT / "geo" / name, *more], ["--resume"]) for name, more in SCENES.items()]
        cases.append(Case("study", ["study", study], []))
        for case in cases:
            folder, begin = self.out / "alone" / case.name, time.monotonic()
            _, said = self.start(case.arguments, folder).communicate()
            case.seconds, case.files = time.monotonic() - begin, contents(folder)
            hidden = [name for name in case.files if ".midplane-" in name]
            if not case.files or hidden:
                sys.exit(f"{case.name} leaves {hidden or 'nothing'}: {said}")
            print(f"alone    {case.name:<16} {case.seconds:6.2f} s, {len(case.files)} files", flush=True)
        return cases

    def often(self, case: Case) -> list[str]:
        """Options for the interval of checkpoints; a study has none."""
        if case.name == "study":
            return []
        return ["--checkpoint", self.random.choice(["1", "3", "0.05s", "60s"])]

    def check(self, kind: str, number: int, case: Case, folder: Path, told: str | None = None) -> None:
        """Goes on with a run that was ended, and compares."""
        process = self.start([*case.arguments, *case.resume], folder)
        _, said = process.communicate()
        fault = told
        if fault is None and process.returncode != 0:
            fault = f"exit code {process.returncode} when it goes on: {said.strip()}"
        found = contents(folder) if folder.is_dir() else {}
        if fault is None and found != case.files:
            more, less = sorted(found.keys() - case.files.keys()), sorted(case.files.keys() - found.keys())
            other = sorted(name for name in found.keys() & case.files.keys() if found[name] != case.files[name])
            fault = f"more {more}, less {less}, other {other}"
        self.count(kind, f"{kind} {number} {case.name}", fault)
        if fault is None:
            shutil.rmtree(folder)

    def count(self, kind: str, name: str, fault: str | None) -> None:
        """Counts a case, and keeps its fault."""
        good, all_of = self.counts.get(kind, (0, 0))
        self.counts[kind] = (good + (fault is None), all_of + 1)
        if fault is not None:
            self.failures.append(f"{name}: {fault}")
            print(f"FAILED   {self.failures[-1]}", flush=True)

    def kill(self, number: int, case: Case) -> None:
        """SIGKILL, up to three times before the run may go to its end; now and then over good results."""
        folder, fault = self.out / "kill" / f"{number}", None
        if self.random.random() < 0.3:
            shutil.copytree(self.out / "alone" / case.name, folder)
        for again in range(self.random.choice([1, 1, 2, 3])):
            more = case.resume if again else []
            process = self.start([*case.arguments, *more, *self.often(case)], folder)
            time.sleep(self.random.uniform(0, 1.05 * case.seconds))
            process.kill()
            process.communicate()
            fault = fault or (folder.is_dir() and broken(folder)) or None
        self.check("kill", number, case, folder, fault)

    def signal(self, number: int, case: Case) -> None:
        """A signal that asks the run to end: code 128 + n, a line, no mesher left."""
        folder, fault = self.out / "signal" / f"{number}", None
        sent = self.random.choice([signal.SIGINT, signal.SIGTERM, signal.SIGHUP])
        process = self.start([*case.arguments, *self.often(case)], folder)
        time.sleep(self.random.uniform(0.05, 1.0 * case.seconds))
        process.send_signal(sent)
        _, said = process.communicate()
        if process.returncode not in (0, 128 + sent):
            fault = f"{sent.name}: exit code {process.returncode}: {said.strip()}"
        elif process.returncode and "stopped by" not in said:
            fault = f"{sent.name}: nothing is said of it: {said.strip()}"
        elif meshers(folder):
            fault = f"{sent.name}: gmsh goes on, {meshers(folder)}"
        elif folder.is_dir() and (broken(folder) or any(folder.rglob(".midplane-*"))):
            fault = f"{sent.name}: {broken(folder)} {list(folder.rglob('.midplane-*'))}"
        elif process.returncode and "--resume" in said and not any(folder.rglob("checkpoint/*")):
            fault = f"{sent.name}: no checkpoint: {said.strip()}"
        self.check("signal", number, case, folder, fault)

    def disk(self, number: int, case: Case) -> None:
        """A disk that is full after so many bytes; the results go on where there is more."""
        mount, folder = self.out / "disk", self.out / "disks" / f"{number}"
        whole = sum(len(data) for data in case.files.values())
        size = int(self.random.uniform(0.02, 1.0) * whole) + 8192
        mount.mkdir(exist_ok=True)
        subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", mount], check=True)
        try:
            process = self.start([*case.arguments, *self.often(case)], mount / "out")
            _, said = process.communicate()
            fault = None if process.returncode in (0, 4) else f"exit code {process.returncode}: {said.strip()}"
            fault = fault or ((mount / "out").is_dir() and broken(mount / "out")) or None
            if process.returncode == 4 and "No space left" not in said and "disk full" not in said:
                fault = f"another reason is given: {said.strip()}"
            if (mount / "out").is_dir():
                shutil.copytree(mount / "out", folder)
        finally:
            subprocess.run(["umount", mount], check=True)
        self.check("disk", number, case, folder, fault)

    def pair(self, number: int, cases: list[Case]) -> None:
        """Two different runs started together in one folder: one is refused and says who is there."""
        folder, two = self.out / "pairs" / f"{number}", self.random.sample(cases, 2)
        runs = [(case, self.start(case.arguments, folder)) for case in two]
        ends = [(case, run.communicate()[1], run.returncode) for case, run in runs]
        won = [case for case, _, code in ends if code == 0]
        lost = [(said, code) for _, said, code in ends if code != 0]
        fault = None
        if len(won) != 1 or lost[0][1] != 4 or "another run is at work there, process" not in lost[0][0]:
            fault = f"{[(case.name, code, said.strip()) for case, said, code in ends]}"
        elif contents(folder) != won[0].files:
            fault = "what is there is of both"
        self.count("pair", f"pair {number}", fault)
        shutil.rmtree(folder)


def can_mount(out: Path) -> bool:
    """True if a small file system can be mounted."""
    place = out / "mount"
    place.mkdir(parents=True, exist_ok=True)
    tried = subprocess.run(["mount", "-t", "tmpfs", "-o", "size=64k", "tmpfs", place], capture_output=True)
    if tried.returncode == 0:
        subprocess.run(["umount", place], check=True)
    place.rmdir()
    return tried.returncode == 0


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/kill-test"))
    for what, count in [("kills", 200), ("signals", 60), ("disks", 20), ("pairs", 50)]:
        parser.add_argument(f"--{what}", type=int, default=count)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    test = Test(options.program, options.out, options.seed)
    cases = test.cases()
    runs = [case for case in cases if case.name != "study"]
    for number in range(options.kills):
        test.kill(number, cases[number % len(cases)])
    for number in range(options.signals):
        test.signal(number, cases[number % len(cases)])
    if can_mount(test.out):
        for number in range(options.disks):
            test.disk(number, runs[number % len(runs)])
    else:
        print("disk     left out: no small file system can be mounted here")
    for number in range(options.pairs):
        test.pair(number, runs)
    for kind, (good, all_of) in test.counts.items():
        print(f"{kind:<8} {good} of {all_of}")
    sys.exit(1 if test.failures else 0)


if __name__ == "__main__":
    main()
