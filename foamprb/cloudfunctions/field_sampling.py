"""Fields of the case along the paths of particles."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

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
    StepObserver,
    appearing,
    fields_at_release,
    fields_of,
    names_of,
    per_particle,
)
from foamprb.dictionary.constraints import Meaning, Words
from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.fields import FieldColumns, FieldValues, columns_of
from foamprb.results.tables import Column, rows_of, write_rows
from foamprb.results.tables import Rows as TableRows

__all__ = ["FieldSampling"]


@dataclass(frozen=True)
class FieldSampling(SampledFunction, StepObserver):
    """Fields of the case along each path: ``fields.csv``, and in clouds, tracks and ``fates``.

    For each particle and field: the value at the last sample, the mean in time and the largest value, that of
    the norm for vectors and tensors.
    """

    fields: Annotated[
        Words, Meaning("`(name name)`: scalars, vectors or tensors at all cells, at each time of the flow")
    ]
    sampleInterval: SampleInterval = 1

    arrays: ClassVar = {
        **SampledFunction.arrays,
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

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return the values of the fields, (n, columns), NaN where the flow is unknown."""
        return {"value": self._table(fields_of(cloud, rows))}

    def before_steps(self, memory: Memory, cloud: ObservedCloud, until: float) -> None:
        """Store the values at the release of the particles that appear, while the flow there is loaded."""
        rows = appearing(cloud, until)
        memory["value"][rows] = self._table(fields_at_release(cloud, rows, cloud.particles.host[rows]))

    def after_steps(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the values at the end of the particles that have ended, while the flow there is loaded."""
        self.close(memory, cloud)

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero, and no largest values."""
        n, end = cloud.particles.size, self._columns(columns_of(cloud.cloud.flow))[-1][1].stop
        return {"integral": np.zeros((n, end)), "largest": np.full((n, len(self.fields)), np.nan)}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Add to the integrals, by the trapezoidal rule, and to the largest values."""
        before = memory["value"][rows]
        # The flow is unknown at a particle that the mesh has lost.
        now["value"] = np.where(np.isfinite(now["value"]), now["value"], before)
        h = now["t"] - memory["t"][rows]
        memory["integral"][rows] += 0.5 * h[:, None] * (before + now["value"])
        for k, (_, columns) in enumerate(self._columns(columns_of(cloud.cloud.flow))):
            both = (v[:, columns] for v in (before, now["value"]))
            sizes = [v[:, 0] if v.shape[1] == 1 else np.linalg.norm(v, axis=1) for v in both]
            memory["largest"][rows, k] = np.fmax(memory["largest"][rows, k], np.fmax(*sizes))

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

    def _table(self, fields: Mapping[str, FieldValues]) -> Floats:
        return np.concatenate([fields[name_of_field(name)].values for name in self.fields], axis=1)


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
