"""Part of a mesh that a node holds: its own cells, which it reads, and layers of cells around them."""

from __future__ import annotations

from collections.abc import Callable, Sequence

import numpy as np

from foamprb.compile.link import link
from foamprb.flow.base import Floats
from foamprb.flow.mesh.baffles import part_fragment
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.folds import grade
from foamprb.flow.mesh.fragment import NO_PAIRS, Fragment, Pairs, Team, grow
from foamprb.flow.mesh.joints import couple_parts
from foamprb.flow.mesh.lists import Index
from foamprb.flow.mesh.locator import cell_boxes
from foamprb.flow.mesh.submesh import BEYOND, RINGS, SubMesh, assemble_part
from foamprb.flow.mesh.tree import build_tree, pairs_near
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
        Returns the own cells. They are read twice if the mesh has folds at boundaries of other nodes.
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
    InputError
        See :func:`foamprb.flow.mesh.mesh.assemble`.
    """
    rims = NO_PAIRS
    while True:
        own, copies = part_fragment(read(), team, n_internal)
        joints = couple_parts(own, patches, patch_start, n_internal, team, source)
        pieces = [own]
        del own
        grown = [grow(pieces, team, depth + RINGS, joints.links, copies, rims)]
        trim()
        part = assemble_part(grown, patches, patch_start, n_internal, joints, source)
        trim()
        if rims.size:
            return part
        rims = _rims(part, team)
        lacking = np.isin(rims[0], part.cells[part.usable]) & ~np.isin(rims[1], part.faces)
        if not any(team.of_all(bool(lacking.any()))):
            return part
        del part


def inverted_boxes(part: SubMesh) -> Floats:
    """Return the boxes of the inverted tetrahedra in own cells; see :func:`foamprb.flow.mesh.folds.grade`."""
    mesh = part.mesh
    tets = mesh.tets[part.own[mesh.tets[:, 0] - mesh.n_points]]
    boxes, marks = np.empty((mesh.inverted, 6)), np.zeros(mesh.n_cells, dtype=np.uint8)
    return boxes[: link(grade)(mesh.nodes, tets, mesh.n_points, marks, boxes)]


def _rims(part: SubMesh, team: Team) -> Pairs:
    """Return the folded cells of all nodes, rising, and the boundary faces with triangles in their boxes."""
    mesh = part.mesh
    if not any(team.of_all(mesh.inverted > 0)):
        return NO_PAIRS
    inverted = np.concatenate(team.of_all(inverted_boxes(part)))
    boxes = cell_boxes(mesh)[part.own]
    folded = np.diff(pairs_near(boxes, build_tree(boxes), inverted)[0]) > 0
    rows = np.flatnonzero(part.own[mesh.tets[mesh.triangle_tet, 0] - mesh.n_points])
    rows = rows[mesh.triangle_patch[rows] != BEYOND]
    corners = mesh.points[mesh.triangles[rows]]
    targets = np.concatenate([corners.min(axis=1), corners.max(axis=1)], axis=1)
    faces, found = part.faces[mesh.n_internal + mesh.triangle_face[rows]], [NO_PAIRS]
    for cells, around in team.of_all((part.cells[part.own][folded], boxes[folded])):
        if len(cells):
            start, near = pairs_near(around, build_tree(around), targets)
            found.append(np.stack([np.repeat(cells, np.diff(start)), faces[near]]))
    everywhere = team.of_all(np.unique(np.concatenate(found, axis=1), axis=1))
    return np.unique(np.concatenate(everywhere, axis=1), axis=1)
