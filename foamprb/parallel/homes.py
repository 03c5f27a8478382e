"""Homes of particles: processes that write the rows of particles of consecutive numbers."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Mapping
from os import PathLike
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.cloud import Value, parts_of, same
from foamprb.cloud.state import VARIABLES, Particles, concatenate
from foamprb.parallel.exchange import homes_of
from foamprb.parallel.worker import Worker
from foamprb.settings.libs import loaded_libs


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
            first = int(p.number[0]) if p.size else 0
            for rank, (start, end) in enumerate(zip(self._bounds[:-1], self._bounds[1:], strict=True)):
                rows = slice(max(0, start - first), max(0, end - first))
                own = p.take(rows)._asdict()
                if len(own["number"]):
                    # Unused arrays of zeros take no memory of the machine until they are written.
                    used = {k: a for k, a in own.items() if not VARIABLES[k].optional or a.any()}
                    self._put(rank, int(own["number"][0] - start), used)

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

    def in_order(
        self, function: Callable[..., Value], *arguments: Any, of: str | None = None
    ) -> Iterator[Value]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        for rank, part in self._parts():
            yield self._of_part(rank, part, of, function, *arguments)

    def remember(self, layout: Mapping[str, NDArray[Any]]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        self._order("remember", layout)

    def begin(self, name: str, first: Callable[[Particles], Mapping[str, NDArray[Any]]]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        for rank, part in self._parts():
            found = first(self._of_part(rank, part, None, same))
            self._put(rank, part.start, {f"{name}/{key}": array for key, array in found.items()})

    def restore(self, file: PathLike[str]) -> None:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        self._order("restore", file)

    def write_parts(self, file: PathLike[str], time: float) -> list[tuple[int, str]]:
        """See :class:`foamprb.cloud.cloud.Homes`."""
        return [part for part in self._order("write_part", file, time) if part is not None]

    def _parts(self) -> Iterator[tuple[int, slice]]:
        """Yield the homes and the rows of their parts, in the order of the particles."""
        for rank, n in enumerate(np.diff(self._bounds).tolist()):
            if n or rank == 0:
                yield from ((rank, slice(part.start, min(part.stop, n))) for part in parts_of(n))

    def _of_part(
        self, rank: int, part: slice, of: str | None, function: Callable[..., Value], *arguments: Any
    ) -> Value:
        found: list[Value] = self._order("of_part", function, rank, part, of, *arguments)
        return found[rank]

    def _put(self, rank: int, first: int, arrays: Mapping[str, NDArray[Any]]) -> None:
        """Store arrays of particles from a row on at a home."""
        if rank == 0:
            self._worker.put(0, first, arrays)
        else:
            self._order("put", rank, first, own=(arrays,))
