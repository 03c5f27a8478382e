"""Quadratic mode of a soft sphere against numbers of the theory and independent calculations."""

from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from strategies import flat, rotations

from foamprb.body.quadratic import (
    Weights,
    advanced,
    advanced_vector,
    bullet_amplitude,
    contract,
    drift_by_shift,
    drift_of_drop,
    drift_of_solid,
    largest_swelling,
    layers,
    outline_parts,
    parts,
    relaxation_of_drop,
    relaxation_of_shift,
    relaxation_of_solid,
    rotation,
    shift,
    source,
    square,
    swelling,
    tube_amplitude,
    tube_deformation,
    tube_velocity,
    turn_of,
    turned,
    weights,
)

# A flow without symmetry; its second derivatives G[i] of component i.
L = np.array([[1.0, 2.0, 0.0], [0.0, -2.0, 1.0], [3.0, -1.0, 1.0]])
G = np.array(
    [
        [[1.0, 2.0, 0.0], [2.0, -1.0, 1.0], [0.0, 1.0, 3.0]],
        [[2.0, 0.0, -1.0], [0.0, 1.0, 2.0], [-1.0, 2.0, 0.0]],
        [[1.0, -1.0, -1.0], [-1.0, 2.0, -3.0], [-1.0, -3.0, -2.0]],
    ]
)
E = 0.5 * (L + L.T)
OMEGA = 0.5 * np.array([L[2, 1] - L[1, 2], L[0, 2] - L[2, 0], L[1, 0] - L[0, 1]])
LEVI_CIVITA = np.zeros((3, 3, 3))
LEVI_CIVITA[0, 1, 2] = LEVI_CIVITA[1, 2, 0] = LEVI_CIVITA[2, 0, 1] = 1.0
LEVI_CIVITA[0, 2, 1] = LEVI_CIVITA[2, 1, 0] = LEVI_CIVITA[1, 0, 2] = -1.0


def curvature_of(G):
    return tuple(tuple(map(float, G[:, j, k])) for j, k in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2)))


def full(B):
    return np.reshape(layers(B), (3, 3, 3))


def third(B):
    return B[0, 0, 0], B[0, 0, 1], B[0, 0, 2], B[0, 1, 1], B[0, 1, 2], B[1, 1, 1], B[1, 1, 2]


def random_third(seed):
    return tuple(map(float, np.random.default_rng(seed).normal(size=7)))


def bullet(eps, axis=0):
    """Return B of r = a (1 + ε P₃) along an axis."""
    e = np.eye(3)[axis]
    delta = np.einsum("ij,k->ijk", np.eye(3), e)
    trace = delta + delta.transpose(0, 2, 1) + delta.transpose(2, 1, 0)
    return third(2.5 * eps * (np.einsum("i,j,k->ijk", e, e, e) - trace / 5.0))


# --- Parts of the flow --------------------------------------------------------------------------------------


def test_parts_of_a_flow_without_symmetry():
    S, T, v = parts(curvature_of(G))
    expected = (0.400000, 1.800000, 0.266667, -0.533333, -0.333333, 0.400000, 1.933333)
    assert pytest.approx(expected, abs=5e-7) == S
    assert pytest.approx(flat(np.array([[0.0, -0.5, -1.5], [-0.5, 2.0, 2.5], [-1.5, 2.5, -2.0]]))) == T
    assert v == pytest.approx((3.0, 3.0, 1.0))


def test_parts_make_up_the_second_derivatives():
    S, T, v = parts(curvature_of(G))
    T, v, d = np.reshape(T, (3, 3)), np.array(v), np.eye(3)
    twist = np.einsum("iak,aj->ijk", LEVI_CIVITA, T)
    translation = (
        4.0 * np.einsum("jk,i->ijk", d, v) - np.einsum("ij,k->ijk", d, v) - np.einsum("ik,j->ijk", d, v)
    )
    together = full(S) + (twist + twist.transpose(0, 2, 1)) / 3.0 + translation / 10.0
    np.testing.assert_allclose(together, G, atol=1e-14)


