"""Place and time at which particles cross a plane between two samples."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Any, ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.contact import Rebounds
from foamprb.cloudfunctions.base import (
    ContactObserver,
    Kind,
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    passages,
    per_particle,
    store,
)
from foamprb.dictionary.constraints import Vector3
from foamprb.errors import InputError

__all__ = ["Crossings", "PlaneFunction", "crossings", "unit"]

Floats = NDArray[np.float64]


class Crossings(NamedTuple):
    """Particles that have changed sides."""

    among: NDArray[np.bool_]
    """For each of the given rows, whether it has."""
    rows: Rows
    """(n,)."""
    share: Floats
    """Share of the time between the samples, (n,)."""
    time: Floats
    """(n,), s."""
    x: Floats
    """(n, 3), m."""
    sense: Floats
    """1 along the normal, −1 against it, (n,)."""


class PlaneFunction(SampledFunction, ContactObserver):
    """Cloud function that finds the particles that cross a plane.

    A passage of a coupled patch is no crossing: the path ends before it and begins anew after it.
    """

    normal: Vector3

    arrays: ClassVar[Mapping[str, Kind]] = {
        **SampledFunction.arrays,
        "x": per_particle,
        "v": per_particle,
        "F": per_particle,
    }

    def __post_init__(self) -> None:
        if not any(self.normal):
            raise InputError("has a normal (0 0 0)")

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return positions, velocities and shapes."""
        p = cloud.particles
        return {"x": p.x[rows], "v": p.v[rows], "F": p.F[rows]}

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Add a sample before each passage, and store the one after it."""
        for before, after in passages(cloud, rows):
            self.add(memory, cloud, before.number, _sample(before))
            store(memory, after.number, _sample(after))


def unit(vector: Vector3) -> Floats:
    """Return the unit vector along a vector, (3,)."""
    return np.array(vector) / math.hypot(*vector)


def _sample(met: Rebounds) -> Memory:
    return {"t": met.t, "x": met.x, "v": met.v, "F": met.F}


def crossings(memory: Memory, now: Memory, rows: Rows, origin: Any, normal: Any) -> Crossings:
    """Find the particles that have changed sides of a plane since the last sample.

    Parameters
    ----------
    memory
        ``x``, ``v`` and ``t`` of all particles at the last sample.
    now, rows
        The same of the particles to be tested now, and their rows.
    origin, normal
        A point of the plane, m, and its unit normal.

    Place and time follow from the cubic through positions and velocities at both samples.
    """
    e = np.asarray(normal)
    heights = [(x - origin) @ e for x in (memory["x"][rows], now["x"])]
    among = (heights[0] < 0.0) != (heights[1] < 0.0)
    at = rows[among]
    h = now["t"][among] - memory["t"][at]
    before, after = memory["x"][at], now["x"][among]
    # Particles without a step have no velocity.
    way = np.where(np.isfinite(memory["v"][at]), h[:, None] * memory["v"][at], after - before)
    ends = [(before, way), (after, h[:, None] * now["v"][among])]
    s = _root(*((x - origin) @ e for x in (ends[0][0], ends[1][0])), *(v @ e for _, v in ends))
    x = _hermite(s[:, None], ends[0][0], ends[1][0], ends[0][1], ends[1][1])
    sense = np.where(heights[1][among] < 0.0, -1.0, 1.0)
    return Crossings(among, at, s, memory["t"][at] + s * h, x, sense)


def _hermite(s: Any, x0: Any, x1: Any, m0: Any, m1: Any) -> Any:
    """Return the value at s of the cubic from x0 with slope m0 at s = 0 to x1 with slope m1 at s = 1."""
    r = 1.0 - s
    return r * r * ((1.0 + 2.0 * s) * x0 + s * m0) + s * s * ((1.0 + 2.0 * r) * x1 - r * m1)


def _root(x0: Floats, x1: Floats, m0: Floats, m1: Floats) -> Floats:
    """Return a root of the cubic of :func:`_hermite` between ends of different sign, by bisection."""
    low, high = np.zeros(len(x0)), np.ones(len(x0))
    for _ in range(53):
        middle = 0.5 * (low + high)
        same = (_hermite(middle, x0, x1, m0, m1) < 0.0) == (x0 < 0.0)
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)
