"""Entry point of the command line: parser, log and exit status."""

from __future__ import annotations

import argparse
import io
import logging
import os
import re
import signal
import sys
import threading
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING, NoReturn, Protocol, TextIO

import foamprb
from foamprb.cli import compare, estimate, export, fit, info, init, paraview, report, run, sweep, view
from foamprb.cli import compile as compile_
from foamprb.cli import help as help_
from foamprb.errors import InputError, RankError, RunInterrupted, RunStopped, suggestion
from foamprb.memory import OutOfMemory, ran_out

if TYPE_CHECKING:
    from foamprb.cloud.communicator import Communicator

_DEFERRED = 0.02
"""Time between two attempts to interrupt, s."""


class Command(Protocol):
    """Module of a command."""

    PURPOSE: str
    """Help text."""

    def declare(self, parser: argparse.ArgumentParser, /) -> None:
        """Add the options of the command."""

    def execute(self, arguments: argparse.Namespace, /) -> int:
        """Execute the command; return the exit status."""


COMMANDS: dict[str, Command] = {
    "init": init,
    "run": run,
    "info": info,
    "view": view,
    "paraview": paraview,
    "report": report,
    "fit": fit,
    "sweep": sweep,
    "compare": compare,
    "export": export,
    "estimate": estimate,
    "help": help_,
    "compile": compile_,
}


class _Parser(argparse.ArgumentParser):
    """Parser whose errors are one message with exit status 1."""

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
    parser.add_argument("-h", "--help", action="help", help="show this text and exit")
    parser.add_argument("--version", action="version", version=version, help="show the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for name, command in COMMANDS.items():
        added = commands.add_parser(name, help=command.PURPOSE, add_help=False, allow_abbrev=False)
        added.add_argument("-h", "--help", action="help", help="show this text and exit")
        added.add_argument("--debug", action="store_true", help="show the traceback of an error")
        command.declare(added)
    return parser


def _complete() -> None:
    """Answer the shell, which wants to complete a command line; does not return."""
    import argcomplete

    argcomplete.autocomplete(_parser())


class _Handler(logging.StreamHandler[TextIO]):
    """Handler that writes plain lines, and warnings in OpenFOAM's manner."""

    def format(self, record: logging.LogRecord) -> str:
        text = record.getMessage()
        return f"--> foamprb Warning : {text}" if record.levelno >= logging.WARNING else text

    def handleError(self, record: logging.LogRecord) -> None:
        """End the program where the reader of its log has gone."""
        error = sys.exception()
        if isinstance(error, BrokenPipeError):
            raise
        if isinstance(error, OSError):
            # A full disk, for example: the command goes on without its log.
            print(f"--> foamprb Warning : the log cannot be written: {error.strerror}.", file=sys.stderr)
            _drop_output()
            return
        super().handleError(record)


def _drop_output() -> None:
    """Drop buffered output; otherwise Python reports at its end that it could not be written."""
    with suppress(OSError, ValueError):
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())


def _log_to_stdout() -> None:
    for number, name in enumerate(("stdin", "stdout", "stderr")):
        if getattr(sys, name) is None:
            # Closed by the caller. Another file would take its number.
            with suppress(OSError):
                os.dup2(os.open(os.devnull, os.O_RDWR), number)
            setattr(sys, name, open(os.devnull, "r" if number == 0 else "w"))  # noqa: PTH123, SIM115
    for stream in (sys.stdout, sys.stderr):
        # File names need not be text.
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors="backslashreplace")
    logger = logging.getLogger("foamprb")
    logger.handlers[:] = [_Handler(sys.stdout)]
    logger.setLevel(logging.INFO)
    logger.propagate = False


def main(arguments: Sequence[str] | None = None) -> int:
    """Run the command line; return the exit status.

    It is 0; 1 for a mistake in the input or a run that had to end early; 141 if the reader of the output has
    closed it; and 128 plus the number of the signal that ended a run: 130 for Ctrl-C, 143 for SIGTERM.
    """
    if "_ARGCOMPLETE" in os.environ:
        _complete()
    words_given = sys.argv[1:] if arguments is None else arguments
    words = [re.sub(r"^-(?=[A-Za-z]{2})", "--", word) for word in words_given]
    _log_to_stdout()

    def answer(comm: Communicator | None = None) -> int:
        return _exit_status(words, lambda: _do(words, comm))

    with _interrupted_between_imports():
        if "--parallel" not in words:
            return answer()
        from foamprb.distributed.launch import run_together

        return _exit_status(words, lambda: run_together(answer))


@contextmanager
def _interrupted_between_imports() -> Iterator[None]:
    """Defer Ctrl-C to the end of an import: VTK crashes if the loading of its modules is interrupted."""

    def interrupt(number: int, frame: FrameType | None) -> None:
        place = frame
        while place is not None and place.f_code is not main.__code__:
            if place.f_code.co_filename == "<frozen importlib._bootstrap>":
                again = threading.Timer(_DEFERRED, os.kill, (os.getpid(), number))
                again.daemon = True
                again.start()
                return
            place = place.f_back
        signal.default_int_handler(number, frame)

    alone = threading.current_thread() is threading.main_thread()
    if not alone or signal.getsignal(signal.SIGINT) is not signal.default_int_handler:
        yield
        return
    signal.signal(signal.SIGINT, interrupt)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, signal.default_int_handler)


def _do(words: Sequence[str], comm: Communicator | None) -> int:
    """Execute the command line; a run with ``-parallel`` has its communicator among the arguments."""
    for word in words:
        if not word.isprintable() and word != word.encode(errors="replace").decode():
            raise InputError(f"{word}: a name that is not UTF-8, which VTK cannot open. Rename it.")
    if words and not words[0].startswith("-") and words[0] not in COMMANDS:
        raise InputError(f"unknown command '{words[0]}'. {suggestion(words[0], COMMANDS)}")
    parsed = _parser().parse_args(words, argparse.Namespace(comm=comm))
    if parsed.command is None:
        _parser().print_help()
        return 1
    return COMMANDS[parsed.command].execute(parsed)


def _exit_status(words: Sequence[str], command: Callable[[], int]) -> int:
    """Call a command, print its error message, and return the exit status."""
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
        _drop_output()
        return 128 + signal.SIGPIPE
    except Exception as error:
        reason = ran_out(error) or error
        expected = isinstance(reason, InputError | RunStopped | RankError | OSError | OutOfMemory)
        if not expected or "--debug" in words:
            raise
        print(f"--> foamprb Error : {reason}", file=sys.stderr)
        try:
            sys.stdout.flush()
        except OSError:
            _drop_output()
        return 1
    except KeyboardInterrupt:
        print("--> foamprb stopped by the user.", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
