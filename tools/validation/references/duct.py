"""Lift by inertia of the fluid on a small neutral sphere between plane walls, by one quadrature.

The sphere's stresslet S_xz = 10π/3 μ_f a³ U'(z₀) disturbs the flow U(z) by v₀ + Re v₁. With Fourier modes
along the walls, of wave number k, the normal components obey

    (D² − k²)² w₀ = i k_x S_xz (k² + D²) δ(z − z₀),
    (D² − k²)² w₁ = i k_x [(U − U₀)(D² − k²) − U''] w₀,          w = Dw = 0 at the walls,

and the sphere drifts with w₁ at its place, summed over all modes (after Cox & Brenner 1968; Schonberg & Hinch
1989 for Re → 0).
"""

from __future__ import annotations

from itertools import pairwise

import numpy as np

from validation.case import Floats

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(60)
_COARSE, _COARSE_WEIGHTS = np.polynomial.legendre.leggauss(10)


def _clamped(k: float, outer: tuple[float, float, float, float]) -> Floats:
    """Return the factors of the modes e^{−kz}, z e^{−kz} and their mirror images that cancel a field.

    ``outer`` is the field and its derivative along z at z = 0, and at z = 1.
    """
    e = np.exp(-k)
    # Rows: value and slope at both walls; columns: the modes.
    matrix = np.array([
        [1.0, 0.0, e, e],
        [-k, 1.0, k * e, (k - 1.0) * e],
        [e, e, 1.0, 0.0],
        [-k * e, (1.0 - k) * e, k, -1.0],
    ])  # fmt: skip
    return np.linalg.solve(matrix, -np.array(outer))


def _integrand(k: float, z0: float) -> float:
    """Return k³ ∫ G(z₀, z) [(U − U₀)(D² − k²) g − U'' g] dz of U = 4 z (1 − z)."""
    a, b = z0, 1.0 - z0
    ea, eb = np.exp(-k * a), np.exp(-k * b)
    # G: (1 + kξ) e^{−kξ}/4k³ in infinite space, with the slope −k² ξ e^{−kξ}/4k³ along ξ.
    f = 0.25 / k**3
    green = _clamped(
        k, (f * (1.0 + k * a) * ea, f * k * k * a * ea, f * (1.0 + k * b) * eb, -f * k * k * b * eb)
    )
    # g = (k² + ∂²/∂z₀²) G: ½ ξ e^{−kξ} there.
    source = _clamped(k, (0.5 * a * ea, -0.5 * (1.0 - k * a) * ea, 0.5 * b * eb, 0.5 * (1.0 - k * b) * eb))
    total = 0.0
    for low, high in ((0.0, z0), (z0, 1.0)):
        # Dense at the sphere and at the walls, where the modes decay.
        for part in (0, 1):
            reach = min(0.5 * (high - low), 20.0 / k)
            start, end = ((low, low + reach), (high - reach, high))[part]
            z = 0.5 * (start + end) + 0.5 * (end - start) * _NODES
            xi, near, far = np.abs(z - z0), np.exp(-k * z), np.exp(-k * (1.0 - z))
            modes = np.array([near, z * near, far, (1.0 - z) * far])
            G = f * (1.0 + k * xi) * np.exp(-k * xi) + green @ modes
            g = 0.5 * xi * np.exp(-k * xi) + source @ modes
            Lg = -k * np.exp(-k * xi) - 2.0 * k * (source[1] * near + source[3] * far)
            U = 4.0 * (z * (1.0 - z) - z0 * (1.0 - z0))
            total += 0.5 * (end - start) * float(_WEIGHTS @ (G * (U * Lg + 8.0 * g)))
    return k**3 * total


def coefficient(s: float) -> float:
    """Return C of a plane channel at s from 0 to below 1.

    C ρ_f γ̇² R⁴ outwards, with the shear rate at the wall and the distance s from the middle over half of that
    of the walls. It goes to −55π/96 at a wall (Cox & Hsu 1977).
    """
    z0 = 0.5 * (1.0 - s)
    most = 40.0 / z0
    # The integrand is smooth in k and goes as 9/32 |U''| k⁻² for large k.
    edges = np.concatenate([[0.0], np.geomspace(0.5, most, 30)])
    total = 9.0 / 4.0 / most
    for low, high in pairwise(edges):
        k = 0.5 * (low + high) + 0.5 * (high - low) * _COARSE
        values = [_integrand(float(each), z0) for each in k]
        total += 0.5 * (high - low) * float(_COARSE_WEIGHTS @ np.array(values))
    return float(5.0 / 4.0 * np.pi * s * total)
