"""Change of a body's velocity gradient by its rotation.

A rotated body in a rotated flow responds likewise: l_s(R F; l_f) = R l_s(F; Rᵀ l_f R) Rᵀ. The change of l_s
by a rotation is therefore known in closed form, with the mobility of the present shape. In a nearly rigid
body only rotation and flow change l_s. A step that includes this change computes strain and attitude to the
same order. All tensors are components in the particle frame.
"""

from __future__ import annotations

from foamprb.body.rosenbrock import Elasticity
from foamprb.body.stokes import Mobility, velocity_gradient
from foamprb.body.tensor import Scalar, Tensor, Vector, add, reciprocals, scale, skew, subtract

_ROUND = 0.01
"""Square of the relative difference of two λ_a² below which a section is treated as round."""


def commutator(S: Tensor, T: Tensor) -> Tensor:
    """Return S T − T S, without the products of two diagonal components, which cancel."""
    xy, xz, yz = S[0] - S[4], S[0] - S[8], S[4] - S[8]
    uv, uw, vw = T[0] - T[4], T[0] - T[8], T[4] - T[8]
    p, q, r = S[1] * T[3] - S[3] * T[1], S[2] * T[6] - S[6] * T[2], S[5] * T[7] - S[7] * T[5]
    return (
        p + q,
        xy * T[1] - uv * S[1] + S[2] * T[7] - T[2] * S[7],
        xz * T[2] - uw * S[2] + S[1] * T[5] - T[1] * S[5],
        uv * S[3] - xy * T[3] + S[5] * T[6] - T[5] * S[6],
        r - p,
        yz * T[5] - vw * S[5] + S[3] * T[2] - T[3] * S[2],
        uw * S[6] - xz * T[6] + S[7] * T[3] - T[7] * S[3],
        vw * S[7] - yz * T[7] + S[6] * T[1] - T[6] * S[1],
        -(q + r),
    )


def turned(W: Tensor, T: Tensor) -> Tensor:
    """Return W T − T W for a skew W, the rate of change of T rotating with the spin W."""
    p, q, r = W[1], W[2], W[5]
    return (
        p * (T[3] + T[1]) + q * (T[6] + T[2]),
        p * (T[4] - T[0]) + q * T[7] + r * T[2],
        p * T[5] + q * (T[8] - T[0]) - r * T[1],
        p * (T[4] - T[0]) + q * T[5] + r * T[6],
        r * (T[7] + T[5]) - p * (T[1] + T[3]),
        r * (T[8] - T[4]) - p * T[2] - q * T[3],
        p * T[7] + q * (T[8] - T[0]) - r * T[3],
        r * (T[8] - T[4]) - p * T[6] - q * T[1],
        -q * (T[2] + T[6]) - r * (T[5] + T[7]),
    )


def shape_spin(stretches: Vector, l_s: Tensor) -> Tensor:
    """Return the spin W, 1/s, that best explains the change of b = F Fᵀ, for the stretches λ_a.

    W minimises |l_s b + b l_sᵀ − (W b − b W)|² + ε² |W|² for each component, with ε = 0.1 (b_i + b_j) and the
    body's velocity gradient l_s, 1/s. It is the spin of a rigid ellipsoid across its axes, and 0 for a body
    that tank-treads or is nearly a sphere.
    """
    x, y, z = stretches[0] * stretches[0], stretches[1] * stretches[1], stretches[2] * stretches[2]
    xy, xz, yz = y - x, z - x, z - y
    s, t, u = x + y, x + z, y + z
    p, q, r = reciprocals((xy * xy + _ROUND * s * s, xz * xz + _ROUND * t * t, yz * yz + _ROUND * u * u))
    w12 = (l_s[1] * y + l_s[3] * x) * (xy * p)
    w13 = (l_s[2] * z + l_s[6] * x) * (xz * q)
    w23 = (l_s[5] * z + l_s[7] * y) * (yz * r)
    return (0.0, w12, w13, -w12, 0.0, w23, -w13, -w23, 0.0)


def _stress_of_spin(e: Elasticity, W: Tensor) -> Tensor:
    """Return the Jacobian's change of τ by a spin, Pa/s, without the off-diagonal elastic stretch."""
    x, y, z = e.squares
    p, q, r = e.shear[0] * W[5] * (z - y), e.shear[1] * W[2] * (z - x), e.shear[2] * W[1] * (y - x)
    return (0.0, r, q, r, 0.0, p, q, p, 0.0)


def turning_gradient(
    stretches: Vector,
    m: Mobility,
    e: Elasticity,
    mu_f: Scalar,
    l_s: Tensor,
    l_f: Tensor,
    sigma: Tensor,
) -> Tensor:
    """Return the rate of change of l_s − J Ω by rotation, 1/s², along Ω = l_s t.

    W of :func:`shape_spin` rotates the shape, the body's own spin the stress. J is that of
    :func:`foamprb.body.relaxation.relaxing`.

    ``m`` and ``e`` are mobility and elasticity of the shape, ``mu_f`` the viscosity of the fluid, Pa s,
    ``l_s`` and ``l_f`` the velocity gradients of body and fluid, ``sigma`` the elastic stress over μ_f, 1/s.
    """
    W, spin = shape_spin(stretches, l_s), skew(l_s)
    stress = turned(subtract(W, spin), sigma)
    stress = add(stress, scale(1.0 / mu_f, _stress_of_spin(e, spin)))
    return subtract(turned(W, l_s), velocity_gradient(m, stress, turned(W, l_f)))
