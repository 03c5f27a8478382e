"""Pulsating pipe flow: the deformation of a stiff body follows the shear, that of a soft one lags."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

RADIUS, NU, PERIOD, RHO = 1e-3, 1e-6, 1.0, 1000.0  # pipe, m; water, m²/s; period, s; density, kg/m³
AMPLITUDE, OMEGA = 0.05, 2.0 * np.pi / PERIOD  # of the pressure gradient over the density, m/s²; 1/s
# Womersley's profile 1 - J0(k r/a)/J0(k) by the series of the Bessel function in (r/a)², its end first.
terms = np.cumprod(np.append(1.0, 0.25j * RADIUS**2 * OMEGA / NU / np.arange(1, 40) ** 2))
profile = -terms / terms.sum()
profile[0] += 1.0
REAL, IMAGINARY = (tuple(part[::-1].tolist()) for part in (profile.real, profile.imag))


def velocity(x, y, z, t):
    """Return the velocity of the pulsating flow in the pipe, m/s."""
    s = (y * y + z * z) / RADIUS**2
    real = imaginary = 0.0 * s
    for k in range(40):
        real, imaginary = real * s + REAL[k], imaginary * s + IMAGINARY[k]
    return AMPLITUDE / OMEGA * (real * np.sin(OMEGA * t) + imaginary * np.cos(OMEGA * t)), 0.0 * x, 0.0 * x


flow = foamprb.analytic.function(velocity, length=RADIUS, time=PERIOD)
stiffness = np.array([10.0, 0.01])  # shear moduli, Pa
start = np.tile([10.0, 0.7 * RADIUS, 0.0], (2, 1))
bodies = foamprb.spheres(start, d=1e-5, rho=RHO, mu=stiffness)
water = foamprb.Medium(mu=NU * RHO, rho=RHO, gravity=(0.0, 0.0, 0.0))
cloud = foamprb.Cloud(bodies, flow, water, [], 2e-3, foamprb.Models(integrator="stokes"))

times, D, rate = [], [], []
for _ in range(200):
    cloud.advance(5)
    stretch = np.linalg.svd(bodies.F.reshape(-1, 3, 3), compute_uv=False)
    times.append(cloud.time)
    D.append((stretch[:, 0] - stretch[:, 2]) / (stretch[:, 0] + stretch[:, 2]))
    rate.append(flow.sample(bodies.x, bodies.host, cloud.time)[1][0, 0, 1])
times, D, rate = np.array(times), np.array(D), np.abs(rate)
follows = 1.25 * NU * RHO * rate / stiffness[0]  # for small deformations in steady shear
second = times > PERIOD
error = np.abs(D[:, 0] - follows)[second].max() / follows.max()
print(f"stiff body: D is 5/4 of the capillary number to {100 * error:.2f} %")
assert error < 0.01
peak = [times[second][np.argmax(d[second])] for d in (rate, D[:, 0], D[:, 1])]
print(f"soft body: its largest D comes {1e3 * (peak[2] - peak[0]):.0f} ms after the largest shear")
assert abs(peak[1] - peak[0]) <= 0.011 < peak[2] - peak[0]

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.plot(times, rate / rate.max(), color="#888888", label="shear rate")
axes.plot(times, D[:, 0] / D[:, 0].max(), "--", color="#0072b2", label="D of the stiff body")
axes.plot(times, D[:, 1] / D[:, 1].max(), color="#d55e00", label="D of the soft body")
axes.set(xlabel="time t [s]", ylabel="of the largest [1]", ylim=(0, 1.35))
axes.legend(frameon=False, ncols=3, loc="upper center")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "pulsatile.png", dpi=120)
