"""The flow of an OpenFOAM case at one of its times.

The mesh comes through VTK's OpenFOAM reader, which gives coordinates in single precision, loses the types of
the patches and passes over most faults in silence. What it loses is read here from the small dictionaries,
and what it passes over is checked. Fields are read in double precision, without VTK.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from pathlib import Path
from typing import NamedTuple, TypeAlias

import numpy as np

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.lists import points_of
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.boundary import PatchInfo, read_boundary
from foamprb.flow.read.boundary_values import boundary_values
from foamprb.flow.read.case import (
    cell_zones,
    field_path,
    mesh_files,
    mesh_folder,
    notes_of_forms,
    select_time,
    shown,
)
from foamprb.flow.read.caveats import caveat_of_flux, caveats_of_case
from foamprb.flow.read.checks import noted_counts, require_labels, require_numbers, require_volumes
from foamprb.flow.read.field import GRADIENT_FIELD, VELOCITY_FIELD, Field, Kind, read_field
from foamprb.flow.read.mrf import Rotation, rotating_zones, with_rotating_walls
from foamprb.flow.read.patch_shapes import notes_of_types, require_patch_shapes
from foamprb.flow.read.turbulence import read_turbulence
from foamprb.flow.read.vtk_reader import raise_first_error, read_blocks
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.rotating import RotatingFlow, RotatingZone

PRECISION_NOTE = (
    "Coordinates have passed through single precision in VTK's OpenFOAM reader: a relative error of up to "
    "6e-8 of their distance from the origin."
)
ReadField: TypeAlias = Callable[[str, str, Kind], Field]
"""Gives the field of a name, and of a kind, at the time of a name."""


class CaseMesh(NamedTuple):
    """The mesh of a case at a time, and its patches as the case lists them."""

    mesh: Mesh
    patches: tuple[PatchInfo, ...]
    notes: tuple[str, ...] = ()
    """What the user should know."""


def read_case(
    case: Path | str,
    time: float | str = "latestTime",
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    fields: ReadField | None = None,
    turbulent: bool = False,
    rotations: Sequence[Rotation] = (),
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
    fields
        Reads a field, if it does not come from the case's own time directories.
    turbulent
        Whether to read k and ε, or k and ω, as well.
    rotations
        The zones that are seen from their rotors.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent: the case, the time, the field, the mesh or a patch.
    """
    case = Path(case)
    name = select_time(case, time, region)
    read = fields or fields_of_case(case, region)
    field = read(name, velocity, VELOCITY_FIELD)
    whole = read_mesh(case, name, region)
    cells, boundary = velocities(field, whole)
    flux = caveat_of_flux(whole.mesh, whole.patches, cells, boundary, case, case / name / region, velocity)
    zones = mesh_folder(case, name, region)
    rotating: list[RotatingZone] = []
    if rotations:
        rotating = rotating_zones(rotations, cell_zones(zones), whole.mesh.n_cells)
        boundary = with_rotating_walls(boundary, whole.mesh, rotations, rotating)
    given = gradients(read(name, gradient, GRADIENT_FIELD), whole.mesh) if gradient else None
    reconstruct = Reconstruction(whole.mesh)
    u, l = reconstruct(cells, boundary, given)
    folder = case / name / region
    eddies = None
    if turbulent:
        eddies = read_turbulence(partial(read, name), folder, whole.patches, whole.mesh, reconstruct)
    notes = [PRECISION_NOTE, *whole.notes, *notes_of_forms([folder / velocity])]
    if float(name) == 0.0:
        notes.append(f"The flow is that of time {name}, which is usually the initial guess and no solution.")
    notes += caveats_of_case(case, folder, region, turbulent=turbulent, relative=bool(rotations))
    notes += flux
    if rotating:
        notes += [_note_of(zone) for zone in rotating]
        return RotatingFlow(rotating, whole.mesh, u, l, notes, lambda: cell_zones(zones), name, eddies)
    return MeshFlow(whole.mesh, u, l, notes, lambda: cell_zones(zones), name, eddies)


