"""Sums over the arrays of a run that tell flows and particles apart."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats

_CHUNK = 1 << 15
"""Rows at a time, whose arrays stay in the processor's cache."""


def of_rows(values: NDArray[np.floating], numbers: NDArray[np.integer]) -> Floats:
    """Return Σ |v| and Σ w v of each column, (2, k), with w from 0 to 1 by a hash of each number.

    Parameters
    ----------
    values
        v, (n, k); what is not finite counts as 0.
    numbers
        Numbers of the rows, (n,).
    """
    total = np.zeros((2, values.shape[1]))
    for start in range(0, len(values), _CHUNK):
        part = slice(start, start + _CHUNK)
        v = np.asarray(values[part], dtype=np.float64)
        if not np.isfinite(v).all():
            v = np.nan_to_num(v, posinf=0.0, neginf=0.0)
        w = (_mixed(numbers[part].astype(np.uint64)) >> np.uint64(11)) * 2.0**-53
        # Threads of BLAS cost more than these sums.
        total += [np.abs(column).sum() for column in v.T], np.einsum("i,ij->j", w, v)
    return total


def _mixed(x: NDArray[np.uint64]) -> NDArray[np.uint64]:
    """Return a hash of 64-bit numbers: the output function of splitmix64 (Steele, Lea & Flood 2014)."""
    x = x + np.uint64(0x9E3779B97F4A7C15)
    x = (x ^ (x >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    x = (x ^ (x >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return x ^ (x >> np.uint64(31))
