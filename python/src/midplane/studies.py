"""A scene at many points of its keys."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import keys
from .bar import tqdm
from .errors import InputError
from .plain import digest, text_of, to_plain
from .running import Call
from .written import Written

if TYPE_CHECKING:
    from .scene import Scene

ROW = re.compile(r"^\s*(\d+)/(\d+)\s")
TAKES = {"last": 1, "peak": 1, "reached": 0, "at_peak": 2}  # measures by a word, and how many probes they want


def study(
    scene: Scene,
    axes: Mapping[str, Any],
    measures: Mapping[str, Any] | None = None,
    *,
    design: Any = "grid",
    out: str | Path | None = None,
    jobs: int = 1,
    threads: int | None = None,
    trust_geo: bool = False,
    geo_path: str | Path | Sequence[str | Path] = (),
    gmsh: str | Path | None = None,
    progress: bool = True,
    **more: Any,
) -> pd.DataFrame:
    """Runs the scene at many points and returns study.csv, a row per point; docs/STUDIES.md has the columns.

    `axes` are {key of the scene, or SUBDOMAIN.PARAMETER of a geometry: [values]}, or axes as a study file has them; `measures`
    {name: probe} for its last value, {name: ("peak", probe)}, ("at_peak", probe, probe of the peak), ("reached",), or as a study file has them;
    `more` are further keys of a study file, such as `reference` and `repeat`. What is done already is not run again: call it anew after a restart
    or an interrupt. Points that fail have a `message`. Raises InputError, MachineError, Interrupted."""
    from .scene import flags, taken_back

    content = scene.data
    request: dict[str, Any] = {
        "axes": {name: axis(scene, content, name, values) for name, values in axes.items()},
        "measures": {name: measure(name, taken) for name, taken in (measures or {}).items()},
        "design": to_plain(design, "design"),
    } | to_plain(more, "study")
    name = f"{scene.name}-study-{digest([content, str(scene.folder), request])}"
    place = Path(out).expanduser().absolute() if out is not None else Path("results").absolute() / name
    written = Written()
    with taken_back(written):
        file, *said = scene.said(place, written)
        changes = scene.changes if "--set" in said else {}
        paths = said[said.index("--geo-path") :] if "--geo-path" in said else []
        request = {"scene": str((scene.cwd / file).resolve())} | request
        if changes:
            request["set"] = changes | request.get("set", {})
        below = place / "notebook" / f"study-{digest(request)}.json"
        words = flags(threads=threads, trust_geo=trust_geo, geo_path=geo_path, gmsh=gmsh)
        run(["study", str(written.file(below, text_of(request))), "-o", str(place), "--jobs", str(jobs), *paths, *words], scene, progress)
    table = pd.read_csv(place / "study.csv", keep_default_na=False, na_values=["", "NaN"], encoding="utf-8")
    table.attrs["folder"] = str(place)
    return table


def run(arguments: list[str], scene: Scene, progress: bool) -> None:
    """Runs the study with a bar."""
    bar = tqdm(desc=f"study of {scene.name}", unit="point") if progress else None

    def on_line(text: str) -> None:
        found = ROW.match(text)
        if found and bar is not None:
            bar.total = int(found[2])
            bar.update(int(found[1]) - bar.n)

    try:
        Call(arguments, on_line, scene.cwd).wait()
    finally:
        if bar is not None:
            bar.close()


def axis(scene: Scene, content: dict[str, Any], name: str, values: Any) -> Any:
    """An axis of a study file; a plain list of values is of the key or parameter that is its name. Raises InputError."""
    plain = to_plain(values, name)
    if isinstance(plain, dict) and {"key", "parameter"} & set(plain):
        return plain
    of = key_of(content, name)
    if isinstance(plain, dict):
        return of | plain
    if not isinstance(plain, list):
        raise InputError(f"axis {name}: {plain!r} is no list of values, such as [{plain!r}]")
    if of.get("key", "").rpartition("/")[2] in ("geo", "msh"):
        plain = [str(scene.folder / value) if isinstance(value, str) else value for value in plain]
    return of | {"values": plain}


def key_of(content: dict[str, Any], name: str) -> dict[str, str]:
    """What an axis changes: a parameter of a geometry, SUBDOMAIN.PARAMETER, or a key of the scene."""
    subdomain, _, parameter = name.rpartition(".")
    if parameter and subdomain in content.get("subdomains", {}):
        return {"parameter": name}
    return {"key": keys.pointer(keys.parts(name, content))}


def measure(name: str, taken: str | Sequence[str] | Mapping[str, Any]) -> Any:
    """A measure of a study file. Raises InputError."""
    if isinstance(taken, str):
        return {"take": "last", "of": taken}
    if isinstance(taken, Mapping):
        return to_plain(dict(taken), name)
    take, *of = taken
    if TAKES.get(take) != len(of):
        raise InputError(f'measure {name}: {taken!r} is none of a probe, ("last", probe), ("peak", probe), ("at_peak", probe, probe of the peak), ("reached",)')
    return {"take": take} | dict(zip(("of", "peak_of"), of, strict=False))
