"""A case as a measuring device: the bodies that pass a plane, and their images there, for any properties."""

from __future__ import annotations

import logging
import math
import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.material import MATERIALS, modulus_of_capsule
from foamprb.body.memory import series_of_power_law
from foamprb.body.quadratic import parts, square, tube_deformation
from foamprb.cloud.cloud import Stepper
from foamprb.cloud.communicator import Communicator
from foamprb.cloud.paths import Steps, step
from foamprb.cloud.state import Particles, Status, empty
from foamprb.cloud.tracker import never
from foamprb.cloudfunctions.base import Memory, ObservedCloud
from foamprb.cloudfunctions.crossings import Crossings, PlaneFunction, unit
from foamprb.cloudfunctions.deformability_cytometry import (
    LARGEST_RATIO,
    TUBE_OF_SQUARE,
    Channel,
    DeformabilityCytometry,
    outline,
)
from foamprb.cloudfunctions.registry import CloudFunctions
from foamprb.dictionary.constraints import Vector3
from foamprb.errors import InputError, RunInterrupted
from foamprb.run.job import Job
from foamprb.run.measured import Measured
from foamprb.run.release import lame_of, with_power_law
from foamprb.settings.injections import Solid

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]

UNKNOWNS = (
    "shearModulus", "youngsModulus", "viscosity", "surfaceTension", "k", "alpha", "surfaceShearModulus"
)  # fmt: skip
"""Properties that can be fitted, as far as a solid has them."""
_LARGEST_EXPONENT = 0.99
_MOST_GUIDES = 2000
_CALLS = 24
"""Calls of the stepper until the slowest particle of the case passes; bodies that have passed stop then."""
_BY_WALLS = 1.02
"""Factor of the modulus from which walls count."""
_ON_AXIS = re.compile(r"([xyz])\s*(?:=\s*(\S+))?")


class Plane(NamedTuple):
    """Plane where bodies are seen."""

    point: Floats
    """(3,), m; NaN for coordinates that the table or the paths give."""
    normal: Floats
    """Unit vector, (3,)."""


class Bodies(NamedTuple):
    """Bodies at their release."""

    guide: NDArray[np.int64]
    """Particle of the case from which each has its other properties, (n,)."""
    x: Floats
    """Places, (n, 3), m."""
    d: Floats
    """Diameters at rest, (n,), m."""
    properties: dict[str, Floats]
    """Values of :data:`UNKNOWNS` that differ from the case, (n,)."""


class Seen(NamedTuple):
    """Bodies where they pass the plane; NaN for the others."""

    passed: NDArray[np.bool_]
    """(n,)."""
    t: Floats
    """Times since the release, (n,), s."""
    x: Floats
    """Places, (n, 3), m."""
    F: Floats
    """Deformation gradients, (n, 3, 3)."""
    spin: Floats
    """Angular velocity of the surface in the image, (n,), 1/s."""
    B: Floats
    """Quadratic modes, (n, 7)."""


def plane_of(text: str | None, job: Job) -> Plane:
    """Return the plane of ``x=0.01``, ``x`` or ``(0.01 0 0) (1 0 0)``; by default that of a cloud function.

    Raises
    ------
    InputError
        If the text is none of these; or without a text, if no cloud function has a plane.
    """
    if text is None:
        planes = [f for f in job.settings.functions.values() if isinstance(f, PlaneFunction)]
        if not planes:
            raise InputError(
                "where were the bodies seen? Needed: -plane, such as x=0.01; or a cloud function "
                "deformabilityCytometry or particleCollector in the settings."
            )
        return Plane(np.array(planes[0].origin, dtype=float), unit(planes[0].normal))
    match = _ON_AXIS.fullmatch(text.strip())
    try:
        if match:
            axis = "xyz".index(match[1])
            point = np.full(3, np.nan)
            point[axis] = float(match[2]) if match[2] else np.nan
            return Plane(point, np.eye(3)[axis])
        numbers = [float(word) for word in re.sub(r"[()]", " ", text).split()]
        if len(numbers) == 6 and any(numbers[3:]) and all(map(math.isfinite, numbers)):
            return Plane(np.array(numbers[:3]), unit((numbers[3], numbers[4], numbers[5])))
    except ValueError:
        pass
    raise InputError(
        f"-plane '{text}'. Allowed: x=0.01, or x if the table has x; or a point and a normal, "
        "(0.01 0 0) (1 0 0)."
    )


