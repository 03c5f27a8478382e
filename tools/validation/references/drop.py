"""Stress of a steady drop to second order in its deformation, by perturbation of the sphere.

The drop is in uniaxial extension of rate 1, E = diag(−½, −½, 1); radius and viscosity of the fluid are 1. The
surface is r = 1 + Ca f P₂(cos θ) + …; the flow of each order is a sum of the regular or decaying solutions
u = (R Pₙ, T dPₙ/dθ), R = rˢ, T = (s + 2) rˢ/(n(n + 1)) of Stokes' equations with n = 2 and 4.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.polynomial import legendre

from validation.references import Floats

_X, _WEIGHTS = legendre.leggauss(16)


class Second(NamedTuple):
    """Stress of a drop over μ_f V, and its shape."""

    first: float
    """Coefficient of E."""
    second: float
    """Coefficient of Ca dev(E·E), divided by the shear rate in which Ca is taken; E·E = ½ E + I/2."""
    shape: float
    """f."""


def steady_stress(ratio: float) -> Second:
    """Return the stress of drops with λ = ``ratio``, from the Stokeslets of degree 2 of both orders."""
    outside = [_Solution(2, s, 1.0) for s in (1, -2, -4)]
    inside = [_Solution(2, s, ratio) for s in (1, 3)]
    columns = [_conditions(*m.at_sphere(), 0, (2,)) for m in outside]
    columns += [_conditions(*m.at_sphere(), 1, (2,)) for m in inside]
    c = np.asarray(np.linalg.solve(np.stack(columns[1:], axis=1), -columns[0]), dtype=np.float64)
    of_flow = _sum(np.array([1.0, *c[:2]]), outside), _sum(c[2:], inside)
    # The jump of σ_rr balances the change of curvature, (n − 1)(n + 2) = 4 times the amplitude.
    f = _part(of_flow[0].normal - of_flow[1].normal, 2, 0) / 4.0
    P, dP, _ = _legendre(2)
    h, slope = f * P, f * dP
    right = np.zeros(8)
    for side, m in enumerate(of_flow):
        across = h * m.du[0] - slope * m.u[1]
        along = h * m.du[1] + slope * m.u[0]
        shear = h * m.dshear + slope * (m.normal - m.lateral)
        right -= _conditions(across, along, shear, side, (2, 4))
    outside = [_Solution(n, s, 1.0) for n, s in ((2, -2), (2, -4), (4, -4), (4, -6))]
    inside = [_Solution(n, s, ratio) for n, s in ((2, 1), (2, 3), (4, 3), (4, 5))]
    columns = [_conditions(*m.at_sphere(), 0, (2, 4)) for m in outside]
    columns += [_conditions(*m.at_sphere(), 1, (2, 4)) for m in inside]
    c2 = np.linalg.solve(np.stack(columns, axis=1), right)
    # A stresslet S V E has the radial velocity −½ S P₂/r².
    return Second(-2.0 * float(c[0]), -4.0 * float(c2[0]), float(f))


class _Flow(NamedTuple):
    """Values on the sphere, at the points of the quadrature."""

    u: Floats
    du: Floats
    """Derivative by r."""
    shear: Floats
    dshear: Floats
    normal: Floats
    lateral: Floats
    """Components rr and θθ of the stress."""


class _Solution:
    """One of the solutions, for unit amplitude."""

    def __init__(self, n: int, s: int, mu: float) -> None:
        P, dP, ddP = _legendre(n)
        k = (s + 2.0) / (n * (n + 1.0))
        pressure = 0.0 if s == 1 else ((s + 1.0) * (s + 2.0) - n * (n + 1.0)) / (s - 1.0)
        u = np.stack([P, k * dP])
        shear = mu * ((s - 1.0) * k + 1.0) * dP
        normal = mu * (2.0 * s - pressure) * P
        lateral = mu * (2.0 * (k * ddP + P) - pressure * P)
        self.flow = _Flow(u, s * u, shear, (s - 1.0) * shear, normal, lateral)

    def at_sphere(self) -> tuple[Floats, Floats, Floats]:
        """Return normal and tangential velocity and shear stress."""
        return self.flow.u[0], self.flow.u[1], self.flow.shear


def _sum(c: Floats, solutions: Sequence[_Solution]) -> _Flow:
    flows = [m.flow for m in solutions]
    return _Flow(*(sum(a * v for a, v in zip(c, values, strict=True)) for values in zip(*flows, strict=True)))


def _legendre(n: int) -> tuple[Floats, Floats, Floats]:
    """Return Pₙ(cos θ) and its first and second derivative by θ."""
    c = np.eye(n + 1)[n]
    p, d, dd = (np.asarray(legendre.legval(_X, legendre.legder(c, k)), dtype=np.float64) for k in range(3))
    return p, np.asarray(-np.sqrt(1.0 - _X**2) * d), np.asarray((1.0 - _X**2) * dd - _X * d)


def _part(values: Floats, n: int, derivative: int) -> float:
    """Return the coefficient of Pₙ, or of dPₙ/dθ."""
    f = _legendre(n)[derivative]
    return float((_WEIGHTS * values * f).sum() / (_WEIGHTS * f * f).sum())


def _conditions(across: Floats, along: Floats, shear: Floats, side: int, degrees: Sequence[int]) -> Floats:
    """Return the parts of a flow outside (0) or inside (1) in the conditions at the surface.

    No flow through it from either side, the same tangential velocity and shear stress on both.
    """
    sign = 1.0 - 2.0 * side
    rows = []
    for n in degrees:
        normal = _part(across, n, 0)
        rows += [normal * (1 - side), normal * side, sign * _part(along, n, 1), sign * _part(shear, n, 1)]
    return np.array(rows)
