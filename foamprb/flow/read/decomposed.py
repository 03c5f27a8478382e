"""Cases that decomposePar has cut into processor folders: put together again, in the original order.

The addressing files tell which point, face, cell and patch of the whole each part holds. Mesh and velocity
are put together in a temporary folder, in OpenFOAM's binary format, and read from there as any other case is:
the flow is the same as that of the case before it was cut.
"""

from __future__ import annotations

import re
import weakref
from collections.abc import Callable, Sequence
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, TypeAlias, TypeVar

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.read.foamfile import (
    Field,
    Floats,
    Labels,
    PatchInfo,
    existing,
    header,
    read_boundary,
    read_cell_zones,
    read_faces,
    read_field,
    read_labels,
    read_vectors,
)
from foamprb.flow.read.openfoam import (
    CaseInfo,
    TimeInfo,
    available_times,
    describe,
    read_case,
    regions,
    require_choice,
    require_region,
    select_time,
)
from foamprb.flow.read.scratch import scratch_folder
from foamprb.flow.series import SeriesFlow, read_series
from foamprb.flow.walk import MeshFlow

__all__ = [
    "Rebuilt",
    "describe_decomposed",
    "is_only_decomposed",
    "processors",
    "read_decomposed_case",
    "read_decomposed_series",
]

_Mask: TypeAlias = NDArray[np.bool_]
Result = TypeVar("Result")
AFlow = TypeVar("AFlow", MeshFlow, SeriesFlow, SeriesFlow | MeshFlow)

_HEADER = """FoamFile
{{
    version     2.0;
    format      binary;
    class       {kind};
    arch        "LSB;label=32;scalar=64";
    {note}
    object      {name};
}}

"""
_MESH = ("points", "faces", "owner", "neighbour", "boundary")
_APART = 1e-6
"""How far apart a point may be in two parts, of the extent of the mesh."""
_ADDRESSING = ("pointProcAddressing", "faceProcAddressing", "cellProcAddressing", "boundaryProcAddressing")


def processors(case: Path) -> tuple[Path, ...]:
    """The processor folders, in their order.

    Raises
    ------
    InputError
        There is none, one is missing, or they are in the collated format.
    """
    folders = {
        int(m[1]): path
        for path in case.glob("processor*")
        if (m := re.fullmatch(r"processor(\d+)", path.name))
    }
    if not folders:
        collated = [path.name for path in case.glob("processors*") if path.is_dir()]
        if collated:
            raise InputError(f"{case / collated[0]}: the collated format is not read: run reconstructPar.")
        raise InputError(f"{case}: no processor folders.")
    for number in range(max(folders)):
        if number not in folders:
            raise InputError(
                f"{case / f'processor{number}'}: no such folder, but there is processor{max(folders)}."
            )
    return tuple(folders[number] for number in sorted(folders))


def is_only_decomposed(case: Path, region: str = "") -> bool:
    """Whether the solution is in processor folders alone: no mesh beside them, or no time but 0."""
    folders = [path for path in case.glob("processor*") if (path / "constant").is_dir()]
    if not folders:
        return False
    if existing(case / "constant" / region / "polyMesh/faces") is None:
        return not regions(case) or bool(region)
    later = any(float(name) != 0.0 for name in available_times(case))
    return not later and any(float(name) != 0.0 for name in available_times(folders[0]))


class _Part(NamedTuple):
    """A processor's mesh, and the places of its pieces in the whole."""

    mesh: Path
    """The folder ``polyMesh``."""
    points: Floats
    face_start: Labels
    face_points: Labels
    owner: Labels
    neighbour: Labels
    patches: Sequence[PatchInfo]
    point_at: Labels
    face_at: Labels
    turned: _Mask
    """(n_faces,) whether a face turns the other way there: its cell is the neighbour."""
    cell_at: Labels
    patch_at: Labels


