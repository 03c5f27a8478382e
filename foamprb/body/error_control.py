"""What the error of a step is measured by, and the size of the next step.

An error of the deformation gradient is F = exp(Ω) F_exact. Its elastic strain is then off by Ω b_e + b_e
Ωᵀ, its attitude by Ω itself. The measure is the larger of |Ω| and of that change over |b_e − I|: a body
of Ca = 10⁻⁵ whose strain is 10⁻⁵ has it right to the tolerance as a soft one has, and so its stress. The
attitude is held to the same number in radians.

The pair of order 3(2) of :mod:`foamprb.body.exponential_runge_kutta` has two estimates. With δ₁ the part that
the slope of N has of the solution of order 2, and δ_f that of the fluid's gradient,

    θ δ₁ + δ_f/32 ≤ tolerance

says that the solution of order 2 will do, and two evaluations are enough. Its error is 5/48 h³ N'' where δ₁
is ½ h² N', that is 0.21 h N''/N' δ₁. N changes at the rate ρ at which the elastic stress relaxes, or at
that of the fluid's gradient, and θ = ½ min(1, h (ρ + max |∂u_i/∂x_j|)) is more than twice as much. Else the
third evaluation is made, and δ₂, the difference of the two solutions, is the error of order 2. From then on
as much of θ δ₁ counts as δ₂ says (:func:`learned_share`), for some eight steps. That of the
solution which is kept is of order h⁴ and found to be about 1/6 δ₂^(4/3), so that a step is accepted for

    δ₂^(4/3) ≤ tolerance,   and the next is   0.9 (tolerance^(3/4)/δ₂)^(1/3) times as long.

The path is held to the tolerance as well, as a share of the way that the step goes (:func:`chord_error`,
:func:`parabola_error`).
A velocity that is interpolated linearly bends from one tetrahedron to the next. Such bends are as large as
the interpolation's own error, and no estimate looks for them: they would cut steps at every face.
"""

from __future__ import annotations

import math

import numpy as np

from foamprb.body.tensor import Scalar, Tensor, Vector, add, add_identity, dot, transpose

LEAST_STRAIN = 1e-6
"""Smaller elastic strains count as this."""
FLUID_SHARE = 1.0 / 32.0
"""Share of δ_f that counts: what is not linear in time of the fluid's gradient is not sampled for order 2."""
SECOND_SHARE = 0.5
"""θ of a step in which N has all the time to change."""
DISTRUST, LEAST_SHARE, LEARNED_FOR = 1.5, 0.25, 8
"""Of :func:`learned_share`: over the error found; the least; after so many steps it is learned anew."""
SAFETY, LEAST, MOST = 0.9, 0.2, 2.0
"""Aim at this share of the step allowed, and the smallest and the largest factor between two steps."""
GROWTH = 1.5
"""A step is at most so much longer than what the one before it was meant to be. With steps that double, soft
bodies err more after their release, in no less time."""
LONGEST = 0.5
"""Longest step times the largest component of the fluid's velocity gradient.

Beyond, the exponential and the series of the rate of Ω end too early, which no estimate sees, and three
samples say little of a gradient that may turn with the body.
"""


def largest(T: Tensor) -> Scalar:
    """Largest magnitude among the components."""
    p = np.maximum(np.maximum(abs(T[0]), abs(T[1])), np.maximum(abs(T[2]), abs(T[3])))
    q = np.maximum(np.maximum(abs(T[4]), abs(T[5])), np.maximum(abs(T[6]), abs(T[7])))
    return np.maximum(np.maximum(p, q), abs(T[8]))


def strain_by(Omega: Tensor, b_e: Tensor) -> Tensor:
    """Ω b_e + b_e Ωᵀ, the change of b_e along Ω."""
    T = dot(Omega, b_e)
    return add(T, transpose(T))


def strain_in_frame(Omega: Tensor, b_e: Tensor) -> Tensor:
    """The same for a diagonal b_e: that of a body that is a sphere at rest, in its particle frame."""
    x, y, z = b_e[0], b_e[4], b_e[8]
    p, q, r = Omega[1] * y + Omega[3] * x, Omega[2] * z + Omega[6] * x, Omega[5] * z + Omega[7] * y
    return (2.0 * Omega[0] * x, p, q, p, 2.0 * Omega[4] * y, r, q, r, 2.0 * Omega[8] * z)


def strain_scale(b_e: Tensor, Omega: Tensor) -> Scalar:
    """Largest |b_e − I| at the two ends of a step Ω, and at least :data:`LEAST_STRAIN`."""
    start = add_identity(b_e, -1.0)
    end = add(start, strain_by(Omega, b_e))
    return np.maximum(np.maximum(largest(start), largest(end)), LEAST_STRAIN)


