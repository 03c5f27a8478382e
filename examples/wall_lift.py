"""Wall lift: soft bodies in shear rise with the cube root of time; a stiff one keeps its height."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, MU, RADIUS = 100.0, 1e-3, 5e-6  # shear rate, 1/s; viscosity of water, Pa s; m

capillary = np.array([1e-3, 0.1, 0.2])
x = np.tile([0.0, 0.0, 4.0 * RADIUS], (3, 1))
flow = foamprb.analytic.shear_over_wall(RATE)
bodies = foamprb.spheres(x, d=2.0 * RADIUS, rho=1000.0, mu=MU * RATE / capillary)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
models = foamprb.Models(integrator="stokes", surroundings=(foamprb.WallLift(cutOff=1000.0),))
cloud = foamprb.Cloud(bodies, flow, water, [foamprb.Stick()], 2e-4, models)
times, heights = [], []
for _ in range(60):
    cloud.advance(500)
    times.append(cloud.time)
    heights.append(bodies.x[:, 2] / RADIUS)
times, heights = np.array(times), np.array(heights)

# The lift is proportional to 1/h², so h³ grows linearly.
late = heights[20:] ** 3
slope = [np.polyfit(times[20:], h, 1) for h in late.T[1:]]
bend = [np.abs(np.polyval(s, times[20:]) - h).max() / h.max() for s, h in zip(slope, late.T[1:], strict=True)]
print("after 6 s at", heights[-1].round(2), "radii; h³ departs from a line by", np.round(bend, 5))
assert max(bend) < 5e-3
print("twice as soft, so much faster:", (slope[1][0] / slope[0][0]).round(3))
assert abs(slope[1][0] / slope[0][0] - 2.0) < 0.05  # for small deformations the lift is proportional to Ca
assert heights[-1, 0] < 4.05

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for Ca, h, colour in zip(capillary, heights.T, ("#888888", "#0072b2", "#d55e00"), strict=True):
    axes.plot(times, h, color=colour, label=f"Ca = {Ca:g}")
axes.set(xlabel="time t [s]", ylabel="height in radii")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "wall_lift.png", dpi=120)
