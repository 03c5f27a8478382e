"""Selection of times by a value or by OpenFOAM's option ``-time``."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from itertools import pairwise
from pathlib import Path
from typing import Any

from foamprb.errors import InputError

_RANGE = re.compile(r"([^:]*):([^:]*)")


def choose_times(source: Path, names: Sequence[str], selection: str | None = None) -> tuple[str, ...]:
    """Return the names of the times that OpenFOAM's option ``-time`` selects, in the order of time.

    Parameters
    ----------
    source
        Owner of the times, for messages.
    names
        The names of all times, in their order; at least one.
    selection
        Values and ranges ``a:b``, ``a:`` or ``:b`` (ends included), separated by commas or blanks;
        ``latestTime``; None for all.

    Raises
    ------
    InputError
        A value or a range selects nothing; or two names are the same time.
    """
    if selection is None:
        _require_different(source, names)
        return tuple(names)
    chosen: set[str] = set()
    for word in re.split(r"[,\s]+", selection.strip()):
        if _RANGE.fullmatch(word):
            inside = names_in(source, names, word)
            if not inside:
                raise InputError(f"{source}: no time in {word}; the times go from {names[0]} to {names[-1]}.")
            chosen |= {*inside}
        else:
            chosen.add(names[pick_time(source, names, word)])
    result = tuple(name for name in names if name in chosen)
    _require_different(source, result)
    return result


def names_in(source: Path, names: Sequence[str], selection: str | None) -> tuple[str, ...]:
    """Return the times in a range ``a:b``, ``a:`` or ``:b``, perhaps none; all for None.

    Raises
    ------
    InputError
        ``selection`` is not a range.
    """
    word = ":" if selection is None else selection.strip()
    match = _RANGE.fullmatch(word)
    low, high = (
        _bound(source, word, match[k] if match else "?", end) for k, end in ((1, -math.inf), (2, math.inf))
    )
    return tuple(name for name in names if low <= float(name) <= high)


def _require_different(source: Path, names: Sequence[str]) -> None:
    for one, other in pairwise(names):
        if _is_same(float(one), float(other)):
            raise InputError(f"{source}: {one} and {other} are the same time; remove one.")


def _bound(source: Path, word: str, text: str, default: float) -> float:
    try:
        value = float(text or default)
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise InputError(f"{source}: '{word}' is no range of times, such as 0.1:0.5, 0.1: or :0.5.")
    # The names of times are rounded.
    return value + math.copysign(1e-9 * abs(value), default) if text else value


def pick_time(source: Path, names: Sequence[str], time: float | str) -> int:
    """Return the position of a time among the names of times.

    Raises
    ------
    InputError
        There is no such time, and the message lists the times; or two names mean it, and neither equals
        ``time``.
    """
    if time in names:
        return names.index(str(time))
    try:
        value = float(names[-1] if time == "latestTime" else time)
    except ValueError:
        raise InputError(
            f"{source}: time '{time}' is neither a number nor latestTime; the times are {listed(names)}."
        ) from None
    positions = [position for position, name in enumerate(names) if _is_same(float(name), value)]
    if not positions:
        raise InputError(f"{source}: no time {time}; the times are {listed(names)}.")
    if len(positions) > 1:
        one, other = names[positions[0]], names[positions[1]]
        raise InputError(
            f"{source}: {one} and {other} are the same time. Remove one, or say which: -time {one} or "
            f"-time {other}."
        )
    return positions[0]


def _is_same(a: float, b: float) -> bool:
    return abs(a - b) <= 1e-9 * max(abs(b), 1e-30)


def listed(names: Any) -> str:
    """Join names by commas, without the middle of many names."""
    names = list(names)
    if len(names) > 12:
        names = [*names[:5], "…", *names[-5:]]
    return ", ".join(names) or "(none)"
