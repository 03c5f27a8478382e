"""Regular expressions in the files of a case, which may be made so that a match takes years."""

from __future__ import annotations

import re
import signal
import threading
from collections.abc import Iterator
from contextlib import contextmanager

from foamprb.errors import InputError

LONGEST = 1.0
"""Time of a match after which a pattern is refused, s."""


def matches(pattern: str, word: str) -> bool:
    """Return whether a regular expression matches a whole word; False if it is none.

    Raises
    ------
    InputError
        If that takes too long; in the main thread only, as others receive no signals.
    """
    try:
        with _limited(pattern):
            return re.fullmatch(pattern, word) is not None
    except (re.error, RecursionError, OverflowError):
        return False


@contextmanager
def _limited(pattern: str) -> Iterator[None]:
    """Raise InputError in the main thread after some time."""
    if threading.current_thread() is not threading.main_thread():
        yield
        return

    def stop(*_: object) -> None:
        raise InputError(f"the pattern '{pattern:.60}' takes more than {LONGEST:g} s to match. Simplify it.")

    handler = signal.signal(signal.SIGALRM, stop)
    left, _ = signal.setitimer(signal.ITIMER_REAL, LONGEST)
    try:
        yield
    finally:
        signal.setitimer(signal.ITIMER_REAL, left)
        signal.signal(signal.SIGALRM, handler)
