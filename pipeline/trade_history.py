"""Histories of a campaign's runs."""

import csv


def read_history(file):
    """The columns of a history.csv that are numbers; none if it is not there."""
    try:
        with open(file) as text:
            rows = list(csv.DictReader(text))
    except OSError:
        return {}
    columns = {}
    for name in rows[0] if rows else ():
        try:
            columns[name] = [float(row[name]) for row in rows]
        except ValueError:
            continue
    return columns


def curves(scene, campaign):
    """Histories of the refinements and increments of the sweep."""
    result = []
    for title, x, y in scene.plotted:
        for k, row in enumerate(campaign.points):
            if row["phase"] != "sweep" or list(row["labels"]) not in (["refinement"], ["increments"]):
                continue
            columns = read_history(campaign.out / "sweep" / "out" / "points" / f"{k:04}" / "history.csv")
            if x in columns and y in columns:
                result.append({"title": title, "labels": row["labels"], "x": columns[x], "y": columns[y]})
    return result
