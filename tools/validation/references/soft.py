"""Soft ellipsoids without inertia by scipy: independent of foamprb's own code.

A body at rest is an ellipsoid, its solid a Kelvin–Voigt one with neo-Hooke elasticity, its surface may have a
tension. Lengths are in radii of the sphere of the same volume, rates in units of γ̇, stresses of μ_f γ̇.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from validation.references import Floats
from validation.references.ellipsoid import Integrals, diagonal_response, integrals
from validation.references.roscoe import roscoe, roscoe_frequency
from validation.references.shear import SHEAR

IDENTITY = np.eye(3)


class Body(NamedTuple):
    """What a soft body is made of."""

    Ca: float
    """μ_f γ̇/μ_s."""
    F0: Floats = IDENTITY
    """Symmetric, det F₀ = 1: makes the shape at rest of the unit sphere, (3, 3)."""
    viscosity_ratio: float = 0.0
    """η_s/μ_f."""
    tension: float = 0.0
    """γ/(R μ_f γ̇)."""


def stretched(ratios: tuple[float, float, float]) -> Floats:
    """Return F₀ of an ellipsoid of unit volume ratio with axes along the coordinate axes, (3, 3)."""
    a = np.array(ratios, dtype=float)
    return np.diag(a / np.cbrt(a.prod()))


def semi_axes(F: Floats) -> Floats:
    """Return semi-axes (..., 3), in falling order, of the images of the sphere under F (..., 3, 3)."""
    return np.asarray(np.linalg.svd(F, compute_uv=False), dtype=np.float64)


def disturbance(axes: Floats, g: Integrals) -> Floats:
    """Return s̃_ij = T_ijkl l_kl of (B.5) to (B.8) in the particle frame, for unit viscosity, (3, 3, 3, 3).

    l is the velocity gradient of the fluid relative to the body.
    """
    T = np.zeros((3, 3, 3, 3))
    for a in range(3):
        T[a, a, range(3), range(3)] = diagonal_response(axes)[a]
    volume = float(np.prod(axes))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        n = 2.0 * g.ring[k] * (axes[i] ** 2 * g.first[i] + axes[j] ** 2 * g.first[j])
        # d_ji and w_ji are (l_ji ± l_ij)/2.
        for row, column, d, w in (
            (i, j, g.first[i], -(axes[j] ** 2) * g.ring[k]),
            (j, i, g.first[j], axes[i] ** 2 * g.ring[k]),
        ):
            T[row, column, j, i] = 4.0 / (volume * n) * (d + w)
            T[row, column, i, j] = 4.0 / (volume * n) * (d - w)
    return T


_COSINES, _WEIGHTS = np.polynomial.legendre.leggauss(40)
_ANGLES = 2.0 * np.pi * np.arange(48) / 48


def _unit_sphere() -> tuple[Floats, Floats]:
    """Return points (m, 3) and weights (m,), of sum 4π, of a quadrature over the unit sphere."""
    z, phi = np.meshgrid(_COSINES, _ANGLES, indexing="ij")
    r = np.sqrt(1.0 - z**2)
    points = np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=-1).reshape(-1, 3)
    return points, np.repeat(_WEIGHTS, len(_ANGLES)) * 2.0 * np.pi / len(_ANGLES)


_POINTS, _SOLID_ANGLES = _unit_sphere()


def surface_stress(F: Floats) -> Floats:
    """Return (R/vol) ∫(I − n n) dA over the image of the unit sphere under F, (3, 3).

    Times γ/R it is the mean Cauchy stress that a tension γ of the surface holds in the body (Batchelor 1970);
    n dA = cof F·ξ dω, by Gauss–Legendre and trapezoidal quadrature.
    """
    normals = _POINTS @ (np.linalg.inv(F) * np.linalg.det(F))
    areas = np.linalg.norm(normals, axis=1)
    weights = _SOLID_ANGLES / areas
    total = float(_SOLID_ANGLES @ areas) * IDENTITY - (normals.T * weights) @ normals
    return np.asarray(total / (4.0 / 3.0 * np.pi * np.linalg.det(F)))


def velocity_gradient(F: Floats, l_f: Floats, body: Body) -> Floats:
    """Return the velocity gradient l_s/γ̇ of the body, (3, 3).

    The nine balances s̃(l_f − l_s) + 2 (1 − η_s/μ_f) d_s − p I = σ, torque included, and tr l_s = 0 are ten
    linear equations for l_s and p.

    Parameters
    ----------
    F
        Deformation gradient from the unit sphere, det F = 1.
    l_f
        Velocity gradient of the fluid, of no trace, (3, 3).
    """
    U, axes, _ = np.linalg.svd(F)
    T = disturbance(axes, integrals(axes)).reshape(9, 9)
    keep = 1.0 - body.viscosity_ratio
    swap = np.einsum("il,jk->ijkl", IDENTITY, IDENTITY).reshape(9, 9)
    system = np.zeros((10, 10))
    system[:9, :9] = keep * (np.eye(9) + swap) - T
    system[:9, 9] = -IDENTITY.ravel()
    system[9, :9] = IDENTITY.ravel()
    elastic = F @ np.linalg.inv(body.F0)
    stress = elastic @ elastic.T / body.Ca
    if body.tension:
        stress = stress + body.tension * surface_stress(F)
    load = np.append((U.T @ stress @ U).ravel() - T @ (U.T @ l_f @ U).ravel(), 0.0)
    return np.asarray(U @ np.linalg.solve(system, load)[:9].reshape(3, 3) @ U.T)


def deformation(
    l_f: Floats, body: Body, times: Floats, F: Floats | None = None, tolerance: float = 1e-10
) -> Floats:
    """Return F (n, 3, 3) at rising times in units of 1/γ̇, from F, or rest, at time 0."""

    def rate(_t: float, y: Floats) -> Floats:
        G = y.reshape(3, 3)
        return (velocity_gradient(G, l_f, body) @ G).ravel()

    start = body.F0 if F is None else F
    answer = solve_ivp(
        rate, (0.0, float(times[-1])), start.ravel(), "DOP853", times, rtol=tolerance, atol=tolerance
    )
    return np.asarray(answer.y.T.reshape(-1, 3, 3))


def steady(l_f: Floats, body: Body, relaxations: float = 25.0) -> Floats:
    """Return the deformation gradient of a steady body, the end of a long transient."""
    stiffness = 1.0 / body.Ca + 0.8 * body.tension
    end = relaxations * (1.5 + body.viscosity_ratio) / stiffness
    return np.asarray(deformation(l_f, body, np.array([end]))[-1])


# --- The motions of a prolate body in shear -----------------------------------------------------------------


def in_plane(F: Floats) -> tuple[Floats, Floats]:
    """Return b₁₁ − b₂₂ and 2 b₁₂ of F (..., 3, 3): a vector at 2θ, θ the angle to the flow."""
    b = F[..., :2, :] @ np.swapaxes(F[..., :2, :], -1, -2)
    return b[..., 0, 0] - b[..., 1, 1], 2.0 * b[..., 0, 1]


class Passages(NamedTuple):
    """Of the curve that :func:`in_plane` draws, once the start is forgotten."""

    nearest: float
    """Least distance from the origin, negative where the curve goes round it clockwise."""
    lowest: float
    """The lowest 2 b₁₂."""


def signed_distance(at: tuple[float, float], slope: tuple[float, float]) -> float:
    """Return the distance from the origin of the line through a point, negative if it passes clockwise."""
    return float((at[0] * slope[1] - at[1] * slope[0]) / np.hypot(*slope))


def passages(Ca: float, ratio: float, end: float = 44.0) -> Passages:
    """Follow a prolate body of the given aspect ratio, released along the flow, to the time ``end``."""
    body = Body(Ca, stretched((ratio, 1.0, 1.0)))

    def rate(_t: float, y: Floats) -> Floats:
        F = y.reshape(3, 3)
        return (velocity_gradient(F, SHEAR, body) @ F).ravel()

    def slope(y: Floats) -> tuple[float, float]:
        F = y.reshape(3, 3)
        d = velocity_gradient(F, SHEAR, body) @ F @ F.T
        return 2.0 * float(d[0, 0] - d[1, 1]), 2.0 * float(d[0, 1] + d[1, 0])

    def place(y: Floats) -> tuple[float, float]:
        x, z = in_plane(y.reshape(3, 3))
        return float(x), float(z)

    def receding(_t: float, y: Floats) -> float:
        return float(np.dot(place(y), slope(y)))

    def rising(_t: float, y: Floats) -> float:
        return slope(y)[1]

    near: Any = receding
    bottom: Any = rising
    near.direction = bottom.direction = 1.0
    answer: Any = solve_ivp(
        rate, (0.0, end), body.F0.ravel(), "DOP853", events=(near, bottom), rtol=1e-8, atol=1e-9
    )
    late = [y[t > 0.5 * end] for t, y in zip(answer.t_events, answer.y_events, strict=True)]
    distances = [signed_distance(place(y), slope(y)) for y in late[0]]
    return Passages(min(distances, key=abs), min(place(y)[1] for y in late[1]))


def transition(of: Callable[[Passages], float], ratio: float, low: float, high: float) -> float:
    """Return the Ca between two at which a passage is through zero; NaN if there is none."""
    ends = of(passages(low, ratio)), of(passages(high, ratio))
    if not ends[0] * ends[1] < 0.0:
        return np.nan
    return float(brentq(lambda Ca: of(passages(Ca, ratio)), low, high, xtol=1e-5))


# --- Stress in a suspension ---------------------------------------------------------------------------------


def particle_stress(F: Floats, l_f: Floats, body: Body) -> Floats:
    """Return the stresslet over μ_f γ̇ V on the solid's side: dev σ + 2 (η_s/μ_f − 1) d_s, (3, 3).

    Batchelor (1970): ∫(σ·n x − μ_f (u n + n u)) dA over the surface of the particle. In a body of uniform
    stress without inertia the first term is its own stress, and u is that of the solid.
    """
    elastic = F @ np.linalg.inv(body.F0)
    l_s = velocity_gradient(F, l_f, body)
    stress = elastic @ elastic.T / body.Ca + (body.viscosity_ratio - 1.0) * (l_s + l_s.T)
    if body.tension:
        stress = stress + body.tension * surface_stress(F)
    return np.asarray(stress - np.trace(stress) / 3.0 * IDENTITY)


class Rheology(NamedTuple):
    """Of a dilute suspension in simple shear, per volume fraction φ."""

    viscosity: float
    """Intrinsic viscosity (η − μ_f)/(μ_f φ)."""
    N1: float
    """(σ₁₁ − σ₂₂)/(μ_f γ̇ φ)."""
    N2: float
    """(σ₂₂ − σ₃₃)/(μ_f γ̇ φ), 3 along the vorticity."""


def rheology(S: Floats) -> Rheology:
    """Return the contribution of a stresslet over μ_f γ̇ and the volume, (3, 3), to the stress."""
    return Rheology(float(S[0, 1]), float(S[0, 0] - S[1, 1]), float(S[1, 1] - S[2, 2]))


def roscoe_rheology(Ca: float, viscosity_ratio: float = 0.0) -> Rheology:
    """Return steady suspension of viscoelastic spheres, from Roscoe's (1967) algebraic solution alone.

    His ellipsoid of semi-axes a₁, a₂, a₃ at the angle θ carries the stress of its stretch, a_i²/Ca, and its
    material goes round with l₁₂ = ν a₁/a₂, l₂₁ = −ν a₂/a₁ in its axes.
    """

    def miss(a: float) -> float:
        return 1.0 / roscoe(a, viscosity_ratio).Ca - 1.0 / Ca

    ellipsoid = roscoe(float(brentq(miss, 1.0 + 1e-4 * Ca, 6.0, xtol=1e-14)), viscosity_ratio)
    a1, a2, _ = ellipsoid.axes
    nu = roscoe_frequency(a1, a2, ellipsoid.angle)
    S = np.diag(ellipsoid.axes**2) / Ca
    S[0, 1] = S[1, 0] = (viscosity_ratio - 1.0) * nu * (a1 / a2 - a2 / a1)
    c, s = np.cos(np.radians(ellipsoid.angle)), np.sin(np.radians(ellipsoid.angle))
    turn = np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])
    return rheology(turn @ S @ turn.T)
