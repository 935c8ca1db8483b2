"""A self-contained HTML page in the making: headings, tables that sort, figures that move."""

import math
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from plotly.offline import get_plotlyjs

from midplane_pipeline.draw.page_text import page_text

STYLE = """
body { font: 15px/1.5 system-ui, sans-serif; color: #222; max-width: 1100px; margin: 2em auto; padding: 0 1em }
h1 { font-size: 1.6em } h2 { margin-top: 2.2em; border-bottom: 1px solid #ccc }
table { border-collapse: collapse; margin: 1em 0; font-size: 13px; font-variant-numeric: tabular-nums }
th, td { padding: 3px 9px; text-align: right; border-bottom: 1px solid #e4e4e4 }
th { background: #f2f4f7; cursor: pointer; vertical-align: bottom } td { white-space: nowrap } .text { text-align: left; white-space: normal }
th::after { content: "\\00a0\\2195"; color: #aaa } tr.front td { background: #eaf4ea } tr.failed td { color: #a33 }
.figure { width: 100%; height: 560px } .wide { overflow-x: auto } .scroll { max-height: 420px; overflow: auto }
.scroll td.text, .scroll th { white-space: nowrap } .note { color: #555 }
@media print { .scroll { max-height: none; overflow: visible } h2 { break-before: page } th::after { content: "" } }
"""

SCRIPT = """
document.querySelectorAll('th').forEach(function (th) {
  th.addEventListener('click', function () {
    var table = th.closest('table'), k = Array.prototype.indexOf.call(th.parentNode.children, th);
    var up = th.dataset.up !== '1';
    th.dataset.up = up ? '1' : '0';
    var value = function (row) {
      var cell = row.children[k], v = cell.dataset.value;
      return v === undefined ? cell.textContent : v === '' ? Infinity : parseFloat(v);
    };
    var rows = Array.prototype.slice.call(table.tBodies[0].rows);
    rows.sort(function (a, b) {
      var x = value(a), y = value(b);
      return (x < y ? -1 : x > y ? 1 : 0) * (up ? 1 : -1);
    });
    rows.forEach(function (row) { table.tBodies[0].appendChild(row); });
  });
});
document.body.dataset.ready = 'yes';
"""


class Page:
    """HTML in the making."""

    def __init__(self, title: str) -> None:
        self.title, self.figures = title, 0
        self.parts: list[str] = []

    def add(self, text: str) -> None:
        """Adds markup."""
        self.parts.append(text)

    def heading(self, text: str, level: int = 2) -> None:
        """Adds a heading."""
        self.add(f"<h{level}>{page_text(text)}</h{level}>")

    def text(self, text: str, kind: str = "") -> None:
        """Adds a paragraph."""
        self.add(f'<p class="{kind}">{page_text(text)}</p>')

    def figure(self, figure: Any) -> None:
        """Adds a figure of plotly."""
        self.figures += 1
        name = f"figure{self.figures}"
        self.add(f'<div id="{name}" class="figure"></div><script>Plotly.newPlot("{name}", {figure.to_json()}, {{}}, {{responsive: true}})</script>')

    def table(self, head: list[str], rows: list[Any], classes: Sequence[str] = (), scroll: bool = False) -> None:
        """Cells are texts, to the left, or (text, number to sort by)."""
        texts = [isinstance(cell, str) for cell in rows[0]] if rows else [True] * len(head)
        kinds = [" class='text'" if text else "" for text in texts]
        lines = [f"<div class='{'scroll' if scroll else 'wide'}'><table><thead><tr>"]
        lines += [f"<th{kind}>{page_text(cell)}</th>" for cell, kind in zip(head, kinds, strict=True)] + ["</tr></thead><tbody>"]
        for k, row in enumerate(rows):
            lines.append(f"<tr class='{classes[k] if classes else ''}'>")
            for cell, kind in zip(row, kinds, strict=True):
                text, value = cell if isinstance(cell, tuple) else (cell, None)
                known = value is not None and math.isfinite(value)
                data = f' data-value="{value!r}"' if known else ' data-value=""' if isinstance(cell, tuple) else ""
                lines.append(f"<td{kind}{data}>{page_text(text)}</td>")
            lines.append("</tr>")
        self.add("".join([*lines, "</tbody></table></div>"]))

    def write(self, path: Path) -> None:
        """Writes the page."""
        head = f"<!DOCTYPE html><html lang='en'><head><meta charset='utf-8'><title>{page_text(self.title)}</title>"
        head += f"<style>{STYLE}</style><script>{get_plotlyjs()}</script></head><body>"
        path.write_text(head + "\n".join(self.parts) + f"<script>{SCRIPT}</script></body></html>")
