"""Correction of the interpolated velocity that keeps the volume of the fluid.

A velocity u that is interpolated between the nodes makes volume in some tetrahedra and loses it in others, so
that particles gather, above all at walls. The correction c is a field of Brezzi, Douglas and Marini's first
order (Numer. Math. 47, 217, 1985): linear in each tetrahedron, with a normal component that is continuous
across the triangles between them. Its fluxes give each tetrahedron its share of what the cell makes, which is
nothing in an incompressible flow; where the density varies, cells make and lose no mass. On a triangle c is
distributed over the free nodes, those that lie on no wall, so that walls keep their velocity at every point.
In tetrahedra, pyramids and prisms, most of whose nodes lie on walls beside one, all nodes are free: c is then
along walls. A face between cells whose nodes all lie on walls carries a uniform flux. A second part, with no
component normal to the triangles, makes the divergence the same everywhere in a tetrahedron:
¼ Σ d_k λ_k (x_k − x), with the divergence d_k of u at vertex k (:func:`foamprb.flow.walk.correction_at`).

The fluxes through the faces of the cells are the smallest change of the interpolated ones that conserves
volume; those through the triangles in a cell likewise. OpenFOAM's ``phi`` is not used: it is the velocity at
the middle of a face times the area, which exceeds the integral by the curvature of the profile.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus, plus, scale_vector, vector_product
from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.balance import BALANCED, CONSTANT, Balance, Mass, closed_pieces
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import arm, bends, point
from foamprb.flow.mesh.communicator import SINGLE_NODE, MeshCommunicator
from foamprb.flow.mesh.interfaces import face_pairs
from foamprb.flow.mesh.lists import Mask, share
from foamprb.flow.mesh.mesh import Mesh
from foamprb.flow.patches import PatchKind

_LEAST_ALONG = 0.02
"""Least cosine between a face's normal and the line of the cell centres that counts in its weight."""
_LARGEST_CHANGE = 1.0
"""Largest change of the velocity through faces; see :class:`~foamprb.flow.balance.Balanced`."""
# Sum of squares of what the tetrahedra of a cell may still lack, over that of their fluxes.
_EXACT = 1e-14
_ROWS = 7
"""Rows of working memory of :func:`correct`."""
_SIZE, _COUNT = 3, 4
"""Columns of its sides: the length of the area vector, m², and the number of free nodes."""


class NodalFlow(NamedTuple):
    """Places x, m, velocity u, m/s, its gradient l, 1/s, and mask ``free`` at the nodes of a mesh."""

    x: Floats
    u: Floats
    l: Floats
    free: Floats


class Sides(NamedTuple):
    """Faces and cells of a mesh; see :class:`~foamprb.flow.mesh.mesh.Mesh`."""

    face_start: Ints
    face_points: Ints
    owner: Ints
    neighbour: Ints
    cell_face_start: Ints
    cell_faces: Ints
    cell_start: Ints
    tets: Ints
    neighbours: Ints


class Measures(NamedTuple):
    """Measures of faces, (n_faces,), for :class:`Balance`."""

    weight: Floats
    """Conductance, m."""
    error: Floats
    """Error of the velocity out of the face, m/s."""
    area: Floats
    """Area, m²."""


class Work(NamedTuple):
    """Working memory for the n tetrahedra of the largest cell."""

    fluxes: Floats
    """(n, 4), of the better velocity out of each side, m³/s."""
    weight: Floats
    """(n, 4)."""
    sides: Floats
    """(n, 4, 5): the area vector of each side, m², its length, and the number of free nodes."""
    rows: Floats
    """(7, n)."""


def free_nodes(mesh: Mesh) -> Floats:
    """Return 1 for nodes off walls, else −1 if all cells around are simple, else 0, (n_nodes,).

    See :attr:`foamprb.flow.mesh.mesh.Mesh.simple`.
    """
    simple = np.ones(mesh.n_points, dtype=bool)
    simple[mesh.cell_points[np.repeat(~mesh.simple, np.diff(mesh.cell_point_start))]] = False
    free = np.ones(mesh.n_points + mesh.n_cells)
    on_walls = mesh.triangles[_of_kind(mesh, PatchKind.WALL)[mesh.triangle_face]]
    free[on_walls] = np.where(simple[on_walls], -1.0, 0.0)
    return free


def _of_kind(mesh: Mesh, kind: PatchKind) -> Mask:
    """Return True for boundary faces of patches of a kind, (n_boundary,)."""
    of_patches = np.array([patch.kind is kind for patch in mesh.patches], dtype=bool)
    return np.repeat(of_patches, np.diff(mesh.patch_start))


