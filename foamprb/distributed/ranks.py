"""Communicator of a run on several processes, ``mpirun -np N foamprb run -parallel``.

The processes share the particles; on several computers (nodes) they may also share the mesh. The first
process reads the case and executes the run. Each of its decisions is broadcast as a function, which every
:class:`~foamprb.distributed.worker.Worker` applies to its own particles. All processes therefore agree on
the next operation, and an error or a signal of any process returns with its answer. The flow's arrays lie in
memory that the processes of a computer share (:mod:`foamprb.distributed.shared_memory`).

The compiled code and the distance to which walls are listed do not depend on the number of processes, and
particles do not act on each other. Results are the same, bit for bit, for any distribution.
"""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable, Iterable, Iterator, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud import communicator
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.communicator import Arrays, Communicator, Value, parts_of
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.measures import largest_slip
from foamprb.cloud.report import Contents
from foamprb.cloud.state import VARIABLES, Particles, Status, empty
from foamprb.cloud.tracker import Outcome
from foamprb.distributed.exchange import firsts_of, plan_exchange
from foamprb.distributed.flow import DistributedFlow, distributed_flow, require_divisible
from foamprb.distributed.fragment import IndivisibleMeshError
from foamprb.distributed.shared_memory import Publisher
from foamprb.distributed.worker import Answer, ShareState, Worker, piece_file
from foamprb.flow.base import Flow
from foamprb.flow.fields import Fields
from foamprb.flow.loaded import loaded_fields
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.results.pvd import with_ending
from foamprb.results.vtk import write_pieces
from foamprb.settings.libs import loaded_libs

log = logging.getLogger("foamprb")

BLOCKS = 4
"""Number of blocks per collective call."""


