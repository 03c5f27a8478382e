"""User-defined material: deformation of a stiffening solid against a neo-Hooke solid."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb
from foamprb import log_ratio

RATE, MU = 100.0, 1e-3  # shear rate, 1/s; viscosity of water, Pa s


def energy(I1, I2, J, mu, lame, k):
    """Return the energy of Yeoh's solid of second order, J/m³; its stiffness grows with k (I₁ − 3)."""
    log_J = log_ratio(J)
    strain = I1 - 3.0
    return 0.5 * mu * (strain + 0.5 * k * strain * strain - 2.0 * log_J) + 0.5 * lame * log_J * log_J


foamprb.add_material("yeoh", energy, parameter=foamprb.Parameter("stiffening", 0.0, 10.0))
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
capillary = np.linspace(0.05, 0.8, 8)
found = {}
for solid, k in (("neoHooke", 0.0), ("yeoh", 2.0)):
    bodies = foamprb.spheres(np.zeros((8, 3)), d=1e-5, rho=1000.0, mu=MU * RATE / capillary, k=k)
    models = foamprb.Models(material=solid, integrator="stokes")
    cloud = foamprb.Cloud(bodies, foamprb.analytic.shear(RATE), water, [], 1e-3, models)
    cloud.advance(400)
    stretch = np.linalg.svd(bodies.F.reshape(-1, 3, 3), compute_uv=False)
    found[solid] = (stretch[:, 0] - stretch[:, 2]) / (stretch[:, 0] + stretch[:, 2])

ratio = found["yeoh"] / found["neoHooke"]
print("D of the stiffening solid over that of neo-Hooke's:", ratio.round(3))
assert 0.96 < ratio[0] < 0.98
assert 0.54 < ratio[-1] < 0.56

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (solid, D), style in zip(found.items(), ("-", "--"), strict=True):
    axes.plot(capillary, D, style, color="#0072b2" if solid == "neoHooke" else "#d55e00", label=solid)
axes.set(xlabel="capillary number Ca", ylabel="Taylor deformation D")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "own_material.png", dpi=120)
