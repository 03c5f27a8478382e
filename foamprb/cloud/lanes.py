"""Assignment of particles to the lanes of a block, in which each particle advances by its own steps.

A lane whose particle is finished takes the next one. A particle can also be set aside with its whole state
and continue later in any lane: an evaluation costs a block as much for one lane as for all, so that of the
ends is made for many particles at once. The cloud's arrays are written only for finished particles.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.block import (
    SHELF,
    Scratch,
    at,
    idle_lanes,
    load_particle,
    save_particle,
)
from foamprb.cloud.layout import LANES
from foamprb.cloud.motion import (
    ACTIVE,
    PENDING,
    SHORTEST_STEP,
    PatchTable,
    interrupted,
    release,
    renew_clearance,
)
from foamprb.cloud.state import Particles
from foamprb.compile.link import separate, slot

READY, ENDED, _NEXT, _RELOCATED, PAUSED = 0, 1, 2, 3, 4
"""Indices in :attr:`~foamprb.cloud.block.Scratch.counts`: particles set aside that may continue, and that
need the rates at their end; particles loaded so far; walks that needed the tree; 1 between two calls for the
same particles, else 0."""
NOTHING, AGAIN, NEW = 0, 1, 2
"""Results of :func:`fetch`."""
_MEMBER, _STATUS, _REASON, _PATCH, _HOST, _STEP, _NUMBER, _WALKS = 0, 1, 2, 3, 4, 5, 6, 7
"""Columns of :attr:`~foamprb.cloud.block.Scratch.labels`."""
_PLACES = SHELF // 2
"""Places for each of the two kinds. As a new particle is loaded only if none is ready, at most those in the
lanes and LANES that ended are set aside."""


@slot
def hold(
    _flow: object, _patches: PatchTable, _s: Scratch, _i: int, _last: int, _dt: float, _start: float
) -> None:
    """No-op: particles that stick stay."""


def begin_lanes(s: Scratch, dt: float) -> None:
    """Start with no particle in any lane, or go on after :func:`pause`."""
    if s.counts[PAUSED]:
        s.counts[PAUSED] = 0
        return
    idle_lanes(s.block, s.initial, dt)
    for i in range(LANES):
        s.member[i] = -1
    for n in range(len(s.counts)):
        s.counts[n] = 0


def pause(s: Scratch) -> None:
    """Leave all particles in their lanes and on the shelf until the next call."""
    s.counts[PAUSED] = 1


def others(s: Scratch, n: int) -> bool:
    """Return True if one of n particles could take the lane of one that is set aside."""
    return bool(s.counts[READY] > 0 or s.counts[_NEXT] < n)


def fetch(p: Particles, members: NDArray[np.int64], s: Scratch, i: int, step: int) -> int:
    """Load lane i with a particle that is ready, or else a new one.

    Parameters
    ----------
    members
        Indices of all particles.
    step
        The first tracking step of a new particle.

    Returns
    -------
    NEW, AGAIN for a particle that was set aside, or NOTHING.
    """
    if s.counts[READY] > 0:
        take_back(s, i, READY)
        return AGAIN
    k = s.counts[_NEXT]
    if k == len(members):
        return NOTHING
    s.counts[_NEXT] = k + 1
    loaded = len(s.lasting) - len(s.fresh)
    for n in range(len(s.fresh)):
        s.block[s.lasting[loaded + n] * LANES + i] = s.fresh[n]
    load_particle(p, members[k], s, i)
    s.member[i], s.step[i], s.mended[i] = members[k], step, 0
    return NEW


def leave(p: Particles, s: Scratch, i: int) -> None:
    """Save the finished particle in lane i and free the lane."""
    save_particle(p, s.member[i], s, i)
    s.counts[_RELOCATED] += s.mended[i]
    s.member[i] = -1


def must_move(s: Scratch, i: int, last: int) -> bool:
    """Return True if the particle in lane i is active and has not reached the tracking step ``last``."""
    return bool(s.member[i] >= 0 and s.status[i] == ACTIVE and s.step[i] < last)


@separate
def fill_lanes(
    flow: object,
    patches: PatchTable,
    p: Particles,
    members: NDArray[np.int64],
    s: Scratch,
    step: int,
    last: int,
    dt: float,
    start: float,
) -> int:
    """Replace the finished particles by others.

    Parameters
    ----------
    As in :func:`foamprb.cloud.integrators.adaptive.track_adaptive`, and
    last
        The tracking step after the last.

    Returns
    -------
    Number of lanes whose particles must move.
    """
    while not interrupted(s):
        for i in range(LANES):
            if s.member[i] >= 0:
                hold(flow, patches, s, i, last, dt, start)
                if not must_move(s, i, last):
                    finish(p, s, i, len(members))
        loaded, new = 0, 0
        for i in range(LANES):
            if s.member[i] < 0:
                kind = fetch(p, members, s, i, step)
                loaded += kind != NOTHING
                new |= (kind == NEW) << i
        if loaded == 0:
            break
        for i in range(LANES):
            if new >> i & 1:
                if s.status[i] == ACTIVE:
                    renew_clearance(flow, s, i)
                release_due(flow, patches, s, i, last, dt, start)
    moving = 0
    for i in range(LANES):
        moving += must_move(s, i, last)
    return moving


def release_due(
    flow: object, patches: PatchTable, s: Scratch, i: int, last: int, dt: float, start: float
) -> None:
    """Release the particle in lane i in the tracking step of its injection time, if it is pending."""
    block = s.block
    while s.status[i] == PENDING and s.step[i] < last:
        if block[at.t0 * LANES + i] < start + (s.step[i] + 1) * dt - SHORTEST_STEP * dt:
            release(flow, patches, s, i)
            block[at.h * LANES + i] = dt
        else:
            s.step[i] += 1


def finish(p: Particles, s: Scratch, i: int, n: int) -> None:
    """Free lane i of its finished particle.

    A particle that needs the rates at its end stays unless one of n particles could take its lane.
    """
    if s.switches.updates_end == 0 or s.status[i] != ACTIVE:
        leave(p, s, i)
    elif s.counts[ENDED] < LANES and others(s, n):
        set_aside(s, i, ENDED)


def set_aside(s: Scratch, i: int, kind: int) -> None:
    """Set the particle in lane i aside as READY or ENDED."""
    place = kind * _PLACES + s.counts[kind]
    s.counts[kind] += 1
    for n in range(len(s.lasting)):
        s.shelf[place, n] = s.block[s.lasting[n] * LANES + i]
    s.labels[place, _MEMBER], s.labels[place, _NUMBER] = s.member[i], s.number[i]
    s.labels[place, _STATUS], s.labels[place, _REASON] = s.status[i], s.reason[i]
    s.labels[place, _PATCH], s.labels[place, _HOST] = s.patch[i], s.host[i]
    s.labels[place, _STEP], s.labels[place, _WALKS] = s.step[i], s.mended[i]
    s.member[i] = -1


def take_back(s: Scratch, i: int, kind: int) -> None:
    """Load lane i with the particle of a kind that was set aside last."""
    s.counts[kind] -= 1
    place = kind * _PLACES + s.counts[kind]
    for n in range(len(s.lasting)):
        s.block[s.lasting[n] * LANES + i] = s.shelf[place, n]
    s.member[i], s.number[i] = s.labels[place, _MEMBER], s.labels[place, _NUMBER]
    s.status[i], s.reason[i] = s.labels[place, _STATUS], s.labels[place, _REASON]
    s.patch[i], s.host[i] = s.labels[place, _PATCH], s.labels[place, _HOST]
    s.step[i], s.mended[i] = s.labels[place, _STEP], s.labels[place, _WALKS]


def walks_relocated(s: Scratch) -> int:
    """Return the number of walks of finished particles that needed the tree."""
    return int(s.counts[_RELOCATED])


def drop_unfinished(s: Scratch) -> None:
    """Drop the rebounds of particles that are not finished."""
    end = s.noted[1]
    for k in range(s.noted[1], s.noted[0]):
        if not _is_unfinished(s, s.rebounds[k, 0]):
            for c in range(s.rebounds.shape[1]):
                s.rebounds[end, c] = s.rebounds[k, c]
            end += 1
    s.noted[0] = s.noted[1] = end


def _is_unfinished(s: Scratch, number: float) -> bool:
    """Return True if the particle of a number is in a lane or set aside."""
    for i in range(LANES):
        if s.member[i] >= 0 and s.number[i] == number:
            return True
    for kind in range(2):
        for n in range(s.counts[kind]):
            if s.labels[kind * _PLACES + n, _NUMBER] == number:
                return True
    return False
