"""midplane beside NGSolve and scikit-fem on the same meshes: times, and a check that all give the same answers.

    python3 benches/peers/compare.py target/release/midplane .venv-peers/bin/python --sizes 10k

Programs take turns, so that a busy machine is busy for all; of several turns the fastest counts. Times are those of whole
processes; `without_imports` is a peer's without the start of Python and the import of its modules. Every peer runs with
one thread and with all, and the faster counts: on a busy machine PARDISO's threads wait for each other. A peer that is not
installed is skipped with a line; so is one that takes longer than `--limit`."""

import argparse
import json
import os
import subprocess
import sys
import time
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import scenes  # noqa: E402

PEERS = {
    "ngsolve-cholesky": ("ngsolve", "with_ngsolve.py", ["sparsecholesky"], ("elastic",)),
    "ngsolve-pardiso": ("ngsolve", "with_ngsolve.py", ["pardiso"], ("elastic", "friction")),
    "ngsolve-umfpack": ("ngsolve", "with_ngsolve.py", ["umfpack"], ("friction",)),
    "skfem-pardiso": ("skfem", "with_skfem.py", [], ("elastic", "friction")),
}
# of the peers' answers: the coupling is the peers' own `pointwise`; `projected` is another discretisation
POINTWISE, PROJECTED = 1e-4, 3e-4


def installed(python, module):
    return subprocess.run([python, "-c", f"import {module}"], capture_output=True).returncode == 0


def environment(python, out, threads):
    """NGSolve finds MKL by its bare name only."""
    libraries = Path(python).absolute().parent.parent / "lib"
    links = out / "mkl"
    links.mkdir(parents=True, exist_ok=True)
    for library in libraries.glob("libmkl_rt.so.*"):
        link = links / "libmkl_rt.so"
        link.unlink(missing_ok=True)
        link.symlink_to(library)
    paths = f"{links.resolve()}:{libraries}"
    counts = {name: str(threads) for name in ("OMP_NUM_THREADS", "MKL_NUM_THREADS", "NGS_NUM_THREADS")}
    return os.environ | counts | {"LD_LIBRARY_PATH": paths}


def peer(python, name, problem, here, out, threads, limit):
    _, script, extra, _ = PEERS[name]
    command = [python, HERE / script, problem, here, here / "peer.vtu", *extra]
    variables = environment(python, out, threads)
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
    }


def ours(program, scene, coupling):
    found = scenes.run(program, scene, f"--set=interfaces.joint.coupling={coupling}")
    names = ("dofs", "seconds", "iterations", "iteration", "peak_bytes_per_dof", "answer", "traction")
    row = {"program": f"midplane, {coupling}"} | {n: found[n] for n in names}
    return row | {"without_imports": row["seconds"], "threads": os.cpu_count()}


def compare(options, python, size, problem):
    """The fastest turn of every program, with the answers compared."""
    here = scenes.folder(options.program.resolve(), size, options.out)
    runs = {
        f"midplane {c}": lambda c=c: ours(options.program.resolve(), here / f"{problem}.json", c)
        for c in ("projected", "pointwise")
    }
    for name, (module, _, _, problems) in PEERS.items():
        if problem in problems and name not in options.skip:
            if not installed(python, module):
                print(f"{name}: skipped, {python} has no module {module}")
                continue
            for threads in options.threads:
                runs[f"{name} {threads}"] = lambda n=name, t=threads: peer(
                    python, n, problem, here, options.out, t, options.limit
                )
    fastest = {}
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
    others = [row for row in rows if not row["program"].startswith("midplane")]
    for row in rows[:2] if others else []:
        allowed = PROJECTED if row["program"].endswith("projected") else POINTWISE
        for what in ("answer", "traction"):
            if row[what] != "" and abs(row[what] / others[0][what] - 1) > allowed:
                two = f"{row['program']} has {row[what]:.8g}, {others[0]['program']} {others[0][what]:.8g}"
                raise SystemExit(f"{size} {problem}: {what}: {two}")
    return rows


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("python", help="a Python with benches/peers/requirements.txt installed")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench"))
    parser.add_argument("--sizes", nargs="+", choices=scenes.SIZES, default=["10k", "100k"])
    parser.add_argument("--scenes", nargs="+", choices=("elastic", "friction"), default=["elastic", "friction"])
    parser.add_argument("--csv", default="peers.csv", help="name of the table in --out")
    parser.add_argument("--repeat", type=int, default=3)
    everything = sorted({1, os.cpu_count()})
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
