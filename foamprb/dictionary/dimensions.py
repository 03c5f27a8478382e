"""Dimensions as OpenFOAM writes them: exponents of kg, m, s, K, mol, A and cd."""

from __future__ import annotations

import re
from typing import TypeAlias

__all__ = [
    "ACCELERATION",
    "DENSITY",
    "KINEMATIC_VISCOSITY",
    "Dimensions",
    "described",
    "read_dimensions",
    "written",
]

Dimensions: TypeAlias = tuple[float, ...]
"""Seven exponents."""

KINEMATIC_VISCOSITY: Dimensions = (0, 2, -1, 0, 0, 0, 0)
DENSITY: Dimensions = (1, -3, 0, 0, 0, 0, 0)
ACCELERATION: Dimensions = (0, 1, -2, 0, 0, 0, 0)

_NAMES: dict[Dimensions, str] = {
    (0, 0, 0, 0, 0, 0, 0): "a number without unit",
    (0, 1, 0, 0, 0, 0, 0): "a length",
    (0, 0, 1, 0, 0, 0, 0): "a time",
    (1, 0, 0, 0, 0, 0, 0): "a mass",
    (0, 0, -1, 0, 0, 0, 0): "a rate",
    (0, 1, -1, 0, 0, 0, 0): "a velocity",
    ACCELERATION: "an acceleration",
    KINEMATIC_VISCOSITY: "a kinematic viscosity",
    (1, -1, -1, 0, 0, 0, 0): "a dynamic viscosity",
    DENSITY: "a density",
    (1, -2, -1, 0, 0, 0, 0): "a momentum per volume (rhoU)",
    (0, 3, -1, 0, 0, 0, 0): "a flux of volume (phi)",
    (1, 0, -1, 0, 0, 0, 0): "a flux of mass (phi)",
    (1, -1, -2, 0, 0, 0, 0): "a pressure",
    (0, 2, -2, 0, 0, 0, 0): "a kinematic pressure",
    (1, 1, -2, 0, 0, 0, 0): "a force",
}
_EXPONENT = re.compile(r"[-+]?(?:\d+\.?\d*|\.\d+)", re.ASCII)


def read_dimensions(text: str) -> Dimensions | None:
    """Read ``[0 1 -1 0 0 0 0]``, or the first five of these exponents; None if the text is something else."""
    words = text.strip().removeprefix("[").removesuffix("]").split()
    if not (text.strip().startswith("[") and text.strip().endswith("]")) or len(words) not in (5, 7):
        return None
    if not all(_EXPONENT.fullmatch(word) for word in words):
        return None
    return tuple(float(word) for word in (*words, "0", "0")[:7])


def written(dimensions: Dimensions) -> str:
    """Return dimensions as OpenFOAM writes them."""
    return f"[{' '.join(f'{exponent:g}' for exponent in dimensions)}]"


def described(dimensions: Dimensions) -> str:
    """Return dimensions and what has them: ``[0 1 -1 0 0 0 0], those of a velocity``."""
    name = _NAMES.get(dimensions)
    return written(dimensions) + (f", those of {name}" if name else "")
