"""Part of a mesh that the processes of a node share, and the nodes that hold the mesh together."""

from __future__ import annotations

import pickle
from collections.abc import Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.mesh.fragment import Labels
from foamprb.flow.mesh.lists import Index
from foamprb.flow.partflow import PartFlow
from foamprb.flow.read.openfoam import steady_flow
from foamprb.flow.read.parts import PartCase
from foamprb.flow.read.source import FlowSource
from foamprb.memory import trim
from foamprb.parallel.shared_memory import Publisher, Windows


class MpiTeam:
    """Nodes, by their first processes; see :class:`foamprb.flow.mesh.fragment.Team`.

    Parameters
    ----------
    comm
        The first processes of all nodes.
    """

    def __init__(self, comm: Any) -> None:
        self._comm = comm
        self.rank: int = comm.rank
        self.size: int = comm.size

    def exchange(self, parcels: Sequence[Any]) -> list[Any]:
        """Send parcel i to node i; return the parcel from each node."""
        found = list(parcels)
        # Pair by pair, as the lengths of one collective message are 32-bit integers.
        for k in range(1, self.size):
            to, source = (self.rank + k) % self.size, (self.rank - k) % self.size
            found[source] = self._comm.sendrecv(parcels[to], to, source=source)
        return found

    def collect(self, value: Any) -> list[Any]:
        """Return the values of all nodes on node 0, and an empty list on the others."""
        if self.rank > 0:
            self._comm.send(value, 0)
            return []
        return [value, *(self._comm.recv(source=k) for k in range(1, self.size))]

    def spread(self, value: Any) -> Any:
        """Return the value of node 0."""
        return self._comm.bcast(value)


class PlacesInWhole(NamedTuple):
    """Where the cells of a node lie in the whole mesh."""

    node: Ints
    """(n_cells,) the node that owns each cell."""
    first: Labels
    """(n_cells,) the first tetrahedron of each cell in the whole mesh."""
    start: Ints
    """(n_cells + 1,) and here."""


class Shared(NamedTuple):
    """Arrays that the processes of a node share."""

    flow: MeshArrays
    places: PlacesInWhole


class Summary(NamedTuple):
    """Properties of the flow that all nodes hold together, and of the part of one."""

    patches: tuple[Any, ...]
    bounds: tuple[Floats, Floats]
    width: float
    notes: tuple[str, ...]
    counts: tuple[int, int, int]
    """Cells, points and tetrahedra of the whole mesh."""
    own: int
    """Number of own cells."""
    held: int
    """Number of cells, with those of other nodes."""
    rate: float
    """Largest velocity over the width of a cell, 1/s."""
    size: float
    """Sum of squares of the velocities at the cells, m²/s²."""
    time: str


def summary_of(flow: PartFlow) -> Summary:
    """Return the summary of a part; all nodes call it together."""
    halo, (time, u, _) = flow.halo, flow.at_nodes()
    own, speeds = halo.part.own, np.einsum("ci,ci->c", *2 * (u[flow.mesh.n_points :],))
    return Summary(
        flow.patches[:-1], flow.bounds, flow.width, flow.notes, flow.counts,
        int(own.sum()), len(own), max(halo.of_all(flow.fastest())), halo.total(speeds), time,
    )  # fmt: skip


class Part:
    """Part of a mesh, as the processes of a node share it.

    Parameters
    ----------
    MPI
        The module ``mpi4py.MPI``.
    windows
        The shared memory of all processes, by which nodes are known.
    """

    def __init__(self, MPI: Any, windows: Windows) -> None:
        self._node = windows.node
        self.shared = Windows(MPI, windows.node)
        self._leads: bool = windows.node.rank == 0
        self._team = MpiTeam(windows.leaders) if self._leads else None
        self._publisher = Publisher(self.shared, self._order)
        self.flow: PartFlow | None = None
        """On the first process of a node."""
        self.number: int = windows.node.bcast(self._team.rank if self._team else None)
        """Number of this node."""

    def close(self) -> None:
        """Free the shared memory."""
        for key in sorted(self.shared.arrays):
            self.shared.free(key)

    def refuse_strays(self) -> None:
        """Raise InputError if a path has left the cells of this node since the last call."""
        strayed = self.arrays.strayed
        if strayed[0]:
            strayed[0] = 0
            raise InputError(
                "a particle went through all layers of cells that a node holds around its own in one call: "
                "the halo is too thin for these steps. Allowed: a smaller deltaT or maxDeltaT, or the case "
                "on one computer."
            )

    @property
    def size(self) -> int:
        """Bytes shared on this node."""
        return sum(array.nbytes for array in self.shared.arrays.values())

    def open(
        self, root: Path, region: str, time: float | str, source: FlowSource, depth: int
    ) -> Summary | None:
        """Read the flow; return a summary on the first process of the node."""
        if not self._leads:
            self._follow()
            return None
        assert self._team is not None
        case = PartCase(root, region, self._team, depth)
        flow = steady_flow(case, time, source)
        case.forget()
        assert isinstance(flow, PartFlow)
        self.flow = flow
        flow.move(self._publisher.move)
        trim()
        self._node.bcast(("done", (None,)))
        return summary_of(flow)

    def share(self, *walls: Any) -> int:
        """Place the arrays of the flow, with some walls, in the memory of the node; return bytes shared.

        Raises
        ------
        InputError
            The lists of walls would be too long.
        """
        if self._leads:
            assert self.flow is not None
            try:
                arrays = self.flow.arrays(*walls)
            except InputError as error:
                self._node.bcast(("failed", (error,)))
                raise
            places = PlacesInWhole(*self.flow.places_in_whole())
            placed = pickle.dumps(self._publisher.replace(Shared(arrays, places)))
            self.flow.forget_walls()
            self._node.bcast(("done", (placed,)))
        else:
            placed = self._follow()
        self.arrays, self.places = self.shared.find(pickle.loads(placed))
        return self.size

    def _order(self, name: str, *arguments: Any) -> None:
        """Let all processes of the node call a method of their windows."""
        self._node.bcast((name, arguments))
        getattr(self.shared, name)(*arguments)

    def _follow(self) -> Any:
        """Carry out orders of the first process of the node until it ends them; return the result."""
        while True:
            name, arguments = self._node.bcast(None)
            if name == "done":
                return arguments[0]
            if name == "failed":
                raise arguments[0]
            getattr(self.shared, name)(*arguments)

    def ask(self, name: str, *arguments: Any) -> Any:
        """Return the result of a method of the flow on the first process of the node, else None."""
        return getattr(self.flow, name)(*arguments) if self._leads else None

    def numbers_of(self, hosts: NDArray[Any]) -> Labels:
        """Return the numbers of tetrahedra in the whole mesh, (n,); −1 stays −1."""
        cells, places = self.cells_of(hosts), self.places
        return np.where(hosts < 0, -1, places.first[cells] + hosts - places.start[cells])

    def hosts_of(self, numbers: Labels) -> Labels:
        """Return tetrahedra of the whole mesh, which must be here, as they are numbered here."""
        places = self.places
        cells = np.maximum(np.searchsorted(places.first, numbers, side="right") - 1, 0)
        return np.where(numbers < 0, -1, numbers - places.first[cells] + places.start[cells])

    def cells_of(self, hosts: NDArray[Any]) -> Index:
        """Return the cells of tetrahedra, (n,); any cell for −1."""
        cells: Index = self.arrays.tets[np.maximum(hosts, 0), 0].astype(np.intp) - self.arrays.n_points
        return cells
