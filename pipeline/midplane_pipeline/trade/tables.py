"""Tables and sentences of what `make trade` has measured, for its page and for docs/TRADE.md.

A table is a head and rows of cells; a cell is a text, or a text and the number to sort by."""

import math
import statistics
from typing import Any

from .front import TARGETS, common, fastest_within, label, next_knob, spread

Cell = str | tuple[str, float]  # a text, or a text and the number to sort by
Table = tuple[list[str], list[list[Cell]]]  # head and rows

STAGES = ("read meshes", "bind", "assemble", "order", "factor", "solve", "recover", "write")
COMMON = ["error", "setting", "dofs", "time / draft", "next knob"]


def cell(value: float | None, digits: int = 3) -> Cell:
    """A number, or nothing."""
    return ("", math.inf) if value is None else (f"{value:.{digits}g}", float(value))


def percent(value: float | None, digits: int = 2) -> Cell:
    """A share as a cell."""
    return ("failed", math.inf) if value is None else (f"{100 * value:.{digits}g} %", value)


def seconds(value: float) -> Cell:
    """A time as a cell."""
    return (f"{value:.4f}" if value < 1 else f"{value:.2f}", value)


def relative(time: float, scene: dict[str, Any]) -> float | None:
    """Time over that of `draft`."""
    draft = next((row for row in scene["presets"] if row["labels"]["accuracy"] == "draft"), None)
    return time / draft["time"] if draft else None


def targets_table(scenes: dict[str, Any]) -> Table:
    """For every target and scene: the fastest setting measured, and what the next digit takes."""
    rows = []
    for target in TARGETS:
        for name, scene in scenes.items():
            best = fastest_within(scene["points"], target)
            if best is None:
                rows.append([percent(target), name, "none measured", cell(None), cell(None), cell(None), ""])
                continue
            knob, cost = next_knob(scene["points"], target)
            times = "" if cost is None else f"× {cost:.1f}"
            sizes = [cell(best["dofs"], 7), seconds(best["time"]), cell(relative(best["time"], scene))]
            rows.append([percent(target), name, label(best), *sizes, f"{knob} {times}".strip()])
    return ["error", "scene", "setting", "dofs", "time [s]", "time / draft", "for one digit more"], rows


def reaches(scene: dict[str, Any], target: float) -> bool:
    """True if some refinement and element is within a target."""
    return fastest_within([row for row in scene["points"] if row["phase"] == "factorial"], target) is not None


def common_table(scenes: dict[str, Any]) -> Table:
    """One setting for all scenes: for every target the refinement and element that are within it everywhere."""
    rows = []
    for target in TARGETS:
        found = common(scenes, target)
        if found is None:
            rows.append([percent(target), "none measured holds on all scenes", "", "", ""])
            continue
        (refinement, element), chosen = found
        dofs = [row["dofs"] for row in chosen.values()]
        times = [relative(row["time"], scenes[name]) or math.nan for name, row in chosen.items()]
        following = common(scenes, target / 10)
        if following is None:
            short = [name for name, scene in scenes.items() if not reaches(scene, target / 10)]
            knob = "refinement; none measured is enough for " + " and ".join(short or ["all at once"])
        else:
            moved = [name for name, a, b in zip(("refinement", "element"), (refinement, element), following[0], strict=True) if a != b]
            there = f" → {following[0][1]} × {following[0][0]}"
            knob = " and ".join(moved) + there if moved else "none: this one has it"
        sizes = [f"{min(dofs):.0f} to {max(dofs):.0f}", f"{min(times):.1f} to {max(times):.1f}"]
        rows.append([percent(target), f"{element}, refinement × {refinement}", *sizes, knob])
    return COMMON, rows


def presets_table(scenes: dict[str, Any]) -> Table:
    """Every scene with every preset."""
    rows = [
        [
            name,
            row["labels"]["accuracy"],
            percent(row["error"]),
            ", ".join(f"{number} {percent(error)[0]}" for number, error in row["errors"].items()),
            cell(row["dofs"], 7),
            seconds(row["time"]),
            cell(relative(row["time"], scene), 2),
        ]
        for name, scene in scenes.items()
        for row in scene["presets"]
    ]
    return ["scene", "preset", "error", "of every number", "dofs", "time [s]", "time / draft"], rows


def front_table(scene: dict[str, Any]) -> Table:
    """The points of a front, with the wall clock of their stages."""
    rows = []
    for row in scene["front"]:
        stages = ", ".join(f"{s} {1e3 * row['stages'][s]:.0f}" for s in STAGES if row["stages"].get(s, 0) >= 0.0005)
        times = [seconds(row["time"]), seconds(statistics.median(row["times"])), percent(spread(row))]
        rows.append([label(row), percent(row["error"]), cell(row["dofs"], 7), *times, seconds(row["wall"]), stages])
    head = ["fastest [s]", "median [s]", "spread", "wall clock [s]", "stages, wall clock [ms]"]
    return ["setting", "error", "dofs", *head], rows


REPEATED = (
    "Every point near a front is measured twice, one measurement after the other, in rounds in which all take turns. Spread is "
    "(slowest − fastest) / median of all rounds; a tie is what the median is above the fastest; both are medians over the "
    "points. The two measurements agree at an error if the fastest times that reach it differ by no more than the spread."
)


