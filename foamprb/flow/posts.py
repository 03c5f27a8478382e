"""Stokes flow through a periodic array of round posts, as a series around each post.

With z = x + iy from the middle of a post, over the spacing, and w = u + iv (Muskhelishvili, Langlois),

    w = φ(z) − z φ'(z)* + g(z)*,    φ = A ln z + Σ a_n zⁿ,    g = A* ln z + Σ b_n zⁿ,    n even,

has no divergence and solves Stokes' equations, with the vorticity 4 Im φ' and a pressure proportional to
Re φ'. No slip on the post gives the b_n. The a_n are the least-squares solution for the periodicity on the
edges of a square around the post.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector
from foamprb.flow.base import NO_PLANES, Planes
from foamprb.flow.channels import extent

_MOST = 44
_ZERO = (0.0, 0.0, 0.0)
_POWERS = np.arange(-_MOST - 2, _MOST + 2, 2)


class PostArrays(NamedTuple):
    """Flow along x and y through columns of posts along z, each column shifted along y."""

    spacing: float
    radius: float
    shift: float
    """m, all three."""
    logarithm: complex
    """A, m/s, as the coefficients."""
    phi: NDArray[np.complex128]
    g: NDArray[np.complex128]
    """a_n and b_n for n = −46, −44, …, 44."""


def from_post(flow: PostArrays, x: Vector) -> tuple[Any, Any]:
    """Return the place of x from the middle of its post, which is nearest along the column, m."""
    column = np.floor(x[0] / flow.spacing + 0.5)
    y = x[1] - column * flow.shift
    return x[0] - column * flow.spacing, y - flow.spacing * np.floor(y / flow.spacing + 0.5)


def _derivatives(flow: PostArrays, x: Vector) -> tuple[Any, ...]:
    """Return z, φ and three derivatives of it, g and two."""
    p, q = from_post(flow, x)
    return _series(flow, (p + 1j * q) / flow.spacing)


def _series(flow: PostArrays, z: Any) -> tuple[Any, ...]:
    """Return the same around the post at 0."""
    square, power = z * z, z ** float(-_MOST - 2)
    f = f_1 = f_2 = f_3 = g = g_1 = g_2 = 0.0 * z
    for k in range(len(flow.phi)):
        n = 2.0 * k - _MOST - 2.0
        term, other = flow.phi[k] * power, flow.g[k] * power
        f, g = f + term, g + other
        f_1, g_1 = f_1 + n * term, g_1 + n * other
        f_2, g_2 = f_2 + n * (n - 1.0) * term, g_2 + n * (n - 1.0) * other
        f_3 = f_3 + n * (n - 1.0) * (n - 2.0) * term
        power = power * square
    A, B, log = flow.logarithm, np.conj(flow.logarithm), np.log(z)
    return (
        z, f + A * log, (f_1 + A) / z, (f_2 - A) / square, (f_3 + 2.0 * A) / (square * z),
        g + B * log, (g_1 + B) / z, (g_2 - B) / square,
    )  # fmt: skip


def sample_posts(flow: PostArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    z, f, f_1, f_2, _, g, g_1, _ = _derivatives(flow, x)
    w = f - z * np.conj(f_1) + np.conj(g)
    along, beside = (f_1 - np.conj(f_1)) / flow.spacing, (np.conj(g_1) - z * np.conj(f_2)) / flow.spacing
    w_x, w_y = along + beside, 1j * (along - beside)
    l = (w_x.real, w_y.real, 0.0, w_x.imag, w_y.imag, 0.0, 0.0, 0.0, 0.0)
    return (w.real, w.imag, 0.0), l, _ZERO


def curvature_posts(flow: PostArrays, host: int, x: Vector, t: float) -> Curvature:
    """Return the second derivatives, 1/(m s)."""
    z, _, _, f_2, f_3, _, _, g_2 = _derivatives(flow, x)
    scale = flow.spacing * flow.spacing
    a, b, c = f_2 / scale, -np.conj(f_2) / scale, (np.conj(g_2) - z * np.conj(f_3)) / scale
    xx, yy, xy = a + 2.0 * b + c, 2.0 * b - a - c, 1j * (a - c)
    return (xx.real, xx.imag, 0.0), (yy.real, yy.imag, 0.0), _ZERO, (xy.real, xy.imag, 0.0), _ZERO, _ZERO


def walk_posts(flow: PostArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Return where the segment from x0 to x1 first meets the post at x1."""
    end = from_post(flow, x1)
    p, q = x1[0] - x0[0], x1[1] - x0[1]
    excess = end[0] * end[0] + end[1] * end[1] - flow.radius * flow.radius
    if excess >= 0.0:
        return host, 1.0, -1, -1
    # The smaller root f of |end − (1 − f) (p, q)| = radius.
    a, b = p * p + q * q, end[0] * p + end[1] * q
    back = (b + math.sqrt(b * b - a * excess)) / a
    return host, max(1.0 - back, 0.0), 0, 0


