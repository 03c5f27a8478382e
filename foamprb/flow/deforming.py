"""Flow on a mesh that deforms: tanks that slosh, pistons, valves, bodies that float.

Between two times each node moves on Hermite's cubic. The kernels of :mod:`foamprb.flow.walk` see the mesh at
a time through :class:`MeshAt`, whose nodes are computed where they are read. A way from (x0, t0) to (x1, t1)
begins where the mesh has carried x0 until t1, and is straight in the mesh at t1: a wall is met if and only if
the way relative to it crosses it.

The velocity is interpolated in time at fixed weights of the tetrahedron's nodes, by the polynomial through up
to four times. On walls it has the velocity of the wall at all times: that of the nodes is added in which
their motion differs from the polynomial. The fluxes of the correction are linear in time, so that it stays
continuous across the sides of tetrahedra.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import replace
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import (
    Tensor,
    Vector,
    dot,
    dot_vector,
    inner,
    minus,
    norm,
    plus,
    plus_scaled,
    scale_vector,
    transpose,
    vector_product,
)
from foamprb.compile.link import link
from foamprb.compile.record import record, stand_in
from foamprb.flow.base import Floats, Ints, Planes, Turbulence
from foamprb.flow.kernels import named
from foamprb.flow.mesh.arrays import FREE, MeshArrays, arm, frame, point
from foamprb.flow.mesh.locator import cell_boxes
from foamprb.flow.mesh.locator import locate as locate_mesh
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import Tree, next_node, pairs_near, square_to_box, tree_with
from foamprb.flow.meshflow import folds_of, graded
from foamprb.flow.motion import Deformation
from foamprb.flow.moving import MovingMeshFlow, any_interval, hermite, hermite_rate, tree_of
from foamprb.flow.planes import walls as walls_mesh
from foamprb.flow.series import _OF_VELOCITY as OF_VELOCITY
from foamprb.flow.series import _OF_VISCOSITY as OF_VISCOSITY
from foamprb.flow.series import SeriesArrays, SeriesFlow
from foamprb.flow.series import _interval as interval
from foamprb.flow.series import cell_volume as cell_volume_series
from foamprb.flow.viscosity import blend_scalar
from foamprb.flow.walk import (
    FAILED,
    Weights,
    blend_curvature,
    blend_turbulence,
    corners,
    correction_by,
    curvature_in,
    fluxes_of,
    follow,
    interpolate,
    inward,
    nearest_point,
    shape,
    shape_and_sides,
)
from foamprb.flow.walk import _blend_vector as blend_vector
from foamprb.flow.walk import cross as cross_mesh
from foamprb.flow.walk import walk as walk_mesh
from foamprb.flow.walk import walk_on as walk_on_mesh
from foamprb.flow.wall_lists import near_walls, wall_tree
from foamprb.flow.walls import Walls, images_of_walls
from foamprb.flow.walls import gap as gap_mesh

_SAME: Tensor = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
Corners: TypeAlias = tuple[Vector, Vector, Vector]
_SHORT = 0.25
"""A neighbouring interval that is shorter than this share of an interval is left out: it extrapolates."""
_BULGE = 4.0 / 27.0
"""Largest value of s (1 − s)²."""


@record
class DeformingArrays(NamedTuple):
    """Arrays of a flow on a mesh that deforms, for the kernels."""

    mesh: MeshArrays
    """The mesh of the first time, with trees, folds and lists of walls that hold at all loaded times."""
    series: SeriesArrays
    shapes: Floats
    """(rows, 6): places of the nodes, m, and their velocities, m/s, as the rows of ``series.fields``."""
    past: Floats
    """(rows, 6): the same of points on walls and openings, at all times of the flow."""
    n_past: int
    """Number of these points."""
    past_rows: Ints
    """(n_nodes,) row of each node among those of a time in ``past``, −1 for others."""
    past_boxes: Floats
    """Boxes of a tree over their triangles that hold at all times; see :class:`MeshArrays`."""
    past_leaves: Ints
    """(n_leaves, leaf size) triangles, −1 for none."""
    starts: Floats
    """(n,) the starts of the intervals between times, s."""
    end: float
    """End of the last interval, s: there the first one follows, if the flow has a period."""

    def pulled(self, x: Floats, hosts: Ints, t: Floats, apart: bool = True) -> Floats:
        """Return where places (n, 3) at times (n,) were on the mesh of the first time.

        They are carried with their hosts at loaded times; if not ``apart``, with the boundary at any time.
        Without a host they stay.
        """
        X = np.array(x, dtype=np.float64)
        link(_pull_all)(self, np.ascontiguousarray(hosts, dtype=np.int64), np.ascontiguousarray(t), X, apart)
        return X


@stand_in
class NodesAt:
    """Nodes at a time in place of :attr:`MeshArrays.nodes`: Hermite's cubic, or its derivative."""

    shapes: Floats
    nodes: Floats
    """Those of the mesh, for what does not change in time."""
    first: int
    """Row of ``shapes`` at which the nodes begin at the start of the interval, and at its end."""
    last: int
    a: float
    """Weights of place and velocity at the start, then at the end."""
    b: float
    c: float
    d: float

    @staticmethod
    def item(at: NodesAt, i: int, k: int) -> float:
        """Return coordinate k of node i, or what does not change in time."""
        if k >= FREE:
            return at.nodes[np.uint64(i), k]  # type: ignore[no-any-return]
        f, i0, i1 = at.shapes, np.uint64(at.first + i), np.uint64(at.last + i)
        return at.a * f[i0, k] + at.b * f[i0, k + 3] + at.c * f[i1, k] + at.d * f[i1, k + 3]  # type: ignore[no-any-return]


