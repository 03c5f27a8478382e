"""The correction of the velocity that keeps the volume of the fluid."""

from __future__ import annotations

import os
import re
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from mesh_shapes import (
    KINDS,
    block,
    box_patches,
    cyclic_row,
    joined_boxes,
    pipe,
    pipe_patches,
    wedge,
    wedge_patches,
)
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import balance
from foamprb.flow.balance import BALANCED, Mass
from foamprb.flow.fluxes import Conservation, UnbalancedFlowError, free_nodes
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow
from foamprb.settings.patches import patch_interactions

SIDES = ((1, 2, 3), (0, 3, 2), (0, 1, 3), (0, 2, 1))


def closed(kind="polyhedra", n=4, perturbation=0.3, seed=0):
    """A box whose boundary is all wall."""
    return build_mesh(block(n, perturbation, kind, seed))


def whirl(x):
    """The curl of (0, 0, s(x) s(y) s(z)) with s = sin² πx: at rest on the walls of the unit box."""
    s, ds = np.sin(np.pi * x) ** 2, np.pi * np.sin(2.0 * np.pi * x)
    u = np.zeros_like(x)
    u[:, 0], u[:, 1] = s[:, 0] * ds[:, 1] * s[:, 2], -ds[:, 0] * s[:, 1] * s[:, 2]
    return u


def whirling(mesh, **options):
    """The whirl on a mesh, with its correction."""
    u, l = Reconstruction(mesh)(whirl(mesh.centres), np.zeros_like(mesh.boundary_centres))
    return MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l, **options))


def sampled(flow, w):
    """Return the velocity at weights w (m, 4) in each tetrahedron, (n_tets, m, 3)."""
    x = np.einsum("mv,nvi->nmi", w, flow.mesh.nodes[flow.mesh.tets])
    hosts = np.repeat(np.arange(len(x), dtype=np.int32), len(w))
    return flow.sample(x.reshape(-1, 3), hosts, 0.0)[0].reshape(x.shape)


def outward(flow):
    """Return the fluxes out of each tetrahedron at the edges of its sides, (n_tets, 4, 3), m³/s.

    The mean of a quadratic velocity over a triangle is that at the middles of its edges.
    """
    x, found = flow.mesh.nodes[flow.mesh.tets], np.empty((len(flow.mesh.tets), 4, 3))
    for k, (a, b, c) in enumerate(SIDES):
        area = 0.5 * np.cross(x[:, b] - x[:, a], x[:, c] - x[:, a])
        middles = 0.5 * (np.eye(4)[[a, b, c]] + np.eye(4)[[b, c, a]])
        found[:, k] = np.einsum("nvi,ni->nv", sampled(flow, middles), area)
    return found


@given(st.sampled_from(KINDS), st.floats(0.0, 0.4), st.integers(0, 100))
@settings(max_examples=20)
def test_no_tetrahedron_makes_or_loses_fluid(kind, perturbation, seed):
    flow = whirling(closed(kind, 2, perturbation, seed))
    fluxes = outward(flow).mean(axis=2)
    size = np.abs(fluxes).max()
    assert fluxes.sum(axis=1) == pytest.approx(0.0, abs=3e-6 * size)
    plain = outward(MeshFlow(flow.mesh, *flow.at_nodes()[1:])).mean(axis=2).sum(axis=1)
    assert np.abs(plain).max() > 1e-2 * size


def test_the_velocity_makes_no_volume_at_any_point(random):
    flow = whirling(closed())
    mesh = flow.mesh
    hosts = random.integers(len(mesh.tets), size=300).astype(np.int32)
    corners = mesh.nodes[mesh.tets[hosts]]
    x, h = np.einsum("nk,nki->ni", random.dirichlet(np.ones(4), 300), corners), 1e-3
    # Differences of a quadratic velocity are exact, outside the tetrahedron, too.
    made = sum(
        (flow.sample(x + h * e, hosts, 0.0)[0] - flow.sample(x - h * e, hosts, 0.0)[0])[:, i] / (2.0 * h)
        for i, e in enumerate(np.eye(3))
    )
    assert made == pytest.approx(0.0, abs=1e-5 * np.abs(flow.at_nodes()[2]).max())


