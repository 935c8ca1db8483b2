"""A picture that a notebook shows."""

from __future__ import annotations

import base64
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

import matplotlib as mpl

from . import page

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SHOWN = 100  # pixels of a notebook per inch


class Picture:
    """A picture: shown by a notebook, written by `save`, changed through its `figure` of matplotlib."""

    def __init__(self, figure: Figure) -> None:
        self.figure = figure

    def save(self, path: str | Path) -> Path:
        """Writes the picture, in the form that the name's ending says: .png, .pdf, .svg."""
        path = Path(path).expanduser()
        path = path if path.suffix else path.with_suffix(".png")
        path.parent.mkdir(parents=True, exist_ok=True)
        with mpl.rc_context(page.STYLE):
            self.figure.savefig(path)
        return path

    def png(self) -> bytes:
        """The picture as a PNG."""
        buffer = io.BytesIO()
        with mpl.rc_context(page.STYLE):
            page.few_colours(page.picture(self.figure)).save(buffer, "png", optimize=True)
        return buffer.getvalue()

    def _repr_mimebundle_(self, **_: Any) -> tuple[dict[str, str], dict[str, dict[str, int]]]:
        """For a notebook: drawn finely, shown as large as on paper."""
        width = round(SHOWN * self.figure.get_figwidth())
        return {"image/png": base64.b64encode(self.png()).decode(), "text/plain": repr(self)}, {"image/png": {"width": width}}

    def __repr__(self) -> str:
        width, height = self.figure.get_size_inches()
        return f"Picture, {width:.1f} by {height:.1f} inches; picture.save(path) writes it"
