"""A flow from a mesh file: VTK's own formats, foamToVTK's output included, and others through meshio.

Where the file has surfaces with names and velocities, as foamToVTK's ``boundary``, they are the patches.
Elsewhere the whole boundary is one patch, ``boundary``, or it is divided by what its user says: by an array
on the surface cells among the cells, or at edges. Types of patches are not in such files: a patch is a
``wall`` unless the fluid moves on it by what the file says.
"""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
import pyvista
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse import csgraph
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError, suggestion
from foamprb.flow.mesh.mesh import CELL_KINDS, Floats, Mesh, PatchSurface, build_mesh
from foamprb.flow.read.openfoam import listed, pick_time, require_numbers, require_volumes, spoken
from foamprb.flow.read.trial import read_vtk, require_survival, times_of
from foamprb.flow.reconstruct import Reconstruction, from_points
from foamprb.flow.series import SeriesFlow, choose_times, stream
from foamprb.flow.walk import MeshFlow

__all__ = ["VTK_SUFFIXES", "Division", "describe_file", "read_mesh_file", "read_mesh_series"]

VTK_SUFFIXES = frozenset({".vtu", ".pvtu", ".vtk", ".vtkhdf", ".pvd", ".vtm", ".series"})
BOUNDARY = "boundary"
_MOST_PATCHES = 1000
_SIZES = {1: 1, 3: 2, 5: 3, 8: 4, 9: 4, 10: 4, 12: 8, 13: 6, 14: 5}
"""Points of the kinds of cells that have always as many."""
_MOST_LOOKED_AT = 10
"""Times of a transient flow at which it is seen whether the fluid moves on a patch."""
_HEAD = re.compile(r"(?!nan|inf)[A-Za-z_]", re.IGNORECASE)
_DATA = ("CELL_DATA", "POINT_DATA")


@dataclass(frozen=True)
class Division:
    """How a boundary without named patches is divided into patches; not at all by default."""

    array: str = ""
    """Integer array on the surface cells of the file: each value is a patch."""
    feature_angle: float | None = None
    """Angle in degrees: patches end at edges where the boundary turns by more."""


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
        The file: of a VTK suffix, see :data:`VTK_SUFFIXES` (``.series`` is ParaView's list of files with
        their times), or of a format that meshio reads.
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
        As :func:`foamprb.flow.series.choose_times`.
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
    known = _times(path)
    names = choose_times(path, known, times) if known else ()
    if len(names) < 2:
        time = names[0] if names else "latestTime"
        return read_mesh_file(path, velocity, time=time, gradient=gradient, division=division)
    grid, mesh, surfaces, note = _read_mesh(path, velocity, names[0], division, among=names)
    field = _Field(path, mesh, grid, surfaces, velocity, gradient)
    still = _topology(grid, surfaces)

    def read(name: str) -> tuple[Floats, Floats]:
        data = _read(path, name)
        whole, now = _parts(data, path)
        cells = _solid_cells(whole, path)
        if not _is_same(still, _topology(cells, now)):
            raise InputError(
                f"{path}: the mesh of time {name} is not that of time {names[0]}; only meshes at rest can be "
                "read."
            )
        return field(cells, now)

    return stream(path, mesh, names, read, period, [note, *field.notes])


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
            return from_points(mesh, _vectors(_array(grid.point_data, name, path), name, path))
        cells = _vectors(_array(grid.cell_data, name, path), name, path)
        boundary = np.zeros((len(mesh.boundary_centres), 3))
        for index in self._valued:
            rows = slice(mesh.patch_start[index], mesh.patch_start[index + 1])
            boundary[rows] = _vectors(_array(surfaces[index][1].cell_data, name, path), name, path)
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
    times = _times(path)
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
    whole, named = _parts(_read(path, time), path)
    grid = _solid_cells(whole, path)
    require_numbers(np.asarray(grid.points, dtype=np.float64), path, "points")
    moving = _moving(named, velocity)
    for name in np.unique(np.linspace(0, len(among) - 1, min(len(among), _MOST_LOOKED_AT)).astype(int)):
        if len(moving) < len(named):
            moving |= _moving(_parts(_read(path, among[name]), path)[1], velocity)
    surfaces = [PatchSurface(name, "patch" if name in moving else "wall", surface) for name, surface in named]
    if not surfaces:
        mesh, note = _divided(grid, whole, division or Division(), path)
    elif division is not None:
        raise InputError(f"{path}: the file names its patches, {listed([s.name for s in surfaces])}.")
    else:
        mesh = build_mesh(grid, surfaces, source=str(path))
        note = f"The patches are those of the file: {_named(mesh)}."
    require_volumes(mesh, path)
    if whole.n_cells > grid.n_cells:
        note += f" {whole.n_cells - grid.n_cells} points, lines and surfaces among the cells are left out."
    return grid, mesh, named, note


