"""Swimming: bacteria keep their direction for a third of a second, and then diffuse ninety times as fast."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RADIUS, SPEED, MU, T = 0.5e-6, 20e-6, 0.89e-3, 298.15  # m; m/s; viscosity of water, Pa s; K
KT = 1.380649e-23 * T

turns, moves = KT / (8.0 * np.pi * MU * RADIUS**3), KT / (6.0 * np.pi * MU * RADIUS)
flow = foamprb.analytic.linear(np.zeros((3, 3)))
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
molecules = foamprb.BrownianMotion(T=T)
found = {}
for name, models in (
    ("swimmers", (molecules, foamprb.Swimming(speed=SPEED))),
    ("without swimming", (molecules,)),
):
    bodies = foamprb.spheres(np.zeros((2000, 3)), d=2.0 * RADIUS, rho=1000.0, mu=1e5)
    chosen = foamprb.Models(integrator="stokes", surroundings=models)
    cloud = foamprb.Cloud(bodies, flow, water, [], 0.01, chosen)
    times, squares = [], []
    for steps in (1, 1, 2, 4, 8, 16, 32, 64, 128, 256, 488):
        cloud.advance(steps)
        times.append(cloud.time)
        squares.append((bodies.x**2).sum(axis=1).mean())
    found[name] = np.array(squares)

x = 2.0 * turns * np.array(times)
theory = {"without swimming": 6.0 * moves * np.array(times)}
theory["swimmers"] = theory["without swimming"] + 2.0 * (SPEED / (2.0 * turns)) ** 2 * (x + np.expm1(-x))
for name, squares in found.items():
    off = np.abs(squares / theory[name] - 1.0).max()
    print(f"{name}: {squares[-1]:.3g} m2 after 10 s, at most {off:.1%} from the theory")
    assert off < 0.1

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (name, squares), colour in zip(found.items(), ("#d55e00", "#0072b2"), strict=True):
    axes.loglog(times, squares, "o", color=colour, label=name)
    axes.loglog(times, theory[name], ":", color=colour)
axes.set(xlabel="time t [s]", ylabel="mean square displacement [m²]")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "swimming.png", dpi=120)
