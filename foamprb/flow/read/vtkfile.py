"""Files that VTK or meshio reads, and their contents at a time."""

from __future__ import annotations

import contextlib
import io
import math
import os
import re
import sys
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import TYPE_CHECKING, Any, TypedDict
from xml.etree import ElementTree

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError
from foamprb.flow.mesh.boundary import mix
from foamprb.flow.mesh.cells import CELL_KINDS, CURVED
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.read.times import listed, pick_time
from foamprb.flow.read.vtk_guard import load_pyvista, read_vtk, require_survival, times_of
from foamprb.flow.read.vtk_messages import vtk_messages
from foamprb.optional import load
from foamprb.results.reading import read_json

if TYPE_CHECKING:
    from vtkmodules.vtkCommonDataModel import vtkUnstructuredGrid

_PIECES = frozenset({".pvtu", ".pvti", ".pvtr", ".pvts"})
VTK_SUFFIXES = _PIECES | {
    ".vtu",
    ".vti",
    ".vtr",
    ".vts",
    ".vtk",
    ".vtkhdf",
    ".cgns",
    ".pvd",
    ".vtm",
    ".case",
    ".series",
}
_SIZES = {1: 1, 3: 2, 5: 3, 8: 4, 9: 4, 10: 4, 11: 8, 12: 8, 13: 6, 14: 5}
"""Number of points of the kinds of cells with a fixed number."""
_HEAD = re.compile(r"(?!nan|inf)[A-Za-z_]", re.IGNORECASE)
_DATA = ("CELL_DATA", "POINT_DATA")
_TABLE = """\
import numpy as np, pyvista as pv
x, y, z, u, v, w = np.loadtxt("{name}", {options}, unpack=True)
cloud = pv.PolyData(np.column_stack([x, y, z]))
cloud["U"] = np.column_stack([u, v, w])
cloud.delaunay_3d().save("flow.vtu")"""
_OTHERS = {
    (".foam", ".openfoam"): "it stands for an OpenFOAM case. Allowed: -case DIR, without -flow.",
    (".cas.h5", ".dat.h5", ".cas", ".cas.gz"): "files of Fluent are not read. Export CGNS or EnSight from "
    "Fluent, or open them in ParaView and save the data as .vtu.",
    (".plt", ".szplt"): "such files of Tecplot are not read. Export CGNS or EnSight from the solver, or open "
    "them in ParaView and save the data as .vtu.",
    (".step", ".stp", ".iges", ".igs", ".brep"): "a CAD geometry has neither cells nor velocities. Compute "
    "the flow in it, and export the cells with their velocity as CGNS, EnSight or .vtu.",
    (".stl", ".obj", ".ply", ".vtp"): "a surface has neither cells with volume nor the flow between them. "
    "Export the cells of the fluid with their velocity as CGNS, EnSight or .vtu.",
}
"""Hints by the endings of files that are no meshes."""
_GMSH = {
    b"$ParametricNodes": "$ParametricNodes is not read. Write the file with Gmsh's option "
    "Mesh.SaveParametric 0.",
    b" np.float64(": "its numbers are written as np.float64(…), by meshio with numpy 2, and cannot be read. "
    "Write it by meshio.write(…, binary=True), or as .vtu.",
}
"""Hints by texts of Gmsh's files that are not read."""
_TABLES = {".csv": 'delimiter=",", skiprows=1', ".tsv": "skiprows=1", ".txt": 'comments="%"'}
"""Options of reading tables by the endings of their names; the last ones are COMSOL's."""
_EMPTY = "no grid with cells."
_FLAT = (
    "only points, lines and surfaces, no cells with volume. Export the cells of the fluid with their "
    "velocity; 2-D data as one layer of cells."
)
_NEAR = 1e-3
"""Distance of faces that lie on each other, as a fraction of their size."""


def read_file(path: Path, time: float | str) -> Any:
    """Read the contents of a file at a time."""
    _require_mesh(path)
    return _read_by_vtk(path, time) if _is_for_vtk(path) else _read_meshio(path)


def _is_for_vtk(path: Path) -> bool:
    """Return whether VTK reads a file; of XDMF's files meshio reads those of one time."""
    return path.suffix in VTK_SUFFIXES or (
        path.suffix in (".xdmf", ".xmf") and b"Temporal" in path.read_bytes()
    )


