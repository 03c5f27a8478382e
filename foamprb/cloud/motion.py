"""Motion of particles through the mesh, contact with patches, and the end of particles.

What models add is behind the slots :func:`turn_along`, :func:`bounce_along`, :func:`form_bond`,
:func:`resume` and :func:`mirror_memory`; :func:`rewind` is that of the integrator.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import (
    Tensor,
    Vector,
    between,
    dot,
    dot_vector,
    inner,
    longest_stretch,
    minus,
    plus,
    plus_scaled,
    scale_vector,
    transpose,
)
from foamprb.cloud.block import (
    CELLS_TOO_MANY,
    FLOW_NOT_FINITE,
    LOST,
    NOT_FINITE,
    STEP_TOO_SMALL,
    SUB_STEPS,
    WALLS_TOO_MANY,
    Scratch,
    at,
    load3,
    load9,
    store3,
    store9,
)
from foamprb.cloud.contact import first_contact, gap_of_lane, on_cubic, record_contact, slope_on_cubic
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.patches import CYCLIC, ESCAPE, MIRROR, REBOUND, STICK
from foamprb.cloud.paths import note_passage
from foamprb.cloud.pressing import approach, carries_reaction, push_out, reaction_on, redirect
from foamprb.cloud.state import Particles, Reason, Status
from foamprb.compile.link import separate, slot
from foamprb.compile.record import record
from foamprb.flow.base import NEAR
from foamprb.flow.kernels import cell_volume, cross, normal, recover, sample, walk, walk_on, wall_velocity

PENDING, ACTIVE, STUCK, ESCAPED, FAILED = (int(status) for status in Status if status <= Status.FAILED)

SEEN = 1.0 + NEAR
"""Distance from a body's centre, in semi-axes, beyond which walls do not matter."""
CLOSE = 1.0
"""Gap to a wall, in radii, below which a step longer than Δt leaves at least a share of the gap."""
LEAST_OF_GAP, _APPROACH = 0.1, 0.8
"""Least share of the gap that such a step leaves, and share of the way to a wall after which it ends if it
would leave less."""
_SOFT = 0.01
"""How far into a wall, in radii, such a step may lead a body that does not bounce."""
SHORTEST_STEP = 1e-6
"""A first step shorter than this share of Δt is joined to the next."""
UNLISTED = 1
"""Value of :attr:`~foamprb.cloud.block.Scratch.outgrown`: a body may touch walls that are not listed."""
TOUCH = 1e-6
"""Gap, in radii, that may be round-off of a body in contact."""
_OTHER_WALL = 0.1
"""Distance of a wall before a step, in radii beyond the gap, from which on another wall was nearest."""
STOPS_AT_CONTACT, GOES_ON = 2, 1
"""Values of :attr:`~foamprb.cloud.block.Switches.bouncing`: the step of a body with inertia ends at the
contact, or goes on from there; 0 without inertia."""
_MAX_BOUNCES = 10
# A particle near the axis of a wedge goes through it many times in a step.
_MAX_PATCHES = 1000
_STALL = 1e-9
"""Share of a way below which a particle that goes back and forth between two patches makes no progress."""
_HALVINGS = 40
_CAME = 1e-3
"""Way towards a wall in a step, in radii, up to which a body that touches it rests: else it bounces on.

Also the gap up to which a body rests that has no speed towards the wall at the start of a step."""
_OFF_WALL = 1e-6
"""Share of the way into a wall at which a walk away from it begins."""
_NO_NORMAL = (0.0, 0.0, 0.0)


BOND_FORMS, BOND_LOOSENS, BOND_FORCE, BOND_LIMIT, BOND_SEED = range(5)
"""Columns of :attr:`PatchTable.bonds`."""


@record
class PatchTable(NamedTuple):
    """Interaction of each patch: its code, and the entries of ``rebound`` and ``adhere``."""

    code: NDArray[np.int8]
    e: NDArray[np.float64]
    mu: NDArray[np.float64]
    bonds: NDArray[np.float64]
    """k_on, −1 without bonds; k_off, 1/s; μ_f x_b/(k_B T); the critical shear rate, 1/s; the seed."""


