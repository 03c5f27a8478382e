"""Parts of a mesh, on which nodes compute what one process computes on the whole, bit by bit."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import (
    block,
    box_patches,
    folds_at_a_gap,
    pipe,
    pipe_patches,
)
from thread_mpi import on_nodes

from foamprb.compile.link import link
from foamprb.distributed.fragment import CellSearch, Fragment, IndivisibleMeshError
from foamprb.distributed.partflow import PartFlow
from foamprb.distributed.parting import hold_part
from foamprb.distributed.submesh import RINGS, Halo, layers_over
from foamprb.flow import balance
from foamprb.flow import fluxes as fluxes_of_faces
from foamprb.flow.fluxes import Conservation
from foamprb.flow.mesh.boundary import PatchSurface, PolyMesh
from foamprb.flow.mesh.communicator import total_of
from foamprb.flow.mesh.geometry import faces_of
from foamprb.flow.mesh.mesh import assemble, build_mesh
from foamprb.flow.meshflow import LONG, MeshFlow
from foamprb.flow.planes import walls
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.walls import gap


def whole_of(poly):
    """All cells of a mesh as a fragment."""
    points, faces, *_ = poly
    neighbour = np.full(len(faces.owner), -1, dtype=np.int64)
    neighbour[: len(faces.neighbour)] = faces.neighbour
    return Fragment(
        np.arange(len(faces.first) - 1), np.arange(len(points)), points, np.arange(len(faces.owner)),
        faces.start.astype(np.intp), faces.points.astype(np.int64), faces.owner.astype(np.int64), neighbour,
    )  # fmt: skip


def poly_of(mesh):
    """Points, faces and patches of a mesh, as they are read from a case."""
    sides = mesh.owner.copy(), mesh.neighbour.copy()
    faces = faces_of(mesh.face_start, mesh.face_points.copy(), *sides, mesh.n_cells)
    patches = [PatchSurface(p.name, p.type, None, p.neighbour) for p in mesh.patches]
    return PolyMesh(mesh.points, faces, patches, mesh.patch_start.astype(np.intp))


def part_of(poly, cells, team, layers):
    """The sub-mesh of a node that owns some cells and does not know what lies beyond them."""
    return hold_part(
        lambda: CellSearch(whole_of(poly)).take(cells),
        *(poly.patches, poly.patch_start, len(poly.faces.neighbour), layers - RINGS, team, "mesh"),
    )


def gaps_at(arrays, points, hosts, R):
    """Gaps of balls, and the patches of the nearest walls."""
    identity = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)
    kernel, inside = link(gap, separate=LONG), np.flatnonzero(hosts >= 0)
    found = [kernel(arrays, hosts[k], tuple(points[k]), identity, R)[:2] for k in inside]
    gaps = np.full((len(points), 2), np.nan)
    gaps[inside] = found
    return gaps


def planes_at(arrays, points, hosts, cut):
    """Walls around points as planes, (n, 12)."""
    kernel, chosen = link(walls, separate=LONG), np.ones(arrays.triangle_patch.max() + 1, dtype=np.int8)
    found = [kernel(arrays, h, tuple(x), cut, chosen) for x, h in zip(points, hosts, strict=True)]
    return np.array([[p.h1, *p.n1, p.h2, *p.n2, p.h3, *p.n3] for p in found])


SHAPES = {
    "pipe": lambda: build_mesh(shape := pipe(6, axial=12), pipe_patches(shape)),
    "polyhedra": lambda: build_mesh(shape := block(8, kind="polyhedra"), box_patches(shape)),
    "tetrahedra": lambda: build_mesh(shape := block(6, kind="tetrahedra"), box_patches(shape)),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_nodes_compute_the_flow_of_the_whole(shape, random, monkeypatch):
    monkeypatch.setattr(balance, "_LEAST_SEGMENT", 30)
    # The flow ends at walls.
    monkeypatch.setattr(fluxes_of_faces, "_LARGEST_CHANGE", 10.0)
    poly = poly_of(SHAPES[shape]())
    mesh = assemble(poly, "mesh")
    x, y, z = mesh.centres.T
    cells = np.stack([np.sin(3 * y) + x * z, np.cos(2 * x) * z, y * y - x], axis=1)
    boundary = np.where(mesh.boundary_areas[:, :1] > 0.0, 0.1 * mesh.boundary_centres, 0.0)
    u, l = Reconstruction(mesh)(cells, boundary)
    positive = np.exp(cells), np.exp(boundary)
    scalars, linear = Reconstruction(mesh).scalars(*positive)[0], Reconstruction(mesh).linear(*positive)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l))
    points = np.concatenate([mesh.points[::7], random.uniform(*flow.bounds, (300, 3))])
    hosts = flow.locate(points)
    near = [k for k, patch in enumerate(mesh.patches) if patch.type == "wall"]
    reach = 0.1 * float(np.ptp(mesh.points, axis=0).max())
    lists = reach, near, 2.0 * reach, near
    gaps = gaps_at(flow.arrays(*lists), points, hosts, 0.1 * reach)
    planes = planes_at(flow.arrays(*lists), points[hosts >= 0], hosts[hosts >= 0], 2.0 * reach)
    assert np.isfinite(planes[:, 0]).any()
    place = np.cumsum(hosts >= 0) - 1
    # Slices, with a cell of another node in one of them.
    along = x + 0.3 * y + 0.1 * z
    parts = np.clip((3 * (along - along.min()) / np.ptp(along)).astype(int), 0, 2)
    parts[random.integers(mesh.n_cells)] = 0

    def work(team):
        sub = part_of(poly, parts == team.rank, team, layers=2 + RINGS)
        halo = Halo(sub, team)
        own_cells = np.where(sub.owned[:, None], cells[sub.cells], np.nan)
        halo.fill("cells", own_cells)
        faces = sub.faces[sub.mesh.n_internal :][: sub.mesh.patch_start[-2]] - sub.n_internal
        on_faces = np.zeros((len(sub.mesh.boundary_centres), 3))
        on_faces[: len(faces)] = boundary[faces]
        reconstruct = Reconstruction(sub.mesh, comm=halo)
        u, l = reconstruct(own_cells, on_faces)
        at_points = reconstruct.scalars(np.exp(own_cells), np.exp(on_faces))[0]
        also = reconstruct.linear(np.exp(own_cells), np.exp(on_faces))
        part = PartFlow(halo, sub.mesh, u, l, fluxes=Conservation(sub.mesh, comm=halo)(u, l))
        assert part.width == flow.width
        # Walls within sight alone, without those beside them.
        part._hold_walls(2.0 * reach)
        arrays = part.arrays(*lists)
        found, numbers, _ = part.locate_own(points)
        owned, local = part.own_hosts(numbers)
        np.testing.assert_array_equal(owned, np.arange(len(found)))
        np.testing.assert_array_equal(gaps_at(arrays, points[found], local, 0.1 * reach), gaps[found])
        there = planes_at(arrays, points[found], local, 2.0 * reach)
        np.testing.assert_array_equal(there, planes[place[found]])
        sampled = part.sample(points[found], local, 0.0)[0]
        np.testing.assert_array_equal(sampled, flow.sample(points[found], hosts[found], 0.0)[0])
        return sub, (u, l, at_points, also), part, found, numbers

    results = on_nodes(3, work)
    located = np.concatenate([found for *_, found, _ in results])
    np.testing.assert_array_equal(np.sort(located), np.flatnonzero(hosts >= 0))
    np.testing.assert_array_equal(np.concatenate([numbers for *_, numbers in results]), hosts[located])
    for sub, parts_of, part, _, _ in results:
        n, inner = sub.mesh.n_points, sub.layer <= 2
        nodes = np.concatenate([sub.points, mesh.n_points + sub.cells])
        of_inner = sub.mesh.cell_points[np.repeat(inner, np.diff(sub.mesh.cell_point_start))]
        some = np.concatenate([np.unique(of_inner), n + np.flatnonzero(inner)])
        np.testing.assert_array_equal(sub.mesh.nodes[some], mesh.nodes[nodes][some])
        for owned, whole in zip(parts_of, (u, l, scalars, linear), strict=True):
            np.testing.assert_array_equal(owned[some], whole[nodes][some])
        tets = np.concatenate([np.arange(*mesh.cell_start[c : c + 2]) for c in sub.cells[inner]])
        owned = np.concatenate([np.arange(*sub.mesh.cell_start[c : c + 2]) for c in np.flatnonzero(inner)])
        np.testing.assert_array_equal(nodes[sub.mesh.tets[owned]], mesh.tets[tets])
        middles = sub.mesh.nodes[sub.mesh.tets[owned]].mean(axis=1)
        there, expected = part.sample(middles, owned, 0.0)[0], flow.sample(middles, tets, 0.0)[0]
        np.testing.assert_array_equal(there, expected)


def test_a_path_out_of_the_layers_of_a_node_is_noted():
    """In a row of cells of two nodes, of which the first has one layer of the second."""
    poly = poly_of(build_mesh(shape := pipe(2, axial=12), pipe_patches(shape)))
    mesh = assemble(poly, "mesh")

    def work(team):
        sub = part_of(poly, (mesh.centres[:, 0] > 0.5) == team.rank, team, layers=1 + RINGS)
        u = np.zeros((sub.mesh.n_points + sub.mesh.n_cells, 3))
        return PartFlow(Halo(sub, team), sub.mesh, u, np.zeros((len(u), 3, 3)))

    flow, _ = on_nodes(2, work)
    arrays = flow.arrays()
    host, start = flow.locate(np.array([[0.48, 0.01, 0.02]]))[0], (0.48, 0.01, 0.02)
    for end, patch, strayed in ((0.57, -1, 0), (0.1, -1, 0), (-0.1, 0, 0), (0.6, -2, 1)):
        assert flow.kernels["walk"](arrays, host, start, (end, 0.01, 0.02))[2] == patch
        assert arrays.strayed[0] == strayed


def test_nodes_hold_the_whole_mesh_if_bodies_pass_more_cells_than_there_are():
    """The first node has a slice of a pipe, and all others around it, to the last of 299 layers."""
    poly = poly_of(build_mesh(shape := pipe(2, axial=300), pipe_patches(shape)))
    mesh = assemble(poly, "mesh")
    layers = layers_over(np.inf)
    parts = on_nodes(2, lambda team: part_of(poly, (mesh.centres[:, 0] > 1 / 300) == team.rank, team, layers))
    np.testing.assert_array_equal(parts[0].layer, np.rint(300.0 * mesh.centres[:, 0] - 0.5))
    assert [part.usable.all() for part in parts] == [True, True]


def test_a_node_holds_the_walls_near_its_cells(random):
    """More of them when bodies reach farther, for which gaps are those of the whole mesh."""
    poly = poly_of(build_mesh(shape := pipe(2, axial=24), pipe_patches(shape)))
    mesh = assemble(poly, "mesh")
    points = random.uniform(0.05, 0.15, (20, 3)) * [1.0, 0.1, 0.1]

    def work(team):
        sub = part_of(poly, (mesh.centres[:, 0] > 0.5) == team.rank, team, layers=1 + RINGS)
        u = np.zeros((sub.mesh.n_points + sub.mesh.n_cells, 3))
        flow = PartFlow(Halo(sub, team), sub.mesh, u, np.zeros((len(u), 3, 3)))
        ends = []
        for reach in (0.01, 0.3):
            arrays = flow.arrays(reach, [0])
            ends.append(arrays.nodes[len(u) :, 0].max())
        return flow, ends

    flow, ends = on_nodes(2, work)[0]
    assert ends[0] < 0.9 < ends[1] == 1.0
    u = np.zeros((len(mesh.nodes), 3))
    whole = MeshFlow(mesh, u, np.zeros((len(u), 3, 3)))
    found, expected = (gaps_at(f.arrays(0.3, [0]), points, f.locate(points), 0.05) for f in (flow, whole))
    np.testing.assert_array_equal(found, expected)


def with_baffle(poly):
    """Give the last boundary face the points of the first one."""
    faces, n = poly.faces, len(poly.faces.neighbour)
    first, last = (slice(*faces.start[k : k + 2]) for k in (n, len(faces.start) - 2))
    faces.points[last] = faces.points[first][::-1]
    return poly


@pytest.mark.parametrize(
    ("poly", "reason"),
    [
        (with_baffle(poly_of(build_mesh(shape := block(4), box_patches(shape)))), "baffles"),
        (poly_of(folds_at_a_gap(6)), "folded cells"),
    ],
)
def test_all_nodes_refuse_meshes_that_they_cannot_share(poly, reason):
    """Also those whose own cells have neither baffles nor folds."""
    x = assemble(poly, "mesh").centres[:, 0] if reason == "folded cells" else np.arange(4**3)

    def work(team):
        owned = (x > np.median(x)) == team.rank
        with pytest.raises(IndivisibleMeshError, match=reason):
            part_of(poly, owned, team, layers=1 + RINGS)
        return True

    assert on_nodes(2, work) == [True, True]


def test_sums_depend_on_no_order(random):
    values = random.random(1000) ** 8
    parts = np.split(random.permutation(values), [10, 500])
    alone = total_of(values)
    assert alone == pytest.approx(values.sum(), rel=1e-12)
    sums = on_nodes(3, lambda team: total_of(parts[team.rank], lambda v: team.exchange([v] * 3)))
    assert sums == [alone] * 3
