"""Rank of a run on several processes, with its share of the particles."""

from __future__ import annotations

import gc
import pickle
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.communicator import Arrays, Rank, Share
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.measures import injected
from foamprb.cloud.report import Contents, report
from foamprb.cloud.state import Status, empty
from foamprb.cloud.surroundings.wall_lift import wall_distances
from foamprb.cloud.tracker import Outcome
from foamprb.distributed.exchange import pack, unpack, with_others
from foamprb.distributed.node import Part, Summary
from foamprb.distributed.route import Route
from foamprb.distributed.shared_memory import Windows, wait_for_all
from foamprb.errors import InputError, RankError, RunStopped
from foamprb.flow.base import Floats
from foamprb.flow.meshflow import MeshFlow
from foamprb.results.checkpoint import FUNCTIONS, PARTICLES, part_file, write_arrays
from foamprb.results.vtk import PieceArray, write_snapshot
from foamprb.settings.libs import load_libs

Piece: TypeAlias = tuple[Path, tuple[PieceArray, ...]]
"""File that a process has written, and its arrays."""


class ShareState(NamedTuple):
    """State of the particles of a process."""

    counts: NDArray[np.int64]
    """Number of each status."""
    outcome: Outcome = Outcome()
    """Progress in the ordered steps."""


class Answer(NamedTuple):
    """Result of a call."""

    value: Any
    error: Exception | None
    signals: list[int]


