"""Flow along x over a plane wall, or between two: the functions that a particle loop calls."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import reach
from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector
from foamprb.flow.base import Planes


class SlitArrays(NamedTuple):
    """Flow along x over the wall z = 0, below another at z = height."""

    height: float
    """m; infinite for shear over one wall."""
    shear_rate: float
    """At the lower wall, 1/s."""


_LOWER, _UPPER, _NOWHERE = 0, 1, -1
_UP, _DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)


def sample_slit(flow: SlitArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """u = γ̇ z (1 − z/H), m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    s = x[2] / flow.height
    u = (flow.shear_rate * x[2] * (1.0 - s), 0.0, 0.0)
    l = (0.0, 0.0, flow.shear_rate * (1.0 - 2.0 * s), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return u, l, (0.0, 0.0, 0.0)


def curvature_slit(flow: SlitArrays, host: int, x: Vector, t: float) -> Curvature:
    """Second derivatives, 1/(m s)."""
    nothing = (0.0, 0.0, 0.0)
    zz = (-2.0 * flow.shear_rate / flow.height, 0.0, 0.0)
    return nothing, nothing, zz, nothing, nothing, nothing


def walk_slit(flow: SlitArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Where the segment from x0 to x1 meets a wall."""
    if x1[2] < 0.0:
        return host, max(x0[2] / (x0[2] - x1[2]), 0.0), _LOWER, _LOWER
    if x1[2] > flow.height:
        return host, max((flow.height - x0[2]) / (x1[2] - x0[2]), 0.0), _UPPER, _UPPER
    return host, 1.0, _NOWHERE, _NOWHERE


def gap_slit(flow: SlitArrays, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """Clearance between the ellipsoid and the nearer wall, m."""
    upper = flow.height - x[2] < x[2]
    patch = _UPPER if upper else _LOWER
    return min(x[2], flow.height - x[2]) - reach(R, F, _UP), patch, patch


def normal_slit(flow: SlitArrays, triangle: int, x: Vector) -> Vector:
    """Unit normal of a wall into the fluid."""
    return _DOWN if triangle == _UPPER else _UP


def planes_of_slit(flow: SlitArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Both walls, as far as they are chosen and nearer than ``cut`` (m)."""
    low, high = x[2], flow.height - x[2]
    return Planes(
        low if low < cut and chosen[_LOWER] > 0 else math.inf, _UP,
        high if high < cut and chosen[_UPPER] > 0 else math.inf, _DOWN,
        math.inf, (0.0, 0.0, 0.0),
    )  # fmt: skip
