"""Shapes at rest, viscosity and surface tension of the body, in the whole loop."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.spatial.transform import Rotation
from strategies import flat, square
from validation.references.roscoe import roscoe_at
from validation.references.shear import shear_shape

from foamprb import (
    Cloud,
    Gravity,
    InputError,
    Medium,
    Models,
    PressureGradient,
    Rebound,
    Stick,
    VirtualMass,
    analytic,
    spheres,
)
from foamprb.body import stokes
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import MATERIALS, piola
from foamprb.body.tensor import principal_frame
from foamprb.cloud.state import Status, set_rest_shape

MU_F, R = 1e-3, 1e-6
REST = (0.0, 0.0, 0.0)
IDENTITY = np.eye(3)


def cloud(
    flow, Ca, dt, integrator, *, number=1e-6, ratios=(1.0, 1.0, 1.0), axes=IDENTITY, nu=0.499999, **solid
):
    """Bodies in a flow of unit rates, with a shape Stokes number; the tolerance of a step is 1e-6."""
    Ca = np.atleast_1d(Ca)
    rho = number * 15 * MU_F / R**2
    p = spheres(np.zeros((len(Ca), 3)), d=2 * R, rho=rho, mu=MU_F / Ca, poissons_ratio=nu, **solid)
    set_rest_shape(p, ratios, axes)
    models = Models(integrator=integrator, tolerance=1e-6)
    return Cloud(p, flow, Medium(MU_F, rho, REST), (), dt, models, threads=1)


def advance_to(c, t):
    c.advance(round(t / c.dt) - c.step)


def inertialess(F, F0, t, gradient, Ca):
    """F after a time t by an independent integrator."""

    def rate(_, y):
        F = y.reshape(3, 3)
        Q, axes = principal_frame(flat(F))
        Q, g = square(Q), integrals(axes)
        F_e = F @ np.linalg.inv(F0)
        tau = square(piola(MATERIALS["neoHooke"], flat(F_e), 1.0, 0.0)) @ F_e.T
        sigma = Q @ tau @ Q.T / Ca
        m = stokes.mobility(axes, g, 0.0)
        l_s = stokes.velocity_gradient(m, flat(sigma), flat(Q @ gradient @ Q.T))
        return (Q.T @ square(l_s) @ Q @ F).ravel()

    found = solve_ivp(rate, (0.0, t), F.ravel(), method="LSODA", rtol=1e-10, atol=1e-12)
    return found.y[:, -1].reshape(3, 3)


ODD = np.array([[0.3, 1.0, -0.2], [0.1, -0.5, 0.4], [0.0, 0.3, 0.2]])


@pytest.mark.parametrize("integrator", ["paper", "rosenbrock", "stokes"])
def test_soft_ellipsoid_follows_its_equations(integrator):
    axes = Rotation.from_rotvec([0.4, 0.2, -0.7]).as_matrix()
    number = {"paper": 2e-3, "rosenbrock": 2e-5, "stokes": 1e-6}[integrator]
    allowed = {"paper": 4e-3, "rosenbrock": 2e-4, "stokes": 2e-5}[integrator]
    L = ODD - np.trace(ODD) / 3 * np.eye(3)
    c = cloud(
        analytic.linear(L), 0.3, 0.2 * number if integrator == "paper" else 0.05, integrator,
        number=number, ratios=(2.0, 1.2, 0.7), axes=axes,
    )  # fmt: skip
    F0 = square(c.particles.F0[0])
    advance_to(c, 1.5)
    np.testing.assert_allclose(c.particles.F[0], inertialess(F0, F0, 1.5, L, 0.3).ravel(), atol=allowed)


def test_body_at_rest_stays_in_its_shape():
    for integrator in ("paper", "rosenbrock", "stokes"):
        c = cloud(
            analytic.linear(np.zeros((3, 3))), 0.3, 1e-3, integrator, number=1e-2, nu=0.45,
            ratios=(3.0, 2.0, 1.0), axes=Rotation.from_rotvec([0.3, 0.5, 0.1]).as_matrix(),
        )  # fmt: skip
        c.advance(50)
        np.testing.assert_allclose(c.particles.F, c.particles.F0, atol=1e-12)


def test_a_sphere_of_another_radius_is_the_same_body():
    """Ratios (1, 1, 1) in any frame leave a sphere a sphere, whose loop is then the sphere's."""
    axes = Rotation.from_rotvec([0.3, 0.5, 0.1]).as_matrix()
    found = []
    for ratios in ((1.0, 1.0, 1.0), (2.0, 2.0, 2.0)):
        c = cloud(analytic.shear(1.0), 0.3, 0.05, "stokes", ratios=ratios, axes=axes)
        advance_to(c, 2.0)
        found.append(c.particles.F[0])
    np.testing.assert_allclose(found[0], found[1], atol=1e-13)


@pytest.mark.parametrize("ratio", [0.5, 5.0])
def test_viscous_solid_in_shear_is_roscoes_by_the_papers_scheme(ratio):
    """The steady viscoelastic ellipsoid of Roscoe (1967), whose η₁/η₀ is ``ratio``."""
    Ca, shapes = 0.25, []
    expected = roscoe_at(Ca, ratio)
    for number in (4e-3, 2e-3):
        c = cloud(analytic.shear(1.0), Ca, 0.1 * number, "paper", number=number, eta=ratio * MU_F)
        advance_to(c, 25.0 if ratio < 1 else 40.0)
        shapes.append(shape(c))
    found = 2 * shapes[1] - shapes[0]
    np.testing.assert_allclose(found[:3], expected[:3], atol=1e-4)
    np.testing.assert_allclose(found[3], expected[3], atol=0.01)


