"""Paths of particles, for ParaView."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.measures import MEASURES
from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    CloudFunction,
    ContactObserver,
    Memory,
    ObservedCloud,
    Rows,
    fields_at_release,
    fields_of,
    has_ended,
    map_where_they_move,
    passages,
    table,
)
from foamprb.dictionary.constraints import AtLeastOne, Meaning
from foamprb.flow.fields import FieldValues

__all__ = ["ParticleTracks"]

_TRACKED = ("semiAxes", "taylorDeformation", "shearRate")
# The sampled fields follow.
_POINT = ("x", "y", "z", "t", "Ux", "Uy", "Uz", "a", "b", "c", "D", "shearRate", "begins")


@dataclass(frozen=True)
class ParticleTracks(CloudFunction, ContactObserver):
    """Paths of particles, with velocity, semi-axes, D and shear rate at their points: ``tracks.vtp``.

    The fields of ``fieldSampling`` are added.

    A path begins at the release, has a point every ``trackInterval`` steps and at the write times, and ends
    with the particle. It has at most ``maxSamples`` points. At most ``maxTracks`` particles are tracked,
    evenly spread over their numbers. At a coupled patch a path ends, and a further one of the same particle
    begins at the neighbour.
    """

    trackInterval: Annotated[int, AtLeastOne, Meaning("steps between two points")]
    maxSamples: Annotated[int, AtLeastOne, Meaning("largest number of points of a path, which then ends")]
    maxTracks: Annotated[
        int, AtLeastOne, Meaning("largest number of paths, evenly spread over the particles")
    ] = 1000

    arrays: ClassVar = dict.fromkeys(("row", "host", "closed", "count", "points"), table)

    @property
    def interval(self) -> int:
        """Steps between two points."""
        return self.trackInterval

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return paths with one point each, the place of release."""
        n = cloud.cloud.size
        tracks = min(n, self.maxTracks)
        rows = np.arange(tracks) * n // max(tracks, 1)
        tracked = cloud.of(rows)
        points = _points(tracked, np.arange(tracks), fields_of(tracked, np.arange(tracks)))
        memory = {
            "row": rows,
            "host": tracked.particles.host.copy(),
            "closed": np.zeros(tracks, dtype=bool),
            "count": np.zeros(tracks, dtype=np.int64),
            "points": np.zeros((tracks, min(self.maxSamples, 16), points.shape[1])),
        }
        self._append(memory, np.arange(tracks), points)
        return memory

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Add the points before and after each passage of a coupled patch."""
        tracked = rows[np.isin(rows[:, 0], memory["row"])]
        for passage in passages(cloud, tracked):
            for met, begins in zip(passage, (0.0, 1.0), strict=True):
                p = cloud.of(met.number).particles._replace(F=met.F)
                axes, D = cloud.of(p).measure(np.arange(p.size), *_TRACKED[:2])
                tracks = np.searchsorted(memory["row"], met.number)
                # The flow may have changed since: shear rate and fields are those of the point before.
                last = memory["points"][tracks, memory["count"][tracks] - 1]
                at_start = np.full(p.size, begins)
                points = [met.x, met.t, met.v, axes, D, last[:, 11], at_start, last[:, len(_POINT) :]]
                self._append(memory, tracks, np.column_stack(points))

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add a point to the path of every particle that has moved since."""
        open_ = memory["row"][~memory["closed"]]
        parts = map_where_they_move(cloud, open_, _released)
        number, ended, points = map(np.concatenate, zip(*parts, strict=True))
        tracks = np.searchsorted(memory["row"], number)
        memory["closed"][tracks] = ended
        last = memory["points"][tracks, memory["count"][tracks] - 1, 3]
        moved = np.flatnonzero(points[:, 3] > last)
        tracks, points, ended = tracks[moved], points[moved], np.flatnonzero(ended[moved])
        first = tracks[memory["count"][tracks] == 1]
        if points.shape[1] > len(_POINT) and len(first):
            observed = cloud.of(memory["row"][first])
            fields = fields_at_release(observed, np.arange(len(first)), memory["host"][first])
            memory["points"][first, 0, len(_POINT) :] = _values(fields, len(first))
        if points.shape[1] > len(_POINT) and len(ended):
            observed = cloud.of(memory["row"][tracks[ended]])
            points[ended, len(_POINT) :] = _values(fields_of(observed, np.arange(len(ended))), len(ended))
        self._append(memory, tracks, points)

    def _append(self, memory: Memory, tracks: Rows, points: NDArray[np.float64]) -> None:
        fits = memory["count"][tracks] < self.maxSamples
        tracks, points = tracks[fits], points[fits]
        at = memory["count"][tracks]
        room = memory["points"].shape[1]
        if len(at) and at.max() >= room:
            more = np.zeros_like(memory["points"][:, : self.maxSamples - room])
            memory["points"] = np.concatenate([memory["points"], more], axis=1)
        memory["points"][tracks, at] = points
        memory["count"][tracks] += 1

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the paths of the particles that have moved."""
        from foamprb.results.vtk import Tracks, write_tracks

        cloud = cloud.of(memory["row"])
        p = cloud.particles
        tracks = np.flatnonzero((memory["count"] > 1) & (p.status != Status.PENDING))
        count = memory["count"][tracks]
        filled = np.arange(memory["points"].shape[1]) < count[:, None]
        points = memory["points"][tracks][filled]
        first = np.cumsum(count) - count
        start = np.union1d(first, np.flatnonzero(points[:, 12])).astype(np.int64)
        rows = tracks[np.searchsorted(first, start, side="right") - 1]
        fields = fields_of(cloud, rows[:0])
        ends = len(_POINT) + np.cumsum([f.values.shape[1] for f in fields.values()], dtype=int)
        values = {
            name: FieldValues(points[:, end - f.values.shape[1] : end], f.unit).array
            for (name, f), end in zip(fields.items(), ends, strict=True)
        }
        write_tracks(
            folder / "tracks.vtp",
            Tracks(
                points[:, :3].copy(),
                np.append(start, len(points)),
                {"time": points[:, 3], "U": points[:, 4:7], "semiAxes": points[:, 7:10],
                 "taylorDeformation": points[:, 10], "shearRate": points[:, 11], **values},
                {"origId": memory["row"][rows], "d": 2.0 * p.R[rows], "Ca": p.Ca[rows],
                 "injector": p.injector[rows], "status": p.status[rows], "patch": p.patch[rows]},
                {"time": "s", "d": "m", "Ca": "1"} | {n: MEASURES[n].unit for n in ("U", *_TRACKED)}
                | {name: f.unit for name, f in fields.items()},
                {"status": STATUS_NAMES, **cloud.names},
            ),
        )  # fmt: skip


def _released(cloud: ObservedCloud) -> tuple[Rows, NDArray[np.bool_], NDArray[np.float64]]:
    """Return the numbers of released particles, whether they have ended, and their points of paths.

    The fields are unknown where they have ended: the flow of that time may not be loaded.
    """
    p = cloud.particles
    rows, ended = np.flatnonzero(p.status != Status.PENDING), has_ended(cloud, slice(None))
    moving = cloud.of(p._replace(host=np.where(ended, -1, p.host).astype(p.host.dtype)))
    return p.number[rows], ended[rows], _points(cloud, rows, fields_of(moving, rows))


def _points(cloud: ObservedCloud, rows: Rows, fields: Mapping[str, FieldValues]) -> NDArray[np.float64]:
    """Return points of paths of particles."""
    p = cloud.particles
    point = [p.x[rows], p.t[rows], p.v[rows], *cloud.measure(rows, *_TRACKED), np.zeros(len(rows))]
    return np.column_stack([*point, _values(fields, len(rows))])


def _values(fields: Mapping[str, FieldValues], n: int) -> NDArray[np.float64]:
    """Return the values of fields at n points side by side."""
    return np.concatenate([np.empty((n, 0)), *(f.values for f in fields.values())], axis=1)