@separate
def fail(s: Scratch, i: int, reason: int) -> None:
    """Let the particle in lane i fail for a reason."""
    s.status[i] = FAILED
    s.reason[i] = reason
    if not (are_finite(s.block, i, at.u, at.u + 3) and are_finite(s.block, i, at.l, at.l + 9)):
        # Distinguish a failure of the particle from one of the flow.
        by_flow = are_finite(s.block, i, at.x, at.x + 24)
        s.reason[i] = FLOW_NOT_FINITE if by_flow else NOT_FINITE


_CODE = 16
"""Factor of a status in the code of an outcome, above all reasons."""


def outcome_code(status: Status, reason: Reason) -> int:
    """Return the verdict that ends a particle with another status than failed."""
    return _CODE * int(status) + int(reason)


def conclude(s: Scratch, i: int, code: int) -> None:
    """End the particle in lane i with the status and the reason of a code."""
    s.status[i], s.reason[i] = code // _CODE, code % _CODE


def are_finite(block: Block, i: int, row: int, end: int) -> bool:
    """Return True if lane i has finite numbers in the rows from ``row`` to before ``end``."""
    total = 0.0
    for k in range(row, end):
        total += block[k * LANES + i]
    return bool(abs(total) < math.inf)


def fail_small_step(s: Scratch, i: int) -> None:
    """Let the particle in lane i fail, as its error requires a step that is too small."""
    fail(s, i, STEP_TOO_SMALL if s.block[at.error * LANES + i] < math.inf else NOT_FINITE)


@slot
def turn_along(_block: Block, _i: int, _turn: Tensor) -> None:
    """No-op: no further quantity of lane i turns with the particle."""


@slot
def bounce_along(_block: Block, _i: int, _n: Vector) -> None:
    """No-op: no further quantity of lane i is reflected by a wall of normal n."""


@slot
def form_bond(
    _flow: object, _patches: PatchTable, _s: Scratch, _i: int, _patch: int, _t: float, _h: float
) -> None:
    """No-op: bodies in contact with a wall form no bonds."""


@slot
def resume(_block: Block, _i: int, _held: float) -> None:
    """No-op: no further quantity of lane i stays as it was while a wall held the body for a time, s."""


@slot
def rewind(_block: Block, _i: int, _f: float) -> None:
    """No-op: the shape in lane i stays that at the end of the step, not after the fraction f of it."""


def interrupted(s: Scratch) -> bool:
    """Return True if the loop must stop at once and leave unfinished particles as they were."""
    return bool(s.stop[0] + s.outgrown[0] != 0)


def end_block(s: Scratch) -> None:
    """Keep the rebounds of a block whose particles are saved."""
    s.noted[1] = s.noted[0]


def end_tracking_steps(s: Scratch, i: int) -> None:
    """Advance lane i to the tracking step after its finished stretch."""
    s.block[at.substeps * LANES + i] = s.block[at.taken * LANES + i] / s.stride[i]
    s.block[at.taken * LANES + i] = 0.0
    s.step[i] += s.stride[i]


def overspent(s: Scratch, i: int, remaining: float) -> bool:
    """Let lane i fail, and return True, if it has taken more steps than allowed for a tracking step.

    ``remaining`` is the part of its stretch left before the last step, in tracking steps.
    """
    begun = s.stride[i] - math.ceil(remaining) + 1
    if s.block[at.taken * LANES + i] <= s.bounds.maxSubSteps * max(1, begun):
        return False
    fail(s, i, SUB_STEPS)
    return True


def reach_end(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    goal: Vector,
    ahead: int,
    held: bool,
    t_end: float,
    h: float,
) -> int:
    """Move the particle in lane i to its goal, due at t_end after a step h, with contact of walls.

    A step of a body that bounces ends at the contact if ``bouncing`` says so. ``ahead`` is the host that
    probably holds the goal, ``held`` True if it certainly does.

    Returns
    -------
    The number of walks that needed the tree.
    """
    fraction, spent, walks = _go(flow, patches, s, i, goal, ahead, held, t_end - h, h)
    if s.switches.bouncing == STOPS_AT_CONTACT and fraction < 1.0 and s.status[i] == ACTIVE:
        reaches_end = h - spent < SHORTEST_STEP * h
        s.block[at.t * LANES + i] = t_end if reaches_end else t_end - h + spent
        return walks
    _arrive(flow, s, i, t_end, h - spent)
    return walks


