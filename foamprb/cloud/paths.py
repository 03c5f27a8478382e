"""Records of the steps of particles, from which their paths are observed.

The loop records both ends of accepted steps, and the coupled patches and mirrors between them; no step ends
for it. The records of all lanes are side by side in a table, and the steps of a particle follow each other in
several of them. An :class:`Observation` declares which steps and rows these are. From them follow the steps
that cloud functions get, and the states at given instants (:mod:`foamprb.cloud.instants`).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.quadratic import Third, advanced, rotation, turned, weights
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    add_identity,
    dot,
    from_frame,
    inverse,
    minus,
    scale,
    scale_vector,
)
from foamprb.cloud.block import Recorder, Scratch, at
from foamprb.cloud.contact import rebounds_of
from foamprb.cloud.layout import LANES, Layout, Row, end, offsets, rows_of
from foamprb.cloud.state import Status
from foamprb.compile.link import compiled, separate

Floats = NDArray[np.float64]


class StepRows(NamedTuple):
    """Rows of the table of steps."""

    t0: Annotated[int, Row(1, "s", "time at the start")]
    x0: Annotated[int, Row(3, "m", "position of the barycentre at the start")]
    v0: Annotated[int, Row(3, "m/s", "its velocity there")]
    F0: Annotated[int, Row(9, "1", "deformation gradient at the start")]
    Q0: Annotated[int, Row(9, "1", "particle frame there, axes as rows")]
    l0: Annotated[int, Row(9, "1/s", "∂u_i/∂x_j of the fluid at the start")]
    A0: Annotated[int, Row(9, "1/s", "dF/dt at the start, or the body's velocity gradient in its frame")]
    t1: Annotated[int, Row(1, "s", "time at the end")]
    x1: Annotated[int, Row(3, "m", "position at the end")]
    v1: Annotated[int, Row(3, "m/s", "velocity at the end")]
    F1: Annotated[int, Row(9, "1", "deformation gradient at the end")]
    Q1: Annotated[int, Row(9, "1", "particle frame at the end")]
    l1: Annotated[int, Row(9, "1/s", "∂u_i/∂x_j of the fluid where the step led")]
    host0: Annotated[int, Row(1, "", "host at the start, −1 if it is unknown")]
    host1: Annotated[int, Row(1, "", "host at the end")]
    row: Annotated[int, Row(1, "", "row of the particle in its cloud")]
    number: Annotated[int, Row(1, "", "number of the particle in the whole cloud")]
    status: Annotated[int, Row(1, "", "status after the step")]
    passed: Annotated[
        int, Row(1, "", "1 if a coupled patch is between it and the step before; in the loop, if within it")
    ]
    patch: Annotated[int, Row(1, "", "patch on which the particle ended, or which holds it")]
    met: Annotated[
        int, Row(1, "s", "time at the first mirror or coupled patch; infinite without, −∞ in a bond")
    ]
    met_x: Annotated[int, Row(3, "m", "position there, before it")]
    left: Annotated[int, Row(1, "s", "time at the last of these; −∞ in a bond")]
    left_x: Annotated[int, Row(3, "m", "position there, after it")]
    B0: Annotated[int, Row(7, "1", "quadratic mode at the start; these rows only where it is recorded")]
    growth0: Annotated[int, Row(7, "1/s", "its source there")]
    recovery0: Annotated[int, Row(1, "1/s", "its relaxation 1/τ₃ there")]
    fluid_spin0: Annotated[int, Row(3, "1/s", "angular velocity of the fluid there")]


step = offsets(StepRows, 0)
COLUMNS = end(step)
"""Number of rows; in a loop, those of :attr:`Observation.more` follow."""
_OF_MODE = ("B", "growth", "recovery", "fluid_spin")
MODE = frozenset(f"{name}0" for name in _OF_MODE)
"""Rows of the quadratic mode."""
_ALWAYS = frozenset(("t0", "x0", "t1", "x1"))
_AT_INSTANTS = MODE | {"v0", "F0", "Q0", "A0", "v1", "F1"}
_PASSING = 2
"""Level of the rows that are recorded only of steps that may lead past an instant."""
ROOM = 256
"""Tables in the memory of a loop."""


class Observation(NamedTuple):
    """What is recorded of steps, and the functions to which they are given, in several threads."""

    needs: frozenset[str] = frozenset()
    """Rows of each step, by the names of :class:`StepRows`, beside times and places."""
    watched: NDArray[np.bool_] = np.empty(0, dtype=np.bool_)
    """1 for each particle all of whose steps are recorded, else 0; empty for none."""
    observe: Callable[[Steps], None] | None = None
    """Takes the steps, divided at coupled patches; those of others in a block are recorded, too."""
    times: tuple[float, ...] = ()
    """Instants, s, rising: of the steps past them, all is recorded that :meth:`Steps.between` reads."""
    more: tuple[str, ...] = ()
    """Arrays of particles that are recorded at the ends of these steps."""
    store: Callable[[Steps], None] | None = None
    """Takes the undivided steps."""


class RecordedRows(NamedTuple):
    """Rows of an integrator's block that are recorded."""

    Q: int
    l: int
    A: int
    in_frame: bool
    """Whether ``A`` is the body's velocity gradient in the frame Q, in place of dF/dt."""
    end_l: int = -1
    """−1 if the fluid is not sampled at the end of a step."""
    v: int = at.v
    """The velocity with which steps start: without inertia not always that of the state."""


