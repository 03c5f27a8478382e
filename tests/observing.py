"""A cloud in a pipe that cloud functions observe, and the tables that they write."""

from __future__ import annotations

import csv

import numpy as np

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Stick
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.registry import CloudFunctions

RADIUS, MEAN, D = 2.1e-3, 0.485, 5e-6
WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
# So strong a gravity that half of the particles reach the wall before the end of the pipe.
AIR = Medium(1.8e-5, 1.2, (0.0, -400.0, 0.0))


def pipe_cloud(n=40, medium=AIR, length=0.03, integrator="stokes", walls=None, rebounds=False, **options):
    """Particles spread over the inlet that start one after the other, from two injection models."""
    random = np.random.default_rng(1)
    r, phi = 0.97 * RADIUS * np.sqrt(random.uniform(0, 1, n)), random.uniform(0, 2 * np.pi, n)
    x = np.stack([np.full(n, 1e-3), r * np.cos(phi), r * np.sin(phi)], axis=1)
    mu = medium.mu * 900.0 / random.uniform(0.1, 1.0, n)
    p = spheres(x, d=D, rho=2560.0, mu=mu, t0=random.uniform(0.0, 5e-3, n))
    p.injector[:] = np.arange(n) % 2
    flow = analytic.pipe(RADIUS, MEAN, length)
    walls = walls or (Stick(), Escape(), Escape())
    return Cloud(p, flow, medium, walls, 1e-4, Models(integrator=integrator, rebounds=rebounds), **options)


def observed(cloud):
    return ObservedCloud(
        cloud, {"injector": ("one", "two"), "patch": tuple(patch.name for patch in cloud.flow.patches)}
    )


def observe(cloud, function, folder, writes=(200, 400, 700)):
    """Advance as a run does, and write at some steps."""
    functions = CloudFunctions({"f": function}, observed(cloud))
    go_on(cloud, functions, folder, writes)
    return functions


def restore(functions, state):
    """Restore the data of functions of a cloud on one process."""
    functions.restore(state, lambda name: np.array(state[name]))
    for name, array in functions.cloud.cloud.comm.arrays_here().items():
        array[:] = state[name]


def go_on(cloud, functions, folder, writes):
    folder.mkdir(exist_ok=True)
    for target in writes:
        while cloud.step < target:
            until = functions.next_sample(target)
            cloud.advance(until - cloud.step)
            cloud.step = until
            functions.sample(functions.due)
        functions.sample(functions.functions)
        functions.write(folder)


def table(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])
