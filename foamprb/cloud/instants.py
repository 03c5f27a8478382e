"""State of particles at given instants, for which no step ends.

Where a step of a particle leads past an instant, the loop stores the state there: the place on Hermite's
cubic through both ends of the step, and the deformation gradient of
:func:`foamprb.cloud.paths.shape_between`. Paths do not depend on the instants.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.quadratic import Third
from foamprb.body.tensor import Tensor, Vector, add, minus, plus_scaled, scale
from foamprb.cloud.block import Instants, Scratch, at, load3, load9
from foamprb.cloud.layout import LANES, Layout, rows_of
from foamprb.cloud.paths import (
    COLUMNS,
    MODE,
    RecordedRows,
    copy_rows,
    cubic,
    mode_after,
    rate_at_start,
    shape_between,
    step,
    tensor_of,
    vector_of,
    way_at_end,
    way_at_start,
)
from foamprb.cloud.state import VARIABLES, Particles, Status
from foamprb.compile.link import separate
from foamprb.flow.kernels import linked_with, recover, walk

Floats = NDArray[np.float64]

STATE, MARKS = "instants/state", "instants/marks"
"""Names of the arrays per particle, among those of cloud functions: the states, (n, w, k); the statuses, 0
where none is stored, and patches, (n, w, 2)."""
_ALWAYS = ("x", "v", "F")
_AT_ENDS = ("F0", "heading", "eddy")
"""Arrays that measures read beside these, and that change at walls or by random numbers only: stored is their
value at the end of the step."""
_DIFFERENCE = 1e-4
"""Share of a step, for the rate of the deformation gradient by differences."""
_ROUND_OFF = 1e-12
"""Of times, over their values."""
ACTIVE, STUCK = int(Status.ACTIVE), int(Status.STUCK)


class Moments(NamedTuple):
    """Instants of some steps, and the arrays of particles that are stored there beside place and shape."""

    times: tuple[float, ...] = ()
    """s, rising, before the end of the last step."""
    more: tuple[str, ...] = ()

    def layout(self) -> Mapping[str, NDArray[Any]]:
        """Return the arrays that hold the states, without particles."""
        w, k = len(self.times), _width(columns_of_state(self.more))
        return {STATE: np.empty((0, w, k)), MARKS: np.empty((0, w, 2), dtype=np.int32)}


def moments_of(times: Sequence[float], changing: Collection[str], with_rates: bool) -> Moments:
    """Return instants with the arrays that steps change and that measures read.

    Parameters
    ----------
    times
        s, rising.
    changing
        Names of the arrays that steps change.
    with_rates
        Whether dF/dt is read.
    """
    more = ("A",) if with_rates else ()
    return Moments(tuple(times), (*more, *(name for name in ("B", *_AT_ENDS) if name in changing)))


def columns_of_state(more: Collection[str]) -> dict[str, slice]:
    """Return the columns of a stored state by the names of arrays of particles."""
    columns: dict[str, slice] = {}
    for name in (*_ALWAYS, *more):
        first, size = _width(columns), int(np.prod(VARIABLES[name].shape, dtype=int))
        columns[name] = slice(first, first + size)
    return columns


def _width(columns: Mapping[str, slice]) -> int:
    return max((part.stop for part in columns.values()), default=0)


def instants_of(
    moments: Moments,
    arrays: Mapping[str, NDArray[Any]],
    recorded: RecordedRows,
    layout: Layout,
    mode: Mapping[str, int],
    slack: float,
) -> Instants:
    """Return the instants as an argument of a loop.

    Parameters
    ----------
    arrays
        See :meth:`Moments.layout`, with a row for each particle.
    recorded, layout
        Rows that are recorded of each step, and layout of the block.
    mode
        Rows of the quadratic mode in the block; empty without it.
    slack
        Time by which a step may be longer than intended, s.
    """
    columns = columns_of_state(moments.more)
    needs = MODE | {"v0", "F0", "Q0", "A0", "v1", "F1"}
    rows = {
        row.of: first
        for part in layout.parts
        for first, (_, row) in zip(part, rows_of(type(part)).items(), strict=True)
        if row.of
    }
    pairs = [
        (rows[name] + c, columns[name].start + c)
        for name in moments.more
        if name != "A"
        for c in range(columns[name].stop - columns[name].start)
    ]
    return Instants(
        times=np.array(moments.times),
        state=arrays[STATE],
        marks=arrays[MARKS],
        table=np.empty((COLUMNS, LANES)),
        begun=np.zeros(1, dtype=np.int64),
        crossed=np.zeros((LANES, 8)),
        starts=recorded.starts(needs, mode),
        ends=recorded.ends(needs),
        more=np.array(pairs, dtype=np.int64).reshape(-1, 2),
        slack=slack,
        in_frame=int(recorded.in_frame),
        rate=columns["A"].start if "A" in columns else -1,
        mode=columns["B"].start if "B" in columns else -1,
    )


@separate
def record_before(s: Scratch) -> None:
    """Record the starts of the steps of all lanes if one may lead past an instant."""
    c = s.instants
    if len(c.times) == 0:
        return
    c.begun[0] = 0
    for i in range(LANES):
        if s.block[at.moving * LANES + i] > 0.0:
            t = s.block[at.t * LANES + i]
            end = t + s.block[at.dt * LANES + i] + c.slack
            for time in c.times:
                if t < time <= end:
                    c.begun[0] = 1
    if c.begun[0]:
        copy_rows(s, c.starts, c.table)
        for i in range(LANES):
            c.crossed[i, 0] = math.inf


@separate
def capture(s: Scratch) -> None:
    """Store the states at the instants within the steps of all lanes, see :func:`record_before`."""
    c = s.instants
    if c.begun[0] == 0:
        return
    copy_rows(s, c.ends, c.table)
    for i in range(LANES):
        t0, t1, k = c.table[step.t0, i], c.table[step.t1, i], s.member[i]
        if k >= 0 and t1 > t0:
            for w in range(len(c.times)):
                time = c.times[w]
                if t0 < time <= t1:
                    x, v, F, A = state_within(c, i, time)
                    sticks = time == t1 and s.status[i] == STUCK
                    store(s, i, w, x, v, F, A, STUCK if sticks else ACTIVE)
                    if c.mode >= 0:
                        store_mode(c, k, w, mode_after(c.table, i, time - t0))


def capture_at_rest(s: Scratch, i: int, until: float) -> None:
    """Store the state of lane i, which sticks to a wall, at the instants since then until a time, s."""
    c, since = s.instants, s.block[at.t * LANES + i]
    for w in range(len(c.times)):
        if since < c.times[w] < until:
            block = s.block
            F, A = load9(block, at.F, i), load9(block, at.A, i)
            store(s, i, w, load3(block, at.x, i), load3(block, at.v, i), F, A, STUCK)


def state_within(c: Instants, i: int, time: float) -> tuple[Vector, Vector, Tensor, Tensor]:
    """Return place, velocity, deformation gradient and its rate at a time, s, in the step of lane i.

    The places of a step through coupled patches or into mirrors lie on the lines to the first of them, and
    from the last.
    """
    table = c.table
    t0, t1 = table[step.t0, i], table[step.t1, i]
    x0, x1 = vector_of(table, step.x0, i), vector_of(table, step.x1, i)
    m0, m1 = way_at_start(table, i), way_at_end(table, i)
    v0, v1 = vector_of(table, step.v0, i), vector_of(table, step.v1, i)
    first, last = c.crossed[i, 0], c.crossed[i, 1]
    if first < math.inf:
        A = rate_at_start(table, i, c.in_frame)
        if time < first:
            y = c.crossed[i, 2], c.crossed[i, 3], c.crossed[i, 4]
            x = plus_scaled(x0, (time - t0) / (first - t0), minus(y, x0))
            return x, v0, tensor_of(table, step.F0, i), A
        # Between two passages the particle stays where it comes to after the last.
        remaining = min(1.0, (t1 - time) / (t1 - last)) if last < t1 else 0.0
        y = c.crossed[i, 5], c.crossed[i, 6], c.crossed[i, 7]
        x = plus_scaled(x1, remaining, minus(y, x1))
        return x, v1, tensor_of(table, step.F1, i), A
    share = (time - t0) / (t1 - t0)
    x = (
        cubic(share, x0[0], x1[0], m0[0], m1[0]),
        cubic(share, x0[1], x1[1], m0[1], m1[1]),
        cubic(share, x0[2], x1[2], m0[2], m1[2]),
    )
    v = v1 if math.isnan(v0[0]) else plus_scaled(v0, share, minus(v1, v0))
    F = shape_between(table, i, share, c.in_frame)
    if c.rate < 0:
        return x, v, F, F
    h = table[step.t1, i] - table[step.t0, i]
    before = shape_between(table, i, share - _DIFFERENCE, c.in_frame)
    after = shape_between(table, i, share + _DIFFERENCE, c.in_frame)
    return x, v, F, scale(0.5 / (_DIFFERENCE * h), add(after, scale(-1.0, before)))


def store(s: Scratch, i: int, w: int, x: Vector, v: Vector, F: Tensor, A: Tensor, status: int) -> None:
    """Store a state of the particle in lane i at instant w."""
    c, k = s.instants, s.member[i]
    state = c.state[k, w]
    for j in range(3):
        state[j], state[3 + j] = x[j], v[j]
    for j in range(9):
        state[6 + j] = F[j]
        if c.rate >= 0:
            state[c.rate + j] = A[j]
    for n in range(c.more.shape[0]):
        state[c.more[n, 1]] = s.block[c.more[n, 0] * LANES + i]
    c.marks[k, w, 0] = status
    c.marks[k, w, 1] = s.patch[i] if status == STUCK else -1


def store_mode(c: Instants, k: int, w: int, B: Third) -> None:
    """Store the quadratic mode of particle k at instant w."""
    for j in range(7):
        c.state[k, w, c.mode + j] = B[j]


def state_at(p: Particles, arrays: Mapping[str, NDArray[Any]], w: int, moments: Moments) -> Particles:
    """Return particles at an instant; the others have the state in which they ended, or are not released.

    Parameters
    ----------
    p
        Particles after the steps with the instant.
    arrays
        See :meth:`Moments.layout`, for these particles.
    w
        Number of the instant.
    """
    time, (stored, status) = moments.times[w], status_at(p, arrays, w, moments)
    values: dict[str, NDArray[Any]] = {}
    for name, columns in columns_of_state(moments.more).items():
        mask = stored.reshape(-1, *(1 for _ in VARIABLES[name].shape))
        values[name] = np.where(mask, arrays[STATE][:, w, columns], getattr(p, name))
    # Those that a changed writeInterval finds beyond the instant go back along their velocity.
    beyond = ~stored & (p.status == Status.ACTIVE) & (p.t > time) & (p.t0 < time)
    values["x"][beyond] -= p.v[beyond] * (p.t[beyond] - time)[:, None]
    return p._replace(
        **values,
        t=np.where(stored | beyond, time, p.t),
        status=status.astype(p.status.dtype),
        reason=np.where(stored, 0, p.reason).astype(p.reason.dtype),
        patch=np.where(stored, arrays[MARKS][:, w, 1], p.patch).astype(p.patch.dtype),
    )


def status_at(
    p: Particles, arrays: Mapping[str, NDArray[Any]], w: int, moments: Moments
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return which particles moved past an instant, (n,), and the status of all then.

    The arguments are those of :func:`state_at`.
    """
    time, status = moments.times[w], arrays[MARKS][:, w, 0]
    # A particle that appears there does not count yet.
    released = p.t0 < time - _ROUND_OFF * abs(time)
    # Those whose steps have ended there have come to that state.
    stored = released & (status > 0) & (p.t > time)
    return stored, np.where(stored, status, np.where(released, p.status, Status.PENDING))


