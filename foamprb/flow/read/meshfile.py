"""A flow from a mesh file: VTK's own formats, foamToVTK's output included, and others through meshio.

Where the file has surfaces with names and velocities, as foamToVTK's ``boundary``, they are the patches.
Elsewhere the whole boundary is one patch, ``boundary``, or it is divided as the user says. Types of patches
are not in such files: a patch is a ``wall`` unless the fluid moves on it by what the file says.
"""

from __future__ import annotations

from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.cells import CELL_KINDS
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.checks import require_numbers, require_volumes
from foamprb.flow.read.division import Division, divided, patch_names
from foamprb.flow.read.series import series_of
from foamprb.flow.read.times import choose_times, listed
from foamprb.flow.read.vtkfile import grid_and_surfaces, read_file, solid_cells, times_of_file
from foamprb.flow.reconstruct import Reconstruction, from_points
from foamprb.flow.series import SeriesFlow

_MOST_TIMES = 10
"""At which it is seen whether the fluid of a transient flow moves on a patch."""


def read_mesh_file(
    path: Path | str,
    velocity: str = "U",
    *,
    time: float | str = "latestTime",
    gradient: str = "",
    division: Division | None = None,
) -> MeshFlow:
    """Read a mesh with velocities.

    Parameters
    ----------
    path
        The file: of a VTK suffix, see :data:`~foamprb.flow.read.vtkfile.VTK_SUFFIXES` (``.series`` is
        ParaView's list of files with their times), or of a format that meshio reads.
    velocity
        Name of the velocity array (n, 3), m/s. Cell data are preferred; point data are taken as they are for
        the values at the mesh points when there is nothing else.
    time
        A time's value, or ``latestTime``, for files that have times.
    gradient
        Name of a cell array of the velocity's gradient, nine components of which the (3i + j)-th is
        ∂u_j/∂x_i, as OpenFOAM writes ``grad(U)``. Without a name the gradient is reconstructed.
    division
        How a boundary without named patches is divided.

    Raises
    ------
    InputError
        The file cannot be read, holds no three-dimensional cells, or lacks the velocity.
    """
    path = Path(path)
    grid, mesh, surfaces, note = _read_mesh(path, velocity, time, division)
    field = _Field(path, mesh, grid, surfaces, velocity, gradient)
    return MeshFlow(mesh, *field(grid, surfaces), [note, *field.notes])


def read_mesh_series(
    path: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    *,
    gradient: str = "",
    division: Division | None = None,
) -> SeriesFlow | MeshFlow:
    """Read a mesh with velocities at several times, as they are needed; a single time is a steady flow.

    Parameters
    ----------
    path
        The file: ``.series``, ``.pvd``, ``.vtkhdf`` or any other that has several times.
    times
        As :func:`~foamprb.flow.read.times.choose_times`.
    period
        Duration after which the flow repeats itself, s.
    velocity, gradient, division
        As :func:`read_mesh_file`.

    Raises
    ------
    InputError
        As :func:`read_mesh_file`; the mesh is not the same at all times; the times do not fill the period.
    """
    path = Path(path)
    known = times_of_file(path)
    names = choose_times(path, known, times) if known else ()
    if len(names) < 2:
        time = names[0] if names else "latestTime"
        return read_mesh_file(path, velocity, time=time, gradient=gradient, division=division)
    grid, mesh, surfaces, note = _read_mesh(path, velocity, names[0], division, among=names)
    field = _Field(path, mesh, grid, surfaces, velocity, gradient)
    topology = _topology(grid, surfaces)

    def read(name: str) -> tuple[Floats, Floats]:
        data = read_file(path, name)
        whole, now = grid_and_surfaces(data, path)
        cells = solid_cells(whole, path)
        if not _is_same(topology, _topology(cells, now)):
            raise InputError(
                f"{path}: the mesh of time {name} is not that of time {names[0]}; only meshes at rest can be "
                "read."
            )
        return field(cells, now)

    return series_of(path, mesh, names, read, period, [note, *field.notes])


