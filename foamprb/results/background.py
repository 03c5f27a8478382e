"""Files that are written in a second thread while the particles advance."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Self


class Writer:
    """A thread that does one piece of work at a time, in the order in which they come.

    Never more than one piece is unfinished, which bounds the memory that they need: :meth:`begin` waits for
    the piece before. An error in the thread is raised by the next call of any method, once.

    It is a context: at its end the last piece is finished, or its error raised; if the context ends with an
    error of its own, that one is raised.
    """

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(1, "foamprb-writer")
        self._unfinished: Future[object] | None = None

    def begin(self, work: Callable[[], object]) -> None:
        """Begin a piece of work, once the one before is done."""
        self.finish()
        self._unfinished = self._thread.submit(work)

    def check(self) -> None:
        """Raise the error of the last piece if there was one, without waiting."""
        if self._unfinished is not None and self._unfinished.done():
            self.finish()

    def finish(self) -> None:
        """Wait until the last piece is done."""
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
            # After the run no thread may write to its folder.
            self._thread.shutdown(wait=True)
