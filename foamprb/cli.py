"""The command line: parses, calls, prints."""

from __future__ import annotations

import argparse
import logging
import os
import re
import signal
import sys
from collections.abc import Callable, Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, NoReturn, TextIO

import foamprb
from foamprb.errors import InputError, RankError, RunInterrupted, RunStopped, suggestion
from foamprb.memory import OutOfMemory, forget, ran_out, require_start
from foamprb.run.estimates import declare as declare_numbers
from foamprb.view.command import declare, declare_export, declare_report, export, report, view

if TYPE_CHECKING:
    from foamprb.flow.read.source import Source
    from foamprb.parallel.ranks import Ranks
    from foamprb.settings.solution import StartFrom


class _Parser(argparse.ArgumentParser):
    """Answers a mistake in the arguments as any other mistake: one message, exit status 1."""

    def error(self, message: str) -> NoReturn:
        raise InputError(f"{message}. Try: {self.prog} -help")


def _parser() -> argparse.ArgumentParser:
    parser = _Parser(
        prog="foamprb",
        description="Track soft micro-particles through a flow computed by OpenFOAM.",
        epilog="Options take a single or a double dash.",
        add_help=False,
        allow_abbrev=False,
    )
    version = f"foamprb {foamprb.__version__}"
    parser.add_argument("-h", "--help", action="help", help="show this text and stop")
    parser.add_argument("--version", action="version", version=version, help="show the version and stop")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)

    def command(name: str, purpose: str) -> argparse.ArgumentParser:
        added = commands.add_parser(name, help=purpose, add_help=False, allow_abbrev=False)
        added.add_argument("-h", "--help", action="help", help="show this text and stop")
        added.add_argument("--debug", action="store_true", help="show where in the code an error arose")
        return added

    init = command("init", "write constant/softCloudProperties, to begin with, from what the case says")
    run = command("run", "track the particles of constant/softCloudProperties")
    info = command("info", "say what a case holds")
    viewing = command("view", "show the bodies of a run: a page for any browser")
    paraview = command("paraview", "show the bodies of a run in ParaView")
    paraview.add_argument("--case", type=Path, default=Path(), metavar="DIR", help="case folder [.]")
    paraview.add_argument("--cloud", metavar="NAME", help="the cloud [softCloud, or the only one]")
    paraview.add_argument("--region", default="", metavar="NAME", help="region of the mesh")
    reporting = command("report", "write a page of what was run and what came of it")
    exporting = command("export", "write the results for OpenFOAM, for OVITO, or as one VTKHDF file")
    estimating = command("estimate", "say from a few numbers which effects matter to a particle")
    helping = command("help", "say what an entry, a dictionary or a type of the settings is")
    command("compile", "compile the particle loops, so that no run has to")
    helping.add_argument("entry", nargs="?", metavar="ENTRY", help="deltaT, solution/deltaT, patchInjection")
    for reading in (init, run, info, viewing, reporting, exporting):
        reading.add_argument("--case", type=Path, default=Path(), metavar="DIR", help="case folder [.]")
        reading.add_argument("--decomposed", action="store_true", help="read the processor folders")
        reading.add_argument("--region", default="", metavar="NAME", help="region of the mesh")
        reading.add_argument(
            "--flow", type=Path, metavar="FILE", help="mesh file with the flow, not the case's"
        )
        reading.add_argument("--velocity", default="U", metavar="NAME", help="velocity field [U]")
        reading.add_argument("--gradient", default="", metavar="NAME", help="its gradient [reconstructed]")
        divided = reading.add_mutually_exclusive_group()
        divided.add_argument(
            "--patchArray", default="", metavar="NAME", help="array of a mesh file that numbers its patches"
        )
        divided.add_argument(
            "--featureAngle", type=float, metavar="DEG", help="patches of a mesh file end at such edges"
        )
    declare(viewing)
    declare_numbers(estimating)
    declare_report(reporting)
    declare_export(exporting)
    when = run.add_mutually_exclusive_group()
    when.add_argument("--time", metavar="TIME", help="time of the flow, or times a:b of a transient one")
    when.add_argument(
        "--latestTime", action="store_true", help="the latest time of the flow (the default of a steady one)"
    )
    run.add_argument("--dict", type=Path, metavar="FILE", help="settings [constant/softCloudProperties]")
    start = run.add_mutually_exclusive_group()
    start.add_argument(
        "--resume", action="store_true", help="go on from the last checkpoint, if there is one"
    )
    start.add_argument("--overwrite", action="store_true", help="begin anew, in place of an unfinished run")
    run.add_argument(
        "--threads", type=int, metavar="N", help="number of threads, of each process [all processors]"
    )
    run.add_argument(
        "--parallel", action="store_true", help="share the particles among the processes of mpirun"
    )
    run.add_argument(
        "--tables", choices=("csv", "parquet"), default="csv", help="kind of tables: text or Parquet [csv]"
    )
    run.add_argument("--dry-run", action="store_true", help="check all, say what would be done, and stop")
    return parser


def _run(arguments: argparse.Namespace, ranks: Ranks | None) -> int:
    from foamprb.run.job import prepare
    from foamprb.run.log import log_description, log_dry_run
    from foamprb.run.loop import execute_until_signal

    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    job = prepare(
        arguments.case,
        "latestTime" if arguments.latestTime else arguments.time,
        arguments.dict,
        arguments.threads or (ranks.threads if ranks else None),
        _source(arguments),
        precompile=ranks is None and not arguments.dry_run,
        tables=arguments.tables,
    )
    log_description(job.description)
    if arguments.dry_run:
        log_dry_run(job)
        return 0
    start_from: StartFrom | None = None
    if arguments.resume or arguments.overwrite:
        start_from = "latestTime" if arguments.resume else "startTime"
    execute_until_signal(job, start_from, ranks)
    return 0