def test_a_mean_flow_that_only_the_fluxes_have_is_uniform(random):
    """At nodes off walls the fluid is at rest, and the fluxes are those of a uniform flow."""
    cube, U = block(3, 0.3, "tetrahedra"), np.array([0.3, -0.2, 0.5])
    patches = [surface._replace(type="patch") for surface in box_patches(cube)]
    mesh = build_mesh(cube, patches)
    n = len(mesh.nodes)
    start = mesh.face_start
    fluxes = np.empty(len(mesh.owner))
    for f in range(len(fluxes)):
        x = mesh.points[mesh.face_points[start[f] : start[f + 1]]]
        fluxes[f] = 0.5 * np.cross(x[1:-1] - x[0], x[2:] - x[0]).sum(axis=0) @ U
    flow = MeshFlow(mesh, np.zeros((n, 3)), np.zeros((n, 3, 3)), fluxes=fluxes)
    x = random.uniform(0.2, 0.8, (300, 3))
    u, _ = flow.sample(x, flow.locate(x), 0.0)
    np.testing.assert_allclose(u, np.broadcast_to(U, u.shape), atol=1e-5)


def edges(nodes, fluxes):
    """Fluxes at the edges of a triangle by their ends."""
    return {frozenset((nodes[k], nodes[(k + 1) % 3])): fluxes[k] for k in range(3)}


@pytest.mark.parametrize("kind", ["polyhedra", "tetrahedra", "mixed"])
def test_what_leaves_a_tetrahedron_enters_the_next_at_every_point(kind):
    flow = whirling(closed(kind))
    fluxes, neighbours, tets = outward(flow), flow.mesh.neighbours, flow.mesh.tets
    size, pairs = np.abs(fluxes).max(), 0
    for t in range(0, len(tets), 7):
        for k in range(4):
            other = neighbours[t, k]
            if other < 0:
                continue
            side = int(np.flatnonzero(neighbours[other] == t)[0])
            mine, theirs = (edges(tets[i, SIDES[j]], fluxes[i, j]) for i, j in ((t, k), (other, side)))
            assert mine.keys() == theirs.keys()
            for edge, flux in mine.items():
                assert flux == pytest.approx(-theirs[edge], abs=1e-6 * size)
            pairs += 1
    assert pairs > 300


def test_walls_keep_their_velocity_and_let_nothing_through(random):
    """In simple cells the correction is along walls."""
    flow = whirling(closed("mixed"))
    mesh = flow.mesh
    corners = mesh.points[mesh.triangles]
    x = np.einsum("nk,nki->ni", random.dirichlet(np.ones(3), len(corners)), corners)
    u = flow.sample(x, mesh.triangle_tet, 0.0)[0]
    simple = np.any(free_nodes(mesh)[mesh.triangles] < 0.0, axis=1)
    assert 0 < simple.sum() < len(simple)
    assert np.abs(u[~simple]).max() < 1e-14
    through = np.einsum("ni,ni->n", u, mesh.triangle_normals)
    # The correction is stored in single precision.
    assert np.abs(through).max() < 1e-6 * np.abs(u).max()


def test_beside_a_wall_the_flow_is_parallel_to_it():
    flow = whirling(closed())
    u = sampled(flow, np.array([[1.0, 0.0, 0.0, 0.0], [0.2, 0.5, 0.2, 0.1]]))[flow.mesh.triangle_tet]
    through = np.einsum("nmi,ni->nm", u, flow.mesh.triangle_normals)
    assert through == pytest.approx(0.0, abs=1e-5 * np.abs(u).max())


