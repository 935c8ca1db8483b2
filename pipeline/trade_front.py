"""Which points of a campaign are on its Pareto front, and what they mean for who needs so many digits."""

import csv
import math

TARGETS = (0.1, 0.01, 0.001, 0.0001)
# errors within so many uncertainties of the reference say nothing
FLOOR = 3.0


def error_of(row, floor):
    """The error as far as the reference can tell; infinite where the run failed."""
    return math.inf if row["error"] is None else max(row["error"], FLOOR * floor)


def front(rows, floor):
    """The rows that no faster row equals or beats, from fast to slow."""
    best, chosen, seen = math.inf, [], set()
    for row in sorted(rows, key=lambda row: (row["time"], error_of(row, floor))):
        error = error_of(row, floor)
        key = tuple(row["settings"])
        if error < best and key not in seen:
            best = error
            seen.add(key)
            chosen.append(row)
    return chosen


def fastest_within(rows, target):
    """The fastest row within a target."""
    good = [row for row in rows if row["error"] is not None and row["error"] <= target]
    return min(good, key=lambda row: row["time"], default=None)


def label(row, reference="the scene as it is"):
    """A setting in words."""
    return ", ".join(f"{name} {value}" for name, value in row["labels"].items()) or reference


def next_knob(rows, target):
    """The knob that differs between the fastest row within a target and the fastest within a tenth of it."""
    here, there = fastest_within(rows, target), fastest_within(rows, target / 10)
    if here is None or there is None:
        return "none left", None
    names = [n for n in {**here["labels"], **there["labels"]} if here["labels"].get(n) != there["labels"].get(n)]
    return (", ".join(names), there["time"] / here["time"]) if names else ("none: this one has it", None)


def common(scenes, target):
    """The density and element that are within a target on all scenes at the least time, relative to each scene's best."""
    by_setting = {}
    for name, scene in scenes.items():
        best = {}
        for row in scene["points"]:
            if row["phase"] == "factorial" and row["error"] is not None and row["error"] <= target:
                best[(row["labels"]["density"], row["labels"]["element"])] = row
        for key, row in best.items():
            by_setting.setdefault(key, {})[name] = row
    everywhere = {key: rows for key, rows in by_setting.items() if len(rows) == len(scenes)}
    if not everywhere:
        return None
    cost = lambda rows: sum(math.log(row["time"]) for row in rows.values())
    key = min(everywhere, key=lambda key: cost(everywhere[key]))
    return key, everywhere[key]


def known(file, columns):
    """Columns of a history, or none if they are not there."""
    try:
        with open(file) as text:
            rows = list(csv.DictReader(text))
        return [[float(row[name]) for row in rows] for name in columns]
    except (OSError, KeyError, ValueError):
        return None
