"""What a folder of results holds: history, summary, fields of the rows that are stored, mid-planes.

All files are complete at every moment, also while a run goes on, so they are read anew whenever they are asked for.
"""

from __future__ import annotations

import csv
import json
import operator
import os
import re
from collections import Counter
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
import pandas as pd

from .errors import ResultsError
from .names import unknown
from .vtu import LINE, Array, Vtu

if TYPE_CHECKING:
    import pyvista

NEAR = 3  # segments before and behind the one in which a place should lie
FIELD = re.compile(r"(.+)_(\d{4,})\.vtu")


class Stored:
    """The results in one folder."""

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)

    def history(self) -> pd.DataFrame:
        """history.csv, a row per increment from the unloaded state on; "step" is text, everything else numbers."""
        return pd.read_csv(self.file("history.csv"), dtype={"step": str}, keep_default_na=False, na_values={}, encoding="utf-8")

    def summary(self) -> dict[str, Any]:
        """summary.json; docs/RESULTS.md says what it has."""
        content: dict[str, Any] = json.loads(self.file("summary.json").read_text(encoding="utf-8"))
        return content

    def file(self, name: str) -> Path:
        """A file of the folder. Raises ResultsError where there is none."""
        path = self.folder / name
        if not path.is_file():
            known = "the run has not come so far, or it was another program" if self.folder.is_dir() else "there is no such folder"
            raise ResultsError(f"{path}: no results here; {known}")
        return path

    def files(self) -> dict[tuple[str, int], Path]:
        """The files of fields by the name of a subdomain or interface, and the row."""
        folder = self.folder / "fields"
        matched = [FIELD.fullmatch(name) for name in os.listdir(folder)] if folder.is_dir() else []
        keys = sorted((found[1], int(found[2]), found[0]) for found in matched if found)
        return {(name, row): folder / file for name, row, file in keys}

    def rows(self) -> list[int]:
        """The rows of the history of which all fields are there; those of the newest may still come."""
        counts = Counter(row for _, row in self.files())
        most = max(counts.values(), default=0)
        return sorted(row for row, count in counts.items() if count == most)

    def row(self, row: int) -> int:
        """A stored row; negative numbers count from the last one. Raises ResultsError."""
        try:
            row = operator.index(row)
        except TypeError:
            raise ResultsError(f'{self.folder}: a row is a number, such as -1 for the last, or "all" of an interface, not {row!r}') from None
        rows = self.rows()
        if row in rows:
            return row
        if -len(rows) <= row < 0:
            return rows[row]
        there = f"{rows[0]} to {rows[-1]}" if rows and len(rows) == rows[-1] - rows[0] + 1 else ", ".join(map(str, rows)) or "none"
        raise ResultsError(f'{self.folder}: no fields of row {row}; there are those of {there} ("output.fields" of the scene says which)')

    def field(self, name: str, row: int) -> Vtu:
        """The fields of a subdomain or interface."""
        path = self.folder / "fields" / f"{name}_{row:04}.vtu"
        if not path.is_file():
            names = dict.fromkeys(name for name, _ in self.files())
            if name in names:
                raise ResultsError(f"{path}: there is no such file, or not yet")
            raise ResultsError(unknown(self.folder, "subdomain or interface", name, names))
        return Vtu(path)

    def grid(self, name: str, row: int) -> pyvista.UnstructuredGrid:
        """The same as PyVista has it."""
        return self.field(name, row).grid()

    @property
    def sizes(self) -> dict[str, Any]:
        """Subdomains and interfaces with their counts. Where a run has no summary yet, those of which there are files."""
        if (self.folder / "summary.json").is_file():
            sizes: dict[str, Any] = self.summary()["sizes"]
            return sizes
        names = dict.fromkeys(name for name, _ in self.files())
        interfaces = {path.stem for path in (self.folder / "midplane").glob("*.vtu")}
        return {"subdomains": {name: {} for name in names if name not in interfaces}, "interfaces": {name: {} for name in names if name in interfaces}}

    def interfaces(self) -> list[str]:
        """The names of the interfaces."""
        return list(self.sizes["interfaces"])

    def subdomains(self) -> list[str]:
        """The names of the subdomains."""
        return list(self.sizes["subdomains"])

    def interface(self, name: str) -> str:
        """The name, if there is such an interface. Raises ResultsError."""
        if name not in self.interfaces():
            raise ResultsError(unknown(self.folder, "interface", name, self.interfaces()))
        return name

    def midplane(self, name: str) -> Midplane:
        """The geometry of an interface."""
        return Midplane(self.folder / "midplane" / f"{self.interface(name)}.vtu")

    def along(self, name: str, rows: list[int]) -> pd.DataFrame:
        """The law points of an interface in rows of the history, one below the other; docs/RESULTS.md has the arrays.

        Index (row, point); `s` is the fraction of the length that probes count by, 0 at one end and 1 at the other, `distance`
        the length from there; arrays of several components are NAME_n, NAME_t or NAME_x, NAME_y."""
        midplane, parts = self.midplane(name), []
        for row in rows:
            vtu = self.field(name, row)
            columns = dict(zip(["x", "y", "z"], vtu.points.T, strict=True))
            for field, values in vtu.point_data.items():
                for component, column in zip(vtu.point_data.components(field), values.reshape(len(values), -1).T, strict=True):
                    columns[f"{field}_{component}" if component else field] = column
            parts.append(columns)
        distance = midplane.distance(np.column_stack([parts[0][x] for x in "xyz"])) if parts else np.array([])
        count = len(distance)
        place = {"s": np.tile(distance / midplane.length, len(rows)), "distance": np.tile(distance, len(rows))}
        names = [column for column in (parts[0] if parts else {}) if not (midplane.plane and (column == "z" or column.endswith("_z")))]
        columns = place | {column: np.concatenate([part[column] for part in parts]) for column in names}
        index = pd.MultiIndex.from_arrays([np.repeat(rows, count), np.tile(np.arange(count), len(rows))], names=["row", "point"])
        frame = pd.DataFrame(columns, index=index)
        sides = self.sizes["interfaces"].get(name, {}).get("subdomains", [None, None])
        frame.attrs = {"interface": name, "side_a": sides[0], "side_b": sides[1], "start": midplane.start, "end": midplane.end, "length": midplane.length}
        return frame


