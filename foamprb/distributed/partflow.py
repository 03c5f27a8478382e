"""Flow on the cells that a node of a parallel run holds."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.turbulence import fluctuation_size
from foamprb.compile.link import link
from foamprb.distributed.fragment import Labels
from foamprb.distributed.submesh import BEYOND, Halo, Ranges
from foamprb.flow.base import Floats, Ints, PatchFaces
from foamprb.flow.mesh.arrays import MeshArrays
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.geometry import inward_normals, largest_fluxes
from foamprb.flow.mesh.lists import Index, ragged, starts
from foamprb.flow.mesh.locator import cell_boxes, depth_of
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import Tree, build_tree
from foamprb.flow.meshflow import MeshFlow, Numbering, end_triangles, shortest_extent
from foamprb.flow.nodes import NodeValues
from foamprb.flow.series import SeriesFlow
from foamprb.flow.walls import Walls, walls_at

_ASIDE = 0.1
"""Distance up to which walls of other nodes are held at the start, over the diagonal of a node's cells."""


_LARGEST_EDDY = 5.0
"""Largest velocity of an eddy, in standard deviations, for which the layers are meant."""


def largest_eddies(k: Floats) -> Floats:
    """Return the largest velocities of eddies for which layers are meant, (n,), m/s, from k, m²/s²."""
    size: Floats = _LARGEST_EDDY * fluctuation_size(np.maximum(k, 0.0))
    return size


