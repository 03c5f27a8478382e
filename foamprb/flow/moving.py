"""Flow on a mesh of which pieces move as rigid bodies: rotors, sliding parts, tanks that are shaken.

A piece is a set of cells joined by faces. Its mesh stands still in a frame of its own: x at the time t has
the place X there, with x = Q(t)·(X − c) + y(t). The kernels pull a place into the frame of the host's piece,
do there what :mod:`foamprb.flow.series` does, and push the result back. The fields in the frame are relative
to the piece, so that its walls are at rest and closed: u = w(x, t) + Q·V(X, t) with w = ẏ + Ω × (x − y).
States of particles are those of the inertial frame.

In the mesh of the kernels the pieces lie apart along x, by :attr:`MovingArrays.pitch`, so that neither the
search of a cell nor that of a wall finds another piece.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import replace
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import (
    Tensor,
    Vector,
    between,
    dot,
    dot_vector,
    inner,
    minus,
    plus,
    plus_scaled,
    scale_vector,
    to_frame,
    transpose,
    turn_about,
    vector_dot,
    vector_product,
)
from foamprb.compile.link import link
from foamprb.compile.record import record
from foamprb.flow.base import Floats, Ints, PatchFaces, Planes, Tetrahedra, Turbulence
from foamprb.flow.kernels import linked_with, named
from foamprb.flow.kernels import recover as recover_kernel
from foamprb.flow.mesh.arrays import FREE, MeshArrays, arm, nodes_of
from foamprb.flow.mesh.coupling import Coupling
from foamprb.flow.mesh.locator import locate as locate_mesh
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.mesh.tree import build_tree, next_node, square_to_box
from foamprb.flow.meshflow import MeshFlow, shortest_extent
from foamprb.flow.motion import Motion, spins
from foamprb.flow.planes import walls as walls_mesh
from foamprb.flow.sampling import sample_with, with_velocity
from foamprb.flow.series import SeriesArrays, SeriesFlow
from foamprb.flow.series import _interval as interval_of
from foamprb.flow.series import cell_volume as cell_volume_series
from foamprb.flow.series import curvature as curvature_series
from foamprb.flow.series import sample as sample_series
from foamprb.flow.series import turbulence as turbulence_series
from foamprb.flow.series import viscosity as viscosity_series
from foamprb.flow.walk import FAILED, Weights, follow, inward, middle_of, nearest_point, shape
from foamprb.flow.walk import cross as cross_mesh
from foamprb.flow.walk import walk as walk_mesh
from foamprb.flow.walk import walk_on as walk_on_mesh
from foamprb.flow.walls import gap as gap_mesh

_APART = 4.0
"""Distance between the middles of pieces in the mesh of the kernels, over the size of the mesh."""
_SMALL = 1e-6
_SAME: Tensor = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
_CENTRE, _MEANS = 30, 33
"""First columns of :attr:`MovingArrays.poses`."""


@record
class MovingArrays(NamedTuple):
    """Arrays of a flow on a moving mesh that the kernels read."""

    mesh: MeshArrays
    """The mesh of ``series``: each piece in its frame."""
    series: SeriesArrays
    """Fields relative to the pieces, in their frames."""
    poses: Floats
    """(n, n_pieces, 46), for each interval of Δ s between times of the flow: y at the start, its
    way to the end, and Δ ẏ at both ends; Q at the start, the rotation vector r to the end, and Δ dr/dt at
    both ends; c; the mean velocities of the piece, m/s, at both ends in the inertial frame, and in that of
    the piece; 1 if the former are blended."""
    starts: Floats
    """(n,) the starts of the intervals, s."""
    end: float
    """End of the last interval, s: there the first one follows, if the flow has a period."""
    level: int
    """Interval of the first loaded time."""
    first: float
    """Lowest x of the mesh, m: piece p lies from ``first`` + p ``pitch`` on."""
    pitch: float
    boxes: Floats
    """Boxes of a tree over the triangles of interfaces between pieces; see :class:`MeshArrays`."""
    leaves: Ints
    """(n_leaves, leaf size) triangles, −1 for none."""
    beyond: Ints
    """(n_patches,) the patch on another piece that continues each, −1 for none."""

    def pulled(self, x: Floats, hosts: Ints, t: Floats, apart: bool = True) -> Floats:
        """Return places (n, 3) at times (n,) in the frames of their hosts, (n,); without a host as they are.

        In the mesh of the kernels pieces are ``apart``; otherwise the frames are those of the first time.
        """
        X = np.array(x, dtype=np.float64)
        link(_pull_all)(self, np.ascontiguousarray(hosts, dtype=np.int64), np.ascontiguousarray(t), X, apart)
        return X


class Pose(NamedTuple):
    """Place of the frame of a piece at a time: x = Q·(X − c) + y."""

    Q: Tensor
    y: Vector
    c: Vector


class Rates(NamedTuple):
    """Rates of a pose: angular velocity Ω, 1/s, ẏ, m/s, and the rates of both."""

    omega: Vector
    velocity: Vector
    omega_t: Vector
    velocity_t: Vector


def piece_of(flow: MovingArrays, host: int) -> int:
    """Return the piece of a host."""
    return piece_at(flow, flow.mesh.nodes[flow.mesh.tets[host, 0], 0])


def piece_at(flow: MovingArrays, x: float) -> int:
    """Return the piece at the first coordinate of a place in the frames."""
    return int((x - flow.first) / flow.pitch)


def _vector(flow: MovingArrays, k: int, p: int, column: int) -> Vector:
    poses = flow.poses
    return poses[k, p, column], poses[k, p, column + 1], poses[k, p, column + 2]


def _interval(flow: MovingArrays, t: float) -> tuple[int, float, float]:
    """Return the row of ``poses`` of the loaded interval that holds t, the share that has passed, and Δ."""
    k = interval_of(flow.series, t)
    start = flow.series.times[k]
    length = flow.series.times[k + 1] - start
    return (flow.level + k) % flow.poses.shape[0], (t - start) / length, length


def any_interval(flow: Any, t: float) -> tuple[int, float, float]:
    """Return the same of any time of the flow."""
    n, whole = flow.starts.shape[0], flow.end - flow.starts[0]
    if t > flow.end:
        t -= whole * math.floor((t - flow.starts[0]) / whole)
    k, last = 0, n - 1
    while k < last:
        middle = (k + last + 1) // 2
        k, last = (middle, last) if flow.starts[middle] <= t else (k, middle - 1)
    length = (flow.starts[k + 1] if k < n - 1 else flow.end) - flow.starts[k]
    return k, (t - flow.starts[k]) / length, length


def hermite(s: float, h: float) -> Weights:
    """Return the weights of value and rate at the start of an interval, h s long, and at its end."""
    g = 1.0 - s
    return g * g * (1.0 + 2.0 * s), h * s * g * g, s * s * (3.0 - 2.0 * s), -h * s * s * g


def hermite_rate(s: float, h: float) -> Weights:
    """Return the derivatives of :func:`hermite`, 1/s."""
    g, w = 1.0 - s, 6.0 * s * (1.0 - s) / h
    return -w, g * (1.0 - 3.0 * s), w, s * (3.0 * s - 2.0)


def _way(w: Weights, flow: MovingArrays, k: int, p: int, column: int) -> Vector:
    """Return the weighted sum of the way in an interval, from a column on, and the rates at its ends."""
    way, a, b = _vector(flow, k, p, column), _vector(flow, k, p, column + 3), _vector(flow, k, p, column + 6)
    return plus(scale_vector(w[2], way), plus(scale_vector(w[1], a), scale_vector(w[3], b)))


def rotation(r: Vector) -> Tensor:
    """Return the matrix of a rotation vector."""
    angle2 = inner(r, r)
    angle = math.sqrt(angle2)
    a, b = (math.sin(angle) / angle, (1.0 - math.cos(angle)) / angle2) if angle > _SMALL else (1.0, 0.5)
    d = math.cos(angle) if angle > _SMALL else 1.0 - 0.5 * angle2
    return turn_about(r, a, b, d)


def pose(flow: MovingArrays, p: int, t: float) -> Pose:
    """Return the pose of piece p at a time, s, in the loaded interval."""
    k, s, _ = _interval(flow, t)
    return _pose(flow, p, k, s)


def _pose(flow: MovingArrays, p: int, k: int, s: float) -> Pose:
    """Return the pose of piece p after the share s of interval k."""
    w = hermite(s, 1.0)
    y, r = plus(_vector(flow, k, p, 0), _way(w, flow, k, p, 3)), _way(w, flow, k, p, 21)
    Q = _start(flow, k, p)
    if r[0] != 0.0 or r[1] != 0.0 or r[2] != 0.0:
        Q = dot(rotation(r), Q)
    return Pose(Q, y, _vector(flow, k, p, _CENTRE))


def _start(flow: MovingArrays, k: int, p: int) -> Tensor:
    a, b, c = _vector(flow, k, p, 12), _vector(flow, k, p, 15), _vector(flow, k, p, 18)
    return a[0], a[1], a[2], b[0], b[1], b[2], c[0], c[1], c[2]


def rates(flow: MovingArrays, p: int, t: float) -> Rates:
    """Return the rates of the pose of piece p at a time, s, in the loaded interval."""
    k, s, h = _interval(flow, t)
    return _rates(flow, p, k, s, h)


def _rates(flow: MovingArrays, p: int, k: int, s: float, h: float) -> Rates:
    """Return the rates of the pose of piece p after the share s of interval k, h s long.

    Ω = J dr/dt with the left Jacobian J of the rotation vector r (Chirikjian 2011, Stochastic models II, 10).
    Of dΩ/dt, what changes with J is left out: it vanishes where the axis keeps its direction.
    """
    e, w, bend = 1.0 / h, hermite_rate(s, 1.0), (0.0, 6.0 * s - 4.0, 6.0 - 12.0 * s, 6.0 * s - 2.0)
    r = _way(hermite(s, 1.0), flow, k, p, 21)
    r_t, r_tt = scale_vector(e, _way(w, flow, k, p, 21)), scale_vector(e * e, _way(bend, flow, k, p, 21))
    y_t, y_tt = scale_vector(e, _way(w, flow, k, p, 3)), scale_vector(e * e, _way(bend, flow, k, p, 3))
    return Rates(_spun(r, r_t), y_t, _spun(r, r_tt), y_tt)


def _spun(r: Vector, v: Vector) -> Vector:
    """Return J·v, with the left Jacobian J of a rotation vector r."""
    angle2 = inner(r, r)
    angle = math.sqrt(angle2)
    b, c = 0.5, 1.0 / 6.0
    if angle > _SMALL:
        b, c = (1.0 - math.cos(angle)) / angle2, (angle - math.sin(angle)) / (angle2 * angle)
    across = vector_product(r, v)
    return plus(v, plus(scale_vector(b, across), scale_vector(c, vector_product(r, across))))


def pull(q: Pose, x: Vector) -> Vector:
    """Return the place in the frame of a piece."""
    return plus(q.c, vector_dot(minus(x, q.y), q.Q))


def push(q: Pose, X: Vector) -> Vector:
    """Return the place in the inertial frame."""
    return plus(q.y, dot_vector(q.Q, minus(X, q.c)))


def speed(q: Pose, of: Rates, x: Vector) -> Vector:
    """Return w, the velocity of a piece at x, m/s."""
    return plus(of.velocity, vector_product(of.omega, minus(x, q.y)))


def sample(flow: MovingArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, gradient and rate in the inertial frame; see :func:`foamprb.flow.kernels.sample`.

    Along a path of velocity v the acceleration is that of the frame, w_t + W·v with W·a = Ω × a, and
    Ω × Q·V + Q·(V_t + L·Qᵀ·(v − w)).
    """
    p = piece_of(flow, host)
    k, s, h = _interval(flow, t)
    q, of = _pose(flow, p, k, s), _rates(flow, p, k, s, h)
    X = pull(q, x)
    V, L, V_t = sample_series(flow.series, host, X, t)
    w, o = speed(q, of, x), of.omega
    V, l = dot_vector(q.Q, V), to_frame(q.Q, L)
    frame = minus(of.velocity_t, vector_product(o, of.velocity))
    frame = plus(frame, vector_product(of.omega_t, minus(x, q.y)))
    u_t = plus(plus(frame, vector_product(o, V)), minus(dot_vector(q.Q, V_t), dot_vector(l, w)))
    u = plus(w, V)
    if flow.poses[k, p, 45] > 0.0:
        m, m_t = _of_mean(flow, k, p, s, h, q.Q, o)
        free = _freely(flow.mesh, host, X)
        u, u_t = plus_scaled(u, free, m), plus_scaled(u_t, free, m_t)
    l = (
        l[0], l[1] - o[2], l[2] + o[1],
        l[3] + o[2], l[4], l[5] - o[0],
        l[6] - o[1], l[7] + o[0], l[8],
    )  # fmt: skip
    return u, l, u_t


