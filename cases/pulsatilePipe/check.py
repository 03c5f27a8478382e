"""Errors of the pulsating flow against Womersley's solution, and of particles against the exact flow.

Reads the flows of ``Allrun``, one folder per mesh. The first table compares velocity and shear rate with the
exact ones, at random points and all written times. The second tracks the particles of
``constant/softCloudProperties`` through the files, with all written times or fewer, and through the exact
flow: errors of position and shape after one period and after four.

    ./Allrun coarse; ./Allrun medium; ./Allrun fine
    python check.py coarse medium fine
"""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.special import jv

import foamprb

Floats = NDArray[np.float64]

RADIUS, LENGTH, NU, PERIOD = 2e-3, 0.06, 2e-6, 1.0
STEADY, OSCILLATING = 0.02, 0.06
"""Pressure gradient over density, m/s²: mean, and amplitude of sin(2π t/T)."""
OMEGA = 2.0 * np.pi / PERIOD
MEAN_VELOCITY = STEADY * RADIUS**2 / (8.0 * NU)
STRIDES = (1, 2, 4, 8)


TERMS = np.cumprod(np.append(1.0, 0.25j * RADIUS**2 * OMEGA / NU / np.arange(1, 40) ** 2))
"""Of the series of J₀(i^{3/2} α r/R) in (r/R)², with the Womersley number α."""
PROFILE = np.append(1.0, np.zeros(39)) - TERMS / TERMS.sum()
REAL, IMAGINARY = (tuple(part[::-1].tolist()) for part in (PROFILE.real, PROFILE.imag))


def velocity(x: float, y: float, z: float, t: float) -> tuple[float, float, float]:
    """Return the exact velocity, m/s."""
    s = (y * y + z * z) / RADIUS**2
    real = imaginary = 0.0 * s
    for k in range(40):
        real, imaginary = real * s + REAL[k], imaginary * s + IMAGINARY[k]
    swing = OSCILLATING / OMEGA * (imaginary * np.sin(OMEGA * t) - real * np.cos(OMEGA * t))
    return 2.0 * MEAN_VELOCITY * (1.0 - s) + swing, 0.0 * x, 0.0 * x


def womersley(r: Floats, t: float) -> tuple[Floats, Floats]:
    """Return u, m/s, and ∂u/∂r, 1/s, at the radii r, m, and at time t, s."""
    k = 1j**1.5 * np.sqrt(OMEGA / NU)
    swing = OSCILLATING / (1j * OMEGA) * np.exp(1j * (OMEGA * t - 0.5 * np.pi))
    u = 2.0 * MEAN_VELOCITY * (1.0 - (r / RADIUS) ** 2)
    u = u + (swing * (1.0 - jv(0, k * r) / jv(0, k * RADIUS))).real
    slope = -4.0 * MEAN_VELOCITY * r / RADIUS**2 + (swing * k * jv(1, k * r) / jv(0, k * RADIUS)).real
    return u, slope


class FlowErrors(NamedTuple):
    """Relative errors in the core (r < 0.9 R) and near the wall."""

    u: tuple[float, float]
    """rms, relative to the largest velocity of the period."""
    slope: tuple[float, float]
    """rms of ∂u/∂r, relative to the largest value at the wall in the period."""


def flow_errors(case: Path, n: int = 2000) -> FlowErrors:
    """Compare the flow at its written times with the exact one, away from the ends."""
    times = foamprb.select_times(case, "3:4")
    flow = foamprb.read_series(case, "3:4")
    random = np.random.default_rng(1)
    r, phi = 0.99 * RADIUS * np.sqrt(random.random(n)), 2.0 * np.pi * random.random(n)
    x = np.stack([LENGTH * random.uniform(0.2, 0.8, n), r * np.cos(phi), r * np.sin(phi)], axis=1)
    hosts = flow.locate(x)
    x, r, phi, hosts = x[hosts >= 0], r[hosts >= 0], phi[hosts >= 0], hosts[hosts >= 0]
    errors, largest = [], np.zeros(2)
    for time in map(float, times):
        u, l = flow.sample(x, hosts, time)
        exact = womersley(r, time)
        slope = l[:, 0, 1] * np.cos(phi) + l[:, 0, 2] * np.sin(phi)
        errors.append((u[:, 0] - exact[0], slope - exact[1]))
        edge = womersley(np.linspace(0.0, RADIUS, 50), time)
        largest = np.maximum(largest, [np.abs(edge[0]).max(), np.abs(edge[1]).max()])
    squares = np.mean(np.square(errors), axis=0)
    core = r < 0.9 * RADIUS
    rms = [[float(np.sqrt(part[where].mean()) / size) for where in (core, ~core)]
           for part, size in zip(squares, largest, strict=True)]  # fmt: skip
    return FlowErrors(tuple(rms[0]), tuple(rms[1]))


