"""The results of a run, while it goes on and after."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Literal, overload

import pandas as pd

from .checked import Warned, warnings_in
from .errors import EquilibriumError, InputError, Interrupted, MidplaneError, ResultsError
from .progress import ROW, Progress
from .running import Call, warn
from .stored import Stored
from .written import Written

if TYPE_CHECKING:
    import pyvista

    from .pictures.picture import Picture

ASKED = "notebook.json"  # how a run was started, for `resume`


class Run:
    """The results in a folder, of `scene.run()` or of any run of the program: `midplane.Run("results/dam")`.

    Everything is read when it is asked for, so it may be looked at while the run goes on; a later run in the same folder replaces it."""

    def __init__(self, folder: str | Path, *, scene: dict[str, Any] | None = None) -> None:
        self.folder = Path(folder).expanduser().absolute()
        self.call: Call | None = None
        self.progress: Progress | None = None
        self.written = Written()
        self.begun = True  # of a run that was started here: whether its own first row is there
        self.error: BaseException | None = None
        if scene is None and not self.folder.is_dir():
            wrong = "is a file" if self.folder.exists() else "there is no such folder"
            raise ResultsError(f"{folder}: {wrong} (looked in {Path.cwd()}); results of a scene are in a folder such as results/<scene>")
        self.files = Stored(self.folder)
        self.scene = scene if scene is not None else self.scene_of_folder()

    # --- the run itself

    def begin(self, arguments: list[str], asked: dict[str, Any], cwd: Path, *, resume: bool, progress: Progress | None, written: Written | None = None) -> None:
        """Starts the program. How is written down with its first row."""
        if self.running:
            raise MidplaneError(f"{self.folder}: this run goes on; `stop()` ends it, `wait()` waits for its end")
        self.begun, self.error, self.progress = resume and self.is_there(), None, progress
        self.written = written or Written()

        def on_line(text: str) -> None:
            if ROW.match(text) and not noted:
                self.begun = True
                self.note(asked)
                noted.append(True)
            if progress is not None:
                progress.line(text)

        noted: list[bool] = []
        try:
            self.call = Call([*arguments, "-o", str(self.folder), *(["--resume"] if resume else [])], on_line, cwd)
        except BaseException:
            self.close(False)
            raise

    def is_there(self) -> bool:
        """Whether the folder has results."""
        return (self.folder / "manifest").is_file()

    def note(self, asked: dict[str, Any]) -> None:
        """Writes down how the run was started, and of which results that is true."""
        note = asked | {"content": self.scene, "manifest": (self.folder / "manifest").stat().st_ino}
        aside = self.folder / f"{ASKED}.new"
        aside.write_text(json.dumps(note), encoding="utf-8")
        aside.replace(self.folder / ASKED)

    def asked(self) -> dict[str, Any] | None:
        """How this package started the run in the folder; None where it was started otherwise."""
        try:
            content: dict[str, Any] = json.loads((self.folder / ASKED).read_text(encoding="utf-8"))
            return content if content["manifest"] == (self.folder / "manifest").stat().st_ino else None
        except (OSError, ValueError, KeyError, TypeError):
            return None

    def scene_of_folder(self) -> dict[str, Any] | None:
        """The scene of the results, where this package has run it."""
        asked = self.asked()
        return asked["content"] if asked else None

    @property
    def running(self) -> bool:
        """Whether a run that this object has started goes on."""
        return self.call is not None and self.call.running

    def wait(self) -> Run:
        """Waits for the end. Raises what went wrong, Interrupted on Ctrl-C; all rows up to then can be read."""
        if self.call is None:
            return self
        call, done = self.call, False
        try:
            call.wait()
            done = self.begun = True
        except EquilibriumError as error:
            self.error = EquilibriumError(f"{error}\n{self.kept()}", self)
        except Interrupted as error:
            self.error = Interrupted(f"{error}\n{self.kept()}", self)
        except MidplaneError as error:
            self.written.take_back()
            self.error = error
        finally:
            self.close(done)
        for warned in warnings_in(call.message()):
            warn(str(warned))
        if self.error is not None:
            raise self.error from None
        return self

    def close(self, done: bool) -> None:
        """The call has ended."""
        if self.progress is not None:
            self.progress.close(done)
        self.call = self.progress = None

    def kept(self) -> str:
        """What there is of a run that did not come to its end."""
        return f"What converged is in midplane.Run({shown(self.folder)!r}); `resume()` goes on" if self.begun else "It has no row yet"

    def stop(self) -> None:
        """Ends a run that goes on; what it has found is on disk."""
        if self.call is not None:
            self.call.stop()
            self.call.wait_quietly()
            self.close(False)

    def resume(self, *, progress: bool = True) -> Run:
        """Goes on where the run was interrupted or found no equilibrium, with the scene and the options it was started with.

        Raises ResultsError where this package did not start it: then `Scene(…).run(out, resume=True)` does."""
        from .scene import Scene, taken_back

        asked = self.asked()
        if asked is None:
            raise ResultsError(f"{self.folder}: was not run from a notebook; midplane.Scene(…).run({str(self.folder)!r}, resume=True) goes on")
        scene, written = Scene.of(asked["scene"]), Written()
        self.scene = scene.data
        with taken_back(written):
            said = scene.said(self.folder, written)
            bar = Progress(self.scene, scene.name) if progress else None
            told = {"scene": asked["scene"], "options": asked["options"]}
            self.begin(["run", *said, *asked["options"]], told, scene.cwd, resume=True, progress=bar, written=written)
        return self.wait()

    # --- what it found

    @property
    def stored(self) -> Stored:
        """The files of the run. Raises ResultsError as long as it has none, or where what is there is of an earlier one."""
        if not self.begun:
            why = f": {self.error}" if self.error is not None else " yet"
            others = "; what is in the folder is of an earlier run" if self.is_there() else ""
            raise ResultsError(f"{self.folder}: the run has no row{why}{others}")
        return self.files

    @property
    def history(self) -> pd.DataFrame:
        """A row per increment, from the unloaded state on: step, load_factor, the columns of the scene, reactions, energy_balance."""
        return self.stored.history()

    @property
    def summary(self) -> dict[str, Any]:
        """summary.json: sizes, counts, residual, energy balance, snaps, times, warnings; there when the run has ended."""
        return self.stored.summary()

    @property
    def warnings(self) -> list[Warned]:
        """The warnings of the run, with their codes."""
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

        `s` runs from 0 at `attrs["start"]` to 1 at `attrs["end"]`, as probes count; the normal points from `attrs["side_a"]` to `attrs["side_b"]`; the
        sum of `length` over the points is that of what they stand for. Index (row, point). Raises ResultsError."""
        name = self.stored.interface(name)
        rows = self.stored.rows() if row == "all" else [self.stored.row(row)]
        if not rows:
            self.stored.row(-1)
        frame = self.stored.along(name, rows)
        if frame.attrs["side_a"] is None and self.scene is not None:
            frame.attrs["side_a"], frame.attrs["side_b"] = sides_in(self.scene, name)
        return frame

    # --- pictures

    def plot(self, field: Literal["displacement", "principal_stress"] = "displacement", row: int = -1, **view: Any) -> Picture:
        """The deformed mesh coloured by displacement, or principal stresses as crosses.

        `view`: `zoom=((x0, x1), (y0, y1))`, `subdomains=["dam*"]`, and `stress="MPa"`, `length="m"`: what the units of the numbers are called, which
        converts nothing."""
        from .pictures import of_run

        return of_run.draw(self, field, row, view)

    def crack_map(self, row: int = -1, **view: Any) -> Picture:
        """All interfaces: opening as thickness, status as colour; `view` as of `plot`."""
        from .pictures import of_run

        return of_run.draw(self, "interfaces", row, view)

    def plot_interface(self, name: str, row: int = -1, *, stress: str = "MPa", length: str = "m") -> Picture:
        """Normal and tangential traction along an interface, its ends named; `stress` and `length` as of `plot`."""
        from .pictures import of_run

        return of_run.draw_traction(self, self.stored.interface(name), row, {"stress": stress, "length": length})

    def __repr__(self) -> str:
        if self.running:
            return f"Run {shown(self.folder)}: goes on"
        if not self.begun or not (self.folder / "summary.json").is_file():
            return f"Run {shown(self.folder)}: " + (f"ended without a row: {self.error}" if self.error is not None else "no summary")
        summary = self.summary
        counts, solution = summary["sizes"], summary["solution"]
        lines = [
            f"Run {shown(self.folder)}: {summary['title']}",
            f"  {counts['dofs']} dofs, {len(counts['subdomains'])} subdomains, {len(counts['interfaces'])} interfaces",
            f"  {solution['increments']} increments, {solution['iterations']} iterations, {summary['time']['total']:.3g} s; "
            f"energies balance to {solution['energy_balance']:.1e}",
        ]
        lines += [f"  stopped: {summary['stopped']}"] if summary["stopped"] else []
        return "\n".join([*lines, *(f"  {warned}" for warned in self.warnings)])


def shown(folder: Path) -> str:
    """A folder as it is seen from the working directory, where it lies below."""
    try:
        return str(folder.relative_to(Path.cwd()))
    except ValueError:
        return str(folder)


def sides_in(scene: dict[str, Any], name: str) -> tuple[str | None, str | None]:
    """The subdomains of side A and of side B of an interface, as the scene and the interface's name tell them."""
    entry, *pair = name.split("~")
    if len(pair) >= 2 and pair[0] in scene["subdomains"]:
        return pair[0], pair[1]
    found: list[str | None] = []
    for key in ("side_a", "side_b"):
        curve = scene["interfaces"].get(entry, {}).get(key)
        curve = curve[0] if isinstance(curve, list) and curve else curve
        owners = [part for part in scene["subdomains"] if isinstance(curve, str) and curve.startswith(f"{part}.")]
        found.append(max(owners, key=len) if owners else None)
    return found[0], found[1]


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
        if not isinstance(at, int):
            raise InputError(f"fields are counted: run.fields[-1], not run.fields[{at!r}]; a block of them is run.fields[-1][{at!r}]")
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
