"""Histories of a campaign's runs."""

from midplane.errors import ResultsError
from midplane.stored import Stored


def read_history(folder):
    """The columns of the history of a run that are numbers; none if it is not there."""
    try:
        frame = Stored(folder).history()
    except ResultsError:
        return {}
    return {name: column.tolist() for name, column in frame.select_dtypes("number").items()}


def curves(scene, campaign):
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
