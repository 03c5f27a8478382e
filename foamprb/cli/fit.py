"""``foamprb fit``: properties of bodies from their measured shapes."""

from __future__ import annotations

import argparse
import logging
import math
from pathlib import Path
from typing import TYPE_CHECKING

from foamprb.cli.options import (
    add_browser,
    add_cache,
    add_dictionary,
    add_flow,
    dictionary_of,
    output_path,
    show_page,
    source_of,
)
from foamprb.errors import InputError, RunInterrupted

if TYPE_CHECKING:
    from foamprb.run.job import Job

PURPOSE = "fit moduli of bodies to their measured shapes"
EXAMPLE = "fit -case myCase -measured bodies.csv -plane x=0.01 -view z"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cache(parser)
    add = parser.add_argument
    add(
        "--measured",
        type=Path,
        required=True,
        metavar="FILE",
        help="table of the bodies: .csv, .rtdc or .tsv",
    )
    add("--unknown", default="shearModulus", metavar="NAMES", help='"shearModulus viscosity" [shearModulus]')
    add_device(parser)
    add(
        "--output", type=output_path, metavar="DIR", help="folder of the results [postProcessing in the case]"
    )
    add("--overwrite", action="store_true", help="start over [continue a fit that was stopped]")
    add_browser(parser)


def add_device(parser: argparse.ArgumentParser) -> None:
    """Add the options of a case as a measuring device."""
    add = parser.add_argument
    add("--plane", metavar="PLANE", help='where bodies are seen: x=0.01, or "(0.01 0 0) (1 0 0)"')
    add("--view", metavar="AXIS", help="direction of the camera: x, y, z or a vector")
    add("--time", metavar="TIME", help="time of the flow [latest]")
    add_dictionary(parser)
    add("--threads", type=int, metavar="N", help="threads [all processors]")
    add("--outsideLibs", action="store_true", help="run also Python files of libs outside the case")


def read_device(arguments: argparse.Namespace, output: Path | None = None) -> Job:
    """Return the job that the options of :func:`add_device` select."""
    from foamprb.run.job import prepare

    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    return prepare(
        arguments.case, arguments.time, dictionary_of(arguments), arguments.threads, source_of(arguments),
        precompile=True, outside_libs=arguments.outsideLibs, output=output,
    )  # fmt: skip


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.distributed.launch import caught_signals
    from foamprb.run.fit import fault_of, fit_job
    from foamprb.run.measured import read_measured
    from foamprb.view.report.fits import write_fit_page

    measured = read_measured(arguments.measured)
    job = read_device(arguments, arguments.output)
    unknown = arguments.unknown.replace(",", " ").split()
    with caught_signals() as caught:
        try:
            fits = fit_job(
                job, measured, unknown, arguments.plane, arguments.view, arguments.overwrite,
                lambda: bool(caught),
            )  # fmt: skip
        except RunInterrupted as stopped:
            raise RunInterrupted(str(stopped), caught[0]) from None
    log.info("Fitted: %d of %d bodies", fits.fitted.sum(), measured.n)
    for reason, count in fits.reasons.items():
        log.info("    %d: %s", count, reason)
    rows = zip(*fits.population.values(), strict=True)
    for name, _, median, low, high, *_ in rows:
        interval = "" if math.isnan(low) else f", 95 % interval {low:.4g} to {high:.4g}"
        log.info("%s: median %.4g%s", name, median, interval)
    page = write_fit_page(fits, fits.folder / "fit.html")
    log.info("Page: %s", page)
    if fault := fault_of(fits, measured, job):
        raise InputError(fault)
    return show_page(arguments, page)
