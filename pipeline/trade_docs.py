"""Put what `make trade` has measured into docs/trade/: tables in Markdown, points as CSV, the presets' errors for the tests,
and the README's table between its marks."""

import argparse
import json
import shutil
from pathlib import Path

from trade_front import label
from trade_html import number
from trade_page import STAGES, benches, common_table, coupling_claim, penalty_claim, relative, targets_table
from trade_scenes import SCENES

MARKS = ("<!-- trade -->", "<!-- /trade -->")


def table(head, rows):
    """A Markdown table."""
    text = lambda cell: str(cell[0] if isinstance(cell, tuple) else cell)
    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(text(cell) for cell in row) + " |" for row in rows])


def seconds(value):
    return f"{value:.3f}" if value < 10 else f"{value:.1f}"


def presets_table(scenes):
    rows = []
    for name, scene in scenes.items():
        for row in scene["presets"]:
            error = "failed" if row["error"] is None else f"{100 * row['error']:.2g} %"
            rows.append(
                [
                    name,
                    row["labels"]["accuracy"],
                    error,
                    number(row["dofs"], 7),
                    seconds(row["time"]),
                    number(relative(row["time"], scene), 2),
                ]
            )
    return table(["scene", "preset", "error", "dofs", "time [s]", "time / draft"], rows)


def fronts_table(name, scene):
    rows = []
    for row in scene["front"]:
        stages = ", ".join(f"{s} {1e3 * row['stages'][s]:.0f}" for s in STAGES if row["stages"].get(s, 0) >= 0.0005)
        spread = (max(row["times"]) - min(row["times"])) / row["time"]
        rows.append(
            [
                label(row),
                f"{row['error']:.2g}",
                number(row["dofs"], 7),
                seconds(min(row["times"])),
                seconds(row["time"]),
                f"{100 * spread:.0f} %",
                seconds(row["wall"]),
                stages,
            ]
        )
    head = [
        "setting",
        "error",
        "dofs",
        "fastest [s]",
        "median [s]",
        "spread",
        "wall clock [s]",
        "stages, wall clock [ms]",
    ]
    return f"### {name}: {scene['case']}\n\nError: largest of {', '.join(scene['deciding'])}.\n\n{table(head, rows)}\n"


def document(data):
    m, scenes = data["machine"], data["scenes"]
    parts = [
        "# Speed against accuracy\n",
        "Written by `make trade-docs` from what `make trade` has measured; every point is in `trade/*.csv`, the interactive page is\n"
        "`results/trade/trade.html` after `make trade`.\n",
        f"{m['date']}, {m['cpu']}, {m['cores']} cores, {m['midplane']} at {m['commit']}, gmsh {m['gmsh']}. Load average over a minute "
        f"{data['load_before'][0]:.1f} before and {data['load_after'][0]:.1f} after; {data['minutes']:.0f} minutes. Every run is a process of its own on one\n"
        "thread; time is the processor's for the whole process without the mesher, which does not count what others on the\n"
        "machine make it wait. Stages and wall clock wait with the rest of the machine.\n",
        "![Error against time of all scenes](trade/trade_fronts.png)\n",
        "## One setting for all scenes\n",
        table(["error", "setting", "dofs", "time / draft", "next knob"], common_table(scenes)),
        "\nA density of 1 is that of the scenes' own files.\n",
        "## The fastest setting of each scene\n",
        table(
            ["error", "scene", "setting", "dofs", "time [s]", "time / draft", "for one digit more"],
            targets_table(scenes),
        ),
        "\n## Presets\n",
        presets_table(scenes),
        "\n## Fronts\n",
        *[fronts_table(name, scene) for name, scene in scenes.items()],
        "## Repeatability\n",
        "Every front is measured twice, one measurement after the other; spread is (slowest − fastest) / median.\n",
        table(
            [
                "scene",
                "points",
                "same front to within the spread",
                "largest ratio of the medians",
                "median spread",
                "medians within the spread",
            ],
            [
                [
                    n,
                    r["points"],
                    "yes" if r["same_front"] else "no",
                    f"{r['largest_ratio']:.2f}",
                    f"{100 * r['median_spread']:.0f} %",
                    f"{r['within_spread']} of {r['points']}",
                ]
                for n, r in data["repeatability"].items()
            ],
        ),
        "\n## Projected against pointwise\n",
        "![Error of the tractions against stiffness](trade/trade_penalty.png)\n",
        "\n".join(f"- {line}" for line in penalty_claim(data["penalty"]) + coupling_claim(scenes)),
    ]
    if "densities" in data:
        d = data["densities"]
        parts += [
            "\n## A study of two densities\n",
            f"{d['points']} points of [`geo/strip/study.json`](../geo/strip/study.json): {d['study']:.1f} s as one study, {d['runs']:.1f} s as single runs "
            f"({d['runs_with_meshes']:.1f} s with their meshes on disk): ratio {d['ratio']:.2f}. Processor time, mesher included: "
            f"{d['processor'][0]:.1f} and {d['processor'][1]:.1f} s, ratio {d['processor'][0] / d['processor'][1]:.2f}.",
        ]
    if "features" in data:
        rows = [
            [
                f["feature"],
                seconds(f["median"]),
                seconds(f["min"]),
                f"{100 * f['spread']:.0f} %",
                f"{f['ratio']:.2f}",
                f"{f['ratio_of_minima']:.2f}",
                number(f["memory"] / 1e6, 3),
                f["iterations"],
            ]
            for f in data["features"]
        ]
        parts += [
            "\n## What a scene pays for\n",
            f"The shear box, {data['features'][0]['dofs']} dofs, {data['features'][0]['increments']} increments.\n",
            table(
                [
                    "feature",
                    "median [s]",
                    "fastest [s]",
                    "spread",
                    "over springs",
                    "of the fastest",
                    "MB",
                    "iterations",
                ],
                rows,
            ),
        ]
    parts += [f"\n## {title}\n\n```text\n{text.rstrip()}\n```" for title, text in data["benches"].items()]
    return "\n".join(parts) + "\n"


def presets(data):
    """What the tests need to run the presets again."""
    result = {}
    for name, scene in data["scenes"].items():
        of = SCENES[name]
        errors = {row["labels"]["accuracy"]: row["error"] for row in scene["presets"]}
        result[name] = {
            "scene": f"{of.folder}/scene.json",
            "set": of.settings,
            "measures": of.measures,
            "deciding": of.errors,
            "errors": errors,
        }
    return result


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("results", type=Path, help="results/trade")
    parser.add_argument("out", type=Path, help="docs/trade")
    parser.add_argument("readme", type=Path)
    options = parser.parse_args()
    data = json.loads((options.results / "trade.json").read_text())
    data["benches"] = benches(options.results)
    options.out.mkdir(parents=True, exist_ok=True)
    (options.out.parent / "TRADE.md").write_text(document(data))
    (options.out / "presets.json").write_text(json.dumps(presets(data), indent=1) + "\n")
    for name in data["scenes"]:
        for file in sorted((options.results / name).glob("*.csv")):
            shutil.copyfile(file, options.out / f"{name}_{file.stem.replace(' ', '_')}.csv")
    text = options.readme.read_text()
    before, rest = text.split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    head = ["error", "setting", "dofs", "time / draft", "next knob"]
    options.readme.write_text(f"{before}{MARKS[0]}\n{table(head, common_table(data['scenes']))}\n{MARKS[1]}{after}")


if __name__ == "__main__":
    main()
