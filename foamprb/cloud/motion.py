"""What becomes of a particle when it moves: through the mesh, onto its patches, and out of the run.

The names ``sample``, ``walk``, ``gap``, ``normal`` and ``recover`` are bound to the flow that was chosen when
the loop is compiled.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector
from foamprb.cloud.block import (
    AT_F,
    AT_R,
    AT_V,
    AT_VERDICT,
    AT_X,
    LANES,
    LOST,
    load3,
    load9,
    store3,
)
from foamprb.cloud.patches import ESCAPE, STICK, rebound_velocity
from foamprb.cloud.state import Particles, Status
from foamprb.flow.analytic import gap_free as gap
from foamprb.flow.analytic import normal_free as normal
from foamprb.flow.analytic import recover_free as recover
from foamprb.flow.analytic import sample_linear as sample
from foamprb.flow.analytic import walk_free as walk

PENDING, ACTIVE, STUCK, ESCAPED, FAILED = (int(status) for status in Status)

SHORTEST_STEP = 1e-6
"""A first step shorter than this share of Δt is left to the next."""
_MAX_BOUNCES = 10


class PatchTable(NamedTuple):
    """What each patch does: its interaction's code, and the entries of ``rebound``."""

    code: NDArray[np.int8]
    e: NDArray[np.float64]
    mu: NDArray[np.float64]


def fail(p: Particles, k: int, reason: int) -> None:
    """End particle k with a reason."""
    p.status[k] = FAILED
    p.reason[k] = reason


def reach_end(
    flow: Any,
    patches: PatchTable,
    p: Particles,
    k: int,
    block: Any,
    i: int,
    goal: Vector,
    t_end: float,
    h: float,
    clearance: Any,
) -> int:
    """Move particle k in lane i to its goal, which it would reach at t_end after a step h, and touch walls.

    Returns
    -------
    The number of walks that the tree had to mend.
    """
    start = load3(block, AT_X, i)
    end, spent, mended = move_centre(flow, patches, p, k, block, i, goal, h)
    store3(block, AT_X, i, end)
    if p.status[k] == ACTIVE or p.status[k] == STUCK:
        clearance[i], f = touch(flow, patches, p, k, block, i, clearance[i], start)
        spent *= f
    p.t[k] = t_end if p.status[k] == ACTIVE else t_end - h + spent
    return mended


def between(a: Vector, b: Vector, f: float) -> Vector:
    """The point at fraction f of the way from a to b."""
    return a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])


def settle(p: Particles, k: int, patch: int, code: int) -> None:
    """End particle k on a patch, stuck or escaped."""
    p.status[k] = STUCK if code == STICK else ESCAPED
    p.patch[k] = patch


def move_centre(
    flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int, goal: Vector, dt: float
) -> tuple[Vector, float, int]:
    """Carry the centre to its goal in Δt, through the mesh and off or onto the patches that it meets.

    Returns the position where it ended, the time that it took, and the number of walks that the tree had to
    mend.
    """
    recovered = 0
    spent = 0.0
    x0, x1 = load3(block, AT_X, i), goal
    for _ in range(_MAX_BOUNCES):
        rest = dt - spent
        host, fraction, patch, triangle = walk(flow, p.host[k], x0, x1)
        if patch == -1:
            p.host[k] = host
            return x1, dt, recovered
        if patch == -2:
            host = recover(flow, x1)
            recovered += 1
            if host < 0:
                fail(p, k, LOST)
            else:
                p.host[k] = host
            return x1, dt, recovered
        p.host[k] = host
        x0 = between(x0, x1, fraction)
        spent += fraction * rest
        code = patches.code[patch]
        if code in (STICK, ESCAPE):
            settle(p, k, patch, code)
            return x0, spent, recovered
        n = normal(flow, triangle, x0)
        v = rebound_velocity(load3(block, AT_V, i), n, patches.e[patch], patches.mu[patch])
        store3(block, AT_V, i, v)
        rest = dt - spent
        x1 = (x0[0] + rest * v[0], x0[1] + rest * v[1], x0[2] + rest * v[2])
    return x0, dt, recovered


def touch(
    flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int, before: float, start: Vector
) -> tuple[float, float]:
    """Let the ellipsoid touch the walls near it, after its centre went from ``start`` to its new place.

    Returns the clearance that is left, and the fraction of the way at which a particle stopped.
    """
    x = load3(block, AT_X, i)
    F = load9(block, AT_F, i)
    R = block[AT_R * LANES + i]
    after, patch, triangle = gap(flow, p.host[k], x, F, R)
    if after > 0.0:
        return after, 1.0
    f = 0.0
    if before > 0.0:
        f = before / (before - after) if before < math.inf else 1.0
    if patches.code[patch] == STICK:
        contact = between(start, x, f)
        host, _, _, _ = walk(flow, p.host[k], x, contact)
        p.host[k] = host
        store3(block, AT_X, i, contact)
        settle(p, k, patch, STICK)
        return 0.0, f
    n = normal(flow, triangle, x)
    v = load3(block, AT_V, i)
    store3(block, AT_V, i, rebound_velocity(v, n, patches.e[patch], patches.mu[patch]))
    # What the centre went towards the wall after the contact is taken back: else a body that comes to rest
    # on the wall would sink into it.
    beyond = (x[0] - start[0]) * n[0] + (x[1] - start[1]) * n[1] + (x[2] - start[2]) * n[2]
    back = -(1.0 - f) * min(beyond, 0.0)
    place = (x[0] + back * n[0], x[1] + back * n[1], x[2] + back * n[2])
    host, _, failed, _ = walk(flow, p.host[k], x, place)
    if failed != -2:
        p.host[k] = host
        store3(block, AT_X, i, place)
        after, _, _ = gap(flow, host, place, F, R)
    return after, 1.0


def release(flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int) -> float:
    """Make a pending particle active, or stuck if it appears in touch with a sticky wall."""
    p.status[k] = ACTIVE
    p.t[k] = p.t0[k]
    if math.isnan(block[AT_V * LANES + i]):
        u, _, _ = sample(flow, p.host[k], load3(block, AT_X, i), p.t0[k])
        store3(block, AT_V, i, u)
    clearance, patch, _ = gap(flow, p.host[k], load3(block, AT_X, i), load9(block, AT_F, i), p.R[k])
    if clearance <= 0.0 and patches.code[patch] == STICK:
        settle(p, k, patch, STICK)
    return clearance


def is_sound(p: Particles, k: int, block: Any, i: int) -> bool:
    """Whether the new shape of particle k was taken over; if not, the particle fails."""
    verdict = int(block[AT_VERDICT * LANES + i])
    if verdict:
        fail(p, k, verdict)
    return verdict == 0