def recorder_of(observation: Observation, recorded: RecordedRows, layout: Layout, slack: float) -> Recorder:
    """Return empty tables for the steps of a block with this layout; see :class:`Recorder` for ``slack``."""
    more, times = observation.more, observation.times
    if observation.observe is None and not times:
        return Recorder()
    named: dict[str, int] = {}
    loaded: dict[str, range] = {}
    for part in layout.parts:
        for first, (name, row) in zip(part, rows_of(type(part)).items(), strict=True):
            named[name], loaded[row.of] = first, range(first, first + row.components)
    starts = {"t": at.t, "x": at.x, "v": recorded.v, "F": at.F, "Q": recorded.Q, "l": recorded.l}
    starts |= {"A": recorded.A} | {name: named[name] for name in _OF_MODE if "B" in loaded}
    ends = {"t": at.t, "x": at.x, "v": at.v, "F": at.F, "Q": at.frame}
    ends |= {"l": recorded.l if recorded.end_l < 0 else recorded.end_l}
    further = [row for name in more for row in loaded[name]]
    return Recorder(
        tables=np.zeros((ROOM, COLUMNS + len(further), LANES)),
        count=np.zeros(2, dtype=np.int64),
        starts=np.array(_levels(starts, "0", observation)),
        ends=np.array(
            _levels(ends, "1", observation) + [(row, COLUMNS + c, _PASSING) for c, row in enumerate(further)]
        ),
        watched=observation.watched,
        times=np.array(times),
        slack=slack,
    )


def _levels(rows: Mapping[str, int], end: str, observation: Observation) -> list[tuple[int, int, int]]:
    """Return :attr:`Recorder.starts` or ``ends`` of quantities in rows of a block."""
    levels = dict.fromkeys(_AT_INSTANTS if observation.times else (), _PASSING)
    levels |= dict.fromkeys(_ALWAYS | observation.needs, 1)
    return [
        (rows[name[:-1]] + c, getattr(step, name) + c, level)
        for name, level in sorted(levels.items())
        if name[-1] == end and name[:-1] in rows
        for c in range(rows_of(StepRows)[name].components)
    ]


def is_full(s: Scratch) -> bool:
    """Return True if steps are recorded, and there may be no room for the next, and rests before it."""
    room = s.recorder.tables.shape[0]
    return bool(room > 0 and s.recorder.count[0] + LANES >= room)


@separate
def record_starts(s: Scratch) -> None:
    """Record the starts of the steps of all lanes; no-op without a table."""
    if s.recorder.tables.shape[0] > 0:
        begin_record(s, level_of(s))


