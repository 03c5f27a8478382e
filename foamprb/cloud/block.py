"""A block of particles: :data:`LANES` of them side by side, one row of numbers per component.

What every integrator does with a block is here: its layout, filling and emptying it, and the particle frame
with Jeffery's integrals of each lane.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from foamprb.body.ellipsoid import Integrals, integrals
from foamprb.body.material import metric_at_rest
from foamprb.body.tensor import (
    Tensor,
    Vector,
    dot_vector,
    refined_frame,
    select,
    stretches_in_frame,
)
from foamprb.cloud.state import Particles, Reason

LANES = 32
"""On a CUDA device, where each thread has a block of its own, 1 is bound in its place."""

LOST, NOT_FINITE, VOLUME_RATIO, NOT_CONVERGED = (int(reason) for reason in Reason if reason)

# First row of each quantity in a block; a row holds one component of every lane.
AT_X, AT_V, AT_F, AT_A, AT_Q, AT_STRETCH = 0, 3, 6, 15, 24, 33
AT_INTEGRALS = 36
AT_U, AT_L, AT_STRESS, AT_PREDICTOR = 46, 49, 58, 67
AT_NEW_V, AT_NEW_F, AT_NEW_A = 76, 79, 88
AT_R, AT_RHO, AT_MU, AT_LAME, AT_DT, AT_ERROR, AT_J = 97, 98, 99, 100, 101, 102, 103
AT_NEW_X, AT_K = 104, 107
AT_M, AT_ETA, AT_TENSION, AT_DUDT = 108, 117, 118, 119
AT_FRAME, AT_SKEWNESS, AT_MOVING, AT_VERDICT, AT_RENEWED = 122, 131, 132, 133, 134
AT_T, AT_T0, AT_SIZE, AT_F0, AT_CLEARANCE, AT_MIRRORED = 135, 136, 137, 138, 147, 148
ROWS = 149

# Largest |b_ac|/(λ_a λ_c) between the axes of a frame, squared; what was stored is held to a little less.
_SKEWNESS, _STORED_SKEWNESS = 1e-24, 1e-22
_MOST_REPEATS = 10
_MIN_J, _MAX_J = 0.125, 8.0


class Medium(NamedTuple):
    """The fluid around the particles, and the forces by which it acts on a barycentre beside drag."""

    mu: float
    """Pa s."""
    rho: float
    """kg/m³."""
    gravity: Vector
    """m/s²."""
    pressure_gradient: float = 0.0
    """1 with the force of the undisturbed flow's pressure gradient, else 0."""
    virtual_mass: float = 0.0
    """Coefficient of the virtual mass force; ½ for a sphere."""


class Scratch(NamedTuple):
    """Working memory of a loop: while a block is in it, the cloud's arrays are left alone.

    Neighbours in memory may be in the blocks of other threads, and a line of memory that two processors write
    to goes to and fro between them.
    """

    block: Any
    """Rows × LANES numbers, flat."""
    status: Any
    """LANES whole numbers, as those that follow: what each particle is doing."""
    reason: Any
    patch: Any
    host: Any
    step: Any
    """The step at which each particle is."""
    matrix: Any
    """9 × 10 numbers: one particle's equations."""


def new_scratch(rows: int) -> Scratch:
    """Working memory for a block of that many rows."""
    a, b, c, d, e = np.empty((5, LANES), dtype=np.int64)
    return Scratch(np.empty(rows * LANES), a, b, c, d, e, np.empty((9, 10)))


def load3(block: Any, row: int, i: int) -> Vector:
    """The vector in three rows of lane i."""
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES]


def store3(block: Any, row: int, i: int, v: Vector) -> None:
    """Put a vector into three rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]


def load9(block: Any, row: int, i: int) -> Tensor:
    """The tensor in nine rows of lane i."""
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES],
        block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES],
        block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES],
    )  # fmt: skip


def store9(block: Any, row: int, i: int, T: Tensor) -> None:
    """Put a tensor into nine rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = T[0], T[1], T[2]
    block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES] = T[3], T[4], T[5]
    block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES] = T[6], T[7], T[8]


def store_fluid(block: Any, i: int, u: Vector, l_f: Tensor, u_t: Vector) -> None:
    """Put the fluid's u, its gradient and its acceleration Du/Dt = ∂u/∂t + l·u into lane i."""
    store3(block, AT_U, i, u)
    store9(block, AT_L, i, l_f)
    c = dot_vector(l_f, u)
    store3(block, AT_DUDT, i, (u_t[0] + c[0], u_t[1] + c[1], u_t[2] + c[2]))


