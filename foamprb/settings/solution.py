"""Steps and times of a run: from ``solution``, or from ``system/controlDict`` as far as that has none."""

from __future__ import annotations

import logging
import math
from pathlib import Path
from typing import Annotated

from foamprb.cloud.limits import Limits
from foamprb.dictionary.constraints import Positive
from foamprb.dictionary.grammar import read_dictionary
from foamprb.dictionary.mistakes import Mistakes
from foamprb.dictionary.schema import read_entries, read_entry
from foamprb.dictionary.tree import Dictionary, Entry
from foamprb.errors import InputError
from foamprb.settings import entries
from foamprb.settings.settings import Solution

__all__ = ["read_solution"]

log = logging.getLogger("foamprb")

_CONTROL, _SCHEMES = Path("system/controlDict"), Path("system/fvSchemes")
_TIME = Annotated[float, Positive]
MULTIPLE_TOLERANCE = 1e-6
"""Relative error of a write interval that counts as a multiple of the step."""
STRIDE = 8
"""How many tracking steps long a step of an integrator that chooses its own may be by default."""
MOST_STEPS = 2**53
"""From there on not every step has a number of its own in double precision."""


def read_solution(dictionary: Dictionary, case: Path) -> Solution:
    """Read ``solution``.

    A step or an end time that it does not give is that of ``system/controlDict``, as for OpenFOAM's clouds,
    unless the solver's time counts iterations; and then so is the write interval.

    Raises
    ------
    InputError
        If there are mistakes, all of them.
    """
    mistakes = Mistakes()
    with mistakes:
        solution = read_entries(entries.Solution, dictionary)
    times: dict[str, tuple[Entry, float]] = {}
    for key in ("deltaT", "endTime", "writeInterval"):
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
    for key, require in (("endTime", _require_steps), ("writeInterval", _require_multiple)):
        with mistakes:
            if key in times and "deltaT" in times:
                require(*times[key], times["deltaT"][1])
    stride = STRIDE
    with mistakes:
        if "maxDeltaT" in dictionary.entries and "deltaT" in times:
            longest = read_entry(dictionary, "maxDeltaT", _TIME)
            stride = _stride(dictionary.entries["maxDeltaT"], longest, times["deltaT"][1])
    mistakes.raise_any()
    if solution.period is not None and not solution.transient:
        raise dictionary.entries["period"].mistake("needs a flow that changes in time: transient yes.")
    end = times["endTime"][1]
    return Solution(
        deltaT=times["deltaT"][1],
        endTime=end,
        writeInterval=times["writeInterval"][1] if "writeInterval" in times else end,
        shape=solution.integrationSchemes.shape,
        tolerance=solution.integrationSchemes.tolerance,
        stride=stride,
        transient=solution.transient,
        period=solution.period,
        rotatingZones=solution.rotatingZones,
        startFrom=solution.startFrom,
        maxFailedFraction=solution.maxFailedFraction,
        limits=Limits(
            solution.maxStretch, solution.maxSize, solution.maxSubSteps, solution.maxCells or math.inf
        ),
    )


def _require_steps(entry: Entry, time: float, step: float) -> None:
    """Raise InputError if a time is so many steps that they cannot be counted."""
    if not time / step < MOST_STEPS:
        raise entry.mistake(
            f"is {time:g}, with deltaT = {step:g} that is {time / step:.3g} steps. Allowed: fewer than "
            f"{MOST_STEPS:.3g}."
        )


def _require_multiple(entry: Entry, interval: float, step: float) -> None:
    """Raise InputError if a write interval is not a multiple of the step."""
    _require_steps(entry, interval, step)
    steps = max(round(interval / step), 1)
    if abs(steps * step - interval) > MULTIPLE_TOLERANCE * interval:
        raise entry.mistake(f"is {interval:g}. Allowed: a multiple of deltaT = {step:g}.")


def _stride(entry: Entry, longest: float, step: float) -> int:
    """The largest number of steps up to ``longest``, s; raise InputError if there is not even one."""
    _require_steps(entry, longest, step)
    if longest < step * (1.0 - MULTIPLE_TOLERANCE):
        raise entry.mistake(f"is {longest:g}. Allowed: at least deltaT = {step:g}.")
    return max(1, int(longest / step * (1.0 + MULTIPLE_TOLERANCE)))


def _time_control(case: Path) -> dict[str, tuple[Entry, float]]:
    """Return the step, end time and write interval of ``system/controlDict``, s, with their entries.

    Nothing of a file that is missing or cannot be read, or of a steady solver's, whose time counts
    iterations; no write interval that is not one of time.
    """
    found: dict[str, tuple[Entry, float]] = {}
    try:
        if not (case / _CONTROL).is_file() or _counts_iterations(case):
            return found
        control = read_dictionary(case / _CONTROL, case)
        for key in ("deltaT", "endTime", "writeInterval"):
            if key in control.entries:
                found[key] = control.entries[key], read_entry(control, key, _TIME)
        if "writeInterval" in found:
            entry, interval = found.pop("writeInterval")
            kind = "timeStep"
            if "writeControl" in control.entries:
                kind = read_entry(control, "writeControl", str)
            if kind in ("runTime", "adjustable", "adjustableRunTime"):
                found["writeInterval"] = entry, interval
            elif kind == "timeStep" and "deltaT" in found:
                found["writeInterval"] = entry, interval * found["deltaT"][1]
    except InputError as error:
        log.info("%s", error)
    return found


def _counts_iterations(case: Path) -> bool:
    """Whether the time derivatives of ``system/fvSchemes`` are those of a steady solver."""
    if not (case / _SCHEMES).is_file():
        return False
    schemes = read_dictionary(case / _SCHEMES, case).entries.get("ddtSchemes")
    default = schemes.entries.get("default") if isinstance(schemes, Dictionary) else None
    return default is not None and any(word in str(default) for word in ("steadyState", "localEuler"))
