"""Kernels of axisymmetric flows on a wedge one cell thick (:mod:`foamprb.flow.mesh.layer`).

All velocities and gradients at nodes are those of the middle plane, where columns of nodes have one value.
Cells are prisms between the planes: the same at all places with the same distance ρ from the axis along the
middle plane. At x = o + ρ (e + t n), with t = tan θ, the velocity is u + t a × u, with the unit vectors a
along the axis, e and n: that of the middle plane turned by θ, and larger by the same factor as the distance
from the axis. So paths keep θ, walls stay closed, and the divergence is u_ρ/ρ + ∂u_ρ/∂ρ + ∂u_a/∂a.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import (
    Tensor,
    Vector,
    dot,
    dot_vector,
    inner,
    minus,
    plus_scaled,
    scale,
    scale_vector,
    subtract,
    to_frame,
    turn_about,
    vector_product,
)
from foamprb.flow.base import Floats

_AXIS, _AWAY, _PLACE, _HALF = 1, 2, 3, 12
"""Rows of three numbers, and the last one, of :attr:`foamprb.flow.mesh.arrays.MeshArrays.layer`."""


def is_wedge(layer: Floats) -> bool:
    """Return True for a wedge, False for a layer between parallel planes and all other meshes."""
    return bool(layer.shape[0] > 3)


def _row(layer: Floats, k: int) -> Vector:
    return layer[3 * k], layer[3 * k + 1], layer[3 * k + 2]


def across(layer: Floats, v: Vector) -> Vector:
    """Return the part of a vector along the middle plane, or along the planes of a layer."""
    n = _row(layer, 0)
    return minus(v, scale_vector(inner(n, v), n))


def distance(layer: Floats, x: Vector) -> Any:
    """Return ρ at x, m."""
    return inner(_row(layer, _AWAY), minus(x, _row(layer, _PLACE)))


def tangent(layer: Floats, x: Vector) -> Any:
    """Return t = tan θ at x, within the wedge; like the other functions also for arrays of points."""
    rho, y = distance(layer, x), inner(_row(layer, 0), minus(x, _row(layer, _PLACE)))
    return np.minimum(np.maximum(y / np.maximum(rho, 1e-300), -layer[_HALF]), layer[_HALF])


def stretched(layer: Floats, t: float, u: Vector) -> Vector:
    """Return u + t a × u."""
    return plus_scaled(u, t, vector_product(_row(layer, _AXIS), u))


def _turn(layer: Floats, t: float) -> Tensor:
    """Return the rotation by θ about the axis."""
    c = (1.0 + t * t) ** -0.5
    return turn_about(_row(layer, _AXIS), c * t, 1.0 - c, c)


def turned(layer: Floats, t: float, l: Tensor) -> Tensor:
    """Return a gradient of the middle plane turned by θ."""
    return to_frame(_turn(layer, t), l)


def change_around(layer: Floats, rho: float, l: Tensor) -> tuple[Vector, Tensor]:
    """Return n and the derivative of a gradient along it, (a × l − l × a)/ρ, at the middle plane."""
    x, y, z = _row(layer, _AXIS)
    turn = (0.0, -z, y, z, 0.0, -x, -y, x, 0.0)
    return _row(layer, 0), scale(1.0 / rho, subtract(dot(turn, l), dot(l, turn)))


def turned_curvature(layer: Floats, x: Vector, h: Curvature) -> Curvature:
    """Return second derivatives of the middle plane turned to x."""
    turn = _turn(layer, tangent(layer, x))
    xx, yy, zz = (dot_vector(turn, h[0]), dot_vector(turn, h[1]), dot_vector(turn, h[2]))
    xy, yz, xz = (dot_vector(turn, h[3]), dot_vector(turn, h[4]), dot_vector(turn, h[5]))
    a, b, c = (
        to_frame(turn, (xx[0], xy[0], xz[0], xy[0], yy[0], yz[0], xz[0], yz[0], zz[0])),
        to_frame(turn, (xx[1], xy[1], xz[1], xy[1], yy[1], yz[1], xz[1], yz[1], zz[1])),
        to_frame(turn, (xx[2], xy[2], xz[2], xy[2], yy[2], yz[2], xz[2], yz[2], zz[2])),
    )
    return (
        (a[0], b[0], c[0]), (a[4], b[4], c[4]), (a[8], b[8], c[8]),
        (a[1], b[1], c[1]), (a[5], b[5], c[5]), (a[2], b[2], c[2]),
    )  # fmt: skip