class Worker(Rank):
    """Rank of several, each a process of MPI; it executes the calls of the first one."""

    def __init__(self, MPI: Any) -> None:
        super().__init__()
        self._MPI = MPI
        self.comm = MPI.COMM_WORLD.Dup()
        self.number: int = self.comm.rank
        self.windows = Windows(MPI, self.comm)
        self._firsts = np.zeros(self.comm.size + 1, dtype=np.int64)
        self.in_order, self._allocated = True, False
        """Whether each rank has the particles that it writes; whether it has the particles in its cells."""
        self._local_hosts = False
        """Whether hosts are numbered as in the part of the node."""
        self._sorted: NDArray[np.int64] | None = None
        """Rows of the particles in the order of their numbers, as long as it is known."""
        self._part: Part | None = None
        self._ranks_of: list[list[int]] = []
        self._in_collective = False
        self.signals: Sequence[int] = ()
        """Signals that this process has received; the sequence grows."""

    @property
    def firsts(self) -> NDArray[np.int64]:
        """See :class:`Rank`."""
        return self._firsts

    def execute(
        self, function: Callable[..., Any], arguments: tuple[Any, ...], signals: Sequence[int] = ()
    ) -> Answer:
        """Execute a function of this rank and arguments."""
        self.signals = signals
        try:
            return Answer(function(self, *arguments), None, list(signals))
        except Exception as error:
            where = f"rank {self.number}: "
            if self._in_collective or (self._part is not None and self._part.in_collective):
                print(
                    f"--> foamprb Error : {where}{type(error).__name__}: {error}", file=sys.stderr, flush=True
                )
                self.comm.Abort(1)
            if not isinstance(error, InputError | RunStopped | OSError):
                error = RankError(f"{where}{type(error).__name__}: {error}", traceback.format_exc())
            return Answer(None, error, list(signals))

    @contextmanager
    def collective(self) -> Iterator[None]:
        """Let an error within abort all processes, which wait for each other."""
        self._in_collective = True
        yield
        self._in_collective = False

    def window(self, name: str, *arguments: Any) -> None:
        """Call a method of the windows of all processes."""
        with self.collective():
            getattr(self.windows, name)(*arguments)

    def allocate(self, libs: Sequence[Path], firsts: NDArray[np.int64], n_times: int) -> None:
        """Make room for the particles that this process writes to checkpoints."""
        load_libs(libs)
        self._firsts, self.sampling = firsts, None
        self._become(Share(empty(int(firsts[self.number + 1] - firsts[self.number]), n_times)))
        self.in_order, self._allocated, self._local_hosts = True, False, False

    def put(self, rank: int, first: int, arrays: Arrays | None = None) -> None:
        """Store arrays of particles on a rank.

        Parameters
        ----------
        rank, first
            The rank, and the first of its rows.
        arrays
            By their names in a record; on the first process only.
        """
        with self.collective():
            if self.number == 0 != rank:
                self.comm.send(arrays, rank)
            elif self.number == rank:
                received = self.comm.recv(source=0) if arrays is None else arrays
                stored = self.share.arrays()
                for name, array in received.items():
                    stored[name][first : first + len(array)] = array

    def prepare(self, tracker: Any, threads: int) -> None:
        """Take the tracker of the cloud, which compiles with the first steps."""
        self.tracker, self.threads = tracker, threads

    def distribute(self, ranks_of: list[list[int]]) -> None:
        """Send the particles to the processes that advance them.

        Injection models release particles roughly in the order of their numbers. The processes of a node take
        them in turn, and therefore have similar numbers of active particles.
        """
        with self.collective():
            self._ranks_of = ranks_of
            nodes = self._nodes_of(self.particles.host)
            route = self._route(self._ranks_in(nodes, self.particles.number))
            arrays, self.share = self.share.arrays(), Share(empty(0))
            # One variable after the other: memory holds one of them twice.
            self._become(Share.of({name: route.send(arrays.pop(name)) for name in [*arrays]}))
            self.in_order, self._allocated = False, True
            self._use_local_hosts()

    def _become(self, share: Share) -> None:
        self.share, self._sorted = share, None

    def _route(self, rank_of: NDArray[np.int64]) -> Route:
        return Route(self._MPI, self.comm, rank_of)

    def sent(self, to: NDArray[np.int64], array: NDArray[Any]) -> NDArray[Any]:
        """Send each row of an array to a rank; return the rows that arrive. All ranks call it together."""
        with self.collective():
            return self._route(to).send(array)

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

    def complete(self) -> Share:
        """See :meth:`Rank.complete`."""
        if not self._local_hosts:
            return self.share
        p = self.particles
        return self.share._replace(particles=p._replace(host=self._held.numbers_of(p.host)))

    def _nodes_of(self, hosts: NDArray[np.int64]) -> NDArray[np.int32]:
        """Return the node of each of the hosts of this process' particles, 0 for hosts without a cell."""
        nodes = np.zeros(len(hosts), dtype=np.int32)
        for rank in range(self.comm.size if self._part is not None else 0):
            sought = self.comm.bcast(hosts if rank == self.number else None, rank)
            flow = self._held.flow
            rows = None if flow is None else flow.own_hosts(sought)[0]
            for number, rows_there in self.comm.gather((self._held.number, rows), rank) or ():
                if rows_there is not None:
                    nodes[rows_there] = number
        return nodes

    def _ranks_in(self, node: NDArray[np.int32], ids: NDArray[np.int64]) -> NDArray[np.int64]:
        """Return the process of a node for each particle, by its number."""
        sizes = np.array([len(ranks) for ranks in self._ranks_of])
        table = np.array([np.resize(ranks, sizes.max()) for ranks in self._ranks_of])
        return np.asarray(table[node, ids % sizes[node]])

    def state(self) -> ShareState:
        """Return the state of the particles."""
        return ShareState(np.bincount(self.particles.status, minlength=len(Status)))

    def open_part(self, *source: Any) -> Summary | None:
        """Read the flow on the cells of this node; see :meth:`Part.open`."""
        self.close_part()
        self._part = Part(self._MPI, self.windows)
        return self._part.open(*source)

    def close_part(self) -> None:
        """Free the flow on the cells of this node."""
        if self._part is not None:
            self._use_whole_hosts()
            self._part.close()
            self._part = None
            gc.collect()

    def share_part(self, *walls: Any) -> int:
        """Place the arrays of the node's flow, with some walls, in its memory; return bytes shared once."""
        size = self._held.share(*walls)
        self._use_part()
        if self._allocated:
            self._use_local_hosts()
        return size if self.windows.node.rank == 0 else 0

    def load_part(self, start: float, end: float) -> tuple[float, float] | None:
        """Load a flow that changes; see :meth:`Part.load`."""
        loaded = self._held.load(start, end)
        self._use_part()
        return loaded

    def _use_part(self) -> None:
        part = self._held
        self.flow, self.sampled, self.cells = part.arrays, part.sampled, part.places.number

    def node_number(self) -> int:
        """Return the number of the node of this process."""
        return self._held.number

    def call_flow(self, name: str, *arguments: Any) -> Any:
        """Return the result of a method of the node's flow on its first process, else None."""
        return self._held.call(name, *arguments)

    @property
    def _held(self) -> Part:
        assert self._part is not None
        return self._part

    def wall_distances(self, x: Floats, numbers: NDArray[np.int64], *others: Any) -> Any:
        """Return the rows of hosts in owned cells of the node, and their distances from walls.

        On the first process of a node only; see :func:`foamprb.cloud.surroundings.wall_lift.wall_distances`.
        """
        part = self._held
        if part.flow is None:
            return None
        rows, hosts = part.flow.own_hosts(numbers)
        cuts, patches = others
        return rows, wall_distances(MeshFlow.kernels, part.mesh, x[rows], hosts, cuts[rows], patches)

    def use_flow(self, flow: Any) -> None:
        """Replace the arguments of the flow's kernels and the fields, whose arrays lie in shared memory."""
        self.flow, self.sampled = self.windows.find(flow)

    def exchange(self, plan: NDArray[np.int64]) -> None:
        """Send active particles and receive others: ``plan[i, j]`` from process i to j."""
        sent = plan[self.number]
        active = np.flatnonzero(self.particles.status == Status.ACTIVE)
        # Evenly spread over the rows, so that costly particles are spread too.
        rows = active[np.arange(sent.sum()) * len(active) // max(sent.sum(), 1)]
        self.send(rows, np.repeat(np.arange(self.comm.size), sent))

    def send(self, rows: NDArray[np.int64], rank_of: NDArray[np.int64]) -> None:
        """Send the particles in rising rows to other processes; store the particles that arrive."""
        with self.collective():
            arrived = unpack(self._route(rank_of).send(self._packed(rows)))
            if self._local_hosts:
                arrived.particles.host[:] = self._held.hosts_of(arrived.particles.host)
            self._become(with_others(self.share, rows, arrived))

    def _packed(self, rows: NDArray[np.int64]) -> NDArray[Any]:
        """Return records of particles with their hosts in the whole mesh."""
        records = pack(self.share, rows)
        if self._local_hosts:
            records["host"] = self._held.numbers_of(records["host"])
        return records

    def take_steps(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps; ``stop`` or a signal ends them early."""
        outcome = self.advance(step, steps, bounds, stop or (lambda: bool(self.signals)))
        return self.state()._replace(outcome=outcome)

    def take_steps_in_part(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps, then migrate.

        See :meth:`take_steps`. If any process fails, none sends particles.
        """
        error: Exception | None = None
        outcome = Outcome()
        try:
            outcome = self.take_steps(step, steps, bounds, stop).outcome
            self._held.refuse_strays()
        except Exception as raised:
            error = raised
        self.wait_for_all()
        if not self.comm.allreduce(error is not None, self._MPI.LOR):
            self.migrate()
        if error is not None:
            raise error
        return self.state()._replace(outcome=outcome)

    def migrate(self) -> None:
        """Send movable particles to the nodes that own their cells."""
        p, part = self.particles, self._held
        rows = np.flatnonzero(np.isin(p.status, self.tracker.movable) & (p.host >= 0))
        node = part.places.node[part.cells_of(p.host[rows])]
        away = node != part.number
        rows, node = rows[away], node[away]
        self.send(rows, self._ranks_in(node, p.number[rows]))

    @property
    def _order(self) -> NDArray[np.int64]:
        """Rows of the particles in the order of their numbers."""
        if self._sorted is None:
            self._sorted = np.argsort(self.particles.number)
        return self._sorted

    def find(self, numbers: NDArray[np.int64]) -> tuple[NDArray[np.bool_], NDArray[np.int64]]:
        """See :meth:`Rank.find`."""
        ids = self.particles.number[self._order]
        at = np.minimum(np.searchsorted(ids, numbers), max(len(ids) - 1, 0))
        here = ids[at] == numbers if len(ids) else np.zeros(len(numbers), dtype=bool)
        return here, self._order[at[here]]

    def map_blocks(
        self,
        function: Callable[..., Any],
        blocks: Sequence[tuple[int, slice]],
        of: str | None,
        *arguments: Any,
    ) -> list[Any]:
        """Apply a function to some blocks of this rank, while particles are in the order of their numbers."""
        shares = (self.share.take(rows) for rank, rows in blocks if rank == self.number)
        return [share.apply(function, of, *arguments) for share in shares]

    def map_numbers(
        self, function: Callable[..., Any], first: int, rows: int, of: str | None, *arguments: Any
    ) -> Any:
        """Apply a function to particles of consecutive numbers, other ones on each rank.

        Parameters
        ----------
        function, of, arguments
            See :meth:`Share.apply`.
        first, rows
            The first number of the first process, and how many particles each has; the last may have fewer.
        """
        numbers, end = self.particles.number, first + rows * self.comm.size
        rows_sent = self._order[slice(*np.searchsorted(numbers, (first, end), sorter=self._order))]
        arrived = self.sent((numbers[rows_sent] - first) // rows, self._packed(rows_sent))
        if self.number and not len(arrived):
            return None
        return unpack(arrived[np.argsort(arrived["number"])]).apply(function, of, *arguments)

    def write_part(self, file: Path, time: float) -> tuple[int, str] | None:
        """Write particles of consecutive numbers to part of a checkpoint at a time, s.

        Returns
        -------
        The number of the first of them, and a checksum; None if nothing was written: without particles only
        the first process writes a part.
        """
        first, last = self._firsts[self.number : self.number + 2].tolist()
        arrays = self._arrays_in_order()
        try:
            if first == last and self.number:
                return None
            return first, write_arrays(part_file(Path(file), first), time, {}, arrays)
        finally:
            # The others wait for the arrays that this process has not sent yet.
            for _ in arrays:
                pass

    def _arrays_in_order(self) -> Iterator[tuple[str, NDArray[Any]]]:
        """Yield the arrays of the particles that this process writes, by names in a checkpoint.

        One variable after the other, of which memory holds two more copies.
        """
        share = self.complete()
        numbers = share.particles.number
        with self.collective():
            route = self._route(np.searchsorted(self._firsts[1:], numbers, side="right"))
            order = np.argsort(route.send(numbers))
        for kind, arrays in ((PARTICLES, share.particles._asdict()), (FUNCTIONS, share.memory)):
            for name, array in arrays.items():
                with self.collective():
                    arrived = route.send(array)
                yield f"{kind}{name}", arrived[order]

    def write_piece(self, folder: Path, time: float, contents: Contents) -> Piece | None:
        """Write the particles; return the file and its arrays.

        Without particles only the first process writes a file.
        """
        p = self.at_instant(time, contents.of_flow or len(self.seen.field_columns) > 0)
        if self.number and not len(injected(p)):
            return None
        file = piece_file(folder, self.number)
        return file, write_snapshot(file, report(p, self.seen, self.tracker.mu, time, contents, p.number))

    def serve(self, signals: Sequence[int]) -> int:
        """Execute the calls of the first process until it dismisses all; return the exit status.

        Parameters
        ----------
        signals
            Signals that this process has received; the sequence grows.
        """
        while True:
            self.wait_for_all()
            message = self.comm.bcast(None)
            if isinstance(message, int):
                self.finalise()
                return message
            answer = self.execute(_unpickled, (message,), signals)
            self.wait_for_all()
            self.comm.gather(answer)

    def wait_for_all(self) -> None:
        """See :func:`foamprb.distributed.shared_memory.wait_for_all`."""
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


def _unpickled(worker: Worker, message: bytes) -> Any:
    """Execute a pickled function of a rank and its arguments."""
    function, arguments = pickle.loads(message)
    return function(worker, *arguments)
