"""Dimensions as OpenFOAM writes them: exponents of kg, m, s, K, mol, A and cd, or units, ``[m s^-1]``."""

from __future__ import annotations

import re
from typing import TypeAlias

Dimensions: TypeAlias = tuple[float, ...]
"""Seven exponents."""

VELOCITY: Dimensions = (0, 1, -1, 0, 0, 0, 0)
RATE: Dimensions = (0, 0, -1, 0, 0, 0, 0)
VOLUME_FLUX: Dimensions = (0, 3, -1, 0, 0, 0, 0)
MASS_FLUX: Dimensions = (1, 0, -1, 0, 0, 0, 0)
KINEMATIC_VISCOSITY: Dimensions = (0, 2, -1, 0, 0, 0, 0)
DYNAMIC_VISCOSITY: Dimensions = (1, -1, -1, 0, 0, 0, 0)
DENSITY: Dimensions = (1, -3, 0, 0, 0, 0, 0)
ACCELERATION: Dimensions = (0, 1, -2, 0, 0, 0, 0)
SPECIFIC_ENERGY: Dimensions = (0, 2, -2, 0, 0, 0, 0)
DISSIPATION: Dimensions = (0, 2, -3, 0, 0, 0, 0)

_NAMES: dict[Dimensions, str] = {
    (0, 0, 0, 0, 0, 0, 0): "a number without unit",
    (0, 1, 0, 0, 0, 0, 0): "a length",
    (0, 0, 1, 0, 0, 0, 0): "a time",
    (1, 0, 0, 0, 0, 0, 0): "a mass",
    RATE: "a rate, such as a velocity's gradient",
    VELOCITY: "a velocity",
    ACCELERATION: "an acceleration",
    KINEMATIC_VISCOSITY: "a kinematic viscosity",
    DYNAMIC_VISCOSITY: "a dynamic viscosity",
    DENSITY: "a density",
    (1, -2, -1, 0, 0, 0, 0): "a momentum per volume (rhoU)",
    VOLUME_FLUX: "a flux of volume (phi)",
    MASS_FLUX: "a flux of mass (phi)",
    (1, -1, -2, 0, 0, 0, 0): "a pressure",
    SPECIFIC_ENERGY: "a kinematic pressure, or an energy per mass (k)",
    DISSIPATION: "a power per mass (epsilon)",
    (1, 1, -2, 0, 0, 0, 0): "a force",
}
_EXPONENT = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)", re.ASCII)
_UNITS: dict[str, Dimensions] = {
    "kg": (1, 0, 0, 0, 0, 0, 0),
    "m": (0, 1, 0, 0, 0, 0, 0),
    "s": (0, 0, 1, 0, 0, 0, 0),
    "K": (0, 0, 0, 1, 0, 0, 0),
    "mol": (0, 0, 0, 0, 1, 0, 0),
    "A": (0, 0, 0, 0, 0, 1, 0),
    "cd": (0, 0, 0, 0, 0, 0, 1),
    "N": (1, 1, -2, 0, 0, 0, 0),
    "Pa": (1, -1, -2, 0, 0, 0, 0),
}
_WORDS: dict[str, Dimensions] = {
    "length": (0, 1, 0, 0, 0, 0, 0), "area": (0, 2, 0, 0, 0, 0, 0), "volume": (0, 3, 0, 0, 0, 0, 0),
    "time": (0, 0, 1, 0, 0, 0, 0), "mass": (1, 0, 0, 0, 0, 0, 0), "temperature": (0, 0, 0, 1, 0, 0, 0),
    "moles": (0, 0, 0, 0, 1, 0, 0), "current": (0, 0, 0, 0, 0, 1, 0),
    "luminousIntensity": (0, 0, 0, 0, 0, 0, 1), "rate": RATE, "velocity": VELOCITY,
    "acceleration": ACCELERATION, "momentum": (1, 1, -1, 0, 0, 0, 0), "force": (1, 1, -2, 0, 0, 0, 0),
    "energy": (1, 2, -2, 0, 0, 0, 0), "power": (1, 2, -3, 0, 0, 0, 0), "density": DENSITY,
    "pressure": (1, -1, -2, 0, 0, 0, 0), "kinematicPressure": SPECIFIC_ENERGY,
    "compressibility": (0, -2, 2, 0, 0, 0, 0), "gasConstant": (0, 2, -2, -1, 0, 0, 0),
    "specificHeatCapacity": (0, 2, -2, -1, 0, 0, 0), "kinematicViscosity": KINEMATIC_VISCOSITY,
    "dynamicViscosity": DYNAMIC_VISCOSITY, "thermalConductivity": (1, 1, -3, -1, 0, 0, 0),
    "volumetricFlux": VOLUME_FLUX, "massFlux": MASS_FLUX,
    "turbulentKineticEnergy": SPECIFIC_ENERGY, "turbulentEpsilon": DISSIPATION, "turbulentOmega": RATE,
    "turbulentViscosity": KINEMATIC_VISCOSITY,
}  # fmt: skip
"""Dimensions that OpenFOAM.org's versions write by name, alone or in products."""
_SCALED = {
    "km": (1e3, "m"), "dm": (0.1, "m"), "cm": (1e-2, "m"), "mm": (1e-3, "m"), "um": (1e-6, "m"),
    "ms": (1e-3, "s"), "us": (1e-6, "s"), "min": (60.0, "s"), "hr": (3600.0, "s"), "g": (1e-3, "kg"),
    "kPa": (1e3, "Pa"), "mPa": (1e-3, "Pa"),
}  # fmt: skip
_SCALED_UNIT = re.compile(rf"(/\s*)?(?<![A-Za-z])({'|'.join(_SCALED)})(?![A-Za-z])(?:\^([-+]?\d+))?")
_NAMED = _UNITS | _WORDS
_UNIT = re.compile(rf"(/\s*)?({'|'.join(sorted(_NAMED, key=len, reverse=True))})(?:\^([-+]?\d+))?")


