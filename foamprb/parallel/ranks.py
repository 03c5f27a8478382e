"""Runs on several processes, ``mpirun -np N foamprb run -parallel``: they share the particles, not the mesh.

One process, the root, reads the case and runs :mod:`foamprb.run.job` as ever. Whatever it decides it tells
the others by an order, which each carries out on its own particles and answers; so no two of them can
disagree on what comes next, and an error or a signal on any of them comes back with its answer. The flow's
arrays lie in memory that the processes of a computer share (:mod:`foamprb.parallel.shared`).

The steps between two orders, the distance to which walls are listed and the compiled code are those of a run
on one process, and particles do not act on each other: results are the same, bit for bit, whoever has which.
"""

from __future__ import annotations

import logging
import os
import pickle
import sys
import time
import traceback
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Cloud, Snapshot
from foamprb.cloud.executor import AT_ONCE, longest_semi_axis
from foamprb.cloud.layout import LANES
from foamprb.cloud.measures import injected
from foamprb.cloud.state import VARIABLES, Particles, Status, concatenate, empty
from foamprb.cloud.tracker import Tracker
from foamprb.errors import InputError, RankError, RunStopped
from foamprb.flow.base import Floats, Ints
from foamprb.flow.meshflow import sample_with
from foamprb.output.pvd import Series
from foamprb.output.vtk import PieceArray, write_pieces, write_snapshot
from foamprb.parallel.shared import Publisher, Windows
from foamprb.parallel.team import View
from foamprb.settings.libs import load_libs, loaded_libs

log = logging.getLogger("foamprb")

Rows = NDArray[np.int64]

_UNEVEN = 1.1
"""How much longer than with even shares a step may take before particles change hands."""
_RECORD = np.dtype([("id", "i8"), *((name, v.dtype, v.shape) for name, v in VARIABLES.items())])
_RANK_VARIABLES = ("OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID")
_LONGEST_NAP = 1e-3
"""Seconds between two looks at whether the others have come, when that takes its time."""
_TOGETHER = ("make", "spread", "free", "begin", "exchange", "gather")
"""Orders in the course of which the processes wait for each other: one that fails there takes all down."""


class Piece(NamedTuple):
    """What a process has written of a cloud."""

    file: Path
    arrays: tuple[PieceArray, ...]


class Share(NamedTuple):
    """What a process tells of its particles."""

    counts: NDArray[np.int64]
    """Number of each status."""
    longest: float
    """Longest semi-axis of those that move or will, m."""
    mended: int = 0
    """Number of walks that the tree mended since the last time."""


class Answer(NamedTuple):
    """How a process has carried out an order."""

    value: Any
    error: Exception | None
    signals: list[int]


class _Samples(NamedTuple):
    """A flow as the processes that did not read it know it."""

    kernel: Callable[..., Any]
    arrays: Any

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        return sample_with(self.kernel, self.arrays, points, hosts, t)


