"""Files that this package writes for the program, such as a scene that is no file, and takes back where the program refuses them."""

from __future__ import annotations

import contextlib
import os
from pathlib import Path

from .errors import MachineError


class Written:
    """What was made by one call. Files of others are never touched: each of these has a name of its own."""

    def __init__(self) -> None:
        self.made: list[Path] = []

    def folder(self, path: Path) -> None:
        """A folder, with those above it. Raises MachineError."""
        missing = [place for place in (path, *path.parents) if not place.exists()]
        for place in reversed(missing):
            try:
                place.mkdir(exist_ok=True)
            except OSError as error:
                raise MachineError(f"{place}: cannot be made: {error.strerror}") from None
            self.made.append(place)

    def file(self, path: Path, text: str) -> Path:
        """A file, complete or not at all; the same one as before is left alone. Raises MachineError."""
        self.folder(path.parent)
        try:
            if path.is_file() and path.read_text(encoding="utf-8") == text:
                return path
            if not path.exists():
                self.made.append(path)
            aside = path.with_name(f"{path.name}.{os.getpid()}")
            aside.write_text(text, encoding="utf-8")
            aside.replace(path)
        except OSError as error:
            raise MachineError(f"{path}: cannot be written: {error.strerror}") from None
        return path

    def take_back(self) -> None:
        """Removes what was made and is not used by anything else."""
        for path in reversed(self.made):
            with contextlib.suppress(OSError):
                path.rmdir() if path.is_dir() else path.unlink()
        self.made = []
