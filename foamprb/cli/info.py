"""``foamprb info``: contents of a case."""

from __future__ import annotations

import argparse

from foamprb.cli.options import add_flow, source_of

PURPOSE = "show the contents of a case"
EXAMPLE = "info -case cases/pipe"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.flow.read.flows import describe_source

    print("\n".join(describe_source(arguments.case, source_of(arguments))))
    return 0
