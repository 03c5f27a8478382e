"""``foamprb sweep``: runs of one case for many values of some entries."""

from __future__ import annotations

import argparse
import logging
from pathlib import Path
from typing import TYPE_CHECKING

from foamprb.cli.options import add_cache
from foamprb.errors import InputError, RunInterrupted, RunStopped

if TYPE_CHECKING:
    from foamprb.flow.base import Flow
    from foamprb.flow.read.source import FlowSource
    from foamprb.settings.solution import StartFrom

PURPOSE = "run a case for many values of some entries, combined or drawn"
EXAMPLE = "sweep study.toml -list"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add = parser.add_argument
    add("study", type=Path, help="file of the study, in TOML; the results go into a folder of its name")
    add("--list", action="store_true", help="print the runs and their values, and exit")
    add("--run", type=int, metavar="N", help="only run N, from 1 on, as in a job array")
    add("--overwrite", action="store_true", help="start over [continue, and keep what has ended]")
    add("--threads", type=int, metavar="N", help="threads [all processors]")
    add("--outsideLibs", action="store_true", help="run also Python files of libs outside the case")
    add_cache(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.run.sweep import execute_run, read_study, require_entries
    from foamprb.view.report.compare import write_comparison
    from foamprb.view.runs import open_runs

    study = read_study(arguments.study)
    n = len(study)
    if not study.case.is_dir():
        raise InputError(f"{study.file}: case: {study.case} is no folder. Needed: one relative to the file.")
    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    if arguments.run is not None and not 1 <= arguments.run <= n:
        raise InputError(f"-run {arguments.run}: the study has the runs 1 to {n}.")
    require_entries(study, arguments.outsideLibs)
    numbers = range(1, n + 1) if arguments.run is None else [arguments.run]
    if arguments.list:
        for number in numbers:
            log.info("%*d  %s", len(str(n)), number, study.described(number))
        return 0
    flows: dict[FlowSource, Flow] = {}
    failed, comparable = 0, list[int]()
    start_from: StartFrom = "startTime" if arguments.overwrite else "latestTime"
    for number in numbers:
        what = f"Run {number} of {n}: {study.described(number)}"
        try:
            job = execute_run(
                study, number, flows, start_from, arguments.threads, arguments.outsideLibs, arguments.cache
            )
        except RunInterrupted as stopped:
            raise RunInterrupted(f"{what}: stopped. The same command continues.", stopped.signal) from stopped
        except (InputError, RunStopped) as error:
            failed += 1
            # Of a run that did not start, the folder may hold an earlier one.
            comparable += [number] * isinstance(error, RunStopped)
            log.warning("%s: %s", what, error)
            continue
        comparable.append(number)
        counts = job.cloud.counts()
        fates = ", ".join(f"{count} {status.name.lower()}" for status, count in counts.items() if count)
        log.info("%s: %s", what, fates)
    if arguments.run is None and comparable:
        runs = open_runs(*map(study.folder, comparable), if_any=True)
        page = study.file.with_suffix("") / "comparison.html"
        log.info("Comparison: %s", write_comparison(runs, page))
    return int(failed > 0)