def bounce_to_end(
    flow: object, patches: PatchTable, s: Scratch, i: int, goal: Vector, t_end: float, h: float
) -> int:
    """Do as :func:`reach_end`, where a body that bounces goes on from the contact to the end of the step."""
    block, recovered, spent = s.block, 0, 0.0
    for _ in range(_MAX_BOUNCES):
        fraction, gone, walks = _go(flow, patches, s, i, goal, s.host[i], False, t_end - h + spent, h - spent)
        recovered += walks
        spent += gone
        if fraction == 1.0 or s.status[i] != ACTIVE:
            break
        block[at.t * LANES + i] = t_end - h + spent
        goal = load3(block, at.new_x, i)
    _arrive(flow, s, i, t_end, h - spent)
    return recovered


def _go(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    goal: Vector,
    ahead: int,
    held: bool,
    t: float,
    h: float,
) -> tuple[float, float, int]:
    """Move the particle in lane i towards its goal, from t on in the time h, to its first contact.

    Returns
    -------
    The fraction of its way after which it stopped or bounced, the time that it took, s, and the number of
    walks that needed the tree.
    """
    origin = load3(s.block, at.x, i)
    end, start, goal, time, patch, triangle, walks = move_centre(flow, patches, s, i, goal, ahead, held, h)
    store3(s.block, at.x, i, end)
    fraction = 1.0
    if s.status[i] == ACTIVE or s.status[i] == STUCK:
        way, met, turned = (start, goal), (patch, triangle), start != origin
        fraction = touch(flow, patches, s, i, way, turned, met, t, time)
    return fraction, fraction * time, walks


def _arrive(flow: object, s: Scratch, i: int, t_end: float, missed: float) -> None:
    """End the step of lane i, of which a particle that is not active any more has missed a time."""
    if s.bounds.maxCells < math.inf and s.status[i] == ACTIVE:
        fail_in_small_cell(flow, s, i)
    s.block[at.t * LANES + i] = t_end if s.status[i] == ACTIVE else t_end - missed


@separate
def fail_in_small_cell(flow: object, s: Scratch, i: int) -> None:
    """Let the particle in lane i fail if its longest semi-axis exceeds the limit in cell sizes."""
    longest = s.block[at.length * LANES + i]
    if longest**3 > s.bounds.maxCells**3 * cell_volume(flow, s.host[i]):
        fail(s, i, CELLS_TOO_MANY)


def settle(s: Scratch, i: int, patch: int, code: int) -> None:
    """End the particle in lane i on a patch, stuck or escaped."""
    s.status[i] = STUCK if code == STICK else ESCAPED
    s.patch[i] = patch


@separate
def share_before_contact(
    flow: object, patches: PatchTable, s: Scratch, i: int, goal: Vector, ahead: int, held: bool
) -> float:
    """Return the share of a long step of lane i that ends before a patch that ends its path, and a wall.

    ``goal``, ``ahead`` and ``held`` are as in :func:`reach_end`. The share is 1 if the body comes to no such
    patch, and close to a wall, with a gap below :data:`CLOSE` radii, not too much closer than it was.
    """
    block, x = s.block, load3(s.block, at.x, i)
    t = block[at.t * LANES + i]
    t_end = t + block[at.dt * LANES + i]
    if not held:
        reached, fraction, patch, _ = walk_on(flow, s.host[i], ahead, x, t, goal, t_end)
        if patch == -2:
            return 0.0
        if patch >= 0 and patches.code[patch] not in (MIRROR, CYCLIC):
            return _APPROACH * fraction
        ahead = reached
    R, F, before = block[at.R * LANES + i], load9(block, at.new_F, i), block[at.clearance * LANES + i]
    after, _, _ = gap_of_lane(flow, block, i, ahead, goal, F, t_end)
    if min(before, after) >= CLOSE * R:
        return 1.0
    before = min(before, NEAR * R)
    least, soft = min(before, LEAST_OF_GAP * before), 0.0 if s.switches.bouncing > 0 else _SOFT * R
    if after < least - soft:
        return float(_APPROACH * max(before, soft) / (before - after))
    way = minus(goal, x)
    if inner(way, way) <= (before + after) ** 2:
        return 1.0
    middle, v0, v1 = between(x, goal, 0.5), load3(block, at.v, i), load3(block, at.new_v, i)
    middle = plus_scaled(middle, 0.125 * block[at.dt * LANES + i], minus(v0, v1))
    host, _, patch, _ = walk(flow, s.host[i], x, t, middle, 0.5 * (t + t_end))
    if patch == -2:
        return 0.0
    between_both, _, _ = gap_of_lane(flow, block, i, host, middle, F, 0.5 * (t + t_end))
    return 1.0 if between_both >= min(least, LEAST_OF_GAP * after) - _SOFT * R else 0.5 * _APPROACH


