"""All pairs of models: each is refused with a reason, or runs with results that depend on nothing else.

Threads, order of the particles, calls and stops change no bit. `tests/run/test_restart.py` has files of runs,
`tests/distributed/test_communicator.py` and `tests/mpi` have ranks.
"""

from __future__ import annotations

import random
from itertools import combinations
from typing import Any

import numpy as np
import pytest

from foamprb.body.material import modulus_of_capsule
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud, Stepper
from foamprb.cloud.forces import DEFAULT, DuctLift
from foamprb.cloud.patches import Adhere, Rebound
from foamprb.cloud.state import Particles, Status, drops, spheres, with_relaxation
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.fates import FateLimits, Fates
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import PowerLaw
from foamprb.errors import InputError
from foamprb.flow import analytic

R, MU, RATE = 2e-6, 1e-3, 100.0
CHANNEL = DuctLift(
    shape="channel", origin=(0.0, 0.0, 5e-5), direction=(0.0, 0.0, 1.0), size=5e-5, shearRate=RATE
)
AROUND = {
    "faxenCorrection": FaxenCorrection(),
    "SaffmanMeiLiftForce": SaffmanMeiLift(),
    "wallLift": WallLift(),
    "wallLift without mobility": WallLift(mobility=False),
    "BrownianMotion": BrownianMotion(T=300.0),
    "swimming": Swimming(speed=2e-5, rotationalDiffusivity=1.0),
    "fates": Fates(ruptured=FateLimits(stretch=2.0)),
    "rotating zones": RotatingFrames(),
}
CHOICES = {
    "integrator": ("stokes", "rosenbrock", "paper"),
    "body": ("soft", "quadratic", "drop", "capsule", "quadratic drop"),
    "solid": ("elastic", "relaxation"),
    "fluid": ("water", "carrier"),
    "wall": ("rebound", "adhesion"),
    "force": ("no force", "ductLift"),
}
"""One of each; the first is the default, with which the others are taken."""
DEFAULTS = {kind: names[0] for kind, names in CHOICES.items()}
MODELS = ["stokes", *(n for names in CHOICES.values() for n in names[1:]), *AROUND]
KIND = {name: kind for kind, names in CHOICES.items() for name in names}


def turning(_flow: Any, _host: int) -> Any:
    return (0.0, 0.0, 5.0), (0.0, 0.0, 0.0)


def cloud_of(names: frozenset[str], before: Cloud | None = None) -> Cloud:
    """Bodies in shear over a wall, two of them about to touch it; or as ``before`` has them."""
    chosen = DEFAULTS | {KIND[name]: name for name in sorted(names) if name in KIND}
    liquid = "drop" in chosen["body"]
    step, reach = 0, 0.0
    if before is not None:
        particles, step, reach = before.particles.copy(), before.step, before.reach
    else:
        # More than two blocks.
        x = [(0.0, 0.0, h * R) for h in (1.0001, 1.003, 1.5, 4.0, *np.linspace(5.0, 20.0, 36))]
        capsule = chosen["body"] == "capsule"
        mu, eta = (modulus_of_capsule(4e-6, 0.5, R), MU) if capsule else (1.0, 0.0)
        particles = (
            drops(x, d=2.0 * R, rho=1500.0, gamma=4e-6, eta=MU)
            if liquid
            else spheres(x, d=2.0 * R, rho=1500.0, mu=mu, bulk_modulus=1e3, eta=eta)
        )
        if chosen["solid"] == "relaxation":
            particles = with_relaxation(particles, [0.5, 0.5], [2e-4, 2e-3])
    flow = analytic.shear_over_wall(RATE)
    if "rotating zones" in names:
        flow.kernels = flow.kernels | {"rotation_at": turning}
    viscosity = MU if chosen["fluid"] == "water" else PowerLaw(k=2e-3, n=0.8)
    models = Models(
        integrator=chosen["integrator"],
        material="drop" if liquid else "capsule neoHookean" if chosen["body"] == "capsule" else "neoHooke",
        shape="quadratic" if "quadratic" in chosen["body"] else "affine",
        forces=(*DEFAULT, CHANNEL) if chosen["force"] == "ductLift" else DEFAULT,
        surroundings=tuple(model for name, model in AROUND.items() if name in names),
    )
    patch = Adhere(kOn=5e3, kOff=10.0) if chosen["wall"] == "adhesion" else Rebound()
    dt = 2e-7 if chosen["integrator"] == "paper" else 2e-4
    medium = Medium(viscosity, 1000.0, (0.0, 0.0, -9.81))
    return Cloud(particles, flow, medium, [patch], dt, models, threads=1, step=step, reach=reach)


