"""Loop of the integrators of order 3(2), with error-controlled steps of each particle.

A tracking step Δt, or a stretch of them, is divided into steps h as the tolerance requires. The step size is
a part of a particle's state. All lanes of a block go through the same operations.

A step evaluates the body's equations at its start, at a quarter of it, and for the lanes that need order 3
at its end. The flow is sampled at the start, at the end, and in the middle if the third evaluation is made,
or if the mesh, and not the given tolerance, limits the steps: then the path uses the velocity there, too.

The slots :func:`predict`, :func:`first_slope`, :func:`second_slope`, :func:`last_argument`,
:func:`third_slope`, :func:`correct_path` and :func:`end_slope` are the stages of the integrator.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import Annotated, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.choice import choice
from foamprb.body.error_control import (
    REUSE_FOR,
    chord_error,
    largest,
    longest_step,
    measured_ratio,
    next_size,
    path_factor,
    share_of_slope,
    step_factor,
)
from foamprb.body.exponential_runge_kutta import NODE
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    dot_vector,
    minus,
    norm,
    plus,
    plus_scaled,
    scale,
    scale_vector,
    select,
)
from foamprb.cloud.block import (
    Ints,
    Medium,
    Scratch,
    accept_stage,
    at,
    choose,
    limit_next_step,
    load3,
    load9,
    new_frames,
    new_integrals,
    store3,
    store9,
    store_fluid,
)
from foamprb.cloud.integrators.base import (
    apply_surroundings,
    held_for,
    look_ahead,
    resolved_share,
    update_surroundings,
)
from foamprb.cloud.lanes import (
    ENDED,
    READY,
    begin_lanes,
    drop_unfinished,
    fill_lanes,
    leave,
    must_move,
    pause,
    set_aside,
    take_back,
    walks_relocated,
)
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import (
    ACTIVE,
    SHORTEST_STEP,
    PatchTable,
    end_block,
    end_tracking_steps,
    fail_small_step,
    interrupted,
    is_sound,
    overspent,
    reach_end,
    share_before_contact,
    would_stick,
)
from foamprb.cloud.paths import is_full, record_ends, record_starts
from foamprb.cloud.state import Particles
from foamprb.compile.link import Function, kernel, separate, slot, traced
from foamprb.flow.kernels import inlined, sample

_LAST_STEP = 1.0 / 4096.0
"""Longest step, in Δt, of a centre onto a patch to which it sticks."""


class StepRows(NamedTuple):
    """Rows of every integrator of this loop: the flow at three times, and two errors."""

    start_Q: Annotated[int, Row(9, "1", "particle frame at the start of the step")]
    second_Q: Annotated[int, Row(9, "1", "particle frame at the second evaluation")]
    start_u: Annotated[int, Row(3, "m/s", "velocity of the fluid at the start, as the flow has it")]
    start_l: Annotated[int, Row(9, "1/s", "its gradient there")]
    start_a: Annotated[int, Row(3, "m/s2", "acceleration ∂u/∂t + l·v at the start")]
    start_v: Annotated[int, Row(3, "m/s", "velocity of the barycentre at the start")]
    middle_l: Annotated[int, Row(9, "1/s", "velocity gradient of the fluid in the middle of the step")]
    middle_u: Annotated[int, Row(3, "m/s", "its velocity there, where the path uses it")]
    end_l: Annotated[int, Row(9, "1/s", "velocity gradient of the fluid at the end")]
    end_u: Annotated[int, Row(3, "m/s", "velocity of the fluid at the end")]
    end_ut: Annotated[int, Row(3, "m/s2", "∂u/∂t at the end")]
    third: Annotated[int, Row(1, "", "1 where the step goes to order 3, else 0")]
    discount: Annotated[
        int, Row(1, "1", "share of ``error_2`` that does not count", of="discount", saved=True)
    ]
    demanding: Annotated[
        int, Row(1, "", "1 where steps like the last one go to order 3, else 0", of="demanding", saved=True)
    ]
    error_2: Annotated[int, Row(1, "1", "error estimate of order 2: θ δ₁, with the part of the fluid")]
    disturbed: Annotated[int, Row(1, "", "1 where the gradient that is felt is not the flow's, else 0")]
    difference: Annotated[int, Row(1, "1", "difference of the solutions of order 2 and 3")]
    path: Annotated[int, Row(1, "1", "error of the path over its length")]
    by_path: Annotated[int, Row(1, "1", "length of the next step over that of this one, by that error")]
    remaining: Annotated[int, Row(1, "s", "time to the next given end of a step", 1.0)]
    held_from: Annotated[int, Row(1, "", "tracking step in which its random numbers begin", lasting=True)]
    held_until: Annotated[int, Row(1, "", "tracking step before which they end", -1.0, lasting=True)]
    again: Annotated[int, Row(1, "", "1 after a step whose error was too large, else 0", lasting=True)]
    ahead: Annotated[int, Row(3, "m", "where the step was to lead when its end was sampled")]
    entered: Annotated[int, Row(1, "", "number of cells that the way there enters")]
    room: Annotated[int, Row(1, "m", "how far off its end may be, along each axis, in the same host")]


during = offsets(StepRows)

_SMALLEST = 1e-9
"""Smallest step allowed, over Δt."""
SHARE_OF_MEMORY = 4.0
"""Longest step over the shortest relaxation time of a solid with memory."""
_STRETCH = 4
"""Length of a stretch over ``maxDeltaT``. Rounding to whole steps then costs little."""
LEAST_STRETCH, _LONGEST_STRETCH = 32, 2**14
"""Length of a stretch in tracking steps, where steps may be of any length."""
_SHARE_OF_TIME = 3.0
"""Largest length of such a stretch over the time scale of the flow, if that is more than the least one."""
CELLS, MOST_CELLS = 2, 3
"""Cells that a step longer than Δt aims to enter, and enters at most: the flow is not sampled between."""


@choice
def drag_rate(block: Block, i: int, mu_f: float, k: Vector) -> Vector:
    """Return μ_f K_a/m, 1/s, with K_a in units of R; by default of a solid."""
    return drag_rate_of_solid(block, i, mu_f, k)


def drag_rate_of_solid(block: Block, i: int, mu_f: float, k: Vector) -> Vector:
    """Return the same of a solid."""
    return scale_vector(mu_f * (3.0 / (20.0 * math.pi)) * block[at.inertia * LANES + i], k)


@choice
def fluid_acceleration(block: Block, i: int, v: Vector) -> Vector:
    """Return ∂u/∂t + l·v, m/s², of the flow at the start of the step along a path of velocity v."""
    w = minus(v, load3(block, during.start_u, i))
    return plus(load3(block, at.DuDt, i), dot_vector(load9(block, during.start_l, i), w))


def acceleration_at_end(block: Block, i: int, v: Vector) -> Vector:
    """Return ∂u/∂t + l·v, m/s², of the flow at the end of the step along a path of velocity v."""
    return plus(load3(block, during.end_ut, i), dot_vector(load9(block, during.end_l, i), v))


@choice
def end_acceleration(block: Block, i: int) -> Vector:
    """Return Du/Dt of the fluid at the end of the step, m/s²."""
    return acceleration_at_end(block, i, load3(block, during.end_u, i))


def finish_path(block: Block, i: int, v: Vector) -> None:
    """Store the velocity v at the end of the step, m/s, the position there, and the error of the path.

    The position is that of Hermite's cubic, x + h/2 (v₀ + v) + h²/12 (a₀ − a); its last term is the error.
    """
    h = block[at.dt * LANES + i]
    x, v0, a0 = load3(block, at.x, i), load3(block, during.start_v, i), load3(block, during.start_a, i)
    a = acceleration_at_end(block, i, v)
    f, g = 0.5 * h, h * h * (1.0 / 12.0)
    store3(block, at.new_x, i, plus_scaled(plus_scaled(x, f, plus(v0, v)), g, minus(a0, a)))
    store3(block, at.new_v, i, v)
    store_path_error(block, i, chord_error(h, h * norm(v0) + block[at.R * LANES + i], a0, a))


def place_after(block: Block, i: int, h: Scalar, v: Vector, a: Vector) -> Vector:
    """Return the position after a time h, s, from the start of the step with v and a constant a."""
    return plus_scaled(plus_scaled(load3(block, at.x, i), h, v), 0.5 * h * h, a)


def add_disturbance_error(block: Block, i: int, d: Vector, dv: Vector) -> None:
    """Add the error of the path by a disturbance of the velocity to the error of the step.

    Parameters
    ----------
    d
        What the surroundings add to the flow's velocity at the start of the step, m/s.
    dv
        Change of that and of the slip over the step, by the slope in its first quarter. Where it is of the
        size of d, it is hardly linear.
    """
    h, change = block[at.dt * LANES + i], norm(dv)
    way = h * norm(load3(block, during.start_v, i)) + block[at.R * LANES + i]
    error = h * (1.0 / 12.0) * change * change / ((norm(d) + change + 1e-300) * way)
    store_path_error(block, i, block[during.path * LANES + i] + select(norm(d) > 0.0, error, 0.0))


def store_path_error(block: Block, i: int, error: Scalar) -> None:
    """Store the error of the path, which is the first part of the step's error."""
    block[during.path * LANES + i] = error
    block[during.difference * LANES + i] = 0.0
    block[at.error * LANES + i] = error


