"""The barycentre without inertia of its own: how it moves relative to the fluid.

The forces are those of :func:`foamprb.body.drag.acceleration`. With the mass m of the body and m_f of the
fluid in its place,

    (m + C m_f) dv/dt = f_G + (p + C) m_f Du/Dt + μ_f K·(u − v).

A body that follows the flow but for its settling w, μ_f K·w = f_G, is accelerated by dv/dt = Du/Dt + l_f
w. To first order in the time in which drag stops it (Maxey, Journal of Fluid Mechanics 174, 1987; Ferry &
Balachandar, International Journal of Multiphase Flow 27, 2001)

    v = u + w + K⁻¹·[(p m_f − m) Du/Dt − (m + C m_f) l_f w]/μ_f.

A heavy body leaves a vortex and cuts a bend, with the pressure gradient's force (p = 1) or without (p = 0).
The virtual mass has no part in it where nothing settles.
"""

from __future__ import annotations

from foamprb.body.drag import reduced_gravity
from foamprb.body.tensor import Scalar, Tensor, Vector, dot_vector, reciprocals, vector_dot


def _moved(Q: Tensor, times: Vector, a: Vector) -> Vector:
    """Velocity by an acceleration a that drag balances."""
    g = dot_vector(Q, a)
    return vector_dot((times[0] * g[0], times[1] * g[1], times[2] * g[2]), Q)


def first_order_slip(
    Q: Tensor,
    rate: Vector,
    J: Scalar,
    rho_s: Scalar,
    rho_f: Scalar,
    gravity: Vector,
    pressure_gradient: Scalar,
    virtual_mass: Scalar,
    Du_Dt: Vector,
    l_f: Tensor,
) -> Vector:
    """Velocity of the barycentre relative to the fluid, m/s, to first order in the particle's inertia.

    Parameters
    ----------
    Q, rate
        Particle frame (rows) and μ_f K_a/m, 1/s, along its axes.
    J, rho_s, rho_f, gravity, pressure_gradient, virtual_mass, Du_Dt
        As :func:`foamprb.body.drag.acceleration`, p and C being the coefficients of the two forces.
    l_f
        ∂u_i/∂x_j, 1/s.
    """
    s = J * rho_f / rho_s
    steady = reduced_gravity(J, rho_s, rho_f, gravity)
    inertia, p = 1.0 + virtual_mass * s, (pressure_gradient + virtual_mass) * s
    push = (steady[0] + p * Du_Dt[0], steady[1] + p * Du_Dt[1], steady[2] + p * Du_Dt[2])
    return balanced_slip(Q, rate, steady, push, inertia, Du_Dt, l_f)


def balanced_slip(
    Q: Tensor, rate: Vector, steady: Vector, push: Vector, inertia: Scalar, Du_Dt: Vector, l_f: Tensor
) -> Vector:
    """The same for forces in general.

    Parameters
    ----------
    steady, push
        What all forces but drag are per mass of the body, m/s², in a fluid that is not accelerated, and in
        this one.
    inertia
        What resists acceleration, in masses of the body: 1 + C m_f/m.
    """
    times = reciprocals(rate)
    w = _moved(Q, times, steady)
    lw = dot_vector(l_f, w)
    more = (
        push[0] - steady[0] - inertia * (Du_Dt[0] + lw[0]),
        push[1] - steady[1] - inertia * (Du_Dt[1] + lw[1]),
        push[2] - steady[2] - inertia * (Du_Dt[2] + lw[2]),
    )
    more = _moved(Q, times, more)
    return w[0] + more[0], w[1] + more[1], w[2] + more[2]
