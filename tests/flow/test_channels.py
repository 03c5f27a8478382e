"""Flows in pipes and ducts, over a wall and between two walls: their kernels, uncompiled."""

from __future__ import annotations

import math

import numpy as np
import pytest

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow.base import NO_PLANES, Planes

RADIUS, LENGTH, MEAN = 0.5, 2.0, 1.5
PIPE = analytic.pipe(RADIUS, MEAN, LENGTH)
PLACES = ((0.3, 0.11, -0.23), (1.7, -0.4, 0.05), (0.9, 0.0, 0.0), (0.2, 0.2, 0.3))

HEIGHT = 0.4
SLIT, SHEAR = analytic.slit(HEIGHT, MEAN), analytic.shear_over_wall(7.0)
RATE = 6.0 * MEAN / HEIGHT
UP, DOWN, NONE = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0), (0.0, 0.0, 0.0)


def kernels(flow):
    return flow.kernels, flow.arrays(0.0, ())


@pytest.mark.parametrize("x", PLACES)
def test_the_derivatives_are_those_of_the_velocity(x):
    """By central differences, in each direction and in time."""
    functions, arrays = kernels(PIPE)
    t, h = 0.31, 1e-4

    def sample(dx=(0.0, 0.0, 0.0), dt=0.0):
        u, l, u_t = functions["sample"](arrays, 3, tuple(np.add(x, dx)), t + dt)
        return np.array(u), np.reshape(l, (3, 3)), np.array(u_t)

    steps = h * np.eye(3)
    slopes = np.stack([(sample(d)[0] - sample(-d)[0]) / (2 * h) for d in steps], axis=1)
    bends = np.stack([(sample(d)[1] - sample(-d)[1]) / (2 * h) for d in steps], axis=2)
    assert sample()[1] == pytest.approx(slopes, abs=1e-5)
    assert sample()[2] == pytest.approx((sample(dt=h)[0] - sample(dt=-h)[0]) / (2 * h), abs=1e-5)
    found = functions["curvature"](arrays, 3, x, t)
    for (j, k), second in zip(((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)), found, strict=True):
        assert second == pytest.approx(tuple(bends[:, j, k]), abs=1e-4)


def test_the_velocity_is_that_of_poiseuille():
    for x in PLACES:
        r = math.hypot(x[1], x[2])
        steady = 2.0 * MEAN * (1.0 - (r / RADIUS) ** 2)
        functions, arrays = kernels(PIPE)
        assert functions["sample"](arrays, 0, x, 0.0)[0] == pytest.approx(
            (steady, 0.0, 0.0), rel=1e-14, abs=0.0
        )


def left_after(x0, x1):
    """Fraction of the way from x0 to x1 after which it leaves the pipe, by the roots of polynomials."""
    x0, x1 = np.array(x0), np.array(x1)
    d = x1 - x0
    found = [(1.0, -1)]
    for at, patch in ((0.0, 1), (LENGTH, 2)):
        if d[0] != 0.0 and (x1[0] < 0.0 if patch == 1 else x1[0] > LENGTH):
            found.append(((at - x0[0]) / d[0], patch))
    roots = np.roots([d[1:] @ d[1:], 2.0 * x0[1:] @ d[1:], x0[1:] @ x0[1:] - RADIUS**2])
    found += [(float(f.real), 0) for f in roots if 0.0 < f.real < 1.0]
    return min(found)


def test_a_way_leaves_the_pipe_at_the_first_of_its_ends_and_its_wall(random):
    functions, arrays = kernels(PIPE)
    seen = set()
    for _ in range(300):
        r, phi = RADIUS * np.sqrt(random.random()), 2 * np.pi * random.random()
        x0 = (LENGTH * random.random(), r * np.cos(phi), r * np.sin(phi))
        x1 = tuple(np.add(x0, random.normal(scale=(1.0, 0.3, 0.3))))
        host, fraction, patch, triangle = functions["walk"](arrays, 7, x0, x1)
        expected = left_after(x0, x1)
        assert (host, patch, triangle) == (7, expected[1], expected[1])
        assert fraction == pytest.approx(expected[0], abs=1e-12)
        seen.add(patch)
    assert seen == {-1, 0, 1, 2}


