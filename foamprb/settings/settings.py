"""What a user asks for, as typed and validated values: what the rest of the package knows of a dictionary."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field
from pathlib import Path
from typing import Literal, TypeAlias

from foamprb.cloud.forces import Force
from foamprb.cloud.injection.distribution import Distribution
from foamprb.cloud.injection.models import Injection
from foamprb.cloud.injection.shapes import Shape
from foamprb.cloud.limits import Limits
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloudfunctions.base import CloudFunction
from foamprb.dictionary.constraints import Vector3
from foamprb.settings.patches import Rule, Touching

__all__ = ["Fluid", "InjectionSettings", "Settings", "Solid", "Solution", "StartFrom"]

StartFrom: TypeAlias = Literal["startTime", "latestTime"]


@dataclass(frozen=True)
class Solution:
    """Time stepping: step, end and write interval, s; the flow in time; the integrator and its tolerance.

    A run begins at time 0 or goes on from its last checkpoint, as ``startFrom`` says, None if the user does
    not; it stops when more than ``maxFailedFraction`` of the injected particles have failed.
    """

    deltaT: float
    endTime: float
    writeInterval: float
    shape: str
    tolerance: float
    stride: int
    """Through how many tracking steps a step may go whose size the integrator chooses."""
    transient: bool = False
    """Whether the flow changes in time; its time is then that of the run."""
    period: float | None = None
    """Time after which a transient flow repeats itself, s."""
    rotatingZones: Literal["relative", "absolute"] = "relative"
    """How zones of MRFProperties are seen."""
    startFrom: StartFrom | None = None
    maxFailedFraction: float = 1.0
    limits: Limits = field(default_factory=Limits)


@dataclass(frozen=True)
class Fluid:
    """Density rho, kg/m3, and kinematic viscosity nu, m2/s."""

    rho: float
    nu: float

    @property
    def mu(self) -> float:
        """Dynamic viscosity, Pa s."""
        return self.rho * self.nu


@dataclass(frozen=True)
class Solid:
    """A particle's material: μ_s, Pa, the shear rate of its Ca, 1/s, η_s, Pa s, and γ, N/m.

    How it yields to pressure is said by ν_s or by the bulk modulus, Pa; if by neither, it hardly does.
    """

    type: str
    shear_modulus: float | Distribution
    poissons_ratio: float | None = None
    bulk_modulus: float | None = None
    reference_shear_rate: float | None = None
    parameter: float = 0.0
    viscosity: float | Distribution = 0.0
    surface_tension: float | Distribution = 0.0


@dataclass(frozen=True)
class InjectionSettings:
    """One injection model: where and when particles appear, and what they are; rho in kg/m3."""

    name: str
    model: Injection
    rho: float | Distribution
    solid: Solid
    size: Distribution | None
    """Diameters, m; None if a file of positions must give them."""
    shape: Shape


@dataclass(frozen=True)
class Settings:
    """All that a user asks for; gravity in m/s2, zero if it is not among the forces."""

    case: Path
    file: Path
    name: str
    solution: Solution
    fluid: Fluid
    gravity: Vector3
    traction: str
    drag: str
    injections: tuple[InjectionSettings, ...]
    interaction: str
    touching: Touching
    patches: tuple[Rule, ...]
    functions: Mapping[str, CloudFunction]
    forces: Mapping[str, Force]
    surroundings: Mapping[str, Surrounding]
    dispersion: Mapping[str, Surrounding] = field(default_factory=dict)
    """The dispersionModel by its name, if there is one."""
    region: str = ""
