"""Haemolysis: damage to red blood cells in a pulsating shear, with and without the memory of the cells."""

from __future__ import annotations

import sys
import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import foamprb
from foamprb.cloudfunctions.base import ObservedCloud
from foamprb.cloudfunctions.haemolysis import Haemolysis
from foamprb.cloudfunctions.registry import CloudFunctions

RATE, PERIOD = 10_000.0, 0.1  # largest shear rate, 1/s; one short pulse in each period, s


def velocity(x, y, z, t):
    """Return the velocity of a shear in pulses, m/s."""
    return RATE * np.sin(np.pi * t / PERIOD) ** 16 * y, 0.0 * x, 0.0 * z


flow = foamprb.analytic.function(velocity, length=1e-3, time=PERIOD)
blood = foamprb.Medium(mu=3.5e-3, rho=1050.0, gravity=(0.0, 0.0, 0.0))
cell = foamprb.spheres(np.zeros((1, 3)), d=6e-6, rho=1100.0, mu=1000.0)
cloud = foamprb.Cloud(cell, flow, blood, [], 5e-4, foamprb.Models(integrator="stokes"))
models = {
    stress: Haemolysis(constants="Giersiepen", stress=stress)
    for stress in ("fluid", "KelvinVoigt", "morphology")
}
functions = CloudFunctions(models, ObservedCloud(cloud, {"injector": ("cells",)}))
with tempfile.TemporaryDirectory() as folder:
    for _ in range(200):
        cloud.advance(5)
        functions.write(Path(folder))
    damage = {
        stress: np.genfromtxt(
            Path(folder) / stress / "means.csv", delimiter=",", names=True, dtype=None, encoding=None
        )
        for stress in models
    }

end = {stress: found["haemolysis"][-1] for stress, found in damage.items()}
print({stress: float(f"{value:.3g}") for stress, value in end.items()}, "per cent")
assert 10.0 < end["fluid"] / end["KelvinVoigt"] < 1000.0
assert abs(end["morphology"] / end["KelvinVoigt"] - 1.0) < 0.1

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for (stress, found), style in zip(damage.items(), ("-", "-", "--"), strict=True):
    axes.semilogy(found["time"], found["haemolysis"], style, label=stress)
axes.set(xlabel="time [s]", ylabel="haemolysis [%]", ylim=(1e-7, None))
axes.legend(frameon=False, title="stress")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "haemolysis.png", dpi=120)
