"""Small clouds for the processor and for a CUDA device; as a script, on a device that numba simulates.

``device_cases.py FILE WHOLE STOPPED`` puts the states that they come to into an .npz file, and runs two
cases: one as a whole, the other stopped and resumed.
"""

from __future__ import annotations

import sys
import warnings

import numpy as np
import pytest
from mesh_shapes import block, box_patches

from foamprb import Gravity, PressureGradient, VirtualMass, analytic
from foamprb.cli import main
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Rebound, Stick
from foamprb.cloud.state import Particles, spheres
from foamprb.cloud.tracker import Models
from foamprb.errors import RunStopped
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.parallel.launch import choose_executor
from foamprb.run.job import prepare
from foamprb.run.loop import execute

INTEGRATORS = ("paper", "rosenbrock", "stokes")
AIR = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))
WALL_RATE, RADIUS, LENGTH = 923.8, 2.1e-3, 0.01
STEPS = 12


def recover_everywhere(flow, x):
    return 0


def walk_fails(flow, host, x0, x1):
    return host, 0.0, -2, -1


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
    forces = (Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
    if integrator == "stokes":
        # Without inertia the velocity is the fluid's; the wall is met by falling.
        medium, forces = Medium(0.02, 100.0, (0.0, 9.81, -9.81)), (Gravity(),)
        p.x[:, 2] = 0.0105, 0.9999, 0.5, 0.5, 0.4
        p.x[2, 1] = 0.9895
    walls = [kinds[patch.name] for patch in flow.patches]
    return Cloud(p, flow, medium, walls, 2e-3, Models(integrator=integrator, forces=forces), 1)


def mended_cloud():
    """A particle whose walks fail and are mended by the tree."""
    flow = analytic.shear(100.0)
    flow.kernels = flow.kernels | {"walk": walk_fails, "recover": recover_everywhere}
    p = spheres(np.zeros((3, 3)), d=5e-6, rho=2560.0, mu=1.0)
    return Cloud(p, flow, AIR, (), 1e-5, Models(integrator="paper"), 1)


def long_steps(integrator):
    """As :func:`pipe_cloud`, where a step may go through four tracking steps."""
    return pipe_cloud(integrator, stride=4)


def states(device):
    """What the clouds come to, by ``cloud integrator/array``."""
    found = {}
    for make in (pipe_cloud, box_cloud, long_steps):
        for integrator in INTEGRATORS:
            cloud = on(device, make(integrator))
            cloud.advance(STEPS)
            found |= state(f"{make.__name__} {integrator}", cloud)
    return found


def on(device, cloud):
    if device == "cuda":
        cloud.hand_over(choose_executor("cuda", None))
    return cloud


def state(name, cloud):
    cloud.gather()
    p = cloud.particles
    return {f"{name}/{key}": array.copy() for key, array in zip(Particles._fields, p, strict=True)}


def states_by_pieces(device):
    """The same of the pipe, in steps that were begun ahead or not, and went on in another cloud."""
    found = {}
    for integrator in INTEGRATORS:
        cloud = on(device, pipe_cloud(integrator))
        cloud.advance(3)
        cloud.begin(4)
        found |= state(f"early {integrator}", cloud)
        cloud.advance(4)
        cloud.begin(3)
        cloud.gather()
        cloud.advance(1)
        cloud.begin(1)
        cloud.advance(1)
        cloud.gather()
        cloud.begin(1)
        other = on(device, pipe_cloud(integrator))
        other.particles = Particles(*(array.copy() for array in cloud.particles))
        other.step, other.reach = cloud.step, cloud.reach
        other.advance(STEPS - other.step)
        found |= state(f"pieces {integrator}", other)
    return found


def run_in_two_parts(case):
    job = prepare(case)
    with pytest.raises(RunStopped):
        execute(job, stop=lambda: job.cloud.step >= 5, executor=choose_executor("cuda", None))
    assert main(["run", "-case", case, "-device", "cuda", "-resume"]) == 0


if __name__ == "__main__":
    file, whole, stopped = sys.argv[1:]
    # Lanes that are not used may divide by zero, as in the compiled code.
    warnings.simplefilter("ignore")
    mended = on("cuda", mended_cloud())
    mended.advance(3)
    mended.advance(1)
    found = states("cuda") | states_by_pieces("cuda") | {"mended": np.array(mended.recovered)}
    np.savez(file, **found)
    assert main(["run", "-case", whole, "-device", "cuda"]) == 0
    run_in_two_parts(stopped)
