"""The progress of a run as a bar, in a notebook or a terminal."""

from __future__ import annotations

import re
from typing import Any

from .bar import tqdm

ROW = re.compile(r"^(?P<step>.*?)\s+(?P<increment>\d+)/(?P<of>\d+)\s+(?P<load>\d\.\d+)\s")


class Progress:
    """A bar over the increments of all steps, moved by the lines that a run prints."""

    def __init__(self, scene: dict[str, Any], name: str) -> None:
        steps = scene.get("steps")
        known = [step for step in steps if isinstance(step, dict)] if isinstance(steps, list) else []
        self.names = [str(step.get("name", "")) for step in known] or [""]
        counts = [step.get("increments", 1) for step in known]
        self.counts = [count if isinstance(count, int) else 1 for count in counts] or [1]
        self.at, self.increment = 0, 0
        self.bar = tqdm(total=float(sum(self.counts)), desc=name, unit="increment", bar_format="{desc} {percentage:3.0f}% |{bar}| {elapsed}{postfix}")

    def line(self, text: str) -> None:
        """A line of the table of increments."""
        found = ROW.match(text)
        if found is None:
            return
        step, increment, count = found["step"].strip(), int(found["increment"]), int(found["of"])
        if step != self.names[self.at] or increment <= self.increment:
            later = (number for number in range(self.at + 1, len(self.names)) if self.names[number] == step)
            self.at = next(later, self.at)
        self.increment, self.counts[self.at] = increment, count
        done = sum(self.counts[: self.at]) + float(found["load"]) * count
        self.bar.total = float(sum(self.counts))
        self.bar.set_postfix_str(f"{step} {float(found['load']):.3f}", refresh=False)
        self.bar.update(done - self.bar.n)

    def close(self, done: bool) -> None:
        """The end: full, or where it stopped."""
        if done:
            self.bar.update(self.bar.total - self.bar.n)
        self.bar.close()
