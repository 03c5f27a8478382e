"""Flow of an OpenFOAM case at one or several of its times."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import cached_property, lru_cache, partial
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.balance import CONSTANT, Mass
from foamprb.flow.base import Caveat, Floats
from foamprb.flow.curvatures import mean_curvatures
from foamprb.flow.deforming import DeformingFlow
from foamprb.flow.fields import FieldColumns
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.boundary import PolyMesh
from foamprb.flow.mesh.mesh import Mesh, assemble, with_points
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.motion import Deformation, Motion, match_walls
from foamprb.flow.moving import MovingFlow
from foamprb.flow.read.boundary import CaseMesh, PatchInfo, read_boundary
from foamprb.flow.read.boundary_values import boundary_values, caveats_of_walls, with_openings, with_walls
from foamprb.flow.read.case import (
    available_times,
    cell_zones,
    field_path,
    fields_of,
    mesh_files,
    mesh_folder,
    regions,
    require_case,
    select_time,
    select_times,
)
from foamprb.flow.read.caveats import (
    MOVING,
    balanced,
    balanced_in_time,
    caveat_of_flux,
    caveats_of_case,
    in_degrees,
    is_unsteady,
    pseudo_time,
    refuse_absolute,
)
from foamprb.flow.read.checks import (
    at_cells,
    caveat_of_order,
    notes_of_types,
    require_numbers,
    require_patch_shapes,
    require_volumes,
)
from foamprb.flow.read.density import density_of, mass_of
from foamprb.flow.read.field import VELOCITY_FIELD, FoamField, Kind, read_field
from foamprb.flow.read.fluid import FRACTION_FIELD
from foamprb.flow.read.foamfile import damage
from foamprb.flow.read.layers import filled
from foamprb.flow.read.motion import (
    DeformsError,
    deformation_of,
    moves_rigidly,
    moving_times,
    nodes_of_moving_walls,
    note_of_deformation,
    notes_of,
    require_points,
    require_uncoupled,
    rigid_motion,
    spin_of_walls,
    with_moving_walls,
)
from foamprb.flow.read.mrf import read_rotations, rotating_zones, with_rotating_walls
from foamprb.flow.read.overlap import reduced
from foamprb.flow.read.polymesh import read_points, read_poly
from foamprb.flow.read.prepared import PreparedTimes
from foamprb.flow.read.refinement import NotPartsError, Resampling, cells_at, finest, same_mesh
from foamprb.flow.read.sampled import kinds_of, read_sampled
from foamprb.flow.read.source import FlowSource
from foamprb.flow.read.times import listed
from foamprb.flow.read.turbulence import read_turbulence
from foamprb.flow.read.viscosity import read_viscosity_field
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.rotating import RotatingFlow, RotatingZone
from foamprb.flow.series import SeriesFlow, series_of
from foamprb.memory import trim

_STEADY = 0.01
"""Change of the velocity, over itself and at the last rate since time 0, below which a flow is steady.

