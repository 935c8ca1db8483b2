"""What can go wrong, in the words of the program where it was the program that found it."""

from __future__ import annotations

import traceback
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    import pandas as pd

    from .run import Run

PACKAGE = Path(__file__).resolve().parent


class Told:
    """An error that a notebook shows with the user's own lines, without the way through this package."""

    def _render_traceback_(self) -> list[str]:
        frames = traceback.extract_tb(getattr(self, "__traceback__", None))
        own = [frame for frame in frames if PACKAGE not in Path(frame.filename).parents and "IPython" not in frame.filename]
        return [*traceback.format_list(own), f"{type(self).__name__}: {self}"]


class MidplaneError(Told, Exception):
    """All errors of this package."""


class InputError(MidplaneError):
    """A scene, study or path that is no such thing; nothing was run (exit code 2 of the program)."""


class EquilibriumError(MidplaneError):
    """No equilibrium was found (exit code 3). All rows before are in `run`; of a law they are the `table`."""

    def __init__(self, text: str, run: Run | None = None, table: pd.DataFrame | None = None) -> None:
        super().__init__(text)
        self.run, self.table = run, table


class MachineError(MidplaneError):
    """No program, no gmsh, a full disk, a folder where another run is at work (exit code 4)."""


class VersionError(MachineError):
    """The program and this package do not belong together."""


class ResultsError(MidplaneError):
    """A folder has no results, or not those that were asked for."""


class Interrupted(Told, KeyboardInterrupt):
    """Ctrl-C, or an interrupt of the kernel: the program has ended. All rows up to then are in `run`, which a study has not."""

    def __init__(self, text: str, run: Run | None = None) -> None:
        super().__init__(text)
        self.run = run


BY_CODE: dict[int, type[MidplaneError]] = {2: InputError, 3: EquilibriumError, 4: MachineError}