class Rebuilt:
    """A decomposed case, put together in a temporary folder that lives as long as this does.

    Parameters
    ----------
    case
        The case.
    region
        Name of the mesh region, if the case has several.

    Raises
    ------
    InputError
        A file is missing or broken, or the parts do not make a whole; the file or the folder.
    """

    def __init__(self, case: Path, region: str = "") -> None:
        self.case, self.region = case, region
        self._folders = processors(case)
        names = regions(self._folders[0])
        require_region(case, region, names)
        if not region and existing(self._folders[0] / "constant/polyMesh/faces") is None:
            require_choice(case, names)
        self.times = _common_times(self._folders, region)
        self._parts = [_read_part(case, folder, region) for folder in self._folders]
        self._patches, self._ranges = _whole_patches(case, self._parts)
        self.folder = scratch_folder(self)
        for name in self.times:
            (self.folder / name / region).mkdir(parents=True)
        (self.folder / "system").mkdir()
        (self.folder / "system/controlDict").write_text(
            _HEADER.format(kind="dictionary", note="", name="controlDict")
        )
        mesh = self.folder / "constant" / region / "polyMesh"
        _write_mesh(mesh, case, self._parts, self._patches, self._ranges)
        _write_zones(mesh / "cellZones", self._parts)
        # The fields need the addresses alone.
        nothing = np.empty(0, dtype=np.int64)
        self._parts = [
            part._replace(
                points=np.empty((0, 3)), face_start=nothing, face_points=nothing,
                owner=nothing, neighbour=nothing, point_at=nothing,
            )
            for part in self._parts
        ]  # fmt: skip

    def write(self, time: str, velocity: str = "U", gradient: str = "") -> None:
        """Put the fields at a time together, in place of those at any other time.

        Raises
        ------
        InputError
            A processor misses one, or its file is broken.
        """
        for name, kind in ((velocity, "volVectorField"), (gradient, "volTensorField")):
            if name:
                self._write(time, name, kind)

    def _write(self, time: str, name: str, kind: str) -> None:
        for other in self.times:
            (self.folder / other / self.region / name).unlink(missing_ok=True)
        fields = []
        for part, folder in zip(self._parts, self._folders, strict=True):
            path = folder / time / self.region / name
            if existing(path) is None:
                raise InputError(f"{path}: no such file.")
            fields.append(_checked(read_field(path, kind), part, path))
        _write_field(
            self.folder / time / self.region / name, kind, self._parts, fields, self._patches, self._ranges
        )

    def call(self, function: Callable[..., Result], *arguments: Any) -> Result:
        """Call a function of a case; its messages then name the case, not the temporary folder."""
        try:
            return function(self.folder, *arguments)
        except InputError as error:
            raise InputError(str(error).replace(str(self.folder), str(self.case))) from None

    def noted(self, flow: AFlow) -> AFlow:
        """The flow, with a note that it comes from here; the folder lives as long as the flow."""
        weakref.finalize(flow, _let_go, self)
        flow.notes = (f"The flow was put together from {len(self._parts)} processor folders.", *flow.notes)
        return flow


def _let_go(whole: Rebuilt) -> None:
    """Hold the folder until this is called."""


def read_decomposed_case(
    case: Path, time: float | str = "latestTime", velocity: str = "U", region: str = "", gradient: str = ""
) -> MeshFlow:
    """Read the flow of a decomposed case at one time, as :func:`foamprb.flow.read.openfoam.read_case`.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent in the processor folders.
    """
    whole = Rebuilt(case, region)
    name = whole.call(select_time, time, region)
    whole.write(name, velocity, gradient)
    return whole.noted(whole.call(read_case, name, velocity, region, gradient))


def read_decomposed_series(
    case: Path,
    times: str | None = None,
    period: float | None = None,
    velocity: str = "U",
    region: str = "",
    gradient: str = "",
) -> SeriesFlow | MeshFlow:
    """Read the flow of a decomposed case at several times, as :func:`foamprb.flow.series.read_series`.

    Raises
    ------
    InputError
        What is missing, broken or inconsistent in the processor folders.
    """
    whole = Rebuilt(case, region)

    def prepare(name: str) -> None:
        whole.write(name, velocity, gradient)

    return whole.noted(whole.call(read_series, times, period, velocity, region, gradient, prepare))


