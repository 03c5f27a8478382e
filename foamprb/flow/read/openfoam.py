"""An OpenFOAM case: its times, fields and patches, and the flow at one of its times.

Mesh and fields come through VTK's OpenFOAM reader, which gives single precision, loses the types of the
patches and passes over most faults in silence. What it loses is read here from the small dictionaries, and
what it passes over is checked.
"""

from __future__ import annotations

import logging
import re
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
import pyvista
from numpy.typing import NDArray
from vtkmodules.vtkCommonCore import vtkLogger, vtkOutputWindow, vtkStringOutputWindow
from vtkmodules.vtkIOGeometry import vtkOpenFOAMReader

from foamprb.errors import InputError, suggestion
from foamprb.flow.mesh.mesh import CELL_KINDS, Floats, Mesh, PatchSurface, build_mesh
from foamprb.flow.read.foamfile import (
    PatchInfo,
    existing,
    header,
    read_boundary,
    read_bytes,
    read_cell_zones,
    read_faces,
    read_labels,
    require_lists,
    require_room,
)
from foamprb.flow.reconstruct import VALUELESS, Reconstruction
from foamprb.flow.walk import MeshFlow

__all__ = [
    "PRECISION_NOTE",
    "CaseInfo",
    "TimeInfo",
    "VelocityReader",
    "available_times",
    "describe",
    "listed",
    "pick_time",
    "read_case",
    "regions",
    "require_choice",
    "require_numbers",
    "require_region",
    "require_volumes",
    "select_time",
    "spoken",
]

_TIME_NAME = re.compile(r"\d+(\.\d*)?([eE][-+]?\d+)?")
LARGEST = 1e30
"""Larger numbers, in m or m/s, are none: products of a few of them must stay finite."""
_SPOKEN = re.compile(
    r"^(ERROR|Warning|Generic Warning): In .*?, line \d+\n(?:\S+ \(0x[0-9a-f]+\): )?(.*)", re.MULTILINE
)
_MOST_SPOKEN = 100
PRECISION_NOTE = (
    "Coordinates and velocities have passed through single precision in VTK's OpenFOAM reader: a relative "
    "error of up to 6e-8 each, the coordinates' relative to their distance from the origin."
)


class TimeInfo(NamedTuple):
    """A time directory: its name as OpenFOAM wrote it, and its fields by name with their classes."""

    name: str
    fields: dict[str, str]


@dataclass(frozen=True)
class CaseInfo:
    """What a case holds."""

    case: Path
    times: tuple[TimeInfo, ...]
    patches: tuple[PatchInfo, ...]
    points: int
    cells: dict[str, int]
    """Number of cells of each kind."""
    bounds: tuple[Floats, Floats]
    """Lowest and highest coordinates, m."""
    region: str = ""
    """The region that this is about."""
    regions: tuple[str, ...] = ()
    """All regions."""

    def lines(self) -> list[str]:
        """The same for a person to read."""
        low, high = ("({:g} {:g} {:g})".format(*corner) for corner in self.bounds)
        return [
            f"Case    {self.case}",
            *([f"Region  {self.region}"] if self.region else []),
            *([f"Regions {', '.join(self.regions)}"] if self.regions else []),
            "",
            "Mesh",
            f"    {'points':20s} {self.points:10d}",
            *(f"    {kind:20s} {n:10d}" for kind, n in self.cells.items()),
            f"    {'bounds [m]':20s} {low} {high}",
            "",
            "Patches",
            *(f"    {patch.name:20s} {patch.faces:10d} faces  {patch.type}" for patch in self.patches),
            "",
            "Times and fields",
            *(
                f"    {time.name:20s} " + ", ".join(f"{name} ({kind})" for name, kind in time.fields.items())
                for time in self.times
            ),
        ]


def available_times(case: Path) -> tuple[str, ...]:
    """Names of the time directories, as OpenFOAM wrote them, in the order of time."""
    names = [path.name for path in case.iterdir() if path.is_dir() and _TIME_NAME.fullmatch(path.name)]
    return tuple(sorted(names, key=float))


