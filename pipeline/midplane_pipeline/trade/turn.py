"""A scene turned about the origin: supports, loads and exact fields turn with it, and answers are read in the old axes.

A place x of the scene goes to R x; a vector field f(x) becomes R f(Rᵀ x). Supports hold along x and y, so a scene on
rollers can turn by a right angle only; one that is held in both directions wherever it is held turns by 30 degrees."""

import math
import re
from collections.abc import Mapping, Sequence
from typing import Any

KNOWN = {"name", "increments", "control", "fix", "displace", "load"}


class Turn:
    """The turn of a scene by 30 degrees, or by 90 if it stands on rollers."""

    def __init__(self, scene: dict[str, Any]) -> None:
        held = [directions for step in scene["steps"] for directions in supports(step).values()]
        self.degrees = 30 if all(len(directions) == 2 for directions in held) else 90
        angle = math.radians(self.degrees)
        self.cosine, self.sine = (0.0, 1.0) if self.degrees == 90 else (math.cos(angle), math.sin(angle))

    def vector(self, x: Any, y: Any) -> list[Any]:
        """R (x, y), numbers or formulas."""
        c, s = self.cosine, self.sine
        if isinstance(x, str) or isinstance(y, str):
            x, y = self.formula(x), self.formula(y)
            return [f"({c!r})*({x})-({s!r})*({y})", f"({s!r})*({x})+({c!r})*({y})"]
        return [c * x - s * y, s * x + c * y]

    def back(self, x: Any, y: Any) -> tuple[float, float]:
        """Rᵀ (x, y)."""
        return self.cosine * x + self.sine * y, self.cosine * y - self.sine * x

    def formula(self, value: Any) -> Any:
        """A formula in the old x and y as one in the new."""
        if not isinstance(value, str):
            return value
        old = {
            "x": f"({self.cosine!r}*x+({self.sine!r})*y)",
            "y": f"({self.cosine!r}*y-({self.sine!r})*x)",
        }
        return re.sub(r"\b[xy]\b", lambda name: old[name[0]], value)

    def step(self, step: dict[str, Any]) -> dict[str, Any]:
        """A step of the scene."""
        if strange := set(step) - KNOWN:
            raise ValueError(f"a step with {', '.join(sorted(strange))} is not turned yet")
        fix, displace = {}, {}
        for group, held in supports(step).items():
            x, y = self.vector(held.get("x", 0.0), held.get("y", 0.0))
            # a single direction turns by a right angle only: into the other
            names = list(held) if len(held) == 2 else ["y" if "x" in held else "x"]
            given = {name: {"x": x, "y": y}[name] for name in names}
            if any(given.values()):
                displace[group] = given
            else:
                fix[group] = names
        load = {group: self.load(of) for group, of in step.get("load", {}).items()}
        kept = {key: step[key] for key in ("name", "increments", "control") if key in step}
        return kept | {"fix": fix, "displace": displace, "load": load}

    def load(self, load: dict[str, Any]) -> dict[str, Any]:
        """A load; pressures stay what they are."""
        return {kind: self.formula(value) if kind == "pressure" else self.vector(*value) for kind, value in load.items()}

    def measure(self, measure: dict[str, Any]) -> dict[str, Any]:
        """A measure of a field; (n, t) components turn with the joint."""
        return measure | {"exact": [self.formula(value) for value in measure["exact"]]}

    def columns(self, probe: str) -> list[str]:
        """Columns that the history must have for a probe: both components of a displacement; reactions are there."""
        if displacement := re.fullmatch(r"(.+\.displacement_)[xy]", probe):
            return [displacement[1] + name for name in "xy"]
        return [] if probe.startswith("reaction:") else [probe]

    def along(self, history: Mapping[str, Sequence[float]], probe: str) -> Sequence[float]:
        """The values of a probe along a history, in the old axes."""
        if component := re.fullmatch(r"(.+\.displacement_|reaction:.+:)([xy])", probe):
            pairs = zip(history[component[1] + "x"], history[component[1] + "y"], strict=True)
            return [self.back(x, y)["xy".index(component[2])] for x, y in pairs]
        return history[probe]


def supports(step: dict[str, Any]) -> dict[str, dict[str, Any]]:
    """{group: {direction: displacement}} of a step."""
    held: dict[str, dict[str, Any]] = {}
    for group, directions in step.get("fix", {}).items():
        held.setdefault(group, {}).update({direction: 0.0 for direction in directions})
    for group, given in step.get("displace", {}).items():
        held.setdefault(group, {}).update(given)
    return held


def taken(measure: dict[str, Any], values: Sequence[float]) -> float:
    """The number that a measure takes from the values of its column."""
    return values[-1] if measure["take"] == "last" else max(values, key=abs)
