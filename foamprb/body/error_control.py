"""Error of a step, and the size of the next step.

An error of the deformation gradient is F = exp(Ω) F_exact. The error of its elastic strain is then Ω b_e +
b_e Ωᵀ, that of its attitude Ω itself, in radians. The measure is the larger of |Ω| and of the former over
|b_e − I|. Strain and stress of a body of Ca = 10⁻⁵, with a strain of 10⁻⁵, thus meet the same tolerance as in
a soft body.

The pair of order 3(2) of :mod:`foamprb.body.exponential_runge_kutta` has two estimates. With δ₁ the
contribution of the slope of N to the solution of order 2, and δ_f that of the fluid's gradient,

    θ δ₁ + δ_f/32 ≤ tolerance

accepts the solution of order 2 after two evaluations. Its error is 5/48 h³ N'' and δ₁ is ½ h² N'; their ratio
is 0.21 h N''/N'. N changes at the rate ρ of elastic relaxation, or at that of the fluid's gradient, and θ = ½
min(1, h (ρ + max |∂u_i/∂x_j|)) is more than twice this ratio. Otherwise the third evaluation is made, and the
difference δ₂ of the two solutions is the error of order 2. In the following eight steps θ δ₁ is scaled by δ₂
(:func:`measured_ratio`). The error of the final solution is of order h⁴, about 1/6 δ₂^(4/3). A step is
accepted for

    δ₂^(4/3) ≤ tolerance,   and the next is   0.9 (tolerance^(3/4)/δ₂)^(1/3) times as long.

The path is subject to the tolerance as well, as a share of the way of the step (:func:`chord_error`,
:func:`parabola_error`). A linearly interpolated velocity has kinks between tetrahedra. They are as large as
the error of interpolation. No estimate covers them, as they would cut steps at every face.
"""

from __future__ import annotations

import math

import numpy as np

from foamprb.body.choice import choice
from foamprb.body.tensor import Scalar, Tensor, Vector, add, add_identity, ddot, dot, minus, norm, transpose

LEAST_STRAIN = 1e-6
"""Least elastic strain to which errors are related."""
FLUID_SHARE = 1.0 / 32.0
"""Share of δ_f in the error: order 2 does not sample the nonlinear change of the fluid's gradient in time."""
SECOND_SHARE = 0.5
"""θ of a step much longer than the time scale of N."""
DISTRUST, LEAST_SHARE, REUSE_FOR = 1.5, 0.25, 8
"""Safety factor and minimum of :func:`measured_ratio`, and the number of steps after which it is renewed."""
SAFETY, LEAST, MOST = 0.9, 0.2, 2.0
"""Share of the allowed step to aim at; smallest and largest factor between two steps."""
GROWTH = 1.5
"""Largest ratio of a step to the planned size of the previous one. If steps may double, errors of soft bodies
after their release grow without a gain in time."""
LONGEST = 1.1
"""Longest step times the size |l| of the fluid's velocity gradient, which is γ̇ in a simple shear.

Beyond, no estimate covers the truncation errors of the exponential and of the series of the rate of Ω, and
three samples do not resolve a gradient that may rotate with the body.
"""


def largest(T: Tensor) -> Scalar:
    """Return the largest magnitude among the components."""
    p = np.maximum(np.maximum(abs(T[0]), abs(T[1])), np.maximum(abs(T[2]), abs(T[3])))
    q = np.maximum(np.maximum(abs(T[4]), abs(T[5])), np.maximum(abs(T[6]), abs(T[7])))
    return np.maximum(np.maximum(p, q), abs(T[8]))


def size(T: Tensor) -> Scalar:
    """Return √(T:T), which rotations do not change."""
    return np.sqrt(ddot(T, T))


@choice
def strain_by(Omega: Tensor, b_e: Tensor) -> Tensor:
    """Return Ω b_e + b_e Ωᵀ, the change of b_e along Ω."""
    T = dot(Omega, b_e)
    return add(T, transpose(T))


def strain_in_frame(Omega: Tensor, b_e: Tensor) -> Tensor:
    """Return :func:`strain_by` for a diagonal b_e: rest shape a sphere, in the particle frame."""
    x, y, z = b_e[0], b_e[4], b_e[8]
    p, q, r = Omega[1] * y + Omega[3] * x, Omega[2] * z + Omega[6] * x, Omega[5] * z + Omega[7] * y
    return (2.0 * Omega[0] * x, p, q, p, 2.0 * Omega[4] * y, r, q, r, 2.0 * Omega[8] * z)


