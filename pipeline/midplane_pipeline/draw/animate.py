"""Animate the results of a scene over the rows of its history that are stored: RESULTS/pictures/FIELD.gif, or the file after -o.

    python -m midplane_pipeline.draw.animate geo/masonry/scene.json results/masonry --every 2 -o masonry.mp4

  displacement   the deformed mesh, coloured by displacement, its interfaces coloured by what they do
  interfaces     the interfaces as in interfaces.png: opening as thickness, status as colour

Below runs the point of the history, of the columns of geo/<scene>/history.args or of --x and --y. Scales are those of all
rows shown. A GIF is always to be had; an MP4 needs ffmpeg.
"""

import argparse
import shutil
import subprocess
from pathlib import Path
from typing import Any

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.axes import Axes
from matplotlib.collections import LineCollection
from midplane import scene_file
from midplane.pictures import displacement, interfaces, page, plane
from midplane.pictures.page import BLUE, FACE, PALE, STATUS, sign
from midplane.pictures.plane import Page
from midplane.pictures.results import Results
from midplane.stored import text_rows
from PIL import Image

from midplane_pipeline.results.columns import read_columns
from midplane_pipeline.results.told import told

from . import history, view_options

MOST = 100  # frames, if --every does not say otherwise
SECONDS = 8.0  # about as long, without the last frame, which stays
SLOWEST, FASTEST, LAST = 0.5, 0.04, 1.5  # a frame [s]
DPI = 110
GRAPH = 1.5  # height of the history [inch]
FIELDS = ("displacement", "interfaces")