def _note_of(zone: RotatingZone) -> str:
    speed = float(np.linalg.norm(zone.omega))
    return (
        f"The zone {zone.name} of {len(zone.cells)} cells rotates with {speed:g} rad/s: particles in it move "
        "relative to the rotor, with its walls at rest."
    )


def fields_of_case(case: Path, region: str) -> ReadField:
    """Make the function that reads a field from the time directories of a case."""

    def read(time: str, name: str, kind: Kind) -> Field:
        return read_field(field_path(case / time / region, name, kind), kind, case)

    return read


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
    field = fields_of_case(case, region)(name, velocity, VELOCITY_FIELD)
    whole = read_mesh(case, name, region)
    return whole.mesh, *velocities(field, whole), name


def read_mesh(case: Path, time: str, region: str) -> CaseMesh:
    """Read the mesh that a case has at the time of a name.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent.
    """
    folder = mesh_folder(case, time, region)
    patches = read_boundary(folder / "boundary", case)
    noted = noted_counts(folder)
    require_labels(folder, noted)
    files = mesh_files(case, time, region)
    blocks, messages = read_blocks(files, patches=True)
    grid = blocks["internalMesh"]
    for word, found in (("nCells", grid.GetNumberOfCells()), ("nPoints", grid.GetNumberOfPoints())):
        if word in noted and noted[word] != found:
            raise InputError(
                f"{shown(folder / 'owner')}: the header says {word} {noted[word]}, but the mesh that the "
                f"files describe has {found}; the mesh is damaged."
            )
    raise_first_error(folder, messages)
    surfaces = []
    for patch in patches:
        block = blocks.get(patch.name)
        found = 0 if block is None else block.GetNumberOfCells()
        if block is None or found != patch.faces:
            raise InputError(
                f"{shown(folder / 'boundary')}: patch {patch.name} has {patch.faces} faces, but "
                f"{found} could be read."
            )
        surfaces.append(PatchSurface(patch.name, patch.type, block, patch.neighbour, patch.transform))
    require_numbers(points_of(grid).astype(np.float64, copy=False), files[0], "point")
    mesh = build_mesh(grid, surfaces, source=str(folder))
    require_volumes(mesh, folder)
    require_patch_shapes(mesh, folder)
    return CaseMesh(mesh, patches, (*notes_of_forms(files), *notes_of_types(patches)))


def velocities(field: Field, whole: CaseMesh) -> tuple[Floats, Floats]:
    """Velocity at the cells (n_cells, 3) and at the boundary faces (n_boundary, 3), m/s.

    Raises
    ------
    InputError
        As many values as the mesh has no cells or a patch no faces; one that is not finite; or as
        :func:`~foamprb.flow.read.boundary_values.boundary_values`.
    """
    cells = _at_cells(field, whole.mesh)
    boundary = boundary_values(field, whole.patches, whole.mesh, cells)
    for patch, first in zip(whole.patches, whole.mesh.patch_start, strict=False):
        rows = boundary[first : first + patch.faces]
        require_numbers(rows, field.path, "value", f"on patch {patch.name}, face")
    return cells, boundary


def gradients(field: Field, mesh: Mesh) -> Floats:
    """l_ij = ∂u_i/∂x_j (n_cells, 3, 3), 1/s; OpenFOAM's component 3i + j is ∂u_j/∂x_i.

    Raises
    ------
    InputError
        As many values as the mesh has no cells, or one that is not finite.
    """
    return _at_cells(field, mesh).reshape(-1, 3, 3).transpose(0, 2, 1)


def _at_cells(field: Field, mesh: Mesh) -> Floats:
    if len(field.cells) not in (1, mesh.n_cells):
        raise InputError(
            f"{field.path}: internalField has {len(field.cells)} values, but there are {mesh.n_cells} cells."
        )
    cells = np.ascontiguousarray(np.broadcast_to(field.cells, (mesh.n_cells, field.cells.shape[1])))
    require_numbers(cells, field.path, "value", "at cell")
    return cells
