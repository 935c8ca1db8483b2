"""Compare the fronts of two campaigns: results/trade/trade.json and an earlier one.

At the error of every point on either front, the fastest time that reaches it in one campaign is compared with that in the
other, over all points that were repeated. They agree if the two differ by no more than the spread of the repeats, the larger
of the two campaigns' for that scene. Ends with code 1 if they disagree anywhere. What is printed is kept as compared.txt
beside the first file."""

import argparse
import json
import math
import statistics
import sys
from pathlib import Path

from .front import SAME, Row, error_of, label, once, spread, tie


def together(a: Row, b: Row) -> Row:
    """A point measured twice: that of the faster one, with all times."""
    return (a if a["time"] <= b["time"] else b) | {"times": a["times"] + b["times"]}


def ratios(front: list[Row], rows: list[Row], others: list[Row], floor: float) -> list[float]:
    """For every point of a front: how many times longer the slower of two measurements takes to its error."""

    def time(measured: list[Row], error: float) -> float:
        times = [row["time"] for row in measured if error_of(row, floor) <= (1 + SAME) * error]
        return min(times, default=math.inf)

    found = []
    for row in front:
        a, b = (time(measured, error_of(row, floor)) for measured in (rows, others))
        found.append(max(a, b) / min(a, b) if math.isfinite(max(a, b)) else math.inf)
    return found


def repeatability(front: list[Row], halves: list[list[Row]], pooled: list[Row], floor: float) -> Row:
    """Agreement of the two measurements of a campaign at its own front."""
    found, most = ratios(front, halves[0], halves[1], floor), statistics.median(spread(row) for row in pooled)
    repeated = len(pooled) if halves[0] is not halves[1] else 0
    return {
        "points": len(front),
        "repeated": repeated,
        "tie": statistics.median(tie(row) for row in pooled),
        "spread": most,
        "largest_ratio": max(found),
        "agree": sum(ratio - 1 <= most for ratio in found),
    }


def compare(name: str, a: Row, b: Row) -> tuple[list[str], bool]:
    """Lines that say how a scene of two campaigns compares, and whether they agree."""
    floor = a["floor"]
    pooled = [[together(*rows) for rows in zip(*scene["repeated"], strict=True)] for scene in (a, b)]
    most = max(scene["repeatability"]["spread"] for scene in (a, b))
    levels = sorted(once(a["front"] + b["front"]), key=lambda row: row["error"], reverse=True)
    found = ratios(levels, pooled[0], pooled[1], floor)
    apart = [(row, ratio) for row, ratio in zip(levels, found, strict=True) if ratio - 1 > most]
    worst = max(range(len(found)), key=found.__getitem__)
    same = {tuple(row["settings"]) for row in a["front"]} & {tuple(row["settings"]) for row in b["front"]}
    lines = [
        f"{name:10} {'no ' if apart else 'yes'}  {len(found) - len(apart):3} of {len(found):3} errors"
        f"  spread {100 * most:4.0f} %  worst × {found[worst]:.2f} at {levels[worst]['error']:.2g}"
        f"  settings on both {len(same)} of {len(a['front'])} and {len(b['front'])}"
    ]
    lines += [f"{'':10}      × {ratio:.2f} at {row['error']:.2g}: {label(row)}" for row, ratio in apart]
    return lines, not apart


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("campaigns", type=Path, nargs=2, help="two files trade.json")
    options = parser.parse_args()
    a, b = (json.loads(file.read_text()) for file in options.campaigns)
    if set(a["scenes"]) != set(b["scenes"]):
        sys.exit("the campaigns have not the same scenes")
    text, agree = [], True
    for of in (a, b):
        machine, load = of["machine"], of["load_before"][0]
        text.append(f"{machine['date']}, {machine['cpu']}, {machine['commit']}, form {of['form']}, load {load:.1f}")
    text.append("scene      within the spread")
    for name in a["scenes"]:
        lines, same = compare(name, a["scenes"][name], b["scenes"][name])
        text += lines
        agree &= same
    print("\n".join(text))
    (options.campaigns[0].parent / "compared.txt").write_text("\n".join(text) + "\n")
    sys.exit(0 if agree else 1)


if __name__ == "__main__":
    main()
