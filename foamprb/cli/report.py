"""``foamprb report``: a page about a run."""

from __future__ import annotations

import argparse

from foamprb.cli.options import add_browser, add_cloud, add_flow, output_path, show_page, source_of
from foamprb.errors import InputError

PURPOSE = "write a page about a run and its results"
EXAMPLE = "report -case myCase -paths 3,17"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cloud(parser)
    add = parser.add_argument
    add("--output", type=output_path, metavar="FILE", help="the page [postProcessing/CLOUD/report.html]")
    add("--paths", metavar="IDS", help="particles whose D is plotted over time, 3,17,20 [a selection]")
    add_browser(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.report.report import write_report

    words = (arguments.paths or "").replace(",", " ").split()
    if not all(word.isascii() and word.isdigit() for word in words):
        raise InputError(f"-paths {arguments.paths}: numbers of particles are needed, such as 3,17,20.")
    target = write_report(
        arguments.case,
        arguments.output,
        arguments.cloud,
        source_of(arguments),
        [int(w) for w in words],
        arguments.results,
    )
    return show_page(arguments, target)
