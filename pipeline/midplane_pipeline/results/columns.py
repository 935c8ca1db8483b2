"""Columns of history.csv as arrays."""

import sys
from collections.abc import Iterable
from pathlib import Path

import numpy as np
from midplane.names import unknown
from midplane.stored import Stored
from midplane.vtu import Array

Columns = dict[str, Array]


def read(folder: Path) -> Columns:
    """The columns of history.csv by name, from the unloaded state on."""
    frame = Stored(folder).history()
    return {str(name): frame[name].to_numpy(float) for name in frame if name != "step"}


def read_columns(folder: Path, columns: Iterable[str]) -> Columns:
    """The same, once it is known to have the columns that are to be drawn."""
    run = read(folder)
    for name in columns:
        if name not in run:
            sys.exit(unknown(folder / "history.csv", "column", name, run))
    return run


def until(run: Columns, x: str, last: float) -> Columns:
    """The rows before the abscissa passes a value for the first time; there a row between the two."""
    beyond = np.flatnonzero(np.sign(last) * run[x] > abs(last))
    if not len(beyond) or beyond[0] == 0:
        return run
    end = beyond[0]
    share = (last - run[x][end - 1]) / (run[x][end] - run[x][end - 1])
    return {name: np.append(row[:end], row[end - 1] + share * (row[end] - row[end - 1])) for name, row in run.items()}
