"""midplane beside NGSolve, scikit-fem, GetFEM and CalculiX on the same meshes: times, and a check of the answers.

    python -m midplane_pipeline.bench.peers.compare target/release/midplane .venv-peers/bin/python --sizes 10k

Programs take turns, so that a busy machine is busy for all; of several turns the fastest counts. Times are those of whole
processes; `without_imports` is a peer's without the start of Python and the import of its modules. Every peer runs with
one thread and with all, and the faster counts: on a busy machine PARDISO's threads wait for each other. A peer that is not
installed is skipped with a line; so is one that takes longer than `--limit`. A peer runs with the first Python that has
its modules: the given one or the system's, where Debian puts GetFEM."""

import argparse
import itertools
import json
import os
import shutil
import subprocess
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import NamedTuple

from midplane_pipeline.bench import scenes
from midplane_pipeline.bench.scenes import Row
from midplane_pipeline.places import PIPELINE

# of the peers' answers: the coupling is the peers' own `pointwise`; `projected` is another discretisation
POINTWISE, PROJECTED = 1e-4, 3e-4
BOTH = ("elastic", "friction")


class Peer(NamedTuple):
    """Another program: its module, options, scenes, and how it is had."""

    module: str
    options: list[str]
    scenes: tuple[str, ...]
    install: str
    needs: str | None = None  # module of another name
    program: str | None = None
    accuracy: float = POINTWISE


PEERS = {
    "ngsolve-cholesky": Peer("ngsolve", ["sparsecholesky"], ("elastic",), "pip install ngsolve"),
    "ngsolve-pardiso": Peer("ngsolve", ["pardiso"], BOTH, "pip install ngsolve"),
    "ngsolve-umfpack": Peer("ngsolve", ["umfpack"], ("friction",), "pip install ngsolve"),
    "skfem-pardiso": Peer("skfem", [], BOTH, "pip install scikit-fem"),
    "getfem-mumps": Peer("getfem", [], BOTH, "apt-get install python3-getfem python3-meshio"),
    # its contact follows the bodies as they slide: the joint of the friction box loses a thousandth of its length
    "calculix-spooles": Peer("calculix", [], BOTH, "apt-get install calculix-ccx", needs="meshio", program="ccx", accuracy=1e-3),
}


def interpreter(python: str, wanted: Peer) -> str | None:
    """The first Python that has a peer's modules; none where these or its program are missing."""
    if wanted.program and not shutil.which(wanted.program):
        return None
    for candidate in filter(shutil.which, [python, "python3", "/usr/bin/python3"]):
        found = subprocess.run([candidate, "-c", f"import meshio, {wanted.needs or wanted.module}"], capture_output=True)
        if found.returncode == 0:
            return candidate
    return None


def environment(python: str, module: str, out: Path, threads: int) -> dict[str, str]:
    """Variables of a peer's process: threads, the package, and MKL where NGSolve finds it."""
    names = ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "NGS_NUM_THREADS")
    variables = os.environ | {name: str(threads) for name in names} | {"PYTHONPATH": str(PIPELINE)}
    if module != "ngsolve":
        return variables
    # it finds MKL by its bare name only
    libraries = Path(python).absolute().parent.parent / "lib"
    links = out / "mkl"
    links.mkdir(parents=True, exist_ok=True)
    for library in libraries.glob("libmkl_rt.so.*"):
        link = links / "libmkl_rt.so"
        link.unlink(missing_ok=True)
        link.symlink_to(library)
    return variables | {"LD_LIBRARY_PATH": f"{links.resolve()}:{libraries}"}


def peer(python: str, name: str, problem: str, here: Path, out: Path, threads: int, limit: float) -> Row:
    """A run of a peer as a row."""
    wanted = PEERS[name]
    command: list[str | Path] = [python, "-m", f"midplane_pipeline.bench.peers.{wanted.module}", problem, here, here / "peer.vtu", *wanted.options]
    variables = environment(python, wanted.module, out, threads)
    start = time.perf_counter()
    found = subprocess.run(command, env=variables, capture_output=True, text=True, timeout=limit)
    seconds = time.perf_counter() - start
    lines = [line for line in found.stdout.splitlines() if line.startswith("{")]
    if found.returncode != 0 or not lines:
        raise RuntimeError((found.stderr.strip().splitlines() or ["no answer"])[-1])
    told = json.loads(lines[-1])
    spent = told["time"]
    solves = told.get("factorisations", 0)
    return {
        "program": told["peer"],
        "seconds": seconds,
        "without_imports": spent["total"] - spent["import"],
        "threads": threads,
        "iterations": solves,
        "iteration": spent["solve"] / solves if solves else "",
        "peak_bytes_per_dof": told["peak_memory_bytes"] / told["dofs"],
        "answer": told.get("shear", told.get("tip")),
        "traction": told["traction"][1] if "traction" in told else "",
        "accuracy": wanted.accuracy,
    }


