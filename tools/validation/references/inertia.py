"""Spheres with all their inertia, rigid and soft, in a flow: the equations of motion by scipy's solvers.

Independent of foamprb's own code. Vectors are arrays (3,), tensors (3, 3).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from validation.references import Floats
from validation.references.ellipsoid import prolate_resistances, resistances, traction_stress

FlowAt = Callable[[Floats], tuple[Floats, Floats]]
"""u (3,), m/s, and ∂u_i/∂x_j (3, 3), 1/s, at a point (3,), m."""


class Surroundings(NamedTuple):
    """The fluid's viscosity, Pa s, and density, kg/m³; gravity (3,), m/s²; and the flow."""

    mu: float
    rho: float
    gravity: Floats
    flow: FlowAt


def poiseuille(radius: float, mean_velocity: float) -> FlowAt:
    """Return the flow u₁ = 2U (1 − r²/a²) in a pipe along x₁."""

    def flow(x: Floats) -> tuple[Floats, Floats]:
        k = 2.0 * mean_velocity / radius**2
        gradient = np.zeros((3, 3))
        gradient[0, 1:] = -2.0 * k * x[1:]
        return np.array([2.0 * mean_velocity - k * float(x[1:] @ x[1:]), 0.0, 0.0]), gradient

    return flow


def uniform_gradient(gradient: Floats) -> FlowAt:
    """Return the flow u = l·x."""
    return lambda x: (gradient @ x, gradient)


def relaxation_time(R: float, rho: float, mu_f: float) -> float:
    """Return ρ_s R²/(15 μ_f), s, the relaxation time of the spin: m (2/5) R² over 8π μ_f R³."""
    return rho * R * R / (15.0 * mu_f)


class RigidHistory(NamedTuple):
    """A rigid sphere at n times."""

    t: Floats
    """(n,), s."""
    x: Floats
    """(n, 3), m."""
    v: Floats
    """(n, 3), m/s."""
    angle: Floats
    """(n,) turned about the third axis, rad."""
    spin: Floats
    """(n,) angular velocity about the third axis, 1/s."""
    torque: Floats
    """(n,) torque of the fluid about the third axis, 8π μ_f R³ (½ rot u − ω), N m."""


def rigid_sphere(
    R: float, rho: float, around: Surroundings, start: Floats, times: Floats, floor: float | None = None
) -> RigidHistory:
    """Solve for a rigid sphere released at rest: Stokes drag, weight less buoyancy, Stokes torque.

    m dv/dt = 6π μ_f R (u − v) + (ρ_s − ρ_f) vol g, (2/5) m R² dω/dt = 8π μ_f R³ (½ rot u − ω), in a plane.

    Parameters
    ----------
    start
        Position of release (3,), m.
    times
        Rising, from 0, s.
    floor
        Height x₂, m, at which its centre lands; the history ends there, with the landing as its last time.
    """
    drag_rate = 9.0 * around.mu / (2.0 * rho * R * R)
    spin_rate = 1.0 / relaxation_time(R, rho, around.mu)
    weight = (1.0 - around.rho / rho) * around.gravity

    def vorticity(x: Floats) -> float:
        gradient = around.flow(x)[1]
        return float(0.5 * (gradient[1, 0] - gradient[0, 1]))

    def rate(_t: float, y: Floats) -> Floats:
        u, _ = around.flow(y[:3])
        a = drag_rate * (u - y[3:6]) + weight
        return np.concatenate([y[3:6], a, [y[7], spin_rate * (vorticity(y[:3]) - y[7])]])

    y0 = np.concatenate([start, np.zeros(5)])
    t, y = _solve(rate, y0, times, floor, "DOP853", 1e-11, np.full(8, 1e-15))
    x, spin = y[:, :3], y[:, 7]
    inertia = 8.0 * np.pi / 15.0 * rho * R**5
    torque = inertia * spin_rate * (np.array([vorticity(p) for p in x]) - spin)
    return RigidHistory(t, x, y[:, 3:6], y[:, 6], spin, torque)


