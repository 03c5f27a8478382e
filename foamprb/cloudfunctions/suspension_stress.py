"""Stress of the particles in a dilute suspension."""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import ClassVar

import numpy as np

from foamprb.body.tensor import dev, sym
from foamprb.cloud.cloud import regrouped
from foamprb.cloud.measures import PER_CONTEXT
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import CloudFunction, Memory, ObservedCloud, append, names_of, table
from foamprb.results.tables import write_table


@dataclass(frozen=True)
class SuspensionStress(CloudFunction):
    """Contribution of moving particles to the stress of a dilute suspension: ``suspensionStress.csv``.

    For each injection model: the number of its particles and their volume V, m³; the sum of the stresslets
    over the sum of the volumes, Pa, which times the volume fraction φ is the particles' stress; and the
    intrinsic viscosity Σ S:d_f/(2 μ_f Σ V d_f:d_f), 5/2 for rigid spheres: their dissipation per φ.
    """

    arrays: ClassVar = {"history": table}

    def begin(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return an empty table."""
        return {"history": np.empty((0, 11))}

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the table, with one more row for each injection model."""
        lines = []
        for index in range(len(cloud.names["injector"])):
            moving = regrouped(cloud.map(_moving, index), PER_CONTEXT)
            lines.append([cloud.time, index, *_suspension(cloud, moving)])
        time, index, n, *values = append(memory, "history", lines).T
        names = ("volume", "Sxx", "Syy", "Szz", "Sxy", "Syz", "Sxz", "intrinsicViscosity")
        write_table(
            folder / "suspensionStress.csv",
            {
                "time": time,
                "injector": names_of(cloud.names["injector"], index),
                "parcels": n.astype(np.int64),
                **dict(zip(names, values, strict=True)),
            },
        )


def _moving(p: Particles, _memory: Memory, injector: int) -> Particles:
    return p.take(np.flatnonzero((p.status == Status.ACTIVE) & (p.injector == injector)))


def _suspension(cloud: ObservedCloud, parts: Iterable[Particles]) -> list[float]:
    """Return number, volume, stress per volume (xx yy zz xy yz xz) and intrinsic viscosity of particles.

    The last seven are NaN without particles.
    """
    # The components off the diagonal count twice.
    weight = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    total, added, dissipated, mu, number = np.zeros(7), 0.0, 0.0, 0.0, 0
    for p in parts:
        number += p.size
        J, S, d, mu_f = cloud.of(p).measure(
            np.arange(p.size), "J", "stresslet", lambda c: np.stack(dev(sym(c.l_f)), axis=1), lambda c: c.mu
        )
        volume, d = 4.0 / 3.0 * math.pi * p.R**3 * J, d[:, [0, 4, 8, 1, 5, 2]]
        total += np.column_stack([volume, S]).sum(axis=0)
        added += (weight * S * d).sum()
        # Over one viscosity, which is that of all where it is constant.
        mu = mu or float(mu_f.max(initial=0.0))
        dissipated += ((mu_f / mu * volume)[:, None] * weight * d * d).sum()
    with np.errstate(invalid="ignore"):
        stress = total[1:] / total[0]
        viscosity = added / (2.0 * mu * np.float64(dissipated))
    return [number, float(total[0]), *map(float, stress), float(viscosity)]