def describe_decomposed(case: Path, region: str = "") -> CaseInfo:
    """Tell what a decomposed case holds, or a region: see :func:`foamprb.flow.read.openfoam.describe`."""
    whole = Rebuilt(case, region)
    first = processors(case)[0]
    times = tuple(TimeInfo(name, _classes(first / name / region)) for name in whole.times)
    return replace(whole.call(describe, region), case=case, times=times, regions=regions(first))


def _classes(folder: Path) -> dict[str, str]:
    paths = sorted(folder.iterdir()) if folder.is_dir() else ()
    found = {path.name.removesuffix(".gz"): header(path).get("class", "") for path in paths if path.is_file()}
    return {name: kind for name, kind in found.items() if kind.endswith("Field")}


def _common_times(folders: Sequence[Path], region: str) -> tuple[str, ...]:
    """The times of all folders; raise InputError if one of them misses a time that another has."""
    times = available_times(folders[0])
    for folder in folders:
        here = available_times(folder)
        meshes = [folder / name / region / "polyMesh" for name in here]
        moved = [mesh for mesh in meshes if mesh.is_dir()]
        if moved:
            raise InputError(f"{moved[0]}: the mesh changes in time; of decomposed cases it must not.")
        for name in (*times, *here):
            if (name in times) != (name in here):
                lacking, having = (folder, folders[0]) if name in times else (folders[0], folder)
                raise InputError(f"{lacking}: no time {name}, which {having.name} has.")
    return times


def _read_part(case: Path, folder: Path, region: str) -> _Part:
    mesh = folder / "constant" / region / "polyMesh"
    for name in _MESH:
        if existing(mesh / name) is None:
            raise InputError(f"{mesh / name}: no such file.")
    for name in _ADDRESSING:
        if existing(mesh / name) is None:
            raise InputError(
                f"{mesh / name}: no such file. Without decomposePar's addressing the parts cannot be put "
                "together here: run reconstructParMesh and reconstructPar."
            )
    start, points = read_faces(mesh / "faces")
    signed = read_labels(mesh / "faceProcAddressing")
    part = _Part(
        mesh, read_vectors(mesh / "points"), start, points,
        read_labels(mesh / "owner"), read_labels(mesh / "neighbour"),
        read_boundary(mesh / "boundary", case),
        read_labels(mesh / "pointProcAddressing"), np.abs(signed) - 1, signed < 0,
        read_labels(mesh / "cellProcAddressing"), read_labels(mesh / "boundaryProcAddressing"),
    )  # fmt: skip
    cells, faces = len(part.cell_at), len(part.owner)
    for name, found, expected in (
        ("faces", len(start) - 1, faces),
        ("faceProcAddressing", len(signed), faces),
        ("pointProcAddressing", len(part.point_at), len(part.points)),
        ("boundaryProcAddressing", len(part.patch_at), len(part.patches)),
    ):
        if found != expected:
            raise InputError(f"{mesh / name}: {found} entries, but the other files say {expected}.")
    for name, values, limit in (
        ("faces", points, len(part.points)),
        ("owner", part.owner, cells),
        ("neighbour", part.neighbour, cells),
    ):
        if len(values) and not 0 <= values.min() <= values.max() < limit:
            raise InputError(f"{mesh / name}: an index outside 0 to {limit - 1}.")
    if np.any(signed == 0):
        raise InputError(f"{mesh / 'faceProcAddressing'}: there is no face 0.")
    return part


def _whole_patches(case: Path, parts: Sequence[_Part]) -> tuple[list[PatchInfo], Labels]:
    """The patches of the whole, and where each begins after the interior faces; then where the last ends."""
    known: dict[int, PatchInfo] = {}
    counts: dict[int, int] = {}
    for part in parts:
        names = [patch.name for patch in part.patches]
        for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
            if at >= 0:
                known.setdefault(at, patch)
                counts[at] = counts.get(at, 0) + patch.faces
            elif "referPatch" in patch.entries and patch.entries["referPatch"] in names:
                # A cyclic patch whose two sides lie on different processors.
                whole = int(part.patch_at[names.index(patch.entries["referPatch"])])
                counts[whole] = counts.get(whole, 0) + patch.faces
    if sorted(known) != list(range(len(known))):
        raise InputError(f"{case}: the processor folders do not name all patches of the mesh.")
    patches = [known[at]._replace(faces=counts[at]) for at in range(len(known))]
    return patches, np.concatenate([[0], np.cumsum([patch.faces for patch in patches])]).astype(np.int64)


