"""Migration: soft bodies that sink or rise in a vertical slit move across it, the softer the faster."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

HEIGHT, RADIUS, MU, RHO, SPEED = 0.02, 1e-3, 1.0, 1000.0, 1e-3  # m, m, Pa s, kg/m³; mean velocity, m/s
moduli, excess = np.array([1.0, 3.0, 1.0, 3.0]), np.array([200.0, 200.0, -200.0, -200.0])  # Pa, kg/m³
settling = 2.0 / 9.0 * RADIUS**2 * 9.81 * excess / MU
oil = foamprb.Medium(mu=MU, rho=RHO, gravity=(9.81, 0.0, 0.0))
models = foamprb.Models(integrator="stokes")

figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.2), layout="constrained", sharey=True)
for ax, way, speed in zip(axes, ("down", "up"), (SPEED, -SPEED), strict=True):
    flow = foamprb.analytic.slit(HEIGHT, speed)
    x = np.outer(np.ones(4), [0.0, 0.0, 0.3 * HEIGHT])
    bodies = foamprb.spheres(x, d=2.0 * RADIUS, rho=RHO + excess, mu=moduli, poissons_ratio=0.4999)
    cloud = foamprb.Cloud(bodies, flow, oil, [foamprb.Stick()] * 2, 0.5, models)
    times, places = [0.0], [bodies.x[:, 2] / HEIGHT]
    for _ in range(40):
        cloud.advance(10)
        times.append(cloud.time)
        places.append(bodies.x[:, 2] / HEIGHT)
    drift = (places[4] - places[3]) * HEIGHT / (times[4] - times[3])
    z = places[3] * HEIGHT
    Ca = MU * 6.0 * speed * (1.0 - 2.0 * z / HEIGHT) / HEIGHT / moduli
    print(f"flow {way}: drift over Ca v_s/4:", (drift / (0.25 * Ca * settling)).round(3))
    assert (np.sign(drift) == np.sign(speed * excess)).all()
    assert np.abs(drift / (0.25 * Ca * settling) - 1.0).max() < 0.05
    for k, (colour, style) in enumerate((("C1", "-"), ("C1", "--"), ("C0", "-"), ("C0", "--"))):
        name = f"{'heavy' if excess[k] > 0 else 'light'}, {moduli[k]:g} Pa"
        ax.plot(times, np.array(places)[:, k], style, color=colour, label=name)
    ax.set(xlabel="time [s]", title=f"flow {way}")
axes[0].set(ylabel="distance from the wall / width", ylim=(0.0, 0.55))
axes[0].legend(frameon=False, fontsize="small", loc="lower left")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "migration.png", dpi=120)
