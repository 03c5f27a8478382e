"""Communicator of a run on several processes, ``mpirun -np N foamprb run -parallel``.

The processes share the particles. The first process reads the case and executes the run. Each of its
decisions is broadcast as a function, which every :class:`~foamprb.distributed.worker.Worker` applies to its
own particles. All processes therefore agree on the next operation, and an error or a signal of any process
returns with its answer. Each computer (node) holds one copy of the flow's arrays, in memory that its
processes share (:mod:`foamprb.distributed.shared_memory`).

The compiled code and the distance to which walls are listed do not depend on the number of processes, and
particles do not act on each other. Results are the same, bit for bit, for any distribution.
"""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable, Iterable, Iterator
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud import communicator
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.communicator import Arrays, Communicator, Value, parts_of
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.report import Contents
from foamprb.cloud.state import VARIABLES, Particles, Status, empty
from foamprb.cloud.tracker import Outcome
from foamprb.distributed.exchange import firsts_of, plan_exchange
from foamprb.distributed.shared_memory import Publisher
from foamprb.distributed.worker import Answer, Worker, piece_file
from foamprb.flow.base import Flow
from foamprb.flow.fields import Fields
from foamprb.flow.loaded import loaded_fields
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
        self._publisher: Publisher | None = None
        self._published = b""

    def call(
        self, function: Callable[..., Value], *arguments: object, here: tuple[Any, ...] = ()
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
        self._n, self._counts, self._publisher, self._published = size, [], None, b""
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
        self, function: Callable[..., Value], *arguments: object, of: str | None = None
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

    def prepare_steps(self, cloud: Cloud) -> None:
        """Send the particles to the processes that advance them."""
        flow: Any = cloud.flow
        self.call(Worker.prepare, cloud.tracker, cloud.threads)
        self._publisher = Publisher(self.rank.windows, partial(self.call, Worker.window))
        flow.move(self._publisher.move)
        cloud.make_ready()
        cloud.publish()
        cloud.particles = empty(0, cloud.particles.n_times)
        self.call(Worker.distribute)
        self._counts = [state.counts for state in self.call(Worker.state)]
        nodes = self.rank.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.size, self.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self._publisher.size / 1e6)

    def publish(self, arrays: Any, flow: Flow) -> None:
        """See :meth:`Communicator.publish`; the large arrays are placed in shared memory, if changed."""
        if self._publisher is None:
            return
        tree = self._publisher.publish(Published(arrays, loaded_fields(flow)))
        published = pickle.dumps(tree)
        if published != self._published:
            self.call(Worker.use_flow, tree)
            self._published = published

    def advance(self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool]) -> Outcome:
        """See :meth:`Communicator.advance`; the shares are balanced before, if they differ too much."""
        plan = plan_exchange([int(counts[Status.ACTIVE]) for counts in self._counts])
        if plan is not None:
            self.call(Worker.exchange, plan)
        states = self.call(Worker.take_steps, step, steps, bounds, here=(stop,))
        self._counts = [state.counts for state in states]
        return sum((state.outcome for state in states), Outcome())

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
