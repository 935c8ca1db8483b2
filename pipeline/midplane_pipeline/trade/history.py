"""Histories of a campaign's runs."""

from pathlib import Path
from typing import Any

from midplane.errors import ResultsError
from midplane.stored import Stored

from .scenes import Scene


def read_history(folder: Path) -> dict[str, list[float]]:
    """The columns of the history of a run that are numbers; none if it is not there."""
    try:
        frame = Stored(folder).history()
    except ResultsError:
        return {}
    return {str(name): column.tolist() for name, column in frame.select_dtypes("number").items()}


def curves(scene: Scene, campaign: Any) -> list[dict[str, Any]]:
    """Histories of the refinements and increments of the sweep."""
    result = []
    for title, x, y in scene.plotted:
        for k, row in enumerate(campaign.points):
            if row["phase"] != "sweep" or list(row["labels"]) not in (["refinement"], ["increments"]):
                continue
            columns = read_history(campaign.out / "sweep" / "out" / "points" / f"{k:04}")
            if x in columns and y in columns:
                result.append({"title": title, "labels": row["labels"], "x": columns[x], "y": columns[y]})
    return result
