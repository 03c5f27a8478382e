"""``foamprb compare``: runs side by side."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path

from foamprb.cli.options import add_browser, output_path, show_page

PURPOSE = "write a page about several runs: fates, deposition, times, deformation"
EXAMPLE = "compare 'study/*'"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = parser.add_argument
    add("runs", nargs="+", help="cases, or folders of results, such as study/*")
    add(
        "--output",
        type=output_path,
        default=Path("comparison.html"),
        metavar="FILE",
        help="page [comparison.html]",
    )
    add_browser(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.report.compare import write_comparison
    from foamprb.view.runs import open_runs

    target = write_comparison(open_runs(*arguments.runs), arguments.output)
    log.info("Comparison: %s", target)
    return show_page(arguments, target)
