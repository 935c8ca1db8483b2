"""Open the trade page in a headless browser: every figure is drawn, tables sort, nothing complains; keep a screenshot.

Without chromium or chrome it says so and checks nothing; `pipeline/tools.sh browser` installs one where apt can."""

import argparse
import re
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path

BROWSERS = ("chromium-headless-shell", "chromium", "chromium-browser", "google-chrome", "chrome-headless-shell")
# sorts the first table by its last column but one, both ways, and says what came of it
PROBE = """
<script>
window.addEventListener('load', function () {
  var table = Array.prototype.find.call(document.querySelectorAll('table'), function (t) { return t.tBodies[0].rows.length > 8; });
  var k = 3, th = table.tHead.rows[0].children[k];
  var column = function () {
    return Array.prototype.map.call(table.tBodies[0].rows, function (row) {
      var v = row.children[k].dataset.value;
      return v === undefined || v === '' ? Infinity : parseFloat(v);
    });
  };
  var sorted = function (v, sign) {
    for (var i = 1; i < v.length; i++) if (sign * (v[i] - v[i - 1]) < 0) return false;
    return true;
  };
  th.click();
  var up = sorted(column(), 1);
  th.click();
  document.body.dataset.sorts = String(up && sorted(column(), -1));
});
</script>
"""


def run(browser: str, page: Path, *options: str) -> subprocess.CompletedProcess[str]:
    """Runs the browser on a page."""
    # a profile of its own, no sandbox because containers have none
    with tempfile.TemporaryDirectory() as profile:
        command = [browser, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={profile}"]
        command += ["--enable-logging=stderr", "--virtual-time-budget=20000", "--window-size=1200,2600", *options]
        return subprocess.run([*command, page.resolve().as_uri()], capture_output=True, text=True, timeout=300)


def main() -> None:
    """The command."""
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("page", type=Path, nargs="?", default=Path("results/trade/trade.html"))
    parser.add_argument("--find", action="store_true", help="only tell which browser there is")
    options = parser.parse_args()
    browser = next((found for name in BROWSERS if (found := shutil.which(name))), None)
    if options.find:
        print(browser or "none")
        sys.exit(0 if browser else 1)
    if browser is None:
        print(f"NOT CHECKED: no chromium or chrome here, so {options.page} was not opened", file=sys.stderr)
        return
    text = options.page.read_text()
    outside = re.findall(r'<(?:script|link|img|iframe)[^>]* (?:src|href)="(https?://[^"]+)"', text)
    probed = options.page.with_suffix(".probe.html")
    probed.write_text(text.replace("</body>", PROBE + "</body>"))
    done = run(browser, probed, "--dump-dom")
    probed.unlink()
    picture = options.page.with_suffix(".screenshot.png")
    run(browser, options.page, f"--screenshot={picture.resolve()}")
    figures = len(re.findall(r'<div id="figure\d+"', text))
    drawn = len(re.findall(r'<div id="figure\d+" class="figure js-plotly-plot"', done.stdout))
    errors = [line for line in done.stderr.splitlines() if "CONSOLE" in line and ("Uncaught" in line or "ERROR" in line)]
    faults = []
    if figures == 0 or drawn != figures:
        faults.append(f"{drawn} of {figures} figures are drawn")
    if 'data-ready="yes"' not in done.stdout:
        faults.append("the page's script did not come to its end")
    if 'data-sorts="true"' not in done.stdout:
        faults.append("the tables do not sort")
    if outside:
        faults.append(f"it needs {outside[0]}")
    if not picture.is_file():
        faults.append("no screenshot")
    faults += errors
    for fault in faults:
        print(f"{options.page}: {fault}", file=sys.stderr)
    if faults:
        sys.exit(1)
    print(f"{options.page}: {figures} figures drawn, tables sort; screenshot {picture}")


if __name__ == "__main__":
    main()