def judge_difference(block: Block, i: int, difference: Scalar, tolerance: float) -> None:
    """Store δ₂, and δ₂⁴/tolerance² as error of the step: it exceeds the tolerance where δ₂^(4/3) does."""
    block[during.difference * LANES + i] = difference
    square = difference * difference
    error = square * square * (1.0 / (tolerance * tolerance + 1e-300))
    block[at.error * LANES + i] = np.maximum(block[during.path * LANES + i], error)


def mark_disturbed(block: Block, i: int) -> None:
    """Store whether models of the surroundings change the fluid's gradient at the start of the step."""
    l, felt = load9(block, during.start_l, i), load9(block, at.l, i)
    off = largest(add(felt, scale(-1.0, l)))
    block[during.disturbed * LANES + i] = select(off > 0.0, 1.0, 0.0)


def error_share(block: Block, i: int, rho: Scalar) -> Scalar:
    """Return θ of :mod:`foamprb.body.error_control`; 1 where models of the surroundings change the gradient.

    They may change it faster than elasticity and the flow do. ``rho`` is the rate at which the elastic stress
    relaxes, 1/s.
    """
    rho = rho + block[at.fading * LANES + i]
    theta = share_of_slope(block[at.dt * LANES + i], rho, load9(block, during.start_l, i))
    return select(block[during.disturbed * LANES + i] > 0.0, 1.0, theta)


