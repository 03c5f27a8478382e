"""Density of the fluid of a case, which decides whether the flow keeps volume or mass."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any

import numpy as np

from foamprb.dictionary.dimensions import MASS_FLUX, VOLUME_FLUX
from foamprb.dictionary.tree import Dictionary
from foamprb.errors import InputError
from foamprb.flow.balance import CONSTANT, Mass
from foamprb.flow.base import Floats
from foamprb.flow.read.boundary import CaseMesh
from foamprb.flow.read.case import find_dictionary
from foamprb.flow.read.checks import require_numbers
from foamprb.flow.read.field import DENSITY_FIELD, PRESSURE_FIELD, TEMPERATURE_FIELD, FoamField, Kind
from foamprb.flow.read.fluid import density_of_state
from foamprb.flow.read.turbulence import values_of

Read = Callable[[str, Kind], FoamField]
"""Reads the field of a name and a kind."""
FLUX_FIELD = Kind("surfaceScalarField", "scalar", (VOLUME_FLUX, MASS_FLUX), "a flux")
_MIXTURES = ("thermophysicalProperties", "physicalProperties")
_STATE = ("p", PRESSURE_FIELD), ("T", TEMPERATURE_FIELD)
_ROUND_OFF = 1e-6


def mass_of(
    case: Path,
    region: str,
    whole: CaseMesh,
    times: Sequence[str],
    reads: Sequence[Read],
    index: int,
    velocity: str = "U",
    density_at: Callable[[int], tuple[Floats, Floats] | None] | None = None,
) -> Mass | None:
    """Return the density of a flow at one of its times; None if it varies, but is not known.

    A case without ``rho`` and without a mixture (``thermoType``) keeps volume. Where ``phi`` is a flux of
    volume, it does so, even if the density of phases differs; the velocity of one phase (``U.air``) keeps
    neither volume nor mass. Else the density is ``rho``, or follows from ``p``, ``T`` and the equation of
    state. Its rate of change is that between the times before and after.

    Parameters
    ----------
    case, region, whole
        The case, a region of its mesh, and its mesh.
    times, reads
        The times of the flow, and the functions that read a field there.
    index
        Which of them.
    velocity
        Name of the velocity.
    density_at
        Returns :func:`density_of` on the mesh at the time of an index, if each time has another mesh.
    """
    if "." in velocity:
        return None
    root, read = _mixture(case, region), reads[index]
    if root is None and not len(densities(read)):
        return CONSTANT
    flux = _dimensions(read)
    if flux == VOLUME_FLUX:
        return CONSTANT
    near = sorted({max(index - 1, 0), index, min(index + 1, len(reads) - 1)})
    density_at = density_at or (lambda i: density_of(case, region, reads[i], whole))
    pairs = {i: density_at(i) for i in near}
    values = {i: pair for i, pair in pairs.items() if pair is not None}
    if len(values) < len(near):
        return None
    if not varies(np.concatenate([array for pair in values.values() for array in pair])):
        return CONSTANT
    if flux is None and root is None:
        return None
    before, after = near[0], near[-1]
    passed = float(times[after]) - float(times[before])
    growth = (values[after][0] - values[before][0]) / passed if passed > 0.0 else np.zeros(1)
    return Mass(*values[index], growth)


def densities(read: Read) -> Floats:
    """Return ``rho`` at the cells, kg/m³, or no values."""
    try:
        rho = read("rho", DENSITY_FIELD)
    except InputError:
        return np.empty((0, 1))
    require_numbers(rho.cells, rho.path, "value", "at cell")
    return rho.cells


def varies(values: Floats) -> bool:
    """Return True if the smallest and the largest value differ by more than round-off; False for none."""
    low, high = values.min(initial=np.inf), values.max(initial=-np.inf)
    return bool(high - low > _ROUND_OFF * max(abs(low), abs(high)))


def _mixture(case: Path, region: str) -> Dictionary | None:
    """Return the dictionary of a compressible solver's fluid; None without one that can be read."""
    try:
        root = find_dictionary(case, region, *_MIXTURES)
    except InputError:
        return None
    return root if root is not None and "thermoType" in root.entries else None


def _dimensions(read: Read) -> Any:
    try:
        return read("phi", FLUX_FIELD).dimensions
    except InputError:
        return None


def density_of(case: Path, region: str, read: Read, whole: CaseMesh) -> tuple[Floats, Floats] | None:
    """Return the density at cells (n_cells,) and boundary faces (n_boundary,); None if it is not known."""
    root = _mixture(case, region)
    try:
        rho, outside = values_of(read("rho", DENSITY_FIELD), whole)
    except InputError:
        if root is None:
            return None
        try:
            p, T = (values_of(read(*field), whole) for field in _STATE)
        except InputError:
            return None
        of_state = density_of_state(root, np.concatenate(p), np.concatenate(T))
        if of_state is None:
            return None
        both = np.broadcast_to(of_state, len(p[0]) + len(p[1]))
        rho, outside = both[: len(p[0])], both[len(p[0]) :]
    return (rho, outside) if min(rho.min(), outside.min(initial=np.inf)) > 0.0 else None
