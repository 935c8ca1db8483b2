"""A call of the program: started, watched, interrupted, its words kept."""

from __future__ import annotations

import atexit
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import warnings
import weakref
from collections.abc import Callable, Sequence
from functools import cache
from pathlib import Path
from typing import Any

from .binary import program
from .errors import BY_CODE, PACKAGE, Interrupted, MachineError, MidplaneError

STOPPED = {128 + number for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
CONTROL = re.compile(r"\x1b\[[0-9;]*m")
UNDER_WAY: weakref.WeakSet[Call] = weakref.WeakSet()


class MidplaneWarning(UserWarning):
    """What the program warns of; docs/WARNINGS.md has a section for each code."""


class Call:
    """The program at work, in a folder. `on_line` is called with every line it prints on standard output, in a thread of its own."""

    def __init__(self, arguments: Sequence[str], on_line: Callable[[str], None] | None = None, folder: Path | None = None) -> None:
        self.on_line = on_line
        self.out: list[str] = []
        self.told: list[str] = []
        self.trouble: Exception | None = None
        command = [*tied(), str(program()), *arguments]
        pipes: Any = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        # a group of its own: Ctrl-C in a terminal is passed on once, by `wait`
        pipes |= {"cwd": folder, "env": os.environ | {"NO_COLOR": "1"}, "process_group": 0}
        try:
            self.process: subprocess.Popen[str] = subprocess.Popen(command, text=True, encoding="utf-8", errors="replace", **pipes)
        except OSError as error:
            raise MachineError(f"{command[0]} does not start: {error.strerror}") from None
        self.readers = [threading.Thread(target=read, daemon=True) for read in (self.read_out, self.read_told)]
        for reader in self.readers:
            reader.start()
        UNDER_WAY.add(self)

    def read_out(self) -> None:
        """Keeps what the program prints."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.out.append(line.rstrip("\n"))
            if self.on_line is not None and self.trouble is None:
                try:
                    self.on_line(self.out[-1])
                except Exception as error:  # the program goes on whatever a bar or a full disk does; `wait` tells it
                    self.trouble = error

    def read_told(self) -> None:
        """Keeps what it warns of, and its error."""
        assert self.process.stderr is not None
        for line in self.process.stderr:
            self.told.append(CONTROL.sub("", line).rstrip("\n"))

    @property
    def running(self) -> bool:
        """Whether the program is at work."""
        return self.process.poll() is None

    def stop(self) -> None:
        """Lets the program end as after Ctrl-C: all that it has found is on disk. Returns when it has ended; a second Ctrl-C ends it at once."""
        if self.running:
            self.process.send_signal(signal.SIGINT)
        try:
            self.process.wait()
        except KeyboardInterrupt:
            self.process.send_signal(signal.SIGINT)
            self.process.wait()

    def wait(self) -> str:
        """What the program printed, when it has ended. Raises what its exit code says, in its own words."""
        try:
            code = self.process.wait()
        except KeyboardInterrupt:
            self.stop()
            code = 128 + signal.SIGINT
        self.wait_quietly()
        if self.trouble is not None:
            warn(f"the progress of the program was lost: {self.trouble}")
        if code == 0:
            return "\n".join(self.out)
        text = self.error()
        if code in STOPPED:
            raise Interrupted(text or "interrupted")
        if code < 0:
            raise MidplaneError(f"the program was ended by signal {signal.Signals(-code).name}" + (f"\n{text}" if text else ""))
        raise BY_CODE.get(code, MidplaneError)(text)

    def wait_quietly(self) -> None:
        """Until the program has ended and all that it has printed is read."""
        self.process.wait()
        for reader, pipe in zip(self.readers, (self.process.stdout, self.process.stderr), strict=True):
            reader.join()
            assert pipe is not None
            pipe.close()
        UNDER_WAY.discard(self)

    def message(self) -> str:
        """All that the program says beside its tables: warnings, and an error in the end."""
        return "\n".join(self.told)

    def error(self) -> str:
        """What it says of an end that is no good one, from "error:" on, and its notes."""
        begin = next((number for number, line in enumerate(self.told) if line.startswith("error: ")), 0)
        notes = [line for line in self.told[:begin] if line.startswith("note: ")]
        return "\n".join([*self.told[begin:], *notes]).strip().removeprefix("error: ")


def tied() -> list[str]:
    """What lets the program end, all on disk, when this process is gone without having been able to tell it (Linux, from the main thread)."""
    main = threading.current_thread() is threading.main_thread()
    setpriv = shutil.which("setpriv") if sys.platform == "linux" and main else None
    return [setpriv, "--pdeathsig", "TERM", "--"] if setpriv and knows_death(setpriv) else []


@cache
def knows_death(setpriv: str) -> bool:
    """Whether this `setpriv` has the option, which older ones have not."""
    try:
        return subprocess.run([setpriv, "--pdeathsig", "keep", "true"], capture_output=True, check=False, timeout=10).returncode == 0
    except (OSError, subprocess.TimeoutExpired):
        return False


def warn(text: str) -> None:
    """A warning at the user's own line."""
    level, frame = 1, sys._getframe(1)
    while frame.f_back is not None and PACKAGE in Path(frame.f_code.co_filename).parents:
        level, frame = level + 1, frame.f_back
    warnings.warn(text, MidplaneWarning, stacklevel=level + 1)


def stop_all() -> None:
    """Lets all programs end that are still at work."""
    for call in list(UNDER_WAY):
        call.stop()


atexit.register(stop_all)