def would_stick(flow: object, patches: PatchTable, s: Scratch, i: int, goal: Vector, ahead: int) -> bool:
    """Return True if the centre in lane i would meet a patch to which it sticks on its way to the goal."""
    t = s.block[at.t * LANES + i]
    t_end = t + s.block[at.dt * LANES + i]
    _, _, patch, _ = walk_on(flow, s.host[i], ahead, load3(s.block, at.x, i), t, goal, t_end)
    return bool(patch >= 0 and patches.code[patch] == STICK)


def clearance_of(flow: object, s: Scratch, i: int, t: float) -> tuple[float, int, int]:
    """Return the gap between the body in lane i and the walls at t, m, and the nearest patch and triangle.

    Where walls are listed, a gap of at least :data:`NEAR` radii at rest is infinite, with −1 and −1: it does
    not depend on the reach of the lists.
    """
    block = s.block
    R, F = block[at.R * LANES + i], load9(block, at.F, i)
    if SEEN * block[at.length * LANES + i] > s.bounds.reach:
        if s.bounds.reach_grows:
            s.outgrown[0] = UNLISTED
        else:
            fail(s, i, WALLS_TOO_MANY)
    x = load3(block, at.x, i)
    clearance, patch, triangle = gap_of_lane(flow, block, i, s.host[i], x, F, t)
    if clearance >= NEAR * R and s.bounds.reach < math.inf:
        return math.inf, -1, -1
    return clearance, patch, triangle


def renew_clearance(flow: object, s: Scratch, i: int) -> None:
    """Store the gap between the body in lane i and the walls at its time."""
    s.block[at.clearance * LANES + i], _, _ = clearance_of(flow, s, i, s.block[at.t * LANES + i])


@separate
def cross_patch(
    flow: object, s: Scratch, i: int, patch: int, code: int, triangle: int, t: float, x0: Vector, x1: Vector
) -> tuple[Vector, Vector, Tensor, Vector]:
    """Move the particle in lane i to the other side of a mirror or a coupled patch.

    It meets the patch at x0 on its way to x1, at the time t. All its vectors and tensors are mirrored or
    turned. At a coupled patch the states before and after are recorded.

    Returns
    -------
    x0, x1, turn, shift
        Both points as seen from the other side; what was done to them, x → turn·x + shift.
    """
    block = s.block
    v = load3(block, at.v, i)
    if code == MIRROR:
        y0, turn = x0, mirror_body(block, i, normal(flow, triangle, x0, t))
    else:
        record_contact(s, i, patch, t, x0, _NO_NORMAL)
        host, y0, turn = cross(flow, triangle, x0, t)
        s.host[i] = host
        turn_body(block, i, turn, load9(block, at.F, i), load9(block, at.A, i))
        store9(block, at.frame, i, dot(load9(block, at.frame, i), transpose(turn)))
    store3(block, at.v, i, dot_vector(turn, v))
    turn_along(block, i, turn)
    if code != MIRROR:
        record_contact(s, i, patch, t, y0, _NO_NORMAL)
    note_passage(s, i, code != MIRROR, t, x0, y0)
    shift = minus(y0, dot_vector(turn, x0))
    return y0, moved(turn, shift, x1), turn, shift


@slot
def mirror_memory(_block: Block, _i: int, _turn: Tensor) -> None:
    """No-op: the solid has no memory."""


