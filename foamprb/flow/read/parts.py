"""Case in processor folders, of which a node of a parallel run reads its own."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from contextlib import suppress
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.errors import InputError
from foamprb.flow.base import Floats
from foamprb.flow.mesh.boundary import Transform
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.fragment import Fragment, IndivisibleMeshError, Labels, Team, merged
from foamprb.flow.mesh.geometry import largest_fluxes, measured
from foamprb.flow.mesh.lists import even_ends
from foamprb.flow.mesh.parting import hold_part
from foamprb.flow.mesh.submesh import CUT, Folders, Halo, layers_over
from foamprb.flow.partflow import largest_eddies
from foamprb.flow.read.boundary import CaseMesh, PatchInfo, patches_of_mesh
from foamprb.flow.read.boundary_values import AREA, FLOW_RATE
from foamprb.flow.read.case import MissingFieldError, mesh_files
from foamprb.flow.read.checks import notes_of_types, require_patch_shapes, require_volumes
from foamprb.flow.read.decomposed import DecomposedCase
from foamprb.flow.read.field import VELOCITY_FIELD, FoamField, Kind, PatchField, read_field
from foamprb.flow.read.mrf import read_rotations
from foamprb.flow.read.processors import (
    Address,
    Piece,
    checked,
    fragment_of,
    join_zones,
    read_addresses,
    read_pieces,
    whole_patches,
)
from foamprb.flow.read.source import FlowSource
from foamprb.flow.read.turbulence import K_FIELD

_COUPLED = frozenset({"cyclicAMI", "nonConformalCyclic", "wedge"})
"""Types of coupled patches whose faces do not match one to one, or that only small meshes have."""
_NO_ADDRESSES = "the processor folders have no files *ProcAddressing"
_FINE = 1e9
_ROUND_OFF = 1e-6
"""Relative difference of rates and volumes from those of the whole mesh, at most."""
_SOURCE = FlowSource()


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
    load
        (n,) particles in each of all processor folders, if they count.
    source, step
        Names of the fields; time in which the fluid must not cross the layers, s.

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
        load: Labels | None = None,
        source: FlowSource = _SOURCE,
        step: float = 0.0,
    ) -> None:
        super().__init__(root, region)
        self._team, self._depth, self._source, self._step = team, depth, source, step
        self._early: dict[Path, list[FoamField]] = {}
        """Fields that were read before the mesh was complete, by their files in a folder."""
        self._whole: CaseMesh | None = None
        folder = self.mesh_folder(self._times[-1]).relative_to(self._first)
        cells = team.spread(self.processors.cells(folder) if team.rank == 0 else None)
        if cells is None:
            raise IndivisibleMeshError(_NO_ADDRESSES)
        self.processors.chosen = range(*ends_of(cells, load, team.size)[team.rank :][:2])

    def mesh(self, time: str) -> CaseMesh:
        """Read the mesh at a time; see :meth:`~foamprb.flow.read.openfoam.Case.mesh`.

        Raises
        ------
        IndivisibleMeshError
            The folders have no addressing files, or see :func:`hold_part`; or some patches are coupled in
            another way than ``cyclic`` ones.
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
        depth = self._layers(pieces, time)
        part = hold_part(own_cells, surfaces, ranges, n_internal, depth, team, str(folder))
        of_cells = np.zeros(len(part.cells), dtype=np.int32)
        for number, address in zip(self.processors.chosen, addresses, strict=True):
            of_cells[np.searchsorted(part.cells, address.cells)] = number
        self.halo, mesh = Halo(part, team, Folders(self.processors.chosen, of_cells)), part.mesh
        counts, first = np.diff(mesh.patch_start).tolist(), (mesh.n_internal + mesh.patch_start).tolist()
        infos = [*self._patches, PatchInfo(CUT.name, CUT.type, 0, 0, "", Transform(), {})]
        patches = tuple(p._replace(faces=n, start=k) for p, n, k in zip(infos, counts, first, strict=False))
        self._local = patches
        require_volumes(mesh, folder)
        require_patch_shapes(mesh, folder)
        self._whole, self._files = CaseMesh(mesh, patches, tuple(notes_of_types(patches))), files
        return self._whole

    def _layers(self, pieces: Sequence[Piece], time: str) -> int:
        """Return the number of layers that the fluid at a time does not cross; eddies drift by less."""
        if self._step == 0.0 or (self._source.relative and read_rotations(self.root, self.region)):
            return self._depth
        name = self._source.velocity
        fields = self._early[Path(time) / self.region / name] = self._read(time, name, VELOCITY_FIELD)
        eddies: list[Floats] = [np.zeros(1)] * len(pieces)
        if self._source.turbulent:
            with suppress(InputError):
                eddies = [largest_eddies(field.cells[:, 0]) for field in self._read(time, "k", K_FIELD)]
        rates = [_rate(*given) for given in zip(pieces, fields, eddies, strict=True)]
        fastest = max(self._team.of_all(max(rates, default=0.0)))
        return max(self._depth, layers_over((1.0 + _ROUND_OFF) * fastest * self._step))

    def _read(self, time: str, name: str, kind: Kind) -> list[FoamField]:
        """Read a field of each processor of this node."""
        file, processors = Path(time) / self.region / name, self.processors
        if file in self._early:
            return self._early.pop(file)
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
        assert self.halo is not None
        fields = self._read(time, name, kind)
        numbers = self.halo.part.cells
        cells = np.zeros((len(numbers), fields[0].cells.shape[1]))
        for part, field in zip(self._parts, fields, strict=True):
            cells[np.searchsorted(numbers, part.cells)] = field.cells
        self.halo.fill("cells", cells)
        entries = {}
        for index, patch in enumerate(self._patches):
            entry = self._joined(fields, index)
            if entry is not None:
                entries[patch.name] = entry
        return fields[0]._replace(cells=cells, patches=entries)

    def _joined(self, fields: list[FoamField], index: int) -> PatchField | None:
        """Return the entry of a patch with values at its faces here; None if no processor has an entry."""
        halo, team = self.halo, self._team
        assert halo is not None
        pieces: list[tuple[NDArray[Any], PatchField]] = []
        for part, field in zip(self._parts, fields, strict=True):
            for patch in (part.patches[k] for k in np.flatnonzero(part.of_patches == index).tolist()):
                entry = field.of(patch)
                if entry is not None:
                    pieces.append((part.faces[patch.start : patch.start + patch.faces], entry))
        own = [
            (len(faces) > 0, entry._replace(fields={key: v[:0] for key, v in entry.fields.items()}))
            for faces, entry in pieces
        ]
        everywhere = [piece for listed in team.of_all(own) for piece in listed]
        filled = [entry for some, entry in everywhere if some] or [entry for _, entry in everywhere]
        if not filled:
            return None
        keys = sorted(set.intersection(*(set(entry.fields) for entry in filled)))
        mesh, values = halo.part.mesh, {}
        numbers = halo.part.faces[mesh.n_internal :][: mesh.patch_start[-2]]
        for key in keys:
            whole: Floats = np.zeros((len(numbers), filled[0].fields[key].shape[1]))
            for faces, entry in pieces:
                if len(faces):
                    whole[np.searchsorted(numbers, faces)] = entry.fields[key]
            halo.fill("boundary", whole)
            values[key] = whole[mesh.patch_start[index] : mesh.patch_start[index + 1]]
        if filled[0].type == FLOW_RATE and "value" not in keys:
            values[AREA] = np.array([[self._area(index)]])
        joined: PatchField = filled[0]._replace(pattern=False, fields=values)
        return joined

    def _area(self, index: int) -> float:
        """Return the area of a patch of the whole mesh, m², summed in its order."""
        assert self.halo is not None
        part, mesh = self.halo.part, self.halo.part.mesh
        rows = np.arange(*mesh.patch_start[index : index + 2])
        rows = rows[part.own[mesh.owner[mesh.n_internal + rows]]]
        own = part.faces[mesh.n_internal + rows], np.linalg.norm(mesh.boundary_areas[rows], axis=1)
        numbers, areas = (np.concatenate(column) for column in zip(*self.halo.of_all(own), strict=True))
        return float(areas[np.argsort(numbers)].sum())

    def zones(self, time: str) -> Mapping[str, NDArray[np.int64]]:
        """Read the cells here of each zone by name; see :meth:`~foamprb.flow.read.openfoam.Case.zones`."""
        assert self.halo is not None
        zones = join_zones(self.processors, self.mesh_folder(time), self._parts)
        names = {name for listed in self._team.of_all(list(zones)) for name in listed}
        found, cells, nothing = {}, self.halo.part.cells, np.empty(0, dtype=np.int64)
        for name in sorted(names):
            inside = np.zeros(len(cells), dtype=bool)
            inside[np.searchsorted(cells, zones.get(name, nothing))] = True
            self.halo.fill("cells", inside)
            found[name] = np.flatnonzero(inside)
        return found


