"""Distributions of sizes and stiffnesses over a population: OpenFOAM's distribution models, with its entries.

A distribution is given by its quantile function, the value below which a given share of the population lies.
Samples are the quantiles of uniform random numbers: limits are exact, and no sample is rejected.

A new distribution is a frozen dataclass of its entries and a line in :data:`DISTRIBUTIONS`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.constraints import Meaning, Pairs, Positive
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entries, read_entry, refuse_unknown, selected
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class Distribution:
    """A distribution of one quantity, in the quantity's own unit."""

    @property
    def limits(self) -> tuple[float, float]:
        """The smallest and the largest value."""
        raise NotImplementedError

    def quantile(self, share: Floats) -> Floats:
        """Return the values below which the shares (n,), from 0 to 1, of the population lie."""
        raise NotImplementedError

    @staticmethod
    def from_dictionary(dictionary: Dictionary) -> Distribution:
        """Read ``{ type name; nameDistribution { … } }``, a distribution of positive numbers."""
        kind = selected(DISTRIBUTIONS, dictionary)
        coefficients = f"{read_entry(dictionary, 'type', str)}Distribution"
        mistakes = Mistakes()
        with mistakes:
            refuse_unknown(dictionary, ("type", coefficients))
        with mistakes:
            entries: Dictionary = read_entry(dictionary, coefficients, Dictionary)
            distribution = read_entries(kind, entries)
            if not distribution.limits[0] > 0.0:
                raise entries.mistake(f"begins at {distribution.limits[0]:g}. Allowed: values > 0.")
        mistakes.raise_any()
        return distribution


@dataclass(frozen=True)
class FixedValue(Distribution):
    """Every particle has the same value."""

    value: Annotated[float, Meaning("of every particle")]

    @property
    def limits(self) -> tuple[float, float]:
        """The value, twice."""
        return self.value, self.value

    def quantile(self, share: Floats) -> Floats:
        """Return the value for each share."""
        return np.full(len(share), self.value)


@dataclass(frozen=True)
class _Bounded(Distribution):
    """A distribution between two values."""

    minValue: Annotated[float, Meaning("smallest value")]
    maxValue: Annotated[float, Meaning("largest value")]

    def __post_init__(self) -> None:
        if not self.minValue < self.maxValue:
            raise InputError(f"has minValue {self.minValue:g}, which is not below maxValue {self.maxValue:g}")

    @property
    def limits(self) -> tuple[float, float]:
        """``minValue`` and ``maxValue``."""
        return self.minValue, self.maxValue


@dataclass(frozen=True)
class Uniform(_Bounded):
    """All values between the limits are equally likely."""

    def quantile(self, share: Floats) -> Floats:
        """Return values that are linear in the share."""
        return self.minValue + share * (self.maxValue - self.minValue)


@dataclass(frozen=True)
class Normal(_Bounded):
    """A density proportional to exp(−((x − expectation)/variance)²) between the limits.

    ``variance`` is defined as in OpenFOAM up to v2112: √2 times the standard deviation of the whole bell, in
    the quantity's own unit.
    """

    expectation: Annotated[float, Meaning("where the density is largest")]
    variance: Annotated[
        float, Positive, Meaning("a width: √2 times the standard deviation of the whole bell")
    ]

    def __post_init__(self) -> None:
        from scipy.special import ndtr

        super().__post_init__()
        low, high, _ = self._tail()
        if not ndtr(high) > ndtr(low):
            raise InputError("has limits so far from its expectation that no values remain between them")

    def _tail(self) -> tuple[float, float, float]:
        """Return the limits in standard deviations, mirrored (−1) if that gives the accurate lower tail."""
        deviation = self.variance / np.sqrt(2.0)
        low = (self.minValue - self.expectation) / deviation
        high = (self.maxValue - self.expectation) / deviation
        return (-high, -low, -1.0) if low > 0.0 else (low, high, 1.0)

    def quantile(self, share: Floats) -> Floats:
        """Return quantiles of the normal distribution, on the part between the limits."""
        from scipy.special import ndtr, ndtri

        low, high, side = self._tail()
        below = ndtr(low)
        s = share if side > 0.0 else 1.0 - share
        z = ndtri(below + s * (ndtr(high) - below))
        x = self.expectation + side * self.variance / np.sqrt(2.0) * z
        return np.asarray(np.clip(x, self.minValue, self.maxValue))


