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
import weakref
from collections.abc import Callable, Sequence
from typing import Any

from .binary import program
from .errors import BY_CODE, Interrupted, MidplaneError

STOPPED = {128 + number for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP)}
CONTROL = re.compile(r"\x1b\[[0-9;]*m")
UNDER_WAY: weakref.WeakSet[Call] = weakref.WeakSet()


class Call:
    """The program at work. `on_line` is called with every line it prints on standard output, in a thread of its own."""

    def __init__(self, arguments: Sequence[str], on_line: Callable[[str], None] | None = None) -> None:
        self.on_line = on_line
        self.out: list[str] = []
        self.told: list[str] = []
        command = [*tied(), str(program()), *arguments]
        environment = os.environ | {"NO_COLOR": "1"}
        pipes: Any = {"stdin": subprocess.DEVNULL, "stdout": subprocess.PIPE, "stderr": subprocess.PIPE}
        # a group of its own: Ctrl-C in a terminal is passed on once, by `wait`
        self.process: subprocess.Popen[str] = subprocess.Popen(
            command, text=True, encoding="utf-8", errors="replace", env=environment, process_group=0, **pipes
        )
        self.readers = [threading.Thread(target=self.read_out, daemon=True), threading.Thread(target=self.read_told, daemon=True)]
        for reader in self.readers:
            reader.start()
        UNDER_WAY.add(self)

    def read_out(self) -> None:
        """Keeps what the program prints."""
        assert self.process.stdout is not None
        for line in self.process.stdout:
            self.out.append(line.rstrip("\n"))
            if self.on_line:
                self.on_line(self.out[-1])

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
        """Lets the program end as after Ctrl-C: all that it has found is on disk. Returns when it has ended."""
        if self.running:
            self.process.send_signal(signal.SIGINT)
        self.process.wait()

    def wait(self) -> str:
        """What the program printed, when it has ended. Raises what its exit code says, in its own words."""
        try:
            code = self.process.wait()
        except KeyboardInterrupt:
            self.stop()
            code = 128 + signal.SIGINT
        for reader in self.readers:
            reader.join()
        UNDER_WAY.discard(self)
        if code == 0:
            return "\n".join(self.out)
        text = self.error()
        if code in STOPPED:
            raise Interrupted(text or "interrupted")
        if code < 0:
            raise MidplaneError(f"the program was ended by signal {signal.Signals(-code).name}" + (f"\n{text}" if text else ""))
        raise BY_CODE.get(code, MidplaneError)(text)

    def message(self) -> str:
        """All that the program says beside its tables: warnings, and an error in the end."""
        return "\n".join(self.told)

    def error(self) -> str:
        """What it says of an end that is no good one, from "error:" on."""
        begin = next((number for number, line in enumerate(self.told) if line.startswith("error: ")), 0)
        return "\n".join(self.told[begin:]).strip().removeprefix("error: ")


def tied() -> list[str]:
    """What lets the program end, all on disk, when this process is gone without having been able to tell it (Linux)."""
    setpriv = shutil.which("setpriv") if sys.platform == "linux" and threading.current_thread() is threading.main_thread() else None
    return [setpriv, "--pdeathsig", "TERM", "--"] if setpriv else []


def stop_all() -> None:
    """Lets all programs end that are still at work."""
    for call in list(UNDER_WAY):
        call.stop()


atexit.register(stop_all)
