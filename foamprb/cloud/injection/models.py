"""OpenFOAM's injection models, with its entries: places and times of release.

A new injection model is a frozen dataclass of its entries and a line in :data:`INJECTIONS`.
"""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from functools import partial
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Annotated, Any, Literal, NamedTuple, Protocol, TypeAlias

import numpy as np
from numpy.random import Generator
from numpy.typing import NDArray

from foamprb.cloud.communicator import parts_of
from foamprb.cloud.state import VARIABLES, Particles, empty
from foamprb.dictionary.constraints import (
    Angle,
    AtLeastOne,
    Axes,
    Bounds,
    Constant,
    Meaning,
    NonNegative,
    Positive,
    Vector3,
)
from foamprb.dictionary.schema import Schema
from foamprb.errors import InputError
from foamprb.flow.base import Flow, PatchFaces, patches_named
from foamprb.memory import memory, size_text

Floats = NDArray[np.float64]
log = logging.getLogger("foamprb")

START_OF_FLOW = -math.inf
"""``SOI`` if it is not given; see :func:`start_of_injection`."""


_SOI = Annotated[float, NonNegative, Meaning("start of injection", "s", "first time of the flow, or 0")]
_U0 = Annotated[
    Vector3 | None,
    Meaning(
        "initial velocity; no effect with the integrator `stokes`, which has no inertia",
        "m/s",
        "the fluid's",
    ),
]

_CLEARANCE = Annotated[bool, Meaning("bodies appear only where they overlap no wall; others are drawn anew")]
_LEAVE_OUT = Annotated[bool, Meaning("leave out positions outside the mesh")]

GIVEN: dict[str, Bounds] = {
    "d": Positive,
    "rho": Positive,
    "shearModulus": Positive,
    "youngsModulus": Positive,
    "Ca": Positive,
    "viscosity": NonNegative,
    "surfaceTension": NonNegative,
}
"""Further columns of a file of positions, in place of distributions: entries of the dictionary, in their
units; ``d`` is the diameter, m."""

Drawn: TypeAlias = tuple[Floats, NDArray[Any]]
"""Random places, (n, 3), m, and their hosts, (n,)."""

Fit: TypeAlias = Callable[[Drawn, Callable[[int], Drawn], Floats], Drawn]
"""Function that replaces the places that do not fit the next particles, by a given number of other ones.

Its last argument are the times of release (n,), s.
"""

ReadPositions: TypeAlias = Callable[[Path, Mapping[str, Bounds]], tuple[Floats, Mapping[str, Floats]]]
"""Function that reads a file: positions (n, 3), m, and further columns, (n,) each, within bounds."""


BYTES = sum(
    (0 if v.optional else 1 if v.fixed else 2) * math.prod(v.shape) * np.dtype(v.dtype).itemsize
    for v in VARIABLES.values()
)
"""Memory of a run for each particle: its state, and a copy of its variable part for the last write time.

What only some models set is left out.
"""


class Places(NamedTuple):
    """Places and times of release."""

    x: Floats
    """(n, 3), m."""
    hosts: NDArray[Any]
    """(n,), tetrahedra that contain them; −1 outside the flow."""
    t: Floats
    """(n,), s."""
    v: Floats | Vector3 | None = None
    """(n, 3) or one for all, m/s; by default that of the fluid."""
    columns: Mapping[str, Floats] = MappingProxyType({})
    """Values per particle of some of :data:`GIVEN`, (n,) each."""


def as_drawn(drawn: Drawn, _redraw: Callable[[int], Drawn], _t: Floats) -> Drawn:
    """Return random places as they were drawn."""
    return drawn


