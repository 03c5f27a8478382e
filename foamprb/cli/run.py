"""``foamprb run``: particles through the flow of a case."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from foamprb.cli.options import add_cache, add_dictionary, add_flow, dictionary_of, output_path, source_of
from foamprb.errors import InputError, UsageError

if TYPE_CHECKING:
    from foamprb.settings.solution import StartFrom

PURPOSE = "track the particles of constant/softCloudProperties"
EXAMPLE = "run -case myCase -dry-run"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cache(parser)
    when = parser.add_mutually_exclusive_group()
    when.add_argument("--time", metavar="TIME", help="time of the flow, or times a:b of a transient one")
    when.add_argument(
        "--latestTime", action="store_true", help="latest time of the flow (default for steady flow)"
    )
    add_dictionary(parser)
    start = parser.add_mutually_exclusive_group()
    start.add_argument("--resume", action="store_true", help="continue from the last checkpoint, if any")
    start.add_argument(
        "--overwrite", action="store_true", help="restart at time 0 and replace an unfinished run"
    )
    parser.add_argument("--threads", type=int, metavar="N", help="threads per process [all processors]")
    parser.add_argument(
        "--parallel", action="store_true", help="distribute the particles over the processes of mpirun"
    )
    parser.add_argument(
        "--outsideLibs", action="store_true", help="run also Python files of libs outside the case"
    )
    parser.add_argument(
        "--output", type=output_path, metavar="DIR", help="folder of the results [postProcessing in the case]"
    )
    parser.add_argument(
        "--estimateErrors",
        action="store_true",
        help="repeat the run with finer steps and other gradients, and log which fates change",
    )
    parser.add_argument("--dry-run", action="store_true", help="check the input, print the plan and exit")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.cloud.communicator import Communicator
    from foamprb.run.job import prepare
    from foamprb.run.log import log_description, log_dry_run

    if arguments.estimateErrors and (arguments.parallel or arguments.dry_run):
        raise UsageError("-estimateErrors does not go with -parallel or -dry-run.")
    comm = arguments.comm or Communicator()
    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    start_from: StartFrom | None = None
    if arguments.resume or arguments.overwrite:
        start_from = "latestTime" if arguments.resume else "startTime"
    job = prepare(
        arguments.case,
        "latestTime" if arguments.latestTime else arguments.time,
        dictionary_of(arguments),
        arguments.threads or comm.threads,
        source_of(arguments),
        precompile=comm.size == 1 and not arguments.dry_run,
        outside_libs=arguments.outsideLibs,
        output=arguments.output,
        comm=comm,
    )
    log_description(job)
    if arguments.dry_run:
        log_dry_run(job)
        return 0
    from foamprb.run.loop import execute_until_signal

    execute_until_signal(job, start_from)
    if arguments.estimateErrors:
        from foamprb.run.errors_of_fates import estimate_errors, log_errors

        log_errors(estimate_errors(job))
    return 0
