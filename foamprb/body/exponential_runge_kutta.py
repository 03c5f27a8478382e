"""Step of a body without inertia: an exponential Runge–Kutta pair of order 3(2) for dF/dt = l_s(F, t) F.

With F = exp(Ω) F₀, Ω(0) = 0, the step solves (Magnus 1954; Munthe-Kaas 1998)

    dΩ/dt = g(Ω, t) = l − ½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]] + …,   l = l_s(exp(Ω) F₀, t),

where g = J Ω + N(Ω, t). J, the relaxation of the elastic stress (:mod:`foamprb.body.relaxation`), is solved
exactly. N is not stiff. It is a polynomial in time (Hochbruck & Ostermann, Acta Numerica 19, 2010) through
its values at 0, ¼ and 1 of the step. With b = (−1/6, 8/9, 5/18) and a₃₂ = 12/5 these are the nodes of an
explicit method of order 3, so the step is of order 3 for any J. Two parts of the change of N are known in
advance and solved exactly as well: the change by the fluid's gradient, in which l_s is linear, and the change
by the rotation of the body (:mod:`foamprb.body.turning`). The *strain* of a nearly rigid body that rotates,
or is sheared unsteadily, is therefore of order 3 too.

A step consists of these parts:

1. l_s, J and the known rates of change at 0 give Ω(¼), :func:`first_argument`.
2. g there gives the :func:`slope` of N, and :func:`second_order` the solution of order 2. It is accepted if
   its error, a share of the slope's contribution, is below the tolerance.
3. Otherwise :func:`last_argument` gives Ω(1), and g there :func:`third_order`. The difference of the two
   solutions is the error of the first. Both errors: :mod:`foamprb.body.error_control`.

Tensors are components in the particle frame of the step's start. The arguments of the stages:

n; quarter, whole
    J, and its :class:`foamprb.body.relaxation.Response` for a quarter and for the whole of the step.
h
    The step, s.
l_s
    Velocity gradient of the body at the start, 1/s.
change, bend
    Change of l_s by the change of the fluid's gradient over the step, and its part quadratic in time, 1/s.
turning
    :func:`foamprb.body.turning.turning_gradient`, 1/s².
slope, last
    :func:`slope` of the second and of the last evaluation, 1/s.
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
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    add_identity,
    add_scaled,
    det,
    dot,
    inverse,
    scale,
    subtract,
    trace,
)
from foamprb.body.turning import commutator

NODE = 0.25
"""Time of the second evaluation, in steps."""
OVERSHOOT = 1.2
"""Share of the slope of N with which the last argument is formed: b₃ a₃₂ c₂ = 1/6 for 1/(3 b₃)."""


def group_exponential(K: Tensor) -> Tensor:
    """Return exp K to sixth order, a rotation for a skew K; within 1e-5 for a rotation by half a radian.

    exp K = (1 − k)⁻¹·(1 + k) = 2 (1 − k)⁻¹ − 1, a Cayley transform, with k = tanh(K/2) = K/2 − K³/24 + K⁵/240
    + O(K⁷). No error estimate covers the exponential, hence the sixth order. Powers follow from
    K³ = I₁K² − I₂K + I₃ (Cayley and Hamilton).
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
    """Return g = l − ½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]], the rate of Ω if F = exp(Ω) F₀ has the velocity gradient l.

    The remainder is of fourth order in Ω.
    """
    return add(l, algebra_excess(Omega, l))


def algebra_excess(Omega: Tensor, l: Tensor) -> Tensor:
    """Return −½[Ω, l] + ¹⁄₁₂[Ω, [Ω, l]], the rate of Ω less l."""
    c = commutator(Omega, l)
    return add(scale(-0.5, c), scale(1.0 / 12.0, commutator(Omega, c)))


def first_argument(
    n: Relaxation, quarter: Response, h: Scalar, l_s: Tensor, change: Tensor, turning: Tensor
) -> Tensor:
    """Return Ω at a quarter of the step."""
    by_change = respond_to_slope(n, quarter, NODE * h, scale(NODE, add_scaled(change, h, turning)))
    return add(respond_to_constant(n, quarter, NODE * h, l_s), by_change)


def slope(n: Relaxation, Omega: Tensor, g: Tensor, l_s: Tensor, change: Tensor, per_step: Scalar) -> Tensor:
    """Return the change of N since the start of the step, less the known one, times ``per_step``, 1/s.

    Parameters
    ----------
    Omega, g
        An argument and :func:`algebra_rate` there.
    change
        The change by the fluid's gradient at that time.
    per_step
        4 for the second evaluation, 1 for the last.
    """
    return scale(per_step, subtract(subtract(subtract(g, relaxing(n, Omega)), l_s), change))


def second_order(
    n: Relaxation, full: Response, h: Scalar, l_s: Tensor, change: Tensor, slope: Tensor
) -> tuple[Tensor, Tensor, Tensor]:
    """Return Ω of order 2 at the end of the step, and the contributions of the fluid's gradient and of N'."""
    by_fluid, by_slope = respond_to_slope(n, full, h, change), respond_to_slope(n, full, h, slope)
    return add(respond_to_constant(n, full, h, l_s), add(by_fluid, by_slope)), by_fluid, by_slope


def last_argument(
    n: Relaxation,
    full: Response,
    h: Scalar,
    l_s: Tensor,
    change: Tensor,
    bend: Tensor,
    slope: Tensor,
    turning: Tensor,
) -> Tensor:
    """Return Ω at the end of the step, for the last evaluation of g."""
    drift = add_scaled(scale(OVERSHOOT, slope), (1.0 - OVERSHOOT) * h, turning)
    rate = add(subtract(change, bend), drift)
    return respond(n, full, h, l_s, rate, scale(2.0, bend))


def third_order(
    n: Relaxation,
    full: Response,
    h: Scalar,
    l_s: Tensor,
    change: Tensor,
    bend: Tensor,
    slope: Tensor,
    last: Tensor,
) -> Tensor:
    """Return Ω of order 3 at the end of the step, with N a parabola through its three values."""
    curve = scale(1.0 / (1.0 - NODE), subtract(last, slope))
    rate = add(subtract(change, bend), subtract(last, curve))
    return respond(n, full, h, l_s, rate, scale(2.0, add(bend, curve)))
