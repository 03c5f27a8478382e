"""Files that VTK or meshio reads, and their contents at a time."""

from __future__ import annotations

import contextlib
import io
import json
import math
import os
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError
from foamprb.flow.mesh.cells import CELL_KINDS
from foamprb.flow.read.times import listed, pick_time
from foamprb.flow.read.vtk_guard import load_pyvista, read_vtk, require_survival, times_of
from foamprb.flow.read.vtk_reader import vtk_messages
from foamprb.optional import load

VTK_SUFFIXES = frozenset({".vtu", ".pvtu", ".vtk", ".vtkhdf", ".pvd", ".vtm", ".series"})
_SIZES = {1: 1, 3: 2, 5: 3, 8: 4, 9: 4, 10: 4, 12: 8, 13: 6, 14: 5}
"""Number of points of the kinds of cells with a fixed number."""
_HEAD = re.compile(r"(?!nan|inf)[A-Za-z_]", re.IGNORECASE)
_DATA = ("CELL_DATA", "POINT_DATA")


def read_file(path: Path, time: float | str) -> Any:
    """Read the contents of a file at a time."""
    if not path.is_file():
        raise InputError(f"{path}: no such file.")
    return _read_by_vtk(path, time) if path.suffix in VTK_SUFFIXES else _read_meshio(path)


def times_of_file(path: Path) -> list[str]:
    """Return the names of the times of a file, rising; empty if it has no times."""
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
            raise InputError(f"{path}: the time {time:g} is not finite; the file is damaged.")
    return [f"{time:.12g}" for time in times]


def _by_vtk(path: Path, function: Callable[..., Any], *arguments: Any) -> Any:
    """Call a function that reads a file by VTK; raise VTK's errors."""
    with vtk_messages() as messages, _quiet(path):
        try:
            found = function(*arguments)
        except Exception as error:
            raise InputError(f"{path}: VTK cannot read it: {error or type(error).__name__}") from None
    if messages.errors:
        raise InputError(f"{path}: VTK says: {messages.errors[0]}")
    return found


def _read_by_vtk(path: Path, time: float | str) -> Any:
    if path.suffix == ".series":
        path = _of_series(path, time)
    names = times_of_file(path)
    step = pick_time(path, names, time) if names else None
    if step is not None:
        require_survival(path, step)
    found = _by_vtk(path, read_vtk, path, step)
    if path.suffix == ".vtk":
        _require_whole(path)
    if path.suffix == ".pvtu":
        # Remove the ghost cells of the pieces, then the duplicate points where the pieces meet.
        ghosts = found.cell_data.get("vtkGhostType")
        found = found if ghosts is None else found.extract_cells(np.flatnonzero(np.asarray(ghosts) == 0))
        found = found.clean(tolerance=0.0)
    return found


def _require_whole(path: Path) -> None:
    """Raise InputError for a truncated legacy text file, which VTK reads without an error."""
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
    """Suppress messages that the HDF5 library prints beneath Python."""
    if path.suffix != ".vtkhdf":
        yield
        return
    sys.stderr.flush()
    original = os.dup(2)
    with open(os.devnull, "wb") as nothing:  # noqa: PTH123
        os.dup2(nothing.fileno(), 2)
    try:
        yield
    finally:
        os.dup2(original, 2)
        os.close(original)


def _series(path: Path) -> dict[str, str]:
    """Return the files of a series by the names of their times, rising."""
    try:
        files = json.loads(path.read_text(encoding="utf-8"))["files"]
        times = {f"{float(entry['time']):.12g}": str(entry["name"]) for entry in files}
    except (OSError, ValueError, KeyError, TypeError) as error:
        raise InputError(f"{path}: not a list of files with their times: {error!r}") from None
    if not times:
        raise InputError(f"{path}: the list of files is empty.")
    return {name: times[name] for name in sorted(times, key=float)}


def _of_series(path: Path, time: float | str) -> Path:
    """Return the file of a series at a time."""
    times = _series(path)
    names = list(times)
    file = path.parent / times[names[pick_time(path, names, time)]]
    if file.suffix == ".series" or not file.is_file():
        raise InputError(f"{path}: the file {file} does not exist.")
    return file


def _read_meshio(path: Path) -> Any:
    meshio = load("meshio", "meshes", "mesh files need")
    pyvista = load_pyvista()
    # For unknown formats meshio prints a message and ends the program.
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


def grid_and_surfaces(data: Any, path: Path) -> tuple[Any, list[tuple[str, Any]]]:
    """Return the one unstructured grid in the data, and the surfaces by name."""
    pyvista = load_pyvista()
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
    if not isinstance(block, load_pyvista().MultiBlock):
        return [] if block is None else [(name, block)]
    return [leaf for key, part in zip(block.keys(), block, strict=True) for leaf in _leaves(str(key), part)]


def solid_cells(grid: Any, path: Path) -> Any:
    """Return the grid without its points, lines and surfaces."""
    kinds = np.unique(grid.celltypes).tolist()
    _require_lists(grid, path)
    if not set(kinds) & set(CELL_KINDS):
        raise InputError(f"{path}: no cells of the allowed kinds {', '.join(CELL_KINDS.values())}.")
    flat = [kind for kind in kinds if load_pyvista().CellType(kind).dimension < 3]
    if not flat:
        return grid
    return grid.extract_cells(np.flatnonzero(~np.isin(grid.celltypes, flat)))


def _require_lists(grid: Any, path: Path) -> None:
    """Raise InputError for cells whose lists of points or faces are out of range or of a wrong length."""
    cells = _lists(grid.GetCells(), path, grid.n_points)
    for kind, size in _SIZES.items():
        if np.any(cells[np.asarray(grid.celltypes) == kind] != size):
            name = CELL_KINDS.get(kind, f"cell of VTK type {kind}")
            raise InputError(f"{path}: a {name} does not have {size} points; the file is broken.")
    faces, of_cells = grid.GetPolyhedronFaces(), grid.GetPolyhedronFaceLocations()
    if faces is not None and of_cells is not None:
        _lists(of_cells, path, len(_lists(faces, path, grid.n_points)))


def _lists(cells: Any, path: Path, limit: int) -> NDArray[Any]:
    """Return the lengths of VTK's lists of numbers, which must be below a limit."""
    start = vtk_to_numpy(cells.GetOffsetsArray()).astype(np.int64)
    numbers = vtk_to_numpy(cells.GetConnectivityArray())
    lengths: NDArray[Any] = np.diff(start)
    sound = not len(start) or (start[0] == 0 and start[-1] == len(numbers) and np.all(lengths >= 0))
    if not sound or (len(numbers) and not 0 <= numbers.min() <= numbers.max() < limit):
        raise InputError(f"{path}: the lists of the cells' points or faces are broken.")
    return lengths
