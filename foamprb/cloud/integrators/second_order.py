"""The compiled loop of the second-order integrators, each particle with error-controlled steps of its own.

A tracking step Δt is cut into as many steps h as the tolerance asks for; the size that a particle found is
part of its state. As in all loops (:mod:`foamprb.cloud.advance`), the lanes of a block go side by side and
all alike.

The names ``first_slope``, ``second_slope`` and ``end_slope`` are bound to the stages of the integrator when
the loop is compiled, ``sample`` and ``walk`` to the flow.
"""

from __future__ import annotations

import math
from typing import Annotated, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Tensor, Vector, add, dot, exponential, scale
from foamprb.cloud.block import (
    ROWS,
    Medium,
    Scratch,
    accept_stage,
    at,
    idle_lanes,
    integrals_stage,
    load3,
    load9,
    load_particle,
    new_frames,
    save_particle,
    store3,
    store9,
    store_fluid,
)
from foamprb.cloud.layout import LANES, Row, end, offsets
from foamprb.cloud.motion import (
    ACTIVE,
    PENDING,
    SHORTEST_STEP,
    PatchTable,
    clearance_of,
    end_tracking_step,
    fail_small_step,
    interrupted,
    is_sound,
    overspent,
    reach_end,
    release,
)
from foamprb.cloud.state import Particles
from foamprb.cloud.surroundings.total import look_around, surround
from foamprb.flow.analytic import sample_linear as sample
from foamprb.flow.analytic import walk_free as walk


class SlopeRows(NamedTuple):
    """What every second-order integrator keeps of the first stage: slopes k₁, and the frame of the state."""

    kx: Annotated[int, Row(3, "m/s", "slope of the position")]
    kF: Annotated[int, Row(9, "1/s", "slope l of the deformation gradient, dF/dt = l F")]
    start_Q: Annotated[int, Row(9, "1", "particle frame at the start of the step")]


slope = offsets(SlopeRows, ROWS)
SECOND_ORDER_ROWS = end(slope)

_SAFETY, _LEAST, _MOST = 0.9, 0.2, 4.0
_SMALLEST = 1e-9
"""A step that must be smaller than this share of Δt is a failure."""


def finish(block: Any, i: int, F: Tensor, k2F: Tensor, x_slopes: tuple[Vector, Vector]) -> None:
    """Store the new deformation gradient and position, and the error estimate of the step."""
    h = block[at.dt * LANES + i]
    k1F = load9(block, slope.kF, i)
    store9(block, at.new_F, i, dot(exponential(add(scale(1.5 * h, k1F), scale(0.5 * h, k2F))), F))
    k1, k2 = x_slopes
    x = load3(block, at.x, i)
    store3(
        block,
        at.new_x,
        i,
        (
            x[0] + h * (1.5 * k1[0] + 0.5 * k2[0]),
            x[1] + h * (1.5 * k1[1] + 0.5 * k2[1]),
            x[2] + h * (1.5 * k1[2] + 0.5 * k2[2]),
        ),
    )
    bend = abs(k1[0] + k2[0]) + abs(k1[1] + k2[1]) + abs(k1[2] + k2[2])
    way = abs(k1[0]) + abs(k1[1]) + abs(k1[2]) + block[at.R * LANES + i] / h
    block[at.error * LANES + i] = np.maximum(0.5 * h * largest(add(k1F, k2F)), 0.5 * bend / way)


def largest(T: Tensor) -> Any:
    """Largest magnitude of a component."""
    p = np.maximum(np.maximum(abs(T[0]), abs(T[1])), np.maximum(abs(T[2]), abs(T[3])))
    q = np.maximum(np.maximum(abs(T[4]), abs(T[5])), np.maximum(abs(T[6]), abs(T[7])))
    return np.maximum(np.maximum(p, q), abs(T[8]))


def no_stage(block: Any, medium: Medium) -> None:
    """Stands for a stage that an integrator does not have, and until one is bound for those that it has."""


first_slope = second_slope = end_slope = no_stage


def _begin(block: Any, i: int, h: float) -> None:
    """Put the state of lane i where the frame is taken from, and its step."""
    store9(block, at.new_F, i, load9(block, at.F, i))
    block[at.dt * LANES + i] = h


def _predicted_host(flow: Any, host: int, block: Any, i: int) -> int:
    """Host of the predicted position, or the last one on the way to a boundary."""
    found, _, patch, _ = walk(flow, host, load3(block, at.x, i), load3(block, at.new_x, i))
    return host if patch == -2 else found


