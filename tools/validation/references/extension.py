"""Steady shapes of a soft sphere in extension, by root finding, and its settling."""

from __future__ import annotations

import numpy as np
from scipy.optimize import root

from validation.references import Floats
from validation.references.ellipsoid import diagonal_response, traction_stress

EXTENSIONS = {
    "uniaxial": np.array([1.0, -0.5, -0.5]),
    "planar": np.array([1.0, -1.0, 0.0]),
    "biaxial": np.array([1.0, 1.0, -2.0]),
}
"""Principal rates of deformation in units of the largest positive one."""


def steady_extension(rates: Floats, Ca: float) -> Floats:
    """Return steady semi-axes (3,) of an incompressible neo-Hooke sphere in an extension.

    The body is at rest, d_s = 0, and along each principal axis −p + s̃_aa(d_f) = λ_a²/Ca. The branch that
    starts from the sphere is followed in Ca.

    Parameters
    ----------
    rates
        Principal rates (3,) in units of ε̇, of sum 0.
    Ca
        μ_f ε̇/μ_s.

    Raises
    ------
    ValueError
        If there is no steady shape: the extension pulls harder than the solid can hold.
    """
    logs = np.zeros(2)
    for part in np.linspace(0.0, Ca, 21)[1:]:
        logs = _balanced(rates, float(part), logs)
    return np.asarray(np.exp(np.append(logs, -logs.sum())))


def _balanced(rates: Floats, Ca: float, start: Floats) -> Floats:
    def imbalance(logs: Floats) -> Floats:
        axes = np.exp(np.append(logs, -logs.sum()))
        stress = Ca * diagonal_response(axes) @ rates - axes**2
        return np.asarray(stress[:2] - stress[2])

    solution = root(imbalance, start, tol=1e-14)
    if not np.abs(imbalance(solution.x)).max() < 1e-10:
        raise ValueError(f"no steady shape at Ca = {Ca:g}")
    return np.asarray(solution.x)


def steady_compressible_extension(rates: Floats, Ca: float, poissons_ratio: float) -> Floats:
    """Return :func:`steady_extension` of the quasi-incompressible solid (24) of a Poisson's ratio.

    p̃ is 4 (α₀A + β₀B + γ₀C) with p = 0, so that the volume follows from the balance.
    """
    ratio = 2.0 * poissons_ratio / (1.0 - 2.0 * poissons_ratio)

    def imbalance(logs: Floats) -> Floats:
        axes = np.exp(logs)
        load = np.diag(traction_stress(np.diag(axes), np.diag(rates), np.zeros((3, 3))))
        return np.asarray(Ca * np.prod(axes) * load - (axes**2 - 1.0) - ratio * logs.sum())

    solution = root(imbalance, np.log(steady_extension(rates, Ca)), tol=1e-14)
    if not np.abs(imbalance(solution.x)).max() < 1e-9:
        raise ValueError(f"no steady shape at Ca = {Ca:g}")
    return np.asarray(np.exp(solution.x))


def settling_in_extension(
    K: Floats, mass: float, mu_f: float, rates: Floats, acceleration: Floats, t: float
) -> tuple[Floats, Floats]:
    """Return position and velocity (3,) of a steady body released at the origin of u = diag(rates)·x.

    Along each axis x″ + k x′ − k ε̇ x = a with k = μ_f K/m has the solution
    x = a/(k ε̇) · [(r₁ e^{r₂t} − r₂ e^{r₁t})/(r₁ − r₂) − 1], r² + k r − k ε̇ = 0.

    Parameters
    ----------
    K
        Principal resistances (3,), m, along the axes of the extension.
    mass, mu_f
        kg, Pa s.
    rates
        Principal rates (3,), 1/s.
    acceleration
        Of gravity less buoyancy (3,), m/s².
    """
    k = mu_f * K / mass
    with np.errstate(invalid="ignore", divide="ignore"):
        spread = np.sqrt(k * k + 4.0 * k * rates)
        r1, r2 = 0.5 * (spread - k), -0.5 * (spread + k)
        e1, e2 = np.exp(r1 * t), np.exp(r2 * t)
        x = acceleration / (k * rates) * ((r1 * e2 - r2 * e1) / (r1 - r2) - 1.0)
        v = acceleration / (k * rates) * r1 * r2 * (e2 - e1) / (r1 - r2)
    still = rates == 0.0
    decay = np.exp(-k * t)
    x = np.where(still, acceleration / k * (t - (1.0 - decay) / k), x)
    v = np.where(still, acceleration / k * (1.0 - decay), v)
    return x, v
