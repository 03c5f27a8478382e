"""Writing of files in a second thread while the particles advance."""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from types import TracebackType
from typing import Self


class Writer:
    """Thread that performs one task at a time, in order.

    At most one task is unfinished, which bounds the memory: :meth:`submit` waits for the task before.
    The next call of any method raises the error of a task, once.

    At the end of the context the last task is finished, or its error raised. An error of the context itself
    takes precedence.
    """

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(1, "foamprb-writer")
        self._unfinished: Future[object] | None = None

    def submit(self, work: Callable[[], object]) -> None:
        """Begin a task when the task before is finished."""
        self.finish()
        self._unfinished = self._thread.submit(work)

    def check(self) -> None:
        """Raise the error of the last task, without waiting."""
        if self._unfinished is not None and self._unfinished.done():
            self.finish()

    def finish(self) -> None:
        """Wait for the last task."""
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
            # No thread may write to the folder after the run.
            self._thread.shutdown(wait=True)
