"""The rows of history.csv: columns in order, finite numbers, steps of the scene, increments that count."""

from pathlib import Path
from typing import Any

import numpy as np
from midplane.stored import text_rows

from midplane_pipeline.check.faults import Faults

HISTORY_COLUMNS = ["step", "increment", "load_factor", "iterations", "residual"]


def supports(scene: dict[str, Any]) -> set[str]:
    """Columns of the reactions: whatever a step fixes, moves or holds."""
    columns: set[str] = set()
    for step in scene["steps"]:
        for key in ("fix", "displace", "hold"):
            for group, directions in step.get(key, {}).items():
                columns.update(f"reaction:{group}:{direction}" for direction in directions)
    return columns


def read_history(path: Path, scene: dict[str, Any], faults: Faults) -> list[dict[str, Any]]:
    """The rows of history.csv, numbers as numbers."""
    rows: list[dict[str, Any]] = list(text_rows(path))
    columns = list(rows[0]) if rows else []
    probes = list(scene.get("output", {}).get("history", {}))
    wanted = HISTORY_COLUMNS + probes
    faults.expect(columns[: len(wanted)] == wanted, f"{path}: columns are {columns}, should begin with {wanted}")
    reactions = supports(scene)
    faults.expect(
        set(columns[len(wanted) : -1]) == reactions,
        f"{path}: reactions are {columns[len(wanted) : -1]}, should be {sorted(reactions)}",
    )
    if not faults.expect(columns[-1:] == ["energy_balance"], f"{path}: the last column is no energy_balance"):
        return rows
    for number, row in enumerate(rows):
        for column in columns:
            if column == "step":
                continue
            try:
                row[column] = float(row[column])
            except (TypeError, ValueError):
                row[column] = np.nan
            faults.expect(np.isfinite(row[column]), f"{path}: row {number}, {column} is not a finite number")
    steps = [step["name"] for step in scene["steps"]]
    seen = list(dict.fromkeys(row.get("step") for row in rows))
    faults.expect(seen == steps[: len(seen)], f"{path}: steps are {seen}, the scene's are {steps}")
    numbers = [row["increment"] for row in rows]
    faults.expect(numbers == list(range(len(rows))), f"{path}: increments do not count from 0: {numbers}")
    faults.expect(rows and rows[0]["load_factor"] == 0, f"{path}: no row of the unloaded state")
    return rows
