"""Compilation of the code of a run, with a second process.

If the loop is not in the cache and there is a processor to spare, a second process compiles it while this one
reads the flow, for which it compiles about as much. This process finds the loop in the cache. If the second
process fails, or compiled another loop than the run needs, this one compiles.
"""

from __future__ import annotations

import atexit
import logging
import os
import pickle
import subprocess
import sys
import threading
import time as clock
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from typing import Any

import numpy as np

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import context, measure, shapes
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Tracker, available_threads
from foamprb.compile.cache import cache_directory
from foamprb.flow.meshflow import MeshFlow
from foamprb.settings.libs import compiling_libs

log = logging.getLogger("foamprb")

_TICK, _BETWEEN_LINES = 1.0, 30.0
"""Time between two looks whether something compiles, and between two lines of the log, s."""


class Compilation:
    """Compilation for one run, by this process and a second one; a run does not depend on the second."""

    def __init__(self) -> None:
        self._process: subprocess.Popen[bytes] | None = None
        self._span: tuple[float, float] | None = None
        """First and last time at which something was compiled, s."""

    def begin(self, tracker: Tracker, flow: type[MeshFlow]) -> None:
        """Start the second process, if a loop is not compiled and a processor is to spare.

        Parameters
        ----------
        tracker
            The loop that the settings select, as far as they determine it without the flow.
        flow
            Class of the flow.
        """
        if tracker.is_compiled(flow.nothing()) or available_threads() == 1:
            return
        self._process = subprocess.Popen(
            [sys.executable, "-P", "-m", __name__],
            stdin=subprocess.PIPE,
            stdout=subprocess.DEVNULL,
            stderr=subprocess.DEVNULL,
        )
        atexit.register(self.stop)
        assert self._process.stdin is not None
        # The process may have ended already, if it cannot import its modules.
        with suppress(BrokenPipeError), self._process.stdin as pipe:
            pickle.dump((tracker, flow), pipe)

    @contextmanager
    def shown(self) -> Iterator[None]:
        """Show the elapsed time while something compiles: on a terminal in one line, else in the log.

        After an error the second process is ended.
        """
        from numba.core import event

        ended = threading.Event()
        with event.install_recorder("numba:compile") as compiled:
            thread = threading.Thread(target=self._show, args=(compiled.buffer, ended), daemon=True)
            thread.start()
            try:
                yield
            except BaseException:
                self.stop()
                raise
            finally:
                ended.set()
                thread.join()

    def _show(self, events: list[tuple[float, Any]], ended: threading.Event) -> None:
        terminal, last = sys.stderr.isatty(), 0.0
        # The reader of the log may have gone.
        with suppress(BrokenPipeError):
            while not ended.wait(_TICK):
                here = sum(1 if one.is_start else -1 for _, one in events)
                if not here and (self._process is None or self._process.poll() is not None):
                    continue
                now = clock.perf_counter()
                if self._span is None:
                    log.info("Compiling the formulas, once; the code is kept in %s", cache_directory())
                began, _ = self._span = (now, now) if self._span is None else (self._span[0], now)
                text = f"Compiling: {now - began:.0f} s"
                if terminal:
                    # The next line of the log begins in the first column.
                    print(f"\x1b[2K{text}", end="\r", file=sys.stderr, flush=True)
                elif now - max(began, last) >= _BETWEEN_LINES:
                    log.info(text)
                    last = now
            if terminal:
                print("\x1b[2K", end="", file=sys.stderr, flush=True)

    def wait(self) -> None:
        """Wait until the process has ended."""
        if self._process is not None:
            self._process.wait()

    def log_end(self) -> None:
        """Log how long the compilation took, if it was noticed."""
        if self._span is not None:
            log.info("Compiled in %.0f s", self._span[1] - self._span[0])
            self._span = None

    def stop(self) -> None:
        """End the process; code compiled so far stays in the cache."""
        if self._process is not None:
            self._process.kill()
            self._process.wait()
            atexit.unregister(self.stop)


def compile_run(cloud: Cloud, compilation: Compilation) -> None:
    """Compile the code of a run; no-op for compiled code."""
    with compilation.shown():
        arguments = cloud.make_ready()
        compilation.wait()
        # The thread that writes measures the particles, and code may not be linked in two threads at once.
        first = cloud.particles.take(np.arange(min(1, cloud.particles.size)))
        first.status[:] = Status.ACTIVE
        measure(context(first, cloud.flow, cloud.medium.mu, cloud.time), ["J"])
        # Of several ranks, each compiles the loop with its first steps.
        if cloud.comm.size == 1:
            with compiling_libs():
                cloud.tracker.compile(arguments)
    compilation.log_end()


def main() -> None:
    """Compile the loop that the standard input describes, and the measures, which share its stages."""
    tracker, flow = pickle.load(sys.stdin.buffer)
    tracker.compile(flow.nothing())
    shapes(spheres([(0.0, 0.0, 0.0)], d=1.0, rho=1.0, mu=1.0))
    os._exit(0)


if __name__ == "__main__":
    main()