def relative_size(Omega: Tensor, b_e: Tensor, strain: Scalar) -> Scalar:
    """Size of a small difference Ω of two deformation gradients.

    Parameters
    ----------
    b_e
        Elastic b_e, in the frame of Ω.
    strain
        :func:`strain_scale` of the step.
    """
    return np.maximum(largest(Omega), largest(strain_by(Omega, b_e)) / strain)


def share_of_slope(h: Scalar, rho: Scalar, l_f: Tensor) -> Scalar:
    """θ, at most what the error of the solution of order 2 is of the part that the slope of N has in it.

    Parameters
    ----------
    h
        The step, s.
    rho
        Rate at which the elastic stress relaxes, 1/s.
    l_f
        Velocity gradient of the fluid, 1/s.
    """
    return SECOND_SHARE * np.minimum(1.0, h * (rho + largest(l_f)))


def learned_share(difference: Scalar, judged: Scalar) -> Scalar:
    """What of θ δ₁ counts after a step of order 3, in which the error of order 2 was δ₂: 1.5 δ₂/(θ δ₁).

    Where a body's slope changes less than it might, θ δ₁ is many times the error. At least a quarter counts:
    since θ is more than twice what it need be, no error that N can have is then above twice the tolerance.

    Parameters
    ----------
    difference, judged
        δ₂ and θ δ₁ of that step.
    """
    share = DISTRUST * difference / (judged + 1e-300)
    return np.minimum(1.0, np.maximum(LEAST_SHARE, share))


def longest_step(l_f: Tensor) -> Scalar:
    """The step, s, that no estimate may exceed, for a velocity gradient of the fluid at its start, 1/s."""
    return LONGEST / (largest(l_f) + 1e-300)


def chord_error(h: Scalar, way: Scalar, a0: Vector, a1: Vector) -> Scalar:
    """What h²/12 (a₁ − a₀), the error of the trapezoidal rule for the way h ∫v, is of the way.

    It is the first term of Euler and Maclaurin's formula, of the order of h³; what is wrong with both
    accelerations alike cancels in it.

    Parameters
    ----------
    h, way
        Step, s, and the way with which errors are compared, m.
    a0, a1
        Accelerations ∂u/∂t + ∇u·v at the ends of the step, m/s².
    """
    f = h * h * (1.0 / 12.0)
    x, y, z = a1[0] - a0[0], a1[1] - a0[1], a1[2] - a0[2]
    return f * np.sqrt(x * x + y * y + z * z) / way


def parabola_error(h: Scalar, way: Scalar, dv: Vector, a0: Vector, a1: Vector) -> Scalar:
    """What h/12 (h (a₀ + a₁) − 2 Δv) is of the way: the same of the parabola of v at both ends and a₀.

    It is of the order of h⁴ where the accelerations are those of v. Of a flow that was computed on a mesh, u
    and ∇u are interpolated each for itself: it is then of the order of h², by what they disagree.

    Parameters
    ----------
    h, way, a0, a1
        As of :func:`chord_error`.
    dv
        Change of the velocity over the step, m/s.
    """
    x = h * (a0[0] + a1[0]) - 2.0 * dv[0]
    y = h * (a0[1] + a1[1]) - 2.0 * dv[1]
    z = h * (a0[2] + a1[2]) - 2.0 * dv[2]
    return h * (1.0 / 12.0) * np.sqrt(x * x + y * y + z * z) / way


def path_factor(path: Scalar, tolerance: float) -> Scalar:
    """Length of the next step over that of this one, as the error of the path would have it."""
    return SAFETY * np.sqrt(tolerance / (path + 1e-300))


def step_factor(third: bool, difference: float, by_path: float, tolerance: float) -> float:
    """Length of the next step over that of this one.

    Parameters
    ----------
    third
        Whether the step has gone to order 3.
    difference
        δ₂ if so.
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
    """Size of the steps that follow a step, s.

    Parameters
    ----------
    h
        The step, s.
    size
        What it was meant to be, s: at least h, as it may have been cut short.
    factor
        :func:`step_factor`.
    rejected
        Whether the step before it was not taken.
    """
    allowed = h * factor
    # A step cut short says nothing against the size before it, unless by its error.
    if factor >= MOST:
        allowed = max(allowed, size)
    # What was too long a moment ago is not tried again at once.
    return min(allowed, size if rejected else GROWTH * size)
