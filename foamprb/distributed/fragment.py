"""Fragments of a mesh, numbered as in the whole, and their growth by layers of cells of other nodes.

A node of a parallel run holds its owned cells and some layers of cells around them, which it obtains from the
nodes that own these. No node holds the whole mesh.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from traceback import format_exc
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError, RankError, RunStopped
from foamprb.flow.base import Floats
from foamprb.flow.mesh.lists import Index, Mask, ragged, starts, take_lists

Labels = NDArray[np.int64]
"""Two rows of numbers."""

_OF_ALL = "_of_all_nodes"
"""Attribute of an error that all nodes raise."""


class Team:
    """Nodes that hold a mesh together; all call the same methods in the same order."""

    rank: int
    size: int

    def swap(self, parcels: Sequence[Any]) -> list[Any]:
        """Send parcel i to node i; return the parcel from each node."""
        raise NotImplementedError

    def exchange(self, parcels: Sequence[Any]) -> list[Any]:
        """Send parcel i to node i; return the parcel from each node.

        Raises
        ------
        InputError, RunStopped, OSError, RankError
            A node has failed amid :meth:`united`.
        """
        received = self.swap(parcels)
        for parcel in received:
            if isinstance(parcel, _Failure):
                parcel.error.__dict__[_OF_ALL] = True
                try:
                    raise parcel.error
                finally:
                    # The error refers to this frame, and so to the arrays of all callers.
                    del received, parcel, parcels
        return received

    def spread(self, value: Any) -> Any:
        """Return the value of node 0."""
        return self.exchange(self.size * [value if self.rank == 0 else None])[0]

    def of_all(self, value: Any) -> list[Any]:
        """Return the values of all nodes."""
        return self.exchange([value] * self.size)

    @contextmanager
    def united(self) -> Iterator[None]:
        """Raise an error of one node on all of them.

        The node that fails sends the error instead of the next parcels, so that all agree on the next call.
        An error that is caught amid the context must be raised by a context within.
        """
        try:
            yield
        except Exception as error:
            if _OF_ALL in error.__dict__:
                raise
            expected = isinstance(error, InputError | RunStopped | OSError | RankError)
            text = f"node {self.rank}: {type(error).__name__}: {error}"
            self.exchange(self.size * [_Failure(error if expected else RankError(text, format_exc()))])
        self.exchange(self.size * [None])


class IndivisibleMeshError(InputError):
    """Reason why each node must hold the whole mesh; all nodes raise it together."""


class _Failure(NamedTuple):
    """Sent in place of a parcel by a node that has failed."""

    error: Exception


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


def merged(parts: Sequence[Fragment]) -> Fragment:
    """Return the cells of several fragments."""
    if len(parts) == 1:
        return parts[0]
    # Places of a point may differ in round-off: the last counts.
    points, last = np.unique(np.concatenate([part.points for part in parts])[::-1], return_index=True)
    places = np.concatenate([part.places for part in parts])[::-1][last]
    faces = np.concatenate([part.faces for part in parts])
    order = np.argsort(faces, kind="stable")
    begins = np.flatnonzero(np.diff(faces[order], prepend=-1))
    # A face between two fragments has its owner in one of them, and its neighbour in the other.
    owner, neighbour = (
        np.maximum.reduceat(np.concatenate(sides)[order], begins) if len(begins) else np.empty(0, np.int64)
        for sides in ([part.owner for part in parts], [part.neighbour for part in parts])
    )
    rows = order[begins]
    sizes = np.concatenate([np.diff(part.start) for part in parts])
    ends = starts(np.array([len(part.lists) for part in parts]))
    first = np.concatenate([part.start[:-1] + end for part, end in zip(parts, ends, strict=False)])
    lists = np.concatenate([part.lists for part in parts])[ragged(first[rows], sizes[rows])]
    cells = np.sort(np.concatenate([part.cells for part in parts]))
    return Fragment(cells, points, places, faces[rows], starts(sizes[rows]), lists, owner, neighbour)


class CellSearch:
    """Search for cells of a fragment by their points and faces."""

    def __init__(self, fragment: Fragment) -> None:
        self.fragment = fragment
        self._lists = np.searchsorted(fragment.points, fragment.lists)
        self._sides = [places_of(fragment.cells, side) for side in (fragment.owner, fragment.neighbour)]

    def touching(self, points: Labels) -> Mask:
        """Return True for cells with any of some points, (n_cells,)."""
        cells = np.zeros(len(self.fragment.cells) + 1, dtype=bool)
        held = np.isin(self.fragment.points, points)
        if held.any():
            faces = np.logical_or.reduceat(held[self._lists], self.fragment.start[:-1])
            for side in self._sides:
                cells[side[faces]] = True
        # The last stands for no cell.
        return cells[:-1]

    def take(self, cells: Mask) -> Fragment:
        """Return some of the cells, by a mask, with their faces and points."""
        f, selected = self.fragment, np.append(cells, False)
        here = [selected[side] for side in self._sides]
        rows = np.flatnonzero(here[0] | here[1])
        start, lists = take_lists(f.start, self._lists, rows)
        held = np.zeros(len(f.points), dtype=bool)
        held[lists] = True
        owner, neighbour = (
            np.where(inside[rows], side[rows], -1)
            for inside, side in zip(here, (f.owner, f.neighbour), strict=True)
        )
        points = f.points[held], f.places[held]
        return Fragment(f.cells[cells], *points, f.faces[rows], start, f.points[lists], owner, neighbour)

    def rim(self) -> Labels:
        """Return the points of the faces with a cell on one side only."""
        open_ = np.flatnonzero((self.fragment.owner < 0) | (self.fragment.neighbour < 0))
        return np.unique(take_lists(self.fragment.start, self.fragment.lists, open_)[1]).astype(np.int64)


def places_of(numbers: Labels, wanted: Labels) -> Index:
    """Return the index of each wanted number in rising numbers, −1 if it is missing."""
    if len(numbers) == 0:
        return np.full(len(wanted), -1, dtype=np.intp)
    at = np.minimum(np.searchsorted(numbers, wanted), len(numbers) - 1)
    return np.where(numbers[at] == wanted, at, -1)


class Grown(NamedTuple):
    """Cells of a node and layers of cells around them."""

    fragment: Fragment
    layer: NDArray[np.int32]
    """(n_cells,) 0 for owned cells, 1 for cells that touch them, and so on."""
    node: NDArray[np.int32]
    """(n_cells,) the node that owns the cell."""
    layers: int
    """Number of layers, those beyond the whole mesh included."""


def grow(pieces: list[Fragment], team: Team, layers: int) -> Grown:
    """Add layers of cells around the owned cells, which share a point.

    Parameters
    ----------
    pieces
        The owned cells; the list is emptied, to free them early.
    team
        The nodes.
    layers
        Number of layers.
    """
    owned = merged(pieces)
    pieces.clear()
    search = CellSearch(owned)
    sent = np.zeros((team.size, len(owned.cells)), dtype=bool)
    sent[team.rank] = True
    held = [(owned, team.rank, 0)]

    def fetch(points: Labels, number: int) -> None:
        """Fetch the cells of each node that touch some points and were not sent before."""
        parcels = []
        for k, wanted in enumerate(team.of_all(points)):
            touched = search.touching(wanted) & ~sent[k]
            sent[k] |= touched
            parcels.append(search.take(touched))
        pieces = enumerate(team.exchange(parcels))
        held.extend((piece, k, number) for k, piece in pieces if len(piece.cells))

    # All cells around the other points are owned.
    points, asked = search.rim(), owned.points
    for number in range(1, layers + 1):
        latest = len(held)
        fetch(points, number)
        if not any(team.of_all(len(held) > latest)):
            # The nodes hold all cells that they can reach.
            break
        new = [piece.points for piece, _, _ in held[latest:]]
        points = np.setdiff1d(np.concatenate([asked[:0], *new]), asked)
        asked = np.union1d(asked, points)
    held.sort(key=lambda part: part[1])
    order = np.argsort(np.concatenate([piece.cells for piece, _, _ in held]))
    counts = [len(piece.cells) for piece, _, _ in held]
    node, layer = (np.repeat(np.array([row[k] for row in held]), counts)[order] for k in (1, 2))
    parts = [piece for piece, _, _ in held]
    held.clear()
    fragment = merged(parts)
    return Grown(fragment, layer.astype(np.int32), node.astype(np.int32), layers)