def test_S_is_traceless_in_a_flow_with_divergence():
    """A reconstructed velocity has a small one."""
    H = np.random.default_rng(1).normal(size=(3, 3, 3))
    H = H + H.transpose(0, 2, 1)
    symmetric = (H + H.transpose(1, 2, 0) + H.transpose(2, 0, 1)) / 3.0
    t = np.einsum("iik->k", symmetric) / 5.0
    trace = sum(np.einsum(f"ij,k->{order}", np.eye(3), t) for order in ("ijk", "ikj", "kij"))
    np.testing.assert_allclose(full(parts(curvature_of(H)).S), symmetric - trace, atol=1e-14)


@pytest.mark.parametrize("y", [0.0, 0.4])
def test_a_pipe_pushes_into_the_shape_of_a_bullet(y):
    """S_zzz = 4U/(5R²), wherever the body is."""
    H = np.zeros((3, 3, 3))
    H[2, 0, 0] = H[2, 1, 1] = -2.0
    S = parts(curvature_of(H)).S
    assert full(S)[2, 2, 2] == pytest.approx(4.0 / 5.0, rel=1e-14)
    eps = (35.0 / 32.0) * np.array(S)
    assert eps == pytest.approx(bullet(7.0 / 8.0, 2))
    assert bullet_amplitude(tuple(eps)) == pytest.approx(7.0 / 8.0)


# --- Rates --------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("eta", "tau_3", "tau_1"),
    [(0.0, 1.187500, 0.666667), (1.0, 2.187500, 1.666667), (3.0, 4.187500, 3.666667)],
)
def test_times_of_solids(eta, tau_3, tau_1):
    assert 1.0 / relaxation_of_solid(1.0, 1.0, eta, 0.0) == pytest.approx(tau_3, abs=5e-7)
    assert 1.0 / relaxation_of_shift(1.0, 1.0, eta) == pytest.approx(tau_1, abs=5e-7)
    # The steady amplitude does not depend on the viscosity of the solid.
    assert source(eta) / relaxation_of_solid(1.0, 1.0, eta, 0.0) == pytest.approx(35.0 / 32.0)


def test_surface_tension_reduces_the_steady_shape_of_a_solid():
    s = 0.7
    steady = source(0.0) / relaxation_of_solid(1.0, 1.0, 0.0, s)
    assert steady == pytest.approx(35.0 / 32.0 / (1.0 + 35.0 / 22.0 * s))


@pytest.mark.parametrize(
    ("ratio", "steady", "tau_3"),
    [
        (0.0, 0.625, 0.678571),
        (1.0, 0.656250, 1.312500),
        (10.0, 0.681818, 6.974026),
        (1e9, 0.6875, 22e9 / 35.0),
    ],
)
def test_steady_shape_and_time_of_drops(ratio, steady, tau_3):
    tau = 1.0 / relaxation_of_drop(1.0, ratio, 1.0)
    assert tau == pytest.approx(tau_3, rel=1e-6)
    assert source(ratio) * tau == pytest.approx(steady, abs=5e-7)


def evolved(t, n, Omega=OMEGA):
    """Return B at a time t from n steps, for μ_f = μ_s = a = 1 without viscosity of the solid."""
    S, h = parts(curvature_of(G)).S, t / n
    before = tuple(source(0.0) * c for c in S)
    w, turn = weights(relaxation_of_solid(1.0, 1.0, 0.0, 0.0), h), rotation(tuple(Omega), h)
    B = (0.0,) * 7
    for _ in range(n):
        B = advanced(B, before, before, w, turn)
    return np.array(B)


def test_shape_in_a_turning_flow():
    expected = (-0.199910, 0.481579, 0.573152, 0.108014, 0.428253, 0.110801, -0.403302)
    assert evolved(1.0, 2000) == pytest.approx(expected, abs=1e-6)


def test_steps_are_of_second_order_in_a_turning_flow():
    exact = evolved(1.0, 4096)
    errors = [np.abs(evolved(1.0, n) - exact).max() for n in (16, 32)]
    assert errors[0] / errors[1] == pytest.approx(4.0, rel=0.05)


