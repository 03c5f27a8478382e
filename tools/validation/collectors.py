"""Rigid spheres that a Stokes flow carries onto a cylinder or a sphere: efficiency by interception."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import quad

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import NO_PLANES, Patch, Planes
from validation.case import Outcome, Row
from validation.references.near_wall import sphere_across_wall, sphere_along_wall

RADIUS, SPEED, SOLIDITY = 1e-4, 1e-4, 0.02
"""m and m/s; the cylinder's share of its cell."""
KU = -0.5 * math.log(SOLIDITY) - 0.75 + SOLIDITY - 0.25 * SOLIDITY**2
LEAST_GAP, SMALL = 0.01, 1e-3
_ZERO = (0.0, 0.0, 0.0)
FLUX: dict[str, tuple[Callable[[Any], Any], str]] = {
    "cylinder": (
        lambda r: (
            (r * (2.0 * np.log(r) - 1.0 + SOLIDITY - 0.5 * SOLIDITY * r * r) + (1.0 - 0.5 * SOLIDITY) / r)
            / (2.0 * KU)
        ),
        "Kuwabara (1959)",
    ),
    "sphere": (lambda r: r * r - 1.5 * r + 0.5 / r, "Stokes' flow"),
}
"""Flux between the axis and the side of the collector at r radii, over that through its cross-section."""


def interception(quick: bool) -> Outcome:
    """Interception by a cylinder and a sphere in Stokes flow."""
    rows = []
    for name, (flux, source) in FLUX.items():
        for size in (0.01,) if quick else (0.01, 0.1):
            exact = float(flux(1.0 + size))
            title = f"{name}, sphere of {size:g} of its radius: efficiency"
            ours, half = _efficiency(name, size, exact, ())
            rows.append(Row(title, ours, exact, f"interception, {source}", 5e-3, True, our_error=half))
        if quick:
            continue
        exact = _hindered_share() * float(flux(1.0 + SMALL))
        ours, half = _efficiency(name, SMALL, exact, (WallLift(leastGap=LEAST_GAP),))
        title = f"{name}, sphere of {SMALL:g}, wallLift: efficiency"
        source = "exact solutions of a sphere at a plane wall, integrated along the path"
        rows.append(Row(title, ours, exact, source, 0.05, True, our_error=half))
    return Outcome(rows, [], [_REMARK])


_REMARK = (
    "Without attraction the lubrication film keeps spheres from a smooth collector: the efficiency with "
    "wallLift is that of spheres which touch at a gap of leastGap, 0.01 radii."
)


def _hindered_share() -> float:
    """Return by how much walls reduce the efficiency of a collector much larger than the spheres.

    With u_t = τ h and u_n = −½ (rτ)' h²/r over the wall, h² r τ changes along a path as exp(−2 ∫ (U/R − 1)
    dh/h), U and R the speeds of a sphere in contact with neither force nor torque over those of the flow.
    """
    least = 1.0 + LEAST_GAP

    def lag(h: float) -> float:
        return (sphere_along_wall(h).speed / sphere_across_wall(h).stagnation - 1.0) / h

    total = quad(lag, least, 1.2, epsrel=1e-4)[0] + quad(lag, 1.2, 12.0, epsrel=1e-4)[0]
    return math.exp(-2.0 * (total + least * lag(least) * math.log(least)))