@dataclass(frozen=True)
class RosinRammler(_Bounded):
    """A share 1 − exp(−((x − minValue)/d)ⁿ) of the values is below x, cut off at ``maxValue``.

    As in OpenFOAM up to v2112, the distribution begins at ``minValue``.
    """

    d: Annotated[float, Positive, Meaning("scale")]
    n: Annotated[float, Positive, Meaning("exponent", "1")]

    def quantile(self, share: Floats) -> Floats:
        """Return the inverse of the share."""
        with np.errstate(over="ignore", divide="ignore"):
            share_below_maximum = -np.expm1(-np.float_power((self.maxValue - self.minValue) / self.d, self.n))
            x = self.minValue + self.d * (-np.log1p(-share_below_maximum * share)) ** (1.0 / self.n)
        return np.asarray(np.clip(x, self.minValue, self.maxValue))


@dataclass(frozen=True)
class General(Distribution):
    """A density given at increasing values, ``( (x w) (x w) … )``, linear between them, of any scale."""

    distribution: Annotated[Pairs, Meaning("`( (x w) (x w) … )`, x increasing")]

    def __post_init__(self) -> None:
        x, w = np.transpose(self.distribution) if self.distribution else np.empty((2, 0))
        if len(x) < 2 or not (np.diff(x) > 0.0).all():
            raise InputError("needs two pairs (x w) or more, x increasing")
        if (w < 0.0).any() or not w.any():
            raise InputError("has a density w that is negative, or zero throughout")

    @property
    def limits(self) -> tuple[float, float]:
        """The first and the last x."""
        return self.distribution[0][0], self.distribution[-1][0]

    def quantile(self, share: Floats) -> Floats:
        """Return the inverse of the integral of the density, a quadratic in each interval."""
        x, w = np.transpose(self.distribution)
        # So that no product underflows.
        w = w / w.max()
        h = np.diff(x)
        area = 0.5 * h * (w[1:] + w[:-1])
        total = np.concatenate([[0.0], np.cumsum(area)])
        sought = share * total[-1]
        # Intervals without area are skipped: the last of equal sums is the one where the density begins.
        i = np.clip(np.searchsorted(total, sought, side="right") - 1, 0, np.flatnonzero(area)[-1])
        remaining = np.maximum(sought - total[i], 0.0) / h[i]
        rise = w[i + 1] - w[i]
        root = np.sqrt(np.maximum(w[i] ** 2 + 2.0 * rise * remaining, 0.0))
        part = np.divide(2.0 * remaining, w[i] + root, out=np.zeros_like(root), where=w[i] + root > 0.0)
        return np.asarray(x[i] + np.clip(part, 0.0, 1.0) * h[i])


DISTRIBUTIONS: dict[str, type[Distribution]] = {
    "fixedValue": FixedValue,
    "general": General,
    "normal": Normal,
    "RosinRammler": RosinRammler,
    "uniform": Uniform,
}
"""By the word that ``type`` selects."""


@dataclass(frozen=True)
class Scaled(Distribution):
    """A quantity that is ``factor`` times a power, 1 or −1, of another, distributed and positive."""

    base: Distribution
    factor: float
    power: int = 1

    @property
    def limits(self) -> tuple[float, float]:
        """Smallest and largest value of the result."""
        low, high = (float(_power(value, self.factor, self.power)) for value in self.base.limits)
        return min(low, high), max(low, high)

    def quantile(self, share: Floats) -> Floats:
        """Return quantiles of the result; a power −1 reverses their order."""
        below = share if self.power > 0 else 1.0 - share
        return _power(self.base.quantile(below), self.factor, self.power)


def scaled(quantity: float | Distribution, factor: float, power: int = 1) -> float | Distribution:
    """Return ``factor`` times a power of a quantity, distributed or not; infinite where that overflows."""
    if isinstance(quantity, float):
        return float(_power(quantity, factor, power))
    return Scaled(quantity, factor, power)


def _power(value: float | Floats, factor: float, power: int) -> Floats:
    with np.errstate(over="ignore"):
        return np.asarray(factor * np.asarray(value, dtype=float) ** power)


def draw(quantity: float | Distribution, n: int, random: np.random.Generator) -> Floats:
    """Return n values of a quantity that is the same for all, or distributed."""
    if isinstance(quantity, float | int):
        return np.full(n, float(quantity))
    return quantity.quantile(random.random(n))