def _read(path: Path, time: float | str) -> Any:
    """All that a file holds at a time."""
    if not path.is_file():
        raise InputError(f"{path}: no such file.")
    return _read_vtk(path, time) if path.suffix in VTK_SUFFIXES else _read_meshio(path)


def _times(path: Path) -> list[str]:
    """Names of the times of a file, rising; none if it has none."""
    if not path.is_file():
        raise InputError(f"{path}: no such file.")
    if path.suffix == ".series":
        return list(_series(path))
    if path.suffix not in VTK_SUFFIXES:
        return []
    require_survival(path)
    times = _by_vtk(path, times_of, path)
    for time in times:
        if not math.isfinite(time):
            raise InputError(f"{path}: the time {time:g} is none; the file is damaged.")
    return [f"{time:.12g}" for time in times]


def _by_vtk(path: Path, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call a function that lets VTK read a file; what VTK says of it is an error."""
    with spoken() as said, _quiet(path):
        try:
            found = function(*arguments)
        except Exception as error:
            raise InputError(f"{path}: VTK cannot read it: {error or type(error).__name__}") from None
    if said.errors:
        raise InputError(f"{path}: VTK says: {said.errors[0]}")
    return found


def _read_vtk(path: Path, time: float | str) -> Any:
    if path.suffix == ".series":
        path = _of_series(path, time)
    names = _times(path)
    step = pick_time(path, names, time) if names else None
    if step is not None:
        require_survival(path, step)
    found = _by_vtk(path, read_vtk, path, step)
    if path.suffix == ".vtk":
        _require_whole(path)
    if path.suffix == ".pvtu":
        # Cells that a piece has for its neighbours' sake come first; then points where the pieces meet.
        ghosts = found.cell_data.get("vtkGhostType")
        found = found if ghosts is None else found.extract_cells(np.flatnonzero(np.asarray(ghosts) == 0))
        found = found.clean(tolerance=0.0)
    return found


def _require_whole(path: Path) -> None:
    """Refuse a legacy file in text form that ends within its last array, which VTK reads without a word."""
    data = path.read_bytes()
    if data.split(b"\n", 3)[2:3] != [b"ASCII"]:
        return
    lines = data.decode("latin-1").splitlines()[3:]
    heads = [k for k, line in enumerate(lines) if _HEAD.match(line)]
    counts = {words[0]: words[1:] for words in (lines[k].split() for k in heads)}
    if not heads:
        return
    words = lines[heads[-1]].split()
    in_data = next((w[1] for k in reversed(heads) if (w := lines[k].split())[0] in _DATA and len(w) > 1), "0")
    try:
        match words:
            case ["POINTS", n, *_]:
                expected = 3 * int(n)
            case ["CELL_TYPES", n, *_]:
                expected = int(n)
            case ["CELLS", _, n, *_]:
                expected = int(n)
            case ["OFFSETS" | "CONNECTIVITY", *_]:
                expected = int(counts["CELLS"][words[0] == "CONNECTIVITY"])
            case ["VECTORS" | "NORMALS", *_]:
                expected = 3 * int(in_data)
            case ["TENSORS", *_]:
                expected = 9 * int(in_data)
            case ["SCALARS" | "LOOKUP_TABLE", *_]:
                scalars = counts.get("SCALARS", [])
                expected = int(in_data) * (int(scalars[2]) if len(scalars) > 2 else 1)
            case [_, components, tuples, _]:
                expected = int(components) * int(tuples)
            case _:
                return
    except (ValueError, LookupError):
        return
    found = sum(len(line.split()) for line in lines[heads[-1] + 1 :])
    if found < expected:
        raise InputError(
            f"{path}: {words[0]} has {found} values, not {expected}; the file is broken or cut short."
        )


@contextlib.contextmanager
def _quiet(path: Path) -> Iterator[None]:
    """Keep the HDF5 library from printing what goes wrong, which it does beneath Python."""
    if path.suffix != ".vtkhdf":
        yield
        return
    sys.stderr.flush()
    kept = os.dup(2)
    with open(os.devnull, "wb") as nothing:  # noqa: PTH123
        os.dup2(nothing.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(kept, 2)
        os.close(kept)


def _series(path: Path) -> dict[str, str]:
    """The files of a series by the names of their times, rising."""
    try:
        files = json.loads(path.read_text(encoding="utf-8"))["files"]
        times = {f"{float(entry['time']):.12g}": str(entry["name"]) for entry in files}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: not a list of files with their times: {error!r}") from None
    if not times:
        raise InputError(f"{path}: the list of files is empty.")
    return {name: times[name] for name in sorted(times, key=float)}


def _of_series(path: Path, time: float | str) -> Path:
    """The file of a series at a time."""
    times = _series(path)
    names = list(times)
    file = path.parent / times[names[pick_time(path, names, time)]]
    if file.suffix == ".series" or not file.is_file():
        raise InputError(f"{path}: the file {file} is not there.")
    return file


def _read_meshio(path: Path) -> Any:
    import meshio

    # Where a format is beyond it, meshio prints and ends the program.
    words = io.StringIO()
    try:
        with contextlib.redirect_stdout(words), contextlib.redirect_stderr(words), np.errstate(all="ignore"):
            mesh = meshio.read(path)
            grid = pyvista.from_meshio(mesh)
    except (Exception, SystemExit) as error:
        reason = str(error) if not isinstance(error, SystemExit) else " ".join(words.getvalue().split())
        raise InputError(f"{path}: meshio cannot read it: {reason or type(error).__name__}") from None
    for name, value in (mesh.field_data or {}).items():
        # Gmsh's names of physical groups: number and dimension.
        if np.size(value) == 2:
            grid.field_data[name] = np.asarray(value)
    return grid


def _parts(data: Any, path: Path) -> tuple[Any, list[tuple[str, Any]]]:
    """The one unstructured grid in what was read, and the surfaces beside it by name."""
    leaves = list(_leaves("", data))
    grids = [part for _, part in leaves if isinstance(part, pyvista.UnstructuredGrid) and part.n_cells]
    if len(grids) != 1:
        raise InputError(f"{path}: {len(grids)} unstructured grids with cells; exactly one is needed.")
    surfaces = [(name, part) for name, part in leaves if isinstance(part, pyvista.PolyData) and part.n_faces]
    names = [name for name, _ in surfaces]
    if len(set(names)) < len(names):
        raise InputError(f"{path}: two surfaces have the same name; their names are {listed(names)}.")
    return grids[0], surfaces


def _leaves(name: str, block: Any) -> list[tuple[str, Any]]:
    if not isinstance(block, pyvista.MultiBlock):
        return [] if block is None else [(name, block)]
    return [leaf for key, part in zip(block.keys(), block, strict=True) for leaf in _leaves(str(key), part)]


def _solid_cells(grid: Any, path: Path) -> Any:
    """The grid without its points, lines and surfaces."""
    kinds = np.unique(grid.celltypes).tolist()
    _require_lists(grid, path)
    if not set(kinds) & set(CELL_KINDS):
        raise InputError(f"{path}: no cells of the allowed kinds {', '.join(CELL_KINDS.values())}.")
    flat = [kind for kind in kinds if pyvista.CellType(kind).dimension < 3]
    if not flat:
        return grid
    return grid.extract_cells(np.flatnonzero(~np.isin(grid.celltypes, flat)))


def _require_lists(grid: Any, path: Path) -> None:
    """Refuse cells whose lists of points or faces end outside of what there is, or are too long or short."""
    cells = _lists(grid.GetCells(), path, grid.n_points)
    for kind, size in _SIZES.items():
        if np.any(cells[np.asarray(grid.celltypes) == kind] != size):
            name = CELL_KINDS.get(kind, f"cell of VTK type {kind}")
            raise InputError(f"{path}: a {name} has not {size} points; the file is broken.")
    faces, of_cells = grid.GetPolyhedronFaces(), grid.GetPolyhedronFaceLocations()
    if faces is not None and of_cells is not None:
        _lists(of_cells, path, len(_lists(faces, path, grid.n_points)))


def _lists(cells: Any, path: Path, limit: int) -> NDArray[Any]:
    """The lengths of VTK's lists of numbers, which are all below a limit."""
    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.int64)
    numbers = vtk_to_numpy(cells.GetConnectivityArray())
    lengths: NDArray[Any] = np.diff(start)
    sound = not len(start) or (start[0] == 0 and start[-1] == len(numbers) and np.all(lengths >= 0))
    if not sound or (len(numbers) and not 0 <= numbers.min() <= numbers.max() < limit):
        raise InputError(f"{path}: the lists of the cells' points or faces are broken.")
    return lengths


