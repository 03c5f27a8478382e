"""Virtual mass: the fluid that an accelerating body accelerates with it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar

from foamprb.body.tensor import Scalar, Vector, scale_vector
from foamprb.cloud.forces.base import FLUID_VELOCITY, Force, Inputs, displaced
from foamprb.dictionary.constraints import Meaning, NonNegative


def virtual_mass(inputs: Inputs, Cvm: Scalar) -> tuple[Vector, Scalar]:
    """C s Du/Dt, m/s², and the inertia C s (Auton, Hunt & Prud'homme 1988)."""
    c = Cvm * displaced(inputs)
    return scale_vector(c, inputs.Du_Dt), c


@dataclass(frozen=True, kw_only=True)
class VirtualMass(Force):
    """Fluid that an accelerating particle accelerates with it: ``virtualMass { Cvm 0.5; }``."""

    Cvm: Annotated[float, NonNegative, Meaning("coefficient of virtual mass; ½ for a sphere", "1")]
    U: Annotated[str, FLUID_VELOCITY] = "U"

    push: ClassVar = staticmethod(virtual_mass)
