"""Cost of models of a particle's surroundings: walls near and far, molecules, curved flows."""

from __future__ import annotations

import numpy as np

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, cpu_of, interleaved, rows

STEP = 1e-4
MODELS = {
    "without": (),
    "wallLift": (foamprb.WallLift(),),
    "BrownianMotion": (foamprb.BrownianMotion(T=293.15),),
    "faxenCorrection": (foamprb.FaxenCorrection(),),
}
PLACES = {
    "far from walls": (pipe.D, 0.0, 0.9),
    "within 10 radii of the wall": (pipe.D, 1.0 - 5.0 * pipe.D / pipe.RADIUS, 1.0 - pipe.D / pipe.RADIUS),
    "a tenth of the pipe's radius wide": (0.2 * pipe.RADIUS, 0.0, 0.8),
}
"""Diameters, m, and between which distances from the axis particles begin, over the pipe's radius."""


def particles(n: int, d: float, low: float, high: float) -> foamprb.Particles:
    """Return n stiff particles of the fluid's density in the first third of the pipe."""
    random = np.random.default_rng(0)
    r = pipe.RADIUS * np.sqrt(low**2 + (high**2 - low**2) * random.random(n))
    angle, x = 2.0 * np.pi * random.random(n), pipe.LENGTH / 3.0 * (0.01 + 0.99 * random.random(n))
    places = np.stack([x, r * np.cos(angle), r * np.sin(angle)], axis=1)
    p = foamprb.spheres(places, d=d, rho=pipe.RHO, mu=pipe.RHO * pipe.NU * pipe.WALL_RATE / 0.01)
    p.v[:] = pipe.poiseuille(places)
    return p


class Contestant:
    """A cloud with one of the models, ready to go."""

    def __init__(self, flow, p: foamprb.Particles, models: tuple, steps: int) -> None:
        medium = foamprb.Medium(pipe.RHO * pipe.NU, pipe.RHO, (0.0, 0.0, 0.0))
        rules = [foamprb.Rebound() if patch.type == "wall" else foamprb.Escape() for patch in flow.patches]
        chosen = foamprb.Models(integrator="stokes", surroundings=models)
        self.cloud, self.steps = foamprb.Cloud(p, flow, medium, rules, STEP, chosen, 1), steps
        self.cloud.advance(3)

    def cost(self) -> float:
        """Measure CPU µs per particle-step, without the lists of walls, made once per run."""
        self.cloud.make_ready()
        before = pipe.particle_steps(self.cloud)
        spent = cpu_of(lambda: self.cloud.advance(self.steps))
        return 1e6 * spent / (pipe.particle_steps(self.cloud) - before)


def measure(options: Options) -> list[Row]:
    """Measure cost per particle-step without and with each model, and the ratio, by place."""
    n, steps, repeats = (2000, 10, 3) if options.quick else (50_000, 20, 7)
    flow = foamprb.read_case(pipe.case("40k"))
    found = []
    for place, (d, low, high) in PLACES.items():
        clocks = {
            name: Contestant(flow, particles(n, d, low, high), models, steps).cost
            for name, models in MODELS.items()
        }
        costs = interleaved(clocks, repeats)
        ratios = {name: cost / costs["without"] for name, cost in costs.items() if name != "without"}
        found += rows("surroundings", f"cost, {place}", costs, "us/particle-step", n)
        found += rows("surroundings", f"over that without, {place}", ratios, "")
    return found