def _efficiency(
    name: str, size: float, expected: float, around: tuple[Surrounding, ...]
) -> tuple[float, float]:
    """Return the efficiency of a collector for spheres over its radius, and half of its resolution."""
    shares = np.linspace(0.9, 1.15, 16) if around else np.linspace(0.9, 1.1, 41)
    r, flux = 6.0, FLUX[name][0]
    # The flux within an angle θ from the axis is that within 90° times sin θ, or sin² θ.
    sine = shares * expected / float(flux(r))
    sine = np.sqrt(sine) if name == "sphere" else sine
    x = RADIUS * r * np.stack([-np.sqrt(1.0 - sine**2), sine, 0.0 * sine], axis=1)
    p = spheres(x, d=2.0 * size * RADIUS, rho=1000.0, mu=1e4)
    # The stress of stiff bodies in shear, and so their lift, has an error of first order in these steps.
    dt, models = 0.005 if around else 0.1, Models(integrator="stokes", surroundings=around, tolerance=np.inf)
    medium = Medium(1e-3, 1000.0, _ZERO)
    cloud = Cloud(p, _flow(name), medium, [Stick()], dt * RADIUS / SPEED, models, threads=1)
    active = np.ones(len(shares), dtype=np.bool_)
    while active.any():
        cloud.advance(round(20.0 / dt))
        active = (p.status == Status.ACTIVE) & (p.x[:, 0] < 0.0)
    held = p.status == Status.STUCK
    half = 0.5 * (shares[1] - shares[0])
    if held.all() or not held.any():
        return float("nan"), half * expected
    return float(shares[held].max() + half) * expected, half * expected


def _flow(name: str) -> analytic.AnalyticFlow:
    """Return the flow along x around the collector at the origin."""
    free = analytic.function(_past_cylinder if name == "cylinder" else _past_sphere, RADIUS)
    depth = 0.0 if name == "cylinder" else 1.0

    def gap(_flow: Any, _host: int, x: Any, _F: Any, R: float, _mode: Any = ()) -> tuple[float, int, int]:
        return math.sqrt(x[0] * x[0] + x[1] * x[1] + depth * x[2] * x[2]) - RADIUS - R, 0, 0

    def walk(_flow: Any, host: int, _x0: Any, _x1: Any) -> tuple[int, float, int, int]:
        return host, 1.0, -1, -1

    def normal(_flow: Any, _triangle: int, x: Any) -> Any:
        r = math.sqrt(x[0] * x[0] + x[1] * x[1] + depth * x[2] * x[2]) + 1e-300
        return x[0] / r, x[1] / r, depth * x[2] / r

    def planes(_flow: Any, _host: int, x: Any, cut: float, _chosen: NDArray[np.int8]) -> Planes:
        r = math.sqrt(x[0] * x[0] + x[1] * x[1] + depth * x[2] * x[2]) + 1e-300
        if r - RADIUS >= cut:
            return NO_PLANES
        n = (x[0] / r, x[1] / r, depth * x[2] / r)
        return Planes(r - RADIUS, n, math.inf, _ZERO, math.inf, _ZERO)

    kernels: dict[str, Any] = {**free.kernels, "gap": gap, "walk": walk, "normal": normal, "walls": planes}
    return analytic.AnalyticFlow(free._parameters, kernels, (Patch("collector", "wall"),))


def _past_sphere(x: float, y: float, z: float) -> tuple[float, float, float]:
    c, r = 1.0 / RADIUS, np.sqrt(x * x + y * y + z * z) / RADIUS
    a, b = 0.75 * (1.0 / r - 1.0 / r**3) / (r * r), 1.0 - 0.75 / r - 0.25 / r**3
    p, q, s = c * x, c * y, c * z
    return SPEED * (b - a * p * p), -SPEED * a * p * q, -SPEED * a * p * s


def _past_cylinder(x: float, y: float, _z: float) -> tuple[float, float, float]:
    p, q = x / RADIUS, y / RADIUS
    r2 = p * p + q * q
    # ψ = f(r²) y; u = ∂ψ/∂y, v = −∂ψ/∂x.
    f = np.log(r2) - 1.0 + SOLIDITY - 0.5 * SOLIDITY * r2 + (1.0 - 0.5 * SOLIDITY) / r2
    slope = 1.0 / r2 - 0.5 * SOLIDITY - (1.0 - 0.5 * SOLIDITY) / (r2 * r2)
    k = SPEED / (2.0 * KU)
    return k * (f + 2.0 * slope * q * q), -2.0 * k * slope * p * q, 0.0
