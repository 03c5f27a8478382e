"""Another process that compiles, which may be started before it is known what.

To load what compiles takes it a good half of a second, in which this process does the same.
"""

from __future__ import annotations

import atexit
import os
import pickle
import subprocess
import sys
from contextlib import suppress
from typing import Any

from foamprb.compile.cache import cache_directory

__all__ = ["Helper", "available_threads", "early_helper"]


class Helper:
    """A process that waits to be told what to do.

    Parameters
    ----------
    module
        What it executes: a module that reads from the standard input, with ``pickle``, what it is told.
    """

    def __init__(self, module: str) -> None:
        self._process = subprocess.Popen(
            [sys.executable, "-m", module],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(self.stop)

    def tell(self, what: Any) -> None:
        """Tell it what to do."""
        assert self._process.stdin is not None
        # It may have ended already, if it cannot import what it needs.
        with suppress(BrokenPipeError), self._process.stdin as pipe:
            pickle.dump(what, pipe)

    @property
    def ended(self) -> bool:
        """Whether it has done what it was told, or failed."""
        return self._process.poll() is not None

    def wait(self) -> None:
        """Wait until it has ended."""
        self._process.wait()

    def stop(self) -> None:
        """End it; what it has made so far stays in the cache."""
        self._process.kill()
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.close()
        self._process.wait()
        atexit.unregister(self.stop)


def early_helper(module: str) -> Helper | None:
    """A helper if nothing has ever been compiled here, and there is a processor to spare."""
    root = cache_directory()
    with suppress(OSError):
        if available_threads() > 1 and not (root.exists() and any(root.iterdir())):
            return Helper(module)
    return None


def available_threads() -> int:
    """Number of processors that this process may use."""
    return len(os.sched_getaffinity(0))