def regions(case: Path) -> tuple[str, ...]:
    """Names of the regions of a case whose mesh is divided into regions; none for a case of one mesh."""
    return tuple(sorted(path.parents[1].name for path in case.glob("constant/*/polyMesh/faces*")))


def select_time(case: Path, time: float | str = "latestTime", region: str = "") -> str:
    """Name of the time directory that ``time`` means: ``latestTime``, or a value.

    Raises
    ------
    InputError
        The case has no such time; the message lists those that it has.
    """
    _require_case(case, region)
    names = available_times(case)
    if not names:
        split = " Only decomposed times are there: run reconstructPar." if _is_decomposed(case) else ""
        raise InputError(f"{case}: no time directories; has the solver been run?{split}")
    return names[pick_time(case, names, time)]


def pick_time(source: Path, names: Sequence[str], time: float | str) -> int:
    """Position of a time among the names of times, in their order.

    Raises
    ------
    InputError
        There is no such time; the message lists those that there are.
    """
    if time == "latestTime":
        return len(names) - 1
    try:
        value = float(time)
    except ValueError:
        raise InputError(
            f"{source}: time '{time}' is neither a number nor latestTime; the times are {listed(names)}."
        ) from None
    for position, name in enumerate(names):
        if abs(float(name) - value) <= 1e-9 * max(abs(value), 1e-30):
            return position
    raise InputError(f"{source}: no time {time}; the times are {listed(names)}.")


def describe(case: Path, region: str = "") -> CaseInfo:
    """Tell what a case, or a region of it, holds, without reading a field.

    Raises
    ------
    InputError
        The folder is no case, or its mesh cannot be read.
    """
    _require_case(case, region)
    names = available_times(case)
    times = tuple(TimeInfo(name, _fields(case / name / region)) for name in names)
    folder = _mesh_folder(case, names[-1] if names else None, region)
    patches = read_boundary(folder / "boundary", case)
    _require_labels(folder, _noted_counts(folder))
    blocks, said = _read_blocks(case, names[-1] if names else None, (), region, patches=False)
    _raise_spoken(case, said)
    grid = blocks["internalMesh"]
    kinds = np.bincount(np.asarray(grid.celltypes), minlength=256)
    cells = {
        CELL_KINDS.get(number, f"VTK type {number}"): int(kinds[number])
        for number in np.flatnonzero(kinds).tolist()
    }
    points = np.asarray(grid.points, dtype=np.float64)
    bounds = (points.min(axis=0), points.max(axis=0))
    return CaseInfo(case, times, patches, len(points), cells, bounds, region, regions(case))


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
    return MeshFlow(mesh, u, l, notes, zones=lambda: _read_cell_zones(_mesh_folder(Path(case), name, region)))


def _read_gradient(case: Path, time: str, field: str, region: str) -> Floats:
    """A gradient (n_cells, 3, 3), l_ij = ∂u_i/∂x_j, 1/s."""
    path = _gradient_path(case / time / region, field)
    blocks, said = _read_blocks(case, time, (field,), region, patches=False)
    _raise_spoken(case, said)
    return _gradients(blocks, field, path)


