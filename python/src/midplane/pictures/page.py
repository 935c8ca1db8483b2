"""What all pictures have in common: colours, type, margins, headings, keys, numbers with their units.

Colours are those of Okabe and Ito, maps viridis: told apart by everyone. Keys stand below the axes, never on data.
"""

from __future__ import annotations

import math
import warnings
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.axis import Axis
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.font_manager import FontProperties
from matplotlib.legend import Legend
from matplotlib.legend_handler import HandlerBase
from matplotlib.lines import Line2D
from matplotlib.patches import Rectangle
from matplotlib.text import Annotation
from matplotlib.textpath import TextPath
from matplotlib.ticker import LogLocator, NullFormatter
from PIL import Image

BLUE, VERMILLION, GREEN, ORANGE = "#0072B2", "#D55E00", "#009E73", "#E69F00"
PURPLE, SKY = "#CC79A7", "#56B4E9"
RUNS = [BLUE, VERMILLION, GREEN, ORANGE, PURPLE, SKY]  # a run and those beside it
MARKERS = ["o", "s", "^", "D", "v", "P"]  # likewise
INK, GREY, PALE, FACE = "#222222", "#777777", "#C9C9C6", "#F3F3F1"
SOFT = "#555555"  # of text that stands back
MAP = "viridis"
DASHES = (0, (4, 3))

# what a law point does, docs/RESULTS.md: meaning, colour
ABSENT, OPEN, TIED = -1, 4, 6
STATUS = {
    0: ("elastic or sticking", GREY),
    1: ("cracks in tension", VERMILLION),
    2: ("cracks or slides, pressed", BLUE),
    3: ("opens and slides at σ = 0", PURPLE),
    OPEN: ("open, free of stress", GREEN),
    5: ("cracked, closed, sticking", INK),
    TIED: ("open, bridged", ORANGE),
}

STYLE: Any = {
    "font.family": "DejaVu Sans",
    "font.size": 8.5,
    "text.color": INK,
    "axes.labelcolor": INK,
    "axes.edgecolor": GREY,
    "axes.linewidth": 0.6,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.formatter.useoffset": False,
    "axes.axisbelow": True,
    "xtick.color": GREY,
    "ytick.color": GREY,
    "xtick.labelcolor": INK,
    "ytick.labelcolor": INK,
    "xtick.major.width": 0.6,
    "ytick.major.width": 0.6,
    "xtick.minor.width": 0.4,
    "ytick.minor.width": 0.4,
    "grid.color": "#E6E6E3",
    "grid.linewidth": 0.7,
    "legend.frameon": False,
    "legend.handletextpad": 0.5,
    "legend.columnspacing": 1.6,
    "figure.dpi": 180,
}
# powers of 1000 of a unit that have a name
NAMES = {("m", -3): "mm", ("m", -6): "µm", ("m", -9): "nm", ("mm", -3): "µm", ("mm", -6): "nm"}
NAMES |= {("MPa", -3): "kPa", ("MPa", -6): "Pa", ("MPa", 3): "GPa", ("MN", -3): "kN", ("MN", -6): "N", ("N", 3): "kN"}
# in inches
WIDTH, HEIGHT = 6.2, 3.8  # room for the plane
LEFT, RIGHT, TOP, BOTTOM = 0.75, 0.25, 0.62, 0.5  # margins around it
KEY, KEY_ROW = 0.3, 0.17  # room for a key, for one more row of it
CAPTION = 0.2  # room for a name above a graph
TITLE, SUBTITLE = (10.5, 8.0), (8.5, 7.0)  # type of the heading, as it is and at least [points]


def sheet(width: float, height: float) -> Figure:
    """An empty figure [inch] that belongs to no window and no notebook."""
    figure = Figure(figsize=(width, height))
    FigureCanvasAgg(figure)
    return figure


def graphs(rows: int, height: float, columns: int = 1, raised: float = 0.0, sharex: bool = True, sharey: bool | str = "row") -> tuple[Figure, list[Axes]]:
    """A figure as wide as the others, with graphs that share their axes; the graphs in a list."""
    width = LEFT + WIDTH + RIGHT
    figure = sheet(width, height)
    axes: Any = figure.subplots(rows, columns, sharex=sharex, sharey=sharey, squeeze=False)  # type: ignore[arg-type]
    sides = {"left": LEFT / width, "right": 1 - RIGHT / width}
    figure.subplots_adjust(top=1 - (TOP + raised) / height, bottom=BOTTOM / height, wspace=0.08, **sides)
    return figure, list(axes.flat)


