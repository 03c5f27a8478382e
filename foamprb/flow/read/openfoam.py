"""Flow of an OpenFOAM case at one or several of its times.

The mesh is read by VTK's OpenFOAM reader, which gives coordinates in single precision, drops the types of the
patches and ignores most faults. The types are read here from the dictionaries, and the faults are checked.
Fields are read in double precision, without VTK.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from functools import partial
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from foamprb.dictionary.files import existing
from foamprb.errors import InputError
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.mesh.boundary import PatchSurface
from foamprb.flow.mesh.lists import points_of
from foamprb.flow.mesh.mesh import Mesh, build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.read.boundary import CaseMesh, read_boundary
from foamprb.flow.read.boundary_values import boundary_values
from foamprb.flow.read.case import (
    cell_zones,
    field_path,
    fields_of,
    mesh_files,
    mesh_folder,
    notes_of_forms,
    regions,
    select_time,
    select_times,
    shown,
)
from foamprb.flow.read.caveats import caveat_of_flux, caveats_of_case
from foamprb.flow.read.checks import (
    at_cells,
    noted_counts,
    notes_of_types,
    require_labels,
    require_numbers,
    require_patch_shapes,
    require_volumes,
)
from foamprb.flow.read.field import GRADIENT_FIELD, VELOCITY_FIELD, FoamField, Kind, read_field
from foamprb.flow.read.mrf import read_rotations, rotating_zones, with_rotating_walls
from foamprb.flow.read.source import FlowSource
from foamprb.flow.read.turbulence import read_turbulence
from foamprb.flow.read.vtk_reader import raise_first_error, read_blocks
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.rotating import RotatingFlow, RotatingZone
from foamprb.flow.series import series_of

PRECISION_NOTE = (
    "Coordinates have passed through single precision in VTK's OpenFOAM reader: a relative error of up to "
    "6e-8 of their distance from the origin."
)


class Case:
    """Case whose mesh and fields lie in its own time directories.

    Parameters
    ----------
    root
        The case's folder.
    region
        Region of the mesh, if the case has several.
    """

    notes: tuple[str, ...] = ()

    def __init__(self, root: Path, region: str = "") -> None:
        self.root, self.region = root, region
        self.mesh_root = root
        """Folder of the case that holds the mesh."""

    @contextmanager
    def messages(self) -> Iterator[None]:
        """Let errors name the case, not the folder that holds the mesh."""
        try:
            yield
        except InputError as error:
            if self.mesh_root == self.root:
                raise
            raise InputError(str(error).replace(str(self.mesh_root), str(self.root))) from None

    def select_time(self, time: float | str) -> str:
        """Return the name of a time; see :func:`foamprb.flow.read.case.select_time`."""
        return select_time(self.mesh_root, time, self.region)

    def select_times(self, selection: str | None) -> tuple[str, ...]:
        """Return the names of times; see :func:`foamprb.flow.read.case.select_times`."""
        return select_times(self.mesh_root, selection, self.region)

    def folder(self, time: str) -> Path:
        """Return the folder of the fields at a time."""
        return self.root / time / self.region

    def regions(self) -> tuple[str, ...]:
        """Return the names of all regions."""
        return regions(self.root)

    def fields(self, time: str) -> dict[str, str]:
        """Return the classes of the fields at a time by name."""
        return fields_of(self.folder(time))

    def field(self, time: str, name: str, kind: Kind) -> FoamField:
        """Read a field at a time; InputError if it is missing, broken or of another kind."""
        return read_field(field_path(self.folder(time), name, kind), kind, self.root)

    def zones(self, time: str) -> Mapping[str, NDArray[np.int64]]:
        """Read the cells of each zone by name; InputError if the file is broken."""
        return cell_zones(mesh_folder(self.mesh_root, time, self.region))

    def mesh(self, time: str) -> CaseMesh:
        """Read the mesh at a time; InputError if it is missing, broken or inconsistent."""
        return read_mesh(self.mesh_root, time, self.region)


def read_case(
    case: Path | str,
    time: float | str = "latestTime",
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    turbulent: bool = False,
) -> MeshFlow:
    """Read mesh, patches and velocity of a case at one time, and reconstruct the flow.

    Parameters
    ----------
    case
        The case's folder.
    time
        Value of a time, or ``latestTime``.
    velocity
        Name of the velocity field, a ``volVectorField`` in m/s.
    region
        Region of the mesh, if the case has several.
    gradient
        Name of the velocity's gradient at the cells, a ``volTensorField`` in 1/s such as ``grad(U)``; empty
        to reconstruct it from the velocity.
    turbulent
        Read also k and ε, or k and ω.

    Raises
    ------
    InputError
        The case, the time, the field, the mesh or a patch is missing, broken or inconsistent.
    """
    source = FlowSource(velocity=velocity, gradient=gradient, turbulent=turbulent)
    return steady_flow(Case(Path(case), region), time, source)


def read_series(
    case: Path | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
    turbulent: bool = False,
) -> MeshFlow:
    """Prepare the flow of a case at several times, which are read when needed; one time gives a steady flow.

    Parameters
    ----------
    case, velocity, region, gradient, turbulent
        See :func:`read_case`.
    times
        See :func:`~foamprb.flow.read.times.choose_times`.
    period
        Duration after which the flow repeats itself, s.

    Raises
    ------
    InputError
        See :func:`read_case`; or the mesh moves, or the times do not fill the period.
    """
    source = FlowSource(velocity=velocity, gradient=gradient, turbulent=turbulent)
    return transient_flow(Case(Path(case), region), times, period, source)


def steady_flow(case: Case, time: float | str, source: FlowSource) -> MeshFlow:
    """Read the flow of a case at one time; see :func:`read_case` and :class:`FlowSource`."""
    with case.messages():
        name = case.select_time(time)
        rotations = read_rotations(case.root, case.region) if source.relative else ()
        field = case.field(name, source.velocity, VELOCITY_FIELD)
        whole = case.mesh(name)
        cells, boundary = velocities(field, whole)
        flux = caveat_of_flux(whole, cells, boundary, partial(case.field, name), source.velocity)
        rotating: list[RotatingZone] = []
        if rotations:
            rotating = rotating_zones(rotations, case.zones(name), whole.mesh.n_cells)
            boundary = with_rotating_walls(boundary, whole.mesh, rotations, rotating)
        at_nodes = _at_nodes(case, name, source, whole, Reconstruction(whole.mesh), cells, boundary)
    notes = [*case.notes, PRECISION_NOTE, *whole.notes]
    notes += notes_of_forms([case.folder(name) / source.velocity])
    if float(name) == 0.0:
        notes.append(f"The flow is that of time {name}, which is usually the initial guess and no solution.")
    notes += _caveats(case, name, turbulent=source.turbulent, relative=bool(rotations))
    notes += flux
    notes += [
        f"The zone {zone.name} of {len(zone.cells)} cells rotates with {np.linalg.norm(zone.omega):g} rad/s: "
        "particles in it move relative to the rotor, with its walls at rest."
        for zone in rotating
    ]
    u, l = at_nodes[:2]
    zones, turbulence = partial(case.zones, name), at_nodes[2] if source.turbulent else None
    if rotating:
        return RotatingFlow(rotating, whole.mesh, u, l, notes, zones, name, turbulence)
    return MeshFlow(whole.mesh, u, l, notes, zones, name, turbulence)


def transient_flow(case: Case, times: str | None, period: float | None, source: FlowSource) -> MeshFlow:
    """Prepare the flow of a case at several times; see :func:`read_series`."""
    with case.messages():
        names = case.select_times(times)
        if len(names) == 1:
            return steady_flow(case, names[0], source)
        _refuse_moving(case, names)
        whole = case.mesh(names[0])
        first = velocities(case.field(names[0], source.velocity, VELOCITY_FIELD), whole)
        flux = caveat_of_flux(whole, *first, partial(case.field, names[0]), source.velocity)
    reconstruct = Reconstruction(whole.mesh)

    def read(name: str) -> tuple[Floats, ...]:
        with case.messages():
            values = velocities(case.field(name, source.velocity, VELOCITY_FIELD), whole)
            return _at_nodes(case, name, source, whole, reconstruct, *values)

    notes = [*case.notes, PRECISION_NOTE, *whole.notes]
    notes += notes_of_forms(case.folder(name) / source.velocity for name in names)[:1]
    notes += _caveats(case, names[-1], moving=False, turbulent=source.turbulent)
    zones = partial(case.zones, names[0])
    return series_of(case.root, whole.mesh, names, read, period, [*notes, *flux], zones, source.turbulent)


def _at_nodes(
    case: Case,
    time: str,
    source: FlowSource,
    whole: CaseMesh,
    reconstruct: Reconstruction,
    cells: Floats,
    boundary: Floats,
) -> tuple[Floats, ...]:
    """Return u and l at the nodes, and the turbulence if the source requests it."""
    given = None
    if source.gradient:
        given = gradients(case.field(time, source.gradient, GRADIENT_FIELD), whole.mesh)
    u, l = reconstruct(cells, boundary, given)
    if not source.turbulent:
        return u, l
    return u, l, read_turbulence(partial(case.field, time), case.folder(time), whole, reconstruct)


def _caveats(case: Case, time: str, **options: bool) -> list[Caveat]:
    return caveats_of_case(case.root, case.region, case.folder(time), partial(case.field, time), **options)


def _refuse_moving(case: Case, names: tuple[str, ...]) -> None:
    for name in names[1:]:
        for part in ("points", "faces"):
            path = existing(case.folder(name) / "polyMesh" / part)
            if path is not None:
                raise InputError(f"{path}: the mesh changes in time; only meshes at rest can be read.")


def read_fields(
    case: Path, time: float | str = "latestTime", velocity: str = "U", region: str = ""
) -> tuple[Mesh, Floats, Floats, str]:
    """Read the mesh with the velocity at its cells (n_cells, 3) and boundary faces (n_boundary, 3), m/s.

    Returns
    -------
    mesh, cells, boundary, name
        Boundary faces of patches without values carry zeros; ``name`` is the time directory's.

    Raises
    ------
    InputError
        See :func:`read_case`.
    """
    opened = Case(case, region)
    name = opened.select_time(time)
    whole = opened.mesh(name)
    return whole.mesh, *velocities(opened.field(name, velocity, VELOCITY_FIELD), whole), name


def read_mesh(case: Path, time: str, region: str) -> CaseMesh:
    """Read the mesh of a case at a time; InputError if it is missing, broken or inconsistent."""
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


def velocities(field: FoamField, whole: CaseMesh) -> tuple[Floats, Floats]:
    """Return the velocity at the cells (n_cells, 3) and at the boundary faces (n_boundary, 3), m/s.

    Raises
    ------
    InputError
        The counts of values and of cells or faces differ; a value is not finite; or see
        :func:`~foamprb.flow.read.boundary_values.boundary_values`.
    """
    cells = at_cells(field, whole.mesh)
    boundary = boundary_values(field, whole.patches, whole.mesh, cells)
    for patch, first in zip(whole.patches, whole.mesh.patch_start, strict=False):
        rows = boundary[first : first + patch.faces]
        require_numbers(rows, field.path, "value", f"on patch {patch.name}, face")
    return cells, boundary


def gradients(field: FoamField, mesh: Mesh) -> Floats:
    """Return l_ij = ∂u_i/∂x_j (n_cells, 3, 3), 1/s; OpenFOAM's component 3i + j is ∂u_j/∂x_i.

    Raises
    ------
    InputError
        The counts of values and of cells differ, or a value is not finite.
    """
    return at_cells(field, mesh).reshape(-1, 3, 3).transpose(0, 2, 1)
