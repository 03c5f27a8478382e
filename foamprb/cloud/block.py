"""A block of particles: :data:`LANES` of them side by side, one row of numbers per component.

What every integrator does with a block is here: its layout, filling and emptying it, and the particle frame
with Jeffery's integrals of each lane.
"""

from __future__ import annotations

from typing import Any, NamedTuple

from foamprb.body.ellipsoid import Integrals, integrals
from foamprb.body.material import metric_at_rest
from foamprb.body.tensor import Tensor, Vector, dot_vector, principal_frame
from foamprb.cloud.state import Particles

LANES = 32

# First row of each quantity in a block; a row holds one component of every lane.
AT_X, AT_V, AT_F, AT_A, AT_Q, AT_STRETCH = 0, 3, 6, 15, 24, 33
AT_INTEGRALS = 36
AT_U, AT_L, AT_STRESS, AT_PREDICTOR = 46, 49, 58, 67
AT_NEW_V, AT_NEW_F, AT_NEW_A = 76, 79, 88
AT_R, AT_RHO, AT_MU, AT_LAME, AT_DT, AT_ERROR, AT_J = 97, 98, 99, 100, 101, 102, 103
AT_NEW_X, AT_K = 104, 107
AT_M, AT_ETA, AT_TENSION, AT_DUDT = 108, 117, 118, 119
ROWS = 122


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


def frame_stage(block: Any) -> None:
    """Particle frame and stretches of the new deformation gradient."""
    for i in range(LANES):
        Q, stretches = principal_frame(load9(block, AT_NEW_F, i))
        store9(block, AT_Q, i, Q)
        store3(block, AT_STRETCH, i, stretches)


def integrals_stage(block: Any) -> None:
    """Jeffery's integrals of the stretches."""
    for i in range(LANES):
        g = integrals(load3(block, AT_STRETCH, i))
        store3(block, AT_INTEGRALS, i, g.alpha)
        store3(block, AT_INTEGRALS + 3, i, g.ring)
        store3(block, AT_INTEGRALS + 6, i, g.star)
        block[(AT_INTEGRALS + 9) * LANES + i] = g.chi


def load_particle(p: Particles, k: int, block: Any, i: int) -> None:
    """Copy particle k of the cloud into lane i."""
    for c in range(3):
        block[(AT_X + c) * LANES + i] = p.x[k, c]
        block[(AT_V + c) * LANES + i] = p.v[k, c]
    for c in range(9):
        block[(AT_F + c) * LANES + i] = p.F[k, c]
        block[(AT_NEW_F + c) * LANES + i] = p.F[k, c]
        block[(AT_A + c) * LANES + i] = p.A[k, c]
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
    store9(block, AT_M, i, metric_at_rest(F0))


def save_particle(p: Particles, k: int, block: Any, i: int) -> None:
    """Copy the state in lane i back to particle k of the cloud."""
    for c in range(3):
        p.x[k, c] = block[(AT_X + c) * LANES + i]
        p.v[k, c] = block[(AT_V + c) * LANES + i]
    for c in range(9):
        p.F[k, c] = block[(AT_F + c) * LANES + i]
        p.A[k, c] = block[(AT_A + c) * LANES + i]


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
        AT_R,
        AT_RHO,
        AT_MU,
        AT_LAME,
        AT_K,
    ):
        block[c * LANES + i] = 1.0
    block[AT_DT * LANES + i] = dt