def test_a_step_is_exact_without_rotation():
    """However long it is against the relaxation time, for a source that is linear in time."""
    rate, h = 50.0, 2.0
    none, one = (0.0,) * 7, (1.0,) + (0.0,) * 6
    B = advanced(none, none, one, weights(rate, h), rotation((0.0, 0.0, 0.0), h))
    assert B[0] == pytest.approx(1.0 / rate - (1.0 - np.exp(-rate * h)) / (rate * rate * h), rel=1e-12)


def test_a_free_shape_turns_with_the_fluid():
    """Without source and relaxation, in many steps of any size."""
    B, q, w = random_third(3), (0.3, -0.2, 0.5), Weights(1.0, 0.0, 0.0)
    turn = rotation((0.0, 0.0, np.pi / 2.0 / 50.0), 1.0)
    C, p, zero = B, q, (0.0,) * 7
    for _ in range(50):
        C, p = advanced(C, zero, zero, w, turn), advanced_vector(p, (0.0,) * 3, (0.0,) * 3, w, turn)
    quarter = (0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    assert pytest.approx(turned(B, quarter), abs=1e-10) == C
    assert p == pytest.approx((0.2, 0.3, 0.5), abs=1e-10)


# --- Tensors ------------------------------------------------------------------------------------------------


@given(rotations)
def test_a_turned_tensor_is_that_of_turned_axes(Q):
    B = random_third(5)
    for sign in (1.0, -1.0):
        expected = np.einsum("il,jm,kn,lmn->ijk", *[sign * Q] * 3, full(B))
        np.testing.assert_allclose(full(turned(B, flat(sign * Q))), expected, atol=1e-13)


def test_contractions_are_those_of_all_components():
    B, M = random_third(6), np.random.default_rng(7).normal(size=(3, 3))
    M = M + M.T
    np.testing.assert_allclose(contract(B, flat(M)), np.einsum("ijk,jk->i", full(B), M), atol=1e-13)
    assert square(B) == pytest.approx(np.sum(full(B) ** 2))
    np.testing.assert_allclose(np.einsum("iik->k", full(B)), 0.0, atol=1e-14)


# --- Drift --------------------------------------------------------------------------------------------------


def drift_of_soft_solid(G, E, Omega):
    """Return the steady drift of an elastic sphere with Faxén's part, over μ_f a²/μ_s."""
    S, _, v = parts(curvature_of(G))
    A, B = 2.5 * E, tuple(35.0 / 32.0 * c for c in S)
    q = shift(1.0, 1.0, 1.0, v)
    own = np.add(drift_of_solid(1.0, B, flat(E)), drift_by_shift(tuple(Omega), q, (0.0, 0.0, 0.0)))
    return np.einsum("ijk,jk->i", G, A) / 3.0 + own


def drift_of_soft_drop(G, E, ratio):
    """Return the steady drift of a drop by its shape, over μ_f a³/σ."""
    flow = parts(curvature_of(G))
    A = (16.0 + 19.0 * ratio) / (8.0 * (1.0 + ratio)) * E
    steady = source(ratio) / relaxation_of_drop(1.0, ratio, 1.0)
    B = tuple(steady * c for c in flow.S)
    sphere = drift_of_drop(1.0, ratio, (0.0,) * 9, (0.0,) * 7, flat(E), flow)
    return np.subtract(drift_of_drop(1.0, ratio, flat(A), B, flat(E), flow), sphere)


def channel(kind):
    """Return G and E of a flow along x with du/dy = d²u/dy² = 1 across it, and the angular velocity."""
    H, l = np.zeros((3, 3, 3)), np.zeros((3, 3))
    H[0, 1, 1] = l[0, 1] = 1.0
    if kind == "pipe":
        H[0, 2, 2] = 1.0
    return H, 0.5 * (l + l.T), np.array([0.0, 0.0, -0.5])


def test_drift_of_an_elastic_sphere_in_a_flow_without_symmetry():
    assert drift_of_soft_solid(G, E, OMEGA) == pytest.approx((6.625000, -1.701389, -6.270833), abs=5e-7)


@pytest.mark.parametrize(("kind", "drift"), [("plane", -5.0 / 36.0), ("pipe", -25.0 / 144.0)])
def test_an_elastic_sphere_drifts_inward(kind, drift):
    x, y, z = drift_of_soft_solid(*channel(kind))
    assert y == pytest.approx(drift, rel=1e-13)
    assert (x, z) == pytest.approx((0.0, 0.0), abs=1e-14)


@pytest.mark.parametrize(
    ("ratio", "drift"), [(1.0, (5.500000, -1.925000, -5.512500)), (0.2, (2.366441, -0.413701, -5.382879))]
)
def test_drift_of_a_drop_in_a_flow_without_symmetry(ratio, drift):
    assert drift_of_soft_drop(G, E, ratio) == pytest.approx(drift, abs=5e-7)


@pytest.mark.parametrize(
    ("ratio", "plane", "pipe"),
    [
        (0.0, -0.345238, -0.571429),
        (0.5, -0.013076, -0.057993),
        (1.0, 0.050000, 0.037500),
        (2.0, 0.062909, 0.061830),
        (10.0, 0.000762, 0.004246),
        (1e9, -0.052381, -0.039286),
    ],
)
def test_drops_drift_inward_or_outward_by_their_viscosity(ratio, plane, pipe):
    """Inward below about 0.5 and above 10, as is known from Chan & Leal (1979)."""
    assert drift_of_soft_drop(*channel("plane")[:2], ratio)[1] == pytest.approx(plane, abs=5e-7)
    assert drift_of_soft_drop(*channel("pipe")[:2], ratio)[1] == pytest.approx(pipe, abs=5e-7)


def test_a_very_viscous_drop_is_a_rigid_body():
    """⅓ a² G:A − ²⁄₇ a B:E, and a²/6 v of a sphere."""
    B, A, flow = random_third(8), 0.1 * E, parts(curvature_of(G))
    drift = drift_of_drop(1.0, 1e12, flat(A), B, flat(E), flow)
    by_A = np.array(flow.v) / 6.0 + np.einsum("ijk,jk->i", G, A) / 3.0
    np.testing.assert_allclose(drift, by_A + np.array(drift_of_solid(1.0, B, flat(E))), rtol=1e-10)


# --- Tube and outline ---------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("b", "velocity", "amplitude", "deformation"),
    [
        (0.2, 0.973389, 1.001181, 1.001164),
        (0.3, 0.940459, 1.008374, 1.008109),
        (0.4, 0.895406, 1.032477, 1.030756),
        (0.5, 0.839923, 1.091351, 1.084475),
        (0.6, 0.776513, 1.214544, 1.194644),
    ],
)
def test_factors_of_a_tube(b, velocity, amplitude, deformation):
    """The fits are within 6e-5 of the numbers of the boundary integrals."""
    assert tube_velocity(b) == pytest.approx(velocity, rel=6e-5)
    assert tube_amplitude(b) == pytest.approx(amplitude, rel=6e-5)
    assert tube_deformation(b) == pytest.approx(deformation, rel=6e-5)


