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
import time
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager, suppress
from types import FrameType
from typing import TYPE_CHECKING, NoReturn, Protocol, TextIO

import foamprb
from foamprb.cli import compare, estimate, export, fit, info, init, lut, paraview, report, run, sweep, view
from foamprb.cli import compile as compile_
from foamprb.cli import help as help_
from foamprb.errors import (
    InputError,
    RankError,
    RunInterrupted,
    RunStopped,
    UsageError,
    closest,
    suggestion,
)
from foamprb.memory import OutOfMemory, ran_out

if TYPE_CHECKING:
    from foamprb.cloud.communicator import Communicator

_START = time.perf_counter()
_DEFERRED = 0.02
"""Time between two attempts to interrupt, s."""


class Command(Protocol):
    """Module of a command."""

    PURPOSE: str
    """Help text."""
    EXAMPLE: str
    """A command line without the program's name."""

    def declare(self, parser: argparse.ArgumentParser, /) -> None:
        """Add the options of the command."""

    def execute(self, arguments: argparse.Namespace, /) -> int:
        """Execute the command; return the exit status."""


GROUPS: dict[str, dict[str, Command]] = {
    "prepare": {"info": info, "init": init, "estimate": estimate, "help": help_},
    "run": {"run": run, "sweep": sweep, "fit": fit, "lut": lut, "compile": compile_},
    "see the results": {
        "view": view,
        "report": report,
        "compare": compare,
        "paraview": paraview,
        "export": export,
    },
}
COMMANDS = {name: command for group in GROUPS.values() for name, command in group.items()}
_LONG = re.compile(r"(?<![\w-])--(?=[A-Za-z])")


class _Help(argparse.HelpFormatter):
    """Formatter whose column of options is as wide as these with a single dash."""

    def _format_action_invocation(self, action: argparse.Action) -> str:
        return _LONG.sub("-", super()._format_action_invocation(action))


class _Parser(argparse.ArgumentParser):
    """Parser whose errors are one message, and whose help has options with a single dash."""

    def error(self, message: str) -> NoReturn:
        raise UsageError(f"{message.removeprefix('argument ')}. Try: {self.prog} -help")

    def format_usage(self) -> str:
        return _LONG.sub("-", super().format_usage())

    def format_help(self) -> str:
        return _LONG.sub("-", super().format_help())


class _MainParser(_Parser):
    """Parser of the whole command line, whose help lists the commands in groups."""

    def format_help(self) -> str:
        text = f"usage: {self.prog} COMMAND [options]\n\n{self.description}\n"
        for title, group in GROUPS.items():
            lines = [f"    {name:10s} {command.PURPOSE}" for name, command in group.items()]
            example = next(iter(group.values())).EXAMPLE
            text += "\n".join([f"\n{title}:", *lines, f"  example: {self.prog} {example}", ""])
        options = "    -help      show this text and exit\n    -version   show the version and exit\n"
        return f"{text}\noptions:\n{options}\n{self.epilog}\n"


def _parser() -> argparse.ArgumentParser:
    parser = _MainParser(
        prog="foamprb",
        description="Track soft micro-particles through a flow computed by OpenFOAM.",
        epilog="Options of a command: foamprb COMMAND -help. They take a single or a double dash.",
        add_help=False,
        allow_abbrev=False,
    )
    version = f"foamprb {foamprb.__version__}"
    parser.add_argument("-h", "--help", action="help", help="show this text and exit")
    parser.add_argument("--version", action="version", version=version, help="show the version and exit")
    commands = parser.add_subparsers(dest="command", metavar="COMMAND", parser_class=_Parser)
    for name, command in COMMANDS.items():
        added = commands.add_parser(
            name,
            help=command.PURPOSE,
            description=f"{command.PURPOSE[0].upper()}{command.PURPOSE[1:]}.",
            epilog=f"example: foamprb {command.EXAMPLE}",
            formatter_class=_Help,
            add_help=False,
            allow_abbrev=False,
        )
        command.declare(added)
        messages = added.add_argument_group("messages")
        messages.add_argument("-h", "--help", action="help", help="show this text and exit")
        amount = messages.add_mutually_exclusive_group()
        amount.add_argument("--quiet", action="store_true", help="write warnings only")
        amount.add_argument("--verbose", action="store_true", help="begin each line with the elapsed time, s")
        messages.add_argument("--debug", action="store_true", help="show the traceback of an error")
    return parser


