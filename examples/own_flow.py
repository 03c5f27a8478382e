"""User-defined flow: soft spheres at the stagnation point of a cross-slot."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, MU = 50.0, 1e-3  # rate of extension, 1/s; viscosity of water, Pa s


def cross_slot(x, y, z):
    """Return the velocity, m/s: inflow along y, outflow along x."""
    return 50.0 * x, -50.0 * y, 0.0 * z


capillary = np.array([0.01, 0.02, 0.05, 0.1])  # μ_f times the rate over μ_s
bodies = foamprb.spheres(np.zeros((4, 3)), d=1e-5, rho=1000.0, mu=MU * RATE / capillary)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
flow = foamprb.analytic.function(cross_slot)
cloud = foamprb.Cloud(bodies, flow, water, [], 1e-3, foamprb.Models(integrator="stokes"))
cloud.advance(200)

stretch = np.linalg.svd(bodies.F.reshape(-1, 3, 3), compute_uv=False)
D = (stretch[:, 0] - stretch[:, 2]) / (stretch[:, 0] + stretch[:, 2])
print("D/Ca:", D / capillary, "for small deformations 5/2")
assert abs(D[0] / capillary[0] / 2.5 - 1.0) < 0.03

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.loglog(capillary, D, "o-", color="#0072b2", label="foamprb")
axes.loglog(capillary, 2.5 * capillary, "--", color="#d55e00", label="small deformations, 5/2 Ca")
axes.set(xlabel="capillary number Ca", ylabel="Taylor deformation D")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "own_flow.png", dpi=120)
