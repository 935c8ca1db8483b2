"""One point of an interface's law along a path."""

from __future__ import annotations

import io
import json
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from .errors import InputError
from .running import Call

if TYPE_CHECKING:
    from .scene import Scene


def law(
    scene: Scene | str | Path | Mapping[str, Any],
    interface: str,
    path: str | Path | Mapping[str, Any],
    *,
    tolerance: float | None = None,
    substeps: int | None = None,
) -> pd.DataFrame:
    """Drives one point of an interface's law along a path, a file or what such a file holds; no mesh is read.

    A row per stored point: `s` counts segments of the path, `jump_n`, `traction_t`, …, the law's variables, `status`. Raises InputError."""
    from .scene import folder_for_nothing, scene_of

    options = {"--tolerance": tolerance, "--substeps": substeps}
    words = [word for flag, value in options.items() if value is not None for word in (flag, str(value))]
    with folder_for_nothing() as folder:
        if isinstance(path, Mapping):
            file = Path(folder) / "path.json"
            file.write_text(json.dumps(path, indent=1))
        else:
            file = Path(path).expanduser()
            if not file.is_file():
                raise InputError(f"{path}: there is no such path (looked in {Path.cwd()})")
        said = scene_of(scene).temporary(folder)
        text = Call(["law", said[0], interface, str(file), *said[1:], *words]).wait()
    return pd.read_csv(io.StringIO(text))
