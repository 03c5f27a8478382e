"""A flow on a mesh, and the kernels by which a particle moves through it.

A particle knows its host, the tetrahedron that holds its centre. A step follows the straight segment from the
old place to the new one through the faces that it crosses, so that location costs a few operations and a wall
is met exactly where it is crossed.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import fields, replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.tensor import Tensor, Vector, dot_vector, inverse, vector_dot
from foamprb.compile.link import link
from foamprb.errors import InputError, suggestion
from foamprb.flow.base import PatchFaces, Tetrahedra
from foamprb.flow.mesh.locator import (
    TOLERANCE,
    MeshArrays,
    build_tree,
    cell_boxes,
    frame,
    locate,
    no_mesh,
    weights,
)
from foamprb.flow.mesh.mesh import Floats, Ints, Mesh
from foamprb.flow.mesh.patch import WALLS

__all__ = [
    "FAILED",
    "LONG",
    "REACHED",
    "MeshArrays",
    "MeshFlow",
    "cross",
    "follow",
    "gap",
    "near_walls",
    "normal",
    "recover",
    "sample",
    "walk",
]

REACHED = -1
FAILED = -2

_MOST_CROSSINGS = 20_000
# Crossings without progress, as around an edge or a vertex, after which the start is nudged.
_MOST_STALLS = 200
_ATTEMPTS = 4
# A point off the middle of a tetrahedron and of its faces.
_INSIDE = (0.1, 0.2, 0.3, 0.4)
_NO_TRIANGLE = _NO_TET = -1
# Entries of the lists of walls nearby: a gigabyte.
_MOST_NEAR = 250_000_000

Corners: TypeAlias = tuple[int, int, int, int]
Weights: TypeAlias = tuple[float, float, float, float]


def sample(flow: MeshArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Velocity u (m/s) and its gradient l_ij = ∂u_i/∂x_j (1/s) at x, linear in the tetrahedron ``host``.

    The flow is steady: the third result, ∂u/∂t (m/s²), is zero.
    """
    u, l = interpolate(flow.nodes, 3, corners(flow, host, 0), shape(flow, host, x))
    return u, l, (0.0, 0.0, 0.0)


def corners(flow: MeshArrays, host: int, first: int) -> Corners:
    """Rows of the nodes of a tetrahedron in a table where node 0 has the row ``first``."""
    tets = flow.tets
    return first + tets[host, 0], first + tets[host, 1], first + tets[host, 2], first + tets[host, 3]


def shape(flow: MeshArrays, host: int, x: Vector) -> Weights:
    """Shares of the four nodes of a tetrahedron in the value at x."""
    origin, c1, c2, c3, volume = frame(flow, host)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    s = 1.0 / volume
    return s * w0, s * w1, s * w2, s * w3


def interpolate(f: Floats, k: int, nodes: Corners, w: Weights) -> tuple[Vector, Tensor]:
    """Velocity and gradient from a table with a row for each node, in which they begin at column k."""
    u = blend(f, k, nodes, w), blend(f, k + 1, nodes, w), blend(f, k + 2, nodes, w)
    l = (
        blend(f, k + 3, nodes, w), blend(f, k + 4, nodes, w), blend(f, k + 5, nodes, w),
        blend(f, k + 6, nodes, w), blend(f, k + 7, nodes, w), blend(f, k + 8, nodes, w),
        blend(f, k + 9, nodes, w), blend(f, k + 10, nodes, w), blend(f, k + 11, nodes, w),
    )  # fmt: skip
    return u, l


def blend(f: Floats, k: int, nodes: Corners, w: Weights) -> float:
    """Column k of a table, interpolated between four of its rows."""
    a, b, c, d = nodes
    return w[0] * f[a, k] + w[1] * f[b, k] + w[2] * f[c, k] + w[3] * f[d, k]  # type: ignore[no-any-return]