def view_of(text: str | None, job: Job, plane: Plane) -> Floats:
    """Return the direction of the camera, a unit vector; by default that of a cloud function, else z or y."""
    if text is not None:
        words = re.sub(r"[()]", " ", text).split()
        axes = {"x": (1.0, 0.0, 0.0), "y": (0.0, 1.0, 0.0), "z": (0.0, 0.0, 1.0)}
        try:
            direction = axes[words[0]] if len(words) == 1 else tuple(map(float, words))
        except (KeyError, ValueError):
            direction = ()
        if len(direction) != 3 or not 0.0 < math.hypot(*direction) < math.inf:
            raise InputError(f"-view '{text}'. Allowed: x, y or z, or a vector (0 0 1).")
        return unit(direction)
    views = [f.view for f in job.settings.functions.values() if hasattr(f, "view")]
    if views:
        return unit(views[0])
    return np.array([0.0, 0.0, 1.0] if abs(plane.normal[2]) < 0.5 else [0.0, 1.0, 0.0])


@dataclass(frozen=True)
class _Passages(PlaneFunction):
    """Crossings of a plane through the origin, moved along its normal for each particle; dF/dt is added."""

    origin: Vector3
    normal: Vector3
    offsets: Floats
    """Distances by the number of the particle, (n,), m."""

    def add(self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]) -> Floats:
        """Return the crossings among the steps."""
        tables, normal = steps.tables.copy(), np.array(self.normal)
        # Lanes without a particle have any number.
        number = tables[:, step.number].astype(np.int64) % len(self.offsets)
        moved = self.offsets[number][:, None] * normal[:, None]
        tables[:, step.x0 : step.x0 + 3] -= moved
        tables[:, step.x1 : step.x1 + 3] -= moved
        rows = super().add(memory, cloud, steps._replace(tables=tables), fresh)
        rows[:, 2:5] += self.offsets[rows[:, 0].astype(np.int64), None] * normal
        return rows

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return an empty table, with dF/dt."""
        table = super().initial(cloud)["crossings"]
        return {"crossings": np.empty((0, table.shape[1] + 9))}

    def more(self, crossing: Steps, share: Floats) -> list[Floats]:
        """Return dF/dt = l F there, 1/s, with l linear in time from its start on, and the right mean.

        The mean is ln(F₁ F₀⁻¹)/Δt = 2 artanh(W)/Δt, W = (F₁ F₀⁻¹ − 1)(F₁ F₀⁻¹ + 1)⁻¹.
        """
        F0, F1 = (F.reshape(-1, 3, 3) for F in crossing.both("F"))
        l0 = crossing.rate.reshape(-1, 3, 3) @ (rest := np.linalg.inv(F0))
        change, one = F1 @ rest, np.eye(3)
        W = (change - one) @ np.linalg.inv(change + one)
        W2 = W @ W
        h = (crossing.t[1] - crossing.t[0])[:, None, None]
        mean = 2.0 * W @ (one + W2 / 3.0 + W2 @ W2 / 5.0) / h
        l = l0 + 2.0 * share[:, None, None] * (mean - l0)
        return [(l @ crossing.between(share)[2].reshape(-1, 3, 3)).reshape(-1, 9)]

    def crossings(self, memory: Memory, cloud: ObservedCloud) -> Crossings:
        """Return all crossings, with dF/dt of the particles."""
        rows = memory["crossings"]
        there = super().crossings({"crossings": rows[:, :-9]}, cloud)
        return there._replace(particles=there.particles._replace(A=rows[:, -9:].copy()))


class Device:
    """Device that the case of a job describes.

    Parameters
    ----------
    job
        The job; its particles show the paths. They are not changed.
    plane, view
        Plane of observation, and direction of the camera.
    stop
        Called several times a second; True to stop.

    Raises
    ------
    InputError
        If the case is no device: its flow changes in time, its bodies are drops or vesicles, or move at
        random; if no particle passes the plane.
    """

    def __init__(self, job: Job, plane: Plane, view: Floats, stop: Callable[[], bool] = never) -> None:
        self.job, self.plane, self.view, self._stop = job, plane, view, stop
        cloud, settings = job.cloud, job.settings
        kind = MATERIALS[cloud.models.material]
        random = [type(model).__name__ for model in cloud.models.surroundings if hasattr(model, "seed")]
        fault = ""
        if settings.solution.transient:
            fault = "solution/transient is yes. Allowed: a steady flow"
        elif kind.liquid or kind.fluid:
            fault = f"the solid is {cloud.models.material}. Allowed: elastic solids"
        elif random:
            fault = f"{random[0]} moves bodies at random. Allowed: models without random numbers"
        if fault:
            raise InputError(f"{settings.file}: {fault}, where moduli are fitted.")
        p = cloud.particles
        rows = np.linspace(0, p.size - 1, min(p.size, _MOST_GUIDES)).astype(np.int64)
        self._guides = p.take(rows)
        self._guides.t0[:] = self._guides.t[:] = cloud.start
        solids = [injection.solid for injection in settings.injections]
        self._frequencies = np.array([solid.referenceFrequency for solid in solids])
        self._youngs = np.array([youngs_factor(solid) for solid in solids])
        # Shear moduli of capsules for G_s = 1 N/m and R = 1 m.
        self._membranes = (
            np.array([modulus_of_capsule(1.0, solid.surfacePoissonsRatio, 1.0) for solid in solids])
            if kind.membrane
            else None
        )
        # Of a power law.
        self._times = 1.0 / self._guides.memoryRates[0] if kind.power_law else None
        self._steps, self._call = job.steps, max(1, job.steps // _CALLS)

    def places(self, measured: Measured) -> tuple[Floats, Floats]:
        """Return where bodies were seen in the plane, and its distance from the origin along the normal.

        Returns
        -------
        Places, (n, 3), m, NaN where paths decide; distances, (n,), m.

        Raises
        ------
        InputError
            If neither the plane nor the table has the coordinate along the normal.
        """
        point, normal = self.plane
        places = np.stack([measured.of(name) for name in "xyz"], axis=1)
        along = np.abs(normal) > 1e-9
        points = np.broadcast_to(point, places.shape) if np.isfinite(point[along]).all() else places
        offsets = points[:, along] @ normal[along]
        if not np.isfinite(offsets).any():
            axis = "xyz"[int(np.argmax(along))]
            raise InputError(f"{measured.file}: no column {axis} [m]. Needed: it, or -plane {axis}=VALUE.")
        places = np.where(np.isfinite(places), places, point)
        # Along an axis, the distance has this coordinate.
        return np.where(along & (along.sum() == 1), np.nan, places), offsets

    def pass_guides(self, offset: float) -> None:
        """Follow the particles of the case to the plane at a distance from the origin along its normal, m."""
        seen = self._follow(self._guides.copy(), np.full(self._guides.size, offset))
        if not seen.passed.any():
            raise InputError(
                f"{self.job.settings.file}: no particle of the injection models passes the plane before "
                f"endTime, {self.job.settings.solution.endTime:g} s. Needed: paths to the bodies."
            )
        self._guides, self._arrivals = self._guides.take(seen.passed), seen.x[seen.passed]
        slowest = seen.t[seen.passed].max() / self.job.cloud.dt
        self._call = max(1, math.ceil(slowest / _CALLS))

    def lead_to(self, places: Floats) -> tuple[NDArray[np.int64], Floats, Floats]:
        """Return the guide of each body, the place of its release, and how releases move with arrivals.

        Parameters
        ----------
        places
            Where bodies are seen, (n, 3), m; NaN in coordinates that the path gives.

        Returns
        -------
        Rows of guides, (n,); places of release, (n, 3), m; displacement of the release over that of the
        arrival, (n,), 1.
        """
        from scipy.spatial import KDTree

        arrivals, releases = self._arrivals, self._guides.x
        guide = np.zeros(len(places), dtype=np.int64)
        shift, ratio = np.zeros_like(places), np.ones(len(places))
        patterns, index = np.unique(np.isfinite(places), axis=0, return_inverse=True)
        for k, pattern in enumerate(patterns):
            rows = np.flatnonzero(index.ravel() == k)
            if not pattern.any():
                # The path in the middle of all.
                guide[rows] = np.argmin(np.linalg.norm(arrivals - np.median(arrivals, axis=0), axis=1))
                continue
            tree = KDTree(arrivals[:, pattern])
            near = tree.query(places[rows][:, pattern], k=min(4, len(arrivals)))[1].reshape(len(rows), -1)
            first, others = near[:, :1], near[:, 1:]
            guide[rows] = first[:, 0]
            apart = np.linalg.norm(arrivals[others] - arrivals[first], axis=2)
            before = np.linalg.norm(releases[others] - releases[first], axis=2)
            if others.shape[1]:
                ratio[rows] = np.median(before / np.maximum(apart, 1e-300), axis=1)
            shift[rows] = np.nan_to_num(places[rows] - arrivals[guide[rows]])
        # Paths that meet, or a single one, say nothing.
        ratio = np.where((ratio > 0.05) & (ratio < 20.0), ratio, 1.0)
        return guide, releases[guide] + ratio[:, None] * shift, ratio

    def expected(self, places: Floats, guide: NDArray[np.int64], offsets: Floats) -> Floats:
        """Return where bodies will pass their planes, (n, 3), m: the places, completed by their guides."""
        x = np.where(np.isfinite(places), places, self._arrivals[guide])
        normal = self.plane.normal
        return np.asarray(x + np.outer(offsets - x @ normal, normal))

    def curvature_number(self, x: Floats, d: Floats) -> Floats:
        """Return a |S|/|E| at places, (n,), with the differences of ∇u over the body; NaN outside the flow.

        S is the part of the second derivatives that changes the form of a sphere of radius a, E the strain
        rate.
        """
        flow, a = self.job.cloud.flow, 0.5 * d

        def gradients(points: Floats) -> tuple[Floats, NDArray[np.bool_]]:
            hosts = flow.locate(np.nan_to_num(points))
            inside = (hosts >= 0) & np.isfinite(points).all(axis=1)
            l = np.full((len(points), 3, 3), np.nan)
            l[inside] = flow.sample(points[inside], hosts[inside], self.job.cloud.start)[1]
            return l, inside

        l, inside = gradients(x)
        G = np.zeros((len(x), 3, 3, 3))
        for k in range(3):
            ends = []
            for sign in (-1.0, 1.0):
                beside, there = gradients(x + sign * a[:, None] * np.eye(3)[k])
                ends.append((np.where(there[:, None, None], beside, l), sign * a * there))
            (before, low), (after, high) = ends
            G[..., k] = (after - before) / np.where(high > low, high - low, np.inf)[:, None, None]
        second: Any = tuple(
            tuple(0.5 * (G[:, i, j, k] + G[:, i, k, j]) for i in range(3))
            for j, k in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
        )
        E = 0.5 * (l + l.swapaxes(1, 2))
        rate = np.sqrt((E**2).sum(axis=(1, 2)))
        return np.where(inside, a * np.sqrt(square(parts(second).S)) / np.maximum(rate, 1e-300), np.nan)

    def follow(self, bodies: Bodies, offsets: Floats) -> Seen:
        """Follow bodies to planes at distances from the origin along the normal, (n,), m."""
        cloud, n = self.job.cloud, len(bodies.d)
        p = self._guides.take(bodies.guide)
        p.x[:] = p.x0[:] = bodies.x
        p.host[:] = cloud.flow.locate(p.x)
        p.number[:] = np.arange(n)
        stress, before = p.Ca * p.mu, p.R.copy()
        p.R[:] = 0.5 * bodies.d
        if self._membranes is not None:
            p.mu[:] *= before / p.R
        p = self.with_properties(p, bodies.properties)
        p.Ca[:] = stress / p.mu
        for k, injection in enumerate(self.job.settings.injections):
            rows = p.injector == k
            p.lame[rows] = lame_of(injection.solid, p.mu[rows], lambda: float(stress.max()))
        inside = (p.host >= 0) & (0.99 * cloud.bounds.maxLength > p.R)
        inside &= np.isfinite(p.mu)
        seen = self._follow(p.take(inside), offsets[inside])
        return Seen(*(spread(values, inside, n) for values in seen))

    def properties(self, p: Particles) -> dict[str, Floats]:
        """Return the properties of particles that can be fitted, (n,) each, by their entries."""
        if self._membranes is not None:
            return {"surfaceShearModulus": p.mu * p.R / self._membranes[p.injector], "viscosity": p.eta}
        values = {"viscosity": p.eta, "surfaceTension": p.gamma}
        if self._times is None:
            G = p.steady_modulus
            return {"shearModulus": G, "youngsModulus": self._youngs[p.injector] * G, **values}
        series = series_of_power_law(p.k, self._times)
        k = p.mu / series.modulus
        law = {"k": k * self._frequencies[p.injector] ** p.k, "alpha": p.k}
        return {**law, **values, "viscosity": p.eta - k * series.viscosity}

    def require_property(self, name: str, where: str) -> None:
        """Raise InputError, which begins with ``where``, if the solid lacks a property."""
        allowed = self.properties(self._guides)
        if name not in allowed:
            solid = self.job.cloud.models.material
            raise InputError(
                f"{where}: the solid {solid} has no such property. Allowed: {', '.join(allowed)}."
            )

    def with_properties(self, p: Particles, changed: Mapping[str, Floats]) -> Particles:
        """Return particles with other properties; the modulus is NaN for an exponent of 1 or more."""
        values = {**self.properties(p), **changed}
        if "youngsModulus" in changed:
            values["shearModulus"] = changed["youngsModulus"] / self._youngs[p.injector]
        if self._membranes is not None:
            p.mu[:] = values["surfaceShearModulus"] * self._membranes[p.injector] / p.R
            p.eta[:] = values["viscosity"]
            return p
        p.gamma[:], p.eta[:] = values["surfaceTension"], values["viscosity"]
        if self._times is None:
            relaxing = p.memoryShares * p.mu[:, None]
            p.mu[:] = values["shearModulus"] + relaxing.sum(axis=1)
            p.memoryShares[:] = relaxing / p.mu[:, None]
            return p
        valid = values["alpha"] < _LARGEST_EXPONENT
        alpha = np.where(valid, values["alpha"], 0.5)
        p = with_power_law(p, values["k"], alpha, self._times, self._frequencies[p.injector])
        p.mu[~valid] = np.nan
        return p

    def _follow(self, p: Particles, offsets: Floats) -> Seen:
        n, normal = p.size, self.plane.normal
        p.number[:] = np.arange(n)
        cloud = replace(self.job.cloud, particles=p, comm=Communicator(), step=0, recovered=0, reach=0.0)
        observed = ObservedCloud(cloud, self.job.observed.names)
        function = _Passages((0.0, 0.0, 0.0), (float(normal[0]), float(normal[1]), float(normal[2])), offsets)
        functions = CloudFunctions({"fit": function}, observed)
        seen = Seen(
            np.zeros(n, dtype=bool), *(np.full((n, *shape), np.nan) for shape in ((), (3,), (3, 3), (), (7,)))
        )
        stepper, taken = Stepper(cloud), 0
        while cloud.step < self._steps and (p.status <= Status.ACTIVE).any():
            stepper.advance(min(self._call, self._steps - cloud.step), self._stop)
            if self._stop():
                raise RunInterrupted("stopped")
            rows = functions.state()["fit/crossings"][taken:]
            taken += len(rows)
            # The first passage counts.
            number, first = np.unique(rows[:, 0].astype(np.int64), return_index=True)
            first, number = first[~seen.passed[number]], number[~seen.passed[number]]
            there = function.crossings({"crossings": rows[first]}, observed)
            seen.passed[number], seen.t[number], seen.x[number] = True, there.t - p.t0[number], there.x
            seen.F[number], seen.B[number] = there.particles.F.reshape(-1, 3, 3), there.particles.B
            seen.spin[number] = self._spin(there.particles)
            p.status[number[p.status[number] == Status.ACTIVE]] = Status.ESCAPED
        return seen

    def _spin(self, p: Particles) -> Floats:
        """Return √det of the velocity gradient of the body in the image, 1/s (Roscoe 1967)."""
        l = p.A.reshape(-1, 3, 3) @ np.linalg.inv(p.F.reshape(-1, 3, 3))
        e = self.basis
        return np.asarray(np.sqrt(np.maximum(np.linalg.det(e @ l @ e.T), 0.0)))

    @property
    def basis(self) -> Floats:
        """Axes of the image, (2, 3): along the normal of the plane as far as it is seen, and across."""
        along = self.plane.normal - (self.plane.normal @ self.view) * self.view
        if np.linalg.norm(along) < 1e-6:
            along = np.eye(3)[int(np.argmin(np.abs(self.view)))]
            along = along - (along @ self.view) * self.view
        along = along / np.linalg.norm(along)
        return np.stack([along, np.cross(self.view, along)])

    def confinement(self, x: Floats, d: Floats) -> tuple[Floats, NDArray[np.bool_]]:
        """Return radii of bodies at x over that of the channel, and whether its effect is unknown, (n,).

        The channel is that of ``deformabilityCytometry``; 0 and False without one.
        """
        for camera in self._cameras:
            if camera.channel is not None:
                ratio = camera.confinement(0.5 * d, x)
                return ratio, ratio == 0.0
        return np.zeros(len(d)), np.zeros(len(d), dtype=bool)

    @property
    def _cameras(self) -> list[DeformabilityCytometry]:
        return [f for f in self.job.settings.functions.values() if isinstance(f, DeformabilityCytometry)]

    @property
    def width(self) -> float:
        """Width of the square channel, m; by default the smallest one of the flow."""
        radii = [camera.channel.tube_radius for camera in self._cameras if camera.channel is not None]
        return radii[0] / TUBE_OF_SQUARE if radii else self.job.cloud.flow.width

    def warn_of_walls(self, d: Floats) -> None:
        """Warn if walls deform bodies of diameters d, (n,), m, and the settings have no channel."""
        job, width = self.job, self.job.cloud.flow.width
        d = d[np.isfinite(d)]
        size = float(np.median(d)) if len(d) else math.inf
        if (
            not job.cloud.models.has_quadratic
            or any(camera.channel is not None for camera in self._cameras)
            or not size < width < math.inf
        ):
            return
        channel = Channel("square", width=width)
        factor = float(tube_deformation(min(0.5 * size / channel.tube_radius, LARGEST_RATIO)))
        if factor > _BY_WALLS:
            log.warning(
                "%s: no channel in deformabilityCytometry, so walls do not act on the shapes. On the axis of "
                "a square channel as wide as the flow, %.4g m, moduli of bodies of %.4g m are then too small "
                "by a factor of %.3g. Needed there: channel { type square; width %.4g; }.",
                job.settings.file, width, size, factor, width,
            )  # fmt: skip

    def image(self, seen: Seen, d: Floats, names: Sequence[str]) -> dict[str, Floats]:
        """Return quantities of :class:`~foamprb.run.measured.Measured` of seen bodies, (n,) each.

        Parameters
        ----------
        seen
            The bodies.
        d
            Their diameters at rest, m.
        names
            Names of the quantities, or ``bulletAmplitude``.
        """
        p = empty(len(d))._replace(R=0.5 * d)
        p.F[seen.passed], p.B[seen.passed] = seen.F[seen.passed].reshape(-1, 9), seen.B[seen.passed]
        confinement, _ = self.confinement(np.nan_to_num(seen.x), d)
        shadow = outline(p, self.view, confinement)
        a, b = shadow.semi_axes.T
        F = p.F.reshape(-1, 3, 3)
        flat = self.basis @ F @ F.transpose(0, 2, 1) @ self.basis.T
        angle = 0.5 * np.abs(np.arctan2(2.0 * flat[:, 0, 1], flat[:, 0, 0] - flat[:, 1, 1]))
        values = {
            "area": shadow.area,
            "strain": (a - b) / np.sqrt(a * b),
            "deformation": shadow.deformation,
            "angle": angle,
            "treading": seen.spin,
            "bulletAmplitude": shadow.bullet_amplitude,
        }
        return {name: np.where(seen.passed, values[name], np.nan) for name in names}


def youngs_factor(solid: Solid) -> float:
    """Return E over the shear modulus; 3 for a solid that keeps its volume."""
    return 3.0 if solid.poissonsRatio is None else 2.0 * (1.0 + solid.poissonsRatio)


def spread(values: NDArray[np.generic], rows: NDArray[np.generic], n: int) -> NDArray[Any]:
    """Return values of some of n bodies for all: NaN or False for the others."""
    fill: Any = False if values.dtype == np.bool_ else np.nan
    every = np.full((n, *values.shape[1:]), fill, dtype=values.dtype)
    every[rows] = values
    return every
