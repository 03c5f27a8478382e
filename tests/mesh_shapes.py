"""Meshes for the tests of the flow: blocks of every kind of cell, and pipes."""

from __future__ import annotations

import numpy as np
import pyvista

from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh, Transform
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.lists import starts
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.read.boundary import PatchInfo, patches_of_mesh

HEXAHEDRON_FACES = ((0, 4, 7, 3), (1, 2, 6, 5), (0, 1, 5, 4), (3, 7, 6, 2), (0, 3, 2, 1), (4, 5, 6, 7))
KINDS = ("hexahedra", "tetrahedra", "prisms", "pyramids", "polyhedra", "mixed")


def corners(n, perturbation, seed=0):
    """Points of a unit cube cut into n³ cells, moved inside; and the eight corners of each cell."""
    g = np.linspace(0.0, 1.0, n + 1)
    z, y, x = np.meshgrid(g, g, g, indexing="ij")
    points = np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1)
    inside = np.all((points > 1e-9) & (points < 1.0 - 1e-9), axis=1)
    rng = np.random.default_rng(seed)
    points[inside] += perturbation / n * rng.uniform(-0.5, 0.5, (inside.sum(), 3))
    k, j, i = np.meshgrid(*3 * [np.arange(n)], indexing="ij")
    s, t = n + 1, (n + 1) ** 2
    b = (i + s * j + t * k).ravel()
    return points, np.stack([b, b + 1, b + 1 + s, b + s, b + t, b + 1 + t, b + 1 + s + t, b + s + t], axis=1)