class Injection(Schema, Protocol):
    """An injection model."""

    @property
    def SOI(self) -> float:
        """Start of injection, s; :data:`START_OF_FLOW` for the first time of the flow."""

    def places(self, flow: Flow, random: np.random.Generator, read: ReadPositions) -> Places:
        """Return the places of all particles.

        Parameters
        ----------
        flow
            The flow into which they are injected.
        random
            Source of every random number.
        read
            Function that reads a file of positions.

        A model with an entry ``clearance`` has a further argument ``fit``, see :data:`Fit`.

        Raises
        ------
        InputError
            If the flow lacks a name in the entries, a place lies outside the flow, or no particle would be
            injected.
        """


@dataclass(frozen=True)
class ManualInjection(Injection):
    """Particles at the positions of a file, all at the time ``SOI``."""

    positionsFile: Annotated[Path, Meaning("a file in `constant`, see [Positions](#positions)")]
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    ignoreOutOfBounds: _LEAVE_OUT = False

    def places(self, flow: Flow, _random: np.random.Generator, read: ReadPositions) -> Places:
        """Return the positions of the file, without those outside the flow if ``ignoreOutOfBounds``."""
        SOI = start_of_injection(self, flow)
        x, columns = read(self.positionsFile, GIVEN)
        hosts = flow.locate(x, SOI)
        inside = _inside(x, hosts, self.ignoreOutOfBounds, self.positionsFile)
        t = np.full(np.count_nonzero(inside), SOI)
        columns = {name: column[inside] for name, column in columns.items()}
        return Places(x[inside], hosts[inside], t, self.U0, columns)


@dataclass(frozen=True)
class PatchInjection(Injection):
    """Particles spread over a patch, uniform in flux, from ``SOI`` on for ``duration``."""

    patch: Annotated[
        str,
        Meaning(
            "a name, group or regular expression; random places, with a density proportional to the inflow"
        ),
    ]
    parcelsPerSecond: Annotated[float, Positive, Meaning("rate of injection, at even intervals", "1/s")]
    duration: Annotated[float, Positive, Meaning("of the injection", "s")]
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    clearance: _CLEARANCE = False

    def places(self, flow: Flow, random: Generator, _read: ReadPositions, fit: Fit = as_drawn) -> Places:
        """Return random places on the patch, with a density proportional to the flux, at even intervals."""
        SOI = start_of_injection(self, flow)
        n = require_room(
            self.parcelsPerSecond * self.duration,
            f"patchInjection on {self.patch}: parcelsPerSecond {self.parcelsPerSecond:g} times "
            f"duration {self.duration:g} s",
        )
        faces = _faces_of(self.patch, flow, SOI)
        inflow = np.maximum(np.einsum("tvi,ti->tv", faces.velocity, faces.normals), 0.0)
        flux = inflow.mean(axis=1) * faces.areas
        if not flux.sum() > 0.0:
            still = not faces.velocity.any()
            raise InputError(
                f"patchInjection on {self.patch}: no fluid enters through this patch at SOI, {SOI:g} s"
                + ("; it is at rest, as is usual at the first time of a case. " if still else ". ")
                + "Choose another SOI, another patch or other times of the flow; or the type "
                "patchFlowRateInjection, which follows the inflow in time."
            )
        draw = partial(_on_faces, random, faces, inflow)
        t = SOI + np.arange(n) / self.parcelsPerSecond
        return Places(*fit(draw(n), draw, t), t, self.U0)


_ONE = Constant(1.0)
_SHARES = 16
"""Parts of an interval between two times of a flow, in each of which the inflow is linear in time."""


