"""Particles on their way from one process to another, and how many should go where."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from types import MappingProxyType
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.layout import LANES
from foamprb.cloud.state import VARIABLES, Particles, concatenate

Rows = NDArray[np.int64]

UNEVEN = 1.1
"""How much longer than with even shares a step may take before particles change hands."""


class Share(NamedTuple):
    """Particles with their numbers in the whole cloud, and what cloud functions remember of them."""

    particles: Particles
    ids: Rows
    memory: Mapping[str, NDArray[Any]] = MappingProxyType({})

    def arrays(self) -> dict[str, NDArray[Any]]:
        """Return all arrays by their names in a record."""
        return {"id": self.ids, **self.particles._asdict(), **self.memory}

    def take(self, rows: Any) -> Share:
        """Return the particles of some rows."""
        memory = {name: array[rows] for name, array in self.memory.items()}
        return Share(self.particles.take(rows), self.ids[rows], memory)


def record(carried: Iterable[tuple[str, str, tuple[int, ...]]] = ()) -> np.dtype[Any]:
    """Return the type of a particle as it travels: number, state, and what is carried with it.

    ``carried`` are names, types and shapes.
    """
    own = ((name, v.dtype, v.shape) for name, v in VARIABLES.items())
    return np.dtype([("id", "i8"), *own, *carried])


def pack(share: Share, rows: Rows, dtype: np.dtype[Any]) -> NDArray[Any]:
    """Return records of the particles in some rows, with the arrays of the type."""
    records, arrays = np.empty(len(rows), dtype=dtype), share.arrays()
    for name in dtype.names or ():
        records[name] = arrays[name][rows]
    return records


def unpack(records: NDArray[Any]) -> Share:
    """Return the particles of records."""
    arrays = {name: records[name].copy() for name in records.dtype.names or ()}
    ids = arrays.pop("id")
    particles = Particles(*(arrays.pop(name) for name in Particles._fields))
    return Share(particles, ids, arrays)


def join(shares: Sequence[Share]) -> Share:
    """Return the particles of several shares, at least one, in order."""
    memory = {name: np.concatenate([s.memory[name] for s in shares]) for name in shares[0].memory}
    ids = np.concatenate([share.ids for share in shares])
    return Share(concatenate(share.particles for share in shares), ids, memory)


def homes_of(n: int, size: int) -> NDArray[np.int64]:
    """Return the number of the first particle whose home is each of several processes, and n, (size + 1,).

    A process is the home of particles of consecutive numbers: it gathers their states, wherever they are.

    Parameters
    ----------
    n, size
        Number of particles and of processes.
    """
    # Rounded up, so that the first process has some if there are any.
    return -(-np.arange(size + 1, dtype=np.int64) * n // size)


def idle_share(before: int, after: int) -> float:
    """Return the share of a step that is saved if the largest of all loads changes; 0 if it grows."""
    return max(0, before - after) / max(before, 1)


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