class Track(NamedTuple):
    """Places and shapes of the particles."""

    x: Floats
    """Positions after one period and at the end, (2, n, 3), m."""
    F: Floats
    """Deformation gradients at the same times, (2, n, 9)."""


def track(cloud: foamprb.Cloud, periods: int = 4) -> Track:
    """Advance the particles by ``periods``."""
    places, shapes = [], []
    for step in (1, periods - 1):
        cloud.advance(round(step * PERIOD / cloud.dt))
        places.append(cloud.particles.x.copy())
        shapes.append(cloud.particles.F.copy())
    if not (cloud.particles.status == foamprb.Status.ACTIVE).all():
        raise SystemExit(f"particles were lost: {cloud.particles.counts()}")
    return Track(np.array(places), np.array(shapes))


def in_files(case: Path, stride: int = 1) -> foamprb.Cloud:
    """Return the particles in the case's flow, with every ``stride``-th written time of the last period."""
    return foamprb.prepare(case, " ".join(foamprb.select_times(case, "3:4")[::stride])).cloud


def in_exact_flow(cloud: foamprb.Cloud) -> foamprb.Cloud:
    """Return the same particles at their start, in the flow in closed form."""
    flow = foamprb.analytic.function(velocity, length=RADIUS, time=PERIOD)
    p = cloud.particles.take(np.arange(cloud.particles.size))
    p.host[:] = -1
    return foamprb.Cloud(p, flow, cloud.medium, [], cloud.dt, cloud.models, cloud.threads, start=cloud.start)


def distances(a: Track, b: Track) -> Floats:
    """Return the largest distance of positions, m, and of deformation gradients, at both times: (2, 2)."""
    return np.array([np.linalg.norm(p - q, axis=-1).max(axis=1) for p, q in zip(a, b, strict=True)])


def main() -> None:
    """Print the tables."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("cases", type=Path, nargs="+", metavar="CASE", help="from coarse to fine")
    cases = parser.parse_args().cases
    print("Errors of the flow, rms, in % of the largest velocity and of the largest wall shear rate\n")
    print("| mesh | u core | u wall | ∂u/∂r core | ∂u/∂r wall |\n|---|---|---|---|---|")
    for case in cases:
        e = flow_errors(case)
        print(f"| {case.name} |" + "".join(f" {100 * value:.2f} |" for value in (*e.u, *e.slope)))
    print("\nLargest errors of the particles: position, in % of the longest way, and deformation gradient\n")
    print("| mesh | times in a period | x, 1 period | x, 4 periods | F, 1 period | F, 4 periods |")
    print("|---" * 6 + "|")
    cloud = in_exact_flow(in_files(cases[0]))
    exact = track(cloud)
    moved = np.abs(cloud.particles.x - cloud.particles.x0).max()
    for case in cases:
        for stride in STRIDES:
            error = distances(track(in_files(case, stride)), exact) / [[moved], [1.0]]
            n = (len(foamprb.select_times(case, "3:4")) - 1) // stride
            print(f"| {case.name} | {n} | {100 * error[0, 0]:.2f} | {100 * error[0, 1]:.2f} |"
                  f" {error[1, 0]:.4f} | {error[1, 1]:.4f} |")  # fmt: skip
    shape = np.abs(exact.F - np.eye(3).ravel()).max()
    print(f"\nThe particles move by up to {1e3 * moved:.1f} mm; their F differs from 1 by up to {shape:.2f}.")


if __name__ == "__main__":
    main()
