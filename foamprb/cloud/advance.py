"""The compiled loop over particles: lanes of a block step side by side.

Particles do not act on each other, so a block of :data:`LANES` of them is carried through many steps while
it stays in the processor's cache. Within a step, the flow's sampling and walking go particle by particle;
the mathematics of the body goes stage by stage over the lanes of the block, each stage one plain loop that
the compiler turns into vector instructions. All lanes are computed alike, whatever their number and order,
which makes the result independent of both and of the number of threads.

The names ``traction``, ``drag``, ``coefficients``, ``sample``, ``walk``, ``gap``, ``normal`` and ``recover``
are bound to the models that were chosen when the loop is compiled (:func:`foamprb.compile.link`).
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.drag import implicit_euler, reduced_gravity
from foamprb.body.drag import oberbeck as drag
from foamprb.body.ellipsoid import Integrals, integrals
from foamprb.body.imex import (
    RELATIVE_TOLERANCE,
    advance,
    equation,
    inertia_factor,
    tangent,
)
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    det,
    dot,
    inverse,
    principal_frame,
    scale,
    to_frame,
    transpose,
)
from foamprb.body.traction import roscoe as traction
from foamprb.cloud.patches import ESCAPE, STICK, rebound_velocity
from foamprb.cloud.state import Particles, Reason, Status
from foamprb.flow.analytic import gap_free as gap
from foamprb.flow.analytic import normal_free as normal
from foamprb.flow.analytic import recover_free as recover
from foamprb.flow.analytic import sample_linear as sample
from foamprb.flow.analytic import walk_free as walk

LANES = 32

PENDING, ACTIVE, STUCK, ESCAPED, FAILED = (int(status) for status in Status)
LOST, NOT_FINITE, VOLUME_RATIO, NOT_CONVERGED = (int(reason) for reason in Reason if reason)

# First row of each quantity in a block; a row holds one component of every lane.
_X, _V, _F, _A, _Q, _STRETCH = 0, 3, 6, 15, 24, 33
_INTEGRALS = 36
_U, _L, _STRESS, _PREDICTOR = 46, 49, 58, 67
_NEW_V, _NEW_F, _NEW_A = 76, 79, 88
_R, _RHO, _MU, _LAME, _DT, _ERROR, _J = 97, 98, 99, 100, 101, 102, 103
ROWS = 104

_SHORTEST_STEP = 1e-6
_MAX_BOUNCES = 10
_DENSE_STEPS = 25
_MIN_J, _MAX_J = 0.125, 8.0


class Medium(NamedTuple):
    """The fluid around the particles, and gravity."""

    mu: float
    rho: float
    gravity: Vector


class PatchTable(NamedTuple):
    """What each patch does: its interaction's code, and the entries of ``rebound``."""

    code: NDArray[np.int8]
    e: NDArray[np.float64]
    mu: NDArray[np.float64]


def _load3(block: Any, row: int, i: int) -> Vector:
    k = row * LANES + i
    return block[k], block[k + LANES], block[k + 2 * LANES]


def _store3(block: Any, row: int, i: int, v: Vector) -> None:
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]


def _load9(block: Any, row: int, i: int) -> Tensor:
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES],
        block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES],
        block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES],
    )  # fmt: skip


def _store9(block: Any, row: int, i: int, T: Tensor) -> None:
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = T[0], T[1], T[2]
    block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES] = T[3], T[4], T[5]
    block[k + 6 * LANES], block[k + 7 * LANES], block[k + 8 * LANES] = T[6], T[7], T[8]


def frame_stage(block: Any) -> None:
    """Particle frame and stretches of the new deformation gradient."""
    for i in range(LANES):
        Q, stretches = principal_frame(_load9(block, _NEW_F, i))
        _store9(block, _Q, i, Q)
        _store3(block, _STRETCH, i, stretches)


def integrals_stage(block: Any) -> None:
    """Jeffery's integrals of the stretches."""
    for i in range(LANES):
        g = integrals(_load3(block, _STRETCH, i))
        _store3(block, _INTEGRALS, i, g.alpha)
        _store3(block, _INTEGRALS + 3, i, g.ring)
        _store3(block, _INTEGRALS + 6, i, g.star)
        block[(_INTEGRALS + 9) * LANES + i] = g.chi


