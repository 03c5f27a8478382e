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


def test_a_flow_without_a_mesh_has_nothing_at_nodes():
    flow = analytic.pipe(0.5, 1.0, 2.0)
    time, u, l = flow.at_nodes()
    assert (time, u.shape, l.shape, flow.turbulence_at_nodes().shape) == ("", (0, 3), (0, 9), (0, 8))


def test_between_walls_flows_a_parabola_and_above_one_a_shear():
    z, h, U = np.array([0.0, 0.01, 0.15, 0.2]), 0.2, 3.0
    x = np.stack([1.0 + z, 2.0 - z, z], axis=1)
    slit, shear = analytic.slit(h, U), analytic.shear_over_wall(7.0)
    for flow, speed, rate in (
        (slit, 6.0 * U * z / h * (1.0 - z / h), 6.0 * U / h * (1.0 - 2.0 * z / h)),
        (shear, 7.0 * z, 7.0 + 0.0 * z),
    ):
        u, l = flow.sample(x, flow.locate(x), 0.0)
        np.testing.assert_allclose(u, np.outer(speed, (1.0, 0.0, 0.0)), rtol=1e-14, atol=1e-14)
        only = np.zeros((len(z), 3, 3))
        only[:, 0, 2] = rate
        np.testing.assert_allclose(l, only, rtol=1e-14, atol=1e-12)
    assert [tuple(patch)[:2] for patch in slit.patches] == [("lower", "wall"), ("upper", "wall")]
    assert [tuple(patch)[:2] for patch in shear.patches] == [("wall", "wall")]


def test_a_straight_way_leaves_a_pipe_where_it_meets_its_end_or_its_wall():
    flow = analytic.pipe(0.5, 1.0, 2.0)
    arrays, walk = flow.arrays(0.0, ()), flow.kernels["walk"]
    names = [patch.name for patch in flow.patches]
    for x0, x1, fraction, name in (
        ((1.5, 0.1, 0.0), (2.5, 0.2, 0.1), 0.5, "outlet"),
        ((0.5, 0.1, 0.0), (-1.5, 0.2, 0.1), 0.25, "inlet"),
        ((1.0, 0.3, 0.0), (1.8, 0.7, 0.0), 0.5, "wall"),
        # The wall before the outlet, and the outlet before the wall.
        ((1.0, 0.4, 0.0), (3.0, 0.8, 0.0), 0.25, "wall"),
        ((1.5, 0.1, 0.0), (3.5, 0.6, 0.0), 0.25, "outlet"),
    ):
        found = walk(arrays, 0, x0, x1)
        assert found[1] == pytest.approx(fraction, rel=1e-14)
        assert names[found[2]] == name
    assert walk(arrays, 0, (1.0, 0.1, 0.0), (1.5, 0.3, 0.2)) == (0, 1.0, -1, -1)
