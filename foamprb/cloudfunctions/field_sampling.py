"""Fields of the case along the paths of particles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np

from foamprb.cloud.measures import name_of_field
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    SampleInterval,
    names_of,
)
from foamprb.dictionary.constraints import Meaning, Words
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.fields import FieldValues, columns_of
from foamprb.results.tables import Column, rows_of, write_rows
from foamprb.results.tables import Rows as TableRows

__all__ = ["FieldSampling"]


@dataclass(frozen=True)
class FieldSampling(SampledFunction):
    """Fields of the case along each path: ``fields.csv``, and in clouds, tracks and ``fates``.

    For each particle and field: the value at the last sample, the mean in time and the largest value, that of
    the norm for vectors and tensors.
    """

    fields: Annotated[
        Words, Meaning("`(name name)`: scalars, vectors or tensors at all cells, at each time of the flow")
    ]
    sampleInterval: SampleInterval = 1

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
            raise InputError(f"the flow has no fields {' '.join(sorted(missing))}; those of a case are read")
        return super().begin(cloud)

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return the values of the fields, (n, columns), NaN where the flow is unknown."""
        return {"value": self._table(cloud.fields(rows))}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return the tetrahedra of release, integrals of zero, and no largest values."""
        n, columns = cloud.particles.size, self._table(cloud.fields(np.empty(0, dtype=np.int64))).shape[1]
        largest = np.full((n, len(self.fields)), np.nan)
        return {"host": cloud.particles.host.copy(), "integral": np.zeros((n, columns)), "largest": largest}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Add to the integrals, by the trapezoidal rule, and to the largest values."""
        new = rows[memory["t"][rows] == cloud.particles.t0[rows]]
        memory["value"][new] = self._table(cloud.fields_at_release(new, memory["host"][new]))
        before = memory["value"][rows]
        # The flow is unknown at a particle that the mesh has lost.
        now["value"] = np.where(np.isfinite(now["value"]), now["value"], before)
        h = now["t"] - memory["t"][rows]
        memory["integral"][rows] += 0.5 * h[:, None] * (before + now["value"])
        for k, (_, own) in enumerate(self._columns(cloud)):
            both = [v[:, own][:, 0] if own.stop - own.start == 1 else np.linalg.norm(v[:, own], axis=1)
                    for v in (before, now["value"])]  # fmt: skip
            memory["largest"][rows, k] = np.fmax(memory["largest"][rows, k], np.fmax(*both))

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the values of all particles that were released."""
        columns = self._columns(cloud)
        rows = cloud.in_order(self.of_particles(memory), _values_of, columns, cloud.injectors, cloud.tables)
        write_rows(folder / f"fields.{cloud.tables}", rows)

    def fates(self, memory: Memory, cloud: ObservedCloud) -> Mapping[str, Column]:
        """Return the last values."""
        columns = [_named(name, "", memory["value"][:, own]) for name, own in self._columns(cloud)]
        return {name: column for named in columns for name, column in named.items()}

    def _columns(self, cloud: ObservedCloud) -> list[tuple[str, slice]]:
        """Return the name of each field and its columns."""
        found, end = [], 0
        for name, values in self._own(cloud.fields(np.empty(0, dtype=np.int64))):
            start, end = end, end + values.values.shape[1]
            found.append((name, slice(start, end)))
        return found

    def _own(self, fields: Mapping[str, FieldValues]) -> list[tuple[str, FieldValues]]:
        return [(name, fields[name]) for name in map(name_of_field, self.fields)]

    def _table(self, fields: Mapping[str, FieldValues]) -> Floats:
        return np.concatenate([f.values for _, f in self._own(fields)], axis=1)


def _values_of(
    p: Particles, memory: Memory, fields: Sequence[tuple[str, slice]], injectors: Sequence[str], tables: str
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
    for k, (name, own) in enumerate(fields):
        table |= _named(name, "", last[:, own]) | _named(name, "Mean", mean[:, own])
        table[f"{name}Max"] = memory["largest"][rows, k]
    return rows_of(table, tables)


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
