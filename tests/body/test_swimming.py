"""Directions of swimmers: fixed in the body, random or along its axis."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.body.swimming import along_axes, direction, random_directions, random_spin

KEY = np.uint64(1), np.uint64(4)


def test_the_direction_is_fixed_in_the_body():
    """A turn turns it, whatever the body's stretch; without a direction it is 0."""
    c, s = np.cos(0.3), np.sin(0.3)
    turn, stretched = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]), np.diag([3.0, 0.5, 1.0])
    F = tuple((turn @ stretched).ravel())
    assert direction(F, (2.0, 0.0, 0.0)) == pytest.approx((c, s, 0.0))
    assert direction(F, (0.0, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def test_first_directions_are_even_on_the_sphere_and_reproducible():
    numbers = np.arange(4000, dtype=np.uint64)
    p = random_directions(numbers, KEY)
    np.testing.assert_allclose(np.linalg.norm(p, axis=1), 1.0)
    np.testing.assert_allclose(p.T @ p / 4000, np.eye(3) / 3.0, atol=4.0 * np.sqrt(4.0 / 45.0 / 4000))
    np.testing.assert_array_equal(random_directions(numbers[7:9], KEY), p[7:9])
    assert not np.allclose(random_directions(numbers, (np.uint64(2), KEY[1])), p)


@pytest.mark.parametrize(
    ("axes", "expected"),
    [((2.0, 1.0, 1.0), (-1.0, 0.0, 0.0)), ((1.0, 1.0, 0.5), (0.0, 0.0, 1.0)), ((1.0, 1.0, 1.0), None)],
)
def test_other_shapes_than_spheres_swim_along_their_axis(axes, expected):
    p = np.array([[-0.48, 0.6, 0.64]])
    found = along_axes(np.diag(axes).ravel()[None, :], p)
    np.testing.assert_allclose(found, p if expected is None else [expected], atol=1e-15)


def test_a_random_spin_has_the_variance_of_diffusion():
    assert random_spin(2.0, 0.01, (1.0, -0.5, 0.0)) == pytest.approx((20.0, -10.0, 0.0))
