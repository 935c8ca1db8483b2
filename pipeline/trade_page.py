"""Draw what `make trade` has measured: one self-contained HTML page, PNGs, and a summary in Markdown."""

import argparse
import html
import json
from pathlib import Path

from trade_front import TARGETS, common, fastest_within, label, next_knob
from trade_figures import (
    answer_figure,
    curve_figure,
    front_figure,
    knob_figure,
    penalty_figure,
    save_fronts,
    save_penalty,
)
from trade_html import Page, cell


def point_rows(scene):
    chosen = {tuple(row["settings"]) for row in scene["front"]}
    rows, classes = [], []
    for row in scene["points"]:
        cells = [row["phase"], label(row), row["status"], cell(row["error"])]
        cells += [cell(row["errors"].get(name)) for name in row["errors"]]
        cells += [
            cell(row["time"]),
            cell(row["wall"]),
            cell(row["dofs"], 7),
            cell(row["iterations"], 7),
            cell(row["factor_entries"], 4),
        ]
        cells += [cell(row["stages"].get(s)) for s in STAGES] + [cell((row["peak_memory"] or 0) / 1e6)]
        rows.append(cells)
        failed = row["error"] is None
        classes.append("failed" if failed else "front" if tuple(row["settings"]) in chosen else "")
    return rows, classes


STAGES = ("read meshes", "bind", "assemble", "order", "factor", "solve", "recover", "write")


def relative(time, scene):
    """Time over that of `draft`."""
    draft = next((row for row in scene["presets"] if row["labels"]["accuracy"] == "draft"), None)
    return time / draft["time"] if draft else None


def targets_table(scenes):
    """For every target and scene: the fastest setting measured, and what the next digit takes."""
    rows = []
    for target in TARGETS:
        for name, scene in scenes.items():
            best = fastest_within(scene["points"], target)
            if best is None:
                rows.append([f"{100 * target:g} %", name, "none measured", cell(None), cell(None), cell(None), ""])
                continue
            knob, cost = next_knob(scene["points"], target)
            times = "" if cost is None else f"× {cost:.1f}"
            rows.append(
                [
                    f"{100 * target:g} %",
                    name,
                    label(best),
                    cell(best["dofs"], 7),
                    cell(best["time"]),
                    cell(relative(best["time"], scene)),
                    f"{knob} {times}".strip(),
                ]
            )
    return rows


def reaches(scene, target):
    """Whether some density and element is within a target."""
    return fastest_within([row for row in scene["points"] if row["phase"] == "factorial"], target) is not None


def common_table(scenes):
    """One setting for all scenes: for every target the density and element that are within it everywhere."""
    rows = []
    for target in TARGETS:
        found = common(scenes, target)
        if found is None:
            rows.append((f"{100 * target:g} %", "none measured holds on all scenes", "", "", ""))
            continue
        (density, element), chosen = found
        dofs = [row["dofs"] for row in chosen.values()]
        times = [relative(row["time"], scenes[name]) for name, row in chosen.items()]
        following = common(scenes, target / 10)
        if following is None:
            short = [name for name, scene in scenes.items() if not reaches(scene, target / 10)]
            knob = "density; none measured is enough for " + " and ".join(short or ["all at once"])
        else:
            moved = [name for name, a, b in zip(("density", "element"), (density, element), following[0]) if a != b]
            knob = (
                " and ".join(moved) + f" → {following[0][1]} × {following[0][0]}" if moved else "none: this one has it"
            )
        rows.append(
            (
                f"{100 * target:g} %",
                f"{element}, density × {density}",
                f"{min(dofs):.0f} to {max(dofs):.0f}",
                f"{min(times):.1f} to {max(times):.1f}",
                knob,
            )
        )
    return rows