@dataclass(frozen=True)
class PatchFlowRateInjection(Injection):
    """Particles in proportion to the volume that flows in through a patch, from ``SOI`` on for ``duration``.

    The inflow is that of the velocity at each time of a transient flow, and linear between them.
    """

    patch: Annotated[
        str,
        Meaning("a name, group or regular expression; random places, as the inflow at the time of release"),
    ]
    parcelConcentration: Annotated[
        float, Positive, Meaning("particles in each cubic metre that flows in", "1/m³")
    ]
    duration: Annotated[float, Positive, Meaning("of the injection", "s")]
    concentration: Annotated[Constant, Positive, Meaning("factor of `parcelConcentration`", "1")] = _ONE
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    clearance: _CLEARANCE = False

    def places(self, flow: Flow, random: Generator, _read: ReadPositions, fit: Fit = as_drawn) -> Places:
        """Return random places on the patch, as the inflow at the times of release.

        Particle k is released when the volume for k + ½ particles has entered.
        """
        start = start_of_injection(self, flow)
        end = min(start + self.duration, flow.span[1])
        what = f"patchFlowRateInjection on {self.patch}"
        rate = self.parcelConcentration * self.concentration
        number, parts = 0.0, []
        before = _faces_of(self.patch, flow, start)
        for t0, t1 in pairwise([start, *flow.times_within(start, end), end]):
            after = _faces_of(self.patch, flow, t1)
            # Velocities into the flow at the corners of the triangles.
            q0, q1 = (np.einsum("tvi,ti->tv", f.velocity, f.normals) for f in (before, after))
            h = (t1 - t0) / _SHARES
            for j in range(_SHARES):
                a, b = (np.maximum(q0 + s / _SHARES * (q1 - q0), 0.0) for s in (j, j + 1))
                Q0, Q1 = (float((q.mean(axis=1) * before.areas).sum()) for q in (a, b))
                first, number = number, number + rate * h * 0.5 * (Q0 + Q1)
                n = math.floor(number + 0.5) - math.floor(first + 0.5)
                if n == 0:
                    continue
                require_room(number, f"{what}: parcelConcentration {rate:g} 1/m3 up to {t1:g} s")
                mean = (math.floor(first + 0.5) + 0.5 + np.arange(n) - first) / (rate * h)
                # The share s of the part in which this volume over h enters: Q0 s + (Q1 - Q0) s²/2.
                s = 2.0 * mean / (Q0 + np.sqrt(np.maximum(Q0**2 + 2.0 * mean * (Q1 - Q0), 0.0)))
                draw = partial(_on_faces, random, before, a + b)
                t = t0 + h * (j + np.minimum(s, 1.0))
                parts.append((*fit(draw(n), draw, t), t))
            before = after
        if not parts:
            raise InputError(
                f"{what}: fluid for {number:.3g} particles enters from {start:g} to {end:g} s, for none."
            )
        x, hosts, t = (np.concatenate(arrays) for arrays in zip(*parts, strict=True))
        return Places(x, hosts, t, self.U0)


def _faces_of(word: str, flow: Flow, t: float) -> PatchFaces:
    """Return the triangles of the patches of a name, a group or a pattern at time t, s."""
    named = [flow.patches[k].name for k in patches_named(flow.patches, word)] or [word]
    parts = [flow.patch_faces(name, t) for name in named]
    return PatchFaces(*(np.concatenate(arrays) for arrays in zip(*parts, strict=True)))


_NUMBER = Annotated[int, AtLeastOne, Meaning("number of particles")]
_OVER = Annotated[float, NonNegative, Meaning("of the injection, at even intervals", "s", "0: all at `SOI`")]


@dataclass(frozen=True, kw_only=True)
class LineInjection(Injection):
    """Particles at even distances on a line, in random order, from ``SOI`` on for ``duration``."""

    start: Annotated[Vector3, Meaning("first place", "m")]
    end: Annotated[Vector3, Meaning("last place", "m")]
    number: _NUMBER
    duration: _OVER = 0.0
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    ignoreOutOfBounds: _LEAVE_OUT = False

    def places(self, flow: Flow, random: np.random.Generator, _read: ReadPositions) -> Places:
        """Return the places on the line, without those outside the flow if ``ignoreOutOfBounds``."""
        n = require_room(self.number, f"lineInjection: number {self.number}")
        x = np.linspace(self.start, self.end, n)
        times = start_of_injection(self, flow) + self.duration * random.permutation(n).astype(float) / n
        hosts = flow.locate(x, times)
        inside = _inside(x, hosts, self.ignoreOutOfBounds, "lineInjection")
        return Places(x[inside], hosts[inside], times[inside], self.U0)


