"""The book: `make book` builds results/book/ and fails on any link that leads nowhere."""

import re
import tomllib
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
CARGO = tomllib.loads((ROOT / "Cargo.toml").read_text(encoding="utf-8"))["package"]

project = CARGO["name"]
release = CARGO["version"]
html_title = f"{project} {release}"
extensions = ["myst_parser", "sphinx_copybutton"]
source_suffix = {".md": "markdown"}
exclude_patterns = ["requirements.txt", "cluster", "bench", "trade", "extremes"]
html_theme = "furo"
html_show_sphinx = False
html_show_copyright = False
myst_heading_anchors = 4
myst_all_links_external = False
suppress_warnings = ["misc.highlighting_failure"]
# letters of formulas are no language
highlight_language = "none"

LINK = re.compile(r"(?<!!)\[(?P<text>[^\]]*)\]\((?P<to>(?!https?:|#|mailto:)[^)\s]+)\)")
MARK = re.compile(r"^<!-- (not run|prints|fails).*?-->\n", re.M)
INFO = re.compile(r'^```(\w+) title="([^"]+)"$', re.M)
SOURCE = re.compile(r"(?<![\w/.*])(?:[a-z_]+/)+[a-z_0-9]+\.rs\b")
# pages that stand elsewhere in the repository
ELSEWHERE = {"overview": "README.md", "changes": "CHANGELOG.md"}


def taken_in(app, docname, content):
    """A page as the book shows it: from where it stands, links out of the book by their names, which must be there."""
    at = ROOT / "docs"
    if docname in ELSEWHERE:
        at = ROOT
        content[0] = (ROOT / ELSEWHERE[docname]).read_text(encoding="utf-8").replace("](docs/", "](")

    def local(link):
        to = link["to"].partition("#")[0]
        if to.endswith(("CHANGELOG.md", "README.md")) and (at / to).resolve().parent == ROOT:
            return f"[{link['text']}]({'changes' if 'CHANGELOG' in to else 'overview'}.md)"
        inside = (ROOT / "docs" / to).resolve()
        if inside.suffix == ".md" and inside.exists() and inside.parent == ROOT / "docs":
            return link[0]
        path = next((path for path in ((at / to).resolve(), inside) if path.exists()), None)
        if path is None:
            raise ValueError(f"{docname}: {link['to']} is not there")
        name = str(path.relative_to(ROOT))
        return link["text"] if name in link["text"].strip("`/") else f"{link['text']} (`{name}`)"

    gone = [name for name in SOURCE.findall(content[0]) if not ((ROOT / name).exists() or (ROOT / "src" / name).exists())]
    if gone and docname != "changes":
        raise ValueError(f"{docname} names files that are not there: {', '.join(gone)}")
    text = INFO.sub(r"*\2*\n\n```\1", MARK.sub("", content[0]))
    content[0] = LINK.sub(local, text)


def setup(app):
    """Reads every page through `taken_in`."""
    app.connect("source-read", taken_in)
