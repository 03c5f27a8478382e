"""Records of the steps of particles, from which their paths are observed.

The loop records both ends of each accepted step; no step ends for it. The records of all lanes are side by
side in a table, and the steps of a particle follow each other in several of them.
"""

from __future__ import annotations

import math
from collections.abc import Collection, Mapping, Sequence
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
from foamprb.cloud.block import Scratch, at
from foamprb.cloud.contact import passages
from foamprb.cloud.layout import LANES, Row, end, offsets, rows_of
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
    B0: Annotated[int, Row(7, "1", "quadratic mode at the start; these rows only where it is recorded")]
    growth0: Annotated[int, Row(7, "1/s", "its source there")]
    recovery0: Annotated[int, Row(1, "1/s", "its relaxation 1/τ₃ there")]
    fluid_spin0: Annotated[int, Row(3, "1/s", "angular velocity of the fluid there")]


step = offsets(StepRows, 0)
COLUMNS = end(step)
MODE = frozenset(("B0", "growth0", "recovery0", "fluid_spin0"))
"""Rows of the quadratic mode."""
COLUMNS_OF_ELLIPSOIDS = step.B0
"""Number of rows before these."""
ALWAYS = frozenset(("t0", "x0", "t1", "x1"))
"""Rows that are recorded of every step; others of the block where a function needs them."""
ROOM = 256
"""Tables in the memory of a loop."""


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

    def starts(self, needs: Collection[str], mode: Mapping[str, int]) -> NDArray[np.int64]:
        """Return the rows that are recorded before a step is accepted, and those of the table, (k, 2).

        Parameters
        ----------
        needs
            Names of :class:`StepRows` beside :data:`ALWAYS`.
        mode
            Rows of the quadratic mode in the block; empty without it.
        """
        rows = {"t": at.t, "x": at.x, "v": self.v, "F": at.F, "Q": self.Q, "l": self.l, "A": self.A, **mode}
        return _pairs({f"{name}0": row for name, row in rows.items()}, needs)

    def ends(self, needs: Collection[str]) -> NDArray[np.int64]:
        """Return the same after it."""
        l = self.l if self.end_l < 0 else self.end_l
        rows = {"t": at.t, "x": at.x, "v": at.v, "F": at.F, "Q": at.frame, "l": l}
        return _pairs({f"{name}1": row for name, row in rows.items()}, needs)


def _pairs(rows: Mapping[str, int], needs: Collection[str]) -> NDArray[np.int64]:
    sizes = rows_of(StepRows)
    return np.array(
        [
            (first + c, getattr(step, name) + c)
            for name, first in rows.items()
            if name in ALWAYS or name in needs
            for c in range(sizes[name].components)
        ]
    )


def is_full(s: Scratch) -> bool:
    """Return True if steps are recorded, and there is no room for the next."""
    room = s.paths.shape[0]
    return bool(room > 0 and s.recorded[0] == room)


@separate
def record_starts(s: Scratch) -> None:
    """Record the starts of the steps of all lanes; no-op without a table."""
    if s.paths.shape[0] == 0:
        return
    steps = s.paths[s.recorded[0]]
    copy_rows(s, s.starts, steps)
    for i in range(LANES):
        s.passed[i] = 0
        steps[step.host0, i] = s.host[i]


@separate
def record_ends(s: Scratch) -> None:
    """Record the ends of the same steps; those of lanes that have not moved take no time."""
    if s.paths.shape[0] == 0 or not has_watched(s):
        return
    steps = s.paths[s.recorded[0]]
    copy_rows(s, s.ends, steps)
    for i in range(LANES):
        steps[step.host1, i] = s.host[i]
        steps[step.row, i], steps[step.number, i] = s.member[i], s.number[i]
        steps[step.status, i], steps[step.passed, i] = s.status[i], s.passed[i]
    s.recorded[0] += 1


def copy_rows(s: Scratch, pairs: NDArray[np.int64], steps: Floats) -> None:
    """Copy rows of the block to rows of a table, (:data:`COLUMNS`, LANES)."""
    for n in range(pairs.shape[0]):
        first, row = pairs[n, 0] * LANES, pairs[n, 1]
        for i in range(LANES):
            steps[row, i] = s.block[first + i]


def has_watched(s: Scratch) -> bool:
    """Return True if a lane has a particle whose steps are recorded."""
    if len(s.watched) == 0:
        return True
    watched = 0
    for i in range(LANES):
        watched += s.member[i] >= 0 and s.watched[s.member[i]]
    return bool(watched > 0)


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
        ends = (getattr(step, f"{name}{end}") for end in (0, 1))
        first, last = (np.moveaxis(self.tables[:, row : row + k], 1, 2).reshape(-1, k) for row in ends)
        return first, last

    def take(self, which: NDArray[np.bool_] | NDArray[np.intp]) -> Steps:
        """Return some of the steps, in a single table."""
        rows = np.flatnonzero(which) if which.dtype == np.bool_ else which
        m, k = np.divmod(rows, max(self.tables.shape[2], 1))
        return self._replace(tables=np.ascontiguousarray(self.tables[m, :, k].T)[None])

    @property
    def rate(self) -> Floats:
        """Material velocity gradients dF/dt at the start of the steps of a single table, (n, 9), 1/s."""
        rate = np.empty((self.n, 9))
        compiled(_rates)(self.tables[0], int(self.in_frame), rate)
        return rate

    def between(self, share: Floats) -> tuple[Floats, Floats, Floats]:
        """Return where and what particles are after a share (n,) of each step of a single table.

        Returns
        -------
        x, v, F
            Positions on Hermite's cubic, (n, 3), m; velocities linear between both ends, (n, 3), m/s;
            deformation gradients by :func:`shape_between`, (n, 9).
        """
        x, v, F = np.empty((self.n, 3)), np.empty((self.n, 3)), np.empty((self.n, 9))
        compiled(_between)(self.tables[0], share, int(self.in_frame), x, v, F)
        return x, v, F

    @property
    def has_mode(self) -> bool:
        """Whether the quadratic mode is recorded."""
        return int(self.tables.shape[1]) > step.B0

    def mode_between(self, share: Floats) -> Floats:
        """Return the quadratic mode after a share (n,) of each step of a single table, (n, 7).

        It is exact for a flow that does not change in the step, as is the drift in it.
        """
        B = np.empty((self.n, 7))
        compiled(_modes)(self.tables[0], share, B)
        return B


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


