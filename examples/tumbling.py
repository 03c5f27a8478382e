"""Tumbling of a stiff ellipsoid in a shear flow, with Jeffery's period."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RATE, RATIO, MU = 100.0, 3.0, 1e-3  # shear rate, 1/s; long axis over the others; viscosity of water, Pa s
STEP = 1e-3  # s

body = foamprb.spheres([[0.0, 0.0, 0.0]], d=1e-5, rho=1000.0, mu=1e4 * MU * RATE)
foamprb.set_rest_shape(body, (RATIO, 1.0, 1.0))
water = foamprb.Medium(mu=MU, rho=1000.0, gravity=(0.0, 0.0, 0.0))
flow = foamprb.analytic.shear(RATE)
cloud = foamprb.Cloud(body, flow, water, [], STEP, foamprb.Models(integrator="stokes"))

angles = []
for _ in range(250):
    cloud.advance(1)
    long_axis = np.linalg.svd(body.F[0].reshape(3, 3))[0][:, 0]
    angles.append(np.arctan2(long_axis[1], long_axis[0]))
times = STEP * np.arange(1, 251)
turned = -np.unwrap(2.0 * np.array(angles)) / 2.0  # the axis has no sign
turned -= np.pi * np.round(turned[0] / np.pi)
half = np.interp(np.pi, turned - turned[0], times - times[0])

period = 2.0 * np.pi * (RATIO + 1.0 / RATIO) / RATE
print(f"period {2.0 * half:.5f} s, Jeffery (1922) {period:.5f} s")
assert abs(2.0 * half / period - 1.0) < 5e-3

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.plot(1e3 * times, np.degrees(turned), color="#0072b2", label="foamprb")
jeffery = np.unwrap(
    2.0 * np.arctan2(np.sin(2.0 * np.pi * times / period) / RATIO, np.cos(2.0 * np.pi * times / period))
)
axes.plot(1e3 * times, np.degrees(jeffery / 2.0), "--", color="#d55e00", label="Jeffery (1922)")
axes.set(xlabel="time t [ms]", ylabel="turned by [degrees]")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "tumbling.png", dpi=120)
