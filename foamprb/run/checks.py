"""Whether a run's numbers make physical sense: dimensionless groups, and a warning for each doubtful one."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from foamprb.body.imex import relaxation_time
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.integrators.registry import INTEGRATORS, SMALL_STOKES
from foamprb.cloud.measures import shear_rate_at
from foamprb.cloud.state import Particles

STEADY_CAPILLARY = 0.3
"""Largest μ_f γ̇/μ_s, about, at which a neo-Hookean sphere comes to a steady shape in uniaxial extension."""
_MOST_NODES, _SMALL_SHARE = 20_000, 0.01
SMALL_REYNOLDS = 0.1
"""Largest particle Reynolds number at which Stokes flow around the particle is taken for granted."""


class Groups(NamedTuple):
    """Ranges (smallest, largest) over the particles of one injection model, at their release."""

    n: int
    shear_rate: tuple[float, float]
    """γ̇, 1/s."""
    capillary: tuple[float, float]
    """μ_f γ̇/μ_s (52)."""
    reynolds: tuple[float, float]
    """γ̇ d²/ν (53)."""
    stokes: tuple[float, float]
    """Shape Stokes number γ̇ τ_s."""
    step: tuple[float, float]
    """Δt/τ_s."""
    size: tuple[float, float]
    """d over the size of the cell at release."""
    extending: float = 0.0
    """Share of the flow in which the softest has no steady shape if it stays."""


def groups(cloud: Cloud, injector: int) -> Groups:
    """Return the dimensionless groups of the particles that one injection model releases."""
    rows = np.flatnonzero(cloud.particles.injector == injector)
    p = cloud.particles.take(slice(None) if len(rows) == cloud.particles.size else rows)
    medium = cloud.medium
    gamma = shear_rate_at(cloud.flow, p, cloud.time)
    tau = relaxation_time(p.rho, p.R, medium.mu, p.eta)
    return Groups(
        p.size,
        _range(gamma),
        _range(medium.mu * gamma / p.mu),
        _range(gamma * 4.0 * p.R**2 * medium.rho / medium.mu),
        _range(gamma * tau),
        _range(cloud.dt / tau),
        _range(2.0 * p.R / cloud.flow.cell_size(p.host)),
        _extending(cloud, p),
    )


def _extending(cloud: Cloud, p: Particles) -> float:
    """Share of the flow's nodes where the softest particle's capillary number of extension is too large.

    It is that of the uniaxial extension that stretches as fast as the flow there, the rate of which is the
    largest real part of the eigenvalues of ∇u; in simple shear, where every body has a steady shape, zero.
    """
    gradient = cloud.flow.at_nodes()[2]
    gradient = gradient[:: max(1, len(gradient) // _MOST_NODES)]
    if len(gradient) == 0 or p.size == 0:
        return 0.0
    rate = np.linalg.eigvals(gradient.reshape(-1, 3, 3)).real.max(axis=1)
    return float(np.mean(np.sqrt(3.0) * cloud.medium.mu * rate / p.mu.min() > STEADY_CAPILLARY))


def _range(values: np.ndarray) -> tuple[float, float]:
    return (float(values.min()), float(values.max())) if len(values) else (np.nan, np.nan)


def doubts(g: Groups, integrator: str, where: str) -> list[str]:
    """Return a sentence, with its number, for each group that is out of the model's range.

    Parameters
    ----------
    g, integrator
        The groups, and the integrator of the shape.
    where
        What the sentences begin with, e.g. ``injection model inlet``.
    """
    found = []
    scheme = INTEGRATORS[integrator]
    if g.step[1] > scheme.stable_steps:
        found.append(
            f"{where}: deltaT is {g.step[1]:.3g} times the shape's relaxation time; the integrator is stable "
            f"only below about {scheme.stable_steps:g}, less for elongated particles."
        )
    if not scheme.inertia and g.stokes[1] > 10 * SMALL_STOKES:
        found.append(
            f"{where}: the shape Stokes number is {g.stokes[1]:.3g}; the integrator {integrator} leaves out "
            "the inertia of the solid, which matters there."
        )
    if g.reynolds[1] > SMALL_REYNOLDS:
        found.append(
            f"{where}: the particle Reynolds number is {g.reynolds[1]:.3g}; the traction and the drag are "
            f"those of Stokes flow, which needs it small (below {SMALL_REYNOLDS:g})."
        )
    if g.extending > _SMALL_SHARE:
        found.append(
            f"{where}: in {100 * g.extending:.3g} % of the flow the capillary number is beyond "
            f"{STEADY_CAPILLARY:g} in extension, where a body has no steady shape: one that stays there is "
            "stretched on and on, and fails at maxStretch."
        )
    if g.size[1] > 1.0:
        found.append(
            f"{where}: a particle is {g.size[1]:.3g} times as large as the cell that it starts in; the flow "
            "is taken as linear over the particle."
        )
    return found
