"""Draw two results of a scene beside each other, on one scale of lengths, colours and thicknesses.

    python -m midplane_pipeline.draw.compare geo/cantilever/scene.json projected=results/cantilever \\
        pointwise=results/cantilever_pointwise --field stress

Writes RESULTS/pictures/beside_FIELD.png of the first results, or the file after -o. Both show the last increment stored,
or those of --row; a run may be compared with itself: --row 10 --row 20.
"""

import argparse
from pathlib import Path

import matplotlib.pyplot as plt
from midplane import scene_file
from midplane.pictures import page, plane
from midplane.pictures.displacement import draw_displacement
from midplane.pictures.interfaces import draw_interfaces
from midplane.pictures.principal import draw_principal_stress
from midplane.pictures.results import Results

from midplane_pipeline.results.told import told

from . import view_options

FIELDS = {"displacement": draw_displacement, "stress": draw_principal_stress, "interfaces": draw_interfaces}


def labelled(text: str) -> tuple[str, Path]:
    """[LABEL=]RESULTS, the label by default the name of the folder."""
    label, _, folder = text.rpartition("=")
    return label or Path(folder).name, Path(folder)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/cantilever/scene.json")
    parser.add_argument("results", type=labelled, nargs=2, help="the two results", metavar="[LABEL=]RESULTS")
    parser.add_argument("--field", choices=FIELDS, default="displacement", help="what is drawn, default: displacement")
    parser.add_argument("--row", type=int, action="append", help="row of history.csv, for both or twice, one for each")
    parser.add_argument("-o", "--output", type=Path, help="picture to write")
    view_options.add_arguments(parser)
    arguments = parser.parse_args()
    rows = (arguments.row or [None]) * (2 if len(arguments.row or "1") == 1 else 1)
    if len(rows) != 2:
        parser.error("--row is given at most twice")
    scene = scene_file.read(arguments.scene)
    plt.rcParams.update(page.STYLE)
    if not plane.can_render():
        raise SystemExit("no library for off-screen rendering (libosmesa6 or libegl1)")
    runs = [(label, Results(folder, scene, row)) for (label, folder), row in zip(arguments.results, rows, strict=True)]
    for (_, folder), (_, run) in zip(arguments.results, runs, strict=True):
        if not run.subdomains:
            stored = ", ".join(map(str, run.rows)) or "none"
            raise SystemExit(f"{folder}: no fields stored" + (f" of row {run.row}; there are {stored}" if run.row is not None else ""))
    if arguments.row:
        runs = [(f"{label}, row {run.row}", run) for label, run in runs]
    path = arguments.output or runs[0][1].pictures / f"beside_{arguments.field}.png"
    title = scene.get("title") or arguments.results[0][1].name
    figure = FIELDS[arguments.field](runs, title, view_options.view_of(arguments))
    if figure is None:
        raise SystemExit("no interface is there")
    page.save(figure, path)


if __name__ == "__main__":
    told(main)