def _solve(
    rate: Callable[[float, Floats], Floats],
    y0: Floats,
    times: Floats,
    floor: float | None,
    method: Literal["DOP853", "BDF"],
    rtol: float,
    atol: Floats,
) -> tuple[Floats, Floats]:
    """Return times (n,) and states (n, m), up to the landing if there is a floor."""

    def height(_t: float, y: Floats) -> float:
        return float(y[1] - (-np.inf if floor is None else floor))

    event: Any = height
    event.terminal = True
    # The implicit method's numerical Jacobian overflows, harmlessly, where a component acts on nothing.
    with np.errstate(over="ignore"):
        answer: Any = solve_ivp(
            rate, (0.0, float(times[-1])), y0, method, times, events=None if floor is None else event,
            rtol=rtol, atol=atol,
        )  # fmt: skip
    t, y = answer.t, answer.y.T
    if floor is not None and len(answer.t_events[0]):
        t = np.append(t, answer.t_events[0][0])
        y = np.vstack([y, answer.y_events[0][0]])
    return np.asarray(t), np.asarray(y)


class SoftHistory(NamedTuple):
    """A soft body at n times."""

    t: Floats
    """(n,), s."""
    x: Floats
    """(n, 3), m."""
    v: Floats
    """(n, 3), m/s."""
    F: Floats
    """(n, 3, 3)."""
    A: Floats
    """(n, 3, 3) dF/dt, 1/s."""


DRAGS = {"oberbeck": resistances, "brennerProlate": prolate_resistances}
"""Principal resistances by the name of the drag law."""


def soft_sphere(
    R: float,
    rho: float,
    mu: float,
    poissons_ratio: float,
    around: Surroundings,
    start: Floats,
    times: Floats,
    drag: str = "oberbeck",
    floor: float | None = None,
    tolerance: float = 1e-7,
) -> SoftHistory:
    """Solve implicitly for a soft sphere with inertia, released at rest: equations of motion (33).

    Parameters
    ----------
    R, rho, mu, poissons_ratio
        Radius (m), density (kg/m³), shear modulus (Pa) and Poisson's ratio.
    around, start, times, floor
        As for :func:`rigid_sphere`.
    drag
        A name in :data:`DRAGS`.
    tolerance
        Relative, of the solver.
    """
    factor = 5.0 / (rho * R * R)
    lame = 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio)
    mass_per_length = 4.0 / 3.0 * np.pi * R * R * rho
    resistance = DRAGS[drag]
    unit = relaxation_time(R, rho, around.mu)

    def rate(_t: float, y: Floats) -> Floats:
        x, v = y[:3], y[3:6] / unit
        F, A = y[6:15].reshape(3, 3), y[15:].reshape(3, 3) / unit
        u, l_f = around.flow(x * R)
        inverse, J = np.linalg.inv(F), float(np.linalg.det(F))
        U, axes, _ = np.linalg.svd(F)
        K = U @ np.diag(resistance(axes)) @ U.T
        dv = around.mu / mass_per_length * K @ (u / R - v) + (1.0 - J * around.rho / rho) * around.gravity / R
        load = around.mu * traction_stress(F, l_f, A @ inverse)
        P = mu * (F - inverse.T) + lame * np.log(J) * inverse.T
        dA = factor * (J * load @ inverse.T - P)
        return np.concatenate([v, unit * dv, A.ravel(), unit * dA.ravel()])

    y0 = np.concatenate([start / R, np.zeros(3), np.eye(3).ravel(), np.zeros(9)])
    bottom = None if floor is None else floor / R
    t, y = _solve(rate, y0, times, bottom, "BDF", tolerance, np.full(24, 0.1 * tolerance))
    shape = (len(t), 3, 3)
    return SoftHistory(
        t, y[:, :3] * R, y[:, 3:6] * R / unit, y[:, 6:15].reshape(shape), y[:, 15:].reshape(shape) / unit
    )
