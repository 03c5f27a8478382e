"""The command line, one module per command."""

from foamprb.cli.main import main

__all__ = ["main"]
