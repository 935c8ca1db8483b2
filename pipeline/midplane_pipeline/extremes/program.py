"""The program as a stranger runs it: a folder with a scene and meshes in, exit code, messages and files out.

What must never happen is checked at every call: a panic or a signal, a file with NaN after exit code 0, a refusal without a
message, more than 60 s.
"""

from __future__ import annotations

import csv
import io
import json
import os
import re
import subprocess
import tempfile
import time
from pathlib import Path
from typing import Any

import numpy as np
from midplane.stored import Stored
from midplane.vtu import Array, Vtu

LONGEST = 60.0  # seconds of any run
FIELDS_READ = 12  # files of fields looked through for NaN, from the last


class Never(Exception):
    """Something happened that must never happen."""


class Program:
    """The program and a folder for its scenes."""

    def __init__(self, path: Path, folder: Path | str) -> None:
        self.path = str(Path(path).resolve())
        self.folder = Path(folder)
        self.runs = 0

    def place(self) -> Path:
        """A new, empty folder."""
        return Path(tempfile.mkdtemp(prefix="", dir=self.folder))

    def write(self, scene: Any, meshes: Any, place: Path | None = None) -> Path:
        """A folder with a scene and its meshes."""
        place = place or self.place()
        for name, mesh in meshes.items():
            text = mesh if isinstance(mesh, (str, bytes)) else mesh.text()
            (place / f"{name}.msh").write_bytes(text if isinstance(text, bytes) else text.encode())
        text = scene if isinstance(scene, str) else json.dumps(scene, indent=1)
        (place / "scene.json").write_text(text)
        return place

    def run(self, scene: Any, meshes: Any, *more: str, command: str = "run", environment: dict[str, str] | None = None) -> Run:
        """Writes a scene with its meshes and runs it."""
        place = self.write(scene, meshes)
        return self.call(place, [command, ".", "-o", "out", *more], environment)

    def call(self, place: Path, arguments: list[str], environment: dict[str, str] | None = None) -> Run:
        """Runs the program in a folder."""
        self.runs += 1
        start = time.monotonic()
        process = subprocess.Popen(
            [self.path, *arguments],
            cwd=place,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            env={**os.environ, **(environment or {})},
        )
        try:
            out, err = process.communicate(timeout=LONGEST)
        except subprocess.TimeoutExpired:
            process.kill()
            process.communicate()
            raise Never(f"longer than {LONGEST:.0f} s: {' '.join(arguments)}") from None
        seconds = time.monotonic() - start
        run = Run(place, process.returncode, out.decode(), err.decode(errors="replace"), seconds)
        run.check()
        return run

    def law(self, law: dict[str, Any], path: Any, *more: str, extra: dict[str, Any] | None = None) -> Run:
        """Drives one point of a law along a path; the CSV as {column: array}."""
        scene = {
            "plane": "strain",
            "subdomains": {name: {"msh": f"{name}.msh", "material": "rock"} for name in "ab"},
            "materials": {"rock": {"young": 1e4, "poisson": 0.0}},
            "interfaces": {"joint": {"side_a": "a.top", "side_b": "b.bottom", "law": law, **(extra or {})}},
            "steps": [{"name": "none"}],
        }
        place = self.write(scene, {})
        (place / "path.json").write_text(json.dumps({"program": path}))
        return self.call(place, ["law", ".", "joint", "path.json", *more])