By then the fluid must have crossed the domain.
"""


_FACES = ("start", "points", "owner", "neighbour")
INSTANT = "the flow of an unsteady solver (ddtSchemes) is used as a steady flow, of one instant"


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

    def times(self) -> tuple[str, ...]:
        """Return the names of all times; InputError if there is no case with a mesh."""
        require_case(self.root, self.region)
        return available_times(self.root)

    def select_time(self, time: float | str) -> str:
        """Return the name of a time; see :func:`foamprb.flow.read.case.select_time`."""
        return select_time(self.root, time, self.region)

    def select_times(self, selection: str | None) -> tuple[str, ...]:
        """Return the names of times; see :func:`foamprb.flow.read.case.select_times`."""
        return select_times(self.root, selection, self.region)

    @property
    def roots(self) -> Sequence[Path]:
        """The folders that hold the times."""
        return (self.root,)

    def damaged(self, times: Sequence[str], name: str) -> dict[str, str]:
        """Return the times at which a field is missing, empty or cut off, each with the word."""
        files = ((time, damage(root / time / self.region / name)) for time in times for root in self.roots)
        return {time: fault for time, fault in files if fault}

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
        return cell_zones(mesh_folder(self.root, time, self.region))

    def poly(self, time: str | None) -> tuple[PolyMesh, tuple[PatchInfo, ...], list[str]]:
        """Read points, faces and patches at a time; None for the mesh in ``constant``.

        Returns them, the patches as the case lists them, and notes; raises InputError if they are missing,
        broken or inconsistent.
        """
        files = mesh_files(self.root, time, self.region)
        patches = read_boundary(files[-1], self.root)
        return read_poly(files, patches), patches, []

    def mesh(self, time: str) -> CaseMesh:
        """Read the mesh at a time; InputError if it is missing, broken or inconsistent."""
        folder = self.mesh_folder(time)
        poly, patches, notes = self.poly(time)
        patches = reduced(patches, poly.used) if poly.used else patches
        mesh = assemble(poly, str(folder))
        require_volumes(mesh, folder)
        require_patch_shapes(mesh, folder)
        return CaseMesh(mesh, patches, (*notes, *notes_of_types(patches)))

    def mesh_folder(self, time: str) -> Path:
        """Return the folder of the mesh at a time."""
        return mesh_folder(self.root, time, self.region)

    def points(self, time: str) -> Floats:
        """Read the points of the mesh at a time, (n_points, 3), m."""
        return read_points(mesh_files(self.root, time, self.region)[0])


def read_case(
    case: PathLike[str] | str,
    time: float | str = "latestTime",
    velocity: str = "U",
    region: str = "",
    turbulent: bool = False,
    curved: bool = False,
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
    turbulent
        Read also k and ε, or k and ω.
    curved
        Reconstruct also the second derivatives of the velocity, for ``FaxenCorrection`` and the quadratic
        mode. Otherwise these are less accurate, and constant in each tetrahedron.

    Raises
    ------
    InputError
        The case, the time, the field, the mesh or a patch is missing, broken or inconsistent.
    """
    source = FlowSource(velocity=velocity, turbulent=turbulent, curved=curved)
    return steady_flow(Case(Path(case), region), time, source)


