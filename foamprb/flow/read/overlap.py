"""cyclicACMI patches, whose faces a mesh lists twice: as couples, and as walls of ``nonOverlapPatch``.

Where the neighbour covers a face, OpenFOAM takes the couple, elsewhere the wall.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path

import numpy as np

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PatchSurface, surface_of
from foamprb.flow.mesh.coupling import closest
from foamprb.flow.mesh.lists import Labels, Mask
from foamprb.flow.read.boundary import PatchInfo

_TYPE = "cyclicACMI"
# Distance of the middle of a covered face from the neighbour, as a fraction of the face's size.
_APART = 0.1


def used_faces(
    points: Floats, start: Labels, lists: Labels, patches: Sequence[PatchInfo], path: Path
) -> dict[str, Mask]:
    """Return which faces of couples and of their walls count, by the names of the patches.

    A face counts as covered if its middle lies on the neighbour.

    Parameters
    ----------
    points, start, lists
        Points (n, 3), m, and the points of each face.
    patches, path
        The patches, and their file for messages.

    Raises
    ------
    InputError
        A neighbour or the patch of the walls is not there, or has other faces; or the couple is transformed.
    """
    known, used = {patch.name: patch for patch in patches}, dict[str, Mask]()
    for patch in patches:
        wall = patch.entries.get("nonOverlapPatch", "")
        if patch.type != _TYPE or not patch.faces:
            continue
        for key, name in (("neighbourPatch", patch.neighbour), ("nonOverlapPatch", wall)):
            if name not in known:
                raise InputError(
                    f"{path}: {key} of patch {patch.name} is '{name}'. {suggestion(name, known)}"
                )
        if known[wall].faces != patch.faces:
            raise InputError(
                f"{path}: patch {patch.name} has {patch.faces} faces, its nonOverlapPatch {wall} "
                f"{known[wall].faces}. Allowed: the same faces in both."
            )
        if patch.transform.kind in ("rotational", "translational"):
            raise InputError(
                f"{path}: patch {patch.name} is of type {_TYPE} and {patch.transform.kind}. "
                "Allowed: couples that coincide (transform noOrdering)."
            )
        covered = _covered(points, start, lists, patch, known[patch.neighbour])
        used |= {patch.name: covered, wall: ~covered}
    return used


def _covered(points: Floats, start: Labels, lists: Labels, patch: PatchInfo, other: PatchInfo) -> Mask:
    """Return whether the middle of each face of a patch lies on another patch."""
    if other.faces == 0:
        return np.zeros(patch.faces, dtype=bool)
    faces = np.arange(patch.start, patch.start + patch.faces)
    corners = [points[lists[start[face] : start[face + 1]]] for face in faces]
    middles = np.array([c.mean(axis=0) for c in corners])
    sizes = np.array([np.linalg.norm(c - c.mean(axis=0), axis=1).min() for c in corners])
    there = surface_of(points, start, lists, slice(other.start, other.start + other.faces))
    covered: Mask = np.linalg.norm(closest(there, middles)[1] - middles, axis=1) <= _APART * sizes
    return covered


def reduced(patches: Sequence[PatchInfo], used: Mapping[str, Mask]) -> tuple[PatchInfo, ...]:
    """Return the patches with the faces that count; ``PatchInfo.rows`` has them."""
    first, found = patches[0].start if patches else 0, []
    for patch in patches:
        rows = used.get(patch.name)
        count = patch.faces if rows is None else int(rows.sum())
        found.append(patch._replace(faces=count, start=first, rows=rows))
        first += count
    return tuple(found)


def as_interfaces(surfaces: Sequence[PatchSurface]) -> list[PatchSurface]:
    """Return patches of a mesh with cyclicACMI patches as the cyclicAMI patches that remain of them."""
    return [s._replace(type="cyclicAMI") if s.type == _TYPE else s for s in surfaces]
