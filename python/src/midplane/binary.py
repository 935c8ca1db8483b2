"""The program that this package drives: where it is, and whether it fits."""

from __future__ import annotations

import os
import shutil
import subprocess
from functools import lru_cache
from pathlib import Path

from .errors import PACKAGE, MachineError, VersionError
from .version import __version__

# beside the package as a wheel may bring it, and where cargo puts it for a package that is used from the sources
BESIDE = [PACKAGE / "bin" / "midplane", PACKAGE.parents[2] / "target" / "release" / "midplane"]


def program() -> Path:
    """The program: what MIDPLANE names, else the one beside the package, else the first in PATH.

    Raises MachineError where there is none, VersionError where it is of another version than the package."""
    named = os.environ.get("MIDPLANE")
    if named:
        found = Path(named).expanduser()
        if not (found.is_file() and os.access(found, os.X_OK)):
            raise MachineError(f"MIDPLANE is {named}, which is no program (looked in {Path.cwd()})")
    else:
        beside = next((path for path in BESIDE if path.is_file() and os.access(path, os.X_OK)), None)
        in_path = shutil.which("midplane")
        if beside is None and in_path is None:
            raise MachineError(
                f"there is no program midplane: not beside the package ({PACKAGE / 'bin'}), not in PATH, and the environment variable MIDPLANE is not set. "
                "Build it with `cargo build --release` and set MIDPLANE to target/release/midplane"
            )
        found = beside or Path(str(in_path))
    found = found.absolute()
    check_version(found, found.stat().st_mtime_ns)
    return found


@lru_cache
def check_version(found: Path, changed: int) -> None:
    """Raises VersionError unless the program is of the package's version, but for the last number; `changed` makes a new one be asked."""
    options = {"capture_output": True, "text": True, "encoding": "utf-8", "errors": "replace", "stdin": subprocess.DEVNULL}
    try:
        ended = subprocess.run([found, "--version"], timeout=60, check=False, **options)  # type: ignore[call-overload]
    except OSError as error:
        raise MachineError(f"{found} does not start: {error.strerror}") from None
    except subprocess.TimeoutExpired:
        raise MachineError(f"{found} does not answer to --version within a minute") from None
    words = ended.stdout.split()
    if ended.returncode or len(words) != 2 or words[0] != "midplane":
        raise MachineError(f"{found} is not midplane; it answers {(ended.stdout or ended.stderr).strip()[:200]!r} to --version")
    if words[1].split(".")[:2] != __version__.split(".")[:2]:
        raise VersionError(f"{found} is midplane {words[1]}, this package is {__version__}: install both of one version, or set MIDPLANE to another program")
