"""Picture of the page of ``foamprb report``: docs/report.png.

Runs the pipe case with the settings of ``foamprb init``, and opens its report in Chromium. Needs
Chromium on PATH and the extra ``browser``.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from pathlib import Path

from foamprb.cli import main as foamprb

ROOT = Path(__file__).resolve().parents[2]
WIDTH, HEIGHT = 1100, 2300


def main() -> None:
    """Run the case, write the report and take the picture."""
    parser = argparse.ArgumentParser(description=__doc__, add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-case", type=Path, help="a case with results, instead of the pipe")
    parser.add_argument("-output", type=Path, default=ROOT / "docs/report.png", help="[docs/report.png]")
    arguments = parser.parse_args()
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as scratch:
        case = Path(scratch) / "pipe"
        if arguments.case:
            shutil.copytree(arguments.case, case := Path(scratch) / arguments.case.resolve().name)
        else:
            shutil.copytree(ROOT / "cases/pipe", case, ignore=shutil.ignore_patterns("postProcessing"))
            (case / "constant/softCloudProperties").unlink()
            for command in ("init", "run"):
                assert foamprb([command, "-case", str(case)]) == 0
        page = case / "report.html"
        assert foamprb(["report", "-case", str(case), "-output", str(page), "-noBrowser"]) == 0
        with sync_playwright() as library:
            browser = library.chromium.launch(executable_path=shutil.which("chromium"), args=["--no-sandbox"])
            tab = browser.new_page(viewport={"width": WIDTH, "height": HEIGHT}, color_scheme="light")
            tab.goto(page.as_uri())
            tab.screenshot(path=arguments.output)
            browser.close()


if __name__ == "__main__":
    main()
