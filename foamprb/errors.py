"""What foamprb raises for what a user gave, and for a run that ends early."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class InputError(Exception):
    """A mistake in what the user gave: its message is all that the user needs to see."""


class FailedParticlesWarning(UserWarning):
    """Particles of a cloud failed: its message says how many, and why the last of them.

    ``warnings.simplefilter("error", FailedParticlesWarning)`` makes an exception of it.
    """


class RunStopped(Exception):  # noqa: N818
    """A run that ended before its end time: its message says why, and how to go on."""


class RunInterrupted(RunStopped):
    """A run that a signal ended before its end time.

    Parameters
    ----------
    message
        Why it ended, and how to go on.
    signal
        The number of the signal.
    """

    def __init__(self, message: str, signal: int) -> None:
        super().__init__(message)
        self.signal = signal

    def __reduce__(self) -> tuple[type[RunInterrupted], tuple[str, int]]:
        return RunInterrupted, (str(self), self.signal)


class RankError(Exception):
    """What went wrong on one of the processes of a parallel run; ``trace`` is its traceback, a text."""

    def __init__(self, message: str, trace: str) -> None:
        super().__init__(message)
        self.trace = trace

    def __reduce__(self) -> tuple[type[RankError], tuple[str, str]]:
        return RankError, (str(self), self.trace)


def closest(found: str, allowed: Iterable[str]) -> str | None:
    """Return which of the allowed words was probably meant, None if none is close."""
    names = sorted(allowed)
    same = [name for name in names if name.lower() == found.lower()]
    close = same or difflib.get_close_matches(found, names, n=1, cutoff=0.6)
    return close[0] if close else None


def suggestion(found: str, allowed: Iterable[str]) -> str:
    """Say what is allowed, and which of it was probably meant.

    Returns
    -------
    ``"Did you mean 'x'? Allowed: a, x, z."``, without the question when nothing is close.
    """
    names = sorted(allowed)
    meant = closest(found, names)
    question = f"Did you mean '{meant}'? " if meant else ""
    return f"{question}Allowed: {', '.join(names) if names else '(nothing)'}."
