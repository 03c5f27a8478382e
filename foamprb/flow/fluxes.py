"""Correction of the interpolated velocity that keeps the volume of the fluid.

A velocity u that is interpolated between the nodes makes volume in some tetrahedra and loses it in others, so
that particles gather, above all at walls. The correction c is a field of Brezzi, Douglas and Marini's first
order (Numer. Math. 47, 217, 1985): linear in each tetrahedron, with a normal component that is continuous
across the triangles between them. Its fluxes give each tetrahedron its share of what the cell makes, which is
nothing in an incompressible flow; where the density varies, cells make and lose no mass. On a triangle c is
distributed over the free nodes, those that lie on no wall, so that walls keep their velocity at every point.
A face between cells whose nodes all lie on walls carries a uniform flux. A second part, with no component
normal to the triangles, makes the divergence the same everywhere in a tetrahedron: ¼ Σ d_k λ_k (x_k − x),
with the divergence d_k of u at vertex k.

The fluxes through the faces of the cells are the smallest change of the interpolated ones that conserves
volume; those through the triangles in a cell likewise. OpenFOAM's ``phi`` is not used: it is the velocity at
the middle of a face times the area, which exceeds the integral by the curvature of the profile.
"""

from __future__ import annotations

from collections.abc import Collection
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy import sparse
from scipy.sparse.linalg import splu

from foamprb.body.tensor import Vector, inner, minus, vector_product
from foamprb.compile.link import link
from foamprb.flow.base import WALLS, Caveat, Floats, Ints
from foamprb.flow.mesh.arrays import arm, point
from foamprb.flow.mesh.lists import Index, Mask, share
from foamprb.flow.mesh.mesh import Mesh

_CLOSED = frozenset({"empty", "symmetry", "symmetryPlane"})
"""Types of patches, beside walls, through which nothing flows."""
_LEAST_ALONG = 0.02
"""Least cosine between a face's normal and the line of the cell centres that counts in its weight."""
_LEAST_ERROR = 0.04
"""Least square of the error of a flux that counts in its weight, over the mean square."""
_BLOCK, _MOST_BLOCKS = 100, 5000
"""Cells in a block of the preconditioner, about, and the most blocks."""
_BALANCED = 1e-5
"""Largest flux that cells make or lose, over the fluxes through faces; root mean squares."""
_MOST_ITERATIONS = 2000
# Sum of squares of what the tetrahedra of a cell may still lack, over that of their fluxes.
_EXACT = 1e-14
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


class Mass(NamedTuple):
    """Density of the fluid in any unit, as only its ratios matter, and its rate of change per second.

    Of the cells (n_cells,) and at the boundary faces (n_boundary,), or one value for all.
    """

    cells: Floats
    boundary: Floats
    growth: Floats


CONSTANT = Mass(np.ones(1), np.ones(1), np.zeros(1))
"""Density of an incompressible flow, whose cells keep volume."""


