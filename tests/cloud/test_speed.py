"""That the loop stays fast: its stages are vectorised, and a step costs no more than it did.

No clock time is compared: a particle-step is set against a fixed piece of numpy in the same process. When the
loop gets faster, lower the number in COST: the message of a failing test tells what was found.
"""

from __future__ import annotations

import logging
import platform
import re
import time

import numpy as np
import pytest
from paths import PIPE

import foamprb
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import coefficients, compose
from foamprb.cloud.integrators.paper import dense_newton
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.integrators.rosenbrock import predict_inertial
from foamprb.cloud.layout import LANES
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.brownian import apply_force, compute_force
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.registry import compose as surrounding
from foamprb.cloud.surroundings.registry import with_rows
from foamprb.cloud.surroundings.wall_lift import WallLift, lift
from foamprb.cloud.tracker import Models
from foamprb.compile import link as compiling
from foamprb.compile.link import link

AIR = Medium(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))

COST = {"paper": 55.0, "stokes": 125.0}
"""A particle-step on a mesh with the default tolerance, in elements of the yardstick."""
SLOWER = 2.5
"""A loop that costs so many times more has lost something; machines alone differ by less."""

FORCES = (foamprb.Gravity(), foamprb.PressureGradient(), foamprb.VirtualMass(Cvm=0.5))
# It goes through a single lane.
_NO_VECTORS = (dense_newton,)
# These ask first whether any lane needs it, or whether it is selected.
_NOT_TRACED = (lift, compute_force, apply_force)
AROUND = (FaxenCorrection(), WallLift(), foamprb.BrownianMotion(T=300.0))
STAGES = {stage: INTEGRATORS["stokes"] for model in AROUND for stage in model.stages()}
STAGES |= {stage: kind for kind in INTEGRATORS.values() for stage in kind.stages if stage not in _NO_VECTORS}


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
    walls = [foamprb.Stick() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    dt = {"paper": 2e-5, "stokes": 1e-4}[integrator]
    return Cloud(p, flow, AIR, walls, dt, Models(integrator=integrator), threads=1)


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


def called(*_arguments):
    """Stands for a stage."""


def caller(*arguments):
    called(*arguments)


def assembly_of(stage, integrator, monkeypatch, folder, more=()):
    """Assembly of a stage, compiled afresh: what comes from numba's cache cannot be inspected.

    With the models of the surroundings whose stage it is, or with others.
    """
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(folder))
    monkeypatch.setattr(compiling, "_parts", {})
    medium = AIR._replace(coefficients=coefficients(FORCES))
    models = more or tuple(model for model in AROUND if stage in model.stages())
    block = np.ones(with_rows(integrator.layout, models).rows * LANES)
    around = surrounding(integrator.layout, models, integrator.inertia)
    bindings = compose(FORCES) | integrator.bindings | around
    dispatcher = link(caller, bindings | {"called": stage}, separate=(stage,))
    values = {"block": block, "medium": medium, "tolerance": 1e-4, "allowed": 1e-22, "share": 1.0, "dt": 1e-4}
    for model in models:
        values["coefficients"] = model.coefficients([])
    dispatcher(*(values[name] for name in stage.__code__.co_varnames[: stage.__code__.co_argcount]))
    (assembly,) = dispatcher.inspect_asm().values()
    return assembly


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86 assembly")
@pytest.mark.parametrize("stage", [lift, predict_inertial], ids=lambda stage: stage.__name__)
def test_hindering_walls_leave_stages_with_inertia_vectorised(stage, monkeypatch, tmp_path):
    packed, scalar = arithmetic(
        assembly_of(stage, INTEGRATORS["rosenbrock"], monkeypatch, tmp_path, (WallLift(),))
    )
    assert packed > 500
    assert scalar <= packed // 50


@pytest.mark.skipif(platform.machine() not in ("x86_64", "AMD64"), reason="reads x86 assembly")
@pytest.mark.parametrize("stage", STAGES, ids=lambda stage: stage.__name__)
def test_stage_is_traced_and_vectorised(stage, monkeypatch, tmp_path, caplog):
    """One that is not traced takes thirty times as long to compile."""
    caplog.set_level(logging.DEBUG, logger="foamprb")
    assembly = assembly_of(stage, STAGES[stage], monkeypatch, tmp_path)
    assert ("is not traced" in caplog.text) == (stage in _NOT_TRACED)
    packed, scalar = arithmetic(assembly)
    assert packed > 15
    # Constants may be prepared before a loop; around a particle there are many, and one counts walls.
    around = any(stage in model.stages() for model in AROUND)
    assert scalar <= (max(6, packed // 50) if around else 6)
    assert not re.search(r"\bv?sqrtsd\b", assembly)
