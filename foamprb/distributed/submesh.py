"""Mesh of the cells that a node of a parallel run holds, equal to the whole mesh to the last bit.

Cells, faces and points rise in the numbers of the whole mesh, so that sums over neighbours have its order.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.distributed.fragment import Grown, Labels, Team, places_of
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh
from foamprb.flow.mesh.communicator import MeshCommunicator
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.lists import Index, Mask, int32, ragged, starts
from foamprb.flow.mesh.mesh import Mesh, assemble

CUT = PatchSurface("(cut)", "processor", None)
"""Patch of the faces where the cells of a node end."""
BEYOND = -2
"""Patch of the triangles through which a path leaves the cells of a node; to kernels a failed walk."""
RINGS = 2
"""Outermost layers of cells, in which the shapes of cells differ in round-off, or their neighbours lack."""

_MANY_CELLS = 1e9
"""Number of cells in a row that no mesh has."""


def layers_over(cells: float) -> int:
    """Return the number of layers that no body leaves which passes some cells between two exchanges."""
    return 2 + math.ceil(min(cells, _MANY_CELLS))


@dataclass(frozen=True)
class SubMesh:
    """Cells of a node with layers of others around them."""

    mesh: Mesh
    """The last patch has the faces where these cells end."""
    cells: Labels
    """(n_cells,) their numbers in the whole mesh, rising."""
    points: Labels
    """(n_points,) numbers of the points, rising."""
    faces: Labels
    """(n_faces,) numbers of the faces."""
    layer: NDArray[np.int32]
    """(n_cells,) 0 for owned cells."""
    node: NDArray[np.int32]
    """(n_cells,) the node that owns the cell."""
    n_internal: int
    """Number of faces between cells in the whole mesh."""
    depth: int
    """Number of layers in which bodies may move."""

    @property
    def owned(self) -> Mask:
        """Return True for owned cells, (n_cells,)."""
        owned: Mask = self.layer == 0
        return owned

    @property
    def usable(self) -> Mask:
        """Return True for cells in which bodies may move, (n_cells,)."""
        usable: Mask = self.layer <= self.depth
        return usable


def assemble_part(
    pieces: list[Grown],
    patches: Sequence[PatchSurface],
    patch_start: Index,
    n_internal: int,
    source: str,
) -> SubMesh:
    """Return the mesh of a node.

    Parameters
    ----------
    pieces
        Its cells; the list is emptied, to free them early.
    patches, patch_start
        Patches of the whole mesh, and the first boundary face of each.
    n_internal
        Number of faces between cells in the whole mesh.
    source
        Name of the mesh for messages.
    """
    poly, numbers, (layer, node, layers) = _local_poly(pieces.pop(), patches, patch_start, n_internal)
    mesh = assemble(poly, source)
    patch = np.where(mesh.triangle_patch == len(patches), np.int32(BEYOND), mesh.triangle_patch)
    return SubMesh(
        replace(mesh, triangle_patch=patch), *numbers, layer, node, n_internal, depth=layers - RINGS
    )


def _local_poly(
    grown: Grown, patches: Sequence[PatchSurface], patch_start: Index, n_internal: int
) -> tuple[PolyMesh, tuple[Labels, Labels, Labels], tuple[NDArray[Any], NDArray[Any], int]]:
    """Return points, faces and patches of the cells of a node.

    Returns
    -------
    The mesh; the numbers of cells, points and faces in the whole; layer and node of the cells, and the number
    of layers.
    """
    f = grown.fragment
    owner, neighbour = (places_of(f.cells, side) for side in (f.owner, f.neighbour))
    inside = (owner >= 0) & (neighbour >= 0)
    outside = f.faces >= n_internal
    order = np.concatenate([np.flatnonzero(m) for m in (inside, outside, ~inside & ~outside)])
    n_inside = int(inside.sum())
    turned, sizes = owner[order] < 0, np.diff(f.start)[order]
    places = ragged(np.zeros(len(order), dtype=np.intp), sizes)
    back = np.repeat(turned, sizes)
    places[back] = (-places % np.repeat(sizes, sizes))[back]
    places += np.repeat(f.start[:-1][order], sizes)
    lists = int32(np.searchsorted(f.points, f.lists[places]))
    del places, back
    owner = np.where(turned, neighbour[order], owner[order])
    ends = np.searchsorted(f.faces[outside] - n_internal, patch_start)
    faces = faces_of(
        int32(starts(sizes)), lists, int32(owner), int32(neighbour[order[:n_inside]]), len(f.cells)
    )
    poly = PolyMesh(f.places, faces, [*patches, CUT], np.append(ends, len(order) - n_inside))
    numbers = f.cells, f.points, f.faces[order]
    return poly, numbers, (grown.layer, grown.node, grown.layers)


class Halo(MeshCommunicator):
    """Exchange of values between the nodes that hold a mesh in parts.

    Parameters
    ----------
    part
        Cells of this node.
    team
        The nodes.
    """

    def __init__(self, part: SubMesh, team: Team) -> None:
        self.part, self.team, self.rank = part, team, team.rank
        mesh, cells = part.mesh, part.cells
        everyone = range(team.size)
        n_boundary = int(mesh.patch_start[-2])
        counted = part.owned[mesh.owner]
        counted[mesh.n_internal + n_boundary :] = False
        self.own_cells, self.own_faces = np.flatnonzero(part.owned), np.flatnonzero(counted)
        self.own_boundary = np.flatnonzero(counted[mesh.n_internal :])
        owner = mesh.owner[: mesh.n_internal + n_boundary]
        # Any node with a cell around a point that it owns can compute the values there.
        lowest = np.full(mesh.n_points, mesh.n_cells, dtype=np.int64)
        of_points = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start))
        np.minimum.at(lowest, mesh.cell_points, of_points)
        giver = part.node[lowest]
        giver[mesh.cell_points[np.repeat(part.owned, np.diff(mesh.cell_point_start))]] = team.rank
        self._plans = {}
        del of_points, lowest
        for name, numbers, node in (
            ("cells", cells, part.node),
            ("points", part.points, giver),
            ("faces", part.faces[: mesh.n_internal + n_boundary], part.node[owner]),
            ("boundary", part.faces[mesh.n_internal :][:n_boundary], part.node[owner[mesh.n_internal :]]),
        ):
            wanted = [np.flatnonzero(node == k) if k != team.rank else np.empty(0, np.intp) for k in everyone]
            asked = team.exchange([numbers[rows] for rows in wanted])
            sent = [np.searchsorted(numbers, ids) for ids in asked]
            self._plans[name] = [int32(rows) for rows in sent], [int32(rows) for rows in wanted]

    def fill(self, kind: str, values: NDArray[Any]) -> None:
        """See :meth:`MeshCommunicator.fill`."""
        sent, received = self._plans[kind]
        for rows, arrived in zip(received, self.team.exchange([values[rows] for rows in sent]), strict=True):
            values[rows] = arrived

    def of_all(self, value: Any) -> list[Any]:
        """See :meth:`MeshCommunicator.of_all`."""
        return self.team.of_all(value)

    def united(self) -> AbstractContextManager[None]:
        """See :meth:`MeshCommunicator.united`."""
        return self.team.united()

    def distribute(
        self, rows: tuple[Any, ...], blocks: tuple[Ints, int], segments: Index
    ) -> tuple[tuple[Any, ...], Callable[[NDArray[Any]], NDArray[Any]], Callable[[Floats], Floats]]:
        """See :meth:`MeshCommunicator.distribute`."""
        team, numbers, cells = self.team, self.part.cells, self.own_cells
        parts = [(len(segments) - 1) * k // team.size for k in range(team.size + 1)]
        ends = segments[parts]
        owned, held = (Ranges(team, ends, some) for some in (numbers[cells], numbers))
        start, columns, values, diagonal = rows
        counts = np.diff(start.astype(np.intp))[cells]
        entries = ragged(start[cells].astype(np.intp), counts)
        row_start, to, values = owned.put_lists(starts(counts), numbers[columns[entries]], values[entries])
        first, end = ends[team.rank : team.rank + 2]
        inside = (to >= first) & (to < end)
        beyond = np.unique(to[~inside])
        others = Ranges(team, ends, beyond)
        columns = np.where(inside, to - first, end - first + np.searchsorted(beyond, to)).astype(np.uint32)
        block = owned.put(blocks[0])
        here = segments[parts[team.rank] : parts[team.rank + 1] + 1] - first
        equations = (
            (row_start.astype(np.uint32), columns, values, owned.put(diagonal[cells])),
            np.concatenate([block, others.get(block)]), blocks[1], here,
            team.of_all, others.get, int(np.searchsorted(beyond, first)),
        )  # fmt: skip
        return equations, owned.put, held.get


class Ranges:
    """Contiguous ranges of the cells of the whole mesh, one for each node, whatever cells it owns.

    Parameters
    ----------
    team
        The nodes.
    ends
        (size + 1,) the first cell of each node, and the end of the last.
    numbers
        (n,) cells whose values this node gives or takes, rising.
    """

    def __init__(self, team: Team, ends: Index, numbers: Labels) -> None:
        self._team, self._n = team, int(ends[team.rank + 1] - ends[team.rank])
        self._parts = [slice(*part) for part in pairwise(np.searchsorted(numbers, ends).tolist())]
        asked = team.exchange([numbers[part] for part in self._parts])
        self._rows = [cells - ends[team.rank] for cells in asked]

    def put(self, values: NDArray[Any]) -> NDArray[Any]:
        """Scatter values (n,) to the nodes of the cells' ranges; return the values of this range."""
        return self._placed([values[part] for part in self._parts], self._rows, self._n)

    def put_lists(self, start: Index, *lists: NDArray[Any]) -> tuple[Any, ...]:
        """Scatter lists; return starts and entries of the lists of this range."""
        counts = self.put(np.diff(start))
        first = starts(counts)
        places = [ragged(first[rows], counts[rows]) for rows in self._rows]
        parts = [slice(start[part.start], start[part.stop]) for part in self._parts]
        return first, *(
            self._placed([entries[part] for part in parts], places, int(first[-1])) for entries in lists
        )

    def _placed(self, parcels: list[NDArray[Any]], places: list[Index], n: int) -> NDArray[Any]:
        values = np.empty(n, dtype=parcels[0].dtype)
        for rows, part in zip(places, self._team.exchange(parcels), strict=True):
            values[rows] = part
        return values

    def get(self, values: NDArray[Any]) -> NDArray[Any]:
        """Gather values (n,) from the nodes of the cells' ranges."""
        return np.concatenate(self._team.exchange([values[rows] for rows in self._rows]))
