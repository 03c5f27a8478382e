"""Values at the nodes of a flow, from which the log has ranges and medians."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

Floats: TypeAlias = NDArray[np.float64]

_FEW = 100_000
"""Nodes of which :func:`stride_over` chooses at least as many, if there are as many."""
_AT_ONCE = 1 << 16
"""Nodes for which a function is evaluated at once."""

Ends: TypeAlias = list[tuple[float, float]]
"""Smallest and largest value of some quantities."""


class NodeValues(NamedTuple):
    """Values at some nodes of a flow, at its first time."""

    time: str
    """Name of the time, if there are times."""
    u: Floats
    """(n, 3), m/s."""
    l: Floats
    """(n, 9): ∂u_i/∂x_j row by row, 1/s."""
    turbulence: Floats
    """(n, 8): k, ε, ∇k and ∇(k²/3ε); no rows if they were not read."""
    viscosity: Floats
    """(n,): a field of the viscosity, as it was read; no rows if it was not."""

    def take(self, rows: slice | NDArray[np.intp]) -> NodeValues:
        """Return the values at some of the nodes."""
        return NodeValues(self.time, *(values[rows] if len(values) else values for values in self[1:]))


NO_VALUES = NodeValues("", np.empty((0, 3)), np.empty((0, 9)), np.empty((0, 8)), np.empty(0))
"""Values of a flow without nodes."""
Function: TypeAlias = Callable[[NodeValues], Sequence[Floats]]
"""Returns some quantities at nodes, (n,) or fewer values each."""


def stride_over(n: int) -> int:
    """Return the difference between the numbers of chosen nodes, so that few of n are chosen."""
    return max(1, n // _FEW)


def ends_over(values: NodeValues, function: Function) -> Ends:
    """Return the ends of some quantities over all nodes; none for no nodes."""
    parts = (values.take(slice(k, k + _AT_ONCE)) for k in range(0, len(values.u), _AT_ONCE))
    ends = (
        [(float(a.min(initial=np.inf)), float(a.max(initial=-np.inf))) for a in function(part)]
        for part in parts
    )
    return [(min(low for low, _ in own), max(high for _, high in own)) for own in zip(*ends, strict=True)]
