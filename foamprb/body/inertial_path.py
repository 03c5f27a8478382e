"""Path of the barycentre of a body with inertia over a step, in the stages of its shape.

    dx/dt = v,   dv/dt = a + k (u(x, t) − v),   k_a = μ_f K_a/m along the axes of the particle frame.

The method is that of :mod:`foamprb.body.inertial_runge_kutta`, with J: (x, v) ↦ (v, −k v) and the drag at the
start of the step. The fluid's velocity is known in advance at both ends of the step, and its rate of change
at the start: u₀ + s h a_u + s² (u₁ − u₀ − h a_u) with a_u = ∂u/∂t + ∇u·v.

All vectors are components in the particle frame of the step's start. Common arguments: ``rate`` is k, 1/s;
``h`` the step, s; ``start`` v, m/s, and dv/dt, m/s², at its start; ``change`` and ``bend`` those of
:func:`fluid_changes`; ``slope`` and ``last`` :func:`slope` of the second and of the last evaluation.
"""

from __future__ import annotations

from foamprb.body.exponential_runge_kutta import NODE, OVERSHOOT
from foamprb.body.inertial_runge_kutta import GAMMA, R1, R2, R3
from foamprb.body.tensor import Scalar, Vector, reciprocals, scale_vector
from foamprb.body.tensor import combine_vectors as combine

Motion = tuple[Vector, Vector]
"""Changes of x and of v, or rates of both."""
NOTHING: Motion = (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)


def _both(a: Scalar, u: Motion, b: Scalar, v: Motion) -> Motion:
    return combine(a, u[0], b, v[0]), combine(a, u[1], b, v[1])


def _times(u: Vector, v: Vector) -> Vector:
    return u[0] * v[0], u[1] * v[1], u[2] * v[2]


def _onto(k: int, u: Motion, v: Motion, w: Motion, s: Motion) -> Motion:
    """Return s and the terms of the power P^(k + 1) of r₁ for u, r₂ for v and r₃ for w."""
    return _both(R1[k], u, 1.0, _both(R2[k], v, 1.0, _both(R3[k], w, 1.0, s)))


def respond(rate: Vector, h: Scalar, u: Motion, v: Motion, w: Motion) -> Motion:
    """Return h (r₁(hJ) u + r₂(hJ) v + r₃(hJ) w); see :func:`foamprb.body.inertial_runge_kutta.respond`.

    ``u``, ``v`` and ``w`` are rates of x, m/s, and of v, m/s²; ``h`` is the step or a part of it.
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
    """Return the change of dv/dt by the fluid's velocity over the step, m/s², and its part quadratic in time.

    Parameters
    ----------
    du
        u₁ − u₀, m/s.
    a_u
        ∂u/∂t + ∇u·v at the start, m/s².
    """
    return _times(rate, du), _times(rate, combine(1.0, du, -h, a_u))


def first_motion(rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector) -> Motion:
    """Return the change of x and v within a quarter of the step."""
    linear = (NOTHING[0], combine(NODE, change, -NODE, bend))
    return respond(rate, NODE * h, start, linear, (NOTHING[0], scale_vector(2.0 * NODE * NODE, bend)))


def slope(rate: Vector, dv: Vector, at: Vector, start: Vector, change: Vector, per_step: Scalar) -> Motion:
    """Return the change of the rates less J and the fluid's part, times ``per_step``; that of dx/dt is 0.

    Parameters
    ----------
    dv, at
        Change of v, and dv/dt there.
    start
        dv/dt at the start.
    change
        The part of the fluid's velocity at that time.
    """
    forces = combine(1.0, combine(1.0, at, -1.0, start), 1.0, _times(rate, dv))
    return NOTHING[0], scale_vector(per_step, combine(1.0, forces, -1.0, change))


def second_order(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion
) -> Motion:
    """Return the change of x and v over the step, of order 2."""
    linear = (slope[0], combine(1.0, slope[1], 1.0, combine(1.0, change, -1.0, bend)))
    return respond(rate, h, start, linear, (NOTHING[0], scale_vector(2.0, bend)))


def last_motion(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion
) -> Motion:
    """Return the change of x and v at the end of the step, for the last evaluation."""
    more = scale_vector(OVERSHOOT, slope[0]), scale_vector(OVERSHOOT, slope[1])
    return second_order(rate, h, start, change, bend, more)


def third_order(
    rate: Vector, h: Scalar, start: Motion, change: Vector, bend: Vector, slope: Motion, last: Motion
) -> Motion:
    """Return the change of x and v over the step, of order 3."""
    f = 1.0 / (1.0 - NODE)
    curve = _both(f, last, -f, slope)
    fluid = NOTHING[0], combine(1.0, change, -1.0, bend)
    linear = _both(1.0, _both(1.0, last, -1.0, curve), 1.0, fluid)
    return respond(rate, h, start, linear, _both(2.0, curve, 2.0, (NOTHING[0], bend)))