def reason_against(names: frozenset[str]) -> str:
    """Return why models exclude each other; empty if they go together."""
    kinds = [KIND[name] for name in names if name in KIND]
    if len(kinds) > len(set(kinds)) or len(names & {"wallLift", "wallLift without mobility"}) == 2:
        return CHOICE
    try:
        cloud_of(names)
    except InputError as error:
        return str(error)
    return ""


def sets_of_pairs(refused: dict[frozenset[str], str], order: random.Random) -> list[frozenset[str]]:
    """Return sets of models that go together, which contain all pairs that do."""
    sets = []
    missing = [pair for pair in PAIRS if pair not in refused]
    order.shuffle(missing)
    while missing:
        names = missing[0]
        while fitting := [n for n in MODELS if not any(frozenset((n, m)) in refused for m in names)]:
            fitting = [n for n in fitting if n not in names]
            gains = [sum(n in pair and pair <= names | {n} for pair in missing) for n in fitting]
            if not any(gains):
                break
            names |= {order.choice([n for n, gain in zip(fitting, gains, strict=True) if gain == max(gains)])}
        sets.append(names)
        missing = [pair for pair in missing if not pair <= names]
    return sets


CHOICE = "one of both is chosen"
PAIRS = [frozenset(pair) for pair in combinations(MODELS, 2)]


@pytest.fixture(scope="module")
def refused():
    return {pair: reason for pair in PAIRS if (reason := reason_against(pair))}


def test_a_refusal_names_one_of_the_models(refused):
    """The wall's force on drops, say: nothing is left out in silence."""
    words = {
        "rotating zones": ("rotating zones", "RotatingFrames"),
        "wallLift": ("wallLift",),
        "quadratic": ("quadratic",),
        "adhesion": ("adhere",),
    }
    for pair, reason in refused.items():
        if reason != CHOICE:
            names = [word for name in pair for word in words.get(name, name.split()[-1:])]
            assert any(name in reason for name in names), (sorted(pair), reason)
    assert frozenset(("SaffmanMeiLiftForce", "rotating zones")) in refused
    assert frozenset(("drop", "rosenbrock")) in refused
    assert frozenset(("BrownianMotion", "wallLift")) not in refused


@pytest.mark.filterwarnings("ignore::foamprb.errors.FailedParticlesWarning")
def test_no_bit_of_other_pairs_depends_on_threads_order_calls_or_stops(refused):
    """With rosenbrock and wallLift the nearest bodies may need too many steps: see the page of wallLift."""
    fewest = min((sets_of_pairs(refused, random.Random(seed)) for seed in range(20)), key=len)
    draw = random.Random(1)
    for names in fewest:
        whole, part = cloud_of(names), cloud_of(names)
        whole.advance(6)
        cut, part.threads = draw.randint(1, 4), draw.randint(1, 3)
        part.advance(cut)
        resumed = cloud_of(names, part)
        order = np.random.default_rng(cut).permutation(resumed.size)
        resumed.particles, resumed.threads = resumed.particles.take(order), draw.randint(1, 3)
        # As after a stop: half of the particles are ahead.
        before = [array.copy() for array in resumed.particles]
        Stepper(resumed).advance(1)
        for array, old in zip(resumed.particles, before, strict=True):
            array[::2] = old[::2]
        resumed.step = cut
        resumed.advance(6 - cut)
        where = sorted(names), cut
        assert (whole.particles.status[2:] == Status.ACTIVE).all(), where
        assert (whole.particles.x[2:] != part.particles.x[2:]).any(axis=1).all(), where
        expected = whole.particles.take(order)
        for name, one, other in zip(Particles._fields, expected, resumed.particles, strict=True):
            assert np.array_equal(one, other, equal_nan=one.dtype.kind == "f"), (name, where)
