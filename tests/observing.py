"""A cloud in a pipe that cloud functions observe, and the tables that they write."""

from __future__ import annotations

import csv

import numpy as np

from foamprb import analytic
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape, Stick
from foamprb.cloud.paths import COLUMNS, Steps, step
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.registry import CloudFunctions

RADIUS, MEAN, D = 2.1e-3, 0.485, 5e-6
WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
# So strong a gravity that half of the particles reach the wall before the end of the pipe.
AIR = Medium(1.8e-5, 1.2, (0.0, -400.0, 0.0))


def pipe_cloud(
    n=40, medium=AIR, length=0.03, integrator="stokes", walls=None, rebounds=False, shape="affine", **options
):
    """Particles spread over the inlet that start one after the other, from two injection models."""
    random = np.random.default_rng(1)
    r, phi = 0.97 * RADIUS * np.sqrt(random.uniform(0, 1, n)), random.uniform(0, 2 * np.pi, n)
    x = np.stack([np.full(n, 1e-3), r * np.cos(phi), r * np.sin(phi)], axis=1)
    mu = medium.mu * 900.0 / random.uniform(0.1, 1.0, n)
    p = spheres(x, d=D, rho=2560.0, mu=mu, t0=random.uniform(0.0, 5e-3, n))
    p.injector[:] = np.arange(n) % 2
    flow = analytic.pipe(RADIUS, MEAN, length)
    walls = walls or (Stick(), Escape(), Escape())
    models = Models(integrator=integrator, rebounds=rebounds, shape=shape)
    return Cloud(p, flow, medium, walls, 1e-4, models, **options)


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
        cloud.advance(target - cloud.step)
        cloud.step = target
        functions.write(folder)


def table(path):
    with path.open() as file:
        return list(csv.DictReader(file))


def column(rows, name):
    return np.array([float(row[name]) for row in rows])


def made_steps(t, x=None, v=None, F=None, l=None, number=0):
    """Steps of a particle, one after the other, from values of some quantities at n + 1 times."""
    n = len(t) - 1
    tables = np.zeros((1, COLUMNS, n))
    still = {"x": np.zeros((n + 1, 3)), "v": np.zeros((n + 1, 3)), "l": np.zeros((n + 1, 9))}
    still["F"] = np.tile(np.eye(3).ravel(), (n + 1, 1))
    given = {name: values for name, values in {"x": x, "v": v, "F": F, "l": l}.items() if values is not None}
    for name, values in {**still, **given, "t": np.reshape(t, (-1, 1))}.items():
        for end, ends in enumerate((values[:-1], values[1:])):
            first = getattr(step, f"{name}{end}")
            tables[0, first : first + ends.shape[1]] = np.transpose(ends)
    tables[0, step.Q0 : step.Q0 + 9] = tables[0, step.Q1 : step.Q1 + 9] = np.eye(3).reshape(9, 1)
    tables[0, step.row] = tables[0, step.number] = number
    tables[0, step.status] = Status.ACTIVE
    return Steps(tables, in_frame=False)


def see(cloud, steps):
    """Give steps to the functions of a cloud."""
    cloud.comm.prepare_steps(cloud)
    cloud.publish()
    rank = cloud.comm.rank
    rank.sampling.observers(rank, cloud.time).observe(steps)
