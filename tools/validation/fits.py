"""Fitted moduli and viscosities of cells whose shapes are Roscoe's (beyond the paper)."""

from __future__ import annotations

import tempfile
from dataclasses import replace
from pathlib import Path

import numpy as np

from foamprb.flow import analytic
from foamprb.run.fit import fit_job
from foamprb.run.job import assemble
from foamprb.run.measured import read_measured
from foamprb.settings.settings import read_settings
from validation.case import Floats, Outcome, Row
from validation.references.roscoe import roscoe

RADIUS, MEAN = 1e-4, 5e-3
"""Radius of the tube, m, and mean velocity, m/s; the viscosity is 1 Pa s."""
SETTINGS = """
solution { deltaT 2e-3; endTime 2; integrationSchemes { shape stokes; } }
constantProperties { rho0 1000; rhoInf 1000; mu 1; solid { type neoHooke; shearModulus 300; viscosity 1; } }
subModels
{
    particleForces { ellipsoidDrag; }
    injectionModels
    {
        cells
        {
            type lineInjection;
            start (1e-6 -9e-5 0); end (1e-6 9e-5 0); number 37;
            sizeDistribution { type fixedValue; fixedValueDistribution { value 15e-6; } }
        }
    }
    patchInteractionModel localInteraction;
    localInteractionCoeffs { patches ( wall { type rebound; } "(inlet|outlet)" { type escape; } ); }
}
"""
STRAIN_ERROR, ANGLE_ERROR = 0.02, 0.02
"""Relative standard error of strains; that of angles, rad."""
_SHAPES = 500
SOURCES = (
    "Strain and angle of each cell are Roscoe's steady ones in the shear of a tube, 1 mm behind the release. "
    "They are measured with errors of 2 % and 0.02 rad. The fit follows each cell from the release on."
)


def _cells(n: int, random: np.random.Generator) -> dict[str, Floats]:
    """Return places, sizes, strains, angles, moduli and viscosities of cells, (n,) each."""
    shapes = []
    for _ in range(min(n, _SHAPES)):
        viscosity = float(np.exp(random.normal(0.0, 0.3)))
        shape = roscoe(float(random.uniform(1.15, 1.5)), viscosity)
        a, b = shape.axes[:2]
        shapes.append(((a - b) / np.sqrt(a * b), np.radians(shape.angle), shape.Ca, viscosity))
    strain, angle, Ca, viscosities = np.resize(shapes, (n, 4)).T
    y = random.uniform(3e-5, 8e-5, n) * random.choice([-1.0, 1.0], n)
    rate = 4.0 * MEAN * np.abs(y) / RADIUS**2
    d = random.normal(15e-6, 1e-6, n)
    return {"y": y, "d": d, "strain": strain, "angle": angle, "G": rate / Ca, "viscosity": viscosities}


def cells(quick: bool) -> Outcome:
    """Fitted cells in a tube."""
    random, n = np.random.default_rng(0), 500 if quick else 10_000
    cells = _cells(n, random)
    table = {
        "y": cells["y"],
        "d": cells["d"],
        "strain": cells["strain"] * random.normal(1.0, STRAIN_ERROR, n),
        "angle": cells["angle"] + random.normal(0.0, ANGLE_ERROR, n),
        "strainError": STRAIN_ERROR * cells["strain"],
        "angleError": np.full(n, ANGLE_ERROR),
    }
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "constant").mkdir()
        (folder / "constant/softCloudProperties").write_text(SETTINGS)
        job = assemble(read_settings(folder), analytic.pipe(RADIUS, MEAN, 2e-3))
        job = replace(job, output=folder / "results")
        fits = fit_job(job, read_measured(table), ("shearModulus", "viscosity"), "x=1e-3", "z")
    rows = []
    for title, name, true in (
        ("shear modulus", "shearModulus", cells["G"]),
        ("viscosity", "viscosity", cells["viscosity"]),
    ):
        low, value, high = (fits.table[name + ending][fits.fitted] for ending in ("Low", "", "High"))
        truth = true[fits.fitted]
        inside = float(np.mean((low <= truth) & (truth <= high)))
        bias = float(np.median(value / truth))
        what = f"{title} of cells by strain and angle"
        rows.append(
            Row(f"{what}: share of the 95 % intervals that hold it", inside, 0.95, "its meaning", 0.02)
        )
        rows.append(Row(f"{what}: median of fitted over true values", bias, 1.0, "Roscoe (1967)", 0.01))
    share = float(np.mean(fits.fitted))
    rows.append(Row("share of the cells that are fitted", share, 1.0, "all have such a shape", 0.005))
    return Outcome(rows, [], [SOURCES])
