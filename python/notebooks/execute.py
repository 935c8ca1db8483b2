#!/usr/bin/env python3
"""Execute the notebooks beside this file in an empty folder, as a reader does, cell by cell.

    execute.py OUT [--keep]

Copies with their outputs go to OUT; an error in a cell ends it with exit code 1. `--keep` puts the outputs into the
notebooks themselves, without progress bars.
"""

import argparse
import sys
import time
from pathlib import Path

import nbformat
from nbclient import NotebookClient
from nbclient.exceptions import CellExecutionError

HERE = Path(__file__).resolve().parent
LONGEST = 300  # of a cell [s]


def execute(path: Path, out: Path, keep: bool) -> bool:
    """Whether a notebook runs through."""
    folder = out / path.stem
    folder.mkdir(parents=True, exist_ok=True)
    notebook = nbformat.read(path, 4)
    begin = time.monotonic()
    failed = None
    try:
        NotebookClient(notebook, timeout=LONGEST, resources={"metadata": {"path": str(folder)}}).execute()
    except CellExecutionError as error:
        failed = error
    nbformat.write(notebook, out / path.name)
    print(f"{path.name}: {failed or f'{time.monotonic() - begin:.0f} s'}", flush=True)
    if keep and not failed:
        for cell in notebook.cells:
            cell.get("metadata", {}).pop("execution", None)
            if cell.cell_type == "code":
                cell.outputs = [output for output in cell.outputs if output.get("name") != "stderr"]
        nbformat.write(notebook, path)
    return failed is None


def main() -> None:
    """All notebooks, one after the other."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("out", type=Path)
    parser.add_argument("--keep", action="store_true")
    options = parser.parse_args()
    good = [execute(path, options.out.resolve(), options.keep) for path in sorted(HERE.glob("*.ipynb"))]
    sys.exit(0 if all(good) else 1)


if __name__ == "__main__":
    main()
