"""Bodies in fluids whose viscosity varies; `tools/validation/viscosity.py` has their deformation."""

from __future__ import annotations

import math

import numpy as np
import pytest
from mesh_shapes import block, box_patches

import foamprb
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import context, contexts, flow_samples, measure
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import (
    RATE_LAWS,
    FieldViscosity,
    PhaseMixture,
    PowerLaw,
    medium_at,
    viscosity_at_nodes,
    viscosity_at_rate,
)
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow

LAW = PowerLaw(k=0.5, n=0.6)
FALL = 1e-3
"""Speed of fall where the field is 1, m/s: (ρ_s − ρ_f) g d²/18 over the factor of the field."""


def falling(flow, integrator="stokes"):
    """A body of 10 µm in a fluid at rest, whose field of the viscosity is in 10⁻³ Pa s."""
    p = spheres([(0.5, 0.5, 0.9)], d=1e-5, rho=2000.0, mu=1e3)
    gravity = (0.0, 0.0, -FALL * 18.0 * 1e-3 / (1000.0 * 1e-10))
    medium = foamprb.Medium(FieldViscosity(factor=1e-3, mean=1.5e-3), 1000.0, gravity)
    walls = [Escape()] * len(flow.patches)
    return Cloud(p, flow, medium, walls, 5.0, Models(integrator=integrator), threads=1)


@pytest.fixture(scope="module")
def mesh():
    return build_mesh(shape := block(2, 0.0), box_patches(shape))


def at_rest(mesh):
    return np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))


def rising(mesh, slope):
    """The field 1 + slope·z and its gradient, (n_nodes, 4)."""
    z = mesh.nodes[:, 2]
    return np.column_stack([1.0 + slope * z, 0.0 * z, 0.0 * z, slope + 0.0 * z])


def test_a_body_falls_through_a_field_that_varies_in_space(mesh):
    """(1 + a z) dz/dt = −w₀ has the solution z + a z²/2 = const. − w₀ t."""
    a, end = 2.0, 500.0
    cloud = falling(MeshFlow(mesh, *at_rest(mesh), viscosity=rising(mesh, a)))
    cloud.advance(round(end / cloud.dt))
    c = 0.9 + 0.5 * a * 0.81 - FALL * end
    assert cloud.particles.x[0, 2] == pytest.approx((math.sqrt(1.0 + 2.0 * a * c) - 1.0) / a, abs=5e-7)
    z = cloud.particles.x[0, 2]
    found = measure(context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time))
    assert found["muc"] == pytest.approx(1e-3 * (1.0 + a * z), rel=1e-12, abs=0.0)
    assert found["U"][0, 2] == pytest.approx(-FALL / (1.0 + a * z), rel=1e-6)
    samples = flow_samples(cloud.particles, cloud.flow, cloud.time, cloud.medium.mu)
    (c,) = contexts(cloud.particles, samples, cloud.medium.mu, cloud.time)
    assert c.mu == pytest.approx(found["muc"], rel=1e-14, abs=0.0)
    assert viscosity_at_nodes(cloud.medium.mu, cloud.flow.values_at_nodes()).max() == pytest.approx(
        1e-3 * (1.0 + a)
    )


WATER_UNDER_OIL = PhaseMixture(mu=(1e-3, 5e-3), rho=(1000.0, 900.0), mean=3e-3)
SETTLES = 9.81 * 1e-10 / 18.0
"""g d²/18 of a body of 10 µm, m³/s²."""


def settling(flow, dt):
    """A body of 10 µm and 1100 kg/m³ in oil over water at rest."""
    p = spheres([(0.5, 0.5, 0.9)], d=1e-5, rho=1100.0, mu=1e3)
    medium = foamprb.Medium(WATER_UNDER_OIL, 950.0, (0.0, 0.0, -9.81))
    walls = [Escape()] * len(flow.patches)
    return Cloud(p, flow, medium, walls, dt, Models(integrator="stokes"), threads=1)


def linear_quotient(b, c, x):
    """∫₀ˣ (b₀ + b₁ s)/(c₀ + c₁ s) ds."""
    return b[1] / c[1] * x + (b[0] - b[1] * c[0] / c[1]) / c[1] * math.log1p(c[1] / c[0] * x)


