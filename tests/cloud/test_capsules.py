"""Capsules whose membrane slides, in the whole loop."""

from __future__ import annotations

import numpy as np
import pytest
from validation.references.shear import shear_shape

from foamprb import Cloud, InputError, Medium, Models, analytic, spheres, with_relaxation
from foamprb.body.material import modulus_of_capsule
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