def read_dimensions(text: str) -> Dimensions | None:
    """Read ``[0 1 -1 0 0 0 0]``, its first five exponents, ``[m s^-1]`` or ``[velocity]``; None otherwise."""
    text = text.strip()
    if not (text.startswith("[") and text.endswith("]")):
        return None
    words = text[1:-1].split()
    if not words or not _EXPONENT.fullmatch(words[0]):
        return _of_units(text[1:-1].strip())
    if len(words) not in (5, 7):
        return None
    if not all(_EXPONENT.fullmatch(word) for word in words):
        return None
    return tuple(float(word) for word in (*words, "0", "0")[:7])


def _of_units(text: str) -> Dimensions | None:
    """Read a product of units or named dimensions, ``kg m^-3`` or ``velocity/length``."""
    sum_of_exponents, at = [0.0] * 7, 0
    while at < len(text):
        match = _UNIT.match(text, at)
        if match is None:
            return None
        power = float(match[3] or 1) * (-1.0 if match[1] else 1.0)
        sum_of_exponents = [a + power * b for a, b in zip(sum_of_exponents, _NAMED[match[2]], strict=True)]
        at = match.end()
        if at < len(text) and text[at] not in " /":
            return None
        at += len(text[at:]) - len(text[at:].lstrip(" "))
    return tuple(sum_of_exponents)


def read_unit(text: str) -> tuple[Dimensions, float] | None:
    """Read dimensions, or a unit of OpenFOAM.org's versions, ``[mm^2/s]``, with its factor to SI."""
    dimensions = read_dimensions(text)
    if dimensions is not None:
        return dimensions, 1.0
    unit, factor = text.strip(), 1.0

    def plain(match: re.Match[str]) -> str:
        nonlocal factor
        scale, unit = _SCALED[match[2]]
        factor *= scale ** (int(match[3] or 1) * (-1 if match[1] else 1))
        return f"{match[1] or ''}{unit}{f'^{match[3]}' if match[3] else ''}"

    dimensions = read_dimensions(_SCALED_UNIT.sub(plain, unit))
    return None if dimensions is None else (dimensions, factor)


def written(dimensions: Dimensions) -> str:
    """Return dimensions as OpenFOAM writes them."""
    return f"[{' '.join(f'{exponent:g}' for exponent in dimensions)}]"


def unit_text(dimensions: Dimensions) -> str:
    """Return the unit of a quantity in SI: ``m/s2``, ``kg/(m s)``, ``1/s``; ``1`` without one."""
    powers = list(zip(("kg", "m", "s", "K", "mol", "A", "cd"), dimensions, strict=True))
    above, below = (
        [f"{unit}{'' if n * sign == 1 else f'{n * sign:g}'}" for unit, n in powers if n * sign > 0]
        for sign in (1, -1)
    )
    bottom = f"({' '.join(below)})" if len(below) > 1 else "".join(below)
    return (" ".join(above) or "1") + (f"/{bottom}" if below else "")


def described(dimensions: Dimensions) -> str:
    """Return dimensions and a quantity that has them: ``[0 1 -1 0 0 0 0], those of a velocity``."""
    name = _NAMES.get(dimensions)
    return written(dimensions) + (f", those of {name}" if name else "")
