"""Flow of a mesh file: VTK's own formats, including foamToVTK's output, and others through meshio.

If the file has named surfaces with velocities, as foamToVTK's ``boundary``, these are the patches. Otherwise
the whole boundary is one patch, ``boundary``, or is divided as the user requests. Such files have no types of
patches: a patch is a ``wall`` unless the fluid moves on it.
"""

from __future__ import annotations

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Floats
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.checks import require_numbers, require_volumes
from foamprb.flow.read.division import divided, patch_names
from foamprb.flow.read.source import Division
from foamprb.flow.read.times import choose_times, listed
from foamprb.flow.read.vtkfile import (
    grid_and_surfaces,
    read_file,
    require_joined,
    solid_cells,
    times_of_file,
)
from foamprb.flow.reconstruct import Reconstruction, from_points
from foamprb.flow.series import series_of

_MOST_TIMES = 10
"""Number of times of a transient flow at which moving patches are looked for."""


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
        File with a suffix of :data:`~foamprb.flow.read.vtkfile.VTK_SUFFIXES` (``.series`` is ParaView's list
        of files with their times), or of a format that meshio reads.
    velocity
        Name of the velocity array (n, 3), m/s, at cells or, if there is no such array, at points; or of three
        arrays of its components, ``(Ux Uy Uz)``.
    time
        Value of a time, or ``latestTime``, for files that have times.
    gradient
        Name of a cell array of the velocity's gradient with nine components, of which the (3i + j)-th is
        ∂u_j/∂x_i, as OpenFOAM writes ``grad(U)``; empty to reconstruct the gradient.
    division
        Division of a boundary without named patches.

    Raises
    ------
    InputError
        The file cannot be read, holds no three-dimensional cells, or lacks the velocity.
    """
    path = Path(path)
    grid, mesh, surfaces, note = open_file(path, velocity, time, division)
    field = _NodalVelocity(path, mesh, grid, surfaces, velocity, gradient)
    u, l, correction = field(grid, surfaces, path)
    return MeshFlow(mesh, u, l, [note, *field.notes], correction=correction)


def read_mesh_series(
    path: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    *,
    gradient: str = "",
    division: Division | None = None,
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
    velocity, gradient, division
        See :func:`read_mesh_file`.

    Raises
    ------
    InputError
        See :func:`read_mesh_file`; or the mesh changes, or the times do not fill the period.
    """
    path = Path(path)
    known = times_of_file(path)
    names = choose_times(path, known, times) if known else ()
    if len(names) < 2:
        time = names[0] if names else "latestTime"
        return read_mesh_file(path, velocity, time=time, gradient=gradient, division=division)
    grid, mesh, surfaces, note = open_file(path, velocity, names[0], division, among=names)
    field = _NodalVelocity(path, mesh, grid, surfaces, velocity, gradient)
    topology = _topology(grid, surfaces)

    def read(name: str) -> tuple[Any, ...]:
        whole, now = grid_and_surfaces(read_file(path, name), path)
        cells = solid_cells(whole, path)[0]
        join_components(velocity, cells, *(surface for _, surface in now))
        later = _topology(cells, now)
        if topology.keys() != later.keys() or not all(np.array_equal(topology[k], later[k]) for k in later):
            raise InputError(
                f"{path}: the mesh of time {name} is not that of time {names[0]}; only meshes at rest can be "
                "read."
            )
        return field(cells, now, f"{path}, time {name}")

    return series_of(path, mesh, list(names), read, period, [note, *field.notes], conservative=True)