def test_what_lies_in_an_end_or_in_the_wall_is_inside():
    functions, arrays = kernels(PIPE)
    for end in ((0.0, 0.1, 0.2), (LENGTH, 0.1, 0.2), (1.0, RADIUS, 0.0), (1.0, 0.0, -RADIUS)):
        assert functions["walk"](arrays, 7, (1.0, 0.1, 0.0), end) == (7, 1.0, -1, -1)


def test_a_start_outside_by_round_off_leaves_at_once():
    functions, arrays = kernels(PIPE)
    for x0, x1, patch in (
        ((-1e-12, 0.1, 0.0), (-0.1, 0.1, 0.0), 1),
        ((LENGTH + 1e-12, 0.1, 0.0), (LENGTH + 0.1, 0.1, 0.0), 2),
        ((1.0, RADIUS + 1e-12, 0.0), (1.0, RADIUS + 0.1, 0.02), 0),
        ((1.0, 0.0, -RADIUS - 1e-12), (1.2, 0.1, -RADIUS - 0.2), 0),
    ):
        assert functions["walk"](arrays, 7, x0, x1) == (7, 0.0, patch, patch)
    # In the rim of an end the wall counts.
    assert functions["walk"](arrays, 7, (1.75, 0.25, 0.0), (2.25, 0.75, 0.0)) == (7, 0.5, 0, 0)


def test_the_gap_is_that_to_the_tangent_plane(random):
    functions, arrays = kernels(PIPE)
    for x in PLACES[:2]:
        F = np.eye(3) + 0.4 * random.uniform(-1.0, 1.0, (3, 3))
        outward = np.array([0.0, x[1], x[2]]) / np.hypot(x[1], x[2])
        ball = random.normal(size=(200_000, 3))
        ball /= np.linalg.norm(ball, axis=1)[:, None]
        reach = (0.02 * ball @ F.T @ outward).max()
        found = functions["gap"](arrays, 5, x, tuple(F.ravel()), 0.02)
        assert found[1:] == (0, 0)
        assert found[0] == pytest.approx(RADIUS - np.hypot(x[1], x[2]) - reach, abs=1e-5)


def test_normals_point_into_the_fluid():
    functions, arrays = kernels(PIPE)
    x = (0.3, 0.3, -0.4)
    assert functions["normal"](arrays, 0, x) == pytest.approx((0.0, -0.6, 0.8), abs=1e-15)
    assert functions["normal"](arrays, 1, x) == (1.0, 0.0, 0.0)
    assert functions["normal"](arrays, 2, x) == (-1.0, 0.0, 0.0)
    assert functions["normal"](arrays, 0, (0.3, 0.0, 0.0)) == (0.0, 0.0, 0.0)


def test_the_wall_is_seen_where_it_is_nearest_and_opposite():
    functions, arrays = kernels(PIPE)
    x, chosen = (0.3, 0.12, -0.16), np.array([1, 0, 0], dtype=np.int8)
    near, far = (0.0, -0.6, 0.8), (0.0, 0.6, -0.8)
    for cut, h1, h2 in ((0.2, np.inf, np.inf), (0.4, 0.3, np.inf), (0.9, 0.3, 0.7)):
        planes = functions["walls"](arrays, 5, x, cut, chosen)
        assert planes.h1 == pytest.approx(h1)
        assert planes.h2 == pytest.approx(h2)
        assert planes.h3 == np.inf
        assert planes.n1 == pytest.approx(near, abs=1e-14)
        assert planes.n2 == pytest.approx(far, abs=1e-14)
        assert planes.n3 == (0.0, 0.0, 0.0)
    at = (0.3, 0.25, 0.0)
    assert functions["walls"](arrays, 5, at, 0.25, chosen).h1 == np.inf
    assert functions["walls"](arrays, 5, at, 0.75, chosen)[0:3:2] == (0.25, np.inf)
    assert functions["walls"](arrays, 5, x, 0.9, np.array([0, 1, 1], dtype=np.int8)) == NO_PLANES


