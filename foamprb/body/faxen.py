"""Faxén's correction: change of a body's velocity by the curvature of the flow."""

from __future__ import annotations

from typing import TypeAlias

from foamprb.body.tensor import Tensor, Vector

Curvature: TypeAlias = tuple[Vector, Vector, Vector, Vector, Vector, Vector]
"""Second derivatives of the velocity along xx, yy, zz, xy, yz and xz, each a vector, 1/(m s)."""


def curvature_of(l_x: Tensor, l_y: Tensor, l_z: Tensor) -> Curvature:
    """Return the second derivatives of the velocity, 1/(m s), from those of its gradient along x, y and z.

    A mixed derivative is the mean of its two values.
    """
    return (
        (l_x[0], l_x[3], l_x[6]),
        (l_y[1], l_y[4], l_y[7]),
        (l_z[2], l_z[5], l_z[8]),
        (0.5 * (l_x[1] + l_y[0]), 0.5 * (l_x[4] + l_y[3]), 0.5 * (l_x[7] + l_y[6])),
        (0.5 * (l_y[2] + l_z[1]), 0.5 * (l_y[5] + l_z[4]), 0.5 * (l_y[8] + l_z[7])),
        (0.5 * (l_x[2] + l_z[0]), 0.5 * (l_x[5] + l_z[3]), 0.5 * (l_x[8] + l_z[6])),
    )


def faxen_velocity(C: Tensor, curvature: Curvature) -> Vector:
    """Return ⅙ C:∇∇u = ⅙ Σ a_i² (e_i·∇)² u, m/s: a body without load moves with u + ⅙ C:∇∇u.

    C = Σ a_i² e_i e_i = R² F Fᵀ is the shape tensor, m²; ``curvature`` is that of the undisturbed flow at the
    centre. The result is the first term of (sinh D/D − 1) u with D² = C:∇∇ (Brenner 1964; Kim & Karrila
    1991), and exact for a velocity polynomial of degree 3 or less. For a sphere it is ⅙ R² ∇²u. The drag is
    then μ_f K·(u + ⅙ C:∇∇u − v). In a unidirectional flow the correction is along the flow: the body lags,
    and does not migrate.
    """
    xx, yy, zz, xy, yz, xz = curvature
    a, b, c, d, e, f = C[0] / 6.0, C[4] / 6.0, C[8] / 6.0, C[1] / 3.0, C[5] / 3.0, C[2] / 3.0
    return (
        a * xx[0] + b * yy[0] + c * zz[0] + d * xy[0] + e * yz[0] + f * xz[0],
        a * xx[1] + b * yy[1] + c * zz[1] + d * xy[1] + e * yz[1] + f * xz[1],
        a * xx[2] + b * yy[2] + c * zz[2] + d * xy[2] + e * yz[2] + f * xz[2],
    )