class UnbalancedFlowError(InputError):
    """No fluxes that keep mass are found, or they are not those of the flow."""


class Conservation:
    """Operator from u and ∇u at the nodes of a mesh to the correction that keeps volume.

    Parameters
    ----------
    mesh
        The mesh.
    valued
        (n_boundary,) mask of boundary faces whose velocity is given; by default all. The flux through a wall
        without a velocity may change, as that through an open face.
    comm
        The nodes that hold the mesh.
    """

    def __init__(self, mesh: Mesh, valued: Mask | None = None, comm: MeshCommunicator = SINGLE_NODE) -> None:
        self._comm, self.n_tets = comm, len(mesh.tets)
        self._mesh, self._nodes, self._free = mesh, mesh.nodes, free_nodes(mesh)
        self._closed, walls = _of_kind(mesh, PatchKind.MIRROR), _of_kind(mesh, PatchKind.WALL)
        # The flux through an open face may change.
        self._open = ~(self._closed | walls)
        if valued is not None:
            self._open |= walls & ~valued
        ends = (walls | _of_kind(mesh, PatchKind.OPENING))[mesh.triangle_face]
        self._ends = np.unique(mesh.triangles[ends])
        self._coupled = np.concatenate([np.empty(0, dtype=np.intp), *(c.faces for c in mesh.couplings)])
        self._open[self._coupled] = False
        self._pairs = face_pairs(mesh)
        self._closed_pieces = closed_pieces(mesh, self._pairs, self._open, comm)

    def __call__(
        self, u: Floats, l: Floats, mass: Mass | None = CONSTANT, where: object = "flow"
    ) -> NDArray[np.float32]:
        """Return the correction (n_tets, 4), 1/s; see :class:`~foamprb.flow.mesh.arrays.MeshArrays`.

        Parameters
        ----------
        u, l
            Velocity (n_nodes, 3), m/s, and its gradient (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, 1/s.
        mass
            Density of the fluid. None if it varies but is not known: cells then keep the volume that the
            interpolation makes.
        where
            Source of the velocity, for the message.

        Raises
        ------
        UnbalancedFlowError
            If no fluxes are found that keep mass, or if they are not those of the flow; on all nodes.
        """
        mesh = self._mesh
        at, sides = NodalFlow(self._nodes, u, l, self._free), sides_of(mesh)
        fluxes, integrate, fill = np.empty(len(mesh.owner)), link(face_fluxes), link(correct)

        def faces(low: int, high: int) -> None:
            integrate(low, high, at, sides, fluxes)

        share(len(fluxes), faces)
        outer = fluxes[mesh.n_internal :]
        outer[self._closed] = 0.0
        # What leaves through a coupled patch enters through its partner.
        crossing = self._pairs.crossing(outer)
        outer[self._coupled] = self._pairs.total(crossing)[self._coupled]
        if mass is not None:
            measures = _measured(mesh, at, sides, fluxes)
            openings = self._open, self._closed_pieces
            balance = Balance(mesh, self._pairs, measures, fluxes, *openings, self._comm)
            speeds = np.linalg.norm(u[self._ends], axis=1)
            speed = max(self._comm.of_all(float(speeds.max(initial=0.0))))
            left, change, iterations = balance(crossing, mass, speed)
            if not (left <= 10.0 * BALANCED and change <= _LARGEST_CHANGE):
                raise UnbalancedFlowError(
                    f"the fluxes of {where} cannot be balanced: after {iterations} iterations the "
                    f"correction of the velocity is {change:.2g} times the flow, and cells make or lose "
                    f"{left:.2g} times the flow through their faces (root mean squares; allowed: "
                    f"{_LARGEST_CHANGE:g} and {10.0 * BALANCED:g}). Without the correction followers gather, "
                    "and stick at walls. Possible causes: a velocity that is no solution of the flow "
                    "equations, or cells without volume (see checkMesh)."
                )
        correction = np.empty((len(mesh.tets), 4), dtype=np.float32)
        most = int(np.diff(mesh.cell_start).max(initial=0))

        def cells(low: int, high: int) -> None:
            work = Work(
                np.empty((most, 4)), np.empty((most, 4)), np.empty((most, 4, 5)), np.empty((_ROWS, most))
            )
            fill(low, high, at, sides, fluxes, correction, work)

        share(mesh.n_cells, cells)
        return correction


