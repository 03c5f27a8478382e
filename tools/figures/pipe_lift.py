"""Landing distance in the paper's pipe with wall lift and hindrance; for docs/pipe.md.

The exact Poiseuille flow and the particle of Sect. 5.4, without inertia of the solid. Prints, for each Ca,
the landing distance in diameters, or the height of the centre over the wall, in radii, at the end.

    python tools/figures/pipe_lift.py
"""

from __future__ import annotations

import argparse

import numpy as np
from pipe_distance import DIAMETER, NU, POISSONS_RATIO, RADIUS, RHO, WALL_SHEAR_RATE

import foamprb
from foamprb.cloud.tracker import Models

CAPILLARY = np.array([1e-4, 0.25, 0.5, 0.75, 1.0])
SURROUNDINGS = {
    "without": (),
    "lift, mobility no": (foamprb.WallLift(mobility=False),),
    "with mobility yes": (foamprb.WallLift(mobility=True),),
}


def particles_after(seconds: float, dt: float, around: tuple[foamprb.WallLift, ...]) -> foamprb.Particles:
    """Return the particles of CAPILLARY after a time, s, in tracking steps dt, s."""
    flow = foamprb.analytic.pipe(RADIUS, WALL_SHEAR_RATE * RADIUS / 4)
    medium = foamprb.Medium(RHO * NU, RHO, (0.0, -9.81, 0.0))
    start = np.tile([0.0, -1.65e-3, 0.0], (len(CAPILLARY), 1))
    mu = medium.mu * WALL_SHEAR_RATE / CAPILLARY
    particles = foamprb.spheres(start, d=DIAMETER, rho=2560.0, mu=mu, poissons_ratio=POISSONS_RATIO)
    interactions = [foamprb.Stick() if p.type == "wall" else foamprb.Escape() for p in flow.patches]
    models = Models(integrator="stokes", surroundings=around)
    foamprb.Cloud(particles, flow, medium, interactions, dt, models).advance(round(seconds / dt))
    return particles


def main() -> None:
    """Compute and print."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("--dt", type=float, default=2e-4, help="tracking step, s [2e-4]")
    parser.add_argument("--time", type=float, default=2.0, help="end, s [2]")
    options = parser.parse_args()
    print("| Ca | " + " | ".join(f"{Ca:g}" for Ca in CAPILLARY) + " |")
    print("|---" * (len(CAPILLARY) + 1) + "|")
    for name, around in SURROUNDINGS.items():
        p = particles_after(options.time, options.dt, around)
        height = 2.0 * (RADIUS - np.hypot(p.x[:, 1], p.x[:, 2])) / DIAMETER
        landed = p.status == foamprb.Status.STUCK
        words = [
            f"{x:.0f}" if is_there else f"at {h:.2f} radii after {options.time:g} s"
            for x, h, is_there in zip(p.x[:, 0] / DIAMETER, height, landed, strict=True)
        ]
        print(f"| {name} | " + " | ".join(words) + " |")


if __name__ == "__main__":
    main()
