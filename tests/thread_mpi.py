"""Processes of MPI as threads of this one, by which :mod:`foamprb.distributed` exchanges particles."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

import numpy as np


class Rows:
    """Type of rows of some bytes."""

    def __init__(self, size: int = 1) -> None:
        self.size = size

    def Create_contiguous(self, n: int) -> Rows:
        return Rows(n)

    def Commit(self) -> Rows:
        return self

    def Free(self) -> None:
        pass


class Mpi:
    """The module ``mpi4py.MPI``, as one process sees it."""

    BYTE, MAX, LOR, UNDEFINED, COMM_TYPE_SHARED = Rows(), max, any, -1, 0

    def __init__(self, comm: Comm) -> None:
        self.COMM_WORLD = comm


class Comm:
    """One of several processes, all on one computer."""

    def __init__(self, rank: int, others: list[Any], barrier: threading.Barrier) -> None:
        self.rank, self.size = rank, len(others)
        self._slots, self._barrier = others, barrier
        self.letters: list[Any] = []
        self.team: list[Comm] = []

    def _of_all(self, value: Any) -> list[Any]:
        self._slots[self.rank] = value
        self._barrier.wait()
        values = list(self._slots)
        self._barrier.wait()
        return values

    def Dup(self) -> Comm:
        return self

    def Split_type(self, kind: int) -> Comm:  # noqa: ARG002
        return self

    def Split(self, colour: int) -> Comm:  # noqa: ARG002
        return self

    def allreduce(self, value: Any, op: Callable[[list[Any]], Any] = sum) -> Any:
        return op(self._of_all(value))

    def Alltoall(self, sent: np.ndarray, received: np.ndarray) -> None:
        received[:] = [counts[self.rank] for counts in self._of_all(sent)]

    def Alltoallv(self, outgoing: list[Any], incoming: list[Any]) -> None:
        array, (received, places), row = incoming
        target = array.reshape(-1).view(np.uint8)
        for rank, (array, (sent, starts), kind) in enumerate(self._of_all(outgoing)):
            start, end = kind.size * starts[self.rank], kind.size * (starts[self.rank] + sent[self.rank])
            place = row.size * places[rank]
            assert kind.size * sent[self.rank] == row.size * received[rank]
            target[place : place + end - start] = array.reshape(-1).view(np.uint8)[start:end]
        self._barrier.wait()

    def send(self, letter: Any, rank: int) -> None:
        self.team[rank].letters.append(letter)

    def recv(self, source: int) -> Any:  # noqa: ARG002
        while not self.letters:
            threading.Event().wait(1e-3)
        return self.letters.pop()


def processes(n: int) -> list[Comm]:
    """Return n processes that exchange data."""
    slots, barrier = [None] * n, threading.Barrier(n, timeout=20.0)
    team = [Comm(rank, slots, barrier) for rank in range(n)]
    for comm in team:
        comm.team = team
    return team


def together(works: list[Callable[[], Any]]) -> list[Any]:
    """Return the results of functions that run at the same time; raise the error of one."""
    results, errors = [None] * len(works), []

    def run(rank: int) -> None:
        try:
            results[rank] = works[rank]()
        except Exception as error:
            errors.append(error)

    threads = [threading.Thread(target=run, args=(rank,)) for rank in range(len(works))]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise next((e for e in errors if not isinstance(e, threading.BrokenBarrierError)), errors[0])
    return results