def _of_mean(
    flow: MovingArrays, k: int, p: int, s: float, h: float, Q: Tensor, omega: Vector
) -> tuple[Vector, Vector]:
    """Return the mean velocity of a piece, linear in time, less what turns with it; and the rate of this."""
    U0, U1 = _vector(flow, k, p, _MEANS), _vector(flow, k, p, _MEANS + 3)
    m0, m1 = _vector(flow, k, p, _MEANS + 6), _vector(flow, k, p, _MEANS + 9)
    turned = dot_vector(Q, between(m0, m1, s))
    rate = minus(minus(U1, U0), dot_vector(Q, minus(m1, m0)))
    return minus(between(U0, U1, s), turned), minus(
        scale_vector(1.0 / h, rate), vector_product(omega, turned)
    )


def _freely(mesh: MeshArrays, host: int, X: Vector) -> float:
    """Return the sum of the weights of nodes off the walls."""
    a, b, c, d = nodes_of(mesh, host)
    w, nodes = shape(mesh, host, X), mesh.nodes
    fa, fb, fc, fd = nodes[a, FREE], nodes[b, FREE], nodes[c, FREE], nodes[d, FREE]
    return float(max(fa, 0.0) * w[0] + max(fb, 0.0) * w[1] + max(fc, 0.0) * w[2] + max(fd, 0.0) * w[3])