def mirror_body(block: Block, i: int, n: Vector) -> Tensor:
    """Mirror the shape of lane i in a plane of normal n; return the reflection."""
    turn = (
        1.0 - 2.0 * n[0] * n[0], -2.0 * n[0] * n[1], -2.0 * n[0] * n[2],
        -2.0 * n[0] * n[1], 1.0 - 2.0 * n[1] * n[1], -2.0 * n[1] * n[2],
        -2.0 * n[0] * n[2], -2.0 * n[1] * n[2], 1.0 - 2.0 * n[2] * n[2],
    )  # fmt: skip
    # The state at rest is mirrored too, and one axis reversed: J and det Q stay positive.
    turn_body(block, i, turn, dot(load9(block, at.F, i), turn), dot(load9(block, at.A, i), turn))
    Q = dot(load9(block, at.frame, i), turn)
    store9(block, at.M, i, dot(turn, dot(load9(block, at.M, i), turn)))
    store9(block, at.F0, i, dot(turn, dot(load9(block, at.F0, i), turn)))
    mirror_memory(block, i, turn)
    block[at.mirrored * LANES + i] = 1.0
    store9(block, at.frame, i, (Q[0], Q[1], Q[2], Q[3], Q[4], Q[5], -Q[6], -Q[7], -Q[8]))
    return turn


def turn_body(block: Block, i: int, turn: Tensor, F: Tensor, A: Tensor) -> None:
    """Store turn·F and turn·A in lane i."""
    store9(block, at.F, i, dot(turn, F))
    store9(block, at.A, i, dot(turn, A))
    block[at.renewed * LANES + i] = 1.0


def moved(turn: Tensor, shift: Vector, x: Vector) -> Vector:
    """Return turn·x + shift."""
    return plus(dot_vector(turn, x), shift)


@separate
def last_inside(flow: object, x0: Vector, x1: Vector, t: float) -> tuple[int, float]:
    """Return the host of the last point from x0 to x1 that the tree finds, −1 for none, and its fraction.

    ``t`` is the time of the mesh, s.
    """
    host = recover(flow, x1, t)
    if host >= 0:
        return host, 1.0
    host, low, high = recover(flow, x0, t), 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        inside = recover(flow, between(x0, x1, middle), t)
        if inside >= 0:
            host, low = inside, middle
        else:
            high = middle
    return host, low


def move_centre(
    flow: object, patches: PatchTable, s: Scratch, i: int, goal: Vector, ahead: int, held: bool, dt: float
) -> tuple[Vector, Vector, Vector, float, int, int, int]:
    """Move the centre towards its goal in Δt, through the mesh, to the patch that ends its way.

    A failed walk restarts from the last point on its way that the tree finds in the mesh. If it fails again,
    the centre stays there for the rest of the step. In the gap between two coupled patches that are cut into
    different faces the centre goes on and keeps its host. ``ahead`` and ``held`` are as in :func:`reach_end`.

    Returns
    -------
    The final position, the start and the goal as seen from there, the time of the motion, the patch
    and the triangle at which the particle bounces, −1 for none, and the number of walks that needed the tree.
    """
    block = s.block
    recovered, bounces, stalls, last, before = 0, 0, 0, -1, -1
    t, spent = block[at.t * LANES + i], 0.0
    x0, x1 = load3(block, at.x, i), goal
    start = x0
    if held:
        s.host[i] = ahead
        return x1, start, x1, dt, -1, -1, recovered
    for _ in range(_MAX_PATCHES):
        remaining = dt - spent
        host, fraction, patch, triangle = walk_on(flow, s.host[i], ahead, x0, t + spent, x1, t + dt)
        if patch == -2:
            recovered += 1
            host, done = last_inside(flow, x0, x1, t + dt)
            if host < 0:
                fail(s, i, LOST)
                return x1, start, x1, dt, -1, -1, recovered
            s.host[i] = host
            if done >= 1.0:
                return x1, start, x1, dt, -1, -1, recovered
            x0 = between(x0, x1, done)
            spent += done * remaining
            remaining = dt - spent
            host, fraction, patch, triangle = walk(flow, s.host[i], x0, t + spent, x1, t + dt)
            if patch == -2:
                return x0, start, x0, dt, -1, -1, recovered
        s.host[i] = host
        if patch == -1:
            return x1, start, x1, dt, -1, -1, recovered
        x0 = between(x0, x1, fraction)
        code = patches.code[patch]
        if code == REBOUND:
            return x0, start, x1, dt, patch, triangle, recovered
        stalls = stalls + 1 if code == CYCLIC and fraction < _STALL else 0
        if stalls >= 2 and patch == before != last:
            # Between two surfaces that are cut into different faces neither side leads on at once.
            return x1, start, x1, dt, -1, -1, recovered
        last, before = patch, last
        spent += fraction * remaining
        if code in (STICK, ESCAPE):
            settle(s, i, patch, code)
            return x0, start, x0, spent, -1, -1, recovered
        bounces += code != CYCLIC
        if bounces > _MAX_BOUNCES:
            break
        x0, x1, turn, shift = cross_patch(flow, s, i, patch, code, triangle, t + spent, x0, x1)
        start, ahead = moved(turn, shift, start), s.host[i]
    return x0, start, x0, dt, -1, -1, recovered