def load_integrals(block: Any, i: int) -> Integrals:
    """Jeffery's integrals of lane i."""
    return Integrals(
        load3(block, AT_INTEGRALS, i),
        load3(block, AT_INTEGRALS + 3, i),
        load3(block, AT_INTEGRALS + 6, i),
        block[(AT_INTEGRALS + 9) * LANES + i],
    )


def new_frames(block: Any) -> None:
    """Particle frame and stretches of the new deformation gradient, from the frame of the last one."""
    frame_stage(block)
    stretch_stage(block)
    straighten(block, _SKEWNESS)


def resume_frames(block: Any) -> None:
    """Particle frames and stretches as they were when the block's particles were last saved."""
    for i in range(LANES):
        store9(block, AT_Q, i, load9(block, AT_FRAME, i))
    # One compiled stage serves both: elsewhere the compiler may contract sums in another way.
    stretch_stage(block)
    # For a particle that never moved, or whose F somebody set.
    straighten(block, _STORED_SKEWNESS)


def renew_frames(block: Any) -> None:
    """As :func:`resume_frames`, of lanes whose state was put there or turned since the last step."""
    found = 0
    for i in range(LANES):
        if block[AT_RENEWED * LANES + i] > 0.0:
            block[AT_RENEWED * LANES + i] = 0.0
            found += 1
            store9(block, AT_Q, i, load9(block, AT_FRAME, i))
            store9(block, AT_NEW_F, i, load9(block, AT_F, i))
    if found:
        stretch_stage(block)
        straighten(block, _STORED_SKEWNESS)
        integrals_stage(block)


def frame_stage(block: Any) -> None:
    """Particle frame of the new deformation gradient, from the frame of the last one."""
    for i in range(LANES):
        store9(block, AT_Q, i, refined_frame(load9(block, AT_NEW_F, i), load9(block, AT_FRAME, i)))


def stretch_stage(block: Any) -> None:
    """Stretches of the new deformation gradient along its frame, and how skew that still is."""
    for i in range(LANES):
        stretches, skewness = stretches_in_frame(load9(block, AT_NEW_F, i), load9(block, AT_Q, i))
        store3(block, AT_STRETCH, i, stretches)
        block[AT_SKEWNESS * LANES + i] = skewness


def straighten(block: Any, allowed: float) -> None:
    """Refine the frames further that have turned too far for one pass."""
    for _ in range(_MOST_REPEATS):
        found = 0
        for i in range(LANES):
            if block[AT_SKEWNESS * LANES + i] > allowed:
                found += 1
        if found == 0:
            break
        straighten_stage(block, allowed)
        stretch_stage(block)


def straighten_stage(block: Any, allowed: float) -> None:
    """Refine those frames, and no others, that are more skew than is allowed."""
    for i in range(LANES):
        Q = load9(block, AT_Q, i)
        refined = refined_frame(load9(block, AT_NEW_F, i), Q)
        store9(block, AT_Q, i, choose(block[AT_SKEWNESS * LANES + i] > allowed, refined, Q))


def accept_stage(block: Any, tolerance: float) -> None:
    """Judge the new shapes and velocities, and take over those that are sound, of the lanes that move."""
    for i in range(LANES):
        F, A, v = load9(block, AT_NEW_F, i), load9(block, AT_NEW_A, i), load3(block, AT_NEW_V, i)
        total = (
            (v[0] + v[1] + v[2] + F[0] + F[1] + F[2] + F[3] + F[4] + F[5] + F[6] + F[7] + F[8])
            + (A[0] + A[1] + A[2] + A[3] + A[4] + A[5] + A[6] + A[7] + A[8])
        )  # fmt: skip
        J = block[AT_J * LANES + i]
        verdict = select(block[AT_ERROR * LANES + i] <= tolerance, 0.0, float(NOT_CONVERGED))
        verdict = select((J >= _MIN_J) & (J <= _MAX_J), verdict, float(VOLUME_RATIO))
        verdict = select(abs(total) < np.inf, verdict, float(NOT_FINITE))
        block[AT_VERDICT * LANES + i] = verdict
        sound = (verdict == 0.0) & (block[AT_MOVING * LANES + i] > 0.0)
        store9(block, AT_F, i, choose(sound, F, load9(block, AT_F, i)))
        store9(block, AT_A, i, choose(sound, A, load9(block, AT_A, i)))
        store9(block, AT_FRAME, i, choose(sound, load9(block, AT_Q, i), load9(block, AT_FRAME, i)))
        w = load3(block, AT_V, i)
        store3(
            block,
            AT_V,
            i,
            (select(sound, v[0], w[0]), select(sound, v[1], w[1]), select(sound, v[2], w[2])),
        )