def counted_error(block: Block, i: int, error_2: Scalar) -> Scalar:
    """Return the part of θ δ₁ that counts as error of order 2: all of it where ``disturbed`` is 1."""
    block[during.error_2 * LANES + i] = error_2
    discount = select(block[during.disturbed * LANES + i] > 0.0, 0.0, block[during.discount * LANES + i])
    return (1.0 - discount) * error_2


def choose_order(block: Block, i: int, error: Scalar, tolerance: float) -> None:
    """Store whether the step goes to order 3: where the error of order 2 exceeds the tolerance."""
    third = select(error <= tolerance, 0.0, 1.0)
    block[during.third * LANES + i] = third
    # A finished lane still goes through the stages before it is saved.
    moving = block[at.moving * LANES + i] > 0.0
    block[during.demanding * LANES + i] = select(moving, third, block[during.demanding * LANES + i])


def update_discount(block: Block, i: int, third: Scalar, difference: Scalar, tolerance: float) -> None:
    """Store the discount of the next errors of order 2, where a step has gone to order 3 with δ₂."""
    error_2 = block[during.error_2 * LANES + i]
    share = measured_ratio(difference, error_2)
    measured = third & (block[at.moving * LANES + i] > 0.0)
    block[during.discount * LANES + i] = select(measured, 1.0 - share, block[during.discount * LANES + i])
    accepts_2 = measured & (counted_error(block, i, error_2) <= tolerance)
    block[during.demanding * LANES + i] = select(accepts_2, 0.0, block[during.demanding * LANES + i])


