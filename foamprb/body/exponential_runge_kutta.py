"""A step of the body without inertia: an exponential Runge–Kutta pair of order 3(2) for dF/dt = l_s(F, t) F.

With F = exp(Ω) F₀, Ω(0) = 0, the step solves (Magnus 1954; Munthe-Kaas 1998)

    dΩ/dt = g(Ω, t) = l − ½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]] + …,   l = l_s(exp(Ω) F₀, t),

where g = J Ω + N(Ω, t). J, the relaxation of the elastic stress (:mod:`foamprb.body.relaxation`), is
solved exactly; N, which is not stiff, is a polynomial in time (Hochbruck & Ostermann, Acta Numerica 19,
2010) through its values at 0, ¼ and 1 of the step. With b = (−1/6, 8/9, 5/18) and a₃₂ = 12/5 these are
the nodes of an explicit method of order 3, so that the step is of order 3 whatever J is. Two parts of the
change of N are known beforehand and solved as exactly as J: that by the fluid's gradient, in which l_s is
linear, and that by the turning of the body (:mod:`foamprb.body.turning`). So a nearly rigid body that
turns, or is sheared unsteadily, has its *strain* to that order too.

A step goes as follows; tensors are components in the particle frame of its start.

1. l_s, J and the known rates of change at 0 give Ω(¼), :func:`first_argument`.
2. g there gives the :func:`slope` of N, and :func:`second_order` the solution of order 2. That is enough
   where its error, a share of the part that the slope has in it, is below the tolerance.
3. Else Ω(1) is :func:`last_argument`. g there gives :func:`third_order`. The difference of the two solutions
   is the error of the first. Both errors: :mod:`foamprb.body.error_control`.
"""

from __future__ import annotations

from foamprb.body.relaxation import (
    Relaxation,
    Response,
    relaxing,
    respond,
    respond_to_constant,
    respond_to_slope,
)
from foamprb.body.tensor import Scalar, Tensor, add, add_identity, det, dot, inverse, scale, trace
from foamprb.body.turning import commutator

NODE = 0.25
"""Time of the second evaluation, in steps."""
WEIGHTS = (-1.0 / 6.0, 8.0 / 9.0, 5.0 / 18.0)
"""Quadrature weights of the three evaluations: ∫ of the parabola through them."""
OVERSHOOT = 1.2
"""Share of the slope of N with which the last argument is formed: b₃ a₃₂ c₂ = 1/6 for 1/(3 b₃)."""


def group_exponential(K: Tensor) -> Tensor:
    """Exp K to sixth order, and a rotation for a skew K: within 1e-5 for a turn of half a radian.

    exp K = (1 − k)⁻¹·(1 + k) = 2 (1 − k)⁻¹ − 1 with k = tanh(K/2) = K/2 − K³/24 + K⁵/240 + O(K⁷). One term
    more than :func:`foamprb.body.tensor.exponential`, as no estimate sees the error of the exponential. The
    powers are those of K³ = I₁K² − I₂K + I₃ (Cayley and Hamilton).
    """
    square = dot(K, K)
    I1, I3 = trace(K), det(K)
    I2 = 0.5 * (I1 * I1 - trace(square))
    a = I1 * I1 - I2
    constant = I3 * ((1.0 / 240.0) * a - 1.0 / 24.0)
    linear = 0.5 + (1.0 / 24.0) * I2 + (1.0 / 240.0) * (I1 * I3 - I2 * a)
    quadratic = (1.0 / 240.0) * (I1 * (a - I2) + I3) - (1.0 / 24.0) * I1
    k = add_identity(add(scale(linear, K), scale(quadratic, square)), constant)
    return add_identity(scale(2.0, inverse(add_identity(scale(-1.0, k), 1.0))), -1.0)


def algebra_rate(Omega: Tensor, l: Tensor) -> Tensor:
    """G = l − ½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]], the rate of Ω where F = exp(Ω) F₀ has the velocity gradient l.

    What is left out is of fourth order in Ω.
    """
    return add(l, algebra_excess(Omega, l))


def algebra_excess(Omega: Tensor, l: Tensor) -> Tensor:
    """What the rate of Ω has beside l: −½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]]."""
    c = commutator(Omega, l)
    return add(scale(-0.5, c), scale(1.0 / 12.0, commutator(Omega, c)))


def _plus(S: Tensor, k: Scalar, T: Tensor) -> Tensor:
    return add(S, scale(k, T))


def first_argument(
    n: Relaxation, quarter: Response, h: Scalar, l_s: Tensor, change: Tensor, turning: Tensor
) -> Tensor:
    """Ω at a quarter of the step.

    Parameters
    ----------
    n, quarter
        J, and its functions for a quarter of the step.
    h
        The step, s.
    l_s
        Velocity gradient of the body at the start, 1/s.
    change
        By how much the change of the fluid's gradient over the step would change l_s, 1/s.
    turning
        :func:`foamprb.body.turning.turning_gradient`, 1/s².
    """
    by_change = respond_to_slope(n, quarter, NODE * h, scale(NODE, _plus(change, h, turning)))
    return add(respond_to_constant(n, quarter, NODE * h, l_s), by_change)


def slope(n: Relaxation, Omega: Tensor, g: Tensor, l_s: Tensor, change: Tensor, per_step: Scalar) -> Tensor:
    """Change of N since the start of the step beside that by the fluid's gradient, times ``per_step``, 1/s.

    Parameters
    ----------
    Omega, g
        An argument and :func:`algebra_rate` there.
    change
        What the fluid's gradient has changed by then.
    per_step
        4 for the second evaluation, 1 for the last.
    """
    return scale(per_step, _plus(_plus(_plus(g, -1.0, relaxing(n, Omega)), -1.0, l_s), -1.0, change))


def second_order(
    n: Relaxation, whole: Response, h: Scalar, l_s: Tensor, change: Tensor, slope: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Ω of order 2 at the end of the step, and the parts of it that the fluid's gradient and N' have."""
    fluid, own = respond_to_slope(n, whole, h, change), respond_to_slope(n, whole, h, slope)
    return add(respond_to_constant(n, whole, h, l_s), add(fluid, own)), fluid, own


def last_argument(
    n: Relaxation,
    whole: Response,
    h: Scalar,
    l_s: Tensor,
    change: Tensor,
    bend: Tensor,
    slope: Tensor,
    turning: Tensor,
) -> Tensor:
    """Ω at the end of the step at which g is evaluated for the last time.

    Parameters
    ----------
    bend
        The part of ``change`` that is quadratic in time, 1/s.
    slope
        :func:`slope` of the second evaluation.
    """
    rate = add(_plus(change, -1.0, bend), _plus(scale(OVERSHOOT, slope), (1.0 - OVERSHOOT) * h, turning))
    return respond(n, whole, h, l_s, rate, scale(2.0, bend))


def third_order(
    n: Relaxation,
    whole: Response,
    h: Scalar,
    l_s: Tensor,
    change: Tensor,
    bend: Tensor,
    slope: Tensor,
    last: Tensor,
) -> Tensor:
    """Ω of order 3 at the end of the step, N being a parabola through its three values.

    Parameters
    ----------
    slope, last
        :func:`slope` of the second and of the last evaluation.
    """
    curve = scale(1.0 / (1.0 - NODE), _plus(last, -1.0, slope))
    rate = add(_plus(change, -1.0, bend), _plus(last, -1.0, curve))
    return respond(n, whole, h, l_s, rate, scale(2.0, add(bend, curve)))
