"""Sensitivity of the results of a study to its entries: indices of Sobol."""

from __future__ import annotations

from collections.abc import Collection, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.results.intervals import share
from foamprb.view.results import Table

__all__ = [
    "QUANTITIES",
    "Design",
    "design_of",
    "index_table",
    "largest_deformation",
    "places_of",
    "samples_of",
    "sobol_indices",
]

Floats = NDArray[np.float64]

_RESAMPLES = 1000
_FEWEST = 4
"""Fewest rows for which indices are computed."""
_ROUND_OFF = 1e-12
QUANTITIES = {"residence time": "s", "largest D": "1"}
"""Quantities of particles whose medians are results, with their units."""


class Design(NamedTuple):
    """Complete rows of a Sobol design among the runs of a study."""

    paths: tuple[str, ...]
    """Entries that vary, d."""
    runs: NDArray[np.str_]
    """Names of the runs, (n, d + 2): a, a with the value of each entry from b, and b; n is a power of 2."""
    missing: int
    """Number of rows that are left out."""


def places_of(fates: Table) -> NDArray[np.str_]:
    """Return where particles ended, ``"escaped: outlet"``, (n,)."""
    pairs = zip(fates["fate"].tolist(), fates["patch"].tolist(), strict=True)
    return np.array([f"{fate}: {patch}" if patch else fate for fate, patch in pairs], dtype=np.str_)


def samples_of(fates: Table) -> dict[str, Floats]:
    """Return the values of :data:`QUANTITIES` of particles, (n,) each; NaN if they are unknown."""
    return {"residence time": fates["t1"] - fates["t0"], "largest D": largest_deformation(fates)}


def largest_deformation(fates: Table) -> Floats:
    """Return the largest D on the path of each particle, (n,); NaN if it is unknown."""
    return fates.get("maxD", fates.get("D", np.full(len(fates["id"]), np.nan)))


def design_of(
    numbers: Mapping[str, int | None], entries: Mapping[str, Mapping[str, str]], ended: Collection[str]
) -> Design | None:
    """Return the Sobol design to which runs belong; None if they belong to none.

    Parameters
    ----------
    numbers
        Number of each run in its study, from 1 on, by name.
    entries
        Values of the replaced entries by path, of each run by name.
    ended
        Names of the runs that have ended.
    """
    by_path: dict[str, set[str]] = {}
    for name in ended:
        for path, text in entries[name].items():
            by_path.setdefault(path, set()).add(text)
    paths = tuple(path for path, texts in by_path.items() if len(texts) > 1)
    names = {number: name for name in ended if (number := numbers[name]) is not None}
    if not paths or not names:
        return None
    width = len(paths) + 2
    # Folders may be named by any numbers.
    starts = sorted({(number - 1) // width * width for number in names})
    groups = [range(k + 1, k + width + 1) for k in starts]
    whole = [[names[number] for number in group] for group in groups if all(n in names for n in group)]
    for group in whole:
        a, *mixed, b = ([entries[name].get(path, "") for path in paths] for name in group)
        if any(row != [*a[:k], b[k], *a[k + 1 :]] for k, row in enumerate(mixed)):
            return None
    if len(whole) < _FEWEST:
        return None
    n = 1 << (len(whole).bit_length() - 1)
    return Design(paths, np.array(whole[:n]), -(-max(names) // width) - n)


def index_table(design: Design, released: Mapping[str, Table]) -> Table:
    """Return :meth:`foamprb.view.runs.Runs.indices` of the released particles of each run, by its name."""
    results: dict[str, list[float]] = {}
    tables = [released[str(name)] for name in design.runs.ravel()]
    places = [places_of(fates) for fates in tables]
    for place in sorted({str(place) for of_run in places for place in np.unique(of_run)}):
        counts = (int(np.count_nonzero(of_run == place)) for of_run in places)
        shares = (share(count, len(of_run)) for count, of_run in zip(counts, places, strict=True))
        results[f"share {place}"] = [estimate.value for estimate in shares]
    for what in QUANTITIES:
        samples = (samples_of(fates)[what] for fates in tables)
        finite = (values[np.isfinite(values)] for values in samples)
        results[f"median {what}"] = [float(np.median(x)) if len(x) else np.nan for x in finite]
    rows: dict[str, list[Any]] = {"result": [], "entry": []}
    for name, values in results.items():
        # A result that is the same in all runs has no variance.
        if np.isfinite(values).all() and np.ptp(values) > _ROUND_OFF * np.max(np.abs(values)):
            columns = sobol_indices(np.reshape(values, design.runs.shape))
            columns |= {"result": [name] * len(design.paths), "entry": list(design.paths)}
            for key, column in columns.items():
                rows.setdefault(key, []).extend(column)
    return {key: np.array(column) for key, column in rows.items()}


def sobol_indices(values: Floats) -> dict[str, list[Any]]:
    """Return the indices of each entry, by Saltelli et al. (2010), with intervals as if the rows were random.

    Parameters
    ----------
    values
        A result in the runs of :class:`Design`, (n, d + 2).

    Returns
    -------
    The share of the variance that each entry explains by itself, ``first``, and with all its interactions,
    ``total``; the ends of the intervals of 95 %, ``firstLow``, ….
    """
    random, n = np.random.default_rng(0), len(values)
    indices = _indices(values)
    resampled = [_indices(values[random.integers(0, n, n)]) for _ in range(_RESAMPLES)]
    low, high = np.quantile(resampled, (0.025, 0.975), axis=0)
    return {
        f"{kind}{end}": of_all[k].tolist()
        for k, kind in enumerate(("first", "total"))
        for end, of_all in (("", indices), ("Low", low), ("High", high))
    }


def _indices(values: Floats) -> Floats:
    """Return the indices of first order and the total ones, (2, d)."""
    from scipy import stats

    f: Any = {"f_A": values[None, :, 0], "f_B": values[None, :, -1], "f_AB": values[:, 1:-1].T[:, None]}
    indices: Any = stats.sobol_indices(func=f, n=len(values))
    return np.stack([np.ravel(indices.first_order), np.ravel(indices.total_order)])