def _between(table: Floats, share: Floats, in_frame: int, x: Floats, v: Floats, F: Floats) -> None:
    for k in range(table.shape[1]):
        s, m0, m1 = share[k], way_at_start(table, k), way_at_end(table, k)
        G = shape_between(table, k, s, in_frame)
        for c in range(3):
            x[k, c] = cubic(s, table[step.x0 + c, k], table[step.x1 + c, k], m0[c], m1[c])
            v0, v1 = table[step.v0 + c, k], table[step.v1 + c, k]
            v[k, c] = v1 if math.isnan(v0) else (1.0 - s) * v0 + s * v1
        for c in range(9):
            F[k, c] = G[c]


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


def steps_of(tables: Floats, rows: RecordedRows, rebounds: Floats, coupled: Sequence[int]) -> Steps:
    """Return the steps in tables, those through coupled patches divided there.

    Parameters
    ----------
    tables
        Records of the loop, also of lanes without a step, whose ends are at the time of their starts.
    rebounds, coupled
        Records of rebounds and passages, see :func:`foamprb.cloud.contact.record_contact`; the coupled
        patches.
    """
    steps = Steps(tables, rows.in_frame)
    if not tables[:, step.passed].any():
        return steps
    moved = steps.take(steps.t[1] > steps.t[0])
    table, first, pieces = moved.tables[0], 0, []
    for k in np.flatnonzero(table[step.passed]).tolist():
        pieces += [table[:, first:k], _divided(table[:, k], rows.in_frame, rebounds, coupled)]
        first = k + 1
    return steps._replace(tables=np.concatenate([*pieces, table[:, first:]], axis=1)[None])


def _divided(record: Floats, in_frame: bool, rebounds: Floats, coupled: Sequence[int]) -> Floats:
    """Return the parts of a step between its passages of coupled patches, (:data:`COLUMNS`, k)."""
    during = (rebounds[:, 0] == record[step.number]) & (rebounds[:, 2] >= record[step.t0])
    during &= rebounds[:, 2] <= record[step.t1]
    parts: list[Floats] = []
    rest = record.copy()
    for before, after in passages(rebounds[during], coupled):
        part = rest.copy()
        turn = after.F[0].reshape(3, 3) @ np.linalg.inv(before.F[0].reshape(3, 3))
        for first, values in ((step.t1, before.t), (step.x1, before.x[0]), (step.v1, before.v[0])):
            part[first : first + len(values)] = values
        # A part of no duration has the least: observers see it, too.
        part[step.t1] = max(part[step.t1], np.nextafter(part[step.t0], np.inf))
        part[step.F1 : step.F1 + 9] = before.F[0]
        part[step.Q1 : step.Q1 + 9] = (rest[step.Q1 : step.Q1 + 9].reshape(3, 3) @ turn).ravel()
        part[step.l1 : step.l1 + 9] = rest[step.l0 : step.l0 + 9]
        part[step.host1], part[step.status], part[step.passed] = -1, Status.ACTIVE, len(parts) > 0
        parts.append(part)
        for first, values in ((step.t0, after.t), (step.x0, after.x[0]), (step.v0, after.v[0])):
            rest[first : first + len(values)] = values
        rest[step.t0] = max(rest[step.t0], part[step.t1])
        rest[step.F0 : step.F0 + 9] = after.F[0]
        rest[step.Q0 : step.Q0 + 9] = (rest[step.Q0 : step.Q0 + 9].reshape(3, 3) @ turn.T).ravel()
        if not in_frame:
            rest[step.A0 : step.A0 + 9] = (turn @ rest[step.A0 : step.A0 + 9].reshape(3, 3)).ravel()
        rest[step.l0 : step.l0 + 9] = rest[step.l1 : step.l1 + 9]
        rest[step.host0] = -1
        if len(rest) > step.B0:
            rest[step.B0 :] = _turned_mode(part[:, None], turn)
    rest[step.t1] = max(rest[step.t1], np.nextafter(rest[step.t0], np.inf))
    return np.stack([*parts, rest], axis=1)


def _turned_mode(part: Floats, turn: Floats) -> Floats:
    """Return the rows of the mode after a step, turned by a rotation, from a table of this step, (n, 1)."""
    flat: Any = tuple(turn.ravel())
    B = mode_after(part, 0, part[step.t1, 0] - part[step.t0, 0])
    growth, spin = third_of(part, step.growth0, 0), turn @ part[step.fluid_spin0 :, 0]
    return np.array([*turned(B, flat), *turned(growth, flat), part[step.recovery0, 0], *spin])
