"""Time whole runs of midplane, from .msh on disk to .vtu on disk: a row of CSV for every scene and size.

Two layers of 1 m x 0.5 m of quadrilaterals, 3 edges facing 2. `elastic` is bent by tractions on its ends; `friction` and
`cracking` are the shear box of geo/shear_box, 50 increments of shear, fields stored for the last one. Runs alternate
between the scenes, and of the repeated ones the fastest counts: a slower one has waited for somebody else."""

import argparse
import csv
import json
import os
import platform
import shutil
import subprocess
import time
from pathlib import Path
from typing import Any

from midplane.stored import Stored

from midplane_pipeline.places import ROOT

Row = dict[str, Any]  # a run

SIZES = {"10k": (84, 56), "100k": (268, 178), "400k": (528, 352), "1m": (834, 556)}
SCENES = ("elastic", "friction", "cracking")
STAGES = ("read meshes", "bind", "assemble", "order", "factor", "prepare", "solve", "recover", "write")
SPRINGS = {"type": "elastic", "normal_stiffness": 1.0e7, "tangential_stiffness": 1.0e7}
BENDING = {
    "name": "bending",
    "fix": {"lower.left": ["x", "y"], "upper.left": ["x", "y"]},
    "load": {"lower.right": {"traction": [0.0, -1.0]}, "upper.right": {"traction": [0.0, -1.0]}},
}
PROBES = {"tip": "upper.right.displacement_y", "traction_t": "joint.traction_t@0.5"}


def kept_below(steps: list[Any]) -> list[Any]:
    """The steps of the shear box at a hundredth of its load: nothing cracks or slips."""
    displace = {f"upper.{side}": {"x": 1e-9} for side in ("left", "right")}
    return [steps[0] | {"load": {"upper.top": {"pressure": 0.1}}}, steps[1] | {"displace": displace}]


def folder(program: Path, size: str, out: Path) -> Path:
    """A folder with the meshes `lower.msh` and `upper.msh` of a size and its scenes."""
    here = out / size
    edges = dict(zip(("lower", "upper"), SIZES[size], strict=True))
    numbers = {"edges": 1, "rows": 2}
    sets = [f"--set=subdomains.{body}.parameters.{name}={count // part}" for body, count in edges.items() for name, part in numbers.items()]
    subprocess.run([program, "mesh", ROOT / "geo/shear_box", "-q", "-o", here, *sets], check=True)
    for body in edges:
        newest = max((here / "mesh").glob(f"{body}-*.msh"), key=lambda path: path.stat().st_mtime)
        shutil.copyfile(newest, here / f"{body}.msh")
    for name in SCENES:
        file = "cracking.json" if name == "cracking" else "scene.json"
        scene = json.loads((ROOT / "geo/shear_box" / file).read_text())
        scene.pop("$schema")
        scene["subdomains"] = {body: {"msh": f"{body}.msh", "material": "rock"} for body in edges}
        scene["output"]["fields"] = "last"
        if name == "elastic":
            scene["title"] = "Two layers, bent"
            scene["interfaces"]["joint"]["law"] = SPRINGS
            scene["steps"] = [BENDING]
            scene["output"]["history"] = PROBES
        (here / f"{name}.json").write_text(json.dumps(scene, indent=2))
    return here


def run(program: Path, scene: Path, *options: str) -> Row:
    """One run: its seconds, those of its stages, its counts and the last row of its history."""
    out = scene.parent / "out"
    shutil.rmtree(out, ignore_errors=True)
    start = time.perf_counter()
    subprocess.run([program, "run", "-q", scene, "-o", out, *options], check=True, stderr=subprocess.DEVNULL)
    seconds = time.perf_counter() - start
    results = Stored(out)
    summary, last = results.summary(), results.history().iloc[-1]
    shutil.rmtree(out)
    spent, solution, dofs = summary["time"], summary["solution"], summary["sizes"]["dofs"]
    iterations = solution["iterations"]
    row = {"scene": scene.stem, "dofs": dofs, "seconds": seconds, "factorisations": seconds / spent["factor"]}
    row |= {"iterations": iterations, "iteration": spent["solve"] / iterations if iterations else ""}
    row |= {"peak_bytes_per_dof": summary["peak_memory_bytes"] / dofs}
    row |= {"answer": float(last["shear"] if "shear" in last else last["tip"])}
    row |= {"traction": float(last["traction_t"]) if "tip" in last else ""}
    return row | {stage: spent.get(stage, 0.0) for stage in STAGES}


def processor() -> str:
    """The name of the processor."""
    info = Path("/proc/cpuinfo")
    lines = info.read_text().splitlines() if info.exists() else []
    models = [line.split(":", 1)[1].strip() for line in lines if line.startswith("model name")]
    return models[0] if models else platform.processor() or platform.machine()


def machine() -> str:
    """The machine, in a line."""
    rustc = subprocess.run(["rustc", "--version"], capture_output=True, text=True).stdout.split()
    load = ", ".join(f"{value:.1f}" for value in os.getloadavg())
    date = time.strftime("%Y-%m-%d")
    return f"{date}, {processor()}, {os.cpu_count()} cores, load average {load}, rustc {rustc[1] if rustc else '?'}"


def write(path: Path, rows: list[Row], about: str) -> None:
    """A CSV file with a comment on where it comes from."""
    rows = [{k: f"{v:.9g}" if isinstance(v, float) else v for k, v in row.items()} for row in rows]
    with open(path, "w", newline="") as file:
        file.write(f"# {about}\n")
        table = csv.DictWriter(file, rows[0], lineterminator="\n")
        table.writeheader()
        table.writerows(rows)


def show(row: Row) -> None:
    """Prints a row."""
    per = f"{1e3 * row['iteration']:8.2f} ms" if row["iterations"] else " " * 11
    print(
        f"{row['scene']:9} {row['dofs']:8} {row['seconds']:8.2f} s {row['factorisations']:6.2f} factorisations"
        f" {row['iterations']:4} iterations {per} {row['peak_bytes_per_dof']:6.0f} B/dof  {row['answer']:.6g}",
        flush=True,
    )


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench"))
    parser.add_argument("--sizes", nargs="+", choices=SIZES, default=list(SIZES))
    parser.add_argument("--repeat", type=int, default=3, help="runs of each, of which the fastest counts")
    options = parser.parse_args()
    program = options.program.resolve()
    rows: list[Row] = []
    for size in options.sizes:
        here = folder(program, size, options.out)
        fastest: dict[str, Row] = {}
        for _ in range(options.repeat):
            for name in SCENES:
                row = run(program, here / f"{name}.json")
                if name not in fastest or row["seconds"] < fastest[name]["seconds"]:
                    fastest[name] = row
        for row in fastest.values():
            show(row)
        rows += fastest.values()
        write(options.out / "scenes.csv", rows, machine())


if __name__ == "__main__":
    main()
