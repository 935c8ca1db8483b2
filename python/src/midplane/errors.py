"""What can go wrong, in the words of the program where it was the program that found it."""

from __future__ import annotations

from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from .run import Run


class Told:
    """An error that a notebook shows by its own words, without the way through this package that led to it."""

    def _render_traceback_(self) -> list[str]:
        return [f"{type(self).__name__}: {self}"]


class MidplaneError(Told, Exception):
    """All errors of this package."""


class InputError(MidplaneError):
    """A scene, study or path that is no such thing; nothing was written (exit code 2 of the program)."""


class EquilibriumError(MidplaneError):
    """No equilibrium was found (exit code 3). All rows before are in `run`."""

    def __init__(self, text: str, run: Run | None = None) -> None:
        super().__init__(text)
        self.run = run


class MachineError(MidplaneError):
    """No program, no gmsh, a full disk, a folder where another run is at work (exit code 4)."""


class VersionError(MachineError):
    """The program and this package do not belong together."""


class ResultsError(MidplaneError):
    """A folder has no results, or not those that were asked for."""


class Interrupted(Told, KeyboardInterrupt):
    """Ctrl-C, or an interrupt of the kernel: the program has ended, all rows up to then are in `run`."""

    def __init__(self, text: str, run: Run | None = None) -> None:
        super().__init__(text)
        self.run = run


BY_CODE: dict[int, type[MidplaneError]] = {2: InputError, 3: EquilibriumError, 4: MachineError}
