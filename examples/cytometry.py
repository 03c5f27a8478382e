"""Deformability cytometry: stiffness of bodies in a narrow channel from the outlines in a camera image."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb
from foamprb.cloudfunctions.deformability_cytometry import outline

HEIGHT, SPEED, MU = 3e-5, 0.05, 15e-3  # height of the channel, m; mean velocity, m/s; viscosity, Pa s
RADIUS = 5e-6

stiffness = np.geomspace(200.0, 5000.0, 9)  # shear moduli, Pa
heights = np.full(9, 0.25 * HEIGHT)  # midway between centre and wall
flow = foamprb.analytic.slit(HEIGHT, SPEED)
x = np.stack([np.zeros(9), np.zeros(9), heights], axis=1)
bodies = foamprb.spheres(x, d=2.0 * RADIUS, rho=1000.0, mu=stiffness)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
walls = [foamprb.Rebound()] * len(flow.patches)
cloud = foamprb.Cloud(bodies, flow, water, walls, 1e-6, foamprb.Models(integrator="stokes"))
cloud.advance(1000)

seen = outline(bodies, np.array([0.0, 1.0, 0.0]))
rate = np.abs(flow.sample(bodies.x, bodies.host, cloud.time)[1][:, 0, 2])
# D = 5/4 Ca for small deformations, and 1 − 2 √(πA)/P = 3/4 D² for a nearly circular ellipse.
expected = 0.75 * (1.25 * MU * rate / stiffness) ** 2
measured = 1.25 * MU * rate / np.sqrt(seen.deformation / 0.75)
print("shear modulus from the outline over the true one:", (measured / stiffness).round(3))
assert abs(measured[-1] / stiffness[-1] - 1.0) < 0.002

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.loglog(stiffness, seen.deformation, "o", color="#0072b2", label="foamprb")
axes.loglog(stiffness, expected, "--", color="#d55e00", label="small deformations, 3/4 (5/4 Ca)²")
axes.set(xlabel="shear modulus [Pa]", ylabel="1 − 2 √(πA)/P")
axes.set_xticks([200, 500, 1000, 2000, 5000], ["200", "500", "1000", "2000", "5000"])
axes.minorticks_off()
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "cytometry.png", dpi=120)
