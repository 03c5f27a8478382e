"""Solids with memory against independent solutions; `tools/validation/memory.py` has more closed forms."""

from __future__ import annotations

import numpy as np
import pytest
from pair_steps import Bodies, evaluate
from scipy.integrate import solve_ivp
from scipy.linalg import expm

from foamprb.body.tensor import from_frame
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import set_rest_shape, spheres, with_relaxation
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

MODULI, TIMES = np.array([2.0, 1.0]), np.array([0.3, 2.0])
SMALL = 1e-5
"""Strain rate of small strains, 1/s; all other numbers are about 1."""


def cloud_of(flow, eta=0.0, integrator="stokes", dt=0.05, axes=None, nu=0.4999999, **models):
    """A body of radius 1 at the origin, in a fluid of viscosity 1, with the moduli and times above."""
    rho = 1.5e-6
    p = spheres([(0.0, 0.0, 0.0)], d=2.0, rho=rho, mu=1.0, poissons_ratio=nu, eta=eta)
    if axes is not None:
        set_rest_shape(p, axes)
    p = with_relaxation(p, MODULI, TIMES)
    models = Models(integrator=integrator, **{"tolerance": 1e-7, **models})
    return Cloud(p, flow, Medium(1.0, rho, (0.0, 0.0, 0.0)), (), dt, models, threads=1)


def strain(p):
    F = p.F[0].reshape(3, 3)
    return 0.5 * (F @ F.T - np.eye(3))


def creep(t, e0, rate, eta):
    """Strain and stresses of the branches after t: 3 de/dt + 2 (σ + η de/dt) = 5 rate, linear."""
    A = np.zeros((4, 4))
    f = 1.0 / (3.0 + 2.0 * eta)
    A[0, :3] = -2.0 * f * np.array([1.0, *MODULI])
    A[0, 3] = 5.0 * f * rate
    # q_k' = e' − q_k/T_k
    A[1:3] = A[0]
    A[1, 1] -= 1.0 / TIMES[0]
    A[2, 2] -= 1.0 / TIMES[1]
    return (expm(A * t) @ np.array([*e0, 1.0]))[:3]


@pytest.mark.parametrize(("integrator", "eta"), [("stokes", 2.0), ("rosenbrock", 0.5)])
def test_creep_and_recovery_have_their_closed_form(integrator, eta):
    cloud = cloud_of(analytic.extension(SMALL), eta, integrator, nu=0.49999)
    e = np.zeros(3)
    before = 0.0
    for t in (0.3, 1.0, 4.0):
        cloud.advance(round(t / cloud.dt) - cloud.step)
        e, before = creep(t - before, e, SMALL, eta), t
        assert strain(cloud.particles)[0, 0] == pytest.approx(e[0], rel=5e-5)
    rest = Cloud(
        cloud.particles, analytic.linear(np.zeros((3, 3))), cloud.medium, (), cloud.dt, cloud.models,
        threads=1, step=cloud.step,
    )  # fmt: skip
    for t in (0.2, 1.0, 3.0):
        rest.advance(round((4.0 + t) / cloud.dt) - rest.step)
        expected = creep(t, e, 0.0, eta)[0]
        assert strain(rest.particles)[0, 0] == pytest.approx(expected, rel=1e-4)


def history(t, axes=(1.0, 1.0, 1.0)):
    """F in shear by solve_ivp, with b_k by its upper-convected equation."""
    a = np.array(axes) / np.prod(axes) ** (1.0 / 3.0)
    F0, l_f = np.diag(a), np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    total = 1.0 + MODULI.sum()

    def rate(_t, y):
        F, M1, M2 = y.reshape(3, 3, 3)
        M0 = np.linalg.inv(F0 @ F0)
        M = (M0 + MODULI[0] * M1 + MODULI[1] * M2) / total
        bodies = Bodies(np.array([total]), tuple(np.array([x]) for x in M.ravel()))
        s = evaluate(
            bodies, tuple(np.array([x]) for x in F.ravel()), tuple(np.array([x]) for x in l_f.ravel())
        )
        l = np.array(from_frame(s.Q, s.l)).reshape(3, 3)
        C = np.linalg.inv(F) @ np.linalg.inv(F).T
        return np.concatenate([(l @ F).ravel(), ((C - M1) / TIMES[0]).ravel(), ((C - M2) / TIMES[1]).ravel()])

    M0 = np.linalg.inv(F0 @ F0)
    start = np.concatenate([F0.ravel(), M0.ravel(), M0.ravel()])
    y = solve_ivp(rate, (0.0, t), start, rtol=1e-9, atol=1e-11).y[:, -1]
    return y[:9].reshape(3, 3), y[9:].reshape(2, 3, 3)


@pytest.mark.parametrize("integrator", ["stokes", "rosenbrock"])
@pytest.mark.parametrize("axes", [(1.0, 1.0, 1.0), (2.0, 1.0, 1.5)])
def test_large_strains_obey_the_upper_convected_equations(integrator, axes):
    cloud = cloud_of(analytic.shear(1.0), integrator=integrator, axes=axes)
    cloud.advance(round(3.0 / cloud.dt))
    p = cloud.particles
    F, M = history(3.0, axes)
    np.testing.assert_allclose(p.F[0].reshape(3, 3), F, atol=2e-5)
    a = np.array(axes) / np.prod(axes) ** (1.0 / 3.0)
    six = [(m - np.diag(a**-2.0))[[0, 1, 2, 0, 0, 1], [0, 1, 2, 1, 2, 2]] for m in M]
    np.testing.assert_allclose(p.memory[0], np.concatenate(six), atol=2e-5)


def test_the_error_is_of_third_order():
    F, _ = history(2.0)
    errors = []
    for n in (10, 20, 40):
        cloud = cloud_of(analytic.shear(1.0), dt=2.0 / n, tolerance=np.inf)
        cloud.advance(n)
        errors.append(np.abs(cloud.particles.F[0].reshape(3, 3) - F).max())
    orders = np.log2(np.divide(errors[:-1], errors[1:]))
    assert (orders > 2.6).all(), (errors, orders)


def test_models_without_memory_are_refused():
    with pytest.raises(InputError, match="relaxation"):
        cloud_of(analytic.shear(1.0), integrator="paper")
