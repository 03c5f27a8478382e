from __future__ import annotations

from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.integrate import solve_ivp
from strategies import flat, mild_stretches, rotations, square, tensors
from validation.references import wall as ref
from validation.references.near_wall import sphere_across_wall, sphere_along_wall

from foamprb.body.drag import oberbeck
from foamprb.body.ellipsoid import integrals, reach
from foamprb.body.stokes import mobility, velocity_gradient
from foamprb.body.tensor import dev, from_frame, principal_frame, scale, skew, sym, to_frame
from foamprb.body.traction import disturbance
from foamprb.body.wall import (
    curvature_factor,
    force_gradient,
    hindered_resistance,
    hindrance,
    normal_mobility,
    parallel_mobility,
    reflected_share,
    stagnation_factor,
    stresslet_gradient,
    stresslet_velocity,
)

UP = (0.0, 0.0, 1.0)
POINT = (0.0,) * 9
VOLUME = 4.0 / 3.0 * np.pi
heights = st.floats(1.2, 20.0)
vectors = st.tuples(*[st.floats(-2.0, 2.0)] * 3)


def traceless(T):
    return dev(sym(T))


def slopes(f, x, step):
    """∂f/∂x_k, (..., 3), by central differences of eighth order."""
    total = []
    for e in step * np.eye(3):
        parts = [
            w * (f(x + k * e) - f(x - k * e)) for k, w in enumerate((4 / 5, -1 / 5, 4 / 105, -1 / 280), 1)
        ]
        total.append(sum(parts) / step)
    return np.stack(total, axis=-1)


def bending(f, x, axes, step):
    """∂²f/∂a² along each of the axes, (..., 3), by central differences of eighth order."""
    total = []
    for e in step * axes:
        parts = [
            w * (f(x + k * e) + f(x - k * e) - 2.0 * f(x))
            for k, w in enumerate((8 / 5, -1 / 5, 8 / 315, -1 / 560), 1)
        ]
        total.append(sum(parts) / step**2)
    return np.stack(total, axis=-1)


def image_of_stresslet(S, x, y, step):
    """Velocity at x of the image of a stresslet at y, −S_jk ∂G_ij/∂y_k."""
    return -np.einsum("jk,ijk->i", S, slopes(lambda z: ref.image(x, z), y, step))


# --- The images of a stresslet and a force ------------------------------------------------------------------


def test_blakes_flow_vanishes_on_the_wall():
    random = np.random.default_rng(1)
    x, y = random.normal(size=(20, 3)), random.normal(size=(20, 3))
    x[:, 2], y[:, 2] = 0.0, 0.3 + abs(y[:, 2])
    assert abs(ref.stokeslet(x - y) + ref.image(x, y)).max() < 1e-15


@pytest.mark.parametrize("h", [0.7, 1.0, 6.0])
def test_image_of_a_stresslet_is_blakes(h):
    """Velocity, strain and spin at its place, to eight digits."""
    S, mu = square(traceless(flat(np.random.default_rng(2).normal(size=(3, 3))))), 1.7
    at, step = np.array([0.0, 0.0, h]), 0.02 * h
    v = stresslet_velocity(flat(S), POINT, UP, h, mu)
    np.testing.assert_allclose(v, image_of_stresslet(S, at, at, step) / mu, atol=1e-8 / h**2)
    l = stresslet_gradient(flat(S), POINT, UP, h, mu)
    expected = slopes(lambda x: image_of_stresslet(S, x, at, step), at, step) / mu
    np.testing.assert_allclose(square(l), expected, atol=1e-8 / h**3)


@given(tensors, heights)
def test_image_of_a_stresslet_by_components(T, h):
    S, mu = square(traceless(T)), 0.3
    l = stresslet_gradient(flat(S), POINT, UP, h, mu)
    strain = [
        [-3 * (2 * S[1, 1] + 5 * S[2, 2]) / 128, 3 * S[0, 1] / 64, 9 * S[0, 2] / 64],
        [3 * S[0, 1] / 64, 3 * (2 * S[1, 1] - 3 * S[2, 2]) / 128, 9 * S[1, 2] / 64],
        [9 * S[0, 2] / 64, 9 * S[1, 2] / 64, 3 * S[2, 2] / 16],
    ]
    np.testing.assert_allclose(square(sym(l)) * np.pi * mu * h**3, strain, atol=1e-13)
    spin = square(skew(l)) * np.pi * mu * h**3
    np.testing.assert_allclose(spin[2], (3 * S[0, 2] / 64, 3 * S[1, 2] / 64, 0.0), atol=1e-13)
    assert spin[0, 1] == 0.0
    v = np.array(stresslet_velocity(flat(S), POINT, UP, h, mu)) * np.pi * mu * h**2
    np.testing.assert_allclose(v, (-3 * S[0, 2] / 32, -3 * S[1, 2] / 32, -9 * S[2, 2] / 64), atol=1e-13)


