"""A run of Parcels 3 (OceanParcels): massless points in Poiseuille flow, on a structured field.

    mpirun -np 2 python tools/benchmarks/parcels_run.py 1050624 500000 50

It needs Parcels alone, with mpi4py for several processes. Every process holds the field; Parcels distributes
the particles.
"""

from __future__ import annotations

import argparse

import numpy as np

RADIUS, LENGTH, MEAN, DT = 2.1e-3, 0.06, 0.485, 1e-4


def run(cells: int, n: int, steps: int) -> None:
    """Advance n points by the method of Runge and Kutta of fourth order."""
    import parcels

    side = round(cells ** (1.0 / 3.0)) + 1
    x, y = np.linspace(0.0, LENGTH, side), np.linspace(-RADIUS, RADIUS, side)
    square = y[None, :, None] ** 2 + y[:, None, None] ** 2
    # Parcels' times have a resolution of a microsecond: a step is its second.
    speed = DT * 2.0 * MEAN * np.maximum(0.0, 1.0 - square / RADIUS**2) * np.ones(side)
    fields = {"U": speed.astype(np.float32)}
    fields |= {name: np.zeros_like(fields["U"]) for name in ("V", "W")}
    flow = parcels.FieldSet.from_data(fields, {"lon": x, "lat": y, "depth": y}, mesh="flat")
    random = np.random.default_rng(0)
    r, angle = 0.95 * RADIUS * np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    start = {"lon": 0.9 * LENGTH * random.random(n), "lat": r * np.cos(angle), "depth": r * np.sin(angle)}
    particles = parcels.ParticleSet(flow, pclass=parcels.JITParticle, **start)
    particles.execute(parcels.AdvectionRK4_3D, runtime=float(steps), dt=1.0, verbose_progress=False)


def main() -> None:
    """Run."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    for name in ("cells", "particles", "steps"):
        parser.add_argument(name, type=int)
    options = parser.parse_args()
    run(options.cells, options.particles, options.steps)


if __name__ == "__main__":
    main()
