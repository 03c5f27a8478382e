"""Times at which a flow is given, once or period after period."""

from __future__ import annotations

import math
from bisect import bisect_left, bisect_right
from collections.abc import Sequence

import numpy as np

from foamprb.errors import InputError

_SLACK = 1e-11
"""Share of a time by which another may differ and still be the same. It does not depend on other times of the
flow: results are then the same, bit for bit, when a solver has written more of them."""
_ENDS = 1e-9
"""Share of the first or last time by which a step may go beyond it: names of times are rounded."""
_OF_PERIOD = 1e-6
"""Share of the period within which a time ends it."""
_LONGEST_END = 2.0
"""How many times longer than any other interval the last one of a period may be."""


class Timeline:
    """Times of a flow that is linear in time between them; see :class:`foamprb.flow.series.SeriesFlow`."""

    times: tuple[float, ...]
    """Rising, s."""
    period: float | None
    span: tuple[float, float]
    """First and last time, s."""
    _ends: tuple[float, ...]

    def _set_times(self, times: Sequence[float], period: float | None) -> None:
        """Set the times; InputError if they do not rise, or do not fill the period."""
        self.times = tuple(times) if period is None else one_period(times, period)
        if np.any(np.diff(self.times) <= 0.0):
            raise InputError(f"the times {', '.join(f'{t:g}' for t in self.times)} do not rise.")
        self.period = period
        self._ends = self.times if period is None else (*self.times, self.times[0] + period)
        self.span = (self.times[0], self.times[-1] if period is None else math.inf)

    def _levels_for(self, start: float, end: float) -> range:
        """Return the levels from the last one up to ``start`` to the first one from ``end`` on."""
        beyond = _ENDS * max(abs(self.times[0]), abs(self.times[-1]))
        if not (self.span[0] - beyond <= start and end <= self.span[1] + beyond):
            raise InputError(
                f"the flow is known from {self.span[0]:.12g} s to {self.span[1]:.12g} s, "
                f"not from {start:.12g} s to {end:.12g} s"
            )
        first, last = self._level_before(start), self._level_after(end)
        if last == first:
            # At a given time both intervals are exact, but round-off requires always the same one.
            first, last = (first - 1, last) if self._is_level(first - 1) else (first, last + 1)
        return range(first, last + 1)

    def times_within(self, start: float, end: float) -> Sequence[float]:
        """Return the times of the flow between ``start`` and ``end``, s, those of each period."""
        levels = range(self._level_before(start), self._level_after(end) + 1)
        times = [self._time_of(level) for level in levels]
        return [t for t in times if start + self._slack(start) < t < end - self._slack(end)]

    def times_until(self, t: float) -> tuple[float, ...]:
        """Return the times of a flow without period up to the first one from t on, s."""
        return self.times[: self._level_after(t) + 1]

    def change_until(self, t: float, then: Sequence[float]) -> str:
        """Return how the times up to t differ from earlier ones; empty if a run may continue at t.

        Times before the interval of t may be missing: they are not read again.

        Parameters
        ----------
        t
            Time, s.
        then
            :meth:`times_until` at this time of the flow at the start of the run.
        """
        now, past = self.times_until(t), bisect_right(then, t + self._slack(t)) - 1
        missing = sorted({*then[max(past, 0) :]} - {*now})
        added = sorted({*now} - {*then})
        if missing:
            return f"the time {missing[0]:.12g} of the flow is missing"
        return f"the time {added[0]:.12g} was added to the flow" if added else ""

    def _slack(self, t: float) -> float:
        """Return the difference below which another time is the same as t, s."""
        return _SLACK * max(abs(t), abs(self.times[0]))

    # A level counts the times on from period to period; the index is that of its time in the first period.

    def _index(self, level: int) -> int:
        return level if self.period is None else level % len(self.times)

    def _time_of(self, level: int) -> float:
        if self.period is None:
            return self.times[level]
        cycle, index = divmod(level, len(self.times))
        return self.times[index] + cycle * self.period

    def _is_level(self, level: int) -> bool:
        return level >= 0 and (self.period is not None or level < len(self.times))

    def _level_before(self, t: float) -> int:
        """Return the last level up to t."""
        cycle, rest = self._cycle(t)
        return max(0, cycle * len(self.times) + bisect_right(self._ends, rest + self._slack(t)) - 1)

    def _level_after(self, t: float) -> int:
        """Return the first level from t on."""
        cycle, rest = self._cycle(t)
        level = min(bisect_left(self._ends, rest - self._slack(t)), len(self._ends) - 1)
        return cycle * len(self.times) + level

    def _cycle(self, t: float) -> tuple[int, float]:
        """Return the count of periods before t, and the corresponding time of the first period."""
        if self.period is None:
            return 0, t
        cycle = math.floor((t - self.times[0]) / self.period)
        return cycle, t - cycle * self.period


def one_period(times: Sequence[float], period: float) -> tuple[float, ...]:
    """Return the times of the first period; raise InputError if they do not fill it."""
    first = _period_from(times, 0, period)
    if first:
        return first
    others = [times[k] for k in range(1, len(times)) if _period_from(times, k, period)]
    # Best is one that ends at a time.
    others.sort(key=lambda start: min(abs(t - start - period) for t in times) <= _OF_PERIOD * period)
    remedy = (
        f"-time {others[-1]:g}:{others[-1] + period:g} selects such times" if others else "correct the period"
    )
    raise InputError(
        f"the times from {times[0]:g} to {times[-1]:g} s do not fill the period of {period:g} s from "
        f"{times[0]:g} to {times[0] + period:g} s: {remedy}."
    )


def _period_from(times: Sequence[float], k: int, period: float) -> tuple[float, ...]:
    """Return the times of a period from the k-th on; none if they do not fill it."""
    end = times[k] + period
    found = tuple(t for t in times[k:] if t < end - _OF_PERIOD * period)
    steps = np.diff([*found, end])
    return found if len(found) > 1 and steps[-1] <= _LONGEST_END * steps[:-1].max() else ()
