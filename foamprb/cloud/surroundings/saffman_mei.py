"""Lift by inertia of the fluid, in the slip of bodies without inertia of their own.

The formulas are those of :mod:`foamprb.body.lift`.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Annotated, Any, ClassVar

from foamprb.body.drag import oberbeck as drag
from foamprb.body.lift import lifted_slip
from foamprb.body.slip import balanced_slip
from foamprb.body.tensor import Tensor, Vector, scale_vector
from foamprb.cloud.block import Medium, at, load3, load9, load_integrals, viscosity_at
from foamprb.cloud.forces import forces_on
from foamprb.cloud.integrators.adaptive import drag_rate
from foamprb.cloud.integrators.base import no_disturbance, no_update
from foamprb.cloud.layout import LANES
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.dictionary.constraints import Only

__all__ = ["SaffmanMeiLift"]


def slip_with_lift(block: Any, i: int, medium: Medium, l_f: Tensor, Du_Dt: Vector) -> Vector:
    """Return the velocity relative to the fluid of the shape in the block, m/s."""
    k, mu = drag(load3(block, at.stretch, i), load_integrals(block, i)), viscosity_at(block, i, medium)
    steady, f, inertia = forces_on(block, i, medium, 1.0, Du_Dt)
    Q, R = load9(block, at.Q, i), block[at.R * LANES + i]
    w = balanced_slip(Q, drag_rate(block, i, mu, k), steady, f, inertia, Du_Dt, l_f)
    omega = (l_f[7] - l_f[5], l_f[2] - l_f[6], l_f[3] - l_f[1])
    return lifted_slip(w, Q, scale_vector(R, k), omega, R, medium.rho, mu)


@dataclass(frozen=True, kw_only=True)
class SaffmanMeiLift(Surrounding):
    """Lift by inertia of the fluid on a sphere that slips in shear: ``SaffmanMeiLiftForce;``."""

    U: Annotated[str, Only("U", "the flow's velocity")] = "U"

    update: ClassVar = staticmethod(no_update)
    disturb: ClassVar = staticmethod(no_disturbance)

    def bindings(self, inertia: bool) -> Mapping[str, Callable[..., Any]]:  # noqa: ARG002
        """Return the slip of the integrator without inertia."""
        return {"_slip": slip_with_lift}

    def refuses(self, inertia: bool, integrator: str) -> str:
        """Refuse integrators with inertia, whose drag and lift would not be in balance."""
        if inertia:
            return (
                f"SaffmanMeiLiftForce acts in the slip of the integrator stokes, not in {integrator}: set "
                "integrationSchemes/shape stokes, or leave the force out"
            )
        return ""

    def refuses_drops(self) -> str:
        """Refuse drops, inside which the fluid moves."""
        return "SaffmanMeiLiftForce holds for solids, not for drops"