def _rate(piece: Piece, field: FoamField, eddies: Floats) -> float:
    """Return the largest number of cells of a processor that the fluid passes in a time, 1/s."""
    n, nothing = piece.n_cells, np.empty(0, dtype=np.int32)
    faces = Faces(piece.start, piece.lists, piece.owner, piece.neighbour, nothing, nothing)
    places = piece.points - piece.points.mean(axis=0)
    shares = np.einsum("fi,fi->f", *measured(places, faces)) / 3.0
    volumes = np.bincount(piece.owner, shares, n)
    volumes -= np.bincount(piece.neighbour, shares[: len(piece.neighbour)], n)
    u, further = np.broadcast_to(field.cells, (n, 3)), np.broadcast_to(eddies, n)
    # Cells without volume are refused later.
    some = volumes > _ROUND_OFF * volumes.mean()
    return float((largest_fluxes(places, faces, u, further)[some] / volumes[some]).max(initial=0.0))


def ends_of(cells: Labels, load: Labels | None, nodes: int) -> list[int]:
    """Return where the processor folders of each node end; see :func:`even_ends`.

    Parameters
    ----------
    cells, load
        Cells and particles of each folder. Without particles the cells count alone. Otherwise all cells count
        as much as all particles, so that no node has more than about two even shares of either.
    nodes
        Number of nodes.
    """
    if load is None or not load.any():
        return even_ends(cells, nodes)
    shares = cells / max(int(cells.sum()), 1) + load / load.sum()
    return even_ends(np.rint(_FINE * shares).astype(np.int64), nodes)
