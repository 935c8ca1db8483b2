"""Put the hashes of all files of every pinned version into a requirements.txt, so that pip installs nothing else.

python -m midplane_pipeline.house.pin [pipeline/requirements.txt]    after raising a version, or after `pip freeze` into that file
"""

import re
import sys
import urllib.request
from pathlib import Path

from midplane_pipeline.places import PIPELINE

FILE = PIPELINE / "requirements.txt"


def hashes(name: str, version: str) -> list[str]:
    """SHA-256 of the files of a version, from the index that pip reads."""
    plain = re.sub(r"[-_.]+", "-", name).lower()
    with urllib.request.urlopen(f"https://pypi.org/simple/{plain}/", timeout=60) as page:
        links = re.findall(r'#sha256=([0-9a-f]{64})"[^>]*>([^<]+)<', page.read().decode())
    stem = re.escape(plain).replace(r"\-", "[-_.]+")
    own = re.compile(rf"{stem}-{re.escape(version)}(-.*\.whl|\.tar\.gz|\.zip)$", re.I)
    return sorted({digest for digest, file in links if own.match(file)})


def main() -> None:
    """The command."""
    file = Path(sys.argv[1]) if len(sys.argv) > 1 else FILE
    lines = []
    for line in file.read_text().splitlines():
        found = re.match(r"([A-Za-z0-9_.\-]+)==([^\s;\\]+)", line)
        if not found:
            if not line.strip().startswith("--hash"):
                lines.append(line)
            continue
        digests = hashes(*found.groups())
        if not digests:
            sys.exit(f"{found[0]}: the index has no file of this version")
        lines.append(" \\\n    ".join([found[0], *(f"--hash=sha256:{digest}" for digest in digests)]))
    file.write_text("\n".join(lines) + "\n")


if __name__ == "__main__":
    main()
