"""Start-up of the processes of ``mpirun``, and the signals that end them."""

from __future__ import annotations

import logging
import os
import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType

from foamprb.distributed.ranks import Ranks
from foamprb.distributed.worker import Worker
from foamprb.errors import InputError
from foamprb.memory import spread_over

_SIGNALS = (signal.SIGINT, signal.SIGTERM, signal.SIGHUP, signal.SIGXCPU)
_RANK_VARIABLES = ("OMPI_COMM_WORLD_RANK", "PMIX_RANK", "PMI_RANK", "SLURM_PROCID")


def run_together(lead: Callable[[Ranks | None], int]) -> int:
    """Call a function with the processes of ``mpirun``, if there are several.

    Parameters
    ----------
    lead
        Called on the first process with all processes, None if there is only one; it returns
        an exit status. The others meanwhile execute its calls.
    """
    try:
        role = connect()
    except InputError:
        if _is_first():
            raise
        return 1
    if role is None:
        return lead(None)
    if isinstance(role, Worker):
        # Only the first process logs.
        logging.getLogger("foamprb").handlers[:] = [logging.NullHandler()]
        with caught_signals() as signals:
            return role.serve(signals)
    status = 1
    try:
        status = lead(role)
    finally:
        role.dismiss(status)
    return status


def connect() -> Ranks | Worker | None:
    """Connect to the other processes that ``mpirun`` has started.

    Returns
    -------
    All processes if this is the first; one of the others, which is to :meth:`Worker.serve`;
    None if there are no others.
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
    worker = Worker(MPI)
    processors = os.sched_getaffinity(0)
    shared = set().union(*worker.windows.node.allgather(processors))
    threads = min(len(processors), max(1, len(shared) // worker.windows.node.size))
    threads = worker.comm.allreduce(threads, MPI.MIN)
    spread_over(worker.windows.nodes)
    return Ranks(worker, threads) if worker.number == 0 else worker


@contextmanager
def caught_signals() -> Iterator[list[int]]:
    """Collect the first of the signals that end a process in a list; a second one ends the process.

    These are Ctrl-C, SIGTERM, SIGHUP when a terminal closes, and SIGXCPU at a limit of processor time.

    Python catches signals in the main thread only.
    """
    caught: list[int] = []
    if threading.current_thread() is not threading.main_thread():
        yield caught
        return
    before = {number: signal.getsignal(number) for number in _SIGNALS}
    # nohup ignores SIGHUP.
    before = {number: handler for number, handler in before.items() if handler is not signal.SIG_IGN}

    def restore() -> None:
        for number, handler in before.items():
            signal.signal(number, handler)

    def catch(number: int, _: FrameType | None) -> None:
        caught.append(number)
        restore()

    for number in before:
        signal.signal(number, catch)
    try:
        yield caught
    finally:
        restore()


def _is_first() -> bool:
    """Return whether this process seems the first of ``mpirun``, judged without MPI."""
    return all(os.environ.get(name, "0") == "0" for name in _RANK_VARIABLES)
