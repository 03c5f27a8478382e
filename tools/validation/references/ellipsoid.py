"""Integrals over the exterior of an ellipsoid, its resistances, and the stress of the fluid on it.

By Gauss–Legendre sums, independent of foamprb's own code. Vectors are arrays (3,), tensors (3, 3). Lengths
and stresses are in any consistent units.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from validation.references import Floats

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(160)
_S = 0.5 * (_NODES + 1.0)
_DS = 0.5 * _WEIGHTS


class Integrals(NamedTuple):
    """Jeffery's integrals (B.2), (B.4), (B.9) of semi-axes a, b, c, each with one entry per axis."""

    first: Floats
    """α₀, β₀, γ₀."""
    ring: Floats
    """α₀°, β₀°, γ₀°."""
    star: Floats
    """α₀*, β₀*, γ₀*."""
    chi: float
    """χ."""


def integrals(axes: Floats) -> Integrals:
    """Return Jeffery's integrals by quadrature.

    With λ = g²(1 − s²)/s², g³ = abc, each is a smooth integral over s in (0, 1); 160 Gauss–Legendre nodes
    give it to 1e-12 for axis ratios up to 30.

    Parameters
    ----------
    axes
        Semi-axes (3,).
    """
    g2 = float(np.prod(axes)) ** (2.0 / 3.0)
    q = g2 + np.multiply.outer(axes**2 - g2, _S**2)
    common = 2.0 * g2 * _DS / np.sqrt(np.prod(q, axis=0))
    s2 = _S**2
    pairs = np.stack([q[1] * q[2], q[2] * q[0], q[0] * q[1]])
    return Integrals(
        (common * s2 / q).sum(axis=1),
        (common * s2**2 / pairs).sum(axis=1),
        (common * g2 * s2 * (1.0 - s2) / pairs).sum(axis=1),
        float(common.sum()),
    )


def resistances(axes: Floats) -> Floats:
    """Return principal resistances of an ellipsoid as lengths, K_a = 16π/(χ + α_a r_a²) (Oberbeck 1876)."""
    g = integrals(axes)
    return 16.0 * np.pi / (g.chi + g.first * axes**2)


def prolate_resistances(axes: Floats) -> Floats:
    """Return π r_min k of the paper's (D.1), (D.2), λ the ratio of longest to shortest semi-axis.

    Below λ = 1.01 the printed forms lose their digits; there the spheroid's exact resistances are taken.
    """
    longest, shortest = int(np.argmax(axes)), float(np.min(axes))
    r = float(axes[longest]) / shortest
    if r < 1.01:
        k = resistances(np.array([r, 1.0, 1.0])) / np.pi
        along, across = float(k[0]), float(k[1])
    else:
        w = np.sqrt(r * r - 1.0)
        log = np.log(r + w)
        along = 8.0 * w**3 / ((2.0 * r * r - 1.0) * log - r * w)
        across = 16.0 * w**3 / ((2.0 * r * r - 3.0) * log + r * w)
    k = np.full(3, across)
    k[longest] = along
    return np.pi * shortest * k


def diagonal_response(axes: Floats) -> Floats:
    """Return the matrix M, (3, 3), of s̃_aa = Σ_b M_ab d_bb for unit viscosity (B.3), (B.5)."""
    x, y, z = integrals(axes).star
    n = 8.0 / (6.0 * (x * y + y * z + z * x) * np.prod(axes))
    return np.asarray(n * np.array([[2 * x, -y, -z], [-x, 2 * y, -z], [-x, -y, 2 * z]]))


def traction_stress(F: Floats, l_f: Floats, l_s: Floats) -> Floats:
    """Return Roscoe's σ̃/μ_f of a body with deformation gradient F, p = 0, inertial frame.

    (25) to (27) and Appendix B, with 2 dev d_s − 4/3 tr(d_s) I for the printed 2 d_s.

    Parameters
    ----------
    F, l_f, l_s
        Deformation gradient, and velocity gradients ∂u_i/∂x_j of fluid and body, each (3, 3).
    """
    U, axes, _ = np.linalg.svd(F)
    d_f, w_f = symmetric_and_skew(U.T @ l_f @ U)
    d_s, w_s = symmetric_and_skew(U.T @ l_s @ U)
    e_s = d_s - np.trace(d_s) / 3.0 * np.eye(3)
    d, w = d_f - np.trace(d_f) / 3.0 * np.eye(3) - e_s, w_f - w_s
    g = integrals(axes)
    s = np.diag(diagonal_response(axes) @ np.diag(d))
    volume = np.prod(axes)
    # (B.6)–(B.8) for the pair of axes i, j, of which k is the third: H_ij couples to d_ji and w_ji.
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        n = 2.0 * g.ring[k] * (axes[i] ** 2 * g.first[i] + axes[j] ** 2 * g.first[j])
        s[i, j] = 8.0 / volume * (g.first[i] * d[j, i] - axes[j] ** 2 * g.ring[k] * w[j, i]) / n
        s[j, i] = 8.0 / volume * (g.first[j] * d[j, i] + axes[i] ** 2 * g.ring[k] * w[j, i]) / n
    # A, B, C of (B.5) are s_aa abc/8, and p̃ = p + 4 (α₀A + β₀B + γ₀C) of (B.1).
    pressure = 0.5 * volume * float(g.first @ np.diag(s))
    stress = s + 2.0 * e_s - (pressure + 4.0 / 3.0 * np.trace(d_s)) * np.eye(3)
    return np.asarray(U @ stress @ U.T)


def symmetric_and_skew(l: Floats) -> tuple[Floats, Floats]:
    """Return the symmetric and the skew part of a tensor (3, 3)."""
    return 0.5 * (l + l.T), 0.5 * (l - l.T)
