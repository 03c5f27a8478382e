from __future__ import annotations

import numpy as np
import pytest
import pyvista
from hard_meshes import HARD
from hypothesis import given
from hypothesis import strategies as st
from mesh_shapes import (
    HEXAHEDRON_FACES,
    KINDS,
    baffle,
    block,
    box_patches,
    corners,
    grid,
    pipe,
    pipe_patches,
    polyhedra,
)
from vtkmodules.util.numpy_support import vtk_to_numpy

from foamprb.errors import InputError
from foamprb.flow.base import Patch
from foamprb.flow.mesh.coupling import couple
from foamprb.flow.mesh.faces import choose_bases
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction


def volumes(mesh):
    a, b, c, d = (mesh.nodes[mesh.tets[:, k]] for k in range(4))
    return np.einsum("ti,ti->t", b - a, np.cross(c - a, d - a)) / 6.0


@pytest.mark.parametrize("kind", KINDS)
def test_tetrahedra_fill_the_mesh(kind):
    mesh = build_mesh(block(4, 0.3, kind))
    assert mesh.inverted == 0
    assert volumes(mesh).min() > 0.0
    assert np.sum(volumes(mesh)) == pytest.approx(1.0, rel=1e-13, abs=0.0)
    assert np.sum(mesh.volumes) == pytest.approx(1.0, rel=1e-13, abs=0.0)
    assert np.array_equal(
        np.repeat(np.arange(mesh.n_cells), np.diff(mesh.cell_start)), mesh.tets[:, 0] - mesh.n_points
    )


@pytest.mark.parametrize("kind", KINDS)
def test_tetrahedra_fill_each_cell_with_plane_faces(kind):
    mesh = build_mesh(block(4, 0.0, kind))
    assert np.allclose(np.add.reduceat(volumes(mesh), mesh.cell_start[:-1]), mesh.volumes, rtol=1e-12)


@given(st.sampled_from(KINDS), st.floats(0.0, 0.6), st.integers(0, 1000))
def test_neighbours_share_a_face_and_know_each_other(kind, perturbation, seed):
    mesh = build_mesh(block(2, perturbation, kind, seed))
    tet, slot = np.nonzero(mesh.neighbours >= 0)
    other = mesh.neighbours[tet, slot]
    back = mesh.neighbours[other] == tet[:, None]
    assert np.all(back.sum(axis=1) == 1)
    opposite = np.argmax(back, axis=1)

    def face(tets, slots):
        rows = mesh.tets[tets].astype(int)
        rows[np.arange(len(rows)), slots] = -1
        return np.sort(rows, axis=1)

    assert np.array_equal(face(tet, slot), face(other, opposite))
    assert np.sum(volumes(mesh)) == pytest.approx(1.0)


def test_boundary_triangles_cover_the_boundary_and_know_their_tetrahedron():
    mesh = build_mesh(block(3, 0.3, "mixed"))
    a, b, c = (mesh.points[mesh.triangles[:, k]] for k in range(3))
    assert np.sum(np.linalg.norm(np.cross(b - a, c - a), axis=1)) / 2.0 == pytest.approx(6.0)
    tet, slot = np.nonzero(mesh.neighbours < 0)
    assert np.array_equal(np.sort(-1 - mesh.neighbours[tet, slot]), np.arange(len(mesh.triangles)))
    assert np.array_equal(mesh.triangle_tet[-1 - mesh.neighbours[tet, slot]], tet)
    inside = mesh.centres[mesh.tets[mesh.triangle_tet, 0] - mesh.n_points]
    assert np.all(np.einsum("ti,ti->t", inside - a, mesh.triangle_normals) > 0.0)