class Run:
    """Exit code, texts and files that a call left behind."""

    def __init__(self, place: Path, code: int, out: str, err: str, seconds: float) -> None:
        self.place, self.code, self.stdout, self.stderr, self.seconds = place, code, out, err, seconds
        at = err.find("error: ")
        self.message = err[at:] if at >= 0 else ""

    @property
    def out(self) -> Path:
        """The folder of the results."""
        return self.place / "out"

    @property
    def good(self) -> bool:
        """True if it has succeeded."""
        return self.code == 0

    def wrote(self) -> bool:
        """True if there are results."""
        return self.out.exists()

    def check(self) -> None:
        """Raises what must never happen."""
        if self.code not in (0, 2, 3, 4) or "panicked" in self.stderr:
            raise Never(f"exit code {self.code}: {self.stderr[-400:]}")
        if self.code != 0 and not self.message:
            raise Never(f"exit code {self.code} without a message")
        if self.code == 0 and self.wrote():
            self.check_finite()

    def check_finite(self) -> None:
        """Raises Never where a file holds NaN."""
        texts = [*self.out.glob("*.csv"), *self.out.glob("*.json")]
        for path in texts:
            if re.search(r"\b(nan|inf(inity)?)\b", re.sub(r'"[^"]*"', "", path.read_text()), re.IGNORECASE):
                raise Never(f"{path.name} holds NaN or inf after exit code 0")
        for path in sorted(self.out.glob("fields/*.vtu"))[-FIELDS_READ:]:
            grid = Vtu(path)
            arrays = [*grid.point_data.values(), *grid.cell_data.values()]
            if not all(np.isfinite(array).all() for array in arrays):
                raise Never(f"{path.name} holds NaN or inf after exit code 0")

    def need(self) -> Run:
        """The run itself, if it succeeded."""
        if not self.good:
            raise AssertionError(f"exit {self.code}: {self.message[:300]}")
        return self

    def warnings(self) -> list[str]:
        """The texts of the warnings."""
        return re.findall(r"^warning: (.*)$", self.stderr, re.MULTILINE)

    def warning_codes(self) -> list[str]:
        """Codes of the warnings, such as W03, in order."""
        return sorted(set(re.findall(r"^warning: (W\d+)", self.stderr, re.MULTILINE)))

    def summary(self) -> dict[str, Any]:
        """summary.json."""
        return Stored(self.out).summary()

    def history(self) -> dict[str, Any]:
        """{column: values of the increments}, without the unloaded state; numbers where all are numbers."""
        rows = Stored(self.out).history()[1:]
        return {str(name): rows[name].to_numpy() if rows[name].dtype != object else rows[name].tolist() for name in rows}

    def rows(self) -> dict[str, Any]:
        """The CSV of the law command."""
        return table(self.stdout)

    def fields(self, name: str, number: int = -1) -> Vtu:
        """The file of a body or joint at an increment, the last by default."""
        return Vtu(sorted(self.out.glob(f"fields/{name}_[0-9]*.vtu"))[number])

    def points(self, body: str) -> Array:
        """Nodes of a body."""
        return self.fields(body).points[:, :2]

    def displacement(self, body: str, number: int = -1) -> Array:
        """Displacements of its nodes."""
        return self.fields(body, number).point_data["displacement"][:, :2]

    def stress(self, body: str) -> Array:
        """xx, yy, xy by cell."""
        return self.fields(body).cell_data["stress"][:, [0, 1, 3]]

    def joint(self, name: str = "joint", number: int = -1) -> dict[str, Array]:
        """Point arrays of a joint's law points, with their `place`."""
        grid = self.fields(name, number)
        return {**grid.point_data, "place": grid.points[:, :2]}

    def traction(self, name: str = "joint", number: int = -1) -> Array:
        """Tractions (n, t) of a joint's law points."""
        return self.joint(name, number)["traction"]

    def segments(self, name: str = "joint") -> Array:
        """Arc lengths of start and end of the segments."""
        grid = Vtu(self.out / "midplane" / f"{name}.vtu")
        ends = grid.cells["connectivity"].reshape(-1, 2)
        return grid.point_data["arc_length"][ends[grid.cell_data["kind"] == 0]]


def table(text: str) -> dict[str, Any]:
    """A CSV text as {column: array of numbers, or list of texts}."""
    rows = list(csv.reader(io.StringIO(text)))
    columns: dict[str, Any] = {}
    for i, name in enumerate(rows[0] if rows else []):
        values = [row[i] for row in rows[1:]]
        try:
            columns[name] = np.array([float(value) for value in values])
        except ValueError:
            columns[name] = values
    return columns
