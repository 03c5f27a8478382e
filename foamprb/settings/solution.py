"""The dictionary ``solution``: steps, times and limits of a run; times also from ``system/controlDict``."""

from __future__ import annotations

import logging
import math
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Annotated, Literal, TypeAlias

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.limits import Limits
from foamprb.cloud.measures import REQUESTED
from foamprb.cloud.tracker import Models
from foamprb.dictionary.constraints import Bounds, Choice, Fraction, Meaning, NoEffect, Only, Positive, Words
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import Instead, read_entries, read_entry
from foamprb.dictionary.tree import Dictionary, Entry
from foamprb.errors import InputError
from foamprb.flow.base import FAULTS
from foamprb.flow.read.caveats import pseudo_time

log = logging.getLogger("foamprb")

_CONTROL = Path("system/controlDict")
_TIME = Annotated[float, Positive]
MULTIPLE_TOLERANCE = 1e-6
"""Tolerance of the check that a write interval is a multiple of the step, relative."""
MOST_STEPS = 2**53
"""Number of steps above which steps have no distinct numbers in double precision."""

StartFrom: TypeAlias = Literal["startTime", "latestTime"]

_CONSTANT_FLUID = NoEffect("density and viscosity of the fluid are not interpolated by these schemes")
_NO_SOURCES = NoEffect("the particles do not act on the flow")
_NOT_COUPLED = Only(False, "the particles do not act on the flow")
_ABOVE_ONE = Bounds(1.0, math.inf, True, True, "a number > 1")
_FROM_ONE = Bounds(1.0, math.inf, False, True, "a number >= 1")
_ERROR = Bounds(1e-14, 0.1, False, False, "a number from 1e-14 to 0.1")
"""Below it round-off is larger; above it the error has no meaning."""
_OF_CONTROL = "that of `system/controlDict`"


@dataclass(frozen=True, kw_only=True)
class InterpolationSchemes:
    """``solution/interpolationSchemes``; either word is the interpolation of docs/flow.md."""

    U: Annotated[
        Literal["linear", "cellPoint"],
        Meaning("either is [the only one](flow.md), which is quadratic between the nodes"),
    ] = "linear"
    rho: Annotated[None, _CONSTANT_FLUID] = None
    mu: Annotated[None, _CONSTANT_FLUID] = None

    @staticmethod
    def instead(word: str) -> Instead | None:
        """Return the name without a phase's, as in ``U.air``."""
        name, dot, _ = word.partition(".")
        return Instead(name, "there is one fluid") if dot and name in ("U", "rho", "mu") else None


@dataclass(frozen=True, kw_only=True)
class IntegrationSchemes:
    """``solution/integrationSchemes``."""

    U: Annotated[Literal["Euler"], Meaning("of the barycentre; the only one")] = "Euler"
    shape: Annotated[
        str,
        Choice(("auto", *INTEGRATORS)),
        Meaning(
            "[integrator of the shape](integrators.md); `auto` chooses by Stokes numbers",
            values={name: integrator.description for name, integrator in INTEGRATORS.items()},
        ),
    ] = "auto"
    tolerance: Annotated[
        float, _ERROR, Meaning("largest error of a step, for integrators with error control", "1")
    ] = 1e-4
    roughnessShare: Annotated[
        float,
        Fraction,
        Meaning(
            "the same over [the roughness of the flow](integrators.md#roughness), where that gives more than "
            "`tolerance`; 0: `tolerance` as it is, for studies of convergence",
            "1",
        ),
    ] = Models.roughness_share