def test_the_faces_of_a_cell_around_another_turn_outwards():
    """A cell like a U, its middle outside it, and the cell that fills the U."""
    outline = np.array([(0, 0), (3, 0), (3, 3), (2, 3), (2, 1), (1, 1), (1, 3), (0, 3)], dtype=float)
    points = np.concatenate([np.column_stack([outline, np.full(8, z)]) for z in (0.0, 1.0)])

    def prism(corners):
        walls = [[a, b, b + 8, a + 8] for a, b in zip(corners, corners[1:] + corners[:1], strict=True)]
        return [corners, [k + 8 for k in corners], *walls]

    mesh = build_mesh(polyhedra(points, [prism(list(range(8))), prism([5, 4, 3, 6])]))
    assert mesh.volumes == pytest.approx([7.0, 2.0])
    assert mesh.n_internal == 3
    assert np.sum(volumes(mesh)) == pytest.approx(9.0)
    outward = mesh.boundary_centres - np.array([1.5, 1.5, 0.5])
    assert np.all(np.einsum("fi,fi->f", outward, mesh.boundary_areas) > 0.0)


def test_single_precision_points_are_matched():
    shape = pipe(4, length=0.1, radius=2.1e-3)
    shape.points = shape.points.astype(np.float32)
    mesh = build_mesh(shape, pipe_patches(shape, length=0.1))
    assert mesh.points.dtype == np.float64
    assert np.array_equal(mesh.points, shape.points.astype(float))


def test_two_patches_on_the_same_points_are_told_apart():
    """A baffle: the cells on its two sides do not share points."""
    points, hexes = corners(1, 0.0)
    two = np.concatenate([points, points + np.array([1.0, 0.0, 0.0])])
    shape = grid(two, [(12, np.concatenate([hexes, hexes + 8]))])
    faces = {"left": [1, 3, 7, 5], "right": [8, 12, 14, 10]}
    surface = shape.extract_surface(algorithm="dataset_surface", pass_pointid=False, pass_cellid=False)
    outer = np.flatnonzero(np.abs(surface.cell_centers().points[:, 0] - 1.0) > 1e-9)
    patches = [("outer", "wall", surface.extract_cells(outer).extract_surface(algorithm="dataset_surface"))]
    patches += [(name, "patch", pyvista.PolyData(two, [4, *face])) for name, face in faces.items()]
    mesh = build_mesh(shape, [type(pipe_patches(pipe(2))[0])(*patch) for patch in patches])
    normals = mesh.triangle_normals[:, 0]
    assert np.all(normals[mesh.triangle_patch == 1] == -1.0)
    assert np.all(normals[mesh.triangle_patch == 2] == 1.0)


@pytest.mark.parametrize(("whole", "copies"), [(True, 25), (False, 10)])
def test_a_baffle_parts_the_cells_on_its_two_sides(whole, copies, random):
    """Two patches on the same interior faces, across the whole box or half of it."""
    mesh = baffle(4, whole)
    assert np.diff(mesh.patch_start)[3:].tolist() == [16 if whole else 8] * 2
    assert mesh.n_points == 125 + copies
    assert mesh.inverted == 0
    normals = mesh.triangle_normals[:, 0]
    assert np.all(normals[mesh.triangle_patch == 3] == -1.0)
    assert np.all(normals[mesh.triangle_patch == 4] == 1.0)
    if not whole:
        return
    # A flow on one side alone; the wall between is at rest.
    cells, faces = np.zeros((mesh.n_cells, 3)), np.zeros((len(mesh.boundary_centres), 3))
    west = mesh.centres[:, 0] < 0.5
    cells[west, 1] = 0.5 - mesh.centres[west, 0]
    outer = mesh.patch_start[3]
    faces[:outer, 1] = np.maximum(0.5 - mesh.boundary_centres[:outer, 0], 0.0)
    flow = MeshFlow(mesh, *Reconstruction(mesh)(cells, faces))
    x = np.column_stack([random.choice([0.45, 0.55], 100), 0.25 * random.random(100), random.random(100)])
    u, l = flow.sample(x, flow.locate(x), 0.0)
    assert u[:, 1] == pytest.approx(np.where(x[:, 0] < 0.5, 0.05, 0.0), abs=1e-12)
    assert l[:, 1, 0] == pytest.approx(np.where(x[:, 0] < 0.5, -1.0, 0.0), abs=1e-11)


CUBE, CUBE_CELLS = corners(1, 0.0)
CUBE_FACES = [CUBE_CELLS[0][list(face)] for face in HEXAHEDRON_FACES]


