"""Make the sources wrong in one place after the other, and see whether the tests of that room notice.

    python -m midplane_pipeline.robust.mutants [--seed 1] [--count 200] [--areas laws] [--again] [-o results/mutants] [--docs docs]
    python -m midplane_pipeline.robust.mutants --report [-o results/mutants] [--docs docs]

A seeded sample of mutants is compiled at once, each behind the number that the environment names, so that one build serves
for all. Every mutant runs the unit tests of its room and the integration tests that are about it; the first failure, or
three times the time of the right program, catches it. Survivors are listed with the reasons in tests/mutants/reasons.json.
After tests were added, `--again` tries those that survived before; after reasons were, `--report` writes the report anew.
"""

import argparse
import hashlib
import json
import os
import random
import shutil
import subprocess
import sys
import threading
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

from midplane_pipeline.places import ROOT

from .areas import AREAS
from .survivors import Site, same, write

REASONS = ROOT / "tests/mutants/reasons.json"
# programs of integration tests
PROGRAMS = ["laws", "coupling", "equilibrium", "program"]
SWITCH = """
/// True for the mutant that the environment names.
pub fn mutant(number: u32) -> bool {
    static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let chosen = || std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    *CHOSEN.get_or_init(chosen) == number
}
"""
# a mutant that takes this many times as long as the right program, and so many seconds more, does not end
SLOWER, MORE = 3.0, 20.0


def build(work: Path, *arguments: str) -> tuple[subprocess.CompletedProcess[str], list[Any]]:
    """Runs cargo; returns how it ended and its messages."""
    command = ["cargo", *arguments, "--release", "--locked", "--message-format", "json"]
    # beside the programs of the project, which it would replace
    environment = os.environ | {"CARGO_TARGET_DIR": str(Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "mutants")}
    ended = subprocess.run(command, cwd=work, env=environment, capture_output=True, text=True, check=False)
    messages = [json.loads(line) for line in ended.stdout.splitlines() if line.startswith("{")]
    return ended, messages


class Mutants:
    """A sample of places, written into a copy of the project."""

    def __init__(self, work: Path, program: Path, areas: list[str], count: int, seed: int) -> None:
        self.work = work
        files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
        shutil.rmtree(work, ignore_errors=True)
        for name in filter(None, files):
            (work / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, work / name)
        self.waiting: dict[str, list[Site]] = {}
        self.sample: dict[str, list[Site]] = {}
        for area in areas:
            sources, without, _, _ = AREAS[area]
            found = sorted({str(path.relative_to(ROOT)) for pattern in sources for path in ROOT.glob(pattern)} - set(without))
            sites = [json.loads(line) for line in subprocess.run([program, *found], cwd=ROOT, check=True, capture_output=True, text=True).stdout.splitlines()]
            # the same places whatever else is changed
            sites.sort(key=lambda site: self.rank(seed, site))
            self.waiting[area], self.sample[area] = sites, []
            self.fill(area, count)
        (work / "src/lib.rs").write_text((ROOT / "src/lib.rs").read_text() + SWITCH)

    @staticmethod
    def rank(seed: int, site: Site) -> str:
        """A number by chance that is the site's own."""
        text = " ".join(str(part) for part in (seed, *(site[key] for key in ("file", "function", "kind", "right", "wrong"))))
        return hashlib.sha256(text.encode()).hexdigest()

    def fill(self, area: str, count: int) -> None:
        """Draws until there are so many, none of them within another."""
        chosen = self.sample[area]
        while len(chosen) < count and self.waiting[area]:
            site = self.waiting[area].pop()
            if all(are_apart(site, other) for other in chosen):
                chosen.append(site | {"area": area})

    def all(self) -> list[Site]:
        """The places of all areas."""
        return [site for area in self.sample for site in self.sample[area]]

    def write(self) -> None:
        """The sources with all mutants in them; every one knows where it stands there."""
        by_file: dict[str, list[Site]] = {}
        for number, site in enumerate(self.all(), 1):
            site["number"] = number
            by_file.setdefault(site["file"], []).append(site)
        for path in self.work.glob("src/**/*.rs"):
            name = str(path.relative_to(self.work))
            if name == "src/lib.rs":
                continue
            text, out, at = (ROOT / name).read_bytes(), b"", 0
            for site in sorted(by_file.get(name, []), key=lambda site: site["start"]):
                right, wrong = text[site["start"] : site["end"]], site["wrong"].encode()
                choice = b"if crate::mutant(%d) { %s }" % (site["number"], wrong)
                if site["kind"] == "statement":
                    choice += b" else { %s }" % right
                elif site["kind"] != "return":
                    choice = b"(%s else { %s })" % (choice, right)
                out += text[at : site["start"]]
                site["there"] = [len(out), len(out) + len(choice)]
                out += choice
                at = site["end"]
            out += text[at:]
            if path.read_bytes() != out:
                path.write_bytes(out)

    def compile(self) -> dict[str, str]:
        """Leaves out what does not compile, and draws others for it; the programs of the tests."""
        count = {area: len(sites) for area, sites in self.sample.items()}
        while True:
            self.write()
            ended, messages = build(self.work, "check", "--lib")
            spans = [
                span
                for message in messages
                if message["reason"] == "compiler-message" and message["message"]["level"] == "error"
                for span in message["message"]["spans"]
            ]
            if ended.returncode == 0:
                break
            bad = {self.nearest(span)["number"] for span in spans if span["file_name"].startswith("src/")}
            if not bad:
                sys.exit(ended.stderr)
            print(f"{len(bad)} do not compile", flush=True)
            for area in self.sample:
                self.sample[area] = [site for site in self.sample[area] if site["number"] not in bad]
                self.fill(area, count[area])
        ended, messages = build(self.work, "test", "--no-run", "--lib", *(f"--test={name}" for name in PROGRAMS))
        if ended.returncode:
            sys.exit(ended.stderr)
        return {
            message["target"]["name"]: message["executable"]
            for message in messages
            if message["reason"] == "compiler-artifact" and message["executable"] and message["profile"]["test"]
        }

    def nearest(self, span: Site) -> Site:
        """The mutant nearest to the place of a compiler's error."""
        own = [site for site in self.all() if site["file"] == span["file_name"]]

        def distance(site: Site) -> int:
            return max(site["there"][0] - span["byte_end"], span["byte_start"] - site["there"][1])

        return min(own, key=distance) if own else self.all()[0]


