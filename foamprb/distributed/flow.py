"""Proxy, on rank 0, of a flow distributed over nodes."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.distributed.fragment import IndivisibleMeshError, Labels
from foamprb.distributed.node import Summary
from foamprb.distributed.submesh import layers_over
from foamprb.distributed.worker import Worker
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats, Ints, PatchFaces, Tetrahedra
from foamprb.flow.fields import FieldColumns, FieldValues, by_name, width
from foamprb.flow.meshflow import MeshFlow, MeshSizes
from foamprb.flow.nodes import Ends, Function, NodeValues, joined, stride_over
from foamprb.flow.read.case import is_only_decomposed, processor_folders
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.flows import rotations_of
from foamprb.flow.read.source import FlowSource
from foamprb.flow.series import SeriesFlow
from foamprb.flow.timeline import Timeline

log = logging.getLogger("foamprb")

LEAST_LAYERS = 3
"""Smallest number of layers around the cells of a node."""
Summaries: TypeAlias = Sequence[Summary | None]
OpenParts: TypeAlias = Callable[[int], Summaries]
_CELLS_AT_ONCE = 1 << 24
"""Cells whose sizes all nodes send together."""


class DistributedFields(NamedTuple):
    """Fields of which every node holds a part; see :class:`foamprb.flow.fields.Fields`."""

    ask: Callable[..., list[NDArray[Any]]]
    columns: tuple[FieldColumns, ...]
    start: float
    end: float

    def at(self, points: Floats, hosts: NDArray[Any], t: ArrayLike) -> dict[str, FieldValues]:
        """See :meth:`foamprb.flow.fields.Fields.at`."""
        empty, times = np.full((len(points), width(self.columns)), np.nan), np.broadcast_to(t, len(points))
        values = self.ask("fields_of_own", [empty], points, hosts, times, self.start, self.end)[0]
        return by_name(values, self.columns)


def deepest(n: int, answers: Iterable[tuple[NDArray[np.intp], Labels, Floats]]) -> Labels:
    """Return the host of each of n points, −1 for none, from the rows, hosts and depths that nodes found.

    Of several the one with the largest depth counts, then the first.
    """
    hosts, depths = np.full(n, -1, dtype=np.int64), np.full(n, -np.inf)
    for rows, numbers, depths_there in answers:
        first = (depths_there == depths[rows]) & (numbers < hosts[rows])
        better = (depths_there > depths[rows]) | first
        hosts[rows[better]], depths[rows[better]] = numbers[better], depths_there[better]
    return hosts


class WholeCounts(NamedTuple):
    """Size of the whole mesh, as :class:`foamprb.flow.mesh.mesh.Mesh` names it."""

    n_cells: int
    n_points: int
    tets: range


def require_divisible(case: Path, source: FlowSource, nodes: int) -> None:
    """Raise IndivisibleMeshError if each node must hold the whole mesh, before any node reads the case."""
    if source.file is not None:
        raise IndivisibleMeshError("a mesh file is read")
    if not (source.decomposed or is_only_decomposed(case, source.region)):
        reason = "the flow is read from the case itself; -decomposed reads its processor folders"
        raise IndivisibleMeshError(reason if processor_folders(case) else "it is not decomposed")
    if rotations_of(case, source):
        raise IndivisibleMeshError("the case has rotating zones (MRFProperties)")
    opened = DecomposedCase(case, source.region)
    if opened.processors.n < nodes:
        raise IndivisibleMeshError(f"the case has {opened.processors.n} processor folders for {nodes} nodes")


class DistributedFlow:
    """Steady flow of which every node holds a part; see :class:`foamprb.flow.base.Flow`.

    Hosts have their 64-bit numbers in the whole mesh.

    Parameters
    ----------
    call
        Applies a function to the workers of all processes; see :meth:`foamprb.distributed.ranks.Ranks.call`.
    open_parts
        Lets all nodes read their parts with at least a number of layers around their cells in which bodies
        may move. Returns the summaries of all processes; None unless a process is the first of its node.
    step
        Time between two points where particles can change nodes, s.
    summaries
        Result of ``open_parts`` with :data:`LEAST_LAYERS`.
    """

    kernels = MeshFlow.kernels
    nothing: Callable[[], Any] = staticmethod(MeshFlow.nothing)
    lists_walls = True
    span = (-math.inf, math.inf)

    def __init__(
        self, call: Callable[..., list[Any]], open_parts: OpenParts, step: float, summaries: Summaries
    ) -> None:
        self._call, self._open_parts, self._step = call, open_parts, step
        self._shared: tuple[Any, ...] | None = None
        self.shared_bytes = 0
        self._slip = 0.0
        self._summarise(summaries)
        self._deepen(self._layers)
        first = self.summaries[0]
        self.patches, self.bounds, self.width, self.notes = first[:4]
        n_cells, n_points, n_tets = first.counts
        self.mesh = WholeCounts(n_cells, n_points, range(n_tets))
        self.field_columns = first.columns

    def _deepen(self, layers: int) -> None:
        """Let all nodes read their parts with more layers, until no body crosses them in a step."""
        if layers <= self.depth:
            return
        while self.depth < layers:
            self._summarise(self._open_parts(layers))
            layers = self._layers
        self._share_again()

    def _share_again(self) -> None:
        """Let all nodes list walls as before, after they have read their parts."""
        walls, self._shared = self._shared, None
        if walls is not None:
            self.arrays(*walls)

    def _summarise(self, summaries: Summaries) -> None:
        self.summaries = [summary for summary in summaries if summary is not None]
        self.depth = self.summaries[0].depth
        self._fluid = self.summaries[0].rate

    @property
    def rate(self) -> float:
        """Largest number of cells that a body passes in a time, 1/s."""
        return self._fluid + self._slip * self.summaries[0].steepness

    def expect(self, slip: float, step: float) -> None:
        """Prepare for bodies with a velocity relative to the fluid, m/s, and exchanges after steps, s."""
        self._slip, self._step = slip, step
        self._deepen(self._layers)

    @property
    def _layers(self) -> int:
        """Return the number of layers that no body crosses in a step."""
        return layers_over(self.rate * self._step)

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is steady."""
        return math.inf

    def arrays(
        self, reach: float = 0.0, touchable: Sequence[int] = (), sight: float = 0.0, seen: Sequence[int] = ()
    ) -> Any:
        """Let all nodes list walls; return arrays without a mesh, for which the kernels can be compiled."""
        walls = reach, tuple(touchable), sight, tuple(seen)
        if walls != self._shared:
            self._shared = None
            self.shared_bytes = sum(self._call(Worker.share_part, *walls))
            self._shared = walls
        return self.nothing()

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """No-op: the nodes have moved their arrays."""

    def _ask(self, name: str, *arguments: Any) -> list[Any]:
        """Return the results of a method of the flows of all nodes."""
        return [answer for answer in self._call(Worker.call_flow, name, *arguments) if answer is not None]

    def _ask_own(self, name: str, empty: Sequence[NDArray[Any]], *arguments: Any) -> list[NDArray[Any]]:
        """Return results, whose rows the nodes have, as arrays of all rows."""
        arrays = list(empty)
        for rows, *parts in self._ask(name, *arguments):
            for array, part in zip(arrays, parts, strict=True):
                array[rows] = part
        return arrays

    def _at_own(self, name: str, empty: Sequence[NDArray[Any]], *arguments: Any) -> list[NDArray[Any]]:
        """Return the results of a method of the flow at hosts, each from the node that owns it."""
        return self._ask_own("at_own", empty, name, *arguments)

    def locate(self, points: Floats) -> Labels:
        """Return the host of each point (n, 3), −1 outside."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        return deepest(len(points), self._ask("locate_own", points))

    def sample(self, points: Floats, hosts: NDArray[Any], t: float) -> tuple[Floats, Floats]:
        """Return velocities (n, 3), m/s, and ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) in hosts (n,)."""
        empty = np.full((len(points), 3), np.nan), np.full((len(points), 3, 3), np.nan)
        u, l = self._at_own("sample", empty, hosts, points, t)
        return u, l

    def cell_size(self, hosts: NDArray[Any]) -> Floats:
        """Return the cube root of the volume of the hosts' cells, (n,), m."""
        return self._at_own("cell_size", [np.full(len(hosts), np.nan)], hosts)[0]

    def mesh_sizes(self) -> MeshSizes:
        """Return the sizes of all cells and boundary faces; see :meth:`MeshFlow.mesh_sizes`."""
        faces, *values = map(np.concatenate, zip(*self._ask("own_faces"), strict=True))
        order = np.argsort(faces)
        patches, owner, areas, centres = (array[order] for array in values)
        start = np.searchsorted(patches, np.arange(len(self.patches) + 1))
        return MeshSizes(self._volumes(), owner, areas, centres, start)

    def _volumes(self) -> Floats:
        """Return the volumes of all cells, (n_cells,), m³."""
        volumes = []
        for low in range(0, self.mesh.n_cells, _CELLS_AT_ONCE):
            answers = self._ask("own_cells", low, low + _CELLS_AT_ONCE)
            order = np.argsort(np.concatenate([answer[0] for answer in answers]))
            volumes.append(np.concatenate([answer[1] for answer in answers])[order])
        return np.concatenate(volumes)

    def times_within(self, start: float, end: float) -> Sequence[float]:  # noqa: ARG002
        """Return no times: the flow is steady."""
        return ()

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Return the triangles of a patch; InputError if there is no such patch."""
        names = [patch.name for patch in self.patches]
        if name not in names:
            raise InputError(f"patch {name} is not in the mesh. {suggestion(name, names)}")
        parts = self._ask("own_patch_faces", name, t)
        order = np.argsort(np.concatenate([faces for faces, _ in parts]), kind="stable")
        return PatchFaces(
            *(np.concatenate(arrays)[order] for arrays in zip(*(p for _, p in parts), strict=True))
        )

    def cell_zone(self, name: str | None) -> Tetrahedra:
        """Return the tetrahedra of a zone of cells, or of all cells; InputError if there is no such zone."""
        parts = self._ask("own_zone", name)
        hosts = np.concatenate([numbers for _, numbers in parts])
        order = np.argsort(hosts)
        volumes: Floats = np.concatenate([part for part, _ in parts])[order]
        sorted_hosts: Any = hosts[order]
        return Tetrahedra(volumes, sorted_hosts, self._vertices)

    def _vertices(self, hosts: Ints) -> Floats:
        """Return the vertices of tetrahedra, (n, 4, 3), m."""
        return self._at_own("_vertices", [np.empty((len(hosts), 4, 3))], hosts)[0]

    def viscosity(self, points: Floats, hosts: NDArray[Any], t: float) -> Floats:
        """Return the field of the viscosity at points (n, 3) in hosts (n,) at t, s, as it was read, (n,)."""
        return self._at_own("viscosity", [np.full(len(points), np.nan)], hosts, points, t)[0]

    def fields(self, start: float, end: float) -> DistributedFields:
        """Return the fields that are sampled, from time ``start`` to ``end``, s."""
        return DistributedFields(self._ask_own, self.field_columns, start, end)

    def at_some_nodes(self) -> NodeValues:
        """See :meth:`foamprb.flow.base.Flow.at_some_nodes`."""
        stride = stride_over(self.mesh.n_points + self.mesh.n_cells)
        numbers, parts = zip(*self._ask("every_node", stride), strict=True)
        # Nodes of the mesh beside several computers are equal on all of them.
        _, first = np.unique(np.concatenate(numbers), return_index=True)
        values = (np.concatenate(columns) for columns in zip(*(part[1:] for part in parts), strict=True))
        return NodeValues(parts[0].time, *values).take(first)

    def ends_at_nodes(self, function: Function) -> Ends:
        """See :meth:`foamprb.flow.base.Flow.ends_at_nodes`."""
        return joined(self._ask("ends_at_nodes", function))

    def gradient_jumps(self) -> NDArray[np.int64]:
        """See :meth:`foamprb.flow.base.Flow.gradient_jumps`."""
        counts: NDArray[np.int64] = np.sum(self._ask("gradient_jumps"), axis=0)
        return counts

    def wall_distances(self, x: Floats, hosts: NDArray[Any], *others: Any) -> Floats:
        """See :func:`foamprb.cloud.surroundings.wall_lift.wall_distances`; by the walls listed last."""
        nearest = np.full(len(x), np.inf)
        for answer in self._call(Worker.wall_distances, x, hosts, *others):
            if answer is not None:
                nearest[answer[0]] = answer[1]
        return nearest

    def traits(self) -> Mapping[str, ArrayLike]:
        """Return the traits of the flow on one node, but for round-off."""
        first, *others = self._ask("traits")
        fixed = ("times", "period")
        return {
            name: value if name in fixed else sum((traits[name] for traits in others), start=value)
            for name, value in first.items()
        }


class DistributedSeries(Timeline, DistributedFlow):
    """Flow that changes in time, see :class:`DistributedFlow`; all nodes load times together.

    ``rate`` is that at the loaded times, to which the number of steps between two exchanges is adapted.
    """

    kernels = SeriesFlow.kernels
    nothing = staticmethod(SeriesFlow.nothing)

    def __init__(self, *arguments: Any) -> None:
        super().__init__(*arguments)
        first = self.summaries[0]
        self._set_times(first.times, first.period)

    def load(self, start: float, end: float) -> float:
        """Let all nodes load times; see :meth:`foamprb.flow.series.SeriesFlow.load`.

        They read their parts anew if the flow has become too fast for the layers.
        """
        until = self._load_all(start, end)
        if self._layers > self.depth:
            log.info("    The flow is faster than before: nodes read more cells around theirs.")
            # It may become faster still.
            self._deepen(self._layers + self._layers // 2)
            until = self._load_all(start, end)
        return until

    def sums_around(self, t: float) -> Floats:
        """Return the sums of :meth:`foamprb.flow.series.SeriesFlow.sums_around` but for round-off."""
        self.load(t, t)
        total: Floats = np.sum(self._ask("sums_around", t), axis=0)
        return total

    def _load_all(self, start: float, end: float) -> float:
        answers = [answer for answer in self._call(Worker.load_part, start, end) if answer is not None]
        self._fluid = max(rate for _, rate in answers)
        return float(answers[0][0])


def distributed_flow(call: Callable[..., list[Any]], open_parts: OpenParts, step: float) -> DistributedFlow:
    """Return the flow of which all nodes hold parts; see :class:`DistributedFlow`."""
    summaries = open_parts(LEAST_LAYERS)
    first = next(summary for summary in summaries if summary is not None)
    kind = DistributedSeries if first.times else DistributedFlow
    return kind(call, open_parts, step, summaries)
