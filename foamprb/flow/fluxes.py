"""Correction of the linear velocity in the tetrahedra that keeps the volume of the fluid.

A velocity u that is linear between the nodes makes volume in some tetrahedra and loses it in others, so that
particles gather, above all at walls. The correction c is a field of Brezzi, Douglas and Marini's first order
(Numer. Math. 47, 217, 1985): linear in each tetrahedron, with a normal component that is continuous across
the triangles between them. Its fluxes make ∇·(u + c) in each tetrahedron equal to that of the cell, which is
zero in an incompressible flow. On a triangle c is distributed over the free nodes, those that lie on no wall,
so that walls keep their velocity at every point. A face between cells whose nodes all lie on walls carries a
uniform flux.

The fluxes through the faces of the cells are OpenFOAM's ``phi``, or the smallest change of the interpolated
ones that conserves volume. Those between the tetrahedra of a cell are the smallest change likewise. The
interpolated fluxes are those of the quadratic velocity that the gradients at the nodes give.
"""

from __future__ import annotations

import os
from collections.abc import Collection
from concurrent.futures import ThreadPoolExecutor
from itertools import pairwise

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import cg

from foamprb.body.tensor import Vector, inner, minus, vector_product
from foamprb.compile.link import link
from foamprb.flow.base import WALLS, Floats, Ints
from foamprb.flow.mesh.arrays import point
from foamprb.flow.mesh.lists import Mask
from foamprb.flow.mesh.mesh import Mesh

_CLOSED = frozenset({"empty", "symmetry", "symmetryPlane"})
"""Types of patches, beside walls, through which nothing flows."""
_BALANCED = 1e-6
"""Largest flux that cells make or lose, over the fluxes through faces; root mean squares."""
_MOST_ITERATIONS = 2000
# Sum of squares of what the tetrahedra of a cell may still lack, over that of their fluxes.
_EXACT = 1e-22
_ROWS = 7
"""Rows of working memory of :func:`correct`."""


def free_nodes(mesh: Mesh) -> Floats:
    """Return 0 for nodes on walls, else 1, (n_nodes,)."""
    free = np.ones(mesh.n_points + mesh.n_cells)
    free[mesh.triangles[_types(mesh, WALLS)[mesh.triangle_face]]] = 0.0
    return free


def _types(mesh: Mesh, types: Collection[str]) -> Mask:
    """Return True for boundary faces of patches of some types, (n_boundary,)."""
    chosen = np.array([patch.type in types for patch in mesh.patches], dtype=bool)
    return np.repeat(chosen, np.diff(mesh.patch_start))


