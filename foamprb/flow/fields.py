"""Fields of a case that are sampled along paths: scalars, vectors and tensors, linear in each tetrahedron."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cache
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.tensor import Vector
from foamprb.compile.link import link
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import MeshArrays, no_mesh
from foamprb.flow.walk import Corners, Weights, blend, corners, shape


class FieldColumns(NamedTuple):
    """Field in the columns of a table: a scalar, a vector, a symmetric tensor or a tensor."""

    name: str
    components: int
    unit: str


class FieldValues(NamedTuple):
    """Values of a field at n points."""

    values: Floats
    """(n, components), NaN where the flow is unknown."""
    unit: str

    @property
    def array(self) -> Floats:
        """The values, (n,) of a scalar."""
        return self.values[:, 0] if self.values.shape[1] == 1 else self.values


FieldArrays: TypeAlias = tuple[MeshArrays, Floats, NDArray[np.int64], Floats, float]


class Fields(NamedTuple):
    """Fields at the nodes of a mesh, at one or several times."""

    mesh: MeshArrays
    """Its nodes and tetrahedra."""
    table: Floats
    """(rows, columns of all fields), with a row for each node, time by time."""
    first: NDArray[np.int64]
    """(n,) row of the first node at each time."""
    times: Floats
    """(n,) rising, s."""
    columns: tuple[FieldColumns, ...]
    slack: float
    """Times closer than this are the same, s."""

    @property
    def arrays(self) -> FieldArrays:
        """Arguments of :func:`blend_fields`."""
        return self.mesh, self.table, self.first, self.times, self.slack

    def at(self, points: Floats, hosts: Ints, t: ArrayLike) -> dict[str, FieldValues]:
        """Return the fields at points (n, 3) in hosts (n,), −1 for none, at times t, by name; linear in t."""
        known = np.flatnonzero((hosts >= 0) & np.isfinite(points).all(axis=1))
        x, hosts = np.ascontiguousarray(points[known]), np.ascontiguousarray(hosts[known], dtype=np.int32)
        times = np.broadcast_to(np.asarray(t, dtype=float), len(points))
        values = np.full((len(points), width(self.columns)), np.nan)
        values[known] = self._linear(x, hosts, times[known])
        ends = np.cumsum([c.components for c in self.columns])
        return {
            c.name: FieldValues(values[:, end - c.components : end], c.unit)
            for c, end in zip(self.columns, ends, strict=True)
        }

    def _linear(self, x: Floats, hosts: Ints, t: Floats) -> Floats:
        if len(self.times) == 1:
            return self._level(0, x, hosts)
        found = np.empty((len(x), self.table.shape[1]))
        # Values at a given time do not depend on the others that are loaded.
        same = np.abs(t[:, None] - self.times) <= self.slack
        given, level = same.any(axis=1), same.argmax(axis=1)
        for k in np.unique(level[given]):
            own = np.flatnonzero(given & (level == k))
            found[own] = self._level(k, x[own], hosts[own])
        before = np.clip(np.searchsorted(self.times, t, side="right") - 1, 0, len(self.times) - 2)
        for k in np.unique(before[~given]):
            own = np.flatnonzero(~given & (before == k))
            a, b = (self._level(n, x[own], hosts[own]) for n in (k, k + 1))
            start, end = self.times[k], self.times[k + 1]
            found[own] = a + ((t[own] - start) / (end - start))[:, None] * (b - a)
        return found

    def _level(self, level: int, x: Floats, hosts: Ints) -> Floats:
        found = np.empty((len(x), self.table.shape[1]))
        _blender()(self.mesh, self.table, self.first[level], x, hosts, found)
        return found


def field_of(name: str) -> str:
    """Return the name of the field in ``grad(E)``; other names are those of fields."""
    return name.removeprefix("grad(").removesuffix(")") if name.startswith("grad(") else name


def columns_of(flow: Any) -> tuple[FieldColumns, ...]:
    """Return the fields that are sampled of a flow; flows without a case have none."""
    return getattr(flow, "field_columns", ())


def fields_on(
    mesh: MeshArrays,
    table: Floats,
    columns: Sequence[FieldColumns],
    first: Sequence[int] = (0,),
    times: Sequence[float] = (0.0,),
    slack: float = 0.0,
) -> Fields:
    """Return fields on a mesh, of whose arrays only those are kept that interpolation reads."""
    own = no_mesh()._replace(nodes=mesh.nodes, tets=mesh.tets, n_points=mesh.n_points)
    return Fields(own, table, np.array(first, dtype=np.int64), np.array(times), tuple(columns), slack)


def width(columns: Sequence[FieldColumns]) -> int:
    """Return the number of columns of fields."""
    return sum(c.components for c in columns)


def blend_fields(
    fields: FieldArrays, host: int, x: Vector, t: float
) -> tuple[Corners, Corners, Weights, float]:
    """Return rows of the table of fields before and after a time, their weights, and the share of the time.

    Column k of the table at x and t is ``between(blend(table, k, before, w), blend(table, k, after, w))``.
    """
    mesh, _, first, times, slack = fields
    k, last = 0, times.shape[0] - 1
    while k < last - 1 and t > times[k + 1] - 2.0 * slack:
        k += 1
    after = min(k + 1, last)
    length = times[after] - times[k]
    share = (t - times[k]) / length if length > 0.0 else 0.0
    return corners(mesh, host, first[k]), corners(mesh, host, first[after]), shape(mesh, host, x), share


@cache
def _blender() -> Any:
    return link(_blend_all)


def _blend_all(
    mesh: MeshArrays, table: Floats, first: int, points: Floats, hosts: Ints, found: Floats
) -> None:
    for i in range(points.shape[0]):
        w = shape(mesh, hosts[i], (points[i, 0], points[i, 1], points[i, 2]))
        nodes = corners(mesh, hosts[i], first)
        for k in range(table.shape[1]):
            found[i, k] = blend(table, k, nodes, w)
