"""Meshes one cell thick between two planes: parallel ones without a flow across them, or those of a wedge.

Each point has a partner in the other plane, with the same velocity. A centre is added to the two faces of
each cell in the planes, from which their fans begin. The tetrahedra then fill prisms, each between three
columns of nodes. As the nodes of a column have the same velocity, the interpolated one is the same at all
depths. In a wedge it is the same after a turn into the middle plane; see :mod:`foamprb.flow.wedge`.
"""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.base import Floats
from foamprb.flow.mesh.coupling import Coupling
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
    axis: Floats
    """(10,): of a wedge the unit vectors along the axis and away from it in the middle plane, a point of the
    axis, and the tangent of half the angle; else (0,)."""
    turns: Floats
    """(n_points, 3, 3): rotations of the points of a wedge into its middle plane; else (0, 3, 3)."""

    def flatten(self, mesh: Mesh, u: Floats, l: Floats, walls: Index | None = None) -> None:
        """Make velocity (n_nodes, 3) and gradient (n_nodes, 3, 3) those of two dimensions, in place.

        In a wedge the velocity is that of the foot of each point in the middle plane, which is nearer to the
        axis; at the points of ``walls`` it is that of the middles of their faces.
        """
        for values in (u, l):
            turn_nodes(self.turns, values)
            points = values[: len(self.partners)]
            points += points[self.partners]
            points *= 0.5
        if not len(self.axis):
            plane = np.eye(3) - np.outer(self.normal, self.normal)
            u[:], l[:] = u @ plane, plane @ l @ plane
            return
        n, axis, away, place = mesh.n_points, *self.axis[:9].reshape(3, 3)
        longer, points = 1.0 / _cosines(self.turns), u[: mesh.n_points]
        points += (longer - 1.0) * (points - np.outer(points @ axis, axis))
        nearer = (longer - 1.0) * ((mesh.points - place) @ away)[:, None] * (l[:n] @ away)
        if walls is not None:
            nearer[walls] = (1.0 - longer[walls]) * (points[walls] - np.outer(points[walls] @ axis, axis))
        points -= nearer
        turn_nodes(self.turns, u, back=True)
        turn_nodes(self.turns, l, back=True)


def turn_nodes(turns: Floats, values: Floats, back: bool = False) -> None:
    """Turn velocities or their derivatives at the first n nodes of a wedge, in place; see :class:`Layer`.

    At the angle θ the part of a velocity across the axis is also multiplied by cos θ: it is linear between
    two planes then.

    Parameters
    ----------
    turns
        (n, 3, 3), rotations into the middle plane.
    values
        (n_nodes, 3), (n_nodes, 3, 3) or (n_nodes, 3, 3, 3).
    back
        Whether to turn out of the middle plane.
    """
    reverse, turned = turns.transpose(0, 2, 1), values[: len(turns)]
    own = reverse if back else turns
    if values.ndim == 2:
        cosine = _cosines(turns)[:, :, None]
        unit = cosine * np.eye(3)
        own = (0.5 * (reverse - turns) + unit) / cosine if back else cosine * turns - unit
        own = own if back else own + 0.5 * (turns + reverse)
    for k in range(1, values.ndim):
        turned = np.moveaxis(np.einsum("nij,n...j->n...i", own, np.moveaxis(turned, k, -1)), -1, k)
    values[: len(turns)] = turned


def _cosines(turns: Floats) -> Floats:
    """Return the cosines of the angles of rotations, (n, 1)."""
    cosines: Floats = 0.5 * (np.trace(turns, axis1=1, axis2=2) - 1.0)[:, None]
    return cosines


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
                return Layer(normal, (sides[0], sides[1]), partners, np.empty(0), np.empty((0, 3, 3)))
    wedges = [c for c in mesh.couplings if mesh.patches[c.patch].type == "wedge"]
    return _wedge(mesh, wedges[0]) if len(wedges) == 2 and not mesh.divided else None