def _write_mesh(
    folder: Path, case: Path, parts: Sequence[_Part], patches: Sequence[PatchInfo], ranges: Labels
) -> None:
    foreign = InputError(
        f"{case}: the processor folders do not make a whole mesh; one of them is damaged or of another case."
    )
    n_cells = _whole_number([part.cell_at for part in parts])
    n_points = _whole_number([part.point_at for part in parts])
    n_faces = _whole_number([part.face_at[~part.turned] for part in parts])
    n_internal = n_faces - int(ranges[-1])
    turned = np.concatenate([part.face_at[part.turned] for part in parts])
    if (
        min(n_cells, n_points, n_internal) < 0
        or n_cells != sum(len(part.cell_at) for part in parts)
        or n_faces != sum(np.count_nonzero(~part.turned) for part in parts)
        or turned.max(initial=-1) >= n_faces
        or len(np.unique(turned)) != len(turned)
    ):
        raise foreign
    points = np.empty((n_points, 3))
    owner, neighbour, size = (np.full(n_faces, -1, dtype=np.int64) for _ in range(3))
    for part in parts:
        points[part.point_at] = part.points
        own = ~part.turned
        owner[part.face_at[own]] = part.cell_at[part.owner[own]]
        size[part.face_at[own]] = np.diff(part.face_start)[own]
        inside = len(part.neighbour)
        neighbour[part.face_at[:inside]] = part.cell_at[part.neighbour]
        neighbour[part.face_at[part.turned]] = part.cell_at[part.owner[part.turned]]
    apart = max(float(np.abs(points[part.point_at] - part.points).max(initial=0.0)) for part in parts)
    if (
        not apart <= _APART * float(np.ptp(points, axis=0).max())
        or np.any(neighbour[:n_internal] < 0)
        or np.any(neighbour[n_internal:] >= 0)
    ):
        raise foreign
    start = np.concatenate([[0], np.cumsum(size)])
    lists = np.empty(start[-1], dtype=np.int64)
    for part in parts:
        kept = np.flatnonzero(~part.turned)
        counts = np.diff(part.face_start)[kept]
        within = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
        to = np.repeat(start[part.face_at[kept]], counts) + within
        lists[to] = part.point_at[part.face_points[np.repeat(part.face_start[kept], counts) + within]]
    folder.mkdir(parents=True)
    note = f'note "nPoints:{n_points}  nCells:{n_cells}  nFaces:{n_faces}  nInternalFaces:{n_internal}";'
    _write(folder / "points", "vectorField", [points])
    _write(folder / "faces", "faceCompactList", [start, lists])
    _write(folder / "owner", "labelList", [owner], note)
    _write(folder / "neighbour", "labelList", [neighbour[:n_internal]], note)
    text = "".join(
        f"{patch.name}\n{{\n"
        + "".join(f"    {key} {value};\n" for key, value in _entries(patch, n_internal + int(first)).items())
        + "}\n"
        for patch, first in zip(patches, ranges, strict=False)
    )
    (folder / "boundary").write_text(
        _HEADER.format(kind="polyBoundaryMesh", note="", name="boundary").replace("binary", "ascii")
        + f"{len(patches)}\n(\n{text})\n"
    )


def _whole_number(addresses: Sequence[Labels]) -> int:
    """How many pieces there are if the parts hold all numbers from 0 on, and no others; −1 if they do not."""
    everything = np.concatenate(addresses)
    n = int(everything.max(initial=-1)) + 1
    if n > len(everything) or everything.min(initial=0) < 0:
        return -1
    return n if np.bincount(everything, minlength=n).all() else -1


