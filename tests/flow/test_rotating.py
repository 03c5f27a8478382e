"""What is seen from zones that turn."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.rotating import RotatingFlow, RotatingZone

ZONES = (
    RotatingZone("first", np.array([0, 1, 2]), (1.0, -2.0, 3.0), (0.1, 0.2, 0.3)),
    RotatingZone("second", np.array([2, 5]), (0.5, 0.7, -0.3), (-1.0, 2.0, 0.5)),
)
OF_CELL = {0: 0, 1: 0, 2: 1, 5: 1}


@pytest.fixture(scope="module")
def flows():
    shape = block(2, 0.2)
    mesh = build_mesh(shape, box_patches(shape))
    n, random = len(mesh.nodes), np.random.default_rng(5)
    u, l, k = random.normal(size=(n, 3)), random.normal(size=(n, 3, 3)), random.normal(size=(n, 8))
    options = {"time": "3", "turbulence": k, "notes": ["a note"]}
    return RotatingFlow(ZONES, mesh, u, l, **options), MeshFlow(mesh, u, l, **options)


def test_velocities_and_gradients_are_relative_to_the_frame_of_the_cell(flows, random):
    """u − Ω × (x − x₀), and l − W with W·a = Ω × a; of a cell in two zones the last counts."""
    flow, fixed = flows
    seen = set()
    for x in random.uniform(0.02, 0.98, (60, 3)):
        host = int(flow.locate(x[None])[0])
        cell = int(flow.cell_of(np.array([host]))[0])
        zone = OF_CELL.get(cell)
        omega, origin = (np.zeros(3), np.zeros(3)) if zone is None else map(np.array, ZONES[zone][2:])
        u, l, _ = fixed.kernels["sample"](fixed.arrays(), host, tuple(x), 0.0)
        W = np.cross(omega, np.eye(3), axisb=0, axisc=0)
        found = flow.kernels["sample"](flow.arrays(), host, tuple(x), 0.0)
        assert found[0] == pytest.approx(u - np.cross(omega, x - origin), rel=1e-12, abs=0.0)
        assert found[1] == pytest.approx(l - W.ravel(), rel=1e-12, abs=0.0)
        assert found[2] == (0.0, 0.0, 0.0)
        sampled = flow.sample(x[None], np.array([host], dtype=np.int32), 0.0)
        assert sampled[0][0] == pytest.approx(found[0])
        assert sampled[1][0].ravel() == pytest.approx(found[1])
        assert flow.kernels["rotation_at"](flow.arrays(), host) == (tuple(omega), tuple(origin))
        for name in ("curvature", "turbulence"):
            assert flow.kernels[name](flow.arrays(), host, tuple(x), 0.0) == fixed.kernels[name](
                fixed.arrays(), host, tuple(x), 0.0
            )
        seen.add(zone)
    assert seen == {None, 0, 1}


def test_velocities_at_a_patch_are_relative_too(flows):
    flow, fixed = flows
    ours, theirs = flow.patch_faces("lid", 0.0), fixed.patch_faces("lid", 0.0)
    np.testing.assert_array_equal(ours.vertices, theirs.vertices)
    cells = flow.cell_of(ours.hosts)
    for k, cell in enumerate(cells.tolist()):
        zone = ZONES[OF_CELL[cell]] if cell in OF_CELL else RotatingZone("", [], (0, 0, 0), (0, 0, 0))
        turning = np.cross(zone.omega, ours.vertices[k] - zone.origin)
        np.testing.assert_allclose(ours.velocity[k], theirs.velocity[k] - turning, rtol=0, atol=1e-12)
    assert 5 in cells


def test_what_tells_a_flow_with_zones_from_another(flows):
    flow, fixed = flows
    traits = flow.traits()
    assert set(traits) == {*fixed.traits(), "zone", "omega", "origin"}
    other = RotatingFlow((ZONES[0],), flow.mesh, *flow.at_nodes()[1:])
    assert not np.array_equal(traits["zone"], other.traits()["zone"])
    assert np.array_equal(traits["omega"], [[0.0] * 3, ZONES[0].omega, ZONES[1].omega])
    assert np.array_equal(traits["origin"], [[0.0] * 3, ZONES[0].origin, ZONES[1].origin])
    assert flow.rotating == ZONES
    assert flow.notes == fixed.notes
    assert flow.at_nodes()[0] == "3"
    np.testing.assert_array_equal(flow.turbulence_at_nodes(), fixed.turbulence_at_nodes())


def test_lists_of_walls_are_those_of_the_mesh(flows):
    flow, fixed = flows
    ours, theirs = flow.arrays(0.3, (0,), 0.2, (2,)).mesh, fixed.arrays(0.3, (0,), 0.2, (2,))
    for name in ("near_start", "near", "seen_start", "seen"):
        np.testing.assert_array_equal(getattr(ours, name), getattr(theirs, name))
