"""One process of a run on several, with its share of the particles."""

from __future__ import annotations

import gc
import pickle
import sys
import traceback
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import contextmanager
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
from foamprb.cloudfunctions.base import ContactObserver, Memory, StepObserver, add_up, in_time, memory_of
from foamprb.errors import InputError, RankError, RunStopped
from foamprb.flow.base import Floats
from foamprb.flow.fields import Fields
from foamprb.flow.loaded import LoadedFlow
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.parallel.exchange import Share, pack, unpack
from foamprb.parallel.parts import Part, Summary
from foamprb.parallel.route import Route
from foamprb.parallel.sampling import Observe, Sampling
from foamprb.parallel.shared_memory import Windows, wait_for_all
from foamprb.results.checkpoint import (
    FUNCTIONS,
    PARTICLES,
    StoredCheckpoint,
    part_file,
    write_arrays,
)
from foamprb.results.vtk import PieceArray, write_snapshot
from foamprb.settings.libs import load_libs

_COLLECTIVE = ("make", "spread", "free", "put", "set_out", "exchange")
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
        self.own = Share(empty(0))
        """Particles that this process holds: those whose home it is, until they set out."""
        self._homes = np.zeros(self.comm.size + 1, dtype=np.int64)
        self.at_home, self._settled = True, False
        """Whether all particles are at their homes; whether they are where their cells are."""
        self._sorted: NDArray[np.int64] | None = None
        """Rows of the particles in the order of their numbers, as long as it is known."""
        self._local_hosts = False
        """Whether hosts are numbered as in the part of the node."""
        self._events: Memory = {}
        self._sums: dict[str, tuple[NDArray[np.int64], Floats]] = {}
        """Of each function with sums of cells, the first cell of each process, and own sums."""
        self._flow: Any = None
        self._sampled: Fields | None = None
        self._part: Part | None = None
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
        """Particles that this process holds."""
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
        self._become(Share(empty(int(homes[self.rank + 1] - homes[self.rank]))))
        self._sums = {}
        self.at_home, self._settled, self._local_hosts = True, False, False

    def remember(self, layout: Mapping[str, NDArray[Any]]) -> None:
        """Make room for what cloud functions remember of these particles, by arrays without rows."""
        n = self.particles.size
        more = {name: np.zeros((n, *array.shape[1:]), dtype=array.dtype) for name, array in layout.items()}
        self.own = self.own._replace(memory={**self.own.memory, **more})

    def share_sums(self, name: str, shape: tuple[int, ...]) -> None:
        """Make room for sums of a function, of a shape (n_cells, …), of the cells that this process has."""
        homes, n = self._homes, shape[0]
        # A process without a part of a checkpoint has none.
        first = np.where(homes == homes[-1], n, homes * n // max(homes[-1], 1))
        first[0] = 0
        own = first[self.rank + 1] - first[self.rank]
        self._sums[name] = first, np.zeros((int(own), *shape[1:]))

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
            own = self.own.arrays()
            for name, array in given.items():
                own[name][first : first + len(array)] = array

    def restore(self, file: PathLike[str]) -> None:
        """Read the particles whose home this process is, what is remembered, and sums, from a checkpoint."""
        stored = StoredCheckpoint(Path(file))
        rows = slice(*self._homes[self.rank : self.rank + 2].tolist())
        for name, array in self.particles._asdict().items():
            stored.read_into(array, f"{PARTICLES}{name}", rows.start)
        for name, array in self.own.memory.items():
            stored.read_into(array, f"{FUNCTIONS}{name}", rows.start)
        for name, (first, sums) in self._sums.items():
            stored.read_into(sums, f"{FUNCTIONS}{name}/sums", int(first[self.rank]))

    def prepare(self, models: bytes, threads: int) -> None:
        """Compile the loop; ``models`` are a tracker and a :class:`Sampling`."""
        self._tracker: Tracker
        self._sampling: Sampling
        self._tracker, self._sampling = pickle.loads(models)
        self._threads = threads

    def set_out(self, ranks_of: list[list[int]]) -> None:
        """Send the particles to the processes that advance them.

        Injection models release particles roughly in the order of their numbers. The processes of a node take
        them in turn, and therefore have similar numbers of active particles.

        Parameters
        ----------
        ranks_of
            Processes of each node.
        """
        self._ranks_of = ranks_of
        nodes = self._nodes_of(self.particles.host)
        route = self._route(self._ranks_in(nodes, self.particles.number))
        arrays, self.own = self.own.arrays(), Share(empty(0))
        # One variable after the other: memory holds one of them twice.
        self._become(Share.of({name: route.send(arrays.pop(name)) for name in [*arrays]}))
        self.at_home, self._settled = False, True
        self._use_local_hosts()

    def _become(self, share: Share) -> None:
        self.own, self._sorted = share, None

    def _route(self, rank_of: NDArray[np.int64]) -> Route:
        return Route(self._MPI, self.comm, rank_of)

    @contextmanager
    def _exchanging(self) -> Iterator[None]:
        """Let an error within abort all processes, which wait for each other."""
        self._amid_exchange = True
        yield
        self._amid_exchange = False

    def _use_local_hosts(self) -> None:
        """Number the hosts as in the part of the node, if it has one."""
        if self._part is not None and not self._local_hosts:
            self.particles.host[:] = self._part.hosts_of(self.particles.host)
            self._local_hosts = True

    def _use_whole_hosts(self) -> None:
        """Number the hosts as in the whole mesh."""
        if self._local_hosts:
            self.particles.host[:] = self._held.numbers_of(self.particles.host)
            self._local_hosts = False

    def _with_whole_hosts(self, share: Share) -> Share:
        """Return some of the particles with hosts of the whole mesh."""
        if not self._local_hosts:
            return share
        p = share.particles
        return share._replace(particles=p._replace(host=self._held.numbers_of(p.host)))

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
        self.close_part()
        self._part = Part(self._MPI, self.windows)
        return self._part.open(root, region, times, source, depth, load, step)

    def close_part(self) -> None:
        """Free the flow on the cells of this node."""
        if self._part is not None:
            self._use_whole_hosts()
            self._part.close()
            self._part = None
            gc.collect()

    def load_of_folders(self, n: int) -> NDArray[np.int64]:
        """Return the number of active particles in each of n processor folders."""
        p, part = self.particles, self._held
        cells = part.cells_of(p.host[p.status == Status.ACTIVE])
        return np.bincount(part.places.folder[cells], minlength=n)

    def break_up(self) -> None:
        """Prepare the particles for another part of the mesh, for which they will set out again."""
        self._use_whole_hosts()
        self._settled = False

    def share_part(self, *walls: Any) -> int:
        """Place the arrays of the node's flow, with some walls, in its memory; return bytes shared once."""
        size = self._held.share(*walls)
        self._flow, self._sampled = self._held.arrays, self._held.sampled
        if self._settled:
            self._use_local_hosts()
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
        rows = self._rows_of(numbers)
        return self.particles.number[rows], self._tracker.contact_normals(self._flow, self.particles, rows)

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
        self._send(rows, np.repeat(np.arange(self.comm.size), sent))

    def _send(self, rows: NDArray[np.int64], rank_of: NDArray[np.int64]) -> None:
        """Send the particles of some rising rows to processes, and take what others send."""
        arrived = unpack(self._route(rank_of).send(self._packed(rows)))
        if self._local_hosts:
            arrived.particles.host[:] = self._held.hosts_of(arrived.particles.host)
        self._become(self.own.with_others(rows, arrived))

    def _packed(self, rows: NDArray[np.int64]) -> NDArray[Any]:
        """Return records of particles with their hosts in the whole mesh."""
        records = pack(self.own, rows)
        if self._local_hosts:
            records["host"] = self._held.numbers_of(records["host"])
        return records

    def advance(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps; ``stop`` or a signal ends them early."""
        stop, tracker = stop or (lambda: bool(self.signals)), self._tracker
        functions = self._sampling.names_of(StepObserver)
        start, until = (tracker.start + n * tracker.dt for n in (step, step + steps))
        self._observe(functions, start, lambda f, memory, cloud: f.before_steps(memory, cloud, until))
        outcome = tracker.advance(
            self._flow, self.particles, step, steps, self._threads, bounds, stop, self._sampled
        )
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
            with self._exchanging():
                self._hand_over()
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
        self._send(rows, self._ranks_in(node, p.number[rows]))

    def take_rebounds(self) -> NDArray[np.float64]:
        """Return the rebounds that happened in this process."""
        return self._tracker.take_rebounds()

    def sample(self, names: Sequence[str], time: float) -> None:
        """Let some cloud functions sample the particles that this process advances."""
        self._observe(names, time, lambda f, memory, cloud: f.sample(memory, cloud))

    def record(self, rebounds: NDArray[np.float64], time: float) -> None:
        """Let the cloud functions record the rebounds of the particles that this process advances."""
        order = self._in_order
        numbers, ids = rebounds[:, 0].astype(np.int64), self.particles.number[order]
        at = np.minimum(np.searchsorted(ids, numbers), max(len(ids) - 1, 0))
        here = ids[at] == numbers if len(ids) else np.zeros(len(numbers), dtype=bool)
        own = np.column_stack([order[at[here]], rebounds[here, 1:]])
        functions = self._sampling.names_of(ContactObserver)
        self._observe(functions, time, lambda f, memory, cloud: f.record_rebounds(memory, cloud, own))

    def _observe(self, names: Iterable[str], time: float, observe: Observe) -> None:
        """See :meth:`Sampling.observe`."""
        own = self.own
        self._events |= self._sampling.observe(
            names, own.memory, own.particles, self._seen, self._tracker, time, self._events, observe
        )

    def observe(
        self, numbers: NDArray[np.int64], function: Callable[..., Any], time: float, *arguments: Any
    ) -> Any:
        """Return what a function finds of those of some particles that this process advances, as a cloud."""
        own = self.particles.take(self._rows_of(numbers))
        return function(self._sampling.cloud(own, self._seen, self._tracker, time), *arguments)

    def take_events(self) -> Memory:
        """Return the events that the functions have recorded since the last call."""
        found, self._events = {**self._sampling.events, **self._events}, {}
        return found

    def add_up(self, names: Sequence[str]) -> None:
        """Add the events of some functions to the sums of cells, each on the process that has these."""
        for name in names:
            (first, sums), events = self._sums[name], self._events[name]
            with self._exchanging():
                found = self._route(np.searchsorted(first[1:], events[:, 2], side="right")).send(events)
            found[:, 2] -= first[self.rank]
            add_up(sums, in_time(found))
            self._events[name] = events[:0].copy()

    def of_cells(self, name: str, part: slice) -> Floats:
        """Return the sums of those of some consecutive cells that this process has."""
        first, sums = self._sums[name]
        own = slice(*np.clip([part.start, part.stop], *first[self.rank : self.rank + 2]) - first[self.rank])
        return sums[own]

    def each(self, function: Callable[..., Any], time: float, *arguments: Any) -> Any:
        """Return what a function finds of the particles that this process advances."""
        return function(self.particles, self._seen, time, *arguments)

    def _rows_of(self, numbers: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the rows of those of some particles that this process has."""
        return np.flatnonzero(np.isin(self.particles.number, numbers))

    @property
    def _in_order(self) -> NDArray[np.int64]:
        """Rows of the particles in the order of their numbers."""
        if self._sorted is None:
            self._sorted = np.argsort(self.particles.number)
        return self._sorted

    def of_own(self, function: Callable[..., Any], of: str | None, *arguments: Any) -> Any:
        """Return what a function finds of the particles that this process holds.

        Parameters
        ----------
        function
            Called with the particles, what a cloud function remembers of them if there is one, and the
            arguments.
        of
            Name of the cloud function.
        """
        return _found(self._with_whole_hosts(self.own), function, of, arguments)

    def chosen(self, numbers: NDArray[np.int64]) -> Particles:
        """Return those of some particles that this process holds."""
        rows = self._rows_of(numbers)
        return self._with_whole_hosts(Share(self.particles.take(rows))).particles

    def of_home(
        self,
        function: Callable[..., Any],
        parts: Sequence[tuple[int, slice]],
        of: str | None,
        *arguments: Any,
    ) -> list[Any]:
        """Return what a function finds of each of some parts that this process has, while all are at home.

        Parameters
        ----------
        function, of
            See :meth:`of_own`.
        parts
            Homes, and rows of their particles.
        """
        own = (self.own.take(part) for rank, part in parts if rank == self.rank)
        return [_found(share, function, of, arguments) for share in own]

    def of_parts(
        self, function: Callable[..., Any], first: int, rows: int, of: str | None, *arguments: Any
    ) -> Any:
        """Return what a function finds of particles of consecutive numbers, other ones on each process.

        Parameters
        ----------
        function, of
            See :meth:`of_own`.
        first, rows
            The first number of the first process, and how many particles each has; the last may have fewer.
        """
        numbers, end = self.particles.number, first + rows * self.comm.size
        chosen = self._in_order[slice(*np.searchsorted(numbers, (first, end), sorter=self._in_order))]
        with self._exchanging():
            arrived = self._route((numbers[chosen] - first) // rows).send(self._packed(chosen))
        if self.rank and not len(arrived):
            return None
        return _found(unpack(arrived[np.argsort(arrived["number"])]), function, of, arguments)

    def write_part(self, file: PathLike[str], time: float) -> tuple[int, str] | None:
        """Write the particles whose home this process is, and its sums, to part of a checkpoint at a time, s.

        Returns
        -------
        The number of the first of them, and a checksum; None if nothing was written: without particles only
        the first process writes a part.

        Raises
        ------
        OSError
            If the file cannot be written.
        """
        first, last = self._homes[self.rank : self.rank + 2].tolist()
        arrays = self._sent_home()
        try:
            if first == last and self.rank:
                return None
            return first, write_arrays(part_file(Path(file), first), time, {}, arrays)
        finally:
            # The others need what this process has not sent yet.
            for _ in arrays:
                pass

    def _sent_home(self) -> Iterator[tuple[str, NDArray[Any]]]:
        """Yield the arrays of the particles whose home this process is, and sums, by names in a checkpoint.

        One variable after the other, of which memory holds two more copies.
        """
        share = self._with_whole_hosts(self.own)
        numbers = share.particles.number
        with self._exchanging():
            route = self._route(np.searchsorted(self._homes[1:], numbers, side="right"))
            order = np.argsort(route.send(numbers))
        for kind, arrays in ((PARTICLES, share.particles._asdict()), (FUNCTIONS, share.memory)):
            for name, array in arrays.items():
                with self._exchanging():
                    found = route.send(array)
                yield f"{kind}{name}", found[order]
        yield from ((f"{FUNCTIONS}{name}/sums", sums) for name, (_, sums) in self._sums.items())

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
            file, report(self.particles, self._seen, mu, time, names, further, self.particles.number)
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
        sys.stdout.flush()
        sys.stderr.flush()
        self._MPI.Finalize()


def piece_file(folder: Path, rank: int) -> Path:
    """Return the file of a process' piece of a cloud."""
    return folder / f"{rank}.vtp"


def _found(share: Share, function: Callable[..., Any], of: str | None, arguments: tuple[Any, ...]) -> Any:
    """Return what a function finds of particles, and of what a cloud function remembers of them."""
    memory = () if of is None else (memory_of(share.memory, of),)
    return function(share.particles, *memory, *arguments)
