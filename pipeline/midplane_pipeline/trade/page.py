"""Draw what `make trade` has measured: one self-contained HTML page, PNGs, and a summary in Markdown."""

import argparse
import json
from pathlib import Path
from typing import Any

from midplane_pipeline.draw.page_text import page_text

from .figures import (
    answer_figure,
    curve_figure,
    front_figure,
    knob_figure,
    penalty_figure,
    save_fronts,
    save_penalty,
)
from .front import label
from .html import Page
from .tables import (
    REPEATED,
    STAGES,
    cell,
    common_table,
    coupling_claim,
    features_table,
    penalty_claim,
    presets_table,
    refinements_text,
    repeatability_table,
    robust_table,
    robust_text,
    spread_text,
    targets_table,
)


def point_rows(scene: dict[str, Any]) -> Any:
    """The rows of the table of all points, and their classes."""
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


BENCHES = {
    "compared": "Fronts of two campaigns",
    "elastic": "An elastic scene against a way that knows nothing else",
    "precision": "A factor in single precision, refined in double",
}


def benches(folder: Path) -> dict[str, str]:
    """Output of the benches beside the campaign, by heading."""
    files = {title: folder / f"{name}.txt" for name, title in BENCHES.items()}
    return {title: file.read_text() for title, file in files.items() if file.is_file()}


def build(data: dict[str, Any], out: Path) -> None:
    """Writes the page."""
    page = Page("midplane: speed against accuracy")
    m = data["machine"]
    scenes = data["scenes"]
    page.heading("Speed against accuracy", 1)
    page.text(
        f"{m['date']}, {m['cpu']}, {m['cores']} cores, {m['midplane']} at {m['commit']}, gmsh {m['gmsh']}. "
        f"Load average {data['load_before'][0]:.1f} before and {data['load_after'][0]:.1f} after; "
        f'{data["minutes"]:.0f} minutes, form "{data["form"]}".',
        "note",
    )
    page.text(
        "Every point is a process of its own on one thread. Time is the processor's for the whole process without the mesher, which does not count "
        "what others on the machine make it wait; wall clock is beside it in the tables. Points near the front are repeated, and of the repeats the "
        "fastest counts. The error of a run is the largest of the errors named below each figure. Click a column to sort, hover over a point for its "
        "setting.",
        "note",
    )
    page.heading("What to choose")
    page.text(
        "One setting for all scenes: the fastest refinement and element that stay within the target on every one. Refinement 1 is that of the "
        "scenes' own files. The two sides never match: where their edges would, B has one more."
    )
    page.table(*common_table(scenes))
    page.text("The fastest setting of each scene:")
    page.table(*targets_table(scenes))
    page.heading("Presets")
    page.table(*presets_table(scenes))
    page.heading("Repeatability")
    page.text(REPEATED)
    page.table(*repeatability_table(scenes))
    page.text(spread_text(scenes))
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
        if "robust" in scene:
            page.text(robust_text(scene["robust"]))
            page.table(*robust_table(scene["robust"]))
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
    if "refinements" in data:
        d = data["refinements"]
        page.heading("A study of two refinements against single runs")
        page.text(f"{d['points']} points of the strip: {refinements_text(d)}")
    if "features" in data:
        page.heading("What a scene pays for")
        page.table(*features_table(data["features"]))
    for title, text in data["benches"].items():
        page.heading(title)
        page.add(f"<pre>{page_text(text)}</pre>")
    page.write(out / "trade.html")


def main() -> None:
    """The command."""
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
