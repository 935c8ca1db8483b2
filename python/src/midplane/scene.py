"""A scene in a notebook: its keys, its check, its runs and studies."""

from __future__ import annotations

import copy
import hashlib
import json
import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any, Literal

import pandas as pd

from . import keys, laws, scene_file, studies
from .checked import Check
from .errors import InputError
from .progress import Progress
from .run import Run
from .running import Call

Accuracy = Literal["draft", "normal", "fine"]
Content = dict[str, Any]


class Scene:
    """A scene file, the folder of a `scene.json`, or a scene as a dictionary whose geometries lie in `folder`.

    `scene["interfaces.base.law.cohesion"] = 0.5` changes a value for what is run from here on; the file stays as it is, and its own
    later changes count. Keys are those of the scene file, with dots or as a JSON pointer; numbers count in lists, from 0."""

    def __init__(self, source: str | Path | Mapping[str, Any], *, folder: str | Path = ".", name: str | None = None) -> None:
        self.changes: dict[str, Any] = {}
        self.own: Content | None = None
        self.file: Path | None = None
        if isinstance(source, Mapping):
            self.own = copy.deepcopy(dict(source))
            self.folder = Path(folder).absolute()
            self.name = name or "scene"
            return
        path = Path(source).expanduser()
        self.file = path / "scene.json" if path.is_dir() else path
        if not self.file.is_file():
            missing = "has no scene.json" if path.is_dir() else "there is no such file or folder"
            raise InputError(f"{path}: {missing} (looked in {Path.cwd()}); give a scene file, or the folder of a scene.json")
        self.folder = self.file.parent.absolute()
        stem = self.file.stem
        self.name = name or (self.folder.name if stem == "scene" else f"{self.folder.name}_{stem}")

    @property
    def data(self) -> Content:
        """The whole scene as a dictionary, a copy."""
        content = copy.deepcopy(self.own) if self.own is not None else self.read()
        for pointer, value in self.changes.items():
            keys.put(content, keys.parts(pointer, content), copy.deepcopy(value), self.place)
        return content

    def read(self) -> Content:
        """What the file holds now. Raises InputError."""
        assert self.file is not None
        try:
            return scene_file.read(self.file)
        except (ValueError, OSError) as error:
            raise InputError(f"{self.file}: {error}") from None

    @property
    def place(self) -> str:
        """The scene in messages."""
        return str(self.file or self.name)

    def __getitem__(self, key: str) -> Any:
        return keys.get(self.data, key, self.place)

    def __setitem__(self, key: str, value: Any) -> None:
        names = keys.parts(key, self.data)
        plain = to_plain(value, key)
        content = self.data
        keys.put(content, names, plain, self.place)
        if self.own is not None:
            self.own = content
        else:
            self.changes[keys.pointer(names)] = plain

    def __delitem__(self, key: str) -> None:
        content = self.data
        keys.without(content, key, self.place)
        # what is taken out cannot be said on top of a file
        self.own, self.file, self.changes = content, None, {}

    def copy(self) -> Scene:
        """Another scene with the same file and changes."""
        return copy.deepcopy(self)

    def __repr__(self) -> str:
        content = self.data
        lines = [f"Scene {self.name}: {content.get('title', '')}".rstrip(": ")]
        for part in ("subdomains", "interfaces", "steps"):
            entries = content.get(part, {})
            names = [entry.get("name", "?") for entry in entries] if isinstance(entries, list) else list(entries)
            lines.append(f"  {part:11} {', '.join(map(str, names))}")
        lines += [f"  {pointer} = {value!r}" for pointer, value in self.changes.items()]
        return "\n".join(lines)

    def check(self, out: str | Path | None = None, **options: Any) -> Check:
        """Everything short of solving: sizes, segments, gaps, stiffness, warnings. Raises InputError with what is wrong and where.

        Options are those of `run` but for `resume` and `checkpoint`."""
        place = self.results(out, options)
        call = Call(["check", *self.said(place), "-o", str(place), *flags(**options)])
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
        geo_path: Sequence[str | Path] = (),
        gmsh: str | Path | None = None,
        progress: bool = True,
        wait: bool = True,
    ) -> Run:
        """Meshes, solves and writes, with a progress bar; the options are those of `midplane run --help`.

        Results go to `results/<name>`, with changes to `results/<name>-<a hash of them>`, or to `out`. With `wait=False` the run is
        there at once, its results as they come, until `run.wait()`. Raises InputError, EquilibriumError (its `run` has the rows
        before), MachineError, and Interrupted on Ctrl-C (likewise)."""
        options: dict[str, Any] = {"accuracy": accuracy, "threads": threads, "checkpoint": checkpoint}
        options |= {"trust_geo": trust_geo, "geo_path": geo_path, "gmsh": gmsh}
        place = self.results(out, options)
        arguments = [*self.said(place), "-o", str(place), *flags(**options)]
        content = self.data
        bar = Progress(content, self.name) if progress else None
        run = Run(place, scene=content)
        run.begin(["run", *arguments], resume=resume, progress=bar)
        if wait:
            run.wait()
        return run

    def study(self, axes: Mapping[str, Any], measures: Mapping[str, Any] | None = None, **options: Any) -> pd.DataFrame:
        """Runs the scene at many points of its keys; see `midplane.studies.study`."""
        return studies.study(self, axes, measures, **options)

    def law(self, interface: str, path: str | Path | Mapping[str, Any], **options: Any) -> pd.DataFrame:
        """Drives one point of an interface's law along a path; see `midplane.law`."""
        return laws.law(self, interface, path, **options)

    def results(self, out: str | Path | None, options: Mapping[str, Any]) -> Path:
        """The folder of results: as told, else one for what is run."""
        if out is not None:
            return Path(out).expanduser()
        accuracy = options.get("accuracy")
        if self.own is None and not self.changes and accuracy is None:
            return Path("results") / self.name
        return Path("results") / f"{self.name}-{digest([self.data, accuracy])}"

    def said(self, place: Path) -> list[str]:
        """The scene as arguments of the program; one that is no file is written into the folder of the results."""
        if self.file is not None:
            return [str(self.file), *settings(self.changes)]
        place.mkdir(parents=True, exist_ok=True)
        return [str(self.write(place / "scene.json")), "--geo-path", str(self.folder)]

    def write(self, path: Path) -> Path:
        """Writes the scene to a file, its geometries with their whole paths."""
        content = self.data
        for part in content.get("subdomains", {}).values() if isinstance(content.get("subdomains"), dict) else ():
            for key in ("geo", "msh"):
                if isinstance(part, dict) and isinstance(part.get(key), str):
                    part[key] = str(self.folder / part[key])
        text = json.dumps(content, indent=2, ensure_ascii=False) + "\n"
        # the same file as before is left alone
        if not path.is_file() or path.read_text(encoding="utf-8") != text:
            path.write_text(text, encoding="utf-8")
        return path

    def temporary(self, folder: str) -> list[str]:
        """The scene as arguments, where nothing is to be kept."""
        return self.said(Path(folder)) if self.file is not None else [str(self.write(Path(folder) / "scene.json"))]


