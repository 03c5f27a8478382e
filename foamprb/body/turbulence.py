"""Eddies of a turbulent flow that is known by its mean, and by k and ε, and what they do to a particle.

The discrete random walk of Gosman & Ioannides (1983): a particle meets one eddy after the other; each has a
velocity of its own, which adds to the mean, for as long as the eddy lives or the particle is in it.
"""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Scalar, Vector

__all__ = [
    "BETA_STAR",
    "crossing_rate",
    "dissipation",
    "eddy_time",
    "fluctuation_size",
    "kolmogorov_length",
    "kolmogorov_rate",
    "lasting",
]

BETA_STAR = 0.09
"""C_μ of the k–ε model, and β* of the k–ω models: ε = β* k ω."""
_LENGTH = BETA_STAR**0.75
"""Of an eddy, over k^{3/2}/ε."""
_SMALL, _FASTEST = 1e-150, 1e6


def dissipation(k: Scalar, omega: Scalar) -> Scalar:
    """ε = β* k ω, m²/s³, of k, m²/s², and ω, 1/s."""
    return BETA_STAR * k * omega


def fluctuation_size(k: Scalar) -> Scalar:
    """√(2k/3), m/s: the standard deviation of each component of the fluctuation in isotropic turbulence."""
    return np.sqrt(2.0 / 3.0 * k)


def eddy_time(k: Scalar, epsilon: Scalar) -> Scalar:
    """k/ε, s: how long an eddy lives."""
    return k / (epsilon + _SMALL)


def crossing_rate(k: Scalar, slip: Scalar) -> Scalar:
    """How many times faster than it decays a particle leaves an eddy, or 1 if it stays in it to its end.

    A particle with the velocity ``slip`` (m/s) relative to the eddy crosses its length C_μ^{3/4} k^{3/2}/ε in
    the share C_μ^{3/4} √k/slip of its life k/ε.
    """
    rate = slip / (_LENGTH * np.sqrt(k) + _SMALL)
    return np.minimum(np.maximum(rate, 1.0), _FASTEST)


def lasting(time: Scalar, step: Scalar) -> tuple[Scalar, Scalar]:
    """Number of steps (s) that an eddy of a life of ``time`` (s) lasts, and what scales its velocity.

    The way that it takes particles has the variance of the eddy's life, σ² T² a life, at any step: one that
    lasts n steps instead of T has the velocity σ √(T/(n Δt)).
    """
    n = np.maximum(np.rint(time / step), 1.0)
    return n, np.sqrt(time / (n * step))


def kolmogorov_rate(epsilon: Scalar, nu: float) -> Scalar:
    """√(ε/ν), 1/s: shear rate of the smallest eddies."""
    return np.sqrt(epsilon / nu)


def kolmogorov_length(epsilon: Scalar, nu: float) -> Scalar:
    """(ν³/ε)^¼, m: their size."""
    return (nu**3 / (epsilon + _SMALL)) ** 0.25


def direction(v: Vector) -> Vector:
    """V over its length; zero of zero."""
    s = 1.0 / (np.sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]) + _SMALL)
    return s * v[0], s * v[1], s * v[2]
