"""Rank of a run on several processes, with its share of the particles."""

from __future__ import annotations

import pickle
import sys
import traceback
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from types import ModuleType
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.communicator import Arrays, Rank, Share
from foamprb.cloud.limits import LoopLimits
from foamprb.cloud.measures import injected
from foamprb.cloud.report import Contents, report
from foamprb.cloud.state import Status, empty
from foamprb.cloud.tracker import Outcome
from foamprb.distributed.exchange import Route, pack, unpack, with_others
from foamprb.distributed.shared_memory import Windows, wait_for_all
from foamprb.errors import InputError, RankError, RunStopped
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

    def __init__(self, MPI: ModuleType) -> None:
        super().__init__()
        self._MPI = MPI
        self.comm = MPI.COMM_WORLD.Dup()
        self.number: int = self.comm.rank
        self.windows = Windows(MPI, self.comm)
        self._firsts = np.zeros(self.comm.size + 1, dtype=np.int64)
        self.in_order = True
        """Whether each rank has the particles that it writes."""
        self._sorted: NDArray[np.int64] | None = None
        """Rows of the particles in the order of their numbers, as long as it is known."""
        self._in_collective = False
        self.signals: Sequence[int] = ()
        """Signals that this process has received; the sequence grows."""

    @property
    def firsts(self) -> NDArray[np.int64]:
        """See :class:`Rank`."""
        return self._firsts

    def execute(
        self, function: Callable[..., Any], arguments: tuple[object, ...], signals: Sequence[int] = ()
    ) -> Answer:
        """Execute a function of this rank and arguments."""
        self.signals = signals
        try:
            return Answer(function(self, *arguments), None, list(signals))
        except Exception as error:
            where = f"rank {self.number}: "
            if self._in_collective:
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

    def window(self, name: str, *arguments: object) -> None:
        """Call a method of the windows of all processes."""
        with self.collective():
            getattr(self.windows, name)(*arguments)

    def allocate(self, libs: Sequence[Path], firsts: NDArray[np.int64], n_times: int) -> None:
        """Make room for the particles that this process writes to checkpoints."""
        load_libs(libs)
        self._firsts, self.sampling = firsts, None
        self._become(Share(empty(int(firsts[self.number + 1] - firsts[self.number]), n_times)))
        self.in_order = True

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

    def distribute(self) -> None:
        """Send the particles to the ranks that advance them.

        Injection models release particles roughly in the order of their numbers. The ranks take them in turn,
        and therefore have similar numbers of active particles.
        """
        with self.collective():
            route = self._route(self.particles.number % self.comm.size)
            arrays, self.share = self.share.arrays(), Share(empty(0))
            # One variable after the other: memory holds one of them twice.
            self._become(Share.of({name: route.send(arrays.pop(name)) for name in [*arrays]}))
            self.in_order = False

    def _become(self, share: Share) -> None:
        self.share, self._sorted = share, None

    def _route(self, rank_of: NDArray[np.int64]) -> Route:
        return Route(self._MPI, self.comm, rank_of)

    def sent(self, to: NDArray[np.int64], array: NDArray[np.generic]) -> NDArray[Any]:
        """Send each row of an array to a rank; return the rows that arrive. All ranks call it together."""
        with self.collective():
            return self._route(to).send(array)

    def state(self) -> ShareState:
        """Return the state of the particles."""
        return ShareState(np.bincount(self.particles.status, minlength=len(Status)))

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
            arrived = unpack(self._route(rank_of).send(pack(self.share, rows)))
            self._become(with_others(self.share, rows, arrived))

    def take_steps(
        self, step: int, steps: int, bounds: LoopLimits, stop: Callable[[], bool] | None = None
    ) -> ShareState:
        """Advance the particles by some steps; ``stop`` or a signal ends them early."""
        outcome = self.advance(step, steps, bounds, stop or (lambda: bool(self.signals)))
        return self.state()._replace(outcome=outcome)

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
        *arguments: object,
    ) -> list[Any]:
        """Apply a function to some blocks of this rank, while particles are in the order of their numbers."""
        shares = (self.share.take(rows) for rank, rows in blocks if rank == self.number)
        return [share.apply(function, of, *arguments) for share in shares]

    def map_numbers(
        self, function: Callable[..., Any], first: int, rows: int, of: str | None, *arguments: object
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
        arrived = self.sent((numbers[rows_sent] - first) // rows, pack(self.share, rows_sent))
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
        share, numbers = self.share, self.particles.number
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
