"""``foamprb fit``: properties of bodies from their measured shapes."""

from __future__ import annotations

import argparse
import logging
import math
from collections.abc import Callable
from functools import partial
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
    from foamprb.settings.settings import Settings

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
        nargs="+",
        metavar="FILE",
        help="tables of the bodies: .csv, .rtdc or .tsv",
    )
    add("--unknown", default="shearModulus", metavar="NAMES", help='"shearModulus viscosity" [shearModulus]')
    add("--by", metavar="COLUMN", help="compare groups: a column, sample of .rtdc files, or file")
    add("--error", type=float, metavar="S", help="standard error of the shapes, in SI units [that by pixels]")
    add(
        "--force",
        action="store_true",
        help="take width, flow rate and viscosity of the case, not of the file",
    )
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


def read_device(
    arguments: argparse.Namespace,
    output: Path | None = None,
    entries: Callable[[Settings], dict[str, object]] | None = None,
) -> Job:
    """Return the job that the options of :func:`add_device` select, with ``entries`` of its settings."""
    from foamprb.run.job import prepare, time_of_fluid
    from foamprb.settings.settings import read_settings

    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    dictionary, overrides = dictionary_of(arguments), {}
    if entries is not None:
        time = time_of_fluid(arguments.time)
        overrides = entries(
            read_settings(arguments.case, dictionary, arguments.region, time, arguments.outsideLibs)
        )
    return prepare(
        arguments.case, arguments.time, dictionary, arguments.threads, source_of(arguments),
        precompile=True, outside_libs=arguments.outsideLibs, output=output, overrides=overrides,
    )  # fmt: skip


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    import numpy as np

    from foamprb.distributed.launch import caught_signals
    from foamprb.run.fit import entries_of, fault_of, fit_job
    from foamprb.run.measured import read_all
    from foamprb.view.report.fits import write_fit_page

    measured = read_all(arguments.measured, arguments.by, arguments.error)
    replaces = measured.conditions is not None and not arguments.force
    job = read_device(arguments, arguments.output, partial(entries_of, measured) if replaces else None)
    unknown = arguments.unknown.replace(",", " ").split()
    with caught_signals() as caught:
        try:
            fits = fit_job(
                job, measured, unknown, arguments.plane, arguments.view, arguments.overwrite,
                lambda: bool(caught), arguments.force,
            )  # fmt: skip
        except RunInterrupted as stopped:
            raise RunInterrupted(str(stopped), caught[0]) from None
    log.info("Fitted: %d of %d bodies", fits.fitted.sum(), measured.n)
    for reason, count in fits.reasons.items():
        log.info("    %d: %s", count, reason)
    columns = fits.population
    groups = columns.get("group", np.full(len(columns["property"]), ""))
    lines = [
        (f"{name}{f' of {group}' if group else ''}: median", value, low, high)
        for name, group, value, low, high in zip(
            columns["property"],
            groups,
            columns["median"],
            columns["medianLow"],
            columns["medianHigh"],
            strict=True,
        )
    ]
    lines += [
        (f"{name}: median of {one} less that of {other}", value, low, high)
        for name, one, other, value, low, high in zip(*fits.differences.values(), strict=True)
    ]
    for text, value, low, high in lines:
        interval = "" if math.isnan(low) else f", 95 % interval {low:.4g} to {high:.4g}"
        log.info("%s %.4g%s", text, value, interval)
    page = write_fit_page(fits, fits.folder / "fit.html")
    log.info("Page: %s", page)
    if fault := fault_of(fits, measured, job):
        raise InputError(fault)
    return show_page(arguments, page)
