"""Compilation before the code is wanted.

Where the particle loop has never been compiled and there is a processor to spare, another process compiles it
while the first compiles some of its stages and reads the flow. Each finds what the other has made where
compiled code is kept; if the other process fails, or made what is not wanted, the first compiles.
"""

from __future__ import annotations

import atexit
import pickle
import subprocess
import sys
from contextlib import suppress
from typing import TYPE_CHECKING

from foamprb.cloud.executor import available_threads
from foamprb.cloud.state import empty
from foamprb.cloud.tracker import Tracker

if TYPE_CHECKING:
    # The process that compiles should soon begin to.
    from foamprb.flow.meshflow import MeshFlow
    from foamprb.flow.series import SeriesFlow

__all__ = ["Ahead"]


class Ahead:
    """The process that compiles.

    Parameters
    ----------
    tracker
        What is to be compiled, as far as it can be known before the flow is.
    flow
        Which kind of flow it will be.
    """

    def __init__(self, tracker: Tracker, flow: type[MeshFlow] | type[SeriesFlow]) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        if tracker.compiled or available_threads() == 1:
            return
        self._process = subprocess.Popen(
            [sys.executable, "-m", "foamprb.run.precompile"],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(self.stop)
        assert self._process.stdin is not None
        # It may have ended already, if it cannot import what it needs.
        with suppress(BrokenPipeError), self._process.stdin as pipe:
            pickle.dump((tracker, flow), pipe)

    def __bool__(self) -> bool:
        """Whether there is such a process."""
        return self._process is not None

    def wait(self) -> None:
        """Wait until it has ended."""
        if self._process is not None:
            self._process.wait()

    def stop(self) -> None:
        """Let it make nothing more."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()


def main() -> None:
    """Compile what stands on the standard input."""
    tracker, flow = pickle.load(sys.stdin.buffer)
    tracker.compile_moves(flow.nothing())
    # With no particles nothing is done but to compile.
    tracker.advance(flow.nothing(), empty(0), 0, 0, 1)


if __name__ == "__main__":
    main()
