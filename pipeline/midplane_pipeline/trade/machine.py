"""The machine and the programs of a campaign."""

import os
import platform
import subprocess
import time
from pathlib import Path
from typing import Any

from midplane_pipeline.bench.scenes import processor


def said(*command: str | Path) -> str:
    """Output of a program about itself, or nothing."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return (done.stdout or done.stderr).strip()


def machine(program: Path) -> dict[str, Any]:
    """Processor, cores, versions, commit, date."""
    return {
        "date": time.strftime("%Y-%m-%d"),
        "cpu": processor(),
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "midplane": said(program, "--version"),
        "commit": said("git", "rev-parse", "--short", "HEAD"),
        "gmsh": said("gmsh", "--version"),
    }


def mesher(out: Path) -> Path:
    """gmsh with its version at hand. Every run asks for it, and gmsh takes ten times as long to say it as a small run."""
    script = (out / "gmsh").resolve()
    version = said("gmsh", "--version")
    script.write_text(f'#!/bin/sh\n[ "$1" = --version ] && echo "{version}" && exit\nexec gmsh "$@"\n')
    script.chmod(0o755)
    return script


def pin(cores: set[int] | None = None) -> set[int] | None:
    """Keeps this process and all that it starts on some cores, or on one; returns those before. Linux only."""
    if not hasattr(os, "sched_setaffinity"):
        return None
    before = os.sched_getaffinity(0)
    os.sched_setaffinity(0, cores or {max(before)})
    return before
