"""The command line: parses, calls, prints."""

from __future__ import annotations

import argparse
import logging
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING, NoReturn

import foamprb
from foamprb.errors import InputError, RankError, RunStopped, suggestion
from foamprb.view.command import declare, view

if TYPE_CHECKING:
    from foamprb.flow.read.source import Source
    from foamprb.parallel.ranks import Root
    from foamprb.parallel.team import OnDevice
    from foamprb.settings.settings import StartFrom

_COMMANDS = ("run", "info", "view", "validate", "compile")


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
    parser.add_argument("--help", action="help", help="show this text and stop")
    parser.add_argument("--version", action="version", version=version, help="show the version and stop")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)

    run = commands.add_parser(
        "run", help="track the particles of constant/softCloudProperties", add_help=False, allow_abbrev=False
    )
    info = commands.add_parser("info", help="say what a case holds", add_help=False, allow_abbrev=False)
    viewing = commands.add_parser(
        "view", help="show the bodies of a run: a page for any browser", add_help=False, allow_abbrev=False
    )
    validate = commands.add_parser(
        "validate", help="compare with independent solutions", add_help=False, allow_abbrev=False
    )
    compiling = commands.add_parser(
        "compile",
        help="compile the particle loops, so that no run has to",
        add_help=False,
        allow_abbrev=False,
    )
    for command in (run, info, viewing, validate, compiling):
        command.add_argument("--help", action="help", help="show this text and stop")
        command.add_argument("--debug", action="store_true", help="show where in the code an error arose")
    for command in (run, info, viewing):
        command.add_argument("--case", type=Path, default=Path(), metavar="DIR", help="case folder [.]")
        command.add_argument("--decomposed", action="store_true", help="read the processor folders")
        command.add_argument("--region", default="", metavar="NAME", help="region of the mesh")
        command.add_argument(
            "--flow", type=Path, metavar="FILE", help="mesh file with the flow, not the case's"
        )
        command.add_argument("--velocity", default="U", metavar="NAME", help="velocity field [U]")
        command.add_argument("--gradient", default="", metavar="NAME", help="its gradient [reconstructed]")
        divided = command.add_mutually_exclusive_group()
        divided.add_argument(
            "--patchArray", default="", metavar="NAME", help="array of a mesh file that numbers its patches"
        )
        divided.add_argument(
            "--featureAngle", type=float, metavar="DEG", help="patches of a mesh file end at such edges"
        )
    declare(viewing)
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
        "--device", choices=("cpu", "cuda"), default="cpu", help="what advances the particles [cpu]"
    )
    run.add_argument("--dry-run", action="store_true", help="check all, say what would be done, and stop")
    validate.add_argument(
        "--case", nargs="+", action="extend", default=[], metavar="NAME", help="only these [all]"
    )
    validate.add_argument("--quick", action="store_true", help="a short form of every case")
    validate.add_argument(
        "--output", type=Path, default=Path("validation"), metavar="DIR", help="[validation]"
    )
    validate.add_argument("--list", action="store_true", help="list the cases and stop")
    return parser


def _run(arguments: argparse.Namespace, team: Root | None) -> int:
    from foamprb.run.job import describe, execute, prepare

    if arguments.threads is not None and arguments.threads < 1:
        raise InputError(f"-threads {arguments.threads}: a number >= 1 is needed.")
    threads = arguments.threads or (team.threads if team else None)
    time = "latestTime" if arguments.latestTime else arguments.time
    on_device = _on_device(arguments, team)
    # With others to compile as well, or for a device, it is done when the loop is wanted, if it ever is.
    ahead = team is None and on_device is None and not arguments.dry_run
    job = prepare(arguments.case, time, arguments.dict, threads, _source(arguments), ahead)
    describe(job)
    if arguments.dry_run:
        steps = job.steps
        logging.getLogger("foamprb").info(
            "\nDry run: %d particles, %d steps, nothing written.\n\nEnd", job.cloud.particles.size, steps
        )
        return 0
    start_from: StartFrom | None = None
    if arguments.resume or arguments.overwrite:
        start_from = "latestTime" if arguments.resume else "startTime"
    with _stopped_by_signals() as received:
        elsewhere = team.signals if team else ()
        try:
            execute(job, start_from, stop=lambda: bool(received or elsewhere), team=on_device or team)
        except RunStopped as stopped:
            signals: list[int] = [*received, *elsewhere]
            if not signals:
                raise
            print(f"--> foamprb {stopped}", file=sys.stderr)
            return 128 + signals[0]
    return 0


def _on_device(arguments: argparse.Namespace, team: Root | None) -> OnDevice | None:
    if arguments.device == "cpu":
        return None
    if team is not None:
        raise InputError("-device cuda does not go together with -parallel: it is for one process.")
    from foamprb.parallel.team import OnDevice

    return OnDevice()


