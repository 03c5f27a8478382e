"""Velocities at many points, by the kernel ``sample`` of a flow."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np

from foamprb.flow.base import Floats, Ints, PatchFaces, Sampled
from foamprb.flow.kernels import linked_with, sample, viscosity


def sample_with(
    kernel: Callable[..., Any], arrays: Any, points: Floats, hosts: Ints, t: float | Floats
) -> tuple[Floats, Floats]:
    """Return velocities and gradients as :meth:`Flow.sample`, by a kernel ``sample`` and its arrays.

    The times t, s, are one for all or (n,).
    """
    points = np.ascontiguousarray(points, dtype=np.float64)
    velocities, gradients = np.empty((len(points), 3)), np.empty((len(points), 9))
    hosts = np.ascontiguousarray(hosts, dtype=np.int32)
    sample_all, flow = linked_with({"sample": kernel}, arrays, _sample_all)
    sample_all(flow, points, hosts, _times(t, len(points)), velocities, gradients)
    return velocities, gradients.reshape(-1, 3, 3)


def viscosity_with(
    kernel: Callable[..., Any], arrays: Any, points: Floats, hosts: Ints, t: float | Floats
) -> Floats:
    """Return the field of the viscosity at points (n, 3) in hosts (n,), by a kernel and its arrays, (n,).

    NaN in host −1.
    """
    points, found = np.ascontiguousarray(points, dtype=np.float64), np.empty(len(points))
    hosts = np.ascontiguousarray(hosts, dtype=np.int32)
    viscosity_all, flow = linked_with({"viscosity": kernel}, arrays, _viscosity_all)
    viscosity_all(flow, points, hosts, _times(t, len(points)), found)
    return found


def _times(t: float | Floats, n: int) -> Floats:
    return np.ascontiguousarray(np.broadcast_to(np.asarray(t, dtype=np.float64), n))


def _viscosity_all(flow: Any, points: Floats, hosts: Ints, t: Floats, found: Floats) -> None:
    for i in range(points.shape[0]):
        found[i] = np.nan
        if hosts[i] >= 0:
            found[i], _ = viscosity(flow, hosts[i], (points[i, 0], points[i, 1], points[i, 2]), t[i])


def with_velocity(faces: PatchFaces, flow: Sampled, t: float) -> PatchFaces:
    """Return triangles of a patch with the velocity at their corners at time t, s."""
    velocity, _ = flow.sample(faces.vertices.reshape(-1, 3), np.repeat(faces.hosts, 3), t)
    return faces._replace(velocity=velocity.reshape(-1, 3, 3))


def _sample_all(
    flow: Any, points: Floats, hosts: Ints, t: Floats, velocities: Floats, gradients: Floats
) -> None:
    """Put u (n, 3) and ∇u (n, 9) at the points (n, 3) in their hosts (n,) at times t (n,) into arrays."""
    for i in range(points.shape[0]):
        u, l, _ = sample(flow, hosts[i], (points[i, 0], points[i, 1], points[i, 2]), t[i])
        for k in range(3):
            velocities[i, k] = u[k]
        for k in range(9):
            gradients[i, k] = l[k]
