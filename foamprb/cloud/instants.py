"""State of particles at given instants, for which no step ends.

It follows from the record of the step that leads past an instant (:meth:`foamprb.cloud.paths.Steps.between`).
Paths do not depend on the instants.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.quadratic import turned
from foamprb.cloud.paths import COLUMNS, Steps, step
from foamprb.cloud.state import VARIABLES, Particles, Status
from foamprb.flow.kernels import linked_with, recover, ride, walk

Floats = NDArray[np.float64]

PREFIX = "instants/"
"""Of the names of arrays of states, (n, w, …), among those of cloud functions; the status is 0 where none is
stored."""
READ = ("A", "B", "F0", "heading", "eddy")
"""Arrays that measures read beside place and shape. The last three change at walls or by random numbers only:
stored is their value at the end of the step."""
_DIFFERENCE = 1e-4
"""Share of a step, for the rate of the deformation gradient by differences."""
_ROUND_OFF = 1e-12
"""Of times, over their values."""


class Moments(NamedTuple):
    """Instants of some steps, and the arrays of particles that are stored there beside place and shape."""

    times: tuple[float, ...] = ()
    """s, rising, before the end of the last step."""
    more: tuple[str, ...] = ()

    def layout(self) -> Mapping[str, NDArray[Any]]:
        """Return the arrays that hold the states, without particles."""
        kept = ((name, VARIABLES[name]) for name in ("x", "v", "F", "status", "patch", *self.more))
        return {f"{PREFIX}{name}": np.empty((0, len(self.times), *v.shape), v.dtype) for name, v in kept}


def store(moments: Moments, arrays: Mapping[str, NDArray[Any]], steps: Steps) -> None:
    """Store the states at the instants within undivided steps in arrays, see :meth:`Moments.layout`."""
    times = np.array(moments.times)
    which, instant = steps.passing(times)
    time, first = times[instant], COLUMNS
    row, status, patch, met, t0, t1 = (
        steps.of(number)[which] for number in (step.row, step.status, step.patch, step.met, step.t0, step.t1)
    )
    share, rests, straight = (time - t0) / (t1 - t0), met == -np.inf, np.flatnonzero(met < np.inf)
    x, v, F = steps.between(share, which)
    if len(straight):
        some = steps.take(which[straight])
        x[straight], v[straight], F[straight] = _on_lines(some, time[straight])
    stuck = (status == Status.STUCK) & (rests | (time == t1))
    state = {"status": np.where(stuck, Status.STUCK, Status.ACTIVE), "patch": np.where(stuck, patch, -1)}
    state |= {"x": x, "v": v, "F": F}
    for name in moments.more:
        columns = VARIABLES[name].shape[0]
        state[name] = np.stack([steps.of(first + c)[which] for c in range(columns)], axis=1)
        first += columns
    if "A" in state:
        before, after = (steps.between(share + change, which)[2] for change in (-_DIFFERENCE, _DIFFERENCE))
        rate = (0.5 / (_DIFFERENCE * (t1 - t0)))[:, None] * (after - before)
        rate[straight] = steps.take(which[straight]).rate
        state["A"] = np.where(rests[:, None], state["A"], rate)
    if "B" in state:
        state["B"] = np.where(rests[:, None], state["B"], steps.take(which).mode_between(share))
    for name, values in state.items():
        arrays[f"{PREFIX}{name}"][row.astype(np.int64), instant] = values


def _on_lines(steps: Steps, time: Floats) -> tuple[Floats, Floats, Floats]:
    """Return x, v and F at times, s, in steps through coupled patches or mirrors, or in bonds.

    The places are on the line to the first of the patches, or on that from the last. Between two passages the
    particle stays where it comes to after the last.
    """
    (t0, t1), met, left = steps.t, steps.of(step.met), steps.of(step.left)
    early = time < met
    begin, end = np.where(early, t0, left), np.where(early, met, t1)
    remaining = np.clip((end - time) / np.maximum(end - begin, 1e-300), 0.0, 1.0)
    to_first = steps.x[0], steps.rows(step.met_x, 3), steps.both("v")[0], steps.both("F")[0]
    from_last = steps.rows(step.left_x, 3), steps.x[1], steps.both("v")[1], steps.both("F")[1]
    x0, x1, v, F = (np.where(early[:, None], *ends) for ends in zip(to_first, from_last, strict=True))
    return x1 + remaining[:, None] * (x0 - x1), v, F


def state_at(p: Particles, arrays: Mapping[str, NDArray[Any]], w: int, moments: Moments) -> Particles:
    """Return particles at instant w; others have the state in which they ended, or are not released.

    The arguments are the particles after the steps with the instant, and what :func:`store` has stored.
    """
    time, (stored, status) = moments.times[w], status_at(p, arrays, w, moments)
    values: dict[str, NDArray[Any]] = {}
    for path, array in moments.layout().items():
        name, mask = path.removeprefix(PREFIX), stored.reshape(-1, *[1] * (array.ndim - 2))
        values[name] = np.where(mask, arrays[path][:, w], getattr(p, name))
    # Those that a changed writeInterval finds beyond the instant go back along their velocity.
    beyond = ~stored & (p.status == Status.ACTIVE) & (p.t > time) & (p.t0 < time)
    values["x"][beyond] -= p.v[beyond] * (p.t[beyond] - time)[:, None]
    values["status"] = status.astype(p.status.dtype)
    values["reason"] = np.where(stored, 0, p.reason).astype(p.reason.dtype)
    return p._replace(**values, t=np.where(stored | beyond, time, p.t))


def status_at(
    p: Particles, arrays: Mapping[str, NDArray[Any]], w: int, moments: Moments
) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
    """Return which particles moved past an instant, (n,), and the status of all then.

    The arguments are those of :func:`state_at`.
    """
    time, status = moments.times[w], arrays[f"{PREFIX}status"][:, w]
    # A particle that appears there does not count yet.
    released = p.t0 < time - _ROUND_OFF * abs(time)
    # Those whose steps have ended there have come to that state.
    stored = released & (status > 0) & (p.t > time)
    return stored, np.where(stored, status, np.where(released, p.status, Status.PENDING))


def hosts_at(kernels: Mapping[str, Any], flow: object, p: Particles, then: Particles) -> NDArray[np.int64]:
    """Return the hosts of particles at an instant in a flow; −1 outside the mesh, (n,).

    They are at the ends of straight ways from the particles as they are, or found by the tree.
    """
    hosts = np.empty(p.size, dtype=np.int64)
    walk_all, packed_flow = linked_with(kernels, flow, _walk_all)
    walk_all(packed_flow, p.host, p.x, p.t, then.x, then.t, hosts)
    return hosts


def _walk_all(
    flow: object,
    hosts: NDArray[np.int64],
    x0: Floats,
    t0: Floats,
    x1: Floats,
    t1: Floats,
    reached: NDArray[np.int64],
) -> None:
    for k in range(len(hosts)):
        start, goal = (x0[k, 0], x0[k, 1], x0[k, 2]), (x1[k, 0], x1[k, 1], x1[k, 2])
        if hosts[k] < 0 or start == goal:
            reached[k] = hosts[k]
        else:
            host, _, patch, _ = walk(flow, hosts[k], start, t0[k], goal, t1[k])
            reached[k] = host if patch == -1 else recover(flow, goal, t1[k])


def ridden(kernels: Mapping[str, Any], flow: object, p: Particles, time: float) -> Particles:
    """Return particles with those that stick to walls where these have carried them until a time, s."""
    rows = np.flatnonzero((p.status == Status.STUCK) & (p.t < time) & (p.host >= 0))
    if "ride" not in kernels or len(rows) == 0:
        return p
    x, v, turns = p.x[rows], p.v[rows], np.empty((len(rows), 3, 3))
    ride_all, packed_flow = linked_with(kernels, flow, _ride_all)
    ride_all(packed_flow, p.host[rows].astype(np.int64), p.t[rows], float(time), x, v, turns)
    moved: dict[str, NDArray[Any]] = {"x": x, "v": v}
    for name in ("F", "A"):
        moved[name] = (turns @ getattr(p, name)[rows].reshape(-1, 3, 3)).reshape(-1, 9)
    given: Any = tuple(p.B[rows].T), tuple(turns.reshape(-1, 9).T)
    moved["B"] = np.stack(turned(*given), axis=1)
    whole = {name: np.array(getattr(p, name)) for name in moved}
    for name, values in moved.items():
        whole[name][rows] = values
    return p._replace(**whole)


def _ride_all(
    flow: object, hosts: NDArray[np.int64], t: Floats, time: float, x: Floats, v: Floats, turns: Floats
) -> None:
    for k in range(len(hosts)):
        place, turn, speed = ride(flow, hosts[k], (x[k, 0], x[k, 1], x[k, 2]), t[k], time)
        for i in range(3):
            x[k, i], v[k, i] = place[i], speed[i]
        for i in range(9):
            turns[k, i // 3, i % 3] = turn[i]
