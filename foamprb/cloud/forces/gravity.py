"""Weight less buoyancy."""

from __future__ import annotations

from dataclasses import dataclass
from typing import ClassVar

from foamprb.body.drag import reduced_gravity
from foamprb.body.tensor import Scalar, Vector
from foamprb.cloud.forces.base import Force, Inputs


def weight(inputs: Inputs) -> tuple[Vector, Scalar]:
    """(1 − s) g, m/s² (28), (35); no inertia."""
    return reduced_gravity(inputs.J, inputs.rho, inputs.medium.rho, inputs.medium.gravity), 0.0


@dataclass(frozen=True, kw_only=True)
class Gravity(Force):
    """Gravity, ``constant/g``, less buoyancy: ``gravity;``."""

    push: ClassVar = staticmethod(weight)
