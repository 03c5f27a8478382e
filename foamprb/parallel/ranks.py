"""Runs on several processes, ``mpirun -np N foamprb run -parallel``: they share the particles, not the mesh.

The first process reads the case and runs :mod:`foamprb.run` as ever, with :class:`Ranks` as its executor.
Whatever it decides it tells all processes, itself included, by an order, which each
:class:`~foamprb.parallel.worker.Worker` carries out on its own particles and answers; so no two of them can
disagree on what comes next, and an error or a signal on any of them comes back with its answer. The flow's
arrays lie in memory that the processes of a computer share (:mod:`foamprb.parallel.shared_memory`).

The steps between two orders, the distance to which walls are listed and the compiled code are those of a run
on one process, and particles do not act on each other: results are the same, bit for bit, whoever has which.
"""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Snapshot
from foamprb.cloud.executor import Executor
from foamprb.cloud.rebounds import in_order
from foamprb.cloud.state import Status
from foamprb.cloud.tracker import Outcome, never
from foamprb.parallel.exchange import plan_exchange
from foamprb.parallel.shared_memory import Publisher
from foamprb.parallel.worker import Answer, Share, Worker, piece_file
from foamprb.results.pvd import Series, with_ending
from foamprb.results.vtk import write_pieces
from foamprb.settings.libs import loaded_libs

log = logging.getLogger("foamprb")


class Ranks(Executor):
    """The processes of ``mpirun``, as the first of them sees them.

    Parameters
    ----------
    worker
        This process' own share of the work.
    threads
        Number of threads of each process, as many as its computer has for it.
    """

    def __init__(self, worker: Worker, threads: int) -> None:
        self.worker, self._threads = worker, threads
        self.size: int = worker.comm.size
        self.signals: list[int] = []
        self._amid_order = False
        self.published = Publisher(worker.windows, self.order)
        self._flow = b""
        self._shares: list[Share] = []
        self._gathered = True
        self._stop: Callable[[], bool] = never

    @property
    def threads(self) -> int:
        """Number of threads of each process, unless the user says otherwise."""
        return self._threads

    def order(self, name: str, *arguments: Any) -> list[Any]:
        """Let all processes do something; return what each answers.

        Parameters
        ----------
        name, arguments
            A method of :class:`~foamprb.parallel.worker.Worker`, and its arguments.

        Raises
        ------
        InputError, RunStopped, OSError, RankError
            If one of them could not.
        """
        self._amid_order = True
        self.worker.meet()
        self.worker.comm.bcast((name, arguments))
        answer = self._carry_out(name, arguments)
        self.worker.meet()
        answers: list[Answer] = self.worker.comm.gather(answer)
        self._amid_order = False
        self.signals += [number for answer in answers for number in answer.signals]
        for answer in answers:
            if answer.error is not None:
                raise answer.error
        return [answer.value for answer in answers]

    def _carry_out(self, name: str, arguments: tuple[Any, ...]) -> Answer:
        # The whole cloud is not for sending around, and who asks to stop cannot be sent.
        own: tuple[Any, ...] = (self._cloud.particles,) if name == "distribute" else ()
        own = (self._stop,) if name == "advance" else own
        return self.worker.carry_out(name, (*arguments, *own), ())

    def dismiss(self, status: int) -> None:
        """End all processes with an exit status."""
        if self._amid_order:
            # They wait for something else than this, and so can only be stopped.
            self.worker.comm.Abort(status)
        self.worker.meet()
        self.worker.comm.bcast(("leave", (status,)))
        self.worker.leave()

    def take(self, cloud: Cloud) -> None:
        """Share out the flow and the particles of a cloud."""
        super().take(cloud)
        cloud.flow.move(self.published.move)
        self.order("prepare", loaded_libs(), pickle.dumps(cloud.tracker), cloud.threads)
        self.order("distribute")
        self._shares = self.order("share")
        self._publish(cloud.flow_arrays())
        nodes = self.worker.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.particles.size, self.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self.published.size / 1e6)

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled in this process."""
        return self._cloud.tracker.compiled

    def advance(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:
        """Even out the shares if they have become too different, and let all go on."""
        self._publish(flow)
        plan = plan_exchange([int(share.counts[Status.ACTIVE]) for share in self._shares])
        if plan is not None:
            self.order("exchange", plan)
        self._stop = stop
        self._shares = self.order("advance", self._cloud.step, steps, self._cloud.bounds)
        self._gathered = False
        return sum((share.outcome for share in self._shares), Outcome())

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""
        total = np.sum([share.counts for share in self._shares], axis=0)
        return {status: int(total[status]) for status in Status}

    def longest(self) -> float:
        """Longest semi-axis of all particles that move or will, m, or a little more; 0 without any."""
        return max(share.longest for share in self._shares)

    def gather(self) -> None:
        """Collect what has changed, if anything has."""
        if not self._gathered:
            self.order("gather")
            self._gathered = True

    def take_rebounds(self) -> NDArray[np.float64]:
        """The rebounds of all processes since they were last asked."""
        return in_order(self.order("take_rebounds"))

    def snapshot_files(self, stem: Path) -> tuple[Path, ...]:
        """The file that lists the pieces, and a piece of each process."""
        return (with_ending(stem, ".pvtp"), *(piece_file(stem, rank) for rank in range(self.size)))

    def begin_write(
        self, series: Series, snapshot: Snapshot, names: Mapping[str, Sequence[str]]
    ) -> Callable[[], object]:
        """Let every process write its particles at once; what is left is to list the pieces."""
        self._cloud.flow.load(snapshot.time, snapshot.time)
        self._publish(self._cloud.flow_arrays())
        stem = series.next(snapshot.time)
        pieces = [piece for piece in self.order("write", stem, snapshot.time, names) if piece is not None]
        file = with_ending(stem, ".pvtp")

        def list_pieces() -> None:
            write_pieces(file, pieces[0].arrays, [piece.file for piece in pieces])
            series.add(snapshot.time, file)

        return list_pieces

    def _publish(self, flow: Any) -> None:
        """Let all processes use what the flow's kernels read."""
        placed = pickle.dumps(self.published.publish(flow))
        if placed != self._flow:
            self.order("use_flow", placed)
            self._flow = placed
