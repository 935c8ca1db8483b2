"""Put what `make trade` has measured into docs/trade/: tables in Markdown, points as CSV, the presets' errors for the tests,
and the README's table between its marks."""

import argparse
import json
import shutil
from pathlib import Path
from textwrap import fill
from typing import Any

from .page import benches
from .scenes import SCENES
from .tables import (
    REPEATED,
    common_table,
    coupling_claim,
    features_table,
    front_table,
    penalty_claim,
    presets_table,
    refinements_text,
    repeatability_table,
    robust_table,
    robust_text,
    spread_text,
    targets_table,
)

# columns of the text
WIDTH = 120
MARKS = ("<!-- trade -->", "<!-- /trade -->")


def table(head: list[str], rows: list[Any]) -> str:
    """A Markdown table."""

    def text(cell: Any) -> str:
        return str(cell[0] if isinstance(cell, tuple) else cell)

    lines = ["| " + " | ".join(head) + " |", "|" + "---|" * len(head)]
    return "\n".join(lines + ["| " + " | ".join(text(cell) for cell in row) + " |" for row in rows])


def scene_text(name: str, scene: dict[str, Any]) -> str:
    """The front of a scene and, in the full form, what it hangs on."""
    parts = [f"### {name}: {scene['case']}\n", f"Error: largest of {', '.join(scene['deciding'])}.\n"]
    parts += [table(*front_table(scene)), ""]
    if "robust" in scene:
        parts += [fill(robust_text(scene["robust"]), WIDTH) + "\n", table(*robust_table(scene["robust"])), ""]
    return "\n".join(parts)


def document(data: dict[str, Any]) -> str:
    """docs/TRADE.md."""
    m, scenes = data["machine"], data["scenes"]
    parts = [
        "# Speed against accuracy\n",
        "Written by `make trade-docs` from what `make trade` has measured; every point is in `trade/*.csv`, the interactive page is\n"
        "`results/trade/trade.html` after `make trade`.\n",
        f"{m['date']}, {m['cpu']}, {m['cores']} cores, {m['midplane']} at {m['commit']}, gmsh {m['gmsh']}. Load average over a minute "
        f"{data['load_before'][0]:.1f} before and {data['load_after'][0]:.1f} after; {data['minutes']:.0f} minutes. Every run is a process of its own on one\n"
        "thread; time is the processor's for the whole process without the mesher, which does not count what others on the\n"
        "machine make it wait; of repeats the fastest counts. Stages and wall clock wait with the rest of the machine.\n",
        "![Error against time of all scenes](trade/trade_fronts.png)\n",
        "## One setting for all scenes\n",
        table(*common_table(scenes)),
        "\nA refinement of 1 is that of the scenes' own files. The two sides never match: where their edges would, B has one more.\n",
        "## The fastest setting of each scene\n",
        table(*targets_table(scenes)),
        "\n## Presets\n",
        table(*presets_table(scenes)),
        "\n## Fronts\n",
        *[scene_text(name, scene) for name, scene in scenes.items()],
        "## Repeatability\n",
        fill(REPEATED, WIDTH) + "\n",
        table(*repeatability_table(scenes)),
        f"\n{spread_text(scenes)}",
        "\n## Projected against pointwise\n",
        "![Error of the tractions against stiffness](trade/trade_penalty.png)\n",
        "\n".join(f"- {line}" for line in penalty_claim(data["penalty"]) + coupling_claim(scenes)),
    ]
    if "refinements" in data:
        d = data["refinements"]
        parts += [
            "\n## A study of two refinements\n",
            fill(f"{d['points']} points of geo/strip/study.json: {refinements_text(d)}", WIDTH),
        ]
    if "features" in data:
        first = data["features"][0]
        parts += [
            "\n## What a scene pays for\n",
            f"The shear box, {first['dofs']} dofs, {first['increments']} increments.\n",
            table(*features_table(data["features"])),
        ]
    parts += [f"\n## {title}\n\n```text\n{text.rstrip()}\n```" for title, text in data["benches"].items()]
    return "\n".join(parts) + "\n"


def presets(data: dict[str, Any]) -> dict[str, Any]:
    """Presets as the tests run them again."""
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
            "long": bool(of.swept),
        }
    return result


def main() -> None:
    """The command."""
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
    for stale in options.out.glob("*.csv"):
        stale.unlink()
    for name in data["scenes"]:
        for file in sorted((options.results / name).glob("*.csv")):
            shutil.copyfile(file, options.out / f"{name}_{file.stem.replace(' ', '_')}.csv")
    text = options.readme.read_text()
    before, rest = text.split(MARKS[0])
    after = rest.split(MARKS[1])[1]
    options.readme.write_text(f"{before}{MARKS[0]}\n{table(*common_table(data['scenes']))}\n{MARKS[1]}{after}")


if __name__ == "__main__":
    main()
