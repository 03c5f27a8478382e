"""Compiled loops over the faces and cells of a mesh: lists of points, pairs of faces, geometry, tetrahedra.

A list of faces is given by ``start`` (n + 1,) and ``lists``: the points of face f are ``lists[start[f]]`` to
``lists[start[f + 1] - 1]``. All indices are int32, lengths in metres. Results are written to arrays of the
caller.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.tensor import Vector, inner, minus, plus, scale_vector, vector_product
from foamprb.flow.base import Floats, Ints
from foamprb.flow.mesh.arrays import arm, point
from foamprb.flow.mesh.lists import Index, ragged

OPEN = 1
"""State of a cell with an edge that does not belong to exactly two of its faces."""
TWISTED = 2
"""State of a cell with two faces that run along a common edge in the same direction."""
_MOST_BASES = 100
"""Largest number of fans compared on a face with many points; their cost is quadratic."""


class Faces(NamedTuple):
    """Faces of a mesh, interior ones first; they turn outwards from their owner."""

    start: Ints
    points: Ints
    owner: Ints
    neighbour: Ints
    """(n_internal,); it is larger than the owner."""
    first: Ints
    """(n_cells + 1,) into ``of_cell``."""
    of_cell: Ints
    """Faces of each cell."""

    def turn(self, some: Index) -> None:
        """Reverse the points of some faces."""
        begin, end = self.start[some], self.start[some + 1]
        places = ragged(begin, end - begin)
        self.points[places] = self.points[np.repeat(begin + end - 1, end - begin) - places]


class Numbering(NamedTuple):
    """Numbers of tetrahedra."""

    cell: Ints
    """(n_cells + 1,), of the first one in each cell."""
    face: Ints
    """(n_faces,), of the first one on each face, in its owner."""


class Fans(NamedTuple):
    """Tetrahedra, a fan on each face of a cell; see :class:`foamprb.flow.mesh.mesh.Mesh`."""

    tets: Ints
    neighbours: Ints
    triangle_tet: Ints
    state: NDArray[np.uint8]
    """(n_cells,), :data:`OPEN` or :data:`TWISTED`; must hold zeros."""


def list_faces(
    types: NDArray[np.uint8],
    corner_start: Ints,
    corners: Ints,
    shapes: Ints,
    poly_start: Ints,
    poly_faces: Ints,
    face_start: Ints,
    face_points: Ints,
    first: Ints,
    start: Ints,
    lists: Ints,
) -> int:
    """List the faces of each cell, cell by cell; a hexahedron with repeated points is the prism that it is.

    Parameters
    ----------
    types, corner_start, corners
        VTK's type of each cell (n,), and its points.
    shapes
        (256, 6, 5) by type and face: number of vertices, 0 for no face, then the local vertices.
    poly_start, poly_faces, face_start, face_points
        The faces of polyhedra, (n + 1,) and indices, and the points of these faces.
    first, start, lists
        Results: the first face of each cell (n + 1,), and the faces.

    Returns
    -------
    The number of faces.
    """
    face, at = 0, 0
    for c in range(types.shape[0]):
        first[c] = face
        shape = shapes[types[c]]
        for k in range(6):
            size = shape[k, 0]
            if size == 0:
                break
            for j in range(size):
                lists[at + j] = corners[corner_start[c] + shape[k, 1 + j]]
            size = _without_repeats(lists, at, size)
            start[face] = at
            face += size > 2
            at += size if size > 2 else 0
        if shape[0, 0] == 0:
            for k in range(poly_start[c], poly_start[c + 1]):
                begin, size = face_start[poly_faces[k]], face_start[poly_faces[k] + 1]
                size -= begin
                for j in range(size):
                    lists[at + j] = face_points[begin + j]
                size = _without_repeats(lists, at, size)
                start[face] = at
                face += size > 2
                at += size if size > 2 else 0
    first[types.shape[0]] = face
    start[face] = at
    return face


def _without_repeats(lists: Ints, at: int, size: int) -> int:
    """Remove points that equal the next one from a face; return the number of points left."""
    kept = 0
    for j in range(size):
        if lists[at + j] != lists[at + (j + 1 if j + 1 < size else 0)]:
            lists[at + kept] = lists[at + j]
            kept += 1
    return kept


def pair_faces(start: Ints, lists: Ints, head: Ints, following: Ints, mate: Ints) -> int:
    """Find for each face the other one with the same points, or itself.

    Parameters
    ----------
    head, following
        (n,) chains of faces with the same sum of point indices; ``head`` must hold −1.
    mate
        (n,) result.

    Returns
    -------
    The first face with the same points as two others, −1 for none.
    """
    n = mate.shape[0]
    for h in range(n):
        mate[h] = h
        total = 0
        for k in range(start[h], start[h + 1]):
            total += lists[k]
        slot = total % n
        other = head[slot]
        while other >= 0:
            if _alike(start, lists, h, other):
                if mate[other] != other:
                    return h
                mate[h], mate[other] = other, h
                break
            other = following[other]
        following[h] = head[slot]
        head[slot] = h
    return -1


def _alike(start: Ints, lists: Ints, a: int, b: int) -> bool:
    """Return True if two faces have the same points, each equally often."""
    size = start[a + 1] - start[a]
    if size != start[b + 1] - start[b]:
        return False
    for i in range(size):
        point, here, there = lists[start[a] + i], 0, 0
        for j in range(size):
            here += lists[start[a] + j] == point
            there += lists[start[b] + j] == point
        if here != there:
            return False
    return True


def gather_faces(
    first: Ints,
    half_start: Ints,
    half_lists: Ints,
    mate: Ints,
    start: Ints,
    lists: Ints,
    owner: Ints,
    neighbour: Ints,
    of_cell: Ints,
) -> None:
    """List each face once, interior faces first, in the order of the cells.

    Parameters
    ----------
    first, half_start, half_lists, mate
        Results of :func:`list_faces` and :func:`pair_faces`.
    start, lists, owner, neighbour
        Results: the faces, their owners, and their neighbours (n_internal,).
    of_cell
        Result: the faces of each cell, in the order of the cell.
    """
    face = at = 0
    for outside in range(2):
        for c in range(first.shape[0] - 1):
            for h in range(first[c], first[c + 1]):
                if mate[h] == h if outside == 1 else mate[h] > h:
                    start[face] = at
                    for k in range(half_start[h], half_start[h + 1]):
                        lists[at] = half_lists[k]
                        at += 1
                    owner[face], of_cell[h] = c, face
                    face += 1
                elif mate[h] < h and outside == 0:
                    of_cell[h] = of_cell[mate[h]]
                    neighbour[of_cell[h]] = c
    start[face] = at


def list_points(
    first: Ints, of_cell: Ints, start: Ints, lists: Ints, last: Ints, begin: Ints, points: Ints
) -> None:
    """List the points of each cell, each once; with no room in ``points``, count them only.

    Parameters
    ----------
    first, of_cell, start, lists
        The faces of each cell, and the points of each face.
    last
        (n_points,) work array; must hold −1.
    begin, points
        Results: the start of the points of each cell (n_cells + 1,), and the points.
    """
    at = 0
    for c in range(first.shape[0] - 1):
        begin[c] = at
        for h in range(first[c], first[c + 1]):
            f = of_cell[h]
            for k in range(start[f], start[f + 1]):
                p = lists[k]
                if last[p] != c:
                    last[p] = c
                    if points.shape[0] > 0:
                        points[at] = p
                    at += 1
    begin[first.shape[0] - 1] = at


def measure_faces(points: Floats, start: Ints, lists: Ints, centres: Floats, areas: Floats) -> None:
    """Compute face centres and area vectors (n, 3), by triangles about the mean of the vertices."""
    for f in range(centres.shape[0]):
        begin, size = start[f], start[f + 1] - start[f]
        for i in range(3):
            x = 0.0
            for k in range(size):
                x += points[lists[begin + k], i]
            centres[f, i], areas[f, i] = x / size, 0.0
        for k in range(size):
            _, n = _edge(
                points, lists[begin + k], lists[begin + k + 1 if k + 1 < size else begin], centres, f
            )
            for i in range(3):
                areas[f, i] += 0.5 * n[i]
        if size == 3:
            continue
        weight, x, y, z = 0.0, 0.0, 0.0, 0.0
        for k in range(size):
            d, n = _edge(
                points, lists[begin + k], lists[begin + k + 1 if k + 1 < size else begin], centres, f
            )
            w = inner(n, point(areas, f))
            weight, x, y, z = weight + w, x + w * d[0], y + w * d[1], z + w * d[2]
        # The area of a face folded onto itself is round-off; such a face keeps its mean as the centre.
        if weight != 0.0:
            x, y, z = x / (3.0 * weight), y / (3.0 * weight), z / (3.0 * weight)
            reach = 0.0
            for k in range(size):
                for i in range(3):
                    reach = max(reach, abs(points[lists[begin + k], i] - centres[f, i]))
            if max(abs(x), abs(y), abs(z)) <= reach:
                centres[f, 0] += x
                centres[f, 1] += y
                centres[f, 2] += z


def _edge(points: Floats, p: int, q: int, origins: Floats, o: int) -> tuple[Vector, Vector]:
    """Return the sum and the cross product of the vectors from an origin to two points."""
    origin = point(origins, o)
    a, b = arm(points, p, origin), arm(points, q, origin)
    return plus(a, b), vector_product(a, b)


def measure_cells(
    begin: int,
    end: int,
    first: Ints,
    of_cell: Ints,
    owner: Ints,
    face_centres: Floats,
    face_areas: Floats,
    middles: Floats,
    centres: Floats,
    volumes: Floats,
) -> None:
    """Compute the mean of the face centres of cells from ``begin`` on, and their centres and volumes.

    The centre and the volume are those of the pyramids over the faces about that mean. A centre outside the
    box of the face centres, as where the volume is round-off, is replaced by their mean.
    """
    for c in range(begin, end):
        total, low, high = (0.0, 0.0, 0.0), (np.inf, np.inf, np.inf), (-np.inf, -np.inf, -np.inf)
        for h in range(first[c], first[c + 1]):
            x = point(face_centres, of_cell[h])
            total = plus(total, x)
            low = min(low[0], x[0]), min(low[1], x[1]), min(low[2], x[2])
            high = max(high[0], x[0]), max(high[1], x[1]), max(high[2], x[2])
        middle = scale_vector(1.0 / (first[c + 1] - first[c]), total)
        volume, moment = 0.0, (0.0, 0.0, 0.0)
        for h in range(first[c], first[c + 1]):
            f = of_cell[h]
            d = arm(face_centres, f, middle)
            pyramid = inner(point(face_areas, f), d) / (3.0 if owner[f] == c else -3.0)
            volume += pyramid
            moment = plus(moment, scale_vector(0.75 * pyramid, d))
        centre = plus(middle, scale_vector(1.0 / volume if volume != 0.0 else 0.0, moment))
        size = minus(high, low)
        # Tolerance for round-off.
        room = 1e-9 * max(size[0], size[1], size[2])
        for i in range(3):
            if not low[i] - room <= centre[i] <= high[i] + room:
                centre = middle
        middles[c, 0], middles[c, 1], middles[c, 2] = middle
        centres[c, 0], centres[c, 1], centres[c, 2] = centre
        volumes[c] = volume


# Quality by which a fan must exceed the one from the point of the smallest label; of coordinates in single
# precision, the round-off is less.
_EQUAL = 1e-6


def choose_bases(
    points: Floats, centres: Floats, start: Ints, lists: Ints, owner: Ints, neighbour: Ints
) -> int:
    """Rotate every face so that the worst tetrahedron of its fan, in both cells, is as good as possible.

    Of a face with many points, evenly spread fans are compared.

    The quality of a tetrahedron is its volume over the cube of its root-mean-square edge.

    Returns
    -------
    The number of tetrahedra without positive volume.
    """
    n_internal = neighbour.shape[0]
    inverted = 0
    for f in range(owner.shape[0]):
        begin, size = start[f], start[f + 1] - start[f]
        best, chosen, negative, first = -np.inf, 0, 0, 0
        for k in range(1, size):
            first = k if lists[begin + k] < lists[begin + first] else first
        if size == 4:
            # The opposite base has the same fan.
            first %= 2
        stride = 1 + size // _MOST_BASES
        for base in range(0, 1 if size == 3 else 2 if size == 4 else size, stride):
            worst, wrong = np.inf, 0
            for side in range(2 if f < n_internal else 1):
                c = owner[f] if side == 0 else neighbour[f]
                for k in range(1, size - 1):
                    i, j = (base + k) % size, (base + k + 1) % size
                    q = _quality(points, centres, c, lists[begin + base], lists[begin + i], lists[begin + j])
                    q = q if side == 0 else -q
                    worst = min(worst, q)
                    wrong += q <= 0.0
            # Round-off, or the order in a file, must not choose between equal fans.
            worst += _EQUAL if base == first else 0.0
            if base == 0 or worst > best:
                best, chosen, negative = worst, base, wrong
        inverted += negative
        for _ in range(chosen):
            head = lists[begin]
            for k in range(begin, begin + size - 1):
                lists[k] = lists[k + 1]
            lists[begin + size - 1] = head
    return inverted


def _quality(points: Floats, centres: Floats, cell: int, a: int, b: int, c: int) -> float:
    """Return six times the volume of a tetrahedron over the 3/2 power of the sum of its squared edges."""
    o = point(centres, cell)
    u, v, w = arm(points, a, o), arm(points, b, o), arm(points, c, o)
    volume = inner(u, vector_product(v, w))
    edges = 0.0
    for i in range(3):
        p, q, r = u[i] - v[i], v[i] - w[i], w[i] - u[i]
        edges += u[i] * u[i] + v[i] * v[i] + w[i] * w[i] + p * p + q * q + r * r
    return float(volume / (edges * np.sqrt(edges)))


def number_tetrahedra(faces: Faces, numbers: Numbering) -> None:
    """Number the tetrahedra, cell by cell."""
    tet = 0
    for c in range(faces.first.shape[0] - 1):
        numbers.cell[c] = tet
        for h in range(faces.first[c], faces.first[c + 1]):
            f = faces.of_cell[h]
            if faces.owner[f] == c:
                numbers.face[f] = tet
            tet += faces.start[f + 1] - faces.start[f] - 2
    numbers.cell[faces.first.shape[0] - 1] = tet


def split_cells(
    begin_cell: int, end_cell: int, n_points: int, faces: Faces, numbers: Numbering, edges: Ints, fans: Fans
) -> None:
    """Cut cells into tetrahedra, a fan on each face, and connect these.

    Parameters
    ----------
    begin_cell, end_cell
        The cells to cut, from the first to before the last.
    n_points
        Number of mesh points; the centre of cell c is node ``n_points + c``.
    faces, numbers
        The faces, and the result of :func:`number_tetrahedra`.
    edges
        (5, m) work array of :func:`_join`; must hold −1. m is a power of two, at least the number of points
        of all faces of any cell.
    fans
        The results.
    """
    start, lists, first, n_internal = faces.start, faces.points, faces.first, faces.neighbour.shape[0]
    tets, neighbours, state = fans.tets, fans.neighbours, fans.state
    boundary = start[n_internal] - 2 * n_internal
    for c in range(begin_cell, end_cell):
        tet = numbers.cell[c]
        found = loose = 0
        for h in range(first[c], first[c + 1]):
            f = faces.of_cell[h]
            begin, size = start[f], start[f + 1] - start[f]
            owned = faces.owner[f] == c
            for k in range(size - 2):
                # In the neighbour the fan turns the other way about the same base.
                i, j = (k + 1, k + 2) if owned else (size - 1 - k, size - 2 - k)
                tets[tet + k, 0], tets[tet + k, 1] = n_points + c, lists[begin]
                tets[tet + k, 2], tets[tet + k, 3] = lists[begin + i], lists[begin + j]
                if k > 0:
                    neighbours[tet + k, 3] = tet + k - 1
                if k < size - 3:
                    neighbours[tet + k, 2] = tet + k + 1
                if f >= n_internal:
                    triangle = begin - 2 * f - boundary + k
                    neighbours[tet + k, 0] = -1 - triangle
                    fans.triangle_tet[triangle] = tet + k
                elif not owned:
                    across = numbers.face[f] + size - 3 - k
                    neighbours[tet + k, 0], neighbours[across, 0] = across, tet + k
            for k in range(size):
                after = k + 1 if k + 1 < size else 0
                i, j = (k, after) if owned else (size - k if k > 0 else 0, size - 1 - k)
                a, b = lists[begin + i], lists[begin + j]
                # The first edge of a fan is opposite vertex 3 of its first tetrahedron, the last opposite
                # vertex 2 of its last, every other opposite vertex 1.
                slot = 3 if k == 0 else 2 if k == size - 1 else 1
                place = 4 * (tet + min(max(k - 1, 0), size - 3)) + slot
                more, wrong = _join(a, b, place, edges, found, neighbours)
                found, loose = found + (more > 0), loose + more
                state[c] |= wrong
            tet += size - 2
        if loose != 0:
            state[c] |= OPEN
        for e in range(found):
            edges[0, (edges[2, e] + edges[3, e]) & (edges.shape[1] - 1)] = -1


def _join(a: int, b: int, place: int, edges: Ints, found: int, neighbours: Ints) -> tuple[int, int]:
    """Connect the tetrahedra at an edge of a cell if the edge is known; otherwise store it.

    Parameters
    ----------
    a, b, place
        Points of the edge, and 4 t + k for the face opposite vertex k of tetrahedron t.
    edges
        Edges by the sum of their points. Rows: first of each chain; next in the chain, a, b and place by
        edge, with place −1 after both sides were found.
    found
        Number of edges so far.

    Returns
    -------
    1 for a new edge, −1 for a completed one; the state of the cell.
    """
    slot = (a + b) & (edges.shape[1] - 1)
    e = edges[0, slot]
    while e >= 0:
        p, q, other = edges[2, e], edges[3, e], edges[4, e]
        if (p == b and q == a) or (p == a and q == b):
            if other < 0:
                return 0, OPEN
            neighbours[place >> 2, place & 3] = other >> 2
            neighbours[other >> 2, other & 3] = place >> 2
            edges[4, e] = -1
            return -1, TWISTED if p == a else 0
        e = edges[1, e]
    edges[1, found], edges[0, slot] = edges[0, slot], found
    edges[2, found], edges[3, found], edges[4, found] = a, b, place
    return 1, 0
