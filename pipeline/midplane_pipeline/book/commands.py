"""Run what the documents tell the reader to type, page by page, in an empty folder with the program in PATH.

    python -m midplane_pipeline.book.commands --program target/release/midplane README.md docs/*.md

A page is one session of a reader. Blocks are taken in their order:

    ```json title="scene.json"    the file of that name
    ```sh                         commands, which must succeed
    ```python                     a program, which must succeed
    ```text                       after `<!-- prints -->`: lines of what the block before has printed; … stands for anything

A block after `<!-- not run: reason -->` is left out and listed; one after `<!-- fails: code -->` must end with that exit code. The folder
shows `geo`, `pipeline`, `python` and `.venv` of the repository beside what the page makes, so that pages may use the gallery."""

import argparse
import os
import re
import subprocess
import sys
import tempfile
from dataclasses import dataclass, field
from pathlib import Path

BLOCK = re.compile(r"(?P<mark><!-- (?P<note>[^>]*) -->\n+)?^```(?P<kind>[\w-]+)(?P<info>[^\n]*)\n(?P<text>.*?)^```$", re.M | re.S)
TITLE = re.compile(r'title="([^"]+)"')
SHOWN = ("geo", "pipeline", "python", ".venv")
LIMIT = 900


@dataclass
class Session:
    """A reader of one page."""

    page: Path
    folder: Path
    environment: dict[str, str]
    printed: str = ""
    ran: int = 0
    left: list[str] = field(default_factory=list)
    wrong: list[str] = field(default_factory=list)

    def read(self) -> None:
        """Do what the page says."""
        text = self.page.read_text(encoding="utf-8")
        for block in BLOCK.finditer(text):
            note, kind = block["note"] or "", block["kind"]
            line = text.count("\n", 0, block.start("kind")) + 1
            title = TITLE.search(block["info"])
            if note.startswith("not run:"):
                self.left.append(f"{self.page}:{line}: {note}")
            elif title:
                path = self.folder / title[1]
                path.parent.mkdir(parents=True, exist_ok=True)
                path.write_text(block["text"], encoding="utf-8")
            elif kind in ("sh", "python"):
                self.run(kind, block["text"], int(note.removeprefix("fails:")) if note.startswith("fails:") else 0, line)
            elif note == "prints":
                self.compare(block["text"], line)

    def run(self, kind: str, text: str, code: int, line: int) -> None:
        """Run a block, and say so where it does not end as told."""
        command = ["bash", "-euo", "pipefail", "-c", text] if kind == "sh" else ["python", "-c", text]
        done = subprocess.run(command, cwd=self.folder, env=self.environment, capture_output=True, text=True, timeout=LIMIT)
        self.printed = done.stdout + done.stderr
        self.ran += 1
        if done.returncode != code:
            self.wrong.append(f"{self.page}:{line}: ends with {done.returncode}, not {code}:\n{text}{self.printed}")

    def compare(self, expected: str, line: int) -> None:
        """Every line that is shown must have been printed, in order."""
        lines = [" ".join(one.split()) for one in self.printed.splitlines()]
        at = 0
        for shown in filter(str.strip, expected.splitlines()):
            pattern = ".*".join(re.escape(part) for part in " ".join(shown.split()).split("…"))
            found = next((k for k in range(at, len(lines)) if re.fullmatch(pattern, lines[k])), None)
            if found is None:
                self.wrong.append(f"{self.page}:{line}: not printed: {shown}\nprinted was:\n{self.printed}")
                return
            at = found + 1


def main() -> int:
    """Run all pages; 1 if something is not as the pages say."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pages", type=Path, nargs="+")
    parser.add_argument("--program", type=Path, help="the program, where it is not in PATH")
    options = parser.parse_args()
    paths = [str(Path(sys.executable).parent), os.environ["PATH"]]
    if options.program:
        paths.insert(0, str(options.program.resolve().parent))
    environment = {**os.environ, "PATH": ":".join(paths), "PYVISTA_OFF_SCREEN": "true", "MPLBACKEND": "agg"}
    ran = 0
    left: list[str] = []
    wrong: list[str] = []
    for page in options.pages:
        with tempfile.TemporaryDirectory() as folder:
            for shown in SHOWN:
                (Path(folder) / shown).symlink_to(Path(shown).resolve())
            session = Session(page, Path(folder), environment)
            session.read()
        ran, left, wrong = ran + session.ran, left + session.left, wrong + session.wrong
    print(*left, *wrong, f"{ran} blocks run, {len(left)} left out, {len(wrong)} wrong", sep="\n")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
