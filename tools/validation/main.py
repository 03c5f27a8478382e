"""The command line of ``tools/validate``."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

from foamprb.errors import InputError
from validation.registry import CASES
from validation.report import choose, validate


def main(words: Sequence[str] | None = None) -> int:
    """Run the validation; return the exit status, which is 1 if a row fails or a case is unknown."""
    arguments = _parser().parse_args(words)
    try:
        cases = choose(CASES, arguments.case)
    except InputError as error:
        print(f"validate: {error}", file=sys.stderr)
        return 1
    if arguments.list:
        for name, case in cases.items():
            print(f"{name:14s} {case.title} ({case.section})")
        return 0
    return 0 if validate(cases, arguments.output, arguments.quick, list(CASES)) else 1


def _parser() -> argparse.ArgumentParser:
    parser = argparse.ArgumentParser(
        prog="validate",
        description="Compare foamprb with independent solutions, and write a report with figures.",
        add_help=False,
        allow_abbrev=False,
    )
    parser.add_argument("-h", "-help", "--help", action="help", help="show this text and stop")
    parser.add_argument(
        "-case", "--case", nargs="+", action="extend", default=[], metavar="NAME", help="only these [all]"
    )
    parser.add_argument("-quick", "--quick", action="store_true", help="a short form of every case")
    parser.add_argument(
        "-output", "--output", type=Path, default=Path("validation"), metavar="DIR", help="[validation]"
    )
    parser.add_argument("-list", "--list", action="store_true", help="list the cases and stop")
    return parser
