"""Solids with memory: elastic strains that fade, one for each relaxation time (Prony series).

The stress is that of the material for b_e = F M Fᵀ. Without memory the metric M is M₀ of the shape at rest
(:mod:`foamprb.body.material`). With memory it follows the present one, C⁻¹ = F⁻¹F⁻ᵀ, in a share g_k of the
modulus with the time T_k,

    M = M₀ + Σ g_k D_k,   dD_k/dt = (X − D_k)/T_k,   X = C⁻¹ − M₀.

A neo-Hookean solid of modulus μ is then the sum of a neo-Hookean one, μ_∞ = μ (1 − Σ g_k), and of Maxwell
elements G_k = g_k μ whose b_k obeys an upper-convected equation (Lodge's network; Oldroyd's B). The modulus
of small strains is G(t) = μ_∞ + Σ G_k exp(−t/T_k). Both M and D_k are tensors of the material: rotations of
the body do not change them.

In a step X is a parabola, for which D_k is exact: through its values at both ends, with the slope at the end.
The slope at the start would be that of the body's fast relaxation. Within a step, X is a line or a parabola
through the shapes that are evaluated. A symmetric tensor is a tuple of the components 11, 22, 33, 12, 13
and 23.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.exponential_runge_kutta import NODE
from foamprb.body.material import metric_at_rest
from foamprb.body.relaxation import phi_functions
from foamprb.body.rosenbrock import Elasticity
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    dev,
    dot,
    dot_vector,
    inverse,
    reciprocals,
    scale,
    select,
    subtract,
    sym,
    transpose,
)

Floats = NDArray[np.float64]

Six: TypeAlias = tuple[Scalar, Scalar, Scalar, Scalar, Scalar, Scalar]
"""Components 11, 22, 33, 12, 13 and 23 of a symmetric tensor."""

MOST = 10
"""Largest number of relaxation times of a solid."""


def six_of(T: Tensor) -> Six:
    """Return the components of a symmetric tensor."""
    return T[0], T[4], T[8], T[1], T[2], T[5]


def symmetric(v: Six) -> Tensor:
    """Return the tensor with these components."""
    return v[0], v[3], v[4], v[3], v[1], v[5], v[4], v[5], v[2]


def metric_strain(F: Tensor, F0: Tensor) -> Six:
    """Return X = F⁻¹F⁻ᵀ − M₀."""
    return six_of(subtract(metric_at_rest(F), metric_at_rest(F0)))


def strain_rate(F: Tensor, A: Tensor) -> Six:
    """Return dX/dt, 1/s, with A = dF/dt, 1/s."""
    inverted = inverse(F)
    P = dot(dot(inverted, A), dot(inverted, transpose(inverted)))
    return six_of(scale(-2.0, sym(P)))


class Weights(NamedTuple):
    """Weights of D_k at the start of a step, and of three tensors."""

    decay: Scalar
    first: Scalar
    second: Scalar
    third: Scalar


def whole_step(z: Scalar) -> Weights:
    """Return the weights of X at both ends of a step, z = h/T_k, and of h dX/dt at its end."""
    decay, one, two, three, _ = phi_functions(-z)
    return Weights(decay, z * (one - 2.0 * (two - three)), 2.0 * z * (two - three), z * (2.0 * three - two))


def part_of_step(z: Scalar, at_node: Any) -> Weights:
    """Return the weights of X at the start, at the node of the step, and where D_k is evaluated.

    Parameters
    ----------
    z
        Time since the start of the step over T_k.
    at_node
        Where D_k is evaluated: True at the node, with X a line; False at the end, with X a parabola.
    """
    decay, one, two, three, _ = phi_functions(-z)
    # Mean of X and of its first two moments.
    n, s = NODE, 2.0 * three
    first = select(at_node, one - two, (s - (1.0 + n) * two + n * one) * (1.0 / n))
    second = select(at_node, 0.0 * two, (two - s) * (1.0 / (n * (1.0 - n))))
    third = select(at_node, two, (s - n * two) * (1.0 / (1.0 - n)))
    return Weights(decay, z * first, z * second, z * third)


def faded(D: Six, first: Six, second: Six, third: Six, w: Weights) -> Six:
    """Return D_k after a step or a part of it; see :class:`Weights`."""
    a, b, c, d = w
    return (
        a * D[0] + b * first[0] + c * second[0] + d * third[0],
        a * D[1] + b * first[1] + c * second[1] + d * third[1],
        a * D[2] + b * first[2] + c * second[2] + d * third[2],
        a * D[3] + b * first[3] + c * second[3] + d * third[3],
        a * D[4] + b * first[4] + c * second[4] + d * third[4],
        a * D[5] + b * first[5] + c * second[5] + d * third[5],
    )


def accumulated(v: Six, share: Scalar, D: Six) -> Six:
    """Return v + g_k D_k."""
    return (
        v[0] + share * D[0], v[1] + share * D[1], v[2] + share * D[2],
        v[3] + share * D[3], v[4] + share * D[4], v[5] + share * D[5],
    )  # fmt: skip


def fading(v: Six, share: Scalar, rate: Scalar, X: Six, D: Six) -> Six:
    """Return v + g_k dD_k/dt, 1/s, with ``rate`` 1/T_k, 1/s."""
    return accumulated(accumulated(v, share * rate, X), -share * rate, D)


def fading_stress(e: Elasticity, G: Tensor, rate: Six) -> Tensor:
    """Return the deviator of the rate of the stress by dM/dt, Pa/s, in the frame of G = Q·F.

    The elastic strain is nearly diagonal there, as in :mod:`foamprb.body.rosenbrock`. M does not change J, so
    that the resistance to dilation, a pressure, does not count.
    """
    b = dot(G, dot(symmetric(rate), transpose(G)))
    x, y, z = reciprocals(e.squares)
    t = dot_vector(e.slopes, (0.5 * x * b[0], 0.5 * y * b[4], 0.5 * z * b[8]))
    yz, xz, xy = e.shear[0] * b[5], e.shear[1] * b[2], e.shear[2] * b[1]
    return dev((t[0], xy, xz, xy, t[1], yz, xz, yz, t[2]))


def faded_metric(F0: Tensor, strain: Six) -> Tensor:
    """Return M = M₀ + Σ g_k D_k."""
    return add(metric_at_rest(F0), symmetric(strain))


# ---------------------------------------------------------------------------------------------------------
# Power law


class Series(NamedTuple):
    """Prony series of power laws with k = 1 Pa and ω₀ = 2π/s, a row for each exponent."""

    elastic: Floats
    """Modulus that stays, (n,), Pa."""
    moduli: Floats
    """G_k, (n, m), Pa."""
    viscosity: Floats
    """Viscosity of all shorter times, (n,), Pa s."""

    @property
    def modulus(self) -> Floats:
        """Modulus of sudden strains, (n,), Pa."""
        return np.asarray(self.elastic + self.moduli.sum(axis=1))


def complex_modulus(
    omega: ArrayLike, elastic: ArrayLike, moduli: ArrayLike, times: ArrayLike, viscosity: ArrayLike = 0.0
) -> NDArray[np.complex128]:
    """Return G* = G_∞ + Σ G_k iωT_k/(1 + iωT_k) + iωη, Pa, at angular frequencies (n,), 1/s."""
    i_omega = 1j * np.asarray(omega, dtype=float)
    x = np.multiply.outer(i_omega, np.asarray(times, dtype=float))
    branches = (np.asarray(moduli, dtype=float) * x / (1.0 + x)).sum(axis=-1)
    return np.asarray(np.asarray(elastic) + branches + i_omega * np.asarray(viscosity))


def power_law_modulus(omega: ArrayLike, alpha: ArrayLike) -> NDArray[np.complex128]:
    """Return G*/k = Γ(1 − α) (iω/ω₀)^α with ω₀ = 2π/s; G(t) is k (ω₀t)^(−α)."""
    from scipy.special import gamma

    a = np.asarray(alpha, dtype=float)
    ratio = 1j * np.asarray(omega, dtype=float) / (2.0 * math.pi)
    return np.asarray(gamma(1.0 - a) * ratio**a)


_BEYOND = 2.0
"""Factor by which relaxation times go beyond the times of a run, so that the power law holds to the ends."""
_PER_DECADE = 1.7
RESOLVED = 1e7
"""Largest range of times, a factor, over which the series holds within 2 %."""
_NEGLIGIBLE = 1e-9
"""Least modulus or viscosity of a series, over those that would give the power law alone."""


def times_of_power_law(shortest: float, longest: float) -> Floats:
    """Return relaxation times for a range of times, s, so many that they are a factor of 4 apart."""
    first, last = shortest / _BEYOND, max(longest, 10.0 * shortest) * _BEYOND
    n = round(_PER_DECADE * math.log10(last / first)) + 1
    return np.geomspace(first, last, min(n, MOST))


def series_of_power_law(alpha: ArrayLike, times: Floats) -> Series:
    """Return Prony series of power laws: least squares of the relative error of G* in the range.

    Parameters
    ----------
    alpha
        Exponents, (n,), between 0 and 1.
    times
        :func:`times_of_power_law`, s.
    """
    from scipy.optimize import nnls

    exponents, index = np.unique(np.atleast_1d(np.asarray(alpha, dtype=float)), return_inverse=True)
    omega = _frequencies(times)
    middle = math.sqrt(times[0] * times[-1])
    x = 1j * omega[:, None] * times
    columns = np.concatenate([np.ones((len(omega), 1)), x / (1.0 + x), 1j * omega[:, None] * middle], axis=1)
    # Relative to the power law, in columns of about 1.
    A = columns / power_law_modulus(omega, exponents[:, None])[..., None]
    A = np.concatenate([A.real, A.imag], axis=1)
    right = np.concatenate([np.ones(len(omega)), np.zeros(len(omega))])
    size = np.linalg.norm(A, axis=1, keepdims=True)
    A = A / size
    normal = np.einsum("nic,nid->ncd", A, A)
    c = np.linalg.solve(normal, np.einsum("nic,i->nc", A, right)[..., None])[..., 0]
    for row in np.flatnonzero((c < 0.0).any(axis=1)):
        # A negative modulus or viscosity would be a source of energy; zero would be no solid.
        c[row] = np.maximum(nnls(A[row], right)[0], _NEGLIGIBLE)
    c = (c / size[:, 0])[index.ravel()]
    return Series(c[:, 0], c[:, 1:-1], c[:, -1] * middle)


def error_of_power_law(alpha: ArrayLike, times: Floats) -> float:
    """Return the largest relative error of G* of :func:`series_of_power_law` in the range."""
    omega, a = _frequencies(times), np.atleast_1d(np.asarray(alpha, dtype=float))
    series, worst = series_of_power_law(a, times), 0.0
    for k, exponent in enumerate(a):
        G = complex_modulus(omega, series.elastic[k], series.moduli[k], times, series.viscosity[k])
        worst = max(worst, float(np.abs(G / power_law_modulus(omega, exponent) - 1.0).max()))
    return worst


def range_of_power_law(times: Floats) -> tuple[float, float]:
    """Return the angular frequencies between which the series holds, 1/s."""
    return float(_BEYOND / times[-1]), float(1.0 / (_BEYOND * times[0]))


def _frequencies(times: Floats) -> Floats:
    return np.geomspace(*range_of_power_law(times), 10 * MOST)