@dataclass(frozen=True, kw_only=True)
class Solution:
    """``solution``; :func:`read_solution` sets times that are not given, which are NaN before."""

    deltaT: Annotated[float, Positive, Meaning("tracking step", "s", _OF_CONTROL)] = math.nan
    maxDeltaT: Annotated[
        float,
        Positive,
        Meaning(
            "[longest step](integrators.md#steps-longer-than-deltat) of integrators with error control",
            "s",
            "by the error and the flow alone",
        ),
    ] = math.inf
    endTime: Annotated[
        float,
        Positive,
        Meaning(
            "end of the run, which also ends when no particle moves; the last step is shorter if this is no "
            "multiple of `deltaT`",
            "s",
            _OF_CONTROL,
        ),
    ] = math.nan
    writeInterval: Annotated[
        float,
        Positive,
        Meaning(
            "time between two writings, a multiple of `deltaT`; if `deltaT` or `endTime` is that of "
            "`system/controlDict`, so is this one",
            "s",
            "`endTime`",
        ),
    ] = math.nan
    writeFields: Annotated[
        Words,
        Choice(REQUESTED),
        Meaning(
            "`( name … )`, further [arrays](reference/files.md#arrays-of-a-cloud) of the particles; those of "
            "the shape can be derived when the files are read",
            default="none",
        ),
    ] = ()
    writePrecision: Annotated[
        Literal["single", "double"],
        Meaning(
            "precision of the numbers in the files of the cloud; `single` keeps positions double where their "
            "error would exceed 1 % of the smallest radius"
        ),
    ] = "single"
    startFrom: Annotated[
        StartFrom | None,
        Meaning(
            "`startTime`: start over; `latestTime`: continue from the last checkpoint, if it exists",
            default="as `startTime`, but an unfinished run is an error",
        ),
    ] = None
    startTime: Annotated[float, Only(0.0, "a cloud begins at time 0"), Meaning("accepted as 0", "s")] = 0.0
    maxFailedFraction: Annotated[
        float,
        Fraction,
        Meaning("the run ends when a larger share of the injected particles has failed", "1"),
    ] = 0.5
    maxStretch: Annotated[
        float, _ABOVE_ONE, Meaning("a particle with a larger stretch from its shape at rest fails", "1")
    ] = Limits.maxStretch
    maxSize: Annotated[
        float,
        Positive,
        Meaning(
            "a particle fails whose longest semi-axis is a larger share of the flow's width; at its start "
            "this is an error",
            "1",
        ),
    ] = Limits.maxSize
    maxSubSteps: Annotated[
        float, _FROM_ONE, Meaning("a particle with more time steps in one `deltaT` fails", "1")
    ] = Limits.maxSubSteps
    maxCells: Annotated[
        float,
        Positive,
        Meaning(
            "a particle fails whose longest semi-axis is longer than this number of cell sizes (the cube "
            "root of the volume of the cell at its centre)",
            "1",
            "none",
        ),
    ] = Limits.maxCells
    accept: Annotated[
        Words,
        Choice(FAULTS),
        Meaning(
            "`( name … )`, faults of the flow with which the run goes on, where it would end with an error: "
            "`movingMesh`, a mesh that moves is read at one time; `pseudoTime`, iterations are taken for "
            "times; `unbalanced`, half of the flow is lost by `phi`, or the velocity cannot be corrected to "
            "[keep volume](flow.md#volume)",
            default="none",
        ),
    ] = ()
    active: Annotated[bool, Only(True, "the cloud is not active, there is nothing to do")] = True
    coupled: Annotated[bool, _NOT_COUPLED] = False
    transient: Annotated[
        bool,
        Meaning(
            "the flow changes in time: it is read at all times, or the times of `-time a:b`, and is linear "
            "between them; the run begins at the first"
        ),
    ] = False
    period: Annotated[
        float | None, Positive, Meaning("with `transient`: period of the flow", "s", "none")
    ] = None
    tracers: Annotated[
        bool,
        Meaning(
            "points of the fluid start where and when the bodies do: the log has their fates beside those of "
            "the bodies, and the table `tracers`; they follow after the bodies' run, on its first process"
        ),
    ] = False
    scale: Annotated[
        float,
        Positive,
        Meaning(
            "lengths in [a mesh file](meshes.md#files) times `scale` are m; `-scale` takes precedence", "1"
        ),
    ] = 1.0
    mixture: Annotated[
        bool,
        Meaning(
            "viscosity and density of the fluid are those of [two phases](models/carrier.md#two-phases) "
            "at the particle, by their volume fractions"
        ),
    ] = False
    rotatingZones: Annotated[
        Literal["relative", "absolute"],
        Meaning(
            "[zones of `constant/MRFProperties`](models/rotating-zones.md): particles in them move "
            "relative to the rotor, or with the absolute velocity as without rotation"
        ),
    ] = "relative"
    cellValueSourceCorrection: Annotated[bool, _NOT_COUPLED] = False
    interpolationSchemes: InterpolationSchemes = InterpolationSchemes()
    integrationSchemes: IntegrationSchemes = IntegrationSchemes()
    maxCo: Annotated[
        None, NoEffect("the tracking step is deltaT, and walks go through any number of cells")
    ] = None
    sourceTerms: Annotated[None, _NO_SOURCES] = None
    averagingMethod: Annotated[None, _NO_SOURCES] = None

    @property
    def stride(self) -> int | None:
        """``maxDeltaT`` in tracking steps, rounded down; None without."""
        return (
            None
            if self.maxDeltaT == math.inf
            else max(1, int(self.maxDeltaT / self.deltaT * (1.0 + MULTIPLE_TOLERANCE)))
        )

    @property
    def limits(self) -> Limits:
        """Limits of a particle."""
        return Limits(self.maxStretch, self.maxSize, self.maxSubSteps, self.maxCells)


