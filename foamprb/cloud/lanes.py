"""Which particle is in which lane of a block, where each particle goes on at its own pace.

A lane whose particle has done its steps takes the next one, so that none waits for the slowest. And a
particle can be put aside with all that it is, to go on later in any lane: where few lanes of a block need
more work than the others, they do it once there are enough of them, as it costs a block as much for one lane
as for all. Until a particle has done all its steps, the cloud's arrays are left alone.
"""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import SHELF, Scratch, ask_for_particle, at, load_particle, save_particle
from foamprb.cloud.layout import LANES
from foamprb.cloud.motion import (
    ACTIVE,
    PENDING,
    SHORTEST_STEP,
    PatchTable,
    clearance_of,
    interrupted,
    release,
)
from foamprb.cloud.state import Particles

READY, WAITING, ENDED, _NEXT, _MENDED = 0, 1, 2, 3, 4
"""In :attr:`~foamprb.cloud.block.Scratch.counts`: particles that are put aside and may go on, that wait for
others, and that have done their steps but for what is found of many at once; those that have been in a lane;
walks that the tree has mended."""
NOTHING, AGAIN, NEW = 0, 1, 2
"""What :func:`fetch` has found."""
_MEMBER, _STATUS, _REASON, _PATCH, _HOST, _STEP, _NUMBER, _WALKS = 0, 1, 2, 3, 4, 5, 6, 7
"""In :attr:`~foamprb.cloud.block.Scratch.labels`."""
_PLACES = SHELF // 3
"""For each of the three kinds. A new particle is loaded only if none is ready: so there are never more than
those in the lanes, 2 LANES that wait and LANES that have ended."""

renews_end = 0
"""Whether an integrator finds something of many particles at once at their ends; bound with it."""


def empty_lanes(s: Scratch) -> None:
    """Begin with no particle in any lane; the block is that of :func:`foamprb.cloud.block.idle_lanes`."""
    for i in range(LANES):
        s.member[i] = -1
    for n in range(len(s.counts)):
        s.counts[n] = 0


def others(s: Scratch, n: int) -> bool:
    """Whether there are particles, of n, that could go on in the place of one that is put aside."""
    return bool(s.counts[READY] > 0 or s.counts[_NEXT] < n)


def ask_ahead(p: Particles, members: NDArray[np.int64], s: Scratch) -> None:
    """Read of the new particles for all lanes that are free, before the first is loaded."""
    k, total = s.counts[_NEXT], 0.0
    for i in range(LANES):
        if s.member[i] < 0 and k < len(members):
            total += ask_for_particle(p, members[k])
            k += 1
    s.asked[0] = total


def fetch(p: Particles, members: NDArray[np.int64], s: Scratch, i: int, step: int) -> int:
    """Put a particle into lane i: one that is ready, a new one, or one that waits.

    Parameters
    ----------
    members
        Rows of all particles.
    step
        The tracking step with which a new one begins.

    Returns
    -------
    NEW, AGAIN for one that was put aside, NOTHING if there is none.
    """
    k = s.counts[_NEXT]
    if s.counts[READY] > 0:
        take_back(s, i, READY)
    elif k < len(members):
        s.counts[_NEXT] = k + 1
        loaded = len(s.kept) - len(s.fresh)
        for n in range(len(s.fresh)):
            s.block[s.kept[loaded + n] * LANES + i] = s.fresh[n]
        load_particle(p, members[k], s, i)
        s.member[i], s.step[i], s.mended[i] = members[k], step, 0
        return NEW
    elif s.counts[WAITING] > 0:
        take_back(s, i, WAITING)
    else:
        return NOTHING
    return AGAIN


def leave(p: Particles, s: Scratch, i: int) -> None:
    """Save the particle in lane i, which has done all its steps."""
    save_particle(p, s.member[i], s, i)
    s.counts[_MENDED] += s.mended[i]
    s.member[i] = -1


def has_steps(s: Scratch, i: int, last: int) -> bool:
    """Whether there is a particle in lane i that moves, and has not come to the tracking step ``last``."""
    return bool(s.member[i] >= 0 and s.status[i] == ACTIVE and s.step[i] < last)


