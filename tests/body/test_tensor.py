from __future__ import annotations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.linalg import expm
from strategies import flat, mild_stretches, rotations, square, stretches, tensors

from foamprb.body import tensor as t
from foamprb.body.ellipsoid import sorted_frame


@given(tensors, tensors)
def test_algebra_is_that_of_matrices(S, T):
    A, B = square(S), square(T)
    np.testing.assert_allclose(square(t.dot(S, T)), A @ B, atol=1e-13)
    np.testing.assert_allclose(square(t.cofactor(S)).T @ A, np.linalg.det(A) * np.eye(3), atol=1e-12)
    np.testing.assert_allclose(t.det(S), np.linalg.det(A), atol=1e-12)
    np.testing.assert_allclose(t.ddot(S, T), (A * B).sum(), atol=1e-12)
    np.testing.assert_allclose(square(t.sym(S)) + square(t.skew(S)), A, atol=1e-15)
    np.testing.assert_allclose(t.trace(t.dev(S)), 0.0, atol=1e-14)
    np.testing.assert_allclose(t.vector_dot(S[:3], T), A[0] @ B, atol=1e-13)


def test_products_of_vectors(random):
    v, w = random.normal(size=(2, 3))
    assert t.inner(v, w) == pytest.approx(v @ w)
    assert t.norm(v) == pytest.approx(np.linalg.norm(v))
    np.testing.assert_allclose(t.vector_product(v, w), np.cross(v, w))
    np.testing.assert_allclose(t.between(v, w, 0.3), 0.7 * v + 0.3 * w)


@given(tensors)
def test_axial_vector_turns_like_its_tensor(T):
    W = t.skew(T)
    r = (0.3, -1.2, 0.7)
    np.testing.assert_allclose(t.dot_vector(W, r), np.cross(t.axial(W), r), atol=1e-14)


@given(rotations, tensors)
def test_a_frame_and_back_is_the_identity(Q, T):
    there = t.to_frame(flat(Q), T)
    np.testing.assert_allclose(square(there), Q @ square(T) @ Q.T, atol=1e-13)
    np.testing.assert_allclose(t.from_frame(flat(Q), there), T, atol=1e-13)


@given(rotations, stretches, rotations)
def test_principal_frame_diagonalises_over_axis_ratios_of_a_thousand(Q1, stretch, Q2):
    F = Q1 @ np.diag(stretch) @ Q2
    Q, found = t.principal_frame(flat(F))
    np.testing.assert_allclose(np.sort(found), np.sort(stretch), rtol=1e-11)
    Q = square(Q)
    np.testing.assert_allclose(Q @ Q.T, np.eye(3), atol=1e-14)
    assert np.linalg.det(Q) > 0
    rows = (Q @ F) / np.asarray(found)[:, None]
    np.testing.assert_allclose(rows @ rows.T, np.eye(3), atol=1e-11)


@given(rotations, st.floats(0.1, 10.0), st.floats(-1e-9, 1e-9))
def test_principal_frame_of_nearly_a_sphere_is_still_a_frame(Q1, size, difference):
    F = size * Q1 @ np.diag([1.0, 1.0 + difference, 1.0 - difference])
    Q, found = t.principal_frame(flat(F))
    np.testing.assert_allclose(found, size, rtol=1e-8)
    np.testing.assert_allclose(square(Q) @ square(Q).T, np.eye(3), atol=1e-14)


@pytest.mark.parametrize(("angle", "times"), [(0.003, 1), (0.1, 2)])
@given(rotations, mild_stretches, rotations, tensors)
def test_refined_frame_is_principal_where_it_has_turned_a_little(angle, times, Q1, stretch, Q2, turn):
    """By up to 0.1, about the angle of the longest step that the flow allows."""
    F = Q1 @ np.diag(stretch) @ Q2
    size = np.linalg.norm(t.axial(t.skew(turn))) + 1e-300
    Q = flat(expm(angle / max(size, 1.0) * square(t.skew(turn))) @ Q1.T)
    for _ in range(times):
        Q = t.refined_frame(flat(F), Q)
    found, skewness = t.stretches_in_frame(flat(F), Q)
    assert skewness <= 1e-24
    np.testing.assert_allclose(np.sort(found), np.sort(stretch), rtol=1e-13)
    np.testing.assert_allclose(square(Q) @ square(Q).T, np.eye(3), atol=1e-15)
    assert np.linalg.det(square(Q)) > 0


@given(rotations, stretches, rotations)
def test_repeated_refinement_ends_in_the_principal_frame_from_anywhere(Q1, stretch, Q2):
    F = flat(Q1 @ np.diag(stretch) @ Q2)
    Q = flat(np.eye(3))
    for _ in range(6):
        Q = t.refined_frame(F, Q)
    found, _ = t.stretches_in_frame(F, Q)
    np.testing.assert_allclose(np.sort(found), np.sort(stretch), rtol=1e-9)
    np.testing.assert_allclose(square(Q) @ square(Q).T, np.eye(3), atol=1e-15)


def test_frame_that_is_carried_along_stays_one():
    """After 20 000 steps of a body that turns, the frame is as orthonormal as after one."""
    Q, F = flat(np.eye(3)), np.diag([1.3, 1.0, 0.7])
    turn = expm(np.array([[0.0, 0.02, 0.01], [-0.02, 0.0, 0.03], [-0.01, -0.03, 0.0]]))
    for _ in range(20_000):
        F = turn @ F
        Q = t.refined_frame(flat(F), Q)
    np.testing.assert_allclose(square(Q) @ square(Q).T, np.eye(3), atol=1e-15)


@given(rotations, stretches, rotations)
def test_sorted_frame_is_the_same_frame_with_falling_axes(Q1, stretch, Q2):
    F = Q1 @ np.diag(stretch) @ Q2
    Q, found = sorted_frame(*t.principal_frame(flat(F)))
    assert found[0] >= found[1] >= found[2]
    Q = square(Q)
    assert np.linalg.det(Q) > 0
    np.testing.assert_allclose(np.linalg.norm(Q @ F, axis=1), found, rtol=1e-11)


@given(st.floats(0.125, 8.0))
def test_log_ratio_is_the_logarithm(J):
    np.testing.assert_allclose(t.log_ratio(J), np.log(J), atol=1e-15, rtol=1e-15)


def test_arrays_and_floats_give_the_same(random):
    F = random.normal(size=(50, 3, 3))
    Q, stretch = t.principal_frame(tuple(F.reshape(50, 9).T))
    for k in range(50):
        Qk, stretch_k = t.principal_frame(flat(F[k]))
        np.testing.assert_array_equal([c[k] for c in Q], Qk)
        np.testing.assert_array_equal([c[k] for c in stretch], stretch_k)