@contextmanager
def _stopped_by_signals() -> Iterator[list[int]]:
    """Collect the first Ctrl-C or SIGTERM in a list; a second one acts at once, as without this."""
    received: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        # Only the main thread may say what a signal does.
        yield received
        return
    before = {number: signal.getsignal(number) for number in (signal.SIGINT, signal.SIGTERM)}

    def restore() -> None:
        for number, handler in before.items():
            signal.signal(number, handler)

    def receive(number: int, _: FrameType | None) -> None:
        received.append(number)
        restore()

    for number in before:
        signal.signal(number, receive)
    try:
        yield received
    finally:
        restore()


def _source(arguments: argparse.Namespace) -> Source:
    from foamprb.flow.read.meshfile import Division
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


def _info(arguments: argparse.Namespace, _: Root | None) -> int:
    from foamprb.flow.read.decomposed import describe_decomposed, is_only_decomposed
    from foamprb.flow.read.meshfile import describe_file
    from foamprb.flow.read.openfoam import describe

    source = _source(arguments)
    if source.file is not None:
        lines = describe_file(source.file, source.velocity, source.division)
    elif source.decomposed or is_only_decomposed(arguments.case, source.region):
        lines = describe_decomposed(arguments.case, source.region).lines()
    else:
        lines = describe(arguments.case, source.region).lines()
    print("\n".join(lines))
    return 0


def _view(arguments: argparse.Namespace, _: Root | None) -> int:
    return view(arguments, _source(arguments))


def _validate(arguments: argparse.Namespace, _: Root | None) -> int:
    from foamprb.validation.registry import CASES
    from foamprb.validation.report import choose, validate

    chosen = choose(CASES, arguments.case)
    if arguments.list:
        for name, case in chosen.items():
            print(f"{name:14s} {case.title} ({case.section})")
        return 0
    return 0 if validate(chosen, arguments.output, arguments.quick) else 1


def _compile(_: argparse.Namespace, __: Root | None) -> int:
    from foamprb.run.everything import compile_all

    compile_all()
    return 0


class _Format(logging.Formatter):
    """Plain lines; a warning in OpenFOAM's manner."""

    def format(self, record: logging.LogRecord) -> str:
        text = record.getMessage()
        return f"--> foamprb Warning : {text}" if record.levelno >= logging.WARNING else text


def _log_to_stdout() -> None:
    handler = logging.StreamHandler(sys.stdout)
    handler.setFormatter(_Format())
    logger = logging.getLogger("foamprb")
    logger.handlers[:] = [handler]
    logger.setLevel(logging.INFO)
    logger.propagate = False


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit status.

    It is 0; 1 for a mistake in the input, a run that had to end early or a validation that fails; 130 after
    Ctrl-C and 143 after SIGTERM.
    """
    given = sys.argv[1:] if arguments is None else arguments
    words = [re.sub(r"^-(?=[A-Za-z]{2})", "--", word) for word in given]
    _log_to_stdout()
    return _run_together(words) if "--parallel" in words else _answer(words)


def _answer(words: Sequence[str], team: Root | None = None) -> int:
    """Do what the words of the command line say."""
    try:
        command = next((word for word in words if not word.startswith("-")), None)
        if command is not None and words[0] == command and command not in _COMMANDS:
            raise InputError(f"unknown command '{command}'. {suggestion(command, _COMMANDS)}")
        parsed = _parser().parse_args(words)
        if parsed.command is None:
            _parser().print_help()
            return 1
        commands: dict[str, Callable[[argparse.Namespace, Root | None], int]] = {
            "run": _run,
            "info": _info,
            "view": _view,
            "validate": _validate,
            "compile": _compile,
        }
        return commands[parsed.command](parsed, team)
    except (InputError, RunStopped, RankError, OSError) as error:
        if "--debug" in words:
            raise
        print(f"--> foamprb Error : {error}", file=sys.stderr)
        return 1
    except KeyboardInterrupt:
        print("--> foamprb stopped by the user.", file=sys.stderr)
        return 130


def _run_together(words: Sequence[str]) -> int:
    """Do what the words of the command line say with the other processes of ``mpirun``, if there are any."""
    from foamprb.parallel.ranks import Rank, connect, is_first

    try:
        rank = connect()
    except InputError as error:
        if is_first():
            print(f"--> foamprb Error : {error}", file=sys.stderr)
        return 1
    if rank is None:
        return _answer(words)
    if isinstance(rank, Rank):
        logging.getLogger("foamprb").handlers[:] = [logging.NullHandler()]
        with _stopped_by_signals() as received:
            return rank.serve(received)
    status = 1
    try:
        status = _answer(words, rank)
    except SystemExit as left:
        status = 1 if left.code else 0
    finally:
        rank.dismiss(status)
    return status


if __name__ == "__main__":
    sys.exit(main())