def sides_of(mesh: Mesh) -> Sides:
    """Return the faces and cells of a mesh."""
    return Sides(*(getattr(mesh, name) for name in Sides._fields))


def _measured(mesh: Mesh, at: NodalFlow, sides: Sides, fluxes: Floats) -> Floats:
    """Return the results of :func:`weigh_faces`, (3, n_faces)."""
    measures, weigh = np.empty((3, len(fluxes))), link(weigh_faces)
    given = at.x, at.u, mesh.n_points, mesh.boundary_centres
    share(len(fluxes), lambda low, high: weigh(low, high, *given, sides, fluxes, Measures(*measures)))
    return measures


def face_fluxes(begin: int, end: int, at: NodalFlow, sides: Sides, fluxes: Floats) -> None:
    """Integrate the interpolated velocity over the triangles of faces, m³/s."""
    start, points = sides.face_start, sides.face_points
    for f in range(begin, end):
        base, total = points[start[f]], 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            total += triangle_flux(at, base, points[k], points[k + 1])
        fluxes[f] = total


def weigh_faces(
    begin: int,
    end: int,
    nodes: Floats,
    u: Floats,
    n_points: int,
    boundary_centres: Floats,
    sides: Sides,
    fluxes: Floats,
    measures: Measures,
) -> None:
    """Measure the faces from ``begin`` to before ``end``."""
    start, points, owner, neighbour = sides.face_start, sides.face_points, sides.owner, sides.neighbour
    for f in range(begin, end):
        s = 0.0, 0.0, 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            s = plus(s, area_vector(nodes, points[start[f]], points[k], points[k + 1]))
        size = max(np.sqrt(inner(s, s)), 1e-300)
        o = n_points + owner[f]
        v, x = point(u, o), point(nodes, o)
        if f < neighbour.shape[0]:
            other = n_points + neighbour[f]
            v, d = scale_vector(0.5, plus(v, point(u, other))), arm(nodes, other, x)
        else:
            d = arm(boundary_centres, f - neighbour.shape[0], x)
        reach = max(inner(d, d), 1e-300)
        measures.weight[f] = max(inner(s, d), _LEAST_ALONG * size * np.sqrt(reach)) / reach
        measures.error[f] = (inner(s, v) - fluxes[f]) / size
        measures.area[f] = size


def area_vector(nodes: Floats, a: int, b: int, c: int) -> Vector:
    """Return the area vector of a triangle, m²."""
    o = point(nodes, a)
    s = vector_product(minus(point(nodes, b), o), minus(point(nodes, c), o))
    return 0.5 * s[0], 0.5 * s[1], 0.5 * s[2]


def triangle_flux(at: NodalFlow, a: int, b: int, c: int) -> float:
    """Return the flux of the better velocity (:func:`measure_sides`) through a triangle, m³/s."""
    u, free, s, flux = at.u, at.free, area_vector(at.x, a, b, c), 0.0
    for k in range(3):
        flux += s[k] * (u[a, k] + u[b, k] + u[c, k]) / 3.0
    for i, j in ((a, b), (b, c), (c, a)):
        flux += _off(free[i], free[j]) * inner(s, edge_bend(at.x, at.l, i, j))
    return float(flux)


def edge_bend(nodes: Floats, l: Floats, i: int, j: int) -> Vector:
    """Return (l_i − l_j)·(x_j − x_i)/24, m/s: a third of what an edge adds to a mean velocity."""
    d, s = arm(nodes, j, point(nodes, i)), 1.0 / 24.0
    return (
        s * _change(l, i, j, 0, d),
        s * _change(l, i, j, 1, d),
        s * _change(l, i, j, 2, d),
    )


def _change(l: Floats, i: int, j: int, k: int, d: Vector) -> float:
    """Return row k of (l_i − l_j)·d."""
    x, y, z = l[i, k, 0] - l[j, k, 0], l[i, k, 1] - l[j, k, 1], l[i, k, 2] - l[j, k, 2]
    return x * d[0] + y * d[1] + z * d[2]  # type: ignore[no-any-return]