@pytest.mark.parametrize("h", [0.7, 1.0, 6.0])
def test_image_of_a_force_is_blakes(h):
    f, at = (0.4, -1.1, 0.8), np.array([0.0, 0.0, h])
    expected = slopes(lambda x: ref.image(x, at) @ np.array(f), at, 0.02 * h)
    np.testing.assert_allclose(square(force_gradient(f, POINT, UP, h, 1.0)), expected, atol=1e-8 / h**2)
    v = ref.image(at, at) @ np.array(f)
    np.testing.assert_allclose(v, -3 * np.array([f[0], f[1], 2 * f[2]]) / (32 * np.pi * h), atol=1e-15)


@given(vectors, tensors, rotations, heights)
def test_force_and_stresslet_are_reciprocal(f, T, Q, h):
    """The velocity by S, times f, is minus the strain rate by f, times S (Lorentz)."""
    S, n = traceless(T), flat(Q[2])
    v = stresslet_velocity(S, POINT, n, h, 0.7)
    l = force_gradient(f, POINT, n, h, 0.7)
    np.testing.assert_allclose(np.dot(v, f), -np.dot(l, S), atol=1e-14)


def test_the_bodys_size_is_of_the_next_order():
    """The stresslet spread by ⅒ C:∇∇ over the body, its image seen by ⅙ C:∇∇, are the terms of h⁻⁴."""
    random = np.random.default_rng(5)
    F = np.eye(3) + 0.3 * random.normal(size=(3, 3))
    C, S = F @ F.T, square(traceless(flat(random.normal(size=(3, 3)))))
    squares, axes = np.linalg.eigh(C)
    at, step = np.array([0.0, 0.0, 1.0]), 0.04
    seen = bending(lambda x: image_of_stresslet(S, x, at, step), at, axes.T, step) @ squares / 6
    spread = bending(lambda y: image_of_stresslet(S, at, y, step), at, axes.T, step) @ squares / 10
    far = np.array(stresslet_velocity(flat(S), POINT, UP, 1.0, 1.0))
    h = 300.0
    found = (np.array(stresslet_velocity(flat(S), flat(C), UP, h, 1.0)) * h**2 - far) * h**2
    np.testing.assert_allclose(found, seen + spread, rtol=1e-3)


@given(tensors, mild_stretches, rotations, rotations, rotations, heights)
def test_frame_indifference(T, stretches, Q1, Q2, Q, h):
    S, F, n, f = square(traceless(T)), Q1 @ np.diag(stretches), Q2[0], Q2[1] + Q2[2]
    C = F @ F.T
    here = flat(C), flat(n), h, 1.0
    there = flat(Q @ C @ Q.T), flat(Q @ n), h, 1.0
    v = stresslet_velocity(flat(S), *here)
    np.testing.assert_allclose(stresslet_velocity(flat(Q @ S @ Q.T), *there), Q @ v, atol=1e-13)
    for function, load, turned in (
        (stresslet_gradient, S, Q @ S @ Q.T),
        (force_gradient, f, Q @ f),
    ):
        l = square(function(flat(load), *here))
        np.testing.assert_allclose(square(function(flat(turned), *there)), Q @ l @ Q.T, atol=1e-13)
        assert abs(np.trace(l)) < 1e-13


# --- Bodies in shear ----------------------------------------------------------------------------------------


def motion(F, l_f, Ca):
    """l_s and the stresslet over μ_f of a soft unit body without inertia, in the inertial frame."""
    Q, stretches = principal_frame(flat(F))
    g = integrals(stretches)
    l = to_frame(Q, flat(l_f))
    sigma = to_frame(Q, flat(F @ F.T / Ca))
    l_s = velocity_gradient(mobility(stretches, g, 0.0), sigma, l)
    relative = tuple(p - q for p, q in zip(l, l_s, strict=True))
    s, _ = disturbance(stretches, g, dev(sym(relative)), skew(relative))
    return square(from_frame(Q, l_s)), from_frame(Q, scale(VOLUME, dev(sym(s))))


