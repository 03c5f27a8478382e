"""OpenFOAM's meshes: points, faces, owner, neighbour and boundary."""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.lists import int32, starts, take_lists
from foamprb.flow.read.boundary import PatchInfo, patches_of_mesh
from foamprb.flow.read.case import shown
from foamprb.flow.read.checks import require_numbers
from foamprb.flow.read.foamfile import FoamFile, read_vectors
from foamprb.flow.read.overlap import as_interfaces, used_faces

_LEAST_FACES = 4


def read_poly(files: Sequence[Path], patches: Sequence[PatchInfo]) -> PolyMesh:
    """Read a mesh.

    Parameters
    ----------
    files
        ``points``, ``faces``, ``owner``, ``neighbour`` and ``boundary``, plain or compressed.
    patches
        The patches of the last.
    """
    paths = [shown(file) for file in files]
    points = read_vectors(paths[0])
    start, lists = FoamFile(paths[1]).faces()
    owner, neighbour = (FoamFile(path).indices() for path in paths[2:4])
    if len(neighbour) == len(owner):
        # Old files have a neighbour -1 for each boundary face.
        neighbour = neighbour[: len(owner) - np.argmax(neighbour[::-1] >= 0) if np.any(neighbour >= 0) else 0]
    return checked_poly(paths, points, start, lists, owner, neighbour, patches)


def read_points(file: Path) -> Floats:
    """Read the points of a mesh, (n_points, 3), m."""
    points = read_vectors(shown(file))
    require_numbers(points, shown(file), "point")
    return points


def count_cells(owner: Ints, neighbour: Ints) -> int:
    """Return the number of cells; the last ones without faces on the boundary own none."""
    n = int(owner.max(initial=-1)) + 1
    further = np.unique(neighbour[neighbour >= n])
    return n + int(np.count_nonzero(further == n + np.arange(len(further))))


def checked_poly(
    paths: Sequence[Path],
    points: Floats,
    start: Ints,
    lists: Ints,
    owner: Ints,
    neighbour: Ints,
    patches: Sequence[PatchInfo],
) -> PolyMesh:
    """Return the mesh of points and faces; InputError if they do not fit each other."""
    require_numbers(points, paths[0], "point")
    n_faces, n_internal = len(start) - 1, len(neighbour)
    if n_faces == 0:
        raise InputError(f"{paths[1]}: the mesh has no faces.")
    if len(owner) != n_faces or n_internal > n_faces:
        raise InputError(f"{paths[2]}: {len(owner)} owners and {n_internal} neighbours of {n_faces} faces.")
    sizes = np.diff(start)
    if sizes.min() < 3:
        raise InputError(
            f"{paths[1]}: face {np.argmin(sizes)} has {sizes.min()} points. Allowed: at least 3."
        )
    if lists.min() < 0 or lists.max() >= len(points):
        at = np.flatnonzero((lists < 0) | (lists >= len(points)))[0]
        face = np.searchsorted(start, at, side="right") - 1
        raise InputError(
            f"{paths[1]}: face {face} has point {lists[at]}, but there are {len(points)} points."
        )
    # Each cell has several faces.
    n_cells = min(count_cells(owner, neighbour), n_faces)
    for path, labels in zip(paths[2:4], (owner, neighbour), strict=True):
        wrong = np.flatnonzero((labels < 0) | (labels >= n_cells))
        if len(wrong):
            raise InputError(
                f"{path}: face {wrong[0]} belongs to cell {labels[wrong[0]]}, but there are {n_cells} cells."
            )
    same = np.flatnonzero(owner[:n_internal] == neighbour)
    if len(same):
        raise InputError(f"{paths[3]}: face {same[0]} has cell {neighbour[same[0]]} on both sides.")
    patch_start = starts(np.array([patch.faces for patch in patches], dtype=np.intp))
    first = patches[0].start if patches else n_internal
    if first != n_internal or patch_start[-1] != n_faces - n_internal:
        raise InputError(
            f"{paths[4]}: the patches have the faces from {first} to {first + patch_start[-1]}, but the "
            f"faces of one cell are those from {n_internal} to {n_faces}."
        )
    surfaces, used = patches_of_mesh(patches), used_faces(points, start, lists, patches, paths[4])
    if used:
        kept = np.concatenate([used.get(patch.name, np.ones(patch.faces, dtype=bool)) for patch in patches])
        rows = np.concatenate([np.arange(n_internal), n_internal + np.flatnonzero(kept)])
        start, lists = (int32(a) for a in take_lists(start, lists, rows))
        owner, surfaces = owner[rows], as_interfaces(surfaces)
        patch_start = starts(np.add.reduceat([*kept, False], patch_start[:-1]) * (np.diff(patch_start) > 0))
    faces = faces_of(start, lists, owner, neighbour, n_cells)
    few = np.flatnonzero(np.diff(faces.first) < _LEAST_FACES)
    if len(few):
        count = np.diff(faces.first)[few[0]]
        raise InputError(f"{paths[2]}: cell {few[0]} has {count} faces. Allowed: at least {_LEAST_FACES}.")
    return PolyMesh(points, faces, surfaces, patch_start, used)
