"""Shear flow deformation cytometry: cells in alginate, as solids of two kinds and as measured."""

from __future__ import annotations

import math
import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

# Medians and quartiles by Gerum et al., eLife 11 (2022) e78823: strain at 300 kPa by the fluid's stress, Pa,
STRAIN = {38.2: (0.415, 0.335, 0.491), 79.8: (0.561, 0.498, 0.623), 140.0: (0.689, 0.608, 0.763)}
STRAIN |= {199.7: (0.756, 0.679, 0.838), 253.6: (0.839, 0.735, 0.9)}
# and tank-treading frequency over the shear rate, by that rate, 1/s.
FREQUENCY = {8.32: (0.329, 0.301, 0.362), 24.4: (0.287, 0.257, 0.321), 75.1: (0.268, 0.236, 0.304)}
FREQUENCY |= {168.0: (0.211, 0.186, 0.242)}
alginate = foamprb.CrossPowerLaw(mu0=3.8, muInf=0.0, m=0.04, n=0.64)  # Pa s, s
rates = np.geomspace(5.0, 550.0, 16)


def velocity(x, y, z):
    """Return a velocity, m/s, with the shear rate 1e6 y/(m s)."""
    return 0.5e6 * y * y, 0.0 * x, 0.0 * z


def cells(modulus, viscosity):
    """Return strain (a - b)/√(ab) and tank-treading frequency over shear rate of cells at the shear rates."""
    x, flow = np.outer(rates, [0.0, 1e-6, 0.0]), foamprb.analytic.function(velocity, length=1e-5)
    solids = foamprb.spheres(x, d=1e-7, rho=1000.0, mu=modulus, eta=viscosity, poissons_ratio=0.4999)
    medium = foamprb.Medium(mu=alginate, rho=1000.0, gravity=(0.0, 0.0, 0.0))
    foamprb.Cloud(solids, flow, medium, [], 0.05, foamprb.Models(integrator="stokes")).advance(200)
    F = solids.F.reshape(-1, 3, 3)
    short, long = np.sqrt(np.linalg.eigvalsh((F @ F.transpose(0, 2, 1))[:, :2, :2])).T
    turning = foamprb.measure(foamprb.context(solids, flow, alginate, 10.0), ["circulation"])["circulation"]
    return (long - short) / np.sqrt(long * short), turning / rates


omega = rates
for _ in range(6):
    G = 70.3 * (1j * omega) ** 0.318 * math.gamma(1.0 - 0.318)  # Pa: power law, fitted to the strains
    soft = cells(G.real, G.imag / omega)
    omega = 2.0 * soft[1] * rates  # Each turn strains the material twice.
solids = {"power law": soft, "Kelvin-Voigt": cells(356.0, 1.53)}  # Pa, Pa s: fitted likewise

figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.2), layout="constrained")
stresses = rates * 3.8 / (1.0 + (0.04 * rates) ** 0.64)
for ax, place, measured, k in zip(axes, (stresses, rates), (STRAIN, FREQUENCY), (0, 1), strict=True):
    points, (median, low, high) = list(measured), np.array(list(measured.values())).T
    for (name, cell), style in zip(solids.items(), ("C0-", "C1--"), strict=True):
        ax.plot(place, cell[k], style, label=name)
        print(name, "over the measured median:", (np.interp(points, place, cell[k]) / median).round(2))
    ax.errorbar(points, median, [median - low, high - median], fmt="ks", ms=4, label="measured")
assert np.abs(np.interp(list(STRAIN), stresses, soft[0]) - np.array(list(STRAIN.values()))[:, 0]).max() < 0.05
axes[0].set(xlabel="stress of the fluid [Pa]", ylabel="strain (a − b)/√(ab)")
axes[1].set(xlabel="shear rate γ̇ [1/s]", ylabel="tank-treading frequency over γ̇", ylim=(0.0, 0.55))
axes[0].legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "shear_cytometry.png", dpi=120)
