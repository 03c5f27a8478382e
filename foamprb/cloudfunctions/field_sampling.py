"""Fields of the case along the paths of particles."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import name_of_field
from foamprb.cloud.paths import Steps, step, vector_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    PathFunction,
    Rows,
    names_of,
    per_particle,
)
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import Meaning, Words
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.fields import FieldArrays, FieldColumns, blend_fields, columns_of
from foamprb.flow.walk import Corners, Weights, blend
from foamprb.results.tables import Column, rows_of, write_rows
from foamprb.results.tables import Rows as TableRows


@dataclass(frozen=True)
class FieldSampling(PathFunction):
    """Fields of the case along each path: ``fields.csv``, and in clouds, tracks and ``fates``.

    For each particle and field: the last value, the mean in time and the largest value, that of the norm for
    vectors and tensors, at the ends of the particle's time steps.
    """

    fields: Annotated[
        Words, Meaning("`(name name)`: scalars, vectors or tensors at all cells, at each time of the flow")
    ]

    arrays: ClassVar = {
        **PathFunction.arrays,
        **dict.fromkeys(("value", "integral", "largest"), per_particle),
    }

    def __post_init__(self) -> None:
        if not self.fields:
            raise InputError("has an empty list fields")

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """The fields."""
        return self.fields

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the first sample; raise InputError if the flow was not read with the fields."""
        missing = {*self.fields} - {c.name for c in columns_of(cloud.cloud.flow)}
        if missing:
            raise InputError(f"the flow has no fields {' '.join(sorted(missing))}; a case may have them")
        return super().begin(cloud)

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero, and no values."""
        n, end = cloud.particles.size, self._columns(columns_of(cloud.cloud.flow))[-1][1].stop
        unknown = np.full((n, end + len(self.fields)), np.nan)
        return {"value": unknown[:, :end], "integral": np.zeros((n, end)), "largest": unknown[:, end:]}

    def add(self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]) -> None:
        """Add to the integrals, by the trapezoidal rule, and to the largest values."""
        flow: Any = cloud.cloud.flow
        fields = flow.fields(0.0, 0.0)
        components = {c.name: c.components for c in fields.columns}
        starts = dict(zip(components, np.cumsum([0, *components.values()]), strict=False))
        source = np.array([starts[name] for name in self.fields])
        edges = np.cumsum([0, *(components[name] for name in self.fields)])
        sums = memory["value"], memory["integral"], memory["largest"]
        compiled(_add_steps)(fields.arrays, steps.tables, fresh, source, edges, *sums)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:  # noqa: ARG002
        """Write the values of all particles that were released."""
        columns = self._columns(columns_of(cloud.cloud.flow))
        rows = cloud.map(_values_of, columns, cloud.names["injector"])
        write_rows(folder / "fields.csv", rows)

    def fates(self, memory: Memory, fields: Sequence[FieldColumns]) -> Mapping[str, Column]:
        """Return the last values."""
        tables = [_named(name, "", memory["value"][:, columns]) for name, columns in self._columns(fields)]
        return {name: column for named in tables for name, column in named.items()}

    def _columns(self, fields: Sequence[FieldColumns]) -> list[tuple[str, slice]]:
        """Return the name of each of its fields and its columns in the data, by the fields of the flow."""
        components, columns, end = {field.name: field.components for field in fields}, [], 0
        for name in self.fields:
            start, end = end, end + components[name]
            columns.append((name_of_field(name), slice(start, end)))
        return columns


def _add_steps(
    fields: FieldArrays,
    tables: Floats,
    fresh: NDArray[np.bool_],
    source: Rows,
    edges: Rows,
    value: Floats,
    integral: Floats,
    largest: Floats,
) -> None:
    """Add the fresh ones of some steps to the integrals of their particles.

    Field k is in the columns ``edges[k]`` to ``edges[k + 1]`` of the values, and from ``source[k]`` on of the
    fields.
    """
    k = -1
    for table in tables:
        for i in range(table.shape[1]):
            k += 1
            if not fresh[k]:
                continue
            row = int(table[step.row, i])
            if math.isnan(value[row, 0]) and table[step.host0, i] >= 0.0:
                x, t = vector_of(table, step.x0, i), table[step.t0, i]
                before, after, w, share = blend_fields(fields, int(table[step.host0, i]), x, t)
                for field in range(len(source)):
                    for c in range(edges[field], edges[field + 1]):
                        n = source[field] + c - edges[field]
                        value[row, c] = mix(fields[1], n, before, after, w, share)
            _add_step(fields, table, i, row, source, edges, value, integral, largest)


def _add_step(
    fields: FieldArrays,
    table: Floats,
    i: int,
    row: int,
    source: Rows,
    edges: Rows,
    value: Floats,
    integral: Floats,
    largest: Floats,
) -> None:
    """Add step i of a table to the integrals of a particle, from its last values."""
    half, host = 0.5 * (table[step.t1, i] - table[step.t0, i]), int(table[step.host1, i])
    x, t = vector_of(table, step.x1, i), table[step.t1, i]
    before, after, w, share = blend_fields(fields, max(host, 0), x, t)
    for field in range(len(source)):
        squares, first, last = 0.0, 0.0, 0.0
        size = 0.0
        for c in range(edges[field], edges[field + 1]):
            n = source[field] + c - edges[field]
            first = value[row, c]
            # The flow is unknown at a particle that the mesh has lost.
            last = mix(fields[1], n, before, after, w, share) if host >= 0 else first
            first = last if math.isnan(first) else first
            integral[row, c] += half * (first + last)
            value[row, c] = last
            squares, size = squares + last * last, size + first * first
        scalar = edges[field + 1] == edges[field] + 1
        most = max(first, last) if scalar else math.sqrt(max(squares, size))
        if not largest[row, field] >= most:
            largest[row, field] = most


def mix(f: Floats, k: int, before: Corners, after: Corners, w: Weights, share: float) -> float:
    """Return column k of a table of fields, see :func:`foamprb.flow.fields.blend_fields`."""
    a, b = blend(f, k, before, w), blend(f, k, after, w)
    return a + share * (b - a)


def _values_of(
    p: Particles, memory: Memory, fields: Sequence[tuple[str, slice]], injectors: Sequence[str]
) -> TableRows:
    """Return the rows of the particles that were released."""
    rows = np.flatnonzero(p.status != Status.PENDING)
    duration = (memory["t"] - p.t0)[rows, None]
    table: dict[str, Column] = {
        "id": p.number[rows],
        "injector": names_of(injectors, p.injector[rows]),
        "fate": names_of(STATUS_NAMES, p.status[rows]),
        "time": memory["t"][rows],
    }
    last = memory["value"][rows]
    mean = np.divide(memory["integral"][rows], duration, out=last.copy(), where=duration > 0.0)
    for k, (name, columns) in enumerate(fields):
        table |= _named(name, "", last[:, columns]) | _named(name, "Mean", mean[:, columns])
        table[f"{name}Max"] = memory["largest"][rows, k]
    return rows_of(table)


_COMPONENTS = {
    1: ("",),
    3: ("x", "y", "z"),
    6: ("xx", "yy", "zz", "xy", "yz", "xz"),
    9: ("xx", "xy", "xz", "yx", "yy", "yz", "zx", "zy", "zz"),
}


def _named(name: str, what: str, values: Floats) -> dict[str, Column]:
    """Return the columns of a field, ``Bx``, or of its mean, ``BxMean``."""
    components = _COMPONENTS[values.shape[1]]
    return {f"{name}{c}{what}": column for c, column in zip(components, values.T, strict=True)}