def penalty_claim(rows):
    """What the data say of the claim about the couplings."""
    pairs = {}
    for row in rows:
        pairs.setdefault((row["stiffness"], row["element"], row["edges"]), {})[row["coupling"]] = row
    stiff = [
        p
        for p in pairs.values()
        if len(p) == 2 and p["projected"]["stiffness_number"] and p["projected"]["stiffness_number"] > 1
    ]
    soft = [p for p in pairs.values() if len(p) == 2 and p not in stiff]

    def ratios(of, name):
        return [
            p["projected"][name] / p["pointwise"][name] for p in of if p["projected"][name] and p["pointwise"][name]
        ]

    def said(of, where):
        if not of:
            return f"{where}: not measured."
        errors, times = ratios(of, "error"), ratios(of, "time")
        middle = sorted(times)[len(times) // 2]
        less = sum(r <= 1.0 for r in errors)
        return f"{where}: projected is at least as accurate in {less} of {len(errors)} pairs (error ratio {min(errors):.2g} to {max(errors):.2g}); time ratio {middle:.2f} in the median, {min(times):.2f} to {max(times):.2f}."

    return [said(stiff, "K_N h/E above 1"), said(soft, "K_N h/E up to 1")]


BENCHES = {
    "elastic": "An elastic scene against a way that knows nothing else",
    "precision": "A factor in single precision, refined in double",
}


def benches(folder):
    """What the benches beside the campaign have printed, by heading."""
    files = {title: folder / f"{name}.txt" for name, title in BENCHES.items()}
    return {title: file.read_text() for title, file in files.items() if file.is_file()}


def coupling_claim(scenes):
    """What the couplings cost and give on every scene at its reference setting."""
    lines = []
    for name, scene in scenes.items():
        sweep = [row for row in scene["points"] if row["phase"] == "sweep"]
        usual = next((row for row in sweep if not row["labels"]), None)
        other = next((row for row in sweep if row["labels"] == {"coupling": "pointwise"}), None)
        if usual and other and usual["error"] and other["error"]:
            ratios = f"time {usual['time'] / other['time']:.2f}, error {usual['error'] / other['error']:.2g}"
            lines.append(f"{name}, K_N h/E = {usual['stiffness_number']:.2g}: projected over pointwise: {ratios}.")
    return lines


def build(data, out):
    page = Page("midplane: speed against accuracy")
    m = data["machine"]
    scenes = data["scenes"]
    page.heading("Speed against accuracy", 1)
    page.text(
        f'{m["date"]}, {m["cpu"]}, {m["cores"]} cores, {m["midplane"]} at {m["commit"]}, gmsh {m["gmsh"]}. Load average {data["load_before"][0]:.1f} before and {data["load_after"][0]:.1f} after; {data["minutes"]:.0f} minutes, form "{data["form"]}".',
        "note",
    )
    page.text(
        "Every point is a process of its own on one thread. Time is the processor's for the whole process without the mesher, which does not count what others on the machine make it wait; wall clock is beside it in the tables. Points on the front are repeated. The error of a run is the largest of the errors named below each figure. Click a column to sort, hover over a point for its setting.",
        "note",
    )
    page.heading("What to choose")
    page.text(
        "One setting for all scenes: the fastest density and element that stay within the target on every one. Density 1 is that of the scenes' own files."
    )
    page.table(["error", "setting", "dofs", "time / draft", "next knob"], common_table(scenes))
    page.text("The fastest setting of each scene:")
    page.table(
        ["error", "scene", "setting", "dofs", "time [s]", "time / draft", "for one digit more"], targets_table(scenes)
    )
    page.heading("Presets")
    rows = [
        [
            name,
            row["labels"]["accuracy"],
            cell(row["error"]),
            cell(row["dofs"], 7),
            cell(row["time"]),
            cell(relative(row["time"], scene)),
        ]
        for name, scene in scenes.items()
        for row in scene["presets"]
    ]
    page.table(["scene", "preset", "error", "dofs", "time [s]", "time / draft"], rows)
    page.heading("Repeatability")
    rows = [
        [
            name,
            r["points"],
            "yes" if r["same_front"] else "no",
            cell(r["largest_ratio"]),
            cell(100 * r["median_spread"]),
            f"{r['within_spread']} of {r['points']}",
        ]
        for name, r in data["repeatability"].items()
    ]
    page.text("Every front is measured twice. Spread is (slowest − fastest) / median of the repeats.")
    page.table(
        [
            "scene",
            "points on the front",
            "same front to within the spread",
            "largest ratio of the two medians",
            "median spread [%]",
            "medians agree to within the spread",
        ],
        rows,
    )
    for name, scene in scenes.items():
        page.heading(f"{name}: {scene['case']}")
        page.figure(front_figure(scene))
        page.text(
            f"Error: largest of {', '.join(scene['deciding'])}. Grey band: the reference is not known better. Crosses at the top failed.",
            "note",
        )
        page.figure(knob_figure(scene))
        if scene["nonlinear"]:
            page.figure(answer_figure(scene))
        for title in sorted({c["title"] for c in scene["curves"]}):
            page.figure(curve_figure(title, [c for c in scene["curves"] if c["title"] == title]))
        rows, classes = point_rows(scene)
        names = [f"error {n}" for n in scene["points"][0]["errors"]]
        page.table(
            [
                "phase",
                "setting",
                "status",
                "error",
                *names,
                "time [s]",
                "wall clock [s]",
                "dofs",
                "iterations",
                "nnz(L)",
                *STAGES,
                "MB",
            ],
            rows,
            classes,
            scroll=True,
        )
    page.heading("Penalty: projected against pointwise")
    page.figure(penalty_figure(data["penalty"]))
    for line in penalty_claim(data["penalty"]) + coupling_claim(scenes):
        page.text(line)
    if "densities" in data:
        d = data["densities"]
        page.heading("A study of two densities against single runs")
        page.text(
            f"{d['points']} points of the strip: {d['study']:.1f} s as one study, {d['runs']:.1f} s as single runs, {d['runs_with_meshes']:.1f} s of single runs with their meshes on disk, ratio {d['ratio']:.2f}. Processor time, mesher included: {d['processor'][0]:.1f} and {d['processor'][1]:.1f} s, ratio {d['processor'][0] / d['processor'][1]:.2f}."
        )
    if "features" in data:
        page.heading("What a scene pays for")
        rows = [
            [
                f["feature"],
                cell(f["median"]),
                cell(f["min"]),
                cell(100 * f["spread"]),
                cell(f["ratio"]),
                cell(f["memory"] / 1e6, 4),
                cell(f["dofs"], 7),
                cell(f["iterations"], 5),
            ]
            for f in data["features"]
        ]
        page.table(
            ["feature", "median [s]", "fastest [s]", "spread [%]", "over springs", "MB", "dofs", "iterations"], rows
        )
    for title, text in data["benches"].items():
        page.heading(title)
        page.add(f"<pre>{html.escape(text)}</pre>")
    page.write(out / "trade.html")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("data", type=Path, help="results/trade/trade.json")
    parser.add_argument("-o", "--out", type=Path, help="folder of the page; that of the data if absent")
    options = parser.parse_args()
    out = options.out or options.data.parent
    out.mkdir(parents=True, exist_ok=True)
    data = json.loads(options.data.read_text())
    data["benches"] = benches(options.data.parent)
    build(data, out)
    save_fronts(data["scenes"], out / "trade_fronts.png")
    save_penalty(data["penalty"], out / "trade_penalty.png")
    print(f"wrote {out / 'trade.html'}")


if __name__ == "__main__":
    main()
