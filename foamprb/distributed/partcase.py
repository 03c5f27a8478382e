"""Case in processor folders, of which a node of a parallel run reads its own."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.distributed.fragment import Fragment, IndivisibleMeshError, Team, merged
from foamprb.distributed.partflow import PartFlow, PartSeries
from foamprb.distributed.parting import hold_part
from foamprb.distributed.submesh import CUT, Halo
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.mesh.lists import even_ends, ragged, starts, take_lists
from foamprb.flow.read.boundary import CaseMesh, PatchInfo, patches_of_mesh
from foamprb.flow.read.boundary_values import AREA, FLOW_RATE
from foamprb.flow.read.case import MissingFieldError, mesh_files
from foamprb.flow.read.checks import notes_of_types, require_patch_shapes, require_volumes
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.field import FoamField, Kind, PatchField, read_field
from foamprb.flow.read.processors import (
    Address,
    Piece,
    checked,
    join_zones,
    read_addresses,
    read_pieces,
    whole_patches,
)
from foamprb.flow.series import SeriesFlow

_COUPLED = frozenset({"cyclic", "cyclicAMI", "nonConformalCyclic", "wedge"})
"""Types of coupled patches, whose two sides may lie on different nodes."""
_NO_ADDRESSES = "the processor folders have no files *ProcAddressing"


class PartCase(DecomposedCase):
    """Part of a case: the cells of some processor folders, and layers of cells around them.

    All nodes call the same methods together. Values of other nodes' cells come from these nodes.

    Parameters
    ----------
    root, region
        See :class:`~foamprb.flow.read.openfoam.Case`.
    team
        The nodes.
    depth
        Least number of layers in which bodies may move.

    Raises
    ------
    IndivisibleMeshError
        The folders have no addressing files.
    """

    def __init__(
        self,
        root: Path,
        region: str,
        team: Team,
        depth: int,
    ) -> None:
        super().__init__(root, region)
        self._team, self._depth = team, depth
        self._whole: CaseMesh | None = None
        self._halo: Halo
        folder = self.mesh_folder(self._times[-1]).relative_to(self._first)
        cells = team.spread(self.processors.cells(folder) if team.rank == 0 else None)
        if cells is None:
            raise IndivisibleMeshError(_NO_ADDRESSES)
        self.processors.selected = range(*even_ends(cells, team.size)[team.rank :][:2])

    def damaged(self, times: Sequence[str], name: str) -> dict[str, str]:
        """See :meth:`~foamprb.flow.read.openfoam.Case.damaged`; of all nodes."""
        of_nodes = self._team.of_all(super().damaged(times, name))
        return {time: fault for damaged in of_nodes for time, fault in damaged.items()}

    def mesh(self, time: str) -> CaseMesh:
        """Read the mesh at a time; see :meth:`~foamprb.flow.read.openfoam.Case.mesh`.

        Raises
        ------
        IndivisibleMeshError
            The folders have no addressing files, or see :func:`hold_part`; or patches are coupled.
        """
        team, folder = self._team, self.mesh_folder(time)
        files = mesh_files(self._first, time, self.region)
        if self._whole is not None and files == self._files:
            return self._whole
        pieces = read_pieces(self.processors, files, self.root)
        parts = read_addresses(self.processors, files[1].parent, pieces)
        if any(team.of_all(parts is None)) or parts is None:
            raise IndivisibleMeshError(_NO_ADDRESSES)
        addresses = parts
        nothing: Any = np.empty(0, dtype=np.int64)
        named = [(part.patches, part.of_patches) for part in parts]
        everywhere = [
            Address(patches, nothing, nothing, nothing, nothing, of_patches)
            for listed in team.of_all(named)
            for patches, of_patches in listed
        ]
        self._patches, self._ranges = whole_patches(self.root, everywhere)
        coupled = [patch.type for patch in self._patches if patch.type in _COUPLED]
        if coupled:
            raise IndivisibleMeshError(f"the mesh has patches of type {coupled[0]}")
        most = max(int(part.faces.max(initial=-1)) for part in parts)
        n_internal = 1 + max(team.of_all(most)) - int(self._ranges[-1])
        surfaces, ranges = patches_of_mesh(self._patches), self._ranges.astype(np.intp)

        def own_cells() -> Fragment:
            fragments = [
                fragment_of(piece, address) for piece, address in zip(pieces, addresses, strict=True)
            ]
            pieces.clear()
            return merged(fragments)

        # What fields need of them.
        self._parts = [
            address._replace(
                points=nothing,
                turned=nothing,
                faces=address.faces[len(piece.neighbour) :].copy(),
                patches=[p._replace(start=p.start - len(piece.neighbour)) for p in address.patches],
            )
            for piece, address in zip(pieces, addresses, strict=True)
        ]
        part = hold_part(own_cells, surfaces, ranges, n_internal, self._depth, team, str(folder))
        self._halo, mesh = Halo(part, team), part.mesh
        self.comm = self._halo
        counts, first = np.diff(mesh.patch_start).tolist(), (mesh.n_internal + mesh.patch_start).tolist()
        infos = [*self._patches, PatchInfo(CUT.name, CUT.type, 0, 0, "", Transform(), {})]
        patches = tuple(p._replace(faces=n, start=k) for p, n, k in zip(infos, counts, first, strict=False))
        self._local = patches
        require_volumes(mesh, folder)
        require_patch_shapes(mesh, folder)
        self._whole, self._files = CaseMesh(mesh, patches, tuple(notes_of_types(patches))), files
        return self._whole

    def _read(self, time: str, name: str, kind: Kind) -> list[FoamField]:
        """Read a field of each processor of this node."""
        file, processors = Path(time) / self.region / name, self.processors
        # Some fields may be missing, or of another kind.
        with self._team.united():
            files = processors.files(file)
            if files is None:
                raise MissingFieldError(f"{processors.folders[processors.held[0]] / file}: no such file.")
            return [
                checked(read_field(file, kind, self.root), part)
                for file, part in zip(files, self._parts, strict=True)
            ]

    def field(self, time: str, name: str, kind: Kind) -> FoamField:
        """Read a field at a time; see :meth:`~foamprb.flow.read.openfoam.Case.field`."""
        self.mesh(time)
        fields = self._read(time, name, kind)
        numbers = self._halo.part.cells
        cells = np.zeros((len(numbers), fields[0].cells.shape[1]))
        for part, field in zip(self._parts, fields, strict=True):
            cells[np.searchsorted(numbers, part.cells)] = field.cells
        self._halo.fill("cells", cells)
        entries = {}
        for index, patch in enumerate(self._patches):
            entry = self._joined(fields, index)
            if entry is not None:
                entries[patch.name] = entry
        return fields[0]._replace(cells=cells, patches=entries)

    def _joined(self, fields: list[FoamField], index: int) -> PatchField | None:
        """Return the entry of a patch with values at its faces here; None if no processor has an entry."""
        halo, team = self._halo, self._team
        pieces: list[tuple[NDArray[Any], PatchField]] = []
        for part, field in zip(self._parts, fields, strict=True):
            for patch in (part.patches[k] for k in np.flatnonzero(part.of_patches == index).tolist()):
                entry = field.of(patch)
                if entry is not None:
                    pieces.append((part.faces[patch.start : patch.start + patch.faces], entry))
        summaries = [
            (len(faces) > 0, entry._replace(fields={key: v[:0] for key, v in entry.fields.items()}))
            for faces, entry in pieces
        ]
        everywhere = [piece for listed in team.of_all(summaries) for piece in listed]
        filled = [entry for some, entry in everywhere if some] or [entry for _, entry in everywhere]
        if not filled:
            return None
        keys = sorted(set.intersection(*(set(entry.fields) for entry in filled)))
        mesh, values = halo.part.mesh, {}
        numbers = halo.part.faces[mesh.n_internal :][: mesh.patch_start[-2]]
        for key in keys:
            values_here: Floats = np.zeros((len(numbers), filled[0].fields[key].shape[1]))
            for faces, entry in pieces:
                if len(faces):
                    values_here[np.searchsorted(numbers, faces)] = entry.fields[key]
            halo.fill("boundary", values_here)
            values[key] = values_here[mesh.patch_start[index] : mesh.patch_start[index + 1]]
        if filled[0].type == FLOW_RATE and "value" not in keys:
            values[AREA] = np.array([[self._area(index)]])
        joined: PatchField = filled[0]._replace(pattern=False, fields=values)
        return joined

    def _area(self, index: int) -> float:
        """Return the area of a patch of the whole mesh, m², summed in its order."""
        part, mesh = self._halo.part, self._halo.part.mesh
        rows = np.arange(*mesh.patch_start[index : index + 2])
        rows = rows[part.owned[mesh.owner[mesh.n_internal + rows]]]
        of_faces = part.faces[mesh.n_internal + rows], np.linalg.norm(mesh.boundary_areas[rows], axis=1)
        numbers, areas = (np.concatenate(column) for column in zip(*self._halo.of_all(of_faces), strict=True))
        return float(areas[np.argsort(numbers)].sum())

    def make(self, kind: Callable[..., Any], *arguments: Any, **options: Any) -> Any:
        """See :meth:`~foamprb.flow.read.openfoam.Case.make`; a flow on the part."""
        return (PartSeries if kind is SeriesFlow else PartFlow)(self._halo, *arguments, **options)

    def zones(self, time: str) -> Mapping[str, NDArray[np.int64]]:
        """Read the cells here of each zone by name; see :meth:`~foamprb.flow.read.openfoam.Case.zones`."""
        zones = join_zones(self.processors, self.mesh_folder(time), self._parts)
        names = {name for listed in self._team.of_all(list(zones)) for name in listed}
        cells_of, cells, nothing = {}, self._halo.part.cells, np.empty(0, dtype=np.int64)
        for name in sorted(names):
            inside = np.zeros(len(cells), dtype=bool)
            inside[np.searchsorted(cells, zones.get(name, nothing))] = True
            self._halo.fill("cells", inside)
            cells_of[name] = np.flatnonzero(inside)
        return cells_of


def fragment_of(piece: Piece, part: Address) -> Fragment:
    """Return the mesh of a processor in the numbers of the whole mesh."""
    cells, points, faces = np.sort(part.cells), np.argsort(part.points), np.argsort(part.faces)
    size, turned = np.diff(piece.start).astype(np.intp), part.turned
    within = ragged(np.zeros(len(size), dtype=np.intp), size)
    back = np.repeat(turned, size)
    within[back] = (-within % np.repeat(size, size))[back]
    lists = part.points[piece.lists[np.repeat(piece.start[:-1].astype(np.intp), size) + within]]
    owner, neighbour = np.full((2, len(size)), -1, dtype=np.int64)
    owner[~turned] = part.cells[piece.owner[~turned]]
    neighbour[turned] = part.cells[piece.owner[turned]]
    neighbour[: len(piece.neighbour)] = part.cells[piece.neighbour]
    start, lists = take_lists(starts(size), lists, faces)
    numbers = part.points[points].astype(np.int64), piece.points[points], part.faces[faces].astype(np.int64)
    sides = owner[faces], neighbour[faces]
    return Fragment(cells.astype(np.int64), *numbers, start, lists.astype(np.int64), *sides)