@cache
def steady_shape(Ca):
    """Deformation gradient in u₁ = x₃ once the start is forgotten."""

    def rate(_t, y):
        F = y.reshape(3, 3)
        return (motion(F, ref.SHEAR_OVER_WALL, Ca)[0] @ F).ravel()

    answer = solve_ivp(rate, (0.0, 40.0 * Ca), np.eye(3).ravel(), "DOP853", rtol=1e-9, atol=1e-10)
    return answer.y[:, -1].reshape(3, 3)


def near_wall(F, l_f, h, Ca):
    """l_s, and the velocity that the wall gives to the centre, of a soft body in a flow over a wall.

    The stresslet is that in the flow with what the wall sends back of the stresslet in the flow alone.
    """
    C = flat(F @ F.T)
    S = motion(F, l_f, Ca)[1]
    l_s, S = motion(F, l_f + square(stresslet_gradient(S, C, UP, h, 1.0)), Ca)
    return l_s, stresslet_velocity(S, C, UP, h, 1.0)


def test_a_body_that_shapes_itself_near_a_wall_has_a_larger_stresslet():
    """As computed for capsules (Nix et al. 2014): the shape partly compensates the smaller lift."""
    Ca, h = 0.1, 2.0

    def rate(_t, y):
        F = y.reshape(3, 3)
        return (near_wall(F, ref.SHEAR_OVER_WALL, h, Ca)[0] @ F).ravel()

    start = steady_shape(Ca)
    answer = solve_ivp(rate, (0.0, 20.0 * Ca), start.ravel(), "DOP853", rtol=1e-6, atol=1e-7)
    F = answer.y[:, -1].reshape(3, 3)
    kept, own = near_wall(start, ref.SHEAR_OVER_WALL, h, Ca)[1], near_wall(F, ref.SHEAR_OVER_WALL, h, Ca)[1]
    assert own[2] / kept[2] == pytest.approx(1.32, abs=0.03)
    exact = ref.Ellipsoid(F, h).free_motion(F @ F.T / Ca, ref.SHEAR_OVER_WALL)
    assert own[2] == pytest.approx(exact.v[2], rel=0.04)


@pytest.mark.parametrize(
    ("h", "lift", "slip", "gradient"),
    [(5.0, 2e-3, 1e-3, 1e-4), (3.0, 0.01, 2e-3, 1.5e-3), (2.0, 0.04, 0.015, 0.01), (1.3, 0.12, 0.08, 0.04)],
)
def test_a_soft_body_near_a_wall_moves_as_in_the_stokes_flow_around_it(h, lift, slip, gradient):
    Ca = 0.1
    F = steady_shape(Ca)
    exact = ref.Ellipsoid(F, h).free_motion(F @ F.T / Ca, ref.SHEAR_OVER_WALL)
    l_s, v = near_wall(F, ref.SHEAR_OVER_WALL, h, Ca)
    assert v[2] == pytest.approx(exact.v[2], rel=lift)
    assert v[0] == pytest.approx(exact.v[0] - h, rel=slip)
    np.testing.assert_allclose(l_s, exact.l, atol=gradient)
    # The point stresslet alone lifts too much.
    far = -9 * motion(F, ref.SHEAR_OVER_WALL, Ca)[1][8] / (64 * np.pi * h**2)
    assert far / exact.v[2] > 1.0 + 1.5 / h**2


def test_the_stokes_flow_that_bodies_are_compared_with_is_roscoes_without_a_wall():
    Ca = 0.1
    F = steady_shape(Ca)
    free = ref.Ellipsoid(F, np.inf).free_motion(F @ F.T / Ca, ref.SHEAR_OVER_WALL)
    l_s, S = motion(F, ref.SHEAR_OVER_WALL, Ca)
    np.testing.assert_allclose(free.l, l_s, atol=2e-5)
    np.testing.assert_allclose(free.stresslet, square(S), atol=2e-4)
    assert abs(free.v).max() < 1e-4