def of_patches(change):
    shape = block(2)
    return lambda: build_mesh(shape, change(box_patches(shape)))


def beside(patches):
    patches[0].surface.points += 0.25
    return patches


def of_other_faces():
    shape = polyhedra(CUBE, [CUBE_FACES])
    vtk_to_numpy(shape.GetPolyhedronFaceLocations().GetConnectivityArray())[-1] = 6
    return build_mesh(shape)


def of_cells(kind, cells):
    return lambda: build_mesh(grid(CUBE, [(kind, cells)]))


REFUSED = {
    "faces without a patch": (
        of_patches(lambda patches: [patch for patch in patches if patch.name != "lid"]),
        "4 of 24 boundary faces belong to no patch; the patches are floor, sides",
    ),
    "faces of two patches": (
        of_patches(lambda patches: [*patches, patches[0]]), "4 boundary faces belong to more than one"
    ),
    "a patch beside the mesh": (
        of_patches(beside), "4 of the 4 faces of patch floor are not on the boundary"
    ),
    "a face of three cells": (of_cells(12, np.tile(CUBE_CELLS, (3, 1))), "three or more cells"),
    "an open cell": (lambda: build_mesh(polyhedra(CUBE, [CUBE_FACES[:5]])), "1 cells are not closed"),
    "too few points": (
        of_cells(12, CUBE_CELLS[:, :7]), "cell 0 has 7 points, but its type is hexahedron"
    ),
    "a point beyond the mesh": (
        lambda: build_mesh(polyhedra(CUBE[:7], [CUBE_FACES])),
        "a cell names point 7, but there are 7 points",
    ),
    "faces that are not there": (of_other_faces, "the faces of the polyhedra do not fit its cells"),
    "cells of type 41": (of_cells(41, CUBE_CELLS), "cells of VTK type 41; allowed are tetrahedron"),
    "cells of type 9": (of_cells(9, CUBE_CELLS[:, :4]), "cells of VTK type 9; allowed are tetrahedron"),
}  # fmt: skip


@pytest.mark.parametrize("mesh", REFUSED)
def test_what_is_no_mesh_is_refused(mesh):
    make, message = REFUSED[mesh]
    with pytest.raises(InputError, match=message):
        make()


def test_a_hexahedron_with_repeated_points_is_what_its_points_make(random):
    """Two prisms, or six pyramids about a point, in place of hexahedra."""
    shape = block(2, 0.2)
    points, hexes = np.asarray(shape.points), shape.cells.reshape(-1, 9)[:, 1:]
    halves = [hexes[:, [0, 1, 2, 2, 4, 5, 6, 6]], hexes[:, [0, 2, 3, 3, 4, 6, 7, 7]]]
    mesh = build_mesh(grid(points, [(12, half) for half in halves]))
    assert mesh.volumes.sum() == pytest.approx(1.0)
    assert np.array_equal(np.bincount(mesh.owner) + np.bincount(mesh.neighbour, minlength=16), np.full(16, 5))
    centres = len(points) + np.arange(len(hexes))
    pyramids = [np.column_stack([hexes[:, list(f)], *4 * [centres]]) for f in HEXAHEDRON_FACES]
    mesh = build_mesh(grid(np.concatenate([points, points[hexes].mean(axis=1)]), [(12, p) for p in pyramids]))
    assert mesh.volumes.sum() == pytest.approx(1.0)
    assert mesh.volumes.min() > 0.0


def test_voxels_and_cells_of_higher_order_have_the_volume_of_their_corners():
    shape = block(2, 0.0)
    points, hexes = np.asarray(shape.points), shape.cells.reshape(-1, 9)[:, 1:]
    mesh = build_mesh(grid(points, [(11, hexes[:, [0, 1, 3, 2, 4, 5, 7, 6]])]))
    assert mesh.volumes == pytest.approx(np.full(8, 0.125))
    edges = np.array(
        [(0, 1), (1, 2), (2, 3), (3, 0), (4, 5), (5, 6), (6, 7), (7, 4), (0, 4), (1, 5), (2, 6), (3, 7)]
    )
    middles = points[hexes[:, edges]].mean(axis=2).reshape(-1, 3)
    curved = np.column_stack([hexes, len(points) + np.arange(len(middles)).reshape(8, 12)])
    mesh = build_mesh(grid(np.concatenate([points, middles]), [(25, curved)]))
    assert mesh.volumes == pytest.approx(np.full(8, 0.125))
    assert np.isfinite(Reconstruction(mesh)(mesh.centres, mesh.boundary_centres)[1]).all()


