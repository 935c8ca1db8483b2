"""Time every strategy beside `auto`: scenes of the gallery, the masonry of a panel, walls of bricks up to a thousand parts, two large bodies.

    python -m midplane_pipeline.bench.strategies target/release/midplane

Prints seconds without those of the mesher and of writing files, which no strategy changes, the fastest of three runs where they are
short, what `auto` took, and its ratio to the fastest. A strategy that takes twice as long as `auto` is stopped. Ends with 1 where `auto` is above the limit."""

import argparse
import subprocess
import sys
from pathlib import Path

from midplane.stored import Stored

from .wall import wall

SHEAR_BOX = [("lower", "edges", 84), ("lower", "rows", 42), ("upper", "edges", 56), ("upper", "rows", 28)]
FORMS = ("condensed", "blocks", "plain")
# seconds below which a run is repeated, and those that a difference must have to be one
SHORT, RESOLVED = 2.0, 0.02


def seconds(program: Path, scene: Path, sets: list[str], out: Path, form: str, patience: float | None) -> tuple[float, str]:
    """Seconds of a run, and what it took; infinite where it ends early."""
    command: list[str | Path] = [program, "run", "-q", scene, "-o", out, f"--set=solution.strategy={form}", "--set=output.fields=none", *sets]
    best, taken = float("inf"), "-"
    for _ in range(3):
        try:
            subprocess.run(command, check=True, timeout=patience, capture_output=True)
        except (subprocess.TimeoutExpired, subprocess.CalledProcessError):
            return best, taken
        summary = Stored(out).summary()
        taken = summary["solution"]["strategy"]
        time = summary["time"]
        best = min(best, time["total"] - time.get("mesh", 0.0) - time["write"])
        if best > SHORT:
            break
    return best, taken


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, help="target/release/midplane")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench/strategies"))
    parser.add_argument("--walls", nargs="*", default=["3x3", "8x8", "12x12", "32x31"], help="rows x columns")
    parser.add_argument("--scenes", nargs="*", default=sorted(str(s.parent) for s in Path("geo").glob("*/scene.json")))
    parser.add_argument("--finer", type=int, nargs="*", default=[3, 7], help="two bodies: geo/shear_box with so many times its edges")
    parser.add_argument("--limit", type=float, default=1.5)
    options = parser.parse_args()
    scenes: list[tuple[str, Path, list[str]]] = [(Path(scene).name, Path(scene), []) for scene in options.scenes]
    for size in options.walls:
        folder = options.out / f"wall_{size}"
        folder.mkdir(parents=True, exist_ok=True)
        rows, columns = map(int, size.split("x"))
        wall(rows, columns, folder)
        scenes.append((folder.name, folder, []))
    for times in options.finer:
        sets = [f"--set=subdomains.{body}.parameters.{name}={count * times}" for body, name, count in SHEAR_BOX]
        scenes.append((f"shear_box x {times}", Path("geo/shear_box"), sets))
    above = []
    print(f"{'scene':16} {'auto':>9} {'taken':>10} " + " ".join(f"{form:>10}" for form in FORMS) + "  auto / fastest")
    for name, scene, sets in scenes:
        out = options.out / name
        own, taken = seconds(options.program.resolve(), scene, sets, out, "auto", None)
        patience = max(2 * own, 2.0)
        spent = [seconds(options.program.resolve(), scene, sets, out, form, patience)[0] for form in FORMS]
        best = min(own, *spent)
        if own > options.limit * best and own - best > RESOLVED:
            above.append(name)
        cells = " ".join(f"{t:10.3f}" for t in spent)
        print(f"{name:16} {own:9.3f} {taken:>10} {cells}  {own / best:.2f}", flush=True)
    print(f"above {options.limit}: {', '.join(above) or 'none'}")
    sys.exit(bool(above))


if __name__ == "__main__":
    main()
