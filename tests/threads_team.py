"""Nodes of a parallel run, as threads of one process."""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Any

from foamprb.distributed.fragment import Team


class ThreadTeam(Team):
    """One of several nodes."""

    def __init__(self, rank: int, size: int, desk: list[Any], barrier: threading.Barrier) -> None:
        self.rank, self.size, self._desk, self._barrier = rank, size, desk, barrier

    def swap(self, parcels):
        self._desk[self.rank] = list(parcels)
        self._barrier.wait()
        found = [self._desk[k][self.rank] for k in range(self.size)]
        self._barrier.wait()
        return found


def together(size: int, work: Callable[[ThreadTeam], Any]) -> list[Any]:
    """Return the results of all nodes; raise the first error."""
    desk, barrier, results, errors = [None] * size, threading.Barrier(size, timeout=100), [None] * size, []

    def run(rank: int) -> None:
        try:
            results[rank] = work(ThreadTeam(rank, size, desk, barrier))
        except threading.BrokenBarrierError:
            pass
        except BaseException as error:
            errors.append(error)
            barrier.abort()

    threads = [threading.Thread(target=run, args=(rank,)) for rank in range(size)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    if errors:
        raise errors[0]
    assert not barrier.broken, "a node waits for another, which does something else"
    return results