def choose(condition: Any, S: Tensor, T: Tensor) -> Tensor:
    """S where the condition holds, else T."""
    return (
        select(condition, S[0], T[0]), select(condition, S[1], T[1]), select(condition, S[2], T[2]),
        select(condition, S[3], T[3]), select(condition, S[4], T[4]), select(condition, S[5], T[5]),
        select(condition, S[6], T[6]), select(condition, S[7], T[7]), select(condition, S[8], T[8]),
    )  # fmt: skip


def integrals_stage(block: Any) -> None:
    """Jeffery's integrals of the stretches."""
    for i in range(LANES):
        g = integrals(load3(block, AT_STRETCH, i))
        store3(block, AT_INTEGRALS, i, g.alpha)
        store3(block, AT_INTEGRALS + 3, i, g.ring)
        store3(block, AT_INTEGRALS + 6, i, g.star)
        block[(AT_INTEGRALS + 9) * LANES + i] = g.chi


def load_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy particle k of the cloud into lane i."""
    block = s.block
    s.status[i], s.host[i] = p.status[k], p.host[k]
    # None of those that are loaded has ended.
    s.reason[i], s.patch[i] = 0, -1
    block[AT_T * LANES + i] = p.t[k]
    block[AT_T0 * LANES + i] = p.t0[k]
    block[AT_SIZE * LANES + i] = p.h[k]
    for c in range(3):
        block[(AT_X + c) * LANES + i] = p.x[k, c]
        block[(AT_V + c) * LANES + i] = p.v[k, c]
    for c in range(9):
        block[(AT_F + c) * LANES + i] = p.F[k, c]
        block[(AT_NEW_F + c) * LANES + i] = p.F[k, c]
        block[(AT_A + c) * LANES + i] = p.A[k, c]
        block[(AT_FRAME + c) * LANES + i] = p.Q[k, c]
    block[AT_R * LANES + i] = p.R[k]
    block[AT_RHO * LANES + i] = p.rho[k]
    block[AT_MU * LANES + i] = p.mu[k]
    block[AT_LAME * LANES + i] = p.lame[k]
    block[AT_K * LANES + i] = p.k[k]
    block[AT_ETA * LANES + i] = p.eta[k]
    block[AT_TENSION * LANES + i] = p.gamma[k] / p.R[k]
    F0 = (
        p.F0[k, 0], p.F0[k, 1], p.F0[k, 2],
        p.F0[k, 3], p.F0[k, 4], p.F0[k, 5],
        p.F0[k, 6], p.F0[k, 7], p.F0[k, 8],
    )  # fmt: skip
    store9(block, AT_F0, i, F0)
    store9(block, AT_M, i, metric_at_rest(F0))
    block[AT_CLEARANCE * LANES + i] = np.inf


def save_particle(p: Particles, k: int, s: Scratch, i: int) -> None:
    """Copy the state in lane i back to particle k of the cloud."""
    block = s.block
    p.host[k] = s.host[i]
    # What seldom changes is left alone: each line of memory that is not written to is time won.
    if p.status[k] != s.status[i]:
        p.status[k], p.reason[k], p.patch[k] = s.status[i], s.reason[i], s.patch[i]
    p.t[k] = block[AT_T * LANES + i]
    p.h[k] = block[AT_SIZE * LANES + i]
    for c in range(3):
        p.x[k, c] = block[(AT_X + c) * LANES + i]
        p.v[k, c] = block[(AT_V + c) * LANES + i]
    for c in range(9):
        p.F[k, c] = block[(AT_F + c) * LANES + i]
        p.A[k, c] = block[(AT_A + c) * LANES + i]
        p.Q[k, c] = block[(AT_FRAME + c) * LANES + i]
    if block[AT_MIRRORED * LANES + i] > 0.0:
        for c in range(9):
            p.F0[k, c] = block[(AT_F0 + c) * LANES + i]


def idle(block: Any, i: int, dt: float) -> None:
    """Fill a lane that has no particle with a sphere at rest, so that its numbers stay finite."""
    for row in range(ROWS):
        block[row * LANES + i] = 0.0
    for c in (
        AT_F,
        AT_F + 4,
        AT_F + 8,
        AT_NEW_F,
        AT_NEW_F + 4,
        AT_NEW_F + 8,
        AT_M,
        AT_M + 4,
        AT_M + 8,
        AT_FRAME,
        AT_FRAME + 4,
        AT_FRAME + 8,
        AT_R,
        AT_RHO,
        AT_MU,
        AT_LAME,
        AT_K,
    ):
        block[c * LANES + i] = 1.0
    block[AT_DT * LANES + i] = dt
