"""Runs of many increments: bytes written against bytes that remain, the last thousand against the first, the price of checkpoints.

    python -m midplane_pipeline.bench.growth <midplane> [--increments 10000] [-o results/bench-growth]

Bytes are those that the process hands to the system (wchar of /proc/<pid>/io). Times of thousands come from the moments at
which lines of increments arrive. Runs with and without checkpoints alternate; the ratio is that of the medians, of
processor time, which other work on the machine disturbs least.
"""

import argparse
import json
import resource
import shutil
import statistics
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

from midplane_pipeline.places import ROOT

SCENES = {
    "linear, fields of every increment": ("compression", ["--set=steps.0.increments={n}", "--set=output.fields=every"]),
    "linear, history only": ("compression", ["--set=steps.0.increments={n}", "--set=output.fields=none"]),
    "friction, history only": ("friction_block", ["--set=steps.1.increments={n}", "--set=output.fields=none"]),
}
PRICED = {
    "linear, 40 increments with fields": (
        "cantilever",
        ["--set=steps.0.increments=40", "--set=output.fields=every", "--set=subdomains.lower.parameters.edges=200"],
    ),
    "cracks along a path": ("dcb", []),
    "cracks of a beam": ("notched_beam", []),
    "parts that come and go": ("lifts", ["--set=output.fields=every"]),
}


def size(folder: Path) -> int:
    """Bytes of the files below a folder."""
    return sum(path.stat().st_size for path in folder.rglob("*") if path.is_file())


def watched(command: list[Any]) -> tuple[int, int, float]:
    """Bytes written, and the seconds of the first and the last thousand increments."""
    process = subprocess.Popen(command, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL, text=True)
    moments, written = [], 0
    for line in process.stdout or ():
        words = line.split()
        if len(words) >= 6 and "/" in words[1]:
            moments.append(time.monotonic())
            if len(moments) % 100 == 0:
                written = bytes_of(process.pid) or written
        elif line.startswith("wrote"):
            written = bytes_of(process.pid) or written
    process.wait()
    thousand = min(1000, len(moments) // 3)
    first, last = moments[thousand] - moments[0], moments[-1] - moments[-1 - thousand]
    return written, len(moments), last / first


def bytes_of(pid: int) -> int | None:
    """Bytes that a process has written so far, if it is still there."""
    try:
        lines = Path(f"/proc/{pid}/io").read_text().splitlines()
        return int(next(line for line in lines if line.startswith("wchar")).split()[1])
    except OSError:
        return None


def processor(command: list[Any]) -> float:
    """Processor time of a command that must succeed [s]."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    subprocess.run(command, check=True, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("--increments", type=int, default=10000)
    parser.add_argument("--repeat", type=int, default=7)
    parser.add_argument("-o", "--out", type=Path, default=Path("results/bench-growth"))
    options = parser.parse_args()
    shutil.rmtree(options.out, ignore_errors=True)
    rows, missed = [], []
    print(f"{'':<36} {'rows':>6} {'written / remain':>17} {'last / first':>13}")
    for name, (scene, more) in SCENES.items():
        folder = options.out / "growth"
        sets = [text.format(n=options.increments) for text in more]
        written, count, ratio = watched([options.program, "run", ROOT / "geo" / scene, "-o", folder, *sets])
        share = written / size(folder)
        rows.append({"scene": name, "rows": count, "written": share, "last_thousand": ratio})
        print(f"{name:<36} {count:>6} {share:>17.2f} {ratio:>13.2f}", flush=True)
        # under friction later increments take more iterations than the first
        slower = options.increments >= 10000 and ratio > 1.2 and name.startswith("linear")
        if share > 3.0 or slower:
            missed.append(name)
        shutil.rmtree(folder)
    print(f"\n{'':<36} {'with / without':>17}")
    for name, (scene, more) in PRICED.items():
        times: dict[str, list[float]] = {"60s": [], "never": []}
        processor([options.program, "mesh", ROOT / "geo" / scene, "-o", options.out / "price", *more])
        for turn in range(options.repeat):
            for often in times if turn % 2 else reversed(times):
                folder = options.out / "price"
                command = [options.program, "run", ROOT / "geo" / scene, "-o", folder, "--threads=1", *more]
                times[often].append(processor([*command, "--checkpoint", often]))
                shutil.rmtree(folder / "checkpoint", ignore_errors=True)
        ratio = statistics.median(times["60s"]) / statistics.median(times["never"])
        shutil.rmtree(options.out / "price")
        rows.append({"scene": name, "checkpoints": ratio})
        print(f"{name:<36} {ratio:>17.3f}", flush=True)
    (options.out / "growth.json").write_text(json.dumps(rows, indent=1))
    if missed:
        sys.exit(f"more than 3 times what remains, or slower at the end: {', '.join(missed)}")


if __name__ == "__main__":
    main()