def _source(arguments: argparse.Namespace) -> Source:
    from foamprb.flow.read.division import Division
    from foamprb.flow.read.source import Source

    angle = arguments.featureAngle
    if angle is not None and not 0.0 < angle < 180.0:
        raise InputError(f"-featureAngle {angle:g}: an angle between 0 and 180 degrees is needed.")
    divided = arguments.patchArray or angle is not None
    return Source(
        arguments.flow,
        arguments.region,
        arguments.velocity,
        arguments.gradient,
        Division(arguments.patchArray, angle) if divided else None,
        arguments.decomposed,
    )


def _init(arguments: argparse.Namespace, _: Ranks | None) -> int:
    from foamprb.run.template import write_template

    file = write_template(arguments.case, _source(arguments))
    print(f"{file} is written. Look through it, then: foamprb run -dry-run, foamprb run, foamprb view.")
    return 0


def _help(arguments: argparse.Namespace, _: Ranks | None) -> int:
    from foamprb.settings.reference import explain

    print("\n".join(explain(arguments.entry)))
    return 0


def _info(arguments: argparse.Namespace, _: Ranks | None) -> int:
    from foamprb.flow.read.source import describe_source

    print("\n".join(describe_source(arguments.case, _source(arguments))))
    return 0


def _view(arguments: argparse.Namespace, _: Ranks | None) -> int:
    return view(arguments, _source(arguments))


def _paraview(arguments: argparse.Namespace, _: Ranks | None) -> int:
    from foamprb.view.show import start_paraview

    return start_paraview(arguments.case, arguments.cloud, arguments.region)


def _report(arguments: argparse.Namespace, _: Ranks | None) -> int:
    return report(arguments, _source(arguments))


def _export(arguments: argparse.Namespace, _: Ranks | None) -> int:
    return export(arguments, _source(arguments))


def _estimate(arguments: argparse.Namespace, _: Ranks | None) -> int:
    from foamprb.run.estimates import lines

    print("\n".join(lines(arguments)))
    return 0


def _compile(_: argparse.Namespace, __: Ranks | None) -> int:
    from foamprb.run.compilation import compile_all

    compile_all()
    return 0


_COMMANDS: dict[str, Callable[[argparse.Namespace, Ranks | None], int]] = {
    "init": _init,
    "run": _run,
    "info": _info,
    "view": _view,
    "paraview": _paraview,
    "report": _report,
    "export": _export,
    "estimate": _estimate,
    "help": _help,
    "compile": _compile,
}


class _Handler(logging.StreamHandler[TextIO]):
    """Plain lines; a warning in OpenFOAM's manner."""

    def format(self, record: logging.LogRecord) -> str:
        text = record.getMessage()
        return f"--> foamprb Warning : {text}" if record.levelno >= logging.WARNING else text

    def handleError(self, record: logging.LogRecord) -> None:
        """Let the program end where nobody reads its log any more."""
        if isinstance(sys.exception(), BrokenPipeError):
            raise
        super().handleError(record)


def _log_to_stdout() -> None:
    logger = logging.getLogger("foamprb")
    logger.handlers[:] = [_Handler(sys.stdout)]
    logger.setLevel(logging.INFO)
    logger.propagate = False


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit status.

    It is 0; 1 for a mistake in the input or a run that had to end early; 130 after Ctrl-C, 143 after
    SIGTERM, and 141 if the reader of the output has closed it.
    """
    given = sys.argv[1:] if arguments is None else arguments
    words = [re.sub(r"^-(?=[A-Za-z]{2})", "--", word) for word in given]
    _log_to_stdout()

    def answer(ranks: Ranks | None) -> int:
        return _exit_status(words, lambda: _do(words, ranks))

    if "--parallel" not in words:
        return answer(None)
    from foamprb.parallel.launch import run_together

    return _exit_status(words, lambda: run_together(answer))


def _do(words: Sequence[str], ranks: Ranks | None) -> int:
    """Do what the words of the command line say."""
    if words and not words[0].startswith("-") and words[0] not in _COMMANDS:
        raise InputError(f"unknown command '{words[0]}'. {suggestion(words[0], _COMMANDS)}")
    parsed = _parser().parse_args(words)
    if parsed.command is None:
        _parser().print_help()
        return 1
    forget()
    if parsed.command != "help":
        require_start()
    return _COMMANDS[parsed.command](parsed, ranks)


def _exit_status(words: Sequence[str], command: Callable[[], int]) -> int:
    """Call a command, print what went wrong, and return the exit status."""
    try:
        try:
            status = command()
        except SystemExit as done:
            status = 1 if done.code else 0
        sys.stdout.flush()
        return status
    except RunInterrupted as stopped:
        print(f"--> foamprb {stopped}", file=sys.stderr)
        return 128 + stopped.signal
    except BrokenPipeError:
        # What is left of the output goes nowhere, or Python would say at its end that it could not write it.
        with suppress(OSError):
            os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 128 + signal.SIGPIPE
    except Exception as error:
        reason = ran_out(error) or error
        known = isinstance(reason, InputError | RunStopped | RankError | OSError | OutOfMemory)
        if not known or "--debug" in words:
            raise
        print(f"--> foamprb Error : {reason}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("--> foamprb stopped by the user.", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
