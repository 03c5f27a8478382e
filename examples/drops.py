"""Drops: deformation in shear up to breakup, for three ratios of the viscosities."""

from __future__ import annotations

import sys
import warnings

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, MU, RADIUS = 100.0, 1e-3, 1e-5  # shear rate, 1/s; viscosity of water, Pa s; radius, m

flow = foamprb.analytic.shear(RATE)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
models = foamprb.Models(material="drop")
capillary = np.linspace(0.02, 0.8, 40)
found = {}
for ratio in (0.1, 1.0, 5.0):
    tension = MU * RATE * RADIUS / capillary
    bodies = foamprb.drops(np.zeros((40, 3)), d=2.0 * RADIUS, rho=1000.0, gamma=tension, eta=ratio * MU)
    cloud = foamprb.Cloud(bodies, flow, water, [], 1e-3, models, limits=foamprb.Limits(maxStretch=20.0))
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", foamprb.FailedParticlesWarning)  # those that break up
        cloud.advance(3000)
    whole = bodies.status == foamprb.Status.ACTIVE
    found[ratio] = np.where(whole, bodies.D, np.nan)
    print(f"viscosity ratio {ratio:g}: drops up to Ca = {capillary[whole].max():.2f} do not break up")

taylor = {ratio: (19.0 * ratio + 16.0) / (16.0 * ratio + 16.0) * capillary for ratio in found}
assert abs(found[1.0][0] / taylor[1.0][0] - 1.0) < 0.005
assert np.isfinite(found[5.0]).all()
assert capillary[np.isfinite(found[1.0])].max() < 0.61

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (ratio, D), colour in zip(found.items(), ("#009e73", "#0072b2", "#d55e00"), strict=True):
    axes.plot(capillary, D, color=colour, label=f"viscosity ratio {ratio:g}")
    axes.plot(capillary, taylor[ratio], ":", color=colour)
axes.set(xlabel="capillary number Ca", ylabel="Taylor deformation D", ylim=(0.0, 1.0))
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "drops.png", dpi=120)
