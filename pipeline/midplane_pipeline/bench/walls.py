"""Time walls of bricks of a hundred cells each, fields of the last increment written: how time and memory grow with the bricks, and
beside them a plain sparse Newton's method on scikit-fem with the same law on the same meshes.

    python -m midplane_pipeline.bench.walls target/release/midplane [--peer .venv-peers/bin/python] [--large] [-o results/bench/walls]

Seconds are those of the whole process, the mesher included; of `--repeat` runs the fastest counts. Every run writes into a new
folder, and none is deleted before the last has ended: a file system that has just lost thousands of files makes new ones slowly. Exponents are slopes of the
logarithms from the smallest wall to the largest. `--large` adds 10 000 bricks: elastic, and friction in 10 increments."""

import argparse
import csv
import json
import math
import os
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

from midplane.stored import Stored, text_rows

from midplane_pipeline.places import PIPELINE

from .wall import wall

SIZES = {100: (10, 10), 400: (20, 20), 1000: (32, 31)}
CELLS = (10, 10)
# factorisations of a peer that takes long for one
FEW = 10
COLUMNS = ("law", "bricks", "dofs", "increments", "strategy", "iterations", "seconds", "solve", "bytes_per_brick", "push")


def run(program: Path, folder: Path, out: Path) -> tuple[float, dict[str, Any]]:
    """Seconds of a whole process, and its summary."""
    start = time.perf_counter()
    subprocess.run([program, "run", "-q", folder, "-o", out, "--set=output.fields=last"], check=True)
    seconds = time.perf_counter() - start
    return seconds, Stored(out).summary()


def row_of(options: argparse.Namespace, law: str, shape: tuple[int, int], increments: int, repeat: int) -> dict[str, Any]:
    """A wall's fastest run as a row."""
    folder = options.scenes / f"{law}_{shape[0]}x{shape[1]}"
    folder.mkdir()
    bricks = wall(*shape, folder, CELLS, law, increments)
    outs = [folder / f"out_{k}" for k in range(repeat)]
    seconds, summary = min((run(options.program.resolve(), folder, out) for out in outs), key=lambda r: r[0])
    push = text_rows(outs[0] / "history.csv")[-1]["push"]
    solution = summary["solution"]
    row: tuple[Any, ...] = (law, bricks, summary["sizes"]["dofs"], increments, solution["strategy"], solution["iterations"], round(seconds, 2))
    row += (round(summary["time"]["solve"], 2), round(summary["peak_memory_bytes"] / bricks), push)
    print("  ".join(f"{name} {value}" for name, value in zip(COLUMNS, row, strict=True)), flush=True)
    return dict(zip(COLUMNS, row, strict=True))


def exponent(rows: list[dict[str, Any]], what: str) -> float:
    """Slope of the logarithms from the smallest wall to the largest."""
    first, last = rows[0], rows[-1]
    return math.log(last[what] / first[what]) / math.log(last["bricks"] / first["bricks"])


def peer(python: Path, folder: Path, *how: str) -> dict[str, Any]:
    """Answer of the peer for a wall that midplane has meshed."""
    mesh = next((folder / "out_0" / "mesh").glob("*.msh"))
    command: list[str | Path] = [python, "-m", "midplane_pipeline.bench.peers.wall", folder / "scene.json", mesh, *how]
    environment = os.environ | {"PYTHONPATH": str(PIPELINE)}
    return json.loads(subprocess.run(command, env=environment, check=True, capture_output=True, text=True).stdout.splitlines()[-1])


def beside(python: Path, folder: Path, own: dict[str, Any]) -> None:
    """The peer on a wall with PARDISO to the end, and with SuperLU for a few factorisations: all would take half an hour."""
    told = peer(python, folder, "pardiso")
    apart = abs(told["push"] / float(own["push"]) - 1)
    count, seconds = told["factorisations"], told["time"]["total"]
    print(
        f"{told['peer']}: bricks {own['bricks']}  seconds {seconds:.1f}  factorisations {count}  push apart {apart:.1e};"
        f" midplane is {seconds / own['seconds']:.1f} times faster",
        flush=True,
    )
    told = peer(python, folder, "superlu", str(FEW))
    seconds = told["time"]["total"] + (count / FEW - 1) * told["solve"]
    print(
        f"{told['peer']}: bricks {own['bricks']}  seconds of a factorisation {told['solve'] / FEW:.2f}, {seconds:.0f} s for {count};"
        f" midplane is {seconds / own['seconds']:.0f} times faster",
        flush=True,
    )


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--peer", type=Path, help="a Python with scikit-fem")
    parser.add_argument("--peer-sizes", type=int, nargs="*", default=[100, 400])
    parser.add_argument("--laws", nargs="*", default=["friction", "cracking"])
    parser.add_argument("--sizes", type=int, nargs="*", default=list(SIZES))
    parser.add_argument("--increments", type=int, default=50)
    parser.add_argument("--large", action="store_true")
    parser.add_argument("--repeat", type=int, default=1)
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench/walls"))
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory(dir=options.out) as scenes:
        options.scenes = Path(scenes)
        rows = measured(options)
    with open(options.out / "walls.csv", "w", newline="") as file:
        writer = csv.DictWriter(file, COLUMNS)
        writer.writeheader()
        writer.writerows(rows)


def measured(options: argparse.Namespace) -> list[dict[str, Any]]:
    """All walls that are asked for, and the peer."""
    rows = []
    for law in options.laws:
        of = [row_of(options, law, SIZES[size], options.increments, options.repeat) for size in options.sizes]
        if len(of) > 1:
            names = ("seconds", "solve", "iterations")
            print(f"{law}: exponents " + ", ".join(f"{name} {exponent(of, name):.2f}" for name in names), flush=True)
        rows += of
    if options.large:
        rows.append(row_of(options, "elastic", (100, 100), 1, 1))
        rows.append(row_of(options, "friction", (100, 100), 10, 1))
    if options.peer:
        for size in options.peer_sizes:
            courses, columns = SIZES[size]
            own = next(row for row in rows if row["law"] == "friction" and row["bricks"] in range(size, 2 * size))
            beside(options.peer, options.scenes / f"friction_{courses}x{columns}", own)
    return rows


if __name__ == "__main__":
    main()