def _load_integrals(block: Any, i: int) -> Integrals:
    return Integrals(
        _load3(block, _INTEGRALS, i),
        _load3(block, _INTEGRALS + 3, i),
        _load3(block, _INTEGRALS + 6, i),
        block[(_INTEGRALS + 9) * LANES + i],
    )


def traction_stage(block: Any, medium: Medium) -> None:
    """σ̃* of the old shape (46) and Newton's first iterate, both in the particle frame."""
    for i in range(LANES):
        F, A, Q = _load9(block, _F, i), _load9(block, _A, i), _load9(block, _Q, i)
        l_f = to_frame(Q, _load9(block, _L, i))
        l_s = to_frame(Q, dot(A, inverse(F)))
        stress = traction(_load3(block, _STRETCH, i), _load_integrals(block, i), l_f, l_s)
        _store9(block, _STRESS, i, scale(medium.mu, stress))
        _store9(block, _PREDICTOR, i, dot(Q, add(F, scale(block[_DT * LANES + i], A))))


def _kappa(block: Any, i: int) -> float:
    return inertia_factor(block[_DT * LANES + i], block[_RHO * LANES + i], block[_R * LANES + i])  # type: ignore[no-any-return]


def _finish_shape(block: Any, i: int, G: Tensor, error: float) -> None:
    """Store Fⁿ⁺¹ = Qᵀ·G, Aⁿ⁺¹ = (Fⁿ⁺¹ − Fⁿ)/Δt (47) and what tells whether they are sound."""
    F = _load9(block, _F, i)
    F_new = dot(transpose(_load9(block, _Q, i)), G)
    _store9(block, _NEW_F, i, F_new)
    _store9(block, _NEW_A, i, scale(1.0 / block[_DT * LANES + i], add(F_new, scale(-1.0, F))))
    block[_ERROR * LANES + i] = error
    block[_J * LANES + i] = det(G)


def newton_stage(block: Any) -> None:
    """The new deformation gradient."""
    for i in range(LANES):
        G, error = advance(
            _load9(block, _PREDICTOR, i),
            _load9(block, _STRESS, i),
            _kappa(block, i),
            block[_MU * LANES + i],
            block[_LAME * LANES + i],
        )
        _finish_shape(block, i, G, error)


def barycentre_stage(block: Any, medium: Medium) -> None:
    """The new velocity, with the drag of the new shape (36) to (43)."""
    for i in range(LANES):
        k = drag(_load3(block, _STRETCH, i), _load_integrals(block, i))
        R, rho = block[_R * LANES + i], block[_RHO * LANES + i]
        # μ_f K_a/m with K_a in units of R
        c = medium.mu / (4.0 / 3.0 * math.pi * R * R * rho)
        rate = (c * k[0], c * k[1], c * k[2])
        a_G = reduced_gravity(block[_J * LANES + i], rho, medium.rho, medium.gravity)
        v, u, Q = _load3(block, _V, i), _load3(block, _U, i), _load9(block, _Q, i)
        _store3(block, _NEW_V, i, implicit_euler(v, u, Q, rate, a_G, block[_DT * LANES + i]))


def _eliminate(M: Any, n: int) -> bool:
    """Solve in place the n×n system with its right side in column n; false when it is singular."""
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


def dense_newton(block: Any, i: int) -> None:
    """The new deformation gradient of lane i by Newton's method with the full 9×9 tangent (50)."""
    predictor, stress = _load9(block, _PREDICTOR, i), _load9(block, _STRESS, i)
    mu, lame, kappa = block[_MU * LANES + i], block[_LAME * LANES + i], _kappa(block, i)
    M = np.empty((9, 10))
    G = predictor
    size = math.inf
    for _ in range(_DENSE_STEPS):
        n = equation(G, predictor, stress, kappa, mu, lame)
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


def _load_particle(p: Particles, k: int, block: Any, i: int) -> None:
    for c in range(3):
        block[(_X + c) * LANES + i] = p.x[k, c]
        block[(_V + c) * LANES + i] = p.v[k, c]
    for c in range(9):
        block[(_F + c) * LANES + i] = p.F[k, c]
        block[(_NEW_F + c) * LANES + i] = p.F[k, c]
        block[(_A + c) * LANES + i] = p.A[k, c]
    block[_R * LANES + i] = p.R[k]
    block[_RHO * LANES + i] = p.rho[k]
    block[_MU * LANES + i] = p.mu[k]
    block[_LAME * LANES + i] = p.lame[k]


