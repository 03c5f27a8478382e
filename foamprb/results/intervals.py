"""Estimates from samples of particles, with intervals of 95 %."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

__all__ = ["Estimate", "difference", "pair_correlation", "quantile", "share"]

_Z = 1.959963984540054
"""Half of the interval of the normal distribution, in standard deviations."""
_LEVEL = 0.95


class Estimate(NamedTuple):
    """Value with its interval of 95 %; NaN without one."""

    value: float
    low: float
    high: float

    def percent(self) -> str:
        """Return it in per cent: ``33.3 % (22.7–45.9 %)``."""
        value, low, high = (f"{100.0 * x:.3g}" for x in self)
        return f"{value} % ({low}–{high} %)"


def share(count: int, total: int) -> Estimate:
    """Return the share of ``count`` of ``total`` particles, with Wilson's interval (1927)."""
    if total == 0:
        return Estimate(math.nan, math.nan, math.nan)
    p, w = count / total, _Z * _Z / total
    middle, half = p + 0.5 * w, math.sqrt(w * (p * (1.0 - p) + 0.25 * w))
    # At its ends the interval includes 0 and 1, but for round-off.
    low, high = (middle - half) / (1.0 + w), (middle + half) / (1.0 + w)
    return Estimate(p, low if count else 0.0, high if count < total else 1.0)


def quantile(values: ArrayLike, p: float = 0.5) -> Estimate:
    """Return a quantile of the finite ones of some values, by default the median.

    The ends of the interval are order statistics, so it holds for any distribution; few values have none
    (Conover, Practical Nonparametric Statistics, 1999, ch. 3).
    """
    x = np.asarray(values, dtype=float)
    x = np.sort(x[np.isfinite(x)])
    n = len(x)
    if n == 0:
        return Estimate(math.nan, math.nan, math.nan)
    # The number of values below the quantile is binomial; scipy.stats takes a second to load.
    k = np.arange(n)
    logs = np.append(0.0, np.cumsum(np.log((n - k) / (k + 1.0) * (p / (1.0 - p)))))
    chances = np.exp(logs - logs.max())
    tail = 0.5 * (1.0 - _LEVEL) * chances.sum()
    low = int(np.searchsorted(np.cumsum(chances), tail)) - 1
    high = n - int(np.searchsorted(np.cumsum(chances[::-1]), tail, side="right"))
    ends = (x[low] if low >= 0 else math.nan, x[high] if high < n else math.nan)
    return Estimate(float(np.quantile(x, p)), float(ends[0]), float(ends[1]))


def difference(a: Estimate, b: Estimate, correlation: float = 0.0) -> Estimate:
    """Return a − b, with the interval that follows from both intervals.

    Newcombe, Statist. Med. 17 (1998) 873 and 2635, for shares; Zou and Donner, Statist. Med. 27 (2008) 1693,
    for any estimates.

    Parameters
    ----------
    a, b
        The estimates.
    correlation
        Of both, if the samples are pairs.
    """
    value = a.value - b.value

    def half(x: float, y: float) -> float:
        return math.sqrt(max(x * x + y * y - 2.0 * correlation * x * y, 0.0))

    low = value - half(a.value - a.low, b.high - b.value)
    return Estimate(value, low, value + half(a.high - a.value, b.value - b.low))


def pair_correlation(a: NDArray[np.bool_], b: NDArray[np.bool_]) -> float:
    """Return the correlation of two properties of the same particles, (n,); 0 if all or none have one."""
    if not (a.any() and b.any()) or a.all() or b.all():
        return 0.0
    return float(np.corrcoef(a, b)[0, 1])
