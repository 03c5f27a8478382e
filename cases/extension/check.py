"""Deformation of the beads along the axis against theory, and mesh convergence.

Tracks the beads of ``constant/softCloudProperties`` through the flows of ``Allrun``, one folder per mesh.
Prints the deformation D = (a − c)/(a + c) on the finest mesh, with that of an elastic sphere at small
deformation, and D at the same stations on every mesh.

    ./Allrun coarse; ./Allrun medium; ./Allrun fine
    python check.py coarse medium fine
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

import foamprb

Floats = NDArray[np.float64]

STATIONS = 1e-6 * np.array([1300.0, 1400.0, 1450.0, 1500.0, 1525.0, 1550.0, 1600.0, 1650.0])
"""x, m. The cone extends from 1500 to 1560 µm."""
INTERVAL = 2e-5
"""Time between two points of a track, s: the beads move by no more than 7 µm."""


class Axis(NamedTuple):
    """Flow on the axis."""

    x: Floats
    """m, from the release of the beads to the outlet."""
    u: Floats
    """Velocity along x, m/s."""
    rate: Floats
    """∂u/∂x, 1/s."""


class Track(NamedTuple):
    """Path and deformation of one bead."""

    name: str
    """Its injection model."""
    mu: float
    """Shear modulus, Pa."""
    x: Floats
    """Positions along the axis, m."""
    D: Floats
    """Deformation there."""


def axis(job: foamprb.Job, points: int = 2000) -> Axis:
    """Sample the flow on the path of the beads."""
    flow, start = job.cloud.flow, job.cloud.particles.x0[0, 0]
    outlet = flow.patch_faces("outlet", 0.0).vertices[..., 0].min()
    x = np.linspace(start, outlet - 1e-3 * (outlet - start), points)
    places = np.zeros((points, 3))
    places[:, 0] = x
    u, gradient = flow.sample(places, flow.locate(places), 0.0)
    return Axis(x, u[:, 0], gradient[:, 0, 0])


def track(job: foamprb.Job) -> list[Track]:
    """Advance the beads to the outlet; return places and deformations, one track per bead."""
    cloud, solution = job.cloud, job.settings.solution
    x, D = [], []
    while cloud.time < solution.endTime and (cloud.particles.status <= foamprb.Status.ACTIVE).all():
        cloud.advance(round(INTERVAL / solution.deltaT))
        values = foamprb.measure(foamprb.context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time))
        x.append(cloud.particles.x[:, 0].copy())
        D.append(values["taylorDeformation"])
    if not (cloud.particles.status == foamprb.Status.ESCAPED).any():
        raise SystemExit(f"{job.settings.case}: no bead reached the outlet: {cloud.particles.counts()}")
    names = [injection.name for injection in job.settings.injections]
    return [
        Track(names[k], mu, np.array(x)[:, i], np.array(D)[:, i])
        for i, (k, mu) in enumerate(zip(cloud.particles.injector, cloud.particles.mu, strict=True))
    ]


def small_deformation(flow: Axis, viscosity: float, mu: float, x: Floats) -> Floats:
    """Return D at x of an elastic sphere without inertia, to first order in its strain.

    Its rate of strain is 5/3 d_f − σ′/(3 μ_f) with σ′ = 2 μ ε. The strain ε along the axis therefore relaxes
    towards (5/2) (μ_f/μ) ∂u/∂x with the time constant (3/2) μ_f/μ as the sphere moves with the liquid. The
    strain across the axis is −ε/2, which keeps the volume, and D = 3/4 ε.
    """
    time = 1.5 * viscosity / mu

    def slope(place: float, strain: Floats) -> Floats:
        rate = np.interp(place, flow.x, flow.rate)
        return (2.5 * viscosity / mu * rate - strain) / (time * np.interp(place, flow.x, flow.u))

    solution = solve_ivp(
        slope, flow.x[[0, -1]], [0.0], "Radau", dense_output=True, rtol=1e-6, atol=1e-9,
        max_step=5e-6, jac=lambda place, _: [[-1.0 / (time * np.interp(place, flow.x, flow.u))]],
    )  # fmt: skip
    return 0.75 * solution.sol(x)[0]


def at(bead: Track, x: Floats) -> Floats:
    """Return D of a bead at x."""
    D: Floats = CubicSpline(bead.x, bead.D)(x)
    return D


def report(cases: list[Path]) -> str:
    """Return both tables, in Markdown."""
    jobs = [foamprb.prepare(case) for case in cases]
    tracks = [track(job) for job in jobs]
    flow, viscosity, beads = axis(jobs[-1]), jobs[-1].cloud.medium.mu, tracks[-1]
    columns = [np.interp(STATIONS, flow.x, flow.rate)]
    for bead in beads:
        columns += [at(bead, STATIONS), small_deformation(flow, viscosity, bead.mu, STATIONS)]
    lines = [f"D on the mesh {cases[-1].name}, and by the theory of small deformation", ""]
    lines.append("| x, µm | ∂u/∂x, 1/s |" + "".join(f" {bead.name} | theory |" for bead in beads))
    lines.append("|---" * (2 + 2 * len(beads)) + "|")
    for x, rate, *D in zip(STATIONS, *columns, strict=True):
        lines.append(f"| {1e6 * x:.0f} | {rate:.1f} |" + "".join(f" {d:.5f} |" for d in D))
    lines += ["", f"D of the bead {beads[0].name}, by mesh and x, µm", ""]
    lines.append("| mesh |" + "".join(f" {1e6 * x:.0f} |" for x in STATIONS) + " largest |")
    lines.append("|---" * (2 + len(STATIONS)) + "|")
    for case, (bead, *_) in zip(cases, tracks, strict=True):
        D = [*at(bead, STATIONS), bead.D.max()]
        lines.append(f"| {case.name} |" + "".join(f" {d:.5f} |" for d in D))
    return "\n".join(lines)


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=Path, nargs="+", metavar="CASE", help="from coarse to fine")
    print(report(parser.parse_args().cases))


if __name__ == "__main__":
    main()
