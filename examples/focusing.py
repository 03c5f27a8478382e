"""Focusing: neutral bodies in a plane channel, by inertia of the fluid and by the walls."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

HEIGHT, RADIUS, RATE, MU = (
    1e-4,
    5e-6,
    1e4,
    1e-3,
)  # m, m; shear rate at the walls, 1/s; viscosity of water, Pa s

flow = foamprb.analytic.slit(HEIGHT, RATE * HEIGHT / 6.0)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
inertia = foamprb.DuctLift(
    shape="channel", origin=(0, 0, HEIGHT / 2), direction=(0, 0, 1), size=HEIGHT / 2, shearRate=RATE
)
walls = foamprb.WallLift(cutOff=20.0, mobility=False)
models = foamprb.Models(integrator="stokes", forces=(inertia,), surroundings=(walls,), stride=20)
starts, capillary = np.array([0.15, 0.3, 0.45]), np.array([1e-4, 0.3])
x = np.zeros((6, 3))
x[:, 2] = HEIGHT * np.tile(starts, 2)
bodies = foamprb.spheres(x, d=2.0 * RADIUS, rho=1000.0, mu=MU * RATE / np.repeat(capillary, 3))
cloud = foamprb.Cloud(bodies, flow, water, [foamprb.Stick()] * 2, 1e-4, models)
times, places = [0.0], [bodies.x[:, 2] / HEIGHT]
for _ in range(60):
    cloud.advance(50)
    times.append(cloud.time)
    places.append(bodies.x[:, 2] / HEIGHT)

places = np.array(places)
print(
    "rigid bodies gather at", places[-1, :3].round(4), "of the height, soft ones at", places[-1, 3:].round(4)
)
assert abs(places[-1, :3] - 0.183).max() < 0.002
assert np.ptp(places[-1, 3:]) < 1e-3
assert places[-1, 3:].min() > 0.22

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for k, (colour, name) in enumerate((("#888888", "rigid"), ("#d55e00", "Ca = 0.3 at the walls"))):
    axes.plot(times, places[:, 3 * k], color=colour, label=name)
    axes.plot(times, places[:, 3 * k + 1 : 3 * k + 3], color=colour)
axes.set(xlabel="time [s]", ylabel="distance from the wall / height", ylim=(0.1, 0.5))
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "focusing.png", dpi=120)
