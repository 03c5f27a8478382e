"""Meshes that no mesher should make: folded, concave, flat, collapsed; and walks through them, checked apart.

A walk must go as far as the straight line does in a closed surface, that of the boundary's triangles: this is
found without any tetrahedron, by cutting the line with each triangle. Whether a place lies inside is found by
the solid angle of all triangles.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from mesh_shapes import HEXAHEDRON_FACES, corners, grid, polyhedra

from foamprb.compile.link import link
from foamprb.errors import InputError
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.walk import FAILED, REACHED, walk

N = 4
# Six tetrahedra of each cube, along its main diagonal.
PATHS = ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))
FLUSH = 1e-9
"""Distance within which two places count as the same, in units of the box in each direction."""
ROUND = 1e-15
"""Distance from a plane, in the same units, that is round-off of a place in it."""


def shaken(share, n=N, seed=0, rim=True):
    """Points of n³ cells, moved by up to a share of the cell's width; with ``rim`` the boundary's too."""
    points, hexes = corners(n, 0.0)
    random = np.random.default_rng(seed)
    inside = np.all((points > 1e-9) & (points < 1.0 - 1e-9), axis=1)
    moved = np.ones(len(points), dtype=bool) if rim else inside
    points[moved] += share / n * random.uniform(-1.0, 1.0, (moved.sum(), 3))
    return points, hexes


def perturbed(seed):
    """By up to 40 %, the boundary as well."""
    return cut(*shaken((0.2, 0.3, 0.4)[seed % 3], seed=seed), seed)


def cut(points, hexes, seed):
    """Hexahedra, tetrahedra or prisms."""
    if seed % 4 == 1:
        return grid(points, [(10, hexes[:, [0, a, b, 6]]) for a, b in PATHS])
    if seed % 4 == 2:
        return grid(points, [(13, hexes[:, [0, 1, 2, 4, 5, 6]]), (13, hexes[:, [0, 2, 3, 4, 6, 7]])])
    return grid(points, [(12, hexes)])


def folded(seed):
    """The boundary is at its place; inside some points lie beyond the opposite sides of their cells."""
    points, hexes = shaken(0.3, seed=seed, rim=False)
    inside = np.flatnonzero(np.all((points > 1e-9) & (points < 1.0 - 1e-9), axis=1))
    random = np.random.default_rng(seed)
    chosen = random.choice(inside, 3, replace=False)
    points[chosen] += random.uniform(-1.5, 1.5, (3, 3)) / N
    return cut(points, hexes, seed)


def concave(seed):
    """Perturbed, a quarter taken out; every other seed of cells with ten faces, bent about its rim."""
    points, hexes = shaken(0.25, seed=seed)
    middle = corners(N, 0.0)[0][hexes].mean(axis=1)
    if seed % 2 == 0:
        return cut(points, hexes[~np.all(middle[:, :2] > 0.5, axis=1)], seed)
    kept = np.flatnonzero(~np.all(middle[:, :2] > 0.5, axis=1))
    pairs = [(a, a + 1) for a in kept if a % 2 == 0 and a + 1 in kept]
    cells = [
        [
            hexes[c, list(face)]
            for c, skip in ((a, 1), (b, 0))
            for k, face in enumerate(HEXAHEDRON_FACES)
            if k != skip
        ]
        for a, b in pairs
    ]
    return polyhedra(points, cells)


def thin(aspect):
    """Perturbed by up to 40 %, then pressed flat."""

    def shape(seed):
        shaped = perturbed(seed)
        shaped.points = np.asarray(shaped.points) * np.array([1.0, 1.0, 1.0 / aspect])
        return shaped

    return shape


def collapsed(seed):
    """Inner edges without length: two points at the same place."""
    points, hexes = shaken(0.1, seed=seed)
    random = np.random.default_rng(seed)
    inside = np.all((points > 0.5 / N) & (points < 1.0 - 0.5 / N), axis=1)
    for c in random.permutation(len(hexes)):
        for i, j in ((0, 1), (1, 2), (0, 4), (5, 6)):
            a, b = hexes[c, i], hexes[c, j]
            if inside[a] and inside[b] and random.random() < 0.4:
                points[a] = points[b]
    return cut(points, hexes, seed)


def collapsed_rim(seed):
    """An edge of the box pressed into its neighbour, and a face of a cell beside it into an edge."""
    points, hexes = shaken(0.0, seed=seed)
    s = N + 1
    for k in range(s):
        points[k * s * s] = points[k * s * s + 1]
    points[s] = points[s + 1]
    return cut(points, hexes, seed)


def flat(thickness):
    """A layer of cells pressed flat."""

    def shape(seed):
        points, hexes = shaken(0.15, seed=seed)
        s = (N + 1) ** 2
        layer = slice(2 * s, 3 * s)
        points[layer] = points[s : 2 * s] + thickness * np.array([0.0, 0.0, 1.0])
        return cut(points, hexes, seed)

    return shape


def slivers(seed):
    """Tetrahedra whose four points lie in a plane."""
    points, hexes = shaken(0.0, seed=seed)
    random = np.random.default_rng(seed)
    inside = np.flatnonzero(np.all((points > 1e-9) & (points < 1.0 - 1e-9), axis=1))
    tets = np.concatenate([hexes[:, [0, a, b, 6]] for a, b in PATHS])
    for tet in random.permutation(tets)[:20]:
        k = random.integers(0, 4)
        if tet[k] in inside:
            a, b, c = (points[p] for j, p in enumerate(tet) if j != k)
            n = np.cross(b - a, c - a)
            if np.linalg.norm(n) > 1e-3:
                n /= np.linalg.norm(n)
                points[tet[k]] -= ((points[tet[k]] - a) @ n) * n
    return cut(points, hexes, 1)


HARD = {
    "perturbed by 40 %": perturbed,
    "folded": folded,
    "concave": concave,
    "aspect 1e4": thin(1e4),
    "aspect 1e6": thin(1e6),
    "aspect 1e8": thin(1e8),
    "collapsed edges": collapsed,
    "collapsed edges of the boundary": collapsed_rim,
    "a layer 1e-6 thin": flat(1e-6),
    "a layer 1e-12 thin": flat(1e-12),
    "a layer without volume": flat(0.0),
    "slivers": slivers,
}


class Counts(NamedTuple):
    """What came of walks; all but the first three should be none."""

    walks: int = 0
    reached: int = 0
    left: int = 0
    failed: int = 0
    """Walks that gave up."""
    early: int = 0
    """Left the mesh where the straight line does not."""
    late: int = 0
    """Went on where the straight line has left."""
    outside: int = 0
    """Places that are outside by their solid angle, and not on the boundary; places that were not found."""
    astray: int = 0
    """Places that are not in their host."""
    worst: float = 0.0
    """How far at most an exit was from where the straight line leaves, in boxes."""

    def __add__(self, other):
        sums = [a + b for a, b in zip(self[:-1], other[:-1], strict=True)]
        return Counts(*sums, max(self.worst, other.worst))

    @property
    def wrong(self):
        return self.failed + self.early + self.late + self.outside + self.astray


def flow_in(shape):
    """A linear flow in a mesh; InputError for one with a cell inside out, which every reader refuses."""
    mesh = build_mesh(shape)
    if mesh.volumes.min() < -1e-12 * np.ptp(mesh.points, axis=0).prod():
        raise InputError("A cell is inside out.")
    return MeshFlow(mesh, mesh.nodes.copy(), np.broadcast_to(np.eye(3), (len(mesh.nodes), 3, 3)))


def try_walks(shape, n, each, seed, every=25):
    """Let n particles walk, each so many times, each time checked; where they are after so many of them."""
    flow = flow_in(shape)
    arrays, points = flow.arrays(), flow.mesh.points
    extent = np.ptp(points, axis=0)
    triangles = np.ascontiguousarray(points[flow.mesh.triangles] / extent)
    random = np.random.default_rng(seed)
    x = points.min(axis=0) + extent * random.uniform(-0.05, 1.05, (4 * n, 3))
    hosts = flow.locate(x)
    inside, apart_by = seen(triangles, x / extent)
    counts, outside, astray = np.zeros(7), ((inside != (hosts >= 0)) & (apart_by > FLUSH)).sum(), 0
    x, hosts = x[hosts >= 0][:n], hosts[hosts >= 0][:n]
    for k in range(each):
        steps = random.normal(size=(len(x), 3))
        steps *= np.exp(random.uniform(np.log(0.02), np.log(2.0), (len(x), 1))) * extent
        steps /= np.sqrt(3.0)
        link(wander)(arrays, triangles, extent, x, hosts, steps, counts)
        if k % every == every - 1:
            inside, apart_by = seen(triangles, x / extent)
            outside += (~inside & (apart_by > FLUSH)).sum()
            astray += (~(from_hosts(flow, hosts, x) < 2.0 * FLUSH)).sum()
    return Counts(*map(int, counts[:6]), int(outside), int(astray), float(counts[6]))


def seen(triangles, x):
    """Which places are inside a closed surface, and their distances from it."""
    angle, distance = np.empty(len(x)), np.empty(len(x))
    link(see)(triangles, np.ascontiguousarray(x), angle, distance)
    return angle > 0.5, distance


def from_hosts(flow, hosts, x):
    """Distances of places from their tetrahedra, or a little more, in boxes; ∞ for one without volume."""
    extent = np.ptp(flow.mesh.points, axis=0)
    corners_of = flow.mesh.nodes[flow.mesh.tets[hosts]] / extent
    a, edges = corners_of[:, 0], (corners_of[:, 1:] - corners_of[:, :1]).transpose(0, 2, 1)
    empty = np.linalg.det(edges) == 0.0
    edges[empty] = np.eye(3)
    w = np.linalg.solve(edges, (x / extent - a)[:, :, None])[:, :, 0]
    w = np.clip(np.column_stack([1.0 - w.sum(axis=1), w]), 0.0, None)
    w /= w.sum(axis=1)[:, None]
    return np.where(
        empty, np.inf, np.linalg.norm(np.einsum("nk,nki->ni", w, corners_of) - x / extent, axis=1)
    )


def wander(flow, triangles, extent, x, hosts, steps, counts):
    """One walk of each particle, and what the straight line does."""
    ex, ey, ez = extent[0], extent[1], extent[2]
    for i in range(x.shape[0]):
        x0 = (x[i, 0], x[i, 1], x[i, 2])
        d = (steps[i, 0], steps[i, 1], steps[i, 2])
        x1 = (x0[0] + d[0], x0[1] + d[1], x0[2] + d[2])
        host, fraction, patch, _ = walk(flow, hosts[i], x0, x1)
        counts[0] += 1
        if patch == FAILED:
            counts[3] += 1
            continue
        counts[1 if patch == REACHED else 2] += 1
        scaled = (d[0] / ex, d[1] / ey, d[2] / ez)
        length = np.sqrt(scaled[0] ** 2 + scaled[1] ** 2 + scaled[2] ** 2)
        room = FLUSH / length
        met, first = ray(triangles, (x0[0] / ex, x0[1] / ey, x0[2] / ez), scaled, room, fraction)
        if first < fraction - room:
            counts[5] += 1
        if patch != REACHED:
            counts[6] = max(counts[6], met * length)
            counts[4] += met > room
        hosts[i] = host
        for k in range(3):
            x[i, k] = x0[k] + fraction * d[k] if patch != REACHED else x1[k]


def ray(triangles, o, d, room, at):
    """How far from ``at`` the nearest meeting of a line with triangles is, and the first behind ``room``.

    A line that grazes a triangle meets it wherever it is in the plane to round-off; that counts as ``room``.
    """
    nearest, first = np.inf, np.inf
    for k in range(triangles.shape[0]):
        ax, ay, az = triangles[k, 0, 0], triangles[k, 0, 1], triangles[k, 0, 2]
        p = (triangles[k, 1, 0] - ax, triangles[k, 1, 1] - ay, triangles[k, 1, 2] - az)
        q = (triangles[k, 2, 0] - ax, triangles[k, 2, 1] - ay, triangles[k, 2, 2] - az)
        r = (o[0] - ax, o[1] - ay, o[2] - az)
        h = outer(d, q)
        det = inner(p, h)
        if det == 0.0:
            continue
        g = outer(r, p)
        u, v, t = inner(r, h) / det, inner(d, g) / det, inner(q, g) / det
        if u >= -FLUSH and v >= -FLUSH and u + v <= 1.0 + FLUSH:
            off = abs(t - at)
            n = outer(p, q)
            # det is how fast the line comes nearer to the plane, times the length of n.
            if off > room and off * abs(det) < ROUND * np.sqrt(inner(n, n)):
                off = room
            nearest = min(nearest, off)
            if u >= FLUSH and v >= FLUSH and u + v <= 1.0 - FLUSH and t > room:
                first = min(first, t)
    return nearest, first


def see(triangles, x, angle, distance):
    """The solid angle of a closed surface, in units of 4π, and the distance to its nearest triangle."""
    for i in range(x.shape[0]):
        total, nearest = 0.0, np.inf
        for k in range(triangles.shape[0]):
            a, b = from_place(triangles, k, 0, x, i), from_place(triangles, k, 1, x, i)
            c = from_place(triangles, k, 2, x, i)
            la, lb, lc = np.sqrt(inner(a, a)), np.sqrt(inner(b, b)), np.sqrt(inner(c, c))
            below = la * lb * lc + inner(a, b) * lc + inner(b, c) * la + inner(c, a) * lb
            total += 2.0 * np.arctan2(inner(a, outer(b, c)), below)
            nearest = min(nearest, apart(a, b, c))
        angle[i], distance[i] = total / (4.0 * np.pi), nearest


def from_place(triangles, k, corner, x, i):
    """A triangle's corner as seen from a place."""
    return (
        triangles[k, corner, 0] - x[i, 0],
        triangles[k, corner, 1] - x[i, 1],
        triangles[k, corner, 2] - x[i, 2],
    )


def inner(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


def outer(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


def apart(a, b, c):
    """Distance of a triangle from the origin: of its inside, or of its sides."""
    best = min(side(a, b), side(b, c), side(c, a))
    p, q = (b[0] - a[0], b[1] - a[1], b[2] - a[2]), (c[0] - a[0], c[1] - a[1], c[2] - a[2])
    n = outer(p, q)
    nn, height = inner(n, n), inner(a, n)
    if nn > 0.0:
        f = height / nn
        w = (f * n[0] - a[0], f * n[1] - a[1], f * n[2] - a[2])
        s, t = inner(outer(w, q), n) / nn, inner(outer(p, w), n) / nn
        if s >= 0.0 and t >= 0.0 and s + t <= 1.0:
            best = min(best, abs(height) / np.sqrt(nn))
    return best


def side(a, b):
    """Distance of a line from the origin."""
    d = (b[0] - a[0], b[1] - a[1], b[2] - a[2])
    dd = inner(d, d)
    s = min(max(-inner(a, d) / dd, 0.0), 1.0) if dd > 0.0 else 0.0
    m = (a[0] + s * d[0], a[1] + s * d[1], a[2] + s * d[2])
    return np.sqrt(inner(m, m))
