"""The pipe case, run from Python: settling distance of particles of different stiffness."""

from __future__ import annotations

import shutil
import sys
import tempfile
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt

import foamprb

HERE = Path(__file__).resolve().parent
RADIUS = 0.5 * 5e-6  # of a particle at rest, m

with tempfile.TemporaryDirectory() as folder:
    case = Path(folder) / "pipe"
    shutil.copytree(HERE.parent / "cases/pipe", case, ignore=shutil.ignore_patterns("postProcessing"))
    foamprb.execute(foamprb.prepare(case, threads=1))
    fates = foamprb.open_run(case).table("fates")
# The first five are released at one point, with Ca from 1e-4 to 1; the others enter over the whole inlet.
Ca, distance = fates["Ca"][:5], fates["x1"][:5]
print("Ca:", Ca, " distance in diameters:", (0.5 * distance / RADIUS).round())
assert (fates["fate"][:5] == "stuck").all()
# In the exact flow the stiff one lands after 8989 diameters; this mesh is coarse.
assert abs(distance[0] / (2.0 * RADIUS) / 8988.7 - 1.0) < 0.005
assert (np.diff(distance) > 0.0).all()  # an elongated body falls more slowly

figure, axes = plt.subplots(figsize=(6.4, 3.2), layout="constrained")
for fate, colour in (("escaped", "#0072b2"), ("stuck", "#d55e00")):
    rows = fates["fate"] == fate
    axes.plot(1e3 * fates["y0"][rows], 1e3 * fates["x1"][rows], "o", ms=3, color=colour, label=fate)
axes.set(xlabel="height y of release [mm]", ylabel="distance x at the end [mm]")
axes.legend(frameon=False)
figure.savefig(sys.argv[1] if len(sys.argv) > 1 else "pipe.png", dpi=120)