def keep_frame(block: Block, i: int, third: Scalar) -> None:
    """Restore the frame of the second evaluation where lane i does not use the third."""
    Q, second = load9(block, at.Q, i), load9(block, during.second_Q, i)
    store9(block, at.Q, i, choose(third, Q, second))


@slot
def predict(_block: Block, _medium: Medium) -> None:
    """Compute what :func:`sample_ahead` needs of the step."""


@slot
def first_slope(_block: Block, _medium: Medium) -> None:
    """Compute the state at the start, and at a quarter of the step."""


@slot
def second_slope(_block: Block, _medium: Medium, _tolerance: float) -> None:
    """Compute the solution of order 2, and choose the order."""


@slot
def last_argument(_block: Block, _medium: Medium) -> None:
    """Compute the state for the evaluation at the end, in lanes of order 3."""


@slot
def third_slope(_block: Block, _medium: Medium, _tolerance: float) -> None:
    """Compute the solution of order 3."""


@slot
def correct_path(_block: Block) -> None:
    """Correct position and velocity at the end of the step by the fluid's velocity in the middle."""


@slot
def find_reactions(_flow: object, _patches: PatchTable, _s: Scratch, _medium: Medium, _share: float) -> int:
    """Return 0: no body carries reactions of walls through a step."""
    return 0


@slot
def apply_reactions(_block: Block) -> None:
    """No-op: there are none."""


@slot
def end_slope(_block: Block, _medium: Medium) -> None:
    """Compute the rates at the ends of calls."""


@traced
def begin_stage(block: Block) -> None:
    """Start a step with the fluid as sampled: ``start_u``, ``start_l``, and ∂u/∂t in the rows of Du/Dt."""
    for i in range(LANES):
        l = load9(block, during.start_l, i)
        store_fluid(block, i, load3(block, during.start_u, i), l, load3(block, at.DuDt, i))
        store9(block, at.new_F, i, load9(block, at.F, i))
        block[at.gone * LANES + i] = 0.0


def limit_by_path(block: Block, i: int, tolerance: float) -> None:
    """Store the length of the next step of lane i that the error of the path allows."""
    block[during.by_path * LANES + i] = path_factor(block[during.path * LANES + i], tolerance)


ADAPTIVE: dict[Function, Function] = {limit_next_step: limit_by_path}
"""What every integrator of this loop puts behind slots."""


def evaluate_shape(block: Block, medium: Medium, share: float, passed: float) -> None:
    """Compute frame, stretches and integrals of the shape in the block, and apply the surroundings.

    It precedes each slope; ``share`` is the part of the way to new_x that the body has gone, and ``passed``
    that of the time of the step.
    """
    for i in range(LANES):
        block[at.passed * LANES + i] = passed
    new_frames(block)
    new_integrals(block)
    apply_surroundings(block, medium, share)


@kernel
def sample_starts(_flow: object, _block: Block, _hosts: object) -> None:
    """Store the flow where the steps of the moving lanes start."""


@kernel
def sample_ends(_flow: object, _block: Block, _hosts: object, _ahead: object) -> None:
    """Store the flow at the ends of the steps of the moving lanes, and the hosts there."""


@kernel
def sample_middles(_flow: object, _block: Block, _hosts: object, _every: bool) -> None:
    """Store the fluid's gradient half-way on the steps of order 3; on every step also the velocity."""


def _starts_by(sample: Function) -> Function:
    def sample_starts(flow: object, block: Block, hosts: Ints) -> None:
        for i in range(LANES):
            if block[at.moving * LANES + i] > 0.0:
                u, l_f, u_t = sample(flow, hosts[i], load3(block, at.x, i), block[at.t * LANES + i])
                store3(block, during.start_u, i, u)
                store9(block, during.start_l, i, l_f)
                store3(block, at.DuDt, i, u_t)

    return sample_starts


def _ends_by(sample_ahead: Function) -> Function:
    def sample_ends(flow: object, block: Block, hosts: Ints, ahead: Ints) -> None:
        for i in range(LANES):
            if block[at.moving * LANES + i] > 0.0:
                x, goal, t = load3(block, at.x, i), load3(block, at.new_x, i), block[at.t * LANES + i]
                t_end = t + block[at.dt * LANES + i]
                ahead[i], room, entered, u, l_f, u_t = sample_ahead(flow, hosts[i], x, t, goal, t_end)
                store3(block, during.ahead, i, goal)
                block[during.room * LANES + i] = room
                block[during.entered * LANES + i] = entered
                store3(block, during.end_u, i, u)
                store9(block, during.end_l, i, l_f)
                store3(block, during.end_ut, i, u_t)

    return sample_ends


