"""Particles that cross a plane."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np

from foamprb.body.quadratic import bullet_amplitude
from foamprb.cloud.measures import shapes
from foamprb.cloudfunctions.base import Memory, ObservedCloud, append, columns, masses, names_of, table
from foamprb.cloudfunctions.crossings import PlaneFunction, unit
from foamprb.dictionary.constraints import Meaning, Only, Positive, Vector3
from foamprb.results.tables import write_table


@dataclass(frozen=True)
class ParticleCollector(PlaneFunction):
    """Number and mass of the particles that cross a plane: ``collector.csv``; each in ``crossings.csv``.

    A crossing is a change of sides in a time step of the particle. Its place and time follow from the cubic
    through the positions and velocities at both ends, the path of the step itself.
    """

    mode: Annotated[Literal["plane"], Meaning("the only one")]
    origin: Annotated[Vector3, Meaning("a point of the plane", "m")]
    normal: Annotated[Vector3, Meaning("its normal, of any length", "1")]
    radius: Annotated[
        float | None, Positive, Meaning("only the disc about `origin`", "m", "the whole plane")
    ] = None
    negateParcelsOppositeNormal: Annotated[
        bool, Meaning("subtract the mass that goes against the normal")
    ] = False
    removeCollected: Annotated[bool, Only(False, "the particles go on")] = False
    resetOnWrite: Annotated[bool, Meaning("reset the counts at each write time")] = False

    arrays: ClassVar = {**PlaneFunction.arrays, "written": table, "history": table}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return empty tables."""
        written = np.zeros(1, dtype=np.int64)
        return {**super().initial(cloud), "written": written, "history": np.empty((0, 6))}

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write both tables, with the crossings since the last writing."""
        p, t, x, sense = self.crossings(memory, cloud)
        D, mass, injector = shapes(p)[1], masses(p, np.arange(p.size)), p.injector
        if self.radius is not None:
            e = unit(self.normal)
            aside = x - self.origin - ((x - self.origin) @ e)[:, None] * e
            within = np.linalg.norm(aside, axis=1) <= self.radius
            p, t, x, sense = p.take(within), t[within], x[within], sense[within]
            D, mass, injector = D[within], mass[within], injector[within]
        names = names_of(cloud.names["injector"], injector)
        mode = {"bulletAmplitude": bullet_amplitude(tuple(p.B.T))} if cloud.cloud.models.has_quadratic else {}
        write_table(
            folder / "crossings.csv",
            {"id": p.number, "injector": names, "t": t, **columns("xyz", x),
             "direction": sense.astype(np.int64), "D": D, "mass": mass, **mode},
        )  # fmt: skip
        fresh = np.arange(p.size) >= memory["written"][0]
        counted = fresh if self.resetOnWrite else np.ones(p.size, dtype=bool)
        weight = mass * np.where(sense < 0.0, -1.0, 1.0) if self.negateParcelsOppositeNormal else mass
        before = memory["history"][-1, 0] if len(memory["history"]) else cloud.cloud.start
        lines = []
        for index in range(len(cloud.names["injector"])):
            of_model = injector == index
            n = [np.count_nonzero(of_model & counted & (sense * side > 0.0)) for side in (1.0, -1.0)]
            rate = weight[of_model & fresh].sum() / max(cloud.time - before, 1e-300)
            lines.append([cloud.time, index, *n, weight[of_model & counted].sum(), rate])
        memory["written"][0] = p.size
        time, index, along, against, total, rate = append(memory, "history", lines).T
        write_table(
            folder / "collector.csv",
            {"time": time, "injector": names_of(cloud.names["injector"], index),
             "parcels": along.astype(np.int64), "parcelsOpposite": against.astype(np.int64),
             "mass": total, "massFlowRate": rate},
        )  # fmt: skip
