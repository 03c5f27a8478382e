"""Eddies of a turbulent flow with known mean velocity, k and ε.

The discrete random walk of Gosman & Ioannides (1983): a particle passes through one eddy after the other. The
velocity of each eddy adds to the mean velocity until the eddy decays or the particle leaves it.
"""

from __future__ import annotations

import numpy as np

from foamprb.body.tensor import Scalar, Vector, norm, scale_vector

BETA_STAR = 0.09
"""C_μ of the k–ε model, and β* of the k–ω models: ε = β* k ω."""
_LENGTH = BETA_STAR**0.75
"""Length of an eddy over k^{3/2}/ε."""
_SMALL, _FASTEST = 1e-150, 1e6


def dissipation(k: Scalar, omega: Scalar) -> Scalar:
    """Return ε = β* k ω, m²/s³, for k, m²/s², and ω, 1/s."""
    return BETA_STAR * k * omega


def fluctuation_size(k: Scalar) -> Scalar:
    """Return √(2k/3), m/s, the standard deviation of a velocity component in isotropic turbulence."""
    return np.sqrt(2.0 / 3.0 * k)


def eddy_time(k: Scalar, epsilon: Scalar) -> Scalar:
    """Return k/ε, s, the lifetime of an eddy."""
    return k / (epsilon + _SMALL)


def crossing_rate(k: Scalar, slip: Scalar) -> Scalar:
    """Return the lifetime of an eddy over the time in which a particle crosses it, or 1 if that is larger.

    A particle with the velocity ``slip`` (m/s) relative to the eddy crosses its length C_μ^{3/4} k^{3/2}/ε in
    the share C_μ^{3/4} √k/slip of its lifetime k/ε.
    """
    rate = slip / (_LENGTH * np.sqrt(k) + _SMALL)
    return np.minimum(np.maximum(rate, 1.0), _FASTEST)


def lasting(time: Scalar, step: Scalar) -> tuple[Scalar, Scalar]:
    """Return the number of steps (s) of an eddy of lifetime ``time`` (s), and the factor of its velocity.

    The displacement of particles has the variance σ² T² per lifetime T at any step: an eddy that lasts n
    steps has the velocity σ √(T/(n Δt)).
    """
    n = np.maximum(np.rint(time / step), 1.0)
    return n, np.sqrt(time / (n * step))


def kolmogorov_rate(epsilon: Scalar, nu: float) -> Scalar:
    """Return √(ε/ν), 1/s, the shear rate of the smallest eddies."""
    return np.sqrt(epsilon / nu)


def kolmogorov_length(epsilon: Scalar, nu: float) -> Scalar:
    """Return (ν³/ε)^¼, m, the size of the smallest eddies."""
    return (nu**3 / (epsilon + _SMALL)) ** 0.25


def direction(v: Vector) -> Vector:
    """Return v/|v|, or 0 for v = 0."""
    return scale_vector(1.0 / (norm(v) + _SMALL), v)
