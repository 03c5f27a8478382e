"""``foamprb init``: initial settings of a case."""

from __future__ import annotations

import argparse
from typing import TYPE_CHECKING

from foamprb.cli.options import add_flow, source_of

if TYPE_CHECKING:
    from foamprb.parallel.ranks import Ranks

PURPOSE = "write an initial constant/softCloudProperties for this case"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)


def execute(arguments: argparse.Namespace, _ranks: Ranks | None) -> int:
    """Execute the command; return the exit status."""
    from foamprb.run.template import write_template

    source = source_of(arguments)
    file = write_template(arguments.case, source)
    region = f" -region {source.region}" if source.region else ""
    commands = ", ".join(f"foamprb {name}{region}" for name in ("run -dry-run", "run", "view"))
    print(f"{file} is written. Look through it, then: {commands}.")
    return 0