@separate
def move_back(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    t: float,
    x0: Vector,
    x1: Vector,
    undone: float = 0.0,
) -> tuple[Vector, bool]:
    """Move the centre from x0 back to x1 at the time t, through mirrors and coupled patches.

    A wall from which bodies rebound undoes the way into it, ``undone`` 1, or mirrors it, 2. A patch of
    another kind that lies between, by round-off, does not stop the centre. Returns the place, and whether the
    centre went there.
    """
    for _ in range(_MAX_BOUNCES):
        host, fraction, patch, triangle = walk(flow, s.host[i], x0, t, x1, t)
        if patch == -2:
            return x0, False
        s.host[i] = host
        if patch < 0:
            return x1, True
        code, y = patches.code[patch], between(x0, x1, fraction)
        if code in (MIRROR, CYCLIC):
            x0, x1, _, _ = cross_patch(flow, s, i, patch, code, triangle, t, y, x1)
            continue
        n = normal(flow, triangle, y, t)
        into = inner(minus(x1, y), n)
        if code != REBOUND or undone == 0.0 or into >= 0.0:
            return x1, True
        bounce_along(s.block, i, n)
        x0, x1 = plus_scaled(y, -_OFF_WALL * into, n), plus_scaled(x1, -undone * into, n)
    return x0, True


def touch(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    way: tuple[Vector, Vector],
    turned: bool,
    met: tuple[int, int],
    t: float,
    h: float,
) -> float:
    """Apply contact of the ellipsoid with walls, after its centre moved to its new position.

    Parameters
    ----------
    way
        Start and goal of the centre.
    turned
        Whether the centre went through a mirror or a coupled patch.
    met
        Patch and triangle at which the centre met a wall before the goal; −1 if it did not.
    t, h
        When it went, and how long it takes to the goal, s.

    Returns
    -------
    The fraction of the way after which the particle stopped or bounced, 1 if it did neither.
    """
    block = s.block
    before = block[at.clearance * LANES + i]
    if met[0] >= 0:
        f = meet_wall(flow, patches, s, i, way, turned, met, before, -math.inf, t, h)
        if f == 1.0:
            form_bond(flow, patches, s, i, met[0], t + h, h)
        return f
    after, patch, triangle = clearance_of(flow, s, i, t + h)
    block[at.clearance * LANES + i] = after
    rests = TOUCH * block[at.R * LANES + i]
    held = patch >= 0 and patches.code[patch] == REBOUND and carries_reaction(block, i)
    if after > 0.0 and not held:
        if after <= rests and before <= rests:
            form_bond(flow, patches, s, i, patch, t + h, h)
        return 1.0
    if patches.code[patch] != STICK:
        if s.status[i] == STUCK:
            return 1.0
        f = meet_wall(flow, patches, s, i, way, turned, (patch, triangle), before, after, t, h)
        if f == 1.0:
            share = 1.0 if before <= rests else after / (after - before) if before < math.inf else 0.0
            form_bond(flow, patches, s, i, patch, t + h, share * h)
        return f
    x = load3(block, at.x, i)
    f = 0.0
    if before > 0.0:
        f = before / (before - after) if before < math.inf else 1.0
    contact, _ = move_back(flow, patches, s, i, t + h, x, between(way[0], x, f))
    store3(block, at.x, i, contact)
    settle(s, i, patch, STICK)
    return f