def to_plain(value: Any, key: str) -> Any:
    """A value as JSON has it: numbers of NumPy and tuples too. Raises InputError."""
    try:
        return json.loads(json.dumps(value, default=lambda other: other.tolist() if hasattr(other, "tolist") else other.__fspath__(), allow_nan=False))
    except (TypeError, ValueError, AttributeError):
        raise InputError(f"{key}: {value!r} ({type(value).__name__}) is nothing a scene can hold: numbers, text, true, false, lists, objects") from None


def settings(changes: Mapping[str, Any]) -> list[str]:
    """Changes as arguments of the program."""
    return [word for pointer, value in changes.items() for word in ("--set", f"{pointer}={json.dumps(value, ensure_ascii=False)}")]


def flags(
    *,
    accuracy: str | None = None,
    threads: int | None = None,
    checkpoint: str | None = None,
    trust_geo: bool = False,
    geo_path: Sequence[str | Path] = (),
    gmsh: str | Path | None = None,
) -> list[str]:
    """Options of the program."""
    paths = [geo_path] if isinstance(geo_path, str | Path) else geo_path
    said = {"--accuracy": accuracy, "--threads": threads, "--checkpoint": checkpoint, "--gmsh": gmsh}
    words = [word for flag, value in said.items() if value is not None for word in (flag, str(value))]
    words += [word for path in paths for word in ("--geo-path", str(path))]
    return words + (["--trust-geo"] if trust_geo else [])


def digest(content: Any) -> str:
    """Eight letters that stand for a content."""
    return hashlib.sha256(json.dumps(content, sort_keys=True).encode()).hexdigest()[:8]


def scene_of(source: Scene | str | Path | Mapping[str, Any]) -> Scene:
    """A scene of what a function takes for one."""
    return source if isinstance(source, Scene) else Scene(source)


def folder_for_nothing() -> tempfile.TemporaryDirectory[str]:
    """A folder that goes away."""
    return tempfile.TemporaryDirectory(prefix="midplane-")