@stand_in
class NormalsAt:
    """Inward normals of boundary triangles at a time."""

    triangles: Ints
    nodes: Any

    @staticmethod
    def item(at: NormalsAt, i: int, k: int) -> float:
        """Return component k of the normal of triangle i."""
        nodes, row = at.nodes, np.uint64(i)
        a, b, c = at.triangles[row, 0], at.triangles[row, 1], at.triangles[row, 2]
        x, y, z = nodes[a, 0], nodes[a, 1], nodes[a, 2]
        p0, p1, p2 = nodes[b, 0] - x, nodes[b, 1] - y, nodes[b, 2] - z
        q0, q1, q2 = nodes[c, 0] - x, nodes[c, 1] - y, nodes[c, 2] - z
        n0, n1, n2 = p2 * q1 - p1 * q2, p0 * q2 - p2 * q0, p1 * q0 - p0 * q1
        size = max(math.sqrt(n0 * n0 + n1 * n1 + n2 * n2), 1e-300)
        return float(n0 if k == 0 else n1 if k == 1 else n2) / size


@stand_in
class MeshAt:
    """The mesh at a time, in place of :class:`MeshArrays`."""

    base: MeshArrays
    nodes: NodesAt
    triangle_normals: NormalsAt


@stand_in
class FieldsAt:
    """A table with a row for each node at a time: the sum of those of four times, with weights."""

    values: Floats
    i: int
    j: int
    k: int
    l: int
    a: float
    b: float
    c: float
    d: float

    @staticmethod
    def item(at: FieldsAt, row: int, k: int) -> float:
        """Return column k of a node."""
        f = at.values
        early = at.a * f[np.uint64(at.i + row), k] + at.b * f[np.uint64(at.j + row), k]
        return early + at.c * f[np.uint64(at.k + row), k] + at.d * f[np.uint64(at.l + row), k]  # type: ignore[no-any-return]


def nodes_at(flow: DeformingArrays, k: int, t: float) -> Any:
    """Return the nodes at a time, s, in the loaded interval k."""
    series, h = flow.series, flow.series.times[k + 1] - flow.series.times[k]
    w = hermite((t - series.times[k]) / h, h)
    return NodesAt(flow.shapes, flow.mesh.nodes, series.first[k], series.first[k + 1], *w)


def rates_at(flow: DeformingArrays, k: int, t: float) -> Any:
    """Return the velocities of the nodes, as places, at a time, s, in the loaded interval k."""
    series, h = flow.series, flow.series.times[k + 1] - flow.series.times[k]
    w = hermite_rate((t - series.times[k]) / h, h)
    return NodesAt(flow.shapes, flow.mesh.nodes, series.first[k], series.first[k + 1], *w)


def with_nodes(flow: DeformingArrays, nodes: NodesAt) -> Any:
    """Return the mesh with these nodes."""
    return MeshAt(flow.mesh, nodes, NormalsAt(flow.mesh.triangles, nodes))


def mesh_at(flow: DeformingArrays, t: float) -> Any:
    """Return the mesh at a time, s."""
    return with_nodes(flow, nodes_at(flow, interval(flow.series, t), t))