def test_a_linear_solenoidal_flow_needs_no_correction():
    shape = block(3, 0.3)
    mesh = build_mesh(shape, box_patches(shape))
    gradient = np.array([[1.0, 2.0, -1.0], [0.5, -3.0, 1.0], [2.0, 0.0, 2.0]])
    u, l = mesh.nodes @ gradient.T, np.broadcast_to(gradient, (len(mesh.nodes), 3, 3))
    flow, hosts = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l)), np.arange(len(mesh.tets))
    flow.sample(mesh.nodes[mesh.tets].mean(axis=1), hosts, 0.0)
    assert flow.arrays().correction == pytest.approx(0.0, abs=1e-5)


def test_fluxes_change_where_the_mesh_does_not_resolve_the_flow():
    """What the walls of a pipe hold back of a plug flow does not slow it down in the middle."""
    shape = pipe(6)
    mesh = build_mesh(shape, pipe_patches(shape))
    plug, still = np.array([1.0, 0.0, 0.0]), np.zeros((len(mesh.boundary_centres), 3))
    boundary = still.copy()
    boundary[: mesh.patch_start[2]] = plug
    u, l = Reconstruction(mesh)(np.tile(plug, (mesh.n_cells, 1)), boundary)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l))
    length = mesh.points[:, 0].max()
    x = np.column_stack([np.linspace(0.1, 0.9, 9) * length, np.zeros((9, 2))])
    assert flow.sample(x, flow.locate(x), 0.0)[0] == pytest.approx(np.tile(plug, (9, 1)), abs=1e-2)


@pytest.mark.parametrize("kind", ["tetrahedra", "polyhedra"])
def test_nothing_flows_through_walls_that_slide(kind):
    """The velocity (x, 0, 0) makes volume everywhere and crosses a wall."""
    mesh = closed(kind)
    x = np.concatenate([mesh.points, mesh.centres])
    u, l = x * [1.0, 0.0, 0.0], np.zeros((len(x), 3, 3))
    l[:, 0, 0] = 1.0
    for sliding in (False, True):
        fluxes = outward(MeshFlow(mesh, u, l, fluxes=Conservation(mesh, sliding)(u, l))).mean(axis=2)
        through, size = np.abs(fluxes[mesh.triangle_tet, 0]).max(), np.abs(fluxes).max()
        assert through < 1e-6 * size if sliding else through > 0.1 * size
    # The iteration ends at a root mean square of BALANCED.
    assert np.abs(fluxes.sum(axis=1)).max() < 10.0 * BALANCED * size


def test_where_the_density_is_unknown_cells_keep_their_divergence():
    shape = block(3, 0.2)
    mesh = build_mesh(shape, [p._replace(type="patch") for p in box_patches(shape)])
    nodes = mesh.nodes
    u, l = nodes**2, 2.0 * nodes[:, :, None] * np.eye(3)
    plain = outward(MeshFlow(mesh, u, l)).mean(axis=2).sum(axis=1)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l, None))
    net = outward(flow).mean(axis=2).sum(axis=1)
    cells = mesh.tets[:, 0] - mesh.n_points
    volumes = np.abs(np.linalg.det(nodes[mesh.tets[:, 1:]] - nodes[mesh.tets[:, :1]])) / 6.0
    of_cells = np.bincount(cells, net) / np.bincount(cells, volumes)
    assert net == pytest.approx(of_cells[cells] * volumes, abs=1e-6 * np.abs(plain).max())
    # The divergence is 2 (x + y + z).
    assert of_cells == pytest.approx(2.0 * mesh.centres.sum(axis=1), rel=0.05)