def repeatability_table(scenes: dict[str, Any]) -> Table:
    """Agreement of two measurements of every scene."""
    rows = []
    for name, scene in scenes.items():
        r = scene["repeatability"]
        if not r["repeated"]:
            rows.append([name, "not repeated: its runs are long", cell(r["points"]), "", "", "", ""])
            continue
        measured = [percent(r["tie"]), percent(r["spread"]), cell(r["largest_ratio"])]
        rows.append([name, cell(r["repeated"]), cell(r["points"]), *measured, f"{r['agree']} of {r['points']}"])
    head = ["scene", "points near the front", "on it", "tie", "spread", "largest ratio of two measurements"]
    return [*head, "errors at which they agree"], rows


def spread_text(scenes: dict[str, Any]) -> str:
    """Scenes whose times vary by more than a tenth."""
    wide = [name for name, scene in scenes.items() if scene["repeatability"]["spread"] > 0.1]
    return f"The spread is above 10 % on {', '.join(wide)}." if wide else "The spread is nowhere above 10 %."


def robust_text(robust: dict[str, Any]) -> str:
    """The sentence above the table of a robust front."""
    how = {
        "perf": "counted by the processor (perf)",
        "valgrind": "counted by valgrind, on the processor that it imitates",
        "none": "not counted: neither perf nor valgrind could",
    }
    rollers = ", as its rollers hold along x or y only" if robust["degrees"] == 90 else ""
    return (
        "Every point of the front again with the nodes of both sides moved along the joint by up to a quarter of an edge, "
        f"three seeds, and with the whole scene turned by {robust['degrees']} degrees{rollers}. Instructions are "
        f"{how[robust['counter']]}."
    )


def robust_table(robust: dict[str, Any]) -> Table:
    """Errors with nodes moved and with the scene turned, and instructions."""
    rows = []
    for point in robust["points"]:
        error, known = point["error"], [e for e in point["offsets"] if e is not None]
        moved = [percent(e) for e in point["offsets"]]
        ratio = max(known) / min(known) if len(known) == len(moved) and min(known) > 0 else None
        turned = None if point["turned"] is None else abs(point["turned"] - error)
        last = [cell(turned, 2) if turned is not None else ("failed", math.inf), cell(point["instructions"])]
        rows.append([label(point), percent(error), *moved, cell(ratio), *last])
    seeds = [f"seed {k + 1}" for k in range(max(len(point["offsets"]) for point in robust["points"]))]
    return ["setting", "error", *seeds, "largest / smallest", "turned − straight", "10⁹ instructions"], rows


def features_table(features: list[dict[str, Any]]) -> Table:
    """Time and memory of the shear box with every feature."""
    rows = [
        [
            f["feature"],
            seconds(f["median"]),
            seconds(f["min"]),
            percent(f["spread"]),
            cell(f["ratio"]),
            cell(f["ratio_of_minima"]),
            cell(f["memory"] / 1e6),
            cell(f["iterations"], 5),
        ]
        for f in features
    ]
    times = ["median [s]", "fastest [s]", "spread", "over springs", "of the fastest"]
    return ["feature", *times, "MB", "iterations"], rows


def refinements_text(d: dict[str, Any]) -> str:
    """A study against single runs, in a sentence."""
    study, runs = d["processor"]
    return (
        f"{d['study']:.1f} s as one study, {d['runs']:.1f} s as single runs ({d['runs_with_meshes']:.1f} s with their meshes "
        f"on disk): ratio {d['ratio']:.2f}. Processor time, mesher included: {study:.1f} and {runs:.1f} s, ratio "
        f"{study / runs:.2f}."
    )


def penalty_claim(rows: list[dict[str, Any]]) -> list[str]:
    """The claim about the couplings, from the data."""
    pairs: dict[Any, dict[str, Any]] = {}
    for row in rows:
        pairs.setdefault((row["stiffness"], row["element"], row["edges"]), {})[row["coupling"]] = row
    stiff = [p for p in pairs.values() if len(p) == 2 and p["projected"]["stiffness_number"] and p["projected"]["stiffness_number"] > 1]
    soft = [p for p in pairs.values() if len(p) == 2 and p not in stiff]

    def ratios(of: list[Any], name: str) -> list[float]:
        return [p["projected"][name] / p["pointwise"][name] for p in of if p["projected"][name] and p["pointwise"][name]]

    def said(of: list[Any], where: str) -> str:
        if not of:
            return f"{where}: not measured."
        errors, times = ratios(of, "error"), ratios(of, "time")
        middle = sorted(times)[len(times) // 2]
        less = sum(r <= 1.0 for r in errors)
        accurate = f"at least as accurate in {less} of {len(errors)} pairs (error ratio {min(errors):.2g} to {max(errors):.2g})"
        return f"{where}: projected is {accurate}; time ratio {middle:.2f} in the median, {min(times):.2f} to {max(times):.2f}."

    return [said(stiff, "K_N h/E above 1"), said(soft, "K_N h/E up to 1")]


def coupling_claim(scenes: dict[str, Any]) -> list[str]:
    """Cost and error of the couplings on every scene at its reference setting."""
    lines = []
    for name, scene in scenes.items():
        sweep = [row for row in scene["points"] if row["phase"] == "sweep"]
        usual = next((row for row in sweep if not row["labels"]), None)
        other = next((row for row in sweep if row["labels"] == {"coupling": "pointwise"}), None)
        if usual and other and usual["error"] and other["error"]:
            ratios = f"time {usual['time'] / other['time']:.2f}, error {usual['error'] / other['error']:.2g}"
            lines.append(f"{name}, K_N h/E = {usual['stiffness_number']:.2g}: projected over pointwise: {ratios}.")
    return lines
