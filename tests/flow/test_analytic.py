"""Flows in closed form: what they are at a point."""

from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb import analytic
from foamprb.errors import InputError
from foamprb.flow import analytic as module
from foamprb.flow import kernels as defaults
from foamprb.flow.base import NO_PLANES


def test_a_linear_flow_is_its_gradient_times_the_place():
    """Nine different components: none may stand in the place of another."""
    l = np.array([[1.0, 2.0, 3.0], [4.0, 5.0, 6.0], [7.0, 8.0, -6.0]])
    u0, x = np.array([0.1, 0.2, 0.3]), np.array([[0.0, 0.0, 0.0], [1.0, -2.0, 0.5], [3.0, 1.0, 7.0]])
    u, gradient = analytic.linear(l, u0).sample(x, np.zeros(3, dtype=np.int32), 0.0)
    assert u == pytest.approx(u0 + x @ l.T, rel=1e-15, abs=0.0)
    np.testing.assert_array_equal(gradient, np.broadcast_to(l, (3, 3, 3)))


def test_named_flows_have_the_gradients_of_their_names():
    for flow, rows in (
        (analytic.shear(3.0), [[0, 3, 0], [0, 0, 0], [0, 0, 0]]),
        (analytic.rotation(3.0), [[0, 1.5, 0], [-1.5, 0, 0], [0, 0, 0]]),
        (analytic.extension(3.0), [[3, 0, 0], [0, -1.5, 0], [0, 0, -1.5]]),
    ):
        x = np.array([[0.3, -0.7, 1.1]])
        u, l = flow.sample(x, flow.locate(x), 0.0)
        np.testing.assert_allclose(l[0], rows)
        np.testing.assert_allclose(u[0], np.array(rows) @ x[0])


def test_a_flow_without_bounds_has_none():
    flow = analytic.linear(np.arange(9.0).reshape(3, 3), (0.1, 0.2, 0.3))
    arrays, kernels = flow.arrays(0.1, (0,)), flow.kernels
    x, F, no = (0.1, 0.2, 0.3), (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0), (0.0, 0.0, 0.0)
    assert defaults.walk(arrays, 4, x, 0.0, (9.0, 9.0, 9.0), 1.0) == (4, 1.0, -1, -1)
    assert kernels["gap"](arrays, 4, x, F, 0.1) == (np.inf, -1, -1)
    assert defaults.normal(arrays, 4, x, 0.0) == no
    assert defaults.recover(arrays, x, 0.0) == 0
    assert kernels["curvature"](arrays, 4, x, 0.0) == (no,) * 6
    assert kernels["sample"](arrays, 4, x, 0.0)[2] == no
    assert defaults.walls(arrays, 4, x, 1.0, None, 0.0) == NO_PLANES
    assert defaults.turbulence(arrays, 4, x, 0.0) == (0.0, 0.0, no, no)
    assert defaults.rotation_at(arrays, 4) == (no, no)
    assert defaults.cross(arrays, 4, x, 0.0) == (0, x, F)
    assert defaults.cell_volume(arrays, 4) == np.inf
    assert flow.locate(np.zeros((3, 3))).tolist() == [0, 0, 0]
    assert flow.cell_size(np.zeros(3, dtype=np.int32)).tolist() == [np.inf] * 3
    assert flow.width == np.inf
    assert flow.span == (-np.inf, np.inf)
    assert flow.load(0.0, 3.0) == np.inf
    assert flow.patches == flow.notes == ()
    assert not flow.lists_walls
    values = flow.at_some_nodes()
    assert [a.shape for a in values[1:]] == [(0, 3), (0, 9), (0, 8), (0,)]
    assert flow.ends_at_nodes(lambda values: values[1:]) == []
    traits = flow.traits()
    assert traits["u0"].tolist() == [0.1, 0.2, 0.3]
    assert traits["l"].tolist() == list(range(9))


def test_a_flow_in_closed_form_has_neither_faces_nor_cells():
    flow = analytic.pipe(1.0, 1.0)
    with pytest.raises(InputError, match="patch wall: a flow in closed form has no faces to inject from"):
        flow.patch_faces("wall", 0.0)
    with pytest.raises(InputError, match="all cells: a flow in closed form has no cells to inject into"):
        flow.cell_zone(None)
    with pytest.raises(InputError, match="cellZone rotor: a flow in closed form"):
        flow.cell_zone("rotor")


def test_differences_are_of_the_fourth_order():
    """Exact for polynomials up to the fourth degree, each component with its own."""
    h, values = 0.3, []
    for at in (-2.0, -1.0, 1.0, 2.0):
        s = 1.0 + at * h
        values.append((s**4, 2.0 * s**3 - s, 5.0 * s + s * s))
    assert module._difference(*values, h) == pytest.approx((4.0, 5.0, 7.0), rel=1e-12)
    tensors = [tuple(k * v[k % 3] for k in range(9)) for v in values]
    exact = [k * (4.0, 5.0, 7.0)[k % 3] for k in range(9)]
    assert module._derivative(*tensors, h) == pytest.approx(exact, rel=1e-12)


def test_functions_of_place_alone_with_defaults_and_with_numbers_captured():
    k = 3.0
    for u in (
        lambda x, y, z: (k * y, 0, z + 0 * x),
        lambda x, y, z, s=3.0: (s * y, 0, z + 0 * x),
        lambda x, y, z, t: (3 * y, 0, z + 0 * x * t),
    ):
        flow = analytic.function(u)
        x = np.array([[0.1, 0.2, 0.3], [1.0, 2.0, 3.0]])
        found, l = flow.sample(x, flow.locate(x), 0.0)
        np.testing.assert_allclose(found, [[0.6, 0.0, 0.3], [6.0, 0.0, 3.0]], rtol=1e-14)
        np.testing.assert_allclose(l, [[[0, 3, 0], [0, 0, 0], [0, 0, 1]]] * 2, atol=1e-8)


def test_a_function_that_has_no_value_at_the_place_of_the_trial_is_taken():
    flow = analytic.function(lambda x, y, z: (math.sqrt(x - 1.0), 1.0 / (y - 0.2), z))
    x = np.array([[2.0, 1.2, 0.3]])
    assert flow.sample(x, flow.locate(x), 0.0)[0][0] == pytest.approx([1.0, 1.0, 0.3])