def test_where_the_density_varies_cells_keep_mass():
    """A stream that expands: ∂ρ/∂t = −∇·(ρu) = 0.1 with ρ = 1/(1 + x) and u = (1 + x)(1 − 0.1 x)."""
    shape = block(4, 0.2)
    mesh = build_mesh(shape, [p._replace(type="patch") for p in box_patches(shape)])
    x = mesh.nodes[:, 0]
    u, l = np.zeros((len(x), 3)), np.zeros((len(x), 3, 3))
    u[:, 0], l[:, 0, 0] = (1.0 + x) * (1.0 - 0.1 * x), 0.9 - 0.2 * x
    inside, outside = (1.0 / (1.0 + at[:, 0]) for at in (mesh.centres, mesh.boundary_centres))
    flow = MeshFlow(
        mesh, u, l, fluxes=Conservation(mesh)(u, l, Mass(inside, outside, np.full(mesh.n_cells, 0.1)))
    )
    # Side 0 of a tetrahedron lies on a face of its cell.
    fluxes, cell = outward(flow).mean(axis=2)[:, 0], mesh.tets[:, 0] - mesh.n_points
    beside, face = mesh.neighbours[:, 0], mesh.triangle_face
    inner = beside >= 0
    density = np.empty(len(fluxes))
    density[inner] = 0.5 * (inside[cell[inner]] + inside[cell[beside[inner]]])
    density[~inner] = outside[face[-1 - beside[~inner]]]
    lost = np.bincount(cell, density * fluxes)
    assert lost == pytest.approx(-0.1 * mesh.volumes, abs=1e-4 / 16)
    assert np.bincount(cell, fluxes) / mesh.volumes == pytest.approx(0.9 - 0.2 * mesh.centres[:, 0], rel=0.1)


def test_mass_that_leaves_through_a_coupled_face_enters_through_its_neighbour(random):
    mesh = joined_boxes([4, 4], [("cyclic", 0, 0, 1), ("cyclic", 0, 1, 0)])
    cells = whirl(mesh.centres % 3.0) + np.prod(np.sin(np.pi * mesh.centres[:, 1:]), axis=1)[:, None] * [
        1,
        0,
        0,
    ]
    u, l = Reconstruction(mesh)(cells, np.zeros_like(mesh.boundary_centres))
    inside, n = random.uniform(1.0, 1.2, mesh.n_cells), len(mesh.boundary_centres)
    mass = Mass(inside, np.ones(n), np.zeros(mesh.n_cells))
    fluxes = outward(MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l, mass))).mean(axis=2)[:, 0]
    beyond = mesh.owner[mesh.n_internal :].copy()
    for coupling in mesh.couplings:
        beyond[coupling.faces] = mesh.owner[mesh.n_internal + coupling.partners]
    cell, beside = mesh.tets[:, 0] - mesh.n_points, mesh.neighbours[:, 0]
    other = np.where(beside >= 0, cell[beside], beyond[mesh.triangle_face[np.maximum(-1 - beside, 0)]])
    lost = np.bincount(cell, 0.5 * (inside[cell] + inside[other]) * fluxes)
    assert lost == pytest.approx(0.0, abs=1e-4 * np.abs(fluxes).max())


def test_a_gas_at_rest_that_is_pumped_up_flows():
    """Before its first step a solver has U = 0, and the density of the next time is another one."""
    shape = block(6, 0.2)
    patches = box_patches(shape)
    mesh = build_mesh(shape, [patches[0]._replace(type="patch"), *patches[1:]])
    u, l = np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    ones = np.ones(mesh.n_cells), np.ones(len(mesh.boundary_centres)), np.full(mesh.n_cells, 0.1)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l, Mass(*ones)))
    inflow = outward(flow).mean(axis=2)[mesh.triangle_tet, 0].sum()
    assert inflow == pytest.approx(-0.1 * mesh.volumes.sum(), rel=1e-5)


_HASH = """
import hashlib
import numpy as np
from test_fluxes import Conservation, Reconstruction, closed, whirl
mesh = closed("hexahedra", 22)
u, l = Reconstruction(mesh)(whirl(mesh.centres), np.zeros_like(mesh.boundary_centres))
print(hashlib.sha256(Conservation(mesh)(u, l).tobytes()).hexdigest())
"""


def test_bits_do_not_depend_on_the_threads_of_blas():
    found = set()
    for threads in "1", "2":
        path = os.pathsep.join([*sys.path, str(Path(__file__).parent)])
        env = os.environ | {"OPENBLAS_NUM_THREADS": threads, "PYTHONPATH": path}
        done = subprocess.run(
            [sys.executable, "-c", _HASH], env=env, capture_output=True, text=True, check=True
        )
        found.add(done.stdout)
    assert len(found) == 1


