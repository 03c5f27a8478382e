"""Capsules and equivalent solids: deformation in shear, beside that of computed capsules."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, MU, RADIUS = 100.0, 1e-3, 1e-5  # shear rate, 1/s; viscosity of water, Pa s; radius, m
# Steady D by Doddi and Bagchi (2008) and, from 0.15 on, by Ramanujan and Pozrikidis (1998).
DODDI = {0.0375: 0.083, 0.075: 0.161, 0.15: 0.275, 0.3: 0.392, 0.6: 0.495}
RAMANUJAN = {0.15: 0.261, 0.3: 0.385, 0.6: 0.500}
READING = 0.005  # accuracy with which they are read off figures

capillary = np.concatenate([[1e-3], np.linspace(0.0125, 0.6, 48)])
surface_modulus = MU * RATE * RADIUS / capillary  # N/m
flow = foamprb.analytic.shear(RATE)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
found = {}
for material in ("capsule neoHookean", "capsule Skalak 1", "neoHooke"):
    # Of all three for small deformation, where the surface Poisson's ratio is 1/2.
    modulus = 0.6 * surface_modulus / RADIUS
    bodies = foamprb.spheres(
        np.zeros((len(capillary), 3)), d=2.0 * RADIUS, rho=1000.0, mu=modulus, eta=MU, poissons_ratio=0.4999
    )
    models = foamprb.Models(integrator="stokes", material=material)
    foamprb.Cloud(bodies, flow, water, [], 1e-3, models).advance(500)
    found[material] = bodies.D
    print(f"{material}: D/Ca_s = {bodies.D[0] / capillary[0]:.4f} for small Ca_s")

for D in found.values():
    assert abs(D[0] / capillary[0] / (25.0 / 12.0) - 1.0) < 1e-3
for Ca, D in DODDI.items():
    assert abs(np.interp(Ca, capillary, found["capsule neoHookean"]) / D - 1.0) < 0.06

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (material, D), colour in zip(found.items(), ("#0072b2", "#009e73", "#d55e00"), strict=True):
    axes.plot(capillary, D, color=colour, label="equivalent solid" if material == "neoHooke" else material)
for points, marker, name in ((DODDI, "o", "Doddi and Bagchi"), (RAMANUJAN, "^", "Ramanujan, Pozrikidis")):
    axes.errorbar(
        list(points), list(points.values()), READING, fmt=marker, color="#0072b2", mfc="none", label=name
    )
axes.set(xlabel="surface capillary number Ca_s", ylabel="Taylor deformation D")
axes.legend(frameon=False, fontsize="small")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "capsules.png", dpi=120)
