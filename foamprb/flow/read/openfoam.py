"""The flow of an OpenFOAM case at one of its times.

Mesh and fields come through VTK's OpenFOAM reader, which gives single precision, loses the types of the
patches and passes over most faults in silence. What it loses is read here from the small dictionaries, and
what it passes over is checked.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.boundary import PatchInfo, read_boundary
from foamprb.flow.read.case import cell_zones, field_path, mesh_folder, select_time, shown
from foamprb.flow.read.checks import noted_counts, require_labels, require_numbers, require_volumes
from foamprb.flow.read.vtk_reader import open_reader, raise_first_error, read_blocks, update, vtk_messages
from foamprb.flow.reconstruct import VALUELESS, Reconstruction

PRECISION_NOTE = (
    "Coordinates and velocities have passed through single precision in VTK's OpenFOAM reader: a relative "
    "error of up to 6e-8 each, the coordinates' relative to their distance from the origin."
)


def read_case(
    case: Path | str,
    time: float | str = "latestTime",
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
) -> MeshFlow:
    """Read mesh, patches and velocity of a case at one time, and reconstruct the flow.

    Parameters
    ----------
    case
        The case's folder.
    time
        A time's value, or ``latestTime``.
    velocity
        Name of the velocity field, a ``volVectorField`` in m/s.
    region
        Name of the mesh region, if the case has several.
    gradient
        Name of the velocity's gradient, a ``volTensorField`` in 1/s such as ``grad(U)``, to be taken for the
        gradient at the cells; without a name it is reconstructed from the velocity.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent: the case, the time, the field, the mesh or a patch.
    """
    mesh, cells, boundary, name = read_fields(Path(case), time, velocity, region)
    given = _read_gradient(Path(case), name, gradient, region) if gradient else None
    u, l = Reconstruction(mesh)(cells, boundary, given)
    notes = [PRECISION_NOTE]
    if float(name) == 0.0:
        notes.append(f"The flow is that of time {name}, which is usually the initial guess and no solution.")
    return MeshFlow(mesh, u, l, notes, zones=lambda: cell_zones(mesh_folder(Path(case), name, region)))


def _read_gradient(case: Path, time: str, field: str, region: str) -> Floats:
    """A gradient (n_cells, 3, 3), l_ij = ∂u_i/∂x_j, 1/s."""
    path = _gradient_path(case / time / region, field)
    blocks, messages = read_blocks(case, time, (field,), region, patches=False)
    raise_first_error(case, messages)
    return _gradients(blocks, field, path)


def _gradient_path(folder: Path, field: str) -> Path:
    return field_path(folder, field, "volTensorField", "the gradient of a velocity")


def _gradients(blocks: dict[str, Any], field: str, path: Path) -> Floats:
    """l_ij = ∂u_i/∂x_j (n_cells, 3, 3), 1/s; OpenFOAM's component 3i + j is ∂u_j/∂x_i."""
    return _values(blocks["internalMesh"], field, path, "the cells", 9).reshape(-1, 3, 3).transpose(0, 2, 1)


def read_fields(
    case: Path, time: float | str = "latestTime", velocity: str = "U", region: str = ""
) -> tuple[Mesh, Floats, Floats, str]:
    """Read the mesh with the velocity at its cells (n_cells, 3) and boundary faces (n_boundary, 3), m/s.

    Returns
    -------
    mesh, cells, boundary, name
        Boundary faces of patches that have no values carry zeros; ``name`` is the time directory's.

    Raises
    ------
    InputError
        As :func:`read_case`.
    """
    name = select_time(case, time, region)
    path = field_path(case / name / region, velocity)
    folder = mesh_folder(case, name, region)
    patches = read_boundary(folder / "boundary", case)
    noted = noted_counts(folder)
    require_labels(folder, noted)
    blocks, messages = read_blocks(case, name, (velocity,), region, patches=True)
    grid = blocks["internalMesh"]
    for word, found in (("nCells", grid.n_cells), ("nPoints", grid.n_points)):
        if word in noted and noted[word] != found:
            raise InputError(
                f"{shown(folder / 'owner')}: the header says {word} {noted[word]}, but the mesh that the "
                f"files describe has {found}; the mesh is damaged."
            )
    raise_first_error(case, messages)
    surfaces = []
    for patch in patches:
        block = blocks.get(patch.name)
        if block is None or block.n_cells != patch.faces:
            raise InputError(
                f"{shown(folder / 'boundary')}: patch {patch.name} has {patch.faces} faces, but "
                f"{0 if block is None else block.n_cells} could be read."
            )
        surfaces.append(PatchSurface(patch.name, patch.type, block, patch.neighbour))
    cells, boundary = _velocities(blocks, patches, velocity, path)
    require_numbers(np.asarray(grid.points, dtype=np.float64), folder / "points", "points")
    mesh = build_mesh(grid, surfaces, source=str(folder))
    require_volumes(mesh, folder)
    return mesh, cells, boundary, name


class VelocityReader:
    """Reads the velocity of a case at one time after the other, the mesh but once.

    Parameters
    ----------
    case
        The case, whose mesh does not change.
    time
        Name of a time directory.
    velocity, region, gradient
        As :func:`read_case`.
    """

    def __init__(self, case: Path, time: str, velocity: str, region: str = "", gradient: str = "") -> None:
        self._case, self._region, self._velocity, self._gradient = case, region, velocity, gradient
        self._folder = mesh_folder(case, time, region)
        self._patches = read_boundary(self._folder / "boundary", case)
        with vtk_messages():
            self._reader = open_reader(case, (velocity, gradient), region, patches=True)

    def __call__(self, time: str) -> tuple[Floats, Floats, Floats | None]:
        """Velocity at the cells (n_cells, 3) and boundary faces (n_boundary, 3), m/s, and the given gradient.

        Raises
        ------
        InputError
            A field is missing, broken or not of the mesh's size.
        """
        folder = self._case / time / self._region
        path = field_path(folder, self._velocity)
        given = _gradient_path(folder, self._gradient) if self._gradient else None
        with vtk_messages() as messages:
            blocks = update(self._reader, time)
        raise_first_error(self._case, messages)
        cells, boundary = _velocities(blocks, self._patches, self._velocity, path)
        l = None if given is None else _gradients(blocks, self._gradient, given)
        return cells, boundary, l

    def zones(self) -> Mapping[str, NDArray[np.int64]]:
        """The cells of each zone, by name; InputError if they cannot be read."""
        return cell_zones(self._folder)


def _velocities(
    blocks: dict[str, Any], patches: Sequence[PatchInfo], velocity: str, path: Path
) -> tuple[Floats, Floats]:
    """Velocity at the cells and at the boundary faces, zero on patches that have no values, m/s."""
    cells = _values(blocks["internalMesh"], velocity, path, "the cells")
    values = [np.zeros((0, 3))]
    for patch in patches:
        if patch.type in VALUELESS:
            values.append(np.zeros((patch.faces, 3)))
        else:
            values.append(_values(blocks[patch.name], velocity, path, f"patch {patch.name}"))
    return cells, np.concatenate(values)


def _values(block: Any, field: str, path: Path, where: str, components: int = 3) -> Floats:
    if field not in block.cell_data:
        raise InputError(f"{path}: no values could be read for {where}; the file is broken or cut short.")
    values = np.asarray(block.cell_data[field], dtype=np.float64)
    shape = (block.n_cells, components)
    if values.shape != shape:
        raise InputError(f"{path}: {where} have values of shape {values.shape}, not {shape}.")
    require_numbers(values, path, f"values of {where}")
    return values
