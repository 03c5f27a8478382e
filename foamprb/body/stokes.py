"""Shape without inertia: the balance of traction and elastic stress determines the rate of deformation.

σ̃(l_s; l_f) − 2 η_s d_s = σ(F) is linear in the body's velocity gradient l_s. In the particle frame the
components ij and ji decouple from the rest. The diagonal ones form a 3×3 system with the pressure that keeps
the volume exactly. All tensors are components in that frame.
"""

from __future__ import annotations

from typing import NamedTuple

from foamprb.body.ellipsoid import Integrals
from foamprb.body.tensor import Scalar, Tensor, Vector, dot_vector, inverse, reciprocals, scale


class Mobility(NamedTuple):
    """Response of l_s to the elastic stress, and of the traction to the fluid."""

    normal: Tensor
    """d_s,aa for unit changes of (σ_cc − traction of the fluid)/μ_f; traceless for any stress."""
    compliance: Vector
    """1/(2/(abc α₀°(b² + c²)) − 1 + η_s/μ_f) and its cyclic companions, for 23, 13 and 12."""
    slip: Vector
    """(b² − c²)/(b² + c²), (a² − c²)/(a² + c²), (a² − b²)/(a² + b²)."""
    deficit: Scalar
    """1 − η_s/μ_f."""


def mobility(semi_axes: Vector, g: Integrals, eta: Scalar) -> Mobility:
    """Return the response.

    ``semi_axes`` and ``g`` are a, b, c and their integrals, in one unit of length, ``eta`` the viscosity of
    the solid over that of the fluid.
    """
    a, b, c = semi_axes
    s = g.star
    f = 8.0 / (6.0 * (s[0] * s[1] + s[1] * s[2] + s[2] * s[0]) * (a * b * c))
    # s̃_aa of unit d_cc; −2 times the first for a = c, as s̃ is traceless.
    p, q, r = f * s[0], f * s[1], f * s[2]
    # The sum of d_s,aa vanishes, so 1 may be added to every entry; this keeps the matrix regular.
    deficit = 1.0 - eta
    n = 1.0 + 2.0 * deficit
    T = (
        n - 2.0 * p, q + 1.0, r + 1.0,
        p + 1.0, n - 2.0 * q, r + 1.0,
        p + 1.0, q + 1.0, n - 2.0 * r,
    )  # fmt: skip
    W = inverse(T)
    rows = (W[0] + W[1] + W[2], W[3] + W[4] + W[5], W[6] + W[7] + W[8])
    columns = (W[0] + W[3] + W[6], W[1] + W[4] + W[7], W[2] + W[5] + W[8])
    f = 1.0 / (rows[0] + rows[1] + rows[2])
    normal = (
        W[0] - f * rows[0] * columns[0], W[1] - f * rows[0] * columns[1], W[2] - f * rows[0] * columns[2],
        W[3] - f * rows[1] * columns[0], W[4] - f * rows[1] * columns[1], W[5] - f * rows[1] * columns[2],
        W[6] - f * rows[2] * columns[0], W[7] - f * rows[2] * columns[1], W[8] - f * rows[2] * columns[2],
    )  # fmt: skip
    x, y, z = a * a, b * b, c * c
    k = 2.0 / (a * b * c)
    p1, p2, p3 = g.ring[0] * (y + z), g.ring[1] * (x + z), g.ring[2] * (x + y)
    t = reciprocals((k - deficit * p1, k - deficit * p2, k - deficit * p3))
    u = reciprocals((y + z, x + z, x + y))
    slip = ((y - z) * u[0], (x - z) * u[1], (x - y) * u[2])
    return Mobility(normal, (p1 * t[0], p2 * t[1], p3 * t[2]), slip, deficit)


def velocity_gradient(m: Mobility, sigma: Tensor, l_f: Tensor) -> Tensor:
    """Return the velocity gradient l_s of the body, 1/s.

    The normal components of the fluid's traction need no further integrals: −N·s̃(e) = e − 2 (1 − η_s/μ_f)
    N·e for a traceless e, with N the ``normal`` mobility, whose rows and columns sum to zero.

    ``sigma`` is the elastic Cauchy stress over μ_f, symmetric, with any mean, and ``l_f`` the velocity
    gradient of the fluid, 1/s.
    """
    third = (l_f[0] + l_f[4] + l_f[8]) * (1.0 / 3.0)
    x, y, z = l_f[0] - third, l_f[4] - third, l_f[8] - third
    n = 2.0 * m.deficit
    d = dot_vector(m.normal, (sigma[0] - n * x, sigma[4] - n * y, sigma[8] - n * z))
    l23, l32 = _off_diagonal(m.compliance[0], m.slip[0], m.deficit, sigma[5], l_f[5], l_f[7])
    l13, l31 = _off_diagonal(m.compliance[1], m.slip[1], m.deficit, sigma[2], l_f[2], l_f[6])
    l12, l21 = _off_diagonal(m.compliance[2], m.slip[2], m.deficit, sigma[1], l_f[1], l_f[3])
    return (x + d[0], l12, l13, l21, y + d[1], l23, l31, l32, z + d[2])


def _off_diagonal(
    compliance: Scalar, slip: Scalar, deficit: Scalar, sigma: Scalar, lf_ij: Scalar, lf_ji: Scalar
) -> tuple[Scalar, Scalar]:
    """Return l_s,ij and l_s,ji: free of torque, with σ̃_ij − 2 η_s d_s,ij = σ_ij."""
    d_f, w_ji = 0.5 * (lf_ij + lf_ji), 0.5 * (lf_ji - lf_ij)
    delta = (0.5 * sigma - deficit * d_f) * compliance
    d_s, ws_ji = d_f - delta, w_ji + slip * delta
    return d_s - ws_ji, d_s + ws_ji


def isochoric(F: Tensor, J: Scalar) -> Tensor:
    """Return F J^(−1/3), F with its volume restored, for J near 1."""
    return scale(inverse_cube_root(J), F)


def inverse_cube_root(J: Scalar) -> Scalar:
    """Return J^(−1/3) for J near 1, by Newton's iteration."""
    s = 0.0 * J + 1.0
    s = s * (4.0 - J * s * s * s) * (1.0 / 3.0)
    s = s * (4.0 - J * s * s * s) * (1.0 / 3.0)
    s = s * (4.0 - J * s * s * s) * (1.0 / 3.0)
    s = s * (4.0 - J * s * s * s) * (1.0 / 3.0)
    s = s * (4.0 - J * s * s * s) * (1.0 / 3.0)
    return s * (4.0 - J * s * s * s) * (1.0 / 3.0)
