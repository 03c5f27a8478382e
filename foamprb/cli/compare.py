"""``foamprb compare``: runs side by side."""

from __future__ import annotations

import argparse
import logging
import sys
from pathlib import Path

PURPOSE = "write a page about several runs: fates, deposition, times, deformation"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = parser.add_argument
    add("runs", nargs="+", help="cases, or folders of results, such as study/*")
    add("--output", type=Path, default=Path("comparison.html"), metavar="FILE", help="page [comparison.html]")
    add("--noBrowser", action="store_true", help="write the page, do not open it")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.report.compare import write_comparison
    from foamprb.view.runs import open_runs
    from foamprb.view.show import open_in_browser

    target = write_comparison(open_runs(*arguments.runs), arguments.output)
    log.info("Comparison: %s", target)
    if not arguments.noBrowser and sys.stdout.isatty():
        open_in_browser(target)
    return 0
