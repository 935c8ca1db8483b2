"""Put what `make damage-test` and `make fuzz` have found into docs/ROBUSTNESS.md.

python -m midplane_pipeline.robust.docs <results/damage/report.json> <results/fuzz/report.json> <docs/ROBUSTNESS.md>
"""

import json
import sys
from pathlib import Path

ABOUT = {
    "msh": "bytes as a mesh file; its groups, boundary, parts and the quality of its cells",
    "scene": "text as a scene; the message is short and clean",
    "study": "text as a study of a scene: its points, measures and their scenes",
    "path": "an interface and a path, as text or made from bytes: laws of all kinds with parameters up to 1e9 times their usual size, driven with error "
    "control and by backward Euler (by backward Euler only where the law is warned of)",
    "expression": "text as a formula; its values and derivatives",
    "bind": "text as a scene, bound to coarse meshes of the gallery",
    "pairing": "two arbitrary chains of edges; what is joined has weights that sum to the length, orthonormal frames, and the jump of a translation",
}
EXITS = {"0": "accepted", "2": "refused as bad input", "3": "no equilibrium", "4": "refused by the environment"}


def main() -> None:
    """The command."""
    damage, fuzz = (json.loads(Path(path).read_text()) for path in sys.argv[1:3])
    lines = ["# Robustness", "", "Written by `make robustness-docs` after `make damage-test` and `make fuzz`.", ""]
    lines += ["## Damaged inputs through the program", "", "```", "make damage-test", "```", ""]
    lines += [
        f"{damage['inputs']} scenes, geometries, meshes, studies and paths of the gallery with one to three faults each (seed {damage['seed']}), "
        "through `check`, `law` and `study --count`. A fault is a panic, a signal, more than 10 s, more than 1 GB, a control character on the terminal, "
        "or a refusal without a word.",
        "",
    ]
    lines += ["| exit code | inputs |", "|---|---|"] + [f"| {code}, {EXITS.get(code, '')} | {count} |" for code, count in damage["exit codes"].items()]
    lines += ["", f"{len(damage['faults'])} faults."]
    runs, faults = sum(target["runs"] for target in fuzz["targets"]), sum(len(target["faults"]) for target in fuzz["targets"])
    lines += ["", "## Inputs made by libFuzzer", "", "```", "make fuzz", "make fuzz minutes=60", "```", ""]
    lines += [
        f"{runs} executions in the process, with counters in every branch and the checks of a debug build. A fault is a panic (a broken promise of the "
        f"target among them), a signal, more than 10 s for one input, or more than 1 GB.",
        "",
    ]
    lines += ["| target | what it tries | executions | most memory | slowest | faults |", "|---|---|---|---|---|---|"]
    for target in fuzz["targets"]:
        name, used = target["target"], f"{target['most memory [MB]']} MB | {target['slowest [s]']} s"
        lines.append(f"| `{name}` | {ABOUT[name]} | {target['runs']} | {used} | {len(target['faults'])} |")
    lines += ["", f"{faults} faults.", "", "[MUTANTS.md](MUTANTS.md) tells how many mistakes in the sources the tests notice."]
    Path(sys.argv[3]).write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