def _gradient_path(folder: Path, field: str) -> Path:
    return _field_path(folder, field, "volTensorField", "the gradient of a velocity")


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
    path = _field_path(case / name / region, velocity)
    folder = _mesh_folder(case, name, region)
    patches = read_boundary(folder / "boundary", case)
    noted = _noted_counts(folder)
    _require_labels(folder, noted)
    blocks, said = _read_blocks(case, name, (velocity,), region, patches=True)
    grid = blocks["internalMesh"]
    for word, found in (("nCells", grid.n_cells), ("nPoints", grid.n_points)):
        if word in noted and noted[word] != found:
            raise InputError(
                f"{_shown(folder / 'owner')}: the header says {word} {noted[word]}, but the mesh that the "
                f"files describe has {found}; the mesh is damaged."
            )
    _raise_spoken(case, said)
    surfaces = []
    for patch in patches:
        block = blocks.get(patch.name)
        if block is None or block.n_cells != patch.faces:
            raise InputError(
                f"{_shown(folder / 'boundary')}: patch {patch.name} has {patch.faces} faces, but "
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
        self._folder = _mesh_folder(case, time, region)
        self._patches = read_boundary(self._folder / "boundary", case)
        with spoken():
            self._reader = _open(case, (velocity, gradient), region, patches=True)

    def __call__(self, time: str) -> tuple[Floats, Floats, Floats | None]:
        """Velocity at the cells (n_cells, 3) and boundary faces (n_boundary, 3), m/s, and the given gradient.

        Raises
        ------
        InputError
            A field is missing, broken or not of the mesh's size.
        """
        folder = self._case / time / self._region
        path = _field_path(folder, self._velocity)
        given = _gradient_path(folder, self._gradient) if self._gradient else None
        with spoken() as said:
            blocks = _update(self._reader, time)
        _raise_spoken(self._case, said)
        cells, boundary = _velocities(blocks, self._patches, self._velocity, path)
        l = None if given is None else _gradients(blocks, self._gradient, given)
        return cells, boundary, l

    def zones(self) -> Mapping[str, NDArray[np.int64]]:
        """The cells of each zone, by name; InputError if they cannot be read."""
        return _read_cell_zones(self._folder)


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


def require_numbers(values: Floats, source: Path, what: str) -> None:
    """Refuse rows that are not finite, or larger than any length or velocity.

    Raises
    ------
    InputError
        How many of them, and the first.
    """
    bad = np.flatnonzero(~(np.abs(values) <= LARGEST).all(axis=1))
    if len(bad):
        raise InputError(
            f"{source}: {len(bad)} of {len(values)} {what} are not finite numbers below {LARGEST:g}; the "
            f"first is number {bad[0]}."
        )


def require_volumes(mesh: Mesh, source: Path) -> None:
    """Refuse a mesh that cannot be one.

    Raises
    ------
    InputError
        Cells have no volume or are inside out.
    """
    flat = np.flatnonzero(~(mesh.volumes > 0.0))
    if len(flat):
        x = "({:g} {:g} {:g})".format(*mesh.centres[flat[0]])
        raise InputError(
            f"{source}: {len(flat)} of {mesh.n_cells} cells have no positive volume; the first is cell "
            f"{flat[0]} at {x}. Is the mesh damaged? (checkMesh tells)"
        )


class Spoken(NamedTuple):
    """What VTK said, each message once."""

    errors: list[str]
    warnings: list[str]


class _Records(logging.Handler):
    """Keeps the errors in the log."""

    def __init__(self, errors: list[str]) -> None:
        super().__init__(logging.ERROR)
        self._errors = errors

    def emit(self, record: logging.LogRecord) -> None:
        self._errors.append(" ".join(record.getMessage().split()))


@contextmanager
def spoken() -> Iterator[Spoken]:
    """Collect what VTK would print: lists that are filled when the block ends."""
    said = Spoken([], [])
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    # Of some of its errors pyvista makes records of the log.
    records = _Records(said.errors)
    logging.getLogger().addHandler(records)
    try:
        yield said
    finally:
        logging.getLogger().removeHandler(records)
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
        vtkOutputWindow.SetInstance(before)
        text: Any = window.GetOutput()
        if isinstance(text, bytes):
            # So when a broken file's contents are quoted.
            text = text.decode("utf-8", "replace")
        for kind, message in _SPOKEN.findall(text):
            message = " ".join(message.split())
            # Of a file cut short VTK's old reader only warns.
            fatal = kind == "ERROR" or (kind == "Generic Warning" and message.startswith("Error"))
            messages = said.errors if fatal else said.warnings
            if message not in messages and len(messages) < _MOST_SPOKEN:
                messages.append(message)


def _read_blocks(
    case: Path, time: str | None, fields: Sequence[str], region: str, *, patches: bool
) -> tuple[dict[str, Any], Spoken]:
    """The reader's blocks by name, ``internalMesh`` and the patches; and what VTK said."""
    with spoken() as said:
        blocks = _update(_open(case, fields, region, patches=patches), time)
    grid = blocks.get("internalMesh")
    if grid is None or grid.n_cells == 0:
        _raise_spoken(case, said)
        raise InputError(
            f"{case / 'constant' / region / 'polyMesh'}: no mesh could be read; a file is missing, broken or "
            "cut short."
        )
    return blocks, said


def _open(case: Path, fields: Sequence[str], region: str, *, patches: bool) -> Any:
    """VTK's reader of the mesh, of some fields, and of the patches."""
    reader = vtkOpenFOAMReader()
    # The name only tells the folder; the file need not be there.
    reader.SetFileName(str(case.resolve() / "case.foam"))
    reader.SetCreateCellToPoint(False)
    reader.SetSkipZeroTime(False)
    reader.SetReadZones(False)
    reader.UpdateInformation()
    reader.DisableAllCellArrays()
    reader.DisableAllPointArrays()
    reader.DisableAllLagrangianArrays()
    for field in fields:
        reader.SetCellArrayStatus(field, 1)
    for index in range(reader.GetNumberOfPatchArrays()):
        part = reader.GetPatchArrayName(index)
        of_region = f"/{region}/" if region else ""
        inner = part.removeprefix(of_region)
        wanted = part.startswith(of_region) and (
            inner == "internalMesh" or (patches and inner.startswith("patch/"))
        )
        reader.SetPatchArrayStatus(part, int(wanted))
    return reader


def _update(reader: Any, time: str | None) -> dict[str, Any]:
    """The reader's blocks by name at a time."""
    if time is None:
        reader.Update()
    else:
        reader.UpdateTimeStep(float(time))
    return dict(_leaves(pyvista.wrap(reader.GetOutput())))


def _raise_spoken(case: Path, said: Spoken) -> None:
    """Pass on VTK's first error, which names the cause; those after it follow from it."""
    if said.errors:
        raise InputError(f"{case}: VTK's OpenFOAM reader says: {said.errors[0]}")


def _leaves(block: Any) -> Iterator[tuple[str, Any]]:
    for name, part in zip(block.keys(), block, strict=True):
        if isinstance(part, pyvista.MultiBlock):
            yield from _leaves(part)
        elif part is not None:
            yield name, part


def _values(block: Any, field: str, path: Path, where: str, components: int = 3) -> Floats:
    if field not in block.cell_data:
        raise InputError(f"{path}: no values could be read for {where}; the file is broken or cut short.")
    values = np.asarray(block.cell_data[field], dtype=np.float64)
    shape = (block.n_cells, components)
    if values.shape != shape:
        raise InputError(f"{path}: {where} have values of shape {values.shape}, not {shape}.")
    require_numbers(values, path, f"values of {where}")
    return values


def _require_case(case: Path, region: str) -> None:
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    names = regions(case)
    require_region(case, region, names)
    if existing(case / "constant" / region / "polyMesh" / "faces") is not None:
        return
    if _is_decomposed(case):
        raise InputError(
            f"{case}: only the processor folders hold a mesh; run reconstructParMesh and reconstructPar."
        )
    require_choice(case, names)
    raise InputError(f"{case / 'constant' / 'polyMesh'}: no mesh here; is {case} an OpenFOAM case?")


def require_region(case: Path, region: str, names: Sequence[str]) -> None:
    """Raise InputError if a region is named that a case of these regions does not have."""
    if region and region not in names:
        raise InputError(
            f"{case}: no region {region}. {suggestion(region, names)}"
            if names
            else f"{case}: no region {region}; the case is not divided into regions."
        )


def require_choice(case: Path, names: Sequence[str]) -> None:
    """Raise InputError if a case without a mesh of its own has regions, of which one must be chosen."""
    if names:
        raise InputError(
            f"{case}: the mesh is divided into regions; choose one with -region. Allowed: {', '.join(names)}."
        )


def _is_decomposed(case: Path) -> bool:
    return any(case.glob("processor*/constant")) or any(case.glob("processors*/constant"))


def _mesh_folder(case: Path, time: str | None, region: str) -> Path:
    """The ``polyMesh`` folder whose topology holds at the time."""
    folder = case / "constant" / region / "polyMesh"
    for name in available_times(case):
        changed = case / name / region / "polyMesh"
        if time is not None and float(name) <= float(time) and existing(changed / "faces") is not None:
            folder = changed
    return folder


def _field_path(
    folder: Path, field: str, wanted: str = "volVectorField", meaning: str = "a velocity"
) -> Path:
    path = existing(folder / field)
    if path is None:
        raise InputError(f"{folder}: no field {field}; the fields are {listed(_fields(folder))}.")
    kind = header(path).get("class", "(none)")
    if kind != wanted:
        raise InputError(f"{path}: the class is {kind}, but {meaning} is a {wanted}.")
    require_lists(path)
    return path


def _fields(folder: Path) -> dict[str, str]:
    """Fields of a time directory, name → class."""
    found = {}
    for path in sorted(folder.iterdir()) if folder.is_dir() else ():
        if path.is_file():
            kind = header(path).get("class", "")
            if kind.endswith("Field"):
                found[path.name.removesuffix(".gz")] = kind
    return found


def _read_cell_zones(folder: Path) -> Mapping[str, NDArray[np.int64]]:
    path = existing(folder / "cellZones")
    return {} if path is None else read_cell_zones(path)


def _noted_counts(folder: Path) -> dict[str, int]:
    """Counts that OpenFOAM notes in the header of ``owner``: nPoints, nCells, nFaces, nInternalFaces."""
    for name in ("faces", "owner", "neighbour"):
        if existing(folder / name) is None:
            raise InputError(f"{folder / name}: no such file.")
    note = header(_shown(folder / "owner")).get("note", "")
    return {word: int(number) for word, number in re.findall(r"(n\w+):\s*(\d+)", note)}


def _require_labels(folder: Path, noted: dict[str, int]) -> None:
    """Refuse owners and neighbours that cannot be cells, for which VTK would make room, and broken faces."""
    for name in ("points", "faces"):
        if existing(folder / name) is not None:
            require_room(folder / name)
    faces = 0
    for name in ("owner", "neighbour"):
        path = _shown(folder / name)
        labels = read_labels(path)
        faces = max(faces, len(labels))
        # There are fewer cells than faces in any mesh.
        limit = noted.get("nCells", faces)
        wrong = np.flatnonzero((labels < 0) | (labels >= limit))
        if len(wrong):
            raise InputError(
                f"{path}: face {wrong[0]} belongs to cell {labels[wrong[0]]}, but there are {limit} cells."
            )
    _require_faces(_shown(folder / "faces"), 10 * max(faces, noted.get("nPoints", 0)))


def _require_faces(path: Path, limit: int) -> None:
    """Refuse lists of faces that VTK does not survive: lengths that do not fit, or beyond all memory."""
    if header(path).get("class") == "faceCompactList":
        read_faces(path)
        return
    data = read_bytes(path)
    long = re.compile(rb"\d{%d,}" % (len(str(limit)) + 1)).search(data, max(data.find(b"}"), 0))
    if long is not None:
        line = data.count(b"\n", 0, long.start()) + 1
        raise InputError(
            f"{path}: line {line}: {long[0][:30].decode()} is neither a point nor a number of them."
        )


def _shown(path: Path) -> Path:
    return existing(path) or path


def listed(names: Any) -> str:
    """Names with commas between them, the middle left out where they are many."""
    names = list(names)
    if len(names) > 12:
        names = [*names[:5], "…", *names[-5:]]
    return ", ".join(names) or "(none)"