def refusal(mesh, cells):
    """Return iterations, correction and remainder in the message for velocities between walls at rest."""
    u, l = Reconstruction(mesh)(cells, np.zeros_like(mesh.boundary_centres))
    with pytest.raises(UnbalancedFlowError, match=r"^the fluxes of 1/U cannot be balanced") as error:
        Conservation(mesh)(u, l, where="1/U")
    pattern = r"after (\d+) iterations .* is (\S+) times the flow, .* lose (\S+) times"
    return map(float, re.search(pattern, str(error.value)).groups())


def test_a_correction_that_is_no_solution_is_refused(monkeypatch):
    monkeypatch.setattr(balance, "MOST_ITERATIONS", 1)
    iterations, _, left = refusal(mesh := closed(n=6), whirl(mesh.centres))
    assert iterations == 1
    assert left > 1e-4


def test_a_correction_that_is_larger_than_the_flow_is_refused():
    """Of a stream that ends at walls."""
    mesh = closed("hexahedra", 8)
    _, change, left = refusal(mesh, np.tile([1.0, 0.0, 0.0], (mesh.n_cells, 1)))
    assert 1.0 < change < 1.2
    assert left <= 1e-4


@st.composite
def networks(draw):
    """Cuts of cubes, joints between sides that face each other, and openings."""
    cuts = draw(st.lists(st.integers(3, 5), min_size=1, max_size=4))
    joints, taken = [], set()
    for axis in range(3):
        others = draw(st.permutations(range(len(cuts))))
        for one, other in enumerate(others):
            if draw(st.booleans()):
                alike = ["cyclic"] if cuts[one] == cuts[other] else []
                kind = draw(st.sampled_from(["cyclicAMI", "nonConformalCyclic", *alike]))
                joints.append((kind, axis, one, other))
                taken |= {f"cube{one}upper{axis}", f"cube{other}lower{axis}"}
    sides = {f"cube{i}{end}{k}" for i in range(len(cuts)) for end in ("lower", "upper") for k in range(3)}
    openings = draw(st.sets(st.sampled_from(sorted(sides - taken)), max_size=2)) if sides - taken else ()
    return cuts, joints, openings


@given(networks(), st.integers(0, 100))
@settings(max_examples=25)
def test_pieces_between_coupled_patches_keep_volume(network, seed):
    """Where walls push fluid into a closed piece, its cells have the same divergence."""
    cuts, joints, openings = network
    mesh, random = joined_boxes(*network), np.random.default_rng(seed)
    cells = whirl(mesh.centres % 3.0) + random.normal(0.0, 0.3, (mesh.n_cells, 3))
    u, l = Reconstruction(mesh)(cells, random.normal(0.0, 0.1, (len(mesh.boundary_centres), 3)))
    plain, flow = MeshFlow(mesh, u, l), MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l))
    fluxes, faces = outward(flow).mean(axis=2), mesh.triangle_face
    size = np.sqrt(np.mean(fluxes**2))
    before, after = (np.bincount(faces, outward(f).mean(axis=2)[mesh.triangle_tet, 0]) for f in (plain, flow))
    walls = np.repeat([patch.type == "wall" for patch in mesh.patches], np.diff(mesh.patch_start))
    assert after[walls] == pytest.approx(before[walls], abs=1e-5 * size)
    patches = np.add.reduceat(after, mesh.patch_start[:-1])
    for coupling in mesh.couplings:
        assert patches[coupling.patch] == pytest.approx(-patches[coupling.other], abs=1e-5 * size)
        if coupling.matching:
            here, there = after[coupling.faces], after[coupling.partners]
            assert here == pytest.approx(-there, abs=1e-5 * size)
    ends = np.array([joint[2:] for joint in joints], dtype=int).reshape(-1, 2).T
    graph = coo_array((np.ones(len(joints)), tuple(ends)), shape=(len(cuts), len(cuts)))
    piece = connected_components(graph, directed=False)[1]
    of_cells = piece[(mesh.centres[:, 0] / 3.0).astype(int)]
    pushed = np.bincount(of_cells[mesh.owner[mesh.n_internal :]], walls * after, len(cuts))
    pushed[[piece[int(opening[4])] for opening in openings]] = 0.0
    corners, cell = mesh.nodes[mesh.tets], mesh.tets[:, 0] - mesh.n_points
    volumes = np.abs(np.linalg.det(corners[:, 1:] - corners[:, :1]))
    made = mesh.volumes * pushed[of_cells] / np.bincount(piece)[of_cells]
    made = volumes * (made / np.bincount(cell, volumes))[cell]
    assert np.sqrt(np.mean((fluxes.sum(axis=1) - made) ** 2)) < 3e-5 * size


