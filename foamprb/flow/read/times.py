"""Which of the times that there are a value, or OpenFOAM's option ``-time``, means."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from foamprb.errors import InputError

_RANGE = re.compile(r"([^:]*):([^:]*)")


def choose_times(source: Path, names: Sequence[str], selection: str | None = None) -> tuple[str, ...]:
    """The names of times that OpenFOAM's option ``-time`` would select, in the order of time.

    Parameters
    ----------
    source
        What has these times, for the messages.
    names
        The names of all times, in their order; at least one.
    selection
        Values and ranges ``a:b``, ``a:`` or ``:b`` (ends included), with commas or blanks between them;
        ``latestTime``; None for all.

    Raises
    ------
    InputError
        A value or a range selects nothing.
    """
    if selection is None:
        return tuple(names)
    chosen: set[str] = set()
    for word in re.split(r"[,\s]+", selection.strip()):
        if match := _RANGE.fullmatch(word):
            low, high = _bound(source, word, match[1], -math.inf), _bound(source, word, match[2], math.inf)
            found = {name for name in names if low <= float(name) <= high}
            if not found:
                raise InputError(f"{source}: no time in {word}; the times go from {names[0]} to {names[-1]}.")
            chosen |= found
        else:
            chosen.add(names[pick_time(source, names, word)])
    return tuple(name for name in names if name in chosen)


def _bound(source: Path, word: str, text: str, default: float) -> float:
    try:
        value = float(text or default)
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise InputError(f"{source}: '{word}' is no range of times, such as 0.1:0.5, 0.1: or :0.5.")
    # Names of times are rounded.
    return value + math.copysign(1e-9 * abs(value), default) if text else value


def pick_time(source: Path, names: Sequence[str], time: float | str) -> int:
    """Position of a time among the names of times, in their order.

    Raises
    ------
    InputError
        There is no such time; the message lists those that there are.
    """
    if time == "latestTime":
        return len(names) - 1
    try:
        value = float(time)
    except ValueError:
        raise InputError(
            f"{source}: time '{time}' is neither a number nor latestTime; the times are {listed(names)}."
        ) from None
    for position, name in enumerate(names):
        if abs(float(name) - value) <= 1e-9 * max(abs(value), 1e-30):
            return position
    raise InputError(f"{source}: no time {time}; the times are {listed(names)}.")


def listed(names: Any) -> str:
    """Names with commas between them, the middle left out where they are many."""
    names = list(names)
    if len(names) > 12:
        names = [*names[:5], "…", *names[-5:]]
    return ", ".join(names) or "(none)"