def correct(
    begin: int,
    end: int,
    at: NodalFlow,
    mesh: Sides,
    phi: Floats,
    correction: NDArray[np.float32],
    memory: Work,
) -> None:
    """Fill ``correction``, (n_tets, 4), for the cells from ``begin`` to before ``end``.

    ``phi`` is the flux out of the owner of each face, m³/s.
    """
    fluxes, weight, sides, work = memory.fluxes, memory.weight, memory.sides, memory.rows
    cell_start, face_start, neighbours = mesh.cell_start, mesh.face_start, mesh.neighbours
    rest, change, volume = work[0], work[4], work[5]
    for c in range(begin, end):
        first, n = cell_start[c], cell_start[c + 1] - cell_start[c]
        total = space = 0.0
        for t in range(n):
            volume[t] = measure_sides(at, mesh.tets, first + t, t, memory, correction)
            space += volume[t]
        # The triangles of a face share its flux by their areas and free nodes.
        t = 0
        for h in range(mesh.cell_face_start[c], mesh.cell_face_start[c + 1]):
            f = mesh.cell_faces[h]
            size = face_start[f + 1] - face_start[f] - 2
            interpolated = area = 0.0
            for k in range(t, t + size):
                interpolated += fluxes[k, 0]
                work[1, k] = sides[k, 0, _SIZE] * sides[k, 0, _COUNT]
                area += work[1, k]
            if area == 0.0:
                for k in range(t, t + size):
                    work[1, k] = sides[k, 0, _SIZE]
                    area += work[1, k]
            out = phi[f] if mesh.owner[f] == c else -phi[f]
            total += out
            for k in range(t, t + size):
                fluxes[k, 0] += (out - interpolated) * work[1, k] / max(area, 1e-300)
            t += size
        _carry(at.x, mesh.tets, first, n, space, memory, correction)
        square = lost = 0.0
        for t in range(n):
            rest[t] = total * volume[t] / space
            for k in range(4):
                rest[t] -= fluxes[t, k]
                square += fluxes[t, k] * fluxes[t, k]
            lost += rest[t] / n
        for t in range(n):
            # Round-off in the sum, for which there is no solution.
            rest[t] -= lost
        for t in range(n):
            for k in range(1, 4):
                reach = abs(volume[t]) + abs(volume[neighbours[first + t, k] - first])
                size = sides[t, k, _SIZE]
                weight[t, k] = sides[t, k, _COUNT] * size * size / max(reach, 1e-300)
        _share(neighbours, first, n, weight, work, _EXACT * square)
        for t in range(n):
            tet = first + t
            for k in range(1, 4):
                fluxes[t, k] += weight[t, k] * (change[t] - change[neighbours[tet, k] - first])
            for k in range(4):
                # All nodes of a side are free if none is.
                count = sides[t, k, _COUNT] if sides[t, k, _COUNT] > 0.0 else 3.0
                flux = fluxes[t, k] + correction[tet, k]
                correction[tet, k] = flux / (count * volume[t]) if volume[t] != 0.0 else 0.0


def measure_sides(
    at: NodalFlow, tets: Ints, tet: int, row: int, memory: Work, correction: NDArray[np.float32]
) -> float:
    """Measure the sides of a tetrahedron; return its signed volume, m³.

    Side k is opposite vertex k. The interpolated velocity (:func:`foamprb.flow.walk.interpolate`) is straight
    along an edge to a wall. A better one is quadratic there, too, but straight along edges on a wall.

    Parameters
    ----------
    tet, row
        The tetrahedron, and its row in working memory.
    memory
        Results are its fluxes and sides.
    correction
        Result (n_tets, 4): minus the flux of the interpolated velocity, m³/s.
    """
    nodes, u, l, free = at
    o, a, b, c = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    x = point(nodes, o)
    p, q, r = arm(nodes, a, x), arm(nodes, b, x), arm(nodes, c, x)
    so, sa = _half_product(minus(q, p), minus(r, p)), _half_product(r, q)
    sb, sc = _half_product(p, r), _half_product(q, p)
    oa, ob, oc = edge_bend(nodes, l, o, a), edge_bend(nodes, l, o, b), edge_bend(nodes, l, o, c)
    ab, bc, ca = edge_bend(nodes, l, a, b), edge_bend(nodes, l, b, c), edge_bend(nodes, l, c, a)
    fo, fa, fb, fc = free[o], free[a], free[b], free[c]
    uo, ua, ub, uc = point(u, o), point(u, a), point(u, b), point(u, c)
    results = row, memory.fluxes, memory.sides, tet, correction
    _put_side(*results, 0, so, plus(plus(ua, ub), uc), (fa, fb, fc), (ab, bc, ca))
    _put_side(*results, 1, sa, plus(plus(uo, uc), ub), (fo, fc, fb), (oc, bc, ob))
    _put_side(*results, 2, sb, plus(plus(uo, ua), uc), (fo, fa, fc), (oa, ca, oc))
    _put_side(*results, 3, sc, plus(plus(uo, ub), ua), (fo, fb, fa), (ob, ab, oa))
    volume = -inner(p, sa) / 3.0
    return float(volume)