class _NodalVelocity:
    """Velocity and gradient at the nodes, from the arrays of a file at cells and some patches, or at points.

    Parameters
    ----------
    path
        The file, for messages.
    mesh
        Its mesh.
    grid, surfaces
        Data read from it.
    velocity, gradient
        See :func:`read_mesh_file`.

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
        self.notes: list[str] = []
        self._reconstruct: Reconstruction | None = None
        faces = np.zeros(len(mesh.boundary_centres), dtype=bool)
        if velocity in grid.cell_data:
            given = [velocity in surface.cell_data for _, surface in surfaces]
            self._valued: list[int] = np.flatnonzero(given).tolist()
            for index in self._valued:
                faces[mesh.patch_start[index] : mesh.patch_start[index + 1]] = True
            self._reconstruct = Reconstruction(mesh, valued=faces)
            if not faces.any():
                self.notes = [
                    "No velocities were given on the boundary, where those of the cells are continued."
                ]
        elif velocity in grid.point_data:
            if gradient:
                raise InputError(
                    f"{path}: {velocity} is given at points; {gradient} is only read beside cells."
                )
            self.notes = ["Velocities are point values; their gradient is first-order accurate."]
        else:
            names = sorted({*grid.cell_data.keys(), *grid.point_data.keys()})
            raise InputError(
                f"{path}: no array {velocity}. {suggestion(velocity, names)} Three scalars are read by "
                '-velocity "(Ux Uy Uz)".'
            )
        self._conserve = Conservation(mesh, faces)

    def __call__(
        self, grid: Any, surfaces: Sequence[tuple[str, Any]], where: object
    ) -> tuple[Floats, Floats, NDArray[np.float32]]:
        """Return velocity and gradient at the nodes and the correction, from the data read at any time.

        ``where`` names them in a message.

        Raises
        ------
        InputError
            An array is missing, of the wrong size, or holds values that are not finite numbers.
        """
        name, path, mesh = self._velocity, self._path, self._mesh
        if self._reconstruct is None:
            u, l = from_points(mesh, _array(grid.point_data, name, 3, path, "at point"))
            return u, l, self._conserve(u, l, where=where)
        cells = _array(grid.cell_data, name, 3, path, "at cell")
        boundary = np.zeros((len(mesh.boundary_centres), 3))
        for index in self._valued:
            rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
            patch, surface = surfaces[index]
            boundary[rows] = _array(surface.cell_data, name, 3, path, f"on patch {patch}, face")
        slopes = None
        if self._gradient:
            given = _array(grid.cell_data, self._gradient, 9, path, "at cell")
            slopes = given.reshape(-1, 3, 3).transpose(0, 2, 1)
        u, l = self._reconstruct(cells, boundary, slopes)
        return u, l, self._conserve(u, l, where=where)


def _array(data: Any, name: str, components: int, path: Path, where: str) -> Floats:
    """Return an array (n, components) of finite numbers; InputError if it is missing or of another shape."""
    if name not in data:
        kind = "cell array" if components == 9 else "array"
        at = "" if components == 9 else " at one of its times"
        raise InputError(f"{path}: no {kind} {name}{at}. {suggestion(name, data.keys())}")
    values = np.asarray(data[name], dtype=np.float64)
    if values.ndim != 2 or values.shape[1] != components:
        what = "a gradient" if components == 9 else "a velocity"
        raise InputError(
            f"{path}: array {name} has shape {values.shape}, but {what} has {components} components."
        )
    require_numbers(values, path, "value", where)
    return values


def _topology(grid: Any, surfaces: Sequence[tuple[str, Any]]) -> dict[str, NDArray[Any]]:
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


def open_file(
    path: Path,
    velocity: str,
    time: float | str,
    division: Division | None,
    among: Sequence[str] = (),
) -> tuple[Any, Mesh, list[tuple[str, Any]], str]:
    """Return the cells of a file, their mesh, the patches that the file names, and a note for the user.

    A patch on which the fluid is at rest at this time may move at other times, ``among`` which some are read.
    """
    whole, named = grid_and_surfaces(read_file(path, time), path)
    grid, notes = solid_cells(whole, path)
    join_components(velocity, grid, *(surface for _, surface in named))
    require_numbers(np.asarray(grid.points, dtype=np.float64), path, "point")
    moving = _moving(named, velocity)
    for name in np.unique(np.linspace(0, len(among) - 1, min(len(among), _MOST_TIMES)).astype(int)):
        if len(moving) < len(named):
            now = grid_and_surfaces(read_file(path, among[name]), path)[1]
            join_components(velocity, *(surface for _, surface in now))
            moving |= _moving(now, velocity)
    surfaces = [PatchSurface(name, "patch" if name in moving else "wall", surface) for name, surface in named]
    if not surfaces:
        mesh, note = divided(grid, whole, division or Division(), path)
    elif division is not None:
        raise InputError(f"{path}: the file names its patches, {listed([s.name for s in surfaces])}.")
    else:
        mesh = build_mesh(grid, surfaces, source=str(path))
        note = f"The patches are those of the file: {patch_names(mesh)}."
    require_volumes(mesh, path)
    if not surfaces:
        require_joined(mesh, path)
    return grid, mesh, named, " ".join([note, *notes])


_COMPONENTS = re.compile(r"\(\s*(\S+)\s+(\S+)\s+(\S+)\s*\)")


def join_components(velocity: str, *data: Any) -> None:
    """Add the velocity ``(Ux Uy Uz)`` to data that has these three scalars."""
    match = _COMPONENTS.fullmatch(velocity)
    for arrays in (arrays for part in data for arrays in (part.cell_data, part.point_data)):
        if match and all(name in arrays for name in match.groups()):
            arrays[velocity] = np.stack(
                [np.asarray(arrays[name]).reshape(-1) for name in match.groups()], axis=1
            )


def _moving(surfaces: Sequence[tuple[str, Any]], velocity: str) -> set[str]:
    """Return the names of the surfaces on which the fluid moves; the others are walls."""
    moving = set()
    for name, surface in surfaces:
        given = [data[velocity] for data in (surface.cell_data, surface.point_data) if velocity in data]
        if given and np.any(np.asarray(given[0]) != 0.0):
            moving.add(name)
    return moving
