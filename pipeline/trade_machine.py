"""What a campaign was measured on."""

import os
import platform
import subprocess
import time
from pathlib import Path


def said(*command):
    """What a program says of itself, or nothing."""
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=20)
    except (OSError, subprocess.TimeoutExpired):
        return ""
    return (done.stdout or done.stderr).strip()


def machine(program):
    """Processor, cores, versions, commit, date."""
    cpu = platform.machine()
    info = Path("/proc/cpuinfo")
    if info.exists():
        models = [
            line.split(":", 1)[1].strip() for line in info.read_text().splitlines() if line.startswith("model name")
        ]
        cpu = models[0] if models else cpu
    return {
        "date": time.strftime("%Y-%m-%d"),
        "cpu": cpu,
        "cores": os.cpu_count(),
        "system": platform.platform(),
        "midplane": said(program, "--version"),
        "commit": said("git", "rev-parse", "--short", "HEAD"),
        "gmsh": said("gmsh", "--version"),
    }