def test_outline_is_that_of_the_mapped_surface():
    """Area, perimeter and centre from the support function of the surface x = X + B X X, by brute force."""
    B = tuple(0.005 * c for c in random_third(9))
    angles = 2.0 * np.pi * np.arange(64) / 64
    h = np.array([_support(full(B), np.array([np.cos(t), np.sin(t), 0.0])) for t in angles])
    modes = np.fft.rfft(h) / len(h)
    k = np.arange(len(modes))
    slope = np.fft.irfft(1j * k * modes * len(h), len(h))
    radius = h + np.fft.irfft(-k * k * modes * len(h), len(h))
    area = np.pi * np.mean(h * h - slope * slope)
    x = h * np.cos(angles) - slope * np.sin(angles)
    seen = outline_parts(B)
    assert area / np.pi - 1.0 == pytest.approx(seen.area, rel=5e-3)
    assert h.mean() - 1.0 == pytest.approx(seen.perimeter, rel=5e-3)
    assert 1.0 - np.sqrt(area / np.pi) / h.mean() == pytest.approx(seen.deformation, rel=5e-3)
    centre = np.pi * np.mean(x * x * radius * np.cos(angles)) / area
    assert centre == pytest.approx(seen.centre[0], rel=5e-3)


def _support(B, e):
    """Return the largest e·(X + B X X) of unit vectors X, from Newton's steps on the sphere."""
    X = e
    for _ in range(50):
        gradient = e + 2.0 * np.einsum("i,ijk,k->j", e, B, X)
        X = gradient / np.linalg.norm(gradient)
    return float(e @ (X + np.einsum("ijk,j,k->i", B, X, X)))


