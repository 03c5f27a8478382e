"""``foamprb init``: initial settings of a case."""

from __future__ import annotations

import argparse
import shlex
from pathlib import Path

from foamprb.cli.options import add_flow, output_path, source_of

PURPOSE = "write an initial constant/softCloudProperties for this case"
EXAMPLE = "init -case myCase"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    parser.add_argument(
        "--output", type=output_path, metavar="FILE", help="the settings [constant/softCloudProperties]"
    )


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.run.template import write_template

    source = source_of(arguments)
    file = write_template(arguments.case, source, arguments.output)
    case = "" if arguments.case == Path() else f" -case {shlex.quote(str(arguments.case))}"
    region = f" -region {source.region}" if source.region else ""
    option = f" -dict {shlex.quote(str(file.resolve()))}" if arguments.output else ""
    run = f"foamprb run{case}{source.options}{option}"
    print(f"{file} is written. Look through it, then: {run} -dry-run, {run}, foamprb view{case}{region}.")
    return 0
