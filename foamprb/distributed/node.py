"""Part of a mesh that the processes of a node share, and the nodes that hold the mesh together."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

import numpy as np
from numpy.typing import NDArray

from foamprb.distributed.fragment import Labels, Team
from foamprb.distributed.partcase import PartCase
from foamprb.distributed.partflow import PartFlow, PartSeries
from foamprb.distributed.shared_memory import Publisher, Windows, wait_for_all
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints
from foamprb.flow.fields import FieldColumns, Fields
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.mesh.lists import Index
from foamprb.flow.read.openfoam import flow_of
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.flow.series import SeriesArrays

T = TypeVar("T")


class MpiTeam(Team):
    """Nodes, by their first processes."""

    def __init__(self, comm: Any) -> None:
        self._comm = comm
        self.rank = comm.rank
        self.size = comm.size

    def swap(self, parcels: Sequence[Any]) -> list[Any]:
        """See :meth:`Team.swap`."""
        received = list(parcels)
        # Pair by pair, as the lengths of one collective message are 32-bit integers.
        for k in range(1, self.size):
            to, source = (self.rank + k) % self.size, (self.rank - k) % self.size
            received[source] = self._comm.sendrecv(parcels[to], to, source=source)
        return received


class PlacesInWhole(NamedTuple):
    """Where the cells of a node lie in the whole mesh."""

    number: Labels
    """(n_cells,) the number of each cell in the whole mesh."""
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
    sampled: Fields


class SharedAtTimes(NamedTuple):
    """Arrays that the processes of a node share, at the loaded times."""

    flow: SeriesArrays
    sampled: Fields


class Summary(NamedTuple):
    """Properties of the distributed flow, and of the part of one node."""

    patches: tuple[Any, ...]
    bounds: tuple[Floats, Floats]
    width: float
    notes: tuple[str, ...]
    counts: tuple[int, int, int]
    """Cells, points and tetrahedra of the whole mesh."""
    owned: int
    """Number of owned cells."""
    depth: int
    """Number of layers around these in which bodies may move."""
    held: int
    """Number of cells in memory, with the layers of other nodes' cells."""
    rate: float
    """Largest velocity of the fluid over the width of a cell, 1/s."""
    steepness: float
    """Largest inverse of the width of a cell, 1/m."""
    columns: tuple[FieldColumns, ...]
    """Fields that are sampled."""
    time: str
    """Name of the first time."""
    times: tuple[float, ...]
    """Times of a flow that changes, s; none of a steady one."""
    period: float | None


def summary_of(flow: PartFlow) -> Summary:
    """Return the summary of a part; all nodes call it together."""
    halo, time = flow.halo, flow.at_nodes()[0]
    owned = halo.part.owned
    return Summary(
        flow.patches[:-1], flow.bounds, flow.width, flow.notes, flow.counts,
        int(owned.sum()), halo.part.depth, len(owned),
        max(halo.of_all(flow.rate)), max(halo.of_all(flow.steepness)), flow.field_columns, time,
        *((flow.times, flow.period) if isinstance(flow, PartSeries) else ((), None)),
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
        self.sampled: Fields | None = None
        """Fields that are sampled."""
        self._loaded: SeriesArrays | None = None
        self.in_collective = False
        """True while the processes of the node might not agree on the next call."""

    def close(self) -> None:
        """Free the shared memory."""
        for key in sorted(self.shared.arrays):
            self.shared.free(key)
        self.flow = None

    def refuse_strays(self) -> None:
        """Raise InputError if a path has left the cells of this node since the last call."""
        strayed = self.mesh.strayed
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

    @property
    def arrays(self) -> Any:
        """Return the arrays for the kernels; see :meth:`foamprb.flow.base.Flow.arrays`."""
        return self._in_space if self._loaded is None else self._loaded._replace(mesh=self.mesh)

    @property
    def mesh(self) -> MeshArrays:
        """Return the arrays of the mesh."""
        arrays: MeshArrays = self._in_space
        return arrays

    def open(self, root: Path, times: FlowTimes, source: FlowSource, *layers: Any) -> Summary | None:
        """Read the flow; return a summary on the first process of the node.

        Parameters
        ----------
        root, times, source
            The case, the times of the flow, and the names of its fields.
        layers
            Least number of layers; see :class:`PartCase`.
        """

        def read(team: MpiTeam) -> Summary:
            flow = flow_of(PartCase(root, source.region, team, *layers), times, source)
            assert isinstance(flow, PartFlow)
            self.flow = flow
            flow.move(self._publisher.move)
            return summary_of(flow)

        return self._lead(read)

    def share(self, *walls: Any) -> int:
        """Place the arrays of the flow, with some walls, in the memory of the node; return bytes shared.

        Raises
        ------
        InputError
            The lists of walls would be too long.
        """

        def place(_: MpiTeam) -> Any:
            assert self.flow is not None
            places = PlacesInWhole(*self.flow.places_in_whole())
            sampled = self.flow.loaded_fields()
            placed = self._publisher.replace(Shared(self.flow.in_space(*walls), places, sampled))
            self.flow.forget_walls()
            return placed

        self._in_space, self.places, self.sampled = self.shared.find(self._tell(self._lead(place)))
        return self.size

    def load(self, start: float, end: float) -> tuple[float, float] | None:
        """Load a flow that changes; see :meth:`foamprb.flow.base.Flow.load`.

        Returns
        -------
        The end of the loaded interval, and the rate of this part, on the first process of the node.
        """

        def load(_: MpiTeam) -> tuple[tuple[float, float], Any]:
            assert isinstance(self.flow, PartSeries)
            until = self.flow.load(start, end)
            now = SharedAtTimes(self.flow.loaded(), self.flow.loaded_fields())
            return (until, self.flow.rate), self._publisher.publish(now)

        loaded, placed = self._tell(self._lead(load))
        self._loaded, self.sampled = self.shared.find(placed)
        return loaded if self._leads else None

    def call(self, name: str, *arguments: Any) -> Any:
        """Return the result of a method of the flow on the first process of the node, else None."""
        return self._lead(lambda _: getattr(self.flow, name)(*arguments))

    def _lead(self, work: Callable[[MpiTeam], T]) -> T | None:
        """Return the result of some work of the first processes of all nodes, else None.

        The other processes carry out the orders of theirs. All raise the error of one.
        """
        if self._team is None:
            self._follow()
            return None
        try:
            with self._team.united():
                result = work(self._team)
        except Exception as error:
            if not self.in_collective:
                self._tell((None, (error,)))
            raise
        self._tell((None, (None,)))
        return result

    def _order(self, name: str, *arguments: Any) -> None:
        """Let all processes of the node call a method of their windows."""
        self._tell((name, arguments))
        self._execute(name, arguments)

    def _follow(self) -> None:
        """Carry out orders of the first process of the node until it ends them, perhaps by an error."""
        while True:
            name, arguments = self._tell()
            if name is None:
                if arguments[0] is not None:
                    raise arguments[0]
                return
            self._execute(name, arguments)

    def _execute(self, name: str, arguments: tuple[Any, ...]) -> None:
        self.in_collective = True
        getattr(self.shared, name)(*arguments)
        self.in_collective = False

    def _tell(self, message: Any = None) -> Any:
        """Return the message of the first process of the node."""
        wait_for_all(self._node)
        return self._node.bcast(message)

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
        cells: Index = self.mesh.tets[np.maximum(hosts, 0), 0].astype(np.intp) - self.mesh.n_points
        return cells
