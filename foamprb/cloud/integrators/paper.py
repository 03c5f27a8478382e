"""Integrator ``paper``: the implicit–explicit Euler scheme of the paper, with inertia, of first order.

The formulas are those of :mod:`foamprb.body.imex`.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import drag, implicit_euler
from foamprb.body.imex import RELATIVE_TOLERANCE, advance, equation, inertia_factor, tangent
from foamprb.body.material import MATERIALS, viscous_stress
from foamprb.body.tensor import Tensor, add, det, dot, inverse, scale, to_frame, transpose
from foamprb.body.traction import traction
from foamprb.cloud.block import (
    Medium,
    Scratch,
    Switches,
    accept_stage,
    at,
    idle_lanes,
    load3,
    load9,
    load_integrals,
    load_particle,
    new_frames,
    new_integrals,
    renew_frames,
    resume_frames,
    save_particle,
    store3,
    store9,
    store_fluid,
    viscosity_at,
)
from foamprb.cloud.forces import acceleration
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.base import Integrator, apply_surroundings, lifted, update_surroundings
from foamprb.cloud.layout import LANES, Block, layout
from foamprb.cloud.motion import (
    ACTIVE,
    GOES_ON,
    PENDING,
    SHORTEST_STEP,
    PatchTable,
    bounce_to_end,
    end_block,
    interrupted,
    is_sound,
    release,
    renew_clearance,
)
from foamprb.cloud.paths import RecordedRows, record_ends, record_starts
from foamprb.cloud.state import Particles
from foamprb.compile.link import separate, traced
from foamprb.flow.kernels import sample

_DENSE_STEPS = 25


@traced
def traction_stage(block: Block, medium: Medium) -> None:
    """Compute σ̃* (46) less the viscous stress, and Newton's first iterate, in the particle frame."""
    for i in range(LANES):
        F, A, Q = load9(block, at.F, i), load9(block, at.A, i), load9(block, at.Q, i)
        l_f = to_frame(Q, load9(block, at.l, i))
        l_s = to_frame(Q, dot(A, inverse(F)))
        stress = traction(load3(block, at.stretch, i), load_integrals(block, i), l_f, l_s)
        viscous = viscous_stress(l_s, block[at.eta * LANES + i])
        store9(block, at.stress, i, add(scale(viscosity_at(block, i, medium), stress), scale(-1.0, viscous)))
        store9(block, at.predictor, i, dot(Q, add(F, scale(block[at.dt * LANES + i], A))))


def _kappa(block: Block, i: int) -> float:
    return inertia_factor(block[at.dt * LANES + i], block[at.rho * LANES + i], block[at.R * LANES + i])  # type: ignore[no-any-return]


def _finish_shape(block: Block, i: int, G: Tensor, error: float) -> None:
    """Store Fⁿ⁺¹ = Qᵀ·G, Aⁿ⁺¹ = (Fⁿ⁺¹ − Fⁿ)/Δt (47), J and the error."""
    F = load9(block, at.F, i)
    F_new = dot(transpose(load9(block, at.Q, i)), G)
    store9(block, at.new_F, i, F_new)
    store9(block, at.new_A, i, scale(1.0 / block[at.dt * LANES + i], add(F_new, scale(-1.0, F))))
    block[at.error * LANES + i] = error
    block[at.J * LANES + i] = det(G)


@traced
def newton_stage(block: Block) -> None:
    """Compute the new deformation gradient."""
    for i in range(LANES):
        G, error = advance(
            load9(block, at.predictor, i),
            load9(block, at.stress, i),
            _kappa(block, i),
            block[at.mu * LANES + i],
            block[at.lame * LANES + i],
            load9(block, at.M, i),
        )
        _finish_shape(block, i, G, error)


@traced
def barycentre_stage(block: Block, medium: Medium) -> None:
    """Compute the new velocity, with the drag of the new shape (36) to (43)."""
    for i in range(LANES):
        k = drag(load3(block, at.stretch, i), load_integrals(block, i))
        R, rho = block[at.R * LANES + i], block[at.rho * LANES + i]
        # μ_f K_a/m with K_a in units of R
        c = viscosity_at(block, i, medium) / (4.0 / 3.0 * math.pi * R * R * rho)
        a, inertia = acceleration(block, i, medium, block[at.J * LANES + i])
        c = c / inertia
        rate = (c * k[0], c * k[1], c * k[2])
        v, u, Q = load3(block, at.v, i), load3(block, at.u, i), load9(block, at.Q, i)
        a = lifted(block, i, medium, a, v, rate, inertia)
        store3(block, at.new_v, i, implicit_euler(v, u, Q, rate, a, block[at.dt * LANES + i]))


def _eliminate(M: Any, n: int) -> bool:
    """Solve in place the n×n system with its right side in column n; return False if it is singular."""
    for k in range(n):
        p = k
        for i in range(k + 1, n):
            if abs(M[i, k]) > abs(M[p, k]):
                p = i
        if not abs(M[p, k]) > 0.0:
            return False
        for j in range(k, n + 1):
            M[k, j], M[p, j] = M[p, j], M[k, j]
        for i in range(n):
            if i != k:
                f = M[i, k] / M[k, k]
                for j in range(k, n + 1):
                    M[i, j] -= f * M[k, j]
    for k in range(n):
        M[k, n] /= M[k, k]
    return True


