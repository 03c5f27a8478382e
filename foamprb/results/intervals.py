"""Estimates from samples of particles, with intervals of 95 %."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

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
    # Every run prints shares; scipy.stats, which has this interval too, takes a second to load.
    p, w = count / total, _Z * _Z / total
    middle, half = p + 0.5 * w, math.sqrt(w * (p * (1.0 - p) + 0.25 * w))
    # At its ends the interval includes 0 and 1, but for round-off.
    low, high = (middle - half) / (1.0 + w), (middle + half) / (1.0 + w)
    return Estimate(p, low if count else 0.0, high if count < total else 1.0)


def quantile(values: ArrayLike, p: float = 0.5) -> Estimate:
    """Return a quantile of the finite ones of some values, by default the median.

    The ends of the interval are order statistics, so it holds for any distribution; few values have none.
    """
    from scipy.stats import quantile_test

    x = np.asarray(values, dtype=float)
    x = x[np.isfinite(x)]
    if not len(x):
        return Estimate(math.nan, math.nan, math.nan)
    test: Any = quantile_test(x, p=p)
    low, high = test.confidence_interval(_LEVEL)
    return Estimate(float(np.quantile(x, p)), float(low), float(high))


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
