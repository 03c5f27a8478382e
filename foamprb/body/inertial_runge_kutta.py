"""Step of a body with inertia: the pair of order 3(2) of :mod:`foamprb.body.exponential_runge_kutta`.

The unknowns are Ω, with F = exp(Ω) F₀, and the body's velocity gradient l_s:

    dΩ/dt = l_s − ½[Ω, l_s] + …,   dl_s/dt = Ȧ F⁻¹ − l_s l_s.

The linear part J, the stiffness of :mod:`foamprb.body.rosenbrock`, couples in the particle frame the
components ij and ji of both, and the three ii of both. The φ_k of such large blocks have no short closed
form. They are replaced by the rational

    r₁(z) = (R(z) − 1)/z,   r_{k+1}(z) = (r_k(z) − 1/k!)/z,   R(z) = eᶻ + O(z⁴) with the threefold pole 1/γ,

which are A-stable with R(∞) = 0 for γ = 0.4359 (Nørsett 1974; Hairer & Wanner, Solving Ordinary Differential
Equations II, Table IV.6.4). This is a W-method (Steihaug & Wolfbrandt, Mathematics of Computation 33, 1979):
its order is 3 for any J. The r_k follow from R as the φ_k from the exponential. Rates linear or quadratic in
time are therefore integrated exactly for any stiffness: there is no order reduction in unsteady flow.

All tensors are components in the particle frame of the step's start. The arguments of the stages:

n; quarter, whole
    Stiffness of the shape, and its :func:`resolvent` for a quarter and for the whole of the step.
h
    The step, s.
rate
    l_s, 1/s, and dl_s/dt, 1/s², at the start.
change, bend
    :func:`fluid_change` over the step, and its part quadratic in time, 1/s².
turning
    :func:`turning_acceleration`, 1/s³.
slope, last
    :func:`slope` of the second and of the last evaluation.
"""

from __future__ import annotations

from typing import NamedTuple

from foamprb.body.exponential_runge_kutta import NODE, OVERSHOOT
from foamprb.body.rosenbrock import (
    Pull,
    Shear,
    Stiffness,
    elastic_response,
    elastic_response_to_spin,
    paired,
)
from foamprb.body.tensor import (
    ZERO,
    Scalar,
    Tensor,
    Vector,
    add,
    inverse,
    reciprocals,
    scale,
    scale_columns,
    skew,
    subtract,
    trace,
)
from foamprb.body.turning import shape_spin, turned

GAMMA = 0.435866521508458999416
"""Root of γ³ − 3γ² + 3/2 γ = 1/6 between 1/3 and 1.07."""


def _partial_fractions(c0: float, c1: float, c2: float) -> tuple[float, float, float]:
    """Return the weights of P, P² and P³ in (c₀ + c₁z + c₂z²) P³ with P = 1/(1 − γz)."""
    u, v = c1 / GAMMA, c2 / GAMMA**2
    return v, -u - 2.0 * v, c0 + u + v


R1 = _partial_fractions(1.0, 0.5 - 3.0 * GAMMA, GAMMA**3)
R2 = _partial_fractions(0.5, GAMMA**3 - 3.0 * GAMMA**2, GAMMA**3)
R3 = _partial_fractions(1.0 / 6.0, GAMMA**3 - 1.5 * GAMMA**2, 0.5 * GAMMA**3)
"""r₁, r₂ and r₃ as polynomials in P."""

Pair = tuple[Tensor, Tensor]
"""Changes of Ω and of l_s, or rates of both."""


class Resolvent(NamedTuple):
    """P = (1 − γh J)⁻¹ for one h."""

    gh: Scalar
    """γh, s."""
    normal: Tensor
    """Inverse matrix of the normal components of l_s."""
    pairs: tuple[Shear, Shear, Shear]
    """Inverse matrices of the pairs 23, 13 and 12."""


def _inverse_pairs(m: tuple[Shear, Shear, Shear]) -> tuple[Shear, Shear, Shear]:
    p, q, r = m
    f, g, h = reciprocals((p[0] * p[3] - p[1] * p[2], q[0] * q[3] - q[1] * q[2], r[0] * r[3] - r[1] * r[2]))
    return (
        (f * p[3], -f * p[1], -f * p[2], f * p[0]),
        (g * q[3], -g * q[1], -g * q[2], g * q[0]),
        (h * r[3], -h * r[1], -h * r[2], h * r[0]),
    )


