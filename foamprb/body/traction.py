"""Traction of Stokes flow on an ellipsoid, as an equivalent uniform Cauchy-type stress σ̃.

t̃ = σ̃·n on the surface (27). All tensors are components in the particle frame, whose axes are those of the
ellipsoid, in any order. ``semi_axes`` and ``g`` are a, b, c and :func:`foamprb.body.ellipsoid.integrals` of
them, in one unit of length.
"""

from __future__ import annotations

from collections.abc import Callable

from foamprb.body.choice import choice
from foamprb.body.ellipsoid import Integrals
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    add_identity,
    dev,
    reciprocals,
    scale,
    skew,
    subtract,
    sym,
    trace,
)


def _pair(
    f: Scalar, a2: Scalar, b2: Scalar, alpha: Scalar, beta: Scalar, ring: Scalar, d21: Scalar, w21: Scalar
) -> tuple[Scalar, Scalar]:
    """Return H and H° (B.8), f = 1/(γ₀°(a²α₀ + b²β₀)); (B.6) and (B.7) are cyclic permutations."""
    h = 0.5 * f
    return h * (alpha * d21 - b2 * ring * w21), h * (beta * d21 + a2 * ring * w21)


def shear_factors(semi_axes: Vector, g: Integrals) -> Vector:
    """Return 1/(α₀°(b²β₀ + c²γ₀)) of (B.6), and those of (B.7) and (B.8), in length⁶."""
    x, y, z = semi_axes
    a, b, c = x * x * g.alpha[0], y * y * g.alpha[1], z * z * g.alpha[2]
    return reciprocals((g.ring[0] * (b + c), g.ring[1] * (c + a), g.ring[2] * (a + b)))


def disturbance(semi_axes: Vector, g: Integrals, d: Tensor, w: Tensor) -> tuple[Tensor, Scalar]:
    """Return Jeffery's s̃(d, w) (B.5) and the pressure 4(α₀A + β₀B + γ₀C) of (B.1) for unit viscosity.

    ``d`` and ``w`` are deviatoric rate of deformation and spin of the flow relative to the body, 1/s.
    """
    a, b, c = semi_axes
    (alpha, beta, gamma), (alpha_r, beta_r, gamma_r), (alpha_s, beta_s, gamma_s) = g.alpha, g.ring, g.star
    n = 1.0 / (6.0 * (alpha_s * beta_s + beta_s * gamma_s + gamma_s * alpha_s))
    x, y, z = alpha_s * d[0], beta_s * d[4], gamma_s * d[8]
    A, B, C = n * (2.0 * x - y - z), n * (2.0 * y - z - x), n * (2.0 * z - x - y)
    a2, b2, c2 = a * a, b * b, c * c
    f, g_, h = shear_factors(semi_axes, g)
    F, F_ring = _pair(f, b2, c2, beta, gamma, alpha_r, d[7], w[7])
    G, G_ring = _pair(g_, c2, a2, gamma, alpha, beta_r, d[2], w[2])
    H, H_ring = _pair(h, a2, b2, alpha, beta, gamma_r, d[3], w[3])
    k = 8.0 / (a * b * c)
    s = (k * A, k * H, k * G_ring, k * H_ring, k * B, k * F, k * G, k * F_ring, k * C)
    return s, 4.0 * (alpha * A + beta * B + gamma * C)


def roscoe(semi_axes: Vector, g: Integrals, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Return Roscoe's traction on a deforming ellipsoid, σ̃/μ_f (26), (27), 1/s.

    σ̃/μ_f = −p̃ I + s̃(d, w) + 2 dev d_s − 4/3 tr(d_s) I with d = dev(d_f − dev d_s), w = w_f − w_s. The
    paper prints 2 d_s; both agree if the body keeps its volume. With a dilation, −4/3 tr(d_s) I follows from
    the exact flow around an expanding sphere, and a traceless d from Jeffery's far field.

    ``l_f`` and ``l_s`` are the velocity gradients of fluid and body, ∂u_i/∂x_j, particle frame, 1/s.
    """
    dilation = trace(l_s)
    e_s = add_identity(sym(l_s), dilation * (-1.0 / 3.0))
    d = subtract(dev(sym(l_f)), e_s)
    s, pressure = disturbance(semi_axes, g, d, subtract(skew(l_f), skew(l_s)))
    return add_identity(add(s, scale(2.0, e_s)), -pressure - 4.0 / 3.0 * dilation)


def jeffery(semi_axes: Vector, g: Integrals, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Return Jeffery's traction on a rigid ellipsoid, σ̃/μ_f (25), 1/s: :func:`roscoe` without d_s.

    It is not valid for soft particles: their orientation then stays at 45° in shear (Fig. 7 of the paper).
    """
    return roscoe(semi_axes, g, l_f, skew(l_s))


@choice
def traction(semi_axes: Vector, g: Integrals, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Return σ̃/μ_f, 1/s, of the chosen traction; by default :func:`roscoe`."""
    return roscoe(semi_axes, g, l_f, l_s)


Traction = Callable[[Vector, Integrals, Tensor, Tensor], Tensor]

TRACTIONS: dict[str, Traction] = {"roscoe": roscoe, "jeffery": jeffery}
