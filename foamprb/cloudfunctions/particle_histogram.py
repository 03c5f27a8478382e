"""What particles have been through, and how that is distributed."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import SAMPLE_INTERVAL, STATUS_NAMES, Memory, ObservedCloud
from foamprb.cloudfunctions.rows import close_ended, names_of, open_rows
from foamprb.dictionary.constraints import AtLeastOne, Meaning, Words
from foamprb.errors import InputError, suggestion
from foamprb.results.tables import Column, write_table

__all__ = ["ParticleHistogram"]

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ParticleHistogram:
    """What each particle has been through, ``exposure.csv``, and its distributions, ``<field>.csv``.

    ``residenceTime``, s; ``maxDeformation`` and ``meanDeformation``, Taylor's D at its largest and averaged
    over time; ``shearExposure``, ∫γ̇ dt. The integrals are trapezoidal sums and the largest value that of the
    samples, ``sampleInterval`` steps apart, and of the start and the end of each particle.
    """

    fields: Annotated[
        Words,
        Meaning(
            "`residenceTime` (s), `maxDeformation`, `meanDeformation` (Taylor's D), `shearExposure` (∫γ̇ dt)",
            default="all",
        ),
    ] = ("residenceTime", "maxDeformation", "meanDeformation", "shearExposure")
    nBins: Annotated[int, AtLeastOne, Meaning("bins between the smallest and the largest value")] = 50
    sampleInterval: Annotated[int, AtLeastOne, SAMPLE_INTERVAL] = 10

    def __post_init__(self) -> None:
        for name in self.fields:
            if name not in _EXPOSURES:
                raise InputError(f"has the field {name}. {suggestion(name, _EXPOSURES)[:-1]}")

    @property
    def interval(self) -> int:
        """Steps between two samples."""
        return self.sampleInterval

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the state of all particles at the start, and integrals of zero.

        Raises
        ------
        InputError
            If an injection model has the name of a column that the tables have already.
        """
        if taken := {"lower", "upper"} & set(cloud.injectors):
            raise InputError(f"no injection model may be called {min(taken)}, as a column of the tables is.")
        p = cloud.particles
        D, rate = cloud.measure(np.arange(p.size), "taylorDeformation", "shearRate")
        return {
            "closed": np.zeros(p.size, dtype=bool),
            "t": p.t.copy(),
            "D": D,
            "shearRate": rate,
            "maxD": D.copy(),
            "sumD": np.zeros(p.size),
            "sumShearRate": np.zeros(p.size),
        }

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the time since the last sample to the integrals."""
        p = cloud.particles
        rows = open_rows(memory, p)
        h = p.t[rows] - memory["t"][rows]
        D, rate = cloud.measure(rows, "taylorDeformation", "shearRate")
        # A particle that the mesh has lost is where the flow is not known.
        rate = np.where(np.isfinite(rate), rate, memory["shearRate"][rows])
        memory["sumD"][rows] += 0.5 * h * (memory["D"][rows] + D)
        memory["sumShearRate"][rows] += 0.5 * h * (memory["shearRate"][rows] + rate)
        memory["maxD"][rows] = np.maximum(memory["maxD"][rows], D)
        memory["t"][rows], memory["D"][rows], memory["shearRate"][rows] = p.t[rows], D, rate
        close_ended(memory, p, rows)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the tables of all particles that were released; the distributions leave out the failed."""
        p = cloud.particles
        rows = np.flatnonzero(p.status != Status.PENDING)
        values = {name: exposure(memory, p)[rows] for name, exposure in _EXPOSURES.items()}
        write_table(
            folder / f"exposure.{cloud.tables}",
            {"id": rows, "injector": names_of(cloud.injectors, p.injector[rows]),
             "fate": names_of(STATUS_NAMES, p.status[rows]), **values},
        )  # fmt: skip
        sound = p.status[rows] != Status.FAILED
        for name in self.fields:
            x, injector = values[name][sound], p.injector[rows][sound]
            edges = np.histogram_bin_edges(x, self.nBins)
            table: dict[str, Column] = {"lower": edges[:-1], "upper": edges[1:]}
            for index, own in enumerate(cloud.injectors):
                table[own] = np.histogram(x[injector == index], edges)[0]
            write_table(folder / f"{name}.{cloud.tables}", table)


def _mean_deformation(memory: Memory, p: Particles) -> Floats:
    age = memory["t"] - p.t0
    mean: Floats = np.where(age > 0.0, memory["sumD"] / np.where(age > 0.0, age, 1.0), memory["D"])
    return mean


_EXPOSURES: dict[str, Callable[[Memory, Particles], Floats]] = {
    "residenceTime": lambda memory, p: memory["t"] - p.t0,
    "maxDeformation": lambda memory, _: memory["maxD"],
    "meanDeformation": _mean_deformation,
    "shearExposure": lambda memory, _: memory["sumShearRate"],
}
