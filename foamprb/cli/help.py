"""``foamprb help``: explanation of a settings entry."""

from __future__ import annotations

import argparse

from foamprb.errors import InputError

PURPOSE = "explain an entry, a dictionary or a type of the settings"
EXAMPLE = "help shearModulus"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("entry", nargs="?", metavar="ENTRY", help="deltaT, solution/deltaT, patchInjection")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.settings.help import explain

    word = arguments.entry
    lines = []
    if word in arguments.purposes:
        lines = [f"foamprb {word}: {arguments.purposes[word]}. Options: foamprb {word} -help"]
    try:
        explained = explain(word)
    except InputError:
        if not lines:
            raise
        explained = []
    print("\n".join([*lines, *explained]))
    return 0
