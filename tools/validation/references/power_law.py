"""Creep of a sphere whose solid is a power law, exact for small strains."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import gamma


def creep_of_power_law(
    t: ArrayLike, k: ArrayLike, alpha: ArrayLike, rate: ArrayLike = 0.0, terms: int = 32
) -> NDArray[np.complex128]:
    """Return the strain over the strain rate of the fluid, s, after a time t, s; viscosity 1 Pa s.

    3 de/dt + 2 ∫G(t − s) de/ds ds = 5 with G(t) = k (2πt)^(−α) has a Laplace transform that is inverted on
    Talbot's contour (Abate & Valkó 2004). In a shear of ``rate`` γ̇, 1/s, the strain rate turns in the
    frame of the material: the result is then that of ε_xx + i ε_xy over i γ̇/2, as seen at rest.
    """
    t, k, alpha, rate = np.broadcast_arrays(t, k, alpha, rate)
    theta = np.arange(1, terms) * np.pi / terms
    cot = 1.0 / np.tan(theta)
    delta = np.concatenate([[0.4 * terms], 0.4 * np.arange(1, terms) * np.pi * (cot + 1j)])
    weight = np.concatenate([[0.5], 1.0 + 1j * theta * (1.0 + cot**2) - 1j * cot]) * np.exp(delta)
    total = np.zeros(t.shape, dtype=complex)
    # Both halves of the contour: the transform of a complex function is not symmetric.
    for point, w in (*zip(delta, weight, strict=True), *zip(delta.conj(), weight.conj(), strict=True)):
        s = point / t
        c = 2.0 * k * gamma(1.0 - alpha) * (2.0 * np.pi) ** -alpha
        total += 0.2 / t * w * 5.0 / ((s - 1j * rate) * s * (3.0 + c * s ** (alpha - 1.0)))
    return np.asarray(total * np.exp(-1j * rate * t))
