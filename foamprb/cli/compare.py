"""``foamprb compare``: runs side by side."""

from __future__ import annotations

import argparse
import logging
import sys
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from foamprb.parallel.ranks import Ranks

PURPOSE = "write a page about several runs: fates, deposition, times, deformation"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = parser.add_argument
    add("runs", nargs="+", help="cases, or folders of results, such as study/*")
    add("--output", type=Path, default=Path("comparison.html"), metavar="FILE", help="page [comparison.html]")
    add("--case", type=Path, metavar="DIR", help="case of the mesh and the flow, for folders of results")
    add("--noBrowser", action="store_true", help="write the page, do not open it")


def execute(arguments: argparse.Namespace, _ranks: Ranks | None) -> int:
    """Execute the command; return the exit status."""
    from foamprb.flow.read.source import FlowSource
    from foamprb.view.report.compare import write_comparison
    from foamprb.view.runs import open_runs, results_at
    from foamprb.view.show import Request, open_in_browser, write_twins

    runs, output = open_runs(*arguments.runs), arguments.output
    scenes: Path | None = None
    if len(runs) == 2:
        requests = {
            name: Request(
                arguments.case or path,
                run.name,
                FlowSource(region=run.results.region) if run.results.region else None,
                results=results_at(path),
            )
            for (name, run), path in zip(runs.items(), runs.paths.values(), strict=True)
        }
        scenes = write_twins(requests, output.with_name(f"{output.stem}Scenes.html"), version("foamprb"))
    target = write_comparison(runs, output, scenes.name if scenes else None)
    log.info("Comparison: %s", target)
    if not arguments.noBrowser and sys.stdout.isatty():
        open_in_browser(target)
    return 0
