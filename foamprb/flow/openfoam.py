"""An OpenFOAM case: its times, fields and patches, and the flow at one of its times.

Mesh and fields come through VTK's OpenFOAM reader, which gives single precision, loses the types of the
patches and passes over most faults in silence. What it loses is read here from the small dictionaries, and
what it passes over is checked.
"""

from __future__ import annotations

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

from foamprb.errors import InputError
from foamprb.flow.foamfile import existing as _existing
from foamprb.flow.foamfile import header as _header
from foamprb.flow.foamfile import read_bytes as _read_bytes
from foamprb.flow.mesh import CELL_KINDS, Floats, Mesh, PatchSurface, build_mesh
from foamprb.flow.reconstruct import VALUELESS, Reconstruction
from foamprb.flow.walk import MeshFlow
from foamprb.flow.zones import parse_cell_zones

__all__ = [
    "PRECISION_NOTE",
    "CaseInfo",
    "PatchInfo",
    "TimeInfo",
    "VelocityReader",
    "available_times",
    "describe",
    "read_case",
    "select_time",
    "spoken",
]

_TIME_NAME = re.compile(r"\d+(\.\d*)?([eE][-+]?\d+)?")
_COMMENT = re.compile(r"/\*.*?\*/|//[^\n]*", re.DOTALL)
_PATCH = re.compile(r'("[^"]*"|[^\s(){};"]+)\s*\{([^{}]*)\}')
_SPOKEN = re.compile(r"^(ERROR|Warning): In .*?, line \d+\n(?:\S+ \(0x[0-9a-f]+\): )?(.*)", re.MULTILINE)
_MOST_SPOKEN = 100
PRECISION_NOTE = (
    "Coordinates and velocities have passed through single precision in VTK's OpenFOAM reader: a relative "
    "error of up to 6e-8 each, the coordinates' relative to their distance from the origin."
)


