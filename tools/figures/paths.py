"""Errors of the steps on paths through flows of OpenFOAM, beside what the correction of the velocity changes.

Usage: python tools/figures/paths.py CASE [CASE …], with solved cases. 32 tracers of 1 µm are followed, with
steps of a fifth of a cell at the largest speed and the default tolerance, for the case's size over its mean
speed. Prints a table of docs/flow.md: the distance to the ends of nearly exact paths (steps of a sixteenth,
tolerance 1e-9) over the length of the path, in the flow as it is read and without the correction that keeps
volume; and the distance between the exact paths of the two.
"""

from __future__ import annotations

import argparse
from pathlib import Path

import numpy as np
from followers import OPEN, interactions, seed
from numpy.typing import NDArray

from foamprb import Cloud, Medium, Models, Status, read_case, spheres
from foamprb.flow.meshflow import MeshFlow

NUMBER, DIAMETER, SAMPLES = 32, 1e-6, 40
"""Tracers, their diameter in m, and the points of a path that give its length."""


def follow(
    flow: MeshFlow, x: NDArray[np.float64], dt: float, steps: int, tolerance: float
) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.bool_]]:
    """Return the last places (n, 3), the lengths of the paths (n,), m, and which tracers are on their way."""
    models = Models(integrator="rosenbrock", tolerance=tolerance)
    bodies = spheres(x, d=DIAMETER, rho=1.0, mu=1.0)
    cloud = Cloud(bodies, flow, Medium(1e-5, 1.0, (0.0, 0.0, 0.0)), interactions(flow), dt, models)
    length, last = np.zeros(len(x)), x.copy()
    for _ in range(SAMPLES):
        cloud.advance(steps // SAMPLES)
        length += np.linalg.norm(cloud.particles.x - last, axis=1)
        last = cloud.particles.x.copy()
    return last, length, cloud.particles.status == Status.ACTIVE


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("cases", nargs="+", type=Path, metavar="CASE")
    options = parser.parse_args()
    print("| case | keeps volume | interpolated | between them |\n|---|---|---|---|")
    for case in options.cases:
        flow = read_case(case)
        _, u, l = flow.at_nodes()
        speeds = np.linalg.norm(u, axis=1)
        dt = 0.2 * float(np.cbrt(np.median(flow.mesh.volumes)) / speeds.max())
        time = float(np.max(flow.bounds[1] - flow.bounds[0]) / speeds[flow.mesh.n_points :].mean())
        steps = SAMPLES * round(time / dt / SAMPLES)
        x = seed(flow, NUMBER, any(patch.type == OPEN for patch in flow.patches))
        flows = flow, MeshFlow(flow.mesh, u, l.reshape(-1, 3, 3))
        exact = [follow(one, x, dt / 16.0, 16 * steps, 1e-9) for one in flows]
        found = [follow(one, x, dt, steps, 1e-4) for one in flows]
        cells = []
        for a, b in (*zip(found, exact, strict=True), exact):
            active = a[2] & b[2]
            error = (np.linalg.norm(a[0] - b[0], axis=1) / b[1])[active]
            cells.append(f"{np.median(error):.1e} / {error.max():.1e}")
        print(f"| {case.name} | {' | '.join(cells)} |", flush=True)


if __name__ == "__main__":
    main()
