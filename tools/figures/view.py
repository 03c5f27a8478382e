"""Pictures of pages in docs: pipe.png by VTK, view.png, view-dark.png, view-phone.png and report.png.

Runs the pipe case of the tree, for the report with the settings of ``foamprb init``, and opens its pages in
Chromium, which draws by software, so that any machine makes the same pictures. Needs Chromium on PATH and the
extra ``browser``.
"""

from __future__ import annotations

import argparse
import shutil
import tempfile
from pathlib import Path
from typing import Any, NamedTuple

from foamprb.cli import main as foamprb

ROOT = Path(__file__).resolve().parents[2]
SOFTWARE = (
    "--no-sandbox",
    "--use-gl=angle",
    "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader",
    "--ignore-gpu-blocklist",
)


class Shot(NamedTuple):
    """Picture: file, window size, and actions on the page before it is taken."""

    file: str
    width: int
    height: int
    scheme: str
    script: str = ""


# Chooses the body nearest to a place, given in shares of the picture.
CHOOSE = """
    const choose = (across, down) => {
        const { data, eye, bodies, placeOf } = foamprb;
        let spot = null, least = Infinity;
        for (let i = 0; i < data.n; i++) {
            const { x, y } = placeOf(i), off = Math.hypot(x - across * eye.width, y - down * eye.height);
            if (bodies.shown[i] && off < least) { least = off; spot = [x, y]; }
        }
        foamprb.choose(foamprb.bodyAt(...spot));
    };
"""
SHOTS = (
    Shot("view.png", 1440, 900, "light"),
    Shot(
        "view-dark.png", 1440, 900, "dark", f"{CHOOSE} foamprb.eye.zoom(0.35, 620, 330); choose(0.62, 0.5);"
    ),
    Shot("view-phone.png", 390, 780, "light", f"{CHOOSE} choose(0.5, 0.4);"),
)
REPORT = Shot("report.png", 1100, 2300, "light")


def take(browser: Any, page: Path, shot: Shot, folder: Path) -> None:
    """Open a page, perform the actions of the shot, and save the picture."""
    size = {"width": shot.width, "height": shot.height}
    scale = 2 if shot.width < 500 else 1
    tab = browser.new_page(viewport=size, color_scheme=shot.scheme, device_scale_factor=scale)
    tab.goto(page.as_uri())
    if shot is not REPORT:
        tab.evaluate("() => foamprb.ready")
        tab.evaluate(f"() => {{ {shot.script} }}")
        tab.evaluate("() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")
    tab.screenshot(path=folder / shot.file)
    tab.close()


def main() -> None:
    """Run the cases and take the pictures."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("--output", type=Path, default=ROOT / "docs", metavar="DIR", help="[docs]")
    options = parser.parse_args()
    # Only now: the help needs no browser.
    from playwright.sync_api import sync_playwright

    with tempfile.TemporaryDirectory() as scratch:
        case, first = Path(scratch) / "pipe", Path(scratch) / "first" / "pipe"
        for copy in (case, first):
            shutil.copytree(ROOT / "cases/pipe", copy, ignore=shutil.ignore_patterns("postProcessing"))
        (first / "constant/softCloudProperties").unlink()
        page, report = Path(scratch) / "pipe.html", Path(scratch) / "report.html"
        for words in (
            ["run", "-case", str(case)],
            ["view", "-noBrowser", "-output", str(page), "-case", str(case)],
            ["view", "-png", str(options.output / "pipe.png"), "-case", str(case)],
            ["init", "-case", str(first)],
            ["run", "-case", str(first)],
            ["report", "-noBrowser", "-output", str(report), "-case", str(first)],
        ):
            if foamprb(words) != 0:
                raise SystemExit(1)
        with sync_playwright() as playwright:
            browser = playwright.chromium.launch(
                executable_path=shutil.which("chromium"), args=list(SOFTWARE)
            )
            for shot in SHOTS:
                take(browser, page, shot, options.output)
            take(browser, report, REPORT, options.output)
            browser.close()


if __name__ == "__main__":
    main()
