"""Give the program damaged inputs and see that it ends in order: no panic, no signal, no wait, no memory without end.

    python -m midplane_pipeline.robust.damage <midplane> [--count 10000] [--seed 1] [-o results/damage]

Scenes, geometries, meshes, studies and paths of the gallery are damaged at random: bits, bytes, lines and values that are
lost, doubled, exchanged, or replaced by what nobody expects. A scene goes through `check`, which does everything but solve,
a path through `law`, a study through `--count`. Writes report.json, with the inputs of all failures beside it, and ends with exit
code 1 if there is one.
"""

import argparse
import json
import os
import random
import re
import resource
import shutil
import subprocess
import sys
import time
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

from midplane import scene_file

from midplane_pipeline.places import ROOT

SECONDS = 10.0
MEMORY = 1 << 30
# one scene with quadrilaterals, one with a curved joint, one that follows a path, one with water
SCENES = ["compression", "ring", "bar", "dam"]
NUMBERS = ["0", "-1", "1e308", "-1e308", "1e-320", "1e18", "18446744073709551616", "NaN", "Infinity", "-0.0", "0.1", "2", "null", '"x"', "[]", "{}", "true"]
WORDS = ["", " ", "\x1b[2J", "\x00", "\u202e", "a" * 300, "../..", "con", "*", "?", "é", "\ud7ff", '"', "\\", "@0", "~", "lower.top"]


def damaged(whole: bytes, dice: random.Random) -> bytes:
    """A copy with one to three faults."""
    data = bytearray(whole)
    for _ in range(dice.choice([1, 1, 1, 2, 3])):
        size = len(data)
        if not size:
            return bytes(data)
        at, span = dice.randrange(size), dice.choice([1, 2, 8, 64, 512])
        kind = dice.randrange(9)
        if kind == 0:
            data[at] ^= 1 << dice.randrange(8)
        elif kind == 1:
            data[at : at + span] = bytes(dice.randrange(256) for _ in range(min(span, size - at)))
        elif kind == 2:
            del data[at : at + span]
        elif kind == 3:
            data[at:at] = data[at : at + span] * dice.choice([1, 3])
        elif kind == 4:
            del data[at:]
        elif kind == 5:
            numbers = list(re.finditer(rb"-?\d+\.?\d*(?:[eE][-+]?\d+)?", bytes(data)))
            if numbers:
                found = dice.choice(numbers)
                data[found.start() : found.end()] = dice.choice(NUMBERS).encode()
        elif kind == 6:
            texts = list(re.finditer(rb'"([^"\n]*)"', bytes(data)))
            if texts:
                found = dice.choice(texts)
                data[found.start(1) : found.end(1)] = dice.choice(WORDS).encode("utf-8", "surrogatepass")
        elif kind == 7:
            lines = bytes(data).split(b"\n")
            a, b = dice.randrange(len(lines)), dice.randrange(len(lines))
            lines[a], lines[b] = lines[b], lines[a]
            data = bytearray(b"\n".join(lines))
        else:
            lines = bytes(data).split(b"\n")
            lines.pop(dice.randrange(len(lines)))
            data = bytearray(b"\n".join(lines))
    return bytes(data)


class Inputs:
    """Inputs to damage: a folder, the file in it, and the arguments that read it."""

    def __init__(self, program: Path, out: Path) -> None:
        self.all, self.out = [], out
        for name in SCENES:
            folder = out / "good" / name
            shutil.copytree(ROOT / "geo" / name, folder)
            subprocess.run([program, "mesh", folder, "-o", folder / "out", "-q"], check=True)
            scene = scene_file.read(folder / "scene.json")
            meshes = {path.name.rsplit("-", 1)[0]: path for path in sorted((folder / "out/mesh").glob("*.msh"))}
            for part, content in scene["subdomains"].items():
                # meshes stand for themselves, so that a damaged one is read as it is
                if part in meshes:
                    shutil.copy(meshes[part], folder / f"{part}.msh")
                    content.pop("geo", None), content.pop("parameters", None)
                    content["msh"] = f"{part}.msh"
            (folder / "meshes.json").write_text(json.dumps(scene, indent=1))
            shutil.rmtree(folder / "out")
            self.all += [(folder, "scene.json", ["check", "scene.json", "-o", "out"])]
            self.all += [(folder, geo.name, ["check", "scene.json", "-o", "out", "--gmsh-limit", "5", "--gmsh-memory", "1"]) for geo in folder.glob("*.geo")]
            self.all += [(folder, "meshes.json", ["check", "meshes.json", "-o", "out"])] * 3
            self.all += [(folder, msh.name, ["check", "meshes.json", "-o", "out"]) for msh in folder.glob("*.msh")] * 3
        folder = out / "good" / "shear"
        shutil.copytree(ROOT / "geo/shear", folder)
        self.all += [(folder, "path.json", ["law", ".", "joint", "path.json"])] * 6
        self.all += [(folder, "scene.json", ["law", ".", "joint", "path.json"])] * 3
        folder = out / "good" / "strip"
        shutil.copytree(ROOT / "geo/strip", folder)
        self.all += [(folder, "study.json", ["study", "study.json", "--count"])] * 3