def window(times: Floats, k: int) -> tuple[int, int]:
    """Return the first of up to four loaded times from which values in interval k follow, and the end."""
    h, n = _SHORT * (times[k + 1] - times[k]), times.shape[0]
    first, end = k, k + 2
    while first > max(min(k - 1, n - 4), 0) and times[first] - times[first - 1] > h:
        first -= 1
    while end < min(max(k + 3, 4), n) and times[end] - times[end - 1] > h:
        end += 1
    return first, end


def basis(times: Floats, first: int, end: int, j: int, t: float) -> tuple[float, float]:
    """Return Lagrange's polynomial of time j at t, and its rate, 1/s."""
    value, rate = 1.0, 0.0
    for m in range(first, end):
        if m != j:
            s = 1.0 / (times[j] - times[m])
            rate = s * (rate * (t - times[m]) + value)
            value = s * value * (t - times[m])
    return value, rate


def blended(flow: SeriesArrays, values: Any, k: int, t: float) -> tuple[Any, Any]:
    """Return a table of nodes at a time in the loaded interval k, and its rate at fixed nodes."""
    first, end = window(flow.times, k)
    j, m, n = first + 1, min(first + 2, end - 1), min(first + 3, end - 1)
    a, b = basis(flow.times, first, end, first, t), basis(flow.times, first, end, j, t)
    c, d = (0.0, 0.0), (0.0, 0.0)
    if first + 2 < end:
        c = basis(flow.times, first, end, m, t)
    if first + 3 < end:
        d = basis(flow.times, first, end, n, t)
    i, j, m, n = flow.first[first], flow.first[j], flow.first[m], flow.first[n]
    return (
        FieldsAt(values, i, j, m, n, a[0], b[0], c[0], d[0]),
        FieldsAt(values, i, j, m, n, a[1], b[1], c[1], d[1]),
    )