@dataclass(frozen=True, kw_only=True)
class BoxInjection(Injection):
    """Particles at random in a box, as far as it lies in the mesh, from ``SOI`` on for ``duration``."""

    min: Annotated[Vector3, Meaning("corner of the smallest coordinates", "m")]
    max: Annotated[Vector3, Meaning("corner of the largest coordinates", "m")]
    number: _NUMBER
    duration: _OVER = 0.0
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    clearance: _CLEARANCE = False

    def __post_init__(self) -> None:
        if any(low > high for low, high in zip(self.min, self.max, strict=True)):
            raise InputError("has a component of min above that of max")

    def places(self, flow: Flow, random: Generator, _read: ReadPositions, fit: Fit = as_drawn) -> Places:
        """Return random places in the box; see :func:`_in_mesh`."""
        box = np.array([self.min, self.max])
        return _in_mesh(self, "boxInjection", flow, random, fit, box, lambda x: np.full(len(x), True))


@dataclass(frozen=True, kw_only=True)
class SphereInjection(Injection):
    """Particles at random in a sphere, as far as it lies in the mesh, from ``SOI`` on for ``duration``."""

    origin: Annotated[Vector3, Meaning("centre", "m")]
    radius: Annotated[float, Positive, Meaning("radius", "m")]
    number: _NUMBER
    duration: _OVER = 0.0
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    clearance: _CLEARANCE = False

    def places(self, flow: Flow, random: Generator, _read: ReadPositions, fit: Fit = as_drawn) -> Places:
        """Return random places in the sphere; see :func:`_in_mesh`."""
        o, R = np.array(self.origin), self.radius
        box = np.array([o - R, o + R])
        return _in_mesh(
            self, "sphereInjection", flow, random, fit, box, lambda x: np.linalg.norm(x - o, axis=1) <= R
        )


_AT_ONCE = 1 << 16
"""Most places that are drawn at once."""
_MOST_DRAWN = 1000
"""Most places that are drawn for each one in the mesh."""


def _in_mesh(
    model: BoxInjection | SphereInjection,
    what: str,
    flow: Flow,
    random: np.random.Generator,
    fit: Fit,
    box: Floats,
    contains: Callable[[Floats], NDArray[np.bool_]],
) -> Places:
    """Return random places of a region in the mesh, released at even intervals.

    Parameters
    ----------
    box
        Corners of a box around the region, (2, 3), m; only its part in that of the mesh is searched.
    contains
        Returns which points lie in the region.

    Raises
    ------
    InputError
        If less than a thousandth of that part lies in region and mesh.
    """
    low, high = np.maximum(box[0], flow.bounds[0]), np.minimum(box[1], flow.bounds[1])
    start = start_of_injection(model, flow)

    def draw(n: int) -> Drawn:
        x, hosts, tried, placed = np.empty((n, 3)), np.empty(n, dtype=np.int64), 0, 0
        while placed < n:
            drawn = low + (high - low) * random.random((min(max(n - placed, 1000), _AT_ONCE), 3))
            tried += len(drawn)
            drawn = drawn[contains(drawn)]
            held = flow.locate(drawn, start)
            rows = np.flatnonzero(held >= 0)[: n - placed]
            x[placed : placed + len(rows)], hosts[placed : placed + len(rows)] = drawn[rows], held[rows]
            placed += len(rows)
            if (low > high).any() or (placed < n and tried > _MOST_DRAWN * (placed + 10)):
                raise InputError(f"{what}: only {placed} of {tried} random places lie in the mesh.")
        return x, hosts

    n = require_room(model.number, f"{what}: number {model.number}")
    times = start + model.duration * np.arange(n, dtype=float) / n
    return Places(*fit(draw(n), draw, times), times, model.U0)


