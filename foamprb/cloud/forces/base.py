"""What a force on the barycentre is: entries in the settings, and a plain function of what it may read."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass, fields
from numbers import Real
from typing import Any, ClassVar, NamedTuple

from foamprb.body.tensor import Scalar, Vector
from foamprb.cloud.block import Medium, at, load3
from foamprb.cloud.layout import LANES
from foamprb.dictionary.constraints import Only

__all__ = ["FLUID_VELOCITY", "Force", "Inputs", "displaced", "inputs_of"]

FLUID_VELOCITY = Only("U", "the flow's velocity")
"""OpenFOAM's forces name the field; here there is one."""


class Inputs(NamedTuple):
    """What a force may read of a particle and of the fluid around it.

    A force that needs more adds a field here, which :func:`inputs_of` fills in for all integrators. What no
    chosen force reads is left out of the compiled code.
    """

    J: Scalar
    """Volume ratio."""
    rho: Scalar
    """Density of the undeformed solid, kg/m³; that of the deformed one is ρ_s/J."""
    Du_Dt: Vector
    """Acceleration of the fluid at the barycentre, ∂u/∂t + l·u, m/s²."""
    medium: Medium


def inputs_of(block: Any, i: int, medium: Medium, J: Scalar) -> Inputs:
    """What forces may read of lane i, whose volume ratio is J."""
    return Inputs(J, block[at.rho * LANES + i], load3(block, at.DuDt, i), medium)


def displaced(inputs: Inputs) -> Scalar:
    """Mass of the displaced fluid over that of the particle, s = m_f/m = J ρ_f/ρ_s."""
    return inputs.J * inputs.medium.rho / inputs.rho


@dataclass(frozen=True, kw_only=True)
class Force:
    """A force on the barycentre. Its fields are the entries of its dictionary in ``particleForces``."""

    push: ClassVar[Callable[..., tuple[Vector, Scalar]]]
    """``push(inputs, *coefficients)``: the force per mass of the particle, m/s², and the inertia that it
    adds, in masses of the particle."""

    @property
    def coefficients(self) -> tuple[float, ...]:
        """The entries that are numbers, in their order."""
        values = (getattr(self, field.name) for field in fields(self))
        return tuple(float(value) for value in values if isinstance(value, Real))

    def __str__(self) -> str:
        """The entries that are numbers, for the log: ``(Cvm 0.5)``, or nothing."""
        values = ((field.name, getattr(self, field.name)) for field in fields(self))
        numbers = ", ".join(f"{name} {value:g}" for name, value in values if isinstance(value, Real))
        return f"({numbers})" if numbers else ""