def _moving(surfaces: Sequence[tuple[str, Any]], velocity: str) -> set[str]:
    """Names of the surfaces on which the fluid moves; the others are walls."""
    found = set()
    for name, surface in surfaces:
        given = [data[velocity] for data in (surface.cell_data, surface.point_data) if velocity in data]
        if given and np.any(np.asarray(given[0]) != 0.0):
            found.add(name)
    return found


def _divided(grid: Any, whole: Any, division: Division, path: Path) -> tuple[Mesh, str]:
    """The mesh with its boundary divided as asked, and what the user should know."""
    mesh = build_mesh(grid, None, source=str(path))
    if division.array:
        labels, names = _by_array(mesh, whole, division.array, path)
    elif division.feature_angle is not None:
        labels = _by_angle(mesh, division.feature_angle)
        names = [f"{BOUNDARY}{k}" for k in range(labels.max() + 1)]
    else:
        return mesh, " ".join(
            ["The file names no patches: the whole boundary is one wall, named boundary.", *_crossings(mesh)]
        )
    if len(names) > _MOST_PATCHES:
        raise InputError(f"{path}: the boundary falls into {len(names)} patches; at most {_MOST_PATCHES}.")
    sizes = np.diff(mesh.face_start)[mesh.n_internal :]
    surfaces = []
    for label, name in enumerate(names):
        faces = np.flatnonzero(labels == label)
        stream = [
            np.concatenate([[sizes[f]], mesh.face_points[slice(*mesh.face_start[mesh.n_internal + f :][:2])]])
            for f in faces
        ]
        if stream:
            surfaces.append(
                PatchSurface(name, "wall", pyvista.PolyData(mesh.points, faces=np.concatenate(stream)))
            )
    exact = grid.copy()
    exact.points = mesh.points
    mesh = build_mesh(exact, surfaces, source=str(path))
    return mesh, " ".join([f"The boundary is divided into {_named(mesh)}.", *_crossings(mesh)])


