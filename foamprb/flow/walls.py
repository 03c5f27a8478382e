"""Clearance between a body and the walls that it may touch.

Walls beyond a cyclic patch or a wedge are included as images on this side of it.
"""

from __future__ import annotations

from typing import Any, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.ellipsoid import largest_swelling, swelling
from foamprb.body.tensor import (
    Tensor,
    Vector,
    ddot,
    dot_vector,
    inner,
    inverse,
    longest_stretch,
    norm,
    scale_vector,
    vector_dot,
)
from foamprb.compile.link import separate
from foamprb.flow.base import NEAR, Floats, Ints
from foamprb.flow.mesh.arrays import MeshArrays, arm
from foamprb.flow.mesh.folds import height
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import next_node, square_to_box
from foamprb.flow.walk import NO_TRIANGLE, inward, nearest_point

_NEARLY = 1.0 + 1e-6
"""Factor of the distance of a plane, which may stand for others that differ by round-off."""
_TIE = 1.0 + 1e-12
"""Factor of the distance of a triangle: of two at the same distance the first counts."""


def gap(
    flow: MeshArrays, host: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the clearance between the ellipsoid {x + R F·ξ: ξ·ξ ≤ 1} and the nearest wall triangle.

    The map y → F⁻¹(y − x) turns the ellipsoid into a ball of radius R about the origin, and triangles into
    triangles. The nearest triangle is that whose image (including edges and corners) has the least distance d
    from the origin. The clearance is (d − R) |Fᵀn|; it is negative exactly if body and wall overlap. Over a
    plane wall at distance h with normal n it is h − R |Fᵀn|. With a quadratic mode the ball is swollen, by R
    :func:`swelling` towards the triangle.

    Returns
    -------
    gap, patch, triangle
        Clearance in metres; ``inf`` with −1, −1 where d exceeds R by more than :data:`NEAR` R.
    """
    cell = flow.tets[host, 0] - flow.n_points
    begin, end = flow.near_start[cell], flow.near_start[cell + 1]
    if begin == end:
        return np.inf, -1, NO_TRIANGLE
    if flow.near[begin] < 0:
        clearance, patch, triangle = nearest_in_tree(flow, -1 - flow.near[begin], x, F, R, mode)
    else:
        clearance, patch, triangle = nearest_wall(flow, begin, end, x, F, R, mode)
    if patch < 0:
        return clearance, patch, triangle
    return clearance * norm(vector_dot(inward(flow, triangle), F)), patch, triangle


@separate
def nearest_wall(
    flow: MeshArrays, begin: int, end: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return d − R, patch and index of the nearest of the entries ``begin`` to ``end``; see :func:`gap`."""
    best, nearest = NEAR * R, NO_TRIANGLE
    # Most bodies are far from all walls; the map shortens no length by more than the norm of F.
    if not _any_within(flow, begin, end, x, _NEARLY * (best + R) * np.sqrt(ddot(F, F))):
        return np.inf, -1, NO_TRIANGLE
    inverse_F = inverse(F)
    more = R * largest_swelling(mode, inverse_F)
    for k in range(begin, end):
        triangle = flow.near[k] if flow.near[k] >= 0 else -1 - flow.near[k]
        distance = _mapped_distance(flow, triangle, x, F, inverse_F, R, mode, _within(best, more, R))
        if distance - R < best or (distance - R == best and triangle < nearest):
            best, nearest = distance - R, triangle
    if nearest == NO_TRIANGLE:
        return np.inf, -1, NO_TRIANGLE
    return best, flow.triangle_patch[nearest], nearest


def _any_within(flow: MeshArrays, begin: int, end: int, x: Vector, reach: float) -> bool:
    """Return True if the plane of a listed triangle is less than ``reach`` (m) from x.

    One triangle of each plane comes first.
    """
    k = begin
    while k < end and flow.near[k] >= 0:
        if height(flow, flow.near[k], x) < reach:
            return True
        k += 1
    return False


@separate
def nearest_in_tree(
    flow: MeshArrays, seed: int, x: Vector, F: Tensor, R: float, mode: tuple[float, ...] = ()
) -> tuple[float, int, int]:
    """Return the same of the tree; see :func:`gap`. ``seed`` is a triangle that may be near.

    Of several at the same distance the first counts, as in a list.
    """
    inverse_F, stretch = inverse(F), longest_stretch(F)
    more = R * largest_swelling(mode, inverse_F)
    best, nearest = NEAR * R, NO_TRIANGLE
    distance = _mapped_distance(flow, seed, x, F, inverse_F, R, mode, _within(best, more, R))
    if distance - R < best:
        best, nearest = distance - R, seed
    boxes, triangles = flow.wall_boxes, flow.wall_leaves
    node, n_leaves = 1, triangles.shape[0]
    while node > 0:
        # The map shortens lengths at most by the longest stretch.
        limit = _within(best, more, R) * stretch
        hit = square_to_box(boxes, node, x) <= limit * limit
        for k in range(triangles.shape[1] if hit and node >= n_leaves else 0):
            triangle = triangles[node - n_leaves, k]
            if triangle >= 0:
                distance = _mapped_distance(flow, triangle, x, F, inverse_F, R, mode, _within(best, more, R))
                if distance - R < best or (distance - R == best and triangle < nearest):
                    best, nearest = distance - R, triangle
        node = next_node(node, n_leaves, hit)
    if nearest == NO_TRIANGLE:
        return np.inf, -1, NO_TRIANGLE
    return best, flow.triangle_patch[nearest], nearest


def _mapped_distance(
    flow: MeshArrays,
    triangle: int,
    x: Vector,
    F: Tensor,
    inverse_F: Tensor,
    R: float,
    mode: Any,
    limit: float,
) -> float:
    """Return the distance of the mapped triangle from the origin, less the swelling of the ball, m.

    It is infinite if the triangle is not nearer than ``limit``.
    """
    nodes = flow.nodes
    a, b, c = flow.triangles[triangle, 0], flow.triangles[triangle, 1], flow.triangles[triangle, 2]
    n, ra = inward(flow, triangle), arm(nodes, a, x)
    h, m = inner(n, ra), vector_dot(n, F)
    # The triangle's plane is no farther than the triangle.
    if h * h >= limit * limit * inner(m, m):
        return np.inf
    rb, rc = arm(nodes, b, x), arm(nodes, c, x)
    p = nearest_point(dot_vector(inverse_F, ra), dot_vector(inverse_F, rb), dot_vector(inverse_F, rc))
    distance = norm(p)
    if distance >= limit:
        return np.inf
    return float(distance - R * swelling(mode, inverse_F, scale_vector(1.0 / (distance + 1e-300), p)))


def _within(best: float, more: float, R: float) -> float:
    """Return the distance of mapped triangles that may be nearer than ``best`` + R by a swelling ``more``.

    It is at most that of a body without swelling, up to which walls are listed.
    """
    return _TIE * (min(best + more, NEAR * R) + R)


class Walls(NamedTuple):
    """Triangles that a body may touch: corners (n, 3, 3), inward unit normals (n, 3), patches (n,)."""

    corners: Floats
    normals: Floats
    patches: Ints

    def moved(self, turn: Floats, shift: Floats) -> Walls:
        """Return the triangles moved by x → turn·x + shift."""
        return Walls(self.corners @ turn.T + shift, self.normals @ turn.T, self.patches)

    def take(self, rows: Any) -> Walls:
        """Return some of the triangles, by index or mask."""
        return Walls(*(array[rows] for array in self))


def walls_at(mesh: Mesh, triangles: Any) -> Walls:
    """Return boundary triangles as walls."""
    return Walls(
        mesh.points[mesh.triangles[triangles]],
        mesh.triangle_normals[triangles],
        mesh.triangle_patch[triangles],
    )


Box: TypeAlias = tuple[Floats, Floats]
"""Lower and upper corner, m."""


def images_of_walls(mesh: Mesh, walls: Walls, reach: float) -> Walls:
    """Return images of the walls beyond coupled patches, within ``reach`` (m) of them.

    Where two pairs of patches meet, there are images of images.
    """
    boxes = {c.other: patch_box(mesh, c.other) for c in mesh.couplings if len(c.partners)}
    found: list[Walls] = []
    sources = [(-1, walls)]
    for _ in range(2):
        images = []
        for pair, seen in sources:
            for coupling in mesh.couplings:
                if min(coupling.patch, coupling.other) == pair or coupling.other not in boxes:
                    continue
                # The walls before the neighbour appear beyond the patch.
                box = boxes[coupling.other]
                low, high = seen.corners.min(axis=1), seen.corners.max(axis=1)
                near = np.all((high >= box[0] - reach) & (low <= box[1] + reach), axis=1)
                back = coupling.reverse()
                image = seen.take(near).moved(back.turn, back.shift)
                images.append((min(coupling.patch, coupling.other), image))
        found += [image for _, image in images]
        sources = images
    return Walls(*(np.concatenate(arrays) for arrays in zip(walls.take(slice(0)), *found, strict=True)))


def patch_box(mesh: Mesh, patch: int) -> Box:
    """Return the box around a patch."""
    points = mesh.points[mesh.triangles[mesh.triangle_patch == patch]].reshape(-1, 3)
    return points.min(axis=0), points.max(axis=0)