def _inside(x: Floats, hosts: NDArray[np.int32], leave_out: bool, what: object) -> NDArray[np.bool_]:
    """Return which of the positions lie in the flow.

    Raises
    ------
    InputError
        If some do not and shall not be left out; with their number and the first of them.
    """
    outside = hosts < 0
    if outside.any() and not leave_out:
        first = ", ".join("({:g} {:g} {:g})".format(*row) for row in x[outside][:3])
        more = ", ..." if outside.sum() > 3 else ""
        raise InputError(
            f"{what}: {outside.sum()} of {len(x)} positions lie outside the mesh: "
            f"{first}{more}. Move them inside, or set ignoreOutOfBounds true to leave them out."
        )
    if outside.any():
        log.warning(
            "%s: %d of %d positions lie outside the mesh and are left out.", what, outside.sum(), len(x)
        )
    return ~outside


@dataclass(frozen=True)
class CellZoneInjection(Injection):
    """Particles spread evenly over the cells of a zone, ``numberDensity`` per cubic metre, all at ``SOI``.

    With ``selectionMode all``, a word of OpenFOAM's fvOptions, over all cells.
    """

    numberDensity: Annotated[
        float, Positive, Meaning("random places, evenly over the volume, all at `SOI`", "1/m³")
    ]
    cellZone: Annotated[
        str, Meaning("a zone of `polyMesh/cellZones`", default="required, without `selectionMode all`")
    ] = ""
    selectionMode: Annotated[
        Literal["cellZone", "all"], Meaning("`all`: all cells of the mesh, in place of a `cellZone`")
    ] = "cellZone"
    U0: _U0 = None
    SOI: _SOI = START_OF_FLOW
    clearance: _CLEARANCE = False

    def __post_init__(self) -> None:
        if self.selectionMode == "all" and self.cellZone:
            raise InputError(f"has the cellZone {self.cellZone}, but selectionMode all")
        if self.selectionMode == "cellZone" and not self.cellZone:
            raise InputError("has no cellZone. Allowed: the name of a zone, or selectionMode all")

    def places(self, flow: Flow, random: Generator, _read: ReadPositions, fit: Fit = as_drawn) -> Places:
        """Return random places in the zone; the number in any part follows its volume, within two.

        Places that are drawn anew are independent of each other.
        """
        SOI = start_of_injection(self, flow)
        zone = flow.cell_zone(self.cellZone or None, SOI)
        # An inverted tetrahedron overlaps its neighbours, which contain its share.
        volumes = np.maximum(zone.volumes, 0.0)
        total = np.cumsum(volumes)
        volume = float(total[-1]) if len(total) else 0.0
        n = require_room(
            self.numberDensity * volume,
            f"cellZoneInjection in {self.cellZone or 'all cells'}: numberDensity {self.numberDensity:g} 1/m3 "
            f"times the volume {volume:g} m3 of {len(volumes)} tetrahedra",
        )

        def at(shares: Floats) -> Drawn:
            """Return random places in the tetrahedra at some shares of the cumulative volume."""
            last = np.flatnonzero(volumes)[-1]
            tetrahedra = np.minimum(np.searchsorted(total, shares * total[-1], side="right"), last)
            weights = random.dirichlet((1.0, 1.0, 1.0, 1.0), len(shares))
            hosts = zone.hosts[tetrahedra]
            return np.einsum("nv,nvi->ni", weights, zone.vertices(hosts)), hosts

        # Stratified sampling: one random number in each n-th part of the cumulative volume.
        strata = (np.arange(n) + random.random(n)) / n
        t = np.full(n, SOI)
        return Places(*fit(at(strata), lambda k: at(random.random(k)), t), t, self.U0)


