"""Shapes at rest that an injection gives its particles."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.cloud.injection.shapes import Ellipsoid, Sphere
from foamprb.cloud.state import spheres


def formed(shape, n=5):
    p = spheres(np.zeros((n, 3)), d=1e-5, rho=1000.0, mu=1.0)
    shape.form(p, np.random.default_rng(2))
    np.testing.assert_array_equal(p.F, p.F0)
    return p.F.reshape(n, 3, 3)


def test_semi_axes_lie_where_they_are_said_to():
    """(4 2 1) of the volume of a sphere are 2, 1 and ½ radii; e2 gives a plane, and no length counts."""
    F = formed(Ellipsoid((4.0, 2.0, 1.0), e1=(3.0, 3.0, 0.0), e2=(0.0, 5.0, 0.0)))
    assert np.linalg.det(F) == pytest.approx([1.0] * 5)
    for axis, stretch in (((1.0, 1.0, 0.0), 2.0), ((-1.0, 1.0, 0.0), 1.0), ((0.0, 0.0, 1.0), 0.5)):
        np.testing.assert_allclose(F @ axis, np.tile(stretch * np.array(axis), (5, 1)), atol=1e-14)
    # Of which those along the coordinates are the default.
    along = formed(Ellipsoid((4.0, 2.0, 1.0)))
    np.testing.assert_allclose(along, np.tile(np.diag([2.0, 1.0, 0.5]), (5, 1, 1)), atol=1e-15)


def test_random_directions_are_each_as_likely():
    """The mean of e eᵀ over all directions is ⅓ I, its entries of a standard deviation of at most 0.3."""
    n = 4000
    values, vectors = np.linalg.eigh(formed(Ellipsoid((1.0, 4.0, 2.0), orientation="random"), n))
    np.testing.assert_allclose(values, np.tile([0.5, 1.0, 2.0], (n, 1)), rtol=1e-12)
    for k in range(3):
        e = vectors[:, :, k]
        np.testing.assert_allclose(e.T @ e / n, np.eye(3) / 3.0, atol=4.0 * 0.3 / np.sqrt(n))


def test_spheres_stay_as_they_are():
    np.testing.assert_array_equal(formed(Sphere()), np.tile(np.eye(3), (5, 1, 1)))


def test_directions_of_any_length_are_the_same_axes():
    axes = Ellipsoid(axisRatios=(2.0, 1.0, 1.0), e1=(1e100, 1e100, 0.0), e2=(0.0, 0.0, -1e-100)).axes()
    expected = Ellipsoid(axisRatios=(2.0, 1.0, 1.0), e1=(1.0, 1.0, 0.0), e2=(0.0, 0.0, -1.0)).axes()
    np.testing.assert_array_equal(axes, expected)
