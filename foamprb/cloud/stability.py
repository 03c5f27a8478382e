"""Stability limit of the integrator ``paper``, whose traction is explicit, for each particle's shape."""

from __future__ import annotations

from functools import cache

import numpy as np
from numpy.typing import NDArray

from foamprb.body.ellipsoid import integrals
from foamprb.body.explicit_limit import is_stable, safe_step
from foamprb.body.material import MATERIALS, derivatives, finger, metric_at_rest
from foamprb.body.rosenbrock import elasticity, kirchhoff
from foamprb.body.tensor import (
    Tensor,
    add,
    cofactor,
    ddot,
    det,
    diagonal,
    dot,
    principal_frame,
    scale,
)
from foamprb.cloud.state import Particles, Status
from foamprb.compile.link import Function, compiled, link

Floats = NDArray[np.float64]
_HALVINGS = 12
_CHUNK = 16_384
_PENDING, _FAILED = int(Status.PENDING), int(Status.FAILED)


def longest_stable_steps(p: Particles, mu_f: float | Floats, dt: float, material: str) -> Floats:
    """Return the longest stable step of ``paper`` for each shape, (n,), s; infinite if it is Δt or more.

    For a particle that has ended, the shape is its last one.

    Parameters
    ----------
    p
        The cloud.
    mu_f, dt
        Viscosity of the fluid, Pa s, a number or (n,), and Δt, s.
    material
        Name of the solid.
    """
    # Part by part, to limit memory.
    chunks = [slice(k, k + _CHUNK) for k in range(0, p.size, _CHUNK)]
    mu_f = np.full(p.size, mu_f)
    parts = [_limits(p.take(some), mu_f[some], dt, material) for some in chunks]
    return np.concatenate([np.empty(0), *parts])


def unstable(p: Particles, mu_f: float | Floats, dt: float, material: str) -> tuple[int, float]:
    """Return the number of particles for whose shapes Δt is too long, and the shortest of their limits, s.

    For the parameters see :func:`longest_stable_steps`.
    """
    limits = longest_stable_steps(p, mu_f, dt, material)
    return int(np.isfinite(limits).sum()), float(limits.min(initial=np.inf))


def warning_of(beyond: int, limit: float, dt: float) -> str:
    """Return a sentence about the particles that :func:`unstable` counts; empty without any."""
    if beyond == 0:
        return ""
    return (
        f"deltaT is up to {dt / limit:.3g} times what the integrator paper is stable with for the shapes of "
        f"{beyond} particles: their deformation is wrong; use deltaT < {limit:.3g} or integrator rosenbrock."
    )


def _limits(p: Particles, mu_f: Floats, dt: float, material: str) -> Floats:
    limits = np.full(p.size, np.inf)
    # Beyond the limit a shape oscillates from step to step, and is at times within it. Therefore the shapes
    # one step before and one step after are tested as well.
    for steps in (0.0, -1.0, 1.0):
        doubtful = np.zeros(p.size, dtype=bool)
        compiled(_find_doubtful)(p.status, p.F, p.A, p.R, p.rho, p.eta, mu_f, dt, steps, doubtful)
        rows = np.flatnonzero(doubtful)
        if len(rows):
            part, longest = p.take(rows), np.empty(len(rows))
            shapes = part.F + steps * dt * part.A
            loop = _limits_of(MATERIALS[material].derivatives)
            loop(shapes, part.F0, part.R, part.rho, part.mu, part.lame, part.k, part.eta,
                 mu_f[rows], dt, longest)  # fmt: skip
            limits[rows] = np.minimum(limits[rows], longest)
    return limits


@cache
def _limits_of(of_solid: Function) -> Function:
    """Return the compiled search of limits for the derivatives of a solid's energy."""
    return link(_find_limits, {derivatives: of_solid})  # type: ignore[no-any-return]


def _find_doubtful(
    status: NDArray[np.int8], F: Floats, A: Floats, R: Floats, rho: Floats, eta: Floats,
    mu_f: Floats, dt: float, steps: float, doubtful: NDArray[np.bool_],
) -> None:  # fmt: skip
    """Mark particles whose shape, after a number of steps, may be unstable for some elasticity."""
    h = steps * dt
    for n in range(len(doubtful)):
        if status[n] != _PENDING and status[n] != _FAILED:
            shape = add(_tensor(F, n), scale(h, _tensor(A, n)))
            J, c = det(shape), cofactor(shape)
            # No stretch is less than J over the norm of the cofactors.
            least = J / np.sqrt(ddot(c, c))
            limit = safe_step(
                (least, least, J / (least * least)), 5.0 / (rho[n] * R[n] * R[n]), mu_f[n], eta[n]
            )
            doubtful[n] = not limit >= dt


def _find_limits(
    F: Floats, F0: Floats, R: Floats, rho: Floats, mu: Floats, lame: Floats, k: Floats, eta: Floats,
    mu_f: Floats, dt: float, longest: Floats,
) -> None:  # fmt: skip
    """Store the longest stable steps in ``longest``; see :class:`Particles` for the other arguments."""
    for n in range(len(longest)):
        Q, stretches = principal_frame(_tensor(F, n))
        g = integrals(stretches)
        b = finger(dot(Q, _tensor(F, n)), metric_at_rest(_tensor(F0, n)))
        J = stretches[0] * stretches[1] * stretches[2]
        e = elasticity(diagonal(b), J, mu[n], lame[n], k[n], 0.0)
        T = kirchhoff(b, J, mu[n], lame[n], k[n])
        tau = diagonal(T)
        c = 5.0 / (rho[n] * R[n] * R[n])
        longest[n] = np.inf
        if is_stable(dt, stretches, g, e, tau, c, mu_f[n], eta[n]):
            continue
        low, high = safe_step(stretches, c, mu_f[n], eta[n]), dt
        for _ in range(_HALVINGS):
            middle = np.sqrt(low * high)
            if is_stable(middle, stretches, g, e, tau, c, mu_f[n], eta[n]):
                low = middle
            else:
                high = middle
        longest[n] = low


def _tensor(T: Floats, n: int) -> Tensor:
    return T[n, 0], T[n, 1], T[n, 2], T[n, 3], T[n, 4], T[n, 5], T[n, 6], T[n, 7], T[n, 8]
