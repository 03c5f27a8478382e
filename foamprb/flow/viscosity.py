"""Scalar fields, as that of the viscosity, linear in each tetrahedron."""

from __future__ import annotations

import math

from foamprb.body.tensor import Vector
from foamprb.flow.base import Floats
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.walk import Corners, Weights, blend, corners, shape


def viscosity(flow: MeshArrays, host: int, x: Vector, t: float) -> tuple[float, Vector]:  # noqa: ARG001
    """Return the viscosity at x and its gradient; NaN if it was not read."""
    if flow.viscosity.shape[0] == 0:
        return math.nan, (0.0, 0.0, 0.0)
    return blend_scalar(flow.viscosity, 0, corners(flow, host, 0), shape(flow, host, x))


def blend_scalar(f: Floats, k: int, nodes: Corners, w: Weights) -> tuple[float, Vector]:
    """Return a scalar and its gradient from a table with a row for each node, from column k on."""
    slope = blend(f, k + 1, nodes, w), blend(f, k + 2, nodes, w), blend(f, k + 3, nodes, w)
    return blend(f, k, nodes, w), slope
