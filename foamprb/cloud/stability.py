"""Stability limit of the integrator ``paper``, whose traction is explicit, for each particle's shape.

A disturbance of the rate of a sphere alternates in sign and grows where Δt is more than 2 τ_s, without
elasticity 3/2 τ_s, with τ_s = ρ_s R²/(15 μ_f). A thin axis has little inertia: Δt = 3/2 τ_s λ²/J is stable
for the smallest stretch λ, and the true limit up to 2.5 times that. Beyond it the scheme does not blow up:
the oscillation saturates, and the deformation is too small.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Tensor, add, principal_frame, scale
from foamprb.cloud.state import Particles, Status
from foamprb.compile.link import link

Floats = NDArray[np.float64]
_PENDING, _FAILED = int(Status.PENDING), int(Status.FAILED)


def longest_stable_steps(p: Particles, mu_f: float | Floats, dt: float) -> Floats:
    """Return a step that is stable for each shape and any elasticity, (n,), s; infinite if it is Δt or more.

    For a particle that has ended, the shape is its last one.

    Parameters
    ----------
    p
        The cloud.
    mu_f, dt
        Viscosity of the fluid, Pa s, a number or (n,), and Δt, s.
    """
    limits = np.full(p.size, np.inf)
    link(_find_limits)(p.status, p.F, p.A, p.R, p.rho, p.eta, np.full(p.size, mu_f), dt, limits)
    return limits


def unstable(p: Particles, mu_f: float | Floats, dt: float) -> tuple[int, float]:
    """Return the number of particles for whose shapes Δt may be too long, and the shortest limit, s.

    For the parameters see :func:`longest_stable_steps`.
    """
    limits = longest_stable_steps(p, mu_f, dt)
    return int(np.isfinite(limits).sum()), float(limits.min(initial=np.inf))


def warning_of(beyond: int, limit: float, dt: float) -> str:
    """Return a sentence about the particles that :func:`unstable` counts; empty without any."""
    if beyond == 0:
        return ""
    return (
        f"deltaT is up to {dt / limit:.3g} times what the integrator paper is surely stable with for the "
        f"shapes of {beyond} particles: their deformation may be wrong; use deltaT < {limit:.3g} or "
        "integrator rosenbrock."
    )


def _find_limits(
    status: NDArray[np.int8], F: Floats, A: Floats, R: Floats, rho: Floats, eta: Floats,
    mu_f: Floats, dt: float, limits: Floats,
) -> None:  # fmt: skip
    """Store the limits below ``dt``; see :class:`Particles` for the other arguments."""
    for n in range(len(limits)):
        if status[n] == _PENDING or status[n] == _FAILED:
            continue
        # Beyond the limit a shape oscillates from step to step, and is at times within it. Therefore the
        # shapes one step before and one step after are tested as well.
        for steps in (0.0, -1.0, 1.0):
            _, (x, y, z) = principal_frame(add(_tensor(F, n), scale(steps * dt, _tensor(A, n))))
            least = min(x, y, z)
            viscosity = 4.0 * mu_f[n] + 2.0 * eta[n]
            limit = 0.4 * rho[n] * R[n] * R[n] * least * least / (x * y * z * viscosity)
            if not limit >= dt:
                limits[n] = min(limits[n], limit)


def _tensor(T: Floats, n: int) -> Tensor:
    return T[n, 0], T[n, 1], T[n, 2], T[n, 3], T[n, 4], T[n, 5], T[n, 6], T[n, 7], T[n, 8]
