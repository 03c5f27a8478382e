"""Mistakes in what a user wrote, collected so that one message can list them all."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from types import TracebackType

from foamprb.errors import InputError

__all__ = ["Mistake", "Mistakes", "ReportedError", "SeveralMistakes"]


_ENDLESS = re.compile(r"\S{500,}")


class Mistake(InputError):  # noqa: N818
    """A mistake in a file, at a line, or at line 0 if it is that something is missing from the whole file.

    Parameters
    ----------
    file, line, what
        The parts of the message.
    missing
        Path of the entry that is missing, if that is the mistake.
    meant
        Paths of the entries that were probably meant by what was found. That one of them is missing is no
        mistake of its own.
    """

    def __init__(
        self, file: str, line: int, what: str, *, missing: str = "", meant: Iterable[str] = ()
    ) -> None:
        # A word as long as that is none, and would hide the message.
        what = _ENDLESS.sub(lambda word: f"{word[0][:60]}...", what)
        super().__init__(f"{file}, line {line}: {what}" if line else f"{file}: {what}")
        self.place = (file, line)
        self.missing = missing
        self.meant = frozenset(meant)

    def __reduce__(self) -> tuple[type[InputError], tuple[str]]:
        # To another process it goes as its message.
        return InputError, (str(self),)


class ReportedError(InputError):
    """What follows from a mistake that is reported elsewhere; of itself it makes no line of a message."""


class SeveralMistakes(InputError):  # noqa: N818
    """Two mistakes or more: their number and a line for each, in the order of files and lines."""

    def __init__(self, errors: Sequence[InputError]) -> None:
        self.errors = tuple(sorted(errors, key=_place))
        lines = "".join(f"\n    {error}" for error in self.errors)
        super().__init__(f"{len(self.errors)} mistakes:{lines}")

    def __reduce__(self) -> tuple[type[InputError], tuple[str]]:
        return InputError, (str(self),)


def _place(error: InputError) -> tuple[str, int]:
    return error.place if isinstance(error, Mistake) else ("", 0)


class Mistakes:
    """Collects the mistakes of the blocks that it guards, each of which ends at its first.

    >>> mistakes = Mistakes()
    >>> with mistakes:
    ...     read_one_thing()
    >>> with mistakes:
    ...     read_another()
    >>> mistakes.raise_any()

    What a block assigns may be used after :meth:`raise_any`, or later in the same block.
    """

    def __init__(self) -> None:
        self._errors: dict[str, InputError] = {}
        self._consequence: ReportedError | None = None

    def __enter__(self) -> None:
        pass

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> bool:
        if not isinstance(error, InputError):
            return False
        self.add(error)
        return True

    def add(self, error: InputError) -> None:
        """Add a mistake; one that is known already counts once."""
        if isinstance(error, ReportedError):
            self._consequence = error
            return
        for one in error.errors if isinstance(error, SeveralMistakes) else (error,):
            self._errors.setdefault(str(one), one)

    def raise_any(self) -> None:
        """Raise what was collected, if anything was.

        Raises
        ------
        InputError
            The only mistake, or SeveralMistakes; or ReportedError if they are reported elsewhere.
        """
        found = [error for error in self._errors.values() if isinstance(error, Mistake)]
        meant = frozenset[str]().union(*(error.meant for error in found))
        errors = [
            error
            for error in self._errors.values()
            if not (isinstance(error, Mistake) and error.missing in meant)
        ]
        if len(errors) == 1:
            raise errors[0]
        if errors:
            raise SeveralMistakes(errors)
        if self._consequence is not None:
            raise self._consequence
