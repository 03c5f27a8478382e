"""A linear flow in closed form whose gradient and drift change in time."""

from __future__ import annotations

import math

from foamprb.flow.analytic import AnalyticFlow, gap_free

NOTHING = (0.0, 0.0, 0.0, 0.0)


def changing(terms, omega, t):
    """a + b cos ωt + c sin ωt + d t, and its rate of change."""
    c, s = math.cos(omega * t), math.sin(omega * t)
    value = terms[0] + terms[1] * c + terms[2] * s + terms[3] * t
    return value, omega * (terms[2] * c - terms[1] * s) + terms[3]


def sample_changing(flow, _host, x, t):
    # A plain tuple: the cache of compiled code cannot be read where a type of its arguments is unknown.
    omega, centre, along, across, drift_x, drift_z = flow
    a, a_t = changing(along, omega, t)
    b, b_t = changing(across, omega, t)
    u, u_t = changing(drift_x, omega, t)
    w, w_t = changing(drift_z, omega, t)
    x0, y0 = x[0] - centre, x[1] - centre
    l = (0.0, a, 0.0, b, 0.0, 0.0, 0.0, 0.0, 0.0)
    return (u + a * y0, b * x0, w), l, (u_t + a_t * y0, b_t * x0, w_t)


def changing_flow(omega, along, across, drift_x=NOTHING, drift_z=NOTHING, centre=0.0):
    """∂u_x/∂y and ∂u_y/∂x, and u_x and u_z where x = y = ``centre``, by the terms of :func:`changing`."""
    kernels = {
        "sample": sample_changing,
        "gap": gap_free,
    }
    return AnalyticFlow((float(omega), centre, along, across, drift_x, drift_z), kernels)