def shape(c):
    F = c.particles.F.reshape(-1, 3, 3)[0]
    return np.array(shear_shape(F, c.particles.A.reshape(-1, 3, 3)[0] @ np.linalg.inv(F)))


def test_surface_tension_is_not_for_the_papers_scheme():
    with pytest.raises(InputError, match="surfaceTension"):
        cloud(analytic.shear(1.0), 0.1, 1e-3, "paper", gamma=1e-3)


@pytest.mark.filterwarnings("ignore::foamprb.errors.FailedParticlesWarning")
@pytest.mark.parametrize(
    ("rate", "numbers"),
    [((1.0, -0.5, -0.5), (0.155, 0.17)), ((1.0, -1.0, 0.0), (0.175, 0.2))],
    ids=["uniaxial", "planar"],
)
def test_surface_tension_alone_holds_a_body_in_weak_extension(rate, numbers):
    """Up to μ_f γ̇ R/γ = 0.16 in uniaxial and 0.18 in planar extension."""
    gamma = np.sqrt(2.0 * np.square(rate).sum()) / np.array(numbers)
    p = spheres(np.zeros((2, 3)), d=2.0, rho=1.0, mu=1e-3 * gamma, poissons_ratio=0.4999, gamma=gamma)
    flow, models = analytic.linear(np.diag(rate)), Models(integrator="stokes")
    cloud = Cloud(p, flow, Medium(1.0, 1.0, (0.0, 0.0, 0.0)), [], 0.02, models, threads=1)
    cloud.advance(1000)
    assert p.status.tolist() == [Status.ACTIVE, Status.FAILED]
    before = p.F[0].copy()
    cloud.advance(500)
    np.testing.assert_allclose(p.F[0], before, atol=1e-3)


FLUID = (Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
"""Forces with the acceleration of the fluid."""


@pytest.mark.parametrize("integrator", ["paper", "rosenbrock"])
def test_virtual_mass_slows_the_start_and_not_the_end(integrator):
    """(m + ½ m_f) dv/dt = (m − m_f) g − 6πμRv of a sphere."""
    d, rho, rho_f, mu, g, t = 1e-4, 1500.0, 1000.0, 1e-3, 9.81, 5e-4
    medium = Medium(mu, rho_f, (0.0, -g, 0.0))
    p = spheres([[0.0, 0.0, 0.0]], d=d, rho=rho, mu=1e3)
    dt = 2e-6 if integrator == "paper" else 1e-4
    models = Models(integrator=integrator, tolerance=1e-7, forces=FLUID)
    c = Cloud(p, analytic.linear(np.zeros((3, 3))), medium, (), dt, models, threads=1)
    advance_to(c, t)
    tau = d * d * (rho + 0.5 * rho_f) / (18 * mu)
    expected = -(d**2) * (rho - rho_f) * g / (18 * mu) * (1 - np.exp(-t / tau))
    np.testing.assert_allclose(p.v[0, 1], expected, rtol=2e-3 if integrator == "paper" else 1e-4)


@pytest.mark.parametrize(("wall", "axis"), [(Stick(), 0), (Rebound(e=0.0, mu=0.0), 1)])
def test_ellipsoid_touches_where_its_own_shape_reaches(wall, axis):
    """A long body lands on the wall of the pipe when its end does; it falls over unless it sticks."""
    a = np.array([2.0, 1.0, 1.0]) / 2 ** (1 / 3) * 1e-5
    flow = analytic.pipe(1e-3, 1e-9)
    p = spheres([[1e-3, -0.9e-3, 0.0]], d=2e-5, rho=2000.0, mu=1e3)
    up = np.array([[0.0, 1.0, 0.0], [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
    set_rest_shape(p, (2.0, 1.0, 1.0), up)
    medium = Medium(1e-3, 1000.0, (0.0, -9.81, 0.0))
    c = Cloud(p, flow, medium, [wall] * 3, 1e-2, Models(integrator="stokes"), threads=1)
    advance_to(c, 2.0)
    np.testing.assert_allclose(1e-3 + p.x[0, 1], a[axis], rtol=2e-2)


def test_inertialess_state_is_in_balance_at_the_end():
    """A and v are those of the state that is left, not of one that the last step has predicted."""
    L = ODD - np.trace(ODD) / 3 * np.eye(3)
    c = cloud(analytic.linear(L), 0.2, 0.1, "stokes", ratios=(2.0, 1.0, 1.0))
    c.advance(7)
    p = c.particles
    F, F0 = square(p.F[0]), square(p.F0[0])
    h = 1e-5
    ahead = inertialess(F, F0, h, L, 0.2)
    back = inertialess(F, F0, -h, L, 0.2)
    np.testing.assert_allclose(square(p.A[0]), (ahead - back) / (2 * h), atol=1e-6)
    np.testing.assert_allclose(p.v[0], L @ p.x[0], atol=1e-20)
