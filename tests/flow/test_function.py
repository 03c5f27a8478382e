"""A flow from a plain Python function: its values, its derivatives, and what particles do in it."""

# ruff: noqa: ARG005

from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb import analytic

A, B, C, K = 0.02, 0.03, 0.05, 700.0


def abc(x, y, z):
    """The flow of Arnold, Beltrami and Childress, with a wavelength of 9 mm."""
    return (
        A * math.sin(K * z) + C * math.cos(K * y),
        B * math.sin(K * x) + A * math.cos(K * z),
        C * math.sin(K * y) + B * math.cos(K * x),
    )


def abc_gradient(x, y, z):
    return (
        (0.0, -C * K * math.sin(K * y), A * K * math.cos(K * z)),
        (B * K * math.cos(K * x), 0.0, -A * K * math.sin(K * z)),
        (-B * K * math.sin(K * x), C * K * math.cos(K * y), 0.0),
    )


def sampled(flow, points, t=0.0):
    return flow.sample(points, flow.locate(points), t)


def rate(flow, point, t):
    """∂u/∂t, which the kernel alone gives."""
    return flow.kernels["sample"](flow.arrays(0.0, ()), 0, tuple(point), t)[2]


def test_velocity_and_gradient_of_a_function(random):
    points = 0.01 * random.standard_normal((200, 3))
    u = np.array([abc(*x) for x in points])
    l = np.array([abc_gradient(*x) for x in points])
    for flow, tolerance in (
        (analytic.function(abc), 1e-8),
        (analytic.function(abc, length=1e-2), 1e-8),
    ):
        found = sampled(flow, points)
        np.testing.assert_allclose(found[0], u, rtol=0, atol=1e-16)
        np.testing.assert_allclose(found[1], l, rtol=0, atol=tolerance * np.abs(l).max())


@pytest.mark.parametrize("size", [1e-4, 1e-3, 1.0])
def test_differences_are_right_whatever_the_size_of_the_flow(size, random):
    def swirl(x, y, z, t, size=size):
        return math.sin(y / size + 3.0 * t), x * z / size**2, math.exp(-x / size)

    flow = analytic.function(swirl)
    points, t = size * random.random((50, 3)), 0.2
    x, y, z = points.T / size
    zero = np.zeros(50)
    rows = [[zero, np.cos(y + 3.0 * t), zero], [z, zero, x], [-np.exp(-x), zero, zero]]
    _, l = sampled(flow, points, t)
    np.testing.assert_allclose(size * l, np.moveaxis(np.array(rows), -1, 0), rtol=0, atol=1e-8)
    for point, w in zip(points[:5], y, strict=False):
        assert rate(flow, point, t) == pytest.approx((3.0 * math.cos(w + 3.0 * t), 0.0, 0.0), abs=1e-7)


def test_what_a_function_captures_is_a_part_of_it():
    """Not what another function of the same text captured before."""

    def sheared(slope):
        return analytic.function(lambda x, y, z: (slope * y, 0, 0))

    point = np.array([[0.0, 2.0, 0.0]])
    assert [sampled(sheared(s), point)[0][0, 0] for s in (1.0, 3.0, 1.0)] == [2.0, 6.0, 2.0]
    assert [sampled(sheared(s), point)[1][0, 0, 1] for s in (1.0, 3.0)] == pytest.approx([1.0, 3.0], rel=1e-9)


class Field:
    def __call__(self, x, y, z):
        return x, y, z


TABLE = np.zeros(3)


def capturing():
    table = np.ones(3)
    return lambda x, y, z: (table[0], y, z)


@pytest.mark.parametrize(
    ("u", "message"),
    [
        (Field(), "not a plain function"),
        (np.sin, "not a plain function"),
        (lambda x, y: (x, y, 0.0), r"u has 2 arguments, not \(x, y, z\) or \(x, y, z, t\)"),
        (lambda x, y, z: (x, y), r"u returns something of shape \(2,\), not \(3,\)"),
        (lambda x, y, z: x, r"u returns something of shape \(\), not \(3,\)"),
        (capturing(), "u captures, or has as a default, a value other than numbers"),
    ],
)
def test_what_is_no_such_function_is_refused(u, message):
    with pytest.raises(TypeError, match=message):
        analytic.function(u)


def test_an_array_in_place_of_a_tuple_is_one_message():
    """Numba would say it in a hundred lines, when the loop is compiled."""
    with pytest.raises(TypeError, match=r"u returns an array. Return a tuple of three numbers\."):
        analytic.function(lambda x, y, z: np.array([y, z, x]))
    with pytest.raises(TypeError, match=r"u returns \[0.2, 0, 0\]. Return a tuple of three numbers\."):
        analytic.function(lambda x, y, z: [y, 0, 0])
    with pytest.raises(TypeError, match=r"u returns \('0.2', 0, 0\). Return a tuple"):
        analytic.function(lambda x, y, z: (str(y), 0, 0))