def _require_mesh(path: Path) -> None:
    """Raise InputError for a missing file, and for one that is no mesh, with a way to make one of it."""
    if not path.is_file():
        raise InputError(f"{path}: no such file.")
    name = path.name.lower()
    for endings, hint in _OTHERS.items():
        if name.endswith(endings):
            raise InputError(f"{path}: {hint}")
    if path.suffix in _TABLES:
        lines = _TABLE.format(name=path.name, options=_TABLES[path.suffix])
        raise InputError(
            f"{path}: a table of points is no mesh. If its columns are x y z u v w and the domain is convex, "
            f"these lines of Python make a mesh of it (docs/tables.md has more):\n\n{lines}\n"
        )
    if path.suffix == ".msh":
        data = path.read_bytes()
        for text, hint in _GMSH.items():
            if text in data:
                raise InputError(f"{path}: {hint}")


def times_of_file(path: Path) -> list[str]:
    """Return the names of the times of a file, rising; empty if it has no times."""
    _require_mesh(path)
    if path.suffix == ".series":
        return list(_series(path))
    if not _is_for_vtk(path):
        return []
    require_survival(path)
    if path.suffix == ".pvd":
        _require_single_entries(path)
    times = _by_vtk(path, times_of, path)
    for time in times:
        if not math.isfinite(time):
            raise InputError(f"{path}: the time {time:g} is not finite; the file is damaged.")
    return [f"{time:.12g}" for time in times]


def _require_single_entries(path: Path) -> None:
    """Raise InputError if a list of files has two for one part of one time."""
    first: dict[tuple[float, int, str], str] = {}
    for entry in _by_vtk(path, load_pyvista().PVDReader, path).datasets:
        other = first.setdefault((entry.time, entry.part, entry.group), entry.path)
        if other != entry.path:
            raise InputError(
                f"{path}: the time {entry.time:g} is there twice, as {other} and {entry.path}. Remove one, "
                "or number the parts of one time (part)."
            )


def _by_vtk(path: Path, function: Callable[..., Any], *arguments: object) -> Any:
    """Call a function that reads a file by VTK; raise VTK's errors."""
    with vtk_messages() as messages, _quiet(path):
        try:
            result = function(*arguments)
        except Exception as error:
            raise InputError(f"{path}: VTK cannot read it: {error or type(error).__name__}") from None
    if messages.errors:
        raise InputError(f"{path}: VTK says: {messages.errors[0]}")
    return result


def _read_by_vtk(path: Path, time: float | str) -> Any:
    if path.suffix == ".series":
        path = _of_series(path, time)
    names = times_of_file(path)
    step = pick_time(path, names, time) if names else None
    if step is not None:
        require_survival(path, step)
    data = _by_vtk(path, read_vtk, path, step)
    if path.suffix == ".vtk":
        _require_whole(path)
    if path.suffix in (".xdmf", ".xmf"):
        data = _united(data, path)
    if path.suffix in _PIECES:
        # Remove the ghost cells of the pieces.
        ghosts = data.cell_data.get("vtkGhostType")
        data = data if ghosts is None else data.extract_cells(np.flatnonzero(np.asarray(ghosts) == 0))
    return data


def _united(data: Any, path: Path) -> Any:
    """Return one grid, with all arrays, of the series of an XDMF file that have the same points.

    VTK also gives grids that belong to no series, with arrays of the first time.
    """
    grids = ElementTree.parse(path).iter("Grid")
    series = {grid.get("Name") for grid in grids if grid.get("CollectionType") == "Temporal"}
    blocks = zip(data.keys(), data, strict=True) if isinstance(data, load_pyvista().MultiBlock) else ()
    of_series = [leaf for name, block in blocks if name in series for leaf in _leaves(name, block)]
    different: list[Any] = []
    for _, part in of_series or _leaves("", data):
        same = (g for g in different if g.n_cells == part.n_cells and np.array_equal(g.points, part.points))
        grid = next(same, None)
        if grid is None:
            different.append(part)
        else:
            grid.point_data.update(part.point_data)
            grid.cell_data.update(part.cell_data)
    return load_pyvista().MultiBlock(different)


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
    count = sum(len(line.split()) for line in lines[heads[-1] + 1 :])
    if count < expected:
        raise InputError(
            f"{path}: {words[0]} has {count} values, not {expected}; the file is broken or cut short."
        )


@contextlib.contextmanager
def _quiet(path: Path) -> Iterator[None]:
    """Suppress messages that the libraries of HDF5 and CGNS print beneath Python."""
    if path.suffix not in (".vtkhdf", ".cgns"):
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


class _Entry(TypedDict):
    name: str
    time: float


class _Series(TypedDict):
    """Contents of a series of files."""

    files: list[_Entry]