def sample_ahead(
    flow: MovingArrays, host: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, Vector, Tensor, Vector]:
    """See :func:`foamprb.flow.walk.sample_ahead`."""
    p = piece_of(flow, host)
    X0, X1 = pull(pose(flow, p, t0), x0), pull(pose(flow, p, t1), x1)
    last, _, patch, _, entered = follow(flow.mesh, host, X0, X1)
    last = host if patch == FAILED else last
    u, l, u_t = sample(flow, last, x1, t1)
    return last, 0.0, entered, u, l, u_t


def walk(
    flow: MovingArrays, host: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk`: the way is straight in the frame of the host's piece."""
    p = piece_of(flow, host)
    return walk_mesh(flow.mesh, host, pull(pose(flow, p, t0), x0), pull(pose(flow, p, t1), x1))


def walk_on(
    flow: MovingArrays, host: int, ahead: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """See :func:`foamprb.flow.walk.walk_on` and :func:`walk`."""
    p = piece_of(flow, host)
    ahead = ahead if piece_of(flow, ahead) == p else host
    return walk_on_mesh(flow.mesh, host, ahead, pull(pose(flow, p, t0), x0), pull(pose(flow, p, t1), x1))


def gap(
    flow: MovingArrays, host: int, x: Vector, F: Tensor, R: float, mode: Any = (), t: float = 0.0
) -> tuple[float, int, int]:
    """See :func:`foamprb.flow.walls.gap`; the walls of the host's piece."""
    q = pose(flow, piece_of(flow, host), t)
    return gap_mesh(flow.mesh, host, pull(q, x), dot(transpose(q.Q), F), R, mode)


def walls(flow: MovingArrays, host: int, x: Vector, cut: float, chosen: NDArray[np.int8], t: float) -> Planes:
    """See :func:`foamprb.flow.planes.walls`; the walls of the host's piece."""
    q = pose(flow, piece_of(flow, host), t)
    h1, n1, h2, n2, h3, n3 = walls_mesh(flow.mesh, host, pull(q, x), cut, chosen)
    return Planes(h1, dot_vector(q.Q, n1), h2, dot_vector(q.Q, n2), h3, dot_vector(q.Q, n3))


def wall_speeds(flow: MovingArrays, host: int, x: Vector, planes: Planes, t: float) -> Vector:
    """See :func:`foamprb.flow.kernels.wall_speeds`: along a normal of a piece its velocity is the same."""
    p = piece_of(flow, host)
    w = speed(pose(flow, p, t), rates(flow, p, t), x)
    return inner(planes.n1, w), inner(planes.n2, w), inner(planes.n3, w)


def _piece_of_triangle(flow: MovingArrays, triangle: int) -> int:
    return piece_at(flow, flow.mesh.nodes[flow.mesh.triangles[triangle, 0], 0])


def normal(flow: MovingArrays, triangle: int, x: Vector, t: float) -> Vector:  # noqa: ARG001
    """See :func:`foamprb.flow.walk.normal`."""
    return dot_vector(pose(flow, _piece_of_triangle(flow, triangle), t).Q, inward(flow.mesh, triangle))


def wall_velocity(flow: MovingArrays, triangle: int, x: Vector, t: float) -> Vector:
    """Return the velocity of the piece of a triangle at x, m/s."""
    p = _piece_of_triangle(flow, triangle)
    return speed(pose(flow, p, t), rates(flow, p, t), x)


def ride(flow: MovingArrays, host: int, x: Vector, t0: float, t1: float) -> tuple[Vector, Tensor, Vector]:
    """Return place, turn and velocity at t1 of what sticks to the host's piece and was at x at t0."""
    p = piece_of(flow, host)
    k, s, _ = any_interval(flow, t0)
    old = _pose(flow, p, k, s)
    k, s, h = any_interval(flow, t1)
    new = _pose(flow, p, k, s)
    y = push(new, pull(old, x))
    return y, dot(new.Q, transpose(old.Q)), speed(new, _rates(flow, p, k, s, h), y)


def cross(flow: MovingArrays, triangle: int, x: Vector, t: float) -> tuple[int, Vector, Tensor]:
    """See :func:`foamprb.flow.walk.cross`; between pieces the place stays."""
    mesh, p = flow.mesh, _piece_of_triangle(flow, triangle)
    q, other = pose(flow, p, t), flow.beyond[mesh.triangle_patch[triangle]]
    if other < 0:
        host, X, turn = cross_mesh(mesh, triangle, pull(q, x))
        return host, push(q, X), to_frame(q.Q, turn)
    a = _nearest(flow, other, p, x, t)
    if a < 0:
        return -1, x, _SAME
    to = pose(flow, piece_of(flow, a), t)
    X = pull(to, x)
    host, _, patch, _, _ = follow(mesh, a, middle_of(mesh, a), X)
    return a if patch == FAILED else host, x, _SAME


def _nearest(flow: MovingArrays, patch: int, p: int, x: Vector, t: float) -> int:
    """Return the tetrahedron behind the triangle of a patch, not of piece p, that is nearest to x."""
    mesh, boxes, leaves = flow.mesh, flow.boxes, flow.leaves
    best, found = math.inf, -1
    for other in range(flow.poses.shape[1]):
        X = pull(pose(flow, other, t), x)
        node, n_leaves = 1, leaves.shape[0]
        while node > 0:
            hit = other != p and square_to_box(boxes, node, X) < best
            for k in range(leaves.shape[1] if hit and node >= n_leaves else 0):
                triangle = leaves[node - n_leaves, k]
                if triangle < 0 or mesh.triangle_patch[triangle] != patch:
                    continue
                if _piece_of_triangle(flow, triangle) != other:
                    continue
                at, row = mesh.triangles, triangle
                a, b, c = at[row, 0], at[row, 1], at[row, 2]
                n = nearest_point(arm(mesh.nodes, a, X), arm(mesh.nodes, b, X), arm(mesh.nodes, c, X))
                if inner(n, n) < best:
                    best, found = inner(n, n), int(mesh.triangle_tet[triangle])
            node = next_node(node, n_leaves, hit)
    return found


def recover(flow: MovingArrays, x: Vector, t: float) -> int:
    """See :func:`foamprb.flow.walk.recover`; the first piece counts that holds x."""
    for p in range(flow.poses.shape[1]):
        host = locate_mesh(flow.mesh, pull(pose(flow, p, t), x))
        if host >= 0:
            return host
    return -1


def cell_volume(flow: MovingArrays, host: int) -> float:
    """See :func:`foamprb.flow.walk.cell_volume`."""
    return cell_volume_series(flow.series, host)


def turbulence(flow: MovingArrays, host: int, x: Vector, t: float) -> Turbulence:
    """See :func:`foamprb.flow.series.turbulence`."""
    q = pose(flow, piece_of(flow, host), t)
    k, epsilon, a, b = turbulence_series(flow.series, host, pull(q, x), t)
    return k, epsilon, dot_vector(q.Q, a), dot_vector(q.Q, b)


def viscosity(flow: MovingArrays, host: int, x: Vector, t: float) -> tuple[float, Vector]:
    """See :func:`foamprb.flow.series.viscosity`."""
    q = pose(flow, piece_of(flow, host), t)
    value, slope = viscosity_series(flow.series, host, pull(q, x), t)
    return value, dot_vector(q.Q, slope)


def curvature(flow: MovingArrays, host: int, x: Vector, t: float) -> Curvature:
    """See :func:`foamprb.flow.series.curvature`; turned with the piece."""
    q = pose(flow, piece_of(flow, host), t)
    xx, yy, zz, xy, yz, xz = curvature_series(flow.series, host, pull(q, x), t)
    a = dot_vector(q.Q, xx), dot_vector(q.Q, xy), dot_vector(q.Q, xz)
    b = dot_vector(q.Q, xy), dot_vector(q.Q, yy), dot_vector(q.Q, yz)
    c = dot_vector(q.Q, xz), dot_vector(q.Q, yz), dot_vector(q.Q, zz)
    # For each component, its matrix of second derivatives.
    x_ = to_frame(q.Q, (a[0][0], a[1][0], a[2][0], b[0][0], b[1][0], b[2][0], c[0][0], c[1][0], c[2][0]))
    y_ = to_frame(q.Q, (a[0][1], a[1][1], a[2][1], b[0][1], b[1][1], b[2][1], c[0][1], c[1][1], c[2][1]))
    z_ = to_frame(q.Q, (a[0][2], a[1][2], a[2][2], b[0][2], b[1][2], b[2][2], c[0][2], c[1][2], c[2][2]))
    return (
        (x_[0], y_[0], z_[0]), (x_[4], y_[4], z_[4]), (x_[8], y_[8], z_[8]),
        (x_[1], y_[1], z_[1]), (x_[5], y_[5], z_[5]), (x_[2], y_[2], z_[2]),
    )  # fmt: skip


class MovingMeshFlow(SeriesFlow):
    """Flow given at several times on a mesh that moves."""

    axisymmetric = False

    def nodes_at(self, t: float) -> Floats:
        """Load a time, s, and return the nodes then, (n_nodes, 3), m."""
        raise NotImplementedError

    def intervals(self) -> tuple[Floats, float]:
        """Return the starts (n,) of the intervals between times, s, and the end of the last one."""
        if self.period is None:
            return np.array(self.times[:-1]), self.times[-1]
        return np.array(self.times), self.times[0] + self.period

    def patch_faces(self, name: str, t: float) -> PatchFaces:
        """See :meth:`SeriesFlow.patch_faces`; at their places at t."""
        faces, x = MeshFlow.patch_faces(self, name, t), self.nodes_at(t)
        at = self.mesh.triangle_patch == [patch.name for patch in self.patches].index(name)
        corners = x[self.mesh.triangles[at]]
        normals = np.cross(corners[:, 2] - corners[:, 0], corners[:, 1] - corners[:, 0])
        areas = np.linalg.norm(normals, axis=1)
        normals /= np.maximum(areas, 1e-300)[:, None]
        faces = faces._replace(vertices=corners, normals=normals, areas=0.5 * areas)
        return with_velocity(faces, self, t)

    def cell_zone(self, name: str | None, t: float | None = None) -> Tetrahedra:
        """See :meth:`MeshFlow.cell_zone`; at the time t, s, by default the first."""
        zone, x = super().cell_zone(name), self.nodes_at(self.times[0] if t is None else t)

        def vertices(hosts: Ints) -> Floats:
            return x[self.mesh.tets[hosts]]

        corners = vertices(zone.hosts)
        return Tetrahedra(np.linalg.det(corners[:, 1:] - corners[:, :1]) / 6.0, zone.hosts, vertices)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:
        """See :meth:`SeriesFlow.sample`."""
        self.load(t, t)
        return sample_with(self.kernels["sample"], self.arrays(), points, hosts, t)

    def locate(self, points: Floats, t: ArrayLike | None = None) -> Ints:
        """Return the hosts (n,) of points (n, 3) at times t, s, by default the first; −1 outside."""
        points = np.ascontiguousarray(points, dtype=np.float64)
        times = np.broadcast_to(np.asarray(self.times[0] if t is None else t, dtype=float), len(points))
        hosts = np.empty(len(points), dtype=np.int32)
        for time in np.unique(times):
            self.load(time, time)
            rows = np.flatnonzero(times == time)
            found = np.empty(len(rows), dtype=np.int32)
            locate_all, flow = linked_with(self.kernels, self.arrays(), _locate_all)
            locate_all(flow, points[rows], float(time), found)
            hosts[rows] = found
        return hosts


class MovingFlow(MovingMeshFlow):
    """Flow given at several times on a mesh of rigid pieces that move.

    Parameters
    ----------
    motion
        Motion of the pieces.
    means
        Mean velocities of the pieces, (n_pieces, 3), m/s, at the times that have been read, by their indices.
    mesh
        The mesh at the first time.
    given, options
        Those of :class:`SeriesFlow`; ``read`` returns fields relative to the pieces, in their frames.
    """

    kernels = named(
        sample, sample_ahead, curvature, walk, walk_on, gap, walls, wall_speeds, normal, wall_velocity,
        cross, recover, ride, turbulence, viscosity, cell_volume
    )  # fmt: skip

    def __init__(
        self, motion: Motion, means: Mapping[int, Floats], mesh: Mesh, *given: Any, **options: Any
    ) -> None:
        self.motion, self._means = motion, means
        nodes, pieces = mesh.nodes, motion.nodes(mesh)
        low, size = nodes.min(axis=0), float(np.ptp(nodes, axis=0).max())
        self._pitch, self._low = _APART * size, float(low[0]) - 0.5 * (_APART - 1.0) * size
        super().__init__(_apart(mesh, motion, pieces, self._pitch), *given, **options)
        self._apart, couplings, owner = self.mesh, mesh.couplings, mesh.owner[mesh.n_internal :]
        if self._division is not None:
            mesh = _apart(self.mesh, motion, motion.nodes(self.mesh), -self._pitch)
        self.mesh, self.bounds, self.width = mesh, (low, nodes.max(axis=0)), shortest_extent(mesh)
        self._rows = np.array([self._poses(i) for i in range(len(motion.turns))])
        self._beyond = np.full(len(mesh.patches), -1, dtype=np.int32)
        for c in couplings:
            if len(c.faces) and (motion.piece[owner[c.faces]] != motion.piece[owner[c.partners]]).any():
                self._beyond[c.patch] = c.other
        between = np.flatnonzero(self._beyond[self._apart.triangle_patch] >= 0)
        self._tree = tree_of(self._apart.points[self._apart.triangles[between]], between)

    @staticmethod
    def nothing() -> MovingArrays:  # type: ignore[override]
        """See :meth:`MeshFlow.nothing`."""
        series = SeriesFlow.nothing()
        none = np.empty((0, 1), dtype=np.int32)
        return MovingArrays(
            series.mesh, series, np.empty((0, 0, 46)), np.empty(0), 0.0, 0, 0.0, 1.0, np.empty((0, 6)),
            none, none[:, 0].copy(),
        )  # fmt: skip

    def arrays(  # type: ignore[override]
        self,
        reach: float = 0.0,
        touchable: Sequence[int] | None = None,
        sight: float = 0.0,
        seen: Sequence[int] = (),
    ) -> MovingArrays:
        """Return the arrays for the kernels; see :meth:`SeriesFlow.arrays`."""
        series = super().arrays(reach, touchable, sight, seen)
        for level in self._levels[:-1]:
            self._set_means(self._index(level), self._index(level + 1))
        level = self._index(self._levels[0]) if len(self._levels) else 0
        return MovingArrays(
            series.mesh, series, self._rows.copy(), *self.intervals(), level, self._low, self._pitch,
            *self._tree, self._beyond,
        )  # fmt: skip

    def _poses(self, i: int) -> Floats:
        """Return the rows of :attr:`MovingArrays.poses` of an interval, without means."""
        m, j, count = self.motion, self._index(i + 1), len(self.motion.names)
        h, rows = self._time_of(i + 1) - self._time_of(i), np.zeros((count, 46))
        way = m.y[j] - m.y[i]
        rows[:, 0:12] = np.concatenate([m.y[i], way, h * m.velocity[i], h * m.velocity[j]], axis=1)
        end = [np.linalg.solve(_jacobian(r), h * o) for r, o in zip(m.turns[i], m.omega[j], strict=True)]
        rows[:, 12:30] = np.concatenate([m.Q[i].reshape(-1, 9), m.turns[i], h * m.omega[i], end], axis=1)
        rows[:, _CENTRE:_MEANS] = m.c
        rows[:, _CENTRE] += self._pitch * np.arange(count)
        return rows

    def _set_means(self, i: int, j: int) -> None:
        """Set the mean velocities of the interval between two times that have been read."""
        U0, U1, Q = self._means[i], self._means[j], self.motion.Q
        own = [np.einsum("pba,pb->pa", Q[k], U) for k, U in ((i, U0), (j, U1))]
        self._rows[i, :, _MEANS:45] = np.concatenate([U0, U1, *own], axis=1)
        turned = np.einsum("pab,pb->pa", Q[j], own[0])
        self._rows[i, :, 45] = np.linalg.norm(U1 - U0, axis=1) < np.linalg.norm(U1 - turned, axis=1)

    def _with_walls(
        self, reach: float, touchable: Sequence[int], sight: float, seen: Sequence[int]
    ) -> MeshArrays:
        mesh, self.mesh = self.mesh, self._apart
        try:
            return super()._with_walls(reach, touchable, sight, seen)
        finally:
            self.mesh = mesh

    def at_nodes(self) -> tuple[str, Floats, Floats]:
        """See :meth:`SeriesFlow.at_nodes`."""
        name, u, l = super().at_nodes()
        m, pieces = self.motion, self.motion.nodes(self.mesh)
        own = u + m.speed(0, self.mesh.nodes, pieces), l + spins(m.omega[0])[pieces].reshape(-1, 9)
        return name, *own

    def traits(self) -> Mapping[str, ArrayLike]:
        """See :meth:`SeriesFlow.traits`; with the first pose."""
        return {**super().traits(), "poses": self._rows[0, :, :_MEANS]}

    def nodes_at(self, t: float) -> Floats:
        """See :meth:`MovingMeshFlow.nodes_at`."""
        self.load(t, t)
        arrays, pieces, x = self.arrays(), self.motion.nodes(self.mesh), self.mesh.nodes
        for p in range(len(self.motion.names)):
            q, own = pose(arrays, p, t), pieces == p
            x[own] = (x[own] - self.motion.c[p]) @ np.reshape(q.Q, (3, 3)).T + q.y
        return x


def _pull_all(flow: MovingArrays, hosts: NDArray[np.int64], t: Floats, x: Floats, apart: bool) -> None:
    for i in range(len(hosts)):
        if hosts[i] >= 0:
            p = piece_of(flow, hosts[i])
            k, s, _ = any_interval(flow, t[i])
            X = pull(_pose(flow, p, k, s), (x[i, 0], x[i, 1], x[i, 2]))
            x[i, 0], x[i, 1], x[i, 2] = X[0] - (0.0 if apart else p * flow.pitch), X[1], X[2]


def _locate_all(flow: Any, points: Floats, t: float, hosts: Ints) -> None:
    for i in range(points.shape[0]):
        hosts[i] = recover_kernel(flow, (points[i, 0], points[i, 1], points[i, 2]), t)


def _jacobian(r: Floats) -> Floats:
    """Return the left Jacobian of a rotation vector, (3, 3)."""
    x, y, z = np.eye(3)
    J: Floats = np.array([_spun(tuple(r), tuple(e)) for e in (x, y, z)]).T
    return J


def _apart(mesh: Mesh, motion: Motion, pieces: NDArray[np.int64], pitch: float) -> Mesh:
    """Return the mesh with its pieces, of the nodes ``pieces``, moved apart along x."""
    shift = np.zeros((len(pieces), 3))
    shift[:, 0] = pitch * pieces
    owner = mesh.owner[mesh.n_internal :]
    couplings = [
        _shifted(c, pitch * float(motion.piece[owner[c.faces[0]]]))
        for c in motion.within(mesh)
        if len(c.faces)
    ]
    return replace(
        mesh,
        points=mesh.points + shift[: mesh.n_points],
        centres=mesh.centres + shift[mesh.n_points :],
        boundary_centres=mesh.boundary_centres + shift[mesh.n_points :][owner],
        couplings=tuple(couplings),
    )


def _shifted(c: Coupling, way: float) -> Coupling:
    """Return a coupling whose patches have been moved along x."""
    return c._replace(shift=c.shift + way * np.eye(3)[0] - way * c.turn[:, 0])


def tree_of(corners: Floats, triangles: NDArray[np.intp], off: Floats | float = 0.0) -> tuple[Floats, Ints]:
    """Return boxes and leaves of a tree over triangles (n,) whose corners (n, 3, 3) move by up to ``off``."""
    if len(triangles) == 0:
        return np.empty((2, 6)), np.full((1, 1), -1, dtype=np.int32)
    lower, upper = corners.min(axis=1) - off, corners.max(axis=1) + off
    tree = build_tree(np.concatenate([lower, upper], axis=1))
    leaves = np.where(tree.leaves < 0, -1, triangles[tree.leaves])
    return tree.boxes, np.ascontiguousarray(leaves, dtype=np.int32)
