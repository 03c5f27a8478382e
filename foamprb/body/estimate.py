"""Orders of magnitude of all effects on a soft sphere in a shear flow, near a wall or not."""

from __future__ import annotations

from math import cbrt, exp, inf, pi, sqrt
from typing import NamedTuple

from foamprb.body.brownian import BOLTZMANN
from foamprb.body.lift import PLANE_CHANNEL, duct_coefficient, hinges
from foamprb.body.lift import lift_coefficient as slip_lift_coefficient


class SoftSphere(NamedTuple):
    """A soft sphere."""

    d: float
    """Diameter, m."""
    rho: float
    """kg/m³."""
    mu: float
    """Shear modulus, Pa; :func:`shear_modulus` gives it from a capillary number."""


class Surroundings(NamedTuple):
    """Fluid and flow at the sphere."""

    mu: float
    """Viscosity, Pa s."""
    rho: float
    """kg/m³."""
    shear_rate: float
    """1/s."""
    wall_distance: float = inf
    """Distance of the sphere's centre from the nearest wall, m."""
    temperature: float = 293.15
    """K."""
    gravity: float = 9.81
    """m/s²."""


class Estimate(NamedTuple):
    """Result of :func:`estimate`."""

    capillary_number: float
    """Ca = μ_f γ̇/μ_s: strain of the shape, Taylor's D = 5/4 Ca where small."""
    reynolds_number: float
    """Re_p = ρ_f γ̇ d²/μ_f, far below 1 in creeping flow."""
    stokes_number: float
    """γ̇ τ_p with the relaxation time of the velocity τ_p = ρ_s d²/(18 μ_f)."""
    peclet_number: float
    """γ̇ R²/D, shear over diffusion. Below 1 Brownian motion determines the orientation."""
    settling_speed: float
    """w = (ρ_s − ρ_f) g d²/(18 μ_f), m/s, negative upwards."""
    settling_reynolds_number: float
    """ρ_f |w| d/μ_f, far below 1 where drag is that of Stokes flow."""
    lift_speed: float
    """Lift by the wall, k γ̇ R³/h², m/s; 0 without a wall."""
    diffusion_coefficient: float
    """D = k_B T/(3π μ_f d), m²/s."""
    thermal_strain: float
    """√⟨ε:ε⟩ = √(5 k_B T/(2 μ_s V)) of the rest shape."""
    settling_length: float
    """Distance from rest in the residence time, |w| (t − τ_p (1 − e^{−t/τ_p})), m, like the next two."""
    lift_length: float
    """(h³ + 3 k γ̇ R³ t)^{1/3} − h."""
    diffusion_length: float
    """√(2 D t)."""
    lift_height: float
    """Height h at which lift balances weight, √(k γ̇ R³/v_settling), m; infinite without weight."""


class AcrossForces(NamedTuple):
    """Forces across the flow, N, positive away from the wall; see :func:`across_forces`."""

    duct_lift: float
    """By inertia of the fluid, C ρ_f γ̇_w² R⁴ of a rigid sphere in a plane channel; 0 without a channel."""
    wall_lift: float
    """6π μ_f R times the speed of lift by the wall."""
    slip_lift: float
    """Saffman's and Mei's, if the sphere settles along the flow; without sign."""
    weight: float
    """Weight less buoyancy; without sign."""


def shear_modulus(capillary_number: float, mu_f: float, shear_rate: float) -> float:
    """Return μ_s = μ_f γ̇/Ca, Pa."""
    return mu_f * shear_rate / capillary_number


def lift_coefficient(capillary_number: float) -> float:
    """Return k = v h²/(γ̇ R³) of the lift on a soft sphere far above a wall in shear.

    A fit to the steady stresslet of a neo-Hooke body (:func:`foamprb.body.wall.stresslet_velocity`), with
    225/224 Ca for small Ca; within 0.3 % for Ca ≤ 1 and within 7 % up to 2.
    """
    square = capillary_number * capillary_number
    return 225.0 / 224.0 * capillary_number * (1.0 + 0.72 * square) / (1.0 + 1.52 * square)


def estimate(sphere: SoftSphere, around: Surroundings, residence_time: float) -> Estimate:
    """Return dimensionless numbers, speeds and distances of a soft sphere for a residence time, s.

    They hold for a single round body. The lift is that of a point stresslet, too large by a relative 5/3
    (R/h)². The numbers show which models are relevant; they do not replace a run.
    """
    R, rate = 0.5 * sphere.d, around.shear_rate
    tau = sphere.rho * sphere.d**2 / (18.0 * around.mu)
    Ca = around.mu * rate / sphere.mu
    D = BOLTZMANN * around.temperature / (3.0 * pi * around.mu * sphere.d)
    settling = (1.0 - around.rho / sphere.rho) * around.gravity * tau
    lift = lift_coefficient(Ca) * rate * R**3
    h = around.wall_distance
    return Estimate(
        capillary_number=Ca,
        reynolds_number=around.rho * rate * sphere.d**2 / around.mu,
        stokes_number=rate * tau,
        peclet_number=rate * R * R / D,
        settling_speed=settling,
        settling_reynolds_number=around.rho * abs(settling) * sphere.d / around.mu,
        lift_speed=lift / h**2,
        diffusion_coefficient=D,
        thermal_strain=sqrt(2.5 * BOLTZMANN * around.temperature / (sphere.mu * 4.0 / 3.0 * pi * R**3)),
        settling_length=abs(settling) * _delayed(residence_time, tau),
        lift_length=_rise(h, 3.0 * lift * residence_time),
        diffusion_length=sqrt(2.0 * D * residence_time),
        lift_height=sqrt(lift / abs(settling)) if settling else inf,
    )


def across_forces(sphere: SoftSphere, around: Surroundings, width: float = inf) -> AcrossForces:
    """Return the forces across the flow on a sphere.

    Parameters
    ----------
    sphere, around
        The sphere, and the fluid and flow at it.
    width
        Distance of the walls of a plane channel with Poiseuille flow, m, more than twice that of the sphere
        from the nearer wall.
    """
    R, e = 0.5 * sphere.d, estimate(sphere, around, 0.0)
    w, duct = abs(e.settling_speed), 0.0
    if width < inf:
        s = 1.0 - 2.0 * around.wall_distance / width
        at_wall = around.shear_rate / s
        duct = -float(duct_coefficient(s, hinges(PLANE_CHANNEL))) * around.rho * (at_wall * R * R) ** 2
    slip = slip_lift_coefficient(w, around.shear_rate, R, around.rho, around.mu) * around.shear_rate * w
    drag = 6.0 * pi * around.mu * R
    return AcrossForces(duct, drag * e.lift_speed, float(slip), drag * w)


def _delayed(t: float, tau: float) -> float:
    """Return t − τ (1 − e^{−t/τ}), without cancellation."""
    s = t / tau
    return t - tau * (1.0 - exp(-s)) if s > 1e-3 else t * s * (0.5 - s / 6.0)


def _rise(h: float, cubes: float) -> float:
    """Return (h³ + cubes)^{1/3} − h, without cancellation."""
    if h == inf:
        return 0.0
    top = cbrt(h**3 + cubes)
    return cubes / (top * top + top * h + h * h)
