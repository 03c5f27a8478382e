"""Flow of a mesh file: VTK's own formats, including foamToVTK's output, and others through meshio.

If the file has named surfaces, as foamToVTK's ``boundary``, these are the patches. Otherwise the boundary is
divided by the velocity, or as the user requests. :mod:`foamprb.flow.read.division` has the rules.
"""

from __future__ import annotations

import math
import re
import shlex
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError, suggestion
from foamprb.flow.balance import CONSTANT
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.cells import poly_of_grid
from foamprb.flow.mesh.mesh import Mesh, assemble
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.patches import VALUELESS, PatchKind
from foamprb.flow.read.caveats import balanced, balanced_in_time
from foamprb.flow.read.checks import caveat_of_order, require_numbers, require_volumes
from foamprb.flow.read.division import (
    boundary_velocity,
    divided,
    faces_at_rest,
    lost_flow,
    patch_lines,
    with_types,
)
from foamprb.flow.read.source import Division
from foamprb.flow.read.times import choose_times, listed
from foamprb.flow.read.vtkfile import (
    grid_and_surfaces,
    read_file,
    require_joined,
    solid_cells,
    times_of_file,
)
from foamprb.flow.reconstruct import Reconstruction, from_points, slide
from foamprb.flow.series import series_of

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

_CLOSED = PatchKind.WALL, PatchKind.MIRROR
_MOST_TIMES = 10
"""Number of times of a transient flow at which moving patches are looked for."""
_LONGEST, _SLOWEST, _FASTEST = 10.0, 3600.0, 1e6
"""Limits of a likely flow: size of the mesh, m, time to cross it, s, and one over this time, 1/s."""


def read_mesh_file(
    path: Path | str,
    velocity: str = "U",
    *,
    time: float | str = "latestTime",
    division: Division | None = None,
    scale: float = 1.0,
    curved: bool = False,
) -> MeshFlow:
    """Read a mesh with velocities.

    Parameters
    ----------
    path
        File with a suffix of :data:`~foamprb.flow.read.vtkfile.VTK_SUFFIXES` (``.series`` is ParaView's list
        of files with their times), or of a format that meshio reads.
    velocity
        Name of the velocity array (n, 3), m/s, at cells or, if there is no such array, at points; or of three
        arrays of its components, ``(Ux Uy Uz)``.
    time
        Value of a time, or ``latestTime``, for files that have times.
    division
        Division of a boundary without named patches.
    scale
        Factor of the lengths in the file, m; velocities stay in m/s.
    curved
        See :func:`~foamprb.flow.read.openfoam.read_case`.

    Raises
    ------
    InputError
        The file cannot be read, holds no three-dimensional cells, or lacks the velocity.
    """
    path = Path(path)
    file = open_file(path, velocity, time, division, scale)
    field = _NodalVelocity(path, file, velocity)
    u, l = field(file.grid, file.surfaces)
    notes: list[str] = [*file.notes, *field.notes]
    fluxes = balanced(field.conserve, u, l, CONSTANT, path, notes=notes)
    curvatures = mean_curvatures(file.mesh, l) if curved else None
    return MeshFlow(file.mesh, u, l, notes, fluxes=fluxes, curvatures=curvatures)


def read_mesh_series(
    path: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    *,
    division: Division | None = None,
    scale: float = 1.0,
    accept: Sequence[str] = (),
    curved: bool = False,
) -> MeshFlow:
    """Prepare the flow of a file at several times, which are read when needed; one time gives a steady flow.

    Parameters
    ----------
    path
        ``.series``, ``.pvd``, ``.vtkhdf`` or any other file with several times.
    times
        See :func:`~foamprb.flow.read.times.choose_times`.
    period
        Duration after which the flow repeats itself, s.
    velocity, division, scale, curved
        See :func:`read_mesh_file`.
    accept
        See :class:`~foamprb.flow.read.source.FlowSource`.

    Raises
    ------
    InputError
        See :func:`read_mesh_file`; or the mesh changes, or the times do not fill the period.
    """
    path = Path(path)
    all_times = times_of_file(path)
    names = choose_times(path, all_times, times) if all_times else ()
    if len(names) < 2:
        time = names[0] if names else "latestTime"
        return read_mesh_file(path, velocity, time=time, division=division, scale=scale, curved=curved)
    file = open_file(path, velocity, names[0], division, scale, among=names)
    field = _NodalVelocity(path, file, velocity)
    topology = _topology(file.grid, file.surfaces)

    def read(name: str) -> tuple[Any, ...]:
        now = _contents(path, name, velocity, scale)
        later = _topology(now.grid, now.surfaces)
        if topology.keys() != later.keys() or not all(np.array_equal(topology[k], later[k]) for k in later):
            raise InputError(
                f"{path}: the mesh of time {name} is not that of time {names[0]}; only meshes at rest can be "
                "read."
            )
        u, l = field(now.grid, now.surfaces)
        where = f"{path}, time {name}"
        fluxes = balanced_in_time(field.conserve, u, l, CONSTANT, where, accept=accept)
        return u, l, fluxes, *([mean_curvatures(file.mesh, l)] if curved else [])

    notes = [*file.notes, *field.notes]
    return series_of(path, file.mesh, list(names), read, period, notes, conservative=True, curved=curved)


