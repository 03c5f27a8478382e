"""How models of the surroundings are bound into the loop of every integrator."""

from __future__ import annotations

import math
from dataclasses import dataclass
from itertools import permutations
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np
import pytest

from foamprb.cloud.block import Medium, Scratch, at, load3, store3
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import Gravity, PressureGradient, VirtualMass
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.layout import FURTHER, LANES, Row, end, offsets
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.base import Stage, Surrounding
from foamprb.cloud.surroundings.registry import _in_order, compose, with_rows
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.tracker import Models
from foamprb.errors import InputError
from foamprb.flow import analytic

WATER = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
DT = 1e-3


class WindRows(NamedTuple):
    speed: Annotated[int, Row(1, "m/s", "what the wind adds")]
    seen: Annotated[int, Row(3, "m", "where it was looked for")]


wind = offsets(WindRows)


def look(
    _flow: Any, s: Scratch, i: int, step: int, _remaining: float, _medium: Medium, coefficients: Any
) -> None:
    s.block[wind.speed * LANES + i] = coefficients[0] * (step + 1)
    store3(s.block, wind.seen, i, load3(s.block, at.x, i))


def blow(block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
    for i in range(LANES):
        u, x = load3(block, at.u, i), load3(block, wind.seen, i)
        store3(block, at.u, i, (u[0] + block[wind.speed * LANES + i], u[1], u[2] + 0.0 * x[0]))


@dataclass(frozen=True, kw_only=True)
class Wind(Surrounding):
    speed: float
    rows: ClassVar = (WindRows,)
    stages: ClassVar = (Stage("start", look, writes=(wind.speed,)), Stage("fluid", blow, adds=(at.u,)))

    def coefficients(self, _patches: Any) -> Any:
        return (self.speed,)


class CalmRows(NamedTuple):
    nothing: Annotated[int, Row(9, "", "nothing")]


@dataclass(frozen=True, kw_only=True)
class Calm(Surrounding):
    rows: ClassVar = (CalmRows,)


def carried(integrator, surroundings, steps=3):
    p = spheres(np.zeros((3, 3)), d=2e-6, rho=1000.0, mu=10.0)
    models = Models(integrator=integrator, surroundings=surroundings, tolerance=np.inf)
    # One that is stable for all.
    dt = 1e-8 if integrator == "paper" else DT
    cloud = Cloud(p, analytic.shear(10.0), WATER, (), dt, models, threads=1)
    cloud.advance(steps)
    return p


@pytest.mark.parametrize("integrator", ["rosenbrock", "stokes"])
def test_a_model_changes_the_fluid_that_a_particle_feels(integrator):
    p = carried(integrator, (Calm(), Wind(speed=1e-3)))
    assert p.x[:, 0] == pytest.approx(DT * 1e-3 * (1 + 2 + 3), rel=2e-3)
    assert p.v[:, 0] == pytest.approx(3e-3, rel=2e-3)


def test_a_model_acts_with_the_papers_integrator():
    p = spheres(np.zeros((3, 3)), d=2e-4, rho=1000.0, mu=1e-3)
    models = Models(integrator="paper", surroundings=(Calm(), Wind(speed=1e-3)))
    cloud = Cloud(p, analytic.shear(1.0), WATER, (), 1e-2, models, threads=1)
    cloud.advance(1)
    assert p.v[:, 0] == pytest.approx(
        1e-3 * (1.0 - 1.0 / (1.0 + 18.0 * 1e-3 * 1e-2 / (1e3 * 4e-8))), rel=0.02
    )


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_no_op_surrounding_changes_no_bit(integrator):
    p, q = (carried(integrator, models, steps=1) for models in ((), (Calm(), Wind(speed=0.0))))
    for one, other in zip(p, q, strict=True):
        assert np.array_equal(one, other, equal_nan=True)


def test_further_models_have_their_rows_one_after_the_other_behind_all_rooms():
    own = INTEGRATORS["stokes"].layout
    models = (Calm(), Wind(speed=0.0))
    assert with_rows(own, ()) is own
    assert wind.speed >= FURTHER
    assert offsets(WindRows) == wind
    assert offsets(CalmRows).nothing >= end(wind)
    assert with_rows(own, models).rows == end(offsets(CalmRows))


class SwirlRows(NamedTuple):
    speed: Annotated[int, Row(1, "m/s", "the largest velocity that a swirl adds")]


swirl = offsets(SwirlRows)


def look_for_nothing(
    _flow: Any, s: Scratch, i: int, _step: int, _remaining: float, _medium: Medium, coefficients: Any
) -> None:
    s.block[swirl.speed * LANES + i] = coefficients[0]


def whirl(block: Any, _medium: Medium, share: float, coefficients: Any) -> None:
    """A velocity that depends on the place, the same along all axes."""
    k = coefficients[1]
    for i in range(LANES):
        u, x, y = load3(block, at.u, i), load3(block, at.x, i), load3(block, at.new_x, i)
        v = block[swirl.speed * LANES + i]
        a, b, c = (x[0] + share * (y[0] - x[0]), x[1] + share * (y[1] - x[1]), x[2] + share * (y[2] - x[2]))
        store3(
            block,
            at.u,
            i,
            (
                u[0] + v * np.sin(k * a) * b * k,
                u[1] + v * np.sin(k * b) * c * k,
                u[2] + v * np.sin(k * c) * a * k,
            ),
        )


@dataclass(frozen=True, kw_only=True)
class Swirl(Surrounding):
    speed: float
    wave: float
    rows: ClassVar = (SwirlRows,)
    stages: ClassVar = (Stage("start", look_for_nothing), Stage("fluid", whirl, adds=(at.u,)))

    def coefficients(self, _patches: Any) -> Any:
        return (self.speed, self.wave)


WAVE, SPEED = 700.0, 0.02


def vortices(x, y, z, t):
    """The flow of Arnold, Beltrami and Childress, the same along all axes, that grows and decays."""
    s = SPEED * (1.0 + 0.5 * math.sin(300.0 * t))
    return (
        s * (math.sin(WAVE * z) + math.cos(WAVE * y)),
        s * (math.sin(WAVE * x) + math.cos(WAVE * z)),
        s * (math.sin(WAVE * y) + math.cos(WAVE * x)),
    )


@pytest.mark.parametrize("integrator", INTEGRATORS)
def test_no_axis_is_unlike_the_others(integrator):
    """Where flow, forces and surroundings have no axis, exchanged axes exchange what comes of a particle."""
    start, d = np.array([1e-3, 2.2e-3, -0.7e-3]), 2e-4 if integrator == "paper" else 4e-5
    p = spheres([np.roll(start, k) for k in range(3)], d=d, rho=1500.0, mu=0.05)
    p.v[:] = [np.roll((0.01, -0.02, 0.03), k) for k in range(3)]
    forces = (Gravity(), PressureGradient(), VirtualMass(Cvm=0.5))
    models = Models(integrator=integrator, surroundings=(Swirl(speed=0.01, wave=WAVE),), forces=forces)
    dt, steps = (1e-5, 100) if integrator == "paper" else (1e-3, 20)
    heavy = Medium(1e-3, 1000.0, (5.0, 5.0, 5.0))
    Cloud(p, analytic.function(vortices), heavy, (), dt, models, threads=1).advance(steps)
    for k in (1, 2):
        for name, scale in (("x", 1e-3), ("v", SPEED)):
            got = np.roll(getattr(p, name)[k], -k)
            np.testing.assert_allclose(got, getattr(p, name)[0], rtol=0, atol=1e-9 * scale, err_msg=name)
        got = np.roll(p.F[k].reshape(3, 3), (-k, -k), (0, 1))
        np.testing.assert_allclose(got, p.F[0].reshape(3, 3), rtol=0, atol=1e-8)
    # It has been somewhere, and is no sphere any more.
    assert np.linalg.norm(p.x[0] - start) > 1e-5
    assert np.abs(p.F[0].reshape(3, 3) - np.eye(3)).max() > 1e-3


class PoolRows(NamedTuple):
    depth: Annotated[int, Row(1, "m", "how deep it is")]
    swell: Annotated[int, Row(3, "m/s", "what moves on it")]


pool = offsets(PoolRows)


def model_of(name, *stages):
    """A model with stages at the place ``fluid`` whose functions have names of their own."""

    def run_of(stage_name):
        def run(block: Any, _medium: Medium, _share: float, _coefficients: Any) -> None:
            for i in range(LANES):
                block[at.u * LANES + i] += 0.0

        run.__qualname__ = stage_name
        return run

    made = tuple(Stage("fluid", run_of(f"{name}{k}"), **rows) for k, rows in enumerate(stages))
    return dataclass(frozen=True, kw_only=True)(
        type(name, (Surrounding,), {"rows": (PoolRows,), "stages": made, "__annotations__": {}})
    )()


def order_of(*models):
    stages = [(n, stage) for n, model in enumerate(models) for stage in model.stages]
    return [stage.run.__qualname__ for _, stage in _in_order(stages, models)]


DIG = model_of("Dig", {"writes": (pool.depth,)})
SWIM = model_of("Swim", {"reads": (pool.depth, pool.swell), "adds": (at.u,)})
BLOW = model_of("Blow", {"adds": (pool.swell,)})
LOOK = model_of("Look", {"before": (at.u, pool.swell)})


def test_the_order_of_models_follows_from_their_rows():
    """Written before it is read, added before that, and looked at before it is changed."""
    for models in permutations((DIG, SWIM, BLOW, LOOK)):
        found = order_of(*models)
        assert found.index("Dig0") < found.index("Swim0")
        assert found.index("Look0") < found.index("Blow0") < found.index("Swim0")
    # Where rows leave it open, it is that of the models.
    assert order_of(BLOW, DIG) == ["Blow0", "Dig0"]
    assert order_of(DIG, BLOW) == ["Dig0", "Blow0"]


def test_models_that_exclude_each_other_are_an_error():
    with pytest.raises(InputError, match="Drain excludes Dig: both determine depth"):
        order_of(DIG, model_of("Drain", {"writes": (pool.depth,)}))
    each = ({"reads": (pool.depth,), "adds": (pool.swell,)}, {"reads": (pool.swell,), "adds": (pool.depth,)})
    with pytest.raises(InputError, match="Hen and Egg each read what another one changes"):
        order_of(model_of("Hen", each[0]), model_of("Egg", each[1]))
    lift, frames = SaffmanMeiLift(), RotatingFrames()
    with pytest.raises(
        InputError, match="RotatingFrames excludes SaffmanMeiLift: both determine slip_of_body"
    ):
        compose((lift, frames), (), inertia=False)
