"""Particles that cross a plane."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal

import numpy as np

from foamprb.cloudfunctions.base import (
    Memory,
    ObservedCloud,
    Rows,
    SampleInterval,
    append,
    masses,
    names_of,
    per_event,
    table,
    taylor_of,
)
from foamprb.cloudfunctions.crossings import PlaneFunction, crossings, unit
from foamprb.dictionary.constraints import Meaning, Only, Positive, Vector3
from foamprb.results.tables import write_table

__all__ = ["ParticleCollector"]


@dataclass(frozen=True)
class ParticleCollector(PlaneFunction):
    """Number and mass of the particles that cross a plane: ``collector.csv``; each in ``crossings.csv``.

    A crossing is a change of sides between two samples. Its place and time follow from the cubic through the
    positions and velocities at both. The error is of fourth order in the time between samples where the path
    is smooth. Particles that cross and return between two samples are not counted.
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
    sampleInterval: SampleInterval = 10

    arrays: ClassVar = {**PlaneFunction.arrays, "crossings": per_event, "written": table, "history": table}

    def initial(self, cloud: ObservedCloud) -> Memory:  # noqa: ARG002
        """Return empty tables."""
        written = np.zeros(1, dtype=np.int64)
        return {"crossings": np.empty((0, 8)), "written": written, "history": np.empty((0, 6))}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:
        """Add the particles that have changed sides since the last sample."""
        p = cloud.particles
        e = unit(self.normal)
        crossed = crossings(memory, now, rows, np.array(self.origin), e)
        at, x = crossed.rows, crossed.x
        before, after = (taylor_of(cloud, at, F) for F in (memory["F"][at], now["F"][crossed.among]))
        D = before + crossed.share * (after - before)
        new = np.column_stack([p.number[at], crossed.time, x, crossed.sense, D, masses(p, at)])
        if self.radius is not None:
            aside = x - self.origin - ((x - self.origin) @ e)[:, None] * e
            new = new[np.linalg.norm(aside, axis=1) <= self.radius]
        append(memory, "crossings", new[np.argsort(new[:, 1], kind="stable")])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write both tables, with the crossings since the last writing."""
        crossings = memory["crossings"]
        id_, t, x, y, z, sense, D, mass = crossings.T
        rows = id_.astype(np.int64)
        injector = cloud.cloud.values_of(rows, "injector")
        names = names_of(cloud.names["injector"], injector)
        write_table(
            folder / "crossings.csv",
            {"id": rows, "injector": names, "t": t, "x": x, "y": y, "z": z,
             "direction": sense.astype(np.int64), "D": D, "mass": mass},
        )  # fmt: skip
        fresh = np.arange(len(crossings)) >= memory["written"][0]
        counted = fresh if self.resetOnWrite else np.ones(len(crossings), dtype=bool)
        weight = mass * np.where(sense < 0.0, -1.0, 1.0) if self.negateParcelsOppositeNormal else mass
        before = memory["history"][-1, 0] if len(memory["history"]) else cloud.cloud.start
        lines = []
        for index in range(len(cloud.names["injector"])):
            of_model = injector == index
            n = [np.count_nonzero(of_model & counted & (sense * side > 0.0)) for side in (1.0, -1.0)]
            rate = weight[of_model & fresh].sum() / max(cloud.time - before, 1e-300)
            lines.append([cloud.time, index, *n, weight[of_model & counted].sum(), rate])
        memory["written"][0] = len(crossings)
        time, index, along, against, total, rate = append(memory, "history", lines).T
        write_table(
            folder / "collector.csv",
            {"time": time, "injector": names_of(cloud.names["injector"], index),
             "parcels": along.astype(np.int64), "parcelsOpposite": against.astype(np.int64),
             "mass": total, "massFlowRate": rate},
        )  # fmt: skip
