"""The force of the undisturbed flow's pressure gradient."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from foamprb.body.tensor import Scalar, Vector, scale_vector
from foamprb.cloud.forces.base import FLUID_VELOCITY, Force, Inputs, displaced


def pressure_gradient(inputs: Inputs) -> tuple[Vector, Scalar]:
    """m_f Du/Dt over m, s Du/Dt, m/s² (Maxey & Riley 1983); no inertia."""
    return scale_vector(displaced(inputs), inputs.Du_Dt), 0.0


@dataclass(frozen=True, kw_only=True)
class PressureGradient(Force):
    """Force of the undisturbed flow's acceleration: ``pressureGradient;`` or ``{ U U; }``."""

    U: Annotated[str, FLUID_VELOCITY] = "U"

    push: ClassVar = staticmethod(pressure_gradient)
