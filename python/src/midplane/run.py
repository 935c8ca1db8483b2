"""The results of a run, while it goes on and after."""

from __future__ import annotations

import json
import warnings
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import pandas as pd

from .checked import Warned, warnings_in
from .errors import EquilibriumError, Interrupted, ResultsError
from .progress import ROW, Progress
from .running import Call
from .stored import Stored

if TYPE_CHECKING:
    import pyvista

    from .pictures.picture import Picture

ASKED = "notebook.json"  # how a run was started, for `resume`


class MidplaneWarning(UserWarning):
    """What the program warns of; docs/WARNINGS.md has a section for each code."""


class Run:
    """The results in a folder, of `scene.run()` or of any run of the program: `midplane.Run("results/dam")`.

    Everything is read when it is asked for, so it may be looked at while the run goes on."""

    def __init__(self, folder: str | Path, *, scene: dict[str, Any] | None = None) -> None:
        self.folder = Path(folder).expanduser()
        if scene is None and not self.folder.is_dir():
            raise ResultsError(f"{folder}: there is no such folder (looked in {Path.cwd()}); results of a scene are in results/<scene>")
        self.stored = Stored(self.folder)
        self.call: Call | None = None
        self.progress: Progress | None = None
        self.scene = scene if scene is not None else self.asked().get("scene")

    # --- the run itself

    def begin(self, arguments: list[str], *, resume: bool, progress: Progress | None = None) -> None:
        """Starts the program. How is written down with its first row: input that is bad leaves nothing."""
        self.progress = progress
        asked = json.dumps({"arguments": arguments, "scene": self.scene}, ensure_ascii=False) + "\n"

        def on_line(text: str) -> None:
            nonlocal asked
            if asked and ROW.match(text):
                (self.folder / ASKED).write_text(asked)
                asked = ""
            if progress is not None:
                progress.line(text)

        self.call = Call([*arguments, *(["--resume"] if resume else [])], on_line)

    def asked(self) -> dict[str, Any]:
        """How this package started the run; nothing where it did not."""
        path = self.folder / ASKED
        content: dict[str, Any] = json.loads(path.read_text()) if path.is_file() else {}
        return content

    @property
    def running(self) -> bool:
        """Whether a run that this object has started goes on."""
        return self.call is not None and self.call.running

    def wait(self) -> Run:
        """Waits for the end. Raises what went wrong, Interrupted on Ctrl-C; all rows up to then can be read."""
        if self.call is None:
            return self
        call, self.call = self.call, None
        done = False
        try:
            call.wait()
            done = True
        except EquilibriumError as error:
            raise EquilibriumError(f"{error}\n{self.kept()}", self) from None
        except Interrupted as error:
            raise Interrupted(f"{error}\n{self.kept()}; `resume()` goes on", self) from None
        finally:
            if self.progress:
                self.progress.close(done)
            vars(self.stored).pop("sizes", None)
        for warned in warnings_in(call.message()):
            warnings.warn(str(warned), MidplaneWarning, stacklevel=3)
        return self

    def kept(self) -> str:
        """What there is of a run that did not come to its end."""
        return f"What converged is in midplane.Run({str(self.folder)!r})"

    def stop(self) -> None:
        """Ends a run that goes on; what it has found is on disk."""
        if self.call is not None:
            self.call.stop()
            if self.progress:
                self.progress.close(False)
            self.call = None

    def resume(self, *, progress: bool = True) -> Run:
        """Goes on where the run was interrupted or found no equilibrium, with the scene and the options it was started with.

        Raises ResultsError where this package did not start it: then `Scene(…).run(out, resume=True)` does."""
        asked = self.asked()
        if "arguments" not in asked:
            raise ResultsError(f"{self.folder}: was not run from a notebook; midplane.Scene(…).run({str(self.folder)!r}, resume=True) goes on")
        self.scene = asked["scene"]
        self.begin(asked["arguments"], resume=True, progress=Progress(asked["scene"], self.folder.name) if progress else None)
        return self.wait()

    # --- what it found

    @property
    def history(self) -> pd.DataFrame:
        """A row per increment, from the unloaded state on: step, load_factor, the columns of the scene, reactions, energy_balance."""
        return self.stored.history()

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: sizes, counts, residual, energy balance, snaps, times, warnings."""
        return self.stored.summary()

    @property
    def warnings(self) -> list[Warned]:
        """The warnings of the run."""
        split = (text.partition(" ") for text in self.summary["warnings"])
        return [Warned(code, text) for code, _, text in split]

    @property
    def interfaces(self) -> list[str]:
        """The names of the interfaces."""
        return self.stored.interfaces()

    @property
    def subdomains(self) -> list[str]:
        """The names of the subdomains."""
        return self.stored.subdomains()

    @property
    def fields(self) -> Fields:
        """The fields of all stored rows, each a PyVista MultiBlock: `run.fields[-1]["dam"]`."""
        return Fields(self.stored)

    def interface(self, name: str, row: int | Literal["all"] = -1) -> pd.DataFrame:
        """The law points along an interface in one stored row, or in "all" of them: jumps, tractions, status, variables of the law.

        `s` runs from 0 at `attrs["start"]` to 1 at `attrs["end"]`; the normal points from `attrs["side_a"]` to `attrs["side_b"]`.
        Index (row, point). Raises ResultsError."""
        name = self.stored.interface(name)
        return self.stored.along(name, self.stored.rows() if row == "all" else [self.stored.row(row)])

    # --- pictures

    def plot(self, field: Literal["displacement", "principal_stress"] = "displacement", row: int = -1, **view: Any) -> Picture:
        """The deformed mesh coloured by displacement, or principal stresses as crosses.

        `view`: `zoom=((x0, x1), (y0, y1))`, `subdomains=["dam*"]`, `stress="MPa"` and `length="m"`, the units of the numbers."""
        from .pictures import of_run

        return of_run.draw(self, field, row, view)

    def crack_map(self, row: int = -1, **view: Any) -> Picture:
        """All interfaces: opening as thickness, status as colour; `view` as of `plot`."""
        from .pictures import of_run

        return of_run.draw(self, "interfaces", row, view)

    def plot_interface(self, name: str, row: int = -1, **view: Any) -> Picture:
        """Normal and tangential traction along an interface, its ends named; `view` as of `plot`."""
        from .pictures import of_run

        return of_run.draw_traction(self, self.stored.interface(name), row, view)

    def __repr__(self) -> str:
        if self.running:
            return f"Run {self.folder}: goes on"
        if not (self.folder / "summary.json").is_file():
            return f"Run {self.folder}: no summary"
        summary = self.summary
        counts, solution = summary["sizes"], summary["solution"]
        lines = [
            f"Run {self.folder}: {summary['title']}",
            f"  {counts['dofs']} dofs, {len(counts['subdomains'])} subdomains, {len(counts['interfaces'])} interfaces",
            f"  {solution['increments']} increments, {solution['iterations']} iterations, {summary['time']['total']:.3g} s; "
            f"energies balance to {solution['energy_balance']:.1e}",
        ]
        lines += [f"  stopped: {summary['stopped']}"] if summary["stopped"] else []
        return "\n".join([*lines, *(f"  {warned}" for warned in self.warnings)])


class Fields(Sequence["pyvista.MultiBlock"]):
    """The stored rows in their order; `rows` are their numbers in the history."""

    def __init__(self, stored: Stored) -> None:
        self.stored = stored
        self.rows = stored.rows()

    def __len__(self) -> int:
        return len(self.rows)

    @overload
    def __getitem__(self, at: int) -> pyvista.MultiBlock: ...
    @overload
    def __getitem__(self, at: slice) -> list[pyvista.MultiBlock]: ...
    def __getitem__(self, at: int | slice) -> pyvista.MultiBlock | list[pyvista.MultiBlock]:
        if isinstance(at, slice):
            return [self.row(row) for row in self.rows[at]]
        if not self.rows:
            raise ResultsError(f'{self.stored.folder}: no fields are stored ("output.fields" of the scene says which)')
        if not -len(self.rows) <= at < len(self.rows):
            raise IndexError(f"{self.stored.folder}: fields of {len(self.rows)} rows are stored, there is none at {at}")
        return self.row(self.rows[at])

    def __iter__(self) -> Iterator[pyvista.MultiBlock]:
        return (self.row(row) for row in self.rows)

    def row(self, row: int) -> pyvista.MultiBlock:
        """The fields of a row of the history: a block per subdomain and interface, by name."""
        import pyvista

        row = self.stored.row(row)
        blocks = pyvista.MultiBlock()
        for name in [*self.stored.subdomains(), *self.stored.interfaces()]:
            blocks.append(self.stored.grid(name, row), name)
        return blocks

    def __repr__(self) -> str:
        return f"fields of {len(self.rows)} rows of {self.stored.folder}"
