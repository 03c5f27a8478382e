from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, mild_stretches, rotations

from foamprb.body.faxen import faxen_velocity
from foamprb.validation.references import wall as ref

RADIUS, SPEED = 10.0, 1.0


def poiseuille(x):
    """u₃ = U (1 − r²/a²) at points (n, 3)."""
    u = np.zeros_like(x)
    u[:, 2] = SPEED * (1.0 - (x[:, 0] ** 2 + x[:, 1] ** 2) / RADIUS**2)
    return u


CURVATURE = tuple((0.0, 0.0, c * SPEED / RADIUS**2) for c in (-2.0, -2.0, 0.0, 0.0, 0.0, 0.0))


def test_a_sphere_lags_in_a_pipe_by_two_thirds_of_its_radius_squared():
    """(2/3) U (R/a)², wherever it is (Happel & Brenner)."""
    R = 1.3
    v = faxen_velocity(flat(R * R * np.eye(3)), CURVATURE)
    np.testing.assert_allclose(v, (0.0, 0.0, -2.0 / 3.0 * SPEED * (R / RADIUS) ** 2), rtol=1e-14)


@given(mild_stretches, rotations)
def test_an_ellipsoid_moves_with_the_mean_over_the_mapped_sphere(stretches, Q):
    """The traction of a translating ellipsoid is uniform over the sphere that F maps to it (Brenner 1964)."""
    F = Q @ np.diag(stretches)
    centre = np.array([[2.0, -1.0, 0.3]])
    # A mean of degree two over the sphere is one over six points.
    points = np.concatenate([np.eye(3), -np.eye(3)])
    mean = poiseuille(centre + points @ F.T).mean(axis=0)
    v = faxen_velocity(flat(F @ F.T), CURVATURE)
    np.testing.assert_allclose(v, mean - poiseuille(centre)[0], atol=1e-14)


@pytest.mark.parametrize("stretches", [(1.0, 1.0, 1.0), (1.5, 1.0, 0.7)])
def test_ellipsoids_lag_as_in_the_stokes_flow_around_them(stretches):
    random = np.random.default_rng(4)
    Q, _ = np.linalg.qr(random.normal(size=(3, 3)))
    F = Q @ np.diag(stretches)
    body = ref.Ellipsoid(F, np.inf)
    centre = np.array([3.0, 1.0, 0.0])
    u = poiseuille(centre + body.x)
    v = np.linalg.solve(body.resistance(), body.moments(u)[0])
    lag = np.array(faxen_velocity(flat(F @ F.T), CURVATURE))
    np.testing.assert_allclose(v, poiseuille(centre[None])[0] + lag, atol=1e-3 * abs(lag).max())


@given(mild_stretches, rotations)
def test_all_second_derivatives_count(stretches, Q):
    """⅙ C:∇∇u by the matrix of derivatives of each component."""
    C = Q @ np.diag(stretches) ** 2 @ Q.T
    hessians = np.random.default_rng(6).normal(size=(3, 3, 3))
    hessians = hessians + hessians.transpose(0, 2, 1)
    curvature = tuple(flat(hessians[:, i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)))
    expected = np.einsum("jk,ijk->i", C, hessians) / 6.0
    np.testing.assert_allclose(faxen_velocity(flat(C), curvature), expected, atol=1e-13)