@pytest.mark.parametrize(
    ("d", "modulus", "deformation"),
    [(7.5e-6, 2500.0, 0.008875), (11e-6, 5000.0, 0.005469), (13e-6, 5000.0, 0.009097)],
)
def test_deformation_in_a_cytometer(d, modulus, deformation):
    """Channel of 20 µm, 0.04 µL/s, 15 mPa s; as a tube of 0.547 of its width, within 2 % of FEM."""
    a, R, mu_f, Q = 0.5 * d, 10.94e-6, 0.015, 0.04e-9
    U = 2.0 * Q / (np.pi * R * R)
    eps = 7.0 / 8.0 * mu_f * U * a / (modulus / 3.0 * R * R)
    seen = outline_parts(bullet(eps)).deformation * tube_deformation(a / R) ** 2
    assert seen == pytest.approx(deformation, abs=5e-7)


def test_time_of_a_cell_in_a_cytometer():
    assert 1.0 / relaxation_of_solid(0.015, 2500.0 / 3.0, 0.0, 0.0) == pytest.approx(21.4e-6, rel=2e-3)


# --- Contact ------------------------------------------------------------------------------------------------


def farthest(F, B, n):
    """Return the largest n·(F X + B YY) over the unit sphere, by a search that halves its grid 30 times."""
    U, _, V = np.linalg.svd(F)
    points, size = np.random.default_rng(0).standard_normal((4000, 3)), 0.1
    best = None
    for _ in range(30):
        X = points / np.linalg.norm(points, axis=1, keepdims=True)
        Y = X @ (U @ V).T
        heights = X @ F.T @ n + np.einsum("ijk,vj,vk,i->v", full(B), Y, Y, n)
        best, height = X[heights.argmax()], heights.max()
        points = best + size * np.random.default_rng(1).uniform(-1.0, 1.0, (400, 3))
        size *= 0.5
    return height


@pytest.mark.parametrize("eps", [0.05, 0.1, 0.2])
def test_the_surface_reaches_as_far_as_a_fine_search_says(eps, random):
    """The swelling is that of the support function to second order: the error is one of the third."""
    worst = 0.0
    for seed in range(20):
        F = rotation_of_frame(random) @ np.diag([1.3, 0.95, 0.81]) @ rotation_of_frame(random)
        B = random_third(seed)
        B = tuple(eps / bullet_amplitude(B) * b for b in B)
        n = random.standard_normal(3)
        n /= np.linalg.norm(n)
        flat_F, inverse_F = tuple(F.ravel()), tuple(np.linalg.inv(F).ravel())
        p = F.T @ n
        length = np.linalg.norm(p)
        mode = (B, turn_of(flat_F))
        swollen = swelling(mode, inverse_F, tuple(p / length))
        assert abs(swollen) <= largest_swelling(mode, inverse_F)
        worst = max(worst, abs(length * (1.0 + swollen) - farthest(F, B, n)))
    assert worst < 4.0 * eps**3


def rotation_of_frame(random):
    Q = np.linalg.qr(random.standard_normal((3, 3)))[0]
    return Q * np.sign(np.linalg.det(Q))