def normal_posts(flow: PostArrays, triangle: int, x: Vector) -> Vector:
    """Return the unit normal of the post into the fluid."""
    p, q = from_post(flow, x)
    r = math.sqrt(p * p + q * q) + 1e-300
    return p / r, q / r, 0.0


def gap_posts(
    flow: PostArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the clearance between the body and the tangent plane of its post, m."""
    p, q = from_post(flow, x)
    return math.sqrt(p * p + q * q) - flow.radius - extent(R, F, mode, normal_posts(flow, 0, x)), 0, 0


def planes_of_posts(flow: PostArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """Return the tangent planes of the nearest post and of the next one of the column."""
    if chosen[0] == 0:
        return NO_PLANES
    p, q = from_post(flow, x)
    s = q - math.copysign(flow.spacing, q)
    near, far = math.sqrt(p * p + q * q), math.sqrt(p * p + s * s)
    h, k = near - flow.radius, far - flow.radius
    return Planes(
        h if h < cut else math.inf, (p / near, q / near, 0.0),
        k if k < cut else math.inf, (p / far, s / far, 0.0),
        math.inf, _ZERO,
    )  # fmt: skip


def _on_post(a: NDArray[np.complex128], A: complex, rho: float) -> NDArray[np.complex128]:
    """Return the b_n that stop the fluid on a post of radius rho, over the spacing."""
    b = np.zeros_like(a)
    of = dict(zip(_POWERS.tolist(), a.tolist(), strict=True))
    for k, n in enumerate(_POWERS):
        m = -int(n)
        value = (2 - m) * np.conj(of.get(2 - m, 0.0)) * rho ** (2 - 2 * m) - of.get(m, 0.0)
        b[k] = np.conj(rho ** (2 * m) * (value + (np.conj(A) / rho**2 if m == 2 else 0.0)))
        if m == 0:
            b[k] -= np.conj(2.0 * A * math.log(rho))
    return b


def through_posts(spacing: float, radius: float, velocity: tuple[float, float], shift: float) -> PostArrays:
    """Return the flow whose mean velocity over fluid and posts is ``velocity``, m/s."""
    rho, slope = radius / spacing, (shift / spacing) % 1.0
    nodes, weights = np.polynomial.legendre.leggauss(80)
    nodes, weights = 0.5 * nodes, 0.5 * weights
    # Points of the right edge less the shift of a column, a spacing higher where that is below the left edge.
    below = np.floor(nodes - slope + 0.5)
    right, left = 0.5 + 1j * nodes, -0.5 + 1j * (nodes - slope - below)
    corner = 0.5 + 1j * (slope * (nodes + 0.5) - 0.5)

    def basis(n: int | None, unit: complex) -> PostArrays:
        a = np.where(n == _POWERS, unit, 0j)
        A = unit if n is None else 0j
        return PostArrays(1.0, rho, 0.0, A, a, _on_post(a, A, rho))

    def misfit(flow: PostArrays) -> NDArray[np.float64]:
        """Return the jumps across the edges, and the fluxes through two sides of the periodic cell."""
        fields = []
        for z in (right, left, nodes + 0.5j, nodes - 0.5j, corner):
            _, f, f_1, _, _, g, _, _ = _series(flow, z)
            fields.append((f - z * np.conj(f_1) + np.conj(g), f_1))
        (w_r, p_r), (w_l, p_l), (w_t, p_t), (w_b, p_b), (w_c, _) = fields
        flux = weights @ w_r.real, weights @ w_t.imag - slope * (weights @ w_c.real)
        jumps = [p_r - p_l, p_t - p_b, w_r - w_l, w_t - w_b]
        return np.concatenate([*(j.real for j in jumps), *(j.imag for j in jumps), 100.0 * np.array(flux)])

    # The singular terms are scaled by the post, the others by the corners of the square; a_0 has no effect.
    units = [(n, c * min(1.4**n, rho**-n)) for n in _POWERS[1:].tolist() if n for c in (1.0, 1j)]
    bases = [basis(n, unit) for n, unit in units] + [basis(None, 1.0), basis(None, 1j)]
    columns = [misfit(flow) for flow in bases]
    # The pressure drops by one number along a row of posts and by another along a column.
    drops = np.zeros((2, len(columns[0])))
    drops[0, : len(nodes)], drops[1, : 2 * len(nodes)] = -1.0, np.concatenate([-below, -np.ones(len(nodes))])
    matrix = np.array([*columns, *drops]).T
    target = np.zeros(len(matrix))
    target[-2:] = 100.0 * velocity[0], 100.0 * (velocity[1] - slope * velocity[0])
    sizes = np.linalg.norm(matrix, axis=0)
    answer = np.linalg.lstsq(matrix / sizes, target)[0] / sizes
    A = complex(sum(c * flow.logarithm for c, flow in zip(answer, bases, strict=False)))
    a, b = (sum(c * flow[k] for c, flow in zip(answer, bases, strict=False)) for k in (4, 5))
    return PostArrays(spacing, radius, shift, A, a, b)
