"""Run a study in one process, as the Slurm array of docs/cluster/ and by its Snakefile, and compare the tables.

    python -m midplane_pipeline.robust.cluster <midplane> [-o results/cluster-test]

The array is run by midplane_pipeline.robust.array, which is no Slurm, and loses a task and then half of another task's points on its way; the
Snakefile by Snakemake where --python has it (pip install snakemake). Cells are compared as text, but for times, memory and what
points of one process share. Ends with exit code 1 if one differs.
"""

import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

from midplane.stored import text_rows

from midplane_pipeline.places import ROOT

CLUSTER = ROOT / "docs/cluster"
# 24 points on four meshes, so that shards share files
STUDY = {
    "title": "In shards",
    "scene": "scene.json",
    "axes": {
        "lower": {"parameter": "lower.edges", "values": [3, 5]},
        "upper": {"parameter": "upper.edges", "values": [4, 6]},
        "stiffness": {"key": "interfaces.joint.law.normal_stiffness", "log_range": [1e4, 1e7], "count": 6},
    },
    "measures": {"energy": {"take": "last", "of": "energy.stored"}, "joint": {"take": "last", "of": "joint.traction_n@0.5"}},
}
POINTS = 24


class Cluster:
    """The study and the folder that it runs in."""

    def __init__(self, program: Path, folder: Path) -> None:
        self.program, self.folder = program, folder

    def call(self, *command: object) -> subprocess.CompletedProcess[str]:
        """Runs a command in the folder of the study."""
        environment = os.environ | {"MIDPLANE": str(self.program)}
        return subprocess.run([str(part) for part in command], cwd=self.folder, env=environment, capture_output=True, text=True)

    def done(self, *command: object) -> str:
        """The same for one that must succeed; returns what it printed."""
        ended = self.call(*command)
        if ended.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))}\nended with exit code {ended.returncode}\n{ended.stdout}{ended.stderr}")
        return ended.stdout + ended.stderr

    def study(self, out: str, *more: str) -> str:
        """Runs the study into a folder."""
        return self.done(self.program, "study", "study.json", "-o", out, *more)

    def table(self, out: str) -> list[dict[str, str]]:
        """Its table without what is measured."""
        rows = text_rows(self.folder / out / "study.csv")
        return [{name: cell for name, cell in row.items() if not is_measured(name)} for row in rows]

    def ages(self, out: str) -> dict[str, int]:
        """When its points were written."""
        return {path.name: path.stat().st_mtime_ns for path in (self.folder / out / "points").glob("*.json")}


def is_measured(name: str) -> bool:
    """True of a column that no two runs have alike."""
    return "seconds" in name or name in ("peak_memory_bytes", "reused")


def expect(true: object, what: str) -> None:
    """Tells what holds; ends where it does not."""
    if not true:
        sys.exit(f"failed: {what}")
    print(f"ok      {what}")


def slurm(cluster: Cluster) -> None:
    """The array without one of its tasks; that task, of which half was lost; the array once more; the table."""
    stand_in = [sys.executable, "-m", "midplane_pipeline.robust.array"]
    submit = [CLUSTER / "study.sbatch", "study.json", "slurm"]
    cluster.done(*stand_in, "--array", "0-2", *submit)
    told = cluster.study("slurm", "--collect")
    expect(f"6 of {POINTS} points are missing, the first is 3" in told, "a task that never ran is told")
    cluster.done(*stand_in, "--array", "3", *submit)
    lost = [f"{point:04}.json" for point in (7, 15, 23)]
    before = cluster.ages("slurm")
    for name in lost:
        (cluster.folder / "slurm/points" / name).unlink()
    cluster.done(*stand_in, *submit)
    after = cluster.ages("slurm")
    again = [name for name in sorted(after) if before[name] != after[name]]
    expect(again == lost, "the whole array again runs the lost points and no other")
    cluster.study("slurm", "--collect")
    wrong = cluster.call(*stand_in, "--array", "4", *submit)
    expect(wrong.returncode == 1 and "task 4" in wrong.stderr, "a task beyond the shards fails")


def snakemake(cluster: Cluster, python: str) -> None:
    """The Snakefile, and once more when nothing is left to do."""
    command = [python, "-m", "snakemake", "-s", CLUSTER / "Snakefile", "--cores", "2", "--config"]
    command += ["study=study.json", "out=snakemake", "shards=3", f"midplane={cluster.program}"]
    cluster.done(*command)
    expect("Nothing to be done" in cluster.done(*command), "the Snakefile has nothing left to do")


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("-o", "--out", type=Path, default=Path("results/cluster-test"))
    parser.add_argument("--python", default=sys.executable, help="a Python that has Snakemake")
    chosen = parser.parse_args()
    folder = chosen.out.resolve()
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    for name in ("lower.geo", "upper.geo", "scene.json"):
        shutil.copy(ROOT / "geo/compression" / name, folder)
    (folder / "study.json").write_text(json.dumps(STUDY))
    cluster = Cluster(chosen.program.resolve(), folder)
    cluster.study("whole")
    whole = cluster.table("whole")
    expect(len(whole) == POINTS and all(row["status"] == "done" for row in whole), f"one process runs {POINTS} points")
    slurm(cluster)
    expect(cluster.table("slurm") == whole, "the table of the Slurm array is that of one process")
    if subprocess.run([chosen.python, "-c", "import snakemake"], capture_output=True).returncode == 0:
        snakemake(cluster, chosen.python)
        expect(cluster.table("snakemake") == whole, "the table of the Snakefile is that of one process")
    else:
        print(f"skipped: the Snakefile, for {chosen.python} has no Snakemake (pip install snakemake)")


if __name__ == "__main__":
    main()
