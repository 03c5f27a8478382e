"""Moduli from shapes: gel beads pass a camera at a pipe, and their stiffness is fitted to what it sees."""

from __future__ import annotations

import shutil
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import foamprb

SETTINGS = """
solution { deltaT 2e-4; endTime 0.1; integrationSchemes { shape stokes; } }
constantProperties { mu 0.1; rhoInf 1000; rho0 1000; solid { type neoHooke; shearModulus 200; } }
subModels
{
    particleForces { ellipsoidDrag; }
    injectionModels
    {
        beads
        {
            type lineInjection; start (1e-4 -1.8e-3 0); end (1e-4 1.8e-3 0); number 200;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 5e-5; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches ( wall { type rebound; } "(inlet|outlet)" { type escape; } ); }
}
cloudFunctions { camera { type deformabilityCytometry; origin (0.02 0 0); normal (1 0 0); view (0 0 1); } }
"""
shutil.copytree(Path(__file__).parents[1] / "cases/pipe", "pipe", dirs_exist_ok=True)
Path("pipe/constant/softCloudProperties").write_text(SETTINGS)

# An experiment: beads of moduli that the settings of the fit do not have, and errors of 2 % of the strain.
random = np.random.default_rng(1)
moduli = {"type": "uniform", "uniformDistribution": {"minValue": 100, "maxValue": 400}}
job = foamprb.prepare("pipe", overrides={"constantProperties/solid/shearModulus": moduli})
foamprb.execute(job, "startTime")
seen = foamprb.open_run("pipe").table("camera/cytometry")
strain = (seen["a"] - seen["b"]) / np.sqrt(seen["a"] * seen["b"])
beads = {
    "id": seen["id"], "y": seen["y"], "z": seen["z"], "d": np.full(len(strain), 5e-5),
    "strain": strain * random.normal(1.0, 0.02, len(strain)), "strainError": 0.02 * strain,
}  # fmt: skip

fits = foamprb.fit("pipe", beads)
true = job.cloud.particles.mu[fits.table["id"].astype(int)]
low, high = fits.table["shearModulusLow"], fits.table["shearModulusHigh"]
inside = np.mean((low <= true) & (true <= high), where=fits.fitted)
print(f"{fits.fitted.sum()} of {len(true)} beads; {100 * inside:.0f} % of the intervals hold the modulus")
assert 0.9 < inside < 1.0

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
value = fits.table["shearModulus"]
axes.errorbar(true, value, [value - low, high - value], fmt="o", ms=3, lw=0.7, color="#0072b2")
axes.plot([100, 400], [100, 400], "--", color="#d55e00")
axes.set(xlabel="true shear modulus [Pa]", ylabel="fitted [Pa]")
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "moduli.png", dpi=120)