class Conservation:
    """Operator from u and ∇u at the nodes of a mesh to the correction that keeps volume."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh = mesh
        self._free, self._nodes = free_nodes(mesh), mesh.nodes
        self._walls, self._closed = (
            mesh.n_internal + np.flatnonzero(_types(mesh, types)) for types in (WALLS, _CLOSED)
        )

    def __call__(
        self, u: Floats, l: Floats, phi: Floats | None = None, balance: bool = True
    ) -> NDArray[np.float32]:
        """Return the correction (n_tets, 4), 1/s; see :class:`~foamprb.flow.mesh.arrays.MeshArrays`.

        Parameters
        ----------
        u, l
            Velocity (n_nodes, 3), m/s, and its gradient (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, 1/s.
        phi
            (n_faces,) flux out of the owner of each face, m³/s; None for the interpolated ones.
        balance
            Whether to balance the interpolated fluxes; not in a compressible flow.
        """
        mesh = self._mesh
        fields = self._nodes, u, l, self._free
        interpolated = np.empty(len(mesh.owner))
        link(face_fluxes)(*fields, mesh.face_start, mesh.face_points, interpolated)
        fluxes = interpolated.copy() if phi is None else phi.copy()
        fluxes[self._walls] = interpolated[self._walls]
        if phi is None:
            fluxes[self._closed] = 0.0
        for coupling in mesh.couplings:
            # What leaves through a wedge, or a cyclic patch without given fluxes, enters through its partner.
            if phi is None or mesh.patches[coupling.patch].type == "wedge":
                here, there = mesh.n_internal + coupling.faces, mesh.n_internal + coupling.partners
                fluxes[here] = 0.5 * (interpolated[here] - interpolated[there])
        if phi is None and balance:
            self._balance(fluxes)
        correction = np.empty((len(mesh.tets), 4), dtype=np.float32)
        most = int(np.diff(mesh.cell_start).max(initial=0))
        arrays = (
            *(mesh.tets, mesh.neighbours, mesh.cell_start, mesh.cell_face_start, mesh.cell_faces),
            *(mesh.face_start, mesh.owner, fluxes, correction),
        )

        def part(cells: tuple[int, int]) -> None:
            work = np.empty((most, 4)), np.empty((most, 4)), np.empty((_ROWS, most))
            link(correct)(*fields, *arrays, *cells, *work)

        threads = len(os.sched_getaffinity(0))
        cuts = np.linspace(0, mesh.n_cells, threads + 1).astype(int).tolist()
        with ThreadPoolExecutor(threads) as pool:
            list(pool.map(part, pairwise(cuts)))
        return correction

    def _balance(self, fluxes: Floats) -> None:
        """Change fluxes so that their sum over the faces of each cell is zero, or alike per volume.

        The change is the smallest, ∫ c² dV. Fluxes through walls, mirrors and coupled patches stay.
        """
        mesh = self._mesh
        n, n_internal, owner, neighbour = mesh.n_cells, mesh.n_internal, mesh.owner, mesh.neighbour
        open_faces = np.ones(len(owner), dtype=bool)
        open_faces[self._walls] = open_faces[self._closed] = False
        for coupling in mesh.couplings:
            open_faces[n_internal + coupling.faces] = False
        reach = mesh.volumes[owner]
        reach[:n_internal] += mesh.volumes[neighbour]
        sizes = np.zeros(len(owner))
        link(face_sizes)(self._nodes, mesh.face_start, mesh.face_points, sizes)
        weight = np.where(open_faces, sizes**2 / np.maximum(reach, 1e-300), 0.0)

        def over_cells(values: Floats, sign: float) -> Floats:
            total = np.bincount(owner, values, n) + sign * np.bincount(neighbour, values[:n_internal], n)
            return np.asarray(total, dtype=np.float64)

        rest = -over_cells(fluxes, -1.0)
        if not weight[n_internal:].any():
            rest -= mesh.volumes * (rest.sum() / mesh.volumes.sum())
        diagonal = over_cells(weight, 1.0)
        diagonal = np.where(diagonal > 0.0, diagonal, 1.0)
        pairs = (
            np.concatenate([owner[:n_internal], neighbour]),
            np.concatenate([neighbour, owner[:n_internal]]),
        )
        beside = sparse.csr_array((np.tile(-weight[:n_internal], 2), pairs), shape=(n, n))
        enough = _BALANCED * float(np.sqrt(np.mean(fluxes**2) * n))
        y, _ = cg(
            beside + sparse.diags_array(diagonal), rest, rtol=0.0, atol=enough, maxiter=_MOST_ITERATIONS,
            M=sparse.diags_array(1.0 / diagonal),
        )  # fmt: skip
        fluxes += weight * y[owner]
        fluxes[:n_internal] -= weight[:n_internal] * y[neighbour]


def face_fluxes(
    nodes: Floats, u: Floats, l: Floats, free: Floats, start: Ints, points: Ints, fluxes: Floats
) -> None:
    """Integrate the interpolated velocity over the triangles of each face, m³/s."""
    for f in range(fluxes.shape[0]):
        base, total = points[start[f]], 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            linear, bend = triangle_flux(nodes, u, l, free, base, points[k], points[k + 1])
            total += linear + bend
        fluxes[f] = total


def face_sizes(nodes: Floats, start: Ints, points: Ints, sizes: Floats) -> None:
    """Put the area of each face, m², into ``sizes``."""
    for f in range(sizes.shape[0]):
        for k in range(start[f] + 1, start[f + 1] - 1):
            area = area_vector(nodes, points[start[f]], points[k], points[k + 1])
            sizes[f] += np.sqrt(inner(area, area))


def area_vector(nodes: Floats, a: int, b: int, c: int) -> Vector:
    """Return the area vector of a triangle, m²."""
    o = point(nodes, a)
    s = vector_product(minus(point(nodes, b), o), minus(point(nodes, c), o))
    return 0.5 * s[0], 0.5 * s[1], 0.5 * s[2]


def triangle_flux(
    nodes: Floats, u: Floats, l: Floats, free: Floats, a: int, b: int, c: int
) -> tuple[float, float]:
    """Return the flux of the linear velocity through a triangle, and the rest of that of the quadratic, m³/s.

    At the middle of an edge the quadratic velocity is ½(u_i + u_j) + ⅛(l_i − l_j)·(x_j − x_i); along an edge
    on a wall it is linear.
    """
    s = area_vector(nodes, a, b, c)
    linear = bend = 0.0
    for k in range(3):
        linear += s[k] * (u[a, k] + u[b, k] + u[c, k]) / 3.0
    for i, j in ((a, b), (b, c), (c, a)):
        if free[i] + free[j] > 0.0:
            for k in range(3):
                for m in range(3):
                    bend += s[k] * (l[i, k, m] - l[j, k, m]) * (nodes[j, m] - nodes[i, m]) / 24.0
    return linear, bend


def correct(
    nodes: Floats,
    u: Floats,
    l: Floats,
    free: Floats,
    tets: Ints,
    neighbours: Ints,
    cell_start: Ints,
    cell_face_start: Ints,
    cell_faces: Ints,
    face_start: Ints,
    owner: Ints,
    phi: Floats,
    correction: NDArray[np.float32],
    begin: int,
    end: int,
    fluxes: Floats,
    weight: Floats,
    work: Floats,
) -> None:
    """Fill ``correction`` for the cells from ``begin`` to before ``end``.

    Parameters
    ----------
    nodes, u, l, free
        Places, velocity, gradient and mask of the nodes.
    tets, neighbours, cell_start, cell_face_start, cell_faces, face_start, owner
        See :class:`~foamprb.flow.mesh.mesh.Mesh`.
    phi
        (n_faces,) flux out of the owner of each face, m³/s.
    correction
        (n_tets, 4), the result.
    fluxes, weight, work
        Working memory, twice (n, 4) and (7, n), for the n tetrahedra of the largest cell.
    """
    rest, change, volume = work[0], work[4], work[5]
    for c in range(begin, end):
        first, n = cell_start[c], cell_start[c + 1] - cell_start[c]
        total = space = 0.0
        for t in range(n):
            volume[t] = volume_of(nodes, tets, first + t)
            space += volume[t]
            for k in range(4):
                linear, bend = side_flux(nodes, u, l, free, tets, first + t, k)
                fluxes[t, k] = linear + bend
                correction[first + t, k] = -linear
        # The triangles of a face share its flux by their areas and free nodes.
        t = 0
        for h in range(cell_face_start[c], cell_face_start[c + 1]):
            f = cell_faces[h]
            size = face_start[f + 1] - face_start[f] - 2
            interpolated = area = 0.0
            for k in range(t, t + size):
                interpolated += fluxes[k, 0]
                work[1, k] = side_area(nodes, tets, first + k, 0) * free_of(free, tets, first + k, 0)
                area += work[1, k]
            if area == 0.0:
                for k in range(t, t + size):
                    work[1, k] = side_area(nodes, tets, first + k, 0)
                    area += work[1, k]
            out = phi[f] if owner[f] == c else -phi[f]
            total += out
            for k in range(t, t + size):
                fluxes[k, 0] += (out - interpolated) * work[1, k] / max(area, 1e-300)
            t += size
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
                other = neighbours[first + t, k] - first
                reach = abs(volume[t]) + abs(volume[other])
                size = side_area(nodes, tets, first + t, k)
                weight[t, k] = free_of(free, tets, first + t, k) * size * size / max(reach, 1e-300)
        _share(neighbours, first, n, weight, work, _EXACT * square)
        for t in range(n):
            tet = first + t
            for k in range(1, 4):
                fluxes[t, k] += weight[t, k] * (change[t] - change[neighbours[tet, k] - first])
            for k in range(4):
                correction[tet, k] = scaled(fluxes[t, k] + correction[tet, k], free, tets, tet, k, volume[t])


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


def free_of(free: Floats, tets: Ints, tet: int, side: int) -> float:
    """Return the number of free nodes of a side of a tetrahedron."""
    a, b, c = _side(tets, tet, side)
    return float(free[a] + free[b] + free[c])


def scaled(flux: float, free: Floats, tets: Ints, tet: int, side: int, volume: float) -> float:
    """Return a flux over the volume and the number of free nodes of a side; all are free if none is."""
    count = free_of(free, tets, tet, side)
    count = count if count > 0.0 else 3.0
    return float(flux / (count * volume)) if volume != 0.0 else 0.0


def volume_of(nodes: Floats, tets: Ints, tet: int) -> float:
    """Return the signed volume of a tetrahedron, m³."""
    o = point(nodes, tets[tet, 0])
    a = minus(point(nodes, tets[tet, 1]), o)
    b = minus(point(nodes, tets[tet, 2]), o)
    c = minus(point(nodes, tets[tet, 3]), o)
    return float(inner(a, vector_product(b, c)) / 6.0)


def side_flux(
    nodes: Floats, u: Floats, l: Floats, free: Floats, tets: Ints, tet: int, side: int
) -> tuple[float, float]:
    """Return :func:`triangle_flux` out of a tetrahedron through the side opposite a vertex."""
    a, b, c = _side(tets, tet, side)
    return triangle_flux(nodes, u, l, free, a, b, c)


def side_area(nodes: Floats, tets: Ints, tet: int, side: int) -> float:
    """Return the area of the side of a tetrahedron opposite a vertex, m²."""
    a, b, c = _side(tets, tet, side)
    area = area_vector(nodes, a, b, c)
    return float(np.sqrt(inner(area, area)))


def _side(tets: Ints, tet: int, side: int) -> tuple[int, int, int]:
    """Return the nodes of the side opposite a vertex, turning outwards."""
    o, a, b, c = tets[tet, 0], tets[tet, 1], tets[tet, 2], tets[tet, 3]
    if side == 0:
        return a, b, c
    if side == 1:
        return o, c, b
    if side == 2:
        return o, a, c
    return o, b, a