class Midplane:
    """The line between the two sides: `points`, ends of its `segments` and of the `cells` of its grid, `parents` of the segments."""

    def __init__(self, path: Path) -> None:
        vtu = Vtu(path)
        kind = vtu.cell_data["kind"]
        lines = vtu.cells["connectivity"].reshape(-1, 2)
        self.plane = bool((vtu.cells["types"] == LINE).all())
        self.points: Array = vtu.points[:, :2]
        self.segments: Array = lines[kind == 0]
        self.cells: Array = lines[kind == 1]
        self.parents: Array = np.column_stack([vtu.cell_data["edge_a"], vtu.cell_data["edge_b"]])[kind == 0]

    @property
    def start(self) -> tuple[float, float]:
        """The end that probes call @0."""
        x, y = self.points[self.segments[0, 0]].tolist()
        return x, y

    @property
    def end(self) -> tuple[float, float]:
        """The end that probes call @1."""
        x, y = self.points[self.segments[-1, 1]].tolist()
        return x, y

    @property
    def length(self) -> float:
        """Of all segments."""
        return float(np.linalg.norm(np.diff(self.points[self.segments], axis=1), axis=2).sum())

    def distance(self, places: Array) -> Array:
        """The length from @0 to places that follow each other on the line, or near it."""
        ends = self.points[self.segments]
        along = ends[:, 1] - ends[:, 0]
        lengths = np.linalg.norm(along, axis=1)
        begin = np.append(0.0, np.cumsum(lengths))
        # about where: by the way from place to place; then the nearest of the segments there
        steps = np.diff(places[:, :2], axis=0, prepend=np.array([self.start]))
        about = np.cumsum(np.linalg.norm(steps, axis=1))
        about *= begin[-1] / max(begin[-1], float(about[-1])) if len(about) else 1.0
        found, nearest = np.zeros(len(places)), np.full(len(places), np.inf)
        at = np.searchsorted(begin, about) - 1
        for off in range(-NEAR, NEAR + 1):
            k = np.clip(at + off, 0, len(lengths) - 1)
            share = ((places[:, :2] - ends[k, 0]) * along[k]).sum(axis=1) / lengths[k] ** 2
            share = np.clip(share, 0.0, 1.0)
            away = np.linalg.norm(places[:, :2] - ends[k, 0] - share[:, None] * along[k], axis=1)
            closer = away < nearest
            found, nearest = np.where(closer, begin[k] + share * lengths[k], found), np.where(closer, away, nearest)
        return found


def text_rows(path: Path) -> list[dict[str, str]]:
    """The rows of a CSV file as they are written."""
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))