class Conservation:
    """Operator from u and ∇u at the nodes of a mesh to the correction that keeps volume."""

    def __init__(self, mesh: Mesh) -> None:
        self._mesh, self._nodes, self._free = mesh, mesh.nodes, free_nodes(mesh)
        self._closed = _types(mesh, _CLOSED)
        # The flux through an open face may change.
        self._open = ~_types(mesh, _CLOSED | WALLS)
        self.unbalanced = 0.0
        """Flux that cells still make or lose after the last call, over that through their faces (rms)."""
        for coupling in mesh.couplings:
            self._open[coupling.faces] = False

    def __call__(self, u: Floats, l: Floats, mass: Mass | None = CONSTANT) -> NDArray[np.float32]:
        """Return the correction (n_tets, 8), 1/s; see :class:`~foamprb.flow.mesh.arrays.MeshArrays`.

        Parameters
        ----------
        u, l
            Velocity (n_nodes, 3), m/s, and its gradient (n_nodes, 3, 3), l_ij = ∂u_i/∂x_j, 1/s.
        mass
            Density of the fluid. None if it varies but is not known: cells then keep the volume that the
            interpolation makes.
        """
        mesh = self._mesh
        fields = self._nodes, u, l, self._free
        fluxes = np.empty(len(mesh.owner))

        def faces(low: int, high: int) -> None:
            link(face_fluxes)(*fields, mesh.face_start[low : high + 1], mesh.face_points, fluxes[low:high])

        share(len(fluxes), faces)
        outer = fluxes[mesh.n_internal :]
        interpolated = outer.copy()
        outer[self._closed] = 0.0
        for coupling in mesh.couplings:
            # What leaves through a coupled patch enters through its partner.
            outer[coupling.faces] = 0.5 * (interpolated[coupling.faces] - interpolated[coupling.partners])
        if mass is not None:
            self.unbalanced = _Balance(mesh, self._nodes, u, self._open, fluxes)(fluxes, mass)
        correction = np.empty((len(mesh.tets), 8), dtype=np.float32)
        most = int(np.diff(mesh.cell_start).max(initial=0))
        arrays = (
            *(mesh.tets, mesh.neighbours, mesh.cell_start, mesh.cell_face_start, mesh.cell_faces),
            *(mesh.face_start, mesh.owner, fluxes, correction),
        )

        def cells(low: int, high: int) -> None:
            work = np.empty((most, 4)), np.empty((most, 4)), np.empty((_ROWS, most))
            link(correct)(*fields, *arrays, low, high, *work)

        share(mesh.n_cells, cells)
        return correction

    def caveats(self) -> list[Caveat]:
        """Return a warning if the last correction leaves cells that make or lose fluid."""
        if self.unbalanced <= 10.0 * _BALANCED:
            return []
        return [
            Caveat(
                f"cells make or lose {self.unbalanced:.1e} of what flows through their faces (root mean "
                f"squares): {_MOST_ITERATIONS} iterations found no fluxes that keep it. Tracers may gather "
                "or stick where fluid is lost. Has the mesh cells without volume? (checkMesh tells)"
            )
        ]