def _next_size(h: float, error: float, tolerance: float) -> float:
    """Step that the error estimate, of second order in h, allows."""
    if not math.isfinite(error):
        return _LEAST * h
    factor = _SAFETY * math.sqrt(tolerance / (error + 1e-300))
    return h * min(_MOST, max(_LEAST, factor))


def track_adaptive(
    flow: Any,
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
) -> int:
    """Carry up to LANES particles through ``steps`` tracking steps, each in steps h ≤ Δt of its own.

    Parameters
    ----------
    As :func:`foamprb.cloud.integrators.paper.track_block`, with a block of the integrator's rows, and
    tolerance
        Largest error of a step in the deformation gradient, and in the direction of the path.

    Returns
    -------
    The number of walks that failed and were mended by the tree.
    """
    recovered = 0
    last = step + steps
    block, status, current = scratch.block, scratch.status, scratch.step
    idle_lanes(block, dt)
    for i in range(LANES):
        current[i] = step
    for i in range(len(members)):
        load_particle(p, members[i], scratch, i)
        if status[i] == ACTIVE:
            block[at.clearance * LANES + i], _, _ = clearance_of(flow, scratch, i)

    while True:
        moving = 0
        for i in range(len(members)):
            block[at.moving * LANES + i] = 0.0
            while status[i] == PENDING and current[i] < last:
                if block[at.t0 * LANES + i] < start + (current[i] + 1) * dt - SHORTEST_STEP * dt:
                    release(flow, patches, scratch, i)
                    block[at.h * LANES + i] = dt
                else:
                    current[i] += 1
            if status[i] != ACTIVE or current[i] >= last:
                continue
            moving += 1
            block[at.moving * LANES + i] = 1.0
            t, size = block[at.t * LANES + i], block[at.h * LANES + i]
            rest = start + (current[i] + 1) * dt - t
            # A little more than one step left is two equal ones, not one and a sliver; round-off is not more.
            h = rest if size >= rest - SHORTEST_STEP * dt else min(size, 0.5 * rest)
            _begin(block, i, h)
            u, l_f, u_t = sample(flow, scratch.host[i], load3(block, at.x, i), t)
            store_fluid(block, i, u, l_f, u_t)
            look_around(flow, scratch, i, current[i], start + (current[i] + 1) * dt - t, medium)
        if interrupted(scratch):
            return 0
        if moving == 0:
            break

        new_frames(block)
        integrals_stage(block)
        surround(block, medium, 0.0)
        first_slope(block, medium)
        for i in range(len(members)):
            if status[i] == ACTIVE and current[i] < last:
                host = _predicted_host(flow, scratch.host[i], block, i)
                t_new = block[at.t * LANES + i] + block[at.dt * LANES + i]
                u, l_f, u_t = sample(flow, host, load3(block, at.new_x, i), t_new)
                store_fluid(block, i, u, l_f, u_t)
        new_frames(block)
        integrals_stage(block)
        surround(block, medium, 1.0)
        second_slope(block, medium)
        accept_stage(block, tolerance)

        for i in range(len(members)):
            if status[i] != ACTIVE or current[i] >= last:
                continue
            if overspent(scratch, i):
                continue
            h = block[at.dt * LANES + i]
            t_end = start + (current[i] + 1) * dt
            error = block[at.error * LANES + i]
            size = _next_size(h, error, tolerance)
            if not error <= tolerance:
                block[at.h * LANES + i] = size
                if size < _SMALLEST * dt:
                    fail_small_step(scratch, i)
                continue
            if not is_sound(scratch, i):
                continue
            t_new = block[at.t * LANES + i] + h
            whole = t_new >= t_end - SHORTEST_STEP * dt
            if whole:
                t_new = t_end
                # A step cut short by the end of Δt says nothing against the size before it.
                size = max(size, block[at.h * LANES + i])
            block[at.h * LANES + i] = min(dt, size)
            goal = load3(block, at.new_x, i)
            recovered += reach_end(flow, patches, scratch, i, goal, t_new, h)
            if whole:
                end_tracking_step(scratch, i)
    for i in range(len(members)):
        block[at.moving * LANES + i] = 0.0
        if status[i] == ACTIVE:
            block[at.moving * LANES + i] = 1.0
            store9(block, at.new_F, i, load9(block, at.F, i))
            x, t = load3(block, at.x, i), block[at.t * LANES + i]
            u, l_f, u_t = sample(flow, scratch.host[i], x, t)
            store_fluid(block, i, u, l_f, u_t)
            look_around(flow, scratch, i, last - 1, 0.0, medium)
    new_frames(block)
    integrals_stage(block)
    surround(block, medium, 0.0)
    end_slope(block, medium)
    for i in range(len(members)):
        save_particle(p, members[i], scratch, i)
    return recovered