def strain_scale(b_e: Tensor, Omega: Tensor) -> Scalar:
    """Return the largest |b_e − I| at the two ends of a step Ω, at least :data:`LEAST_STRAIN`."""
    start = add_identity(b_e, -1.0)
    end = add(start, strain_by(Omega, b_e))
    return np.maximum(np.maximum(largest(start), largest(end)), LEAST_STRAIN)


def relative_size(Omega: Tensor, b_e: Tensor, strain: Scalar) -> Scalar:
    """Return the size of a small difference Ω of two deformation gradients.

    ``b_e`` is in the frame of Ω, ``strain`` the :func:`strain_scale` of the step.
    """
    return np.maximum(largest(Omega), largest(strain_by(Omega, b_e)) / strain)


def share_of_slope(h: Scalar, rho: Scalar, l_f: Tensor) -> Scalar:
    """Return θ, a bound of the error of order 2 over the contribution δ₁ of the slope of N.

    ``h`` is the step, s, ``rho`` the rate of elastic relaxation and ``l_f`` the velocity gradient of the
    fluid, 1/s.
    """
    return SECOND_SHARE * np.minimum(1.0, h * (rho + size(l_f)))


def measured_ratio(difference: Scalar, error_2: Scalar) -> Scalar:
    """Return the factor of θ δ₁ after a step of order 3, 1.5 δ₂/(θ δ₁), between a quarter and 1.

    If the slope of N changes more slowly than the bound, θ δ₁ is many times the error. As θ is more than
    twice the necessary value, a factor of at least a quarter keeps every error below twice the tolerance.

    ``difference`` and ``error_2`` are δ₂ and θ δ₁ of that step.
    """
    share = DISTRUST * difference / (error_2 + 1e-300)
    return np.minimum(1.0, np.maximum(LEAST_SHARE, share))


def longest_step(l_f: Tensor) -> Scalar:
    """Return the longest step, s, for a velocity gradient of the fluid at its start, 1/s."""
    return LONGEST / (size(l_f) + 1e-300)


def chord_error(h: Scalar, way: Scalar, a0: Vector, a1: Vector) -> Scalar:
    """Return h²/12 |a₁ − a₀| over the way, the relative error of the trapezoidal rule for the way h ∫v.

    It is the first term of the Euler–Maclaurin formula, of order h³. Common errors of both accelerations
    cancel.

    Parameters
    ----------
    h, way
        Step, s, and the way to which errors are related, m.
    a0, a1
        Accelerations ∂u/∂t + ∇u·v at the ends of the step, m/s².
    """
    return h * h * (1.0 / 12.0) * norm(minus(a1, a0)) / way


def parabola_error(h: Scalar, way: Scalar, dv: Vector, a0: Vector, a1: Vector) -> Scalar:
    """Return h/12 |h (a₀ + a₁) − 2 Δv| over the way: the error of the parabola through v at both ends and a₀.

    It is of order h⁴ if the accelerations are those of v. On a mesh u and ∇u are interpolated separately; the
    result is then of order h², by the difference between the two. ``dv`` is the change of velocity over the
    step, m/s; for the others see :func:`chord_error`.
    """
    x = h * (a0[0] + a1[0]) - 2.0 * dv[0]
    y = h * (a0[1] + a1[1]) - 2.0 * dv[1]
    z = h * (a0[2] + a1[2]) - 2.0 * dv[2]
    return h * (1.0 / 12.0) * norm((x, y, z)) / way


def path_factor(path: Scalar, tolerance: float) -> Scalar:
    """Return the length of the next step over that of this one, by the error of the path."""
    return SAFETY * np.sqrt(tolerance / (path + 1e-300))


def step_factor(third: bool, difference: float, by_path: float, tolerance: float) -> float:
    """Return the length of the next step over that of this one.

    Parameters
    ----------
    third, difference
        Whether the step is of order 3, and δ₂ if so.
    by_path
        :func:`path_factor`.
    tolerance
        Largest error of a step.
    """
    if not math.isfinite(difference) or math.isnan(by_path):
        return LEAST
    factor = MOST
    if third:
        factor = SAFETY * (tolerance**0.75 / (difference + 1e-300)) ** (1.0 / 3.0)
    return min(MOST, max(LEAST, min(factor, by_path)))


def next_size(h: float, size: float, factor: float, rejected: bool) -> float:
    """Return the size of the next steps, s.

    Parameters
    ----------
    h, size
        The step and its planned size, s; h is shorter if the step ended at a given time.
    factor
        :func:`step_factor`.
    rejected
        Whether the previous step was rejected.
    """
    allowed = h * factor
    # A shortened step only reduces the planned size by its error.
    if factor >= MOST:
        allowed = max(allowed, size)
    # No growth right after a rejection.
    return min(allowed, size if rejected else GROWTH * size)
