"""Flow through arrays of posts in closed form."""

from __future__ import annotations

import numpy as np
import pytest

from foamprb.errors import InputError
from foamprb.flow import analytic

SPACING, DIAMETER = 2e-5, 1e-5
ARRAYS = {"square": ((1e-3, -2e-4), 0.0), "shifted": ((1e-3, 0.0), 0.2 * SPACING)}


def sample(flow, *points):
    x = np.array(points, dtype=float)
    assert not flow.locate(x).any()
    return flow.sample(x, flow.locate(x), 0.0)


@pytest.mark.parametrize(("velocity", "shift"), ARRAYS.values(), ids=ARRAYS)
def test_the_flow_is_periodic_without_slip_and_has_its_mean(velocity, shift):
    flow = analytic.posts(SPACING, DIAMETER, velocity, shift)
    y = SPACING * np.linspace(0.3, 0.7, 5)
    edges = (0.0 * y + 0.5 * SPACING, y, 0.0 * y), (y - 0.5 * SPACING, 0.0 * y + 0.5 * SPACING, 0.0 * y)
    for edge, step in zip(edges, 1e-12 * np.eye(3)[:2], strict=True):
        (u, l), (v, m) = (sample(flow, *(np.transpose(edge) + side * step)) for side in (1, -1))
        np.testing.assert_allclose(u, v, atol=1e-8)
        np.testing.assert_allclose(l, m, atol=5e-2)
    angle = np.linspace(0.0, 6.0, 9)
    rim = 0.5 * DIAMETER * (1.0 + 1e-12) * np.array([np.cos(angle), np.sin(angle), 0.0 * angle]).T
    u, l = sample(flow, *rim)
    assert np.abs(u).max() < 1e-12
    assert np.abs(np.trace(l, axis1=1, axis2=2)).max() < 1e-9
    nodes, weights = np.polynomial.legendre.leggauss(40)
    gap = 0.5 * SPACING + 0.5 * (SPACING - DIAMETER) * nodes
    u, _ = sample(flow, *np.array([0.0 * gap, gap, 0.0 * gap]).T)
    assert 0.5 * (SPACING - DIAMETER) * (weights @ u[:, 0]) == pytest.approx(SPACING * velocity[0], rel=1e-8)
    # Through a row of posts, from one post to the next.
    along = 0.5 * DIAMETER + (SPACING - DIAMETER) * 0.5 * (1.0 + nodes)
    if not shift:
        u, _ = sample(flow, *np.array([along, 0.0 * along, 0.0 * along]).T)
        assert 0.5 * (SPACING - DIAMETER) * (weights @ u[:, 1]) == pytest.approx(
            SPACING * velocity[1], rel=1e-7
        )


def test_its_derivatives_are_those_of_the_velocity():
    flow = analytic.posts(SPACING, DIAMETER, (1e-3, 0.0), 4e-6)
    x, h = np.array([0.31 * SPACING, 0.27 * SPACING, 0.0]), 1e-3 * SPACING
    steps = h * np.eye(3)[:2]
    ((_, l),) = [sample(flow, x)]
    curvature = flow.kernels["curvature"](flow._parameters, 0, tuple(x), 0.0)
    for k, step in enumerate(steps):
        (ahead, before), gradients = sample(flow, x + step, x - step)
        np.testing.assert_allclose(l[0, :, k], (ahead - before) / (2 * h), atol=1e-2)
        second = (gradients[0] - gradients[1]) / (2 * h)
        np.testing.assert_allclose(curvature[k], second[:, k], atol=3e3)
        np.testing.assert_allclose(curvature[3], second[:, 1 - k], atol=3e3)


def test_a_path_ends_on_a_post():
    flow = analytic.posts(SPACING, DIAMETER, (1e-3, 0.0), 4e-6)
    start, end = (0.5 * SPACING, 4e-6, 0.0), (0.9 * SPACING, 4e-6, 0.0)
    host, fraction, patch, _ = flow.kernels["walk"](flow._parameters, 0, start, end)
    assert (host, patch) == (0, 0)
    assert fraction == pytest.approx((0.25 / 0.4), rel=1e-12)
    assert flow.kernels["walk"](flow._parameters, 0, start, (0.7 * SPACING, 4e-6, 0.0))[1:3] == (1.0, -1)
    planes = flow.kernels["walls"](flow._parameters, 0, (0.0, 0.4 * SPACING, 0.0), 1.0, np.ones(1, np.int8))
    assert (planes.h1, planes.h2) == pytest.approx((0.15 * SPACING, 0.35 * SPACING))
    assert (planes.n1[1], planes.n2[1]) == (1.0, -1.0)


def test_impossible_posts_are_refused():
    with pytest.raises(InputError, match=r"diameter of 0.2 to 0.9"):
        analytic.posts(SPACING, SPACING, (1e-3, 0.0))
