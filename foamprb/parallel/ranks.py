"""Runs on several processes, ``mpirun -np N foamprb run -parallel``: they share the particles, not the mesh.

The first process reads the case and executes the run; its stepper is a :class:`RankStepper`. Each decision is
broadcast as an order. Every :class:`~foamprb.parallel.worker.Worker` carries it out on its own particles. All
processes therefore agree on the next operation, and an error or a signal of any process returns with its
answer. The flow's arrays lie in memory that the processes of a computer share
(:mod:`foamprb.parallel.shared_memory`).

The steps between two orders, the distance to which walls are listed and the compiled code are those of a run
on one process, and particles do not act on each other. Results are the same, bit for bit, for any
distribution.
"""

from __future__ import annotations

import logging
import pickle
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np

from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.state import Status
from foamprb.cloud.tracker import Outcome, never
from foamprb.flow.fields import Fields, columns_of
from foamprb.parallel.exchange import plan_exchange
from foamprb.parallel.shared_memory import Publisher
from foamprb.parallel.worker import Answer, Worker, piece_file
from foamprb.results.pvd import with_ending
from foamprb.results.vtk import write_pieces
from foamprb.settings.libs import loaded_libs

log = logging.getLogger("foamprb")


class Ranks:
    """Processes of ``mpirun``, commanded by the first of them.

    Parameters
    ----------
    worker
        Worker of this process.
    threads
        Number of threads of each process.
    """

    def __init__(self, worker: Worker, threads: int) -> None:
        self.worker, self.threads = worker, threads
        self.size: int = worker.comm.size
        self.signals: list[int] = []
        """Signals that any process has received."""
        self._amid_order = False

    def order(self, name: str, *arguments: Any, own: tuple[Any, ...] = ()) -> list[Any]:
        """Broadcast an order; return the answers of all processes.

        Parameters
        ----------
        name, arguments
            A method of :class:`~foamprb.parallel.worker.Worker`, and its arguments.
        own
            Further arguments for this process alone, which cannot be sent.

        Raises
        ------
        InputError, RunStopped, OSError, RankError
            If a process fails.
        """
        self._amid_order = True
        self.worker.wait_for_all()
        self.worker.comm.bcast((name, arguments))
        answer = self.worker.execute(name, (*arguments, *own), ())
        self.worker.wait_for_all()
        answers: list[Answer] = self.worker.comm.gather(answer)
        self._amid_order = False
        self.signals += [number for answer in answers for number in answer.signals]
        for answer in answers:
            if answer.error is not None:
                raise answer.error
        return [answer.value for answer in answers]

    def dismiss(self, status: int) -> None:
        """End all processes with an exit status."""
        if self._amid_order:
            # The others wait for something else, so they can only be stopped.
            self.worker.comm.Abort(status)
        self.worker.wait_for_all()
        self.worker.comm.bcast(("finalise", (status,)))
        self.worker.finalise()


class Published(NamedTuple):
    """Data of the flow for all processes."""

    flow: Any
    """Arguments of its kernels."""
    fields: Fields | None
    """Fields that are sampled, for writing."""


class RankStepper(Stepper):
    """Stepper that advances a cloud with all processes of ``mpirun``.

    Parameters
    ----------
    cloud
        The cloud, whose particles and flow are distributed.
    ranks
        The processes.
    """

    def __init__(self, cloud: Cloud, ranks: Ranks) -> None:
        super().__init__(cloud)
        self.ranks = ranks
        self.published = Publisher(ranks.worker.windows, ranks.order)
        self._placed = b""
        self._gathered = True
        cloud.flow.move(self.published.move)
        ranks.order("prepare", loaded_libs(), pickle.dumps(cloud.tracker), cloud.threads)
        ranks.order("distribute", own=(cloud.particles,))
        self._counts = [share.counts for share in ranks.order("share")]
        self._publish(cloud.flow_arrays())
        nodes = ranks.worker.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.particles.size, ranks.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self.published.size / 1e6)

    def gather(self) -> None:
        """Collect changed particles and rebounds from all processes."""
        if not self._gathered:
            self.ranks.order("gather")
            self.cloud.tracker.rebounds += self.ranks.order("take_rebounds")
            self._gathered = True

    def counts(self) -> dict[Status, int]:
        """Return the number of particles of each status, gathered or not."""
        total = np.sum(self._counts, axis=0)
        return {status: int(total[status]) for status in Status}

    def begin_pieces(
        self, stem: Path, time: float, names: Mapping[str, Sequence[str]], further: Sequence[str] = ()
    ) -> Callable[[], Path]:
        """Write a snapshot, a piece per process.

        Parameters
        ----------
        stem
            File of the snapshot without its ending.
        time
            Time of the gathered state, s.
        names
            For each array of codes, the meanings of the codes 0, 1, ….
        further
            Names of the optional measures to write.

        Returns
        -------
        A function that writes the list of the pieces and returns its file.

        Raises
        ------
        OSError
            If a file cannot be written.
        """
        self.cloud.flow.load(time, time)
        flow: Any = self.cloud.flow
        self._publish(self.cloud.flow_arrays(), flow.fields(time, time) if columns_of(flow) else None)
        written = self.ranks.order("write", stem, time, names, further)
        pieces = [piece for piece in written if piece is not None]
        file = with_ending(stem, ".pvtp")

        def list_pieces() -> Path:
            write_pieces(file, pieces[0][1], [path for path, _ in pieces])
            return file

        return list_pieces

    def piece_files(self, stem: Path) -> tuple[Path, ...]:
        """Return the files that :meth:`begin_pieces` may write."""
        return (with_ending(stem, ".pvtp"), *(piece_file(stem, rank) for rank in range(self.ranks.size)))

    def _carry(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:
        """Balance the shares if they differ too much, and advance all of them."""
        self._publish(flow)
        plan = plan_exchange([int(counts[Status.ACTIVE]) for counts in self._counts])
        if plan is not None:
            self.ranks.order("exchange", plan)
        shares = self.ranks.order("advance", self.cloud.step, steps, self.cloud.bounds, own=(stop,))
        self._counts = [share.counts for share in shares]
        self._gathered = False
        return sum((share.outcome for share in shares), Outcome())

    def _publish(self, flow: Any, fields: Fields | None = None) -> None:
        """Place the arguments of the flow's kernels and the fields in shared memory, where they changed."""
        placed = pickle.dumps(self.published.publish(Published(flow, fields)))
        if placed != self._placed:
            self.ranks.order("use_flow", placed)
            self._placed = placed
