"""Compilation of all that most runs need, before the first of them."""

from __future__ import annotations

import logging

import numpy as np
import pyvista

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.measures import context, measure
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.compile.cache import cache_directory
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.reconstruct import Reconstruction
from foamprb.flow.series import SeriesFlow

__all__ = ["compile_all"]

log = logging.getLogger("foamprb")


def compile_all() -> None:
    """Compile what runs need that select nothing of their own: reading of meshes, all loops, the output.

    Steady and transient flows have loops of their own, and so has each integrator.
    """
    corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0), (0, 0, 1), (1, 0, 1), (1, 1, 1), (0, 1, 1)]
    cells = {pyvista.CellType.HEXAHEDRON: np.arange(8).reshape(1, 8)}
    mesh = build_mesh(pyvista.UnstructuredGrid(cells, np.array(corners, dtype=float)))
    nodes = Reconstruction(mesh)(np.zeros((1, 3)), np.zeros((len(mesh.boundary_centres), 3)))
    steady, transient = MeshFlow(mesh, *nodes), SeriesFlow(mesh, [0.0, 1.0], lambda _: nodes)
    flows: dict[str, MeshFlow | SeriesFlow] = {"steady": steady, "transient": transient}
    medium = Medium(1.0, 1.0, (0.0, 0.0, 0.0))
    for kind, flow in flows.items():
        for integrator in INTEGRATORS:
            log.info("Compiling the particle loop of integrationScheme %s in %s flows", integrator, kind)
            particle = spheres([(0.5, 0.5, 0.5)], d=1e-3, rho=1.0, mu=1.0)
            models = Models(integrator=integrator)
            cloud = Cloud(particle, flow, medium, [Stick()] * len(mesh.patches), 1e-3, models, threads=1)
            cloud.advance(1)
        measure(context(cloud.particles, flow, medium.mu, cloud.time))
    log.info("The code is kept in %s", cache_directory())
