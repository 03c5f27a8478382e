"""Where and when particles appear: OpenFOAM's injection models, with its entries."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

from foamprb.entries import NonNegative, Positive

Vector3 = tuple[float, float, float]


@dataclass(frozen=True)
class FixedValue:
    """Every particle has the same diameter, m."""

    value: Annotated[float, Positive]


SIZE_DISTRIBUTIONS: dict[str, type[FixedValue]] = {"fixedValue": FixedValue}


@dataclass(frozen=True)
class ManualInjection:
    """Particles at the positions that a file lists, all at the time ``SOI``."""

    positionsFile: Path
    U0: Vector3 | None = None
    SOI: Annotated[float, NonNegative] = 0.0
    ignoreOutOfBounds: bool = False


@dataclass(frozen=True)
class PatchInjection:
    """Particles spread over a patch, uniform in flux, from ``SOI`` on for ``duration``."""

    patch: str
    parcelsPerSecond: Annotated[float, Positive]
    duration: Annotated[float, Positive]
    U0: Vector3 | None = None
    SOI: Annotated[float, NonNegative] = 0.0
    seed: int = 0


Injection = ManualInjection | PatchInjection

INJECTIONS: dict[str, type[Injection]] = {
    "manualInjection": ManualInjection,
    "patchInjection": PatchInjection,
}
