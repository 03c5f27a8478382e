"""Sensitivity of the results of a study to its entries: indices of Sobol."""

from __future__ import annotations

import warnings
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.results.intervals import Estimate

__all__ = ["Design", "Indices", "design_of", "sobol_indices"]

Floats = NDArray[np.float64]

_LEVEL, _RESAMPLES = 0.95, 1000
_FEWEST = 4
"""Fewest rows for which indices are computed."""


class Design(NamedTuple):
    """Complete rows of a Sobol design among the runs of a study."""

    paths: tuple[str, ...]
    """Entries that vary, d."""
    runs: NDArray[np.str_]
    """Names of the runs, (n, d + 2): a, a with the value of each entry from b, and b; n is a power of 2."""
    missing: int
    """Number of rows that are left out."""


class Indices(NamedTuple):
    """Shares of the variance of a quantity that one entry explains."""

    first: Estimate
    """By itself."""
    total: Estimate
    """With all its interactions."""


def design_of(numbers: Mapping[str, int | None], entries: Mapping[str, Mapping[str, str]]) -> Design | None:
    """Return the Sobol design to which runs belong; None if they belong to none.

    Parameters
    ----------
    numbers
        Number of each run in its study, from 1 on, by name.
    entries
        Values of the replaced entries by path, of each run by name.
    """
    by_path: dict[str, set[str]] = {}
    for values in entries.values():
        for path, text in values.items():
            by_path.setdefault(path, set()).add(text)
    paths = tuple(path for path, texts in by_path.items() if len(texts) > 1)
    width, names = len(paths) + 2, {number: name for name, number in numbers.items() if number is not None}
    if not paths or not names:
        return None
    groups = [range(k + 1, k + width + 1) for k in range(0, max(names), width)]
    whole = [[names[number] for number in group] for group in groups if all(n in names for n in group)]
    for group in whole:
        a, *mixed, b = ([entries[name].get(path, "") for path in paths] for name in group)
        if any(row != [*a[:k], b[k], *a[k + 1 :]] for k, row in enumerate(mixed)):
            return None
    if len(whole) < _FEWEST:
        return None
    n = 1 << (len(whole).bit_length() - 1)
    return Design(paths, np.array(whole[:n]), len(groups) - n)


def sobol_indices(values: Floats) -> list[Indices]:
    """Return the indices of each entry, by Saltelli et al. (2010), with intervals by resampling the rows.

    Parameters
    ----------
    values
        A quantity in the runs of :class:`Design`, (n, d + 2).
    """
    from scipy import stats

    f: Any = {"f_A": values[None, :, 0], "f_B": values[None, :, -1], "f_AB": values[:, 1:-1].T[:, None]}
    result: Any = stats.sobol_indices(func=f, n=len(values), rng=np.random.default_rng(0))
    with warnings.catch_warnings(), np.errstate(invalid="ignore"):
        # An entry without any effect has indices 0 in all samples, and no interval.
        warnings.simplefilter("ignore", stats.DegenerateDataWarning)
        spread = result.bootstrap(_LEVEL, _RESAMPLES)
    first, total = (
        np.stack([np.ravel(row) for row in (index, *resampled.confidence_interval)], axis=1).tolist()
        for index, resampled in (
            (result.first_order, spread.first_order), (result.total_order, spread.total_order)
        )
    )  # fmt: skip
    return [Indices(Estimate(*one), Estimate(*all_of)) for one, all_of in zip(first, total, strict=True)]
