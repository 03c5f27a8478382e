"""Cyclic patches of a mesh that nodes hold in parts: each node couples all their faces."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np

from foamprb.distributed.fragment import Fragment, Pairs, Team
from foamprb.flow.base import Floats, Patch
from foamprb.flow.mesh.boundary import PatchSurface, patches_of
from foamprb.flow.mesh.coupling import Coupling, couple
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.geometry import measured
from foamprb.flow.mesh.lists import Index, int32, ragged, starts, take_lists


class Joints(NamedTuple):
    """Cyclic patches of the whole mesh."""

    patches: tuple[Patch, ...]
    couplings: tuple[Coupling, ...]
    """Faces have their numbers in the whole mesh."""
    links: Pairs
    """(2, n) faces, rising, and the faces that continue them."""


def couple_parts(
    owned: Fragment,
    patches: Sequence[PatchSurface],
    patch_start: Index,
    n_internal: int,
    team: Team,
    source: str,
) -> Joints:
    """Couple the patches as :func:`foamprb.flow.mesh.coupling.couple` does in the whole mesh.

    Parameters
    ----------
    owned
        The owned cells of a node.
    patches, patch_start
        Patches of the whole mesh, and the first boundary face of each.
    n_internal
        Number of faces between cells in the whole mesh.
    team, source
        The nodes; the name of the mesh for messages.
    """
    counts = np.where([patch.type == "cyclic" for patch in patches], np.diff(patch_start), 0)
    named = patches_of(patches, patch_start)
    if not counts.any():
        alone = tuple(patch._replace(neighbour="") for patch in named)
        return Joints(alone, (), np.empty((2, 0), dtype=np.int64))
    numbers = n_internal + ragged(patch_start[:-1], counts)
    faces, points = _gathered(owned, numbers, team)
    joined, coupled = couple(named, starts(counts), *measured(points, faces), patches, source)
    couplings = tuple(c._replace(faces=numbers[c.faces], partners=numbers[c.partners]) for c in coupled)
    links = np.concatenate([[c.faces, c.partners] for c in couplings], axis=1)
    return Joints(joined, couplings, links[:, np.argsort(links[0])])


def _gathered(owned: Fragment, numbers: Index, team: Team) -> tuple[Faces, Floats]:
    """Return some boundary faces of the whole mesh, and their points in the order of these numbers."""
    here = np.flatnonzero(np.isin(owned.faces, numbers))
    start, lists = take_lists(owned.start, owned.lists, here)
    places = owned.places[np.searchsorted(owned.points, lists)]
    gathered = team.of_all((owned.faces[here], np.diff(start), lists, places))
    faces, sizes, lists, places = (np.concatenate(column) for column in zip(*gathered, strict=True))
    order = np.argsort(faces)
    start, rows = take_lists(starts(sizes), np.arange(len(lists)), order)
    _, first, place = np.unique(lists[rows], return_index=True, return_inverse=True)
    nothing = np.empty(0, dtype=np.int32)
    owner = np.zeros(len(faces), dtype=np.int32)
    lists_of_faces = int32(start), int32(place.reshape(-1)), owner, nothing, nothing, nothing
    return Faces(*lists_of_faces), places[rows[first]]