def level_of(s: Scratch) -> int:
    """Return 2 if a lane may step past an instant, 1 if there is a particle that is watched, else 0."""
    c, level = s.recorder, 0
    for i in range(LANES):
        t = s.block[at.t * LANES + i]
        if s.block[at.moving * LANES + i] > 0.0 and is_due(s, t, t + s.block[at.dt * LANES + i] + c.slack):
            return _PASSING
        if len(c.watched) > 0 and s.member[i] >= 0 and c.watched[s.member[i]]:
            level = 1
    return level


def is_due(s: Scratch, begin: float, end: float) -> bool:
    """Return True if an instant is after one time and not after another, s."""
    due = 0
    for time in s.recorder.times:
        due += begin < time <= end
    return due > 0


def begin_record(s: Scratch, level: int) -> None:
    """Record the starts of steps of all lanes in the rows up to a level; none at 0."""
    s.recorder.count[1] = level
    if level == 0:
        return
    steps = s.recorder.tables[s.recorder.count[0]]
    copy_rows(s, s.recorder.starts, steps)
    for i in range(LANES):
        steps[step.host0, i], steps[step.passed, i], steps[step.met, i] = s.host[i], 0.0, math.inf


def note_passage(s: Scratch, i: int, coupled: bool, t: float, x: Vector, y: Vector) -> None:
    """Note at which time, s, the step of lane i comes to a patch at x and goes on from y."""
    c = s.recorder
    if c.count[1] == 0:
        return
    steps = c.tables[c.count[0]]
    if coupled:
        steps[step.passed, i] = 1.0
    if steps[step.met, i] == math.inf:
        steps[step.met, i] = t
        steps[step.met_x, i], steps[step.met_x + 1, i], steps[step.met_x + 2, i] = x[0], x[1], x[2]
    steps[step.left, i] = t
    steps[step.left_x, i], steps[step.left_x + 1, i], steps[step.left_x + 2, i] = y[0], y[1], y[2]


@separate
def record_ends(s: Scratch) -> None:
    """Record the ends of the steps whose starts are recorded; those of lanes at rest take no time."""
    c = s.recorder
    if c.count[1] == 0:
        return
    steps = c.tables[c.count[0]]
    copy_rows(s, c.ends, steps)
    for i in range(LANES):
        steps[step.host1, i] = s.host[i]
        steps[step.row, i], steps[step.number, i] = s.member[i], s.number[i]
        steps[step.status, i], steps[step.patch, i] = s.status[i], s.patch[i]
    c.count[0] += 1
    c.count[1] = 0


def record_rest(s: Scratch, i: int, until: float) -> None:
    """Record that a bond has held lane i up to a time, s, if an instant was meanwhile."""
    if not is_due(s, s.block[at.t * LANES + i], until):
        return
    begin_record(s, _PASSING)
    record_ends(s)
    steps = s.recorder.tables[s.recorder.count[0] - 1]
    steps[step.t1, i], steps[step.met, i], steps[step.left, i] = until, -math.inf, -math.inf


def copy_rows(s: Scratch, rows: NDArray[np.int64], steps: Floats) -> None:
    """Copy rows of the block to rows of a table, up to the level of the present record."""
    for n in range(rows.shape[0]):
        if rows[n, 2] <= s.recorder.count[1]:
            first, row = rows[n, 0] * LANES, rows[n, 1]
            for i in range(LANES):
                steps[row, i] = s.block[first + i]


def vector_of(table: Floats, first: int, k: int) -> Vector:
    """Return the vector in three rows of a table, column k."""
    return table[first, k], table[first + 1, k], table[first + 2, k]


def tensor_of(table: Floats, first: int, k: int) -> Tensor:
    """Return the tensor in nine rows of a table, column k."""
    return (
        table[first, k], table[first + 1, k], table[first + 2, k],
        table[first + 3, k], table[first + 4, k], table[first + 5, k],
        table[first + 6, k], table[first + 7, k], table[first + 8, k],
    )  # fmt: skip


def third_of(table: Floats, first: int, k: int) -> Third:
    """Return the symmetric, traceless tensor of third order in seven rows of a table, column k."""
    return (
        table[first, k], table[first + 1, k], table[first + 2, k], table[first + 3, k],
        table[first + 4, k], table[first + 5, k], table[first + 6, k],
    )  # fmt: skip