def sample(flow: DeformingArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, gradient and rate; see :func:`foamprb.flow.kernels.sample`.

    At fixed weights the velocity changes at the rate u_w = u_t + l·w, with the velocity w of the mesh.
    """
    series = flow.series
    k = interval(series, t)
    at, moving = with_nodes(flow, nodes_at(flow, k, t)), rates_at(flow, k, t)
    sides, scale, w = shape_and_sides(at, host, x)
    now, rate = blended(series, series.fields, k, t)
    u, l = interpolate(at, host, now, 0, 0, w)
    u_w, _ = interpolate(at, host, rate, 0, 0, w)
    rows = corners(flow.mesh, host, 0)
    u = plus(u, _lack(flow, k, t, moving, rows, w))
    c = _correction(flow, at, k, t, now, host, w, sides, scale)
    v = plus(blend_vector(moving, 0, rows, w), c)
    return plus(u, c), l, minus(u_w, dot_vector(l, v))


def _lack(flow: DeformingArrays, k: int, t: float, moving: Any, rows: Any, w: Weights) -> Vector:
    """Return the velocity of walls less that of the polynomial through their times, weighted by nodes."""
    nodes, slopes, lack = flow.mesh.nodes, blended(flow.series, flow.shapes, k, t)[0], (0.0, 0.0, 0.0)
    for n in range(4):
        i = rows[n]
        if nodes[i, FREE] < 1.0:
            d = moving[i, 0] - slopes[i, 3], moving[i, 1] - slopes[i, 4], moving[i, 2] - slopes[i, 5]
            lack = plus_scaled(lack, w[n], d)
    return lack


def _correction(
    flow: DeformingArrays,
    at: Any,
    k: int,
    t: float,
    f: Any,
    host: int,
    w: Weights,
    sides: tuple[Vector, Vector, Vector],
    scale: float,
) -> Vector:
    """Return the correction of the velocity, m/s, see :func:`foamprb.flow.walk.correction_at`."""
    times = flow.series.times
    if flow.series.correction.shape[0] == 0:
        return 0.0, 0.0, 0.0
    s = (t - times[k]) / (times[k + 1] - times[k])
    # Stored are fluxes over volumes, of which that at t is 1 / scale.
    (a, V), (b, W) = _fluxes(flow, k, host), _fluxes(flow, k + 1, host)
    V, W = scale * (1.0 - s) * V, scale * s * W
    q = V * a[0] + W * b[0], V * a[1] + W * b[1], V * a[2] + W * b[2], V * a[3] + W * b[3]
    return correction_by(at, q, f, 0, 0, host, w, sides, scale)


def _fluxes(flow: DeformingArrays, j: int, host: int) -> tuple[Weights, float]:
    """Return the fluxes of the correction in a host at loaded time j, and six times its volume, m³."""
    series, first = flow.series, flow.series.first[j]
    then = with_nodes(flow, NodesAt(flow.shapes, flow.mesh.nodes, first, first, 1.0, 0.0, 0.0, 0.0))
    row, first_face = series.first_tet[j] + host, series.first_face[j]
    q = fluxes_of(then, series.correction, row, series.phi, first_face, series.fields, 0, first, host)
    return q, frame(then, host)[4]


def carried(flow: DeformingArrays, host: int, x: Vector, t0: float, t1: float) -> Vector:
    """Return where the mesh has moved at t1 what was at x in a host at t0."""
    if t0 == t1:
        return x
    w = shape(mesh_at(flow, t0), host, x)
    return blend_vector(nodes_at(flow, interval(flow.series, t1), t1), 0, corners(flow.mesh, host, 0), w)


def sample_ahead(
    flow: DeformingArrays, host: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, Vector, Tensor, Vector]:
    """See :func:`foamprb.flow.walk.sample_ahead`."""
    last, _, patch, _, entered = follow(mesh_at(flow, t1), host, carried(flow, host, x0, t0, t1), x1)
    last = host if patch == FAILED else last
    u, l, u_t = sample(flow, last, x1, t1)
    return last, 0.0, entered, u, l, u_t


def walk(
    flow: DeformingArrays, host: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk`: the way is that relative to the mesh."""
    return walk_mesh(mesh_at(flow, t1), host, carried(flow, host, x0, t0, t1), x1)


def walk_on(
    flow: DeformingArrays, host: int, ahead: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk_on` and :func:`walk`."""
    return walk_on_mesh(mesh_at(flow, t1), host, ahead, carried(flow, host, x0, t0, t1), x1)


def gap(
    flow: DeformingArrays, host: int, x: Vector, F: Tensor, R: float, mode: Any = (), t: float = 0.0
) -> tuple[float, int, int]:
    """See :func:`foamprb.flow.walls.gap`."""
    return gap_mesh(mesh_at(flow, t), host, x, F, R, mode)


def walls(
    flow: DeformingArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8], t: float
) -> Planes:
    """See :func:`foamprb.flow.planes.walls`."""
    return walls_mesh(mesh_at(flow, t), host, x, cut, chosen)


def wall_speeds(flow: DeformingArrays, host: int, x: Vector, planes: Planes, t: float) -> Vector:
    """See :func:`foamprb.flow.kernels.wall_speeds`."""
    h1, n1, h2, n2, h3, n3 = planes
    return (
        _speed(flow, host, x, h1, n1, t),
        _speed(flow, host, x, h2, n2, t),
        _speed(flow, host, x, h3, n3, t),
    )


def _speed(flow: DeformingArrays, host: int, x: Vector, h: float, n: Vector, t: float) -> float:
    """Return the velocity along n of the wall that is seen from x at the distance h against n, m/s."""
    if h == math.inf:
        return 0.0
    mesh, now, foot = flow.mesh, nodes_at(flow, interval(flow.series, t), t), plus_scaled(x, -h, n)
    cell, best, nearest = mesh.tets[host, 0] - mesh.n_points, math.inf, 0
    for k in range(mesh.seen_start[cell], mesh.seen_start[cell + 1]):
        triangle = mesh.seen[k] >> 1
        a, b, c = mesh.triangles[triangle, 0], mesh.triangles[triangle, 1], mesh.triangles[triangle, 2]
        p = nearest_point(arm(now, a, foot), arm(now, b, foot), arm(now, c, foot))
        if inner(p, p) < best:
            best, nearest = inner(p, p), triangle
    return float(inner(n, wall_velocity(flow, nearest, foot, t)))


def normal(flow: DeformingArrays, triangle: int, x: Vector, t: float) -> Vector:  # noqa: ARG001
    """See :func:`foamprb.flow.walk.normal`."""
    return inward(mesh_at(flow, t), triangle)


def wall_velocity(flow: DeformingArrays, triangle: int, x: Vector, t: float) -> Vector:
    """Return the velocity of a triangle of the boundary at x, m/s."""
    k = interval(flow.series, t)
    now, moving, at = nodes_at(flow, k, t), rates_at(flow, k, t), flow.mesh.triangles
    a, b, c = at[triangle, 0], at[triangle, 1], at[triangle, 2]
    w = in_triangle(arm(now, a, x), arm(now, b, x), arm(now, c, x))
    return _mean(w, (point(moving, a), point(moving, b), point(moving, c)))


def in_triangle(a: Vector, b: Vector, c: Vector) -> Vector:
    """Return the barycentric weights of the origin's foot in the plane of a triangle."""
    p, q = minus(b, a), minus(c, a)
    n = vector_product(p, q)
    s = 1.0 / max(inner(n, n), 1e-300)
    v, w = s * inner(vector_product(q, a), n), s * inner(vector_product(a, p), n)
    return 1.0 - v - w, v, w


def ride(flow: DeformingArrays, host: int, x: Vector, t0: float, t1: float) -> tuple[Vector, Tensor, Vector]:
    """Return place, turn and velocity at t1 of what sticks to the boundary and was at x at t0."""
    triangle = _touched(flow, host, x, t0)
    if triangle < 0:
        return x, _SAME, (0.0, 0.0, 0.0)
    a, b, c = _corners(flow, _boundary(flow, t0)[0], triangle)
    w = in_triangle(minus(a, x), minus(b, x), minus(c, x))
    Q, foot = _axes(a, b, c), _mean(w, (a, b, c))
    now, rates = _boundary(flow, t1)
    a, b, c = _corners(flow, now, triangle)
    turn, y = dot(_axes(a, b, c), transpose(Q)), _mean(w, (a, b, c))
    y = plus(y, dot_vector(turn, minus(x, foot)))
    return y, turn, _mean(w, _corners(flow, rates, triangle))


def _touched(flow: DeformingArrays, host: int, x: Vector, t: float) -> int:
    """Return the triangle of walls and openings that is nearest to x, one of the host if there is one."""
    mesh, now, best, found = flow.mesh, _boundary(flow, t)[0], math.inf, -1
    for k in range(4):
        own = -1 - mesh.neighbours[host, k]
        if own >= 0 and _is_past(flow, own):
            return int(own)
    boxes, leaves, node = flow.past_boxes, flow.past_leaves, 1
    while node > 0:
        hit = square_to_box(boxes, node, x) <= best
        for k in range(leaves.shape[1] if hit and node >= leaves.shape[0] else 0):
            triangle = int(leaves[node - leaves.shape[0], k])
            if triangle >= 0:
                a, b, c = _corners(flow, now, triangle)
                p = nearest_point(minus(a, x), minus(b, x), minus(c, x))
                if inner(p, p) < best or (inner(p, p) == best and triangle < found):
                    best, found = inner(p, p), triangle
        node = next_node(node, leaves.shape[0], hit)
    return found


def _is_past(flow: DeformingArrays, triangle: int) -> bool:
    at, rows = flow.mesh.triangles, flow.past_rows
    return bool(min(rows[at[triangle, 0]], rows[at[triangle, 1]], rows[at[triangle, 2]]) >= 0)


def _boundary(flow: DeformingArrays, t: float) -> tuple[Any, Any]:
    """Return the points on walls and openings at any time of the flow, and their velocities."""
    k, s, h = any_interval(flow, t)
    n, fixed = flow.past.shape[0] // flow.n_past, flow.mesh.nodes
    first, last, w, w_t = k * flow.n_past, (k + 1) % n * flow.n_past, hermite(s, h), hermite_rate(s, h)
    return NodesAt(flow.past, fixed, first, last, *w), NodesAt(flow.past, fixed, first, last, *w_t)


def _corners(flow: DeformingArrays, past: Any, triangle: int) -> Corners:
    at, rows = flow.mesh.triangles, flow.past_rows
    a, b, c = rows[at[triangle, 0]], rows[at[triangle, 1]], rows[at[triangle, 2]]
    return point(past, a), point(past, b), point(past, c)


def _mean(w: Vector, of: Corners) -> Vector:
    return plus_scaled(plus_scaled(scale_vector(w[0], of[0]), w[1], of[1]), w[2], of[2])


def _axes(a: Vector, b: Vector, c: Vector) -> Tensor:
    """Return the matrix of columns along an edge of a triangle, along its normal, and across both."""
    n, p = vector_product(minus(b, a), minus(c, a)), minus(b, a)
    n, p = scale_vector(1.0 / max(norm(n), 1e-300), n), scale_vector(1.0 / max(norm(p), 1e-300), p)
    q = vector_product(n, p)
    return p[0], n[0], q[0], p[1], n[1], q[1], p[2], n[2], q[2]


def cross(flow: DeformingArrays, triangle: int, x: Vector, t: float) -> tuple[int, Vector, Tensor]:
    """See :func:`foamprb.flow.walk.cross`."""
    return cross_mesh(mesh_at(flow, t), triangle, x)


def recover(flow: DeformingArrays, x: Vector, t: float) -> int:
    """See :func:`foamprb.flow.walk.recover`."""
    return locate_mesh(mesh_at(flow, t), x)


def cell_volume(flow: DeformingArrays, host: int) -> float:
    """See :func:`foamprb.flow.walk.cell_volume`; at the first time."""
    return cell_volume_series(flow.series, host)


def turbulence(flow: DeformingArrays, host: int, x: Vector, t: float) -> Turbulence:
    """See :func:`foamprb.flow.walk.turbulence`."""
    series, w = flow.series, shape(mesh_at(flow, t), host, x)
    if series.fields.shape[1] <= OF_VELOCITY:
        return 0.0, 0.0, (0.0, 0.0, 0.0), (0.0, 0.0, 0.0)
    f = blended(series, series.fields, interval(series, t), t)[0]
    return blend_turbulence(f, OF_VELOCITY, corners(flow.mesh, host, 0), w)


def viscosity(flow: DeformingArrays, host: int, x: Vector, t: float) -> tuple[float, Vector]:
    """See :func:`foamprb.flow.series.viscosity`."""
    series, w = flow.series, shape(mesh_at(flow, t), host, x)
    f = blended(series, series.fields, interval(series, t), t)[0]
    return blend_scalar(f, series.fields.shape[1] - OF_VISCOSITY, corners(flow.mesh, host, 0), w)


def curvature(flow: DeformingArrays, host: int, x: Vector, t: float) -> Curvature:
    """See :func:`foamprb.flow.walk.curvature`."""
    series, at = flow.series, mesh_at(flow, t)
    k = interval(series, t)
    if series.curvatures.shape[0] == 0:
        return curvature_in(at, host, blended(series, series.fields, k, t)[0], 3, 0)
    f = blended(series, series.curvatures, k, t)[0]
    return blend_curvature(f, corners(flow.mesh, host, 0), shape(at, host, x))


class DeformingFlow(MovingMeshFlow):
    """Flow given at several times on a mesh that deforms.

    Parameters
    ----------
    motion
        Motion of the mesh.
    shapes
        Places and velocities of the nodes, (n_nodes, 6), m and m/s, at the times that have been read, by
        their indices.
    mesh
        The mesh at the first time.
    given, options
        Those of :class:`SeriesFlow`.
    """

    kernels = named(
        sample, sample_ahead, curvature, walk, walk_on, gap, walls, wall_speeds, normal, wall_velocity,
        cross, recover, ride, turbulence, viscosity, cell_volume
    )  # fmt: skip
    around = 4

    def __init__(
        self, motion: Deformation, shapes: dict[int, Floats], mesh: Mesh, *given: Any, **options: Any
    ) -> None:
        super().__init__(mesh, *given, **options)
        self.motion, self._read_shapes = motion, shapes
        self._shapes = np.empty((0, len(self._arrays.nodes), 6))
        # Centres of faces in the planes of a layer keep their distance from those of the cells.
        added = (self.mesh.n_points - mesh.n_points) // mesh.n_cells
        self._depths = self.mesh.points[mesh.n_points :] - np.tile(mesh.centres, (added, 1))
        self._covered: tuple[int, ...] = ()
        self._graded: dict[int, tuple[NDArray[np.uint8], Floats]] = {}
        """Folds at the covered times, by their indices."""
        self._past_rows = np.full(len(self._arrays.nodes), -1, dtype=np.int32)
        self._past_rows[: mesh.n_points] = motion.rows
        of = self.mesh.triangle_patch
        for patch, other in motion.sliding:
            # The triangles of a patch are consecutive, and the first of the partners are all triangles.
            there = np.flatnonzero(of == other)
            self._arrays.across[of == patch] = there[0], there[-1] + 1
        past, ends = motion.past, np.append(*self.intervals())
        past = past if self.period is None else np.concatenate([past, past[:1]])
        rows = self._past_rows[self.mesh.triangles]
        own = np.flatnonzero((rows >= 0).all(axis=1))
        off = strays(past[:, :, :3], past[:, :, 3:], np.diff(ends))[rows[own]].max(axis=1, initial=0.0)
        self._past_tree = tree_of(past[0, rows[own], :3], own, off[:, None])

    @staticmethod
    def nothing() -> DeformingArrays:  # type: ignore[override]
        """See :meth:`MeshFlow.nothing`."""
        series = SeriesFlow.nothing()
        none, rows = np.empty((0, 6)), np.empty(0, dtype=np.int32)
        tree = tree_of(np.empty((0, 3, 3)), np.empty(0, dtype=np.intp))
        return DeformingArrays(series.mesh, series, none, none, 0, rows, *tree, np.empty(0), 0.0)

    def arrays(  # type: ignore[override]
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> DeformingArrays:
        """Return the arrays for the kernels; see :meth:`SeriesFlow.arrays`."""
        self._cover()
        series = super().arrays(reach, touchable, sight, seen)
        shapes, past = self._shapes.reshape(-1, 6), self.motion.past
        rows = past.reshape(-1, 6), past.shape[1], self._past_rows, *self._past_tree
        return DeformingArrays(series.mesh, series, shapes, *rows, *self.intervals())

    def _cover(self) -> None:
        """Let trees and folds hold at all loaded times."""
        rows = [self._in_memory[self._index(level)] for level in self._inner]
        key = *self._inner, *rows
        if not rows or key == self._covered:
            return
        self._covered, self._near, n = key, None, self.mesh.n_points
        x, w = self._shapes[rows, :, :3], self._shapes[rows, :, 3:]
        off = strays(x, w, np.diff([self._time_of(level) for level in self._inner]))
        mesh = replace(self.mesh, points=x[0, :n], centres=x[0, n:])
        start = mesh.cell_point_start[:-1]
        of_cells = np.maximum(np.maximum.reduceat(off[mesh.cell_points], start), off[n:])[:, None]
        boxes = cell_boxes(mesh) + of_cells * np.repeat([-1.0, 1.0], 3)
        tree = tree_with(self._arrays.tree_cells, boxes)
        known, most, at = self._graded, len(mesh.tets), [self._index(level) for level in self._inner]
        self._graded = {
            k: known[k] if k in known else graded(mesh, p, most) for k, p in zip(at, x, strict=True)
        }
        marks, folded = zip(*self._graded.values(), strict=True)
        folds = folds_of(mesh, np.max(marks, axis=0), np.concatenate(folded), tree, boxes, float(off.max()))
        self._arrays = self._arrays._replace(tree_boxes=tree.boxes, **folds)
        self._reference, self._boxes, self._off = mesh, boxes, off

    def _with_walls(
        self,
        reach: float,
        touchable: Sequence[int],
        sight: float,
        seen: Sequence[int],
    ) -> MeshArrays:
        mesh, arrays = self._reference, self._arrays
        names = np.flatnonzero(np.isin(mesh.triangle_patch, [*touchable, *seen])).astype(np.int32)
        corners, off = mesh.points[mesh.triangles[names]], self._off[mesh.triangles[names]].max(axis=1)
        if mesh.couplings:
            far = max(reach if touchable else 0.0, sight if seen else 0.0) + 2.0 * off.max(initial=0.0)
            images = images_of_walls(mesh, Walls(corners, mesh.triangle_normals[names], names), far)
            of = images.patches
            names = np.concatenate([names, len(mesh.triangles) + np.arange(len(of), dtype=np.int32)])
            corners = np.concatenate([corners, images.corners])
            off = np.concatenate([off, self._off[mesh.triangles[of]].max(axis=1)])
            arrays = arrays._replace(
                triangles=np.concatenate([arrays.triangles, self._place_images(of, images.corners)]),
                triangle_patch=np.concatenate([arrays.triangle_patch, arrays.triangle_patch[of]]),
            )
        some = np.isin(arrays.triangle_patch[names], seen)
        if some.any():
            # Each of them may be the nearest wall of some place at some time.
            far = sight + off[some, None]
            lower, upper = corners[some].min(axis=1) - far, corners[some].max(axis=1) + far
            tree = Tree(arrays.tree_boxes, arrays.tree_cells)
            start, found = pairs_near(self._boxes, tree, np.concatenate([lower, upper], axis=1))
            arrays = arrays._replace(seen_start=start, seen=2 * names[some][found] + 1)
        some = np.isin(arrays.triangle_patch[names], touchable)
        if not some.any():
            return arrays
        names, most = names[some], float(off[some].max())
        # Without normals no triangle stands for others in its plane.
        walls = wall_tree(corners[some], np.zeros((len(names), 3)), seen=False)
        walls = walls._replace(boxes=walls.boxes + most * np.repeat([-1.0, 1.0], 3))
        size = float(np.cbrt(np.median(mesh.volumes)))
        start, near = near_walls(walls, self._boxes, reach + most, names, size)
        leaves = np.where(walls.leaves < 0, np.int32(-1), names[walls.leaves])
        return arrays._replace(near_start=start, near=near, wall_boxes=walls.boxes, wall_leaves=leaves)

    def _place_images(self, of: Ints, corners: Floats) -> Ints:
        """Place the corners of images of triangles at the loaded times; return their nodes, (n, 3).

        Their rows follow those of all times in memory: that of a node is as far from row to row.
        """
        mesh, (capacity, n) = self._reference, self._fields.shape[:2]
        nodes = mesh.triangles[of].ravel()
        rows, columns = np.divmod(np.arange(len(nodes)), n)
        rows = capacity * (1 + rows)
        if len(nodes) and rows[-1] + capacity > len(self._shapes):
            self._shapes = self._grown(self._shapes, rows[-1] + capacity)
        # Triangles without an area have no inverse.
        back = np.linalg.pinv(_edges(mesh.points[mesh.triangles[of]]))
        turns = np.repeat(_edges(corners) @ back, 3, axis=0)
        shifts = corners.reshape(-1, 3) - np.einsum("nij,nj->ni", turns, mesh.points[nodes])
        for level in self._levels:
            place = self._in_memory[self._index(level)]
            shapes = self._shapes[place, nodes].reshape(-1, 2, 3) @ turns.transpose(0, 2, 1)
            shapes[:, 0] += shifts
            self._shapes[rows + place, columns] = shapes.reshape(-1, 6)
        return (rows * n + columns).astype(np.int32).reshape(-1, 3)

    def _make_room(self, wanted: Sequence[int]) -> None:
        before = len(self._fields)
        super()._make_room(wanted)
        if len(self._fields) > before:
            self._shapes, self._near = self._grown(self._shapes[:before], len(self._fields)), None

    def _fetch(self, index: int) -> None:
        super()._fetch(index)
        if index in self._read_shapes:
            self._shapes[self._in_memory[index]] = self._placed(self._read_shapes.pop(index))

    def _placed(self, shapes: Floats) -> Floats:
        """Return places and velocities of the nodes of the flow's mesh, by those of the given one."""
        wide, n = self.widened(shapes), len(self._depths)
        wide[self.mesh.n_points - n : self.mesh.n_points, :3] += self._depths
        return wide

    def nodes_at(self, t: float) -> Floats:
        """Load a time, s, and return the nodes then, (n_nodes, 3), m."""
        self.load(t, t)
        arrays = self.arrays()
        at = nodes_at(arrays, int(interval(arrays.series, t)), t)
        n, rows = len(self._arrays.nodes), (at.first, at.last)
        (x, v), (y, w) = (np.split(arrays.shapes[row : row + n], 2, axis=1) for row in rows)
        nodes: Floats = at.a * x + at.b * v + at.c * y + at.d * w
        return nodes


def strays(x: Floats, w: Floats, h: Floats) -> Floats:
    """Return how far points (n_times, n, 3) of velocities w go from the first places, (n,), m.

    ``h`` (n_times − 1,) are the times between, s.
    """
    chord, h = np.diff(x, axis=0), h[:, None, None]
    bulge = np.linalg.norm(h * w[:-1] - chord, axis=2) + np.linalg.norm(h * w[1:] - chord, axis=2)
    off: Floats = np.linalg.norm(x - x[0], axis=2).max(axis=0) + _BULGE * bulge.max(axis=0)
    return off


def _edges(corners: Floats) -> Floats:
    """Return matrices of two edges of triangles (n, 3, 3) and the normal, as columns."""
    p, q = corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]
    return np.stack([p, q, np.cross(p, q)], axis=2)


def _pull_all(flow: DeformingArrays, hosts: NDArray[np.int64], t: Floats, x: Floats, apart: bool) -> None:
    for i in range(len(hosts)):
        if hosts[i] >= 0:
            y = x[i, 0], x[i, 1], x[i, 2]
            if apart:
                w, rows = shape(mesh_at(flow, t[i]), hosts[i], y), corners(flow.mesh, hosts[i], 0)
                x[i, 0], x[i, 1], x[i, 2] = blend_vector(flow.mesh.nodes, 0, rows, w)
            else:
                x[i, 0], x[i, 1], x[i, 2] = ride(flow, hosts[i], y, t[i], flow.starts[0])[0]
