"""What a flow on a mesh gives to the kernels, and to those who ask for its patches and cells."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest
from mesh_shapes import block, boundary, box_patches, corners, cyclic_row, grid, interfaces, merged, period

from foamprb.errors import InputError
from foamprb.flow.fluxes import free_nodes
from foamprb.flow.mesh.arrays import FREE
from foamprb.flow.mesh.folds import FOLDED
from foamprb.flow.mesh.locator import cell_boxes
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow


def flow_on(mesh, random=None, **options):
    n = len(mesh.nodes)
    u, l = (np.zeros((n, 3)), np.zeros((n, 3, 3)))
    if random is not None:
        u, l = random.normal(size=u.shape), random.normal(size=l.shape)
    return MeshFlow(mesh, u, l, **options)


def box(size=(1.0, 1.0, 1.0), types=None):
    """A box of these sides, each side a patch of its own."""
    shape = block(3, 0.0)
    shape.points = np.asarray(shape.points) * size

    def name(x):
        for axis, letter in enumerate("xyz"):
            if x[axis] < 1e-9 or x[axis] > size[axis] - 1e-9:
                return letter
        raise AssertionError

    kinds = dict.fromkeys("xyz", "wall") | (types or {})
    return build_mesh(shape, boundary(shape, name, kinds))


@pytest.mark.parametrize(
    ("types", "width"),
    [
        ({}, 0.5),
        ({"z": "patch"}, 0.5),
        ({"z": "empty"}, 2.0),
        ({"z": "symmetryPlane"}, 2.0),
        ({"z": "symmetry", "y": "wedge"}, 3.0),
        ({"x": "empty", "y": "empty", "z": "empty"}, np.inf),
    ],
)
def test_the_width_is_the_shortest_way_between_walls_or_openings(types, width):
    for turn in range(3):
        size = np.roll([3.0, 2.0, 0.5], turn)
        named = {"xyz"[("xyz".index(k) + turn) % 3]: v for k, v in types.items()}
        assert flow_on(box(size, named)).width == pytest.approx(width)


def test_coupled_patches_do_not_end_a_flow():
    row = cyclic_row(0.0, 1)
    row.points[:, 0] *= 0.5
    assert flow_on(row).width == pytest.approx(1.0)
    assert [p.neighbour for p in row.patches] == ["right", "left", "", ""]


@pytest.mark.parametrize(("lean", "width"), [(0.01, 2.005), (0.1, 0.5)])
def test_walls_that_hardly_lean_are_no_end_across(lean, width):
    """Between planes of symmetry: walls face along z by less than a hundredth of their area, or by more."""
    shape = block(3, 0.0)
    x, y, z = np.array(shape.points).T
    shape.points = np.column_stack([3.0 * x, 2.0 * y + lean * 0.5 * z, 0.5 * z])

    def name(x):
        return "planes" if min(x[2], 0.5 - x[2]) < 1e-9 else "sides"

    mesh = build_mesh(shape, boundary(shape, name, {"planes": "symmetry", "sides": "wall"}))
    assert flow_on(mesh).width == pytest.approx(width)


@pytest.mark.parametrize("angle", [0.0, 60.0])
def test_each_triangle_of_a_coupled_patch_knows_those_of_the_face_across(angle):
    mesh = cyclic_row(angle, 1)
    arrays = flow_on(mesh).arrays()
    turn, shift = period(angle)
    names = [patch.name for patch in mesh.patches]
    for triangle, patch in enumerate(mesh.triangle_patch):
        first, last = arrays.across[triangle]
        others = arrays.partners[first:last]
        if names[patch] not in ("left", "right"):
            assert (first, last) == (0, 0)
            continue
        face = mesh.boundary_centres[mesh.triangle_face[triangle]]
        image = turn @ face + shift if names[patch] == "left" else turn.T @ (face - shift)
        assert len(others) == 2
        across = mesh.triangle_face[others]
        assert across[0] == across[1]
        np.testing.assert_allclose(mesh.boundary_centres[across[0]], image, atol=1e-9)
    motions = arrays.motions.reshape(len(names), 12)
    for k, name in enumerate(names):
        q, s = {"left": (turn, shift), "right": (turn.T, -turn.T @ shift)}.get(name, (np.eye(3), np.zeros(3)))
        np.testing.assert_allclose(motions[k], [*q.ravel(), *s], atol=1e-9)


def test_triangles_across_patches_cut_differently_are_all_that_overlap(random):
    """Every place of a triangle lies in one of those that are listed for it."""
    mesh, _, _ = interfaces(0.0, (3, 4), 0.0)
    arrays = flow_on(mesh).arrays()
    names = [patch.name for patch in mesh.patches]
    checked = 0
    for name in ("after0", "before1"):
        for triangle in np.flatnonzero(mesh.triangle_patch == names.index(name)):
            first, last = arrays.across[triangle]
            others = arrays.partners[first:last]
            assert last > first
            assert {names[p] for p in mesh.triangle_patch[others]} == {
                "before1" if name == "after0" else "after0"
            }
            corners = mesh.points[mesh.triangles[others]][:, :, 1:]
            for x in random.dirichlet(np.ones(3), 20) @ mesh.points[mesh.triangles[triangle]][:, 1:]:
                d = np.roll(corners, -1, axis=1) - corners
                turns = d[:, :, 0] * (x[1] - corners[:, :, 1]) - d[:, :, 1] * (x[0] - corners[:, :, 0])
                assert ((turns >= -1e-12).all(axis=1) | (turns <= 1e-12).all(axis=1)).any()
                checked += 1
    assert checked > 500


def test_nodes_are_points_and_centres_with_their_values(random):
    mesh = build_mesh(block(2, 0.2))
    n = len(mesh.nodes)
    u, l, k = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3)), random.normal(size=(n, 8))
    flow = MeshFlow(mesh, u, l, ["one", "two"], time="0.25", turbulence=k)
    nodes = flow.arrays().nodes
    np.testing.assert_array_equal(nodes[:, :3], np.concatenate([mesh.points, mesh.centres]))
    np.testing.assert_array_equal(nodes[:, 4:7], u)
    np.testing.assert_array_equal(nodes[:, 7:], l.reshape(-1, 9))
    assert np.array_equal(nodes[:, FREE], free_nodes(mesh))
    name, u_nodes, l_nodes = flow.at_nodes()
    assert name == "0.25"
    np.testing.assert_array_equal(u_nodes, u)
    np.testing.assert_array_equal(l_nodes, l.reshape(-1, 9))
    np.testing.assert_array_equal(flow.turbulence_at_nodes(), k)
    assert flow_on(mesh).turbulence_at_nodes().shape == (0, 8)
    assert flow.notes == ("one", "two")
    assert flow.span == (-np.inf, np.inf)
    assert flow.load(0.0, 1.0) == np.inf


def test_what_tells_a_flow_from_another(random):
    """One value, the order of two, a point, a cell and a patch."""
    mesh = build_mesh(block(2, 0.2), box_patches(block(2, 0.2)))
    n = len(mesh.nodes)
    u, l = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3))
    before = MeshFlow(mesh, u, l).traits()
    assert all(np.array_equal(value, before[name]) for name, value in MeshFlow(mesh, u, l).traits().items())
    other, swapped, moved = u.copy(), u.copy(), block(2, 0.2)
    other[5, 1] *= 1.0 + 1e-6
    # Of two centres, which count alike.
    swapped[[-1, -2]] = u[[-2, -1]]
    moved.points[13] += 1e-6
    faces = replace(mesh, triangle_patch=np.roll(mesh.triangle_patch, 1))
    cells = replace(mesh, cell_points=np.roll(mesh.cell_points, 1))
    for flow, name in (
        (MeshFlow(mesh, other, l), "nodes"),
        (MeshFlow(mesh, swapped, l), "nodes"),
        (MeshFlow(build_mesh(moved, box_patches(moved)), u, l), "nodes"),
        (MeshFlow(cells, u, l), "cells"),
        (MeshFlow(faces, u, l), "patches"),
    ):
        found = flow.traits()[name]
        assert not np.allclose(
            np.asarray(found, dtype=float), np.asarray(before[name], dtype=float), 1e-10
        ), name


def test_lists_are_made_for_what_is_asked_and_kept():
    shape = block(3, 0.0)
    mesh = build_mesh(shape, box_patches(shape))
    flow = flow_on(mesh)
    plain = flow.arrays()
    assert len(plain.near) == len(plain.seen) == 0
    # Without a reach nothing is touched, without a sight nothing seen.
    assert flow.arrays(0.0, (0, 2)) is plain
    assert flow.arrays(0.3, ()) is plain
    assert flow.arrays(0.0, (0,), 0.0, (0,)) is plain
    near = flow.arrays(0.3)
    assert flow.arrays(0.3, (0, 2)) is near
    assert set(mesh.triangle_patch[np.maximum(near.near, -1 - near.near)]) == {0, 2}
    assert len(near.seen) == 0
    assert len(near.near_start) == len(near.seen_start) == mesh.n_cells + 1
    assert not near.seen_start.any()
    lid = flow.arrays(0.3, (1,))
    assert lid is not near
    assert set(mesh.triangle_patch[np.maximum(lid.near, -1 - lid.near)]) == {1}
    sight = flow.arrays(0.0, (0,), 0.4, (0,))
    assert len(sight.near) == 0
    assert set(mesh.triangle_patch[sight.seen >> 2]) == {0}
    both = flow.arrays(0.3, (1,), 0.4, (0,))
    np.testing.assert_array_equal(both.near, lid.near)
    np.testing.assert_array_equal(both.seen, sight.seen)
    leaves = both.wall_leaves[both.wall_leaves >= 0]
    assert sorted(leaves) == np.flatnonzero(mesh.triangle_patch == 1).tolist()


def test_images_of_walls_stand_behind_the_triangles_of_the_mesh():
    """With their corners as nodes of their own, and the patch and normal of what they are images of."""
    mesh = cyclic_row(0.0, 1)
    flow = flow_on(mesh)
    floor = [patch.name for patch in mesh.patches].index("floor")
    arrays = flow.arrays(0.2, (floor,))
    n, nodes = len(mesh.triangles), len(mesh.nodes)
    images = arrays.triangles[n:]
    assert len(images) > 8
    assert images.ravel().tolist() == list(range(nodes, nodes + images.size))
    assert len(arrays.nodes) == nodes + images.size
    assert set(arrays.triangle_patch[n:]) == {floor}
    np.testing.assert_allclose(arrays.triangle_normals[n:], [[0.0, 0.0, 1.0]] * len(images), atol=1e-12)
    x = arrays.nodes[images][:, :, 0]
    assert ((x.max(axis=1) > 1.0 + 1e-9) | (x.min(axis=1) < -1e-9)).all()
    own = mesh.points[mesh.triangles[mesh.triangle_patch == floor]]
    for image in arrays.nodes[images][:, :, :3]:
        shift = np.array([1.0, 0.0, 0.0]) * (1.0 if image[:, 0].max() > 1.0 + 1e-9 else -1.0)
        assert np.abs(own - (image - shift)).max(axis=(1, 2)).min() < 1e-9


def test_cells_and_zones():
    mesh = build_mesh(block(2, 0.2, "mixed"))
    zones = {"some": np.array([1, 4]), "none": np.array([], dtype=np.int64)}
    flow = flow_on(mesh, zones=lambda: zones)
    everything, some = flow.cell_zone(None), flow.cell_zone("some")
    assert everything.volumes.sum() == pytest.approx(1.0)
    assert everything.hosts.tolist() == list(range(len(mesh.tets)))
    expected = [t for c in (1, 4) for t in range(mesh.cell_start[c], mesh.cell_start[c + 1])]
    assert some.hosts.tolist() == expected
    np.testing.assert_array_equal(some.volumes, everything.volumes[expected])
    np.testing.assert_array_equal(some.vertices(some.hosts[:2]), mesh.nodes[mesh.tets[expected[:2]]])
    assert len(flow.cell_zone("none").hosts) == 0
    with pytest.raises(InputError, match=r"cellZone sone is not in the mesh\. Did you mean 'some'"):
        flow.cell_zone("sone")
    hosts = np.array([0, expected[0]])
    assert flow.cell_of(hosts).tolist() == [0, 1]
    assert flow.cell_size(hosts) == pytest.approx(np.cbrt(mesh.volumes[[0, 1]]))


def test_triangles_of_a_patch(random):
    shape = block(2, 0.2)
    mesh = build_mesh(shape, box_patches(shape))
    flow = flow_on(mesh, random)
    for k, patch in enumerate(mesh.patches):
        faces = flow.patch_faces(patch.name, 0.0)
        at = np.flatnonzero(mesh.triangle_patch == k)
        np.testing.assert_array_equal(faces.vertices, mesh.points[mesh.triangles[at]])
        np.testing.assert_array_equal(faces.hosts, mesh.triangle_tet[at])
        a, b, c = faces.vertices.transpose(1, 0, 2)
        n = np.cross(b - a, c - a)
        np.testing.assert_allclose(faces.areas, 0.5 * np.linalg.norm(n, axis=1))
        np.testing.assert_allclose(faces.normals, -n / np.linalg.norm(n, axis=1)[:, None], atol=1e-12)
        np.testing.assert_array_equal(faces.velocity, flow.at_nodes()[1][mesh.triangles[at]])


def test_inverted_tetrahedra_are_noted():
    mesh = build_mesh(block(3, 2.5))
    [note] = flow_on(mesh).notes
    assert note.startswith(f"{mesh.inverted} of {len(mesh.tets)} tetrahedra are inverted")


@pytest.mark.parametrize("transient", [False, True])
def test_large_arrays_are_put_elsewhere_and_the_flow_stays_the_same(transient, random):
    shape = block(2, 0.2)
    mesh = build_mesh(shape, box_patches(shape))
    n = len(mesh.nodes)
    values = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3))
    flow = SeriesFlow(mesh, (0.0, 1.0), lambda _: values) if transient else MeshFlow(mesh, *values)
    x = random.uniform(0.05, 0.95, (20, 3))
    before, placed = flow.sample(x, flow.locate(x), 0.3), []
    # Walls that were listed before do not hold the arrays of before.
    flow.arrays(0.2)

    def place(array):
        placed.append(array.copy())
        return placed[-1]

    flow.move(place)
    arrays = flow.arrays(0.2).mesh if transient else flow.arrays(0.2)
    assert len(arrays.near)
    here = {id(a) for a in placed}
    for name, array in arrays._asdict().items():
        if isinstance(array, np.ndarray):
            assert (id(array) in here) == (not name.startswith(("near", "wall_", "seen"))), name
    assert id(flow.mesh.tets) in here
    for a, b in zip(flow.sample(x, flow.locate(x), 0.3), before, strict=True):
        np.testing.assert_array_equal(a, b)


def test_folded_cells_and_the_triangles_near_them_are_listed():
    """A cell is folded whose box meets that of a tetrahedron turned inside out."""
    points, hexes = corners(4, 0.0)
    # A point inside, beyond the opposite sides of some of its cells.
    inside = np.flatnonzero(np.all((points > 1e-9) & (points < 0.4), axis=1))
    points[inside[0]] += (0.28, 0.23, 0.19)
    flow = flow_on(build_mesh(grid(points, [(12, hexes)])))
    mesh, arrays = flow.mesh, flow.arrays()
    a, b, c, d = (mesh.nodes[mesh.tets[:, k]] for k in range(4))
    volumes = np.einsum("ti,ti->t", b - a, np.cross(c - a, d - a))
    turned = mesh.nodes[mesh.tets[volumes < 0.0]]
    boxes = cell_boxes(mesh)

    def meet(low, high, box):
        return np.all((low <= box[3:]) & (box[:3] <= high), axis=1)

    sides = mesh.points[mesh.triangles]
    states = set()
    for cell in range(mesh.n_cells):
        is_folded = meet(turned.min(axis=1), turned.max(axis=1), boxes[cell]).any()
        assert (arrays.folds[cell] == FOLDED) == is_folded
        rim = arrays.rim[arrays.rim_start[cell] : arrays.rim_start[cell + 1]]
        near = np.flatnonzero(meet(sides.min(axis=1), sides.max(axis=1), boxes[cell]))
        assert sorted(rim.tolist()) == (near.tolist() if is_folded else [])
        states.add(bool(is_folded))
    assert states == {True, False}
    assert arrays.rim_start[-1] == len(arrays.rim) > 0


@pytest.mark.parametrize(("shift", "noticed"), [((2.0, 0.0, 0.0), 0), ((0.4, 0.1, 0.1), 1)])
def test_overlapping_blocks_are_noticed(shift, noticed):
    first, second = block(3, 0.0), block(3, 0.0)
    second.points = np.asarray(second.points) + shift
    caveats = flow_on(build_mesh(merged([first, second]))).overlap()
    assert len(caveats) == noticed
    assert all("of 54 cell centres lie in another cell too" in caveat for caveat in caveats)
