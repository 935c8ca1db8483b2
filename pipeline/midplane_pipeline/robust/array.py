"""Run the tasks of a Slurm array script on this machine, some at a time: a stand-in to try a script with, and no Slurm.

    python -m midplane_pipeline.robust.array [--array 0-3] [--at-once 2] <script> [arguments ...]

It reads --array, --cpus-per-task, --job-name and --output from the #SBATCH lines, sets the SLURM_ variables of a task and starts the
script with the shell of its first line. Nothing is queued, and no limit on time, memory or cores is kept. Ends with exit code 1 if a
task failed and says which.
"""

import argparse
import os
import re
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

JOB = "1"


def options(script: Path) -> dict[str, str]:
    """{name: value} of the lines `#SBATCH --name=value` before the first command."""
    found = {}
    for line in script.read_text().splitlines():
        if line.strip() and not line.startswith("#"):
            break
        if match := re.match(r"#SBATCH\s+--([a-z-]+)[=\s]\s*(\S+)", line):
            found[match[1]] = match[2]
    return found


def task_ids(array: str) -> list[int]:
    """Numbers of "0-3", "1,4", "0-6:2"; the limit of "0-9%2" is left to --at-once."""
    ids: list[int] = []
    for part in array.split("%")[0].split(","):
        ends, _, step = part.partition(":")
        first, _, last = ends.partition("-")
        ids.extend(range(int(first), int(last or first) + 1, int(step or 1)))
    return ids


def run(task: int, ids: list[int], script: Path, arguments: list[str], of: dict[str, str]) -> int:
    """Runs a task; returns its exit code."""
    environment = {
        "SLURM_JOB_ID": JOB,
        "SLURM_JOB_NAME": of.get("job-name", script.name),
        "SLURM_ARRAY_JOB_ID": JOB,
        "SLURM_ARRAY_TASK_ID": str(task),
        "SLURM_ARRAY_TASK_COUNT": str(len(ids)),
        "SLURM_ARRAY_TASK_MIN": str(min(ids)),
        "SLURM_ARRAY_TASK_MAX": str(max(ids)),
        "SLURM_SUBMIT_DIR": os.getcwd(),
    }
    if "cpus-per-task" in of:
        environment["SLURM_CPUS_PER_TASK"] = of["cpus-per-task"]
    log = of.get("output", "slurm-%A_%a.out")
    for pattern, value in {"%x": environment["SLURM_JOB_NAME"], "%A": JOB, "%a": str(task)}.items():
        log = log.replace(pattern, value)
    shell = script.read_text().splitlines()[0].removeprefix("#!").split()
    with open(log, "w") as output:
        command = [*shell, str(script), *arguments]
        return subprocess.run(command, env=os.environ | environment, stdout=output, stderr=subprocess.STDOUT).returncode


def main() -> int:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("script", type=Path)
    parser.add_argument("arguments", nargs=argparse.REMAINDER)
    parser.add_argument("--array", help="in place of that of the script")
    parser.add_argument("--at-once", type=int, default=2, metavar="N", help="tasks side by side")
    chosen = parser.parse_args()
    of = options(chosen.script)
    array = chosen.array or of.get("array")
    if not array:
        parser.error(f"{chosen.script} has no line #SBATCH --array=...")
    ids = task_ids(array)
    with ThreadPoolExecutor(chosen.at_once) as pool:
        codes = list(pool.map(lambda task: run(task, ids, chosen.script, chosen.arguments, of), ids))
    failed = {task: code for task, code in zip(ids, codes, strict=True) if code != 0}
    for task, code in failed.items():
        print(f"task {task} ended with exit code {code}", file=sys.stderr)
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
