"""Folders of the project."""

from pathlib import Path

PIPELINE = Path(__file__).resolve().parents[1]  # what a Python without this package needs in PYTHONPATH
ROOT = PIPELINE.parent
