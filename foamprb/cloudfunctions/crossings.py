"""Place, time and shape at which particles cross a plane."""

from __future__ import annotations

import math
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus
from foamprb.cloud.paths import Steps, cubic, shape_between, step, vector_of, way_at_end, way_at_start
from foamprb.cloud.state import Particles
from foamprb.cloudfunctions.base import Memory, ObservedCloud, PathFunction, per_event
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import Vector3
from foamprb.errors import InputError

__all__ = ["Crossings", "PlaneFunction", "unit"]

Floats = NDArray[np.float64]

_COLUMNS = 15
_HALVINGS = 53


class Crossings(NamedTuple):
    """Crossings of a plane."""

    particles: Particles
    """The particles, with their shapes there."""
    t: Floats
    """Times, (n,), s."""
    x: Floats
    """Places, (n, 3), m."""
    sense: Floats
    """1 along the normal, −1 against it, (n,)."""


class PlaneFunction(PathFunction):
    """Cloud function that observes the particles that cross a plane.

    A passage of a coupled patch is no crossing: the path ends before it and begins anew after it.
    """

    origin: Vector3
    normal: Vector3

    arrays: ClassVar = {**PathFunction.arrays, "crossings": per_event}

    def __post_init__(self) -> None:
        if not any(self.normal):
            raise InputError("has a normal (0 0 0)")

    def initial(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return an empty table: number, time, place, sense, and F."""
        return {"crossings": np.empty((0, _COLUMNS))}

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return frozenset({"v0", "v1", "F0", "F1", "Q0", "A0"})

    def add(
        self,
        memory: Memory,  # noqa: ARG002
        cloud: ObservedCloud,  # noqa: ARG002
        steps: Steps,
        fresh: NDArray[np.bool_],
    ) -> Floats:
        """Return the crossings among the steps."""
        found = np.empty((np.count_nonzero(fresh) + 1, _COLUMNS))
        plane = np.array(self.origin, dtype=float), unit(self.normal)
        n = compiled(_find)(steps.tables, fresh, *plane, int(steps.in_frame), found)
        return found[:n].copy()

    def crossings(self, memory: Memory, cloud: ObservedCloud) -> Crossings:
        """Return all crossings, in the order of time."""
        rows = memory["crossings"]
        p = cloud.cloud.of(rows[:, 0].astype(np.int64))._replace(F=np.ascontiguousarray(rows[:, 6:]))
        return Crossings(p, rows[:, 1], rows[:, 2:5], rows[:, 5])


def unit(vector: Vector3) -> Floats:
    """Return the unit vector along a vector, (3,)."""
    return np.array(vector) / math.hypot(*vector)


def _find(
    tables: Floats, fresh: NDArray[np.bool_], origin: Floats, normal: Floats, in_frame: int, found: Floats
) -> int:
    """Find the fresh steps whose ends lie on different sides of a plane; return their number.

    Place and time follow from the cubic of the step, by bisection.
    """
    o: Vector = (origin[0], origin[1], origin[2])
    n: Vector = (normal[0], normal[1], normal[2])
    m, k = 0, -1
    for table in tables:
        for i in range(table.shape[1]):
            k += 1
            if fresh[k]:
                m += _cross(table, i, o, n, in_frame, found[m])
    return m


def _cross(table: Floats, k: int, o: Vector, n: Vector, in_frame: int, found: Floats) -> int:
    """Return 1 and describe the crossing, if the ends of step k of a table lie on different sides, else 0."""
    x0, x1 = vector_of(table, step.x0, k), vector_of(table, step.x1, k)
    before, after = inner(minus(x0, o), n), inner(minus(x1, o), n)
    if (before < 0.0) == (after < 0.0):
        return 0
    m0, m1 = way_at_start(table, k), way_at_end(table, k)
    slope0, slope1 = inner(m0, n), inner(m1, n)
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if (cubic(middle, before, after, slope0, slope1) < 0.0) == (before < 0.0):
            low = middle
        else:
            high = middle
    s = 0.5 * (low + high)
    found[0], found[1] = table[step.number, k], (1.0 - s) * table[step.t0, k] + s * table[step.t1, k]
    found[5] = 1.0 if before < 0.0 else -1.0
    F = shape_between(table, k, s, in_frame)
    for c in range(3):
        found[2 + c] = cubic(s, x0[c], x1[c], m0[c], m1[c])
    for c in range(9):
        found[6 + c] = F[c]
    return 1
