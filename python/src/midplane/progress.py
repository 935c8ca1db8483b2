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
        counts = [step.get("increments", 1) for step in steps if isinstance(step, dict)] if isinstance(steps, list) else []
        self.counts = [count if isinstance(count, int) else 1 for count in counts] or [1]
        self.at, self.load = 0, 0.0
        self.bar = tqdm(total=float(sum(self.counts)), desc=name, unit="increment", bar_format="{desc} {percentage:3.0f}% |{bar}| {elapsed}{postfix}")

    def line(self, text: str) -> None:
        """A line of the table of increments."""
        found = ROW.match(text)
        if found is None:
            return
        load, count = float(found["load"]), int(found["of"])
        if load < self.load and int(found["increment"]) == 1 and self.at < len(self.counts) - 1:
            self.at += 1
        self.load = load
        self.counts[self.at] = count
        done = sum(self.counts[: self.at]) + load * count
        self.bar.total = float(sum(self.counts))
        self.bar.set_postfix_str(f"{found['step'].strip()} {load:.3f}", refresh=False)
        self.bar.update(done - self.bar.n)

    def close(self, done: bool) -> None:
        """The end: full, or where it stopped."""
        if done:
            self.bar.update(self.bar.total - self.bar.n)
        self.bar.close()