def _wedge(mesh: Mesh, coupling: Coupling) -> Layer | None:
    """Return the planes of a wedge one cell thick; None if it is thicker, or half a turn or more."""
    turn, owner = coupling.turn, mesh.owner[mesh.n_internal :]
    sides = [side[np.argsort(owner[side])] for side in (coupling.faces, coupling.partners)]
    cosine = 0.5 * (np.trace(turn) - 1.0)
    if cosine <= 0.0 or not all(np.array_equal(owner[s], np.arange(mesh.n_cells)) for s in sides):
        return None
    here, there = (mesh.boundary_areas[side].sum(axis=0) for side in sides)
    normal, axis = there - here, np.cross(there, here)
    normal, axis = (np.where(np.abs(v) < _PARALLEL * np.abs(v).max(), 0.0, v) for v in (normal, axis))
    normal, axis = normal / np.linalg.norm(normal), axis / np.linalg.norm(axis)
    away = np.cross(normal, axis)
    place = np.linalg.lstsq(np.eye(3) - turn, coupling.shift, rcond=1e-9)[0]
    partners = _partners(mesh, normal, sides)
    if partners is None:
        return None
    arms = mesh.points - place
    # Points of the axis are their own partners.
    tangents = np.where(partners == np.arange(mesh.n_points), 0.0, arms @ normal)
    tangents /= np.where(tangents == 0.0, 1.0, arms @ away)
    half = np.sqrt((1.0 - cosine) / (1.0 + cosine))
    numbers = np.concatenate([axis, away, place, [half]])
    return Layer(normal, (sides[0], sides[1]), partners, numbers, _into_plane(numbers, tangents))


def _into_plane(axis: Floats, tangents: Floats) -> Floats:
    """Return the rotations about the axis of a wedge by −θ (n, 3, 3), from tan θ (n,); see :class:`Layer`."""
    cosine, cross = 1.0 / np.sqrt(1.0 + tangents[:, None, None] ** 2), np.cross(np.eye(3), axis[:3])
    sine = cosine * tangents[:, None, None]
    # Rodrigues' formula.
    turns: Floats = np.eye(3) + (1.0 - cosine) * (cross @ cross) - sine * cross
    return turns


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
    if len(np.union1d(here, there)) != mesh.n_points or len(np.unique(nearest)) != len(there):
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
    turns: Floats
    """See :class:`Layer`; of the further points, too."""

    def widened(self, values: NDArray[np.generic]) -> NDArray[Any]:
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
        arms, areas = mesh.boundary_centres[side] - mesh.centres, mesh.boundary_areas[side]
        depth = arms @ layer.normal
        if len(layer.axis):
            depth = np.einsum("ni,ni->n", arms, areas) / (areas @ layer.normal)
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
    turns = layer.turns
    if len(layer.axis):
        # Triangles match whose edges do, in the same cell.
        column = np.minimum(np.arange(m), layer.partners)
        edges = np.sort(column[np.stack([lists[at + 1], lists[at + 2]])], axis=0)
        order = np.lexsort((*edges, mesh.owner[face], centre[face] >= m + mesh.n_cells))
        pair = np.flatnonzero(fans)[order].reshape(2, -1) - n
        size = float(np.sqrt(np.linalg.norm(areas[pair], axis=2).min()))
        wedges = iter((pair, pair[::-1]))
        couplings = tuple(
            c._replace(**dict(zip(("faces", "partners"), next(wedges), strict=True)), size=size)
            if mesh.patches[c.patch].type == "wedge"
            else c
            for c in couplings
        )
        half = _into_plane(layer.axis, np.repeat([-layer.axis[9], layer.axis[9]], mesh.n_cells))
        turns = np.concatenate([turns, half])
    divided, _ = cut(
        points, faces, first[n + mesh.patch_start] - n, own, "layer", areas, centres=mesh.centres,
        volumes=mesh.volumes, patches=mesh.patches, boundary_centres=centres, inverted=mesh.inverted,
        couplings=couplings, divided=True,
    )  # fmt: skip
    return Division(divided, np.where(fans, -1, of), m, turns)
