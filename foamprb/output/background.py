"""Work on files that goes on while the particles do."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Self


class Writer:
    """A thread that does one piece of work at a time, in the order in which they come.

    Never more than one piece is unfinished, so that what they need of memory is bounded: whoever has the next
    waits for it. What went wrong in the thread is raised where the next word with the writer is had, once.

    It is a context: on leaving it without an error the last piece is finished, or its error raised; on
    leaving it with an error, that is the one that counts.
    """

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(1, "foamprb-writer")
        self._unfinished: Future[object] | None = None

    def begin(self, work: Callable[[], object]) -> None:
        """Begin with a piece of work, once the one before is done."""
        self.finish()
        self._unfinished = self._thread.submit(work)

    def check(self) -> None:
        """Raise what has gone wrong so far, without waiting."""
        if self._unfinished is not None and self._unfinished.done():
            self.finish()

    def finish(self) -> None:
        """Wait until nothing is left to do."""
        if self._unfinished is not None:
            unfinished, self._unfinished = self._unfinished, None
            unfinished.result()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        try:
            if error is None:
                self.finish()
        finally:
            # Nobody may find the folder in the hands of a thread whose run is over.
            self._thread.shutdown(wait=True)
