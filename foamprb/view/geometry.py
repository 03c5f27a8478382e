"""Boundary of the mesh, its edges, and planes through the flow."""

from __future__ import annotations

import re
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.viscosity import shear_rate
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.view.libraries import load

pyvista = load("pyvista")

Floats = NDArray[np.float64]
Ints = NDArray[np.int64]

MOST_TRIANGLES = 200_000
"""Finer boundaries are decimated."""
_FEATURE_ANGLE = 30.0
FLAT_TYPES = frozenset({"empty", "wedge"})
"""Types of patches of two-dimensional cases; these patches are not drawn."""
PLANE = "speed"
"""Default quantity of a plane through the flow."""

_NUMBER = r"[-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"
_VECTOR = rf"\(\s*({_NUMBER})\s+({_NUMBER})\s+({_NUMBER})\s*\)"
_HOW_TO_SLICE = (
    "Allowed: x, y or z (through the middle), z=0.01, or '(point) (normal)' such as '(0 0 0) (1 0 1)'."
)


class Surface(NamedTuple):
    """Patch with outward triangles; a point at a sharp edge exists once for each side."""

    name: str
    type: str
    points: Floats
    """(v, 3), m."""
    triangles: Ints
    """(t, 3)."""

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


class Slice(NamedTuple):
    """Plane through the flow."""

    points: Floats
    """(v, 3), m."""
    triangles: Ints
    """(t, 3)."""
    values: dict[str, tuple[str, str, Floats]]
    """Label, unit and values (v,) by name."""


def boundary(mesh: Mesh) -> Geometry:
    """Return the boundary of a mesh, patch by patch."""
    nodes = mesh.nodes
    triangles = mesh.triangles.astype(np.int64)
    surfaces = []
    share = MOST_TRIANGLES / max(len(triangles), 1)
    for index, patch in enumerate(mesh.patches):
        own = triangles[mesh.triangle_patch == index]
        if len(own):
            surfaces.append(Surface(patch.name, patch.type, *_smooth(nodes, own, share)))
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
    if len(triangles) == 0:
        return np.zeros((0, 2, 3))
    a, b, c = nodes[triangles].transpose(1, 0, 2)
    normals = np.cross(b - a, c - a)
    normals /= np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)
    pairs = np.sort(
        np.concatenate([triangles[:, [0, 1]], triangles[:, [1, 2]], triangles[:, [2, 0]]]), axis=1
    )
    owner = np.tile(np.arange(len(triangles)), 3)
    order = np.lexsort((pairs[:, 1], pairs[:, 0]))
    pairs, owner = pairs[order], owner[order]
    first = np.flatnonzero(np.r_[True, (pairs[1:] != pairs[:-1]).any(axis=1)])
    count = np.diff(np.r_[first, len(pairs)])
    one, other = owner[first], owner[np.minimum(first + 1, len(owner) - 1)]
    bend = np.einsum("ij,ij->i", normals[one], normals[other]) < np.cos(np.radians(_FEATURE_ANGLE))
    sharp = (count != 2) | bend | (patch[one] != patch[other])
    return np.asarray(nodes[pairs[first[sharp]]])


def flat_normal(surfaces: list[Surface]) -> Floats | None:
    """Return the normal of a two-dimensional case, by its ``empty`` patches or wedges; else None."""
    areas = [surface.areas for surface in surfaces if surface.type in FLAT_TYPES]
    if not areas:
        return None
    # Front and back point to opposite sides, along the axis of the largest variance.
    axes = np.linalg.eigh(sum(a.T @ a for a in areas))[1]
    normal = axes[:, 2]
    return np.asarray(normal * np.sign(normal[np.argmax(np.abs(normal))]))


def read_plane(text: str, low: Floats, high: Floats) -> tuple[Floats, Floats]:
    """Return point and unit normal of the plane of ``-slice``, in the box of a mesh.

    Raises
    ------
    InputError
        If the text has no allowed form, or the plane misses the box.
    """
    by_axis = re.fullmatch(rf"([xyz])(?:=({_NUMBER}))?", text.strip())
    by_normal = re.fullmatch(rf"{_VECTOR}\s*{_VECTOR}", text.strip())
    if by_axis:
        axis = "xyz".index(by_axis[1])
        origin, normal = 0.5 * (low + high), np.eye(3)[axis]
        if by_axis[2]:
            origin[axis] = float(by_axis[2])
    elif by_normal:
        numbers = [float(number) for number in by_normal.groups()]
        origin, normal = np.array(numbers[:3]), np.array(numbers[3:])
    else:
        raise InputError(f"-slice {text}: not a plane. {_HOW_TO_SLICE}")
    size = float(np.linalg.norm(normal))
    if size == 0.0:
        raise InputError(f"-slice {text}: the normal is zero.")
    normal = normal / size
    corners = np.array(
        [[x, y, z] for x in (low[0], high[0]) for y in (low[1], high[1]) for z in (low[2], high[2])]
    )
    sides = (corners - origin) @ normal
    if sides.min() > 0.0 or sides.max() < 0.0:
        box = " to ".join("({:g} {:g} {:g})".format(*corner) for corner in (low, high))
        raise InputError(f"-slice {text}: the plane misses the mesh, whose box is {box}.")
    return origin, normal


def cut(flow: MeshFlow, origin: Floats, normal: Floats) -> Slice:
    """Return speed and shear rate of a flow on a plane, from the values at the nodes.

    Parameters
    ----------
    flow
        The flow.
    origin, normal
        A point of the plane, m, and its unit normal, each (3,).
    """
    mesh = flow.mesh
    nodes, tets = mesh.nodes, mesh.tets.astype(np.int64)
    distance = (nodes - origin) @ normal
    # Nodes on the plane, such as cell centres of a mesh with one layer, count as above it.
    distance += 1e-9 * np.ptp(nodes, axis=0).max()
    above = distance[tets] > 0.0
    n_above = above.sum(axis=1)
    # Vertices of each tetrahedron; vertices below the plane come first.
    order = np.argsort(above, axis=1, kind="stable")
    pairs, hosts = [], []
    for number, corners in _CUTS:
        own = np.flatnonzero(n_above == number)
        vertices = np.take_along_axis(tets[own], order[own], axis=1)
        pairs.append(vertices[:, corners].reshape(-1, 2))
        hosts.append(np.repeat(own, 3))
    ends = np.sort(np.concatenate(pairs), axis=1)
    unique, first, corner = np.unique(
        ends[:, 0] * len(nodes) + ends[:, 1], return_index=True, return_inverse=True
    )
    one, other = unique // len(nodes), unique % len(nodes)
    share = distance[one] / (distance[one] - distance[other])
    points = nodes[one] + share[:, None] * (nodes[other] - nodes[one])
    u, l = flow.sample(points, np.concatenate(hosts)[first].astype(np.int32), 0.0)
    rate = np.asarray(shear_rate(tuple(l.reshape(-1, 9).T)))  # type: ignore[arg-type]
    return Slice(
        points,
        corner.reshape(-1, 3).astype(np.int64),
        {
            "speed": ("speed of the flow", "m/s", np.linalg.norm(u, axis=1)),
            "shearRate": ("shear rate of the flow", "1/s", rate),
        },
    )


# Number of vertices above the plane, and the vertex pairs, below first, of the corners of a triangle.
_CUTS = (
    (1, (0, 3, 1, 3, 2, 3)),
    (3, (0, 1, 0, 2, 0, 3)),
    (2, (0, 2, 0, 3, 1, 3)),
    (2, (0, 2, 1, 3, 1, 2)),
)
