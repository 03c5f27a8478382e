"""``foamprb paraview``: ParaView with the bodies of a run."""

from __future__ import annotations

import argparse

from foamprb.cli.options import add_case, add_cloud

PURPOSE = "show the bodies of a run in ParaView"
EXAMPLE = "paraview -case myCase"


def declare(parser: argparse.ArgumentParser) -> None:
    """Add the options of the command."""
    add_case(parser)
    add_cloud(parser)


def execute(arguments: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.view.show import start_paraview

    return start_paraview(arguments.case, arguments.cloud, arguments.region, arguments.results)