def fill_lanes(
    flow: Any,
    patches: PatchTable,
    p: Particles,
    members: NDArray[np.int64],
    s: Scratch,
    step: int,
    last: int,
    dt: float,
    start: float,
) -> int:
    """Save the particles that have no step to take, and give their lanes others, as far as there are any.

    Where their ends are to be renewed, some may stay in their lanes.

    Parameters
    ----------
    As of :func:`foamprb.cloud.integrators.adaptive.track_adaptive`, and
    last
        The tracking step after the last.

    Returns
    -------
    Number of lanes whose particles have steps to take.
    """
    while not interrupted(s):
        for i in range(LANES):
            if s.member[i] >= 0 and not has_steps(s, i, last):
                finish(p, s, i, len(members))
        ask_ahead(p, members, s)
        found, new = 0, 0
        for i in range(LANES):
            if s.member[i] < 0:
                kind = fetch(p, members, s, i, step)
                found += kind != NOTHING
                new |= (kind == NEW) << i
        if found == 0:
            break
        for i in range(LANES):
            if new >> i & 1:
                if s.status[i] == ACTIVE:
                    s.block[at.clearance * LANES + i], _, _ = clearance_of(flow, s, i)
                release_due(flow, patches, s, i, last, dt, start)
    moving = 0
    for i in range(LANES):
        moving += has_steps(s, i, last)
    return moving


def release_due(
    flow: Any, patches: PatchTable, s: Scratch, i: int, last: int, dt: float, start: float
) -> None:
    """Let the particle in lane i, if it is pending, wait for its time, and release it if that has come."""
    block = s.block
    while s.status[i] == PENDING and s.step[i] < last:
        if block[at.t0 * LANES + i] < start + (s.step[i] + 1) * dt - SHORTEST_STEP * dt:
            release(flow, patches, s, i)
            block[at.h * LANES + i] = dt
        else:
            s.step[i] += 1


def finish(p: Particles, s: Scratch, i: int, n: int) -> None:
    """Take the particle out of lane i, which has no step to take.

    It stays if its end is to be renewed, and none of n particles could take its place.
    """
    if not renews_end or s.status[i] != ACTIVE:
        leave(p, s, i)
    elif s.counts[ENDED] < LANES and (others(s, n) or s.counts[WAITING] > 0):
        put_aside(s, i, ENDED)


def put_aside(s: Scratch, i: int, kind: int) -> None:
    """Put the particle in lane i aside, of a kind: READY, WAITING or ENDED."""
    place = kind * _PLACES + s.counts[kind]
    s.counts[kind] += 1
    for n in range(len(s.kept)):
        s.shelf[place, n] = s.block[s.kept[n] * LANES + i]
    s.labels[place, _MEMBER], s.labels[place, _NUMBER] = s.member[i], s.number[i]
    s.labels[place, _STATUS], s.labels[place, _REASON] = s.status[i], s.reason[i]
    s.labels[place, _PATCH], s.labels[place, _HOST] = s.patch[i], s.host[i]
    s.labels[place, _STEP], s.labels[place, _WALKS] = s.step[i], s.mended[i]
    s.member[i] = -1


def take_back(s: Scratch, i: int, kind: int) -> None:
    """Put the particle of a kind that was put aside last into lane i."""
    s.counts[kind] -= 1
    place = kind * _PLACES + s.counts[kind]
    for n in range(len(s.kept)):
        s.block[s.kept[n] * LANES + i] = s.shelf[place, n]
    s.member[i], s.number[i] = s.labels[place, _MEMBER], s.labels[place, _NUMBER]
    s.status[i], s.reason[i] = s.labels[place, _STATUS], s.labels[place, _REASON]
    s.patch[i], s.host[i] = s.labels[place, _PATCH], s.labels[place, _HOST]
    s.step[i], s.mended[i] = s.labels[place, _STEP], s.labels[place, _WALKS]


def give_way(s: Scratch, kind: int) -> None:
    """Put particles of a kind into the lanes, and aside those that are there."""
    for i in range(LANES):
        if s.member[i] >= 0:
            put_aside(s, i, READY)
        if s.counts[kind] > 0:
            take_back(s, i, kind)


def walks_mended(s: Scratch) -> int:
    """How many walks the tree has mended of the particles that have done all their steps."""
    return int(s.counts[_MENDED])


def forget_unfinished(s: Scratch) -> None:
    """Let only those rebounds count that are of particles which have done all their steps."""
    kept = s.noted[1]
    for k in range(s.noted[1], s.noted[0]):
        if not _is_unfinished(s, s.rebounds[k, 0]):
            for c in range(s.rebounds.shape[1]):
                s.rebounds[kept, c] = s.rebounds[k, c]
            kept += 1
    s.noted[0] = s.noted[1] = kept


def _is_unfinished(s: Scratch, number: float) -> bool:
    for i in range(LANES):
        if s.member[i] >= 0 and s.number[i] == number:
            return True
    for kind in range(3):
        for n in range(s.counts[kind]):
            if s.labels[kind * _PLACES + n, _NUMBER] == number:
                return True
    return False