def hosts_at(kernels: Mapping[str, Any], flow: Any, p: Particles, x: Floats) -> NDArray[np.int64]:
    """Return the hosts of points near particles, (n,); −1 outside the mesh.

    They are at the ends of straight ways from the particles, or found by the tree.

    Parameters
    ----------
    kernels, flow
        Functions of the flow, and their arguments.
    p
        The particles in their hosts.
    x
        The points, (n, 3), m.
    """
    hosts = np.empty(p.size, dtype=np.int64)
    walk_all, packed_flow = linked_with(kernels, flow, _walk_all)
    walk_all(packed_flow, p.host, p.x, p.t, x, hosts)
    return hosts


def _walk_all(
    flow: Any, hosts: NDArray[np.int64], x0: Floats, t: Floats, x1: Floats, reached: NDArray[np.int64]
) -> None:
    for k in range(len(hosts)):
        start, goal = (x0[k, 0], x0[k, 1], x0[k, 2]), (x1[k, 0], x1[k, 1], x1[k, 2])
        if hosts[k] < 0 or start == goal:
            reached[k] = hosts[k]
        else:
            host, _, patch, _ = walk(flow, hosts[k], start, t[k], goal, t[k])
            reached[k] = host if patch == -1 else recover(flow, goal, t[k])
