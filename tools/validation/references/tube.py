"""Lift by inertia of the fluid on a small neutral sphere in a pipe, by modes around and along it.

As in :mod:`validation.references.duct`, the sphere's stresslet S_xr = 10π/3 μ_f a³ U'(r₀) in U = 1 − r² makes
a Stokes flow v₀, whose inertia f = (U − U₀) ∂v₀/∂x + v₀·∇U drives the sphere. By the reciprocal theorem the
drift is −Re ∫ u·f dV with the Stokes flow u of a unit radial force at the sphere.

Both flows are sums over modes exp(ikx + inθ) of three solutions of Stokes' equations with Bessel functions I
within r₀, and of six with I and K outside. In v± = v_r ± i v_θ they are

    v+ = A I_{n+1} + ½ P r I'_{n+1},   v− = B I_{n−1} + ½ P r I'_{n−1},
    v_x = C I_n + ½ i P r I'_n,        p = P I_n,

with P = −k (A + B) − 2ikC. At r₀ a unit radial force has the jump 1/r₀ of p; the stresslet those of v_x,
−1/r₀, and of p, 2ik/r₀.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any

import numpy as np
from scipy.special import ive, kve

from validation.case import Floats

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(14)
_COARSE, _COARSE_WEIGHTS = np.polynomial.legendre.leggauss(10)
_CUTS = (0.0, 1.5, 5.0, 12.0, 30.0)
"""Parts of the radial integral, in decay lengths from r₀."""


def _solutions(growing: bool, n: int, k: Floats, r: Floats, at: float) -> Any:
    """Return v+, v−, v_x, p and the slopes of the first three, (3, 7, K), of the solutions A, B and C.

    They have I if ``growing``, else K; scaled by the exponential that is 1 at the radius ``at``.
    """
    z, scale = k * r, np.exp((k if growing else -k) * (r - at))
    # (−1)^m K_m has the recurrences of I_m.
    bessel = {m: (ive(m, z) if growing else (-1.0) ** m * kve(m, z)) * scale for m in range(n - 1, n + 3)}
    slope = {m: bessel[m + 1] + m / z * bessel[m] for m in range(n - 1, n + 2)}
    bend = {m: (1.0 + m * m / z**2) * bessel[m] - slope[m] / z for m in slope}
    solutions = []
    for A, B, C in ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0), (0.0, 0.0, 1.0)):
        P = -k * (A + B) - 2j * k * C
        parts = ((A, n + 1, 0.5), (B, n - 1, 0.5), (C, n, 0.5j))
        values = [c * bessel[m] + f * P * r * slope[m] for c, m, f in parts]
        slopes = [c * k * slope[m] + f * P * (slope[m] + z * bend[m]) for c, m, f in parts]
        solutions.append(np.array([*values, P * bessel[n], *slopes]))
    return np.array(solutions)


def _factors(n: int, k: Floats, r0: float) -> Any:
    """Return the factors of the nine solutions, (K, 9, 2), for the radial force and for the stresslet."""
    at, wall = np.full(len(k), r0), np.ones(len(k))
    inner = _solutions(True, n, k, at, r0)
    outer = np.concatenate([_solutions(True, n, k, at, 1.0), _solutions(False, n, k, at, r0)])
    ends = np.concatenate([_solutions(True, n, k, wall, 1.0), _solutions(False, n, k, wall, r0)])
    matrix = np.zeros((len(k), 9, 9), dtype=complex)
    for row, weights in enumerate(({0: 1}, {1: 1}, {2: 1}, {4: 1, 5: -1}, {6: 1}, {3: 1})):
        for component, weight in weights.items():
            matrix[:, row] += weight * np.concatenate([-inner[:, component], outer[:, component]]).T
    for component in range(3):
        matrix[:, 6 + component, 3:] = ends[:, component].T
    right = np.zeros((len(k), 9, 2), dtype=complex)
    right[:, 5, 0] = 1.0 / r0
    right[:, 2, 1] = -1.0 / r0
    right[:, 5, 1] = 2j * k / r0
    columns = np.abs(matrix).max(axis=1, keepdims=True)
    matrix = matrix / columns
    rows = np.abs(matrix).max(axis=2, keepdims=True)
    return np.linalg.solve(matrix / rows, right / rows) / columns.transpose(0, 2, 1)


def hindrance(r0: float, size: float = 3.0) -> float:
    """Return by how much walls slow a small sphere that moves radially: 1.8044 on the axis, in a/R.

    The difference of the flow at a radial force in this pipe and in one that is ``size`` times as wide.
    """
    k, weights = 8.0 * (_NODES + 1.0), 8.0 * _WEIGHTS
    k, weights = np.concatenate([k, 16.0 + 2.0 * k]), np.concatenate([weights, 2.0 * weights])

    def velocity(n: int, k: Floats, r: float) -> Floats:
        fields = _solutions(True, n, k, np.full(len(k), r), r)[:, :2]
        return np.asarray(0.5 * np.einsum("kb,bck->k", _factors(n, k, r)[:, :3, 0], fields).real)

    total = 0.0
    for n in range(10):
        missing = velocity(n, size * k, r0 / size) - velocity(n, k, r0)
        total += (1.0 if n == 0 else 2.0) * float(weights @ missing)
    return 3.0 * total / (np.pi * (1.0 - 1.0 / size))


def _mode(n: int, k: Floats, r0: float) -> Floats:
    """Return the real part of ∫ u*·f r dr for one n and the wave numbers k (K,), with S_xr = 1."""
    factors, total = _factors(n, k, r0), np.zeros(len(k))
    decay = np.hypot(k, n / r0)
    for sign, length in ((-1.0, r0), (1.0, 1.0 - r0)):
        cuts = [*(np.minimum(length, cut / decay) for cut in _CUTS), np.full(len(k), length)]
        for low, high in pairwise(cuts):
            for node, weight in zip(_NODES, _WEIGHTS, strict=True):
                r = np.maximum(r0 + sign * (0.5 * (low + high) + 0.5 * (high - low) * node), 1e-12)
                if sign < 0.0:
                    fields, weights = _solutions(True, n, k, r, r0), factors[:, :3]
                else:
                    fields = np.concatenate([_solutions(True, n, k, r, 1.0), _solutions(False, n, k, r, r0)])
                    weights = factors[:, 3:]
                u, v = np.einsum("kbs,bck->sck", weights, fields[:, :3])
                carried = 1j * k * (r0 * r0 - r * r) * v
                carried[2] -= r * (v[0] + v[1])
                work = 0.5 * (u[0].conj() * carried[0] + u[1].conj() * carried[1]) + u[2].conj() * carried[2]
                total += 0.5 * (high - low) * weight * r * np.where(high > low, work.real, 0.0)
    return total


def _sum(n_most: int, r0: float) -> tuple[float, float]:
    """Return the largest wave number and the sum over all modes up to it."""
    most, total = (n_most + 0.5) / r0, 0.0
    for n in range(n_most + 1):
        first = max(0.3, n / 3.0)
        edges = np.concatenate(
            [[0.0], np.geomspace(first, most, max(4, int(6 * np.log10(most / first)) + 3))]
        )
        middle, half = 0.5 * (edges[1:] + edges[:-1])[:, None], 0.5 * np.diff(edges)[:, None]
        k, weights = (middle + half * _COARSE).ravel(), (half * _COARSE_WEIGHTS).ravel()
        total += (1.0 if n == 0 else 2.0) * float(weights @ _mode(n, k, r0))
    return most, total / (2.0 * np.pi**2)


def coefficient(s: float, n_most: int = 72) -> float:
    """Return C of a pipe at s from above 0 to below 0.95: C ρ_f γ̇² R⁴ outwards, with the rate at the wall.

    ``n_most`` is the number of modes around the pipe. The sum up to the wave number K is continued as
    a + b/K + c/K².
    """
    K, sums = np.transpose([_sum(n_most // part, s) for part in (1, 2, 4)])
    limit = np.linalg.solve(np.stack([np.ones(3), 1.0 / K, 1.0 / K**2], axis=1), sums)[0]
    return float(10.0 * np.pi**2 * s * limit)
