"""Capsules as equivalent solids: deformation in shear, beside that of computed capsules."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, MU, RADIUS = 100.0, 1e-3, 1e-5  # shear rate, 1/s; viscosity of water, Pa s; radius, m
# Steady D by Doddi and Bagchi (2008) and, from 0.15 on, by Ramanujan and Pozrikidis (1998).
DODDI = {0.0375: 0.083, 0.075: 0.161, 0.15: 0.275, 0.3: 0.392}
RAMANUJAN = {0.15: 0.261, 0.3: 0.385}
READING = 0.005  # accuracy with which they are read off figures

capillary = np.concatenate([[1e-3], np.linspace(0.0125, 0.3, 24)])
surface_modulus = MU * RATE * RADIUS / capillary  # N/m
flow = foamprb.analytic.shear(RATE)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
found = {}
for nu_s in (1 / 3, 0.5, 0.9):  # surface Poisson's ratio; 1/2 for a neo-Hookean membrane
    modulus = (1.0 + nu_s) / (2.0 + nu_s) * surface_modulus / RADIUS
    bodies = foamprb.spheres(
        np.zeros((len(capillary), 3)), d=2.0 * RADIUS, rho=1000.0, mu=modulus, poissons_ratio=0.4999
    )
    foamprb.Cloud(bodies, flow, water, [], 1e-3, foamprb.Models(integrator="stokes")).advance(500)
    found[nu_s] = bodies.D
    print(f"nu_s {nu_s:.3g}: D/Ca_s = {bodies.D[0] / capillary[0]:.4f} for small Ca_s")

assert abs(found[0.5][0] / capillary[0] / (25.0 / 12.0) - 1.0) < 1e-3
for Ca, D in DODDI.items():
    assert abs(np.interp(Ca, capillary, found[0.5]) / D - 1.0) < (0.1 if Ca < 0.2 else 0.4)

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (nu_s, D), colour in zip(found.items(), ("#009e73", "#0072b2", "#d55e00"), strict=True):
    axes.plot(capillary, D, color=colour, label=f"solid for surface Poisson's ratio {nu_s:.2g}")
for points, marker, name in ((DODDI, "o", "Doddi and Bagchi"), (RAMANUJAN, "^", "Ramanujan, Pozrikidis")):
    axes.errorbar(
        list(points), list(points.values()), READING, fmt=marker, color="#0072b2", mfc="none", label=name
    )
axes.set(xlabel="surface capillary number Ca_s", ylabel="Taylor deformation D")
axes.legend(frameon=False, fontsize="small")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "capsules.png", dpi=120)
