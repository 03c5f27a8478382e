"""Shear-thinning carrier: soft spheres in the pipe flow of a power-law fluid."""

from __future__ import annotations

import math
import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

K, N, WALL, MU_S = 0.5, 0.6, 1.0, 10.0  # Pa sⁿ; exponent; stress at the wall, Pa; shear modulus, Pa


def velocity(x, y, z):
    """Return the velocity, m/s, in a pipe of 1 mm radius along x: γ̇ = (τ/K)^(1/n) with τ = r/1 mm."""
    s = 1e3 * math.sqrt(y * y + z * z)
    return 0.375e-3 * 2.0 ** (5.0 / 3.0) * (1.0 - s ** (8.0 / 3.0)), 0.0 * x, 0.0 * x


places = np.linspace(0.1, 0.9, 9)  # r/a
x = np.column_stack([0.0 * places, 1e-3 * places, 0.0 * places])
found = []
thinning = foamprb.PowerLaw(k=K, n=N)
for mu in (thinning, thinning.at_rate(1.0)):  # by the local shear rate, and that of r/a = 1/2 everywhere
    bodies = foamprb.spheres(x, d=1e-5, rho=1000.0, mu=MU_S)
    flow = foamprb.analytic.function(velocity)
    medium = foamprb.Medium(mu=mu, rho=1000.0)
    cloud = foamprb.Cloud(bodies, flow, medium, [], 0.05, foamprb.Models(integrator="stokes"))
    cloud.advance(100)
    particles = foamprb.context(bodies, flow, mu, cloud.time)
    found.append(foamprb.measure(particles, ["muc", "taylorDeformation"]))

local, constant = found
# Ca = τ/μ_s at any exponent, and D = 5/4 Ca for small deformations.
expected = 1.25 * WALL * places / MU_S
print("D over 5/4 τ/μ_s:", (local["taylorDeformation"] / expected).round(4))
assert np.abs(local["taylorDeformation"] / expected - 1.0).max() < 0.01
assert abs(local["muc"][4] - 0.5) < 1e-6

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
axes.plot(places, local["taylorDeformation"], "o", color="#0072b2", label="viscosity at the particle")
axes.plot(places, constant["taylorDeformation"], "s", color="#d55e00", label="that at r/a = 1/2 everywhere")
axes.plot(places, expected, "--", color="#999999", label="small deformations, 5/4 τ/μ_s")
axes.set(xlabel="distance from the axis, r/a", ylabel="Taylor deformation D")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "carrier.png", dpi=120)