class Rank:
    """A process with its share of the particles; what it is ordered to do are its methods by name.

    Parameters
    ----------
    MPI
        The module ``mpi4py.MPI``.
    """

    def __init__(self, MPI: Any) -> None:
        self._MPI = MPI
        self.comm = MPI.COMM_WORLD.Dup()
        self.number: int = self.comm.rank
        self.windows = Windows(MPI, self.comm)
        self._record = MPI.BYTE.Create_contiguous(_RECORD.itemsize).Commit()
        self.make, self.spread, self.free = self.windows.make, self.windows.spread, self.windows.free
        self.particles, self.ids = empty(0), np.empty(0, dtype=np.int64)
        self._whole: Particles | None = None
        self._fresh = np.empty(0, dtype=bool)
        self._flow: Any = None

    def carry_out(self, name: str, arguments: tuple[Any, ...], signals: Sequence[int]) -> Answer:
        """Do what an order says."""
        try:
            return Answer(getattr(self, name)(*arguments), None, list(signals))
        except Exception as error:
            where = f"rank {self.number}: "
            if name in _TOGETHER:
                print(
                    f"--> foamprb Error : {where}{type(error).__name__}: {error}", file=sys.stderr, flush=True
                )
                self.comm.Abort(1)
            if not isinstance(error, InputError | RunStopped | OSError):
                error = RankError(f"{where}{type(error).__name__}: {error}", traceback.format_exc())
            return Answer(None, error, list(signals))

    def prepare(self, libs: Sequence[Path], tracker: bytes, threads: int) -> None:
        """Compile the loop."""
        load_libs(libs)
        self._tracker: Tracker = pickle.loads(tracker)
        self._threads = threads

    def begin(self, whole: Particles | None = None) -> None:
        """Receive a share from the root, which has the whole: every N-th particle of N processes.

        Injection models release their particles in the order of their numbers, more or less, so that each
        process then has as many active ones as any other.
        """
        size = self.comm.size
        if self.number == 0:
            assert whole is not None
            self._whole = whole
            for rank in range(1, size):
                ids = np.arange(rank, whole.size, size)
                self.comm.Send([_pack(whole, ids, ids), len(ids), self._record], rank)
            self.ids = np.arange(0, whole.size, size)
            self.particles = whole.take(self.ids)
        else:
            self.particles, self.ids = _unpack(self._receive(0))
        self._fresh = _live(self.particles)

    def share(self) -> Share:
        """Tell of the particles."""
        counts = np.bincount(self.particles.status, minlength=len(Status))
        return Share(counts, longest_semi_axis(self.particles))

    def look(self, flow: bytes) -> None:
        """Take over what the flow's kernels read."""
        self._flow = self.windows.find(pickle.loads(flow))

    def exchange(self, plan: NDArray[np.int64]) -> None:
        """Give active particles away and receive others: ``plan[i, j]`` from process i to j."""
        sent, received = plan[self.number], plan[:, self.number]
        active = np.flatnonzero(self.particles.status == Status.ACTIVE)
        # Evenly spread over all: what some cost more than others is then spread as well.
        rows = active[np.arange(sent.sum()) * len(active) // max(sent.sum(), 1)]
        gone = np.zeros(self.particles.size, dtype=bool)
        gone[rows] = True
        outgoing = _pack(self.particles, rows, self.ids[rows])
        incoming = np.empty(received.sum(), dtype=_RECORD)
        self.comm.Alltoallv([outgoing, (sent, _starts(sent)), self._record],
                            [incoming, (received, _starts(received)), self._record])  # fmt: skip
        particles, ids = _unpack(incoming)
        self.particles = concatenate([self.particles.take(~gone), particles])
        self.ids = np.concatenate([self.ids[~gone], ids])
        self._fresh = np.concatenate([self._fresh[~gone], np.ones(len(ids), dtype=bool)])

    def advance(self, step: int, steps: int) -> Share:
        """Carry the particles through some steps."""
        mended = self._tracker.advance(self._flow, self.particles, step, steps, self._threads)
        return self.share()._replace(mended=mended)

    def gather(self) -> None:
        """Send what may have changed since the last time to the root."""
        rows = np.flatnonzero(self._fresh)
        changed = _pack(self.particles, rows, self.ids[rows])
        if self._whole is None:
            self.comm.Send([changed, len(rows), self._record], 0)
        else:
            for rank in range(self.comm.size):
                records = self._receive(rank) if rank else changed
                for name, array in self._whole._asdict().items():
                    array[records["id"]] = records[name]
        self._fresh = _live(self.particles)

    def write(self, folder: Path, at: float, view: View) -> Piece | None:
        """Write the particles; nothing if there are none, but for the root."""
        flow = _Samples(self._tracker.kernels["sample"], self._flow)
        if self.number and not len(injected(self.particles)):
            return None
        file = folder / f"{self.number}.vtp"
        return Piece(file, write_snapshot(file, view.parts(at, self.particles, flow, self.ids)))

    def serve(self, signals: Sequence[int]) -> int:
        """Carry out the root's orders until it sends everybody home; return the exit status.

        Parameters
        ----------
        signals
            Those that this process has received, which grow.
        """
        while True:
            self.meet()
            name, arguments = self.comm.bcast(None)
            if name == "leave":
                self.leave()
                return int(arguments[0])
            answer = self.carry_out(name, arguments, signals)
            self.meet()
            self.comm.gather(answer)

    def meet(self) -> None:
        """Wait for all processes without keeping a processor busy, as MPI itself would."""
        request, nap = self.comm.Ibarrier(), 1e-6
        while not request.Test():
            time.sleep(nap)
            nap = min(2.0 * nap, _LONGEST_NAP)

    def leave(self) -> None:
        """Give back what was shared, and end MPI."""
        for key in sorted(self.windows.arrays):
            self.windows.free(key)
        self._record.Free()
        sys.stdout.flush()
        sys.stderr.flush()
        self._MPI.Finalize()

    def _receive(self, source: int) -> NDArray[Any]:
        status = self._MPI.Status()
        self.comm.Probe(source, status=status)
        records = np.empty(status.Get_count(self._record), dtype=_RECORD)
        self.comm.Recv([records, len(records), self._record], source)
        return records


class Root:
    """The team of a parallel run, and the crew of its cloud.

    Parameters
    ----------
    rank
        This process, which is the first.
    threads
        Number of threads of each process, as many as its computer has for it.
    """

    at_once = AT_ONCE

    def __init__(self, rank: Rank, threads: int) -> None:
        self.rank, self.threads = rank, threads
        self.size: int = rank.comm.size
        self.signals: list[int] = []
        self._amid = False
        self._published = Publisher(rank.windows, self.order)
        self._seen = b""
        self._shares: list[Share] = []
        self._stale = False

    def order(self, name: str, *arguments: Any) -> list[Any]:
        """Let all processes do something; return what each answers.

        Raises
        ------
        InputError, RunStopped, OSError, RankError
            If one of them could not.
        """
        self._amid = True
        self.rank.meet()
        self.rank.comm.bcast((name, arguments))
        answer = self._do(name, arguments)
        self.rank.meet()
        answers: list[Answer] = self.rank.comm.gather(answer)
        self._amid = False
        self.signals += [number for answer in answers for number in answer.signals]
        for answer in answers:
            if answer.error is not None:
                raise answer.error
        return [answer.value for answer in answers]

    def _do(self, name: str, arguments: tuple[Any, ...]) -> Answer:
        # The whole cloud is not for sending around.
        extra = (self._cloud.particles,) if name == "begin" else ()
        return self.rank.carry_out(name, (*arguments, *extra), ())

    def dismiss(self, status: int) -> None:
        """End all processes with an exit status."""
        if self._amid:
            # They wait for something else than this, and so can only be stopped.
            self.rank.comm.Abort(status)
        self.rank.meet()
        self.rank.comm.bcast(("leave", (status,)))
        self.rank.leave()

    # As a team

    def take(self, cloud: Cloud) -> None:
        """Share out the flow and the particles."""
        self._cloud = cloud
        cloud.flow.move(self._published.move)
        self.order("prepare", loaded_libs(), pickle.dumps(cloud.tracker), cloud.threads)
        self.order("begin")
        self._shares = self.order("share")
        cloud.hand_over(self)
        self._show(cloud.flow_arrays())
        nodes = self.rank.windows.nodes
        log.info("\nSharing out %d particles among %d processes of %d thread%s on %d computer%s",
                 cloud.particles.size, self.size, cloud.threads, "s"[: cloud.threads > 1], nodes,
                 "s"[: nodes > 1])  # fmt: skip
        log.info("    %-24s %.1f", "shared memory [MB]", self._published.size / 1e6)

    def begin_write(self, series: Series, cloud: Snapshot, view: View) -> Callable[[], object]:
        """Let every process write its particles at once; what is left is to list the pieces."""
        self._cloud.flow.load(cloud.time, cloud.time)
        self._show(self._cloud.flow_arrays())
        stem = series.next(cloud.time)
        pieces = [p for p in self.order("write", stem, cloud.time, view) if p is not None]
        file = stem.with_suffix(".pvtp")

        def list_pieces() -> None:
            write_pieces(file, pieces[0].arrays, [piece.file for piece in pieces])
            series.add(cloud.time, file)

        return list_pieces

    # As a crew

    @property
    def compiled(self) -> bool:
        """Whether the loop is compiled here."""
        return self._cloud.tracker.compiled

    def begin(self, prepare: Callable[[], tuple[Any, int]]) -> None:
        """Wait until told to advance."""

    def advance(self, flow: Any, steps: int) -> int:
        """Even out the shares if they have become too different, and let all go on."""
        self._show(flow)
        plan = plan_exchange([int(share.counts[Status.ACTIVE]) for share in self._shares])
        if plan is not None:
            self.order("exchange", plan)
        self._shares = self.order("advance", self._cloud.step, steps)
        self._stale = True
        return sum(share.mended for share in self._shares)

    def counts(self) -> dict[Status, int]:
        """Number of particles of each status."""
        total = np.sum([share.counts for share in self._shares], axis=0)
        return {status: int(total[status]) for status in Status}

    def longest(self) -> float:
        """Longest semi-axis of all particles that move or will, m."""
        return max(share.longest for share in self._shares)

    def gather(self) -> None:
        """Collect what has changed, if anything has."""
        if self._stale:
            self.order("gather")
            self._stale = False

    def _show(self, flow: Any) -> None:
        seen = pickle.dumps(self._published.publish(flow))
        if seen != self._seen:
            self.order("look", seen)
            self._seen = seen


def plan_exchange(active: Sequence[int]) -> NDArray[np.int64] | None:
    """Who gives how many active particles to whom, (n, n), so that all have as many; None if it does not pay.

    The processes wait for the one with most blocks of particles, a block taking its time however few are in
    it.

    Parameters
    ----------
    active
        Number of active particles of each of n processes.
    """
    n, total = len(active), sum(active)
    even = np.diff(np.arange(n + 1) * total // n)
    if -(-max(active) // LANES) <= _UNEVEN * -(-int(even.max()) // LANES):
        return None
    plan = np.zeros((n, n), dtype=np.int64)
    surplus = np.asarray(active) - even
    givers, takers = np.flatnonzero(surplus > 0), np.flatnonzero(surplus < 0)
    # Both sides laid out in rows of particles: what lies side by side changes hands.
    given = np.repeat(givers, surplus[givers])
    taken = np.repeat(takers, -surplus[takers])
    np.add.at(plan, (given, taken), 1)
    return plan


def connect() -> Root | Rank | None:
    """Find the other processes that ``mpirun`` has started.

    Returns
    -------
    The team if this is the first of them, which leads the run; one of the others, which is to
    :meth:`Rank.serve`; None if there are no others.

    Raises
    ------
    InputError
        If mpi4py or MPI is missing.
    """
    try:
        from mpi4py import MPI
    except ImportError as error:
        raise InputError(
            f"-parallel needs mpi4py ({error}): pip install 'foamprb[mpi]', beside OpenMPI or MPICH."
        ) from error
    except RuntimeError as error:
        raise InputError(f"-parallel: mpi4py finds no MPI ({error}): install OpenMPI or MPICH.") from error
    if MPI.COMM_WORLD.size == 1:
        return None
    rank = Rank(MPI)
    own = os.sched_getaffinity(0)
    shared = set().union(*rank.windows.node.allgather(own))
    threads = min(len(own), max(1, len(shared) // rank.windows.node.size))
    threads = rank.comm.allreduce(threads, MPI.MIN)
    return Root(rank, threads) if rank.number == 0 else rank


def is_first() -> bool:
    """Whether this process is the first that ``mpirun`` has started, as far as can be told without MPI."""
    return all(os.environ.get(name, "0") == "0" for name in _RANK_VARIABLES)


def _live(p: Particles) -> NDArray[np.bool_]:
    return np.asarray((p.status == Status.PENDING) | (p.status == Status.ACTIVE))


def _starts(counts: NDArray[np.int64]) -> NDArray[np.int64]:
    return np.cumsum(counts) - counts


def _pack(p: Particles, rows: Rows, ids: Rows) -> NDArray[Any]:
    """Rows of particles, one record each, with their numbers in the whole cloud."""
    records = np.empty(len(rows), dtype=_RECORD)
    records["id"] = ids
    for name, array in p._asdict().items():
        records[name] = array[rows]
    return records


def _unpack(records: NDArray[Any]) -> tuple[Particles, Rows]:
    """The particles of records, and their numbers."""
    return Particles(*(records[name].copy() for name in Particles._fields)), records["id"].copy()