def resolvent(n: Stiffness, h: Scalar) -> Resolvent:
    """Factorise 1 − γh J for the step h, or a part of it."""
    gh = GAMMA * h
    gh2 = gh * gh
    (x, y, z), t, e = n.b, n.traction, n.elastic
    M = (
        x - gh * t[0] + gh2 * e[0], gh2 * e[1] - gh * t[1], gh2 * e[2] - gh * t[2],
        gh2 * e[3] - gh * t[3], y - gh * t[4] + gh2 * e[4], gh2 * e[5] - gh * t[5],
        gh2 * e[6] - gh * t[6], gh2 * e[7] - gh * t[7], z - gh * t[8] + gh2 * e[8],
    )  # fmt: skip
    (p, q, r), (f, g, k) = n.traction_pairs, n.elastic_pairs
    pairs = _inverse_pairs(
        (
            _sheared(z, y, gh, p, gh2, f),
            _sheared(z, x, gh, q, gh2, g),
            _sheared(y, x, gh, r, gh2, k),
        )
    )
    return Resolvent(gh, inverse(M), pairs)


def _sheared(first: Scalar, second: Scalar, gh: Scalar, T: Shear, gh2: Scalar, E: Pull) -> Shear:
    return (
        first - gh * T[0] + gh2 * E[0], gh2 * E[1] - gh * T[1],
        gh2 * E[0] - gh * T[2], second - gh * T[3] + gh2 * E[1],
    )  # fmt: skip


def resolve(n: Stiffness, r: Resolvent, v: Pair) -> Pair:
    """Return P v, in the units of v: changes of Ω and of l_s, 1/s, or rates of both, 1/s and 1/s².

    ½ h P v is 0.96 to 1.15 of h r₂(hJ) v, the response to a rate v t/h, if J damps.
    """
    X, Y = v
    s = subtract(scale_columns(Y, n.b), scale(r.gh, elastic_response(n, X)))
    L = paired(r.normal, r.pairs, s)
    return add(X, scale(r.gh, L)), L


def _traction_response(n: Stiffness, Y: Tensor) -> Tensor:
    """Return the change of the traction's part of Ȧ Fᵀ by a change of l_s, 1/s²."""
    return paired(n.traction, n.traction_pairs, Y)


def over_b(b: Vector, T: Tensor) -> Tensor:
    """Return T b⁻¹ for the diagonal b."""
    return scale_columns(T, reciprocals(b))


def stiff_rate(n: Stiffness, v: Pair) -> Pair:
    """Return J v."""
    X, Y = v
    return Y, over_b(n.b, subtract(_traction_response(n, Y), elastic_response(n, X)))


def combine(a: Scalar, u: Pair, b: Scalar, v: Pair) -> Pair:
    """Return a u + b v."""
    return add(scale(a, u[0]), scale(b, v[0])), add(scale(a, u[1]), scale(b, v[1]))


def _onto(k: int, u: Pair, v: Pair, s: Pair) -> Pair:
    """Return s and the terms of the power P^(k + 1) of r₁ for u and of r₂ for v."""
    return combine(R1[k], u, 1.0, combine(R2[k], v, 1.0, s))


def respond(n: Stiffness, r: Resolvent, h: Scalar, u: Pair, v: Pair, w: Pair) -> Pair:
    """Return h (r₁(hJ) u + r₂(hJ) v + r₃(hJ) w), the response to rates u + v t/h + ½ w (t/h)².

    ``u``, ``v`` and ``w`` are rates of Ω, 1/s, and of l_s, 1/s².
    """
    s = resolve(n, r, combine(R3[2], w, 1.0, combine(R1[2], u, R2[2], v)))
    s = resolve(n, r, _onto(1, u, v, combine(R3[1], w, 1.0, s)))
    s = resolve(n, r, _onto(0, u, v, combine(R3[0], w, 1.0, s)))
    return scale(h, s[0]), scale(h, s[1])


def respond_to_line(n: Stiffness, r: Resolvent, h: Scalar, u: Pair, v: Pair) -> Pair:
    """Return :func:`respond` for rates u + v t/h."""
    s = resolve(n, r, combine(R1[2], u, R2[2], v))
    s = resolve(n, r, _onto(1, u, v, s))
    s = resolve(n, r, _onto(0, u, v, s))
    return scale(h, s[0]), scale(h, s[1])


def fluid_change(n: Stiffness, dl_f: Tensor) -> Tensor:
    """Return the change of dl_s/dt, 1/s², by a change δl_f, 1/s: c J μ_f σ̃(0; δl_f) b⁻¹.

    Apart from terms in l_s alone, 2 dev d_s − 4/3 tr(d_s) I and the solid's viscosity, the traction is a
    function of l_f − l_s (26). The response to l_f therefore follows from that to l_s.
    """
    return over_b(n.b, _fluid_stress(n, dl_f))