def _by_array(mesh: Mesh, whole: Any, array: str, path: Path) -> tuple[NDArray[np.intp], list[str]]:
    """The patch of each boundary face by an array on the surface cells, and the patches' names."""
    if array not in whole.cell_data:
        raise InputError(f"{path}: no cell array {array}. {suggestion(array, whole.cell_data.keys())}")
    values = np.asarray(whole.cell_data[array])
    if values.ndim != 1 or values.dtype.kind not in "iu":
        raise InputError(f"{path}: cell array {array} is not one of whole numbers, one for each cell.")
    flat = [kind for kind in np.unique(whole.celltypes).tolist() if pyvista.CellType(kind).dimension == 2]
    rows = np.flatnonzero(np.isin(whole.celltypes, flat))
    if len(rows) == 0:
        raise InputError(f"{path}: no surface cells among the cells, for {array} to name patches on.")
    names = {int(value[0]): name for name, value in _groups(whole) if int(value[1]) == 2}
    found = {
        frozenset(
            map(tuple, np.asarray(whole.points, dtype=np.float64)[whole.get_cell(row).point_ids] + 0.0)
        ): (int(values[row]))
        for row in rows.tolist()
    }
    labels = np.empty(len(mesh.boundary_centres), dtype=np.intp)
    used: dict[str, int] = {}
    for face in range(len(labels)):
        begin, end = mesh.face_start[mesh.n_internal + face : mesh.n_internal + face + 2]
        corners = frozenset(map(tuple, mesh.points[mesh.face_points[begin:end]] + 0.0))
        value = found.get(corners)
        name = BOUNDARY if value is None else names.get(value, f"{BOUNDARY}{value}")
        labels[face] = used.setdefault(name, len(used))
    return labels, list(used)


