"""Boundary of the mesh, and its edges."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.flow.mesh.mesh import Mesh
from foamprb.optional import load

pyvista = load("pyvista")

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MOST_TRIANGLES = 200_000
"""Finer boundaries are decimated."""
_FEATURE_ANGLE = 30.0
FLAT_TYPES = frozenset({"empty", "wedge"})
"""Types of patches of two-dimensional cases; these patches are not drawn."""


class Surface(NamedTuple):
    """Patch with outward triangles; a point at a sharp edge exists once for each side."""

    name: str
    type: str
    points: Floats
    """(v, 3), m."""
    triangles: Ints
    """(t, 3)."""
    density: Floats | None = None
    """Particles per area that stick there, at the points, (v,), 1/m²; None if it is not known."""

    @property
    def centres(self) -> Floats:
        """Centres of the triangles, (t, 3), m."""
        return np.asarray(self.points[self.triangles].mean(axis=1))

    @property
    def areas(self) -> Floats:
        """Area vectors of the triangles, outward, (t, 3), m²."""
        a, b, c = self.points[self.triangles].transpose(1, 0, 2)
        return np.asarray(0.5 * np.cross(b - a, c - a))


class Geometry(NamedTuple):
    """Boundary of a mesh."""

    surfaces: tuple[Surface, ...]
    """One per patch with faces."""
    edges: Floats
    """Edges where the boundary bends sharply or two patches meet, (e, 2, 3), m."""
    flat: Floats | None
    """Unit normal of a two-dimensional case."""

    @property
    def points(self) -> Floats:
        """All corners, (v, 3), m."""
        return np.concatenate([surface.points for surface in self.surfaces])


def boundary(mesh: Mesh) -> Geometry:
    """Return the boundary of a mesh, patch by patch."""
    nodes = mesh.nodes
    triangles = mesh.triangles.astype(np.int64)
    surfaces = []
    share = MOST_TRIANGLES / max(len(triangles), 1)
    for index, patch in enumerate(mesh.patches):
        of_patch = triangles[mesh.triangle_patch == index]
        if len(of_patch):
            surfaces.append(Surface(patch.name, patch.type, *_smooth(nodes, of_patch, share)))
    return Geometry(tuple(surfaces), _edges(nodes, triangles, mesh.triangle_patch), flat_normal(surfaces))


def _smooth(nodes: Floats, triangles: Ints, share: float) -> tuple[Floats, Ints]:
    used, corners = np.unique(triangles, return_inverse=True)
    data = pyvista.PolyData.from_regular_faces(nodes[used], corners.reshape(-1, 3))
    if share < 1.0:
        data = data.decimate(1.0 - share)
    data = data.compute_normals(
        cell_normals=False, split_vertices=True, feature_angle=_FEATURE_ANGLE, consistent_normals=False
    )
    # Copies: the arrays of pyvista may share the memory of this temporary mesh.
    return np.array(data.points, dtype=np.float64), np.array(data.regular_faces, dtype=np.int64)


def _edges(nodes: Floats, triangles: Ints, patch: NDArray[Any]) -> Floats:
    """Return the edges of a single triangle, between patches, or where the surface bends sharply."""
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for index in np.unique(patch):
        data = pyvista.PolyData.from_regular_faces(nodes, triangles[patch == index])
        data.point_data["node"] = np.arange(len(nodes))
        sharp = data.extract_feature_edges(_FEATURE_ANGLE)
        pairs.append(np.asarray(sharp.point_data["node"])[sharp.lines.reshape(-1, 3)[:, 1:]])
    return np.asarray(nodes[np.unique(np.sort(np.concatenate(pairs), axis=1), axis=0)])


def flat_normal(surfaces: list[Surface]) -> Floats | None:
    """Return the normal of a two-dimensional case, by its ``empty`` patches or wedges; else None."""
    areas = [surface.areas for surface in surfaces if surface.type in FLAT_TYPES]
    if not areas:
        return None
    # Front and back point to opposite sides, along the axis of the largest variance.
    axes = np.linalg.eigh(sum(a.T @ a for a in areas))[1]
    normal = axes[:, 2]
    return np.asarray(normal * np.sign(normal[np.argmax(np.abs(normal))]))
