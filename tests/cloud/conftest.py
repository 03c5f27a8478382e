"""Flows that several of these tests share."""

from __future__ import annotations

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction


@pytest.fixture(scope="module")
def coarse_vortex():
    """A vortex in a cube of 6³ crooked cells, of which u and ∇u are reconstructed each for itself."""
    mesh = build_mesh(shape := block(6), box_patches(shape))

    def u(x):
        p, q = np.pi * x[:, 0], np.pi * x[:, 1]
        return np.stack([np.sin(p) * np.cos(q), -np.cos(p) * np.sin(q), 0.0 * p], axis=1)

    return MeshFlow(mesh, *Reconstruction(mesh)(u(mesh.centres), u(mesh.boundary_centres)))
