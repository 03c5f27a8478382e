"""The forces on the barycentre beside drag, by the names of their entries in ``particleForces``."""

from __future__ import annotations

from foamprb.cloud.forces.base import Force
from foamprb.cloud.forces.gravity import Gravity
from foamprb.cloud.forces.pressure_gradient import PressureGradient
from foamprb.cloud.forces.virtual_mass import VirtualMass

__all__ = ["FORCES"]

FORCES: dict[str, type[Force]] = {
    "gravity": Gravity,
    "pressureGradient": PressureGradient,
    "virtualMass": VirtualMass,
}
"""In the order in which those that are chosen are summed, whatever their order in the settings."""