class _NodalVelocity:
    """Velocity and gradient at the nodes, from arrays of a file at cells and some patches, or at points."""

    def __init__(self, path: Path, file: MeshFile, velocity: str) -> None:
        mesh, grid = file.mesh, file.grid
        self._path, self._mesh, self._velocity = path, mesh, velocity
        self.notes: list[str] = []
        self._reconstruct: Reconstruction | None = None
        if velocity in grid.cell_data:
            self._valued = [
                index
                for index, (_, surface) in enumerate(file.surfaces)
                if velocity in surface.cell_data and mesh.patches[index].type not in VALUELESS
            ]
            faces = np.zeros(len(mesh.boundary_centres), dtype=bool)
            for index in self._valued:
                faces[mesh.patch_start[index] : mesh.patch_start[index + 1]] = True
            if not faces.any():
                self.notes = ["The file has velocities of cells alone: they are continued to the boundary."]
                self.notes += ["The fluid is at rest on walls, as they show."] * bool(file.at_rest.any())
            self._reconstruct = Reconstruction(mesh, valued=faces | file.at_rest)
            self.notes += caveat_of_order(mesh, _array(grid.cell_data, velocity, path, "at cell"))
        elif velocity in grid.point_data:
            self.notes = ["Velocities are point values; their gradient is first-order accurate."]
        else:
            raise InputError(f"{path}: {_other_names(grid, velocity)}")
        self.conserve = Conservation(mesh, sliding=True)
        kinds = np.array([patch.kind in _CLOSED for patch in mesh.patches], dtype=bool)
        self._closed = np.flatnonzero(np.repeat(kinds, np.diff(mesh.patch_start)))

    def __call__(self, grid: Any, surfaces: Sequence[tuple[str, Any]]) -> tuple[Floats, Floats]:
        """Return velocity and gradient at the nodes, from the data read at any time."""
        name, path, mesh = self._velocity, self._path, self._mesh
        if self._reconstruct is None:
            points = _array(grid.point_data, name, path, "at point").copy()
            slide(mesh, points, self._closed)
            return from_points(mesh, points)
        cells = _array(grid.cell_data, name, path, "at cell")
        boundary = np.zeros((len(mesh.boundary_centres), 3))
        for index in self._valued:
            rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
            patch, surface = surfaces[index]
            boundary[rows] = _array(surface.cell_data, name, path, f"on patch {patch}, face")
        u, l = self._reconstruct(cells, boundary)
        slide(mesh, u, self._closed)
        return u, l


def _other_names(grid: vtkUnstructuredGrid, velocity: str) -> str:
    """Return a message that names the arrays that may be the velocity."""
    data = {**grid.point_data, **grid.cell_data}
    vectors = [shlex.quote(name) for name, values in data.items() if np.shape(values)[1:] == (3,)]
    if vectors:
        return f"no array {velocity}. Another one is read by -velocity NAME: {listed(vectors)}."
    missing = f"{velocity} is not a vector." if velocity in data else f"no array {velocity}."
    others = suggestion(velocity, data.keys() - {velocity})
    return f'{missing} {others} Three scalars are read by -velocity "(Ux Uy Uz)".'