def _fluid_stress(n: Stiffness, dl_f: Tensor) -> Tensor:
    """Return the change of Ȧ Fᵀ by a change of l_f, 1/s²."""
    T, k = _traction_response(n, dl_f), n.weight * n.deficit
    third = (1.0 / 3.0) * trace(dl_f)
    twice, dilation = 2.0 * k, (2.0 * k + 4.0 * n.weight) * third
    p, q, r = k * (dl_f[5] + dl_f[7]), k * (dl_f[2] + dl_f[6]), k * (dl_f[1] + dl_f[3])
    return (
        twice * dl_f[0] - dilation - T[0], r - T[1], q - T[2],
        r - T[3], twice * dl_f[4] - dilation - T[4], p - T[5],
        q - T[6], p - T[7], twice * dl_f[8] - dilation - T[8],
    )  # fmt: skip


def turning_acceleration(
    stretches: Vector, n: Stiffness, c: Scalar, l_s: Tensor, rate: Tensor, l_f: Tensor, tau: Tensor
) -> Tensor:
    """Return the rate of change of dl_s/dt by rotation, less its stiff part, along the solution, 1/s³.

    See :func:`foamprb.body.turning.turning_gradient`. Shape, l_s and traction rotate with the W of
    :func:`foamprb.body.turning.shape_spin`, the stress with the body's own spin.

    ``n`` is the stiffness of the shape with the stretches λ_a, ``c`` is 5/(ρ_s R²), m/kg, ``rate`` dl_s/dt,
    1/s², ``tau`` the Kirchhoff stress, Pa.
    """
    W, spin = shape_spin(stretches, l_s), skew(l_s)
    stress = scale(-c, turned(subtract(spin, W), tau))
    traction = add(_traction_response(n, turned(W, l_s)), _fluid_stress(n, turned(W, l_f)))
    stress = add(stress, subtract(elastic_response_to_spin(n, spin), traction))
    return add(turned(W, rate), over_b(n.b, stress))


def first_argument(
    n: Stiffness, quarter: Resolvent, h: Scalar, rate: Pair, change: Tensor, turning: Tensor
) -> Pair:
    """Return Ω and the change of l_s at a quarter of the step."""
    bent = (ZERO, scale(NODE, add(change, scale(h, turning))))
    return respond_to_line(n, quarter, NODE * h, rate, bent)


def slope(n: Stiffness, v: Pair, at: Pair, rate: Pair, change: Tensor, per_step: Scalar) -> Pair:
    """Return the change of the non-stiff rates since the start, less the known one, times ``per_step``.

    Parameters
    ----------
    v, at
        An argument, and there :func:`foamprb.body.exponential_runge_kutta.algebra_excess` and the rate of
        l_s. The rate of Ω is l_s, which J v and the rate at the start cover, plus this excess.
    change
        The change by the fluid's gradient at that time.
    per_step
        4 for the second evaluation, 1 for the last.
    """
    _, stiff = stiff_rate(n, v)
    Y = subtract(at[1], add(add(stiff, rate[1]), change))
    return scale(per_step, at[0]), scale(per_step, Y)


def second_order(
    n: Stiffness,
    full: Resolvent,
    h: Scalar,
    rate: Pair,
    change: Tensor,
    slope: Pair,
    shares: tuple[Scalar, Scalar],
) -> tuple[Pair, Pair]:
    """Return Ω and change of l_s of order 2, and P of ``shares`` of slope and change, 1/s and 1/s².

    ½ h times the second result is about the contribution of these shares to the first (:func:`resolve`).
    """
    two = respond_to_line(n, full, h, rate, (slope[0], add(slope[1], change)))
    p, q = shares
    estimate = (scale(p, slope[0]), add(scale(p, slope[1]), scale(q, change)))
    return two, resolve(n, full, estimate)


def last_argument(
    n: Stiffness,
    full: Resolvent,
    h: Scalar,
    rate: Pair,
    change: Tensor,
    bend: Tensor,
    slope: Pair,
    turning: Tensor,
) -> Pair:
    """Return Ω and change of l_s at the end of the step, for the last evaluation."""
    drift = add(subtract(change, bend), scale((1.0 - OVERSHOOT) * h, turning))
    return respond(n, full, h, rate, combine(OVERSHOOT, slope, 1.0, (ZERO, drift)), (ZERO, scale(2.0, bend)))


def third_order(
    n: Stiffness,
    full: Resolvent,
    h: Scalar,
    rate: Pair,
    change: Tensor,
    bend: Tensor,
    slope: Pair,
    last: Pair,
) -> Pair:
    """Return Ω and change of l_s of order 3 at the end of the step."""
    f = 1.0 / (1.0 - NODE)
    curve = combine(f, last, -f, slope)
    linear = combine(1.0, combine(1.0, last, -1.0, curve), 1.0, (ZERO, subtract(change, bend)))
    return respond(n, full, h, rate, linear, combine(2.0, curve, 2.0, (ZERO, bend)))