@pytest.mark.parametrize(("h", "miss"), [(5.0, 4e-3), (3.0, 0.01), (2.0, 0.04)])
def test_a_soft_sphere_pulled_near_a_wall_deforms_as_in_the_stokes_flow_around_it(h, miss):
    f, F = np.array([0.6, 0.0, -0.8]), np.eye(3)
    exact = ref.Ellipsoid(F, h).free_motion(F, np.zeros((3, 3)), f)
    l_s, _ = near_wall(F, square(force_gradient(flat(f), flat(F), UP, h, 1.0)), h, 1.0)
    strain, expected = square(sym(flat(l_s))), square(sym(flat(exact.l)))
    assert abs(strain - expected).max() < miss * abs(expected).max()


# --- Mobility -----------------------------------------------------------------------------------------------


@pytest.mark.parametrize("h", [1.005, 1.05, 1.13, 1.3, 1.54, 2.0, 3.76, 10.0, 50.0])
def test_normal_mobility_is_brenners(h):
    assert normal_mobility(1.0 / h) * ref.brenner_drag(h, 2000) == pytest.approx(1.0, abs=4e-3)


def test_normal_mobility_far_from_the_wall_and_in_touch_with_it():
    assert (1.0 - normal_mobility(1e-4)) / 1e-4 == pytest.approx(9 / 8, rel=1e-6)
    assert normal_mobility(1.0 / (1.0 + 1e-4)) / 1e-4 == pytest.approx(1.0, rel=1e-3)


def speed_in_shear(h):
    """U/(γ̇ h) of a rigid unit sphere, with two reflections of its stresslet."""
    C, free = flat(np.eye(3)), 5.0 * VOLUME * square(sym(flat(ref.SHEAR_OVER_WALL)))
    S = free
    for _ in range(2):
        S = free + 5.0 * VOLUME * square(sym(stresslet_gradient(flat(S), C, UP, h, 1.0)))
    return 1.0 + stresslet_velocity(flat(S), C, UP, h, 1.0)[0] / h


@pytest.mark.parametrize("h", [1.003, 1.01, 1.0453, 1.1276, 1.3, 1.5431, 2.3524, 3.7622, 10.0677])
def test_a_sphere_moves_along_a_wall_as_in_the_exact_solution(h):
    exact = sphere_along_wall(h)
    assert parallel_mobility(1.0 / h) == pytest.approx(exact.mobility, rel=4e-3)
    assert speed_in_shear(h) == pytest.approx(exact.speed, rel=1e-3)


@pytest.mark.parametrize("h", [1.01, 1.05, 1.1, 1.2, 1.5, 2.0, 3.0, 10.0])
def test_a_sphere_is_carried_to_a_wall_as_in_the_exact_solution(h):
    """In u = (xz, yz, −z²) and in u = (z², 0, 0), each linear about the centre and with what that lacks."""
    exact = sphere_across_wall(h)
    S = -h * 20.0 / 3.0 * np.pi * np.diag([-1.0, -1.0, 2.0])
    for _ in range(2):
        E = square(stresslet_gradient(flat(S), flat(np.eye(3)), UP, h, 1.0))
        S = 20.0 / 3.0 * np.pi * (E - h * np.diag([-1.0, -1.0, 2.0]))
    v = stresslet_velocity(flat(S), flat(np.eye(3)), UP, h, 1.0)[2]
    assert v / (2.0 * h) == pytest.approx(exact.strain, rel=1e-3)
    q = reflected_share(1.0 / h)
    Q = stagnation_factor(1.0 / h, 1.0 + q + q * q)
    assert 1.0 - v / h**2 + Q == pytest.approx(exact.stagnation, rel=4e-3)
    along = 2.0 * speed_in_shear(h) - 1.0 + curvature_factor(1.0 / h)
    assert along == pytest.approx(sphere_along_wall(h).curved, rel=1e-3)


def test_a_sphere_stops_where_the_flow_carries_it_onto_a_wall():
    assert stagnation_factor(1e-3, 1.0) == pytest.approx(1e-6 / 3.0, rel=0.01)
    assert curvature_factor(1e-3) == pytest.approx(1e-6 / 3.0, rel=0.01)
    # The published limit (Goren & O'Neill 1971) of the speed over the mobility, and of the drag in shear.
    exact = sphere_across_wall(1.003).stagnation
    assert exact / normal_mobility(1.0 / 1.003) == pytest.approx(3.23, rel=5e-3)


