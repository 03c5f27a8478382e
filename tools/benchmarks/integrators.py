"""A 5 µm particle in water: cost of each integrator for the same time and error."""

from __future__ import annotations

import numpy as np
from figures import integrators as study

import foamprb
from benchmarks import pipe
from benchmarks.records import Options, Row, interleaved, rows
from foamprb.body.imex import relaxation_time

ERRORS = {"error of F 1e-3": 1e-3, "error of F 3e-4": 3e-4}
_FINER = 1.15


def fewest_steps(integrator: str, exact: np.ndarray, largest: float) -> int:
    """Return the number of fixed steps, to a seventh, with an error of F below ``largest``."""
    tau = relaxation_time(study.WATER.rho_s, study.D / 2, study.WATER.mu)
    n = 8.0 if integrator != "paper" else 0.4 * study.WATER.time / tau
    while True:
        state = study.run(study.WATER, integrator, round(n))
        if np.abs(state - exact)[:9].max() < largest:
            return round(n)
        n *= _FINER


def measure(options: Options) -> list[Row]:
    """Measure steps, CPU per step and CPU per particle."""
    n, repeats = (2000, 2) if options.quick else (50_000, 5)
    flow = foamprb.read_case(pipe.case("40k"))
    exact = study.run(study.WATER, "rosenbrock", 1 << (14 if options.quick else 17))
    table = []
    for name, largest in list(ERRORS.items())[: 1 if options.quick else None]:
        steps = {i: fewest_steps(i, exact, largest) for i in ("paper", "rosenbrock", "stokes")}
        clocks = {}
        for integrator, number in steps.items():
            cloud = pipe.soft_cloud(flow, n, study.WATER.time / number, integrator, fluid=pipe.WATER)
            cloud.advance(5)
            clocks[integrator] = lambda c=cloud: pipe.cost(c, 20)
        costs = interleaved(clocks, repeats)
        totals = {integrator: costs[integrator] * number for integrator, number in steps.items()}
        table += rows("integrators", f"steps, {name}", {k: float(v) for k, v in steps.items()}, "")
        table += rows("integrators", f"cost of a step, {name}", costs, "us/particle-step")
        table += rows("integrators", f"cost of 4 ms, {name}", totals, "us/particle")
        table += rows(
            "integrators", "cost of paper over stokes", {name: totals["paper"] / totals["stokes"]}, ""
        )
    return table
