"""Run the campaign of extremes and write its report.

Every row tries one extreme through the command line alone, on scenes written for it, and states what must happen: an accuracy
from a formula or an exact solution, or a refusal that names its reason. The report is Markdown and HTML with the curves;
one line per row is printed on the way. Exit code 1 if a row is not as expected.
"""

import argparse
import sys
import tempfile
import time
import traceback
from pathlib import Path

from . import report
from .program import Never, Program
from .row import Claim, Function, Trial
from .rows import ROWS


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(prog="python -m midplane_pipeline.extremes", description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("midplane", type=Path, help="the program")
    parser.add_argument("-o", "--out", type=Path, default=Path("results/extremes"), help="folder of the report")
    parser.add_argument("--docs", type=Path, help="folder that gets EXTREMES.md and its curves as well")
    parser.add_argument("--quick", action="store_true", help="shorter sweeps, for every change")
    parser.add_argument("rows", nargs="*", help="only these, such as B9")
    arguments = parser.parse_intermixed_args()
    missing = [f"B{i}" for i in range(1, 53) if f"B{i}" not in [entry[0] for entry in ROWS]]
    if missing:
        sys.exit(f"there is no row {', '.join(missing)}")
    chosen = [entry for entry in ROWS if not arguments.rows or entry[0] in arguments.rows]
    chosen.sort(key=lambda entry: int(entry[0][1:]))
    done = []
    with tempfile.TemporaryDirectory(prefix="extremes-") as folder:
        for number, tried, expected, function in chosen:
            done.append(attempt(number, tried, expected, function, Program(arguments.midplane, folder), arguments.quick))
            print(report.line(done[-1]), flush=True)
    report.write(done, arguments.out, arguments.docs)
    missed = [entry for entry in done if not entry.good]
    print(f"{len(done) - len(missed)} of {len(done)} rows as expected: {arguments.out / 'report.html'}")
    sys.exit(1 if missed else 0)


def attempt(number: str, tried: str, expected: str, function: Function, program: Program, quick: bool) -> report.Entry:
    """Tries one row; whatever breaks it is a finding."""
    trial, start = Trial(program, quick), time.monotonic()
    try:
        function(trial)
    except Never as never:
        trial.claims.append(Claim("never: panic, NaN, silence, more than 60 s", str(never), "never", False))
    except Exception as error:  # a row that breaks is a row that is not as expected
        trial.claims.append(Claim("the row runs", described(error), "no exception", False))
    return report.Entry(number, tried, expected, trial, time.monotonic() - start, program.runs)


def described(error: Exception) -> str:
    """An exception and the line of the row it came from."""
    frames = [f for f in traceback.extract_tb(sys.exc_info()[2]) if Path(f.filename).parent.name == "rows"]
    place = f" ({Path(frames[-1].filename).name}:{frames[-1].lineno})" if frames else ""
    return f"{type(error).__name__}: {str(error)[:200]}{place}"


if __name__ == "__main__":
    main()
