"""Slip of a barycentre without inertia of its own: its velocity relative to the fluid.

With the mass m of the body and m_f of the displaced fluid,

    (m + C m_f) dv/dt = f_G + (p + C) m_f Du/Dt + μ_f K·(u − v).

A body that follows the flow apart from its settling w, μ_f K·w = f_G, has the acceleration dv/dt = Du/Dt +
l_f w. To first order in the relaxation time of drag (Maxey, Journal of Fluid Mechanics 174, 1987; Ferry &
Balachandar, International Journal of Multiphase Flow 27, 2001)

    v = u + w + K⁻¹·[(p m_f − m) Du/Dt − (m + C m_f) l_f w]/μ_f.

A heavy body leaves a vortex and cuts a bend, with the force of the pressure gradient (p = 1) or without it
(p = 0). The virtual mass has no effect without settling.
"""

from __future__ import annotations

from foamprb.body.tensor import Scalar, Tensor, Vector, dot_vector, plus, reciprocals, vector_dot


def _moved(Q: Tensor, times: Vector, a: Vector) -> Vector:
    """Return the velocity at which drag balances an acceleration a."""
    g = dot_vector(Q, a)
    return vector_dot((times[0] * g[0], times[1] * g[1], times[2] * g[2]), Q)


def balanced_slip(
    Q: Tensor, rate: Vector, steady: Vector, push: Vector, inertia: Scalar, Du_Dt: Vector, l_f: Tensor
) -> Vector:
    """Return the barycentre's velocity relative to the fluid, m/s, to first order in its inertia.

    Parameters
    ----------
    Q, rate
        Particle frame (rows) and μ_f K_a/m, 1/s, along its axes.
    steady, push
        All forces except drag per mass of the body, m/s²: in a fluid without acceleration, and in this fluid.
    inertia
        Inertia of body and virtual mass over that of the body: 1 + C m_f/m.
    Du_Dt, l_f
        Acceleration of the fluid, m/s², and ∂u_i/∂x_j, 1/s.
    """
    times = reciprocals(rate)
    w = _moved(Q, times, steady)
    lw = dot_vector(l_f, w)
    more = (
        push[0] - steady[0] - inertia * (Du_Dt[0] + lw[0]),
        push[1] - steady[1] - inertia * (Du_Dt[1] + lw[1]),
        push[2] - steady[2] - inertia * (Du_Dt[2] + lw[2]),
    )
    return plus(w, _moved(Q, times, more))