class PartFlow(MeshFlow):
    """Steady flow on a part of a mesh: the owned cells of a node, and the layers around them.

    A path that leaves the layers sets ``strayed`` of the arrays. All nodes call the constructor and
    :meth:`arrays` together. Hosts of owned cells have numbers in the whole mesh, see :meth:`numbers_of`.

    Parameters
    ----------
    halo
        The part, and the other nodes.
    arguments, options
        See :class:`MeshFlow`, with the mesh of the part.
    """

    def __init__(self, halo: Halo, *arguments: Any, **options: Any) -> None:
        self.halo = halo
        super().__init__(*arguments, **options)
        mesh = self.mesh
        self._close(*_ends(halo))
        owned = halo.part.owned
        totals = halo.of_all((int(owned.sum()), int(halo.part.points.max(initial=-1)) + 1))
        n_cells, n_points = sum(n for n, _ in totals), max(n for _, n in totals)
        ends = np.linspace(0, n_cells, halo.team.size + 1).astype(np.intp)
        counts = Ranges(halo.team, ends, halo.part.cells[owned]).put(np.diff(mesh.cell_start)[owned])
        tets = halo.of_all(int(counts.sum()))
        first = starts(counts)[:-1].astype(np.int64) + sum(tets[: halo.team.rank])
        self._first_tet = Ranges(halo.team, ends, halo.part.cells).get(first)
        """(n_cells,) first tetrahedron of each cell in the whole mesh."""
        self.counts = n_cells, n_points, sum(tets)
        """Cells, points and tetrahedra of the whole mesh."""

    def _extents(self, mesh: Mesh) -> tuple[tuple[Floats, Floats], float]:
        ends = self.halo.of_all((mesh.points.min(axis=0), mesh.points.max(axis=0)))
        bounds = np.min([low for low, _ in ends], axis=0), np.max([high for _, high in ends], axis=0)
        rows = self._own_triangles(mesh)
        rows = rows[np.isin(rows, end_triangles(mesh))]
        return bounds, shortest_extent(mesh.points[mesh.triangles[rows]], self.halo.of_all)

    def _tree(self, mesh: Mesh) -> Tree:
        part, boxes = self.halo.part, cell_boxes(mesh)
        usable = np.flatnonzero(part.layer <= part.depth).astype(np.int32)
        tree = build_tree(boxes[usable])
        self._usable_box = tree.boxes[1].copy()
        ends = self.halo.of_all((boxes[part.owned, :3].min(axis=0), boxes[part.owned, 3:].max(axis=0)))
        tree.boxes[1, :3] = np.min([low for low, _ in ends], axis=0)
        tree.boxes[1, 3:] = np.max([high for _, high in ends], axis=0)
        return tree._replace(leaves=np.where(tree.leaves < 0, np.int32(-1), usable[tree.leaves]))

    def _numbering(self) -> Numbering:
        mesh, part = self.mesh, self.halo.part
        triangles = self._own_triangles(mesh)
        nodes = np.concatenate([part.points, self.counts[1] + part.cells])
        return Numbering(part.owned, part.cells, nodes, triangles, self._faces_of(mesh, triangles))

    def _own_triangles(self, mesh: Mesh) -> Index:
        """Return the boundary triangles of owned cells."""
        cells = mesh.tets[mesh.triangle_tet, 0] - mesh.n_points
        return np.flatnonzero(self.halo.part.owned[cells] & (mesh.triangle_patch != BEYOND))

    def _faces_of(self, mesh: Mesh, triangles: Index) -> Labels:
        """Return the faces of boundary triangles in the whole mesh."""
        return self.halo.part.faces[mesh.n_internal + mesh.triangle_face[triangles]]

    def _close(self, rows: Index, lost: Index) -> None:
        """End paths behind some tetrahedra, and at triangles outside the usable layers."""
        mesh, arrays = self.mesh, self._arrays
        n, triangles = len(arrays.triangles), mesh.tets[rows, 1:]
        arrays.neighbours[rows, 0] = -1 - np.arange(n, n + len(rows), dtype=np.int32)
        patches = np.concatenate([arrays.triangle_patch, np.full(len(rows), BEYOND, dtype=np.int32)])
        patches[lost] = BEYOND
        normals = inward_normals(mesh.points, triangles, np.ones((len(rows), 3)))
        self._arrays = arrays._replace(
            triangles=np.concatenate([arrays.triangles, triangles]),
            triangle_patch=patches,
            triangle_normals=np.concatenate([arrays.triangle_normals, normals]),
            triangle_tet=np.concatenate([arrays.triangle_tet, rows.astype(np.int32)]),
            across=np.concatenate([arrays.across, np.zeros((len(rows), 2), dtype=np.int32)]),
        )
        self._n_ends = n + len(rows)
        box = self._usable_box
        self._hold_walls(min(self.halo.of_all(_ASIDE * float(np.linalg.norm(box[3:] - box[:3])))))

    def _hold_walls(self, reach: float) -> None:
        """Add all nodes' walls within a distance (m) of usable cells, in the order of the whole mesh."""
        mesh, arrays, n, halo = self.mesh, self._arrays, self._n_ends, self.halo
        rows = self._own_triangles(mesh)
        walls, faces, corners = walls_at(mesh, rows), self._faces_of(mesh, rows), mesh.triangles[rows]
        low, high = walls.corners.min(axis=1), walls.corners.max(axis=1)
        self._reach = reach
        parcels = []
        for box in halo.of_all(self._usable_box):
            near = np.all((high >= box[:3] - self._reach) & (low <= box[3:] + self._reach), axis=1)
            parcels.append((faces[near], halo.part.points[corners[near]], walls.take(near)))
        received = halo.team.exchange(parcels)
        order = np.argsort(np.concatenate([numbers for numbers, *_ in received]), kind="stable")
        self._all_walls = walls = Walls(
            *(np.concatenate(arrays)[order] for arrays in zip(*(part for *_, part in received), strict=True))
        )
        points = np.concatenate([points for _, points, _ in received])[order].reshape(-1)
        _, first, place = np.unique(points, return_index=True, return_inverse=True)
        count, nodes, n_nodes = len(first), arrays.nodes, mesh.n_points + mesh.n_cells
        if len(nodes) == n_nodes:
            # In place at the start, when a second copy would be the peak of memory.
            nodes.resize((n_nodes + count, nodes.shape[1]), refcheck=False)
        else:
            nodes = np.concatenate([nodes[:n_nodes], np.zeros((count, nodes.shape[1]))])
        nodes[n_nodes:, :3] = walls.corners.reshape(-1, 3)[first]
        of_walls = (n_nodes + place.reshape(-1, 3)).astype(np.int32)
        self._arrays = arrays._replace(
            nodes=nodes,
            triangles=np.concatenate([arrays.triangles[:n], of_walls]),
            triangle_patch=np.concatenate([arrays.triangle_patch[:n], walls.patches]),
            triangle_normals=np.concatenate([arrays.triangle_normals[:n], walls.normals]),
        )

    def _walls(self, patches: Sequence[int], reach: float) -> tuple[Ints, Walls, Walls | None]:
        """See :meth:`MeshFlow._walls`; the walls of all nodes, in the order of the whole mesh."""
        if reach > self._reach:
            self._hold_walls(2.0 * reach)
        some = np.flatnonzero(np.isin(self._all_walls.patches, patches))
        return (self._n_ends + some).astype(np.int32), self._all_walls.take(some), None

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """See :meth:`MeshFlow.move`; with the fields that are sampled."""
        super().move(place)
        self._first_tet = place(self._first_tet)
        self.field_table = place(self.field_table)

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """See :meth:`MeshFlow.at_nodes`."""
        time, u, l = super().at_nodes()
        n = self.mesh.n_points + self.mesh.n_cells
        return time, u[:n], l[:n]

    def in_space(self, *walls: Any) -> Any:
        """Return the arrays for the kernels, without fields of several times; see :meth:`MeshFlow.arrays`."""
        return MeshFlow.arrays(self, *walls)

    def forget_walls(self) -> None:
        """Free the lists of walls that :meth:`arrays` returned last."""
        self._near = None

    def numbers_of(self, hosts: NDArray[Any]) -> Labels:
        """Return the numbers of tetrahedra in the whole mesh, (n,); −1 stays −1."""
        cells = self.cell_of(np.maximum(hosts, 0).astype(np.int32))
        numbers = self._first_tet[cells] + hosts - self.mesh.cell_start[cells]
        return np.where(hosts < 0, -1, numbers)

    def own_hosts(self, numbers: Labels) -> tuple[Index, Ints]:
        """Return the rows of tetrahedra in owned cells, and the indices of these tetrahedra here."""
        cells = np.searchsorted(self._first_tet, numbers, side="right") - 1
        held = np.maximum(cells, 0)
        offset = numbers - self._first_tet[held]
        start = self.mesh.cell_start
        here = (numbers >= 0) & (cells >= 0) & (offset < np.diff(start)[held]) & self.halo.part.owned[held]
        rows = np.flatnonzero(here)
        return rows, (start[held[rows]] + offset[rows]).astype(np.int32)

    def locate_own(self, points: Floats) -> tuple[Index, Labels, Floats]:
        """Return the rows of points in owned cells, the numbers of their hosts, and the depths there.

        Of hosts of other nodes at the same place the one with the largest :func:`depth_of` counts, then the
        first.
        """
        hosts = self.locate(points)
        inside = np.flatnonzero(hosts >= 0)
        rows = inside[self.halo.part.owned[self.cell_of(hosts[inside])]]
        depths = np.empty(len(rows))
        link(_depths)(self._arrays, points[rows], hosts[rows], depths)
        return rows, self.numbers_of(hosts[rows]), depths

    def at_own(self, name: str, numbers: Labels, points: Floats | None = None, *t: float) -> tuple[Any, ...]:
        """Return the rows of owned hosts, and the results of a method there."""
        rows, hosts = self.own_hosts(numbers)
        values = getattr(self, name)(*((hosts,) if points is None else (points[rows], hosts, *t)))
        return rows, *(values if isinstance(values, tuple) else (values,))

    def fields_of_own(
        self, points: Floats, numbers: Labels, t: Floats, start: float, end: float
    ) -> tuple[Index, Floats]:
        """Return the rows of owned hosts, and the fields there at times t, from ``start`` to ``end``."""
        rows, hosts = self.own_hosts(numbers)
        fields = self.fields(start, end).at(points[rows], hosts, t[rows])
        return rows, np.concatenate([field.values for field in fields.values()], axis=1)

    def own_cells(self, low: int, high: int) -> tuple[Labels, Floats]:
        """Return numbers of owned cells from ``low`` to before ``high``, and their volumes, m³."""
        cells = self.halo.part.cells
        rows = np.flatnonzero(self.halo.part.owned & (cells >= low) & (cells < high))
        return cells[rows], self.mesh.volumes[rows]

    def own_faces(self) -> tuple[Labels, Ints, Labels, Floats, Floats]:
        """Return the boundary faces of owned cells: numbers, patches, cells, areas, m², and centres, m."""
        part, mesh = self.halo.part, self.mesh
        sizes, counts = self.mesh_sizes(), np.diff(mesh.patch_start)[:-1]
        patches = np.repeat(np.arange(len(counts), dtype=np.int32), counts)
        rows = np.flatnonzero(part.owned[sizes.owner[: len(patches)]])
        cells, faces = part.cells[sizes.owner[rows]], part.faces[mesh.n_internal + rows]
        return faces, patches[rows], cells, sizes.areas[rows], sizes.centres[rows]

    def own_zone(self, name: str | None) -> tuple[Floats, Labels]:
        """Return volumes and numbers of a zone's tetrahedra in owned cells."""
        zone = self.cell_zone(name)
        owned = self.halo.part.owned[self.cell_of(zone.hosts)]
        return zone.volumes[owned], self.numbers_of(zone.hosts[owned])

    def every_node(self, stride: int) -> tuple[Labels, NodeValues]:
        """Return nodes by their numbers in the whole mesh, multiples of ``stride``, and the values there."""
        part = self.halo.part
        numbers = np.concatenate([part.points, self.counts[1] + part.cells])
        rows = np.flatnonzero(numbers % stride == 0)
        return numbers[rows], self.values_at_nodes().take(rows)

    @property
    def rate(self) -> float:
        """Largest number of owned cells that the fluid passes in a time, 1/s."""
        return self._rate_of(self.at_nodes()[1], self.turbulence_at_nodes())

    @property
    def steepness(self) -> float:
        """Largest number of owned cells on a length, 1/m."""
        n = self.mesh.n_cells
        return self._most_passed(np.zeros((n, 3)), np.ones(n))

    def _rate_of(self, u: Floats, turbulence: Floats) -> float:
        """Return :attr:`rate` for the velocity (n, 3) and turbulence (n, 8), if any, at points and cells."""
        cells, eddies = slice(self.mesh.n_points, None), np.zeros(self.mesh.n_cells)
        if len(turbulence):
            eddies = largest_eddies(turbulence[cells, 0]) + np.linalg.norm(turbulence[cells, 5:], axis=1)
        return self._most_passed(u[cells], eddies)

    def _most_passed(self, u: Floats, further: Floats) -> float:
        """Return the largest flux through a face over the volume, of owned cells, 1/s.

        Cells have the velocities u (n, 3), m/s, and further ones in any direction, (n,).
        """
        mesh = self.mesh
        of_faces = mesh.face_start, mesh.face_points, mesh.owner, mesh.neighbour
        faces = Faces(*of_faces, mesh.cell_face_start, mesh.cell_faces)
        most = largest_fluxes(mesh.points, faces, u, further)
        return float((most / mesh.volumes)[self.halo.part.owned].max(initial=0.0))

    def places_in_whole(self) -> tuple[Labels, Ints, Labels, Ints]:
        """Return the columns of :class:`~foamprb.distributed.node.PlacesInWhole`."""
        halo = self.halo
        return halo.part.cells, halo.part.node, self._first_tet, self.mesh.cell_start

    def own_patch_faces(self, name: str, t: float) -> tuple[Labels, PatchFaces]:
        """Return the triangles of a patch at owned cells, with the numbers of faces and hosts."""
        mesh, v = self.mesh, self.patch_faces(name, t)
        at = np.flatnonzero(mesh.triangle_patch == [patch.name for patch in self.patches].index(name))
        mine = self.halo.part.owned[self.cell_of(mesh.triangle_tet[at])]
        owned = PatchFaces(v.vertices[mine], v.areas[mine], v.normals[mine], v.velocity[mine], v.hosts[mine])
        numbers: Any = self.numbers_of(owned.hosts)
        return self._faces_of(mesh, at[mine]), owned._replace(hosts=numbers)


