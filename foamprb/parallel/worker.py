"""One process of a run on several, with its share of the particles."""

from __future__ import annotations

import gc
import pickle
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.measures import injected
from foamprb.cloud.report import report
from foamprb.cloud.state import Particles, Status, empty
from foamprb.cloud.surroundings.wall_lift import wall_distances
from foamprb.cloud.tracker import Outcome, Tracker
from foamprb.cloudfunctions.base import Memory, memory_of
from foamprb.errors import InputError, RankError, RunStopped
from foamprb.flow.base import Floats
from foamprb.flow.fields import Fields
from foamprb.flow.loaded import LoadedFlow
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.parallel.exchange import Share, join, pack, record, unpack
from foamprb.parallel.parts import Part, Summary
from foamprb.parallel.sampling import Observe, Sampling
from foamprb.parallel.shared_memory import Windows, wait_for_all
from foamprb.results.checkpoint import FUNCTIONS, PARTICLES, StoredCheckpoint
from foamprb.results.vtk import PieceArray, write_snapshot
from foamprb.settings.libs import load_libs

_AT_ONCE = 1 << 22
"""Most particles that all processes send together; a process packs its part of them."""
_COLLECTIVE = ("make", "spread", "free", "put", "set_out", "exchange", "gather")
"""Orders during which processes wait for each other; an error in one of them aborts all processes."""


Piece: TypeAlias = tuple[Path, tuple[PieceArray, ...]]
"""File that a process has written, and its arrays."""


class ShareState(NamedTuple):
    """State of the particles of a process."""

    counts: NDArray[np.int64]
    """Number of each status."""
    outcome: Outcome = Outcome()
    """Progress in the ordered steps."""


class Answer(NamedTuple):
    """Result of an order."""

    value: Any
    error: Exception | None
    signals: list[int]


