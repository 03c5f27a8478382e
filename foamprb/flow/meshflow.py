"""Steady flow on a mesh."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from copy import copy
from functools import cache
from typing import Any, Self

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.compile.link import link
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import Caveat, Floats, Ints, PatchFaces, Tetrahedra
from foamprb.flow.curvatures import columns_of_third, third_order
from foamprb.flow.fields import FieldColumns, Fields, fields_on
from foamprb.flow.fluxes import free_nodes
from foamprb.flow.jumps import count_jumps, relative_jumps, roughness
from foamprb.flow.kernels import named
from foamprb.flow.mesh.arrays import FREE, GRADIENT, VELOCITY, MeshArrays, no_mesh
from foamprb.flow.mesh.folds import FOLDED, grade
from foamprb.flow.mesh.interfaces import motions_of_patches, triangles_across
from foamprb.flow.mesh.layer import divide, layer_of, turn_nodes
from foamprb.flow.mesh.locator import cell_boxes, locate
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import Tree, build_tree, pairs_near
from foamprb.flow.nodes import Ends, Function, NodeValues, ends_over, stride_over
from foamprb.flow.patches import PatchKind
from foamprb.flow.planes import walls
from foamprb.flow.sampling import sample_with, viscosity_with, with_velocity
from foamprb.flow.viscosity import viscosity
from foamprb.flow.walk import (
    cell_volume,
    cross,
    curvature,
    normal,
    recover,
    sample,
    sample_ahead,
    turbulence,
    walk,
    walk_on,
)
from foamprb.flow.wall_lists import near_walls, seen_walls, wall_tree
from foamprb.flow.walls import Walls, gap, images_of_walls, walls_at
from foamprb.flow.wedge import is_wedge
from foamprb.memory import sparse_zeros, trim

_NO_END = frozenset({PatchKind.MIRROR, PatchKind.PASSABLE})
"""Kinds of patches beyond which the flow continues."""
_FACING = 0.01
"""Fraction of the boundary area that must face along an axis for the flow to end there."""


def shortest_extent(mesh: Mesh) -> float:
    """Return the shortest extent of a flow along axes on which it ends, at walls and openings, m."""
    ends = np.array([patch.kind not in _NO_END for patch in mesh.patches], dtype=bool)
    corners = mesh.points[mesh.triangles[ends[mesh.triangle_patch]]]
    areas = np.abs(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])).sum(axis=0)
    points = corners.reshape(-1, 3)
    extents = points.max(axis=0, initial=-np.inf) - points.min(axis=0, initial=np.inf)
    return float(extents[areas > _FACING * areas.sum()].min(initial=np.inf))


def graded(mesh: Mesh, nodes: Floats, most: int) -> tuple[NDArray[np.uint8], Floats]:
    """Return the marks of cells, and the boxes of up to ``most`` inverted tetrahedra; see :func:`grade`."""
    folds, folded = np.zeros(mesh.n_cells, dtype=np.uint8), np.empty((most, 6))
    n = link(grade)(nodes, mesh.tets, mesh.n_points, folds, folded)
    return folds, folded[:n].copy()


def folds_of(
    mesh: Mesh, marks: NDArray[np.uint8], folded: Floats, tree: Tree, boxes: Floats, off: float = 0.0
) -> dict[str, Any]:
    """Return ``folds``, ``rim_start`` and ``rim`` of :class:`MeshArrays`, by a tree over boxes of cells.

    Boundary triangles are up to ``off``, m, from their places in the mesh.
    """
    start, rim = np.zeros(mesh.n_cells + 1, dtype=np.int32), np.empty(0, dtype=np.int32)
    if len(folded) > 0:
        marks[np.diff(pairs_near(boxes, tree, folded)[0]) > 0] = FOLDED
        corners = mesh.points[mesh.triangles]
        targets = np.concatenate([corners.min(axis=1) - off, corners.max(axis=1) + off], axis=1)
        where, triangles = pairs_near(boxes, tree, targets)
        counts = np.diff(where)
        rim = triangles[np.repeat(marks == FOLDED, counts)]
        np.cumsum(np.where(marks == FOLDED, counts, 0), out=start[1:])
    return {"folds": marks, "rim_start": start, "rim": rim}


LISTS = ("near", "wall_", "seen")
"""Prefixes of the names of arrays for lists of walls."""
AT_ONCE = 1 << 20
"""Number of tetrahedra per chunk when volumes are computed."""


class MeshFlow:
    """Flow given by u and ∇u at the nodes of a mesh, and the fluxes through its faces.

    Parameters
    ----------
    mesh
        The mesh.
    u, l
        (n_nodes, 3) in m/s and (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j in 1/s; mesh points, then cell centres. None
        of a flow that has them in other arrays.
    notes
        Sentences for the user about the flow.
    zones
        Returns the cells of each zone by name; called when a zone is requested.
    time
        Name of the time that was read, if there are times.
    turbulence
        (n_nodes, 8): k, ε, ∇k and ∇(k²/3ε) at the nodes, if they were read.
    fluxes
        (n_faces,) fluxes that keep volume, m³/s, by :class:`foamprb.flow.fluxes.Conservation`; without them u
        is not corrected.
    viscosity
        (n_nodes, 4): a field of the viscosity and its gradient, if it was read.
    curvatures
        (n_nodes, 18) second derivatives of u, by :func:`foamprb.flow.curvatures.mean_curvatures`.
    """

    kernels = named(
        sample, sample_ahead, curvature, walk, walk_on, gap, walls, normal, cross, recover,
        turbulence, viscosity, cell_volume
    )  # fmt: skip
    lists_walls = True
    axisymmetric = True
    """Whether the flow in a wedge one cell thick is that of its middle plane (:mod:`foamprb.flow.wedge`)."""

    def __init__(
        self,
        mesh: Mesh,
        u: Floats | None,
        l: Floats | None,
        notes: Iterable[str] = (),
        zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
        time: str = "",
        turbulence: Floats | None = None,
        fluxes: Floats | None = None,
        viscosity: Floats | None = None,
        curvatures: NDArray[np.float32] | None = None,
    ) -> None:
        layer = layer_of(mesh)
        layer = layer if layer is None or not len(layer.axis) or self.axisymmetric else None
        self._division = None if layer is None else divide(mesh, layer)
        if self._division is not None:
            mesh = self._division.mesh
            given = u, l, turbulence, fluxes, viscosity, curvatures
            u, l, turbulence, fluxes, viscosity, curvatures = (
                None if values is None else self.widened(values) for values in given
            )
            if u is not None and l is not None:
                self._turn(u, l)
            curvatures = None if curvatures is None else self._turned_curvatures(curvatures)
        self._time = time
        self.field_columns: tuple[FieldColumns, ...] = ()
        self.field_table: NDArray[np.float64] = np.empty((0, 0))
        self.mesh = mesh
        self._zones = zones
        self.patches = mesh.patches
        self.notes = tuple(notes)
        if mesh.inverted:
            self.notes += (
                f"{mesh.inverted} of {len(mesh.tets)} tetrahedra are inverted: the mesh has cells "
                "far from convex there, and paths through them take longer.",
            )
        self.bounds = mesh.points.min(axis=0), mesh.points.max(axis=0)
        self.width = shortest_extent(mesh)
        boxes = cell_boxes(mesh)
        tree = build_tree(boxes)
        nodes = np.empty((mesh.n_points + mesh.n_cells, VELOCITY if u is None or l is None else 16))
        if u is not None and l is not None:
            nodes[:, VELOCITY:GRADIENT], nodes[:, GRADIENT:] = u, l.reshape(-1, 9)
        nodes[: mesh.n_points, :3], nodes[mesh.n_points :, :3] = mesh.points, mesh.centres
        nodes[:, FREE] = free_nodes(mesh)
        self.span = (-np.inf, np.inf)
        self._near: tuple[Any, MeshArrays] | None = None
        self._roughness: dict[int, float] = {}
        """Roughness at some times, by their indices."""
        folds = folds_of(mesh, *graded(mesh, nodes, mesh.inverted), tree, boxes)
        across, partners = triangles_across(mesh)
        self._arrays = no_mesh()._replace(
            nodes=nodes,
            n_points=mesh.n_points,
            tets=mesh.tets,
            neighbours=mesh.neighbours,
            cell_start=mesh.cell_start,
            tree_boxes=tree.boxes,
            tree_cells=tree.leaves,
            triangles=mesh.triangles,
            triangle_patch=mesh.triangle_patch,
            triangle_normals=mesh.triangle_normals,
            triangle_tet=mesh.triangle_tet,
            across=across,
            partners=partners,
            motions=motions_of_patches(mesh),
            **folds,
            near_start=np.zeros(mesh.n_cells + 1, dtype=np.int32),
            turbulence=np.empty((0, 8)) if turbulence is None else turbulence,
            viscosity=np.empty((0, 4)) if viscosity is None else viscosity,
            curvatures=np.empty((0, 18), dtype=np.float32) if curvatures is None else curvatures,
            wall_boxes=np.empty((2, 6)),
            seen_start=np.zeros(mesh.n_cells + 1, dtype=np.int32),
            correction=sparse_zeros((0 if fluxes is None else len(mesh.tets), 4), np.float32),
            phi=np.empty(0) if fluxes is None else fluxes,
            owner=mesh.owner,
            face_start=mesh.face_start,
            cell_face_start=mesh.cell_face_start,
            cell_faces=mesh.cell_faces,
            layer=np.empty(0) if layer is None else np.concatenate([layer.normal, layer.axis]),
        )

    def widened(self, values: NDArray[np.generic]) -> NDArray[Any]:
        """Return values at the nodes or fluxes of the given mesh on that of the flow."""
        return values if self._division is None else self._division.widened(values)

    def _turn(self, u: Floats, l: Floats, back: bool = False) -> None:
        """Turn velocities and gradients at the nodes of a wedge into its middle plane, or back, in place."""
        if self._division is not None:
            # The centres of faces have the values of cells, in the middle plane.
            turns = self._division.turns[: None if back else self._division.n_points]
            turn_nodes(turns, u, back)
            turn_nodes(turns, l, back)

    def _turned_curvatures(self, values: NDArray[np.float32]) -> NDArray[np.float32]:
        """Return second derivatives at the nodes, (n_nodes, 18), in a wedge turned into its middle plane."""
        if self._division is None or not len(self._division.turns):
            return values
        tensors = third_order(values)
        turn_nodes(self._division.turns[: self._division.n_points], tensors)
        return columns_of_third(tensors)

    def _turned_back(self, fields: Floats) -> tuple[Floats, Floats]:
        """Return u (n, 3) and ∇u (n, 9) at the nodes from columns of both, in a wedge turned to each node."""
        if self._division is None or not len(self._division.turns):
            return fields[:, :3], fields[:, 3:]
        u, l = fields[:, :3].copy(), fields[:, 3:].reshape(-1, 3, 3).copy()
        self._turn(u, l, back=True)
        return u, l.reshape(-1, 9)

    @staticmethod
    def nothing() -> MeshArrays:
        """Return the arrays of an empty flow, for which the kernels can be compiled."""
        return no_mesh()

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is steady."""
        return float(np.inf)

    def arrays(
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> MeshArrays:
        """Return the arrays for the kernels.

        Bodies of semi-axes up to ``reach`` (m) find the ``touchable`` patches, given by index; by default
        these are the walls. Patches that are ``seen`` are found as planes up to a distance of ``sight`` (m).
        """
        if touchable is None:
            touchable = [k for k, patch in enumerate(self.patches) if patch.kind is PatchKind.WALL]
        touched = tuple(touchable) if reach > 0.0 else ()
        known = tuple(seen) if sight > 0.0 else ()
        if not (touched or known):
            return self._arrays
        key = reach, touched, sight, known
        if self._near is None or self._near[0] != key:
            self._near = key, self._with_walls(reach, touched, sight, known)
        return self._near[1]

    def _with_walls(
        self, reach: float, touchable: Sequence[int], sight: float, seen: Sequence[int]
    ) -> MeshArrays:
        """Return the arrays with the walls that bodies touch and see, and their images at coupled patches."""
        mesh, arrays = self.mesh, self._arrays
        names = np.flatnonzero(np.isin(mesh.triangle_patch, [*touchable, *seen])).astype(np.int32)
        walls = walls_at(mesh, names)
        if mesh.couplings:
            images = images_of_walls(mesh, walls, max(reach if touchable else 0.0, sight if seen else 0.0))
            n, nodes, triangles = len(images.patches), len(arrays.nodes), len(arrays.triangles)
            beyond = np.zeros((3 * n, arrays.nodes.shape[1]))
            beyond[:, :3] = images.corners.reshape(-1, 3)
            names = np.concatenate([names, np.arange(triangles, triangles + n, dtype=np.int32)])
            walls = Walls(*(np.concatenate([own, other]) for own, other in zip(walls, images, strict=True)))
            arrays = arrays._replace(
                nodes=np.concatenate([arrays.nodes, beyond]),
                triangles=np.concatenate(
                    [arrays.triangles, np.arange(nodes, nodes + 3 * n, dtype=np.int32).reshape(-1, 3)]
                ),
                triangle_patch=np.concatenate([arrays.triangle_patch, images.patches]),
                triangle_normals=np.concatenate([arrays.triangle_normals, images.normals]),
            )
        boxes = cell_boxes(mesh)
        for patches in (touchable, seen):
            some = np.isin(walls.patches, patches)
            if not some.any():
                continue
            tree = wall_tree(walls.corners[some], walls.normals[some], patches is not touchable)
            own = names[some]
            if patches is touchable:
                size = float(np.cbrt(np.median(mesh.volumes)))
                start, near = near_walls(tree, boxes, reach, own, size)
                leaves = np.where(tree.leaves < 0, np.int32(-1), own[tree.leaves])
                arrays = arrays._replace(
                    near_start=start, near=near, wall_boxes=tree.boxes, wall_leaves=leaves
                )
            else:
                start, found = seen_walls(tree, boxes, sight, own)
                arrays = arrays._replace(seen_start=start, seen=found)
        return arrays

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """Replace the constant arrays, without the lists of walls, by the copies that ``place`` returns.

        The arrays are replaced one by one, so that each is freed before the next is copied.
        """
        for name in self._arrays._fields:
            array = getattr(self._arrays, name)
            if not isinstance(array, np.ndarray) or name.startswith(LISTS):
                continue
            moved: dict[str, Any] = {name: place(array)}
            self._arrays = self._arrays._replace(**moved)
            if vars(self.mesh).get(name) is array:
                # Readers of further times hold the same mesh.
                setattr(self.mesh, name, moved[name])
            if self._near is not None and getattr(self._near[1], name) is array:
                self._near = self._near[0], self._near[1]._replace(**moved)
            del array
            trim()

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """Return the name of the time, and u (n, 3), m/s, and ∂u_i/∂x_j (n, 9), 1/s, at all nodes."""
        return self._time, *self._turned_back(self._arrays.nodes[:, VELOCITY:])

    def turbulence_at_nodes(self) -> Floats:
        """Return k, ε, ∇k and ∇(k²/3ε) at all nodes, (n, 8); no rows if they were not read."""
        return self._arrays.turbulence

    def viscosity(self, points: Floats, hosts: Ints, t: float) -> Floats:
        """Return the field of the viscosity at points (n, 3) in hosts (n,) at t, s, as it was read, (n,)."""
        return viscosity_with(self.kernels["viscosity"], self.arrays(), points, hosts, t)

    def viscosity_at_nodes(self) -> Floats:
        """Return the field of the viscosity at all nodes, as it was read, (n,)."""
        return self._arrays.viscosity[:, 0]

    def values_at_nodes(self) -> NodeValues:
        """Return the values at all nodes, at the first time."""
        return NodeValues(*self.at_nodes(), self.turbulence_at_nodes(), self.viscosity_at_nodes())

    def at_some_nodes(self) -> NodeValues:
        """See :meth:`foamprb.flow.base.Flow.at_some_nodes`."""
        values = self.values_at_nodes()
        return values.take(slice(None, None, stride_over(len(values.u))))

    def ends_at_nodes(self, function: Function) -> Ends:
        """See :meth:`foamprb.flow.base.Flow.ends_at_nodes`."""
        return ends_over(self.values_at_nodes(), function)

    def gradient_jumps(self) -> NDArray[np.int64]:
        """See :meth:`foamprb.flow.base.Flow.gradient_jumps`."""
        mesh, n = self.mesh, self.mesh.n_internal
        walls = np.array([patch.kind is PatchKind.WALL for patch in mesh.patches], dtype=bool)
        at_walls = np.zeros(mesh.n_cells, dtype=bool)
        at_walls[mesh.owner[n:][np.repeat(walls, np.diff(mesh.patch_start))]] = True
        l = self.values_at_nodes().l[mesh.n_points :]
        return count_jumps(l, mesh.owner[:n], mesh.neighbour, at_walls)

    def roughness(self) -> float:
        """See :meth:`foamprb.flow.base.Flow.roughness`."""
        return self._roughness_at(0, *self.at_nodes()[1:])

    def _roughness_at(self, index: int, u: Floats, l: Floats) -> float:
        """Return the roughness at the time of an index, of u (n, 3), m/s, and ∂u_i/∂x_j (n, 9), 1/s."""
        if index not in self._roughness:
            low, high = self.bounds
            least = float(np.linalg.norm(u, axis=1).max() / (high - low).max())
            rough = roughness(l, self.mesh.cell_point_start, self.mesh.cell_points, least)
            self._roughness[index] = rough
        return self._roughness[index]

    def with_jumps(self, part: float) -> Self:
        """Return the same flow with ∇u times 1 + part j, where j is the relative jump between cells there."""
        mesh, n = self.mesh, self.mesh.n_internal
        nodes = self._arrays.nodes.copy()
        at_cells = relative_jumps(nodes[mesh.n_points :, GRADIENT:], mesh.owner[:n], mesh.neighbour[:n])
        cells = np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_point_start))
        around = np.bincount(mesh.cell_points, minlength=mesh.n_points)
        at_points = np.bincount(mesh.cell_points, at_cells[cells], mesh.n_points) / np.maximum(around, 1)
        nodes[:, GRADIENT:] *= 1.0 + part * np.concatenate([at_points, at_cells])[:, None]
        other = copy(self)
        other._arrays, other._near = self._arrays._replace(nodes=nodes), None
        return other

    def fields(self, start: float, end: float) -> Fields:  # noqa: ARG002
        """Return the fields that are sampled, from time ``start`` to ``end``, s."""
        return self.loaded_fields()

    def loaded_fields(self) -> Fields:
        """Return the fields that are sampled."""
        return fields_on(self._arrays, self.field_table, self.field_columns)

    def traits(self) -> Mapping[str, ArrayLike]:
        """Return the arrays by which a resumed run recognises the flow, by name."""
        arrays, mesh = self._arrays, self.mesh
        return {
            "cells": mesh.cell_points,
            "patches": mesh.triangle_patch,
            "nodes": arrays.nodes,
            "turbulence": arrays.turbulence,
            "viscosity": arrays.viscosity,
            "fluxes": arrays.phi,
            **({"sampled": self._first_table} if self.field_columns else {}),
        }

    @property
    def _first_table(self) -> Floats:
        """Fields that are sampled, at the first time, (n_nodes, columns)."""
        return self.field_table

    def locate(self, points: Floats, t: ArrayLike | None = None) -> Ints:  # noqa: ARG002
        """Return the tetrahedra (n,) that hold the points (n, 3), −1 outside the mesh."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        hosts = np.empty(len(points), dtype=np.int32)
        _locator()(self._arrays, points, hosts)
        return hosts

    def overlap(self, most: int = 10_000) -> Sequence[Caveat]:
        """Return a caveat if cells overlap, by the centres of ``most`` cells; none in meshes with folds."""
        own = np.unique(np.linspace(0, self.mesh.n_cells - 1, most).astype(np.int32))
        # The centre is a corner of all tetrahedra of its own cell: any other that holds it is found first.
        found = self.cell_of(self.locate(self.mesh.centres[own]))
        twice = np.flatnonzero((found != own) & (self.mesh.inverted == 0))
        if len(twice) == 0:
            return ()
        return (
            Caveat(
                f"{len(twice)} of {len(own)} cell centres lie in another cell too: cells {own[twice[0]]} and "
                f"{found[twice[0]]} overlap. The flow is ambiguous there; do blocks of the mesh overlap?"
            ),
        )

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Return velocities (n, 3), m/s, and ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) in hosts (n,)."""
        return sample_with(sample, self._arrays, points, hosts, t)

    def cell_of(self, hosts: Ints) -> Ints:
        """Return the cells (n,) of tetrahedra."""
        cells: Ints = self.mesh.tets[hosts, 0] - np.int32(self.mesh.n_points)
        return cells

    def cell_size(self, hosts: Ints) -> Floats:
        """Return the cube root of the volume of the hosts' cells, (n,), m."""
        return np.cbrt(self.mesh.volumes[self.cell_of(hosts)])

    def cell_size_at(self, patches: Sequence[int]) -> float:
        """See :meth:`foamprb.flow.base.Flow.cell_size_at`."""
        hosts = self.mesh.triangle_tet[np.isin(self.mesh.triangle_patch, patches)]
        return float(np.median(self.cell_size(hosts))) if len(hosts) else 0.0

    def times_within(self, start: float, end: float) -> Sequence[float]:  # noqa: ARG002
        """Return no times: the flow is steady."""
        return ()

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """Return the triangles of a patch; InputError if there is no such patch."""
        names = [patch.name for patch in self.patches]
        if name not in names:
            raise InputError(f"patch {name} is not in the mesh. {suggestion(name, names)}")
        mesh = self.mesh
        at = np.flatnonzero(mesh.triangle_patch == names.index(name))
        triangles = mesh.triangles[at]
        vertices = mesh.points[triangles]
        edges = vertices[:, 1:] - vertices[:, :1]
        faces = PatchFaces(
            vertices=vertices,
            areas=0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1),
            normals=mesh.triangle_normals[at],
            velocity=self._arrays.nodes[triangles, VELOCITY:GRADIENT],
            hosts=mesh.triangle_tet[at],
        )
        return with_velocity(faces, self, t) if is_wedge(self._arrays.layer) else faces

    def cell_zone(self, name: str | None, t: float | None = None) -> Tetrahedra:  # noqa: ARG002
        """Return the tetrahedra of a zone of cells, or of all cells, cell by cell."""
        hosts = np.arange(len(self.mesh.tets), dtype=np.int32) if name is None else self._hosts_in(name)
        volumes = np.empty(len(hosts))
        for start in range(0, len(hosts), AT_ONCE):
            vertices = self._vertices(hosts[start : start + AT_ONCE])
            volumes[start : start + AT_ONCE] = np.linalg.det(vertices[:, 1:] - vertices[:, :1]) / 6.0
        return Tetrahedra(volumes, hosts, self._vertices)

    def _vertices(self, hosts: Ints) -> Floats:
        """Return the vertices of tetrahedra, (n, 4, 3), m."""
        vertices: Floats = self._arrays.nodes[self.mesh.tets[hosts], :3]
        return vertices

    def _hosts_in(self, name: str) -> Ints:
        """Return the tetrahedra of a zone, (n,); see :meth:`cell_zone`."""
        zones = self._zones()
        if name not in zones:
            raise InputError(f"cellZone {name} is not in the mesh. {suggestion(name, zones)}")
        cells = require_cells(name, zones[name], self.mesh.n_cells)
        start, end = self.mesh.cell_start[cells], self.mesh.cell_start[cells + 1]
        return np.concatenate([np.empty(0, dtype=np.int32), *map(np.arange, start, end)]).astype(np.int32)


# Linking costs as much as locating thousands of points.
@cache
def _locator() -> Any:
    return link(_locate_all)


def _locate_all(flow: MeshArrays, points: Floats, hosts: Ints) -> None:
    for i in range(points.shape[0]):
        hosts[i] = locate(flow, (points[i, 0], points[i, 1], points[i, 2]))


def require_cells(name: str, cells: NDArray[np.int64], n_cells: int) -> NDArray[np.int64]:
    """Return the cells of a zone; InputError if the mesh does not have them."""
    if len(cells) and not 0 <= cells.min() <= cells.max() < n_cells:
        raise InputError(f"cellZone {name} names cells beyond the mesh's {n_cells}.")
    return cells