class PartSeries(PartFlow, SeriesFlow):
    """Flow that changes in time on a part of a mesh; all nodes load times together."""

    def __init__(
        self, halo: Halo, mesh: Mesh, times: Sequence[float], *arguments: Any, keep: int = 0, **options: Any
    ) -> None:
        super().__init__(halo, mesh, times, *arguments, keep=min(halo.of_all(keep)), **options)
        self._rates: dict[int, float] = {}
        self._place: Callable[..., NDArray[Any]] = lambda array, _: array

    @property
    def rate(self) -> float:
        """See :class:`PartFlow`; at the loaded times, and so between them."""
        return max(self._rates[self._index(level)] for level in self._levels)

    def move(self, place: Callable[..., NDArray[Any]]) -> None:
        """See :meth:`MeshFlow.move`; ``place`` has the array of before that is no longer used, too."""
        super().move(place)
        self._place = place

    def _placed(self, array: NDArray[Any], before: NDArray[Any]) -> NDArray[Any]:
        return self._place(array, before)

    def _fetch(self, index: int) -> None:
        super()._fetch(index)
        if index not in self._rates:
            fields = self._fields[self._in_memory[index]]
            self._rates[index] = self._rate_of(*self._velocity_and_turbulence(fields))

    def _take(self, index: int) -> tuple[Any, ...]:
        """Read the fields at a time; nodes exchange values meanwhile."""
        return self._read(index)

    def _prefetch(self, index: int) -> Any:
        """No-op: collectives must not overlap."""


def _depths(flow: MeshArrays, points: Floats, hosts: Ints, depths: Floats) -> None:
    for i in range(points.shape[0]):
        depths[i] = depth_of(flow, hosts[i], (points[i, 0], points[i, 1], points[i, 2]))


def _ends(halo: Halo) -> tuple[Index, Index]:
    """Return the tetrahedra behind which the usable layers end, and the boundary triangles outside them."""
    part, mesh = halo.part, halo.part.mesh
    inside, last = part.layer <= part.depth, np.flatnonzero(part.layer == part.depth)
    rows = ragged(mesh.cell_start[last], np.diff(mesh.cell_start)[last])
    beyond = mesh.neighbours[rows, 0]
    rows = rows[(beyond >= 0) & ~inside[mesh.tets[beyond, 0] - mesh.n_points]]
    return rows, np.flatnonzero(~inside[mesh.tets[mesh.triangle_tet, 0] - mesh.n_points])
