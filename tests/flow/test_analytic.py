"""Flows in closed form: what they are at a point."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb import analytic


def test_a_linear_flow_is_its_gradient_times_the_place():
    """Nine different components: none may stand in the place of another."""
    l = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
    u0, x = np.array([0.1, 0.2, 0.3]), np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [3.0, 1.0, 7.0]])
    u, gradient = analytic.linear(l, u0).sample(x, np.zeros(3, dtype=np.int32), 0.0)
    assert u == pytest.approx(u0 + x @ l.T, rel=1e-15)
    np.testing.assert_array_equal(gradient, np.broadcast_to(l, (3, 3, 3)))
