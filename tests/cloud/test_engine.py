"""One loop serves for all models and flows: its code is found by one key. Nothing is compiled here."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
import pytest
from mesh_shapes import block

from foamprb.cloud.block import Medium, Scratch, at
from foamprb.cloud.forces import Gravity, PressureGradient, VirtualMass
from foamprb.cloud.layout import LANES, Row, offsets
from foamprb.cloud.patches import Adhere
from foamprb.cloud.surroundings.base import Stage, Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.fates import FateLimits, Fates
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.memory import FadingMemory
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models, Tracker
from foamprb.cloud.viscosity import FieldViscosity, PhaseMixture, PowerLaw
from foamprb.compile import link as linking
from foamprb.compile.link import packed
from foamprb.flow import analytic
from foamprb.flow.mesh.mesh import build_mesh
from foamprb.flow.meshflow import MeshFlow
from foamprb.flow.series import SeriesFlow

WATER = Medium(1e-3, 1000.0, (0.0, 0.0, -9.81))


class WindRows(NamedTuple):
    speed: Annotated[int, Row(1, "m/s", "what the wind adds")]


wind = offsets(WindRows)


def look(
    _flow: Any, s: Scratch, i: int, _step: int, _left: float, _medium: Medium, coefficients: Any
) -> None:
    s.block[wind.speed * LANES + i] = coefficients[0]


def blow(block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
    for i in range(LANES):
        block[at.u * LANES + i] += block[wind.speed * LANES + i]


@dataclass(frozen=True, kw_only=True)
class Wind(Surrounding):
    """A user's model."""

    speed: float = 1.0
    rows: ClassVar = (WindRows,)
    stages: ClassVar = (Stage("start", look), Stage("fluid", blow, adds=(at.u,)))

    def coefficients(self, _patches: Any) -> Any:
        return (self.speed,)


BROWNIAN = BrownianMotion(T=300.0)
MODELS: dict[str, dict[str, Any]] = {
    "bare": {},
    "without gravity": {"forces": ()},
    "heavy fluid": {"forces": (Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))},
    "centre": {"touching": "centre"},
    "Brownian": {"surroundings": (BROWNIAN,)},
    "walls": {"surroundings": (WallLift(),)},
    "walls and molecules": {"surroundings": (WallLift(strain=False), BROWNIAN)},
    "lift": {"surroundings": (SaffmanMeiLift(),)},
    "swimming": {"surroundings": (FaxenCorrection(), Swimming(speed=1e-4))},
    "fates": {"surroundings": (Fates(ruptured=FateLimits(stretch=2.0)),)},
    "quadratic": {"shape": "quadratic"},
    "memory": {"surroundings": (FadingMemory(n_times=2),)},
    "adhesion": {"interactions": (Adhere(kOn=1.0, kOff=0.1),)},
    "user's": {"surroundings": (Wind(),)},
    "other solid": {"material": "saintVenantKirchhoff", "traction": "jeffery"},
}
"""Arguments of Models, and interactions."""

FLUIDS = {
    "Newtonian": WATER,
    "shear-thinning": WATER._replace(mu=PowerLaw(k=1e-3, n=0.8)),
    "field": WATER._replace(mu=FieldViscosity(factor=1e-3, mean=1e-3)),
    "mixture": WATER._replace(mu=PhaseMixture(mu=(1e-3, 5e-3), rho=(1000.0, 900.0), mean=3e-3)),
}


@pytest.fixture(scope="module")
def flows():
    """A flow of each kind."""
    mesh = build_mesh(block(1, 0.0, "mixed"))
    values = np.zeros((len(mesh.nodes), 3)), np.zeros((len(mesh.nodes), 3, 3))
    return {
        "steady mesh": MeshFlow(mesh, *values),
        "transient mesh": SeriesFlow(mesh, [0.0, 1.0], lambda _: values),
        "posts": analytic.posts(1e-3, 5e-4, (1e-3, 0.0), 1e-4),
        "linear": analytic.shear(1.0),
    }


def key_of_loop(integrator, flow, medium=WATER, interactions=(), **models):
    """Name of the folder in which the machine code of a loop is saved."""
    tracker = Tracker(
        Models(integrator=integrator, **models), flow.kernels, medium, interactions, 1e-3, 0.0, True, False
    )
    loop = tracker.linked(packed(flow.arrays(0.0, ())), packed(()))
    return linking._stores[id(loop)][0].folder.name


@pytest.mark.parametrize("integrators", [("stokes", "rosenbrock"), ("paper",)], ids=["adaptive", "paper"])
def test_loops_of_all_models_and_flows_have_one_key(integrators, flows, tmp_path, monkeypatch):
    monkeypatch.setenv("FOAMPRB_CACHE_DIR", str(tmp_path))
    monkeypatch.setattr(linking, "_dispatchers", {})
    keys = {}
    steady = flows["steady mesh"]
    for integrator in integrators:
        for name, flow in flows.items():
            keys[integrator, name] = key_of_loop(integrator, flow)
        for name, models in MODELS.items():
            if integrator != "paper" or name not in REFUSED_BY_PAPER:
                keys[integrator, name] = key_of_loop(integrator, steady, **models)
        for name, medium in FLUIDS.items():
            keys[integrator, name] = key_of_loop(integrator, steady, medium)
    (first, key), *_ = keys.items()
    assert {name: k for name, k in keys.items() if k != key} == {}, first
    assert not any(code.signatures for code in linking._dispatchers.values())
    assert not list(tmp_path.iterdir())


REFUSED_BY_PAPER = ("adhesion",)