@separate
def dense_newton(block: Block, i: int, M: Any) -> None:
    """Compute the deformation gradient of lane i by Newton's method with the full 9×9 tangent (50), in M."""
    predictor, stress = load9(block, at.predictor, i), load9(block, at.stress, i)
    mu, lame, kappa = block[at.mu * LANES + i], block[at.lame * LANES + i], _kappa(block, i)
    M_rest = load9(block, at.M, i)
    G = predictor
    size = math.inf
    for _ in range(_DENSE_STEPS):
        n = equation(G, predictor, stress, kappa, mu, lame, M_rest)
        for k in range(9):
            E = (
                1.0 if k == 0 else 0.0, 1.0 if k == 1 else 0.0, 1.0 if k == 2 else 0.0,
                1.0 if k == 3 else 0.0, 1.0 if k == 4 else 0.0, 1.0 if k == 5 else 0.0,
                1.0 if k == 6 else 0.0, 1.0 if k == 7 else 0.0, 1.0 if k == 8 else 0.0,
            )  # fmt: skip
            column = tangent(n, E)
            for row in range(9):
                M[row, k] = column[row]
        for row in range(9):
            M[row, 9] = n.r[row]
        if not _eliminate(M, 9):
            break
        X = (M[0, 9], M[1, 9], M[2, 9], M[3, 9], M[4, 9], M[5, 9], M[6, 9], M[7, 9], M[8, 9])
        G = add(G, scale(-1.0, dot(X, G)))
        before = size
        size = 0.0
        for row in range(9):
            size = max(size, abs(M[row, 9]))
        # Convergence is quadratic: once a correction is this small the next is below round-off.
        if size < 1e-9 or not size < 1e3 * (before + 1.0):
            break
    _finish_shape(block, i, G, 0.0 if size < 1e-9 else math.inf)


def track_paper(
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
) -> int:
    """Advance particles from step ``step`` by ``steps`` steps of Δt, block by block.

    Parameters
    ----------
    flow
        Packed arrays of the flow.
    p
        The cloud; only ``members`` are read and changed.
    members
        Indices of particles, pending or active.
    step
        Number of the first step: it goes from t = start + step Δt to start + (step + 1) Δt.
    scratch
        With a block of the integrator's rows.

    Returns
    -------
    The number of walks that needed the tree.
    """
    recovered = 0
    for first in range(0, len(members), LANES):
        some = members[first : first + LANES]
        recovered += _track_block(flow, patches, medium, p, some, step, steps, dt, start, scratch)
    return recovered


def _track_block(
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
) -> int:
    """Advance up to :data:`LANES` particles, see :func:`track_paper`."""
    recovered = 0
    block, status = scratch.block, scratch.status
    idle_lanes(block, scratch.initial, dt)
    for i in range(LANES):
        scratch.member[i] = members[i] if i < len(members) else -1
    for i in range(len(members)):
        load_particle(p, members[i], scratch, i)
        if status[i] == ACTIVE:
            renew_clearance(flow, scratch, i)
    resume_frames(block)
    new_integrals(block)

    for n in range(step, step + steps):
        t_end = start + (n + 1) * dt
        moving = 0
        for i in range(len(members)):
            block[at.moving * LANES + i] = 0.0
            t0 = block[at.t0 * LANES + i]
            # A first step of length 0 would divide round-off by zero in Aⁿ⁺¹.
            if status[i] == PENDING and t0 < t_end - SHORTEST_STEP * dt:
                release(flow, patches, scratch, i)
            if status[i] == ACTIVE:
                moving += 1
                block[at.moving * LANES + i] = 1.0
                block[at.dt * LANES + i] = t_end - max(start + n * dt, t0)
                u, l_f, u_t = sample(flow, scratch.host[i], load3(block, at.x, i), t_end)
                store_fluid(block, i, u, l_f, u_t)
                block[during.held_from * LANES + i] = n
                block[during.remaining * LANES + i] = block[at.dt * LANES + i]
            elif status[i] == PENDING:
                moving += 1
        if moving == 0 or interrupted(scratch):
            break

        update_surroundings(flow, scratch, medium)
        renew_frames(block)
        apply_surroundings(block, medium, 0.0)
        traction_stage(block, medium)
        newton_stage(block)
        for i in range(len(members)):
            if status[i] == ACTIVE and not block[at.error * LANES + i] <= RELATIVE_TOLERANCE:
                dense_newton(block, i, scratch.matrix)
        new_frames(block)
        new_integrals(block)
        barycentre_stage(block, medium)
        record_starts(scratch)
        accept_stage(block, RELATIVE_TOLERANCE)

        for i in range(len(members)):
            if status[i] != ACTIVE or not is_sound(scratch, i):
                continue
            h = block[at.dt * LANES + i]
            x, v = load3(block, at.x, i), load3(block, at.v, i)
            goal = (x[0] + h * v[0], x[1] + h * v[1], x[2] + h * v[2])
            recovered += bounce_to_end(flow, patches, scratch, i, goal, t_end, h)
        record_ends(scratch)
    if interrupted(scratch):
        return 0
    for i in range(len(members)):
        save_particle(p, members[i], scratch, i)
    end_block(scratch)
    return recovered


def _refuses(_traction: str, material: str, tense: bool) -> str:
    if MATERIALS[material].dilation is None:
        return f"takes no {material}: choose rosenbrock or stokes"
    return "takes no surfaceTension: choose rosenbrock or stokes" if tense else ""


PAPER = Integrator(
    name="paper",
    description="implicit-explicit Euler of the paper's Sect. 4, first order, stable below 1.5 τ_s",
    order=1,
    track=track_paper,
    layout=layout(at, during),
    recorded=RecordedRows(at.frame, at.l, at.A, in_frame=False),
    switches=Switches(bouncing=GOES_ON),
    stable_steps=1.5,
    refuses=_refuses,
)
