"""Surfaces of bodies with a quadratic mode."""

from __future__ import annotations

import numpy as np
from view_run import modes

from foamprb.body.quadratic import layers
from foamprb.view.surfaces import bulges, unfolded


def rotation(random):
    Q = np.linalg.qr(random.standard_normal((5, 3, 3)))[0]
    Q[:, 0] *= np.sign(np.linalg.det(Q))[:, None]
    return Q


def surface(X, F, K):
    return X @ F.swapaxes(1, 2) + np.einsum("nijk,vj,vk->nvi", K, X, X)


def test_the_rotation_of_the_material_moves_points_along_the_same_surface(random):
    """x = V Y + B YY with the axes of B in space: bodies V Q have a point X where V has Q X."""
    V = np.diag([1.2, 0.95, 0.9])[None].repeat(5, axis=0)
    B, Q = modes(5, 1, 0.1)[0], rotation(random)
    X = random.standard_normal((7, 3))
    X /= np.linalg.norm(X, axis=1, keepdims=True)
    turned = surface(X, V @ Q, bulges(V @ Q, B))
    for k in range(5):
        Y = X @ Q[k].T
        whole = np.array(layers(tuple(B[k]))).reshape(3, 3, 3)
        expected = Y @ V[k] + np.einsum("ijk,vj,vk->vi", whole, Y, Y)
        np.testing.assert_allclose(turned[k], expected, atol=1e-14)


def test_a_mode_is_reduced_only_where_the_surface_would_fold(random):
    """The map of the ball is one to one while its derivative F + 2 B·Y has a positive determinant."""
    F = np.diag([1.5, 1.0, 2.0 / 3.0])[None].repeat(40, axis=0)
    small, large = modes(40, 1, 0.2)[0], modes(40, 1, 2.0)[0]
    np.testing.assert_allclose(unfolded(F, small), small, rtol=1e-12)
    X = random.standard_normal((500, 3))
    X /= np.linalg.norm(X, axis=1, keepdims=True)
    for B, folds in ((large, True), (unfolded(F, large), False)):
        slopes = F[:, None] + 2.0 * np.einsum("nijk,vk->nvij", bulges(F, B), X)
        assert (np.linalg.det(slopes).min() < 0.0) == folds
    assert unfolded(F[:1], np.full((1, 7), np.nan)).tolist() == [[0.0] * 7]