@dataclass(frozen=True)
class ConeInjection(Injection):
    """Sprays: at each position ``parcelsPerInjector`` particles in a cone about an axis, from ``SOI`` on.

    As in OpenFOAM, the angle between velocity and axis is uniform between ``thetaInner`` and ``thetaOuter``,
    degrees (not uniform over the sphere), and so is the angle about the axis; ``Umag`` is the speed, m/s.
    """

    positionAxis: Annotated[Axes, Meaning("`( ((x y z) (axis)) … )`, used in turn", "m")]
    duration: Annotated[float, Positive, Meaning("of the injection", "s")]
    parcelsPerInjector: Annotated[float, Positive, Meaning("at each position, at even intervals", "1")]
    Umag: Annotated[Constant, NonNegative, Meaning("speed; `3` or `constant 3`", "m/s")]
    thetaInner: Annotated[Constant, Angle, Meaning("smallest angle from the axis", "°")]
    thetaOuter: Annotated[Constant, Angle, Meaning("largest angle; uniform between them", "°")]
    SOI: _SOI = START_OF_FLOW

    def __post_init__(self) -> None:
        if not self.positionAxis:
            raise InputError("has an empty list positionAxis")
        if any(not np.any(axis) for _, axis in self.positionAxis):
            raise InputError("has an axis (0 0 0) in positionAxis")

    def places(self, flow: Flow, random: np.random.Generator, _read: ReadPositions) -> Places:
        """Return the positions in turn, at even intervals in time, with a random direction each."""
        SOI = start_of_injection(self, flow)
        positions, axes = (np.array(part, dtype=float) for part in zip(*self.positionAxis, strict=True))
        hosts = flow.locate(positions, SOI)
        if (hosts < 0).any():
            first = "({:g} {:g} {:g})".format(*positions[hosts < 0][0])
            raise InputError(f"coneInjection: the position {first} lies outside the mesh.")
        what = f"coneInjection: parcelsPerInjector {self.parcelsPerInjector:g} at {len(positions)} positions"
        n = require_room(float(np.rint(self.parcelsPerInjector)) * len(positions), what)
        which = np.arange(n) % len(positions)
        least, most = sorted((self.thetaInner, self.thetaOuter))
        theta = np.deg2rad(random.uniform(least, most, n))
        v = self.Umag * _directions(axes[which], theta, random.uniform(0.0, 2.0 * np.pi, n))
        t = SOI + self.duration * np.arange(n) / n
        return Places(positions[which], hosts[which], t, v)


def _directions(axes: Floats, theta: Floats, turn: Floats) -> Floats:
    """Return unit vectors (n, 3) at angles theta from the axes (n, 3), turned about them; angles in rad."""
    along = axes / np.linalg.norm(axes, axis=1)[:, None]
    # The cross product with the least parallel coordinate axis is well conditioned.
    other = np.eye(3)[np.argmin(np.abs(along), axis=1)]
    first = np.cross(along, other)
    first /= np.linalg.norm(first, axis=1)[:, None]
    second = np.cross(along, first)
    aside = np.cos(turn)[:, None] * first + np.sin(turn)[:, None] * second
    directions: Floats = np.cos(theta)[:, None] * along + np.sin(theta)[:, None] * aside
    return directions


def _on_faces(random: np.random.Generator, faces: PatchFaces, density: Floats, n: int) -> Drawn:
    """Draw n points, (n, 3), m, on triangles, and return their hosts.

    ``density`` is at the vertices of the triangles, (m, 3), and linear between them.
    """
    weight = density.mean(axis=1) * faces.areas
    triangles = random.choice(len(weight), size=n, p=weight / weight.sum())
    points = np.empty((len(triangles), 3))
    open_rows = np.arange(len(triangles))
    while len(open_rows):
        weights = random.dirichlet((1.0, 1.0, 1.0), len(open_rows))
        accepted = random.random(len(open_rows))
        for part in parts_of(len(open_rows)):
            at_corners = density[triangles[open_rows[part]]]
            accepted[part] = accepted[part] * at_corners.max(axis=1) <= np.einsum(
                "nv,nv->n", weights[part], at_corners
            )
        inside = accepted.astype(bool)
        points[open_rows[inside]] = weights[inside]
        open_rows = open_rows[~inside]
    for part in parts_of(len(triangles)):
        points[part] = np.einsum("nv,nvi->ni", points[part], faces.vertices[triangles[part]])
    return points, faces.hosts[triangles]


