"""Exchange of values between the computers (nodes) that hold a mesh; here one node holds all of it.

:mod:`foamprb.distributed` has the communicator of several nodes. Its sums depend on no division of the mesh.
"""

from __future__ import annotations

from collections.abc import Callable
from contextlib import AbstractContextManager, nullcontext
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.lists import Index


class MeshCommunicator:
    """Nodes that hold a mesh; all call the same methods together. Here there is one node.

    Each cell and each face is counted by one node, its owner.
    """

    rank = 0
    own_cells: Index | slice = slice(None)
    own_faces: Index | slice = slice(None)
    own_boundary: Index | slice = slice(None)
    """Cells, faces and boundary faces that this node counts."""

    def fill(self, kind: str, values: NDArray[Any]) -> None:
        """Fill the rows of ``cells``, ``points``, ``faces`` or ``boundary`` of other nodes, in place."""

    def of_all(self, value: Any) -> list[Any]:
        """Return the values of all nodes."""
        return [value]

    def united(self) -> AbstractContextManager[None]:
        """Raise an error of one node on all of them."""
        return nullcontext()

    def any(self, value: bool) -> bool:
        """Return True if the value is true on any node."""
        return any(self.of_all(bool(value)))

    def extremes(self, values: Floats) -> tuple[float, float]:
        """Return the smallest and the largest of values, of all nodes; (∞, −∞) for none."""
        ends = float(values.min(initial=np.inf)), float(values.max(initial=-np.inf))
        lows, highs = zip(*self.of_all(ends), strict=True)
        return min(lows), max(highs)

    def total(self, values: Floats) -> float:
        """Return the sum of values of the cells of all nodes; see :func:`total_of`."""
        return total_of(values[self.own_cells], self.of_all)

    def distribute(
        self, rows: tuple[Any, ...], blocks: tuple[Ints, int], segments: Index
    ) -> tuple[tuple[Any, ...], Callable[[NDArray[Any]], NDArray[Any]], Callable[[Floats], Floats]]:
        """Redistribute matrix rows by contiguous cell ranges.

        Parameters
        ----------
        rows, blocks, segments
            See :class:`foamprb.flow.balance.Equations`, of the cells of this node.

        Returns
        -------
        arguments, put, get
            The arguments of the equations of this node. Functions that send values of the own cells to the
            equations, and values of the equations to the cells.
        """
        return (rows, *blocks, segments), lambda values: values, lambda values: values


SINGLE_NODE = MeshCommunicator()


def single_node(value: Any) -> list[Any]:
    """Return the values of all nodes, if there is one."""
    return [value]


def total_of(values: Floats, of_all: Callable[[Any], list[Any]] = single_node) -> float:
    """Return the sum of values that are not negative, the same in any order and any division among nodes.

    The values are rounded to multiples of a power of two, which add without round-off; it is 2⁶⁰ times less
    than the largest value times their number. ``of_all`` returns a value of each node.
    """
    ends = of_all((float(values.max(initial=0.0)), len(values)))
    peak, n = max(peak for peak, _ in ends), sum(n for _, n in ends)
    if not 0.0 < peak < np.inf:
        return float(peak)
    unit = int(np.frexp(peak)[1]) + max(n, 1).bit_length() - 61
    own = int(np.rint(np.ldexp(values, -unit)).astype(np.int64).sum())
    return float(np.ldexp(float(sum(of_all(own))), unit))