def _steps_by(parabola: Function) -> Function:
    def sample_ends(flow: object, block: Block, hosts: Ints, ahead: Ints) -> None:
        """Store the gradient over whole steps, which may end earlier; nothing moves."""
        for i in range(LANES):
            if block[at.moving * LANES + i] > 0.0:
                t, size, h = block[at.t * LANES + i], block[at.dt * LANES + i], block[at.h * LANES + i]
                t_end, most, start, middle, end = parabola(flow, hosts[i], t, t + size)
                ahead[i] = hosts[i]
                block[at.dt * LANES + i], block[at.h * LANES + i] = t_end - t, min(h, most)
                added = add(load9(block, at.l, i), scale(-1.0, load9(block, during.start_l, i)))
                store9(block, at.l, i, add(added, start))
                store9(block, during.start_l, i, start)
                store9(block, during.middle_l, i, middle)
                store9(block, during.end_l, i, end)
                block[during.room * LANES + i], block[during.entered * LANES + i] = math.inf, 0.0
                store3(block, during.end_u, i, (0.0, 0.0, 0.0))
                store3(block, during.end_ut, i, (0.0, 0.0, 0.0))
                store3(block, during.ahead, i, load3(block, at.new_x, i))

    return sample_ends


def _middles_by(sample_ahead: Function) -> Function:
    def sample_middles(flow: object, block: Block, hosts: Ints, every: bool) -> None:
        for i in range(LANES):
            if needs_third(block, i) or (every and block[at.moving * LANES + i] > 0.0):
                half, t = 0.5 * block[at.dt * LANES + i], block[at.t * LANES + i]
                v, a = load3(block, during.start_v, i), load3(block, during.start_a, i)
                place = place_after(block, i, half, v, a)
                x = load3(block, at.x, i)
                _, _, _, u, l_f, _ = sample_ahead(flow, hosts[i], x, t, place, t + half)
                store9(block, during.middle_l, i, l_f)
                if every:
                    store3(block, during.middle_u, i, u)

    return sample_middles


def sampling(kernels: Mapping[str, Function]) -> dict[Function, Function]:
    """Return the functions behind the slots by which the loop samples a flow, with its kernels inlined."""
    sample, sample_ahead, parabola = inlined(kernels)
    if parabola:
        return {sample_starts: _starts_by(sample), sample_ends: _steps_by(parabola)}
    return {
        sample_starts: _starts_by(sample),
        sample_ends: _ends_by(sample_ahead),
        sample_middles: _middles_by(sample_ahead),
    }


def holds_end(block: Block, i: int, goal: Vector) -> bool:
    """Return True if the host found for the end of the step of lane i certainly holds ``goal``, m."""
    x, room = load3(block, during.ahead, i), block[during.room * LANES + i]
    # A maximum of the three might hide NaN.
    return bool(abs(goal[0] - x[0]) < room and abs(goal[1] - x[1]) < room and abs(goal[2] - x[2]) < room)


