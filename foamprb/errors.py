"""Exceptions for mistakes in the input and for runs that end early; suggestions for misspelt words."""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class InputError(Exception):
    """Mistake in the input; its message is complete for the user, without a traceback."""


class UsageError(InputError):
    """Command line that cannot be read: an unknown option, a missing or a superfluous argument."""


class FailedParticlesWarning(UserWarning):
    """Failure of particles of a cloud; the message gives their number and the last reason.

    ``warnings.simplefilter("error", FailedParticlesWarning)`` turns it into an exception.
    """


class ValidityWarning(UserWarning):
    """Step or particles beyond the range in which a model or an integrator is right."""


class RunStopped(Exception):  # noqa: N818
    """End of a run before its end time; the message gives the reason, and how to continue."""


class RunInterrupted(RunStopped):
    """End of a run by a signal before its end time.

    Parameters
    ----------
    message
        Reason, and how to continue.
    signal
        Number of the signal.
    """

    def __init__(self, message: str, signal: int = 0) -> None:
        super().__init__(message)
        self.signal = signal


class RankError(Exception):
    """Error on one of the processes of a parallel run; ``trace`` is its traceback as text."""

    def __init__(self, message: str, trace: str = "") -> None:
        super().__init__(message)
        self.trace = trace


def closest(found: str, allowed: Iterable[str], cutoff: float = 0.6) -> str | None:
    """Return the closest allowed word, or None without one whose similarity is at least the cutoff."""
    names = sorted(allowed)
    same = [name for name in names if name.lower() == found.lower()]
    close = same or difflib.get_close_matches(found, names, n=1, cutoff=cutoff)
    return close[0] if close else None


def suggestion(found: str, allowed: Iterable[str]) -> str:
    """Return ``"Did you mean 'x'? Allowed: a, x, z."``, without the question if no word is close."""
    names = sorted(allowed)
    meant = closest(found, names)
    question = f"Did you mean '{meant}'? " if meant else ""
    return f"{question}Allowed: {', '.join(names) if names else '(nothing)'}."