def grow(figure: Figure, inches: float) -> None:
    """More room below all axes."""
    width, height = figure.get_size_inches()
    figure.set_size_inches(width, height + inches)
    for axis in figure.axes:
        left, bottom, across, up = axis.get_position().bounds
        axis.set_position((left, (bottom * height + inches) / (height + inches), across, up * height / (height + inches)))


class Bar:
    """An entry of a key that shows a size: a bar of a length and a thickness in points."""

    def __init__(self, label: str, length: float, thickness: float = 1.4, colour: str = INK) -> None:
        self.label, self.length, self.thickness, self.colour = label, length, thickness, colour

    def get_label(self) -> str:
        """The text of the entry, as matplotlib asks for it."""
        return self.label


class BarHandler(HandlerBase):
    """How a legend draws a Bar: as large as it is."""

    def legend_artist(self, legend: Legend, bar: Any, fontsize: float, box: Any) -> Rectangle:
        """The bar, put into its box."""
        box.width = bar.length
        place = (0, 0.35 * fontsize - bar.thickness / 2)
        drawn = Rectangle(place, bar.length, bar.thickness, facecolor=bar.colour, linewidth=0)
        box.add_artist(drawn)
        return drawn


def key_below(figure: Figure, handles: Sequence[Any]) -> None:
    """A legend in rows below the axes, the figure grown by what it needs."""
    left, room = LEFT / figure.get_figwidth(), (figure.get_figwidth() - LEFT - 0.05) * figure.dpi
    place: dict[str, Any] = {"loc": "lower left", "bbox_to_anchor": (left, 0), "borderaxespad": 0.3, "handler_map": {Bar: BarHandler()}}
    columns = 1
    for columns in range(len(handles), 0, -1):
        # matplotlib fills columns, people read rows
        order = [handles[i] for column in range(columns) for i in range(column, len(handles), columns)]
        labels = [handle.get_label() for handle in order]
        legend = figure.legend(handles=order, labels=labels, ncols=columns, **place)
        if columns == 1 or legend.get_window_extent(renderer(figure)).width <= room:
            break
        legend.remove()
    grow(figure, KEY + KEY_ROW * (math.ceil(len(handles) / columns) - 1))


def renderer(figure: Figure) -> Any:
    """What knows how large texts are."""
    canvas: Any = figure.canvas
    return canvas.get_renderer()


def heading(axis: Axes, title: str, subtitle: str, raised: float = 0.0) -> None:
    """Title and, in a smaller and lighter line below it, what the picture shows; raised where captions stand below [inch]."""
    figure: Any = axis.figure
    room = figure.get_figwidth() * (1 - axis.get_position().x0) - 0.05
    above: dict[str, Any] = {"xy": (0, 1), "xycoords": "axes fraction", "textcoords": "offset points", "linespacing": 1.05}
    title, size = fitted(title, TITLE, room, "bold")
    axis.annotate(title, xytext=(0, 23 + 72 * raised), fontsize=size, fontweight="bold", **above)
    subtitle, size = fitted(subtitle, SUBTITLE, room)
    axis.annotate(subtitle, xytext=(0, (9 if "\n" not in subtitle else 4) + 72 * raised), fontsize=size, color=SOFT, **above)


def fitted(text: str, sizes: tuple[float, float], room: float, weight: str = "normal") -> tuple[str, float]:
    """The text and its size so that it fits into a room: smaller, or in lines where that is not enough."""
    largest, least = sizes
    needed = text_width(text, largest, weight)
    if needed <= room:
        return text, largest
    if needed * least / largest <= room:
        return text, largest * room / needed
    lines = [""]
    for word in text.split(" "):
        longer = f"{lines[-1]} {word}".strip()
        if text_width(longer, least, weight) <= room or not lines[-1]:
            lines[-1] = longer
        else:
            lines.append(word)
    return "\n".join(lines), least


def text_width(text: str, size: float, weight: str = "normal") -> float:
    """Width of a line of text [inch]."""
    if not text.strip():
        return 0.0
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # letters that the font has not are told when the text is drawn
        path = TextPath((0, 0), text, size=size, prop=FontProperties(family=STYLE["font.family"], weight=weight))
        return float(path.get_extents().width) / 72