def _complete() -> None:
    """Answer the shell, which wants to complete a command line; does not return."""
    import argcomplete

    argcomplete.autocomplete(_parser())


class _Handler(logging.StreamHandler[TextIO]):
    """Handler that writes plain lines, and warnings in OpenFOAM's manner."""

    timed = False

    def format(self, record: logging.LogRecord) -> str:
        text = record.getMessage()
        if record.levelno >= logging.WARNING:
            text = f"--> foamprb Warning : {text}"
        elapsed = f"[{time.perf_counter() - _START:8.2f}] "
        return "\n".join(f"{elapsed}{line}" for line in text.split("\n")) if self.timed else text

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

    It is 0; 1 for a mistake in the input or a run that had to end early; 2 for a command line that cannot be
    read; 141 if the reader of the output has
    closed it; and 128 plus the number of the signal that ended a run: 130 for Ctrl-C, 143 for SIGTERM.
    """
    if "_ARGCOMPLETE" in os.environ:
        _complete()
    words_given = sys.argv[1:] if arguments is None else arguments
    words = [re.sub(r"^-(?=[A-Za-z]{2})", "--", word) for word in words_given]
    _log_to_stdout()

    def answer(comm: Communicator | None = None) -> int:
        return _exit_status(words, lambda: _do(words, words_given, comm))

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


def _do(words: Sequence[str], typed: Sequence[str], comm: Communicator | None) -> int:
    """Execute the command line; a run with ``-parallel`` has its communicator among the arguments.

    Parameters
    ----------
    words, typed
        Arguments with two dashes before the name of an option, and as the user typed them.
    comm
        Communicator of the ranks.
    """
    for word in words:
        if not word.isprintable() and word != word.encode(errors="replace").decode():
            raise InputError(f"{word}: a name that is not UTF-8, which VTK cannot open. Rename it.")
    if words and not words[0].startswith("-") and words[0] not in COMMANDS:
        raise UsageError(f"unknown command '{words[0]}'. {suggestion(words[0], COMMANDS)}")
    try:
        purposes = {name: command.PURPOSE for name, command in COMMANDS.items()}
        given = argparse.Namespace(comm=comm, purposes=purposes)
        parsed, unknown = _parser().parse_known_args(words, given)
    except UsageError as error:
        raise UsageError(_as_typed(str(error), words, typed)) from None
    if unknown:
        raise UsageError(_as_typed(_unknown(unknown[0], parsed.command), words, typed))
    if parsed.command is None:
        _parser().print_help()
        return 2
    if parsed.quiet:
        logging.getLogger("foamprb").setLevel(logging.WARNING)
    for handler in logging.getLogger("foamprb").handlers:
        if isinstance(handler, _Handler):
            handler.timed = parsed.verbose
    case = getattr(parsed, "case", None)
    if case is not None and not case.is_dir():
        what = "is a file; the folder of a case is needed" if case.exists() else "no such folder"
        raise InputError(f"-case {case}: {what}.")
    return COMMANDS[parsed.command].execute(parsed)


def _unknown(word: str, command: str | None) -> str:
    """Return the message for an argument that a command does not take."""
    program = f"foamprb {command}" if command else "foamprb"
    if not word.startswith("-"):
        return f"'{word}' is one argument too many. Try: {program} -help"
    name, parser = word.partition("=")[0], _parser()
    if command:
        (commands,) = (action for action in parser._actions if isinstance(action, argparse._SubParsersAction))
        parser = commands.choices[command]
    meant = closest(name, {option for action in parser._actions for option in action.option_strings})
    question = f" Did you mean '{meant}'?" if meant else ""
    return f"{program} has no option '{name}'.{question} Try: {program} -help"


def _as_typed(message: str, words: Sequence[str], typed: Sequence[str]) -> str:
    """Return a message in which options have one dash, unless the user typed two."""
    doubled = {
        word.partition("=")[0] for word, as_typed in zip(words, typed, strict=True) if word == as_typed
    }
    return re.sub(
        r"(?<![\w-])--[A-Za-z][\w-]*", lambda m: m[0] if m[0] in doubled else m[0].removeprefix("-"), message
    )


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
        return 2 if isinstance(error, UsageError) else 1
    except KeyboardInterrupt:
        print("--> foamprb stopped by the user.", file=sys.stderr)
        return 130


if __name__ == "__main__":
    sys.exit(main())