@separate
def meet_wall(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    way: tuple[Vector, Vector],
    turned: bool,
    met: tuple[int, int],
    before: float,
    after: float,
    t: float,
    h: float,
) -> float:
    """Let the body in lane i bounce off a wall, or slide along it.

    A body with inertia bounces where and when it meets the wall on the cubic through both ends of its way. A
    body in contact at both ends slides, and so does one without inertia: its motion into the wall is undone.

    Parameters
    ----------
    As in :func:`touch`, with the patch and triangle of the wall, and
    before, after
        Gap at the start and at the goal, m; the latter −∞ if the centre met the wall.

    Returns
    -------
    The fraction of the way after which it bounced, 1 if it slides.
    """
    block, (start, goal), (patch, triangle) = s.block, way, met
    x, R = load3(block, at.x, i), block[at.R * LANES + i]
    bouncing = s.switches.bouncing
    n, W = normal(flow, triangle, x, t + h), wall_velocity(flow, triangle, x, t + h)
    fall = inner(minus(goal, start), n) - h * inner(W, n)
    reflected = s.switches.reflects_steps > 0
    through = after == -math.inf
    if through:
        F = load9(block, at.F, i)
        room, _, _ = gap_of_lane(flow, block, i, s.host[i], x, F, t + h)
        # Infinite for a body that is a point to walls.
        reflected = reflected or room == math.inf
        after = min(0.0, (room if room < math.inf else 0.0) + inner(minus(goal, x), n))
    if before == math.inf or after - fall > before + _OTHER_WALL * R:
        before = after - fall
    # A step that ended on the wall, by chance, was no contact: a body at rest has no speed towards the wall.
    came, towards = approach(block, i, n)
    came, towards = came - inner(W, n), towards - inner(W, n)
    flew = came < 0.5 * min(towards, 0.0) and (fall < -_CAME * R or before > TOUCH * R)
    rests = before <= TOUCH * R or (bouncing > 0 and before <= _CAME * R and not flew)
    if bouncing > 0 and not turned and (flew or not rests):
        return bounce(flow, patches, s, i, way, met, n, before, after, t, h)
    f = before / (before - after) if before > 0.0 >= after else 0.0
    if not rests:
        record_contact(s, i, patch, t + f * h, between(start, goal, f), n)
    e = 0.0 if rests and bouncing > 0 else patches.e[patch]
    # Without inertia friction acts on the way.
    mu = patches.mu[patch] if bouncing > 0 else 0.0
    redirect(block, i, n, W, e, mu, rests)
    bounce_along(block, i, n)
    undone = 2.0 if reflected else 1.0
    if through:
        goal = plus_scaled(goal, -(1.0 - f) * min(fall, 0.0) * undone, n)
    else:
        goal = push_out(block, i, n, goal, -after * undone, patches.mu[patch], W)
    x = plus_scaled(x, -_OFF_WALL * min(fall, 0.0), n) if through else x
    for _ in range(_MAX_BOUNCES):
        place, went = move_back(flow, patches, s, i, t + h, x, goal, undone)
        if not went:
            break
        store3(block, at.x, i, place)
        into, patch, triangle = clearance_of(flow, s, i, t + h)
        block[at.clearance * LANES + i] = into
        if abs(into) <= TOUCH * R or patch < 0 or patches.code[patch] != REBOUND:
            break
        x, n = place, normal(flow, triangle, place, t + h)
        if into > 0.0 and (reflected or reaction_on(block, i, n) == 0.0):
            break
        bounce_along(block, i, n)
        goal = push_out(block, i, n, x, -into, 0.0, W)
    return 1.0