def walk(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Go from x0, in the tetrahedron ``host``, straight to x1.

    Returns
    -------
    host, fraction, patch, triangle
        ``(tetrahedron of x1, 1, −1, −1)`` when x1 was reached; ``(last tetrahedron, fraction of the segment,
        patch, boundary triangle)`` when the boundary was crossed there; patch −2 when the walk failed.
    """
    if holds(flow, host, x1):
        return host, 1.0, REACHED, _NO_TRIANGLE
    return follow(flow, host, x0, x1)


def holds(flow: MeshArrays, tet: int, x: Vector) -> bool:
    """Whether a tetrahedron holds x, to round-off."""
    origin, c1, c2, c3, volume = frame(flow, tet)
    w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, x)
    sign = -1.0 if volume < 0.0 else 1.0
    return min(sign * w0, sign * w1, sign * w2, sign * w3) >= -TOLERANCE * abs(volume)


def follow(flow: MeshArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Follow the segment from x0, in the tetrahedron ``host``, to x1, through the faces on its way.

    A face is crossed at the fraction of the whole segment where its barycentric weight vanishes, which
    does not drift however many faces are crossed. In a tetrahedron turned inside out the path runs backwards,
    so that it comes out where the mesh unfolds again. A path that circles about an edge or a vertex is begun
    anew from a start moved towards the middle of the host by 1e-8 of its size, then by more.

    Returns
    -------
    As :func:`walk`.
    """
    tets, neighbours, nodes = flow.tets, flow.neighbours, flow.nodes
    for attempt in range(_ATTEMPTS):
        nudge = 0.0 if attempt == 0 else 1e-10 * 100.0**attempt
        a, b, c, d = tets[host, 0], tets[host, 1], tets[host, 2], tets[host, 3]
        at = a, b, c, d
        mx, my, mz = blend(nodes, 0, at, _INSIDE), blend(nodes, 1, at, _INSIDE), blend(nodes, 2, at, _INSIDE)
        start = (x0[0] + nudge * (mx - x0[0]), x0[1] + nudge * (my - x0[1]), x0[2] + nudge * (mz - x0[2]))
        tet, came_from, progress, stalls = host, -1, 0.0, 0
        for _ in range(_MOST_CROSSINGS):
            origin, c1, c2, c3, volume = frame(flow, tet)
            end = weights(origin, c1, c2, c3, volume, x1)
            sign = -1.0 if volume < 0.0 else 1.0
            slack = -TOLERANCE * abs(volume)
            if min(sign * end[0], sign * end[1], sign * end[2], sign * end[3]) >= slack:
                return tet, 1.0, REACHED, _NO_TRIANGLE
            begin = weights(origin, c1, c2, c3, volume, start)
            face, fraction, first = -1, 0.0, np.inf
            for k in range(4):
                w0, w1 = sign * begin[k], sign * end[k]
                fall = sign * (w0 - w1)
                if fall <= 0.0 or (sign > 0.0 and w1 >= slack):
                    continue
                other = neighbours[tet, k]
                if other >= 0 and other == came_from:
                    continue
                s = w0 / (w0 - w1)
                # Where a path touches the rim of a wall, the way inside is preferred.
                rank = sign * s + (0.0 if other >= 0 else TOLERANCE)
                if rank < first:
                    face, fraction, first = k, s, rank
            if face < 0:
                break
            other = neighbours[tet, face]
            if other < 0:
                triangle = -1 - other
                fraction = min(max(fraction, 0.0), 1.0)
                return tet, fraction, flow.triangle_patch[triangle], triangle
            stalls = 0 if fraction > progress + 1e-12 else stalls + 1
            if stalls > _MOST_STALLS:
                break
            progress = max(progress, fraction)
            tet, came_from = other, tet
    return host, 0.0, FAILED, _NO_TRIANGLE


def recover(flow: MeshArrays, x: Vector) -> int:
    """Ask the tree for the tetrahedron that holds x; −1 when x lies outside the mesh."""
    return locate(flow, x)


def normal(flow: MeshArrays, triangle: int, x: Vector) -> Vector:  # noqa: ARG001
    """Unit normal of a boundary triangle, pointing into the mesh; it is flat, so x does not matter."""
    return inward(flow, triangle)


def inward(flow: MeshArrays, triangle: int) -> Vector:
    """Unit normal of a boundary triangle, pointing into the mesh."""
    n = flow.triangle_normals
    return n[triangle, 0], n[triangle, 1], n[triangle, 2]


def cross(flow: MeshArrays, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """Go from x on a triangle of a coupled patch to where the neighbouring patch continues it.

    Returns
    -------
    host, x, turn
        The tetrahedron behind the neighbouring face, −1 if the patch is coupled to none; the place, which
        lies in it to round-off however well the two faces fit; the rotation from this side to that.
    """
    first, end = flow.across[triangle, 0], flow.across[triangle, 1]
    m, k = flow.motions, flow.triangle_patch[triangle]
    turn = (m[k, 0], m[k, 1], m[k, 2], m[k, 3], m[k, 4], m[k, 5], m[k, 6], m[k, 7], m[k, 8])
    y = dot_vector(turn, x)
    y = (y[0] + m[k, 9], y[1] + m[k, 10], y[2] + m[k, 11])
    host, depth = _NO_TET, -np.inf
    for other in range(first, end):
        tet = int(flow.triangle_tet[other])
        origin, c1, c2, c3, volume = frame(flow, tet)
        if volume != 0.0:
            w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, y)
            smallest = min(w0 / volume, w1 / volume, w2 / volume, w3 / volume)
            if smallest > depth:
                host, depth = tet, smallest
    if host >= 0 and depth < 0.0:
        origin, c1, c2, c3, volume = frame(flow, host)
        w0, w1, w2, w3 = weights(origin, c1, c2, c3, volume, y)
        s = 1.0 / volume
        w0, w1, w2, w3 = max(s * w0, 0.0), max(s * w1, 0.0), max(s * w2, 0.0), max(s * w3, 0.0)
        s = 1.0 / (w0 + w1 + w2 + w3)
        nodes, tets = flow.nodes, flow.tets
        a, b, c, d = tets[host, 0], tets[host, 1], tets[host, 2], tets[host, 3]
        found, w = (a, b, c, d), (s * w0, s * w1, s * w2, s * w3)
        y = blend(nodes, 0, found, w), blend(nodes, 1, found, w), blend(nodes, 2, found, w)
    return host, y, turn


def gap(flow: MeshArrays, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """Clearance between the ellipsoid {x + R F·ξ: ξ·ξ ≤ 1} and the nearest wall triangle.

    The map y → F⁻¹(y − x) turns the ellipsoid into a ball of radius R about the origin and keeps triangles
    triangles. The clearance is the distance of the mapped triangle from the origin (corners and edges count)
    less R: negative exactly when body and wall overlap. Over a plane wall at distance h with normal n it is
    h/|Fᵀn| − R.

    Returns
    -------
    gap, patch, triangle
        The clearance in metres of the undeformed ball, ``inf`` with −1, −1 when no wall triangle is near.
    """
    cell = flow.tets[host, 0] - flow.n_points
    begin, end = flow.near_start[cell], flow.near_start[cell + 1]
    if begin == end:
        return np.inf, -1, _NO_TRIANGLE
    return nearest_wall(flow, begin, end, x, F, R)


def nearest_wall(
    flow: MeshArrays, begin: int, end: int, x: Vector, F: Tensor, R: float
) -> tuple[float, int, int]:
    """The nearest of those wall triangles that are listed from ``begin`` to ``end``, as :func:`gap`."""
    best, nearest = np.inf, _NO_TRIANGLE
    inverse_F = inverse(F)
    nodes = flow.nodes
    for k in range(begin, end):
        triangle = flow.near[k]
        a, b, c = flow.triangles[triangle, 0], flow.triangles[triangle, 1], flow.triangles[triangle, 2]
        ra = (nodes[a, 0] - x[0], nodes[a, 1] - x[1], nodes[a, 2] - x[2])
        n = inward(flow, triangle)
        height = n[0] * ra[0] + n[1] * ra[1] + n[2] * ra[2]
        m = vector_dot(n, F)
        limit = best + R
        # The triangle's plane is no farther than the triangle.
        if height * height >= limit * limit * (m[0] * m[0] + m[1] * m[1] + m[2] * m[2]):
            continue
        rb = (nodes[b, 0] - x[0], nodes[b, 1] - x[1], nodes[b, 2] - x[2])
        rc = (nodes[c, 0] - x[0], nodes[c, 1] - x[1], nodes[c, 2] - x[2])
        distance = _distance(dot_vector(inverse_F, ra), dot_vector(inverse_F, rb), dot_vector(inverse_F, rc))
        if distance - R < best:
            best, nearest = distance - R, triangle
    return best, (flow.triangle_patch[nearest] if nearest >= 0 else -1), nearest


def _distance(a: Vector, b: Vector, c: Vector) -> float:
    """Distance of the triangle a, b, c from the origin (Ericson, Real-Time Collision Detection, 5.1.5)."""
    ab = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    ac = (c[0] - a[0], c[1] - a[1], c[2] - a[2])
    d1, d2 = -_dot(ab, a), -_dot(ac, a)
    d3, d4 = -_dot(ab, b), -_dot(ac, b)
    d5, d6 = -_dot(ab, c), -_dot(ac, c)
    va, vb, vc = d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2
    v, w = 0.0, 0.0
    if d1 <= 0.0 and d2 <= 0.0:
        v, w = 0.0, 0.0
    elif d3 >= 0.0 and d4 <= d3:
        v, w = 1.0, 0.0
    elif d6 >= 0.0 and d5 <= d6:
        v, w = 0.0, 1.0
    elif vc <= 0.0 and d1 >= 0.0 and d3 <= 0.0:
        v, w = d1 / (d1 - d3), 0.0
    elif vb <= 0.0 and d2 >= 0.0 and d6 <= 0.0:
        v, w = 0.0, d2 / (d2 - d6)
    elif va <= 0.0 and d4 - d3 >= 0.0 and d5 - d6 >= 0.0:
        w = (d4 - d3) / ((d4 - d3) + (d5 - d6))
        v = 1.0 - w
    else:
        s = 1.0 / (va + vb + vc)
        v, w = vb * s, vc * s
    p = (a[0] + v * ab[0] + w * ac[0], a[1] + v * ab[1] + w * ac[1], a[2] + v * ab[2] + w * ac[2])
    return float(np.sqrt(_dot(p, p)))


def _dot(p: Vector, q: Vector) -> Any:
    return p[0] * q[0] + p[1] * q[1] + p[2] * q[2]


LONG: tuple[Callable[..., Any], ...] = (follow, nearest_wall, locate)
"""Kernels that few steps need, and long ones: inlined wherever they are called they would swell the loop."""


def _across(mesh: Mesh) -> Ints:
    """See :class:`MeshArrays`."""
    count = np.bincount(mesh.triangle_face, minlength=len(mesh.boundary_centres))
    start = np.concatenate([[0], np.cumsum(count)])
    partner = np.full(len(mesh.boundary_centres), -1)
    for coupling in mesh.couplings:
        partner[coupling.faces] = coupling.partners
    other = partner[mesh.triangle_face]
    across = np.stack([start[other], start[other + 1]], axis=1)
    across[other < 0] = 0
    return across.astype(np.int32)


def _motions(mesh: Mesh) -> Floats:
    """See :class:`MeshArrays`."""
    motions = np.zeros((len(mesh.patches), 12))
    motions[:, [0, 4, 8]] = 1.0
    for coupling in mesh.couplings:
        motions[coupling.patch] = [*coupling.turn.ravel(), *coupling.shift]
    return motions


class _Walls(NamedTuple):
    """Triangles that a body may touch: corners (n, 3, 3), inward unit normals (n, 3), patches (n,)."""

    corners: Floats
    normals: Floats
    patches: Ints

    def moved(self, turn: Floats, shift: Floats) -> _Walls:
        return _Walls(self.corners @ turn.T + shift, self.normals @ turn.T, self.patches)

    def take(self, rows: Any) -> _Walls:
        return _Walls(*(array[rows] for array in self))


def _images(mesh: Mesh, walls: _Walls, reach: float) -> _Walls:
    """What lies of the walls beyond the coupled patches, within ``reach`` (m) of the patch.

    Where two pairs of patches meet there are images of images.
    """
    found: list[_Walls] = []
    sources = [(-1, walls)]
    for _ in range(2):
        images = []
        for pair, seen in sources:
            for coupling in mesh.couplings:
                if min(coupling.patch, coupling.other) == pair or len(coupling.faces) == 0:
                    continue
                # Beyond the patch lies what lies before its neighbour.
                boxes = _face_box(mesh, coupling.partners)
                low, high = seen.corners.min(axis=1), seen.corners.max(axis=1)
                near = np.all((high >= boxes[0] - reach) & (low <= boxes[1] + reach), axis=1)
                back = coupling.reverse()
                image = seen.take(near).moved(back.turn, back.shift)
                images.append((min(coupling.patch, coupling.other), image))
        found += [image for _, image in images]
        sources = images
    return _Walls(*(np.concatenate(arrays) for arrays in zip(walls.take(slice(0)), *found, strict=True)))


def _face_box(mesh: Mesh, faces: Any) -> tuple[Floats, Floats]:
    """Corners of the box around boundary faces."""
    points = mesh.points[mesh.triangles[np.isin(mesh.triangle_face, faces)]].reshape(-1, 3)
    return points.min(axis=0), points.max(axis=0)


def near_walls(
    mesh: Mesh, boxes: Floats, tree: tuple[Floats, Ints], reach: float, names: Ints, corners: Floats
) -> tuple[Ints, Ints]:
    """List, cell by cell, the wall triangles within ``reach`` of the cell's box.

    Parameters
    ----------
    mesh, boxes, tree
        The mesh, its cells' boxes and the tree over them.
    reach
        Distance in metres, at least the longest semi-axis of a particle; 0 lists nothing.
    names, corners
        Indices (n,) of the triangles that count, and their corners (n, 3, 3).

    Returns
    -------
    near_start, near
        As in :class:`MeshArrays`; a box distance is never larger than the true one, so none is missed.

    Raises
    ------
    InputError
        The lists would be longer than memory should bear, as the reach is many cells wide.
    """
    start = np.zeros(mesh.n_cells + 1, dtype=np.int32)
    if reach <= 0.0 or len(names) == 0:
        return start, np.empty(0, dtype=np.int32)
    targets = np.concatenate([corners.min(axis=1) - reach, corners.max(axis=1) + reach], axis=1)
    meet = link(_meetings)
    counts = np.zeros(mesh.n_cells, dtype=np.int32)
    total = meet(*tree, boxes, targets, names, _MOST_NEAR, counts, np.empty(0, dtype=np.int32))
    if total > _MOST_NEAR:
        size = np.cbrt(np.median(mesh.volumes))
        raise InputError(
            f"Walls within {reach:g} m of a particle's centre may be touched, but cells are {size:g} m wide: "
            f"lists of the {len(names)} wall triangles near each of the {mesh.n_cells} cells would have more "
            f"than {_MOST_NEAR} entries. Are the particles as large as they should be? Particles many cells "
            "wide need a coarser mesh."
        )
    np.cumsum(counts, out=start[1:])
    near = np.empty(total, dtype=np.int32)
    meet(*tree, boxes, targets, names, _MOST_NEAR, start[:-1].copy(), near)
    return start, near


def _meetings(
    tree_boxes: Floats,
    tree_cells: Ints,
    boxes: Floats,
    targets: Floats,
    names: Ints,
    most: int,
    place: Ints,
    found: Ints,
) -> int:
    """Count pairs of a cell and a target whose boxes meet, up to ``most`` and one, in all and by cell.

    With room in ``found``, the names of the targets go there from ``place`` (n_cells,) on, cell by cell.
    """
    leaves = tree_cells.shape[0]
    count = 0
    for i in range(targets.shape[0]):
        node = 1
        while node > 0:
            if _meet(tree_boxes, node, targets, i):
                if node < leaves:
                    node = 2 * node
                    continue
                for k in range(tree_cells.shape[1]):
                    cell = tree_cells[node - leaves, k]
                    if cell >= 0 and _meet(boxes, cell, targets, i):
                        if found.shape[0] > 0:
                            found[place[cell]] = names[i]
                        place[cell] += 1
                        count += 1
                if count > most:
                    return count
            while node & 1:
                node >>= 1
            if node > 0:
                node += 1
    return count


def _meet(boxes: Floats, i: int, others: Floats, j: int) -> bool:
    return bool(
        boxes[i, 0] <= others[j, 3]
        and boxes[i, 1] <= others[j, 4]
        and boxes[i, 2] <= others[j, 5]
        and others[j, 0] <= boxes[i, 3]
        and others[j, 1] <= boxes[i, 4]
        and others[j, 2] <= boxes[i, 5]
    )


class MeshFlow:
    """A flow given by u and ∇u at the nodes of a mesh, linear in each tetrahedron.

    Parameters
    ----------
    mesh
        The mesh.
    u, l
        (n_nodes, 3) in m/s and (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j in 1/s; mesh points, then cell centres.
    notes
        What the user should know about the flow, sentence by sentence.
    zones
        Reads the cells of each zone of cells, by name, when somebody asks for one.
    """

    kernels: dict[str, Callable[..., Any]] = {  # noqa: RUF012
        "sample": sample,
        "walk": walk,
        "gap": gap,
        "normal": normal,
        "cross": cross,
        "recover": recover,
    }
    """The functions that a particle loop calls, by the names under which it calls them."""

    def __init__(
        self,
        mesh: Mesh,
        u: Floats,
        l: Floats,
        notes: Iterable[str] = (),
        zones: Callable[[], Mapping[str, NDArray[np.int64]]] = dict,
    ) -> None:
        self.mesh = mesh
        self._zones = zones
        self.patches = mesh.patches
        self.notes = tuple(notes)
        if mesh.inverted:
            self.notes += (
                f"{mesh.inverted} of {len(mesh.tets)} tetrahedra are inverted: the mesh has cells "
                "far from convex there, and paths through them are less certain.",
            )
        self.bounds = (mesh.points.min(axis=0), mesh.points.max(axis=0))
        nodes = np.zeros((len(u), 16))
        nodes[: mesh.n_points, :3], nodes[mesh.n_points :, :3] = mesh.points, mesh.centres
        nodes[:, 3:6] = u
        nodes[:, 6:15] = l.reshape(-1, 9)
        self.span = (-np.inf, np.inf)
        self._near: tuple[Any, MeshArrays] | None = None
        self._tree = build_tree(cell_boxes(mesh))
        self._arrays = MeshArrays(
            nodes=nodes,
            n_points=mesh.n_points,
            tets=mesh.tets,
            neighbours=mesh.neighbours,
            cell_start=mesh.cell_start,
            tree_boxes=self._tree[0],
            tree_cells=self._tree[1],
            triangles=mesh.triangles,
            triangle_patch=mesh.triangle_patch,
            triangle_normals=mesh.triangle_normals,
            triangle_tet=mesh.triangle_tet,
            across=_across(mesh),
            motions=_motions(mesh),
            near_start=np.zeros(mesh.n_cells + 1, dtype=np.int32),
            near=np.empty(0, dtype=np.int32),
        )

    @staticmethod
    def nothing() -> MeshArrays:
        """What the kernels read where there is no flow, for which they can be compiled."""
        return no_mesh()

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is the same at all times."""
        return float(np.inf)

    def arrays(self, reach: float = 0.0, touchable: Sequence[int] | None = None) -> MeshArrays:
        """What the kernels read; bodies of semi-axes up to ``reach`` (m) find what they touch.

        The ``touchable`` patches are given by their indices; by default they are those of type wall.
        """
        if touchable is None:
            touchable = [index for index, patch in enumerate(self.patches) if patch.type in WALLS]
        if reach <= 0.0 or len(touchable) == 0:
            return self._arrays
        key = reach, tuple(touchable)
        if self._near is None or self._near[0] != key:
            self._near = key, self._with_walls(reach, touchable)
        return self._near[1]

    def _with_walls(self, reach: float, touchable: Sequence[int]) -> MeshArrays:
        """The arrays with the walls that bodies can touch, and with their images beyond coupled patches."""
        mesh, boxes, arrays = self.mesh, cell_boxes(self.mesh), self._arrays
        names = np.flatnonzero(np.isin(mesh.triangle_patch, list(touchable))).astype(np.int32)
        corners = mesh.points[mesh.triangles[names]]
        if mesh.couplings:
            walls = _Walls(corners, mesh.triangle_normals[names], mesh.triangle_patch[names])
            images = _images(mesh, walls, reach)
            n, nodes, triangles = len(images.patches), len(arrays.nodes), len(arrays.triangles)
            beyond = np.zeros((3 * n, 16))
            beyond[:, :3] = images.corners.reshape(-1, 3)
            names = np.concatenate([names, np.arange(triangles, triangles + n, dtype=np.int32)])
            corners = np.concatenate([corners, images.corners])
            arrays = arrays._replace(
                nodes=np.concatenate([arrays.nodes, beyond]),
                triangles=np.concatenate(
                    [arrays.triangles, np.arange(nodes, nodes + 3 * n, dtype=np.int32).reshape(-1, 3)]
                ),
                triangle_patch=np.concatenate([arrays.triangle_patch, images.patches]),
                triangle_normals=np.concatenate([arrays.triangle_normals, images.normals]),
            )
        start, near = near_walls(mesh, boxes, self._tree, reach, names, corners)
        return arrays._replace(near_start=start, near=near)

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """Put what the kernels read, but for the lists of walls nearby, where ``place`` copies it."""
        fixed: dict[str, Any] = {
            name: place(array)
            for name, array in self._arrays._asdict().items()
            if isinstance(array, np.ndarray) and not name.startswith("near")
        }
        self._arrays = self._arrays._replace(**fixed)
        self._tree = self._arrays.tree_boxes, self._arrays.tree_cells
        held = {field.name for field in fields(self.mesh)}
        self.mesh = replace(self.mesh, **{name: array for name, array in fixed.items() if name in held})

    def traits(self) -> Mapping[str, ArrayLike]:
        """Mesh and velocities, by name."""
        return self._arrays._asdict()

    def locate(self, points: Floats) -> Ints:
        """Hosts of the points (n, 3): (n,) tetrahedra, −1 for a point outside the mesh."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        hosts = np.empty(len(points), dtype=np.int32)
        link(_locate_all)(self._arrays, points, hosts)
        return hosts

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """Velocity (n, 3), m/s, and ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) in hosts (n,) at time t, s."""
        return sample_with(sample, self._arrays, points, hosts, t)

    def cell_of(self, hosts: Ints) -> Ints:
        """Cells to which the tetrahedra belong, (n,)."""
        cells: Ints = self.mesh.tets[hosts, 0] - np.int32(self.mesh.n_points)
        return cells

    def cell_size(self, hosts: Ints) -> Floats:
        """Cube root of the volume of the hosts' cells, (n,), m."""
        return np.cbrt(self.mesh.volumes[self.cell_of(hosts)])

    def patch_faces(self, name: str, t: float) -> PatchFaces:  # noqa: ARG002
        """Triangles of the patch ``name``.

        Raises
        ------
        InputError
            There is no such patch.
        """
        names = [patch.name for patch in self.patches]
        if name not in names:
            raise InputError(f"patch {name} is not in the mesh. {suggestion(name, names)}")
        mesh = self.mesh
        at = np.flatnonzero(mesh.triangle_patch == names.index(name))
        triangles = mesh.triangles[at]
        vertices = mesh.points[triangles]
        edges = vertices[:, 1:] - vertices[:, :1]
        return PatchFaces(
            vertices=vertices,
            areas=0.5 * np.linalg.norm(np.cross(edges[:, 0], edges[:, 1]), axis=1),
            normals=mesh.triangle_normals[at],
            velocity=self._arrays.nodes[triangles, 3:6],
            hosts=mesh.triangle_tet[at],
        )

    def cell_zone(self, name: str) -> Tetrahedra:
        """Tetrahedra of the zone of cells ``name``, cell after cell.

        Raises
        ------
        InputError
            There is no such zone, or it names cells that the mesh does not have.
        """
        zones = self._zones()
        if name not in zones:
            raise InputError(f"cellZone {name} is not in the mesh. {suggestion(name, zones)}")
        cells = zones[name]
        if len(cells) and not (cells.min() >= 0 and cells.max() < self.mesh.n_cells):
            raise InputError(f"cellZone {name} names cells beyond the mesh's {self.mesh.n_cells}.")
        start, end = self.mesh.cell_start[cells], self.mesh.cell_start[cells + 1]
        hosts = np.concatenate([np.empty(0, dtype=np.int32), *map(np.arange, start, end)]).astype(np.int32)
        vertices = self._arrays.nodes[self.mesh.tets[hosts], :3]
        edges = vertices[:, 1:] - vertices[:, :1]
        return Tetrahedra(vertices, np.linalg.det(edges) / 6.0, hosts)


def _locate_all(flow: MeshArrays, points: Floats, hosts: Ints) -> None:
    for i in range(points.shape[0]):
        hosts[i] = locate(flow, (points[i, 0], points[i, 1], points[i, 2]))


def sample_with(
    kernel: Callable[..., Any], arrays: Any, points: Floats, hosts: Ints, t: float
) -> tuple[Floats, Floats]:
    """Velocities and gradients as :meth:`Flow.sample`, by a flow's kernel ``sample`` and what it reads."""
    points = np.ascontiguousarray(points, dtype=np.float64)
    values = np.empty((len(points), 12))
    sampler = link(_sample_all, {"sample": kernel})
    sampler(arrays, points, np.ascontiguousarray(hosts, dtype=np.int32), t, values)
    return values[:, :3].copy(), values[:, 3:].reshape(-1, 3, 3).copy()


def _sample_all(flow: Any, points: Floats, hosts: Ints, t: float, values: Floats) -> None:
    """Put u and ∇u at the points (n, 3) in their hosts (n,) at time t into the rows of ``values`` (n, 12)."""
    for i in range(points.shape[0]):
        u, l, _ = sample(flow, hosts[i], (points[i, 0], points[i, 1], points[i, 2]), t)
        for k in range(3):
            values[i, k] = u[k]
        for k in range(9):
            values[i, 3 + k] = l[k]
