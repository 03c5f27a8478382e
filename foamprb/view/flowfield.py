"""Flow in a picture: planes, streamlines, and a grid of values through which the page draws planes."""

from __future__ import annotations

import re
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersFlowPaths import vtkStreamTracer

from foamprb.body.viscosity import shear_rate
from foamprb.errors import InputError
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.vtk_messages import vtk_messages
from foamprb.optional import load
from foamprb.results.vtk import triangles_data
from foamprb.view.colours import round_limits
from foamprb.view.geometry import filtered

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

QUANTITIES = {"speed": ("speed of the flow", "m/s"), "shearRate": ("shear rate of the flow", "1/s")}
"""Label and unit of each quantity of a plane."""
PLANE = "speed"
"""Default quantity of a plane through the flow."""
_HIGHEST = 99.0
"""Percentile of the values at the nodes at which the colours of a plane end."""
STREAM_OPACITY = 0.3
_POINTS = 100_000
"""Points of the grid, about."""
_STARTS, _LINES = 150, 36
"""Starts of streamlines, and the number of lines that are taken, far from each other."""
_LONGEST = 3.0
"""Largest length of a streamline each way, in longest sides."""
_MOST_COMPARED = 200
"""Points of a line, about, whose distances from the starts are compared."""
_SLOW = 1e-3
"""Share of the mean speed below which a streamline ends."""
_BEND, _PIECE = 0.06, 0.5
"""Largest bend, rad, and length, in second longest sides, of a piece of a drawn streamline."""


_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_VECTOR = rf"\(\s*({_NUMBER})\s+({_NUMBER})\s+({_NUMBER})\s*\)"
_HOW_TO_SLICE = (
    "Allowed: x, y or z (through the middle), z=0.01, or '(point) (normal)' such as '(0 0 0) (1 0 1)'."
)


class Slice(NamedTuple):
    """Plane through the flow."""

    points: Floats
    """(v, 3), m."""
    triangles: Ints
    """(t, 3)."""
    values: dict[str, Floats]
    """(v,) by name."""


class Streamlines(NamedTuple):
    """Lines along the velocity."""

    points: Floats
    """(v, 3), m, line after line."""
    start: Ints
    """(k + 1,): line i has the points from ``start[i]`` to ``start[i + 1]``."""

    @property
    def segments(self) -> Floats:
        """Ends of all segments, (s, 2, 3), m."""
        pairs = np.stack([self.points[:-1], self.points[1:]], axis=1)
        within = np.ones(len(pairs), dtype=bool)
        within[self.start[1:-1] - 1] = False
        return np.asarray(pairs[within])


class Scale(NamedTuple):
    """Limits of the colours of a quantity, and its least and largest value."""

    limits: tuple[float, float]
    extremes: tuple[float, float]


class Grid(NamedTuple):
    """Flow on a regular grid over the box of a mesh, (nz, ny, nx) points."""

    low: Floats
    """First point, (3,), m."""
    high: Floats
    """Last point."""
    u: Floats
    """Velocity, (nz, ny, nx, 3), m/s; zero outside the mesh."""
    values: dict[str, Floats]
    """Quantities of a plane, (nz, ny, nx), by name; outside the mesh values of the nearest point inside."""


@dataclass(frozen=True)
class FlowField:
    """Everything of a flow that is drawn."""

    lines: Streamlines
    scales: dict[str, Scale]
    """Of the quantities of a plane."""
    plane: tuple[Floats, Floats] | None
    """Point, m, and unit normal of the requested plane."""
    slice: Slice | None
    """The flow on this plane, for pictures."""
    grid: Grid
    """For a page, which draws any plane."""


def field_of(flow: MeshFlow, plane: str | None, *, drawn: bool) -> FlowField:
    """Return the field to draw, in a picture if ``drawn``, else on a page; ``plane`` is ``-slice``."""
    at = None if plane is None else read_plane(plane, *flow.bounds)
    cut_there = cut(flow, *at) if drawn and at is not None else None
    grid = sample_grid(flow)
    return FlowField(streamlines(flow, grid), scales_of(flow), at, cut_there, grid)


def scales_of(flow: MeshFlow) -> dict[str, Scale]:
    """Return the scales of the quantities of a plane, from the values at the nodes."""
    _, u, l = flow.at_nodes()
    scales = {}
    for name, values in (("speed", np.linalg.norm(u, axis=1)), ("shearRate", _rate(l))):
        low, high = float(values.min()), float(values.max())
        scales[name] = Scale(round_limits(low, float(np.percentile(values, _HIGHEST)) or high), (low, high))
    return scales


