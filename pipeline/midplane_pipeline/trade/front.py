"""The Pareto front of a campaign, and its points for who needs so many digits.

A time is not known better than its repeats tell. Points that are closer than their middle is to the fastest are a tie, of
which the more accurate is on the front; and two measurements agree at an error if the times they take to reach it differ by
no more than the spread."""

import math
import statistics
from typing import Any

Row = dict[str, Any]  # a point of a campaign

TARGETS = (0.1, 0.01, 0.001, 0.0001)
# errors within so many uncertainties of the reference say nothing
FLOOR = 3.0
# errors that differ by less are the same, relative
SAME = 0.01
# what a point may be slower than one as accurate and still be run again, relative: after one run, and after two
MARGINS = (1.0, 0.3)


def error_of(row: Row, floor: float) -> float:
    """The error as far as the reference can tell; infinite where the run failed."""
    return math.inf if row["error"] is None else max(row["error"], FLOOR * floor)


def spread(row: Row) -> float:
    """(slowest - fastest) / median of the repeats of a point."""
    return (max(row["times"]) - min(row["times"])) / statistics.median(row["times"])


def tie(row: Row) -> float:
    """Relative distance of the middle of the repeats of a point from the fastest."""
    return statistics.median(row["times"]) / min(row["times"]) - 1


def once(rows: list[Row]) -> list[Row]:
    """The rows without those of the same settings."""
    return list({tuple(row["settings"]): row for row in reversed(rows)}.values())[::-1]


def candidates(rows: list[Row], floor: float, margin: float) -> list[Row]:
    """The rows that may be on the front once they are repeated: none as accurate is faster by more than the margin."""
    rows = [row for row in once(rows) if row["error"] is not None]

    def beaten(row: Row) -> bool:
        good = (other for other in rows if error_of(other, floor) <= error_of(row, floor))
        return any(other["time"] * (1 + margin) < row["time"] for other in good)

    return sorted((row for row in rows if not beaten(row)), key=lambda row: row["time"])


def front(rows: list[Row], floor: float, tied: float) -> list[Row]:
    """The way from fast to accurate: the fastest row that is more accurate than the last one, or the best of its ties."""
    chosen, left = [], [row for row in once(rows) if row["error"] is not None]
    while left:
        fastest = min(row["time"] for row in left)
        ties = [row for row in left if row["time"] <= (1 + tied) * fastest]
        least = (1 + SAME) * min(error_of(row, floor) for row in ties)
        best = min((row for row in ties if error_of(row, floor) <= least), key=lambda row: row["time"])
        chosen.append(best)
        left = [row for row in left if (1 + SAME) * error_of(row, floor) < error_of(best, floor)]
    return chosen


def fastest_within(rows: list[Row], target: float) -> Row | None:
    """The fastest row within a target."""
    good = [row for row in rows if row["error"] is not None and row["error"] <= target]
    return min(good, key=lambda row: row["time"], default=None)


def label(row: Row, reference: str = "the scene as it is") -> str:
    """A setting in words."""
    return ", ".join(f"{name} {value}" for name, value in row["labels"].items()) or reference


def next_knob(rows: list[Row], target: float) -> tuple[str, float | None]:
    """The knob that differs between the fastest row within a target and the fastest within a tenth of it."""
    here, there = fastest_within(rows, target), fastest_within(rows, target / 10)
    if here is None or there is None:
        return "none left", None
    names = [n for n in {**here["labels"], **there["labels"]} if here["labels"].get(n) != there["labels"].get(n)]
    return (", ".join(names), there["time"] / here["time"]) if names else ("none: this one has it", None)


def common(scenes: dict[str, Row], target: float) -> tuple[Any, dict[str, Row]] | None:
    """The refinement and element that are within a target on all scenes at the least time, relative to each scene's best."""
    by_setting: dict[Any, dict[str, Row]] = {}
    for name, scene in scenes.items():
        best = {}
        for row in scene["points"]:
            if row["phase"] == "factorial" and row["error"] is not None and row["error"] <= target:
                best[(row["labels"]["refinement"], row["labels"]["element"])] = row
        for key, row in best.items():
            by_setting.setdefault(key, {})[name] = row
    everywhere = {key: rows for key, rows in by_setting.items() if len(rows) == len(scenes)}
    if not everywhere:
        return None

    def cost(rows: dict[str, Row]) -> float:
        return sum(math.log(row["time"]) for row in rows.values())

    key = min(everywhere, key=lambda key: cost(everywhere[key]))
    return key, everywhere[key]