class Ranks(Communicator):
    """Processes of ``mpirun``, commanded by the first of them."""

    rank: Worker

    def __init__(self, worker: Worker, threads: int) -> None:
        self.rank, self.threads = worker, threads
        self.size: int = worker.comm.size
        self.signals: list[int] = []
        self._in_collective = False
        self._n = 0
        self._counts: list[NDArray[np.int64]] = []
        """Number of particles of each status on each rank, from the first step on."""
        self._way: _WholeFlow | _PartedFlow | None = None

    def call(
        self, function: Callable[..., Value], *arguments: Any, here: tuple[Any, ...] = ()
    ) -> list[Value]:
        """See :meth:`Communicator.call`; the other processes import the function.

        Parameters
        ----------
        function, arguments
            Function and arguments.
        here
            Further arguments for this process alone, which cannot be sent.

        Raises
        ------
        InputError, RunStopped, OSError, RankError
            If a process fails.
        """
        worker, message = self.rank, pickle.dumps((function, arguments))
        self._in_collective = True
        worker.wait_for_all()
        worker.comm.bcast(message)
        answer = worker.execute(function, (*arguments, *here))
        worker.wait_for_all()
        answers: list[Answer] = worker.comm.gather(answer)
        self._in_collective = False
        self.signals += [number for answer in answers for number in answer.signals]
        for answer in answers:
            if answer.error is not None:
                raise answer.error
        return [answer.value for answer in answers]

    @property
    def n_particles(self) -> int:
        """See :class:`Communicator`."""
        return self._n

    @property
    def parts(self) -> tuple[int, ...]:  # type: ignore[override]
        """See :class:`Communicator`."""
        firsts = self.rank.firsts
        return tuple(np.unique(firsts[:-1][np.diff(firsts) > 0]).tolist()) or (0,)

    def place(self, size: int, parts: Callable[..., Iterable[Particles]], n_times: int = 0) -> Particles:
        """See :meth:`Communicator.place`."""
        self._n, self._counts, self._way = size, [], None
        self.call(Worker.allocate, loaded_libs(), firsts_of(size, self.size), n_times)
        for p in parts(communicator.PART):
            # Unused arrays of zeros take no memory of the machine until they are written.
            used = {k: a for k, a in p._asdict().items() if not VARIABLES[k].optional or a.any()}
            self.put(p.number, used)
        return self.rank.particles

    def adopt(self, p: Particles) -> None:
        """No-op: the ranks have their particles."""

    def put(self, numbers: NDArray[np.int64], arrays: Arrays) -> None:
        """See :meth:`Communicator.put`."""
        firsts = self.rank.firsts
        ends = np.searchsorted(numbers, firsts)
        for rank, rows in enumerate(map(slice, ends[:-1], ends[1:])):
            of_rank = {name: array[rows] for name, array in arrays.items()}
            if rows.start == rows.stop:
                continue
            first = int(numbers[rows.start] - firsts[rank])
            if rank == 0:
                self.rank.put(0, first, of_rank)
            else:
                self.call(Worker.put, rank, first, here=(of_rank,))

    def map_by_id(
        self, function: Callable[..., Value], *arguments: Any, of: str | None = None
    ) -> Iterator[Value]:
        """See :meth:`Communicator.map_by_id`."""
        if self.rank.in_order:
            # Nothing has to be sent.
            sizes = enumerate(np.diff(self.rank.firsts).tolist())
            blocks = [(rank, rows) for rank, n in sizes if n or rank == 0 for rows in parts_of(n)]
            for some in (blocks[k : k + BLOCKS] for k in range(0, len(blocks), BLOCKS)):
                results = [
                    iter(answer) for answer in self.call(Worker.map_blocks, function, some, of, *arguments)
                ]
                yield from (next(results[rank]) for rank, _ in some)
            return
        rows = max(1, min(BLOCKS, self.size) * communicator.PART // self.size)
        for first in range(0, max(self._n, 1), rows * self.size):
            answer: list[Value] = self.call(Worker.map_numbers, function, first, rows, of, *arguments)
            yield from answer[: max(1, -(-(self._n - first) // rows))]

    def arrays_here(self) -> Arrays:
        """See :meth:`Communicator.arrays_here`; each rank writes its own."""
        return {}

    def open_flow(self, read: Callable[[], Flow], *source: Any) -> Flow:
        """Return the flow of a case, with a part on each of several nodes if it can be divided.

        Parameters
        ----------
        read
            Returns the flow, read on this process.
        source
            The case; the times of the flow; the names of its fields; and the time between two points where
            particles can change nodes, s.
        """
        nodes = self.rank.windows.nodes
        return read() if nodes == 1 else self._parts_of_flow(nodes, *source) or read()

    def _parts_of_flow(
        self, nodes: int, case: Path, times: FlowTimes, source: FlowSource, step: float
    ) -> Any:
        """Return the flow with a part on each node; None if it cannot be divided."""

        def open_parts(depth: int) -> list[Any]:
            return self.call(Worker.open_part, case, times, source, depth)

        try:
            require_divisible(case, source, nodes)
            flow = distributed_flow(self.call, open_parts, step)
        except IndivisibleMeshError as reason:
            log.info("    Each of %d nodes holds the whole mesh: %s.", nodes, reason)
            self.call(Worker.close_part)
            return None
        for number, summary in enumerate(flow.summaries):
            log.info("    %-24s %d cells, and %d around them", f"node {number}", summary.owned,
                     summary.held - summary.owned)  # fmt: skip
        return flow

    def prepare_steps(self, cloud: Cloud) -> None:
        """Send the particles to the processes that advance them."""
        flow: Any = cloud.flow
        self.call(Worker.prepare, cloud.tracker, cloud.threads)
        self._way = (_PartedFlow if isinstance(flow, DistributedFlow) else _WholeFlow)(self, cloud)
        cloud.publish()
        cloud.particles = empty(0, cloud.particles.n_times)
        self.distribute()
        nodes = self.rank.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.size, self.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self._way.shared_bytes / 1e6)

    def distribute(self) -> None:
        """Send the particles to the processes that advance them."""
        assert self._way is not None
        self.call(Worker.distribute, self._way.ranks_of)
        self._counts = [state.counts for state in self.call(Worker.state)]

    def publish(self, arrays: Any, flow: Flow) -> None:
        """See :meth:`Communicator.publish`."""
        if self._way is not None:
            self._way.publish(arrays, flow)

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """See :meth:`Communicator.advance`."""
        assert self._way is not None
        return self._way.advance(step, steps, bounds, stop)

    def take_steps(
        self, function: Callable[..., ShareState], stop: Callable[[], bool], *steps: Any
    ) -> Outcome:
        """Let all ranks take steps by a function of :class:`Worker`."""
        states = self.call(function, *steps, here=(stop,))
        self._counts = [state.counts for state in states]
        return sum((state.outcome for state in states), Outcome())

    def exchange(self, groups: Iterable[Sequence[int]]) -> None:
        """Balance the shares of the ranks of each group if they differ too much."""
        plans = np.zeros(2 * (self.size,), dtype=np.int64)
        for group in groups:
            plan = plan_exchange([int(self._counts[rank][Status.ACTIVE]) for rank in group])
            if plan is not None:
                plans[np.ix_(group, group)] = plan
        if plans.any():
            self.call(Worker.exchange, plans)

    def counts(self) -> dict[Status, int]:
        """See :meth:`Communicator.counts`."""
        counts_of_ranks = self._counts or [state.counts for state in self.call(Worker.state)]
        total = np.sum(counts_of_ranks, axis=0)
        return {status: int(total[status]) for status in Status}

    def piece_files(self, stem: Path) -> tuple[Path, ...]:
        """See :meth:`Communicator.piece_files`."""
        return (with_ending(stem, ".pvtp"), *(piece_file(stem, rank) for rank in range(self.size)))

    def write_pieces(self, stem: Path, time: float, contents: Contents) -> Callable[[], Path]:
        """See :meth:`Communicator.write_pieces` and :meth:`Worker.write_piece`."""
        written = self.call(Worker.write_piece, stem, time, contents)
        pieces = [piece for piece in written if piece is not None]
        file = with_ending(stem, ".pvtp")

        def list_pieces() -> Path:
            write_pieces(file, pieces[0][1], [path for path, _ in pieces])
            return file

        return list_pieces

    def write_parts(self, file: Path, time: float) -> list[tuple[int, str]]:
        """See :meth:`Communicator.write_parts`."""
        return [part for part in self.call(Worker.write_part, file, time) if part is not None]

    def dismiss(self, status: int) -> None:
        """End all processes with an exit status."""
        worker = self.rank
        if self._in_collective:
            # The others wait for something else, so they can only be stopped.
            worker.comm.Abort(status)
        worker.wait_for_all()
        worker.comm.bcast(status)
        worker.finalise()


class Published(NamedTuple):
    """Data of the flow for all processes."""

    flow: Any
    """Arguments of its kernels."""
    fields: Fields | None
    """Fields that are sampled."""


class _WholeFlow:
    """Steps of ranks whose nodes hold the whole mesh."""

    def __init__(self, ranks: Ranks, cloud: Cloud) -> None:
        self._ranks = ranks
        self.publisher = Publisher(ranks.rank.windows, lambda *call: ranks.call(Worker.window, *call))
        self._placed = b""
        self.ranks_of = [list(range(ranks.size))]
        """Ranks that share particles with each other."""
        flow: Any = cloud.flow
        flow.move(self.publisher.move)
        cloud.make_ready()

    @property
    def shared_bytes(self) -> int:
        """Bytes shared on each computer."""
        return self.publisher.size

    def publish(self, arrays: Any, flow: Flow) -> None:
        """Place the arguments of the flow's kernels and the loaded fields in shared memory, if changed."""
        tree = self.publisher.publish(Published(arrays, loaded_fields(flow)))
        placed = pickle.dumps(tree)
        if placed != self._placed:
            self._ranks.call(Worker.use_flow, tree)
            self._placed = placed

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """Balance the shares if they differ too much, and advance all of them."""
        self._ranks.exchange(self.ranks_of)
        return self._ranks.take_steps(Worker.take_steps, stop, step, steps, bounds)


class _PartedFlow:
    """Steps of ranks whose nodes hold a part of the mesh each, with the particles in it.

    Calls of few steps are followed by the migration of particles that have come to cells of other nodes.
    """

    def __init__(self, ranks: Ranks, cloud: Cloud) -> None:
        flow: Any = cloud.flow
        self._ranks, self._flow = ranks, flow
        self._dt, self._stretch = cloud.dt, cloud.tracker.stretch_steps
        flow.expect(max(cloud.map_ranks(largest_slip, cloud.medium)), self._dt * self._stretch)
        cloud.make_ready()
        numbers = ranks.call(Worker.node_number)
        self.ranks_of = [[r for r, n in enumerate(numbers) if n == k] for k in range(max(numbers) + 1)]
        """Ranks of each node."""
        log.info("    %-24s %d", "steps between exchanges", self._few)

    @property
    def shared_bytes(self) -> int:
        """Bytes shared on all computers."""
        return int(self._flow.shared_bytes)

    def publish(self, arrays: Any, flow: Flow) -> None:
        """No-op: the nodes share the arrays of their parts."""

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """Advance all shares by few steps at a time, and let particles migrate after each call."""
        last, few, outcome = step + steps, self._few, Outcome()
        while step < last and outcome.finished:
            self._ranks.exchange(self.ranks_of)
            # Calls end at multiples, as strides of several tracking steps do.
            end = min(last, (step // few + 1) * few)
            outcome += self._ranks.take_steps(Worker.take_steps_in_part, stop, step, end - step, bounds)
            step = end
        return outcome

    @property
    def _few(self) -> int:
        """Number of steps between two exchanges in the flow that is loaded."""
        flow, stretch = self._flow, self._stretch
        # A body may go through one layer less than there are, so that it ends before the last.
        most = max(1, int((flow.depth - 1) / max(flow.rate * self._dt * stretch, 1e-300)))
        return stretch * min(most, MOST_AT_ONCE)


MOST_AT_ONCE = 1000
"""Most strides between two exchanges of particles."""