def sample_grid(flow: MeshFlow) -> Grid:
    """Return a flow on a grid of about :data:`_POINTS` points."""
    low, high = (np.asarray(corner, dtype=np.float64) for corner in flow.bounds)
    number = _numbers(high - low)
    # Points on the boundary could lie outside by round-off; one point lies in the middle.
    inset = np.where(number > 1, 1e-6, 0.5) * (high - low)
    low, high = low + inset, high - inset
    axes = [np.linspace(low[k], high[k], number[k]) for k in range(3)]
    points = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1).transpose(2, 1, 0, 3)
    shape = points.shape[:3]
    points = points.reshape(-1, 3)
    hosts = flow.locate(points)
    inside = np.flatnonzero(hosts >= 0)
    u, l = np.zeros((len(points), 3)), np.zeros((len(points), 9))
    if len(inside):
        u[inside], gradient = flow.sample(points[inside], hosts[inside], 0.0)
        l[inside] = gradient.reshape(-1, 9)
    nearest = _nearest_inside(hosts.reshape(shape) >= 0)
    values = {"speed": np.linalg.norm(u, axis=1), "shearRate": _rate(l)}
    return Grid(
        low,
        high,
        u.reshape(*shape, 3),
        {name: v[nearest].reshape(shape) for name, v in values.items()},
    )


def _nearest_inside(inside: NDArray[np.bool_]) -> Ints:
    """Return for each point of a grid the index of a near point inside, its own for points inside."""
    nearest = np.where(inside, np.arange(inside.size).reshape(inside.shape), -1)
    while inside.any() and (nearest < 0).any():
        for axis in range(3):
            for shifted in (nearest, nearest[::-1, ::-1, ::-1]):
                along = np.moveaxis(shifted, axis, 0)
                before, after = along[:-1].copy(), along[1:]
                after[(after < 0) & (before >= 0)] = before[(after < 0) & (before >= 0)]
    return nearest


