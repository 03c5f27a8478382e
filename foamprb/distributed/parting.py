"""Part of a mesh that a node holds: its owned cells, which it reads, and layers of cells around them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from foamprb.distributed.fragment import Fragment, IndivisibleMeshError, Team, grow
from foamprb.distributed.submesh import RINGS, SubMesh, assemble_part
from foamprb.flow.mesh.baffles import codes_of
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.lists import Index
from foamprb.memory import trim


def hold_part(
    read: Callable[[], Fragment],
    patches: Sequence[PatchSurface],
    patch_start: Index,
    n_internal: int,
    depth: int,
    team: Team,
    source: str,
) -> SubMesh:
    """Return the mesh of a node.

    Parameters
    ----------
    read
        Returns the owned cells.
    patches, patch_start
        Patches of the whole mesh, and the first boundary face of each.
    n_internal
        Number of faces between cells in the whole mesh.
    depth
        Number of layers in which bodies may move.
    team, source
        The nodes, which call it together; the name of the mesh for messages.

    Raises
    ------
    IndivisibleMeshError
        The mesh has baffles or folded cells.
    """
    pieces = [read()]
    if has_baffles(pieces[0], team, n_internal):
        raise IndivisibleMeshError("the mesh has baffles, walls without thickness")
    grown = [grow(pieces, team, depth + RINGS)]
    trim()
    part = assemble_part(grown, patches, patch_start, n_internal, source)
    if any(team.of_all(part.mesh.inverted > 0)):
        raise IndivisibleMeshError("the mesh has folded cells")
    trim()
    return part


def has_baffles(owned: Fragment, team: Team, n_internal: int) -> bool:
    """Return True if two boundary faces of the owned cells of all nodes have the same points.

    ``n_internal`` is the number of faces between cells in the whole mesh.
    """
    codes, size = codes_of(owned.start, owned.lists, np.flatnonzero(owned.faces >= n_internal)), team.size
    received = np.concatenate(team.exchange([codes[codes % np.uint64(size) == k] for k in range(size)]))
    return any(team.of_all(len(np.unique(received)) < len(received)))
