"""Boundary of the mesh, and its edges."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersCore import vtkFeatureEdges, vtkPolyDataNormals, vtkQuadricDecimation

from foamprb.flow.mesh.mesh import Mesh
from foamprb.results.vtk import triangles_data

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
    data = triangles_data(nodes[used], corners)
    if share < 1.0:
        coarser = vtkQuadricDecimation()
        coarser.SetTargetReduction(1.0 - share)
        data = filtered(coarser, data)
    normals = vtkPolyDataNormals()
    normals.SetFeatureAngle(_FEATURE_ANGLE)
    normals.ConsistencyOff()
    return triangles_of(filtered(normals, data))


def filtered(algorithm: Any, data: Any) -> Any:
    """Return the output of a filter of VTK for some data."""
    algorithm.SetInputData(data)
    algorithm.Update()
    return algorithm.GetOutput()


def triangles_of(data: Any) -> tuple[Floats, Ints]:
    """Return copies of the points (n, 3) and the triangles (t, 3) of PolyData."""
    points, triangles = data.GetPoints().GetData(), data.GetPolys().GetConnectivityArray()
    return (
        np.array(vtk_to_numpy(points), dtype=np.float64),
        np.array(vtk_to_numpy(triangles), dtype=np.int64).reshape(-1, 3),
    )


def _edges(nodes: Floats, triangles: Ints, patch: NDArray[Any]) -> Floats:
    """Return the edges of a single triangle, between patches, or where the surface bends sharply."""
    pairs = [np.zeros((0, 2), dtype=np.int64)]
    for index in np.unique(patch):
        data = triangles_data(nodes, triangles[patch == index])
        data.GetPointData().SetScalars(numpy_to_vtk(np.arange(len(nodes))))
        bends = vtkFeatureEdges()
        bends.SetFeatureAngle(_FEATURE_ANGLE)
        bends.ColoringOff()
        sharp = filtered(bends, data)
        node, ends = sharp.GetPointData().GetScalars(), sharp.GetLines().GetConnectivityArray()
        if ends.GetNumberOfValues():
            pairs.append(vtk_to_numpy(node)[vtk_to_numpy(ends)].reshape(-1, 2))
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
