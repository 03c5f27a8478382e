"""``foamprb help``: explanation of a settings entry."""

from __future__ import annotations

import argparse

PURPOSE = "explain an entry, a dictionary or a type of the settings"
EXAMPLE = "help shearModulus"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    parser.add_argument("entry", nargs="?", metavar="ENTRY", help="deltaT, solution/deltaT, patchInjection")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.settings.help import explain

    print("\n".join(explain(arguments.entry)))
    return 0