def read_series(
    case: PathLike[str] | str,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    turbulent: bool = False,
    curved: bool = False,
) -> MeshFlow:
    """Prepare the flow of a case at several times, which are read when needed; one time gives a steady flow.

    Parameters
    ----------
    case, velocity, region, turbulent, curved
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
    source = FlowSource(velocity=velocity, turbulent=turbulent, curved=curved)
    return transient_flow(Case(Path(case), region), times, period, source)


def steady_flow(case: Case, time: float | str, source: FlowSource) -> MeshFlow:
    """Read the flow of a case at one time; see :func:`read_case` and :class:`FlowSource`."""
    name = case.select_time(time)
    refuse_absolute(case.root, case.region, case.folder(name), source.velocity)
    rotations = read_rotations(case.root, case.region) if source.relative else ()
    field = case.field(name, source.velocity, VELOCITY_FIELD)
    whole = case.mesh(name)
    whole = with_walls(whole, field)
    cells, boundary = velocities(field, whole)
    whole = with_openings(whole, field, boundary)
    across = caveats_of_walls(whole, field, boundary)
    read, unsteady = partial(case.field, name), is_unsteady(case.root, case.region)
    flux = caveat_of_flux(whole, cells, boundary, read, source.velocity, unsteady)
    flux += caveat_of_order(whole.mesh, cells)
    rotating: list[RotatingZone] = []
    if rotations:
        rotating = rotating_zones(rotations, case.zones(name), whole.mesh.n_cells)
        boundary = with_rotating_walls(boundary, whole.mesh, rotations, rotating)
    kinds = kinds_of(source.sampled, case.fields, (name,))
    operators = _Operators(whole.mesh)
    more = _further(case, name, source, whole, operators)
    sampled = read_sampled(read, source.sampled, kinds, whole, operators.reconstruct) if kinds else None
    mass = mass_of(case.root, case.region, whole, (name,), [read], 0, source.velocity)
    notes: list[Any] = [*case.notes, *whole.notes, *across]
    file = (case.folder(name) / source.velocity).relative_to(case.root)

    def make() -> tuple[Floats, Floats, Floats | None]:
        u, l = operators.reconstruct(cells, boundary)
        # Its arrays take half as much memory as the flow.
        operators.free()
        trim()
        if not source.balanced:
            return u, l, None
        fluxes = balanced(operators.conserve, u, l, mass, file, notes=notes)
        operators.free()
        return u, l, fluxes

    prepared = PreparedTimes(source.cache, whole.mesh)
    u, l, fluxes = prepared.get((cells, boundary, mass), make)
    if float(name) == 0.0:
        initial = f"the flow is that of time {name}, which is usually the initial guess and no solution"
        uniform = bool((cells == cells[0]).all())
        notes.append(Caveat(f"{initial}; it is uniform. Run the solver first.") if uniform else f"{initial}.")
    caveats = _caveats(case, name, source, relative=bool(rotations))
    if unsteady and all(caveat.fault != MOVING for caveat in caveats):
        caveats += _instant(case, name, source.velocity, cells, whole.mesh)
    notes += caveats
    notes += flux
    trim()
    notes += [
        f"The zone {zone.name} of {len(zone.cells)} cells rotates with "
        f"{np.linalg.norm(zone.omega):g} rad/s: "
        "particles in it move relative to the rotor, with its walls at rest."
        for zone in rotating
    ]
    zones, turbulence = partial(case.zones, name), more[0] if source.turbulent else None
    viscosity = more[-1] if source.viscosity else None
    curvatures = mean_curvatures(whole.mesh, l) if source.curved else None
    parts = whole.mesh, u, l, notes, zones, name, turbulence, fluxes, viscosity, curvatures
    flow = RotatingFlow(rotating, *parts) if rotating else MeshFlow(*parts)
    if sampled is not None:
        flow.field_table, flow.field_columns = flow.widened(sampled[0]), sampled[1]
    return flow


def transient_flow(case: Case, times: str | None, period: float | None, source: FlowSource) -> MeshFlow:
    """Prepare the flow of a case at several times; see :func:`read_series` and :class:`FlowTimes`."""
    if source.relative and read_rotations(case.root, case.region):
        raise InputError(
            f"{case.root}: rotating zones (MRFProperties) are seen from their rotors in steady flows only. "
            "Allowed: solution/transient no, or solution/rotatingZones absolute."
        )
    names, notes = transient_times(case, times, source.velocity)
    if len(names) == 1:
        return steady_flow(case, names[0], source)
    kinds = kinds_of(source.sampled, case.fields, names)
    refuse_absolute(case.root, case.region, case.folder(names[0]), source.velocity)
    base, *others = _times_of_meshes(case, names)
    if others and source.sampled:
        raise InputError(
            f"{case.root}: the faces of the mesh change, but fields of the case ({' '.join(source.sampled)}) "
            "are read on one mesh only. Allowed: no fieldSampling, and no force that reads them."
        )
    field = case.field(base, source.velocity, VELOCITY_FIELD)
    whole = case.mesh(base)
    # A flow that starts from rest does not show its openings.
    if others:
        whole = _with_kinds(case, names[len(names) // 2], whole, source.velocity)
    elif with_walls(whole, field) is not whole:
        whole = with_walls(whole, field, case.field(names[len(names) // 2], source.velocity, VELOCITY_FIELD))
    first = velocities(field, whole)
    if not others:
        last = case.field(names[-1], source.velocity, VELOCITY_FIELD)
        at_end = velocities(last, whole)[1]
        whole = with_openings(whole, last, at_end)
    read_first, unsteady = partial(case.field, base), is_unsteady(case.root, case.region)
    flux = caveat_of_flux(whole, *first, read_first, source.velocity, unsteady)
    flux += caveat_of_order(whole.mesh, first[0])
    layers: Mapping[str, Floats] = {}
    if others:
        try:
            whole = _with_finest_cells(case, whole, base, others)
        except NotPartsError:
            layers = _filling(case, names, base, whole)
    motion: Motion | Deformation | None = None
    if layers or not others:
        motion = _motion(case, names, whole, period, source, layers)
    means: dict[int, Floats] = {}
    shapes: dict[int, Floats] = {}
    rigid = motion if isinstance(motion, Motion) else None
    local = None if rigid is None else rigid.of_frames()
    # Patches that slide along each other are coupled anew at each time.
    joined = rigid is not None and rigid.joins(whole.mesh)
    slides = joined or (isinstance(motion, Deformation) and len(motion.sliding) > 0)
    surfaces = case.poly(base)[0].patches if slides else ()
    if layers:
        whole = whole._replace(mesh=with_points(whole.mesh, layers[names[0]]))
    operators = _Operators(whole.mesh)
    prepared = PreparedTimes(source.cache, whole.mesh)
    # In the frames of pieces fields do not continue from one to another.
    framed = whole.mesh if rigid is None else replace(whole.mesh, couplings=rigid.within(whole.mesh))

    def sampled(name: str) -> tuple[Floats, tuple[FieldColumns, ...]]:
        return read_sampled(partial(case.field, name), source.sampled, kinds, whole, operators.reconstruct)

    fastest = 0.0 if motion is None else motion.fastest(whole.mesh)

    def mesh_at(index: int) -> Mesh:
        if rigid is not None and not joined:
            return rigid.moved(index, whole.mesh)
        points = layers[names[index]] if layers else _points_at(case, names[index], whole.mesh)
        return with_points(whole.mesh, points, surfaces, str(case.mesh_folder(names[index])))

    deformed = lru_cache(maxsize=10)(mesh_at)

    def given_at(index: int, here: CaseMesh) -> tuple[CaseMesh, Resampling | None]:
        """Return the mesh of a time, on which its fields are given, and their way to another one."""
        given, where = _mesh_of(case, names[index], whole), f"{case.root}, mesh at {names[index]} s"
        same = same_mesh(given.mesh, here.mesh)
        return given, None if same else Resampling(here.mesh, given.mesh, where)

    @lru_cache(maxsize=4)
    def density_at(index: int) -> tuple[Floats, Floats] | None:
        here = whole if motion is None else whole._replace(mesh=deformed(index))
        given, to = given_at(index, here)
        values = density_of(case.root, case.region, partial(case.field, names[index]), given)
        if values is None or to is None:
            return values
        at_nodes = _Operators(given.mesh).reconstruct.linear(*values)
        # Beside a front a linear continuation exceeds the range.
        ends = np.sort(np.concatenate(values))[[0, -1]]
        rho = to(at_nodes[:, None])[:, 0].clip(*ends)
        start = here.mesh.face_start[here.mesh.n_internal :]
        sums = np.add.reduceat(rho[here.mesh.face_points[start[0] :]], start[:-1] - start[0])
        return rho[here.mesh.n_points :], sums / np.diff(start)

    def read(name: str) -> tuple[Any, ...]:
        reads = [partial(case.field, name) for name in names]
        here, own, index = whole, operators, names.index(name)
        rates: Floats | None = None
        if motion is not None:
            here = whole._replace(mesh=(deformed if rigid is None else mesh_at)(index))
            own = operators if rigid is not None and not joined else _Operators(here.mesh, operators)
        given, to = given_at(index, here) if others else (here, None)
        at = own if to is None else _Operators(given.mesh)
        # Without sliding patches fields are read in the frames of the pieces, on the mesh of the first time.
        of_frame = rigid if joined else local
        field = case.field(name, source.velocity, VELOCITY_FIELD)
        values = velocities(field, given)
        densities = density_at if others else None
        mass = mass_of(case.root, case.region, here, names, reads, index, source.velocity, densities)
        where = (case.folder(name) / source.velocity).relative_to(case.root)

        def make() -> tuple[Floats, Floats, Floats]:
            u, l = at.reconstruct(*values)
            u, l = (u, l) if to is None else to.velocities(u, l)
            frame = None if of_frame is None else of_frame.frame(index, own.mesh)
            # Means of the values of the faces around are not quite those of the wall.
            if frame is not None:
                nodes = nodes_of_moving_walls(here, field)
                u[nodes] = frame[0][nodes]
            there = mass
            if rates is not None:
                there = _at_fixed_places(mass, own, rates)
                match_walls(here.mesh, u, rates.copy())
            fluxes = balanced_in_time(own.conserve, u, l, there, where, frame, fastest, accept=source.accept)
            if frame is not None:
                u, l = u - frame[0], l - frame[1]
            return (*(rigid.in_frames(index, here.mesh, u, l) if rigid and joined else (u, l)), fluxes)

        key: tuple[Any, ...] = (*values, mass)
        if others:
            key = *key, given.mesh.points, given.mesh.face_points
        if isinstance(motion, Deformation):
            rates = motion.rates(index, lambda k: deformed(k).nodes)
            key = *key, here.mesh.points, rates
        elif rigid is not None:
            values = values[0], with_moving_walls(rigid, index, here, field, values[1])
            means[index] = rigid.means(here.mesh, values[0])
            if not joined:
                pieces = rigid.piece, rigid.piece[here.mesh.owner[here.mesh.n_internal :]]
                cells, boundary = (rigid.turned(index, *of) for of in zip(values, pieces, strict=True))
                values = cells, boundary
            pose = (array[index] for array in (rigid.Q, rigid.y, rigid.omega, rigid.velocity))
            key = (*values, mass, here.mesh.points, *pose)
        u, l, fluxes = prepared.get(key, make)
        if rates is not None:
            match_walls(here.mesh, u, rates)
            shapes[index] = np.concatenate([here.mesh.nodes, rates], axis=1)
        more = _further(case, name, source, given, at)
        more = more if to is None else [to(array) for array in more]
        if rigid is not None and joined:
            for array in more:
                slopes = array[:, -3 * (array.shape[1] // 3) :]
                slopes[:] = rigid.turned(index, slopes, rigid.nodes(here.mesh))
        bent = framed if rates is None else here.mesh
        curvatures = [mean_curvatures(bent, l)] if source.curved else []
        return (u, l, *more, *([sampled(name)[0]] if kinds else []), fluxes, *curvatures)

    notes = [*notes, *case.notes, *whole.notes]
    if motion is None and not others:
        notes += caveats_of_walls(whole, last, at_end)
    notes += _caveats(case, names[-1], source, moving=False)
    if float(names[0]) == 0.0 and not first[0].any():
        notes.append(
            Caveat(
                f"at time {names[0]}, the first of the flow, the fluid is at rest, and until {names[1]} s it "
                "is interpolated. If that is no solution, as where setFlow or setFields made the flow: "
                f"-time {names[1]}:."
            )
        )
    zones: Callable[[], Mapping[str, NDArray[np.int64]]] = partial(case.zones, base)
    notes += flux
    flow: Any = SeriesFlow
    if others:
        cells = f"a mesh of {whole.mesh.n_cells} cells, the finest of all times"
        if layers:
            cells = f"the mesh of {base} s ({whole.mesh.n_cells} cells), which deforms with the boundary"
        else:
            zones = partial(_zones_of_finest, case, base, whole.mesh)
        notes.append(f"The faces of the mesh change in time: fields are read at the nodes of {cells}.")
    if isinstance(motion, Deformation):
        notes.append(note_of_deformation(motion, whole.mesh))
        flow = partial(DeformingFlow, motion, shapes)
    elif motion is not None:
        notes.append(notes_of(motion, float(np.ptp(whole.mesh.points, axis=0).max())))
        flow = partial(MovingFlow, motion, means)
    return series_of(
        case.root, whole.mesh, names, read, period, notes, zones, source.turbulent, conservative=True,
        viscous=source.viscosity is not None, sampled=sampled(names[0])[1] if kinds else (),
        curved=source.curved, flow=flow, course="cubic" if isinstance(motion, Deformation) else "linear",
    )  # fmt: skip


def _with_finest_cells(case: Case, whole: CaseMesh, base: str, others: Sequence[str]) -> CaseMesh:
    """Return a mesh with the finest cells of several times, one of which is ``base``."""
    mesh, change = whole.mesh, sorted((base, *others), key=float)[1]
    for time in others:
        where = f"{case.root}, mesh at {time} s (the faces change at {change} s)"
        mesh = finest(mesh, case.mesh(time).mesh, case.poly(time)[0], where)
    return whole._replace(mesh=replace(mesh, patches=whole.mesh.patches))


def _zones_of_finest(case: Case, base: str, mesh: Mesh) -> Mapping[str, NDArray[np.int64]]:
    """Return the zones of the mesh at a time, ``base``, as cells of one with finer cells."""
    cells = cells_at(case.mesh(base).mesh, mesh.centres)
    return {name: np.flatnonzero(np.isin(cells, zone)) for name, zone in case.zones(base).items()}


def _mesh_of(case: Case, name: str, whole: CaseMesh) -> CaseMesh:
    """Return the mesh of a time, whose patches mean what they mean to another one; InputError for others."""
    here = case.mesh(name)
    if [patch.name for patch in here.patches] != [patch.name for patch in whole.patches]:
        raise InputError(
            f"{case.mesh_folder(name)}: other patches than before. Allowed: the same at all times."
        )
    return here._replace(mesh=replace(here.mesh, patches=whole.mesh.patches))


def _with_kinds(case: Case, name: str, whole: CaseMesh, velocity: str) -> CaseMesh:
    """Return a mesh whose patches are walls and openings by the velocity of a time with another mesh."""
    field, seen = case.field(name, velocity, VELOCITY_FIELD), _mesh_of(case, name, whole)
    seen = with_walls(seen, field)
    seen = with_openings(seen, field, velocities(field, seen)[1])
    return CaseMesh(replace(whole.mesh, patches=seen.mesh.patches), whole.patches, seen.notes)


def _filling(case: Case, names: Sequence[str], base: str, whole: CaseMesh) -> Mapping[str, Floats]:
    """Return the points of the mesh of one time, ``base``, at each time.

    They follow from those at the time before: from time to time cells deform little.
    """
    require_uncoupled(case.root, whole.mesh)
    points = {base: whole.mesh.points}
    for step in (1, -1):
        mesh = whole.mesh
        for name in names[names.index(base) :: step][1:]:
            where = f"{case.root}, mesh at {name} s"
            mesh = filled(mesh, _mesh_of(case, name, whole).mesh, where)
            points[name] = mesh.points
    return points


def _at_fixed_places(mass: Mass | None, operators: _Operators, rates: Floats) -> Mass | None:
    """Return a density whose growth is given in cells that move, by velocities at nodes, at fixed places."""
    if mass is None or mass is CONSTANT:
        return mass
    n = operators.mesh.n_cells
    slopes = operators.reconstruct.scalar(mass.cells, mass.boundary)[-n:, 1:]
    return mass._replace(growth=mass.growth - np.einsum("ci,ci->c", rates[-n:], slopes))


def _points_at(case: Case, time: str, mesh: Mesh) -> Floats:
    """Return the points at a time in the order of a mesh, in which points of baffles may be parted."""
    points = case.points(time)
    return points if len(points) == mesh.n_points else case.mesh(time).mesh.points


def _motion(
    case: Case,
    names: Sequence[str],
    whole: CaseMesh,
    period: float | None,
    source: FlowSource,
    layers: Mapping[str, Floats],
) -> Motion | Deformation | None:
    """Return the motion of the mesh of a case; None if it is at rest.

    ``layers`` are the points of a mesh at all times, if the faces of that of the case change.
    """
    folders = {name: case.folder(name) for name in names[1:]}
    moved = moving_times(folders, "points")
    if not moved:
        return None
    require_points(list(folders), moved, case.root)
    if source.sampled:
        raise InputError(
            f"{case.root}: the mesh moves, but fields of the case ({' '.join(source.sampled)}) are read on "
            "meshes at rest only. Allowed: no fieldSampling, and no force that reads them."
        )
    if layers:
        return deformation_of(case.root, names, layers.__getitem__, whole.mesh, period)

    @lru_cache(maxsize=2)
    def around(index: int) -> tuple[CaseMesh, FoamField, Floats]:
        mesh = with_points(whole.mesh, _points_at(case, names[index], whole.mesh))
        here = whole._replace(mesh=mesh)
        field = case.field(names[index], source.velocity, VELOCITY_FIELD)
        return here, field, velocities(field, here)[1]

    def spin(index: int, cells: NDArray[np.int64]) -> Floats | None:
        return spin_of_walls(*around(index), cells)

    if any(patch.rows is not None for patch in whole.patches):
        raise InputError(
            f"{case.root}: cyclicACMI patches are read on meshes at rest only. Allowed: cyclicAMI."
        )
    named = moves_rigidly(case.root, case.region)
    given = case.root, names, case.points, whole.mesh, case.zones(names[0]), spin, period, named
    try:
        motion = rigid_motion(*given)
    except DeformsError as error:
        if named:
            raise InputError(
                f"{error} Its dynamicMeshDict names rigid motions only. Allowed: points of such a motion."
            ) from None
        read = partial(_points_at, case, mesh=whole.mesh)
        cut = any(not c.matching for c in whole.mesh.couplings)
        surfaces = case.poly(names[0])[0].patches if cut else ()
        return deformation_of(case.root, names, read, whole.mesh, period, surfaces)
    return motion if motion.turns.any() or np.ptp(motion.y, axis=0).any() else None


def transient_times(case: Case, selection: str | None, velocity: str) -> tuple[list[str], list[str]]:
    """Return the times of a transient flow at which the velocity is whole, and notes.

    Raises
    ------
    InputError
        The selection has no times.
    """
    selected, notes = case.select_times(selection), []
    damaged = case.damaged(selected, velocity)
    names = [name for name in selected if name not in damaged] or list(selected)
    if len(names) > 1 and in_degrees(case.root, case.region):
        raise InputError(
            f"{case.root}: the times {names[0]} to {names[-1]} are degrees of an engine's crank (rpm), not "
            "seconds. Allowed: one time, with solution/transient no."
        )
    if damaged:
        kind = Caveat if {*damaged.values()} - {"missing"} else str
        times = listed(f"{name} ({fault})" for name, fault in damaged.items())
        notes.append(kind(f"Times without a whole field {velocity} are left out: {times}."))
    scheme = pseudo_time(case.root, case.region)
    if scheme:
        notes.append(
            Caveat(
                f"the times of the flow are iterations (ddtSchemes {scheme}): solution/transient takes them "
                "for seconds.",
                "pseudoTime",
            )
        )
    return names, notes


def _times_of_meshes(case: Case, names: Sequence[str]) -> list[str]:
    """Return times between which the faces of the mesh change, that with the most cells first.

    Solvers that may change faces write them at each time, changed or not.
    """
    written = moving_times({name: case.folder(name) for name in names[1:]}, "faces")
    before, times = case.poly(names[0])[0].faces if written else None, [names[0]]
    counts = [0 if before is None else len(before.first)]
    for name in written:
        now = case.poly(name)[0].faces
        if any(not np.array_equal(getattr(before, of), getattr(now, of)) for of in _FACES):
            times.append(name)
            counts.append(len(now.first))
        before = now
    largest = int(np.argmax(counts))
    return [times.pop(largest), *times]


class _Operators:
    """Operators of a mesh, made when they are first used; ``first`` are those with other points."""

    def __init__(self, mesh: Mesh, first: _Operators | None = None) -> None:
        self.mesh, self._first = mesh, first

    @cached_property
    def reconstruct(self) -> Reconstruction:
        return Reconstruction(self.mesh)

    @cached_property
    def conserve(self) -> Conservation:
        if self._first is None or self.mesh.couplings:
            return Conservation(self.mesh)
        return self._first.conserve.at(self.mesh)

    def free(self) -> None:
        """Free the operators; others are made if they are used again."""
        for name in ("reconstruct", "conserve"):
            vars(self).pop(name, None)


def _further(case: Case, time: str, source: FlowSource, whole: CaseMesh, operators: _Operators) -> list[Any]:
    """Return turbulence and viscosity at the nodes, as the source requests."""
    read, arrays = partial(case.field, time), []
    if source.turbulent:
        arrays.append(read_turbulence(read, case.folder(time), whole, operators.reconstruct))
    if source.viscosity:
        arrays.append(read_viscosity_field(read, source.viscosity, whole, operators.reconstruct))
    return arrays


def _caveats(case: Case, time: str, source: FlowSource, **options: bool) -> list[Caveat]:
    read = partial(case.field, time)
    mixed = source.viscosity is not None and source.viscosity.kind == FRACTION_FIELD
    options |= {"turbulent": source.turbulent, "mixed": mixed}
    return caveats_of_case(case.root, case.region, case.folder(time), read, **options)


def _instant(case: Case, name: str, velocity: str, cells: Floats, mesh: Mesh) -> list[Caveat]:
    """Return a warning that an unsteady flow stands still, unless it has become steady."""
    text = INSTANT
    earlier = [time for time in case.times() if 0.0 < float(time) < float(name)]
    with suppress(InputError):
        if earlier and case.mesh_folder(earlier[-1]) == case.mesh_folder(name):
            changes = cells - at_cells(case.field(earlier[-1], velocity, VELOCITY_FIELD), mesh)
            change, speed = (_mean_square(v) ** 0.5 for v in (changes, cells))
            length = float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
            crossed, change = speed * float(name) > length, change / max(speed, 1e-300)
            if crossed and change * float(name) < _STEADY * (float(name) - float(earlier[-1])):
                return []
            text += f": its velocity changed by {100.0 * change:.3g} % since {earlier[-1]} s"
            return [Caveat(f"{text}; set transient true to follow all times.")]
    return [Caveat(f"{text}, which is right if it is steady by then.")]


def _mean_square(vectors: Floats) -> float:
    """Return the mean of the squares of vectors at the cells."""
    return float(np.einsum("ci,ci->c", vectors, vectors).mean())


def velocities(field: FoamField, whole: CaseMesh) -> tuple[Floats, Floats]:
    """Return the velocity at the cells (n_cells, 3) and at the boundary faces (n_boundary, 3), m/s."""
    cells = at_cells(field, whole.mesh)
    boundary = boundary_values(field, whole.patches, whole.mesh, cells)
    for patch, first in zip(whole.patches, whole.mesh.patch_start, strict=False):
        rows = boundary[first : first + patch.faces]
        require_numbers(rows, field.path, "value", f"on patch {patch.name}, face")
    return cells, boundary
