"""Faxén's correction: what a flow that is curved over a body gives to its velocity."""

from __future__ import annotations

from typing import TypeAlias

from foamprb.body.tensor import Tensor, Vector

Curvature: TypeAlias = tuple[Vector, Vector, Vector, Vector, Vector, Vector]
"""Second derivatives of the velocity along xx, yy, zz, xy, yz and xz, each a vector, 1/(m s)."""


def faxen_velocity(C: Tensor, curvature: Curvature) -> Vector:
    """⅙ C:∇∇u = ⅙ Σ a_i² (e_i·∇)² u, m/s: a body without load moves with u + ⅙ C:∇∇u.

    The first term of (sinh D/D − 1) u with D² = C:∇∇ (Brenner 1964; Kim & Karrila 1991), and all of it where
    the velocity is a polynomial of third degree at most. A sphere has ⅙ R² ∇²u. The drag is then
    μ_f K·(u + ⅙ C:∇∇u − v). In a unidirectional flow the correction is along the flow: the body lags, and
    does not migrate.

    Parameters
    ----------
    C
        Shape tensor Σ a_i² e_i e_i = R² F Fᵀ, m².
    curvature
        Of the undisturbed flow at the centre.
    """
    xx, yy, zz, xy, yz, xz = curvature
    a, b, c, d, e, f = C[0] / 6.0, C[4] / 6.0, C[8] / 6.0, C[1] / 3.0, C[5] / 3.0, C[2] / 3.0
    return (
        a * xx[0] + b * yy[0] + c * zz[0] + d * xy[0] + e * yz[0] + f * xz[0],
        a * xx[1] + b * yy[1] + c * zz[1] + d * xy[1] + e * yz[1] + f * xz[1],
        a * xx[2] + b * yy[2] + c * zz[2] + d * xy[2] + e * yz[2] + f * xz[2],
    )
