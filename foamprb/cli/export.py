"""``foamprb export``: results in the files of other programs."""

from __future__ import annotations

import argparse
import logging

from foamprb.cli.options import add_cloud, add_flow, fraction, output_path, source_of

PURPOSE = "write the results for OpenFOAM, or as one VTKHDF file"
EXAMPLE = "export vtkhdf -case myCase -output bodies.vtkhdf"

log = logging.getLogger("foamprb")


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_flow(parser)
    add_cloud(parser)
    add = parser.add_argument
    add(
        "kind",
        choices=("openfoam", "vtkhdf", "stress"),
        help="format of the files, or their stress for a solver",
    )
    add("--output", type=output_path, metavar="PATH", help="file or folder [postProcessing/CLOUD/...]")
    add(
        "--volumeFraction",
        type=fraction,
        metavar="PHI",
        help="stress of this mean volume fraction of the particles [that of the run]",
    )
    add("--flowTime", default="latestTime", metavar="TIME", help="time of the flow with the mesh [latest]")


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.export import export as write

    target = write(
        arguments.kind,
        arguments.case,
        arguments.cloud,
        source_of(arguments),
        arguments.flowTime,
        arguments.output,
        arguments.results,
        arguments.volumeFraction,
    )
    log.info("Written: %s", target)
    return 0