class _Field:
    """How velocities are had from a file's arrays: from cells and some patches, or from points.

    Parameters
    ----------
    path
        The file, for the messages.
    mesh
        Its mesh.
    grid, surfaces
        What was read of it.
    velocity, gradient
        As :func:`read_mesh_file`.

    Raises
    ------
    InputError
        There is no such array.
    """

    def __init__(
        self,
        path: Path,
        mesh: Mesh,
        grid: Any,
        surfaces: Sequence[tuple[str, Any]],
        velocity: str,
        gradient: str,
    ) -> None:
        self._path, self._mesh, self._velocity, self._gradient = path, mesh, velocity, gradient
        self._valued: list[int] | None = None
        if velocity in grid.cell_data:
            given = [velocity in surface.cell_data for _, surface in surfaces]
            self._valued = np.flatnonzero(given).tolist()
            faces = np.zeros(len(mesh.boundary_centres), dtype=bool)
            for index in self._valued:
                faces[mesh.patch_start[index] : mesh.patch_start[index + 1]] = True
            self._reconstruct = Reconstruction(mesh, valued=faces)
            self.notes = [] if faces.any() else [
                "No velocities were given on the boundary, where those of the cells are continued."
            ]  # fmt: skip
        elif velocity in grid.point_data:
            if gradient:
                raise InputError(
                    f"{path}: {velocity} is given at points; {gradient} is only read beside cells."
                )
            self.notes = ["Velocities are point values; their gradient is first-order accurate."]
        else:
            names = sorted({*grid.cell_data.keys(), *grid.point_data.keys()})
            raise InputError(f"{path}: no array {velocity}. {suggestion(velocity, names)}")

    def __call__(self, grid: Any, surfaces: Sequence[tuple[str, Any]]) -> tuple[Floats, Floats]:
        """Velocity and gradient at the nodes, from what was read of any time.

        Raises
        ------
        InputError
            An array is missing, of the wrong size, or holds what is no number.
        """
        name, path, mesh = self._velocity, self._path, self._mesh
        if self._valued is None:
            points = _vectors(_array(grid.point_data, name, path), name, path, "at point")
            return from_points(mesh, points)
        cells = _vectors(_array(grid.cell_data, name, path), name, path, "at cell")
        boundary = np.zeros((len(mesh.boundary_centres), 3))
        for index in self._valued:
            rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
            surface_name, surface = surfaces[index]
            values = _array(surface.cell_data, name, path)
            boundary[rows] = _vectors(values, name, path, f"on patch {surface_name}, face")
        given = _gradients(grid, self._gradient, path) if self._gradient else None
        return self._reconstruct(cells, boundary, given)


def _array(data: Any, name: str, path: Path) -> Any:
    if name not in data:
        raise InputError(f"{path}: no array {name} at one of its times. {suggestion(name, data.keys())}")
    return data[name]


def _topology(grid: Any, surfaces: Sequence[tuple[str, Any]]) -> dict[str, NDArray[Any]]:
    """All that makes a mesh and its patches."""
    found = {f"points of {name}": np.asarray(part.points) for name, part in surfaces}
    found |= {f"faces of {name}": np.asarray(part.faces) for name, part in surfaces}
    lists = {
        "cells": grid.GetCells(),
        "faces": grid.GetPolyhedronFaces(),
        "own": grid.GetPolyhedronFaceLocations(),
    }
    for name, cells in lists.items():
        if cells is not None:
            found[name] = vtk_to_numpy(cells.GetConnectivityArray())
            found[f"start of {name}"] = vtk_to_numpy(cells.GetOffsetsArray())
    return {**found, "kinds": np.asarray(grid.celltypes), "points": np.asarray(grid.points)}


def _is_same(a: dict[str, NDArray[Any]], b: dict[str, NDArray[Any]]) -> bool:
    return a.keys() == b.keys() and all(np.array_equal(a[name], b[name]) for name in a)


