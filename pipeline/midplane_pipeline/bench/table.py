"""Put the measured tables into docs/BENCH.md, below its line `<!-- tables -->`.

python -m midplane_pipeline.bench.table docs/BENCH.md results/bench/scenes.csv results/bench/peers*.csv"""

import csv
import math
import sys
from pathlib import Path

Row = dict[str, str]  # of a table, as text

MARK = "<!-- tables -->"
NAMES = {"read meshes": "read", "factorisations": "/ factor"}


def read(path: Path | str) -> tuple[str, list[Row]]:
    """The comment of a table and its rows."""
    lines = Path(path).read_text().splitlines()
    return lines[0].removeprefix("# "), list(csv.DictReader(line for line in lines if not line.startswith("#")))


def table(head: list[str], rows: list[list[str]]) -> str:
    """A Markdown table, numbers to the right."""
    rule = ["---"] + ["---:"] * (len(head) - 1)
    return "\n".join("| " + " | ".join(row) + " |" for row in [head, rule, *rows])


def number(text: str, scale: float = 1.0, digits: int = 3) -> str:
    """A number to so many digits, or nothing."""
    return f"{scale * float(text):.{digits}g}" if text else ""


def runs(rows: list[Row]) -> str:
    """Times of whole runs and of their stages."""
    stages = ["read meshes", "bind", "assemble", "order", "factor", "prepare", "solve", "recover", "write"]
    head = ["scene", "dofs", "whole [s]", "/ factor", *(NAMES.get(s, s) for s in stages)]
    head += ["iterations", "each [ms]", "each / factor", "bytes per dof"]
    lines = []
    for row in rows:
        share = f"{100 * float(row['iteration']) / float(row['factor']):.1f} %" if row["iteration"] else ""
        lines.append(
            [
                row["scene"],
                f"{int(row['dofs']):,}".replace(",", " "),
                number(row["seconds"]),
                number(row["factorisations"], digits=2),
                *(number(row[s], digits=2) for s in stages),
                row["iterations"],
                number(row["iteration"], 1000.0, 2),
                share,
                f"{float(row['peak_bytes_per_dof']):.0f}",
            ]
        )
    return table(head, lines)


def growth(rows: list[Row]) -> str:
    """Exponents of seconds over dofs between 100k and the largest size."""
    what = ["seconds", "bind", "assemble", "order", "factor", "prepare", "solve", "write", "iteration"]
    lines = []
    for scene in dict.fromkeys(row["scene"] for row in rows):
        known = sorted((row for row in rows if row["scene"] == scene), key=lambda row: int(row["dofs"]))
        known = [row for row in known if int(row["dofs"]) > 50_000]
        if len(known) < 2:
            continue
        small, large = known[0], known[-1]
        cells = []
        for name in what:
            a, b = float(small[name] or 0), float(large[name] or 0)
            steps = math.log(int(large["dofs"]) / int(small["dofs"]))
            cells.append(f"{math.log(b / a) / steps:.2f}" if a > 1e-4 and b > 0 else "")
        lines.append([f"{scene}, {int(small['dofs'])} to {int(large['dofs'])}", *cells])
    return table(["exponent of", "whole", *what[1:]], lines) if lines else ""


def beside(rows: list[Row]) -> str:
    """Times of other programs beside ours."""
    head = ["scene", "program", "threads", "whole [s]", "ratio", "without imports", "ratio", "iterations"]
    head += ["bytes per dof", "answer"]
    lines = []
    for row in rows:
        first = row["program"].startswith("midplane")
        lines.append(
            [
                f"{row['scene']} {row['size']}",
                row["program"],
                row["threads"],
                number(row["seconds"]),
                number(row["ratio"]),
                "" if first else number(row["without_imports"]),
                "" if first else number(row["ratio_without_imports"]),
                "" if row["iterations"] == "0" else row["iterations"],
                f"{float(row['peak_bytes_per_dof']):.0f}",
                f"{float(row['answer']):.8g}",
            ]
        )
    return table(head, lines)


def main() -> None:
    """The command."""
    page, scenes, *peers = map(Path, sys.argv[1:])
    about, rows = read(scenes)
    parts = [MARK, f"## Whole runs\n\n{about}.", runs(rows), "## Growth", growth(rows)]
    for path in peers:
        about, rows = read(path)
        parts += [f"## Beside others: {rows[0]['size']} dofs\n\n{about}.", beside(rows)]
    text = page.read_text().split(MARK)[0].rstrip()
    page.write_text("\n\n".join([text, *(part for part in parts if part)]) + "\n")


if __name__ == "__main__":
    main()
