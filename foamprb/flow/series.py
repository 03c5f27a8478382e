"""Flow that changes in time: fields given at several times, linear in time between them.

Only the times around the current one are in memory; the next one is prefetched while particles advance. The
mesh does not move.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector, between, dot_vector, minus, plus
from foamprb.compile.record import record
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints, PatchFaces, Planes, Turbulence
from foamprb.flow.fields import FieldColumns, Fields, fields_on, width
from foamprb.flow.kernels import named
from foamprb.flow.mesh.arrays import MeshArrays, no_mesh
from foamprb.flow.mesh.locator import locate
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.planes import walls as walls_mesh
from foamprb.flow.sampling import sample_with, with_velocity
from foamprb.flow.timeline import Timeline
from foamprb.flow.traits import of_rows
from foamprb.flow.viscosity import blend_scalar
from foamprb.flow.walk import (
    FAILED,
    blend_curvature,
    blend_turbulence,
    corners,
    correction_at,
    curvature_of_nodes,
    follow,
    from_middle,
    interpolate,
    inward,
    shape,
    shape_and_sides,
)
from foamprb.flow.walk import cell_volume as cell_volume_mesh
from foamprb.flow.walk import cross as cross_mesh
from foamprb.flow.walk import walk as walk_mesh
from foamprb.flow.walk import walk_on as walk_on_mesh
from foamprb.flow.walls import gap as gap_mesh
from foamprb.flow.wedge import is_wedge, stretched, tangent, turned_curvature
from foamprb.memory import clear, sparse_zeros

_OF_VELOCITY, _OF_TURBULENCE, _OF_VISCOSITY = 12, 8, 4
"""Columns of u and ∇u, of the turbulence after them, and of the viscosity at the end."""


@record
class SeriesArrays(NamedTuple):
    """Arrays of a transient flow that the kernels read: the mesh, and the fields at the loaded times."""

    mesh: MeshArrays
    times: Floats
    """(n,) rising, s."""
    first: NDArray[np.int64]
    """(n,) 64-bit, row of ``fields`` at which the nodes of each time begin."""
    fields: Floats
    """(rows, 12 or more): u v w and the nine ∂u_i/∂x_j row by row, time by time; k, ε, ∇k and ∇(k²/3ε) if
    they were read; last viscosity and its gradient, if it was."""
    slack: float
    """Times closer than this are the same, s."""
    curvatures: NDArray[np.float32]
    """(rows, 18) as those of :class:`MeshArrays`, time by time; no rows for none."""
    first_tet: NDArray[np.int64]
    """(n,) row of ``correction`` at which the tetrahedra of each time begin."""
    correction: NDArray[np.float32]
    """(rows, 4) as that of :class:`MeshArrays`, time by time; no rows for none."""
    first_face: NDArray[np.int64]
    """(n,) row of ``phi`` at which the faces of each time begin."""
    phi: Floats
    """(rows,) as that of :class:`MeshArrays`, time by time."""


def sample(flow: SeriesArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return u + c (m/s), l_ij = ∂u_i/∂x_j (1/s) and ∂u/∂t − l·c (m/s²), linear in t.

    See :func:`foamprb.flow.walk.sample`. At a loaded time ∂u/∂t is the one of the following interval, if that
    interval is loaded.
    """
    k = _interval(flow, t)
    sides, scale, w = shape_and_sides(flow.mesh, host, x)
    u0, l0 = interpolate(flow.mesh, host, flow.fields, 0, flow.first[k], w)
    u1, l1 = interpolate(flow.mesh, host, flow.fields, 0, flow.first[k + 1], w)
    length = flow.times[k + 1] - flow.times[k]
    s = (t - flow.times[k]) / length
    d = minus(u1, u0)
    l = (
        l0[0] + s * (l1[0] - l0[0]), l0[1] + s * (l1[1] - l0[1]), l0[2] + s * (l1[2] - l0[2]),
        l0[3] + s * (l1[3] - l0[3]), l0[4] + s * (l1[4] - l0[4]), l0[5] + s * (l1[5] - l0[5]),
        l0[6] + s * (l1[6] - l0[6]), l0[7] + s * (l1[7] - l0[7]), l0[8] + s * (l1[8] - l0[8]),
    )  # fmt: skip
    c = between(
        correction_at(
            flow.mesh, flow.correction, flow.first_tet[k] + host, flow.phi, flow.first_face[k],
            flow.fields, 0, flow.first[k], host, w, sides, scale,
        ),
        correction_at(
            flow.mesh, flow.correction, flow.first_tet[k + 1] + host, flow.phi, flow.first_face[k + 1],
            flow.fields, 0, flow.first[k + 1], host, w, sides, scale,
        ),
        s,
    )  # fmt: skip
    u, u_t = between(u0, u1, s), (d[0] / length, d[1] / length, d[2] / length)
    if is_wedge(flow.mesh.layer):
        u_t = stretched(flow.mesh.layer, tangent(flow.mesh.layer, x), u_t)
        u, c, l = from_middle(flow.mesh, x, u, c, l)
    return plus(u, c), l, minus(u_t, dot_vector(l, c))


