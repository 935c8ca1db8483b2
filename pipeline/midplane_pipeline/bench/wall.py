"""Time walls of many bricks by every form of the equations: bricks of their own meshes, friction in all joints, pushed
sideways under their weight. Prints seconds, iterations and the estimated operations of every form, and the push.

    python -m midplane_pipeline.bench.wall target/release/midplane --rows 10 20"""

import argparse
import itertools
import json
import subprocess
import time
from pathlib import Path

from midplane.stored import Stored

LENGTH, HEIGHT, CELLS = 0.25, 0.1, (5, 2)
STIFFNESS = {"normal_stiffness": 1e5, "tangential_stiffness": 4e4}
LAWS = {
    "friction": {"type": "coulomb", **STIFFNESS, "friction_coefficient": 0.6},
    "cracking": {
        "type": "cracking",
        **STIFFNESS,
        "tensile_strength": 0.05,
        "cohesion": 0.1,
        "tan_friction": 0.6,
        "fracture_energy_i": 1e-5,
        "fracture_energy_iia": 1e-4,
        "dilatancy_stress": 0,
    },
    "elastic": {"type": "elastic", **STIFFNESS},
}
PRESSURE, SHEAR = 0.2, 0.06


def wall(
    rows: int,
    columns: int,
    folder: Path,
    mesh: tuple[int, int] = CELLS,
    law: str = "friction",
    increments: int = 10,
    pressure: float = PRESSURE,
    shear: float = SHEAR,
) -> int:
    """A scene of a wall in running bond; half bricks at the ends of every second row. `mesh`: cells along and across a brick."""
    geo = ["// bricks with points of their own"]
    bricks: list[tuple[int, int]] = []
    for row in range(rows):
        edges = [LENGTH * k for k in range(columns + 1)]
        if row % 2:
            edges = [0.0] + [LENGTH * (k + 0.5) for k in range(columns)] + [LENGTH * columns]
        for left, right in itertools.pairwise(edges):
            n = 4 * len(bricks) + 1
            corners = [(left, row), (right, row), (right, row + 1), (left, row + 1)]
            geo += [f"Point({n + i}) = {{{x}, {y * HEIGHT}, 0}};" for i, (x, y) in enumerate(corners)]
            geo += [f"Line({n + i}) = {{{n + i}, {n + (i + 1) % 4}}};" for i in range(4)]
            cells = mesh[0] if right - left > 0.6 * LENGTH else mesh[0] // 2 + 1
            geo.append(f"Transfinite Curve {{{n}, {n + 2}}} = {cells + 1 + row % 2};")
            geo.append(f"Transfinite Curve {{{n + 1}, {n + 3}}} = {mesh[1] + 1};")
            s = len(bricks) + 1
            geo.append(f"Curve Loop({s}) = {{{n}:{n + 3}}}; Plane Surface({s}) = {{{s}}};")
            geo.append(f"Transfinite Surface {{{s}}}; Recombine Surface {{{s}}};")
            geo.append(f'Physical Surface("brick_{s}") = {{{s}}};')
            if row == 0:
                geo.append(f'Physical Curve("foot_{s}") = {{{n}}};')
            if row == rows - 1:
                geo.append(f'Physical Curve("top_{s}") = {{{n + 2}}};')
            bricks.append((s, row))
    (folder / "wall.geo").write_text("\n".join(geo) + "\n")
    tops = [s for s, row in bricks if row == rows - 1]
    scene = {
        "subdomains": {f"brick_{s}": {"geo": "wall.geo", "surface": f"brick_{s}", "material": "brick"} for s, _ in bricks},
        "plane": "strain",
        "materials": {"brick": {"young": 1e4, "poisson": 0.15, "density": 2e-3}},
        "interfaces": {"joints": {"between": ["brick_*", "brick_*"], "law": LAWS[law]}},
        "steps": [
            {
                "name": "weight",
                "gravity": [0.0, -9.81],
                "fix": {f"brick_{s}.foot_{s}": ["x", "y"] for s, row in bricks if row == 0},
                "load": {f"brick_{s}.top_{s}": {"pressure": pressure} for s in tops},
            },
            {
                "name": "push",
                "increments": increments,
                "load": {f"brick_{s}.top_{s}": {"traction": [shear, -pressure]} for s in tops},
            },
        ],
        "output": {"fields": "none", "history": {"push": f"brick_{tops[0]}.top_{tops[0]}.displacement_x"}},
    }
    (folder / "scene.json").write_text(json.dumps(scene))
    return len(bricks)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench/wall"))
    parser.add_argument("--rows", nargs="+", type=int, default=[5, 10, 20])
    parser.add_argument("--forms", nargs="+", default=["condensed", "blocks", "plain"])
    options = parser.parse_args()
    for rows in options.rows:
        folder = options.out / str(rows)
        folder.mkdir(parents=True, exist_ok=True)
        bricks = wall(rows, rows, folder)
        for form in options.forms:
            out = folder / form
            command = [options.program.resolve(), "run", "-q", folder, "-o", out, f"--set=solution.strategy={form}"]
            start = time.perf_counter()
            subprocess.run(command, check=True)
            seconds = time.perf_counter() - start
            results = Stored(out)
            summary, push = results.summary(), float(results.history()["push"].iloc[-1])
            solution, spent = summary["solution"], summary["time"]
            work = (solution["operations"] or {}).get(form)
            print(
                f"{bricks:4} bricks {summary['sizes']['dofs']:7} dofs {form:9} {seconds:7.2f} s, factor"
                f" {spent['factor']:.2f}, solve {spent['solve']:.2f} s, {solution['iterations']:3} iterations,"
                f" estimate {work or float('nan'):.1e}, push {push:.12e}",
                flush=True,
            )


if __name__ == "__main__":
    main()
