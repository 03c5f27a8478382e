"""Fates by limits: bodies rupture, or release their contents, where a stress, a stretch or a dose is large.

A limit is checked at the start of each step, and no step longer than Δt goes beyond one. A particle ends at
the first of these times at which one is reached, in the state of that time.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, fields
from typing import Annotated, ClassVar, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.material import finger
from foamprb.body.rosenbrock import extra_stress
from foamprb.body.tensor import Scalar, Tensor, ddot, det, dev, dot, inverse, longest_stretch, select
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium, Scratch, at, judge, load9, viscosity_at
from foamprb.cloud.elastic import solid
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import conclude, outcome_code
from foamprb.cloud.state import Reason, Status
from foamprb.cloud.surroundings.base import Stage, Surrounding
from foamprb.compile.link import Slots
from foamprb.dictionary.constraints import Bounds, Meaning, Positive
from foamprb.errors import InputError
from foamprb.flow.base import Patch

Numbers: TypeAlias = tuple[tuple[float, ...], tuple[float, ...]]
"""Limits of ruptures and of releases."""

_ABOVE_ONE = Bounds(1.0, math.inf, True, True, "a number > 1")
_REASONS = Reason.STRETCH_REACHED, Reason.STRESS_REACHED, Reason.SHEAR_REACHED, Reason.DOSE_REACHED
_OF_RUPTURE, _OF_RELEASE = (
    tuple(outcome_code(status, reason) for reason in _REASONS)
    for status in (Status.RUPTURED, Status.RELEASED)
)


class FateRows(NamedTuple):
    """Dose of a particle, and the fate that it has reached."""

    dose: Annotated[int, Row(1, "Pa s", "dose of the fluid's shear stress", of="dose", saved=True)]
    dosed: Annotated[int, Row(1, "s", "time to which it is integrated")]
    shear_stress: Annotated[int, Row(1, "Pa", "shear stress of the fluid at that time")]
    measured: Annotated[int, Row(1, "", "1 once these two are measured, else 0")]
    outcome: Annotated[int, Row(1, "", "code of the status and the reason that are reached, else 0")]


fates = offsets(FateRows)


def elastic_stress(block: Block, i: int, F: Tensor) -> Scalar:
    """Return von Mises' stress of the solid in lane i, √(³⁄₂ dev τ:dev τ)/J, Pa, without its viscosity."""
    J = det(F)
    T = dev(extra_stress(finger(F, load9(block, at.M, i)), J, *solid(block, i)))
    return np.sqrt(1.5 * ddot(T, T)) / J


def reached(values: tuple[Scalar, ...], limits: tuple[Scalar, ...], codes: tuple[int, ...]) -> int:
    """Return the code of the first limit that is reached; 0 if there is none."""
    for k in range(4):
        if values[k] >= limits[k]:
            return codes[k]
    return 0


def reached_fate(block: Block, i: int, F: Tensor, stress: Scalar, dose: Scalar, coefficients: Numbers) -> int:
    """Return the code of the fate of lane i with F, a shear stress of the fluid and a dose; 0 for none."""
    stretch = longest_stretch(dot(F, inverse(load9(block, at.F0, i))))
    values = stretch, elastic_stress(block, i, F), stress, dose
    code = reached(values, coefficients[0], _OF_RUPTURE)
    return code if code > 0 else reached(values, coefficients[1], _OF_RELEASE)


def stays_within_limits(_flow: object, s: Scratch, i: int, medium: Medium, coefficients: Numbers) -> float:
    """Return a half for a step of lane i that leads beyond a limit, else 1."""
    block = s.block
    stress = viscosity_at(block, i, medium) * shear_rate(load9(block, during.end_l, i))
    mean = 0.5 * (block[fates.shear_stress * LANES + i] + stress)
    dose = block[fates.dose * LANES + i] + mean * block[at.dt * LANES + i]
    code = reached_fate(block, i, load9(block, at.new_F, i), stress, dose, coefficients)
    return 0.5 if code > 0 else 1.0


