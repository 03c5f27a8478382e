"""Traction of Stokes flow on an ellipsoid, as the uniform Cauchy-type stress σ̃ that equals it.

t̃ = σ̃·n on the surface (27). All tensors here are components in the particle frame, whose axes are those of
the ellipsoid; the order of the axes does not matter.
"""

from __future__ import annotations

from collections.abc import Callable

from foamprb.body.ellipsoid import Integrals
from foamprb.body.tensor import Scalar, Tensor, Vector, add_identity, dev, reciprocals, skew, sym, trace


def _pair(
    f: Scalar, a2: Scalar, b2: Scalar, alpha: Scalar, beta: Scalar, ring: Scalar, d21: Scalar, w21: Scalar
) -> tuple[Scalar, Scalar]:
    """H and H° (B.8) of the axes a, b with f = 1/(γ₀°(a²α₀ + b²β₀)); (B.6), (B.7) are cyclic permutations."""
    h = 0.5 * f
    return h * (alpha * d21 - b2 * ring * w21), h * (beta * d21 + a2 * ring * w21)


def shear_factors(semi_axes: Vector, g: Integrals) -> Vector:
    """1/(α₀°(b²β₀ + c²γ₀)) of (B.6), and those of (B.7) and (B.8).

    Parameters
    ----------
    semi_axes, g
        As of :func:`disturbance`; the result has the sixth power of their unit of length.
    """
    x, y, z = semi_axes
    a, b, c = x * x * g.alpha[0], y * y * g.alpha[1], z * z * g.alpha[2]
    return reciprocals((g.ring[0] * (b + c), g.ring[1] * (c + a), g.ring[2] * (a + b)))


def disturbance(semi_axes: Vector, g: Integrals, d: Tensor, w: Tensor) -> tuple[Tensor, Scalar]:
    """Jeffery's s̃(d, w) (B.5) and the pressure 4(α₀A + β₀B + γ₀C) of (B.1) for unit viscosity.

    Parameters
    ----------
    semi_axes, g
        a, b, c and their integrals, in one unit of length.
    d, w
        Deviatoric rate of deformation and spin of the flow relative to the body, 1/s.
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
    """Roscoe's traction on a deforming ellipsoid, σ̃/μ_f (26), (27), 1/s.

    σ̃/μ_f = −p̃ I + s̃(d, w) + 2 dev d_s − 4/3 tr(d_s) I with d = dev(d_f − dev d_s), w = w_f − w_s. The
    paper prints 2 d_s; the two agree where the body keeps its volume. With a dilation, the exact flow around
    an expanding sphere asks for −4/3 tr(d_s) I, and Jeffery's far field for a traceless d.

    Parameters
    ----------
    semi_axes, g
        a, b, c and :func:`foamprb.body.ellipsoid.integrals` of them, in one unit of length.
    l_f, l_s
        Velocity gradients of the fluid and of the body, ∂u_i/∂x_j, particle frame, 1/s.
    """
    d_s = sym(l_s)
    dilation = trace(l_s)
    e_s = add_identity(d_s, dilation * (-1.0 / 3.0))
    d_f = dev(sym(l_f))
    w_f, w_s = skew(l_f), skew(l_s)
    d = (
        d_f[0] - e_s[0], d_f[1] - e_s[1], d_f[2] - e_s[2],
        d_f[3] - e_s[3], d_f[4] - e_s[4], d_f[5] - e_s[5],
        d_f[6] - e_s[6], d_f[7] - e_s[7], d_f[8] - e_s[8],
    )  # fmt: skip
    w = (
        w_f[0], w_f[1] - w_s[1], w_f[2] - w_s[2],
        w_f[3] - w_s[3], w_f[4], w_f[5] - w_s[5],
        w_f[6] - w_s[6], w_f[7] - w_s[7], w_f[8],
    )  # fmt: skip
    s, pressure = disturbance(semi_axes, g, d, w)
    sphere = -pressure - 4.0 / 3.0 * dilation
    return (
        s[0] + 2.0 * e_s[0] + sphere, s[1] + 2.0 * e_s[1], s[2] + 2.0 * e_s[2],
        s[3] + 2.0 * e_s[3], s[4] + 2.0 * e_s[4] + sphere, s[5] + 2.0 * e_s[5],
        s[6] + 2.0 * e_s[6], s[7] + 2.0 * e_s[7], s[8] + 2.0 * e_s[8] + sphere,
    )  # fmt: skip


def jeffery(semi_axes: Vector, g: Integrals, l_f: Tensor, l_s: Tensor) -> Tensor:
    """Jeffery's traction on a rigid ellipsoid, σ̃/μ_f (25), 1/s: :func:`roscoe` without d_s.

    Not enough for soft particles, whose orientation then stays at 45° in shear (Fig. 7 of the paper).
    """
    return roscoe(semi_axes, g, l_f, skew(l_s))


Traction = Callable[[Vector, Integrals, Tensor, Tensor], Tensor]

TRACTIONS: dict[str, Traction] = {"roscoe": roscoe, "jeffery": jeffery}
