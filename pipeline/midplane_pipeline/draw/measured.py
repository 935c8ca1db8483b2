"""Measured values beside a computed curve: the band between the lowest and the highest specimen, from a CSV in the scene's folder.

The CSV has the columns x, low, high; lines that begin with # say where they come from. An empty cell is a value that was not
measured: the band ends there and the other bound goes on as a line.
"""

import csv
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from midplane.pictures.page import GREY, PALE


@dataclass
class Measured:
    """Lowest and highest value at every abscissa, NaN where there is none."""

    x: np.ndarray
    low: np.ndarray
    high: np.ndarray


def read(path: Path) -> Measured:
    """The bounds of one file, in order of x."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    if not rows or set(rows[0]) != {"x", "low", "high"}:
        raise SystemExit(f"{path}: the columns should be x, low, high")
    columns = {name: np.array([float(row[name] or "nan") for row in rows]) for name in rows[0]}
    order = np.argsort(columns["x"], kind="stable")
    return Measured(**{name: values[order] for name, values in columns.items()})


def draw_measured(axis: Axes, measured: Measured, source: str) -> None:
    """The band and its bounds beneath the curves, one entry of the key."""
    look: dict[str, Any] = {"color": PALE, "alpha": 0.55, "linewidth": 0, "zorder": 0.5}
    axis.fill_between(measured.x, measured.low, measured.high, label=f"measured, {source}", **look)
    for bound in (measured.low, measured.high):
        axis.plot(measured.x, bound, color=GREY, linewidth=0.7, zorder=0.6)
