"""A flow at the times that are loaded, as arrays that several processes may share."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats, Ints
from foamprb.flow.fields import FieldColumns, Fields, columns_of
from foamprb.flow.sampling import sample_with, viscosity_with


class LoadedFlow(NamedTuple):
    """Flow at the loaded times: its kernels, their arguments, and the fields that are sampled."""

    kernels: Mapping[str, Callable[..., Any]]
    arrays: Any
    sampled: Fields | None

    @property
    def field_columns(self) -> tuple[FieldColumns, ...]:
        """Fields that are sampled."""
        return () if self.sampled is None else self.sampled.columns

    def fields(self, start: float, end: float) -> Fields:  # noqa: ARG002
        """Return the fields that are sampled; the loaded times must include ``start`` to ``end``."""
        assert self.sampled is not None
        return self.sampled

    def cell_of(self, hosts: Ints) -> NDArray[np.int64]:
        """Return the cells (n,) of tetrahedra; any cell for −1."""
        mesh = getattr(self.arrays, "mesh", self.arrays)
        cells: NDArray[np.int64] = mesh.tets[hosts, 0].astype(np.int64) - mesh.n_points
        return cells

    def sample(self, points: Floats, hosts: Ints, t: float | Floats) -> tuple[Floats, Floats]:
        """See :meth:`foamprb.flow.base.Flow.sample`; the times t, s, are one for all or (n,)."""
        return sample_with(self.kernels["sample"], self.arrays, points, hosts, t)

    def viscosity(self, points: Floats, hosts: Ints, t: float | Floats) -> Floats:
        """See :func:`foamprb.flow.sampling.viscosity_with`."""
        return viscosity_with(self.kernels["viscosity"], self.arrays, points, hosts, t)


def loaded_fields(flow: Any) -> Fields | None:
    """Return the fields of a flow that are sampled, at the loaded times; None without any."""
    fields: Fields | None = flow.loaded_fields() if columns_of(flow) else None
    return fields
