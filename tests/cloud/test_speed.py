"""Speed of the loop: stages are vectorised, and a step costs no more than before.

A particle-step is compared with a fixed piece of numpy in the same process, not with a clock. When the loop
gets faster, lower the number in COST: the message of a failing test has the figure found.
"""

from __future__ import annotations

import re
import time
from types import FunctionType

import numpy as np
import pytest
from paths import PIPE
from processor import has_avx2, is_host

import foamprb
from foamprb.body.choice import choice
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import coefficients, compose, sum_of_forces
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.integrators.rosenbrock import first_inertial, predict_inertial
from foamprb.cloud.layout import LANES
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.registry import compose as surrounding
from foamprb.cloud.surroundings.registry import numbers_of, with_rows
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.compile import link as compiling
from foamprb.compile.link import link, separate

AIR = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))

COST = {"paper": 55.0, "stokes": 125.0}
"""A particle-step on a mesh with the default tolerance, in elements of the yardstick."""
SLOWER = 2.5
"""A loop that costs so many times more has lost something; machines alone differ by less."""

FORCES = (foamprb.Gravity(), foamprb.PressureGradient(), foamprb.VirtualMass(Cvm=0.5))


class Yardstick:
    """A square root, a division and three products and sums an element, in the cache."""

    def __init__(self) -> None:
        self.x = np.linspace(1.0, 2.0, 2048)
        self.y, self.z = np.empty_like(self.x), np.empty_like(self.x)

    def cost(self) -> float:
        """CPU seconds per element."""
        passes = 1000
        start = time.process_time()
        for _ in range(passes):
            np.multiply(self.x, self.x, out=self.y)
            np.add(self.y, 1.0, out=self.y)
            np.sqrt(self.y, out=self.y)
            np.multiply(self.y, 0.5, out=self.z)
            np.add(self.z, self.x, out=self.z)
            np.divide(self.y, self.z, out=self.z)
        return (time.process_time() - start) / (passes * self.x.size)


@pytest.fixture(scope="module")
def flow():
    return foamprb.read_case(PIPE)


def cloud_in(flow, integrator, n=3200):
    random = np.random.default_rng(0)
    r, angle = 1.9e-3 * np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    x = np.stack([0.03 * random.random(n) + 1e-3, r * np.cos(angle), r * np.sin(angle)], axis=1)
    p = spheres(x, d=5e-6, rho=2560.0, mu=0.05)
    walls = foamprb.patch_interactions(flow)
    dt = {"paper": 2e-5, "stokes": 1e-4}[integrator]
    return Cloud(p, flow, AIR, walls, dt, Models(integrator=integrator), threads=1)


@pytest.mark.skipif(not is_host(), reason="numpy, the yardstick, has more vector units than numba")
@pytest.mark.parametrize("integrator", COST)
def test_particle_step_costs_no_more_than_it_did(flow, integrator):
    """The least of several repeats, in turns with the yardstick: other work on the machine only adds."""
    cloud, yardstick = cloud_in(flow, integrator), Yardstick()
    cloud.advance(5)
    yardstick.cost()
    steps = 20
    ours, unit = [], []
    for _ in range(7):
        unit.append(yardstick.cost())
        before = cloud.particles.t.sum()
        start = time.process_time()
        cloud.advance(steps)
        spent = time.process_time() - start
        ours.append(spent / ((cloud.particles.t.sum() - before) / cloud.dt))
    cost = min(ours) / min(unit)
    assert cost < SLOWER * COST[integrator], (
        f"{cost:.0f} elements of the yardstick, {COST[integrator]} before"
    )


def arithmetic(assembly):
    """Numbers of packed and of scalar operations in double precision."""
    found = re.findall(r"^\s+v?(?:add|sub|mul|div|sqrt|fn?m(?:add|sub)\d*)([ps])d\b", assembly, re.MULTILINE)
    return found.count("p"), found.count("s")


@choice
def called(*_arguments):
    """Stand-in of a stage."""


def caller(*arguments):
    called(*arguments)


without_trace = separate(FunctionType(first_inertial.__code__, first_inertial.__globals__, "first_inertial"))
"""A stage that is not marked to be traced."""


@pytest.mark.skipif(not has_avx2(), reason="reads assembly for AVX2")
@pytest.mark.parametrize("stage", [predict_inertial, without_trace], ids=["traced", "compiled by numba"])
def test_stage_is_vectorised(stage, monkeypatch, tmp_path):
    """Beside walls, where stages are longest. A cached function cannot be inspected."""
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(compiling, "_dispatchers", {})
    integrator, models = INTEGRATORS["rosenbrock"], (WallLift(),)
    block = np.ones(with_rows(integrator.layout, models).rows * LANES)
    around = surrounding(models, (), integrator.inertia)
    slots = {**integrator.slots, **around.slots, sum_of_forces: compose(FORCES), called: stage}
    dispatcher = link(caller, slots)
    medium = AIR._replace(forces=coefficients(FORCES), numbers=numbers_of(models, ()))
    dispatcher(block, medium)
    (assembly,) = dispatcher.py_func.__globals__["called"].inspect_asm().values()
    packed, scalar = arithmetic(assembly)
    assert packed > 500
    assert scalar <= packed // 50
    assert not re.search(r"\bv?sqrtsd\b", assembly)