def _save_particle(p: Particles, k: int, block: Any, i: int) -> None:
    for c in range(3):
        p.x[k, c] = block[(_X + c) * LANES + i]
        p.v[k, c] = block[(_V + c) * LANES + i]
    for c in range(9):
        p.F[k, c] = block[(_F + c) * LANES + i]
        p.A[k, c] = block[(_A + c) * LANES + i]


def _idle(block: Any, i: int, dt: float) -> None:
    """Fill a lane that has no particle with a sphere at rest, so that its numbers stay finite."""
    for row in range(ROWS):
        block[row * LANES + i] = 0.0
    for c in (_F, _F + 4, _F + 8, _NEW_F, _NEW_F + 4, _NEW_F + 8, _R, _RHO, _MU, _LAME):
        block[c * LANES + i] = 1.0
    block[_DT * LANES + i] = dt


def _fail(p: Particles, k: int, reason: int) -> None:
    p.status[k] = FAILED
    p.reason[k] = reason


def _between(a: Vector, b: Vector, f: float) -> Vector:
    """The point at fraction f of the way from a to b."""
    return a[0] + f * (b[0] - a[0]), a[1] + f * (b[1] - a[1]), a[2] + f * (b[2] - a[2])


def _is_finite(block: Any, i: int) -> bool:
    total = 0.0
    for c in range(_NEW_V, _NEW_A + 9):
        total += block[c * LANES + i]
    return math.isfinite(total)


def _accept_shape(p: Particles, k: int, block: Any, i: int) -> bool:
    """Take over the new shape and velocity if they are sound; fail the particle if not."""
    if not _is_finite(block, i):
        _fail(p, k, NOT_FINITE)
        return False
    J = block[_J * LANES + i]
    if not (_MIN_J <= J <= _MAX_J):
        _fail(p, k, VOLUME_RATIO)
        return False
    if not block[_ERROR * LANES + i] <= RELATIVE_TOLERANCE:
        _fail(p, k, NOT_CONVERGED)
        return False
    for c in range(9):
        block[(_F + c) * LANES + i] = block[(_NEW_F + c) * LANES + i]
        block[(_A + c) * LANES + i] = block[(_NEW_A + c) * LANES + i]
    for c in range(3):
        block[(_V + c) * LANES + i] = block[(_NEW_V + c) * LANES + i]
    return True


def _settle(p: Particles, k: int, patch: int, code: int) -> None:
    p.status[k] = STUCK if code == STICK else ESCAPED
    p.patch[k] = patch


def _move_centre(
    flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int, dt: float
) -> tuple[Vector, float, int]:
    """Carry the centre along v Δt, through the mesh and off or onto the patches that it meets.

    Returns the position where it ended, the time that it took, and the number of walks that the tree had to
    mend.
    """
    recovered = 0
    spent = 0.0
    x0 = _load3(block, _X, i)
    for _ in range(_MAX_BOUNCES):
        v = _load3(block, _V, i)
        rest = dt - spent
        x1 = (x0[0] + rest * v[0], x0[1] + rest * v[1], x0[2] + rest * v[2])
        host, fraction, patch, triangle = walk(flow, p.host[k], x0, x1)
        if patch == -1:
            p.host[k] = host
            return x1, dt, recovered
        if patch == -2:
            host = recover(flow, x1)
            recovered += 1
            if host < 0:
                _fail(p, k, LOST)
            else:
                p.host[k] = host
            return x1, dt, recovered
        p.host[k] = host
        x0 = _between(x0, x1, fraction)
        spent += fraction * rest
        code = patches.code[patch]
        if code in (STICK, ESCAPE):
            _settle(p, k, patch, code)
            return x0, spent, recovered
        n = normal(flow, triangle, x0)
        _store3(block, _V, i, rebound_velocity(v, n, patches.e[patch], patches.mu[patch]))
    return x0, dt, recovered


