"""Direction of a swimmer, which is fixed in its body.

p = F·q/|F·q| with the deformation gradient F and a constant q: p turns with the solid. For a rigid ellipsoid
of revolution about p this is Jeffery's equation, dp/dt = W p + Λ (E p − (p·E p) p), with Λ = 0 for a sphere.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.body.philox import Word, normals, philox
from foamprb.body.tensor import Scalar, Tensor, Vector, dot_vector, inner, scale_vector

_LOW, _HALF = np.uint64(0xFFFFFFFF), np.uint64(32)
_TINY = 1e-300
_ROUND = 1e-6
"""Relative difference of semi-axes up to which a body at rest is a sphere."""

Floats = NDArray[np.float64]


def direction(F: Tensor, q: Vector) -> Vector:
    """Return the unit vector along F·q; 0 for q = 0."""
    p = dot_vector(F, q)
    return scale_vector(1.0 / np.sqrt(inner(p, p) + _TINY), p)


def random_spin(diffusivity: Scalar, duration: Scalar, xi: Vector) -> Vector:
    """Return an angular velocity, 1/s, for a duration, s: its angle has the variance 2 D_R t about each axis.

    ``diffusivity`` is D_R, 1/s; ``xi`` are normal deviates.
    """
    return scale_vector(np.sqrt(2.0 * diffusivity / duration), xi)


def random_directions(numbers: NDArray[np.uint64], key: tuple[Word, Word]) -> Floats:
    """Return random unit vectors of particles with these numbers, (n, 3)."""
    none = np.zeros_like(numbers)
    words = philox((numbers & _LOW, numbers >> _HALF, none, none), key)
    directions = np.stack(normals(words)[:3], axis=1)
    return np.asarray(directions / np.linalg.norm(directions, axis=1, keepdims=True))


def along_axes(F: Floats, p: Floats) -> Floats:
    """Return the directions of bodies nearest to p, (n, 3): along the axis of a body that is not a sphere.

    It is the axis whose length differs most from the others: that of revolution of a spheroid. ``F`` is the
    deformation gradient from the sphere, (n, 9).
    """
    axes, stretches, _ = np.linalg.svd(F.reshape(-1, 3, 3))
    logs = np.log(stretches)
    longest = logs[:, 0] - logs[:, 1] >= logs[:, 1] - logs[:, 2]
    axis = np.where(longest[:, None], axes[:, :, 0], axes[:, :, 2])
    axis = axis * np.where(np.einsum("ni,ni->n", axis, p) < 0.0, -1.0, 1.0)[:, None]
    return np.where((logs[:, 0] - logs[:, 2] < _ROUND)[:, None], p, axis)