def bounce(
    flow: object,
    patches: PatchTable,
    s: Scratch,
    i: int,
    way: tuple[Vector, Vector],
    met: tuple[int, int],
    n: Vector,
    before: float,
    after: float,
    t: float,
    h: float,
) -> float:
    """Let the body in lane i bounce off a wall of normal n; return after which fraction of the way it does.

    The other parameters are as in :func:`meet_wall`. If the step goes on, ``new_x`` is its new goal, ``v``
    the velocity there, and ``new_v`` that after the contact.
    """
    block, (start, goal), (patch, triangle) = s.block, way, met
    d, bouncing = minus(goal, start), s.switches.bouncing
    v0, v1 = load3(block, at.new_v, i), load3(block, at.v, i)
    # Euler's steps lie on parabolas, whose slopes exceed the velocities by o.
    p, q = (0.5, 1.0 / h) if bouncing == GOES_ON else (0.0, 0.0)
    o = (q * d[0] - p * (v0[0] + v1[0]), q * d[1] - p * (v0[1] + v1[1]), q * d[2] - p * (v0[2] + v1[2]))
    a, b = minus(scale_vector(h, plus(v0, o)), d), minus(scale_vector(h, plus(v1, o)), d)
    f = first_contact(before, after, inner(a, n), inner(b, n))
    place = (
        start[0] + on_cubic(f, d[0], a[0], b[0]),
        start[1] + on_cubic(f, d[1], a[1], b[1]),
        start[2] + on_cubic(f, d[2], a[2], b[2]),
    )
    v = (
        slope_on_cubic(f, d[0], a[0], b[0]) / h,
        slope_on_cubic(f, d[1], a[1], b[1]) / h,
        slope_on_cubic(f, d[2], a[2], b[2]) / h,
    )
    store3(block, at.v, i, v)
    rewind(block, i, f)
    record_contact(s, i, patch, t + f * h, place, n)
    W = wall_velocity(flow, triangle, place, t + f * h)
    redirect(block, i, n, W, patches.e[patch], patches.mu[patch], False)
    v = load3(block, at.v, i)
    bounce_along(block, i, n)
    x, _ = move_back(flow, patches, s, i, t + f * h, load3(block, at.x, i), place)
    store3(block, at.x, i, x)
    block[at.clearance * LANES + i], _, _ = clearance_of(flow, s, i, t + f * h)
    if bouncing == GOES_ON:
        g, r = 1.0 - f, (1.0 - f) * h
        dv = scale_vector(g, minus(v1, v0))
        store3(block, at.new_x, i, plus_scaled(x, r, plus_scaled(v, 0.5, dv)))
        v = minus(v, o)
        store3(block, at.new_v, i, v)
        v = plus(v, dv)
    store3(block, at.v, i, v)
    return f


def release(flow: object, patches: PatchTable, s: Scratch, i: int) -> None:
    """Make a pending particle active, or stuck if it starts in contact with a sticky wall."""
    block = s.block
    s.status[i] = ACTIVE
    t = block[at.t * LANES + i] = block[at.t0 * LANES + i]
    block[at.renewed * LANES + i] = 1.0
    if math.isnan(block[at.v * LANES + i]):
        u, _, _ = sample(flow, s.host[i], load3(block, at.x, i), t)
        store3(block, at.v, i, u)
    clearance, patch, _ = clearance_of(flow, s, i, t)
    block[at.clearance * LANES + i] = clearance
    if clearance <= 0.0 and patches.code[patch] == STICK:
        settle(s, i, patch, STICK)


def is_sound(s: Scratch, i: int) -> bool:
    """Return True if the new shape in lane i was accepted; else end the particle."""
    verdict = int(s.block[at.verdict * LANES + i])
    if verdict >= _CODE:
        conclude(s, i, verdict)
    elif verdict:
        fail(s, i, verdict)
    return verdict == 0


def longest_now(p: Particles, k: int) -> float:
    """Return an upper bound of the longest semi-axis of particle k, m; 0 if it has ended."""
    if p.status[k] > ACTIVE:
        return 0.0
    f = p.F
    F = (f[k, 0], f[k, 1], f[k, 2], f[k, 3], f[k, 4], f[k, 5], f[k, 6], f[k, 7], f[k, 8])
    return float(p.R[k] * longest_stretch(F))


def longest_of(p: Particles) -> float:
    """Return the maximum of :func:`longest_now`."""
    longest = 0.0
    for k in range(len(p.status)):
        longest = max(longest, longest_now(p, k))
    return longest
