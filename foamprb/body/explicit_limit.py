"""Stability limit of the paper's scheme, for any shape.

The scheme evaluates the traction σ̃ at the old deformation gradient and its old rate A (46), and the elastic
stress at the new one. A disturbance Y = δA F⁻¹ of the rate that alternates in sign is neutrally stable where

    2 Y b + ½ Δt² c E(Y) − Δt c J μ_f D(Y) = 0,   b = F Fᵀ,   c = 5/(ρ_s R²).

Here −μ_f D is the change of the traction, and of the viscous stress of the solid, by the body's velocity
gradient (`traction_slopes` and `shears` of :mod:`foamprb.body.rosenbrock`). E(Y) = δτ − tr(Y) τ is the
tangent of the elastic stress less that of the traction's Piola stress, with both in balance. In the particle
frame the components ij and ji decouple from the rest, and so do the three ii: three 2×2 matrices and one 3×3
matrix. The step is stable if all their eigenvalues have positive real parts.

A sphere without elasticity has D = 3, and 4 in dilation: Δt < 2 τ_s and 3/2 τ_s with τ_s = ρ_s R²/(15 μ_f). A
thin axis has little inertia: the limit is proportional to the square of the shortest axis. Elasticity raises
it. Beyond the limit the scheme does not blow up: the oscillation saturates, and the deformation is too small.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from foamprb.body.ellipsoid import Integrals
from foamprb.body.rosenbrock import Elasticity, shears, traction_slopes
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    add_identity,
    det,
    scale,
    scale_columns,
    subtract,
    trace,
)

_TRACTION = 4.0
"""Bound of the eigenvalues of D b⁻¹ times λ², λ the smallest stretch."""


def safe_step(stretches: Vector, c: Scalar, mu_f: Scalar, eta: Scalar) -> Scalar:
    """Return a step, s, stable for any elasticity: 3/2 τ_s λ²/J for η_s = 0, λ the smallest stretch.

    ``stretches`` are λ_a, ``c`` is 5/(ρ_s R²), m/kg, ``mu_f`` and ``eta`` are the viscosities of fluid and
    solid, Pa s.
    """
    x, y, z = stretches
    least = np.minimum(x, np.minimum(y, z))
    return 2.0 * least * least / (c * x * y * z * (_TRACTION * mu_f + 2.0 * eta))


def _pair_is_stable(a: Scalar, b: Scalar, c: Scalar, d: Scalar) -> Scalar:
    return (a + d > 0.0) & (a * d - b * c > 0.0)


def _is_stable(M: Tensor) -> Scalar:
    """Return whether the eigenvalues of M have positive real parts (Routh and Hurwitz)."""
    t = trace(M)
    minors = M[0] * M[4] - M[1] * M[3] + M[0] * M[8] - M[2] * M[6] + M[4] * M[8] - M[5] * M[7]
    d = det(M)
    return (t > 0.0) & (d > 0.0) & (t * minors > d)


def is_stable(
    dt: Scalar,
    stretches: Vector,
    g: Integrals,
    e: Elasticity,
    tau: Vector,
    c: Scalar,
    mu_f: Scalar,
    eta: Scalar,
) -> Any:
    """Return whether the paper's step ``dt``, s, is stable for a shape.

    ``g`` are the integrals of the stretches; ``e`` is the elasticity, with the resistance to dilation, and
    ``tau`` the normal Kirchhoff stresses, Pa. For the others see :func:`safe_step`.
    """
    x, y, z = stretches
    bx, by, bz = x * x, y * y, z * z
    rx, ry, rz = 1.0 / bx, 1.0 / by, 1.0 / bz
    J = x * y * z
    ratio = eta / mu_f
    f, h = dt * c * J * mu_f, 0.5 * dt * dt * c
    traction = scale(f, traction_slopes(stretches, g, ratio))
    u, v, w = tau
    elastic = scale(h, subtract(e.slopes, (u, u, u, v, v, v, w, w, w)))
    normal = _is_stable(add_identity(scale_columns(add(traction, elastic), (rx, ry, rz)), 2.0))
    (e1, e2, e3), (s23, s13, s12) = e.squares, e.shear
    p, q, r = shears(stretches, g, ratio)
    return (
        normal
        & _pair_is_stable(
            2.0 + (f * p[0] + h * s23 * e3) * rz, (f * p[1] + h * s23 * e2) * ry,
            (f * p[2] + h * s23 * e3) * rz, 2.0 + (f * p[3] + h * s23 * e2) * ry,
        )
        & _pair_is_stable(
            2.0 + (f * q[0] + h * s13 * e3) * rz, (f * q[1] + h * s13 * e1) * rx,
            (f * q[2] + h * s13 * e3) * rz, 2.0 + (f * q[3] + h * s13 * e1) * rx,
        )
        & _pair_is_stable(
            2.0 + (f * r[0] + h * s12 * e2) * ry, (f * r[1] + h * s12 * e1) * rx,
            (f * r[2] + h * s12 * e2) * ry, 2.0 + (f * r[3] + h * s12 * e1) * rx,
        )
    )  # fmt: skip
