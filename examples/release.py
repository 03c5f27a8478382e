"""Release: carriers in a pipe release their contents at a dose of shear stress, first those near the wall."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RADIUS, MEAN, MU, DOSE = 1e-4, 1e-3, 1e-3, 0.02  # of the pipe, m; m/s; viscosity, Pa s; dose, Pa s

r = np.linspace(0.15, 0.95, 60) * RADIUS
x = np.stack([0.0 * r, r, 0.0 * r], axis=1)
flow = foamprb.analytic.pipe(RADIUS, MEAN, 0.1)
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
limits = foamprb.FateLimits(dose=DOSE)
models = foamprb.Models(integrator="stokes", surroundings=(foamprb.Fates(released=limits),))
carriers = foamprb.spheres(x, d=2e-6, rho=1000.0, mu=100.0)
walls = [foamprb.Stick(), foamprb.Escape(), foamprb.Escape()]
cloud = foamprb.Cloud(carriers, flow, water, walls, 1e-3, models)
cloud.advance(2000)
released = carriers.status == foamprb.Status.RELEASED
print(f"{np.count_nonzero(released)} of {carriers.size} carriers have released their contents after 2 s")

# The speed is 2 U (1 − r²/a²) and the stress 4 μ U r/a²: the dose is reached after this length.
length = DOSE * RADIUS**2 * (1.0 - (r / RADIUS) ** 2) / (2.0 * MU * r)
off = np.abs(carriers.x[released, 0] / length[released] - 1.0).max()
print(f"they are at most {off:.2%} from the lengths of the theory")
assert np.count_nonzero(released) > 45
assert off < 0.01
assert carriers.counts()[foamprb.Status.ACTIVE] == np.count_nonzero(~released)

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.plot(length * 1e3, r * 1e6, ":", color="#888888", label="theory")
for chosen, colour, name in ((released, "#d55e00", "released"), (~released, "#0072b2", "on the way")):
    axes.plot(carriers.x[chosen, 0] * 1e3, r[chosen] * 1e6, "o", markersize=4, color=colour, label=name)
axes.set(xlabel="way along the pipe [mm]", ylabel="distance from the axis [µm]", xlim=(0.0, 8.0))
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "release.png", dpi=120)
