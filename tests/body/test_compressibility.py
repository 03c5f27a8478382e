"""Bulk modulus and Poisson's ratio."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pipe_case import copy_of_pipe, edit

from foamprb import Cloud, Medium, Models, analytic, spheres
from foamprb.body import compressibility as own
from foamprb.body.material import lame_parameter
from foamprb.cloud.state import Status
from foamprb.run.job import prepare


@given(st.floats(1e-3, 1e6), st.floats(-0.9, 0.4999))
def test_bulk_modulus_and_poissons_ratio_are_equivalent(mu, ratio):
    bulk = own.bulk_modulus(mu, ratio)
    assert own.lame_from_bulk_modulus(bulk, mu) == pytest.approx(lame_parameter(mu, ratio), abs=1e-9 * bulk)


@pytest.mark.parametrize("integrator", ["rosenbrock", "paper"])
def test_the_softest_body_keeps_its_volume(integrator):
    """For Ca up to 1e6, where a body of ν = 0.499 is squeezed to nothing."""
    Ca, rate = np.array([1.0, 100.0, 1e4, 1e6]), 100.0
    mu_f, R, rho = 1e-3, 1e-5, 1000.0
    mu = mu_f * rate / Ca
    p = spheres(
        np.zeros((4, 3)), d=2 * R, rho=rho, mu=mu, bulk_modulus=own.sufficient_bulk_modulus(mu, mu_f * rate)
    )
    tau = rho * R**2 / (15 * mu_f)
    dt = 0.02 / rate if integrator == "rosenbrock" else 0.02 * tau
    cloud = Cloud(p, analytic.shear(rate), Medium(mu_f, rho, (0.0, 0.0, 0.0)), (), dt,
                  Models(integrator=integrator), threads=1)  # fmt: skip
    cloud.advance(round(3.0 / rate / dt))
    assert (p.status == Status.ACTIVE).all()
    np.testing.assert_allclose(np.linalg.det(p.F.reshape(-1, 3, 3)), 1.0, atol=2e-4)


@pytest.mark.parametrize("integrator", ["rosenbrock", "paper"])
def test_a_nearly_incompressible_body_deforms_as_an_incompressible_one(integrator):
    """For K/μ_s from 10² on, of soft and stiff bodies; water has 10¹¹ in air and more."""
    K = np.array([1e2, 1e4, 1e7, 1e10, 1e13, np.inf])
    mu_f, R, rho, rate = 1e-5, 5e-6, 2560.0, 900.0
    dt = (0.3 if integrator == "paper" else 3.0) * rho * R**2 / (15 * mu_f)
    p = spheres(np.zeros((12, 3)), d=2 * R, rho=rho, mu=1.0, bulk_modulus=1.0)
    p.mu[:] = mu_f * rate / np.repeat([0.01, 0.4], 6)
    p.lame[:] = np.tile(K, 2) * p.mu
    Cloud(p, analytic.shear(rate), Medium(mu_f, 1.2, (0.0, 0.0, 0.0)), (), dt,
          Models(integrator=integrator), threads=1).advance(round(3.0 / rate / dt))  # fmt: skip
    assert (p.status == Status.ACTIVE).all()
    axes = np.linalg.svd(p.F.reshape(-1, 3, 3), compute_uv=False)
    D = ((axes[:, 0] - axes[:, 2]) / (axes[:, 0] + axes[:, 2])).reshape(2, 6)
    np.testing.assert_allclose(D, np.tile(D[:, 1:2], 6), rtol=5e-4)


def test_default_bulk_modulus_keeps_the_volume(tmp_path):
    case = copy_of_pipe(tmp_path)
    edit(case, r"poissonsRatio\s+\S+;", "")
    edit(case, r"\bCa\s+0.5;", "Ca 20;")
    cloud = prepare(case).cloud
    stress = cloud.medium.mu * 923.8
    bulk = cloud.particles.lame + 2.0 / 3.0 * cloud.particles.mu
    # Some particles of the case are stiffer than the fluid pulls.
    np.testing.assert_allclose(bulk, 1e4 * np.maximum(stress, cloud.particles.mu), rtol=1e-12)
    edit(case, r"\bCa\s+20;", "Ca 20; bulkModulus 7e2;")
    cloud = prepare(case).cloud
    np.testing.assert_allclose(cloud.particles.lame + 2.0 / 3.0 * cloud.particles.mu, 7e2, rtol=1e-9)