class Worker:
    """Process with its share of the particles; orders are names of its methods.

    Parameters
    ----------
    MPI
        The module ``mpi4py.MPI``.
    """

    def __init__(self, MPI: Any) -> None:
        self._MPI = MPI
        self.comm = MPI.COMM_WORLD.Dup()
        self.rank: int = self.comm.rank
        self.windows = Windows(MPI, self.comm)
        self.make, self.spread, self.free = self.windows.make, self.windows.spread, self.windows.free
        nothing = Share(empty(0), np.empty(0, dtype=np.int64))
        self.own = nothing
        """Particles that this process advances."""
        self.home = nothing
        """Gathered states of particles of consecutive numbers."""
        self._events: Memory = {}
        # Of a particle as it travels.
        self._dtype, self._record = record(), MPI.BYTE
        self._homes = np.zeros(self.comm.size + 1, dtype=np.int64)
        # True for particles whose state their homes may not have.
        self._fresh = np.empty(0, dtype=bool)
        self._flow: Any = None
        self._sampled: Fields | None = None
        self._part: Part | None = None
        self._hosts: NDArray[np.int64] | None = None
        """Hosts of the particles in the whole mesh, while the node has read its part anew."""
        self._ranks_of: list[list[int]] = []
        self._amid_exchange = False
        self.signals: Sequence[int] = ()
        """Signals that this process has received; the sequence grows."""

    def execute(self, name: str, arguments: tuple[Any, ...], signals: Sequence[int]) -> Answer:
        """Execute an order."""
        self.signals = signals
        try:
            return Answer(getattr(self, name)(*arguments), None, list(signals))
        except Exception as error:
            where = f"rank {self.rank}: "
            torn = self._amid_exchange or (self._part is not None and self._part.torn)
            if name in _COLLECTIVE or torn:
                print(
                    f"--> foamprb Error : {where}{type(error).__name__}: {error}", file=sys.stderr, flush=True
                )
                self.comm.Abort(1)
            if not isinstance(error, InputError | RunStopped | OSError):
                error = RankError(f"{where}{type(error).__name__}: {error}", traceback.format_exc())
            return Answer(None, error, list(signals))

    @property
    def particles(self) -> Particles:
        """Particles that this process advances."""
        return self.own.particles

    def settle(self, libs: Sequence[Path], homes: NDArray[np.int64]) -> None:
        """Make room for the particles whose home this process is.

        Parameters
        ----------
        libs
            Files of models to load.
        homes
            First numbers, see :func:`foamprb.parallel.exchange.homes_of`.
        """
        load_libs(libs)
        self._homes = homes
        first, last = homes[self.rank : self.rank + 2].tolist()
        self.home = Share(empty(last - first), np.arange(first, last))

    def remember(self, layout: Mapping[str, NDArray[Any]]) -> None:
        """Make room for what cloud functions remember of these particles, by arrays without rows."""
        n = len(self.home.ids)
        more = {name: np.zeros((n, *array.shape[1:]), dtype=array.dtype) for name, array in layout.items()}
        self.home = self.home._replace(memory={**self.home.memory, **more})

    def put(self, rank: int, first: int, arrays: Mapping[str, NDArray[Any]] | None = None) -> None:
        """Store arrays of particles at a home.

        Parameters
        ----------
        rank, first
            The home, and the first of its rows.
        arrays
            By their names in a record; on the first process only.
        """
        if self.rank == 0 != rank:
            self.comm.send(arrays, rank)
        elif self.rank == rank:
            given = self.comm.recv(source=0) if arrays is None else arrays
            own = self.home.arrays()
            for name, array in given.items():
                own[name][first : first + len(array)] = array

    def restore(self, file: PathLike[str]) -> None:
        """Read the particles whose home this process is, and what is remembered, from a checkpoint."""
        stored = StoredCheckpoint(Path(file))
        rows = slice(*self._homes[self.rank : self.rank + 2].tolist())
        for name, array in self.home.particles._asdict().items():
            stored.read_into(array, f"{PARTICLES}{name}", rows.start)
        for name, array in self.home.memory.items():
            stored.read_into(array, f"{FUNCTIONS}{name}", rows.start)

    def prepare(self, models: bytes, threads: int) -> None:
        """Compile the loop; ``models`` are a tracker and a :class:`Sampling`."""
        self._tracker: Tracker
        self._sampling: Sampling
        self._tracker, self._sampling = pickle.loads(models)
        self._threads = threads
        self._dtype = record(self._sampling.carried)
        self._record = self._MPI.BYTE.Create_contiguous(self._dtype.itemsize).Commit()

    def set_out(self, ranks_of: list[list[int]]) -> None:
        """Send the particles from their homes to the processes that advance them.

        Injection models release particles roughly in the order of their numbers. The processes of a node take
        them in turn, and therefore have similar numbers of active particles.

        Parameters
        ----------
        ranks_of
            Processes of each node.
        """
        self._ranks_of = ranks_of
        rank_of = self._ranks_in(self._nodes_of(self.home.particles.host), self.home.ids)
        arrived = self._trade(lambda rows: pack(self.home, rows, self._dtype), rank_of)
        self.own = join([unpack(records) for records in arrived])
        if self._part is not None:
            self.particles.host[:] = self._held.hosts_of(self.particles.host)
        self._fresh = self._unfinished(self.particles)

    def _nodes_of(self, hosts: NDArray[np.int64]) -> NDArray[np.int32]:
        """Return the node of each of the hosts of this process' particles, 0 for hosts without a cell."""
        nodes = np.zeros(len(hosts), dtype=np.int32)
        for rank in range(self.comm.size if self._part is not None else 0):
            sought = self.comm.bcast(hosts if rank == self.rank else None, rank)
            flow = self._held.flow
            rows = None if flow is None else flow.own_hosts(sought)[0]
            for number, own in self.comm.gather((self._held.number, rows), rank) or ():
                if own is not None:
                    nodes[own] = number
        return nodes

    def _ranks_in(self, node: NDArray[np.int32], ids: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the process of a node for each particle, by its number."""
        sizes = np.array([len(ranks) for ranks in self._ranks_of])
        table = np.array([np.resize(ranks, sizes.max()) for ranks in self._ranks_of])
        return np.asarray(table[node, ids % sizes[node]])

    def _trade(
        self, packed: Callable[[NDArray[np.int64]], NDArray[Any]], rank_of: NDArray[np.int64]
    ) -> Iterator[NDArray[Any]]:
        """Send records to processes, and yield what comes from all, not too many at a time.

        Parameters
        ----------
        packed
            Returns the records of some rows.
        rank_of
            Process to which each row goes.
        """
        most = max(1, _AT_ONCE // self.comm.size)
        for k in range(max(1, self.comm.allreduce(-(-len(rank_of) // most), self._MPI.MAX))):
            some = rank_of[k * most : (k + 1) * most]
            rows = np.argsort(some, kind="stable")
            sent = np.bincount(some, minlength=self.comm.size).astype(np.int64)
            yield self._swap(packed(k * most + rows), sent)

    def _swap(self, outgoing: NDArray[Any], sent: NDArray[np.int64]) -> NDArray[Any]:
        """Send records, in the order of the processes; return those from all."""
        received = np.empty_like(sent)
        self.comm.Alltoall(sent, received)
        incoming = np.empty(received.sum(), dtype=self._dtype)
        self.comm.Alltoallv([outgoing, (sent, _starts(sent)), self._record],
                            [incoming, (received, _starts(received)), self._record])  # fmt: skip
        return incoming

    def _unfinished(self, p: Particles) -> NDArray[np.bool_]:
        return np.isin(p.status, self._tracker.movable)

    def share(self) -> ShareState:
        """Return the state of the particles."""
        counts = np.bincount(self.particles.status, minlength=len(Status))
        return ShareState(counts)

    def open_part(
        self,
        root: Path,
        region: str,
        times: FlowTimes,
        source: FlowSource,
        depth: int,
        load: NDArray[np.int64] | None,
        step: float,
    ) -> Summary | None:
        """Read the flow on the cells of this node; return a summary on its first process."""
        if self._part is not None:
            if self.particles.size:
                self._hosts = self._part.numbers_of(self.particles.host)
            self._part.close()
            self._part = None
            gc.collect()
        self._part = Part(self._MPI, self.windows)
        return self._part.open(root, region, times, source, depth, load, step)

    def load_of_folders(self, n: int) -> NDArray[np.int64]:
        """Return the number of active particles in each of n processor folders."""
        p, part = self.particles, self._held
        cells = part.cells_of(p.host[p.status == Status.ACTIVE])
        return np.bincount(part.places.folder[cells], minlength=n)

    def go_home(self) -> None:
        """Leave all particles to their homes, which have gathered them."""
        self.own = self.own.take(slice(0))

    def share_part(self, *walls: Any) -> int:
        """Place the arrays of the node's flow, with some walls, in its memory; return bytes shared once."""
        size = self._held.share(*walls)
        self._flow, self._sampled = self._held.arrays, self._held.sampled
        if self._hosts is not None:
            self.particles.host[:], self._hosts = self._held.hosts_of(self._hosts), None
        return size if self.windows.node.rank == 0 else 0

    def load_part(self, start: float, end: float) -> tuple[float, float] | None:
        """Load a flow that changes; see :meth:`Part.load`."""
        found = self._held.load(start, end)
        self._flow, self._sampled = self._held.arrays, self._held.sampled
        return found

    def node_number(self) -> int:
        """Return the number of the node of this process."""
        return self._held.number

    def ask_part(self, name: str, *arguments: Any) -> Any:
        """Return the result of a method of the node's flow on its first process, else None."""
        return self._held.ask(name, *arguments)

    @property
    def _held(self) -> Part:
        assert self._part is not None
        return self._part

    def normals(self, numbers: NDArray[np.int64]) -> tuple[NDArray[np.int64], Floats]:
        """Return which of some particles this process has, and the normals of the walls where they ended."""
        rows = np.flatnonzero(np.isin(self.own.ids, numbers))
        return self.own.ids[rows], self._tracker.contact_normals(self._flow, self.particles, rows)

    def wall_distances(self, x: Floats, numbers: NDArray[np.int64], *others: Any) -> Any:
        """Return which hosts are in own cells of the node, and the distances from walls there.

        On the first process of a node only; see :func:`foamprb.cloud.surroundings.wall_lift.wall_distances`.
        """
        part = self._held
        if part.flow is None:
            return None
        rows, hosts = part.flow.own_hosts(numbers)
        cuts, chosen = others
        return rows, wall_distances(MeshFlow.kernels, part.mesh, x[rows], hosts, cuts[rows], chosen)

    def use_flow(self, flow: bytes) -> None:
        """Replace the arguments of the flow's kernels and the fields, whose arrays lie in shared memory."""
        self._flow, self._sampled = self.windows.find(pickle.loads(flow))

    def exchange(self, plan: NDArray[np.int64]) -> None:
        """Send active particles and receive others: ``plan[i, j]`` from process i to j."""
        sent = plan[self.rank]
        active = np.flatnonzero(self.particles.status == Status.ACTIVE)
        # Evenly spread over the rows, so that costly particles are spread too.
        rows = active[np.arange(sent.sum()) * len(active) // max(sent.sum(), 1)]
        self._replace(rows, unpack(self._swap(pack(self.own, rows, self._dtype), sent)))

    def _replace(self, rows: NDArray[np.int64], others: Share) -> None:
        """Replace the particles of some rows by others."""
        stay = np.ones(self.particles.size, dtype=bool)
        stay[rows] = False
        self.own = join([self.own.take(stay), others])
        self._fresh = np.concatenate([self._fresh[stay], np.ones(len(others.ids), dtype=bool)])

    def advance(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps; ``stop`` or a signal ends them early."""
        stop, tracker = stop or (lambda: bool(self.signals)), self._tracker
        functions = self._sampling.functions
        start, until = (tracker.start + n * tracker.dt for n in (step, step + steps))
        self._observe(functions, start, lambda f, memory, cloud: f.before_steps(memory, cloud, until))
        outcome = tracker.advance(self._flow, self.particles, step, steps, self._threads, bounds, stop)
        self._observe(functions, until, lambda f, memory, cloud: f.after_steps(memory, cloud))
        return self.share()._replace(outcome=outcome)

    def advance_part(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps, and hand over those that have come to other nodes.

        See :meth:`advance`. If any process fails, none hands particles over.
        """
        error: Exception | None = None
        outcome = Outcome()
        try:
            outcome = self.advance(step, steps, bounds, stop).outcome
            self._held.refuse_strays()
        except Exception as raised:
            error = raised
        self.wait_for_all()
        if not self.comm.allreduce(error is not None, self._MPI.LOR):
            self._amid_exchange = True
            self._hand_over()
            self._amid_exchange = False
        if error is not None:
            raise error
        return self.share()._replace(outcome=outcome)

    def _hand_over(self) -> None:
        """Send the particles that may still move and have come to cells of other nodes to these."""
        p, part = self.particles, self._held
        rows = np.flatnonzero(self._unfinished(p) & (p.host >= 0))
        node = part.places.node[part.cells_of(p.host[rows])]
        away = node != part.number
        rows, node = rows[away], node[away]
        rank_of = self._ranks_in(node, self.own.ids[rows])
        arrived = join([unpack(own) for own in self._trade(lambda some: self._packed(rows[some]), rank_of)])
        arrived.particles.host[:] = part.hosts_of(arrived.particles.host)
        self._replace(rows, arrived)

    def _packed(self, rows: NDArray[np.int64]) -> NDArray[Any]:
        """Return records of particles with their hosts in the whole mesh."""
        records = pack(self.own, rows, self._dtype)
        if self._part is not None:
            records["host"] = self._part.numbers_of(records["host"])
        return records

    def take_rebounds(self) -> NDArray[np.float64]:
        """Return the rebounds that happened in this process."""
        return self._tracker.take_rebounds()

    def gather(self, numbers: NDArray[np.int64] | None, settled: bool) -> None:
        """Send particles that may have changed to their homes.

        Parameters
        ----------
        numbers
            Those of some numbers; None for all.
        settled
            Whether what cloud functions remember of particles that have ended is final.
        """
        rows, first = np.flatnonzero(self._fresh), self._homes[self.rank]
        if numbers is not None:
            rows = rows[np.isin(self.own.ids[rows], numbers)]
        homes = np.searchsorted(self._homes[1:], self.own.ids[rows], side="right")
        for records in self._trade(lambda some: self._packed(rows[some]), homes):
            arrays = self.home.arrays()
            for name in self._dtype.names or ():
                arrays[name][records["id"] - first] = records[name]
        if settled:
            self._fresh = self._unfinished(self.particles)

    def sample(self, names: Sequence[str], time: float) -> None:
        """Let some cloud functions sample the particles that this process advances."""
        self._observe(names, time, lambda f, memory, cloud: f.sample(memory, cloud))

    def record(self, rebounds: NDArray[np.float64], time: float) -> None:
        """Let the cloud functions record the rebounds of the particles that this process advances."""
        order = np.argsort(self.own.ids)
        numbers, ids = rebounds[:, 0].astype(np.int64), self.own.ids[order]
        at = np.minimum(np.searchsorted(ids, numbers), max(len(ids) - 1, 0))
        here = ids[at] == numbers if len(ids) else np.zeros(len(numbers), dtype=bool)
        own = np.column_stack([order[at[here]], rebounds[here, 1:]])
        functions = self._sampling.functions
        self._observe(functions, time, lambda f, memory, cloud: f.record_rebounds(memory, cloud, own))

    def _observe(self, names: Iterable[str], time: float, observe: Observe) -> None:
        """See :meth:`Sampling.observe`."""
        own = self.own
        self._events |= self._sampling.observe(
            names, own.memory, own.particles, self._seen, self._tracker, time, self._events, observe
        )

    def take_events(self) -> Memory:
        """Return the events that the functions have recorded since the last call."""
        found, self._events = {**self._sampling.events, **self._events}, {}
        return found

    def take_events_below(self, name: str, number: int) -> NDArray[np.float64]:
        """Return and remove the events of a function, of the particles below a number."""
        events = self._events[name]
        events = events[np.argsort(events[:, 0], kind="stable")]
        n = int(np.searchsorted(events[:, 0], number))
        self._events[name] = events[n:]
        return np.asarray(events[:n])

    def each(self, function: Callable[..., Any], time: float, *arguments: Any) -> Any:
        """Return what a function finds of the particles that this process advances."""
        return function(self.particles, self._seen, time, *arguments)

    def at_home(
        self, function: Callable[..., Any], rank: int | None, part: slice, of: str | None, *arguments: Any
    ) -> Any:
        """Return what a function finds of gathered particles, on one process or on all.

        Parameters
        ----------
        function
            Called with particles of consecutive numbers, what a cloud function remembers of them if there is
            one, and the arguments.
        rank, part
            The process, None for all; and the rows of its particles.
        of
            Name of the cloud function.
        """
        if rank not in (self.rank, None):
            return None
        share = self.home.take(part)
        memory = () if of is None else (memory_of(share.memory, of),)
        return function(share.particles, *memory, *arguments)

    @property
    def _seen(self) -> LoadedFlow:
        """The flow around the particles."""
        cells = None if self._part is None else self._part.places.number
        return LoadedFlow(self._tracker.kernels, self._flow, self._sampled, cells)

    def write(
        self, folder: Path, time: float, names: Mapping[str, Sequence[str]], further: Sequence[str] = ()
    ) -> Piece | None:
        """Write the particles; return the file and its arrays.

        Without particles only the first process writes a file.

        Parameters
        ----------
        folder
            Folder of the pieces.
        time
            Time of the state, s.
        names
            For each array of codes, the meanings of the codes 0, 1, ….
        further
            Names of the optional measures to write.
        """
        if self.rank and not len(injected(self.particles)):
            return None
        file, mu = piece_file(folder, self.rank), self._tracker.mu
        return file, write_snapshot(
            file, report(self.particles, self._seen, mu, time, names, further, self.own.ids)
        )

    def serve(self, signals: Sequence[int]) -> int:
        """Execute the orders of the first process until it dismisses all; return the exit status.

        Parameters
        ----------
        signals
            Signals that this process has received; the sequence grows.
        """
        while True:
            self.wait_for_all()
            name, arguments = self.comm.bcast(None)
            if name == "finalise":
                self.finalise()
                return int(arguments[0])
            answer = self.execute(name, arguments, signals)
            self.wait_for_all()
            self.comm.gather(answer)

    def wait_for_all(self) -> None:
        """See :func:`foamprb.parallel.shared_memory.wait_for_all`."""
        wait_for_all(self.comm)

    def finalise(self) -> None:
        """Free the shared memory, and finalise MPI."""
        if self._part is not None:
            self._part.close()
        for key in sorted(self.windows.arrays):
            self.windows.free(key)
        if self._record != self._MPI.BYTE:
            self._record.Free()
        sys.stdout.flush()
        sys.stderr.flush()
        self._MPI.Finalize()


def piece_file(folder: Path, rank: int) -> Path:
    """Return the file of a process' piece of a cloud."""
    return folder / f"{rank}.vtp"


def _starts(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.cumsum(counts) - counts