def are_apart(site: Site, other: Site) -> bool:
    """True if neither of two places lies within the other."""
    return other["file"] != site["file"] or other["end"] < site["start"] or site["end"] < other["start"]


def tests_of(area: str, programs: dict[str, str]) -> list[list[str]]:
    """Commands of the tests of an area."""
    _, _, units, integration = AREAS[area]
    named = [name.split("/") for name in integration]
    return [[programs["midplane"], *units], *([programs[program], f"{name}::"] for program, name in named)]


def run(commands: list[list[str]], number: int, work: Path, limit: float) -> tuple[str | None, float]:
    """The first test that fails, "time" or None, and the seconds until then."""
    begin = time.monotonic()
    environment = os.environ | {"MUTANT": str(number), "RUST_BACKTRACE": "0", "RAYON_NUM_THREADS": "1"}
    for command in commands:
        process = subprocess.Popen(
            [*command, "--test-threads=1"],
            cwd=work,
            env=environment,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
            stdin=subprocess.DEVNULL,
            text=True,
            start_new_session=True,
        )
        late = threading.Timer(max(0.1, limit - (time.monotonic() - begin)), os.killpg, (process.pid, 9))
        late.start()
        failed, name = None, "?"
        for line in process.stdout or ():
            if line.startswith("test ") and "..." in line:
                name = line.split()[1]
            if line.rstrip().endswith("FAILED") and line.startswith("test ") and "result:" not in line:
                failed = name
                os.killpg(process.pid, 9)
                break
        late.cancel()
        code = process.wait()
        seconds = time.monotonic() - begin
        if failed:
            return failed, seconds
        if code:
            return ("time" if seconds >= limit - 0.1 else f"exit code {code} after {name}"), seconds
    return None, time.monotonic() - begin


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path, nargs="?", default=ROOT / "target/release/mutants", help="target/release/mutants")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--count", type=int, default=200)
    parser.add_argument("--areas", nargs="+", choices=list(AREAS), default=list(AREAS))
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("--docs", type=Path)
    parser.add_argument("--again", action="store_true", help="those only that have survived in the last report")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/mutants"))
    parser.add_argument("--report", action="store_true", help="nothing but the report, of what the last run has found")
    options = parser.parse_args()
    out = options.out.resolve()
    reasons = json.loads(REASONS.read_text()) if REASONS.exists() else []
    if options.report:
        write(json.loads((out / "report.json").read_text()), reasons, out, options)
        return
    out.mkdir(parents=True, exist_ok=True)
    mutants = Mutants(out / "work", options.program.resolve(), options.areas, options.count // len(options.areas), options.seed)
    programs = mutants.compile()
    limits = {}
    for area in options.areas:
        failed, seconds = run(tests_of(area, programs), 0, mutants.work, 3600)
        if failed:
            sys.exit(f"{area}: {failed} fails without a mutant")
        limits[area] = SLOWER * seconds + MORE
        print(f"{area}: {seconds:.0f} s without a mutant", flush=True)

    def one(site: Site) -> None:
        site["caught"], site["seconds"] = run(tests_of(site["area"], programs), site["number"], mutants.work, limits[site["area"]])
        print(f"{site['number']:4} {site['file']}:{site['line']} {site['kind']}: {site['caught'] or 'SURVIVES'} {site['seconds']:.0f} s", flush=True)

    sites = mutants.all()
    before = [site for site in json.loads((out / "report.json").read_text()) if site["caught"]] if options.again else []
    order = []
    for site in sites:
        known = next((old for old in before if same(old, site) and old["kind"] == site["kind"]), None)
        if known:
            site |= {key: known[key] for key in ("caught", "seconds", "again") if key in known}
        else:
            site["again"] = options.again
            order.append(site)
    random.Random(0).shuffle(order)
    with ThreadPoolExecutor(options.jobs) as pool:
        list(pool.map(one, order))
    write(sites, reasons, out, options)


if __name__ == "__main__":
    main()