def describe_file(path: Path, velocity: str = "U", division: Division | None = None) -> list[str]:
    """What a mesh file holds, for a person to read.

    Raises
    ------
    InputError
        As :func:`read_mesh_file`.
    """
    grid, mesh, _, note = _read_mesh(path, velocity, "latestTime", division)
    kinds = [
        (name, np.count_nonzero(np.asarray(grid.celltypes) == kind)) for kind, name in CELL_KINDS.items()
    ]
    low, high = (
        "({:g} {:g} {:g})".format(*corner) for corner in (mesh.points.min(axis=0), mesh.points.max(axis=0))
    )
    lines = [f"File    {path}", "", "Mesh", f"    {'points':20s} {mesh.n_points:10d}"]
    lines += [f"    {name:20s} {n:10d}" for name, n in kinds if n]
    lines += [f"    {'bounds [m]':20s} {low} {high}", "", "Patches"]
    for index, patch in enumerate(mesh.patches):
        rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
        centre = "({:g} {:g} {:g})".format(*mesh.boundary_centres[rows].mean(axis=0))
        faces = rows.stop - rows.start
        lines.append(f"    {patch.name:20s} {faces:10d} faces  {patch.type}  about {centre}")
    lines += ["", "Arrays"]
    for where, data in (("cells", grid.cell_data), ("points", grid.point_data)):
        lines += [f"    {name:20s} at {where}, {np.shape(data[name])[1:] or 'scalar'}" for name in list(data)]
    times = times_of_file(path)
    return [*lines, *(["", "Times", f"    {listed(times)}"] if times else []), "", note]


def _read_mesh(
    path: Path,
    velocity: str,
    time: float | str,
    division: Division | None,
    among: Sequence[str] = (),
) -> tuple[Any, Mesh, list[tuple[str, Any]], str]:
    """The cells of a file, their mesh, the patches that the file names, and what the user should know.

    Where the fluid does not move on a patch at this time it may do so ``among`` others.
    """
    whole, named = grid_and_surfaces(read_file(path, time), path)
    grid = solid_cells(whole, path)
    require_numbers(np.asarray(grid.points, dtype=np.float64), path, "point")
    moving = _moving(named, velocity)
    for name in np.unique(np.linspace(0, len(among) - 1, min(len(among), _MOST_TIMES)).astype(int)):
        if len(moving) < len(named):
            moving |= _moving(grid_and_surfaces(read_file(path, among[name]), path)[1], velocity)
    surfaces = [PatchSurface(name, "patch" if name in moving else "wall", surface) for name, surface in named]
    if not surfaces:
        mesh, note = divided(grid, whole, division or Division(), path)
    elif division is not None:
        raise InputError(f"{path}: the file names its patches, {listed([s.name for s in surfaces])}.")
    else:
        mesh = build_mesh(grid, surfaces, source=str(path))
        note = f"The patches are those of the file: {patch_names(mesh)}."
    require_volumes(mesh, path)
    if whole.n_cells > grid.n_cells:
        note += f" {whole.n_cells - grid.n_cells} points, lines and surfaces among the cells are left out."
    return grid, mesh, named, note


def _moving(surfaces: Sequence[tuple[str, Any]], velocity: str) -> set[str]:
    """Names of the surfaces on which the fluid moves; the others are walls."""
    found = set()
    for name, surface in surfaces:
        given = [data[velocity] for data in (surface.cell_data, surface.point_data) if velocity in data]
        if given and np.any(np.asarray(given[0]) != 0.0):
            found.add(name)
    return found


def _vectors(values: Any, name: str, path: Path, where: str) -> Floats:
    vectors = np.asarray(values, dtype=np.float64)
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise InputError(f"{path}: array {name} has shape {vectors.shape}, but a velocity has 3 components.")
    require_numbers(vectors, path, "value", where)
    return vectors


def _gradients(grid: Any, name: str, path: Path) -> Floats:
    """A gradient (n_cells, 3, 3), l_ij = ∂u_i/∂x_j."""
    if name not in grid.cell_data:
        raise InputError(f"{path}: no cell array {name}. {suggestion(name, grid.cell_data.keys())}")
    values = np.asarray(grid.cell_data[name], dtype=np.float64)
    if values.shape != (grid.n_cells, 9):
        raise InputError(f"{path}: array {name} has shape {values.shape}, but a gradient has 9 components.")
    require_numbers(values, path, "value", "at cell")
    return values.reshape(-1, 3, 3).transpose(0, 2, 1)
