"""Which flow to read: a case, a region of it or a mesh file, and the names of its fields."""

from __future__ import annotations

import shlex
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

from foamprb.flow.read.fluid import ViscosityField


@dataclass(frozen=True)
class Division:
    """Division of a boundary without named patches into patches; by default it stays one patch."""

    array: str = ""
    """Integer array on the surface cells of the file; each value is a patch."""
    feature_angle: float | None = None
    """Angle in degrees: patches end at edges where the boundary turns by more."""


class FlowTimes(NamedTuple):
    """Times of a flow to read."""

    selection: float | str | None = None
    """A time of a steady flow, by default the latest; times of a transient one, by default all."""
    transient: bool = False
    period: float | None = None
    """Duration after which a transient flow repeats itself, s."""

    @property
    def steady(self) -> float | str:
        """Return the time of a steady flow."""
        return "latestTime" if self.selection is None else self.selection

    @property
    def several(self) -> str | None:
        """Return the selection of the times of a transient flow."""
        return None if self.selection is None else str(self.selection)


@dataclass(frozen=True)
class FlowSource:
    """Options of reading a flow beside the case's folder and the time."""

    file: Path | None = None
    """Mesh file that replaces the case's mesh and fields."""
    region: str = ""
    """Region of the case's mesh."""
    velocity: str = "U"
    """Name of the velocity."""
    division: Division | None = None
    """Division of the boundary of a mesh file without named patches."""
    decomposed: bool = False
    """Read the processor folders even if there is a flow beside them."""
    turbulent: bool = False
    """Read also k and ε, or k and ω."""
    curved: bool = False
    """Reconstruct also second derivatives of the velocity."""
    relative: bool = False
    """Describe rotating zones in the frames of their rotors."""
    viscosity: ViscosityField | None = None
    """Read also a field of the viscosity."""
    sampled: tuple[str, ...] = ()
    """Read also these fields, for sampling."""
    accept: tuple[str, ...] = ()
    """Faults of a transient flow with which to go on, of :data:`~foamprb.flow.base.FAULTS`."""
    scale: float | None = None
    """Factor of the lengths in a mesh file, m; by default 1."""
    cache: Path | None = None
    """Folder that keeps the times of cases; see :class:`~foamprb.flow.read.prepared.PreparedTimes`."""

    balanced: bool = True
    """Balance the fluxes of a steady flow of a case, so that its velocities keep volume."""

    @property
    def length_scale(self) -> float:
        """Return the factor of the lengths in a mesh file, m."""
        return 1.0 if self.scale is None else self.scale

    @property
    def of_file(self) -> dict[str, Any]:
        """Return the options of reading a mesh file, beside its velocity."""
        return {
            "division": self.division,
            "scale": self.length_scale,
            "curved": self.curved,
        }

    @property
    def options(self) -> str:
        """Options of the command line for this source, each with a blank before it."""
        divided = self.division or Division()
        given = {
            "flow": self.file,
            "region": self.region,
            "velocity": "" if self.velocity == "U" else self.velocity,
            "patchArray": divided.array,
            "featureAngle": divided.feature_angle,
            "scale": self.scale,
        }
        words = "".join(f" -{name} {shlex.quote(str(value))}" for name, value in given.items() if value)
        return words + " -decomposed" * self.decomposed
