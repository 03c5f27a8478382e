"""Flow over a wall and between two: the functions that the particle loop calls, as plain functions."""

from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb import analytic
from foamprb.flow.base import Planes

HEIGHT, MEAN = 0.4, 1.5
SLIT, SHEAR = analytic.slit(HEIGHT, MEAN), analytic.shear_over_wall(7.0)
RATE = 6.0 * MEAN / HEIGHT
UP, DOWN, NONE = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 0.0, 0.0)


def kernels(flow):
    return flow.kernels, flow.arrays(0.0, ())


def test_the_flow_in_a_slit_is_a_parabola():
    functions, arrays = kernels(SLIT)
    for z in (0.0, 0.05, 0.2, 0.31):
        x, s = (0.3, -0.2, z), z / HEIGHT
        u, l, u_t = functions["sample"](arrays, 0, x, 0.3)
        assert u == pytest.approx((RATE * z * (1.0 - s), 0.0, 0.0), rel=1e-14)
        assert l == pytest.approx((0.0, 0.0, RATE * (1.0 - 2.0 * s), *6 * [0.0]), rel=1e-13, abs=1e-13)
        assert u_t == NONE
        bends = functions["curvature"](arrays, 0, x, 0.3)
        assert bends[2] == pytest.approx((-2.0 * RATE / HEIGHT, 0.0, 0.0), rel=1e-14)
        assert [bends[k] for k in (0, 1, 3, 4, 5)] == 5 * [NONE]


def test_a_way_ends_at_the_wall_that_it_meets():
    functions, arrays = kernels(SLIT)
    for x0, x1, fraction, patch in (
        ((0.1, 0.2, 0.1), (0.5, 0.2, -0.3), 0.25, 0),
        ((0.1, 0.2, 0.3), (0.5, 0.2, 0.5), 0.5, 1),
        ((0.1, 0.2, 0.1), (0.5, 0.2, 0.4), 1.0, -1),
        ((0.1, 0.2, 0.1), (0.5, 0.2, 0.0), 1.0, -1),
        ((0.1, 0.2, -1e-12), (0.5, 0.2, -0.3), 0.0, 0),
        ((0.1, 0.2, 0.4 + 1e-12), (0.5, 0.2, 0.5), 0.0, 1),
    ):
        host, found, reached, triangle = functions["walk"](arrays, 7, x0, x1)
        assert (host, reached, triangle) == (7, patch, patch)
        assert found == pytest.approx(fraction, abs=1e-14)


def test_the_gap_is_that_to_the_nearer_wall():
    functions, arrays = kernels(SLIT)
    # Reach along z: R |Fᵀ·e_z|.
    F = (1.0, 0.2, 0.1, 0.3, 0.9, 0.0, 0.2, 0.6, 1.5)
    reach = 0.02 * math.sqrt(0.2**2 + 0.6**2 + 1.5**2)
    for z, gap, patch in ((0.1, 0.1, 0), (0.27, 0.13, 1), (0.2, 0.2, 0)):
        found = functions["gap"](arrays, 0, (0.5, 0.6, z), F, 0.02)
        assert found[0] == pytest.approx(gap - reach, rel=1e-12)
        assert found[1:] == (patch, patch)
    functions, arrays = kernels(SHEAR)
    found = functions["gap"](arrays, 0, (0.5, 0.6, 30.0), F, 0.02)
    assert found == (pytest.approx(30.0 - reach), 0, 0)


def test_normals_point_into_the_fluid():
    functions, arrays = kernels(SLIT)
    assert functions["normal"](arrays, 0, (0.1, 0.2, 0.3)) == UP
    assert functions["normal"](arrays, 1, (0.1, 0.2, 0.1)) == DOWN


@pytest.mark.parametrize(
    ("cut", "chosen", "low", "high"),
    [
        (0.5, (1, 1), 0.1, 0.3),
        (0.5, (0, 1), math.inf, 0.3),
        (0.5, (1, 0), 0.1, math.inf),
        (0.2, (1, 1), 0.1, math.inf),
        (0.05, (1, 1), math.inf, math.inf),
        (0.1, (1, 1), math.inf, math.inf),
    ],
)
def test_walls_are_seen_that_are_chosen_and_near(cut, chosen, low, high):
    functions, arrays = kernels(SLIT)
    found = functions["walls"](arrays, 0, (0.7, 0.8, 0.1), cut, np.array(chosen, dtype=np.int8))
    assert found == Planes(low, UP, pytest.approx(high), DOWN, math.inf, NONE)


def test_the_upper_wall_is_not_seen_from_just_its_distance():
    functions, arrays = kernels(SLIT)
    found = functions["walls"](arrays, 0, (0.7, 0.8, 0.15), 0.25, np.array([1, 1], dtype=np.int8))
    assert (found.h1, found.h2) == (0.15, math.inf)


def test_places_between_walls():
    z = np.array([-1e-9, 0.0, 0.1, HEIGHT, HEIGHT + 1e-9])
    x = np.stack([0.0 * z + 9.0, 0.0 * z - 9.0, z], axis=1)
    assert SLIT.locate(x).tolist() == [-1, 0, 0, 0, -1]
    assert SHEAR.locate(x).tolist() == [-1, 0, 0, 0, 0]
    assert SLIT.width == HEIGHT
    assert SHEAR.width == math.inf