def _array(data: Any, name: str, path: Path, where: str) -> Floats:
    """Return an array (n, 3) of finite numbers; InputError if it is missing or of another shape."""
    if name not in data:
        raise InputError(f"{path}: no array {name} at one of its times. {suggestion(name, data.keys())}")
    values = np.asarray(data[name], dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != 3:
        raise InputError(f"{path}: array {name} has shape {values.shape}, but a velocity has 3 components.")
    require_numbers(values, path, "value", where)
    return values


def _topology(grid: vtkUnstructuredGrid, surfaces: Sequence[tuple[str, Any]]) -> dict[str, NDArray[Any]]:
    """Return the arrays that define a mesh and its patches."""
    arrays = {f"points of {name}": np.asarray(part.points) for name, part in surfaces}
    arrays |= {f"faces of {name}": np.asarray(part.faces) for name, part in surfaces}
    lists = {
        "cells": grid.GetCells(),
        "faces": grid.GetPolyhedronFaces(),
        "own": grid.GetPolyhedronFaceLocations(),
    }
    for name, cells in lists.items():
        if cells is not None:
            arrays[name] = vtk_to_numpy(cells.GetConnectivityArray())
            arrays[f"start of {name}"] = vtk_to_numpy(cells.GetOffsetsArray())
    return {**arrays, "kinds": np.asarray(grid.celltypes), "points": np.asarray(grid.points)}


class _Contents(NamedTuple):
    """Contents of a file at a time."""

    whole: Any
    """All cells."""
    grid: vtkUnstructuredGrid
    """Those with volume."""
    surfaces: list[tuple[str, Any]]
    """Surfaces by name."""
    notes: list[str]


def _contents(path: Path, time: float | str, velocity: str, scale: float) -> _Contents:
    """Read the contents of a file at a time, with lengths in m."""
    whole, surfaces = grid_and_surfaces(read_file(path, time), path)
    if scale != 1.0:
        for part in (whole, *(surface for _, surface in surfaces)):
            part.points = np.asarray(part.points) * scale
    grid, notes = solid_cells(whole, path)
    join_components(velocity, grid, *(surface for _, surface in surfaces))
    return _Contents(whole, grid, surfaces, notes)


class MeshFile(NamedTuple):
    """Mesh and contents of a file at a time."""

    grid: vtkUnstructuredGrid
    """Cells."""
    mesh: Mesh
    surfaces: list[tuple[str, Any]]
    """Patches that the file names."""
    patches: list[str]
    """Description of each patch."""
    remarks: list[str]
    """Further notes for the user, and warnings."""
    at_rest: NDArray[np.bool_]
    """(n_boundary,): faces of walls at rest."""

    @property
    def notes(self) -> list[str]:
        """Return lines about the patches and all remarks."""
        return [
            "Patches, as the velocity shows them:",
            *(f"    {line}" for line in self.patches),
            *self.remarks,
        ]


def open_file(
    path: Path,
    velocity: str,
    time: float | str,
    division: Division | None,
    scale: float,
    among: Sequence[str] = (),
) -> MeshFile:
    """Read a file at a time, with the types of its patches.

    A patch on which the fluid is at rest at this time may move at other times, ``among`` which some are read.
    """
    first = _contents(path, time, velocity, scale)
    grid, surfaces, remarks = first.grid, first.surfaces, first.notes
    require_numbers(np.asarray(grid.points, dtype=np.float64), path, "point")
    named = [PatchSurface(name, "patch", surface) for name, surface in surfaces]
    if named and division is not None:
        raise InputError(f"{path}: the file names its patches, {listed([s.name for s in named])}.")
    poly = poly_of_grid(grid, named or None, str(path))
    mesh = assemble(poly, str(path))
    require_volumes(mesh, path)
    later = np.unique(np.linspace(0, len(among) - 1, min(len(among), _MOST_TIMES)).astype(int))
    others = (_contents(path, among[k], velocity, scale) for k in later if among[k] != time)
    u = boundary_velocity(mesh, [(at.grid, at.surfaces) for at in (first, *others)], velocity)
    if named:
        mesh = with_types(mesh, u)
    else:
        mesh, u, warnings = divided(poly, mesh, first.whole, division or Division(), u, path)
        remarks = [*warnings, *remarks]
        require_joined(mesh, path)
    if u is None:
        remarks.append(f"Openings are unknown: {_other_names(grid, velocity)}")
    else:
        remarks += [*lost_flow(mesh, u), *_doubtful_units(mesh, grid, velocity)]
    return MeshFile(grid, mesh, surfaces, patch_lines(mesh, u), remarks, faces_at_rest(mesh, u))


def _doubtful_units(mesh: Mesh, grid: vtkUnstructuredGrid, velocity: str) -> list[Caveat]:
    """Return a warning if the size of the mesh, or the time to cross it, is unlikely in m and s."""
    data = grid.cell_data if velocity in grid.cell_data else grid.point_data
    size = float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
    speed = float(np.linalg.norm(data[velocity], axis=1).max())
    if size <= _LONGEST and (speed == 0.0 or 1.0 / _FASTEST <= size / speed <= _SLOWEST):
        return []
    return [
        Caveat(
            f"the mesh is {size:.3g} m across, which the fluid of up to {speed:.3g} m/s crosses in "
            f"{size / speed if speed else math.inf:.3g} s: -scale 1e-3 reads lengths in mm, -scale 1e-6 "
            "lengths in um; velocities are in m/s."
        )
    ]


_COMPONENTS = re.compile(r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s*\)")


def join_components(velocity: str, *data: Any) -> None:
    """Add the velocity ``(Ux Uy Uz)`` to data that has these three scalars."""
    match = _COMPONENTS.fullmatch(velocity)
    for arrays in (arrays for part in data for arrays in (part.cell_data, part.point_data)):
        if match and all(name in arrays for name in match.groups()):
            arrays[velocity] = np.stack(
                [np.asarray(arrays[name]).reshape(-1) for name in match.groups()], axis=1
            )
