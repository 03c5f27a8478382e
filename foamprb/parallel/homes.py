"""Homes of particles: processes that write particles of consecutive numbers to checkpoints."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud import cloud
from foamprb.cloud.cloud import Value, parts_of, same
from foamprb.cloud.state import VARIABLES, Particles, concatenate
from foamprb.parallel.exchange import homes_of
from foamprb.parallel.worker import Worker
from foamprb.settings.libs import loaded_libs

PARTS = 4
"""Most parts of a cloud of which the first process takes at once what a function finds."""


class RankHomes:
    """Homes of the particles of a cloud; see :class:`foamprb.cloud.cloud.Homes`.

    Parameters
    ----------
    worker
        Worker of this process, the first.
    order
        Lets all processes call a method of their worker; see :meth:`foamprb.parallel.ranks.Ranks.order`.
    size
        Number of particles.
    parts
        The particles at the start, part by part in the order of their numbers.
    """

    def __init__(
        self, worker: Worker, order: Callable[..., list[Any]], size: int, parts: Iterable[Particles]
    ) -> None:
        self.size, self._worker, self._order = size, worker, order
        self._bounds = homes_of(size, worker.comm.size)
        order("settle", loaded_libs(), self._bounds)
        for p in parts:
            # Unused arrays of zeros take no memory of the machine until they are written.
            used = {k: a for k, a in p._asdict().items() if not VARIABLES[k].optional or a.any()}
            self._put(p.number, used)

    @property
    def firsts(self) -> tuple[int, ...]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return tuple(np.unique(self._bounds[:-1][np.diff(self._bounds) > 0]).tolist()) or (0,)

    @property
    def particles(self) -> Particles:
        """Particles that the first process holds."""
        return self._worker.particles

    def at_homes(self, function: Callable[..., Value], *arguments: Any, of: str | None = None) -> list[Value]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return self._order("of_own", function, of, *arguments)

    def of(self, numbers: NDArray[np.int64]) -> Particles:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        found = concatenate(self._order("chosen", numbers))
        return found.take(np.argsort(found.number))

    def observe(
        self, numbers: NDArray[np.int64], function: Callable[..., Value], time: float, *arguments: Any
    ) -> list[Value]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return self._order("observe", numbers, function, time, *arguments)

    def in_order(
        self, function: Callable[..., Value], *arguments: Any, of: str | None = None
    ) -> Iterator[Value]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        size = self._worker.comm.size
        if self._worker.at_home:
            # Nothing has to be sent.
            sizes = enumerate(np.diff(self._bounds).tolist())
            parts = [(rank, part) for rank, n in sizes if n or rank == 0 for part in parts_of(n)]
            for some in (parts[k : k + PARTS] for k in range(0, len(parts), PARTS)):
                own = [iter(found) for found in self._order("of_home", function, some, of, *arguments)]
                yield from (next(own[rank]) for rank, _ in some)
            return
        rows = max(1, min(PARTS, size) * cloud.PART // size)
        for first in range(0, max(self.size, 1), rows * size):
            found: list[Value] = self._order("of_parts", function, first, rows, of, *arguments)
            yield from found[: max(1, -(-(self.size - first) // rows))]

    def remember(self, layout: Mapping[str, NDArray[Any]]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        self._order("remember", layout)

    def begin(self, name: str, first: Callable[[Particles], Mapping[str, NDArray[Any]]]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        for p in self.in_order(same):
            self._put(p.number, {f"{name}/{key}": array for key, array in first(p).items()})

    def share_sums(self, name: str, shape: tuple[int, ...]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        self._order("share_sums", name, shape)

    def of_cells(self, name: str, part: slice) -> NDArray[np.float64]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return np.concatenate(self._order("of_cells", name, part))

    def restore(self, file: PathLike[str]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        self._order("restore", file)

    def write_parts(self, file: PathLike[str], time: float) -> list[tuple[int, str]]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return [part for part in self._order("write_part", file, time) if part is not None]

    def _put(self, numbers: NDArray[np.int64], arrays: Mapping[str, NDArray[Any]]) -> None:
        """Store arrays of particles of consecutive numbers at their homes."""
        ends = np.searchsorted(numbers, self._bounds)
        for rank, rows in enumerate(map(slice, ends[:-1], ends[1:])):
            own = {name: array[rows] for name, array in arrays.items()}
            if rows.start == rows.stop:
                continue
            first = int(numbers[rows.start] - self._bounds[rank])
            if rank == 0:
                self._worker.put(0, first, own)
            else:
                self._order("put", rank, first, own=(own,))
