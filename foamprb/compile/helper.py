"""Helper process that compiles.

It may start before its task is known, so that it imports numba while the main process does the same.
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
    """Process that reads a task and executes it.

    Parameters
    ----------
    module
        Its main module, which reads the task from the standard input with ``pickle``.
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
        """Send the task."""
        assert self._process.stdin is not None
        # It may have ended already if an import failed.
        with suppress(BrokenPipeError), self._process.stdin as pipe:
            pickle.dump(what, pipe)

    @property
    def ended(self) -> bool:
        """Whether it has finished or failed."""
        return self._process.poll() is not None

    def wait(self) -> None:
        """Wait until it has ended."""
        self._process.wait()

    def stop(self) -> None:
        """End it; compiled code stays in the cache."""
        self._process.kill()
        assert self._process.stdin is not None
        with suppress(BrokenPipeError):
            self._process.stdin.close()
        self._process.wait()
        atexit.unregister(self.stop)


def early_helper(module: str) -> Helper | None:
    """Return a helper if the cache is empty and there is a second processor, else None."""
    root = cache_directory()
    with suppress(OSError):
        if available_threads() > 1 and not (root.exists() and any(root.iterdir())):
            return Helper(module)
    return None


def available_threads() -> int:
    """Return the number of processors that this process may use."""
    return len(os.sched_getaffinity(0))
