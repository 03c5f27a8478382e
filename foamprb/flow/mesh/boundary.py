"""Which patch each face of the boundary belongs to."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats, Patch
from foamprb.flow.mesh.geometry import Faces
from foamprb.flow.mesh.lists import Index, cell_array, points_of, starts, take_lists

_Hash: TypeAlias = NDArray[np.uint64]


class Transform(NamedTuple):
    """What ``polyMesh/boundary`` says of the way from a cyclicAMI patch to its neighbour."""

    kind: str = ""
    """``translational`` or ``rotational``; else the two patches lie in the same place."""
    separation: tuple[float, float, float] | None = None
    """m."""
    axis: tuple[float, float, float] = (0.0, 0.0, 0.0)
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """m."""
    angle: float | None = None
    """Radians."""


class PatchSurface(NamedTuple):
    """A patch with its faces, ``surface`` a ``vtkPolyData`` with points of its own."""

    name: str
    type: str
    surface: Any
    neighbour: str = ""
    """The patch that a cyclic patch leads to."""
    transform: Transform = Transform()


def sort_boundary(faces: Faces, order: Index) -> None:
    """Put the boundary faces in the given order."""
    n_internal = len(faces.neighbour)
    ends, moved = take_lists(faces.start, faces.points, n_internal + order)
    faces.start[n_internal:] = faces.start[n_internal] + ends
    faces.points[faces.start[n_internal] :] = moved
    faces.owner[n_internal:] = faces.owner[n_internal + order]
    place = np.empty(len(order), dtype=np.int32)
    place[order] = np.arange(n_internal, len(faces.owner), dtype=np.int32)
    outside = np.flatnonzero(faces.of_cell >= n_internal)
    faces.of_cell[outside] = place[faces.of_cell[outside] - n_internal]


def assign_patches(
    points: Floats,
    dtype: Any,
    faces: Faces,
    surfaces: Sequence[PatchSurface] | None,
    source: str,
) -> tuple[Index, tuple[Patch, ...], Index]:
    """Order of the boundary faces by patch; the patches; where each begins."""
    boundary = np.arange(len(faces.neighbour), len(faces.owner))
    if surfaces is None:
        return np.arange(len(boundary)), (Patch("boundary", "wall"),), np.array([0, len(boundary)])
    start, lists = take_lists(faces.start, faces.points, boundary)
    polygons = [cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [points_of(surface.surface).astype(dtype, copy=False) for surface in surfaces]
    used, local = np.unique(lists, return_inverse=True)
    # A point is known by its coordinates; adding zero makes −0 equal to 0.
    coordinates = np.concatenate([points[used].astype(dtype), *clouds]) + 0
    place = np.unique(coordinates, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
    codes = _turning_codes(start, place[local])
    order = np.argsort(codes, kind="stable")

    chosen: list[Index] = []
    first_point = len(used)
    for surface, (poly_start, poly_points), cloud in zip(surfaces, polygons, clouds, strict=True):
        ids = place[first_point + poly_points]
        first_point += len(cloud)
        found = _find(codes, order, _turning_codes(poly_start, ids))
        # Two patches may lie on the same points (baffles): then only the sense of rotation tells them apart.
        astray = found < 0
        found[astray] = _find(codes, order, _turning_codes(poly_start, ids, reverse=True))[astray]
        if np.any(found < 0):
            raise InputError(
                f"{source}: {np.count_nonzero(found < 0)} of the {len(found)} faces of patch {surface.name} "
                "are not on the boundary of the mesh."
            )
        chosen.append(found)
    found = np.concatenate([np.empty(0, dtype=np.intp), *chosen])
    times = np.bincount(found, minlength=len(boundary))
    names = ", ".join(surface.name for surface in surfaces) or "(none)"
    if np.any(times == 0):
        raise InputError(
            f"{source}: {np.count_nonzero(times == 0)} of {len(boundary)} boundary faces belong to no patch; "
            f"the patches are {names}."
        )
    if np.any(times > 1):
        raise InputError(
            f"{source}: {np.count_nonzero(times > 1)} boundary faces belong to more than one of the patches "
            f"{names}."
        )
    patches = tuple(Patch(surface.name, surface.type, surface.neighbour) for surface in surfaces)
    return found, patches, starts(np.array([len(part) for part in chosen], dtype=np.intp))


def mix(ids: Index) -> _Hash:
    """Scramble ids into 64 bits (the finalizer of splitmix64)."""
    code = (ids.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    code = (code ^ (code >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    code = (code ^ (code >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return code ^ (code >> np.uint64(31))


def _turning_codes(start: Index, lists: Index, reverse: bool = False) -> _Hash:
    """Hash of each list that does not depend on where it begins, but on which way it turns."""
    if len(start) < 2:
        return np.empty(0, dtype=np.uint64)
    following = np.roll(lists, -1)
    following[start[1:] - 1] = lists[start[:-1]]
    a, b = (following, lists) if reverse else (lists, following)
    return np.add.reduceat(mix((mix(a) + mix(b) * np.uint64(3)).view(np.intp)), start[:-1])


def _find(codes: _Hash, order: Index, wanted: _Hash) -> Index:
    """Position of each wanted code, −1 when absent."""
    if len(codes) == 0:
        return np.full(len(wanted), -1, dtype=np.intp)
    at = order[np.minimum(np.searchsorted(codes, wanted, sorter=order), len(codes) - 1)]
    return np.where(codes[at] == wanted, at, -1)
