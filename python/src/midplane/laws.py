"""One point of an interface's law along a path."""

from __future__ import annotations

import io
import tempfile
from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from .errors import EquilibriumError, InputError
from .plain import text_of, to_plain
from .running import Call
from .written import Written

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

    A row per stored point: `s` counts segments of the path, `jump_n`, `traction_t`, …, the law's variables, `status`. Raises InputError, and
    EquilibriumError where the point cannot follow, with the rows up to there in its `table`."""
    from .scene import scene_of

    options = {"--tolerance": tolerance, "--substeps": substeps}
    words = [word for flag, value in options.items() if value is not None for word in (flag, str(value))]
    own = scene_of(scene)
    with tempfile.TemporaryDirectory(prefix="midplane-") as folder:
        if isinstance(path, Mapping):
            file = Path(folder) / "path.json"
            file.write_text(text_of(to_plain(dict(path), "path")), encoding="utf-8")
        elif isinstance(path, str | Path):
            file = Path(path).expanduser().absolute()
            if not file.is_file():
                raise InputError(f"{path}: there is no such path (looked in {Path.cwd()})")
        else:
            raise InputError(f"a path is a file or a dictionary, not a {type(path).__name__}")
        scene_file, *said = own.said(Path(folder), Written())
        changes = said[: said.index("--geo-path")] if "--geo-path" in said else said  # no mesh is read
        call = Call(["law", scene_file, interface, str(file), *changes, *words], folder=own.cwd)
        try:
            return table(call.wait())
        except EquilibriumError as error:
            raise EquilibriumError(str(error), table=table("\n".join(call.out))) from None


def table(text: str) -> pd.DataFrame:
    """The rows that the program has printed."""
    return pd.read_csv(io.StringIO(text)) if text else pd.DataFrame()