@pytest.mark.parametrize("corrected", [True, False])
def test_followers_cross_unequal_faces_and_come_to_no_wall(corrected):
    """A whirl about the joint of two closed cubes."""
    mesh = joined_boxes([5, 4], [("cyclicAMI", 0, 0, 1)], perturbation=0.0)
    second = mesh.centres[:, :1] > 2.0
    x = (mesh.centres - np.hstack([2.0 * second, 0.0 * second, 0.0 * second])) / [2.0, 1.0, 1.0]
    u, l = Reconstruction(mesh)(whirl(x) / [1.0, 2.0, 1.0], np.zeros_like(mesh.boundary_centres))
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l) if corrected else None)
    starts = np.random.default_rng(7).uniform(0.0, 1.0, (400, 3))
    bodies = spheres(starts, d=1e-9, rho=1.0, mu=1e3)
    still = Medium(1e-3, 1.0, (0.0, 0.0, 0.0))
    cloud = Cloud(bodies, flow, still, patch_interactions(flow, Stick()), 0.05, Models("roscoe"))
    cloud.advance(400)
    active = cloud.particles.status == Status.ACTIVE
    across = cloud.particles.x[active, 0] > 2.0
    if corrected:
        assert active.all()
        assert np.mean(across) == pytest.approx(0.5, abs=0.1)
    else:
        assert np.count_nonzero(~active) > 10


@pytest.mark.parametrize("kind", ["patch", "wall"])
def test_a_flow_from_rest_is_taken(kind):
    """An inlet, or a piston, which drives a flow that is larger than the interpolated one."""
    shape = pipe(4, axial=12)
    patches = [p._replace(type=kind) if p.name == "inlet" else p for p in pipe_patches(shape)]
    mesh = build_mesh(shape, patches)
    inlet = next(k for k, patch in enumerate(mesh.patches) if patch.name == "inlet")
    boundary = np.zeros_like(mesh.boundary_centres)
    boundary[slice(*mesh.patch_start[inlet : inlet + 2]), 0] = 1.0
    fluxes = Conservation(mesh)(*Reconstruction(mesh)(np.zeros_like(mesh.centres), boundary))
    out = np.bincount(mesh.owner, fluxes, mesh.n_cells)
    out -= np.bincount(mesh.neighbour, fluxes[: mesh.n_internal], mesh.n_cells)
    assert np.linalg.norm(out) < 1e-3 * np.linalg.norm(fluxes)


@pytest.mark.parametrize("shape", ["cyclic", "wedge"])
def test_what_leaves_through_a_coupled_patch_enters_through_its_neighbour(shape):
    if shape == "cyclic":
        mesh = cyclic_row(0.0, 2)
        u, l = mesh.nodes**2 + 1.0, np.zeros((len(mesh.nodes), 3, 3))
    else:
        row = wedge(4)
        mesh = build_mesh(row, wedge_patches(row))
        u, l = Reconstruction(mesh)(mesh.centres**2 + 1.0, mesh.boundary_centres**2 + 1.0)
    flow = MeshFlow(mesh, u, l, fluxes=Conservation(mesh)(u, l))
    found, mesh = outward(flow).mean(axis=2), flow.mesh
    through = np.bincount(mesh.triangle_face, found[mesh.triangle_tet, 0])
    for coupling in mesh.couplings:
        here, there = through[coupling.faces], through[coupling.partners]
        assert here == pytest.approx(-there, abs=1e-6 * np.abs(through).max())


