"""Paths of particles, for ParaView."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, ClassVar

import numpy as np
from numpy.typing import NDArray

from foamprb.body.viscosity import shear_rate
from foamprb.cloud.measures import MEASURES, fields_at, shapes
from foamprb.cloud.paths import Steps, step
from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    PathFunction,
    Rows,
    per_event,
    per_particle,
)
from foamprb.dictionary.constraints import AtLeastOne, Meaning
from foamprb.flow.fields import FieldValues, columns_of, field_of

Floats = NDArray[np.float64]

_TRACKED = ("semiAxes", "taylorDeformation", "shearRate")
# The sampled fields follow.
_POINT = ("id", "t", "x", "y", "z", "Ux", "Uy", "Uz", "a", "b", "c", "D", "shearRate", "begins")
_ROUND_OFF = 1e-6


@dataclass(frozen=True)
class ParticleTracks(PathFunction):
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

    arrays: ClassVar = {**PathFunction.arrays, "begun": per_particle, "points": per_event}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return paths without points."""
        width = sum(c.components for c in columns_of(cloud.cloud.flow) if c.name == field_of(c.name))
        points = np.empty((0, len(_POINT) + width))
        return {"begun": np.zeros(cloud.particles.size, dtype=bool), "points": points}

    def watches(self, numbers: Rows, n: int) -> NDArray[np.bool_]:
        """Return which particles have a path."""
        return np.isin(numbers, _tracked(n, self.maxTracks))

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return frozenset({"v0", "v1", "F0", "F1", "Q0", "A0", "l0", "l1"})

    def add(self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]) -> Floats:
        """Return the points of the steps of these particles."""
        # The other lanes of a block are recorded, too.
        steps = steps.take(fresh & self.watches(steps.number, cloud.cloud.size))
        first = np.zeros(steps.n, dtype=bool)
        first[np.unique(steps.row, return_index=True)[1]] = True
        first &= ~memory["begun"][steps.row]
        memory["begun"][steps.row] = True
        passed, last = steps.of(step.passed) > 0.0, steps.ended | (steps.hosts[1] < 0)
        (t0, t1), tracker = steps.t, cloud.cloud.tracker
        begun, done = (self._number(t, tracker) for t in (t0, t1))
        count = done - begun
        inner = np.repeat(np.arange(steps.n), count)
        within = np.arange(len(inner)) - np.repeat(np.cumsum(count) - count, count)
        t = tracker.start + (begun[inner] + 1 + within) * (self.trackInterval * tracker.dt)
        at = np.minimum((t - t0[inner]) / (t1 - t0)[inner], 1.0)
        last &= (done == begun) | (t1 > tracker.start + done * (self.trackInterval * tracker.dt))
        which = np.concatenate([np.flatnonzero(first | passed), inner, np.flatnonzero(last)])
        share = np.concatenate([np.zeros(np.count_nonzero(first | passed)), at, np.ones(last.sum())])
        order = np.lexsort((share, which))
        which, share = which[order], share[order]
        begins = passed[which] & (share == 0.0)
        return _points(cloud, steps.take(which), share, begins)

    def _number(self, t: Floats, tracker: Any) -> NDArray[np.int64]:
        """Return the number of the last point at times t, s, to round-off."""
        steps = (t - tracker.start) / tracker.dt
        return np.asarray(np.floor((steps + _ROUND_OFF) / self.trackInterval), dtype=np.int64)

    def _up_to_now(self, memory: Memory, cloud: ObservedCloud) -> Floats:
        """Return all points, path after path, with those of the present time of the particles that move.

        A path with one point is none.
        """
        p, points = cloud.particles, memory["points"]
        latest = np.full(p.size, -np.inf)
        np.maximum.at(latest, np.searchsorted(p.number, points[:, 0].astype(np.int64)), points[:, 1])
        rows = np.flatnonzero((p.status == Status.ACTIVE) & np.isfinite(latest) & (latest < p.t))
        fields = fields_at(cloud.cloud.flow, p.x[rows], p.host[rows], cloud.time)
        point = [p.number[rows], p.t[rows], p.x[rows], p.v[rows], *cloud.measure(rows, *_TRACKED)]
        now = np.column_stack([*point, np.zeros(len(rows)), *(f.values for f in fields.values())])
        points = np.concatenate([points, now])
        points = points[np.lexsort((points[:, 1], points[:, 0]))]
        order = np.arange(len(points)) - np.searchsorted(points[:, 0], points[:, 0])
        memory["points"] = points = points[order < self.maxSamples]
        _, path, count = np.unique(points[:, 0], return_inverse=True, return_counts=True)
        return np.asarray(points[count[path] > 1])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the paths of the particles that have moved."""
        from foamprb.results.vtk import Tracks, write_tracks

        numbers = _tracked(cloud.cloud.size + cloud.cloud.late, self.maxTracks)
        numbers = numbers[numbers < cloud.cloud.size]
        cloud = cloud.of(numbers)
        p = cloud.particles
        points = self._up_to_now(memory, cloud)
        fields = fields_at(cloud.cloud.flow, p.x[:0], p.host[:0], cloud.time)
        start = np.flatnonzero(np.diff(points[:, 0], prepend=-1.0) + points[:, 13]).astype(np.int64)
        rows = np.searchsorted(numbers, points[start, 0])
        points = points[:, 1:]
        ends = len(_POINT) - 1 + np.cumsum([f.values.shape[1] for f in fields.values()], dtype=int)
        values = {
            name: FieldValues(points[:, end - f.values.shape[1] : end], f.unit).array
            for (name, f), end in zip(fields.items(), ends, strict=True)
        }
        write_tracks(
            folder / "tracks.vtp",
            Tracks(
                points[:, 1:4].copy(),
                np.append(start, len(points)),
                {"time": points[:, 0], "U": points[:, 4:7], "semiAxes": points[:, 7:10],
                 "taylorDeformation": points[:, 10], "shearRate": points[:, 11], **values},
                {"origId": numbers[rows], "d": 2.0 * p.R[rows], "Ca": p.Ca[rows],
                 "injector": p.injector[rows], "status": p.status[rows], "patch": p.patch[rows]},
                {"time": "s", "d": "m", "Ca": "1"} | {n: MEASURES[n].unit for n in ("U", *_TRACKED)}
                | {name: f.unit for name, f in fields.items()},
                {"status": STATUS_NAMES, **cloud.names},
            ),
        )  # fmt: skip


def _tracked(n: int, most: int) -> Rows:
    """Return the numbers of the particles of n that have a path."""
    tracks = min(n, most)
    return np.arange(tracks) * n // max(tracks, 1)


def _points(cloud: ObservedCloud, steps: Steps, share: Floats, begins: NDArray[np.bool_]) -> Floats:
    """Return points of paths, each after a share of its step; ``begins`` marks those of a further path."""
    (t0, t1), (l0, l1), (x0, x1) = steps.t, steps.both("l"), steps.x
    x, v, F = steps.between(share)
    p = cloud.particles.take(steps.row)._replace(F=F, Q=np.ascontiguousarray(steps.both("Q")[0]))
    flow, s = cloud.cloud.flow, share[:, None]
    first, last = (
        fields_at(flow, place, hosts, t)
        for place, hosts, t in zip((x0, x1), steps.hosts, (t0, t1), strict=True)
    )
    fields = [_between(first[name].values, last[name].values, s) for name in first]
    axes, D = shapes(p)
    rate = shear_rate(tuple(_between(l0, l1, s).T))
    point = [p.number, t0 + share * (t1 - t0), x, v]
    return np.column_stack([*point, axes, D, rate, begins, *fields])


def _between(a: Floats, b: Floats, s: Floats) -> Floats:
    """Return values between those at both ends of steps, or the one that is known."""
    return np.where(np.isnan(b), a, np.where(np.isnan(a), b, (1.0 - s) * a + s * b))