def test_places_in_a_pipe():
    """Its ends and its wall belong to it."""
    x = [(0.0, 0.0, RADIUS), (LENGTH, -RADIUS, 0.0), (-1e-9, 0.0, 0.0), (LENGTH + 1e-9, 0.0, 0.0),
         (1.0, 0.4, 0.31), (1.0, 0.31, -0.4), (1.0, 0.3, -0.4), (1.0, 0.3, 0.3)]  # fmt: skip
    hosts = PIPE.locate(np.array(x))
    assert hosts.dtype == np.int32
    assert hosts.tolist() == [0, 0, -1, -1, -1, -1, 0, 0]
    assert PIPE.width == 2.0 * RADIUS
    assert [tuple(patch)[:2] for patch in PIPE.patches] == [
        ("wall", "wall"), ("inlet", "patch"), ("outlet", "patch"),
    ]  # fmt: skip


def test_the_flow_in_a_slit_is_a_parabola():
    functions, arrays = kernels(SLIT)
    for z in (0.0, 0.05, 0.2, 0.31):
        x, s = (0.3, -0.2, z), z / HEIGHT
        u, l, u_t = functions["sample"](arrays, 0, x, 0.3)
        assert u == pytest.approx((RATE * z * (1.0 - s), 0.0, 0.0), rel=1e-14, abs=0.0)
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
        assert found[0] == pytest.approx(gap - reach, rel=1e-12, abs=0.0)
        assert found[1:] == (patch, patch)
    functions, arrays = kernels(SHEAR)
    found = functions["gap"](arrays, 0, (0.5, 0.6, 30.0), F, 0.02)
    assert found == (pytest.approx(30.0 - reach), 0, 0)


def test_normals_of_a_slit_point_into_the_fluid():
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


def test_places_between_walls():
    z = np.array([-1e-9, 0.0, 0.1, HEIGHT, HEIGHT + 1e-9])
    x = np.stack([0.0 * z + 9.0, 0.0 * z - 9.0, z], axis=1)
    assert SLIT.locate(x).tolist() == [-1, 0, 0, 0, -1]
    assert SHEAR.locate(x).tolist() == [-1, 0, 0, 0, 0]
    assert SLIT.width == HEIGHT
    assert SHEAR.width == math.inf


DUCTS = [analytic.duct(0.4, 0.4, MEAN), analytic.duct(0.9, 0.4, MEAN), analytic.duct(0.3, 1.2, MEAN)]


@pytest.mark.parametrize("flow", DUCTS)
def test_the_derivatives_in_a_duct_are_those_of_the_velocity(flow, random):
    functions, arrays = kernels(flow)
    h = 1e-4 * flow.width
    for _ in range(5):
        y, z = random.uniform(-0.45, 0.45) * arrays.width, random.uniform(0.05, 0.95) * arrays.height
        samples = {
            d: functions["sample"](arrays, 0, (0.0, y + d[0] * h, z + d[1] * h), 0.0)
            for d in ((0, 0), (1, 0), (-1, 0), (0, 1), (0, -1))
        }
        ends = ((1, 0), (-1, 0)), ((0, 1), (0, -1))
        slopes = [(samples[a][0][0] - samples[b][0][0]) / (2 * h) for a, b in ends]
        assert samples[0, 0][1][1:3] == pytest.approx(slopes, abs=1e-6 * MEAN / flow.width)
        bends = [
            (samples[a][1][k] - samples[b][1][k]) / (2 * h)
            for k, a, b in ((1, (1, 0), (-1, 0)), (2, (0, 1), (0, -1)), (1, (0, 1), (0, -1)))
        ]
        found = functions["curvature"](arrays, 0, (0.0, y, z), 0.0)
        assert [found[k][0] for k in (1, 2, 4)] == pytest.approx(bends, abs=1e-3 * MEAN / flow.width**2)
        # Stokes' equation.
        assert found[1][0] + found[2][0] == pytest.approx(-arrays.force, rel=1e-12)


@pytest.mark.parametrize("flow", DUCTS)
def test_the_velocity_in_a_duct_has_its_mean_and_is_zero_at_the_walls(flow):
    w, h = flow.traits()["width"], flow.traits()["height"]
    y, wy = np.polynomial.legendre.leggauss(40)
    points = np.stack([np.zeros((40, 40)), *np.meshgrid(0.5 * w * y, 0.5 * h * (1.0 + y))], axis=-1)
    u = flow.sample(points.reshape(-1, 3), None, 0.0)[0][:, 0].reshape(40, 40)
    assert wy @ u @ wy / 4.0 == pytest.approx(MEAN, rel=1e-5)
    walls = np.array([[0.0, y * w / 2, z * h] for y, z in ((0.3, 0.0), (0.3, 1.0), (-1.0, 0.3), (1.0, 0.6))])
    assert flow.sample(walls, None, 0.0)[0][:, 0] == pytest.approx(0.0, abs=1e-5 * MEAN)


