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
import time as clock
from collections.abc import Callable, Iterable, Mapping, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Stepper, Value
from foamprb.cloud.contact import in_order
from foamprb.cloud.measures import largest_slip
from foamprb.cloud.state import Particles, Status, empty
from foamprb.cloud.tracker import Outcome, never
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.flow.fields import Fields
from foamprb.flow.loaded import loaded_fields
from foamprb.flow.mesh.fragment import IndivisibleMeshError
from foamprb.flow.read.source import FlowSource, FlowTimes
from foamprb.parallel.distributed import DistributedFlow, distributed_flow, require_divisible
from foamprb.parallel.exchange import idle_share, plan_exchange
from foamprb.parallel.homes import RankHomes
from foamprb.parallel.sampling import Sampling
from foamprb.parallel.shared_memory import Publisher
from foamprb.parallel.worker import Answer, Worker, piece_file
from foamprb.results.pvd import with_ending
from foamprb.results.vtk import write_pieces

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

    def open_flow(
        self, case: Path, times: FlowTimes, source: FlowSource, step: float, followed: bool = False
    ) -> DistributedFlow | None:
        """Return the flow of a decomposed case with a part on each of several nodes.

        Parameters
        ----------
        case, times, source
            The case; the times of the flow; the names of its fields.
        step
            Time between two points where particles can change nodes, s.
        followed
            Whether the solver of the flow is running.

        Returns
        -------
        The flow; None if each node must hold the whole, or there is one node.
        """
        nodes = self.worker.windows.nodes
        if nodes == 1:
            return None

        def open_parts(depth: int, load: NDArray[np.int64] | None) -> list[Any]:
            return self.order("open_part", case, source.region, times, source, depth, load, step)

        started = clock.perf_counter()
        try:
            require_divisible(case, source, nodes, followed)
            flow = distributed_flow(self.order, open_parts, step)
        except IndivisibleMeshError as reason:
            log.info("    Each of %d nodes holds the whole mesh: %s.", nodes, reason)
            self.order("close_part")
            return None
        flow.seconds = clock.perf_counter() - started
        for number, summary in enumerate(flow.summaries):
            log.info("    %-24s %d cells, and %d around them", f"node {number}", summary.own,
                     summary.held - summary.own)  # fmt: skip
        return flow

    def signal(self) -> int:
        """Return a signal that any process has received, while all wait for something; 0 for none."""
        self.order("wait_for_all")
        return next(iter(self.signals), 0)

    def homes_of(self, size: int, parts: Iterable[Particles]) -> RankHomes:
        """Send particles to their homes; see :class:`foamprb.parallel.homes.RankHomes`."""
        return RankHomes(self.worker, self.order, size, parts)

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
    """Fields that are sampled."""