def check_limits(
    _flow: object, s: Scratch, i: int, _step: int, remaining: float, medium: Medium, coefficients: Numbers
) -> None:
    """Add to the dose of lane i, and end the particle where it has reached a limit."""
    block = s.block
    t, stress = block[at.t * LANES + i], viscosity_at(block, i, medium) * shear_rate(load9(block, at.l, i))
    if block[fates.measured * LANES + i] > 0.0:
        mean = 0.5 * (block[fates.shear_stress * LANES + i] + stress)
        block[fates.dose * LANES + i] += mean * (t - block[fates.dosed * LANES + i])
    block[fates.measured * LANES + i] = 1.0
    block[fates.dosed * LANES + i], block[fates.shear_stress * LANES + i] = t, stress
    code = reached_fate(block, i, load9(block, at.F, i), stress, block[fates.dose * LANES + i], coefficients)
    if code > 0 and remaining > 0.0:
        block[fates.outcome * LANES + i] = code
    elif code > 0:
        # The end of a call: there is no step that could be judged.
        conclude(s, i, code)


def judge_by_limits(block: Block, i: int, verdict: Scalar) -> Scalar:
    """Return the code of the fate that lane i has reached, else the verdict on its step."""
    code = block[fates.outcome * LANES + i]
    return select(code > 0.0, code, verdict)


@dataclass(frozen=True, kw_only=True)
class FateLimits:
    """Limits of a fate; the first that is reached counts."""

    stretch: Annotated[
        float | None, _ABOVE_ONE, Meaning("largest stretch from the shape at rest", "1", "none")
    ] = None
    stress: Annotated[
        float | None, Positive, Meaning("elastic stress of the solid, after von Mises", "Pa", "none")
    ] = None
    shearStress: Annotated[
        float | None, Positive, Meaning("of the fluid at the centre, μ γ̇", "Pa", "none")
    ] = None
    dose: Annotated[float | None, Positive, Meaning("time integral of that shear stress", "Pa s", "none")] = (
        None
    )

    def __post_init__(self) -> None:
        if all(value is None for value in self._values):
            raise InputError(f"has no limit. Allowed: {', '.join(field.name for field in fields(self))}")

    @property
    def _values(self) -> tuple[float | None, ...]:
        return tuple(getattr(self, field.name) for field in fields(self))

    @property
    def limits(self) -> tuple[float, ...]:
        """The limits, infinite where there is none."""
        return tuple(math.inf if value is None else float(value) for value in self._values)

    def __str__(self) -> str:
        """Return the limits for the log: ``stretch 2 dose 5``."""
        named = zip(fields(self), self._values, strict=True)
        return " ".join(f"{field.name} {value:g}" for field, value in named if value is not None)


@dataclass(frozen=True, kw_only=True)
class Fates(Surrounding):
    """Bodies that rupture or release their contents at a limit: ``fates { ruptured { stretch 2; } }``."""

    ruptured: Annotated[FateLimits | None, Meaning("where bodies break", default="never")] = None
    released: Annotated[FateLimits | None, Meaning("where they release their contents", default="never")] = (
        None
    )

    rows: ClassVar = (FateRows,)
    each_step: ClassVar = False
    switches: ClassVar = {"updates_end": 1}
    stages: ClassVar = (
        Stage("start", check_limits, writes=(fates.outcome,), before=(at.l,)),
        Stage("accept", stays_within_limits),
    )

    def __post_init__(self) -> None:
        if self.ruptured is None and self.released is None:
            raise InputError("has no fate. Allowed: ruptured, released")

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return the limits of rupture and of release."""
        none = (math.inf,) * 4
        ruptured, released = self.ruptured, self.released
        return ruptured.limits if ruptured else none, released.limits if released else none

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the judgement of steps, of each call."""
        return {judge: judge_by_limits}

    def refuses(self, integrator: Integrator, liquid: bool) -> str:
        """Refuse ``paper``, which has no update at the end of a call, and a stress that drops do not have."""
        if integrator.name == "paper":
            return "fates need the integrator stokes or rosenbrock, not paper"
        limits = [fate for fate in (self.ruptured, self.released) if fate is not None]
        if liquid and any(fate.stress is not None for fate in limits):
            return "the limit stress of a fate holds for solids, not for drops or vesicles"
        return ""
