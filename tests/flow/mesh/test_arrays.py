"""The geometry of one tetrahedron, and the arrays of a mesh that is not there."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.flow.mesh.arrays import frame, no_mesh, weights
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.rotating import RotatingFlow, RotatingZone
from foamprb.flow.series import SeriesFlow


def test_weights_are_those_of_the_corners(random):
    """w₀ + w₁ + w₂ + w₃ = 1 and Σ w_k x_k = x."""
    for _ in range(5):
        nodes = random.normal(size=(6, 3))
        tet = random.permutation(6)[:4]
        x = random.normal(size=3)
        arrays = no_mesh()._replace(nodes=nodes, tets=np.array([[0, 0, 0, 0], tet]))
        origin, c1, c2, c3, volume = frame(arrays, 1)
        a, b, c, d = nodes[tet]
        assert origin == tuple(a)
        assert volume == pytest.approx(np.linalg.det([b - a, c - a, d - a]), rel=1e-12, abs=0.0)
        found = np.array(weights(origin, c1, c2, c3, volume, tuple(x))) / volume
        exact = np.linalg.solve(np.vstack([nodes[tet].T, np.ones(4)]), [*x, 1.0])
        np.testing.assert_allclose(found, exact, rtol=1e-10, atol=1e-12)


def alike(nothing, some):
    """Whether tuples of arrays are of the same types, dimensions and rows, so that one loop reads both."""
    for name, a, b in zip(some._fields, nothing, some, strict=True):
        if isinstance(b, tuple):
            alike(a, b)
        elif isinstance(b, np.ndarray):
            assert (a.dtype, a.ndim, a.flags.c_contiguous) == (b.dtype, b.ndim, True), name
            # Lists of cells or walls in leaves are as long as there are.
            # Nodes of a flow in time have no velocities of their own.
            if name not in ("tree_cells", "wall_leaves", "nodes"):
                assert a.shape[1:] == b.shape[1:], name
            assert a.size == 0, name
        else:
            assert isinstance(a, type(b)), name
            assert a == 0, name


def test_no_flow_is_like_some():
    shape = block(2)
    mesh = build_mesh(shape, box_patches(shape))
    n = len(mesh.nodes)
    u, l = np.zeros((n, 3)), np.zeros((n, 3, 3))
    steady = MeshFlow(mesh, u, l, turbulence=np.zeros((n, 8)))
    alike(steady.nothing(), steady.arrays(0.3, (0,), 0.3, (0,)))
    series = SeriesFlow(mesh, (0.0, 1.0), lambda _: (u, l))
    series.load(0.0, 1.0)
    alike(series.nothing(), series.arrays(0.3, (0,), 0.3, (0,)))
    zone = RotatingZone("rotor", np.array([1]), (0.0, 0.0, 1.0), (0.0, 0.0, 0.0))
    rotating = RotatingFlow((zone,), mesh, u, l)
    alike(rotating.nothing(), rotating.arrays(0.3, (0,), 0.3, (0,)))