def track_adaptive(
    flow: object,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    members: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    start: float,
    scratch: Scratch,
    tolerance: float,
    most: int,
    stretch: int,
) -> int:
    """Advance particles by ``steps`` tracking steps, each with its own steps.

    Parameters
    ----------
    As in :func:`foamprb.cloud.integrators.paper.track_paper`, with any number of members, a block of the
    integrator's rows, and
    tolerance
        Largest error of a step (:mod:`foamprb.body.error_control`), unless the bounds have a larger one.
        Infinite for steps Δt of order 3, limited only by :func:`foamprb.body.error_control.longest_step`.
    most
        Longest step in tracking steps.
    stretch
        Length of a stretch in tracking steps (:func:`stretch_of`): steps of a particle end at its end. Within
        it they start and end anywhere. As stretches start at multiples of their length, steps do not depend
        on calls that start and end there.

    Returns
    -------
    The number of walks that needed the tree; 0 once the table of steps is full, to go on with the same
    ``scratch`` after it was emptied.
    """
    last = step + steps
    rough = scratch.bounds.tolerance > tolerance
    tolerance = scratch.bounds.tolerance if rough else tolerance
    enough = tolerance if tolerance < math.inf else 0.0
    block, current, updates_end = scratch.block, scratch.step, scratch.switches.updates_end
    begin_lanes(scratch, dt)

    while True:
        if is_full(scratch):
            pause(scratch)
            return 0
        moving = 0
        for i in range(LANES):
            moving += must_move(scratch, i, last)
        if moving < LANES:
            moving = fill_lanes(flow, patches, p, members, scratch, step, last, dt, start)
        if interrupted(scratch):
            drop_unfinished(scratch)
            break
        if updates_end > 0 and (moving == 0 or scratch.counts[ENDED] >= LANES) and has_ended(scratch):
            update_ends(flow, patches, medium, p, scratch, last)
            continue
        if moving == 0:
            break

        for i in range(LANES):
            block[at.moving * LANES + i] = 1.0 if must_move(scratch, i, last) else 0.0
        sample_starts(flow, block, scratch.host)
        for i in range(LANES):
            if not block[at.moving * LANES + i] > 0.0:
                continue
            t, l_f = block[at.t * LANES + i], load9(block, during.start_l, i)
            scratch.stride[i] = min((current[i] // stretch + 1) * stretch, last) - current[i]
            block[during.held_until * LANES + i] = next_end(scratch, i, t, dt, start, stretch, medium)
            remaining = start + block[during.held_until * LANES + i] * dt - t
            left = steps_left(block, i, remaining, l_f, dt, most)
            block[during.remaining * LANES + i], block[at.dt * LANES + i] = remaining, remaining / left
            if measures_again(scratch, i, left, stretch):
                block[during.discount * LANES + i] = 0.0
        begin_stage(block)
        update_surroundings(flow, scratch, medium)
        evaluate_shape(block, medium, 0.0, 0.0)
        resting = find_reactions(flow, patches, scratch, medium, 1.0)
        predict(block, medium)
        sample_ends(flow, block, scratch.host, scratch.ahead)
        look_ahead(flow, scratch, medium)
        first_slope(block, medium)
        evaluate_shape(block, medium, 1.0, NODE)
        if resting:
            apply_reactions(block)
        second_slope(block, medium, enough)
        thirds = count_thirds(block)
        if rough or thirds:
            sample_middles(flow, block, scratch.host, rough)
        if thirds:
            last_argument(block, medium)
            evaluate_shape(block, medium, 1.0, 1.0)
            if resting:
                apply_reactions(block)
            third_slope(block, medium, enough)
        if rough:
            correct_path(block)
        if most > 1:
            for i in range(LANES):
                keep_short(flow, patches, medium, scratch, i, dt, tolerance)
        for i in range(LANES):
            approach(flow, patches, scratch, i, dt, tolerance)
        record_starts(scratch)
        accept_stage(block, tolerance)

        for i in range(LANES):
            if not block[at.moving * LANES + i] > 0.0:
                continue
            h, size, t_before = block[at.dt * LANES + i], block[at.h * LANES + i], block[at.t * LANES + i]
            if overspent(scratch, i, (start + (current[i] + scratch.stride[i]) * dt - t_before) / dt):
                continue
            t_end = start + block[during.held_until * LANES + i] * dt
            error = block[at.error * LANES + i]
            third = block[during.third * LANES + i] > 0.0
            difference, by_path = block[during.difference * LANES + i], block[during.by_path * LANES + i]
            factor = step_factor(third, difference, by_path, tolerance)
            if not error <= tolerance:
                block[at.h * LANES + i] = h * factor
                block[during.again * LANES + i] = 1.0
                if h * factor < _SMALLEST * dt:
                    fail_small_step(scratch, i)
                continue
            if not is_sound(scratch, i):
                continue
            allowed = next_size(h, size, factor, block[during.again * LANES + i] > 0.0)
            block[during.again * LANES + i] = 0.0
            t_new = t_before + h
            reaches_end = t_new >= t_end - SHORTEST_STEP * dt
            if reaches_end:
                t_new = t_end
            block[at.h * LANES + i] = min(most * dt, allowed, longest_over_cells(block, i, dt))
            goal = load3(block, at.new_x, i)
            held = holds_end(block, i, goal)
            ahead = scratch.ahead[i]
            scratch.mended[i] += reach_end(flow, patches, scratch, i, goal, ahead, held, t_new, h)
            # A step ends early where a body bounces.
            at_end = reaches_end and (scratch.status[i] != ACTIVE or block[at.t * LANES + i] >= t_end)
            if at_end and block[during.held_until * LANES + i] >= current[i] + scratch.stride[i]:
                end_tracking_steps(scratch, i)
        record_ends(scratch)
    end_block(scratch)
    return walks_relocated(scratch)


def stretch_of(most: int | None) -> int:
    """Return the length of a stretch, for steps of at most ``most`` tracking steps, in tracking steps.

    None for any step returns the least length, see :func:`stretch_in`.
    """
    return LEAST_STRETCH if most is None else 1 if most == 1 else _STRETCH * most


def stretch_in(rate: float, dt: float) -> int:
    """Return the length of a stretch in a flow, where steps may be of any length, in tracking steps.

    It is the least length, or a multiple of it as long as the time scale of the flow allows. Shorter tracking
    steps then make no shorter steps.

    Parameters
    ----------
    rate
        Largest rate at which the flow around a particle may change, 1/s.
    dt
        Tracking step, s.
    """
    if rate <= 0.0:
        return LEAST_STRETCH
    most = min(_LONGEST_STRETCH, _SHARE_OF_TIME / (rate * dt))
    return LEAST_STRETCH * max(1, int(most / LEAST_STRETCH))


def next_end(s: Scratch, i: int, t: float, dt: float, start: float, stretch: int, medium: Medium) -> float:
    """Return the tracking step before which the next step of lane i ends: its stretch or its random numbers.

    Random numbers hold up to the next multiple of a power of two of tracking steps; their length depends on
    the state in which they begin, and not on themselves.
    """
    block, end = s.block, float(s.step[i] + s.stride[i])
    if s.switches.draws == 0:
        block[during.held_from * LANES + i] = s.step[i]
        return end
    if t < start + (block[during.held_until * LANES + i] - SHORTEST_STEP) * dt:
        return float(block[during.held_until * LANES + i])
    first = np.floor((t - start) / dt + SHORTEST_STEP)
    block[during.held_from * LANES + i] = first
    longest, n = min(held_for(block, i, medium) / dt, float(stretch)), 1.0
    while 2.0 * n <= longest:
        n *= 2.0
    return float(min((np.floor(first / n) + 1.0) * n, end))


def steps_left(block: Block, i: int, remaining: float, l_f: Tensor, dt: float, most: int) -> float:
    """Return the number of equal steps of lane i for its remaining stretch, at its present step size.

    Parameters
    ----------
    remaining
        Time to the end of the stretch, s; round-off needs no step.
    l_f
        Velocity gradient of the fluid at the start, 1/s.
    dt, most
        As in :func:`track_adaptive`.
    """
    size = min(block[at.h * LANES + i], most * dt, longest_step(l_f))
    if block[at.fading * LANES + i] > 0.0:
        size = min(size, SHARE_OF_MEMORY / block[at.fading * LANES + i])
    return float(max(1.0, np.ceil((remaining - SHORTEST_STEP * dt) / size)))


def measures_again(s: Scratch, i: int, left: float, stretch: int) -> bool:
    """Return True if lane i must re-estimate its error ratio: one step of eight, early in a stretch."""
    if s.block[at.taken * LANES + i] > 0.0 or left >= REUSE_FOR:
        return left % REUSE_FOR == 0.0
    return bool(s.step[i] // stretch % (REUSE_FOR // left) == 0.0)


def keep_short(
    flow: object, patches: PatchTable, medium: Medium, s: Scratch, i: int, dt: float, tolerance: float
) -> None:
    """Reject a step of lane i longer than Δt over many cells, to a patch, or much closer to a wall.

    So is one that a model of the surroundings does not resolve. The next is shorter, but not than Δt: contact
    and the flow are resolved to Δt.
    """
    block = s.block
    long = block[at.dt * LANES + i] > (1.0 + SHORTEST_STEP) * dt
    if long and block[at.moving * LANES + i] > 0.0 and block[at.error * LANES + i] <= tolerance:
        goal = load3(block, at.new_x, i)
        if block[during.entered * LANES + i] > MOST_CELLS:
            block[at.moving * LANES + i] = 0.0
            block[at.h * LANES + i] = longest_over_cells(block, i, dt)
            return
        share = share_before_contact(flow, patches, s, i, goal, s.ahead[i], holds_end(block, i, goal))
        share = min(share, resolved_share(flow, s, i, medium))
        if share < 1.0:
            block[at.moving * LANES + i] = 0.0
            block[at.h * LANES + i] = max(dt, share * block[at.dt * LANES + i])


def approach(flow: object, patches: PatchTable, s: Scratch, i: int, dt: float, tolerance: float) -> None:
    """Reject a step of lane i that leads the centre onto a patch to which it sticks, unless it is short.

    Where the velocity of the fluid jumps, a step may end in a wall along which the fluid flows.
    """
    block = s.block
    h = block[at.dt * LANES + i]
    if (
        h > _LAST_STEP * dt
        and block[at.moving * LANES + i] > 0.0
        and block[at.error * LANES + i] <= tolerance
    ):
        goal = load3(block, at.new_x, i)
        if not holds_end(block, i, goal) and would_stick(flow, patches, s, i, goal, s.ahead[i]):
            block[at.moving * LANES + i] = 0.0
            block[at.h * LANES + i] = 0.25 * h


def longest_over_cells(block: Block, i: int, dt: float) -> float:
    """Return the longest next step of lane i by the cells that this one enters, s; at least Δt."""
    entered = block[during.entered * LANES + i]
    if entered <= CELLS:
        return math.inf
    return float(max(dt, block[at.dt * LANES + i] * CELLS / entered))


def needs_third(block: Block, i: int) -> bool:
    """Return True if lane i takes a step of order 3."""
    return bool(block[at.moving * LANES + i] > 0.0 and block[during.third * LANES + i] > 0.0)


def count_thirds(block: Block) -> int:
    """Return the number of lanes that take a step of order 3."""
    count = 0
    for i in range(LANES):
        count += needs_third(block, i)
    return count


def has_ended(s: Scratch) -> bool:
    """Return True if particles are left that need the rates at their ends, where no lane moves."""
    for i in range(LANES):
        if s.member[i] >= 0:
            return True
    return bool(s.counts[ENDED] > 0)


@separate
def update_ends(
    flow: object, patches: PatchTable, medium: Medium, p: Particles, s: Scratch, last: int
) -> None:
    """Apply ``end_slope`` to finished particles, and save them.

    ``last`` is the tracking step after the last.
    """
    block = s.block
    for i in range(LANES):
        block[at.moving * LANES + i] = 0.0
        if s.member[i] >= 0 and not (s.status[i] == ACTIVE and s.step[i] >= last):
            set_aside(s, i, READY)
        if s.member[i] < 0 and s.counts[ENDED] > 0:
            take_back(s, i, ENDED)
        if s.member[i] >= 0:
            block[at.moving * LANES + i] = 1.0
            store9(block, at.new_F, i, load9(block, at.F, i))
            x, t = load3(block, at.x, i), block[at.t * LANES + i]
            u, l_f, u_t = sample(flow, s.host[i], x, t)
            store_fluid(block, i, u, l_f, u_t)
            store3(block, during.start_u, i, u)
            store9(block, during.start_l, i, l_f)
            block[during.held_from * LANES + i], block[during.remaining * LANES + i] = last - 1.0, 0.0
    update_surroundings(flow, s, medium)
    evaluate_shape(block, medium, 0.0, 0.0)
    find_reactions(flow, patches, s, medium, 0.0)
    end_slope(block, medium)
    for i in range(LANES):
        if s.member[i] >= 0 and not interrupted(s):
            leave(p, s, i)