class PatchInfo(NamedTuple):
    """A patch as ``polyMesh/boundary`` lists it."""

    name: str
    type: str
    faces: int


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

    def lines(self) -> list[str]:
        """The same for a person to read."""
        low, high = ("({:g} {:g} {:g})".format(*corner) for corner in self.bounds)
        return [
            f"Case    {self.case}",
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


def select_time(case: Path, time: float | str = "latestTime") -> str:
    """Name of the time directory that ``time`` means: ``latestTime``, or a value.

    Raises
    ------
    InputError
        The case has no such time; the message lists those that it has.
    """
    _require_case(case)
    names = available_times(case)
    if not names:
        split = " Only decomposed times are there: run reconstructPar." if _is_decomposed(case) else ""
        raise InputError(f"{case}: no time directories; has the solver been run?{split}")
    if time == "latestTime":
        return names[-1]
    try:
        value = float(time)
    except ValueError:
        raise InputError(
            f"{case}: time '{time}' is neither a number nor latestTime; the times are {_list(names)}."
        ) from None
    for name in names:
        if abs(float(name) - value) <= 1e-9 * max(abs(value), 1e-30):
            return name
    raise InputError(f"{case}: no time {time}; the times are {_list(names)}.")


def describe(case: Path) -> CaseInfo:
    """Tell what a case holds, without reading a field.

    Raises
    ------
    InputError
        The folder is no case, or its mesh cannot be read.
    """
    _require_case(case)
    names = available_times(case)
    times = tuple(TimeInfo(name, _fields(case / name)) for name in names)
    folder = _mesh_folder(case, names[-1] if names else None)
    patches = _read_boundary(folder)
    blocks, said = _read_blocks(case, names[-1] if names else None, None, patches=False)
    _raise_spoken(case, said)
    grid = blocks["internalMesh"]
    kinds = np.bincount(np.asarray(grid.celltypes), minlength=256)
    cells = {
        CELL_KINDS.get(number, f"VTK type {number}"): int(kinds[number])
        for number in np.flatnonzero(kinds).tolist()
    }
    points = np.asarray(grid.points, dtype=np.float64)
    bounds = (points.min(axis=0), points.max(axis=0))
    return CaseInfo(case, times, patches, len(points), cells, bounds)


def read_case(case: Path | str, time: float | str = "latestTime", velocity: str = "U") -> MeshFlow:
    """Read mesh, patches and velocity of a case at one time, and reconstruct the flow.

    Parameters
    ----------
    case
        The case's folder.
    time
        A time's value, or ``latestTime``.
    velocity
        Name of the velocity field, a ``volVectorField`` in m/s.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent: the case, the time, the field, the mesh or a patch.
    """
    case = Path(case)
    mesh, cells, boundary, name = read_fields(case, time, velocity)
    u, l = Reconstruction(mesh)(cells, boundary)
    notes = [PRECISION_NOTE]
    if float(name) == 0.0:
        notes.append(f"The flow is that of time {name}, which is usually the initial guess and no solution.")
    return MeshFlow(mesh, u, l, notes, zones=lambda: _read_cell_zones(_mesh_folder(case, name)))


def read_fields(
    case: Path, time: float | str = "latestTime", velocity: str = "U"
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
    name = select_time(case, time)
    path = _field_path(case, name, velocity)
    folder = _mesh_folder(case, name)
    patches = _read_boundary(folder)
    noted = _noted_counts(folder)
    blocks, said = _read_blocks(case, name, velocity, patches=True)
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
        surfaces.append(PatchSurface(patch.name, patch.type, block))
    cells, boundary = _velocities(blocks, patches, velocity, path)
    mesh = build_mesh(grid, surfaces, source=str(folder))
    return mesh, cells, boundary, name


class VelocityReader:
    """Reads the velocity of a case at one time after the other, the mesh but once.

    Parameters
    ----------
    case
        The case, whose mesh does not change.
    time
        Name of a time directory.
    velocity
        Name of the velocity field.
    """

    def __init__(self, case: Path, time: str, velocity: str) -> None:
        self._case, self._velocity = case, velocity
        self._folder = _mesh_folder(case, time)
        self._patches = _read_boundary(self._folder)
        with spoken():
            self._reader = _open(case, velocity, patches=True)

    def __call__(self, time: str) -> tuple[Floats, Floats]:
        """Velocity at the cells (n_cells, 3) and boundary faces (n_boundary, 3) at a time, m/s.

        Raises
        ------
        InputError
            The field is missing, broken or not of the mesh's size.
        """
        path = _field_path(self._case, time, self._velocity)
        with spoken() as said:
            blocks = _update(self._reader, time)
        _raise_spoken(self._case, said)
        return _velocities(blocks, self._patches, self._velocity, path)

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


class Spoken(NamedTuple):
    """What VTK said, each message once."""

    errors: list[str]
    warnings: list[str]


@contextmanager
def spoken() -> Iterator[Spoken]:
    """Collect what VTK would print: lists that are filled when the block ends."""
    said = Spoken([], [])
    window, before = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
    vtkOutputWindow.SetInstance(window)
    vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_OFF)
    try:
        yield said
    finally:
        vtkLogger.SetStderrVerbosity(vtkLogger.VERBOSITY_INFO)
        vtkOutputWindow.SetInstance(before)
        text: Any = window.GetOutput()
        if isinstance(text, bytes):
            # So when a broken file's contents are quoted.
            text = text.decode("utf-8", "replace")
        for kind, message in _SPOKEN.findall(text):
            messages = said.errors if kind == "ERROR" else said.warnings
            message = " ".join(message.split())
            if message not in messages and len(messages) < _MOST_SPOKEN:
                messages.append(message)


def _read_blocks(
    case: Path, time: str | None, velocity: str | None, *, patches: bool
) -> tuple[dict[str, Any], Spoken]:
    """The reader's blocks by name, ``internalMesh`` and the patches; and what VTK said."""
    with spoken() as said:
        blocks = _update(_open(case, velocity, patches=patches), time)
    grid = blocks.get("internalMesh")
    if grid is None or grid.n_cells == 0:
        _raise_spoken(case, said)
        raise InputError(
            f"{case / 'constant' / 'polyMesh'}: no mesh could be read; a file is missing, broken or cut "
            "short."
        )
    return blocks, said


def _open(case: Path, velocity: str | None, *, patches: bool) -> Any:
    """VTK's reader of the mesh, of the velocity if it is named, and of the patches."""
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
    if velocity is not None:
        reader.SetCellArrayStatus(velocity, 1)
    for index in range(reader.GetNumberOfPatchArrays()):
        part = reader.GetPatchArrayName(index)
        wanted = part == "internalMesh" or (patches and part.startswith("patch/"))
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


def _values(block: Any, field: str, path: Path, where: str) -> Floats:
    if field not in block.cell_data:
        raise InputError(f"{path}: no values could be read for {where}; the file is broken or cut short.")
    values = np.asarray(block.cell_data[field], dtype=np.float64)
    if values.shape != (block.n_cells, 3):
        raise InputError(f"{path}: {where} have values of shape {values.shape}, not {(block.n_cells, 3)}.")
    bad = ~np.isfinite(values).all(axis=1)
    if bad.any():
        raise InputError(
            f"{path}: {np.count_nonzero(bad)} of {len(values)} values of {where} are not finite numbers."
        )
    return values


def _require_case(case: Path) -> None:
    if not case.is_dir():
        raise InputError(f"{case}: no such folder.")
    if _existing(case / "constant" / "polyMesh" / "faces") is not None:
        return
    if _is_decomposed(case):
        raise InputError(
            f"{case}: only the processor folders hold a mesh; run reconstructParMesh and reconstructPar."
        )
    raise InputError(f"{case / 'constant' / 'polyMesh'}: no mesh here; is {case} an OpenFOAM case?")


def _is_decomposed(case: Path) -> bool:
    return any(case.glob("processor*/constant")) or any(case.glob("processors*/constant"))


def _mesh_folder(case: Path, time: str | None) -> Path:
    """The ``polyMesh`` folder whose topology holds at the time."""
    folder = case / "constant" / "polyMesh"
    for name in available_times(case):
        changed = case / name / "polyMesh"
        if time is not None and float(name) <= float(time) and _existing(changed / "faces") is not None:
            folder = changed
    return folder


def _field_path(case: Path, time: str, field: str) -> Path:
    path = _existing(case / time / field)
    if path is None:
        raise InputError(f"{case / time}: no field {field}; the fields are {_list(_fields(case / time))}.")
    kind = _header(path).get("class", "(none)")
    if kind != "volVectorField":
        raise InputError(f"{path}: the class is {kind}, but a velocity is a volVectorField.")
    return path


def _fields(folder: Path) -> dict[str, str]:
    """Fields of a time directory, name → class."""
    found = {}
    for path in sorted(folder.iterdir()):
        if path.is_file():
            kind = _header(path).get("class", "")
            if kind.endswith("Field"):
                found[path.name.removesuffix(".gz")] = kind
    return found


def _read_boundary(folder: Path) -> tuple[PatchInfo, ...]:
    path = _existing(folder / "boundary")
    if path is None:
        raise InputError(f"{folder / 'boundary'}: no such file.")
    text = _COMMENT.sub(" ", _read_bytes(path).decode("utf-8", "replace"))
    body = text[text.find("}") + 1 :]
    count = re.search(r"\d+(?=\s*\()", body)
    patches = []
    for match in _PATCH.finditer(body):
        entries = {words[0]: words[1] for line in match[2].split(";") if len(words := line.split()) > 1}
        if "type" not in entries or not entries.get("nFaces", "").isdigit():
            raise InputError(f"{path}: patch {match[1]} lacks its type or nFaces.")
        patches.append(PatchInfo(match[1].strip('"'), entries["type"], int(entries["nFaces"])))
    if count is None or int(count[0]) != len(patches):
        raise InputError(
            f"{path}: {len(patches)} patches could be read, not {count[0] if count else '(no number)'}."
        )
    return tuple(patches)


def _read_cell_zones(folder: Path) -> Mapping[str, NDArray[np.int64]]:
    path = _existing(folder / "cellZones")
    return {} if path is None else parse_cell_zones(_read_bytes(path), path)


def _noted_counts(folder: Path) -> dict[str, int]:
    """Counts that OpenFOAM notes in the header of ``owner``: nPoints, nCells, nFaces, nInternalFaces."""
    for name in ("faces", "owner", "neighbour"):
        if _existing(folder / name) is None:
            raise InputError(f"{folder / name}: no such file.")
    note = _header(_shown(folder / "owner")).get("note", "")
    return {word: int(number) for word, number in re.findall(r"(n\w+):\s*(\d+)", note)}


def _shown(path: Path) -> Path:
    return _existing(path) or path


def _list(names: Any) -> str:
    names = list(names)
    if len(names) > 12:
        names = [*names[:5], "…", *names[-5:]]
    return ", ".join(names) or "(none)"
