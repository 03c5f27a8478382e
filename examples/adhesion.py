"""Adhesion: cells on a wall stick by bonds, which break the faster the larger the shear of the fluid is."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RADIUS, MU, T = 2e-6, 1e-3, 300.0  # m; viscosity of water, Pa s; K
ON, OFF, LENGTH = 2.0, 0.5, 4e-10  # rates of the bonds, 1/s; reactive length, m

water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, -9.81))
wall = foamprb.Adhere(kOn=ON, kOff=OFF, xb=LENGTH, T=T)
found, theory = {}, {}
for rate in (0.0, 100.0, 200.0):
    x = np.tile([0.0, 0.0, RADIUS * (1.0 + 1e-7)], (2000, 1))
    cells = foamprb.spheres(x, d=2.0 * RADIUS, rho=1100.0, mu=100.0)
    flow = foamprb.analytic.shear_over_wall(rate)
    models = foamprb.Models(integrator="stokes")
    cloud = foamprb.Cloud(cells, flow, water, [wall], 5e-3, models)
    times, shares = [], []
    for _ in range(20):
        cloud.advance(20)
        times.append(cloud.time)
        shares.append(np.mean(cells.status == foamprb.Status.STUCK))
    # Bell's rate, with the force of a shear flow on a sphere that is held at a wall.
    force = 1.7005 * 6.0 * np.pi * MU * RADIUS**2 * rate
    off = OFF * np.exp(force * LENGTH / (1.380649e-23 * T))
    theory[rate] = ON / (ON + off) * (1.0 - np.exp(-(ON + off) * np.array(times)))
    found[rate] = np.array(shares)
    print(f"{rate:g} 1/s: {found[rate][-1]:.1%} stick after 2 s, {cells.bonds.mean():.1f} changes of a cell")
    assert np.abs(found[rate] - theory[rate]).max() < 0.05

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (rate, shares), colour in zip(found.items(), ("#0072b2", "#009e73", "#d55e00"), strict=True):
    axes.plot(times, shares, "o", markersize=4, color=colour, label=f"{rate:g} 1/s")
    axes.plot(times, theory[rate], ":", color=colour)
axes.set(xlabel="time t [s]", ylabel="share of cells that stick", ylim=(0.0, 1.0))
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "adhesion.png", dpi=120)