def _half_product(v: Vector, w: Vector) -> Vector:
    return scale_vector(0.5, vector_product(v, w))


def _put_side(
    row: int,
    fluxes: Floats,
    sides: Floats,
    tet: int,
    correction: NDArray[np.float32],
    k: int,
    s: Vector,
    u: Vector,
    free: Vector,
    edges: tuple[Vector, Vector, Vector],
) -> None:
    """Write side k from its area vector, and the sum of velocities, free nodes and edges 01, 12, 20."""
    f, g, h = free
    size, ends = inner(s, s), (inner(s, edges[0]), inner(s, edges[1]), inner(s, edges[2]))
    mean = inner(s, u) / 3.0
    flux = mean + bends(f, g) * ends[0] + bends(g, h) * ends[1] + bends(h, f) * ends[2]
    better = mean + _off(f, g) * ends[0] + _off(g, h) * ends[1] + _off(h, f) * ends[2]
    fluxes[row, k], correction[tet, k] = better, -flux
    sides[row, k, 0], sides[row, k, 1], sides[row, k, 2] = s
    sides[row, k, _SIZE], sides[row, k, _COUNT] = np.sqrt(size), abs(f) + abs(g) + abs(h)


def _off(f: float, g: float) -> float:
    """Return 1 for an edge with an end off the walls, else 0; see :func:`free_nodes`."""
    return 1.0 if f > 0.0 or g > 0.0 else 0.0


def _carry(
    nodes: Floats,
    tets: Ints,
    first: int,
    n: int,
    space: float,
    memory: Work,
    correction: NDArray[np.float32],
) -> None:
    """Add to the fluxes inside a cell those of the mean correction that the ones through its sides make.

    The mean is Σ x δ over the volume ``space``, with the additional flux δ out of a side with the middle x.
    """
    fluxes, sides = memory.fluxes, memory.sides
    o, mean = point(nodes, tets[first, 0]), (0.0, 0.0, 0.0)
    for t in range(n):
        tet = first + t
        s = (fluxes[t, 0] + correction[tet, 0]) / (3.0 * space)
        p, q, r = arm(nodes, tets[tet, 1], o), arm(nodes, tets[tet, 2], o), arm(nodes, tets[tet, 3], o)
        mean = (
            mean[0] + s * (p[0] + q[0] + r[0]),
            mean[1] + s * (p[1] + q[1] + r[1]),
            mean[2] + s * (p[2] + q[2] + r[2]),
        )
    for t in range(n):
        for k in range(1, 4):
            area = sides[t, k, 0], sides[t, k, 1], sides[t, k, 2]
            fluxes[t, k] += inner(area, mean) * sides[t, k, _COUNT] / 3.0


def _share(neighbours: Ints, first: int, n: int, weight: Floats, work: Floats, enough: float) -> None:
    """Solve for potentials of the tetrahedra of a cell, whose differences drive fluxes that balance ``rest``.

    ``rest``, row 0 of ``work``, is what each tetrahedron lacks; the potentials go into row 4. The fluxes are
    the smallest change in the sum of squares over ``weight`` (n, 4). Conjugate gradients end when the sum of
    squares of what is still lacking is ``enough``.
    """
    rest, way, residual, image, change, diagonal = work[0], work[1], work[2], work[3], work[4], work[6]
    energy = square = 0.0
    for t in range(n):
        change[t] = 0.0
        diagonal[t] = weight[t, 1] + weight[t, 2] + weight[t, 3]
        residual[t] = rest[t]
        way[t] = rest[t] / diagonal[t]
        energy += rest[t] * way[t]
        square += rest[t] * rest[t]
    for _ in range(8 * n):
        if square <= enough:
            break
        curve = 0.0
        for t in range(n):
            image[t] = 0.0
            for k in range(1, 4):
                image[t] += weight[t, k] * (way[t] - way[neighbours[first + t, k] - first])
            curve += way[t] * image[t]
        if curve <= 0.0:
            break
        s, before = energy / curve, energy
        square = energy = 0.0
        for t in range(n):
            change[t] += s * way[t]
            residual[t] -= s * image[t]
            square += residual[t] * residual[t]
            energy += residual[t] * residual[t] / diagonal[t]
        for t in range(n):
            way[t] = residual[t] / diagonal[t] + energy / before * way[t]
