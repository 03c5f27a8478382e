"""A flow that changes in time: fields written at some times, linear in time between them.

Only the times about the present one are in memory; the next is read and reconstructed in the background while
particles advance. The mesh does not move.
"""

from __future__ import annotations

import math
import re
from bisect import bisect_left, bisect_right
from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.tensor import Tensor, Vector
from foamprb.errors import InputError
from foamprb.flow.base import PatchFaces, Tetrahedra
from foamprb.flow.mesh.locator import MeshArrays, locate, no_mesh
from foamprb.flow.mesh.mesh import Floats, Ints, Mesh
from foamprb.flow.read.foamfile import existing
from foamprb.flow.read.openfoam import (
    PRECISION_NOTE,
    VelocityReader,
    available_times,
    pick_time,
    read_case,
    read_fields,
    select_time,
)
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.walk import MeshFlow, corners, interpolate, inward, sample_with, shape
from foamprb.flow.walk import cross as still_cross
from foamprb.flow.walk import gap as still_gap
from foamprb.flow.walk import walk as still_walk

__all__ = ["SeriesArrays", "SeriesFlow", "choose_times", "read_series", "select_times", "stream"]

_SLACK = 1e-6
"""Share of the shortest interval by which two times may differ and still be the same."""
_MOST_KEPT = 1 << 28
"""Bytes up to which all times of a periodic flow stay in memory."""
_OPEN_LOOP = 2.0
"""How much longer than any other interval the last one of a period may be."""


class SeriesArrays(NamedTuple):
    """What the kernels know of a flow on a mesh at the times that are loaded."""

    mesh: MeshArrays
    times: Floats
    """(n,) rising, s."""
    first: NDArray[np.int64]
    """(n,) 64-bit, row of ``fields`` at which the nodes of each time begin."""
    fields: Floats
    """(rows, 12): u v w and the nine ∂u_i/∂x_j row by row, time by time."""
    slack: float
    """Times closer than this are the same, s."""


