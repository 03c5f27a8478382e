"""Particles on their way from one process to another, and how many should go where."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.layout import LANES
from foamprb.cloud.state import VARIABLES, Particles

Rows = NDArray[np.int64]

UNEVEN = 1.1
"""How much longer than with even shares a step may take before particles change hands."""
RECORD = np.dtype([("id", "i8"), *((name, v.dtype, v.shape) for name, v in VARIABLES.items())])
"""A particle as it travels: its number in the whole cloud, and its state."""


def pack(p: Particles, rows: Rows, ids: Rows) -> NDArray[Any]:
    """Return records of the particles in some rows.

    Parameters
    ----------
    ids
        Their numbers in the whole cloud, as many as ``rows``.
    """
    records = np.empty(len(rows), dtype=RECORD)
    records["id"] = ids
    for name, array in p._asdict().items():
        records[name] = array[rows]
    return records


def unpack(records: NDArray[Any]) -> tuple[Particles, Rows]:
    """Return the particles of records, and their numbers in the whole cloud."""
    return Particles(*(records[name].copy() for name in Particles._fields)), records["id"].copy()


def homes_of(n: int, size: int, whole: bool) -> NDArray[np.int64]:
    """Return the number of the first particle whose home is each of several processes, and n, (size + 1,).

    A process is the home of particles of consecutive numbers: it gathers their states, wherever they are.

    Parameters
    ----------
    n, size
        Number of particles and of processes.
    whole
        Whether the first process is the home of all.
    """
    if whole:
        return np.array([0] + [n] * size, dtype=np.int64)
    return np.arange(size + 1, dtype=np.int64) * n // size


def plan_exchange(active: Sequence[int]) -> NDArray[np.int64] | None:
    """Who gives how many active particles to whom, so that all have as many; None if it does not pay.

    The processes wait for the one with most blocks of particles, a block taking its time however few are in
    it.

    Parameters
    ----------
    active
        Number of active particles of each of n processes.

    Returns
    -------
    The number that process i gives to process j, (n, n).
    """
    n, total = len(active), sum(active)
    even = np.diff(np.arange(n + 1) * total // n)
    if -(-max(active) // LANES) <= UNEVEN * -(-int(even.max()) // LANES):
        return None
    plan = np.zeros((n, n), dtype=np.int64)
    surplus = np.asarray(active) - even
    givers, takers = np.flatnonzero(surplus > 0), np.flatnonzero(surplus < 0)
    # Surplus and deficit as rows of particles: each surplus particle goes to the deficit at the same index.
    given = np.repeat(givers, surplus[givers])
    taken = np.repeat(takers, -surplus[takers])
    np.add.at(plan, (given, taken), 1)
    return plan