def require_room(number: float, what: str) -> int:
    """Return a number of particles, rounded, if memory is available for them.

    Parameters
    ----------
    number
        Number of particles, infinite if that overflows.
    what
        Beginning of a message: the entries that give the number.

    Raises
    ------
    InputError
        If it is zero, or if there is not enough memory for them.
    """
    need, there = number * BYTES, memory()
    if not need < there:
        raise InputError(
            f"{what} gives {number:.3g} particles, which need about {size_text(need)} of memory; "
            f"{size_text(there)} are available."
        )
    n = round(number)
    if n == 0:
        raise InputError(f"{what} gives no particle.")
    return n


def start_of_injection(model: Injection, flow: Flow) -> float:
    """Return ``SOI``, s, or by default the first time of the flow, 0 for a steady flow."""
    first = flow.span[0]
    return model.SOI if model.SOI != START_OF_FLOW else first if math.isfinite(first) else 0.0


def pending(places: Places, rows: slice = slice(None)) -> Particles:
    """Return pending spheres at some places of release, of zero size, density and stiffness."""
    x, t = places.x[rows], places.t[rows]
    p = empty(len(t))
    p.x[:] = p.x0[:] = x
    p.host[:] = places.hosts[rows]
    p.t0[:] = p.t[:] = t
    p.v[:] = np.broadcast_to(np.nan if places.v is None else places.v, (len(places.t), 3))[rows]
    return p


def given_shear_modulus(
    columns: Mapping[str, Floats], poissons_ratio: float | None, mu: float, shear_rate: float | None
) -> Floats | None:
    """Return the shear moduli μ_s of a file, (n,), Pa; None if it gives no stiffness.

    Parameters
    ----------
    columns
        Columns of the file: ``shearModulus``, ``youngsModulus`` (2(1 + ν_s) μ_s) or ``Ca`` (μ_f γ̇/μ_s).
    poissons_ratio
        ν_s, which ``youngsModulus`` needs.
    mu, shear_rate
        Viscosity μ_f of the fluid, Pa s, and γ̇, 1/s, to which Ca refers.

    Raises
    ------
    InputError
        If there are several of these columns, or if ``Ca`` or ``youngsModulus`` lacks its second quantity.
    """
    names = [name for name in ("shearModulus", "youngsModulus", "Ca") if name in columns]
    if len(names) > 1:
        raise InputError(f"the file of positions gives {' and '.join(names)}, but one of them is enough.")
    if "Ca" in names and shear_rate is None:
        raise InputError(
            "the file of positions gives Ca, which needs the entry referenceShearRate of the solid."
        )
    if "youngsModulus" in names and poissons_ratio is None:
        raise InputError(
            "the file of positions gives youngsModulus, which needs the entry poissonsRatio of the solid."
        )
    if not names:
        return None
    column = columns[names[0]]
    with np.errstate(over="ignore"):
        if names == ["Ca"]:
            return np.asarray(mu * (shear_rate or 0.0) / column)
        return 0.5 * column / (1.0 + (poissons_ratio or 0.0)) if names == ["youngsModulus"] else column


INJECTIONS: dict[str, type[Injection]] = {
    "boxInjection": BoxInjection,
    "cellZoneInjection": CellZoneInjection,
    "coneInjection": ConeInjection,
    "lineInjection": LineInjection,
    "manualInjection": ManualInjection,
    "patchFlowRateInjection": PatchFlowRateInjection,
    "patchInjection": PatchInjection,
    "sphereInjection": SphereInjection,
}
"""By the word that ``type`` selects."""
