"""A scene in a notebook: its keys, its check, its runs and studies."""

from __future__ import annotations

import copy
import json
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Literal

import pandas as pd

from . import keys, laws, scene_file, studies
from .checked import Check
from .errors import EquilibriumError, InputError, Interrupted, MidplaneError
from .plain import digest, text_of, to_plain
from .progress import Progress
from .run import Run
from .running import Call
from .written import Written

Accuracy = Literal["draft", "normal", "fine"]
Content = dict[str, Any]
LONGEST = 60_000  # letters of changes that are said as options; more are written down


class Scene:
    """A scene file, the folder of a `scene.json`, or a scene as a dictionary whose geometries lie in `folder`.

    `scene["interfaces.base.law.cohesion"] = 0.5` changes a value for what is run from here on; the file stays as it is, and what is changed in it
    later counts too (until a key is deleted, which goes on from the file as it was then). Keys are those of the scene file, with dots or as a JSON
    pointer; numbers count in lists, from 0. What `scene[key]` and `scene.data` return are copies."""

    def __init__(self, source: Scene | str | Path | Mapping[str, Any], *, folder: str | Path = ".", name: str | None = None) -> None:
        self.changes: dict[str, Any] = {}
        self.own: Content | None = None
        self.file: Path | None = None
        self.cwd = Path.cwd()  # what relative paths are relative to
        if isinstance(source, Scene):
            self.__dict__.update(copy.deepcopy(source.__dict__))
            self.name: str = name or source.name
        elif isinstance(source, Mapping):
            self.own = to_plain(dict(source), "scene")
            self.folder = Path(folder).expanduser().resolve()
            self.name = name or "scene"
        elif isinstance(source, str | Path):
            path = Path(source).expanduser()
            self.file = path / "scene.json" if path.is_dir() else path
            if not self.file.is_file():
                missing = "has no scene.json" if path.is_dir() else "there is no such file or folder"
                raise InputError(f"{path}: {missing} (looked in {self.cwd}); give a scene file, or the folder of a scene.json")
            self.folder = self.file.resolve().parent
            stem = self.file.stem
            self.name = name or (self.folder.name if stem == "scene" else f"{self.folder.name}_{stem}")
        else:
            raise InputError(f"a scene is a file, a folder or a dictionary, not a {type(source).__name__}")
        if not self.name or self.name in (".", "..") or any(letter in self.name for letter in "/\\\0"):
            raise InputError(f"{self.name!r} is no name for a scene: it names the folder of its results")

    @property
    def data(self) -> Content:
        """The whole scene as a dictionary, a copy."""
        content = self.base()
        for pointer, value in self.changes.items():
            keys.put(content, keys.parts(pointer, content), copy.deepcopy(value), self.place)
        return content

    def base(self) -> Content:
        """The scene without changes, a copy. Raises InputError."""
        if self.file is None:
            return copy.deepcopy(self.own or {})
        try:
            return scene_file.read(self.cwd / self.file)
        except json.JSONDecodeError as error:
            raise InputError(f"{self.file}:{error.lineno}: is no JSON: {error.msg}, column {error.colno}") from None
        except (ValueError, OSError) as error:
            raise InputError(f"{self.file}: {error}") from None

    @property
    def place(self) -> str:
        """The scene in messages."""
        return str(self.file or self.name)

    def __getitem__(self, key: str) -> Any:
        content = self.data
        return keys.seen(keys.get(content, key, self.place), ".".join(keys.parts(key, content)))

    def __setitem__(self, key: str, value: Any) -> None:
        content = self.data
        names = keys.parts(key, content)
        plain = to_plain(value, key)
        keys.put(content, names, plain, self.place)
        pointer = keys.pointer(names)
        self.forget(pointer)
        self.changes[pointer] = plain

    def __delitem__(self, key: str) -> None:
        content = self.data
        keys.without(content, key, self.place)
        # what is taken out cannot be said on top of a file
        self.own, self.file, self.changes = content, None, {}

    def forget(self, pointer: str) -> None:
        """Drops earlier changes of a key and of what lies below it."""
        self.changes = {key: value for key, value in self.changes.items() if key != pointer and not key.startswith(f"{pointer}/")}

    def __contains__(self, key: str) -> bool:
        return keys.has(self.data, key)

    def __iter__(self) -> Iterator[str]:
        return iter(self.data)

    def copy(self) -> Scene:
        """Another scene with the same file and changes."""
        return copy.deepcopy(self)

    def __repr__(self) -> str:
        try:
            content = self.data
        except MidplaneError as error:
            return f"Scene {self.name}: {error}"
        lines = [f"Scene {self.name}: {content.get('title', '')}".rstrip(": ")]
        for part in ("subdomains", "interfaces", "steps"):
            entries = content.get(part)
            names = list(entries) if isinstance(entries, dict) else []
            if isinstance(entries, list):
                names = [entry.get("name", "?") if isinstance(entry, dict) else "?" for entry in entries]
            lines.append(f"  {part:11} {', '.join(map(str, names))}")
        lines += [f"  {pointer} = {value!r}" for pointer, value in self.changes.items()]
        return "\n".join(lines)

    def check(
        self,
        out: str | Path | None = None,
        *,
        accuracy: Accuracy | None = None,
        trust_geo: bool = False,
        geo_path: str | Path | Sequence[str | Path] = (),
        gmsh: str | Path | None = None,
    ) -> Check:
        """Everything short of solving: sizes, segments, gaps, stiffness, warnings. Raises InputError with what is wrong and where."""
        place, written = self.results(out, accuracy), Written()
        words = flags(accuracy=accuracy, trust_geo=trust_geo, geo_path=geo_path, gmsh=gmsh)
        with taken_back(written):
            call = Call(["check", *self.said(place, written), "-o", str(place), *words], folder=self.cwd)
            text = call.wait()
        return Check(text, call.message())

    def run(
        self,
        out: str | Path | None = None,
        *,
        accuracy: Accuracy | None = None,
        threads: int | None = None,
        resume: bool = False,
        checkpoint: str | None = None,
        trust_geo: bool = False,
        geo_path: str | Path | Sequence[str | Path] = (),
        gmsh: str | Path | None = None,
        gmsh_limit: float | None = None,
        gmsh_memory: float | None = None,
        progress: bool = True,
        wait: bool = True,
    ) -> Run:
        """Meshes, solves and writes, with a progress bar; the options are those of `midplane run --help`.

        Results go to `results/<name>`; those of a dictionary, of a changed scene or of a preset (`accuracy`) to `results/<name>-<hash>`, so that runs
        that differ do not meet; or to `out`. A run replaces what an earlier one has left in its folder, so an older `Run` of that folder reads the
        new results. With `wait=False` the run is there at once, its results as they come, and what goes wrong is told by `run.wait()`. Raises
        InputError, EquilibriumError (its `run` has the rows before), MachineError, and Interrupted on Ctrl-C (likewise)."""
        place, written = self.results(out, accuracy), Written()
        words = flags(
            accuracy=accuracy,
            threads=threads,
            checkpoint=checkpoint,
            trust_geo=trust_geo,
            geo_path=geo_path,
            gmsh=gmsh,
            gmsh_limit=gmsh_limit,
            gmsh_memory=gmsh_memory,
        )
        content = self.data
        run = Run(place, scene=content)
        asked = {"scene": self.asked(), "options": words}
        with taken_back(written):
            said = self.said(place, written)
            bar = Progress(content, self.name) if progress else None
            run.begin(["run", *said, *words], asked, self.cwd, resume=resume, progress=bar, written=written)
        return run.wait() if wait else run

    def study(self, axes: Mapping[str, Any], measures: Mapping[str, Any] | None = None, **options: Any) -> pd.DataFrame:
        """Runs the scene at many points of its keys; see `midplane.studies.study`."""
        return studies.study(self, axes, measures, **options)

    def law(self, interface: str, path: str | Path | Mapping[str, Any], **options: Any) -> pd.DataFrame:
        """Drives one point of an interface's law along a path; see `midplane.law`."""
        return laws.law(self, interface, path, **options)

    def results(self, out: str | Path | None, accuracy: Accuracy | None = None) -> Path:
        """The folder of results, whole path: as told, else one for what is run."""
        if out is not None:
            return Path(out).expanduser().absolute()
        if self.file is not None and not self.changes and accuracy is None:
            return Path("results").absolute() / self.name
        return Path("results").absolute() / f"{self.name}-{digest([self.data, accuracy, str(self.folder)])}"

    def said(self, place: Path, written: Written) -> list[str]:
        """The scene as arguments of the program; one that is no file is written into the folder of the results, beside its own content's name."""
        words = settings(self.changes)
        too_much = sum(map(len, words)) > LONGEST or any("=" in pointer for pointer in self.changes)
        if self.file is not None and not too_much:
            return [str(self.file), *words]
        content = self.data if too_much else self.base()
        self.find(content)
        below = place / "notebook" / digest([content, str(self.folder)]) / self.name
        file = written.file(below / "scene.json", text_of(content))
        return [str(file), *([] if too_much else words), "--geo-path", str(self.folder)]

    def find(self, content: Content) -> None:
        """Gives the geometries of a scene their whole paths."""
        parts = content.get("subdomains")
        for part in parts.values() if isinstance(parts, dict) else ():
            for key in ("geo", "msh"):
                if isinstance(part, dict) and isinstance(part.get(key), str):
                    part[key] = str(self.folder / part[key])

    def asked(self) -> dict[str, Any]:
        """The scene as it is written down for `Run.resume`."""
        file = str((self.cwd / self.file).resolve()) if self.file is not None else None
        return {"file": file, "own": self.own, "folder": str(self.folder), "name": self.name, "changes": self.changes}

    @staticmethod
    def of(asked: Mapping[str, Any]) -> Scene:
        """The scene that was written down."""
        scene = Scene(asked["file"] or asked["own"], folder=asked["folder"], name=asked["name"])
        scene.changes = dict(asked["changes"])
        return scene


