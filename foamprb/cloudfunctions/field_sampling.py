"""Fields of the case along the paths of particles."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any

import numpy as np

from foamprb.cloud.state import Status
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
from foamprb.results.tables import Column, write_table

__all__ = ["FieldSampling"]


@dataclass(frozen=True)
class FieldSampling(SampledFunction):
    """Scalar fields of a case with a steady flow along each path: ``fields.csv``.

    For each particle and field: the value at the last sample, the mean in time and the largest value.
    """

    fields: Annotated[Words, Meaning("`(name name)`: each a `volScalarField` at the time of the flow")]
    sampleInterval: SampleInterval = 1

    @property
    def needed_fields(self) -> tuple[str, ...]:
        """The fields."""
        return self.fields

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the first sample; raise InputError if the flow was not read with the fields."""
        missing = {*self.fields} - {*getattr(cloud.cloud.flow, "scalars", ())}
        if missing:
            raise InputError(f"the flow has no fields {' '.join(sorted(missing))}; those of a case are read")
        return super().begin(cloud)

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return the values of the fields, (n, number of fields), NaN where the flow is unknown."""
        p = cloud.particles
        flow: Any = cloud.cloud.flow
        known = rows[(p.host[rows] >= 0) & np.isfinite(p.x[rows]).all(axis=1)]
        values = np.full((p.size, len(self.fields)), np.nan)
        for k, name in enumerate(self.fields):
            values[known, k] = flow.scalar(name, p.x[known], p.host[known])
        return {"value": values[rows]}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero, and the largest values at the start."""
        start = self.observe(cloud, np.arange(cloud.particles.size))["value"]
        return {"integral": np.zeros_like(start), "largest": start}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:  # noqa: ARG002
        """Add to the integrals, by the trapezoidal rule, and to the largest values."""
        before = memory["value"][rows]
        # The flow is unknown at a particle that the mesh has lost.
        now["value"] = np.where(np.isfinite(now["value"]), now["value"], before)
        h = now["t"] - memory["t"][rows]
        memory["integral"][rows] += 0.5 * h[:, None] * (before + now["value"])
        memory["largest"][rows] = np.fmax(memory["largest"][rows], now["value"])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the values of all particles that were released."""
        p = cloud.particles
        rows = np.flatnonzero(p.status != Status.PENDING)
        duration = (memory["t"] - p.t0)[rows]
        table: dict[str, Column] = {
            "id": rows,
            "injector": names_of(cloud.injectors, p.injector[rows]),
            "fate": names_of(STATUS_NAMES, p.status[rows]),
            "time": memory["t"][rows],
        }
        for k, name in enumerate(self.fields):
            last = memory["value"][rows, k]
            mean = np.divide(memory["integral"][rows, k], duration, out=last.copy(), where=duration > 0.0)
            table |= {name: last, f"{name}Mean": mean, f"{name}Max": memory["largest"][rows, k]}
        write_table(folder / f"fields.{cloud.tables}", table)