def read_solution(dictionary: Dictionary, case: Path) -> Solution:
    """Read ``solution``.

    A step or an end time that is not given is read from ``system/controlDict``, as for OpenFOAM's clouds,
    unless the solver's time counts iterations. The write interval is then read from there too.
    """
    mistakes = Mistakes()
    with mistakes:
        solution = read_entries(Solution, dictionary)
    times: dict[str, tuple[Entry, float]] = {}
    for key in ("deltaT", "endTime", "writeInterval", "maxDeltaT"):
        with mistakes:
            if key in dictionary.entries:
                times[key] = dictionary.entries[key], read_entry(dictionary, key, _TIME)
    if not {"deltaT", "endTime"} <= dictionary.entries.keys():
        for key, (entry, time) in _time_control(case).items():
            if key not in dictionary.entries:
                times[key] = entry, time
                log.info("%s: solution/%s is %g s, that of %s.", dictionary.source, key, time, _CONTROL)
    for key in ("deltaT", "endTime"):
        if key not in times and key not in dictionary.entries:
            mistakes.add(dictionary.missing(key, f"Allowed: {Positive.text}."))
    for key, (entry, time) in times.items() if "deltaT" in times else ():
        with mistakes:
            _check_time(key, entry, time, step=times["deltaT"][1])
    mistakes.raise_any()
    if solution.period is not None and not solution.transient:
        raise dictionary.entries["period"].mistake("needs a flow that changes in time: transient yes.")
    step, end = times["deltaT"][1], times["endTime"][1]
    interval = times["writeInterval"][1] if "writeInterval" in times else end
    longest = times["maxDeltaT"][1] if "maxDeltaT" in times else math.inf
    return replace(solution, deltaT=step, endTime=end, writeInterval=interval, maxDeltaT=longest)


def _check_time(key: str, entry: Entry, time: float, step: float) -> None:
    """Raise InputError for a time with too many steps, or that is inconsistent with the step."""
    if not time / step < MOST_STEPS:
        raise entry.mistake(
            f"is {time:g}, with deltaT = {step:g} that is {time / step:.3g} steps. Allowed: fewer than "
            f"{MOST_STEPS:.3g}."
        )
    steps = max(round(time / step), 1)
    if key == "writeInterval" and abs(steps * step - time) > MULTIPLE_TOLERANCE * time:
        raise entry.mistake(f"is {time:g}. Allowed: a multiple of deltaT = {step:g}.")
    if key == "maxDeltaT" and time < step * (1.0 - MULTIPLE_TOLERANCE):
        raise entry.mistake(f"is {time:g}. Allowed: at least deltaT = {step:g}.")


def _time_control(case: Path) -> dict[str, tuple[Entry, float]]:
    """Return the step, end time and write interval of ``system/controlDict``, s, with their entries.

    It is empty if the file is missing or broken, or if the time of a steady solver counts iterations. A write
    interval that is not a time is left out.
    """
    times: dict[str, tuple[Entry, float]] = {}
    try:
        if not (case / _CONTROL).is_file() or pseudo_time(case, ""):
            return times
        control = read_dictionary(case / _CONTROL, case)
        for key in ("deltaT", "endTime", "writeInterval"):
            if key in control.entries:
                times[key] = control.entries[key], read_entry(control, key, _TIME)
        if "writeInterval" in times:
            entry, interval = times.pop("writeInterval")
            kind = "timeStep"
            if "writeControl" in control.entries:
                kind = read_entry(control, "writeControl", str)
            if kind in ("runTime", "adjustable", "adjustableRunTime"):
                times["writeInterval"] = entry, interval
            elif kind == "timeStep" and "deltaT" in times:
                times["writeInterval"] = entry, interval * times["deltaT"][1]
    except InputError as error:
        log.info("%s", error)
    return times
