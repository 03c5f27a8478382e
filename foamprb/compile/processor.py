"""Processor for which code is compiled.

Machines of one level run the same code and get the same bits, whatever the names of their processors. An x86
processor between two levels counts as the lower one.
"""

from __future__ import annotations

import os
import platform
from functools import cache
from typing import NamedTuple

from foamprb.errors import InputError

__all__ = ["SWITCH", "Processor", "processor"]

SWITCH = "FOAMPRB_CPU"
"""Environment variable: a level of the processor, or ``native`` for all of its features."""

_LEVELS = {
    "x86-64": (2, ""),
    "x86-64-v3": (4, "avx avx2 bmi bmi2 f16c fma lzcnt movbe"),
    "x86-64-v4": (8, "avx512f avx512bw avx512cd avx512dq avx512vl"),
}
"""Doubles in a register, and LLVM's features that a level adds, by its name."""


class Processor(NamedTuple):
    """Processor, as LLVM knows it."""

    level: str
    """Name in keys of compiled code."""
    name: str
    features: str
    register: int
    """Number of doubles in a register."""


@cache
def processor() -> Processor:
    """Return the processor for which this process compiles.

    Numba's variables ``NUMBA_CPU_NAME`` and ``NUMBA_CPU_FEATURES`` have priority, then :data:`SWITCH`; the
    default is the highest level of this machine.

    Raises
    ------
    InputError
        If :data:`SWITCH` is not a level of this machine.
    """
    import numba
    from llvmlite import binding  # type: ignore[import-untyped]

    name, features = numba.config.CPU_NAME, numba.config.CPU_FEATURES
    host = binding.get_host_cpu_features()
    levels = _levels({feature for feature, present in host.items() if present})
    chosen = os.environ.get(SWITCH) or next(reversed(levels))
    if (name, features) == (None, None) and chosen in levels:
        name = "generic" if chosen == "arm64" else chosen
        return Processor(chosen, name, "", levels[chosen])
    if (name, features) == (None, None) and chosen != "native":
        raise InputError(f"{SWITCH} is {chosen}; allowed on this machine: {', '.join(levels)}, native")
    name = name or binding.get_host_cpu_name()
    features = host.flatten() if features is None else features
    present = {feature.lstrip("+") for feature in features.split(",") if feature.startswith("+")}
    # A name with its own features, such as skylake-avx512, counts as the baseline.
    register = max(_LEVELS.get(name, (2,))[0], *_levels(present).values())
    return Processor(f"{name} {features}", name, features, register)


def _levels(present: set[str]) -> dict[str, int]:
    """Return the levels of a processor with some features, lowest first, and their registers."""
    if platform.machine() in ("aarch64", "arm64"):
        return {"arm64": 2}
    levels: dict[str, int] = {}
    for level, (register, features) in _LEVELS.items():
        if not present.issuperset(features.split()):
            break
        levels[level] = register
    return levels