def test_ducts_that_are_known():
    """Square: largest over mean velocity 2.0963, f Re = 56.91 (Shah and London 1978). Wide: a slit."""
    flow, a = analytic.duct(1.0, 1.0, 1.0), np.array([[0.0, 0.0, 0.5]])
    assert flow.sample(a, None, 0.0)[0][0, 0] == pytest.approx(2.0963, abs=5e-5)
    assert 2.0 * flow.traits()["force"] == pytest.approx(56.91, abs=0.01)
    wide, x = analytic.duct(50.0, 1.0, 1.0), np.array([[0.0, 0.0, 0.2]])
    slit = analytic.slit(1.0, wide.traits()["force"] / 12.0)
    for found, expected in zip(wide.sample(x, None, 0.0), slit.sample(x, None, 0.0), strict=True):
        np.testing.assert_allclose(found, expected, rtol=1e-12)
    for k in range(2):
        with pytest.raises(InputError, match="finite lengths above 0"):
            analytic.duct(*np.roll((0.0, 1.0), k), 1.0)


def test_walls_of_a_duct():
    functions, arrays = kernels(flow := DUCTS[1])
    assert [patch.name for patch in flow.patches] == ["lower", "upper", "left", "right"]
    x = [(0, 0.45, 0.4), (0, 0.451, 0.2), (0, -0.451, 0.2), (0, 0, -0.001), (0, 0, 0.401), (0, -0.45, 0.0)]
    assert flow.locate(np.array(x, dtype=float)).tolist() == [0, -1, -1, -1, -1, 0]
    start, identity = (0.0, 0.15, 0.1), (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    ways = [
        ((1.0, 0.15, -0.3), 0.25, 0), ((1.0, 0.15, 0.7), 0.5, 1), ((1.0, -1.05, 0.1), 0.5, 2),
        ((1.0, 0.65, 0.1), 0.6, 3), ((1.0, 0.75, 0.7), 0.5, 3), ((1.0, 0.2, 0.2), 1.0, -1),
    ]  # fmt: skip
    for end, fraction, patch in ways:
        assert functions["walk"](arrays, 7, start, end) == (7, pytest.approx(fraction), patch, patch)
    # Along y the body is three times as long: it touches the wall at its side first.
    long = (1.0, 0.0, 0.0, 0.0, 3.0, 0.0, 0.0, 0.0, 1.0)
    for x, F, gap, patch in (
        ((0.0, 0.1, 0.1), identity, 0.09, 0), ((0.0, 0.1, 0.35), identity, 0.04, 1),
        ((0.0, -0.4, 0.1), identity, 0.04, 2), ((0.0, 0.36, 0.1), identity, 0.08, 3),
        ((0.0, 0.36, 0.1), long, 0.06, 3),
    ):  # fmt: skip
        assert functions["gap"](arrays, 0, x, F, 0.01) == (pytest.approx(gap), patch, patch)
    normals = [functions["normal"](arrays, k, start) for k in range(4)]
    assert normals == [UP, DOWN, (0.0, 1.0, 0.0), (0.0, -1.0, 0.0)]
    planes = functions["walls"](arrays, 0, (0.0, -0.3, 0.1), 0.2, np.ones(4, dtype=np.int8))
    assert planes[0::2] == pytest.approx((0.1, math.inf, 0.15))
    assert planes.n3 == (0.0, 1.0, 0.0)


def test_a_body_in_a_square_channel_follows_its_flow():
    """Compiled: a rigid neutral sphere, without the curvature of the flow, moves with the fluid."""
    flow = analytic.duct(40e-6, 40e-6, 0.01)
    body = spheres(np.array([[0.0, 5e-6, 12e-6]]), d=1e-6, rho=1000.0, mu=1e4)
    water = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    cloud = Cloud(body, flow, water, [Stick()] * 4, 1e-4, Models(integrator="stokes"))
    u = flow.sample(body.x, body.host, 0.0)[0][0, 0]
    cloud.advance(10)
    assert body.x[0] == pytest.approx((1e-3 * u, 5e-6, 12e-6), rel=1e-9)