def test_free_nodes_are_those_off_the_walls():
    shape = pipe(3)
    mesh = build_mesh(shape, pipe_patches(shape))
    on_wall = np.hypot(mesh.points[:, 1], mesh.points[:, 2]) > 1.0 - 1e-9
    assert np.array_equal(free_nodes(mesh)[: mesh.n_points], np.where(on_wall, 0.0, 1.0))
    assert free_nodes(mesh)[mesh.n_points :].all()


def test_cells_are_corrected_where_velocities_are_sampled_in_any_order(random):
    mesh = closed(n=2)
    n = len(mesh.nodes)
    u, l = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3))
    phi = Conservation(mesh)(u, l)
    one, other = (MeshFlow(mesh, u, l, fluxes=phi) for _ in range(2))
    middles, hosts = mesh.nodes[mesh.tets].mean(axis=1), np.arange(len(mesh.tets))
    some = one.cell_of(hosts) == 3
    one.sample(middles[some], hosts[some], 0.0)
    assert np.array_equal(one.arrays().correction.all(axis=1), some)
    assert np.array_equal(one.arrays().correction.any(axis=1), some)
    backwards = other.sample(middles[::-1], hosts[::-1], 0.0)[0]
    assert np.array_equal(one.sample(middles, hosts, 0.0)[0], backwards[::-1])


def test_between_two_times_the_correction_is_linear(random):
    mesh = closed(n=2)
    n = len(mesh.nodes)
    fields = [(random.normal(size=(n, 3)), random.normal(size=(n, 3, 3))) for _ in range(2)]
    balanced = [Conservation(mesh)(*field) for field in fields]
    series = SeriesFlow(mesh, [0.0, 2.0], lambda k: (*fields[k], balanced[k]), conservative=True)
    x = random.uniform(0.1, 0.9, (50, 3))
    hosts = series.locate(x)
    u0, u1 = (
        MeshFlow(mesh, *field, fluxes=phi).sample(x, hosts, 0.0)[0]
        for field, phi in zip(fields, balanced, strict=True)
    )
    for t in (0.0, 0.5, 2.0):
        assert series.sample(x, hosts, t)[0] == pytest.approx(u0 + 0.5 * t * (u1 - u0), abs=1e-12)


@pytest.mark.parametrize(
    ("kind", "n", "corrected"), [("hexahedra", 5, True), ("tetrahedra", 3, True), ("hexahedra", 5, False)]
)
def test_a_uniform_seed_stays_uniform(kind, n, corrected):
    """χ² of the counts per cell is about their number, and followers of the fluid come to no wall.

    Of 1000, finite steps may throw a few at one.
    """
    flow = whirling(closed(kind, n, 0.2))
    if not corrected:
        flow = MeshFlow(flow.mesh, *flow.at_nodes()[1:])
    x = np.random.default_rng(7).uniform(0.0, 1.0, (1000, 3))
    bodies = spheres(x[flow.locate(x) >= 0], d=1e-9, rho=1.0, mu=1e3)
    cloud = Cloud(bodies, flow, Medium(1e-3, 1.0, (0.0, 0.0, 0.0)), [Stick()], 0.05, Models("roscoe"))
    cloud.advance(200 if corrected else 400)
    p = cloud.particles
    active = p.status == Status.ACTIVE
    count = np.bincount(flow.cell_of(p.host[active]), minlength=flow.mesh.n_cells)
    expected = len(x) * flow.mesh.volumes / flow.mesh.volumes.sum()
    chi = np.mean((count - expected) ** 2 / expected)
    if corrected:
        assert np.count_nonzero(~active) <= 3
        assert chi < 1.0 + 4.0 * np.sqrt(2.0 / len(count))
    else:
        assert np.count_nonzero(~active) > 50
        assert chi > 2.0
