"""Bodies that settle along a shear flow, with the lift by inertia of the fluid."""

from __future__ import annotations

import math

import pytest

from foamprb.body.lift import lift_coefficient
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

R, RATE, RHO, MU, LOAD = 25e-6, 1000.0, 1000.0, 1e-3, 9.0 * 1e-3 * 1e-3 / (2.0 * 25e-6**2)
"""LOAD is the weight less buoyancy by which a sphere settles at 1 mm/s, N/m³."""


def advance(integrator="stokes", sign=1.0):
    # Without inertia of the body: light, in a strong field of gravity.
    p = spheres([(0.0, 0.0, 0.0)], d=2.0 * R, rho=1e-6, mu=1e5, poissons_ratio=0.4999)
    flow = analytic.shear(RATE)
    water = Medium(MU, RHO, (-sign * LOAD / RHO, 0.0, 0.0))
    models = Models(integrator=integrator, surroundings=(SaffmanMeiLift(),))
    cloud = Cloud(p, flow, water, [Escape()] * len(flow.patches), 1e-9, models, threads=1)
    cloud.advance(1)
    return p.v[0]


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_leading_sphere_drifts_to_the_slower_fluid(sign):
    """0.2709 of its slip by Saffman, times Mei's factor; to the faster fluid if it lags."""
    v = advance(sign=sign)
    drag = 6.0 * math.pi * MU * R
    lift = lift_coefficient(math.hypot(v[0], v[1]), RATE, R, RHO, MU) * RATE
    assert v[1] / v[0] == pytest.approx(-lift / drag, rel=1e-4)
    assert v[1] / v[0] == pytest.approx(-0.2709, rel=4e-3)
    assert v[0] == pytest.approx(sign * 1e-3 / (1.0 + (lift / drag) ** 2), rel=1e-4)


def test_integrators_with_inertia_are_refused():
    with pytest.raises(InputError, match="acts in the slip of the integrator stokes, not in rosenbrock"):
        advance("rosenbrock")
