"""The paper's scheme in plain numpy: the formulas of :mod:`foamprb.body` on arrays.

The flow is Poiseuille's. There is no mesh, no wall and no patch, which spares it what locating and sampling
cost.
"""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from benchmarks import pipe
from foamprb.body.drag import implicit_euler, oberbeck, reduced_gravity
from foamprb.body.ellipsoid import integrals
from foamprb.body.imex import advance, inertia_factor
from foamprb.body.material import lame_parameter
from foamprb.body.tensor import (
    Tensor,
    Vector,
    add,
    det,
    dot,
    inverse,
    refined_frame,
    scale,
    stretches_in_frame,
    to_frame,
    transpose,
)
from foamprb.body.traction import roscoe

Floats = NDArray[np.float64]

_CHUNK, _SKEWNESS = 8192, 1e-20
_GRAVITY = (0.0, -9.81, 0.0)
_UNIT = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


class State(NamedTuple):
    """Particles of one kind: components of arrays (n,), as of :class:`foamprb.cloud.state.Particles`."""

    x: Vector
    v: Vector
    F: Tensor
    A: Tensor
    Q: Tensor


def at_rest(x: Floats) -> State:
    """Return spheres moving with the flow, at the places (n, 3)."""

    def each(values: tuple[float, ...]) -> Tensor:
        return tuple(np.full(len(x), value) for value in values)  # type: ignore[return-value]

    v = pipe.poiseuille(x)
    return State(tuple(x.T.copy()), tuple(v.T.copy()), each(_UNIT), each((0.0,) * 9), each(_UNIT))  # type: ignore[arg-type]


def step(s: State, dt: float, Ca: float, poissons_ratio: float, fluid: pipe.Fluid = pipe.AIR) -> State:
    """Take one step of the paper's scheme, (46) to (50) and (36) to (43), like its integrator."""
    mu_f, R = fluid.rho * fluid.nu, pipe.D / 2
    mu = mu_f * pipe.WALL_RATE / Ca
    zero = np.zeros_like(s.x[0])
    c = 2.0 * pipe.MEAN / pipe.RADIUS**2
    u = (2.0 * pipe.MEAN - c * (s.x[1] ** 2 + s.x[2] ** 2), zero, zero)
    l = (zero, -2.0 * c * s.x[1], -2.0 * c * s.x[2], zero, zero, zero, zero, zero, zero)

    stretches, _ = stretches_in_frame(s.F, s.Q)
    l_s = to_frame(s.Q, dot(s.A, inverse(s.F)))
    stress = scale(mu_f, roscoe(stretches, integrals(stretches), to_frame(s.Q, l), l_s))
    predictor = dot(s.Q, add(s.F, scale(dt, s.A)))
    kappa = inertia_factor(dt, fluid.rho_s, R)
    G, _ = advance(predictor, stress, kappa, mu, lame_parameter(mu, poissons_ratio), _UNIT)
    F = dot(transpose(s.Q), G)
    A = scale(1.0 / dt, add(F, scale(-1.0, s.F)))

    Q, skewness = s.Q, np.array(np.inf)
    while skewness.max() > _SKEWNESS:
        Q = refined_frame(F, Q)
        stretches, skewness = stretches_in_frame(F, Q)
    k = oberbeck(stretches, integrals(stretches))
    rate = mu_f / (4.0 / 3.0 * math.pi * R * R * fluid.rho_s)
    a = reduced_gravity(det(F), fluid.rho_s, fluid.rho, _GRAVITY)
    v = implicit_euler(s.v, u, Q, (rate * k[0], rate * k[1], rate * k[2]), a, dt)
    x = (s.x[0] + dt * v[0], s.x[1] + dt * v[1], s.x[2] + dt * v[2])
    return State(x, v, F, A, Q)


def carry(x: Floats, steps: int, dt: float, Ca: float = 0.5, poissons_ratio: float = 0.499) -> list[State]:
    """Carry particles from the places (n, 3) through so many steps, some thousands at a time."""
    found = []
    for begin in range(0, len(x), _CHUNK):
        state = at_rest(x[begin : begin + _CHUNK])
        for _ in range(steps):
            state = step(state, dt, Ca, poissons_ratio)
        found.append(state)
    return found