def ours(program: Path, scene: Path, coupling: str) -> Row:
    """A run of midplane as a row."""
    found = scenes.run(program, scene, f"--set=interfaces.joint.coupling={coupling}")
    names = ("dofs", "seconds", "iterations", "iteration", "peak_bytes_per_dof", "answer", "traction")
    row = {"program": f"midplane, {coupling}"} | {n: found[n] for n in names}
    return row | {"without_imports": row["seconds"], "threads": os.cpu_count()}


def compare(options: argparse.Namespace, python: str, size: str, problem: str) -> list[Row]:
    """The fastest turn of every program, with the answers compared."""
    here = scenes.folder(options.program.resolve(), size, options.out)
    own = options.program.resolve(), here / f"{problem}.json"
    runs: dict[str, Callable[[], Row]] = {f"midplane {c}": partial(ours, *own, c) for c in ("projected", "pointwise")}
    for name, wanted in PEERS.items():
        if problem in wanted.scenes and name not in options.skip:
            chosen = interpreter(python, wanted)
            if chosen is None:
                print(f"{name}: skipped, not installed ({wanted.install})")
                continue
            for threads in options.threads:
                runs[f"{name} {threads}"] = partial(peer, chosen, name, problem, here, options.out, threads, options.limit)
    fastest: dict[str, Row] = {}
    for _ in range(options.repeat):
        for name, turn in list(runs.items()):
            try:
                row = turn()
            except (RuntimeError, subprocess.TimeoutExpired) as why:
                print(f"{size} {problem} {name}: skipped, {str(why)[-120:]}", flush=True)
                del runs[name]
                continue
            key = row["program"]
            if key not in fastest or row["seconds"] < fastest[key]["seconds"]:
                fastest[key] = row
    first = fastest["midplane, projected"]["seconds"]
    columns = ("program", "threads", "seconds", "without_imports", "iterations", "iteration", "peak_bytes_per_dof")
    rows = [
        {"size": size, "dofs": fastest["midplane, projected"]["dofs"], "scene": problem}
        | {name: row[name] for name in (*columns, "answer", "traction")}
        | {"ratio": row["seconds"] / first, "ratio_without_imports": row["without_imports"] / first}
        for row in fastest.values()
    ]
    for row in rows:
        print(
            f"{size:5} {problem:9} {row['program']:36} {row['seconds']:8.2f} s"
            f" x{row['ratio']:7.2f} ({row['ratio_without_imports']:.2f} without imports)"
            f" {row['iterations']:4} iterations {row['peak_bytes_per_dof']:6.0f} B/dof  {row['answer']:.9g}",
            flush=True,
        )
    agree(list(fastest.values()), f"{size} {problem}")
    return rows


def agree(rows: list[Row], where: str) -> None:
    """Ours have what every peer has, within its accuracy."""
    for row, other in itertools.product(rows[:2], rows[2:]):
        allowed = max(PROJECTED if row["program"].endswith("projected") else POINTWISE, other["accuracy"])
        for what in ("answer", "traction"):
            if row[what] != "" and abs(row[what] / other[what] - 1) > allowed:
                two = f"{row['program']} has {row[what]:.8g}, {other['program']} {other[what]:.8g}"
                raise SystemExit(f"{where}: {what}: {two}")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("python", help="a Python with bench/peers/requirements.txt installed")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench"))
    parser.add_argument("--sizes", nargs="+", choices=scenes.SIZES, default=["10k", "100k"])
    parser.add_argument("--scenes", nargs="+", choices=("elastic", "friction"), default=["elastic", "friction"])
    parser.add_argument("--csv", default="peers.csv", help="name of the table in --out")
    parser.add_argument("--repeat", type=int, default=3)
    everything = sorted({1, os.cpu_count() or 1})
    parser.add_argument("--threads", nargs="+", type=int, default=everything, help="of the peers")
    parser.add_argument("--limit", type=float, default=900, help="seconds that one run may take")
    parser.add_argument("--skip", nargs="*", default=["ngsolve-umfpack"], choices=PEERS)
    options = parser.parse_args()
    rows = []
    for size in options.sizes:
        for problem in options.scenes:
            rows += compare(options, options.python, size, problem)
            scenes.write(options.out / options.csv, rows, scenes.machine())


if __name__ == "__main__":
    main()