def _interval(flow: SeriesArrays, t: float) -> int:
    """Return the index of the interval between loaded times that holds t."""
    k = 0
    while k < flow.times.shape[0] - 2 and t > flow.times[k + 1] - 2.0 * flow.slack:
        k += 1
    return k


def turbulence(flow: SeriesArrays, host: int, x: Vector, t: float) -> Turbulence:
    """See :func:`foamprb.flow.walk.turbulence`; linear in t."""
    if flow.fields.shape[1] <= _OF_VELOCITY:
        return 0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    k = _interval(flow, t)
    w = shape(flow.mesh, host, x)
    a = blend_turbulence(flow.fields, _OF_VELOCITY, corners(flow.mesh, host, flow.first[k]), w)
    b = blend_turbulence(flow.fields, _OF_VELOCITY, corners(flow.mesh, host, flow.first[k + 1]), w)
    s = (t - flow.times[k]) / (flow.times[k + 1] - flow.times[k])
    k_epsilon = a[0] + s * (b[0] - a[0]), a[1] + s * (b[1] - a[1])
    return *k_epsilon, between(a[2], b[2], s), between(a[3], b[3], s)


def viscosity(flow: SeriesArrays, host: int, x: Vector, t: float) -> tuple[float, Vector]:
    """See :func:`foamprb.flow.viscosity.viscosity`; linear in t. The loop requests it only if it was read."""
    k = _interval(flow, t)
    w, column = shape(flow.mesh, host, x), flow.fields.shape[1] - _OF_VISCOSITY
    a, da = blend_scalar(flow.fields, column, corners(flow.mesh, host, flow.first[k]), w)
    b, db = blend_scalar(flow.fields, column, corners(flow.mesh, host, flow.first[k + 1]), w)
    s = (t - flow.times[k]) / (flow.times[k + 1] - flow.times[k])
    return a + s * (b - a), between(da, db, s)


def curvature(flow: SeriesArrays, host: int, x: Vector, t: float) -> Curvature:
    """See :func:`foamprb.flow.walk.curvature`; linear in t."""
    k = _interval(flow, t)
    s = (t - flow.times[k]) / (flow.times[k + 1] - flow.times[k])
    a, b = _curvature_at(flow, host, x, k), _curvature_at(flow, host, x, k + 1)
    return (
        between(a[0], b[0], s), between(a[1], b[1], s), between(a[2], b[2], s),
        between(a[3], b[3], s), between(a[4], b[4], s), between(a[5], b[5], s),
    )  # fmt: skip


def _curvature_at(flow: SeriesArrays, host: int, x: Vector, k: int) -> Curvature:
    """Return the second derivatives at the k-th of the loaded times."""
    if flow.curvatures.shape[0] == 0:
        return curvature_of_nodes(flow.mesh, host, x, flow.fields, 3, flow.first[k])
    rows = corners(flow.mesh, host, flow.first[k])
    h = blend_curvature(flow.curvatures, rows, shape(flow.mesh, host, x))
    return turned_curvature(flow.mesh.layer, x, h) if is_wedge(flow.mesh.layer) else h