def _write_zones(path: Path, parts: Sequence[_Part]) -> None:
    """Put the zones of cells together, if there are any; each in the order of its cells."""
    zones: dict[str, list[Labels]] = {}
    for part in parts:
        found = existing(part.mesh / "cellZones")
        for name, cells in ({} if found is None else read_cell_zones(found)).items():
            if len(cells) and not 0 <= cells.min() <= cells.max() < len(part.cell_at):
                raise InputError(f"{found}: zone {name} names a cell that is not there.")
            zones.setdefault(name, []).append(part.cell_at[cells])
    text = ""
    for name, lists in zones.items():
        labels = np.sort(np.concatenate(lists))
        text += f"{name}\n{{\n    type cellZone;\n    cellLabels List<label> {len(labels)} "
        text += f"({' '.join(map(str, labels))});\n}}\n"
    if zones:
        head = _HEADER.format(kind="regIOobject", note="", name="cellZones").replace("binary", "ascii")
        path.write_text(f"{head}{len(zones)}\n(\n{text})\n")


def _entries(patch: PatchInfo, start: int) -> dict[str, str]:
    return patch.entries | {"nFaces": str(patch.faces), "startFace": str(start)}


def _checked(field: Field, part: _Part, path: Path) -> Field:
    """The field, if it has the part's size."""
    if len(field.cells) not in (1, len(part.cell_at)):
        raise InputError(f"{path}: {len(field.cells)} cells, but the mesh there has {len(part.cell_at)}.")
    for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
        if at < 0:
            continue
        if patch.name not in field.patches:
            raise InputError(f"{path}: no boundaryField for the patch {patch.name}.")
        values = field.patches[patch.name][1]
        if values is not None and len(values) not in (1, patch.faces):
            raise InputError(
                f"{path}: {len(values)} values on patch {patch.name}, which has {patch.faces} faces."
            )
    return field


def _write_field(
    path: Path,
    kind: str,
    parts: Sequence[_Part],
    fields: Sequence[Field],
    patches: Sequence[PatchInfo],
    ranges: Labels,
) -> None:
    components = fields[0].cells.shape[1]
    of = {3: "vector", 9: "tensor"}[components]
    cells = np.empty((sum(len(part.cell_at) for part in parts), components))
    n_faces = 1 + max(int(part.face_at.max(initial=-1)) for part in parts)
    boundary = np.zeros((int(ranges[-1]), components))
    valued = np.zeros(len(patches), dtype=bool)
    types = [""] * len(patches)
    for part, field in zip(parts, fields, strict=True):
        cells[part.cell_at] = field.cells
        for patch, at in zip(part.patches, part.patch_at.tolist(), strict=True):
            if at < 0:
                continue
            types[at], values = field.patches[patch.name]
            if values is not None and patch.faces:
                faces = part.face_at[patch.start : patch.start + patch.faces]
                boundary[faces - (n_faces - len(boundary))] = values
                valued[at] = True
    with path.open("wb") as file:
        file.write(_HEADER.format(kind=kind, note="", name=path.name).encode())
        length = 1 if components == 3 else 0
        file.write(f"dimensions [0 {length} -1 0 0 0 0];\ninternalField nonuniform List<{of}> ".encode())
        _write_list(file, cells)
        file.write(b";\nboundaryField\n{\n")
        for i, patch in enumerate(patches):
            file.write(f"{patch.name}\n{{\ntype {types[i]};\n".encode())
            if valued[i]:
                file.write(f"value nonuniform List<{of}> ".encode())
                _write_list(file, boundary[ranges[i] : ranges[i + 1]])
                file.write(b";\n")
            file.write(b"}\n")
        file.write(b"}\n")


def _write(path: Path, kind: str, lists: Sequence[NDArray[Any]], note: str = "") -> None:
    with path.open("wb") as file:
        file.write(_HEADER.format(kind=kind, note=note, name=path.name).encode())
        for values in lists:
            _write_list(file, values)
            file.write(b"\n")


def _write_list(file: Any, values: NDArray[Any]) -> None:
    kind = "<f8" if values.dtype.kind == "f" else "<i4"
    file.write(f"{len(values)}\n(".encode())
    file.write(np.ascontiguousarray(values, dtype=kind).tobytes())
    file.write(b")")
