"""Place, time and shape at which particles cross a plane."""

from __future__ import annotations

import math
from typing import ClassVar, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus
from foamprb.cloud.paths import MODE, Steps, cubic, step, vector_of, way_at_end, way_at_start
from foamprb.cloud.state import Particles
from foamprb.cloudfunctions.base import Memory, ObservedCloud, PathFunction, per_event
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import Vector3
from foamprb.errors import InputError

Floats = NDArray[np.float64]

_COLUMNS, _OF_MODE = 15, 10
_HALVINGS = 53


class Crossings(NamedTuple):
    """Crossings of a plane."""

    particles: Particles
    """The particles, with their shapes there; with a quadratic mode also its B and their velocities."""
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

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return an empty table: number, time, place, sense, F, and with a quadratic mode B and velocity."""
        more = _OF_MODE if cloud.cloud.models.has_quadratic else 0
        return {"crossings": np.empty((0, _COLUMNS + more))}

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return MODE | {"v0", "v1", "F0", "F1", "Q0", "A0"}

    def add(
        self,
        memory: Memory,
        cloud: ObservedCloud,  # noqa: ARG002
        steps: Steps,
        fresh: NDArray[np.bool_],
    ) -> Floats:
        """Return the crossings among the steps."""
        places = np.empty((np.count_nonzero(fresh) + 1, 3))
        n = compiled(_find)(
            steps.tables, fresh, np.array(self.origin, dtype=float), unit(self.normal), places
        )
        index, share, sense = places[:n].T.copy()
        crossing = steps.take(index.astype(np.intp))
        (x, v, F), (t0, t1) = crossing.between(share), crossing.t
        columns = [crossing.number, (1.0 - share) * t0 + share * t1, x, sense, F]
        more = self.more(crossing, share)
        if memory["crossings"].shape[1] - sum(array.shape[1] for array in more) > _COLUMNS:
            columns += [crossing.mode_between(share), v]
        return np.column_stack([*columns, *more])

    def more(self, crossing: Steps, share: Floats) -> list[Floats]:  # noqa: ARG002
        """Return further columns of the crossings after a share, (n,), of their steps; by default none."""
        return []

    def crossings(self, memory: Memory, cloud: ObservedCloud) -> Crossings:
        """Return all crossings, in the order of time."""
        rows = memory["crossings"]
        # The frames that particles have now would change last digits.
        Q = np.tile(np.eye(3).ravel(), (len(rows), 1))
        p = cloud.cloud.of(rows[:, 0].astype(np.int64))._replace(F=rows[:, 6:_COLUMNS].copy(), Q=Q)
        if rows.shape[1] > _COLUMNS:
            p = p._replace(B=rows[:, _COLUMNS : _COLUMNS + 7].copy(), v=rows[:, _COLUMNS + 7 :].copy())
        return Crossings(p, rows[:, 1], rows[:, 2:5], rows[:, 5])


def unit(vector: Vector3) -> Floats:
    """Return the unit vector along a vector, (3,)."""
    return np.array(vector) / math.hypot(*vector)


def _find(tables: Floats, fresh: NDArray[np.bool_], origin: Floats, normal: Floats, places: Floats) -> int:
    """Find the fresh steps whose ends lie on different sides of a plane; return their number.

    ``places`` (n, 3) receives the index of each, the share of it before the crossing, and the sense.
    """
    o: Vector = (origin[0], origin[1], origin[2])
    n: Vector = (normal[0], normal[1], normal[2])
    m, k = 0, -1
    for table in tables:
        for i in range(table.shape[1]):
            k += 1
            if fresh[k]:
                m += _cross(table, i, o, n, k, places[m])
    return m


def _cross(table: Floats, i: int, o: Vector, n: Vector, k: int, place: Floats) -> int:
    """Return 1 and describe the crossing, if the ends of step i of a table lie on different sides, else 0.

    ``k`` is the index of the step in all tables.
    """
    before = inner(minus(vector_of(table, step.x0, i), o), n)
    after = inner(minus(vector_of(table, step.x1, i), o), n)
    if (before < 0.0) == (after < 0.0):
        return 0
    slope0, slope1 = inner(way_at_start(table, i), n), inner(way_at_end(table, i), n)
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if (cubic(middle, before, after, slope0, slope1) < 0.0) == (before < 0.0):
            low = middle
        else:
            high = middle
    place[0], place[1], place[2] = k, 0.5 * (low + high), 1.0 if before < 0.0 else -1.0
    return 1
