"""Error against work of the integrators, in the air pipe of the paper and in a water pipe.

A particle in a pipe for a given time, steps of fixed size; the error is that of the deformation gradient and
of the position over the diameter, against a far finer run of the integrator of order 3 with inertia. Work
is the number of evaluations of the traction: one a step for the paper's scheme, three for the others. Writes
``integrators.csv`` and ``integrators.png``.

    python tools/figures/integrators.py --output docs
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import NamedTuple

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from validation.report import pyplot

import foamprb
from foamprb.body.imex import relaxation_time
from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.results.tables import write_table


class Pipe(NamedTuple):
    """Fluid in a pipe, particle, and time of tracking."""

    name: str
    mu: float
    rho_f: float
    rho_s: float
    wall_rate: float
    time: float
    capillary: float


AIR = Pipe("air", 1.208 * 1.491e-5, 1.208, 2560.0, 923.8, 0.02, 0.5)
WATER = Pipe("water", 1e-3, 1000.0, 1050.0, 923.8, 0.004, 0.5)
RADIUS, D = 2.1e-3, 5e-6
EVALUATIONS = {"paper": 1, "rosenbrock": 3, "stokes": 3}


def run(pipe: Pipe, integrator: str, steps: int) -> np.ndarray:
    """Return deformation gradient and position over the diameter at the end; NaN if the particle failed."""
    medium = foamprb.Medium(pipe.mu, pipe.rho_f, (0.0, -9.81, 0.0))
    flow = foamprb.analytic.pipe(RADIUS, pipe.wall_rate * RADIUS / 4)
    mu = pipe.mu * pipe.wall_rate / pipe.capillary
    particles = foamprb.spheres([[0.0, -1.65e-3, 0.0]], d=D, rho=pipe.rho_s, mu=mu, poissons_ratio=0.4999)
    # Released with the flow: a start from rest decays within the drag's relaxation time, all the same.
    particles.v[:] = flow.sample(particles.x, np.zeros(1, dtype=np.int32), 0.0)[0]
    walls = (foamprb.Stick(), foamprb.Escape(), foamprb.Escape())
    models = foamprb.Models(integrator=integrator, tolerance=np.inf)
    cloud = foamprb.Cloud(particles, flow, medium, walls, pipe.time / steps, models)
    cloud.advance(steps)
    if particles.status[0] != foamprb.Status.ACTIVE:
        return np.full(12, np.nan)
    return np.concatenate([particles.F[0], particles.x[0] / D])


def sweep(pipe: Pipe) -> list[tuple[str, str, int, float, float]]:
    """Return rows of pipe, integrator, evaluations, error of F, error of x/d."""
    tau = relaxation_time(pipe.rho_s, D / 2, pipe.mu)
    exact = run(pipe, "rosenbrock", 1 << 14)
    rows = []
    for integrator in INTEGRATORS:
        largest = tau if integrator == "paper" else 2.0 / pipe.wall_rate
        n = max(4, int(pipe.time / largest))
        for _ in range(9):
            state = run(pipe, integrator, n)
            error = np.abs(state - exact)
            rows.append(
                (pipe.name, integrator, n * EVALUATIONS[integrator], error[:9].max(), error[9:].max())
            )
            n *= 2
    return rows


def main() -> None:
    """Compute, write and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("--output", type=Path, default=Path("docs"))
    output = parser.parse_args().output
    rows = sweep(AIR) + sweep(WATER)
    names = ("pipe", "integrator", "evaluations", "error of F", "error of x/d")
    write_table(output / "integrators.csv", dict(zip(names, map(list, zip(*rows, strict=True)), strict=True)))
    for pipe in (AIR, WATER):
        for target in (1e-2, 1e-3):
            least = {
                i: min(
                    (n for p, name, n, e, _ in rows if (p, name) == (pipe.name, i) and e < target),
                    default=None,
                )
                for i in INTEGRATORS
            }
            print(f"{pipe.name}: evaluations for an error of F below {target:g}: {least}")
    plot(rows, output / "integrators.png")


def plot(rows: list[tuple[str, str, int, float, float]], file: Path) -> None:
    """Plot the error of the deformation gradient against work, one panel per pipe."""
    figure, panels = pyplot().subplots(1, 2, figsize=(9, 4), sharey=True, layout="constrained")
    for panel, pipe in zip(panels, (AIR, WATER), strict=True):
        for integrator in INTEGRATORS:
            points = [(n, e) for p, i, n, e, _ in rows if (p, i) == (pipe.name, integrator)]
            panel.loglog(*zip(*points, strict=True), "o-", ms=4, label=integrator)
        number = pipe.wall_rate * relaxation_time(pipe.rho_s, D / 2, pipe.mu)
        panel.set(
            title=f"{pipe.name}, γ̇τ = {number:.2g} at the wall, {pipe.time * pipe.wall_rate:.3g} shear times",
            xlabel="evaluations of the traction",
        )
        panel.grid(alpha=0.3)
    panels[0].set_ylabel("error of the deformation gradient")
    panels[0].legend(frameon=False)
    figure.savefig(file, dpi=130)


if __name__ == "__main__":
    main()
