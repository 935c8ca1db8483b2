"""A scene at many points of its keys."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any

import pandas as pd

from . import keys
from .bar import tqdm
from .running import Call

if TYPE_CHECKING:
    from .scene import Scene

ROW = re.compile(r"^\s*(\d+)/(\d+)\s")


def study(
    scene: Scene,
    axes: Mapping[str, Any],
    measures: Mapping[str, Any] | None = None,
    *,
    design: Any = "grid",
    out: str | Path | None = None,
    jobs: int = 1,
    threads: int | None = None,
    progress: bool = True,
    **more: Any,
) -> pd.DataFrame:
    """Runs the scene at many points and returns study.csv, a row per point; README "Studies" has the columns.

    `axes` are {key of the scene, or SUBDOMAIN.PARAMETER of a geometry: [values]}, or axes as a study file has them; `measures`
    {name: probe} for its last value, {name: ("peak", probe)}, or as a study file has them; `more` are further keys of a study
    file, such as `reference` and `repeat`. What is done already is not run again: call it anew after a restart. Points that
    fail have a `message`. Raises InputError, MachineError, Interrupted."""
    from .scene import digest

    content = scene.data
    request: dict[str, Any] = {
        "scene": str(scene.file.absolute()) if scene.file else "scene.json",
        "axes": {name: axis(content, name, values) for name, values in axes.items()},
        "measures": {name: measure(taken) for name, taken in (measures or {}).items()},
        "design": design,
    } | more
    if scene.changes:
        request["set"] = scene.changes | request.get("set", {})
    place = Path(out).expanduser() if out is not None else Path("results") / f"{scene.name}-study-{digest([content, request])}"
    place.mkdir(parents=True, exist_ok=True)
    paths = [] if scene.file else ["--geo-path", str(scene.folder)]
    if not scene.file:
        scene.write(place / "scene.json")
    file = place / "request.json"
    file.write_text(json.dumps(request, indent=2, ensure_ascii=False) + "\n")
    bar = tqdm(desc=f"study of {scene.name}", unit="point") if progress else None

    def on_line(text: str) -> None:
        found = ROW.match(text)
        if found and bar is not None:
            bar.total = int(found[2])
            bar.update(int(found[1]) - bar.n)

    options = ["--jobs", str(jobs), *(["--threads", str(threads)] if threads is not None else [])]
    try:
        Call(["study", str(file), "-o", str(place), *options, *paths], on_line).wait()
    finally:
        if bar is not None:
            bar.close()
    table = pd.read_csv(place / "study.csv")
    table.attrs["folder"] = str(place)
    return table


def axis(content: dict[str, Any], name: str, values: Any) -> Any:
    """An axis of a study file; a plain list of values is of the key or parameter that is its name."""
    if isinstance(values, Mapping):
        return dict(values)
    plain = values.tolist() if hasattr(values, "tolist") else list(values)
    subdomain, _, parameter = name.rpartition(".")
    if parameter and subdomain in content.get("subdomains", {}):
        return {"parameter": name, "values": plain}
    return {"key": keys.pointer(keys.parts(name, content)), "values": plain}


def measure(taken: str | Sequence[str] | Mapping[str, Any]) -> Any:
    """A measure of a study file."""
    if isinstance(taken, str):
        return {"take": "last", "of": taken}
    if isinstance(taken, Mapping):
        return dict(taken)
    take, of = taken
    return {"take": take, "of": of}
