from __future__ import annotations

import itertools

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, mild_stretches, rotations

from foamprb.body.faxen import curvature_of, faxen_velocity

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


@given(mild_stretches, rotations)
def test_all_second_derivatives_count(stretches, Q):
    """⅙ C:∇∇u by the matrix of derivatives of each component."""
    C = Q @ np.diag(stretches) ** 2 @ Q.T
    hessians = np.random.default_rng(6).normal(size=(3, 3, 3))
    hessians = hessians + hessians.transpose(0, 2, 1)
    curvature = tuple(flat(hessians[:, i, j]) for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)))
    expected = np.einsum("jk,ijk->i", C, hessians) / 6.0
    np.testing.assert_allclose(faxen_velocity(flat(C), curvature), expected, atol=1e-13)


def test_curvature_is_the_second_derivative_of_the_velocity():
    """Of a velocity of degree three, from its gradient by central differences, which are exact for it."""
    random = np.random.default_rng(8)
    quadratic, cubic = random.normal(size=(3, 3, 3)), random.normal(size=(3, 3, 3, 3))

    def velocity(x):
        return np.einsum("ijk,j,k->i", quadratic, x, x) + np.einsum("ijkl,j,k,l->i", cubic, x, x, x)

    def along(f, x, axis):
        e = np.eye(3)[axis]
        # Of fourth order.
        return (8.0 * (f(x + e) - f(x - e)) - (f(x + 2 * e) - f(x - 2 * e))) / 12.0

    def gradient(x):
        return np.stack([along(velocity, x, axis) for axis in range(3)], axis=1)

    x = np.array([0.3, -0.7, 1.1])
    found = curvature_of(*(flat(along(gradient, x, axis)) for axis in range(3)))
    symmetric = quadratic + quadratic.transpose(0, 2, 1)
    for order in itertools.permutations((1, 2, 3)):
        symmetric = symmetric + cubic.transpose(0, *order) @ x
    expected = [symmetric[:, i, j] for i, j in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))]
    np.testing.assert_allclose(found, expected, atol=1e-12)


@pytest.mark.parametrize(("i", "j", "place"), [(0, 1, 3), (1, 2, 4), (0, 2, 5)])
def test_a_mixed_derivative_is_the_mean_of_both_ways(i, j, place):
    """That of ∂u/∂j along i and that of ∂u/∂i along j."""
    gradients = np.zeros((3, 3, 3))
    gradients[i, :, j], gradients[j, :, i] = (1.0, 2.0, 3.0), (3.0, 8.0, -3.0)
    found = curvature_of(*(flat(l) for l in gradients))
    expected = np.zeros((6, 3))
    expected[place] = (2.0, 5.0, 0.0)
    np.testing.assert_array_equal(found, expected)
