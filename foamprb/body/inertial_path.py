"""The barycentre of a body with inertia over a step, in the stages that its shape has.

    dx/dt = v,   dv/dt = a + k (u(x, t) − v),   k_a = μ_f K_a/m along the axes of the particle frame.

The method is that of :mod:`foamprb.body.inertial_runge_kutta`, with J: (x, v) ↦ (v, −k v) and the drag at
the start of the step. The fluid's velocity is known beforehand at both ends of the step, and how it
begins to change: u₀ + s h a_u + s² (u₁ − u₀ − h a_u) with a_u = ∂u/∂t + ∇u·v. All vectors are components
in the particle frame of the step's start.
"""

from __future__ import annotations

from foamprb.body.exponential_runge_kutta import NODE, OVERSHOOT
from foamprb.body.inertial_runge_kutta import GAMMA, R1, R2, R3
from foamprb.body.tensor import Scalar, Vector, reciprocals, scale_vector

Motion = tuple[Vector, Vector]
"""A change of x and one of v, or rates of both."""
NOTHING: Motion = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def combine(a: Scalar, u: Vector, b: Scalar, v: Vector) -> Vector:
    """A u + b v."""
    return a * u[0] + b * v[0], a * u[1] + b * v[1], a * u[2] + b * v[2]


def _both(a: Scalar, u: Motion, b: Scalar, v: Motion) -> Motion:
    return combine(a, u[0], b, v[0]), combine(a, u[1], b, v[1])


def _times(u: Vector, v: Vector) -> Vector:
    return u[0] * v[0], u[1] * v[1], u[2] * v[2]


def _onto(k: int, u: Motion, v: Motion, w: Motion, s: Motion) -> Motion:
    """What the powers P^(k + 1) in r₁, r₂ and r₃ take of u, v and w, and s."""
    return _both(R1[k], u, 1.0, _both(R2[k], v, 1.0, _both(R3[k], w, 1.0, s)))


def respond(rate: Vector, h: Scalar, u: Motion, v: Motion, w: Motion) -> Motion:
    """H (r₁(hJ) u + r₂(hJ) v + r₃(hJ) w), as :func:`foamprb.body.inertial_runge_kutta.respond`.

    Parameters
    ----------
    rate
        k, 1/s.
    h
        The step, or a part of it, s.
    u, v, w
        Rates of x, m/s, and of v, m/s².
    """
    gh = GAMMA * h
    d = reciprocals((1.0 + gh * rate[0], 1.0 + gh * rate[1], 1.0 + gh * rate[2]))
    x, y = _onto(2, u, v, w, NOTHING)
    for k in (1, 0):
        y = _times(d, y)
        x = combine(1.0, x, gh, y)
        x, y = _onto(k, u, v, w, (x, y))
    y = _times(d, y)
    x = combine(1.0, x, gh, y)
    return scale_vector(h, x), scale_vector(h, y)


def fluid_changes(rate: Vector, h: Scalar, du: Vector, a_u: Vector) -> tuple[Vector, Vector]:
    """What the fluid's velocity changes of dv/dt over the step, m/s², and the part of it quadratic in time.

    Parameters
    ----------
    du
        u₁ − u₀, m/s.
    a_u
        ∂u/∂t + ∇u·v at the start, m/s².
    """
    return _times(rate, du), _times(rate, combine(1.0, du, -h, a_u))


def first_motion(rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector) -> Motion:
    """Change of x and v within a quarter of the step; ``start`` are v, m/s, and dv/dt, m/s², at its start."""
    linear = (NOTHING[0], combine(NODE, change, -NODE, bend))
    return respond(rate, NODE * h, start, linear, (NOTHING[0], scale_vector(2.0 * NODE * NODE, bend)))


def slope(rate: Vector, dv: Vector, at: Vector, start: Vector, change: Vector, per_step: Scalar) -> Motion:
    """What of the rates has changed beside J and the fluid, times ``per_step``; nothing of dx/dt = v has.

    Parameters
    ----------
    dv, at
        Change of v, and dv/dt there.
    start
        dv/dt at the start.
    change
        What the fluid's velocity has changed of it by then.
    """
    forces = combine(1.0, combine(1.0, at, -1.0, start), 1.0, _times(rate, dv))
    return NOTHING[0], scale_vector(per_step, combine(1.0, forces, -1.0, change))


def second_order(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion
) -> Motion:
    """Change of x and v over the step, of order 2."""
    linear = (slope[0], combine(1.0, slope[1], 1.0, combine(1.0, change, -1.0, bend)))
    return respond(rate, h, start, linear, (NOTHING[0], scale_vector(2.0, bend)))


def last_motion(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion
) -> Motion:
    """Change of x and v at the end of the step, for the last evaluation."""
    more = scale_vector(OVERSHOOT, slope[0]), scale_vector(OVERSHOOT, slope[1])
    return second_order(rate, h, start, change, bend, more)


def third_order(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion, last: Motion
) -> Motion:
    """Change of x and v over the step, of order 3."""
    f = 1.0 / (1.0 - NODE)
    curve = _both(f, last, -f, slope)
    fluid = NOTHING[0], combine(1.0, change, -1.0, bend)
    linear = _both(1.0, _both(1.0, last, -1.0, curve), 1.0, fluid)
    return respond(rate, h, start, linear, _both(2.0, curve, 2.0, (NOTHING[0], bend)))
