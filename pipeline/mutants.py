#!/usr/bin/env python3
"""Make the sources wrong in one place after the other, and see whether the tests of that room notice.

    mutants.py [--seed 1] [--count 200] [--areas laws] [--again] [-o results/mutants] [--docs docs]
    mutants.py --report [-o results/mutants] [--docs docs]

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

ROOT = Path(__file__).resolve().parent.parent
REASONS = ROOT / "tests/mutants/reasons.json"
# programs of integration tests
PROGRAMS = ["laws", "coupling", "equilibrium", "program"]
# sources, those that are left out, unit tests of a room, and integration tests by program and file, the quick ones first
AREAS = {
    "pairing": (
        ["src/coupling/line/*.rs"],
        ["src/coupling/line/faults.rs"],
        ["coupling::"],
        [
            "coupling/straight", "coupling/joints", "equilibrium/gap", "coupling/ends", "coupling/junctions", "coupling/patch", "coupling/round",
            "coupling/shared_mesh", "coupling/fractures", "coupling/curves", "program/check", "program/warnings",
        ],
    ),
    "projected operator": (
        ["src/coupling/projected.rs", "src/coupling/pointwise.rs", "src/coupling/jump.rs", "src/coupling/slaves.rs", "src/coupling/place.rs", "src/sparse/banded.rs"],
        [],
        ["coupling::", "sparse::"],
        [
            "coupling/straight", "coupling/ends", "coupling/patch", "coupling/round", "equilibrium/gap", "coupling/junctions", "coupling/cantilever",
            "coupling/stiff",
        ],
    ),
    "laws": (
        ["src/law/**/*.rs"],
        [],
        ["law::"],
        [
            "laws/closed_forms", "laws/coulomb", "laws/closing", "laws/extremes", "laws/steps", "laws/tangent", "laws/path", "laws/space", "laws/reference", "coupling/fit",
            "laws/coulomb_way", "laws/invariants", "laws/cohesive", "equilibrium/varying",
        ],
    ),
    "load history": (
        ["src/history/*.rs"],
        # how an equilibrium is sought where Newton's method finds none decides no answer: what is found is one, by the checks of others
        [f"src/history/{name}.rs" for name in ("clock", "memory", "progress", "rest", "stretch", "dissipate", "viscous")],
        ["history::"],
        [
            "equilibrium/loads", "equilibrium/ramp", "equilibrium/steps", "equilibrium/stages", "equilibrium/opening", "equilibrium/own_strains",
            "equilibrium/in_situ", "equilibrium/snapback", "equilibrium/water", "equilibrium/structures", "equilibrium/resume", "equilibrium/cycles",
            "equilibrium/energies", "equilibrium/increments", "program/faults", "equilibrium/tunnel", "program/units",
        ],
    ),
}
SWITCH = '''
/// True for the mutant that the environment names.
pub fn mutant(number: u32) -> bool {
    static CHOSEN: std::sync::OnceLock<u32> = std::sync::OnceLock::new();
    let chosen = || std::env::var("MUTANT").ok().and_then(|text| text.parse().ok()).unwrap_or(0);
    *CHOSEN.get_or_init(chosen) == number
}
'''
# a mutant that takes this many times as long as the right program, and so many seconds more, does not end
SLOWER, MORE = 3.0, 20.0


def build(work, *arguments):
    command = ["cargo", *arguments, "--release", "--locked", "--message-format", "json"]
    # beside the programs of the project, which it would replace
    environment = os.environ | {"CARGO_TARGET_DIR": str(Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "mutants")}
    ended = subprocess.run(command, cwd=work, env=environment, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    messages = [json.loads(line) for line in ended.stdout.splitlines() if line.startswith("{")]
    return ended, messages


class Mutants:
    """A sample of places, written into a copy of the project."""

    def __init__(self, work, program, areas, count, seed):
        self.work = work
        files = subprocess.run(["git", "ls-files", "-z"], cwd=ROOT, check=True, capture_output=True, text=True).stdout.split("\0")
        shutil.rmtree(work, ignore_errors=True)
        for name in filter(None, files):
            (work / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, work / name)
        self.waiting, self.sample = {}, {}
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
    def rank(seed, site):
        """A number by chance that is the site's own."""
        text = " ".join(str(part) for part in (seed, *(site[key] for key in ("file", "function", "kind", "right", "wrong"))))
        return hashlib.sha256(text.encode()).hexdigest()

    def fill(self, area, count):
        """Draws until there are so many, none of them within another."""
        chosen = self.sample[area]
        while len(chosen) < count and self.waiting[area]:
            site = self.waiting[area].pop()
            apart = lambda other: other["file"] != site["file"] or other["end"] < site["start"] or site["end"] < other["start"]
            if all(apart(other) for other in chosen):
                chosen.append(site | {"area": area})

    def all(self):
        return [site for area in self.sample for site in self.sample[area]]

    def write(self):
        """The sources with all mutants in them; every one knows where it stands there."""
        by_file = {}
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

    def compile(self):
        """Leaves out what does not compile, and draws others for it; the programs of the tests."""
        count = {area: len(sites) for area, sites in self.sample.items()}
        while True:
            self.write()
            ended, messages = build(self.work, "check", "--lib")
            spans = [span for message in messages if message["reason"] == "compiler-message" and message["message"]["level"] == "error" for span in message["message"]["spans"]]
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
        made = {message["target"]["name"]: message["executable"] for message in messages if message["reason"] == "compiler-artifact" and message["executable"] and message["profile"]["test"]}
        return made

    def nearest(self, span):
        own = [site for site in self.all() if site["file"] == span["file_name"]]
        distance = lambda site: max(site["there"][0] - span["byte_end"], span["byte_start"] - site["there"][1])
        return min(own, key=distance) if own else self.all()[0]