def _groups(grid: Any) -> list[tuple[str, Any]]:
    return [
        (str(name), grid.field_data[name])
        for name in grid.field_data.keys()  # noqa: SIM118
        if np.size(grid.field_data[name]) == 2
    ]


def _boundary_edges(mesh: Mesh) -> tuple[NDArray[np.int64], NDArray[np.intp]]:
    """The edges of the boundary faces, face after face: a number for each that its points give; its face."""
    start = mesh.face_start[mesh.n_internal :].astype(np.intp)
    sizes = np.diff(start)
    a = mesh.face_points[start[0] :].astype(np.int64)
    b = np.roll(a, -1)
    b[start[1:] - start[0] - 1] = a[start[:-1] - start[0]]
    return (np.minimum(a, b) << 32) | np.maximum(a, b), np.repeat(np.arange(len(sizes)), sizes)


def _crossings(mesh: Mesh) -> list[str]:
    """A warning where the boundary crosses itself, as it does about a cell that names a wrong point."""
    edges, _ = _boundary_edges(mesh)
    crossings = np.count_nonzero(np.unique(edges, return_counts=True)[1] > 2)
    if not crossings:
        return []
    return [
        f"At {crossings} edges more than two boundary faces meet: the domain touches itself there, or cells "
        "name points that are not theirs."
    ]


def _by_angle(mesh: Mesh, angle: float) -> NDArray[np.intp]:
    """The patch of each boundary face: faces are together across edges that turn by less than the angle."""
    edges, face = _boundary_edges(mesh)
    order = np.argsort(edges, kind="stable")
    same = edges[order[1:]] == edges[order[:-1]]
    one, other = face[order[:-1]][same], face[order[1:]][same]
    normals = mesh.boundary_areas / np.maximum(
        np.linalg.norm(mesh.boundary_areas, axis=1, keepdims=True), 1e-300
    )
    smooth = np.einsum("ei,ei->e", normals[one], normals[other]) > np.cos(np.radians(angle))
    graph = sparse.coo_array(
        (np.ones(np.count_nonzero(smooth), dtype=np.int8), (one[smooth], other[smooth])),
        shape=2 * (len(mesh.boundary_centres),),
    )
    labels: NDArray[np.intp] = csgraph.connected_components(graph, directed=False)[1].astype(np.intp)
    return labels


def _named(mesh: Mesh) -> str:
    """The patches by name, type and number of faces."""
    faces = np.diff(mesh.patch_start).tolist()
    return listed([f"{p.name} ({p.type}, {n} faces)" for p, n in zip(mesh.patches, faces, strict=True)])


def _vectors(values: Any, name: str, path: Path) -> Floats:
    vectors = np.asarray(values, dtype=np.float64)
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise InputError(f"{path}: array {name} has shape {vectors.shape}, but a velocity has 3 components.")
    require_numbers(vectors, path, f"values of {name}")
    return vectors


def _gradients(grid: Any, name: str, path: Path) -> Floats:
    """A gradient (n_cells, 3, 3), l_ij = ∂u_i/∂x_j."""
    if name not in grid.cell_data:
        raise InputError(f"{path}: no cell array {name}. {suggestion(name, grid.cell_data.keys())}")
    values = np.asarray(grid.cell_data[name], dtype=np.float64)
    if values.shape != (grid.n_cells, 9):
        raise InputError(f"{path}: array {name} has shape {values.shape}, but a gradient has 9 components.")
    require_numbers(values, path, f"values of {name}")
    return values.reshape(-1, 3, 3).transpose(0, 2, 1)