def caption(axis: Axes, text: str) -> Annotation:
    """A name above one of several graphs; the heading is to be raised by CAPTION."""
    above: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
    return axis.annotate(text, (0, 1), xytext=(0, 4), fontweight="bold", **above)


def mark_ends(axis: Axes, start: str, end: str) -> None:
    """Texts below the two ends of an axis that runs along an interface."""
    below: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points", "color": SOFT, "va": "top"}
    axis.annotate(start, (0, 0), xytext=(0, -19), ha="left", **below)
    axis.annotate(end, (1, 0), xytext=(0, -19), ha="right", **below)


def sign(label: str, colour: str, **look: Any) -> Line2D:
    """An entry of a key."""
    return Line2D([], [], label=label, color=colour, solid_capstyle="butt", **look)


def plain_log(line: Axis) -> None:
    """Plain numbers on a logarithmic axis (axes.xaxis, axes.yaxis), as many as have room."""
    low, high = line.get_view_interval()
    line.set_major_locator(LogLocator(subs=(1, 2, 5) if high < 15 * low else (1,), numticks=6))
    line.set_major_formatter("{x:g}")
    line.set_minor_formatter(NullFormatter())


def picture(figure: Figure) -> Image.Image:
    """The figure as an image."""
    figure.canvas.draw()
    return Image.fromarray(np.asarray(renderer(figure).buffer_rgba())[:, :, :3])


def few_colours(image: Image.Image) -> Image.Image:
    """The image with a palette of 256 colours, which makes its file three times smaller."""
    return image.quantize(256, Image.Quantize.MAXCOVERAGE, kmeans=1, dither=Image.Dither.NONE)


def save(figure: Figure, path: Path) -> None:
    """Write the picture and tell where it is."""
    path.parent.mkdir(parents=True, exist_ok=True)
    few_colours(picture(figure)).save(path, optimize=True)
    print(path)


def round_down(value: float) -> float:
    """The largest of 1, 2, 5 times a power of ten that is not above the value."""
    power = 10.0 ** math.floor(math.log10(value))
    return float(power * max(digit for digit in (1, 2, 5) if digit * power <= value * (1 + 1e-12)))


def power_of_ten(value: float) -> str:
    """One digit and its power of ten, for a text."""
    digit, _, exponent = f"{value:.0e}".partition("e")
    return f"${digit}\\times 10^{{{int(exponent)}}}$"


def plain(value: float) -> str:
    """A number for a text: digits, or a power of ten where these would be many."""
    if value == 0 or 1e-3 <= abs(value) < 1e5:
        return f"{value:,.12g}"
    digits, _, exponent = f"{value:.3e}".partition("e")
    digits = f"{float(digits):g}"
    return f"$10^{{{int(exponent)}}}$" if digits == "1" else f"${digits}\\times 10^{{{int(exponent)}}}$"


def enlarged(factor: float) -> str:
    """How much larger than it is something is drawn, in words."""
    if factor == 1:
        return "as large as it is"
    return f"enlarged {plain(factor)} times" if factor > 1 else f"reduced to {plain(factor)} of it"


def scaled(size: float, unit: str) -> tuple[float, str]:
    """A power of 1000 to divide by so that the size reads well, and the unit that says so."""
    exponent = 0
    if size > 0 and not 0.1 <= size < 1e4:
        exponent = 3 * math.floor((math.log10(size) + (1 if size < 1 else 0)) / 3)
    if exponent == 0:
        return 1.0, unit
    return 10.0**exponent, NAMES.get((unit, exponent)) or f"$10^{{{exponent}}}$ {unit}".strip()


def unit_of(label: str, size: float) -> tuple[str, float, str]:
    """The text of a label without the unit that ends it in brackets, what to divide by, and the unit that says so."""
    text, _, unit = label.rpartition(" [") if label.endswith("]") else (label, "", "")
    return text, *scaled(size, unit.removesuffix("]"))


def scale_axis(axis: Axis, label: str, size: float) -> None:
    """Label an axis (axes.xaxis, axes.yaxis), its ticks in a power of 1000 of the unit that ends the label in brackets."""
    text, factor, unit = unit_of(label, size)
    axis.set_major_formatter(lambda value, _: f"{value / factor:.6g}".replace("-", "−"))
    axis.set_label_text(f"{text} [{unit}]" if unit else text)
