"""Meshes one cell thick between two parallel planes without a flow across them, in two dimensions.

Each point has a partner in the other plane, with the same velocity. A centre is added to the two faces of
each cell in the planes, from which their fans begin. The tetrahedra then fill prisms, each between three
columns of nodes. As the nodes of a column have the same velocity, the interpolated one is the same at all
depths.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats
from foamprb.flow.mesh.faces import Faces
from foamprb.flow.mesh.lists import Index, int32, ragged, starts
from foamprb.flow.mesh.mesh import Mesh, cut
from foamprb.flow.patches import PatchKind

_PARALLEL, _SAME = 1e-6, 1e-5
"""Tolerances of normals, and of the places of partners over the size of the mesh."""


class Layer(NamedTuple):
    """Mesh one cell thick."""

    normal: Floats
    """(3,), unit, of its planes."""
    faces: tuple[Index, Index]
    """Boundary faces of the cells in each plane, (n_cells,)."""
    partners: Index
    """(n_points,): the point in the other plane."""

    def flatten(self, u: Floats, l: Floats) -> None:
        """Make velocity (n_nodes, 3) and gradient (n_nodes, 3, 3) those of two dimensions, in place."""
        for values in (u, l):
            points = values[: len(self.partners)]
            points += points[self.partners]
            points *= 0.5
        plane = np.eye(3) - np.outer(self.normal, self.normal)
        u[:], l[:] = u @ plane, plane @ l @ plane


def layer_of(mesh: Mesh) -> Layer | None:
    """Return the planes of a mesh one cell thick; None for other meshes, and for divided ones."""
    owner, outer = mesh.owner[mesh.n_internal :], mesh.boundary_areas
    normals = outer / np.maximum(np.linalg.norm(outer, axis=1), 1e-300)[:, None]
    mirrors = [patch.kind is PatchKind.MIRROR for patch in mesh.patches]
    on_mirrors = np.repeat(np.array(mirrors, dtype=bool), np.diff(mesh.patch_start))
    own = [k for k, mirror in enumerate(mirrors) if mirror and mesh.patch_start[k] < mesh.patch_start[k + 1]]
    for k in sorted(own, key=lambda k: mesh.patches[k].type != "empty") if not mesh.divided else ():
        normal = normals[mesh.patch_start[k]].copy()
        normal[np.abs(normal) < _PARALLEL] = 0.0
        normal /= np.linalg.norm(normal)
        along = on_mirrors * (normals @ normal)
        sides = [np.flatnonzero(s * along > 1.0 - _PARALLEL) for s in (-1.0, 1.0)]
        sides = [side[np.argsort(owner[side])] for side in sides]
        if all(np.array_equal(owner[side], np.arange(mesh.n_cells)) for side in sides):
            partners = _partners(mesh, normal, sides)
            if partners is not None:
                return Layer(normal, (sides[0], sides[1]), partners)
    return None


def _partners(mesh: Mesh, normal: Floats, sides: list[Index]) -> Index | None:
    """Return the point on the other side for each point; None if they do not match."""
    from scipy.spatial import KDTree

    n, start = mesh.n_internal, mesh.face_start.astype(np.intp)
    here, there = (
        np.unique(mesh.face_points[ragged(start[n + side], np.diff(start)[n + side])]) for side in sides
    )
    flat = mesh.points - (mesh.points @ normal)[:, None] * normal
    distance, nearest = KDTree(flat[there]).query(flat[here])
    size = float(np.linalg.norm(np.ptp(mesh.points, axis=0)))
    if len(here) + len(there) != mesh.n_points or len(np.unique(nearest)) != len(there):
        return None
    partners = np.empty(mesh.n_points, dtype=np.intp)
    partners[here], partners[there[nearest]] = there[nearest], here
    return partners if np.max(distance, initial=0.0) <= _SAME * size else None


class Division(NamedTuple):
    """Mesh of a layer whose faces in the planes are divided into triangles about centres."""

    mesh: Mesh
    """Its further points are the centres in one plane, then those in the other one, cell by cell."""
    faces: Index
    """(n_faces,): the face of the layer's mesh that each face is of, −1 in the planes."""
    n_points: int
    """Number of points of the layer's mesh."""

    def widened(self, values: NDArray[Any]) -> NDArray[Any]:
        """Return values at nodes, (n_nodes, …), or fluxes through faces, (n_faces,), on the divided mesh."""
        if values.ndim == 1:
            return np.where(self.faces < 0, 0.0, values[self.faces])
        cells = values[self.n_points :]
        return np.concatenate([values[: self.n_points], cells, cells, cells])


def divide(mesh: Mesh, layer: Layer) -> Division:
    """Divide the faces of a layer in its planes."""
    n, m, cells = mesh.n_internal, mesh.n_points, np.arange(mesh.n_cells)
    begin, sizes = mesh.face_start[:-1].astype(np.intp), np.diff(mesh.face_start).astype(np.intp)
    centre, counts, places = np.full(len(sizes), -1), np.ones(len(sizes), dtype=np.intp), [mesh.points]
    for k, side in enumerate(layer.faces):
        centre[n + side], counts[n + side] = m + k * mesh.n_cells + cells, sizes[n + side]
        depth = (mesh.boundary_centres[side] - mesh.centres) @ layer.normal
        places.append(mesh.centres + depth[:, None] * layer.normal)
    points, first = np.concatenate(places), starts(counts)
    of = np.repeat(np.arange(len(sizes)), counts)
    fans = centre[of] >= 0
    start = starts(np.where(fans, 3, sizes[of]))
    lists = np.empty(start[-1], dtype=np.int32)
    kept, at, face = of[~fans], start[:-1][fans], of[fans]
    lists[ragged(start[:-1][~fans], sizes[kept])] = mesh.face_points[ragged(begin[kept], sizes[kept])]
    edge = np.flatnonzero(fans) - first[face]
    lists[at], lists[at + 1] = centre[face], mesh.face_points[begin[face] + edge]
    lists[at + 2] = mesh.face_points[begin[face] + (edge + 1) % sizes[face]]
    a, b, c = (points[lists[at + k]] for k in range(3))
    areas, centres = mesh.boundary_areas[of[n:] - n], mesh.boundary_centres[of[n:] - n]
    areas[fans[n:]], centres[fans[n:]] = 0.5 * np.cross(b - a, c - a), (a + b + c) / 3.0
    of_cell = mesh.cell_faces.astype(np.intp)
    per_cell = np.add.reduceat(counts[of_cell], mesh.cell_face_start[:-1])
    faces = Faces(
        int32(start), lists, mesh.owner[of], mesh.neighbour, int32(starts(per_cell)),
        int32(ragged(first[of_cell], counts[of_cell])),
    )  # fmt: skip
    ends = np.repeat(mesh.cell_point_start[1:], 2)
    added = (m + np.stack([cells, mesh.n_cells + cells], axis=1)).ravel()
    own = (
        int32(mesh.cell_point_start + 2 * np.arange(mesh.n_cells + 1)),
        np.insert(mesh.cell_points, ends, added),
    )
    couplings = tuple(
        c._replace(faces=first[n + c.faces] - n, partners=first[n + c.partners] - n) for c in mesh.couplings
    )
    divided, _ = cut(
        points, faces, first[n + mesh.patch_start] - n, own, "layer", areas, centres=mesh.centres,
        volumes=mesh.volumes, patches=mesh.patches, boundary_centres=centres, inverted=mesh.inverted,
        couplings=couplings, divided=True,
    )  # fmt: skip
    return Division(divided, np.where(fans, -1, of), m)
