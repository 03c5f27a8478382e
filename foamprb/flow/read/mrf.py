"""Rotating zones of ``constant/MRFProperties``."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.patterns import matches
from foamprb.dictionary.tree import Dictionary, Entry, Stream, unquoted
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import require_cells
from foamprb.flow.patches import PatchKind
from foamprb.flow.read.case import active_zones, find_dictionary, word_of
from foamprb.flow.rotating import RotatingZone

_NUMBER = r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?)"
_SCALAR = re.compile(rf"(?:\w+ )?(?:\[[^\]]*\] )?(?:constant )?{_NUMBER}")
_VECTOR = re.compile(rf"(?:\w+ )?(?:\[[^\]]*\] )?\( {_NUMBER} {_NUMBER} {_NUMBER} \)")


class Rotation(NamedTuple):
    """Entry of a zone in the dictionary."""

    name: str
    """Name of the entry."""
    zone: str
    """Name of the zone of cells."""
    omega: tuple[float, float, float]
    """Ω, 1/s."""
    origin: tuple[float, float, float]
    """A point of the axis, m."""
    still: tuple[str, ...]
    """Names or patterns of patches that do not rotate."""
    source: str
    """Dictionary, for messages."""


def read_rotations(case: Path, region: str) -> tuple[Rotation, ...]:
    """Read the active zones."""
    root = find_dictionary(case, region, "MRFProperties")
    return () if root is None else tuple(map(_rotation, active_zones(root)))


def rotating_zones(
    rotations: Sequence[Rotation], zones: Mapping[str, NDArray[np.int64]], n_cells: int
) -> list[RotatingZone]:
    """Find the cells of the zones."""
    found = []
    for rotation in rotations:
        if rotation.zone not in zones:
            raise InputError(
                f"{rotation.source}: cellZone is '{rotation.zone}', which the mesh does not have. "
                f"{suggestion(rotation.zone, zones)}"
            )
        cells = require_cells(rotation.zone, zones[rotation.zone], n_cells)
        found.append(RotatingZone(rotation.name, cells, rotation.omega, rotation.origin))
    return found


def with_rotating_walls(
    boundary: Floats, mesh: Mesh, rotations: Sequence[Rotation], zones: Sequence[RotatingZone]
) -> Floats:
    """Return the boundary velocities (n_boundary, 3) with Ω × r at walls in a zone, as OpenFOAM sets them."""
    values = boundary.copy()
    owner = mesh.owner[mesh.n_internal :]
    patch_of_face = np.repeat(np.arange(len(mesh.patches)), np.diff(mesh.patch_start))
    for rotation, zone in zip(rotations, zones, strict=True):
        turning = [
            patch.kind is PatchKind.WALL and not any(matches(word, patch.name) for word in rotation.still)
            for patch in mesh.patches
        ]
        inside = np.zeros(mesh.n_cells, dtype=bool)
        inside[zone.cells] = True
        rows = np.flatnonzero(inside[owner] & np.array(turning, dtype=bool)[patch_of_face])
        values[rows] = np.cross(np.array(zone.omega), mesh.boundary_centres[rows] - np.array(zone.origin))
    return values


def _rotation(zone: Dictionary) -> Rotation:
    speed = _numbers(zone, "omega", _SCALAR, "a constant angular velocity in rad/s")[0]
    origin = _numbers(zone, "origin", _VECTOR, "a vector (x y z)")
    axis = np.array(_numbers(zone, "axis", _VECTOR, "a vector (x y z) that is not zero"))
    most = np.abs(axis).max()
    if most == 0.0:
        raise zone.entries["axis"].mistake("is zero. Allowed: a vector (x y z) that is not zero.")
    # The squares of very large or very small components overflow or underflow.
    axis /= most
    x, y, z = (speed / np.linalg.norm(axis) * axis).tolist()
    still = zone.entries.get("nonRotatingPatches")
    words = still.tokens if isinstance(still, Stream) else ()
    return Rotation(
        zone.key,
        unquoted(word_of(zone, "cellZone", zone.key)),
        (x, y, z),
        (origin[0], origin[1], origin[2]),
        tuple(unquoted(word) for word in words if word not in "()" and not word.isdigit()),
        str(zone.source),
    )


def _numbers(zone: Dictionary, key: str, pattern: re.Pattern[str], allowed: str) -> list[float]:
    entry: Entry | None = zone.entries.get(key)
    if entry is None:
        raise zone.missing(key, f"Allowed: {allowed}.")
    match = pattern.fullmatch(entry.text) if isinstance(entry, Stream) else None
    found = [] if match is None else [float(number) for number in match.groups()]
    if not found or not all(map(math.isfinite, found)):
        raise entry.mistake(f"is {entry}. Allowed: {allowed}; or solution/rotatingZones absolute.")
    return found