def streamlines(flow: MeshFlow, grid: Grid) -> Streamlines:
    """Return lines along the velocity by VTK's tracer on a grid; where more fluid flows, more lines begin."""
    mesh = flow.mesh
    speed = np.linalg.norm(flow.at_nodes()[1][mesh.n_points :], axis=1)
    weight = mesh.volumes * speed
    shape = np.array(grid.u.shape[2::-1])
    empty = Streamlines(np.zeros((0, 3)), np.zeros(1, dtype=np.int64))
    if not weight.sum() > 0.0:
        return empty
    starts = mesh.centres[np.random.default_rng(0).choice(len(weight), _STARTS, p=weight / weight.sum())]
    sides = np.sort(grid.high - grid.low)
    # A grid of one layer becomes one of two.
    thin = shape == 1
    u = grid.u.repeat(1 + thin[2], axis=0).repeat(1 + thin[1], axis=1).repeat(1 + thin[0], axis=2)
    spacing = np.where(thin, 1e-2 * sides[2], (grid.high - grid.low) / np.maximum(shape - 1, 1))
    image = vtkImageData()
    image.SetDimensions(*(shape + thin).tolist())
    image.SetSpacing(*spacing)
    image.SetOrigin(*(grid.low - np.where(thin, 0.5 * spacing, 0.0)))
    image.GetPointData().SetVectors(numpy_to_vtk(u.reshape(-1, 3)))
    tracer = vtkStreamTracer()
    tracer.SetSourceData(triangles_data(starts, np.zeros(0, dtype=np.int64)))
    tracer.SetIntegrationDirectionToBoth()
    tracer.SetIntegratorTypeToRungeKutta45()
    tracer.SetComputeVorticity(False)
    tracer.SetIntegrationStepUnit(vtkStreamTracer.CELL_LENGTH_UNIT)
    tracer.SetInitialIntegrationStep(0.5)
    tracer.SetMaximumIntegrationStep(1.0)
    tracer.SetMaximumPropagation(_LONGEST * sides[2])
    tracer.SetTerminalSpeed(_SLOW * float(weight.sum() / mesh.volumes.sum()))
    tracer.SetMaximumNumberOfSteps(4000)
    with vtk_messages():
        traced = filtered(tracer, image)
    points, lines_of = vtk_to_numpy(traced.GetPoints().GetData()).astype(np.float64), traced.GetLines()
    places, ends = (
        vtk_to_numpy(lines_of.GetConnectivityArray()),
        vtk_to_numpy(lines_of.GetOffsetsArray()),
    )
    seeds = vtk_to_numpy(traced.GetCellData().GetArray("SeedIds"))
    halves: dict[int, list[Floats]] = {}
    for seed, a, b in zip(seeds.tolist(), ends[:-1], ends[1:], strict=True):
        halves.setdefault(seed, []).append(points[places[a:b]])
    # Each half begins at the start; the first one follows the flow.
    remaining = {
        seed: np.concatenate([half[1][:0:-1], half[0]]) if len(half) > 1 else half[0]
        for seed, half in halves.items()
    }
    apart, lines = np.full(len(starts), np.inf), []
    for _ in range(min(_LINES, len(remaining))):
        seed = max(remaining, key=lambda seed: apart[seed])
        line = remaining.pop(seed)
        lines.append(_simplified(line, _PIECE * sides[1]))
        few = line[:: 1 + len(line) // _MOST_COMPARED]
        apart = np.minimum(apart, np.linalg.norm(starts[:, None] - few, axis=2).min(axis=1))
    return Streamlines(np.concatenate(lines), np.cumsum([0, *map(len, lines)])) if lines else empty


def _simplified(line: Floats, longest: float) -> Floats:
    """Return the points of a line between which it bends little, and its ends."""
    steps = np.diff(line, axis=0)
    steps /= np.linalg.norm(steps, axis=1, keepdims=True)
    rows = [0]
    for k in range(1, len(line) - 1):
        from_last = steps[k] @ steps[rows[-1]]
        if from_last < np.cos(_BEND) or np.linalg.norm(line[k] - line[rows[-1]]) > longest:
            rows.append(k)
    return line[[*rows, len(line) - 1]]


def _numbers(sides: Floats) -> Ints:
    """Return the numbers of points along three sides, (3,); one along a side shorter than the step."""
    thick = np.ones(3, dtype=bool)
    number = np.ones(3, dtype=np.int64)
    for _ in range(3):
        pitch = float((sides[thick].prod() / _POINTS) ** (1.0 / thick.sum()))
        thin = thick & (sides < pitch)
        if not thin.any():
            number[thick] = np.maximum(1, np.rint(sides[thick] / pitch)).astype(np.int64)
            break
        thick &= ~thin
    return number


def _rate(l: Floats) -> Floats:
    return np.asarray(shear_rate(tuple(l.T)))


def read_plane(text: str, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Return point and unit normal of the plane of ``-slice``, in the box of a mesh.

    Raises
    ------
    InputError
        If the text has no allowed form, or the plane misses the box.
    """
    by_axis = re.fullmatch(rf"([xyz])(?:=({_NUMBER}))?", text.strip())
    by_normal = re.fullmatch(rf"{_VECTOR}\s*{_VECTOR}", text.strip())
    if by_axis:
        axis = "xyz".index(by_axis[1])
        origin, normal = 0.5 * (low + high), np.eye(3)[axis]
        if by_axis[2]:
            origin[axis] = float(by_axis[2])
    elif by_normal:
        numbers = [float(number) for number in by_normal.groups()]
        origin, normal = np.array(numbers[:3]), np.array(numbers[3:])
    else:
        raise InputError(f"-slice {text}: not a plane. {_HOW_TO_SLICE}")
    size = float(np.linalg.norm(normal))
    if size == 0.0:
        raise InputError(f"-slice {text}: the normal is zero.")
    normal = normal / size
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    sides = (corners - origin) @ normal
    if sides.min() > 0.0 or sides.max() < 0.0:
        box = " to ".join("({:g} {:g} {:g})".format(*corner) for corner in (low, high))
        raise InputError(f"-slice {text}: the plane misses the mesh, whose box is {box}.")
    return origin, normal


def cut(flow: MeshFlow, origin: Floats, normal: Floats) -> Slice:
    """Return speed and shear rate of a flow on a plane, from the values at the nodes.

    Parameters
    ----------
    flow
        The flow.
    origin, normal
        A point of the plane, m, and its unit normal, each (3,).
    """
    pyvista, nodes, tets = load("pyvista"), flow.mesh.nodes, flow.mesh.tets
    grid = pyvista.UnstructuredGrid({pyvista.CellType.TETRA: tets}, nodes)
    grid.cell_data["tet"] = np.arange(len(tets), dtype=np.int32)
    # Nodes on the plane, such as cell centres of a mesh with one layer, count as above it.
    below = origin - 1e-9 * np.ptp(nodes, axis=0).max() * normal
    section = grid.slice(normal=normal, origin=below).triangulate()
    points, triangles = np.array(section.points, dtype=np.float64), np.array(section.regular_faces)
    hosts = np.zeros(len(points), dtype=np.int32)
    hosts[triangles] = section.cell_data["tet"][:, None]
    u, l = flow.sample(points, hosts, 0.0)
    values = {"speed": np.linalg.norm(u, axis=1), "shearRate": _rate(l.reshape(-1, 9))}
    return Slice(points, triangles.astype(np.int64), values)
