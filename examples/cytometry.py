"""Deformability cytometry: lines of equal stiffness of cells on the axis of a square channel."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

WIDTH, FLOW_RATE, MU = 20e-6, 0.04e-9, 15e-3  # width of the channel, m; m³/s; viscosity, Pa s
# Young's modulus, kPa, and areas, µm², with deformations of outlines: some rows of LE-2D-FEM-19 of dclab,
# finite elements by Mokbel et al., ACS Biomater. Sci. Eng. 3 (2017) 2962.
PUBLISHED = {
    2.17667: (
        [34.0, 46.43, 60.93, 77.65, 94.88, 114.6],
        [0.00906, 0.0125, 0.01709, 0.02301, 0.03044, 0.04054],
    ),
    3.78053: ([73.19, 94.87, 115.4, 128.9], [0.00688, 0.00965, 0.01287, 0.0154]),
}

diameters = np.linspace(6.5e-6, 13e-6, 14)
flow = foamprb.analytic.duct(WIDTH, WIDTH, FLOW_RATE / WIDTH**2)
buffer = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
walls = [foamprb.Rebound()] * len(flow.patches)
models = foamprb.Models(integrator="stokes", shape="quadratic")
axis = np.tile([0.0, 0.0, 0.5 * WIDTH], (len(diameters), 1))

figure, axes = plt.subplots(figsize=(6.4, 3.6), layout="constrained")
for colour, (modulus, (areas, published)) in zip(("#0072b2", "#d55e00"), PUBLISHED.items(), strict=True):
    cells = foamprb.spheres(axis, d=diameters, rho=1000.0, mu=1e3 * modulus / 3.0, poissons_ratio=0.4999)
    foamprb.Cloud(cells, flow, buffer, walls, 1e-6, models).advance(200)
    # A square channel acts on a cell on its axis as a tube of 0.547 of the width does.
    seen = foamprb.outline(cells, np.array([0.0, 1.0, 0.0]), 0.5 * diameters / (0.547 * WIDTH))
    expected = np.interp(areas, 1e12 * seen.area, seen.deformation)
    print(f"{modulus:.2f} kPa: over the published deformation", (expected / published).round(3))
    assert (np.abs(expected / published - 1.0) < 0.04).all()
    axes.plot(1e12 * seen.area, seen.deformation, color=colour, label=f"{modulus:.2f} kPa")
    axes.plot(areas, published, "o", color=colour)
axes.set(xlabel="area of the outline [µm²]", ylabel="1 − 2 √(πA)/P", ylim=(0.0, None))
axes.legend(frameon=False, title="Young's modulus")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "cytometry.png", dpi=120)
