"""Integrators of the shape by name."""

from __future__ import annotations

from foamprb.body.material import MATERIALS
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.paper import PAPER
from foamprb.cloud.integrators.rosenbrock import ROSENBROCK
from foamprb.cloud.integrators.stokes import STOKES

INTEGRATORS: dict[str, Integrator] = {
    integrator.name: integrator for integrator in (PAPER, ROSENBROCK, STOKES)
}
"""By their names in the settings and in Models."""

SMALL_STOKES = 0.01
"""Stokes number of shape or path below which ``auto`` neglects the solid's inertia."""


def automatic(stokes_number: float, material: str) -> str:
    """Return the integrator for a Stokes number: ``stokes`` where it is small, for drops and vesicles."""
    kind = MATERIALS[material]
    return (STOKES if stokes_number < SMALL_STOKES or kind.liquid or kind.fluid else ROSENBROCK).name
