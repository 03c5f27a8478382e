"""Patches of the boundary faces, and baffles: walls without thickness inside the mesh.

A baffle is a face between two cells that belongs to a patch on either side.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints, Patch
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.lists import Index, Labels, Mask, cell_array, points_of, starts, take_lists

_Hash: TypeAlias = NDArray[np.uint64]


class Transform(NamedTuple):
    """Motion from a cyclicAMI patch to its neighbour, as ``polyMesh/boundary`` states it."""

    kind: str = ""
    """``translational`` or ``rotational``; otherwise the two patches coincide."""
    separation: tuple[float, float, float] | None = None
    """m."""
    axis: tuple[float, float, float] = (0.0, 0.0, 0.0)
    centre: tuple[float, float, float] = (0.0, 0.0, 0.0)
    """m."""
    angle: float | None = None
    """Radians."""


class PatchSurface(NamedTuple):
    """Patch, and its faces if they are not yet those of a mesh."""

    name: str
    type: str
    surface: Any
    """``vtkPolyData`` with points of its own, or None."""
    neighbour: str = ""
    """Neighbour of a cyclic patch."""
    transform: Transform = Transform()
    groups: frozenset[str] = frozenset()


class PolyMesh(NamedTuple):
    """Points, faces and patches of a mesh."""

    points: Floats
    """(n_points, 3), m."""
    faces: Faces
    patches: Sequence[PatchSurface]
    patch_start: Index
    """(n_patches + 1,): boundary faces of patch p are ``patch_start[p]`` to ``patch_start[p + 1]``."""
    used: Mapping[str, Mask] = {}
    """Which of the faces that the file lists count, by the names of patches of which some do not."""


def patches_of(surfaces: Sequence[PatchSurface], patch_start: Index) -> list[Patch]:
    """Return the patches of a mesh, before they are coupled."""
    faceless = (np.diff(patch_start) == 0).tolist()
    return [Patch(s.name, s.type, s.neighbour, s.groups, f) for s, f in zip(surfaces, faceless, strict=True)]


def sort_boundary(faces: Faces, order: Index) -> None:
    """Sort the boundary faces into the given order."""
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
    surfaces: Sequence[PatchSurface],
    source: str,
) -> tuple[Index, Index]:
    """Return the order of the boundary faces by patch, and the first face of each patch."""
    boundary = np.arange(len(faces.neighbour), len(faces.owner))
    start, lists = take_lists(faces.start, faces.points, boundary)
    polygons = [cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [points_of(surface.surface).astype(dtype, copy=False) for surface in surfaces]
    used, local = np.unique(lists, return_inverse=True)
    # Points are identified by their coordinates; adding zero makes −0 equal to 0.
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
        # Two patches may lie on the same points (baffles) and differ only in the sense of rotation.
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
    return found, starts(np.array([len(part) for part in chosen], dtype=np.intp))


def mix(ids: Labels) -> _Hash:
    """Scramble ids into 64 bits (the finalizer of splitmix64)."""
    code = (ids.astype(np.uint64) + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)
    code = (code ^ (code >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    code = (code ^ (code >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    return code ^ (code >> np.uint64(31))


def _turning_codes(start: Index, lists: Index, reverse: bool = False) -> _Hash:
    """Return a hash of each list that depends on its sense of rotation, not on its first entry."""
    if len(start) < 2:
        return np.empty(0, dtype=np.uint64)
    following = np.roll(lists, -1)
    following[start[1:] - 1] = lists[start[:-1]]
    a, b = (following, lists) if reverse else (lists, following)
    return np.add.reduceat(mix((mix(a) + mix(b) * np.uint64(3)).view(np.intp)), start[:-1])


def _find(codes: _Hash, order: Index, wanted: _Hash) -> Index:
    """Return the position of each wanted code, −1 if absent."""
    if len(codes) == 0:
        return np.full(len(wanted), -1, dtype=np.intp)
    at = order[np.minimum(np.searchsorted(codes, wanted, sorter=order), len(codes) - 1)]
    return np.where(codes[at] == wanted, at, -1)


def find_baffles(
    points: Floats,
    dtype: Any,
    start: Ints,
    lists: Ints,
    mate: Ints,
    surfaces: Sequence[PatchSurface] | None,
) -> Mask:
    """Return True for matched half faces that belong to patches."""
    inside = mate != np.arange(len(mate), dtype=np.int32)
    faces = sum(surface.surface.GetNumberOfCells() for surface in surfaces or ())
    if surfaces is None or faces <= np.count_nonzero(~inside):
        return np.zeros(len(mate), dtype=bool)
    polygons = [cell_array(surface.surface.GetPolys()) for surface in surfaces]
    clouds = [points_of(surface.surface).astype(dtype, copy=False) for surface in surfaces]
    coordinates = np.concatenate([points.astype(dtype), *clouds]) + 0
    place = np.unique(coordinates, axis=0, return_inverse=True)[1].reshape(-1).astype(np.intp)
    begin, wanted = len(points), []
    for (poly_start, poly_points), cloud in zip(polygons, clouds, strict=True):
        if len(poly_start) > 1:
            wanted.append(np.add.reduceat(mix(place[begin + poly_points]), poly_start[:-1]))
        begin += len(cloud)
    codes = np.add.reduceat(mix(place[lists]), start[:-1])
    found: Mask = inside & np.isin(codes, np.concatenate(wanted))
    return found


def surface_of(points: Floats, start: Labels, lists: Labels, part: slice) -> Any:
    """Return the vtkPolyData of some faces, for searches on it."""
    from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray
    from vtkmodules.vtkCommonCore import vtkPoints
    from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

    start, lists = take_lists(start, lists, np.arange(part.start, part.stop))
    used, local = np.unique(lists, return_inverse=True)
    surface, places, polygons = vtkPolyData(), vtkPoints(), vtkCellArray()
    places.SetData(numpy_to_vtk(points[used], deep=True))
    polygons.SetData(*(numpy_to_vtkIdTypeArray(a.astype(np.int64), deep=True) for a in (start, local)))
    surface.SetPoints(places)
    surface.SetPolys(polygons)
    return surface