@contextmanager
def taken_back(written: Written) -> Iterator[None]:
    """Takes back what was written for a call that is refused."""
    try:
        yield
    except (EquilibriumError, Interrupted):
        raise
    except BaseException:
        written.take_back()
        raise


def settings(changes: Mapping[str, Any]) -> list[str]:
    """Changes as arguments of the program."""
    return [word for pointer, value in changes.items() for word in ("--set", f"{keys.option(pointer)}={json.dumps(value)}")]


def flags(
    *,
    accuracy: str | None = None,
    threads: int | None = None,
    checkpoint: str | None = None,
    trust_geo: bool = False,
    geo_path: str | Path | Sequence[str | Path] = (),
    gmsh: str | Path | None = None,
    gmsh_limit: float | None = None,
    gmsh_memory: float | None = None,
) -> list[str]:
    """Options of the program."""
    paths = [geo_path] if isinstance(geo_path, str | Path) else geo_path
    said: dict[str, Any] = {"--accuracy": accuracy, "--threads": threads, "--checkpoint": checkpoint, "--gmsh": gmsh}
    said |= {"--gmsh-limit": gmsh_limit, "--gmsh-memory": gmsh_memory}
    words = [word for flag, value in said.items() if value is not None for word in (flag, str(value))]
    words += [word for path in paths for word in ("--geo-path", str(Path(path).expanduser().absolute()))]
    return words + (["--trust-geo"] if trust_geo else [])


def scene_of(source: Scene | str | Path | Mapping[str, Any]) -> Scene:
    """A scene of what a function takes for one."""
    return source if isinstance(source, Scene) else Scene(source)
