"""Deterministic lateral displacement: round posts push large spheres aside and let small ones pass."""

from __future__ import annotations

import sys

import numpy as np
from matplotlib import pyplot as plt

import foamprb

SLOPE, GAP, SPEED = 0.2, 10e-6, 1e-3  # of the rows to the flow; m, half the spacing of posts; m/s
sizes = np.linspace(0.3, 0.9, 31)  # diameters over the gap
water = foamprb.Medium(mu=1e-3, rho=1000.0, gravity=(0.0, 0.0, 0.0))
square = foamprb.analytic.posts(2.0 * GAP, GAP, (SPEED, -SLOPE * SPEED))
shifted = foamprb.analytic.posts(2.0 * GAP, GAP, (SPEED, 0.0), shift=SLOPE * 2.0 * GAP)
near_posts = (foamprb.FaxenCorrection(), foamprb.WallLift())
cases = {
    "rows shifted": (shifted, SLOPE, ()),
    "square": (square, 0.0, ()),
    "square, lag and hindrance": (square, 0.0, near_posts),
}
results, paths = {}, []
for name, (flow, rise, surroundings) in cases.items():
    x = np.tile([0.0, GAP, 0.0], (len(sizes), 1))
    beads = foamprb.spheres(x, d=sizes * GAP, rho=1000.0, mu=1e4)
    models = foamprb.Models(integrator="stokes", surroundings=surroundings)
    cloud = foamprb.Cloud(beads, flow, water, [foamprb.Rebound(e=0.0)], 2e-5, models)  # they slide
    places = [x]
    for _ in range(250):
        cloud.advance(40)
        places.append(beads.x.copy())
    places = np.array(places)
    # 1 for spheres that go with the fluid, 0 for those that stay in their row.
    way = places[-1] - places[75]
    results[name] = (rise - way[:, 1] / way[:, 0]) / SLOPE
    paths = places[:, [5, 20]] if name == "square" else paths

critical = {name: sizes[share > 0.5].max() for name, share in results.items()}
inglis, davis = 0.574, 1.4 * SLOPE**0.48
print("critical diameters over the gap:", {name: round(size, 2) for name, size in critical.items()})
print(f"Inglis (2006) {inglis}, Davis (2008) {davis:.3f}")
assert abs(critical["square"] / inglis - 1.0) < 0.06
assert abs(critical["rows shifted"] - critical["square"]) < 0.03
assert critical["square"] < critical["square, lag and hindrance"] < davis

figure, (array, plot) = plt.subplots(1, 2, figsize=(8.4, 3.2), layout="constrained", width_ratios=(3, 2))
for n, m in np.ndindex(8, 4):
    array.add_patch(plt.Circle((n, m - 2), 0.25, color="#bbbbbb"))
for path, colour, size in zip(np.moveaxis(paths, 1, 0), ("#0072b2", "#d55e00"), (0.4, 0.7), strict=True):
    array.plot(*path[:, :2].T / (2.0 * GAP), color=colour, label=f"d = {size} of the gap")
array.set(xlim=(-0.3, 7.3), ylim=(-2.3, 1.3), aspect="equal", xlabel="x / spacing", ylabel="y / spacing")
array.legend(loc="lower left")
for name, colour in zip(cases, ("#009e73", "#0072b2", "#d55e00"), strict=True):
    plot.plot(sizes, results[name], ".-", color=colour, label=name)
plot.axvline(inglis, color="k", ls=":", label="Inglis")
plot.axvline(davis, color="k", ls="--", label="Davis")
plot.set(xlabel="diameter / gap", ylabel="slope of path / of rows", ylim=(-0.3, 2.2))
plot.legend(frameon=False, fontsize=8)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "dld.png", dpi=120)
