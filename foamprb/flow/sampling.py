"""Velocities at many points, by the compiled function ``sample`` of a flow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from foamprb.body.tensor import Tensor, Vector
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints


def sample(flow: Any, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Stand for the function of a flow, which :func:`sample_with` puts in its place."""
    raise NotImplementedError


def sample_with(
    kernel: Callable[..., Any], arrays: Any, points: Floats, hosts: Ints, t: float
) -> tuple[Floats, Floats]:
    """Velocities and gradients as :meth:`Flow.sample`, by a flow's kernel ``sample`` and what it reads."""
    points = np.ascontiguousarray(points, dtype=np.float64)
    values = np.empty((len(points), 12))
    sampler = link(_sample_all, {"sample": kernel})
    sampler(arrays, points, np.ascontiguousarray(hosts, dtype=np.int32), t, values)
    return values[:, :3].copy(), values[:, 3:].reshape(-1, 3, 3).copy()


def _sample_all(flow: Any, points: Floats, hosts: Ints, t: float, values: Floats) -> None:
    """Put u and ∇u at the points (n, 3) in their hosts (n,) at time t into the rows of ``values`` (n, 12)."""
    for i in range(points.shape[0]):
        u, l, _ = sample(flow, hosts[i], (points[i, 0], points[i, 1], points[i, 2]), t)
        for k in range(3):
            values[i, k] = u[k]
        for k in range(9):
            values[i, 3 + k] = l[k]