class Steps(NamedTuple):
    """Steps of particles, in the order in which each took them, and others that take no time."""

    tables: Floats
    """One table after the other, each with the rows of :class:`StepRows`, (m, :data:`COLUMNS`, k)."""
    in_frame: bool
    """See :class:`RecordedRows`."""

    @property
    def n(self) -> int:
        """Number of steps."""
        return int(self.tables.shape[0] * self.tables.shape[2])

    def of(self, row: int) -> Floats:
        """Return a row of the tables, (n,)."""
        return self.tables[:, row].reshape(-1)

    @property
    def row(self) -> NDArray[np.int64]:
        """Rows of the particles, (n,)."""
        return self.of(step.row).astype(np.int64)

    @property
    def number(self) -> NDArray[np.int64]:
        """Numbers of the particles in the whole cloud, (n,)."""
        return self.of(step.number).astype(np.int64)

    @property
    def ended(self) -> NDArray[np.bool_]:
        """Whether the particle did not move any more after the step, (n,)."""
        return np.asarray(self.of(step.status) != Status.ACTIVE)

    @property
    def t(self) -> tuple[Floats, Floats]:
        """Times at start and end, (n,), s."""
        return self.of(step.t0), self.of(step.t1)

    @property
    def x(self) -> tuple[Floats, Floats]:
        """Positions at start and end, (n, 3), m."""
        return self.both("x")

    @property
    def hosts(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Hosts at start and end, (n,), −1 where unknown."""
        return self.of(step.host0).astype(np.int64), self.of(step.host1).astype(np.int64)

    def both(self, name: str) -> tuple[Floats, Floats]:
        """Return a quantity with several components at start and end, (n, k)."""
        k = 3 if name in ("x", "v") else 9
        first, last = (self.rows(getattr(step, f"{name}{end}"), k) for end in (0, 1))
        return first, last

    def rows(self, first: int, k: int) -> Floats:
        """Return k rows of the tables, (n, k)."""
        return np.moveaxis(self.tables[:, first : first + k], 1, 2).reshape(-1, k)

    def take(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Steps:
        """Return some of the steps, in a single table."""
        rows = np.flatnonzero(which) if which.dtype == np.bool_ else which
        taken = np.empty((1, self.tables.shape[1], len(rows)))
        compiled(_take)(self.tables, rows, taken[0])
        return self._replace(tables=taken)

    def divided(self, rebounds: Floats, coupled: Sequence[int]) -> Steps:
        """Return the steps, those through coupled patches divided there; rests take no time.

        ``rebounds`` are all of :func:`foamprb.cloud.contact.record_contact` in these steps, (m, 21).
        """
        t1, rests = self.tables[:, step.t1], self.tables[:, step.met] == -np.inf
        t1[rests] = self.tables[:, step.t0][rests]
        if not self.tables[:, step.passed].any():
            return self
        moved = self.take(self.t[1] > self.t[0])
        table, first, pieces = moved.tables[0], 0, []
        for k in np.flatnonzero(table[step.passed]).tolist():
            pieces += [table[:, first:k], _divided(table[:, k], self.in_frame, rebounds, coupled)]
            first = k + 1
        return self._replace(tables=np.concatenate([*pieces, table[:, first:]], axis=1)[None])

    @property
    def rate(self) -> Floats:
        """Material velocity gradients dF/dt at the start of the steps of a single table, (n, 9), 1/s."""
        rate = np.empty((self.n, 9))
        compiled(_rates)(self.tables[0], int(self.in_frame), rate)
        return rate

    def between(self, share: Floats, which: NDArray[np.int64] | None = None) -> tuple[Floats, Floats, Floats]:
        """Return where and what particles are after a share (n,) of each step, or of those at some indices.

        Returns
        -------
        x, v, F
            Positions on Hermite's cubic, (n, 3), m; velocities linear between both ends, (n, 3), m/s;
            deformation gradients by :func:`shape_between`, (n, 9).
        """
        which = np.arange(self.n) if which is None else which
        x, v, F = (np.empty((len(which), k)) for k in (3, 3, 9))
        compiled(_between)(self.tables, which, share, int(self.in_frame), x, v, F)
        return x, v, F

    def passing(self, times: Floats) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Return the indices of the steps of particles past instants, s, and those of the instants."""
        found = np.empty((2, self.n * len(times)), dtype=np.int64)
        which, instant = found[:, : compiled(_passing)(self.tables, times, found)]
        return which, instant

    def mode_between(self, share: Floats) -> Floats:
        """Return the quadratic mode after a share (n,) of each step of a single table, (n, 7).

        It is exact for a flow that does not change in the step, as is the drift in it.
        """
        B = np.empty((self.n, 7))
        compiled(_modes)(self.tables[0], share, B)
        return B


def _take(tables: Floats, rows: NDArray[np.int64], taken: Floats) -> None:
    lanes = tables.shape[2]
    for n in range(len(rows)):
        m, k = rows[n] // lanes, rows[n] % lanes
        for c in range(tables.shape[1]):
            taken[c, n] = tables[m, c, k]


def _modes(table: Floats, share: Floats, modes: Floats) -> None:
    for k in range(table.shape[1]):
        B = mode_after(table, k, share[k] * (table[step.t1, k] - table[step.t0, k]))
        for c in range(7):
            modes[k, c] = B[c]


def mode_after(table: Floats, k: int, h: float) -> Third:
    """Return the quadratic mode after the time h, s, of step k."""
    growth, rate = third_of(table, step.growth0, k), table[step.recovery0, k]
    turn = rotation(vector_of(table, step.fluid_spin0, k), h)
    return advanced(third_of(table, step.B0, k), growth, growth, weights(rate, h), turn)


def _rates(table: Floats, in_frame: int, rate: Floats) -> None:
    for k in range(table.shape[1]):
        A = rate_at_start(table, k, in_frame)
        for c in range(9):
            rate[k, c] = A[c]


def _passing(tables: Floats, times: Floats, found: NDArray[np.int64]) -> int:
    n, lanes = 0, tables.shape[2]
    for m in range(tables.shape[0]):
        for k in range(lanes):
            if tables[m, step.row, k] < 0.0:
                continue
            for w in range(len(times)):
                if tables[m, step.t0, k] < times[w] <= tables[m, step.t1, k]:
                    found[0, n], found[1, n] = m * lanes + k, w
                    n += 1
    return n


def _between(
    tables: Floats, which: NDArray[np.int64], share: Floats, in_frame: int, x: Floats, v: Floats, F: Floats
) -> None:
    for n in range(len(which)):
        table, k, s = tables[which[n] // tables.shape[2]], which[n] % tables.shape[2], share[n]
        m0, m1 = way_at_start(table, k), way_at_end(table, k)
        G = shape_between(table, k, s, in_frame)
        for c in range(3):
            x[n, c] = cubic(s, table[step.x0 + c, k], table[step.x1 + c, k], m0[c], m1[c])
            v0, v1 = table[step.v0 + c, k], table[step.v1 + c, k]
            v[n, c] = v1 if math.isnan(v0) else (1.0 - s) * v0 + s * v1
        for c in range(9):
            F[n, c] = G[c]


def way_at_start(table: Floats, k: int) -> Vector:
    """Return the way in the time of step k at the velocity of its start, m."""
    v = vector_of(table, step.v0, k)
    if math.isnan(v[0]):
        # Without a velocity at its release, a particle has that of its way.
        return minus(vector_of(table, step.x1, k), vector_of(table, step.x0, k))
    return scale_vector(table[step.t1, k] - table[step.t0, k], v)


def way_at_end(table: Floats, k: int) -> Vector:
    """Return the way in the time of step k at the velocity of its end, m."""
    return scale_vector(table[step.t1, k] - table[step.t0, k], vector_of(table, step.v1, k))


def rate_at_start(table: Floats, k: int, in_frame: int) -> Tensor:
    """Return dF/dt at the start of step k, 1/s; for ``in_frame`` see :class:`RecordedRows`."""
    A = tensor_of(table, step.A0, k)
    if in_frame == 0:
        return A
    return dot(from_frame(tensor_of(table, step.Q0, k), A), tensor_of(table, step.F0, k))


def shape_between(table: Floats, k: int, s: float, in_frame: int) -> Tensor:
    """Return the deformation gradient after the share s of step k.

    F = cay(s c + s² d)·F₀ with cay(Ω) = (1 − Ω/2)⁻¹·(1 + Ω/2) has F₀ and dF/dt at the start, and F₁.
    """
    F0 = tensor_of(table, step.F0, k)
    rest = inverse(F0)
    change = dot(tensor_of(table, step.F1, k), rest)
    whole = dot(add_identity(change, -1.0), inverse(scale(0.5, add_identity(change, 1.0))))
    h = table[step.t1, k] - table[step.t0, k]
    c = scale(h, dot(rate_at_start(table, k, in_frame), rest))
    half = scale(0.5 * s, add(scale(1.0 - s, c), scale(s, whole)))
    return dot(dot(inverse(add_identity(scale(-1.0, half), 1.0)), add_identity(half, 1.0)), F0)


def cubic(s: Any, x0: Any, x1: Any, m0: Any, m1: Any) -> Any:
    """Return the value at s of the cubic from x0 with slope m0 at s = 0 to x1 with slope m1 at s = 1."""
    r = 1.0 - s
    return r * r * ((1.0 + 2.0 * s) * x0 + s * m0) + s * s * ((1.0 + 2.0 * r) * x1 - r * m1)


def _divided(record: Floats, in_frame: bool, rebounds: Floats, coupled: Sequence[int]) -> Floats:
    """Return the parts of a step between its passages of coupled patches, (:data:`COLUMNS`, k)."""
    during = (rebounds[:, 0] == record[step.number]) & np.isin(rebounds[:, 1], coupled)
    during &= (rebounds[:, 2] >= record[step.t0]) & (rebounds[:, 2] <= record[step.t1])
    parts: list[Floats] = []
    rest, states = record.copy(), rebounds_of(rebounds[during])
    for before in range(0, len(states.t), 2):
        after = before + 1
        turn = states.F[after].reshape(3, 3) @ np.linalg.inv(states.F[before].reshape(3, 3))
        part, Q0, Q1 = rest.copy(), rest[step.Q0 : step.Q0 + 9], rest[step.Q1 : step.Q1 + 9]
        l0, l1 = rest[step.l0 : step.l0 + 9], rest[step.l1 : step.l1 + 9]
        # A part of no duration has the least: observers see it, too.
        t = max(states.t[before], np.nextafter(rest[step.t0], np.inf))
        _put(part, t1=t, **{f"{name}1": getattr(states, name)[before] for name in "xvF"}, l1=l0)
        _put(part, Q1=Q1.reshape(3, 3) @ turn, host1=-1, status=Status.ACTIVE, passed=len(parts) > 0)
        parts.append(part)
        _put(rest, **{f"{name}0": getattr(states, name)[after] for name in "xvF"}, l0=l1, host0=-1)
        _put(rest, t0=max(states.t[after], t))
        _put(rest, Q0=Q0.reshape(3, 3) @ turn.T, **_turned_mode(part[:, None], turn))
        if not in_frame:
            _put(rest, A0=turn @ rest[step.A0 : step.A0 + 9].reshape(3, 3))
    rest[step.t1] = max(rest[step.t1], np.nextafter(rest[step.t0], np.inf))
    return np.stack([*parts, rest], axis=1)


def _put(record: Floats, **values: Any) -> None:
    """Store quantities in their rows of a record."""
    for name, value in values.items():
        first = getattr(step, name)
        record[first : first + np.size(value)] = np.ravel(value)


def _turned_mode(part: Floats, turn: Floats) -> dict[str, Any]:
    """Return the quadratic mode after a step, turned by a rotation, from a table of this step, (n, 1)."""
    flat: Any = tuple(turn.ravel())
    B = mode_after(part, 0, part[step.t1, 0] - part[step.t0, 0])
    growth, spin = third_of(part, step.growth0, 0), vector_of(part, step.fluid_spin0, 0)
    return {"B0": turned(B, flat), "growth0": turned(growth, flat), "fluid_spin0": turn @ spin}
