"""Small clouds: five particles in a pipe in closed form, and in a box with a mesh."""

from __future__ import annotations

import numpy as np
from mesh_shapes import block, box_patches

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Particles, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow

AIR = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))
WALL_RATE, RADIUS, LENGTH = 923.8, 2.1e-3, 0.01


def pipe_cloud(integrator, stride=1):
    """Particles that rest on the wall, leave, move on, and appear within the run and after it."""
    mean, dt = WALL_RATE * RADIUS / 4, 4e-5
    x = [(0.001, 0.9 * RADIUS, 0.0), (0.0, -RADIUS + 2.51e-6, 0.0), (LENGTH - 1e-4, 0.0, 1e-4)]
    x += [(0.002, 0.0, -1e-3), (0.003, 1e-3, 0.0)]
    p = spheres(np.array(x), d=5e-6, rho=2560.0, mu=AIR.mu * WALL_RATE / np.linspace(0.2, 1.0, 5))
    p.t0[3:] = p.t[3:] = 5.3 * dt, 100 * dt
    p.v[1], p.v[2] = (0.0, -1e-3, 0.0), (0.9, 0.0, 0.0)
    flow = analytic.pipe(RADIUS, mean, LENGTH)
    walls = (Stick(), Escape(), Escape())
    return Cloud(p, flow, AIR, walls, dt, Models(integrator=integrator, stride=stride), 1)


def box_cloud(integrator):
    """Particles in a box that stick to its floor, leave through its lid and rebound from its sides."""
    shape = block(2, 0.25, "mixed")
    mesh = build_mesh(shape, box_patches(shape))
    gradient = np.array([[0.0, 30.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    nodes = mesh.nodes
    flow = MeshFlow(mesh, nodes @ gradient.T, np.broadcast_to(gradient, (len(nodes), 3, 3)))
    p = spheres(np.full((5, 3), 0.5), d=2e-2, rho=1200.0, mu=2.0 * 30.0 / np.linspace(0.1, 0.8, 5))
    p.x[:, 2] = 0.03, 0.97, 0.5, 0.5, 0.4
    p.x[2, 1] = 0.96
    p.v[:] = (0.0, 0.0, -20.0), (0.0, 0.0, 20.0), (15.0, 30.0, 0.0), (0.0, 1.0, 0.0), (15.0, 0.0, 0.0)
    p.t0[4] = p.t[4] = 5e-3
    kinds = {"floor": Stick(), "lid": Escape(), "sides": Rebound(0.8, 0.1)}
    medium = Medium(2.0, 1000.0, (0.0, 0.0, -9.81))
    if integrator == "stokes":
        # Without inertia the velocity is the fluid's; the wall is met by falling.
        medium = Medium(0.02, 100.0, (0.0, 9.81, -9.81))
        p.x[:, 2] = 0.0105, 0.9999, 0.5, 0.5, 0.4
        p.x[2, 1] = 0.9895
    walls = [kinds[patch.name] for patch in flow.patches]
    return Cloud(p, flow, medium, walls, 2e-3, Models(integrator=integrator), 1)


def assert_same(a: Particles, b: Particles, rows: int | slice = slice(None)) -> None:
    """Particles are the same to the last bit; ``rows`` are of the first."""
    for name, x, y in zip(Particles._fields, a, b, strict=True):
        np.testing.assert_array_equal(x[rows], y, err_msg=name)