def tests_of(area, programs):
    _, _, units, integration = AREAS[area]
    integration = [name.split("/") for name in integration]
    return [[programs["midplane"], *units], *([programs[program], f"{name}::"] for program, name in integration)]


def run(commands, number, work, limit):
    """The first test that fails, "time" or None, and the seconds until then."""
    begin = time.monotonic()
    environment = os.environ | {"MUTANT": str(number), "RUST_BACKTRACE": "0", "RAYON_NUM_THREADS": "1"}
    for command in commands:
        process = subprocess.Popen(
            [*command, "--test-threads=1"], cwd=work, env=environment, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, stdin=subprocess.DEVNULL, text=True, start_new_session=True
        )
        late = threading.Timer(max(0.1, limit - (time.monotonic() - begin)), lambda: os.killpg(process.pid, 9))
        late.start()
        failed, name = None, "?"
        for line in process.stdout:
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


def same(reason, site):
    return all(reason[key] == site[key] for key in ("file", "function", "right", "wrong"))


def page(sites, options):
    """The report in Markdown."""
    areas = {site["area"]: None for site in sites}
    lines = ["# Mutants", "", f"Written by `make mutants`: {len(sites)} places, drawn with seed {options.seed}, each made wrong in turn.", ""]
    again = sum(site.get("again", False) for site in sites)
    if again:
        lines[-1:] = [f"{again} of them survived at first; tests were added, and these were tried once more (`make mutants again=1`).", ""]
    lines += ["| area | mutants | caught | of them by time | survive |", "|---|---|---|---|---|"]
    rows = [(area, [site for site in sites if site["area"] == area]) for area in areas] + [("all", sites)]
    for area, own in rows:
        caught = [site for site in own if site["caught"]]
        late = sum(site["caught"] == "time" for site in caught)
        lines.append(f"| {area} | {len(own)} | {len(caught)}, {100 * len(caught) / len(own):.0f} % | {late} | {len(own) - len(caught)} |")
    lines += ["", "Those that survive, and why:", "", "| place | right | wrong | reason |", "|---|---|---|---|"]
    code = lambda text: "`" + " ".join(text.split()).replace("|", "\\|") + "`" if text else ""
    for site in sites:
        if not site["caught"]:
            place = f"{site['file'].removeprefix('src/')}, `{site['function']}`"
            lines.append(f"| {place} | {code(site['right'])} | {code(site['wrong'])} | {site['reason'] or '**none yet**'} |")
    return "\n".join(lines) + "\n"


def main():
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

    def one(site):
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


def write(sites, reasons, out, options):
    """The report, and a line for the terminal."""
    for site in sites:
        site["reason"] = next((reason["reason"] for reason in reasons if same(reason, site)), "")
    (out / "report.json").write_text(json.dumps(sites, indent=1) + "\n")
    (out / "report.md").write_text(page(sites, options))
    if options.docs:
        shutil.copy(out / "report.md", options.docs / "MUTANTS.md")
    caught = sum(1 for site in sites if site["caught"])
    without = sum(1 for site in sites if not site["caught"] and not site["reason"])
    print(f"{caught} of {len(sites)} caught, {100 * caught / len(sites):.0f} %; {without} of the others without a reason")


if __name__ == "__main__":
    main()