class _Balance:
    """Least change of the fluxes through the faces of the cells that keeps the mass of each cell.

    The change is the smallest in the sum of squares over a weight, which is a conductance: the area of a face
    in the direction of the line between the centres, over its length. A face that this line meets at a small
    angle lies along long cells; a flux through it would move the fluid along them. It is multiplied by the
    square of an error: the difference between the integral of the interpolated velocity and the mean of the
    cells, as large as at walls and shear layers that the mesh does not resolve, plus a part of its mean.

    Parameters
    ----------
    nodes, u
        Places and velocities of the nodes.
    free
        Boundary faces through which the flux may change.
    fluxes
        (n_faces,) interpolated fluxes, m³/s.
    """

    def __init__(self, mesh: Mesh, nodes: Floats, u: Floats, free: Mask, fluxes: Floats) -> None:
        self._mesh, self._closed = mesh, not free.any()
        n, cells, neighbour = mesh.n_internal, mesh.n_cells, mesh.neighbour
        areas = np.empty((len(mesh.owner), 3))
        link(face_areas)(nodes, mesh.face_start, mesh.face_points, areas)
        size = np.maximum(np.sqrt(np.einsum("fi,fi->f", areas, areas)), 1e-300)
        arms = np.concatenate([mesh.centres[neighbour], mesh.boundary_centres]) - mesh.centres[mesh.owner]
        square = np.maximum(np.einsum("fi,fi->f", arms, arms), 1e-300)
        along = np.einsum("fi,fi->f", areas, arms)
        weight = np.maximum(along, _LEAST_ALONG * size * np.sqrt(square)) / square
        mean = u[mesh.n_points + mesh.owner]
        mean[:n] += u[mesh.n_points + neighbour]
        mean[:n] *= 0.5
        error = ((np.einsum("fi,fi->f", areas, mean) - fluxes) / size) ** 2
        weight *= error + _LEAST_ERROR * np.mean(error) + 1e-12 * np.mean((fluxes / size) ** 2) + 1e-300
        weight /= weight.max(initial=1e-300)
        weight[n:][~free] = 0.0
        self._weight = weight
        owner = mesh.owner[:n]
        diagonal = np.bincount(mesh.owner, weight, cells) + np.bincount(neighbour, weight[:n], cells)
        diagonal = np.where(diagonal > 0.0, diagonal, 1.0)
        pairs = np.concatenate([owner, neighbour]), np.concatenate([neighbour, owner])
        beside = sparse.csr_array((np.tile(-weight[:n], 2), pairs), shape=(cells, cells))
        self._matrix = beside + sparse.diags_array(diagonal)
        self._inverse = 1.0 / diagonal
        self._block = _blocks(mesh.centres)
        sums = sparse.csr_array((np.ones(cells), (self._block, np.arange(cells))))
        coarse = sums @ self._matrix @ sums.T
        # Blocks that no flux leaves, as a closed flow, are determined but for a constant.
        lift = sparse.diags_array(1e-9 * np.bincount(self._block, diagonal))
        self._solve_blocks = splu((coarse + lift).tocsc()).solve

    def __call__(self, fluxes: Floats, mass: Mass) -> float:
        """Change fluxes (n_faces,) in place; what remains of a closed flow is shared by volume.

        Returns
        -------
        What cells still make or lose, over the fluxes through faces; root mean squares.
        """
        mesh, weight, n = self._mesh, self._weight, self._mesh.n_internal
        owner, neighbour, cells = mesh.owner, mesh.neighbour, mesh.n_cells
        inside = np.broadcast_to(mass.cells, (cells,))
        outside = np.broadcast_to(mass.boundary, (len(owner) - n,))
        density = np.concatenate([0.5 * (inside[owner[:n]] + inside[neighbour]), outside])
        fluxes *= density
        stored = mesh.volumes * mass.growth
        rest = np.bincount(neighbour, fluxes[:n], cells) - np.bincount(owner, fluxes, cells) - stored
        if self._closed:
            rest -= mesh.volumes * (rest.sum() / mesh.volumes.sum())
        size = float(np.sqrt(np.mean(fluxes**2) * cells))
        y, left = self._solve(rest, _BALANCED * size)
        fluxes += weight * y[owner]
        fluxes[:n] -= weight[:n] * y[neighbour]
        fluxes /= density
        return left / max(size, 1e-300)

    def _solve(self, rest: Floats, enough: float) -> tuple[Floats, float]:
        """Solve for potentials of the cells by conjugate gradients until the norm of what is left is enough.

        BLAS, and so SciPy's solvers, add in an order that depends on the number of threads.

        Returns
        -------
        The potentials (n_cells,), and the norm.
        """
        y, residual = np.zeros_like(rest), rest.copy()
        way = self._precondition(residual)
        energy, left = _product(residual, way), np.sqrt(_product(residual, residual))
        for _ in range(_MOST_ITERATIONS):
            if left <= enough:
                break
            image = self._matrix @ way
            step = energy / _product(way, image)
            y += step * way
            residual -= step * image
            better = self._precondition(residual)
            before, energy = energy, _product(residual, better)
            left = np.sqrt(_product(residual, residual))
            way = better + energy / before * way
        return y, float(left)

    def _precondition(self, rest: Floats) -> Floats:
        """Return Jacobi's approximation plus the exact solution with a constant in each block."""
        of_blocks: Floats = self._solve_blocks(np.bincount(self._block, rest))
        found: Floats = self._inverse * rest + of_blocks[self._block]
        return found


def _product(a: Floats, b: Floats) -> float:
    return float(np.einsum("i,i->", a, b))


def _blocks(centres: Floats) -> Index:
    """Return the block of each cell: a box of a regular grid over the centres with one at least."""
    n, extent = len(centres), np.ptp(centres, axis=0)
    wide = extent > 1e-6 * max(extent.max(initial=0.0), 1e-300)
    counts = np.ones(3, dtype=np.int64)
    if wide.any():
        boxes = min(max(n / _BLOCK, 1.0), _MOST_BLOCKS)
        edge = float(np.prod(extent[wide]) / boxes) ** (1.0 / np.count_nonzero(wide))
        counts[wide] = np.ceil(extent[wide] / edge)
    at = (centres - centres.min(axis=0)) / np.where(wide, extent, 1.0) * counts
    number = np.ravel_multi_index(tuple(np.minimum(at.astype(np.int64), counts - 1).T), tuple(counts))
    return np.unique(number, return_inverse=True)[1]


def face_fluxes(
    nodes: Floats, u: Floats, l: Floats, free: Floats, start: Ints, points: Ints, fluxes: Floats
) -> None:
    """Integrate the interpolated velocity over the triangles of each face, m³/s."""
    for f in range(fluxes.shape[0]):
        base, total = points[start[f]], 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            total += triangle_flux(nodes, u, l, free, base, points[k], points[k + 1])[1]
        fluxes[f] = total