def block(n, perturbation=0.3, kind="hexahedra", seed=0):
    """A unit cube of n³ hexahedra with displaced points, cut further according to the kind."""
    points, hexes = corners(n, perturbation, seed)
    if kind == "hexahedra":
        return grid(points, [(12, hexes)])
    if kind == "tetrahedra":
        # Along the main diagonal, which cuts opposite faces alike.
        paths = ((1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1))
        return grid(points, [(10, hexes[:, [0, a, b, 6]]) for a, b in paths])
    if kind == "prisms":
        return grid(points, [(13, hexes[:, [0, 1, 2, 4, 5, 6]]), (13, hexes[:, [0, 2, 3, 4, 6, 7]])])
    if kind == "pyramids":
        centres = len(points) + np.arange(len(hexes))
        faces = [np.column_stack([hexes[:, list(face)], centres]) for face in HEXAHEDRON_FACES]
        return grid(np.concatenate([points, points[hexes].mean(axis=1)]), [(14, face) for face in faces])
    if kind == "mixed":
        # Layers of hexahedra below, of prisms with quadrangles below and above on top.
        lower, upper = np.split(hexes, [n * n * (n // 2)])
        return grid(
            points,
            [(12, lower), (13, upper[:, [0, 3, 7, 1, 2, 6]]), (13, upper[:, [0, 7, 4, 1, 6, 5]])],
        )
    assert kind == "polyhedra"
    # Neighbours along x become one cell with ten faces.
    first, second = hexes[0::2], hexes[1::2]
    cells = [
        [
            row[list(face)]
            for row, skip in ((a, 1), (b, 0))
            for k, face in enumerate(HEXAHEDRON_FACES)
            if k != skip
        ]
        for a, b in zip(first, second, strict=True)
    ]
    return polyhedra(points, cells)


def grid(points, parts):
    cells, types = [], []
    for kind, ids in parts:
        cells.append(np.column_stack([np.full(len(ids), ids.shape[1]), ids]).ravel())
        types.append(np.full(len(ids), kind, dtype=np.uint8))
    return pyvista.UnstructuredGrid(
        np.concatenate(cells), np.concatenate(types), np.array(points, dtype=float)
    )


def polyhedra(points, cells):
    """Cells given by the vertices of their faces."""
    stream = []
    for faces in cells:
        flat = [number for face in faces for number in (len(face), *face)]
        stream += [len(flat) + 1, len(faces), *flat]
    types = np.full(len(cells), 42, dtype=np.uint8)
    return pyvista.UnstructuredGrid(np.array(stream), types, np.array(points, dtype=float))


def pipe(n, axial=4, radius=1.0, length=1.0):
    """A pipe along x: an inner square of n × n bulging cells and a ring of n // 2 layers."""
    t = np.linspace(-1.0, 1.0, n + 1)
    y, z = np.meshgrid(t, t, indexing="ij")
    core = 0.4 * np.stack([y * np.sqrt(1.0 - z**2 / 4.0), z * np.sqrt(1.0 - y**2 / 4.0)], axis=-1)
    blocks = [core]
    for quarter, side in enumerate((core[:, 0], core[-1, :], core[::-1, -1], core[0, ::-1])):
        angle = (2 * quarter - 3) * np.pi / 4 + np.linspace(0.0, np.pi / 2, n + 1)
        rim = np.stack([np.cos(angle), np.sin(angle)], axis=-1)
        s = np.linspace(0.0, 1.0, n // 2 + 1)[None, :, None]
        blocks.append(side[:, None] * (1.0 - s) + rim[:, None] * s)
    quads, offset = [], 0
    for part in blocks:
        rows, columns = part.shape[:2]
        i, j = np.meshgrid(np.arange(rows - 1), np.arange(columns - 1), indexing="ij")
        base = (offset + i * columns + j).ravel()
        quads.append(np.stack([base, base + columns, base + columns + 1, base + 1], axis=1))
        offset += rows * columns
    flat = np.concatenate([part.reshape(-1, 2) for part in blocks])
    _, first, place = np.unique(np.round(flat, 9), axis=0, return_index=True, return_inverse=True)
    section, quads = flat[first], place.reshape(-1)[np.concatenate(quads)]
    stations = np.linspace(0.0, length, axial + 1)
    points = np.concatenate([np.column_stack([np.full(len(section), x), radius * section]) for x in stations])
    m = len(section)
    hexes = np.concatenate([np.hstack([quads + i * m, quads + (i + 1) * m]) for i in range(axial)])
    return grid(points, [(12, hexes)])


def boundary(mesh_grid, of_centre, types):
    """Patches of a grid: ``of_centre`` names a face's patch by its centre; ``types``: name → type."""
    surface = mesh_grid.extract_surface(algorithm="dataset_surface", pass_pointid=False, pass_cellid=False)
    names = np.array([of_centre(centre) for centre in surface.cell_centers().points])
    return [
        PatchSurface(name, kind, surface.extract_cells(np.flatnonzero(names == name)).extract_surface(
            algorithm="dataset_surface", pass_pointid=False, pass_cellid=False
        ))
        for name, kind in types.items()
    ]  # fmt: skip


def pipe_patches(mesh_grid, length=1.0):
    def name(centre):
        return "inlet" if centre[0] < 1e-9 else "outlet" if centre[0] > length - 1e-9 else "wall"

    return boundary(mesh_grid, name, {"inlet": "patch", "outlet": "patch", "wall": "wall"})


def box_patches(mesh_grid):
    def name(centre):
        return "floor" if centre[2] < 1e-9 else "lid" if centre[2] > 1.0 - 1e-9 else "sides"

    return boundary(mesh_grid, name, {"floor": "wall", "lid": "patch", "sides": "wall"})


def baffle(n, whole=True):
    """A box of n³ cells with a wall of two patches on the faces at x = ½, or on half of these."""
    shape = block(n, 0.0)
    points, hexes = np.asarray(shape.points), shape.cells.reshape(-1, 9)[:, 1:]
    middle = points[hexes].mean(axis=1)
    before = np.abs(middle[:, 0] - 0.5 + 0.5 / n) < 1e-9
    front = hexes[before & (whole | (middle[:, 1] < 0.5))][:, [1, 2, 6, 5]]
    patches = [
        PatchSurface(name, "wall", pyvista.PolyData(points, np.column_stack([np.full(len(f), 4), f]).ravel()))
        for name, f in {"west": front, "east": front[:, ::-1]}.items()
    ]
    return build_mesh(shape, [*box_patches(shape), *patches])


def merged(grids):
    """Grids of hexahedra side by side, points in the same place made one."""
    points = np.concatenate([np.asarray(g.points) for g in grids])
    first = np.concatenate([[0], np.cumsum([g.n_points for g in grids])[:-1]])
    cells = np.concatenate(
        [g.cells.reshape(-1, 9)[:, 1:] + start for g, start in zip(grids, first, strict=True)]
    )
    _, unique, place = np.unique(np.round(points, 9) + 0.0, axis=0, return_index=True, return_inverse=True)
    return grid(points[unique], [(12, place.reshape(-1)[cells])])


def period(angle):
    """Rotation and shift from one period to the next, straight along x or around the z axis."""
    if angle == 0.0:
        return np.eye(3), np.array([1.0, 0.0, 0.0])
    c, s = np.cos(np.radians(angle)), np.sin(np.radians(angle))
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]]), np.zeros(3)


def cyclic_row(angle, n, cells=4, perturbation=0.2):
    """A mesh of n periods, unit cubes straight or bent, between two cyclic patches; the floor is a wall."""
    shape = block(cells, perturbation)
    turn, shift = period(angle)
    if angle:
        x, y, z = np.array(shape.points).T
        shape.points = np.column_stack(
            [(1.0 + y) * np.cos(np.radians(angle) * x), (1.0 + y) * np.sin(np.radians(angle) * x), z]
        )
    parts = [shape]
    for _ in range(n - 1):
        last = parts[-1].copy()
        last.points = np.asarray(last.points) @ turn.T + shift
        parts.append(last)

    def name(centre):
        along = centre[0] / n if angle == 0.0 else np.arctan2(centre[1], centre[0]) / np.radians(angle * n)
        return "left" if along < 1e-9 else "right" if along > 1.0 - 1e-9 else floor(centre)

    def floor(centre):
        return "floor" if centre[2] < 1e-9 else "sides"

    row = merged(parts)
    patches = boundary(row, name, {"left": "cyclic", "right": "cyclic", "floor": "wall", "sides": "wall"})
    patches[0] = patches[0]._replace(neighbour="right")
    patches[1] = matching(patches[0], patches[1], turn, shift, n)._replace(neighbour="left")
    return build_mesh(row, patches)


def beside(grids):
    """Grids of hexahedra in one mesh, each with points of its own."""
    first = np.concatenate([[0], np.cumsum([g.n_points for g in grids])[:-1]])
    cells = [g.cells.reshape(-1, 9)[:, 1:] + start for g, start in zip(grids, first, strict=True)]
    return grid(np.concatenate([np.asarray(g.points) for g in grids]), [(12, np.concatenate(cells))])


def interfaces(angle, cuts=(4, 5, 7), perturbation=0.2):
    """Unit cubes in a row, straight or bent, each cut differently, between cyclicAMI patches all round.

    ``angle`` is that of one cube; the first and the last are neighbours by a translation or a rotation.
    """
    n, parts = len(cuts), []
    for i, cut in enumerate(cuts):
        part = block(cut, perturbation, seed=i)
        part.points = np.asarray(part.points) + np.array([float(i), 0.0, 0.0])
        if angle:
            x, y, z = np.array(part.points).T
            part.points = np.column_stack(
                [(1.0 + y) * np.cos(np.radians(angle) * x), (1.0 + y) * np.sin(np.radians(angle) * x), z]
            )
        parts.append(part)
    turn, shift = period(n * angle)
    around = (
        Transform("rotational", axis=(0.0, 0.0, -2.0))
        if angle
        else Transform("translational", separation=(-float(n), 0.0, 0.0))
    )

    def along(x):
        return x[0] if angle == 0.0 else np.arctan2(x[1], x[0]) / np.radians(angle)

    patches = []
    for i, part in enumerate(parts):
        before, after = f"before{i}", f"after{i}"

        def name(x, i=i, before=before, after=after):
            at = along(x)
            return before if at < i + 1e-9 else after if at > i + 1.0 - 1e-9 else "sides"

        types = {before: "cyclicAMI", after: "cyclicAMI", "sides": "wall"}
        first, last, sides = boundary(part, name, types)
        patches += [
            first._replace(neighbour=f"after{(i - 1) % n}", transform=around if i == 0 else Transform()),
            last._replace(neighbour=f"before{(i + 1) % n}", transform=around if i == n - 1 else Transform()),
            sides._replace(name=f"sides{i}"),
        ]
    return build_mesh(beside(parts), patches), turn, shift * n


def joined_boxes(cuts, joints, openings=(), perturbation=0.2):
    """Unit cubes far from each other, each cut differently; some sides continue in sides of others.

    A joint is a type of coupled patches, an axis, and two cubes: the upper side of the first along the axis
    continues in the lower side of the second. ``openings`` are patches, such as ``cube0upper2``; all other
    sides are walls.
    """
    parts, types, infos = [], {}, []
    for i, cut in enumerate(cuts):
        part = block(cut, perturbation, seed=i)
        part.points = np.asarray(part.points) + np.array([3.0 * i, 0.0, 0.0])
        parts.append(part)
        names = [f"cube{i}{end}{axis}" for axis in range(3) for end in ("lower", "upper")]
        types[i] = {name: "patch" if name in openings else "wall" for name in names}
    for kind, axis, one, other in joints:
        ends = {one: f"cube{one}upper{axis}"}, {other: f"cube{other}lower{axis}"}
        shift = np.array([3.0 * (other - one), 0.0, 0.0]) - np.eye(3)[axis]
        for own, theirs, sign in ((*ends, 1.0), (*ends[::-1], -1.0)):
            (name,), (beyond,) = own.values(), theirs.values()
            transform = Transform("translational", separation=tuple(sign * shift))
            if kind == "nonConformalCyclic":
                infos.append(PatchInfo(name, "wall", 1, 0, "", Transform(), {}))
                entries = {"originalPatch": name}
                infos.append(PatchInfo(f"on{name}", kind, 0, 0, f"on{beyond}", transform, entries))
            else:
                infos.append(PatchInfo(name, kind, 1, 0, beyond, transform, {}))
    coupled = {patch.name: patch for patch in patches_of_mesh(infos)}

    def name(x):
        y = x - [3.0 * round((x[0] - 0.5) / 3.0), 0.0, 0.0]
        axis = int(np.argmax(np.abs(y - 0.5)))
        return f"cube{round((x[0] - 0.5) / 3.0)}{'upper' if y[axis] > 0.5 else 'lower'}{axis}"

    patches = [
        coupled[p.name]._replace(surface=p.surface) if p.name in coupled else p
        for i, part in enumerate(parts)
        for p in boundary(part, name, types[i])
    ]
    return build_mesh(beside(parts), patches)


def ring(inner, outer, around, layers=3):
    """A ring about the z axis, one cell high, cut into straight segments."""
    r = np.linspace(inner, outer, layers + 1)
    a = np.linspace(0.0, 2.0 * np.pi, around, endpoint=False)
    z, phi, radius = np.meshgrid([0.0, 1.0], a, r, indexing="ij")
    points = np.column_stack([(radius * np.cos(phi)).ravel(), (radius * np.sin(phi)).ravel(), z.ravel()])
    m, top = layers + 1, (layers + 1) * around
    j, i = (index.ravel() for index in np.meshgrid(np.arange(around), np.arange(layers), indexing="ij"))
    k = (j + 1) % around
    low = np.stack([j * m + i, j * m + i + 1, k * m + i + 1, k * m + i], axis=1)
    return grid(points, [(12, np.hstack([low, low + top]))])


def rings(around=(24, 36), layers=3):
    """Two rings, from r = 0.5 to 1 and from 1 to 1.5, that slide on each other."""
    parts = [ring(0.5, 1.0, around[0], layers), ring(1.0, 1.5, around[1], layers)]
    patches = []
    for part, own, other, edges in zip(
        parts, ("in", "out"), ("out", "in"), ((0.5, 1.0), (1.5, 1.0)), strict=True
    ):

        def name(x, own=own, edges=edges):
            if min(x[2], 1.0 - x[2]) < 1e-9:
                return f"{own}Ends"
            return own if abs(np.hypot(x[0], x[1]) - edges[1]) < 0.02 else f"{own}Wall"

        types = {own: "cyclicAMI", f"{own}Ends": "wall", f"{own}Wall": "wall"}
        first, *others = boundary(part, name, types)
        patches += [first._replace(neighbour=other), *others]
    return build_mesh(beside(parts), patches)


def matching(left, right, turn, shift, n):
    """The right patch with its faces in the order of those of the left."""
    centres = np.array(left.surface.cell_centers().points)
    for _ in range(n):
        centres = centres @ turn.T + shift
    distance = np.linalg.norm(centres[:, None] - right.surface.cell_centers().points[None], axis=2)
    faces = right.surface.faces.reshape(-1, 5)[distance.argmin(axis=1)]
    return right._replace(surface=pyvista.PolyData(np.array(right.surface.points), faces.ravel()))


def wedge(n, angle=5.0):
    """A sector about the z axis, one cell thick, n cells from the axis to r = 1 and n along z."""
    half = np.radians(angle) / 2.0
    i, k = np.meshgrid(np.arange(n + 1), np.arange(n + 1), indexing="ij")
    r, z = i.ravel() / n, k.ravel() / n
    sides = [np.column_stack([r * np.cos(a), r * np.sin(a), z]) for a in (-half, half)]
    m = (n + 1) ** 2
    # The axis has its points once.
    points = np.concatenate([sides[0], sides[1][n + 1 :]])
    back = np.concatenate([np.arange(n + 1), np.arange(m, len(points))])
    cell = np.stack(np.meshgrid(np.arange(n), np.arange(n), indexing="ij"), axis=-1).reshape(-1, 2)
    a = cell[:, 0] * (n + 1) + cell[:, 1]
    b, c, d = a + n + 1, a + n + 2, a + 1
    ring = cell[:, 0] > 0
    hexes = np.stack([a, b, back[b], back[a], d, c, back[c], back[d]], axis=1)[ring]
    prisms = np.stack([a, b, back[b], d, c, back[c]], axis=1)[~ring]
    return grid(points, [(12, hexes), (13, prisms)])


def wedge_patches(shape, angle=5.0):
    tangent = np.tan(np.radians(angle) / 2.0)

    def name(x):
        if abs(abs(x[1]) - tangent * x[0]) < 1e-9:
            return "front" if x[1] < 0.0 else "back"
        return "ends" if min(x[2], 1.0 - x[2]) < 1e-9 else "wall"

    return boundary(shape, name, {"front": "wedge", "back": "wedge", "ends": "patch", "wall": "wall"})


SIDES = {"left": "wall", "right": "wall", "bottom": "wall", "top": "wall", "sides": "empty"}


def layer(x, y, n, m, **types):
    """A rectangle, one cell thick, with n by m cells, and the types of its patches."""
    points = np.stack(np.meshgrid(np.linspace(*x, n + 1), np.linspace(*y, m + 1), [0.0, 0.1]), axis=-1)
    points = points.transpose(2, 0, 1, 3).reshape(-1, 3)
    j, i = np.divmod(np.arange(n * m), n)
    a = i + (n + 1) * j
    base = np.stack([a, a + 1, a + n + 2, a + n + 1], axis=1)
    shape = grid(points, [(12, np.concatenate([base, base + (n + 1) * (m + 1)], axis=1))])

    def name(c):
        near = np.abs([c[0] - x[0], c[0] - x[1], c[1] - y[0], c[1] - y[1]]) < 1e-9
        return [*SIDES][near.argmax() if near.any() else 4]

    patches = boundary(shape, name, {**SIDES, **types})
    if types.get("left") == "cyclic":
        patches[0] = patches[0]._replace(neighbour="right")
        shift = np.array([x[1] - x[0], 0.0, 0.0])
        patches[1] = matching(patches[0], patches[1], np.eye(3), shift, 1)._replace(neighbour="left")
    return build_mesh(shape, patches)


def octants(*fine):
    """A unit cube of eight boxes, some of which are divided into eight again; floor, lid and sides."""
    low = np.array(list(np.ndindex(2, 2, 2)))
    parts = [0.5 * low[[k]] + 0.25 * low if k in fine else 0.5 * low[[k]] for k in range(8)]
    a = np.concatenate(parts)
    b = a + np.repeat([0.25 if k in fine else 0.5 for k in range(8)], [len(part) for part in parts])[:, None]
    sides = {-1: [], 0: [], 1: [], 2: []}
    for i, axis, end in np.ndindex(len(a), 3, 2):
        across = [k for k in range(3) if k != axis]
        plane = (a, b)[end][i, axis]
        low, high = np.maximum(a, a[i]), np.minimum(b, b[i])
        meets = ((b, a)[end][:, axis] == plane) & np.all(low[:, across] < high[:, across], axis=1)
        for j in np.flatnonzero(meets) if meets.any() else [-1]:
            first, last = (low[j], high[j]) if j >= 0 else (a[i].copy(), b[i].copy())
            rectangle = np.array([first, first, last, last])
            rectangle[:, axis] = plane
            rectangle[1, across[0]], rectangle[3, across[0]] = last[across[0]], first[across[0]]
            turned = rectangle if (end == 1) == (axis != 1) else rectangle[::-1]
            if j < 0:
                sides[2 if axis < 2 else end].append((i, -1, turned))
            elif i < j:
                sides[-1].append((i, j, turned))
    listed = [side for group in sides.values() for side in group]
    points = np.unique(np.concatenate([c for *_, c in listed]), axis=0)

    def polygon(corners):
        for p, q in zip(corners, np.roll(corners, -1, axis=0), strict=True):
            s = (points - p) @ (q - p) / ((q - p) @ (q - p))
            off = np.abs(points - p - s[:, None] * (q - p)).max(axis=1)
            on = np.flatnonzero((off < 1e-9) & (s >= 0.0) & (s < 1.0))
            yield from on[np.argsort(s[on])]

    polygons = [list(polygon(corners)) for *_, corners in listed]
    owner, neighbour = (np.array([side[k] for side in listed], dtype=np.int32) for k in (0, 1))
    start = starts(np.array([len(p) for p in polygons])).astype(np.int32)
    faces = faces_of(
        start, np.concatenate(polygons).astype(np.int32), owner, neighbour[neighbour >= 0], len(a)
    )
    kinds = {"floor": "wall", "lid": "patch", "sides": "wall"}
    surfaces = [PatchSurface(name, kind, None) for name, kind in kinds.items()]
    return PolyMesh(points, faces, surfaces, starts([len(sides[k]) for k in range(3)]))