def walk(flow: SeriesArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk`."""
    return walk_mesh(flow.mesh, host, x0, x1)


def walk_on(flow: SeriesArrays, host: int, ahead: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk_on`."""
    return walk_on_mesh(flow.mesh, host, ahead, x0, x1)


def host_ahead(flow: Any, host: int, x0: Vector, x1: Vector) -> tuple[int, int]:
    """Return the host at the end of a segment, that at its start if the walk fails, and the cells entered."""
    last, _, patch, _, entered = follow(flow.mesh, host, x0, x1)
    return host if patch == FAILED else last, entered


def sample_ahead(
    flow: SeriesArrays, host: int, x0: Vector, x1: Vector, t1: float
) -> tuple[int, float, int, Vector, Tensor, Vector]:
    """See :func:`foamprb.flow.kernels.sample_ahead`."""
    last, entered = host_ahead(flow, host, x0, x1)
    u, l, u_t = sample(flow, last, x1, t1)
    return last, 0.0, entered, u, l, u_t


def gap(
    flow: SeriesArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """See :func:`foamprb.flow.walk.gap`."""
    return gap_mesh(flow.mesh, host, x, F, R, mode)


def walls(flow: SeriesArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8]) -> Planes:
    """See :func:`foamprb.flow.planes.walls`."""
    return walls_mesh(flow.mesh, host, x, cut, chosen)


def normal(flow: SeriesArrays, triangle: int, x: Vector) -> Vector:  # noqa: ARG001
    """See :func:`foamprb.flow.walk.normal`."""
    return inward(flow.mesh, triangle)


def cross(flow: SeriesArrays, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """See :func:`foamprb.flow.walk.cross`."""
    return cross_mesh(flow.mesh, triangle, x)


def recover(flow: SeriesArrays, x: Vector) -> int:
    """See :func:`foamprb.flow.walk.recover`."""
    return locate(flow.mesh, x)


def cell_volume(flow: SeriesArrays, host: int) -> float:
    """See :func:`foamprb.flow.walk.cell_volume`."""
    return cell_volume_mesh(flow.mesh, host)


class SeriesFlow(Timeline, MeshFlow):
    """Flow given by u and ∇u at the nodes of a mesh at several times, linear between them.

    Parameters
    ----------
    mesh
        The mesh.
    times
        At least two, rising, s.
    read
        Returns u (n_nodes, 3), m/s, and l (n_nodes, 3, 3), 1/s, at the time of an index; with ``turbulent``
        also k, ε, ∇k and ∇(k²/3ε), (n_nodes, 8); with ``viscous`` also the viscosity and its gradient,
        (n_nodes, 4); with ``sampled`` also these fields, (n_nodes, columns); with ``conservative`` the
        fluxes that keep volume, (n_faces,) (:mod:`foamprb.flow.fluxes`); with ``curved`` last the second
        derivatives, (n_nodes, 18). One thread at a time calls it, not always the same.
    period
        Duration after which the flow repeats itself, s. Times from ``times[0] + period`` on are ignored; at
        that time the first field follows.
    notes
        Sentences for the user about the flow.
    keep
        Number of times to keep in memory, if more than a step needs.
    zones
        Returns the cells of each zone by name; called when a zone is requested.
    turbulent, conservative, viscous, curved
        Whether ``read`` returns the turbulence, the fluxes, the viscosity, and the second derivatives.
    sampled
        Further fields that ``read`` returns.

    Raises
    ------
    InputError
        The times do not rise, or do not fill the period.
    """

    kernels = named(
        sample, sample_ahead, curvature, walk, walk_on, gap, walls, normal, cross, recover,
        turbulence, viscosity, cell_volume
    )  # fmt: skip
    around = 2
    """Number of times to load for each interval, if there are so many."""

    def __init__(
        self,
        mesh: Mesh,
        times: Sequence[float],
        read: Callable[[int], tuple[Any, ...]],
        period: float | None = None,
        notes: Iterable[str] = (),
        keep: int = 0,
        zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
        turbulent: bool = False,
        conservative: bool = False,
        viscous: bool = False,
        sampled: Sequence[FieldColumns] = (),
        curved: bool = False,
    ) -> None:
        super().__init__(mesh, None, None, notes, zones)
        mesh = self.mesh
        nodes = mesh.n_points + mesh.n_cells
        self._set_times(times, period)
        self._read, self._keep = read, keep
        self._turbulent, self._viscous = turbulent, viscous
        self.field_columns = tuple(sampled)
        self.field_table: NDArray[np.float64] = np.empty((0, nodes, width(sampled)))
        self._fields = np.empty((0, nodes, _width(turbulent, viscous)))
        self._corrections = np.empty((0, len(mesh.tets) if conservative else 0, 4), dtype=np.float32)
        self._fluxes = np.empty((0, len(mesh.owner) if conservative else 0))
        self._curvatures = np.empty((0, nodes if curved else 0, 18), dtype=np.float32)
        self._in_memory: dict[int, int] = {}
        """Row in ``_fields`` of each loaded time by its index, the least recently used first."""
        self._levels = self._inner = range(0)
        self._sums: dict[int, Floats] = {}
        """Sums over the fields at some loaded times, by their indices."""
        self._reader = ThreadPoolExecutor(1, "foamprb-read")
        self._prefetched: tuple[int, Future[tuple[Any, ...]]] | None = None

    @staticmethod
    def nothing() -> SeriesArrays:  # type: ignore[override]
        """See :meth:`MeshFlow.nothing`."""
        rows = np.empty(0, dtype=np.int64)
        return SeriesArrays(
            no_mesh(), np.empty(0), rows, np.empty((0, 12)), 0.0, np.empty((0, 18), dtype=np.float32),
            rows, np.empty((0, 4), dtype=np.float32), rows, np.empty(0),
        )  # fmt: skip

    def load(self, start: float, end: float) -> float:
        """Load the times from the last one up to ``start`` to the first one from ``end`` on.

        Returns
        -------
        The last of these times, s.
        """
        self._inner = self._levels_for(start, end)
        first, last = self._inner[0], self._inner[-1]
        for extra in range(self.around - 2):
            # On both sides in turn, on the other one at the ends of the flow.
            if self._is_level(last + 1) and (extra % 2 or not self._is_level(first - 1)):
                last += 1
            elif self._is_level(first - 1):
                first -= 1
        self._levels = range(first, last + 1)
        wanted = [self._index(level) for level in self._levels]
        self._make_room(wanted)
        for index in wanted:
            self._fetch(index)
        following = self._levels[-1] + 1
        if self._is_level(following) and self._index(following) not in self._in_memory:
            self._prefetch(self._index(following))
        return self._time_of(self._inner[-1])

    def arrays(  # type: ignore[override]
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> SeriesArrays:
        """Return the arrays for the kernels at the times loaded last; see :meth:`MeshFlow.arrays`."""
        nodes, tets, faces = self._fields.shape[1], self._corrections.shape[1], self._fluxes.shape[1]
        places = np.array([self._in_memory[self._index(level)] for level in self._levels], dtype=np.int64)
        times = np.array([self._time_of(level) for level in self._levels])
        return SeriesArrays(
            super().arrays(reach, touchable, sight, seen),
            times,
            places * nodes,
            self._fields.reshape(-1, self._fields.shape[2]),
            self._slack(float(times.max(initial=self.times[0]))),
            self._curvatures.reshape(-1, 18),
            places * tets,
            self._corrections.reshape(-1, 4),
            places * faces,
            self._fluxes.reshape(-1),
        )

    def _first(self) -> Floats:
        """Return the fields (n_nodes, 12 or 20) at the first time."""
        self.load(self.times[0], self.times[0])
        first: Floats = self._fields[self._in_memory[0]]
        return first

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """Return the name of the first time, and u (n, 3), m/s, and ∂u_i/∂x_j (n, 9), 1/s, at all nodes."""
        first = self._first()
        return f"{self.times[0]:g}", *self._turned_back(first[:, :_OF_VELOCITY])

    def turbulence_at_nodes(self) -> Floats:
        """Return k, ε, ∇k and ∇(k²/3ε) (n, 8) at all nodes at the first time; no rows if not read."""
        if not self._turbulent:
            return np.empty((0, _OF_TURBULENCE))
        return self._first()[:, _OF_VELOCITY : _OF_VELOCITY + _OF_TURBULENCE]

    def viscosity(self, points: Floats, hosts: Ints, t: float) -> Floats:
        """Load time t and sample there; see :meth:`MeshFlow.viscosity` and :meth:`load`."""
        self.load(t, t)
        return super().viscosity(points, hosts, t)

    def viscosity_at_nodes(self) -> Floats:
        """Return the field of the viscosity at all nodes at the first time, as it was read, (n,)."""
        return self._first()[:, -_OF_VISCOSITY] if self._viscous else np.empty(0)

    def fields(self, start: float, end: float) -> Fields:
        """Load times and return the fields that are sampled; see :meth:`MeshFlow.fields` and :meth:`load`."""
        self.load(start, end)
        return self.loaded_fields()

    def loaded_fields(self) -> Fields:
        """See :meth:`MeshFlow.loaded_fields`; at the times loaded last."""
        rows, nodes, columns = self.field_table.shape
        first = [self._in_memory[self._index(level)] * nodes for level in self._levels]
        times = [self._time_of(level) for level in self._levels]
        return fields_on(
            self._arrays,
            self.field_table.reshape(rows * nodes, columns),
            self.field_columns,
            first,
            times,
            self._slack(max(times, default=self.times[0])),
        )

    def roughness(self) -> float:
        """See :meth:`foamprb.flow.base.Flow.roughness`."""
        if not self._levels:
            return 0.0
        # A step across a time loads earlier ones, too: the last one depends on the step alone.
        index = self._index(self._levels[-1])
        fields = self._fields[self._in_memory[index]]
        return self._roughness_at(index, fields[:, :3], fields[:, 3:_OF_VELOCITY])

    def traits(self) -> Mapping[str, ArrayLike]:
        """Return the arrays of the mesh, of the first time, and all times of a period, by name.

        Later times may be added to a flow without period (:meth:`extend`).
        """
        first = self._first()
        times = self.times[: 1 if self.period is None else None]
        return {
            **super().traits(),
            "times": times,
            "period": self.period or 0.0,
            "fields": first,
            "fluxes": self._fluxes[self._in_memory[0]],
        }

    def sums_around(self, t: float) -> Floats:
        """Load time t, s, and return sums over the fields at the times around it, (n, 2, columns)."""
        self.load(t, t)
        wanted = [self._index(level) for level in self._levels]
        fields = {index: self._fields[self._in_memory[index]] for index in wanted}
        numbers = np.arange(self._fields.shape[1])
        self._sums = {i: self._sums[i] if i in self._sums else of_rows(f, numbers) for i, f in fields.items()}
        return np.array([self._sums[index] for index in wanted])

    @property
    def _first_table(self) -> Floats:
        table: Floats = self.field_table[self._in_memory[0]]
        return table

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Load time t and sample there; see :meth:`MeshFlow.sample` and :meth:`load`."""
        self.load(t, t)
        return sample_with(sample, self.arrays(), points, hosts, t)

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Return the triangles of a patch at time t, s; see :meth:`MeshFlow.patch_faces` and :meth:`load`."""
        return with_velocity(super().patch_faces(name, t), self, t)

    def _make_room(self, wanted: Sequence[int]) -> None:
        capacity = max(len(set(wanted)), min(self._keep, len(self.times)))
        if capacity > len(self._fields):
            self._fields = self._grown(self._fields, capacity)
            self._corrections = sparse_zeros((capacity, *self._corrections.shape[1:]), np.float32)
            self._fluxes = self._grown(self._fluxes, capacity)
            self._curvatures = self._grown(self._curvatures, capacity)
            self.field_table = self._grown(self.field_table, capacity)
        for index in wanted:
            if index in self._in_memory:
                self._in_memory[index] = self._in_memory.pop(index)

    def _grown(self, array: NDArray[np.generic], n: int) -> NDArray[Any]:
        """Return a copy of an array with n rows; further ones are not set."""
        grown = np.empty((n, *array.shape[1:]), dtype=array.dtype)
        grown[: len(array)] = array
        return grown

    def _fetch(self, index: int) -> None:
        if index in self._in_memory:
            return
        future, self._prefetched = self._prefetch(index), None
        u, l, *more = map(self.widened, future.result())
        self._turn(u, l)
        if len(self._in_memory) < len(self._fields):
            place = len(self._in_memory)
        else:
            place = self._in_memory.pop(next(iter(self._in_memory)))
        self._fields[place, :, :3] = u
        self._fields[place, :, 3:_OF_VELOCITY] = l.reshape(-1, 9)
        if self._curvatures.shape[1] > 0:
            self._curvatures[place] = self._turned_curvatures(more.pop())
        if self._corrections.shape[1] > 0:
            self._fluxes[place] = more.pop()
            clear(self._corrections[place])
        if self.field_columns:
            self.field_table[place] = more.pop()
        if more:
            self._fields[place, :, _OF_VELOCITY:] = np.concatenate(more, axis=1)
        self._in_memory[index] = place

    def _prefetch(self, index: int) -> Future[tuple[Any, ...]]:
        if self._prefetched is None or self._prefetched[0] != index:
            self._prefetched = index, self._reader.submit(self._read, index)
        return self._prefetched[1]


def _width(turbulent: bool, viscous: bool) -> int:
    """Return the number of columns of the fields."""
    return _OF_VELOCITY + _OF_TURBULENCE * turbulent + _OF_VISCOSITY * viscous


_MOST_IN_MEMORY = 1 << 28
"""Bytes up to which all times of a periodic flow stay in memory."""


def series_of(
    source: Path,
    mesh: Mesh,
    names: Sequence[str],
    read: Callable[[str], tuple[Any, ...]],
    period: float | None,
    notes: Sequence[str],
    zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
    turbulent: bool = False,
    conservative: bool = False,
    viscous: bool = False,
    sampled: Sequence[FieldColumns] = (),
    curved: bool = False,
    flow: Callable[..., SeriesFlow] = SeriesFlow,
    course: str = "linear",
) -> SeriesFlow:
    """Return the flow of a case or a file at several times: a few of them in memory, or a whole short period.

    See :class:`SeriesFlow` for its errors.

    Parameters
    ----------
    source
        The case or file, for messages.
    mesh
        Mesh of all times.
    names
        Names of the times, rising; see :class:`SeriesFlow`.
    read
        Returns the fields at the time of a name; see :class:`SeriesFlow`.
    period, notes, zones, turbulent, conservative, viscous, sampled, curved
        See :class:`SeriesFlow`.
    flow, course
        Class of the flow, and how it changes between times.
    """
    note = f"The flow is {course} in time between {len(names)} times from {names[0]} to {names[-1]}"
    note += "." if period is None else f", and repeats itself every {period:g} s."
    size = 8 * (_width(turbulent, viscous) + width(sampled)) * (mesh.n_points + mesh.n_cells)
    size += 16 * len(mesh.tets) if conservative else 0
    size += 72 * (mesh.n_points + mesh.n_cells) if curved else 0
    keep = _MOST_IN_MEMORY // size if period is not None else 0
    times = [float(name) for name in names]
    try:
        return flow(
            mesh, times, lambda i: read(names[i]), period, [*notes, note], keep=keep, zones=zones,
            turbulent=turbulent, conservative=conservative, viscous=viscous, sampled=sampled, curved=curved,
        )  # fmt: skip
    except InputError as error:
        raise InputError(f"{source}: {error}") from None
