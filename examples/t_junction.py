"""End wall of a T-junction: soft spheres approach it and turn to the left or to the right."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

K, MU = 5e4, 1e-3  # flow constant, 1/(m s); viscosity of water, Pa s


def parting(x, y, z):
    """Return the Stokes flow against the wall y = 0, with the stream function K x y², m/s."""
    return 2.0 * 5e4 * x * y, -5e4 * y * y, 0.0 * z


starts = np.array([-6e-5, -2e-5, -5e-6, 5e-6, 2e-5, 6e-5])
x0 = np.stack([starts, np.full(6, 1e-3), np.zeros(6)], axis=1)
bodies = foamprb.spheres(x0, d=1e-5, rho=1000.0, mu=1.0)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
flow = foamprb.analytic.function(parting, length=1e-3)
cloud = foamprb.Cloud(bodies, flow, water, [], 1e-4, foamprb.Models(integrator="stokes"))
paths, D = [bodies.x.copy()], [np.zeros(6)]
for _ in range(250):
    cloud.advance(8)
    stretch = np.linalg.svd(bodies.F.reshape(-1, 3, 3), compute_uv=False)
    paths.append(bodies.x.copy())
    D.append((stretch[:, 0] - stretch[:, 2]) / (stretch[:, 0] + stretch[:, 2]))
x, y = np.array(paths)[:, :, 0], np.array(paths)[:, :, 1]

assert (np.sign(x[-1]) == np.sign(starts)).all()  # flow and bodies have the same dividing line
drift = np.abs(x * y * y / (x[0] * y[0] ** 2) - 1.0).max()
print(f"away from the streamline: {100 * drift:.3f} %; largest D {np.max(D):.3f}")
assert drift < 3e-3  # effect of inertia
assert np.max(np.abs(np.array(D) - np.array(D)[:, ::-1])) < 1e-9  # symmetric

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
shown = axes.scatter(1e3 * x, 1e3 * y, c=np.array(D), s=4, cmap="viridis")
figure.colorbar(shown, label="Taylor deformation D")
axes.set(xlabel="x [mm]", ylabel="height over the wall y [mm]", xlim=(-2.6, 2.6), ylim=(0, 1.05))
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "t_junction.png", dpi=120)
