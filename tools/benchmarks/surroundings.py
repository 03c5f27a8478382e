"""Cost of models: walls near and far, molecules, curved flows; carriers that thin, lift, drops."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, rows

STEP, MU = 1e-4, pipe.RHO * pipe.NU


class Model(NamedTuple):
    """What is chosen beside the defaults."""

    surroundings: tuple = ()
    forces: tuple = (foamprb.Gravity(),)
    mu: object = MU
    material: str = "neoHooke"


DUCT = foamprb.DuctLift(
    shape="pipe", origin=(0.0, 0.0, 0.0), direction=(1.0, 0.0, 0.0), size=pipe.RADIUS,
    shearRate=pipe.WALL_RATE, table=((0.0, 0.0), (0.5, 0.1), (0.6, 0.0), (0.9, -0.5)),
)  # fmt: skip
MODELS = {
    "without": Model(),
    "wallLift": Model((foamprb.WallLift(),)),
    "BrownianMotion": Model((foamprb.BrownianMotion(T=293.15),)),
    "faxenCorrection": Model((foamprb.FaxenCorrection(),)),
}
FAR = {
    "SaffmanMeiLiftForce": Model((foamprb.SaffmanMeiLift(),)),
    "ductLift": Model((), (foamprb.Gravity(), DUCT)),
    "powerLaw": Model(mu=foamprb.PowerLaw(k=10.0 * MU, n=0.7)),
    "BirdCarreau": Model(mu=foamprb.BirdCarreau(mu0=10.0 * MU, muInf=MU, k=0.1, n=0.4)),
    "drops": Model(material="drop"),
}
"""Models without walls, measured far from them only."""
PLACES = {
    "far from walls": (pipe.D, 0.0, 0.9),
    "within 10 radii of the wall": (pipe.D, 1.0 - 5.0 * pipe.D / pipe.RADIUS, 1.0 - pipe.D / pipe.RADIUS),
    "a tenth of the pipe's radius wide": (0.2 * pipe.RADIUS, 0.0, 0.8),
}
"""Diameters, m, and between which distances from the axis particles begin, over the pipe's radius."""


def particles(n: int, d: float, low: float, high: float, material: str) -> foamprb.Particles:
    """Return n stiff particles of the fluid's density in the first third of the pipe."""
    places = pipe.positions(n, high, low)
    mu = MU * pipe.WALL_RATE / 0.01
    if material == "drop":
        p = foamprb.drops(places, d=d, rho=pipe.RHO, gamma=0.5 * d * mu, eta=MU)
    else:
        p = foamprb.spheres(places, d=d, rho=pipe.RHO, mu=mu)
    p.v[:] = pipe.poiseuille(places)
    return p


def contestant(flow, p: foamprb.Particles, model: Model, steps: int) -> Callable[[], float]:
    """Return the measurement of CPU µs per particle-step with a model, without the lists of walls."""
    medium = foamprb.Medium(model.mu, pipe.RHO, (0.0, 0.0, 0.0))
    rules = [foamprb.Rebound() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
    models = foamprb.Models(
        material=model.material, integrator="stokes", forces=model.forces, surroundings=model.surroundings
    )
    cloud = foamprb.Cloud(p, flow, medium, rules, STEP, models, 1)
    cloud.advance(3)

    def cost() -> float:
        # The lists are made once per run.
        cloud.make_ready()
        return pipe.cost(cloud, steps)

    return cost


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step without and with each model, and the ratio, by place."""
    n, steps, repeats = (2000, 10, 3) if options.quick else (50_000, 20, 7)
    flow = foamprb.read_case(pipe.case("40k"))
    table = []
    for place, (d, low, high) in PLACES.items():
        models = MODELS | FAR if place == "far from walls" else MODELS
        clocks = {
            name: contestant(flow, particles(n, d, low, high, model.material), model, steps)
            for name, model in models.items()
        }
        costs = interleaved(clocks, repeats)
        ratios = {name: cost / costs["without"] for name, cost in costs.items() if name != "without"}
        table += rows("surroundings", f"cost, {place}", costs, "us/particle-step", n)
        table += rows("surroundings", f"over that without, {place}", ratios, "")
    return table