def _touch(
    flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int, before: float, start: Vector
) -> tuple[float, float]:
    """Let the ellipsoid touch the walls near it, after its centre went from ``start`` to its new place.

    Returns the clearance that is left, and the fraction of the way at which a particle stopped.
    """
    x = _load3(block, _X, i)
    F = _load9(block, _F, i)
    R = block[_R * LANES + i]
    after, patch, triangle = gap(flow, p.host[k], x, F, R)
    if after > 0.0:
        return after, 1.0
    code = patches.code[patch]
    if code == STICK:
        f = before / (before - after) if before > 0.0 and before < math.inf else 1.0
        if before <= 0.0:
            f = 0.0
        contact = _between(start, x, f)
        host, _, _, _ = walk(flow, p.host[k], x, contact)
        p.host[k] = host
        _store3(block, _X, i, contact)
        _settle(p, k, patch, STICK)
        return 0.0, f
    n = normal(flow, triangle, x)
    v = _load3(block, _V, i)
    _store3(block, _V, i, rebound_velocity(v, n, patches.e[patch], patches.mu[patch]))
    return after, 1.0


def _release(flow: Any, patches: PatchTable, p: Particles, k: int, block: Any, i: int) -> float:
    """Make a pending particle active, or stuck if it appears in touch with a sticky wall."""
    p.status[k] = ACTIVE
    p.t[k] = p.t0[k]
    clearance, patch, _ = gap(flow, p.host[k], _load3(block, _X, i), _load9(block, _F, i), p.R[k])
    if clearance <= 0.0 and patches.code[patch] == STICK:
        _settle(p, k, patch, STICK)
    return clearance


def track_block(
    flow: Any,
    patches: PatchTable,
    medium: Medium,
    p: Particles,
    members: NDArray[np.int64],
    step: int,
    steps: int,
    dt: float,
    block: NDArray[np.float64],
    clearance: NDArray[np.float64],
) -> int:
    """Carry up to :data:`LANES` particles from step ``step`` through ``steps`` steps of Δt.

    Parameters
    ----------
    flow
        Arrays of the flow, as its kernels want them.
    p
        The cloud; only the rows in ``members`` are read and changed.
    members
        Rows of particles, pending or active.
    step
        Number of the first step: it goes from t = step Δt to (step + 1) Δt.
    block, clearance
        Scratch of ROWS × LANES and LANES numbers.

    Returns
    -------
    The number of walks that failed and were mended by the tree.
    """
    recovered = 0
    for i in range(LANES):
        _idle(block, i, dt)
    for i in range(len(members)):
        k = members[i]
        _load_particle(p, k, block, i)
        clearance[i] = math.inf
        if p.status[k] == ACTIVE:
            clearance[i], _, _ = gap(flow, p.host[k], _load3(block, _X, i), _load9(block, _F, i), p.R[k])
    frame_stage(block)
    integrals_stage(block)

    for n in range(step, step + steps):
        t_end = (n + 1) * dt
        moving = 0
        for i in range(len(members)):
            k = members[i]
            # A first step of no length would divide round-off by nothing in Aⁿ⁺¹.
            if p.status[k] == PENDING and p.t0[k] < t_end - _SHORTEST_STEP * dt:
                clearance[i] = _release(flow, patches, p, k, block, i)
            if p.status[k] == ACTIVE:
                moving += 1
                block[_DT * LANES + i] = t_end - max(n * dt, p.t0[k])
                u, l_f = sample(flow, p.host[k], _load3(block, _X, i))
                _store3(block, _U, i, u)
                _store9(block, _L, i, l_f)
            elif p.status[k] == PENDING:
                moving += 1
        if moving == 0:
            break

        traction_stage(block, medium)
        newton_stage(block)
        for i in range(len(members)):
            if p.status[members[i]] == ACTIVE and not block[_ERROR * LANES + i] <= RELATIVE_TOLERANCE:
                dense_newton(block, i)
        frame_stage(block)
        integrals_stage(block)
        barycentre_stage(block, medium)

        for i in range(len(members)):
            k = members[i]
            if p.status[k] != ACTIVE or not _accept_shape(p, k, block, i):
                continue
            h = block[_DT * LANES + i]
            start = _load3(block, _X, i)
            end, spent, mended = _move_centre(flow, patches, p, k, block, i, h)
            recovered += mended
            _store3(block, _X, i, end)
            if p.status[k] == ACTIVE or p.status[k] == STUCK:
                clearance[i], f = _touch(flow, patches, p, k, block, i, clearance[i], start)
                spent *= f
            p.t[k] = t_end if p.status[k] == ACTIVE else t_end - h + spent
    for i in range(len(members)):
        _save_particle(p, members[i], block, i)
    return recovered


STAGES = (frame_stage, integrals_stage, traction_stage, newton_stage, barycentre_stage, dense_newton)
"""Parts of the loop that do not depend on the flow, compiled once for all flows."""