class Film:
    """A page of which the pictures change from row to row."""

    def __init__(self, arguments: argparse.Namespace, scene: dict[str, Any]) -> None:
        self.view = view_options.view_of(arguments)
        self.every_row = history_rows(arguments.results)
        stored = Results(arguments.results, scene).rows
        if len(stored) < 2:
            raise SystemExit(f'{arguments.results}: fields of {len(stored)} rows are stored; "fields": "every" stores all')
        step = arguments.every or -(-len(stored) // MOST)
        self.rows = sorted({*stored[::step], stored[-1]})
        self.states = [Results(arguments.results, scene, row) for row in self.rows]
        # parts that come later are shown from then on
        self.states = [state for state in self.states if state.has(self.view)] or self.states
        self.rows = [state.row for state in self.states if state.row is not None]
        self.bodies = [list(state.bodies(self.view).values()) for state in self.states]
        self.columns = history_columns(arguments)
        self.changing: list[Any] = []
        title = scene.get("title") or arguments.results.name
        getattr(self, f"prepare_{arguments.field}")(title)
        self.show = getattr(self, f"show_{arguments.field}")
        if self.columns:
            self.draw_history(arguments.results)

    def page(self, bounds: Any, title: str, subtitle: str, keys: list[Any], bar: float = 0.0) -> None:
        """An empty page with room for the history below."""
        below = GRAPH + 0.6 if self.columns else 0.0
        sheet = Page(bounds, title, subtitle, bar=bar, captions=(" ",), below=below, cut=self.view.zoom is not None)
        sheet.figure.set_dpi(DPI)
        sheet.label(self.view.length)
        self.sheet, self.keys = sheet, keys

    def prepare_displacement(self, title: str) -> None:
        """Scale, heading and outlines of the deformed mesh."""
        every = [mesh for meshes in self.bodies for mesh in meshes]
        self.scale = displacement.scale_of(every, self.view)
        moved = [displacement.deformed(mesh, self.scale) for mesh in every]
        subtitle = f"{self.view.part()}deformed mesh, displacement {page.enlarged(self.scale.factor)}; dashed: before loading"
        keys = self.status_keys()
        self.page(self.view.zoom or plane.frame([*every, *moved]), title, subtitle, keys, plane.BAR)
        self.sheet.colour_bar(self.scale.levels, self.scale.colours, f"displacement [{self.scale.label}]")
        displacement.draw_outlines(self.sheet.axis, self.bodies[-1])

    def show_displacement(self, state: Results, meshes: list[Any]) -> None:
        """The deformed mesh of a row and its interfaces."""
        moved = [displacement.deformed(mesh, self.scale) for mesh in meshes]
        self.changing.append(displacement.draw_deformed(self.sheet, self.sheet.axis, moved, self.scale))
        for name in state.joined(self.view):
            points = state.interfaces[name]
            if "displacement" in points.array_names:  # results of older programs have none
                self.changing += moved_line(self.sheet.axis, points, self.scale.factor)

    def prepare_interfaces(self, title: str) -> None:
        """Scale and heading of the interfaces."""
        every = [mesh for meshes in self.bodies for mesh in meshes]
        bounds = self.view.zoom or plane.frame(every, margin=0.1)
        names = [state.joined(self.view) for state in self.states]
        fields = [state.interfaces[name] for state, here in zip(self.states, names, strict=True) for name in here]
        if not fields:
            raise SystemExit("no interface lies in the picture")
        self.factor = interfaces.factor_of(fields, self.view, plane.largest_scale(bounds, 1))
        subtitle = f"{self.view.part()}status as colour, opening as thickness, {page.enlarged(self.factor)}"
        self.page(bounds, title, subtitle, self.status_keys())
        self.courses = {name: interfaces.course(self.states[0].midplane(name)) for name in set().union(*names)}

    def show_interfaces(self, state: Results, meshes: list[Any]) -> None:
        """The interfaces of a row."""
        axis = self.sheet.axis
        self.changing.append(self.sheet.render(meshes, None, axis, color=FACE))
        self.changing += interfaces.draw_outlines(axis, meshes)
        names = state.joined(self.view)
        if names:
            fields, courses = [state.interfaces[name] for name in names], [self.courses[name] for name in names]
            self.changing += interfaces.draw_status(axis, fields, courses, self.factor, self.sheet.inch)

    def status_keys(self) -> list[Any]:
        """An entry for whatever an interface does in a row that is shown."""
        fields = [state.interfaces[name]["status"] for state in self.states for name in state.joined(self.view)]
        seen: Any = np.unique(np.concatenate(fields)) if fields else []
        return [sign(text, colour, linewidth=1.2 if kind == 0 else 3) for kind, (text, colour) in STATUS.items() if kind in seen]

    def draw_history(self, folder: Path) -> None:
        """The whole curve pale; what has been gone through comes over it."""
        run = read_columns(folder, [name for name, _ in self.columns])
        axis = self.sheet.place(page.LEFT, page.BOTTOM, self.sheet.size[0] - page.LEFT - page.RIGHT, GRAPH)
        history.draw(axis, [("", run)], None, self.columns)
        axis.lines[0].set(color=PALE, markersize=0, zorder=1)
        self.run, self.axis = run, axis

    def frame(self, number: int) -> Image.Image:
        """The image of a row."""
        while self.changing:
            self.changing.pop().remove()
        state, row = self.states[number], self.rows[number]
        self.show(state, self.bodies[number])
        step, share = self.every_row[row]["step"], float(self.every_row[row]["load_factor"])
        self.sheet.captions[0].set_text(f"row {row}: {step}, load factor {share:.3g}")
        if self.columns:
            x, y = (self.run[name][: row + 1] for name, _ in self.columns)
            self.changing += self.axis.plot(x, y, color=BLUE, linewidth=1.2, zorder=3, clip_on=False)
            self.changing += self.axis.plot(x[-1:], y[-1:], "o", color=BLUE, markersize=5, zorder=4, clip_on=False)
        if self.keys:
            self.sheet.key(self.keys)
            self.keys = []
        image = page.picture(self.sheet.figure)
        return image.crop((0, 0, image.width // 2 * 2, image.height // 2 * 2))  # as films want it


def moved_line(axis: Axes, points: Any, factor: float) -> list[Any]:
    """An interface where its sides have moved to, in pieces coloured by status."""
    places = points.points[:, :2] + factor * points["displacement"][:, :2]
    middle = 0.5 * (places[1:] + places[:-1])
    bounds = np.concatenate([places[:1], middle, places[-1:]])
    pieces, status = np.stack([bounds[:-1], bounds[1:]], axis=1), points["status"]
    drawn = []
    for kind, (_, colour) in STATUS.items():
        look: dict[str, Any] = {"colors": colour, "linewidths": 1.0 if kind == 0 else 2.4, "zorder": 3 if kind == 0 else 4}
        drawn.append(axis.add_collection(LineCollection(pieces[status == kind], **look), autolim=False))
    return drawn


def history_rows(folder: Path) -> list[dict[str, str]]:
    """The rows of history.csv as text."""
    return text_rows(folder / "history.csv")


def history_columns(arguments: argparse.Namespace) -> Any:
    """(name, label) of the abscissa and of the ordinate: those asked for, else those of the scene; None if there are none."""
    if arguments.x and arguments.y:
        return arguments.x, arguments.y
    file = arguments.scene.parent / "history.args"
    if not file.exists():
        return None
    known = history.parse([str(arguments.scene), str(arguments.results), f"@{file}"])
    return known.x, known.y


def write_gif(images: list[Image.Image], path: Path, seconds: float) -> None:
    """All frames with the colours of the last one."""
    palette = images[-1].quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE)
    frames = [image.quantize(palette=palette, dither=Image.Dither.NONE) for image in images]
    times = [1000 * seconds] * (len(frames) - 1) + [1000 * LAST]
    frames[0].save(path, save_all=True, append_images=frames[1:], duration=times, loop=0, optimize=False)


def write_mp4(images: list[Image.Image], path: Path, seconds: float) -> None:
    """The frames through ffmpeg."""
    width, height = images[0].size
    raw = f"-f rawvideo -pix_fmt rgb24 -s {width}x{height} -r {1 / seconds:.6g} -i - -an".split()
    made = ["-c:v", "libx264", "-crf", "20", "-pix_fmt", "yuv420p", "-movflags", "+faststart"]
    frames = images + [images[-1]] * round(LAST / seconds)
    command = ["ffmpeg", "-y", "-loglevel", "error", *raw, *made, str(path)]
    subprocess.run(command, input=b"".join(image.tobytes() for image in frames), check=True)


def positive(text: str) -> int:
    """A number of rows."""
    number = int(text)
    if number < 1:
        raise ValueError
    return number


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("scene", type=Path, help="the scene file, such as geo/masonry/scene.json")
    parser.add_argument("results", type=Path, help="the folder of its results, such as results/masonry")
    parser.add_argument("--field", choices=FIELDS, default=FIELDS[0], help="what is drawn, default: displacement")
    parser.add_argument("--every", type=positive, metavar="N", help=f"every Nth stored row, default: at most {MOST} frames")
    axis: dict[str, Any] = {"type": history.column, "metavar": "COLUMN=LABEL"}
    parser.add_argument("--x", help="abscissa of the history, default: that of history.args", **axis)
    parser.add_argument("--y", help="its ordinate", **axis)
    parser.add_argument("--seconds", type=float, default=SECONDS, help=f"how long it runs, about, default: {SECONDS:g}")
    parser.add_argument("-o", "--output", type=Path, help="the .gif or .mp4 to write")
    view_options.add_arguments(parser)
    arguments = parser.parse_args()
    path = arguments.output or arguments.results / "pictures" / f"{arguments.field}.gif"
    if path.suffix not in (".gif", ".mp4"):
        parser.error(f"{path} is neither a .gif nor an .mp4")
    if bool(arguments.x) != bool(arguments.y):
        parser.error("--x and --y go together")
    if path.suffix == ".mp4" and not shutil.which("ffmpeg"):
        raise SystemExit(f"no ffmpeg to write {path} with: install it, or write a .gif")
    if not plane.can_render():
        raise SystemExit("no library for off-screen rendering (libosmesa6 or libegl1)")
    plt.rcParams.update(page.STYLE)
    film = Film(arguments, scene_file.read(arguments.scene))
    last = film.frame(len(film.rows) - 1)  # the key first, so that all are of one size
    images = [film.frame(number) for number in range(len(film.rows) - 1)] + [last]
    seconds = float(np.clip(arguments.seconds / len(images), FASTEST, SLOWEST))
    path.parent.mkdir(parents=True, exist_ok=True)
    (write_gif if path.suffix == ".gif" else write_mp4)(images, path, seconds)
    print(f"{path}: {len(images)} of {len(film.every_row)} rows")


if __name__ == "__main__":
    told(main)