def test_a_body_settles_through_an_interface():
    """Stokes' velocity on either side, and the time to cross a layer in which α rises linearly to 1."""
    shape = block(4, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    z = mesh.nodes[:, 2]
    inside = np.where((z > 0.26) & (z < 0.74), -2.0, 0.0)
    table = np.column_stack([np.clip(1.5 - 2.0 * z, 0.0, 1.0), 0.0 * z, 0.0 * z, inside])
    # Of two times, for the loop of the next test.
    flow = SeriesFlow(mesh, [0.0, 1e7], lambda _: (*at_rest(mesh), table), viscous=True)
    cloud = settling(flow, 100.0)
    oil, water = SETTLES * 200.0 / 5e-3, SETTLES * 100.0 / 1e-3
    # With s from the top of the layer down, μ = 5e-3 − 8e-3 s and ρ_s − ρ_f = 200 − 200 s.
    crossing = linear_quotient((5e-3, -8e-3), (200.0, -200.0), 0.5) / SETTLES
    cloud.advance(2)
    assert measure(context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time))["U"][
        0, 2
    ] == pytest.approx(-oil, rel=1e-6)
    total = 0.15 / oil + crossing + 0.15 / water
    cloud.advance(round(total / 100.0) - 2)
    late = cloud.time - total
    assert cloud.particles.x[0, 2] == pytest.approx(0.1 - water * late, abs=1e-4)
    around = medium_at(cloud.medium, cloud.flow, cloud.particles, cloud.time)
    assert (around.mu[0], around.rho[0]) == pytest.approx((1e-3, 1000.0))
    assert measure(context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time))["U"][
        0, 2
    ] == pytest.approx(-water, rel=1e-6)


def test_a_body_settles_while_the_fraction_rises(mesh):
    """From oil to water in 2e5 s: μ = 5e-3 − 4e-3 t/T and ρ_s − ρ_f = 200 − 100 t/T."""
    end = 2e5

    def read(index):
        return *at_rest(mesh), np.tile([float(index), 0.0, 0.0, 0.0], (len(mesh.nodes), 1))

    cloud = settling(SeriesFlow(mesh, [0.0, end], read, viscous=True), 500.0)
    cloud.advance(round(end / 500.0))
    assert cloud.flow.viscosity(cloud.particles.x, cloud.particles.host, 0.25 * end) == pytest.approx([0.25])
    way = SETTLES * end * linear_quotient((200.0, -100.0), (5e-3, -4e-3), 1.0)
    assert cloud.particles.x[0, 2] == pytest.approx(0.9 - way, abs=1e-5)


@pytest.mark.parametrize(("integrator", "around"), [("paper", ()), ("stokes", (BrownianMotion(T=300.0),))])
def test_a_law_is_a_constant_in_a_shear_of_one_rate(integrator, around):
    """Also for a viscous solid, molecules, and bodies that settle."""
    found = []
    for mu in (LAW, LAW.at_rate(2.0)):
        p = spheres(np.zeros((3, 3)), d=1e-5, rho=2000.0, mu=10.0, eta=0.5)
        models = Models(integrator=integrator, surroundings=around)
        medium = foamprb.Medium(mu, 1000.0, (0.0, 0.0, -9.81))
        dt = 1e-9 if integrator == "paper" else 0.01
        cloud = Cloud(p, analytic.shear(2.0), medium, (), dt, models, threads=1)
        cloud.advance(10)
        found.append((p.F.copy(), p.v.copy()))
    np.testing.assert_allclose(found[0][0], found[1][0], rtol=1e-12, atol=1e-15)
    np.testing.assert_allclose(found[0][1], found[1][1], rtol=1e-9, atol=1e-18)


def test_viscosity_at_particles_and_rates():
    p = spheres([(0.0, 0.0, 0.0), (1.0, 0.0, 0.0)], d=1e-5, rho=1000.0, mu=1.0)
    p.host[:] = 0
    medium = foamprb.Medium(LAW, 1000.0)
    found = medium_at(medium, analytic.shear(3.1748021), p, 0.0)
    assert found.mu == pytest.approx([0.3149803, 0.3149803])
    constant = foamprb.Medium(1e-3, 1000.0)
    assert medium_at(constant, analytic.shear(1.0), p, 0.0) is constant
    assert viscosity_at_rate(LAW, 1.0) == pytest.approx(0.5)
    assert viscosity_at_rate(1e-3, 1.0) == 1e-3


def test_openfoams_coefficients_are_multiplied_by_the_density():
    """The viscosity is that of the kinematic law times ρ, whatever the units of its coefficients are."""
    given = {
        "BirdCarreau": {"nu0": 2e-5, "nuInf": 1e-6, "k": 3.0, "n": 0.4, "a": 2.0},
        "Casson": {"m": 1e-6, "tau0": 2e-6, "nuMin": 1e-7, "nuMax": 1e-3},
        "CrossPowerLaw": {"nu0": 2e-5, "nuInf": 1e-6, "m": 3.0, "n": 0.4},
        "HerschelBulkley": {"nu0": 1.0, "tau0": 2e-6, "k": 1e-6, "n": 0.7},
        "powerLaw": {"k": 1e-5, "n": 0.7, "nuMin": 1e-7, "nuMax": 1.0},
    }
    assert given.keys() == RATE_LAWS.keys()
    for name, coefficients in given.items():
        one, heavy = (RATE_LAWS[name].of_kinematic(coefficients, rho) for rho in (1.0, 1060.0))
        for rate in (1e-3, 5.0, 1e4):
            assert heavy.at_rate(rate) == pytest.approx(1060.0 * one.at_rate(rate), rel=1e-14, abs=0.0)
