"""Mistakes in input files, collected so that one message can list them all."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from types import TracebackType

from foamprb.errors import InputError

_ENDLESS = re.compile(r"\S{500,}")


class Mistake(InputError):  # noqa: N818
    """A mistake in a line of a file, or at line 0 in the whole file.

    Parameters
    ----------
    file, line, what
        The parts of the message.
    missing
        Path of the missing entry, if that is the mistake.
    meant
        Paths of similar entries. If one of them is missing, that is not reported as well.
    """

    def __init__(
        self, file: str, line: int, what: str, *, missing: str = "", meant: Iterable[str] = ()
    ) -> None:
        # A very long word would hide the message.
        what = _ENDLESS.sub(lambda word: f"{word[0][:60]}...", what)
        super().__init__(f"{file}, line {line}: {what}" if line else f"{file}: {what}")
        self.place = (file, line)
        self.missing = missing
        self.meant = frozenset(meant)

    def __reduce__(self) -> tuple[type[InputError], tuple[str]]:
        # Another process receives the message only.
        return InputError, (str(self),)


class ReportedError(InputError):
    """Consequence of a mistake that is reported elsewhere; it adds no line to a message."""


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
    """Collector of the mistakes of guarded blocks, each of which ends at its first mistake.

    ::

        mistakes = Mistakes()
        with mistakes:
            read_one_thing()
        with mistakes:
            read_another()
        mistakes.raise_any()

    Variables that a block assigns may be used after :meth:`raise_any`, or later in the same block.
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
        """Add a mistake, unless the same message is there already."""
        if isinstance(error, ReportedError):
            self._consequence = error
            return
        for one in error.errors if isinstance(error, SeveralMistakes) else (error,):
            self._errors.setdefault(str(one), one)

    def raise_any(self) -> None:
        """Raise the collected mistakes, if there are any.

        Raises
        ------
        InputError
            A single mistake, or SeveralMistakes; ReportedError if they are reported elsewhere.
        """
        mistakes = [error for error in self._errors.values() if isinstance(error, Mistake)]
        meant = frozenset[str]().union(*(error.meant for error in mistakes))
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
