"""What a run observes of its cloud on the way: OpenFOAM's ``cloudFunctions``, with its structure.

A function is a frozen dataclass of its entries with three methods. What it remembers is a dict of arrays
that belongs to the run, so that a checkpoint can save it as it is. A new function is one such class and one
line in :data:`FUNCTIONS`.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Any, Literal, Protocol, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import dev, sym
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import MEASURES, PER_CONTEXT, Context, contexts
from foamprb.cloud.patches import REBOUND
from foamprb.cloud.state import Particles, Status
from foamprb.dictionary.constraints import AtLeastOne, Only, Positive, Vector3, Words
from foamprb.errors import InputError, suggestion
from foamprb.output.tables import Column, write_table
from foamprb.output.vtk import Tracks, write_tracks

Floats = NDArray[np.float64]
Rows = NDArray[np.int64]
Memory: TypeAlias = dict[str, NDArray[Any]]
STATUS_NAMES = tuple(status.name.lower() for status in Status)


@dataclass(frozen=True)
class Look:
    """The cloud at one moment, as a function sees it; and the names of injection models and patches."""

    cloud: Cloud
    injectors: tuple[str, ...]
    patches: tuple[str, ...]

    @property
    def particles(self) -> Particles:
        """The whole cloud, the pending included."""
        return self.cloud.particles

    @property
    def time(self) -> float:
        """Time to which the cloud has come, s."""
        return self.cloud.time

    def contexts(self, rows: Rows) -> Iterator[Context]:
        """What the measures of :mod:`foamprb.cloud.measures` need of particles, whatever their status.

        As :func:`foamprb.cloud.measures.contexts`, a few at a time.
        """
        for start in range(0, max(len(rows), 1), PER_CONTEXT):
            p = self.particles.take(rows[start : start + PER_CONTEXT])
            p.status[:] = Status.ACTIVE
            yield from contexts(p, self.cloud.flow, self.cloud.medium.mu, self.time)

    def collect(self, rows: Rows, *values: Callable[[Context], NDArray[Any]]) -> list[NDArray[Any]]:
        """Values of particles, whatever their status."""
        parts = [[np.array(value(c)) for value in values] for c in self.contexts(rows)]
        return [np.concatenate(arrays) for arrays in zip(*parts, strict=True)]

    def measure(self, rows: Rows, *names: str) -> list[NDArray[Any]]:
        """Some of :data:`foamprb.cloud.measures.MEASURES` of particles, whatever their status."""
        return self.collect(rows, *(MEASURES[name].value for name in names))


class CloudFunction(Protocol):
    """Something that is observed while the cloud moves.

    Between two looks a particle goes unobserved; where it ended, and when, is exact all the same.
    """

    @property
    def interval(self) -> int:
        """Tracking steps between two looks; 0 if the write times are enough."""

    def begin(self, look: Look) -> Memory:
        """What is remembered at the start; InputError if the cloud does not have what the entries name."""

    def see(self, memory: Memory, look: Look) -> None:
        """Look at the cloud, at every ``interval``-th step and before each writing."""

    def write(self, memory: Memory, look: Look, folder: Path) -> None:
        """Write what was seen into a folder of its own, at each write time."""


class Functions:
    """The functions of a run, and what they remember.

    Parameters
    ----------
    functions
        By their names.
    look
        The cloud at the start.

    Raises
    ------
    InputError
        If a function asks for what the cloud does not have.
    """

    def __init__(self, functions: Mapping[str, CloudFunction], look: Look) -> None:
        self.functions = dict(functions)
        self._look = look
        self._memory: dict[str, Memory] = {}
        for name, function in self.functions.items():
            try:
                self._memory[name] = function.begin(look)
            except InputError as error:
                raise InputError(f"cloudFunctions/{name}: {error}") from error

    def next_look(self, last: int) -> int:
        """The step, at most ``last``, up to which the cloud may advance unobserved."""
        step = self._look.cloud.step
        return min([last, *((step // n + 1) * n for f in self.functions.values() if (n := f.interval) > 0)])

    def see(self) -> None:
        """Let those functions look whose time has come."""
        step = self._look.cloud.step
        for name, function in self.functions.items():
            if function.interval and step % function.interval == 0:
                self._look.cloud.gather()
                function.see(self._memory[name], self._look)

    def write(self, folder: Path) -> None:
        """Let every function look, and write into a folder of its name."""
        self._look.cloud.gather()
        for name, function in self.functions.items():
            function.see(self._memory[name], self._look)
            function.write(self._memory[name], self._look, folder / name)

    def state(self) -> Memory:
        """All that is remembered, by ``function/array``."""
        return {f"{name}/{key}": array for name, m in self._memory.items() for key, array in m.items()}

    def restore(self, state: Mapping[str, NDArray[Any]]) -> None:
        """Take over what :meth:`state` gave in an earlier run.

        Raises
        ------
        InputError
            If it was that of other functions.
        """
        expected, found = sorted(self.state()), sorted(state)
        if expected != found:
            changed = ", ".join(sorted({key.split("/")[0] for key in {*expected} ^ {*found}}))
            raise InputError(f"cloudFunctions: {changed} was not observed from the start, or no longer is.")
        for name, memory in self._memory.items():
            memory.update({key: state[f"{name}/{key}"].copy() for key in memory})


# ---------------------------------------------------------------------------------------------------------
# Functions


@dataclass(frozen=True)
class ParticleTracks:
    """The paths of particles, a polyline each: ``tracks.vtp``.

    A path begins where the particle is released, has a point every ``trackInterval`` steps and at the write
    times, and ends where the particle does. One that has ``maxSamples`` points grows no more. Of more than
    ``maxTracks`` particles that many are followed, evenly spread over their numbers.
    """

    trackInterval: Annotated[int, AtLeastOne]
    maxSamples: Annotated[int, AtLeastOne]
    maxTracks: Annotated[int, AtLeastOne] = 1000

    @property
    def interval(self) -> int:
        """Steps between two points."""
        return self.trackInterval

    def begin(self, look: Look) -> Memory:
        """Remember the places of release."""
        n = look.particles.size
        tracks = min(n, self.maxTracks)
        memory = {
            "row": np.arange(tracks) * n // max(tracks, 1),
            "closed": np.zeros(tracks, dtype=bool),
            "count": np.zeros(tracks, dtype=np.int64),
            "points": np.zeros((tracks, min(self.maxSamples, 16), len(_POINT))),
        }
        self._append(memory, look, np.arange(tracks))
        return memory

    def see(self, memory: Memory, look: Look) -> None:
        """Add a point to the path of every particle that has moved since."""
        status = look.particles.status[memory["row"]]
        last = memory["points"][np.arange(len(status)), memory["count"] - 1, 3]
        moved = look.particles.t[memory["row"]] > last
        tracks = np.flatnonzero(~memory["closed"] & (status != Status.PENDING) & moved)
        self._append(memory, look, tracks[memory["count"][tracks] < self.maxSamples])
        memory["closed"] |= status > Status.ACTIVE

    def _append(self, memory: Memory, look: Look, tracks: Rows) -> None:
        at = memory["count"][tracks]
        room = memory["points"].shape[1]
        if len(at) and at.max() >= room:
            more = np.zeros((len(memory["row"]), min(room, self.maxSamples - room), len(_POINT)))
            memory["points"] = np.concatenate([memory["points"], more], axis=1)
        p, rows = look.particles, memory["row"][tracks]
        point = [p.x[rows], p.t[rows], p.v[rows], *look.measure(rows, *_TRACKED)]
        memory["points"][tracks, at] = np.column_stack(point)
        memory["count"][tracks] += 1

    def write(self, memory: Memory, look: Look, folder: Path) -> None:
        """Write the paths of the particles that have moved."""
        p = look.particles
        tracks = np.flatnonzero((memory["count"] > 1) & (p.status[memory["row"]] != Status.PENDING))
        count, rows = memory["count"][tracks], memory["row"][tracks]
        filled = np.arange(memory["points"].shape[1]) < count[:, None]
        points = memory["points"][tracks][filled]
        write_tracks(
            folder / "tracks.vtp",
            Tracks(
                points[:, :3].copy(),
                np.concatenate([[0], np.cumsum(count)]),
                {"time": points[:, 3], "U": points[:, 4:7], "semiAxes": points[:, 7:10],
                 "taylorDeformation": points[:, 10], "shearRate": points[:, 11]},
                {"origId": rows, "d": 2.0 * p.R[rows], "Ca": p.Ca[rows], "injector": p.injector[rows],
                 "status": p.status[rows], "patch": p.patch[rows]},
                {"time": "s", "d": "m", "Ca": "1"} | {n: MEASURES[n].unit for n in ("U", *_TRACKED)},
                {"status": STATUS_NAMES, "patch": look.patches, "injector": look.injectors},
            ),
        )  # fmt: skip


_TRACKED = ("semiAxes", "taylorDeformation", "shearRate")
_POINT = ("x", "y", "z", "t", "Ux", "Uy", "Uz", "a", "b", "c", "D", "shearRate")


@dataclass(frozen=True)
class PatchPostProcessing:
    """Who sticks to a patch or leaves through it, when, where and in what shape: ``<patch>.csv``.

    ``impactAngle`` is the angle between the velocity and the normal out of the fluid, ``axisAngle`` that
    between the longest axis and the normal, both in degrees. A rebound is not an end, and is not seen.
    """

    patches: Words
    maxStoredParcels: Annotated[int, AtLeastOne] | None = None

    @property
    def interval(self) -> int:
        """What has ended stays as it is."""
        return 0

    def begin(self, look: Look) -> Memory:
        """Check the names.

        Raises
        ------
        InputError
            If there is no such patch, or particles bounce off it.
        """
        for name in self.patches:
            if name not in look.patches:
                raise InputError(f"patch {name} is not in the mesh. {suggestion(name, look.patches)}")
            if look.cloud.interactions[look.patches.index(name)].code == REBOUND:
                raise InputError(f"patch {name}: particles bounce off it, but only those that stick or "
                                 "escape are seen.")  # fmt: skip
        return {}

    def see(self, memory: Memory, look: Look) -> None:
        """Nothing is remembered."""

    def write(self, memory: Memory, look: Look, folder: Path) -> None:  # noqa: ARG002
        """Write a table for each patch, in the order of time."""
        p = look.particles
        for name in self.patches:
            ended = (p.status == Status.STUCK) | (p.status == Status.ESCAPED)
            rows = np.flatnonzero(ended & (p.patch == look.patches.index(name)))
            rows = rows[np.argsort(p.t[rows], kind="stable")][: self.maxStoredParcels]
            axes, D, longest = look.collect(
                rows,
                MEASURES["semiAxes"].value,
                MEASURES["taylorDeformation"].value,
                lambda c: np.stack(c.frame[:3], axis=1),
            )
            n = look.cloud.contact_normals(rows)
            write_table(
                folder / f"{name}.csv",
                {
                    "id": rows, "injector": _names(look.injectors, p.injector[rows]),
                    "fate": _names(STATUS_NAMES, p.status[rows]), "t": p.t[rows],
                    **_columns("xyz", p.x[rows]), **_columns(("Ux", "Uy", "Uz"), p.v[rows]),
                    "d": 2.0 * p.R[rows], "mass": _mass(p, rows), "Ca": p.Ca[rows],
                    **_columns("abc", axes), "D": D,
                    "impactAngle": _angle(p.v[rows], -n), "axisAngle": _axis_angle(longest, n),
                },
            )  # fmt: skip


@dataclass(frozen=True)
class ParticleCollector:
    """How many particles cross a plane, and their mass: ``collector.csv``, and ``crossings.csv`` one by one.

    A crossing is seen when a particle changes sides between two looks. Where and when follows from the cubic
    through the positions and velocities at both: an error of fourth order in the time between looks where
    the path is smooth. A particle that crosses and comes back between two looks goes unseen.
    """

    mode: Literal["plane"]
    origin: Vector3
    normal: Vector3
    radius: Annotated[float, Positive] | None = None
    negateParcelsOppositeNormal: bool = False
    removeCollected: Annotated[bool, Only(False, "the particles go on")] = False
    resetOnWrite: bool = False
    sampleInterval: Annotated[int, AtLeastOne] = 10

    def __post_init__(self) -> None:
        if not any(self.normal):
            raise InputError("has a normal (0 0 0)")

    @property
    def interval(self) -> int:
        """Steps between two looks."""
        return self.sampleInterval

    def begin(self, look: Look) -> Memory:
        """Remember where everybody starts."""
        p = look.particles
        return {
            "closed": np.zeros(p.size, dtype=bool),
            "x": p.x.copy(),
            "v": p.v.copy(),
            "t": p.t.copy(),
            "D": look.measure(np.arange(p.size), "taylorDeformation")[0],
            "crossings": np.empty((0, 8)),
            "written": np.zeros(1, dtype=np.int64),
            "history": np.empty((0, 6)),
        }

    def see(self, memory: Memory, look: Look) -> None:
        """Note who has changed sides."""
        p = look.particles
        rows = _open(memory, p)
        e = np.array(self.normal) / math.hypot(*self.normal)
        heights = [(x - self.origin) @ e for x in (memory["x"][rows], p.x[rows])]
        crossed = (heights[0] < 0.0) != (heights[1] < 0.0)
        at = rows[crossed]
        (D,) = look.measure(rows, "taylorDeformation")
        h = p.t[at] - memory["t"][at]
        ends = [(memory["x"][at], h[:, None] * memory["v"][at]), (p.x[at], h[:, None] * p.v[at])]
        s = _root(*((x - self.origin) @ e for x in (ends[0][0], ends[1][0])), *(v @ e for _, v in ends))
        x = _hermite(s[:, None], ends[0][0], ends[1][0], ends[0][1], ends[1][1])
        sense = np.where(heights[1][crossed] < 0.0, -1.0, 1.0)
        D_there = memory["D"][at] + s * (D[crossed] - memory["D"][at])
        new = np.column_stack([at, memory["t"][at] + s * h, x, sense, D_there, _mass(p, at)])
        if self.radius is not None:
            aside = x - self.origin - ((x - self.origin) @ e)[:, None] * e
            new = new[np.linalg.norm(aside, axis=1) <= self.radius]
        memory["crossings"] = np.concatenate([memory["crossings"], new[np.argsort(new[:, 1], kind="stable")]])
        memory["x"][rows], memory["v"][rows], memory["t"][rows] = p.x[rows], p.v[rows], p.t[rows]
        memory["D"][rows] = D
        _close(memory, p, rows)

    def write(self, memory: Memory, look: Look, folder: Path) -> None:
        """Add what has crossed since the last writing to the tables."""
        every = memory["crossings"]
        id_, t, x, y, z, sense, D, mass = every.T
        rows = id_.astype(np.int64)
        injector = look.particles.injector[rows]
        names = _names(look.injectors, injector)
        write_table(
            folder / "crossings.csv",
            {"id": rows, "injector": names, "t": t, "x": x, "y": y, "z": z,
             "direction": sense.astype(np.int64), "D": D, "mass": mass},
        )  # fmt: skip
        fresh = np.arange(len(every)) >= memory["written"][0]
        counted = fresh if self.resetOnWrite else np.ones(len(every), dtype=bool)
        weight = mass * np.where(sense < 0.0, -1.0, 1.0) if self.negateParcelsOppositeNormal else mass
        before = memory["history"][-1, 0] if len(memory["history"]) else look.cloud.start
        lines = []
        for index in range(len(look.injectors)):
            own = injector == index
            n = [np.count_nonzero(own & counted & (sense * side > 0.0)) for side in (1.0, -1.0)]
            rate = weight[own & fresh].sum() / max(look.time - before, 1e-300)
            lines.append([look.time, index, *n, weight[own & counted].sum(), rate])
        memory["history"] = np.concatenate([memory["history"], np.reshape(lines, (-1, 6))])
        memory["written"][0] = len(every)
        time, index, along, against, total, rate = memory["history"].T
        write_table(
            folder / "collector.csv",
            {"time": time, "injector": _names(look.injectors, index.astype(np.int64)),
             "parcels": along.astype(np.int64), "parcelsOpposite": against.astype(np.int64),
             "mass": total, "massFlowRate": rate},
        )  # fmt: skip


@dataclass(frozen=True)
class ParticleHistogram:
    """What each particle has been through, ``exposure.csv``, and how it is spread, ``<field>.csv``.

    ``residenceTime``, s; ``maxDeformation`` and ``meanDeformation``, Taylor's D at its largest and averaged
    over time; ``shearExposure``, ∫γ̇ dt. The integrals are trapezoidal sums and the largest value that of the
    looks, ``sampleInterval`` steps apart, with the start and the end of each particle.
    """

    fields: Words = ("residenceTime", "maxDeformation", "meanDeformation", "shearExposure")
    nBins: Annotated[int, AtLeastOne] = 50
    sampleInterval: Annotated[int, AtLeastOne] = 10

    def __post_init__(self) -> None:
        for name in self.fields:
            if name not in _EXPOSURES:
                raise InputError(f"has the field {name}. {suggestion(name, _EXPOSURES)[:-1]}")

    @property
    def interval(self) -> int:
        """Steps between two looks."""
        return self.sampleInterval

    def begin(self, look: Look) -> Memory:
        """Begin the integrals."""
        p = look.particles
        D, rate = look.measure(np.arange(p.size), "taylorDeformation", "shearRate")
        return {
            "closed": np.zeros(p.size, dtype=bool),
            "t": p.t.copy(),
            "D": D,
            "shearRate": rate,
            "maxD": D.copy(),
            "sumD": np.zeros(p.size),
            "sumShearRate": np.zeros(p.size),
        }

    def see(self, memory: Memory, look: Look) -> None:
        """Go on with the integrals."""
        p = look.particles
        rows = _open(memory, p)
        h = p.t[rows] - memory["t"][rows]
        D, rate = look.measure(rows, "taylorDeformation", "shearRate")
        # A particle that the mesh has lost is where the flow is not known.
        rate = np.where(np.isfinite(rate), rate, memory["shearRate"][rows])
        memory["sumD"][rows] += 0.5 * h * (memory["D"][rows] + D)
        memory["sumShearRate"][rows] += 0.5 * h * (memory["shearRate"][rows] + rate)
        memory["maxD"][rows] = np.maximum(memory["maxD"][rows], D)
        memory["t"][rows], memory["D"][rows], memory["shearRate"][rows] = p.t[rows], D, rate
        _close(memory, p, rows)

    def write(self, memory: Memory, look: Look, folder: Path) -> None:
        """Write both tables of all particles that were released; the failed are left out of the second."""
        p = look.particles
        rows = np.flatnonzero(p.status != Status.PENDING)
        values = {name: exposure(memory, p)[rows] for name, exposure in _EXPOSURES.items()}
        write_table(
            folder / "exposure.csv",
            {"id": rows, "injector": _names(look.injectors, p.injector[rows]),
             "fate": _names(STATUS_NAMES, p.status[rows]), **values},
        )  # fmt: skip
        sound = p.status[rows] != Status.FAILED
        for name in self.fields:
            x, injector = values[name][sound], p.injector[rows][sound]
            edges = np.histogram_bin_edges(x, self.nBins)
            table: dict[str, Column] = {"lower": edges[:-1], "upper": edges[1:]}
            for index, own in enumerate(look.injectors):
                table[own] = np.histogram(x[injector == index], edges)[0]
            write_table(folder / f"{name}.csv", table)


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


@dataclass(frozen=True)
class SuspensionStress:
    """What the moving particles add to the fluid's stress in a dilute suspension: ``suspensionStress.csv``.

    Of each injection model its number of particles and their volume V, m³; the sum of the stresslets over
    that of the volumes, Pa, which times the volume fraction φ is the particles' stress; and the intrinsic
    viscosity Σ S:d_f/(2 μ_f Σ V d_f:d_f), 5/2 for rigid spheres: what they add to the dissipation, per φ.
    """

    @property
    def interval(self) -> int:
        """The write times are enough."""
        return 0

    def begin(self, look: Look) -> Memory:  # noqa: ARG002
        """Nothing has been written."""
        return {"history": np.empty((0, 11))}

    def see(self, memory: Memory, look: Look) -> None:
        """Leave it to the write times."""

    def write(self, memory: Memory, look: Look, folder: Path) -> None:
        """Add a row for each injection model."""
        p = look.particles
        lines = []
        for index in range(len(look.injectors)):
            rows = np.flatnonzero((p.status == Status.ACTIVE) & (p.injector == index))
            lines.append([look.time, index, len(rows), *_suspension(look, rows)])
        memory["history"] = np.concatenate([memory["history"], np.reshape(lines, (-1, 11))])
        time, index, n, *values = memory["history"].T
        names = ("volume", "Sxx", "Syy", "Szz", "Sxy", "Syz", "Sxz", "intrinsicViscosity")
        write_table(
            folder / "suspensionStress.csv",
            {
                "time": time,
                "injector": _names(look.injectors, index.astype(np.int64)),
                "parcels": n.astype(np.int64),
                **dict(zip(names, values, strict=True)),
            },
        )


def _suspension(look: Look, rows: Rows) -> list[float]:
    """Volume, stress per volume (xx yy zz xy yz xz) and intrinsic viscosity; the latter NaN of nothing."""
    # The components off the diagonal count twice.
    weight = np.array([1.0, 1.0, 1.0, 2.0, 2.0, 2.0])
    total, added, dissipated = np.zeros(7), 0.0, 0.0
    for c in look.contexts(rows):
        volume = 4.0 / 3.0 * math.pi * c.particles.R**3 * MEASURES["J"].value(c)
        S = MEASURES["stresslet"].value(c)
        d = np.stack(dev(sym(c.l_f)), axis=1)[:, [0, 4, 8, 1, 5, 2]]
        total += np.column_stack([volume, S]).sum(axis=0)
        added += (weight * S * d).sum()
        dissipated += (volume[:, None] * weight * d * d).sum()
    with np.errstate(invalid="ignore"):
        stress = total[1:] / total[0]
        viscosity = added / (2.0 * look.cloud.medium.mu * np.float64(dissipated))
    return [float(total[0]), *map(float, stress), float(viscosity)]


FUNCTIONS: dict[
    str,
    type[ParticleTracks | PatchPostProcessing | ParticleCollector | ParticleHistogram | SuspensionStress],
] = {
    "particleCollector": ParticleCollector,
    "particleHistogram": ParticleHistogram,
    "particleTracks": ParticleTracks,
    "patchPostProcessing": PatchPostProcessing,
    "suspensionStress": SuspensionStress,
}


# ---------------------------------------------------------------------------------------------------------
# Helpers


def _open(memory: Memory, p: Particles) -> Rows:
    """Rows of the particles that move, or have ended since the last look."""
    return np.flatnonzero(~memory["closed"] & (p.status != Status.PENDING))


def _close(memory: Memory, p: Particles, rows: Rows) -> None:
    """Look no more at those of the rows that have ended."""
    memory["closed"][rows] = p.status[rows] > Status.ACTIVE


def _mass(p: Particles, rows: Rows) -> Floats:
    """Masses, kg."""
    mass: Floats = 4.0 / 3.0 * math.pi * p.rho[rows] * p.R[rows] ** 3
    return mass


def _names(names: Sequence[str], codes: NDArray[Any]) -> list[str]:
    return [names[code] for code in codes]


def _columns(names: Sequence[str], array: NDArray[Any]) -> dict[str, Column]:
    return dict(zip(names, array.T, strict=True))


def _angle(a: Floats, b: Floats) -> Floats:
    """Angle between vectors (n, 3), degrees; NaN where one of them has no direction."""
    length = np.linalg.norm(a, axis=1) * np.linalg.norm(b, axis=1)
    with np.errstate(invalid="ignore", divide="ignore"):
        cosine = np.einsum("ni,ni->n", a, b) / length
    return np.asarray(np.degrees(np.arccos(np.clip(cosine, -1.0, 1.0))))


def _axis_angle(a: Floats, b: Floats) -> Floats:
    """Angle between an axis and a vector, up to 90 degrees."""
    angle = _angle(a, b)
    return np.minimum(angle, 180.0 - angle)


def _hermite(s: Any, x0: Any, x1: Any, m0: Any, m1: Any) -> Any:
    """The cubic from x0 with slope m0 at s = 0 to x1 with slope m1 at s = 1."""
    r = 1.0 - s
    return r * r * ((1.0 + 2.0 * s) * x0 + s * m0) + s * s * ((1.0 + 2.0 * r) * x1 - r * m1)


def _root(x0: Floats, x1: Floats, m0: Floats, m1: Floats) -> Floats:
    """A root of the cubic of :func:`_hermite` between ends of different sign, by bisection."""
    low, high = np.zeros(len(x0)), np.ones(len(x0))
    for _ in range(53):
        middle = 0.5 * (low + high)
        same = (_hermite(middle, x0, x1, m0, m1) < 0.0) == (x0 < 0.0)
        low, high = np.where(same, middle, low), np.where(same, high, middle)
    return 0.5 * (low + high)
