"""``foamprb compile``: compilation of the particle loops."""

from __future__ import annotations

import argparse

PURPOSE = "compile the particle loops before the first run"
EXAMPLE = "compile"


def declare(_parser: argparse.ArgumentParser) -> None:
    """Add no options."""


def execute(_: argparse.Namespace) -> int:
    """Execute the command; return the exit status."""
    from foamprb.run.precompile import compile_all

    compile_all()
    return 0