class RankStepper(Stepper):
    """Stepper that advances a cloud with all processes of ``mpirun``.

    Parameters
    ----------
    cloud
        The cloud, whose particles the processes hold, and whose flow is distributed.
    ranks
        The processes.
    functions
        Cloud functions.
    """

    _order = "advance"

    def __init__(self, cloud: Cloud, ranks: Ranks, functions: CloudFunctions) -> None:
        super().__init__(cloud)
        self.ranks, self._functions = ranks, functions
        self.published = Publisher(ranks.worker.windows, ranks.order)
        self._placed = b""
        self._gathered = True
        cloud.flow.move(self.published.move)
        models = pickle.dumps((cloud.tracker, Sampling.of(functions, cloud.medium)))
        ranks.order("prepare", models, cloud.threads)
        self._ranks_of = [list(range(ranks.size))]
        """Processes of each node."""
        self._begin()
        cloud.particles = empty(0)
        self._set_out()
        self._counts = [share.counts for share in ranks.order("share")]
        nodes = ranks.worker.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.size, ranks.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self._shared_bytes / 1e6)

    @property
    def _shared_bytes(self) -> int:
        """Bytes shared on each computer."""
        return self.published.size

    def _begin(self) -> None:
        """Prepare the flow."""
        self._publish(self.cloud.make_ready())

    def _set_out(self) -> None:
        """Send the particles to the processes."""
        self.ranks.order("set_out", self._ranks_of)

    def gather(self) -> None:
        """Collect rebounds, and events from all processes."""
        if self._gathered:
            return
        self._record_rebounds()
        self._functions.add_events(self.ranks.order("take_events"))
        self._gathered = True

    def sample_away(self, names: Sequence[str]) -> list[str]:
        """Let the cloud functions sample that can do so on all processes; return the others."""
        self._record_rebounds()
        if names:
            self._publish_present()
        travelling = self._functions.travelling
        away = [name for name in names if name in travelling]
        if away:
            self.ranks.order("sample", away, self.cloud.time)
            summing = [name for name in away if name in self._functions.summing]
            if summing:
                self.ranks.order("add_up", summing)
            self._gathered = False
        return [name for name in names if name not in travelling]

    def _record_rebounds(self) -> None:
        """Let the cloud functions record the rebounds of all processes since the last call."""
        functions = self._functions
        if not self.cloud.models.rebounds or not functions.functions:
            return
        rows = in_order(self.ranks.order("take_rebounds"))
        if len(rows):
            self._publish_present()
            self.ranks.order("record", rows, self.cloud.time)
            functions.record_rebounds(
                rows, [name for name in functions.functions if name not in functions.travelling]
            )

    def each(self, function: Callable[..., Value], *arguments: Any) -> list[Value]:
        """See :meth:`Stepper.each`."""
        self._publish_present()
        return self.ranks.order("each", function, self.cloud.time, *arguments)

    def counts(self) -> dict[Status, int]:
        """Return the number of particles of each status."""
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
            Time of the state, s.
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
        self._publish_present()
        written = self.ranks.order("write", stem, time, names, further)
        pieces = [piece for piece in written if piece is not None]
        file = with_ending(stem, ".pvtp")

        def list_pieces() -> Path:
            write_pieces(file, pieces[0][1], [path for path, _ in pieces])
            return file

        return list_pieces

    def _publish_present(self) -> None:
        """Make the flow and the sampled fields at the present time known to all processes."""
        self.cloud.flow.load(self.cloud.time, self.cloud.time)
        self._publish(self.cloud.flow_arrays())

    def piece_files(self, stem: Path) -> tuple[Path, ...]:
        """Return the files that :meth:`begin_pieces` may write."""
        return (with_ending(stem, ".pvtp"), *(piece_file(stem, rank) for rank in range(self.ranks.size)))

    def _carry(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:
        """Balance the shares if they differ too much, and advance all of them."""
        self._publish(flow)
        plan = plan_exchange([int(counts[Status.ACTIVE]) for counts in self._counts])
        if plan is not None:
            self.ranks.order("exchange", plan)
        return self._advance(self.cloud.step, steps, stop)

    def _advance(self, step: int, steps: int, stop: Callable[[], bool]) -> Outcome:
        """Let all processes advance their particles."""
        shares = self.ranks.order(self._order, step, steps, self.cloud.bounds, own=(stop,))
        self._counts = [share.counts for share in shares]
        self._gathered = False
        return sum((share.outcome for share in shares), Outcome())

    def _publish(self, flow: Any) -> None:
        """Place the arguments of the flow's kernels and the loaded fields in shared memory, if changed."""
        placed = pickle.dumps(self.published.publish(Published(flow, loaded_fields(self.cloud.flow))))
        if placed != self._placed:
            self.ranks.order("use_flow", placed)
            self._placed = placed


class PartStepper(RankStepper):
    """Stepper whose processes hold particles in their node's part of the mesh.

    Calls of few steps are followed by the hand-over of particles that have come to cells of other nodes.
    """

    _order = "advance_part"

    def _begin(self) -> None:
        cloud, ranks = self.cloud, self.ranks
        self._flow.expect(max(cloud.at_homes(largest_slip, cloud.medium)))
        cloud.make_ready()
        numbers = ranks.order("node_number")
        self._ranks_of = [[r for r, n in enumerate(numbers) if n == k] for k in range(max(numbers) + 1)]
        self._seconds, self._lost = 0.0, 0.0
        log.info("    %-24s %d", "steps between exchanges", self._few)

    def regroup(self) -> None:
        """Let the nodes take other processor folders, if the most loaded one then has fewer particles.

        They do when as much time has been lost as reading the parts takes. This is at most twice the time
        that the best choice in hindsight would take.
        """
        flow = self._flow
        load = sum(self.ranks.order("load_of_folders", len(flow.folders)))
        before, after = (int(flow.loads(load, again).max()) for again in (False, True))
        self._lost += self._seconds * idle_share(before, after)
        self._seconds = 0.0
        if not self._pays():
            return
        log.info("Nodes take processor folders again: one has at most %d particles, instead of %d",
                 after, before)  # fmt: skip
        started, self._lost = clock.perf_counter(), 0.0
        self.ranks.order("break_up")
        flow.regroup(load)
        self._set_out()
        self._counts = [share.counts for share in self.ranks.order("share")]
        flow.seconds = clock.perf_counter() - started

    def _pays(self) -> bool:
        return self._lost > self._flow.seconds

    @property
    def _few(self) -> int:
        """Number of steps between two exchanges in the flow that is loaded."""
        flow, whole = self._flow, self.cloud.tracker.whole
        # A body may go through one layer less than there are, so that it ends before the last.
        most = max(1, int((flow.depth - 1) / max(flow.rate * self.cloud.dt * whole, 1e-300)))
        return whole * min(most, MOST_AT_ONCE)

    @property
    def _flow(self) -> DistributedFlow:
        flow: Any = self.cloud.flow
        assert isinstance(flow, DistributedFlow)
        return flow

    @property
    def _shared_bytes(self) -> int:
        return self._flow.shared_bytes

    def _publish(self, flow: Any) -> None:
        """No-op: the flow has let the nodes share their arrays."""

    def _carry(self, flow: Any, steps: int, stop: Callable[[], bool] = never) -> Outcome:  # noqa: ARG002
        """Advance all shares by few steps at a time, and hand particles over after each call."""
        step, last, few, outcome = self.cloud.step, self.cloud.step + steps, self._few, Outcome()
        started = clock.perf_counter()
        while step < last and outcome.finished:
            self._balance()
            # Calls end at multiples, as strides of several tracking steps do.
            end = min(last, (step // few + 1) * few)
            outcome += self._advance(step, end - step, stop)
            step = end
        self._seconds += clock.perf_counter() - started
        return outcome

    def _balance(self) -> None:
        """Balance the shares of the processes of each node."""
        whole = np.zeros(2 * (self.ranks.size,), dtype=np.int64)
        for own in self._ranks_of:
            plan = plan_exchange([int(self._counts[rank][Status.ACTIVE]) for rank in own])
            if plan is not None:
                whole[np.ix_(own, own)] = plan
        if whole.any():
            self.ranks.order("exchange", whole)


def stepper_of(cloud: Cloud, ranks: Ranks, functions: CloudFunctions) -> RankStepper:
    """Return the stepper for a cloud whose flow the nodes share as parts or as a whole.

    Parameters
    ----------
    cloud, ranks, functions
        See :class:`RankStepper`.
    """
    flow: Any = cloud.flow
    return (PartStepper if isinstance(flow, DistributedFlow) else RankStepper)(cloud, ranks, functions)


MOST_AT_ONCE = 1000
"""Most strides between two exchanges of particles."""