def limits() -> None:
    """Keeps a process from taking the machine."""
    resource.setrlimit(resource.RLIMIT_AS, (4 * MEMORY, 4 * MEMORY))
    resource.setrlimit(resource.RLIMIT_CORE, (0, 0))


def run(program: Path, inputs: Inputs, number: int, seed: int) -> tuple[str | None, int | None]:
    """One damaged input: its fault, if there is one, and the time it took."""
    dice = random.Random(f"{seed}/{number}")
    folder, name, arguments = dice.choice(inputs.all)
    place = inputs.out / "work" / str(number)
    place.mkdir(parents=True)
    for path in folder.iterdir():
        if path.is_file() and path.name != name:
            os.link(path, place / path.name)
    (place / name).write_bytes(damaged((folder / name).read_bytes(), dice))
    begin, fault = time.monotonic(), None
    with open(place / "said", "wb") as said:
        process = subprocess.Popen([program, *arguments], cwd=place, stdin=subprocess.DEVNULL, stdout=said, stderr=said, preexec_fn=limits)
        killer = SECONDS + 20
        while True:
            pid, status, used = os.wait4(process.pid, os.WNOHANG)
            if pid or time.monotonic() - begin > killer:
                break
            time.sleep(0.002)
    seconds = time.monotonic() - begin
    if not pid:
        process.kill()
        process.wait()
        fault = f"runs for more than {killer:.0f} s"
    else:
        process.returncode = code = os.waitstatus_to_exitcode(status)
        text = (place / "said").read_bytes()
        control = re.search(rb"[\x00-\x08\x0b-\x1f\x7f]", text)
        if code < 0:
            fault = f"signal {-code}"
        elif b"panicked" in text or code not in (0, 2, 3, 4):
            fault = f"exit code {code}: {text[:300].decode(errors='replace')}"
        elif control:
            fault = f"control character {control[0]!r}"
        elif seconds > SECONDS:
            fault = f"{seconds:.1f} s"
        elif used.ru_maxrss * 1024 > MEMORY:
            fault = f"{used.ru_maxrss / 1024:.0f} MB"
        elif code != 0 and b"error: " not in text:
            fault = f"exit code {code} without a word"
    if fault is None:
        shutil.rmtree(place)
    return fault and f"{number}: {folder.name}/{name}: {fault}", code if pid else None


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--count", type=int, default=10000)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--jobs", type=int, default=os.cpu_count())
    parser.add_argument("-o", "--out", type=Path, default=Path("results/damage"))
    options = parser.parse_args()
    out, program = options.out.resolve(), options.program.resolve()
    shutil.rmtree(out, ignore_errors=True)
    out.mkdir(parents=True)
    inputs, begin = Inputs(program, out), time.monotonic()
    with ThreadPoolExecutor(options.jobs) as pool:
        ends = list(pool.map(lambda number: run(program, inputs, number, options.seed), range(options.count)))
    faults = [fault for fault, _ in ends if fault]
    codes = {str(code): sum(1 for _, other in ends if other == code) for code in sorted({code for _, code in ends if code is not None})}
    report = {"inputs": options.count, "seed": options.seed, "exit codes": codes, "faults": faults, "seconds": round(time.monotonic() - begin)}
    (out / "report.json").write_text(json.dumps(report, indent=1) + "\n")
    print("\n".join(faults[:20]))
    print(f"{options.count} damaged inputs, exit codes {codes}, {len(faults)} faults, {report['seconds']} s")
    sys.exit(1 if faults else 0)


if __name__ == "__main__":
    main()
