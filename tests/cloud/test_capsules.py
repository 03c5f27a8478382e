"""Capsules whose membrane slides, in the whole loop."""

from __future__ import annotations

import numpy as np
import pytest
from validation.references.shear import shear_shape

from foamprb import (
    BrownianMotion,
    Cloud,
    FateLimits,
    Fates,
    InputError,
    Medium,
    Models,
    analytic,
    set_excess_area,
    spheres,
    with_relaxation,
)
from foamprb.body.material import modulus_of_capsule
from foamprb.body.surface_tension import laplace_stress
from foamprb.cloud.state import Reason, Status, set_rest_shape

NAME, REST = "capsule neoHookean", (0.0, 0.0, 0.0)


def cloud(flow, Ca, dt, integrator="stokes", ratio=1.0, change=lambda p: p, **models):
    """Capsules of radius 1 and G_s = 1/Ca in a fluid of viscosity 1, of unit rates."""
    Ca = np.atleast_1d(Ca)
    mu = modulus_of_capsule(1.0 / Ca, 0.5, 1.0)
    p = spheres(np.zeros((len(Ca), 3)), d=2.0, rho=1e-6, mu=mu, eta=ratio, poissons_ratio=0.4999)
    models = Models(integrator=integrator, material=NAME, tolerance=1e-6, **models)
    return Cloud(change(p), flow, Medium(1.0, 1e-6, REST), (), dt, models, threads=1)


def unsteady(x, y, z, t):
    c, s = np.cos(t), np.sin(t)
    return (
        0.3 * c * x + y + 0.2 * np.sin(2.0 * t) * z,
        -0.1 * x - 0.5 * c * y + 0.3 * z,
        0.4 * s * x + 0.2 * c * z,
    )


def test_a_capsule_follows_its_equations():
    """F by an independent integrator, RK4 with a step of 0.01 and Eshelby's tensor."""
    c = cloud(analytic.function(unsteady, 1.0, 1.0), 0.2, 0.02)
    c.advance(100)
    np.testing.assert_allclose(
        c.particles.F[0],
        [0.502951, 1.032996, 0.097854, -0.552510, 0.564004, 0.401718, 0.257919, 0.001434, 1.062226],
        atol=2e-4,
    )
    c.advance(100)
    np.testing.assert_allclose(
        c.particles.F[0],
        [-0.486647, 0.809072, 0.526231, -0.789747, -0.173282, 0.825619, 0.603537, -0.193669, 0.745399],
        atol=2e-4,
    )


@pytest.mark.parametrize("integrator", ["rosenbrock", "stokes"])
def test_steady_capsules_in_shear_are_those_of_the_balance(integrator):
    """D and angle, °, of the same body by Newton's method; computed capsules have .2625 and .4959."""
    c = cloud(analytic.shear(1.0), [0.15, 0.6], 0.02, integrator)
    c.advance(1500)
    shapes = []
    for F, A in zip(c.particles.F.reshape(-1, 3, 3), c.particles.A.reshape(-1, 3, 3), strict=True):
        shape = shear_shape(F, A @ np.linalg.inv(F))
        shapes.append((shape[0], shape[3]))
    np.testing.assert_allclose(shapes, [(0.2702, 29.88), (0.5038, 18.26)], rtol=1e-3)


@pytest.mark.filterwarnings("ignore::foamprb.errors.FailedParticlesWarning")
def test_a_capsule_fails_where_its_table_ends():
    c = cloud(analytic.shear(1.0), [0.3, 3.0], 0.02)
    c.advance(150)
    assert c.particles.status.tolist() == [Status.ACTIVE, Status.FAILED]
    assert c.particles.reason[1] == Reason.STRETCHED


def test_vesicles_keep_their_area_and_tread_as_keller_and_skalak_found():
    """Semi-axes, inclination, °, and frequency by Newton's method; from a ratio of 5.846 on they swing."""
    p = spheres(np.zeros((4, 3)), d=2.0, rho=1e-6, mu=1.0, eta=[1.0, 3.0, 5.0, 15.0], poissons_ratio=0.4999)
    set_excess_area(p, 0.5)
    models = Models(material="capsule fluid", integrator="stokes", tolerance=1e-6)
    c = Cloud(p, analytic.shear(1.0), Medium(1.0, 1e-6, REST), (), 0.02, models, threads=1)
    c.advance(2000)
    F, stretches = p.F.reshape(-1, 3, 3), np.linalg.svd(p.F.reshape(-1, 3, 3))[1]
    areas = [4.0 * np.pi * (1.0 + sum(laplace_stress(tuple(s), 1.0)) / 6.0) for s in stretches]
    np.testing.assert_allclose(np.array(areas) - 4.0 * np.pi, 0.5, atol=1e-4)
    np.testing.assert_allclose(stretches[:3], [(1.3621, 0.9287, 0.7905)] * 3, atol=2e-4)
    found = []
    for deformed, A in zip(F, p.A.reshape(-1, 3, 3), strict=True):
        l_s = A @ np.linalg.inv(deformed)
        found.append((shear_shape(deformed, l_s)[3], np.sqrt(max(np.linalg.det(l_s[:2, :2]), 0.0))))
    np.testing.assert_allclose(found[:3], [(30.127, 0.4341), (20.515, 0.3603), (10.176, 0.3080)], rtol=1e-3)
    assert abs(found[3][0] - found[2][0]) > 20.0


@pytest.mark.parametrize(
    ("message", "options"),
    [
        ("integrator stokes, not rosenbrock", {"integrator": "rosenbrock"}),
        ("not for drops or vesicles", {"surroundings": (BrownianMotion(T=300.0),)}),
        ("not for drops or vesicles", {"surroundings": (Fates(ruptured=FateLimits(stress=1.0)),)}),
    ],
)
def test_models_that_need_elasticity_refuse_vesicles(message, options):
    p = spheres(np.zeros((1, 3)), d=2.0, rho=1e-6, mu=1.0)
    set_excess_area(p, 0.5)
    models = Models(material="capsule fluid", **{"integrator": "stokes", **options})
    with pytest.raises(InputError, match=message):
        Cloud(p, analytic.shear(1.0), Medium(1.0, 1e-6, REST), (), 0.05, models, threads=1)


def tense(p):
    p.gamma[:] = 0.1
    return p


def shaped(p):
    set_rest_shape(p, (2.0, 1.0, 1.0), np.eye(3))
    return p


@pytest.mark.parametrize(
    ("message", "options"),
    [
        ("sphere without tension at rest", {"change": tense}),
        ("sphere without tension at rest", {"change": shaped}),
        ("relaxation is unknown for the membrane", {"change": lambda p: with_relaxation(p, [1.0], [1.0])}),
        ("quadratic is unknown for the membrane", {"shape": "quadratic"}),
        ("integrator paper takes no capsule", {"integrator": "paper"}),
    ],
)
def test_models_without_a_theory_of_membranes_are_refused(message, options):
    with pytest.raises(InputError, match=message):
        cloud(analytic.shear(1.0), 0.1, 0.02, **options)
