"""A flow from a mesh file: ``.vtu .vtk .vtkhdf .pvd .vtm`` through VTK, other formats through meshio.

Such a file names no patches. Its whole boundary is one patch, ``boundary``, of type ``wall``: particles touch
it, but its velocity is what the field in the file says, at rest or not.
"""

from __future__ import annotations

import contextlib
import io
from pathlib import Path
from typing import Any

import numpy as np
import pyvista

from foamprb.errors import InputError
from foamprb.flow.mesh import CELL_KINDS, Floats, build_mesh
from foamprb.flow.openfoam import spoken
from foamprb.flow.reconstruct import Reconstruction, from_points
from foamprb.flow.walk import MeshFlow

__all__ = ["VTK_SUFFIXES", "read_mesh_file"]

VTK_SUFFIXES = frozenset({".vtu", ".vtk", ".vtkhdf", ".pvd", ".vtm"})


def read_mesh_file(path: Path, velocity: str = "U") -> MeshFlow:
    """Read a mesh with velocities, at its last time if it has several.

    Parameters
    ----------
    path
        The file.
    velocity
        Name of the velocity array (n, 3), m/s. Cell data are preferred; point data are taken as they are for
        the values at the mesh points when there is nothing else.

    Raises
    ------
    InputError
        The file cannot be read, holds no three-dimensional cells, or lacks the velocity.
    """
    if not path.is_file():
        raise InputError(f"{path}: no such file.")
    grid = _solid_cells(_read_vtk(path) if path.suffix in VTK_SUFFIXES else _read_meshio(path), path)
    mesh = build_mesh(grid, None, source=str(path))
    if velocity in grid.cell_data:
        nowhere = np.zeros(len(mesh.boundary_centres), dtype=bool)
        cells = _vectors(grid.cell_data[velocity], velocity, path)
        u, l = Reconstruction(mesh, valued=nowhere)(cells, np.zeros((len(nowhere), 3)))
        note = "Velocities are cell values; none were given on the boundary, where they are extrapolated."
    elif velocity in grid.point_data:
        u, l = from_points(mesh, _vectors(grid.point_data[velocity], velocity, path))
        note = "Velocities are point values; their gradient is first-order accurate."
    else:
        names = sorted({*grid.cell_data.keys(), *grid.point_data.keys()})
        raise InputError(f"{path}: no array {velocity}; the arrays are {', '.join(names) or '(none)'}.")
    return MeshFlow(mesh, u, l, [note, "The file names no patches: the whole boundary is one wall."])


def _read_vtk(path: Path) -> Any:
    with spoken() as said:
        try:
            reader = pyvista.get_reader(path)
            times = getattr(reader, "time_values", None)
            if times:
                reader.set_active_time_value(times[-1])
            found = reader.read()
        except Exception as error:
            raise InputError(f"{path}: VTK cannot read it: {error}") from None
    if said.errors:
        raise InputError(f"{path}: VTK says: {said.errors[0]}")
    return found


def _read_meshio(path: Path) -> Any:
    import meshio

    # Where a format is beyond it, meshio prints and ends the program.
    words = io.StringIO()
    try:
        with contextlib.redirect_stdout(words), contextlib.redirect_stderr(words):
            return pyvista.from_meshio(meshio.read(path))
    except (Exception, SystemExit) as error:
        reason = str(error) if not isinstance(error, SystemExit) else " ".join(words.getvalue().split())
        raise InputError(f"{path}: meshio cannot read it: {reason or type(error).__name__}") from None


def _solid_cells(data: Any, path: Path) -> Any:
    """The one unstructured grid in what was read, without its points, lines and surfaces."""
    parts = [data]
    if isinstance(data, pyvista.MultiBlock):
        parts = list(data.recursive_iterator())
    grids = [part for part in parts if isinstance(part, pyvista.UnstructuredGrid) and part.n_cells]
    if len(grids) != 1:
        raise InputError(f"{path}: {len(grids)} unstructured grids with cells; exactly one is needed.")
    grid = grids[0]
    solid = np.isin(grid.celltypes, list(CELL_KINDS))
    if not solid.any():
        raise InputError(f"{path}: no cells of the allowed kinds {', '.join(CELL_KINDS.values())}.")
    flat = np.array([pyvista.CellType(kind).dimension < 3 for kind in np.unique(grid.celltypes).tolist()])
    if flat.any():
        kinds = np.unique(grid.celltypes)[~flat]
        grid = grid.extract_cells(np.flatnonzero(np.isin(grid.celltypes, kinds)))
    return grid


def _vectors(values: Any, name: str, path: Path) -> Floats:
    vectors = np.asarray(values, dtype=np.float64)
    if vectors.ndim != 2 or vectors.shape[1] != 3:
        raise InputError(f"{path}: array {name} has shape {vectors.shape}, but a velocity has 3 components.")
    if not np.isfinite(vectors).all():
        raise InputError(
            f"{path}: array {name} has {np.count_nonzero(~np.isfinite(vectors))} values that are no number."
        )
    return vectors