def test_centres_of_faces_and_cells_without_size_stay_where_the_points_are():
    """Their areas and volumes are round-off, by which nothing can be weighed."""
    for seed in range(4):
        mesh = build_mesh(HARD["collapsed edges"](seed))
        low, high = mesh.points.min(axis=0), mesh.points.max(axis=0)
        assert np.all((low <= mesh.centres) & (mesh.centres <= high))
        assert np.sum(volumes(mesh)) == pytest.approx(np.sum(mesh.volumes), rel=0.05)


def test_cyclic_patches_without_faces_are_coupled_all_the_same():
    """As a part of a mesh may have them."""
    patches, nothing = [Patch("left", "cyclic", "right"), Patch("right", "cyclic", "left")], np.zeros((0, 3))
    named, couplings = couple(patches, np.zeros(3, dtype=np.int64), nothing, nothing, (), "mesh")
    assert list(named) == patches
    assert [(c.patch, c.other, len(c.faces)) for c in couplings] == [(0, 1, 0), (1, 0, 0)]
    assert all(np.array_equal(c.turn, np.eye(3)) and not c.shift.any() for c in couplings)


@pytest.mark.parametrize("corners", [4, 5, 6])
def test_a_face_is_cut_where_its_worst_tetrahedron_is_best(corners, random):
    """By volume over the cube of the root-mean-square edge, from any corner; of a quadrangle, two count."""
    start, owner, nobody = np.array([0, corners]), np.array([0]), np.zeros(0, dtype=np.int64)
    angle = 2.0 * np.pi * np.arange(corners) / corners
    chosen = set()
    for _ in range(40):
        points = np.stack([np.cos(angle), np.sin(angle), 0.0 * angle], axis=1)
        points += 0.35 * random.uniform(-1.0, 1.0, (corners, 3))
        centre = np.array([[0.0, 0.0, -1.0]]) + 0.3 * random.uniform(-1.0, 1.0, 3)
        worst = []
        for base in range(2 if corners == 4 else corners):
            ring = np.roll(points, -base, axis=0)
            tets = [np.array([centre[0], ring[0], ring[k], ring[k + 1]]) for k in range(1, corners - 1)]
            edges = [[t[i] - t[j] for i in range(4) for j in range(i)] for t in tets]
            mean = np.sqrt(np.mean(np.sum(np.square(edges), axis=2), axis=1))
            worst.append(min(np.array([np.linalg.det(t[1:] - t[0]) for t in tets]) / mean**3))
        lists = np.arange(corners)
        inverted = choose_bases(points, centre, start, lists, owner, nobody)
        assert lists.tolist() == np.roll(np.arange(corners), -lists[0]).tolist()
        # Two fans may have the same tetrahedron as their worst.
        assert worst[lists[0]] > max(worst) - 1e-7
        assert (inverted > 0) == (max(worst) <= 0.0)
        chosen.add(int(lists[0]))
    assert len(chosen) > 1


@pytest.mark.parametrize("cells", [[0, 64], [-1, 0]])
def test_a_zone_has_no_cells_but_those_of_the_mesh(cells):
    mesh = build_mesh(block(4, 0.0))
    nothing = np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    flow = MeshFlow(mesh, *nothing, zones=lambda: {"all": np.arange(64), "other": np.array(cells)})
    assert flow.cell_zone("all").volumes.sum() == pytest.approx(1.0)
    with pytest.raises(InputError, match=r"cellZone other names cells beyond the mesh's 64\."):
        flow.cell_zone("other")
