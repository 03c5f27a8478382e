"""Kernels of flows in closed form along x: in a circular pipe and over plane walls."""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import swelling
from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector, inverse, norm, scale_vector, vector_dot
from foamprb.flow.base import NO_PLANES, Planes


class PipeArrays(NamedTuple):
    """Poiseuille flow along x in a circular pipe."""

    radius: float
    mean_velocity: float
    length: float


_WALL, _INLET, _OUTLET, _NOWHERE = 0, 1, 2, -1
_ZERO = (0.0, 0.0, 0.0)


def sample_pipe(flow: PipeArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return u = 2 U (1 − r²/a²), m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    k = 2.0 * flow.mean_velocity / (flow.radius * flow.radius)
    r2 = x[1] * x[1] + x[2] * x[2]
    u = (2.0 * flow.mean_velocity - k * r2, 0.0, 0.0)
    l = (0.0, -2.0 * k * x[1], -2.0 * k * x[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return u, l, _ZERO


def curvature_pipe(flow: PipeArrays, host: int, x: Vector, t: float) -> Curvature:
    """Return the second derivatives, 1/(m s)."""
    across = (-4.0 * flow.mean_velocity / (flow.radius * flow.radius), 0.0, 0.0)
    return _ZERO, across, across, _ZERO, _ZERO, _ZERO


def walk_pipe(flow: PipeArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Return where the segment from x0 to x1 first leaves the pipe."""
    fraction, patch = 1.0, _NOWHERE
    dx, dy, dz = x1[0] - x0[0], x1[1] - x0[1], x1[2] - x0[2]
    if x1[0] < 0.0:
        fraction, patch = max(-x0[0] / dx, 0.0), _INLET
    elif x1[0] > flow.length:
        fraction, patch = max((flow.length - x0[0]) / dx, 0.0), _OUTLET
    if x1[1] * x1[1] + x1[2] * x1[2] > flow.radius * flow.radius:
        a = dy * dy + dz * dz
        b = x0[1] * dy + x0[2] * dz
        c = min(x0[1] * x0[1] + x0[2] * x0[2] - flow.radius * flow.radius, 0.0)
        # The root of a f² + 2 b f + c that lies ahead, without cancellation.
        root = math.sqrt(b * b - a * c)
        hit = -c / (b + root) if b > 0.0 else (root - b) / a
        if hit <= fraction:
            fraction, patch = hit, _WALL
    return host, fraction, patch, patch


def gap_pipe(
    flow: PipeArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the clearance between the body and the wall's tangent plane, m."""
    n = normal_pipe(flow, _WALL, x)
    r = math.sqrt(x[1] * x[1] + x[2] * x[2])
    return flow.radius - r - extent(R, F, mode, n), _WALL, _WALL


def normal_pipe(flow: PipeArrays, triangle: int, x: Vector) -> Vector:
    """Return the unit normal into the fluid, of the wall or of an end."""
    if triangle == _INLET:
        return 1.0, 0.0, 0.0
    if triangle == _OUTLET:
        return -1.0, 0.0, 0.0
    r = math.sqrt(x[1] * x[1] + x[2] * x[2]) + 1e-300
    return 0.0, -x[1] / r, -x[2] / r


def planes_of_pipe(flow: PipeArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Return the wall of a pipe at its nearest point and at the opposite one."""
    if chosen[0] == 0:
        return NO_PLANES
    n = normal_pipe(flow, 0, x)
    r = math.sqrt(x[1] * x[1] + x[2] * x[2])
    near, far = flow.radius - r, flow.radius + r
    return Planes(
        near if near < cut else math.inf, n,
        far if far < cut else math.inf, (-n[0], -n[1], -n[2]),
        math.inf, _ZERO,
    )  # fmt: skip


class SlitArrays(NamedTuple):
    """Flow along x over the wall z = 0, below another at z = height."""

    height: float
    """m; infinite for shear over one wall."""
    shear_rate: float
    """Shear rate at the lower wall, 1/s."""


_LOWER, _UPPER = 0, 1
_UP, _DOWN = (0.0, 0.0, 1.0), (0.0, 0.0, -1.0)


def sample_slit(flow: SlitArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return u = γ̇ z (1 − z/H), m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    s = x[2] / flow.height
    u = (flow.shear_rate * x[2] * (1.0 - s), 0.0, 0.0)
    l = (0.0, 0.0, flow.shear_rate * (1.0 - 2.0 * s), 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return u, l, _ZERO


def curvature_slit(flow: SlitArrays, host: int, x: Vector, t: float) -> Curvature:
    """Return the second derivatives, 1/(m s)."""
    zz = (-2.0 * flow.shear_rate / flow.height, 0.0, 0.0)
    return _ZERO, _ZERO, zz, _ZERO, _ZERO, _ZERO


def walk_slit(flow: SlitArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Return where the segment from x0 to x1 meets a wall."""
    if x1[2] < 0.0:
        return host, max(x0[2] / (x0[2] - x1[2]), 0.0), _LOWER, _LOWER
    if x1[2] > flow.height:
        return host, max((flow.height - x0[2]) / (x1[2] - x0[2]), 0.0), _UPPER, _UPPER
    return host, 1.0, _NOWHERE, _NOWHERE


def gap_slit(
    flow: SlitArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the clearance between the body and the nearer wall, m."""
    low, high = x[2] - extent(R, F, mode, _UP), flow.height - x[2] - extent(R, F, mode, _DOWN)
    patch = _UPPER if high < low else _LOWER
    return min(low, high), patch, patch


def extent(R: float, F: Tensor, mode: Any, n: Vector) -> float:
    """Return how far a body reaches against the unit vector n, m."""
    p = vector_dot(n, F)
    length = norm(p)
    # On the axis of a pipe n is 0.
    outward = scale_vector(-1.0 / (length + 1e-300), p)
    return float(R * length * (1.0 + swelling(mode, inverse(F), outward)))


def normal_slit(flow: SlitArrays, triangle: int, x: Vector) -> Vector:
    """Return the unit normal of a wall into the fluid."""
    return _DOWN if triangle == _UPPER else _UP


def planes_of_slit(flow: SlitArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Return the walls that are chosen and nearer than ``cut`` (m)."""
    low, high = x[2], flow.height - x[2]
    return Planes(
        low if low < cut and chosen[_LOWER] > 0 else math.inf, _UP,
        high if high < cut and chosen[_UPPER] > 0 else math.inf, _DOWN,
        math.inf, _ZERO,
    )  # fmt: skip


class DuctArrays(NamedTuple):
    """Poiseuille flow along x in a rectangular duct, 0 ≤ z ≤ height and |y| ≤ width/2."""

    width: float
    height: float
    force: float
    """Pressure gradient over the viscosity, −∂p/∂x/μ, 1/(m s)."""


_LEFT, _RIGHT = 2, 3
_TERMS = 100
_ASIDE = (0.0, 1.0, 0.0)


def _of_duct(flow: DuctArrays, x: Vector) -> tuple[float, tuple[float, float], tuple[float, float, float]]:
    """Return u, m/s, its derivatives along p and q, 1/s, and those along pp, qq and pq, 1/(m s).

    p is the place along the shorter side, from a wall, and q that along the longer one, from the middle. With
    the force k and the sides s and b, u = k (p (s − p)/2 − (4 s²/π³) Σ cosh(nπq/s)/cosh(nπb/2s)
    sin(nπp/s)/n³), n odd (White, Viscous Fluid Flow, 3-48).
    """
    if flow.width < flow.height:
        s, b, p, q = flow.width, flow.height, x[1] + 0.5 * flow.width, x[2] - 0.5 * flow.height
    else:
        s, b, p, q = flow.height, flow.width, x[2], x[1]
    a = math.pi / s
    # Sines, cosines and exponentials of the next odd number follow from the last ones.
    sine, cosine = np.sin(a * p), np.cos(a * p)
    double_sine, double_cosine = 2.0 * sine * cosine, 1.0 - 2.0 * sine * sine
    near, far = np.exp(-a * np.maximum(0.5 * b - q, 0.0)), np.exp(-a * np.maximum(0.5 * b + q, 0.0))
    ends = math.exp(-a * b)
    near_2, far_2, ends_2 = near * near, far * far, ends * ends
    u = u_p = u_q = u_pp = u_pq = 0.0 * sine
    for k in range(_TERMS):
        n = 2.0 * k + 1.0
        even, odd = (near + far) / (1.0 + ends), (near - far) / (1.0 + ends)
        u = u + even * sine / (n * n * n)
        u_p = u_p + even * cosine / (n * n)
        u_q = u_q + odd * sine / (n * n)
        u_pp = u_pp + even * sine / n
        u_pq = u_pq + odd * cosine / n
        sine, cosine = (
            sine * double_cosine + cosine * double_sine,
            cosine * double_cosine - sine * double_sine,
        )
        near, far, ends = near * near_2, far * far_2, ends * ends_2
    f, c = flow.force, 4.0 / math.pi
    return (
        f * (0.5 * p * (s - p) - c / (a * a) * u),
        (f * (0.5 * s - p - c / a * u_p), -f * c / a * u_q),
        (f * (c * u_pp - 1.0), -f * c * u_pp, -f * c * u_pq),
    )


def sample_duct(flow: DuctArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    u, (u_p, u_q), _ = _of_duct(flow, x)
    u_y, u_z = (u_p, u_q) if flow.width < flow.height else (u_q, u_p)
    return (u, 0.0, 0.0), (0.0, u_y, u_z, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), _ZERO


def curvature_duct(flow: DuctArrays, host: int, x: Vector, t: float) -> Curvature:
    """Return the second derivatives, 1/(m s)."""
    _, _, (u_pp, u_qq, u_pq) = _of_duct(flow, x)
    u_yy, u_zz = (u_pp, u_qq) if flow.width < flow.height else (u_qq, u_pp)
    return _ZERO, (u_yy, 0.0, 0.0), (u_zz, 0.0, 0.0), _ZERO, (u_pq, 0.0, 0.0), _ZERO


def duct_mean(width: float, height: float) -> float:
    """Return the mean velocity in a duct whose pressure gradient over the viscosity is 1, m²."""
    s, b = min(width, height), max(width, height)
    n = np.arange(1.0, 400.0, 2.0)
    corners = np.sum(np.tanh(0.5 * math.pi * n * b / s) / n**5)
    return float(s * s / 12.0 * (1.0 - 192.0 / math.pi**5 * s / b * corners))


def distances_in_duct(flow: DuctArrays, x: Vector) -> tuple[float, float, float, float]:
    """Return the distances to the walls in the order of the patches, m."""
    return x[2], flow.height - x[2], 0.5 * flow.width + x[1], 0.5 * flow.width - x[1]


def walk_duct(flow: DuctArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Return where the segment from x0 to x1 first meets a wall."""
    fraction, patch = 1.0, _NOWHERE
    before, after = distances_in_duct(flow, x0), distances_in_duct(flow, x1)
    for k in range(4):
        if after[k] < 0.0:
            hit = max(before[k] / (before[k] - after[k]), 0.0)
            if hit <= fraction:
                fraction, patch = hit, k
    return host, fraction, patch, patch


def gap_duct(
    flow: DuctArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the clearance between the body and the wall that it is nearest to, m."""
    gap, patch, distances = math.inf, _LOWER, distances_in_duct(flow, x)
    for k in range(4):
        clearance = distances[k] - extent(R, F, mode, normal_duct(flow, k, x))
        if clearance < gap:
            gap, patch = clearance, k
    return gap, patch, patch


def normal_duct(flow: DuctArrays, triangle: int, x: Vector) -> Vector:
    """Return the unit normal of a wall into the fluid."""
    if triangle >= _LEFT:
        return (0.0, -1.0, 0.0) if triangle == _RIGHT else _ASIDE
    return _DOWN if triangle == _UPPER else _UP


def planes_of_duct(flow: DuctArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Return the walls that are chosen and nearer than ``cut`` (m): of the sides, the nearer one."""
    low, high, left, right = distances_in_duct(flow, x)
    side = _RIGHT if right < left else _LEFT
    beside = min(left, right)
    return Planes(
        low if low < cut and chosen[_LOWER] > 0 else math.inf, _UP,
        high if high < cut and chosen[_UPPER] > 0 else math.inf, _DOWN,
        beside if beside < cut and chosen[side] > 0 else math.inf, normal_duct(flow, side, x),
    )  # fmt: skip
