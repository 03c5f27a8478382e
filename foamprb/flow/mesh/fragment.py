"""Fragments of a mesh, numbered as in the whole, and their growth by layers of cells of other nodes.

A node of a parallel run holds its own cells and some layers of cells around them, which it obtains from the
nodes that own these. Nobody holds the whole mesh.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import reduce
from typing import Any, NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats
from foamprb.flow.mesh.lists import Index, Mask, ragged, starts, take_lists

Labels = NDArray[np.int64]


class Team(Protocol):
    """Nodes that hold a mesh together; all call the same methods in the same order."""

    rank: int
    size: int

    def exchange(self, parcels: Sequence[Any]) -> list[Any]:
        """Send parcel i to node i; return the parcel from each node."""

    def collect(self, value: Any) -> list[Any]:
        """Return the values of all nodes on node 0, and an empty list on the others."""

    def spread(self, value: Any) -> Any:
        """Return the value of node 0."""


class Fragment(NamedTuple):
    """Cells with all their faces and points, in the numbers of the whole mesh."""

    cells: Labels
    """(n_cells,) rising."""
    points: Labels
    """(n_points,) rising."""
    places: Floats
    """(n_points, 3), m."""
    faces: Labels
    """(n_faces,) rising."""
    start: Index
    """(n_faces + 1,) into ``lists``."""
    lists: Labels
    """Points of each face, turning as in the whole mesh."""
    owner: Labels
    """(n_faces,) cell; −1 if it is not known."""
    neighbour: Labels
    """(n_faces,) cell; −1 if it is not known, or there is none."""

    def take(self, cells: Mask) -> Fragment:
        """Return some of the cells, by a mask, with their faces and points."""
        numbers = self.cells[cells]
        chosen = np.flatnonzero(np.isin(self.owner, numbers) | np.isin(self.neighbour, numbers))
        start, found = take_lists(self.start, self.lists, chosen)
        lists = found.astype(np.int64)
        held = np.isin(self.points, lists)
        sides = self.owner[chosen], self.neighbour[chosen]
        return Fragment(
            numbers, self.points[held], self.places[held], self.faces[chosen], start, lists, *sides
        )

    def touching(self, points: Labels) -> Mask:
        """Return True for cells with any of some points, (n_cells,)."""
        faces = self.faces_with(points)
        return np.isin(self.cells, np.concatenate([self.owner[faces], self.neighbour[faces]]))

    def faces_with(self, points: Labels) -> Mask:
        """Return True for faces with any of some points, (n_faces,)."""
        if len(self.faces) == 0:
            return np.empty(0, dtype=bool)
        held = np.isin(self.points, points)[np.searchsorted(self.points, self.lists)]
        return np.logical_or.reduceat(held, self.start[:-1])

    def points_of(self, faces: Labels) -> Labels:
        """Return the points of those of some faces that are here."""
        here = np.flatnonzero(np.isin(self.faces, faces))
        return np.unique(take_lists(self.start, self.lists, here)[1]).astype(np.int64)


def merged(a: Fragment, b: Fragment) -> Fragment:
    """Return the cells of two fragments."""
    points, first = np.unique(np.concatenate([a.points, b.points]), return_index=True)
    faces, place = np.unique(np.concatenate([a.faces, b.faces]), return_index=True)
    sides = []
    for one, other in ((a.owner, b.owner), (a.neighbour, b.neighbour)):
        side = np.full(len(faces), -1, dtype=np.int64)
        for part, values in ((a, one), (b, other)):
            at = np.searchsorted(faces, part.faces)
            side[at] = np.maximum(side[at], values)
        sides.append(side)
    lists = np.concatenate([a.lists, b.lists])
    sizes = np.concatenate([np.diff(a.start), np.diff(b.start)])
    begin = np.concatenate([a.start[:-1], len(a.lists) + b.start[:-1]])
    return Fragment(
        np.union1d(a.cells, b.cells),
        points,
        np.concatenate([a.places, b.places])[first],
        faces,
        starts(sizes[place]),
        lists[ragged(begin[place], sizes[place])],
        *sides,
    )


class Grown(NamedTuple):
    """Cells of a node and layers of cells around them."""

    fragment: Fragment
    layer: NDArray[np.uint8]
    """(n_cells,) 0 for own cells, 1 for those that touch these, and so on."""
    node: NDArray[np.int32]
    """(n_cells,) the node that owns the cell."""
    layers: int
    """Number of layers that were added."""


def grow(own: Fragment, team: Team, layers: int, partners: Labels, n_internal: int) -> Grown:
    """Add layers of cells around the own cells, which share a point, also across coupled faces.

    Parameters
    ----------
    own
        The own cells.
    team
        The nodes.
    layers
        Number of layers.
    partners
        (n_boundary,) boundary face that continues each boundary face, −1 for none.
    n_internal
        Number of faces between cells in the whole mesh.
    """
    everyone, fragment = range(team.size), own
    found = [(own.cells, team.rank, 0)]
    sent = np.zeros((team.size, len(own.cells)), dtype=bool)
    sent[team.rank] = True
    asked = np.empty(0, dtype=np.int64)

    def fetch(points: Labels) -> list[Fragment]:
        """Return the cells of each node that touch some points, without those that it has sent before."""
        parcels = []
        for k, wanted in enumerate(team.exchange([points for _ in everyone])):
            touched = own.touching(wanted) & ~sent[k]
            sent[k] |= touched
            parcels.append(own.take(touched))
        return team.exchange(parcels)

    for number in range(1, layers + 1):
        points, asked = np.setdiff1d(fragment.points, asked), fragment.points
        pieces = fetch(points)
        fragment = reduce(merged, pieces, fragment)
        found += [(piece.cells, k, number) for k, piece in enumerate(pieces)]
        if np.any(partners >= 0):
            faces = fragment.faces[fragment.faces_with(asked)] - n_internal
            across = partners[faces[faces >= 0]]
            asking = team.exchange([across[across >= 0] + n_internal for _ in everyone])
            answers = team.exchange([own.points_of(wanted) for wanted in asking])
            pieces = fetch(np.unique(np.concatenate(answers)))
            fragment = reduce(merged, pieces, fragment)
            found += [(piece.cells, k, number) for k, piece in enumerate(pieces)]
    cells = np.concatenate([numbers for numbers, _, _ in found])
    order = np.argsort(cells)
    counts = [len(numbers) for numbers, _, _ in found]
    node, layer = (np.repeat(np.array([row[k] for row in found]), counts)[order] for k in (1, 2))
    return Grown(fragment, layer.astype(np.uint8), node.astype(np.int32), layers)