def sample(flow: SeriesArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity u (m/s), l_ij = ∂u_i/∂x_j (1/s) and ∂u/∂t (m/s²), linear in the tetrahedron ``host`` and in t.

    At a loaded time ∂u/∂t is that of the interval after it, if that is loaded.
    """
    k = 0
    while k < flow.times.shape[0] - 2 and t > flow.times[k + 1] - 2.0 * flow.slack:
        k += 1
    w = shape(flow.mesh, host, x)
    u0, l0 = interpolate(flow.fields, 0, corners(flow.mesh, host, flow.first[k]), w)
    u1, l1 = interpolate(flow.fields, 0, corners(flow.mesh, host, flow.first[k + 1]), w)
    length = flow.times[k + 1] - flow.times[k]
    s = (t - flow.times[k]) / length
    d = (u1[0] - u0[0], u1[1] - u0[1], u1[2] - u0[2])
    u = (u0[0] + s * d[0], u0[1] + s * d[1], u0[2] + s * d[2])
    l = (
        l0[0] + s * (l1[0] - l0[0]), l0[1] + s * (l1[1] - l0[1]), l0[2] + s * (l1[2] - l0[2]),
        l0[3] + s * (l1[3] - l0[3]), l0[4] + s * (l1[4] - l0[4]), l0[5] + s * (l1[5] - l0[5]),
        l0[6] + s * (l1[6] - l0[6]), l0[7] + s * (l1[7] - l0[7]), l0[8] + s * (l1[8] - l0[8]),
    )  # fmt: skip
    return u, l, (d[0] / length, d[1] / length, d[2] / length)


def walk(flow: SeriesArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """:func:`foamprb.flow.walk.walk` on the mesh, which does not move."""
    return still_walk(flow.mesh, host, x0, x1)


def gap(flow: SeriesArrays, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """:func:`foamprb.flow.walk.gap`."""
    return still_gap(flow.mesh, host, x, F, R)


def normal(flow: SeriesArrays, triangle: int, x: Vector) -> Vector:  # noqa: ARG001
    """:func:`foamprb.flow.walk.normal`."""
    return inward(flow.mesh, triangle)


def cross(flow: SeriesArrays, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """:func:`foamprb.flow.walk.cross`."""
    return still_cross(flow.mesh, triangle, x)


def recover(flow: SeriesArrays, x: Vector) -> int:
    """:func:`foamprb.flow.walk.recover`."""
    return locate(flow.mesh, x)


class SeriesFlow:
    """A flow given by u and ∇u at the nodes of a mesh at several times, linear between them.

    Parameters
    ----------
    mesh
        The mesh.
    times
        Rising, at least two, s.
    read
        Gives u (n_nodes, 3) in m/s and l (n_nodes, 3, 3) in 1/s of the time with a given index; it is called
        by one thread at a time, not always the same.
    period
        Duration after which the flow repeats itself, s: the times before ``times[0] + period`` count, and at
        that time the first field comes again.
    notes
        What the user should know about the flow, sentence by sentence.
    keep
        Number of times to keep in memory, if more than a step needs.
    zones
        Gives the cells of each zone, by name; it is called when a zone is asked for.

    Raises
    ------
    InputError
        The times do not rise, or do not fill the period.
    """

    kernels: dict[str, Callable[..., Any]] = {  # noqa: RUF012
        "sample": sample,
        "walk": walk,
        "gap": gap,
        "normal": normal,
        "cross": cross,
        "recover": recover,
    }

    def __init__(
        self,
        mesh: Mesh,
        times: Sequence[float],
        read: Callable[[int], tuple[Floats, Floats]],
        period: float | None = None,
        notes: Iterable[str] = (),
        keep: int = 0,
        zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
    ) -> None:
        self.times = tuple(times) if period is None else _one_period(times, period)
        if np.any(np.diff(self.times) <= 0.0):
            raise InputError(f"the times {', '.join(f'{t:g}' for t in self.times)} do not rise.")
        self.period = period
        self.mesh = mesh
        nodes = mesh.n_points + mesh.n_cells
        self._still = MeshFlow(mesh, np.zeros((nodes, 3)), np.zeros((nodes, 3, 3)), notes, zones)
        self.patches, self.notes, self.bounds = self._still.patches, self._still.notes, self._still.bounds
        self._read, self._keep = read, keep
        self._ends = self.times if period is None else (*self.times, self.times[0] + period)
        self._slack = _SLACK * float(np.diff(self._ends).min())
        self.span = (self.times[0], self.times[-1] if period is None else math.inf)
        self._fields = np.empty((0, nodes, 12))
        self._held: dict[int, int] = {}
        """Place in ``_fields`` of each time in memory, by its index, the longest unused first."""
        self._levels = range(0)
        self._reader = ThreadPoolExecutor(1, "foamprb-read")
        self._ahead: tuple[int, Future[tuple[Floats, Floats]]] | None = None

    @staticmethod
    def nothing() -> SeriesArrays:
        """As :meth:`MeshFlow.nothing`."""
        return SeriesArrays(no_mesh(), np.empty(0), np.empty(0, dtype=np.int64), np.empty((0, 12)), 0.0)

    def load(self, start: float, end: float) -> float:
        """Hold the times from the last one up to ``start`` to the first one from ``end`` on, and return that.

        Raises
        ------
        InputError
            The flow does not reach so far, or one of its times cannot be read.
        """
        if not (self.span[0] - self._slack <= start and end <= self.span[1] + self._slack):
            raise InputError(
                f"the flow is known from {self.span[0]:.12g} s to {self.span[1]:.12g} s, "
                f"not from {start:.12g} s to {end:.12g} s"
            )
        first, last = self._level_before(start), self._level_after(end)
        if last == first:
            # At one of the times either interval would do, but to the last bit it must always be the same.
            first, last = (first - 1, last) if self._is_level(first - 1) else (first, last + 1)
        levels = range(first, last + 1)
        wanted = [self._index(level) for level in levels]
        self._make_room(wanted)
        for index in wanted:
            self._hold(index)
        self._levels = levels
        following = self._index(last + 1)
        if self._is_level(last + 1) and following not in self._held:
            self._read_ahead(following)
        return self._time(last)

    def arrays(self, reach: float = 0.0, touchable: Sequence[int] | None = None) -> SeriesArrays:
        """What the kernels read, at the times that were loaded last; see :meth:`MeshFlow.arrays`."""
        nodes = self._fields.shape[1]
        places = [self._held[self._index(level)] for level in self._levels]
        return SeriesArrays(
            self._still.arrays(reach, touchable),
            np.array([self._time(level) for level in self._levels]),
            np.array(places, dtype=np.int64) * nodes,
            self._fields.reshape(-1, 12),
            self._slack,
        )

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """As :meth:`MeshFlow.move`; the fields change, and stay."""
        self._still.move(place)
        self.mesh = self._still.mesh

    def traits(self) -> Mapping[str, ArrayLike]:
        """Mesh, times, and velocities at the first of them, by name."""
        self.load(self.times[0], self.times[0])
        first = self._fields[self._held[0]]
        return {**self._still.traits(), "times": self.times, "period": self.period or 0.0, "fields": first}

    def locate(self, points: Floats) -> Ints:
        """Hosts of the points (n, 3): (n,) tetrahedra, −1 for a point outside the mesh."""
        return self._still.locate(points)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Velocity (n, 3), m/s, and ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) in hosts (n,) at time t, s.

        Raises
        ------
        InputError
            As :meth:`load`.
        """
        self.load(t, t)
        return sample_with(sample, self.arrays(), points, hosts, t)

    def cell_size(self, hosts: Ints) -> Floats:
        """Cube root of the volume of the hosts' cells, (n,), m."""
        return self._still.cell_size(hosts)

    def cell_zone(self, name: str) -> Tetrahedra:
        """Tetrahedra of a zone of cells; InputError when there is no such zone."""
        return self._still.cell_zone(name)

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Triangles of the patch ``name`` at time t, s.

        Raises
        ------
        InputError
            There is no such patch; or as :meth:`load`.
        """
        faces = self._still.patch_faces(name, t)
        corners = faces.vertices.reshape(-1, 3)
        velocity, _ = self.sample(corners, np.repeat(faces.hosts, 3), t)
        return faces._replace(velocity=velocity.reshape(-1, 3, 3))

    # A level is a time counted on through all periods; its index is that of the field it has.

    def _index(self, level: int) -> int:
        return level if self.period is None else level % len(self.times)

    def _time(self, level: int) -> float:
        if self.period is None:
            return self.times[level]
        cycle, index = divmod(level, len(self.times))
        return self.times[index] + cycle * self.period

    def _is_level(self, level: int) -> bool:
        return level >= 0 and (self.period is not None or level < len(self.times))

    def _level_before(self, t: float) -> int:
        """The last level up to t."""
        cycle, rest = self._cycle(t)
        return max(0, cycle * len(self.times) + bisect_right(self._ends, rest + self._slack) - 1)

    def _level_after(self, t: float) -> int:
        """The first level from t on."""
        cycle, rest = self._cycle(t)
        return cycle * len(self.times) + min(bisect_left(self._ends, rest - self._slack), len(self._ends) - 1)

    def _cycle(self, t: float) -> tuple[int, float]:
        """The period in which t lies, and the time in the first that corresponds to t."""
        if self.period is None:
            return 0, t
        cycle = math.floor((t - self.times[0]) / self.period)
        return cycle, t - cycle * self.period

    def _make_room(self, wanted: Sequence[int]) -> None:
        capacity = max(len(set(wanted)), min(self._keep, len(self.times)))
        if capacity > len(self._fields):
            fields = np.empty((capacity, *self._fields.shape[1:]))
            fields[: len(self._fields)] = self._fields
            self._fields = fields
        for index in wanted:
            if index in self._held:
                self._held[index] = self._held.pop(index)

    def _hold(self, index: int) -> None:
        if index in self._held:
            return
        u, l = self._result(index)
        if len(self._held) < len(self._fields):
            place = len(self._held)
        else:
            place = self._held.pop(next(iter(self._held)))
        self._fields[place, :, :3] = u
        self._fields[place, :, 3:] = l.reshape(-1, 9)
        self._held[index] = place

    def _result(self, index: int) -> tuple[Floats, Floats]:
        if self._ahead is None or self._ahead[0] != index:
            self._ahead = index, self._reader.submit(self._read, index)
        future = self._ahead[1]
        self._ahead = None
        return future.result()

    def _read_ahead(self, index: int) -> None:
        if self._ahead is None or self._ahead[0] != index:
            self._ahead = index, self._reader.submit(self._read, index)


def _one_period(times: Sequence[float], period: float) -> tuple[float, ...]:
    """The times of the first period; raise InputError if they do not fill it."""
    end = times[0] + period
    first = tuple(t for t in times if t < end - _SLACK * period)
    steps = np.diff([*first, end])
    if len(first) < 2 or steps[-1] > _OPEN_LOOP * steps[:-1].max():
        raise InputError(
            f"the period {period:g} s asks for fields up to nearly {end:g} s, but of the {len(times)} times "
            f"from {times[0]:g} s on the last before that is {first[-1]:g} s."
        )
    return first


_RANGE = re.compile(r"([^:]*):([^:]*)")


def select_times(case: Path, selection: str | None = None, region: str = "") -> tuple[str, ...]:
    """Names of the time directories of a case that ``selection`` means, as :func:`choose_times`.

    Raises
    ------
    InputError
        The case cannot be read; or as :func:`choose_times`.
    """
    select_time(case, region=region)
    return choose_times(case, available_times(case), selection)


def choose_times(source: Path, names: Sequence[str], selection: str | None = None) -> tuple[str, ...]:
    """The names of times that OpenFOAM's option ``-time`` would select, in the order of time.

    Parameters
    ----------
    source
        What has these times, for the messages.
    names
        The names of all times, in their order; at least one.
    selection
        Values and ranges ``a:b``, ``a:`` or ``:b`` (ends included), with commas or blanks between them;
        ``latestTime``; None for all.

    Raises
    ------
    InputError
        A value or a range selects nothing.
    """
    if selection is None:
        return tuple(names)
    chosen: set[str] = set()
    for word in re.split(r"[,\s]+", selection.strip()):
        if match := _RANGE.fullmatch(word):
            low, high = _bound(source, word, match[1], -math.inf), _bound(source, word, match[2], math.inf)
            found = {name for name in names if low <= float(name) <= high}
            if not found:
                raise InputError(f"{source}: no time in {word}; the times go from {names[0]} to {names[-1]}.")
            chosen |= found
        else:
            chosen.add(names[pick_time(source, names, word)])
    return tuple(name for name in names if name in chosen)


def _bound(source: Path, word: str, text: str, default: float) -> float:
    try:
        value = float(text or default)
    except ValueError:
        value = math.nan
    if math.isnan(value):
        raise InputError(f"{source}: '{word}' is no range of times, such as 0.1:0.5, 0.1: or :0.5.")
    # Names of times are rounded.
    return value + math.copysign(1e-9 * abs(value), default) if text else value


def read_series(
    case: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    prepare: Callable[[str], None] | None = None,
) -> SeriesFlow | MeshFlow:
    """Read the flow of a case at several of its times, as it is needed; a single time is a steady flow.

    Parameters
    ----------
    case
        The case's folder.
    times
        As :func:`choose_times`.
    period
        Duration after which the flow repeats itself, s.
    velocity, region, gradient
        As :func:`foamprb.flow.read.openfoam.read_case`.
    prepare
        Called with the name of a time directory before it is read.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent: the case, a time, a field, the mesh or a patch; a mesh that
        moves; times that do not fill the period.
    """
    case = Path(case)
    names = select_times(case, times, region)
    if prepare is not None:
        prepare(names[0])
    if len(names) == 1:
        return read_case(case, names[0], velocity, region, gradient)
    _refuse_moving(case, names, region)
    mesh, *_ = read_fields(case, names[0], velocity, region)
    reconstruct = Reconstruction(mesh)
    reader = VelocityReader(case, names[0], velocity, region, gradient)

    def read(name: str) -> tuple[Floats, Floats]:
        if prepare is not None:
            prepare(name)
        return reconstruct(*reader(name))

    return stream(case, mesh, names, read, period, [PRECISION_NOTE], reader.zones)


def stream(
    source: Path,
    mesh: Mesh,
    names: Sequence[str],
    read: Callable[[str], tuple[Floats, Floats]],
    period: float | None,
    notes: Sequence[str],
    zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
) -> SeriesFlow:
    """Make a flow of the times of a case or a file, in memory as few as needed, or all of a short period.

    Parameters
    ----------
    source
        What it comes from, for the messages.
    mesh
        The mesh, of all times.
    names
        The names of the times, rising.
    read
        Gives u and l at the nodes of the time with a given name, as :class:`SeriesFlow`'s.
    period, notes, zones
        As :class:`SeriesFlow`'s.

    Raises
    ------
    InputError
        The times do not rise, or do not fill the period.
    """
    note = f"The flow is linear in time between {len(names)} times from {names[0]} to {names[-1]}"
    note += "." if period is None else f", and repeats itself every {period:g} s."
    a_time = 96 * (mesh.n_points + mesh.n_cells)
    keep = _MOST_KEPT // a_time if period is not None else 0
    times = [float(name) for name in names]
    try:
        return SeriesFlow(mesh, times, lambda i: read(names[i]), period, [*notes, note], keep, zones)
    except InputError as error:
        raise InputError(f"{source}: {error}") from None


def _refuse_moving(case: Path, names: Sequence[str], region: str) -> None:
    for name in names[1:]:
        for part in ("points", "faces"):
            path = existing(case / name / region / "polyMesh" / part)
            if path is not None:
                raise InputError(f"{path}: the mesh changes in time; only meshes at rest can be read.")