def face_areas(nodes: Floats, start: Ints, points: Ints, areas: Floats) -> None:
    """Put the area vector of each face, out of its owner, m², into ``areas`` (n_faces, 3)."""
    for f in range(areas.shape[0]):
        areas[f] = 0.0
        for k in range(start[f] + 1, start[f + 1] - 1):
            s = area_vector(nodes, points[start[f]], points[k], points[k + 1])
            for i in range(3):
                areas[f, i] += s[i]


def area_vector(nodes: Floats, a: int, b: int, c: int) -> Vector:
    """Return the area vector of a triangle, m²."""
    o = point(nodes, a)
    s = vector_product(minus(point(nodes, b), o), minus(point(nodes, c), o))
    return 0.5 * s[0], 0.5 * s[1], 0.5 * s[2]


def triangle_flux(
    nodes: Floats, u: Floats, l: Floats, free: Floats, a: int, b: int, c: int
) -> tuple[float, float]:
    """Return the flux of the interpolated velocity through a triangle, and that of a better one, m³/s.

    The interpolated velocity (:func:`foamprb.flow.walk.interpolate`) is straight along an edge to a wall. The
    other one is quadratic there, too, but along edges on a wall.
    """
    s = area_vector(nodes, a, b, c)
    flux = more = 0.0
    for k in range(3):
        flux += s[k] * (u[a, k] + u[b, k] + u[c, k]) / 3.0
    for i, j in ((a, b), (b, c), (c, a)):
        bend = 0.0
        for k in range(3):
            for m in range(3):
                bend += s[k] * (l[i, k, m] - l[j, k, m]) * (nodes[j, m] - nodes[i, m]) / 24.0
        flux += free[i] * free[j] * bend
        more += (free[i] + free[j] - 2.0 * free[i] * free[j]) * bend
    return flux, flux + more


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
        (n_tets, 8), the result.
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
                flux, better = side_flux(nodes, u, l, free, tets, first + t, k)
                fluxes[t, k] = better
                correction[first + t, k] = -flux
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
        _carry(nodes, free, tets, first, n, space, fluxes, correction)
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
                correction[tet, 4 + k] = 0.25 * divergence(nodes, l, free, tets, tet, k, volume[t])


def _carry(
    nodes: Floats,
    free: Floats,
    tets: Ints,
    first: int,
    n: int,
    space: float,
    fluxes: Floats,
    correction: NDArray[np.float32],
) -> None:
    """Add to the fluxes inside a cell those of the mean correction that the ones through its sides make.

    The mean is Σ x δ over the volume ``space``, with the additional flux δ out of a side with the middle x.
    """
    o, mean = point(nodes, tets[first, 0]), (0.0, 0.0, 0.0)
    for t in range(n):
        a, b, c = _side(tets, first + t, 0)
        s = (fluxes[t, 0] + correction[first + t, 0]) / (3.0 * space)
        p, q, r = arm(nodes, a, o), arm(nodes, b, o), arm(nodes, c, o)
        mean = (
            mean[0] + s * (p[0] + q[0] + r[0]),
            mean[1] + s * (p[1] + q[1] + r[1]),
            mean[2] + s * (p[2] + q[2] + r[2]),
        )
    for t in range(n):
        for k in range(1, 4):
            a, b, c = _side(tets, first + t, k)
            fluxes[t, k] += inner(area_vector(nodes, a, b, c), mean) * free_of(free, tets, first + t, k) / 3.0


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


def divergence(
    nodes: Floats, l: Floats, free: Floats, tets: Ints, tet: int, vertex: int, volume: float
) -> float:
    """Return the divergence that the bends of the edges make at a vertex of a tetrahedron, 1/s."""
    here, total = tets[tet, vertex], 0.0
    if volume == 0.0:
        return 0.0
    for j in range(4):
        there = tets[tet, j]
        a, b, c = _side(tets, tet, j)
        # The gradient of the weight of the other vertex is this over −3 volumes.
        s = area_vector(nodes, a, b, c)
        for k in range(3):
            for m in range(3):
                bend = (l[here, k, m] - l[there, k, m]) * (nodes[there, m] - nodes[here, m])
                total -= free[there] * s[k] * bend
    return float(0.5 * free[here] * total / (3.0 * volume))


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