def test_the_exact_solution_has_the_published_drag():
    for h, drag in ref.GOLDMAN_COX_BRENNER:
        assert sphere_along_wall(h).drag == pytest.approx(drag, rel=1e-4)
    assert (1.0 / parallel_mobility(1e-5) - 1.0) / 1e-5 == pytest.approx(0.5625, rel=1e-4)


@pytest.mark.parametrize("gap", [1e-4, 1e-6, 1e-8])
def test_a_sphere_stops_in_contact(gap):
    """The resistances of lubrication (Goldman, Cox & Brenner 1967), of order ln(R/gap) and 1."""
    L = -np.log(gap)
    coupling = 2 / 15 * L - 0.2526
    resistance = [[8 / 15 * L + 0.9588, -coupling], [-0.75 * coupling, 0.4 * L + 0.3817]]
    speed = np.linalg.solve(resistance, [1.7005, 0.5 * 0.9440])[0]
    mobility = np.linalg.solve(resistance, [1.0, 0.0])[0]
    assert speed_in_shear(1.0 + gap) == pytest.approx(speed, rel=2e-3)
    assert parallel_mobility(1.0 / (1.0 + gap)) == pytest.approx(mobility, rel=4e-3)


@pytest.mark.parametrize("h", [1.3, 2.0, 5.0])
def test_mobilities_are_those_of_the_stokes_flow_around_a_sphere(h):
    K = ref.Ellipsoid(np.eye(3), h).resistance() / (6 * np.pi)
    assert K[2, 2] == pytest.approx(ref.brenner_drag(h), rel=2e-3)
    assert 1.0 / K[0, 0] == pytest.approx(parallel_mobility(1.0 / h), rel=0.03)


def resistance_near_wall(F, h):
    """Of an ellipsoid over the wall x₃ = 0, in the inertial frame."""
    Q, stretches = principal_frame(flat(F))
    k = oberbeck(stretches, integrals(stretches))
    n = flat(square(Q) @ np.array(UP))
    K = hindered_resistance(k, hindrance(k, n, h, h - reach(1.0, flat(F), UP)))
    return square(from_frame(Q, K))


@given(rotations, st.floats(1.05, 30.0))
def test_a_sphere_is_hindered_by_the_closed_forms(Q, h):
    k, n = (6 * np.pi,) * 3, Q[2]
    K = square(hindered_resistance(k, hindrance(k, flat(n), h, h - 1.0))) / (6 * np.pi)
    along, across = 1 / parallel_mobility(1 / h), 1 / normal_mobility(1 / h)
    np.testing.assert_allclose(K, along * np.eye(3) + (across - along) * np.outer(n, n), atol=1e-9)


@given(mild_stretches, st.lists(st.tuples(rotations, st.floats(1e-3, 30.0)), min_size=1, max_size=4))
def test_resistance_near_any_walls_is_above_that_without(stretches, walls):
    k = oberbeck(stretches, integrals(stretches))
    W = sum(np.array(hindrance(k, flat(turn[0]), gap + 0.3, gap)) for turn, gap in walls)
    K = square(hindered_resistance(k, tuple(W)))
    np.testing.assert_allclose(K, K.T)
    root = np.sqrt(np.array(k))
    assert np.linalg.eigvalsh(K / np.outer(root, root)).min() > 1.0


@pytest.mark.parametrize("lean", [0.0, 45.0, 90.0])
@pytest.mark.parametrize(("gap", "miss"), [(1.0, 0.06), (2.0, 0.02)])
def test_ellipsoids_are_hindered_nearly_as_by_the_stokes_flow_around_them(lean, gap, miss):
    c, s = np.cos(np.radians(lean)), np.sin(np.radians(lean))
    F = np.array([[c, 0.0, -s], [0.0, 1.0, 0.0], [s, 0.0, c]]) @ np.diag([1.3, 1.0, 1.0 / 1.3])
    h = gap + reach(1.0, flat(F), UP)
    exact, found = ref.Ellipsoid(F, h, 450, 220).resistance(), resistance_near_wall(F, h)
    assert abs(found - exact).max() < miss * exact[2, 2]


def test_walls_far_away_have_no_effect():
    F = np.diag([1.2, 1.0, 0.9])
    np.testing.assert_allclose(
        resistance_near_wall(F, 1e6), ref.Ellipsoid(F, np.inf).resistance(), rtol=1e-4, atol=1e-3
    )