def _series(path: Path) -> dict[str, str]:
    """Return the files of a series by the names of their times, rising."""
    files = read_json(path, _Series)["files"]
    times = {f"{entry['time']:.12g}": entry["name"] for entry in files}
    if not times:
        raise InputError(f"{path}: the list of files is empty.")
    if len(times) < len(files):
        raise InputError(f"{path}: {len(files)} files have {len(times)} different times. Remove the others.")
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
    except ModuleNotFoundError as error:
        raise InputError(
            f"{path}: meshio needs {error.name} for this format: pip install 'foamprb[meshes]', or in a "
            "clone pip install '.[meshes]'."
        ) from None
    except (Exception, SystemExit) as error:
        reason = str(error) if not isinstance(error, SystemExit) else " ".join(words.getvalue().split())
        raise InputError(f"{path}: meshio cannot read it: {reason or type(error).__name__}") from None
    for name, value in (mesh.field_data or {}).items():
        # Gmsh's names of physical groups: number and dimension.
        if np.size(value) == 2:
            grid.field_data[name] = np.asarray(value)
    return grid


def grid_and_surfaces(data: Any, path: Path) -> tuple[Any, list[tuple[str, Any]]]:
    """Return the unstructured grid of all cells in the data, and the surfaces by name."""
    pyvista = load_pyvista()
    structured = pyvista.ImageData, pyvista.RectilinearGrid, pyvista.StructuredGrid
    leaves = [
        (name, part.cast_to_unstructured_grid() if isinstance(part, structured) else part)
        for name, part in _leaves("", data)
    ]
    grids = [part for _, part in leaves if isinstance(part, pyvista.UnstructuredGrid) and part.n_cells]
    if not grids:
        reason = _FLAT if any(part.n_cells for _, part in leaves if hasattr(part, "n_cells")) else _EMPTY
        raise InputError(f"{path}: {reason}")
    if len(grids) > 1:
        grids = [pyvista.merge(grids, merge_points=False)]
    surfaces = [(name, part) for name, part in leaves if isinstance(part, pyvista.PolyData) and part.n_faces]
    names = [name for name, _ in surfaces]
    if len(set(names)) < len(names):
        raise InputError(f"{path}: two surfaces have the same name; their names are {listed(names)}.")
    return grids[0], surfaces


def _leaves(name: str, block: Any) -> list[tuple[str, Any]]:
    if not isinstance(block, load_pyvista().MultiBlock):
        return [] if block is None else [(name, block)]
    return [leaf for key, part in zip(block.keys(), block, strict=True) for leaf in _leaves(str(key), part)]


def solid_cells(grid: vtkUnstructuredGrid, path: Path) -> tuple[Any, list[str]]:
    """Return the grid without its points, lines and surfaces, coinciding points merged; and notes."""
    kinds = np.unique(grid.celltypes).tolist()
    _require_lists(grid, path)
    flat = np.isin(grid.celltypes, [kind for kind in kinds if load_pyvista().CellType(kind).dimension < 3])
    if flat.all():
        raise InputError(f"{path}: {_FLAT}")
    if not set(kinds) & {*CELL_KINDS, *CURVED}:
        raise InputError(f"{path}: no cells of the allowed kinds {', '.join(CELL_KINDS.values())}.")
    notes = []
    if flat.any():
        notes.append(f"{flat.sum()} points, lines and surfaces among the cells are left out.")
        grid = grid.extract_cells(np.flatnonzero(~flat))
    curved = np.count_nonzero(np.isin(grid.celltypes, list(CURVED)))
    if curved:
        notes.append(f"{curved} cells of higher order are read by their corners alone, with plane faces.")
    points = np.asarray(grid.points) + 0.0
    codes = sum(
        mix(mix(column.view(f"i{column.itemsize}")) + np.uint64(k))
        for k, column in enumerate(points.T.copy())
    )
    copies = grid.n_points - len(np.unique(codes))
    if copies:
        notes.append(f"{copies} points that coincide with others are merged with them.")
        grid = grid.clean(tolerance=0.0)
    return grid, notes


def require_joined(mesh: Mesh, path: Path) -> None:
    """Raise InputError if boundary faces lie on each other, between cells that share no points."""
    from scipy.spatial import KDTree

    size = np.linalg.norm(mesh.boundary_areas, axis=1)
    nearest = KDTree(mesh.boundary_centres).query(mesh.boundary_centres, k=2)
    distance, other = np.asarray(nearest[0]), np.asarray(nearest[1])
    along = np.einsum("fi,fi->f", mesh.boundary_areas, mesh.boundary_areas[other[:, 1]])
    twice = np.flatnonzero(
        (distance[:, 1] < _NEAR * np.sqrt(size)) & (along < -0.9 * size * size[other[:, 1]])
    )
    if len(twice):
        x = "({:g} {:g} {:g})".format(*mesh.boundary_centres[twice[0]])
        raise InputError(
            f"{path}: {len(twice)} boundary faces lie on each other, the first at {x}: cells there share no "
            "points, and particles could not pass. Merge the points, such as by ParaView's Clean to Grid."
        )


def _require_lists(grid: vtkUnstructuredGrid, path: Path) -> None:
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
