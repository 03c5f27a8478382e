"""Morphology equation of drops and of model cells, by a general integrator of stiff equations."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp

from validation.case import Floats


def shapes(
    gradient: Floats,
    coefficients: tuple[float, float, float],
    times: Floats,
    start: Floats | None = None,
) -> Floats:
    """Return S at times, (n, 3, 3).

    Parameters
    ----------
    gradient, coefficients
        Constant ∂u_i/∂x_j, and (f₁, f₂, f₃).
    start
        S at time 0; a sphere by default.
    """
    E, W = 0.5 * (gradient + gradient.T), 0.5 * (gradient - gradient.T)
    f1, f2, f3 = coefficients

    def rate(_: float, s: Floats) -> Floats:
        S = s.reshape(3, 3)
        second = 0.5 * (np.trace(S) ** 2 - np.trace(S @ S))
        recovery = S - 3.0 * np.linalg.det(S) / second * np.eye(3)
        return np.ravel(f3 * (W @ S - S @ W) - f1 * recovery + f2 * (E @ S + S @ E))

    F0 = np.eye(3) if start is None else start
    solution = solve_ivp(
        rate, (0.0, times[-1]), F0.ravel(), method="LSODA", t_eval=times, rtol=1e-10, atol=1e-12
    )
    return np.asarray(solution.y.T.reshape(-1, 3, 3))


def of_drop(ratio: float, Ca: float) -> tuple[float, float, float]:
    """Return (f₁, f₂, f₃) of Maffettone and Minale (1998), in units of σ/(μ_f R)."""
    f1 = 40.0 * (ratio + 1.0) / ((2.0 * ratio + 3.0) * (19.0 * ratio + 16.0))
    return f1, 5.0 / (2.0 * ratio + 3.0) + 3.0 * Ca**2 / (2.0 + 6.0 * Ca**2), 1.0


def taylor(S: Floats) -> Floats:
    """Return D of each S, (n,)."""
    axes = np.sqrt(np.linalg.eigvalsh(S))
    return np.asarray((axes[:, 2] - axes[:, 0]) / (axes[:, 2] + axes[:, 0]))


def angle(S: Floats) -> Floats:
    """Return the angle of the longest axis to x in the plane of shear, degrees, (n,)."""
    long = np.linalg.eigh(S)[1][:, :, 2]
    return np.asarray(np.degrees(np.arctan(long[:, 1] / long[:, 0])))
