"""Exposure of particles along their paths, and its distributions."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.body.viscosity import shear_rate
from foamprb.cloud.measures import shapes
from foamprb.cloud.paths import Steps, step, tensor_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    PathFunction,
    Rows,
    names_of,
    per_particle,
    taylor_at_end,
)
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import AtLeastOne, Meaning, Words
from foamprb.errors import InputError, suggestion
from foamprb.results.tables import Column, rows_of, write_rows, write_table
from foamprb.results.tables import Rows as TableRows

Floats = NDArray[np.float64]


@dataclass(frozen=True)
class ParticleHistogram(PathFunction):
    """Exposure of each particle along its path, ``exposure.csv``, and its distributions, ``<field>.csv``.

    ``residenceTime``, s; ``maxDeformation`` and ``meanDeformation``, Taylor's D at its largest and averaged
    over time; ``shearExposure``, ∫γ̇ dt. The integrals are trapezoidal sums over the time steps of a particle,
    and the largest value is that at their ends.
    """

    fields: Annotated[
        Words,
        Meaning(
            "`residenceTime` (s), `maxDeformation`, `meanDeformation` (Taylor's D), `shearExposure` (∫γ̇ dt)",
            default="all",
        ),
    ] = ("residenceTime", "maxDeformation", "meanDeformation", "shearExposure")
    nBins: Annotated[int, AtLeastOne, Meaning("bins between the smallest and the largest value")] = 50

    arrays: ClassVar = {
        **PathFunction.arrays,
        **dict.fromkeys(("D", "maxD", "sumD", "sumShearRate"), per_particle),
    }

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return frozenset({"F1", "Q1", "l0", "l1"})

    def __post_init__(self) -> None:
        for name in self.fields:
            if name not in _EXPOSURES:
                raise InputError(f"has the field {name}. {suggestion(name, _EXPOSURES)[:-1]}")

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero.

        Raises
        ------
        InputError
            If an injection model has the name of another column of the tables.
        """
        if taken := {"lower", "upper"} & set(cloud.names["injector"]):
            raise InputError(f"no injection model may be called {min(taken)}, as a column of the tables is.")
        D = shapes(cloud.particles)[1]
        return {"D": D, "maxD": D.copy(), "sumD": np.zeros(len(D)), "sumShearRate": np.zeros(len(D))}

    def add(
        self,
        memory: Memory,
        cloud: ObservedCloud,  # noqa: ARG002
        steps: Steps,
        fresh: NDArray[np.bool_],
    ) -> None:
        """Add to the integrals."""
        sums = memory["D"], memory["maxD"], memory["sumD"], memory["sumShearRate"]
        compiled(_expose)(steps.tables, fresh, *sums)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:  # noqa: ARG002
        """Write the tables of all particles that were released; the distributions leave out the failed."""
        injectors = cloud.names["injector"]
        write_rows(folder / "exposure.csv", cloud.map(_exposures_of, injectors))
        for name in self.fields:
            # The edges follow from the smallest and the largest value.
            ends = np.concatenate([*cloud.map(_ends_of, name)])
            edges = np.histogram_bin_edges(ends, self.nBins)
            counts = np.sum([*cloud.map(_numbers_in, name, edges, len(injectors))], axis=0)
            table: dict[str, Column] = {"lower": edges[:-1], "upper": edges[1:]}
            table |= dict(zip(injectors, counts, strict=True))
            write_table(folder / f"{name}.csv", table)


def _expose(
    tables: Floats, fresh: NDArray[np.bool_], D: Floats, maxD: Floats, sumD: Floats, sumShearRate: Floats
) -> None:
    """Add the fresh ones of some steps to the integrals of their particles."""
    k = -1
    for table in tables:
        for i in range(table.shape[1]):
            k += 1
            if not fresh[k]:
                continue
            row, half = int(table[step.row, i]), 0.5 * (table[step.t1, i] - table[step.t0, i])
            rates = shear_rate(tensor_of(table, step.l0, i)) + shear_rate(tensor_of(table, step.l1, i))
            after = taylor_at_end(table, i)
            sumD[row] += half * (D[row] + after)
            sumShearRate[row] += half * rates
            D[row], maxD[row] = after, max(maxD[row], after)


def _exposures_of(p: Particles, memory: Memory, injectors: Sequence[str]) -> TableRows:
    """Return the rows of the particles that were released."""
    rows = np.flatnonzero(p.status != Status.PENDING)
    return rows_of(
        {"id": p.number[rows], "injector": names_of(injectors, p.injector[rows]),
         "fate": names_of(STATUS_NAMES, p.status[rows]),
         **{name: exposure(memory, p)[rows] for name, exposure in _EXPOSURES.items()}}
    )  # fmt: skip


def _sound(p: Particles) -> Rows:
    """Return the rows of the particles that were released and have not failed."""
    return np.flatnonzero((p.status != Status.PENDING) & (p.status != Status.FAILED))


def _ends_of(p: Particles, memory: Memory, name: str) -> Floats:
    """Return the smallest and the largest exposure, none without particles."""
    x = _EXPOSURES[name](memory, p)[_sound(p)]
    return np.array([x.min(), x.max()]) if len(x) else x


def _numbers_in(p: Particles, memory: Memory, name: str, edges: Floats, injectors: int) -> Rows:
    """Return the numbers of particles of each injection model between the edges, (injectors, bins)."""
    rows = _sound(p)
    x, injector = _EXPOSURES[name](memory, p)[rows], p.injector[rows]
    counts = [np.histogram(x[injector == index], edges)[0] for index in range(injectors)]
    return np.array(counts, dtype=np.int64).reshape(injectors, len(edges) - 1)


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
