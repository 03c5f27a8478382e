"""Quadratic mode: cells in a cytometer, and drifts across a pipe (beyond the paper)."""

from __future__ import annotations

import tempfile
from pathlib import Path

import numpy as np
from benchmarks import pipe

import foamprb
from foamprb.body.quadratic import tube_amplitude
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import drops, spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Floats, Outcome, Row

WIDTH, FLOW, MU_F = 20e-6, 0.04e-9, 0.015
"""Width of the square channel, m, volume flow, m³/s, and viscosity, Pa s."""
RADIUS = 0.547 * WIDTH
"""Of the tube that replaces the channel (Mietke et al. 2015), m."""
ELEMENTS = (
    (34.0043, 0.009059, 2.17667), (46.4343, 0.012500, 2.17667), (60.9267, 0.017086, 2.17667),
    (77.6523, 0.023007, 2.17667), (94.8824, 0.030440, 2.17667), (114.612, 0.040542, 2.17667),
    (126.974, 0.048073, 2.17667), (73.1886, 0.006880, 3.78053), (94.8739, 0.009649, 3.78053),
    (115.392, 0.012874, 3.78053), (128.903, 0.015403, 3.78053), (133.631, 0.016408, 3.78053),
    (44.9351, 0.006814, 2.90223), (65.2588, 0.010323, 2.90223), (85.9541, 0.014487, 2.90223),
    (105.766, 0.019475, 2.90223), (125.943, 0.025596, 2.90223), (74.6517, 0.003524, 5.34621),
    (94.4151, 0.004767, 5.34621), (114.532, 0.006308, 5.34621), (132.205, 0.007974, 5.34621),
)  # fmt: skip
"""Some rows of the table LE-2D-FEM-19: area of the outline, µm², deformation, Young's modulus, kPa."""
OF_ELEMENTS = "finite elements, Mokbel et al. (2017): LE-2D-FEM-19 of dclab"
ANALYTICAL = (
    (33.6043, 6.36019e-4, 7.97), (59.4575, 1.17519e-3, 7.97), (93.2372, 2.03852e-3, 7.97),
    (123.009, 2.81196e-3, 8.32218), (134.878, 3.58464e-3, 7.97),
)  # fmt: skip
"""Some rows of the analytical table."""
SQUARE = (
    (50.2161, 0.021359, 0.791), (50.6006, 0.008676, 1.198), (81.6609, 0.015470, 1.198),
    (107.646, 0.022716, 1.198), (82.0236, 0.005249, 2.026), (108.1, 0.007583, 2.026),
)  # fmt: skip
"""Some rows of HE-3D-FEM-22: neo-Hookean cells in the square channel, in a fluid that thins."""
OF_SQUARE, THINNED = "finite elements in 3-D, Wittwer et al. (2022): HE-3D-FEM-22 of dclab", 6e-3
"""The viscosity that its authors state for the fluid, Pa s."""
OF_FORMULA = "analytical, Mietke et al. (2015): scripts of dclab"
SOURCES = (
    "The tables are part of dclab (github.com/DC-analysis/dclab, GPL 2; data of the finite elements: doi "
    "10.6084/m9.figshare.12155064.v4). Both replace the channel by a tube of 0.547 of its width. The finite "
    "elements have the velocity that belongs to the curvature of the flow, 2Q/πR²; the analytical table has "
    "that of the square channel, 2.0963 Q/L². Deformation is 1 − 2√(πA)/P of the outline. Each is a run of a "
    "case of OpenFOAM with the exact flow in 3072 cells, with default settings; the deformation is that of "
    "cytometry.csv, of bodies with the outlines' areas. The cells of HE-3D-FEM-22 are neo-Hookean, in the "
    "square channel and a fluid that thins (0.4057 Pa sⁿ, n = 0.6039). With the one viscosity that its "
    "authors state, and the tube, ours are 15 to 22 % less deformed: the fluid is thicker near the axis."
)


SETTINGS = """solution {{ deltaT 2e-6; endTime 6e-4; writeInterval 6e-4; }}
constantProperties
{{
    rho0 1000; rhoInf 1000; mu {mu_f};
    solid {{ type neoHooke; poissonsRatio 0.4999; youngsModulus 1000; }}
}}
subModels
{{
    shapeModel quadratic;
    particleForces {{ ellipsoidDrag; faxenCorrection; }}
    injectionModels {{ cells {{ type manualInjection; positionsFile "cells.csv"; SOI 0; }} }}
    patchInteractionModel localInteraction;
    localInteractionCoeffs {{ patches ( wall {{ type rebound; }} "(inlet|outlet)" {{ type escape; }} ); }}
}}
cloudFunctions
{{
    camera
    {{
        type deformabilityCytometry; origin (7e-5 0 0); normal (1 0 0); view (0 0 1);
        channel {{ type tube; radius {radius}; }}
    }}
}}
"""
"""Settings of a run with defaults."""


def _cells(areas: Floats, moduli: Floats, speed: float, mu_f: float) -> Floats:
    """Return the deformations of cells on the axis of a tube, from a run of a case of OpenFOAM, (n,).

    Parameters
    ----------
    areas
        Of their outlines, m².
    moduli
        Young's, Pa.
    speed
        Of the fluid on the axis, m/s.
    mu_f
        Viscosity of the fluid, Pa s.
    """
    a = np.sqrt(areas / np.pi)
    for _ in range(20):
        eps = 7.0 / 8.0 * mu_f * speed * a / (moduli / 3.0 * RADIUS**2) * tube_amplitude(a / RADIUS)
        a = np.sqrt(areas / (np.pi * (1.0 - 0.75 * eps * eps)))
    rows = [
        f"1e-5,0,0,{2.0 * float(radius)!r},{float(modulus)!r}"
        for radius, modulus in zip(a, moduli, strict=True)
    ]
    with tempfile.TemporaryDirectory() as name:
        case = pipe.write_case(Path(name), pipe.Grid(16, 8, 4), pipe.Size(RADIUS, 1e-4, 0.5 * speed))
        (case / "constant/softCloudProperties").write_text(SETTINGS.format(mu_f=mu_f, radius=RADIUS))
        (case / "constant/cells.csv").write_text("\n".join(["x,y,z,d,youngsModulus", *rows]))
        foamprb.execute(foamprb.prepare(case))
        seen = foamprb.open_run(case).table("camera/cytometry")
    return np.asarray(seen["deformation"])[np.argsort(seen["id"])]


def _advance(p, flow, mu_f: float, dt: float, steps: int, surroundings=()) -> None:  # type: ignore[no-untyped-def]
    models = Models(
        integrator="stokes",
        material="drop" if p.drop.any() else "neoHooke",
        surroundings=surroundings,
        shape="quadratic",
    )
    rules = [Escape()] * len(flow.patches)
    Cloud(p, flow, Medium(mu_f, 1000.0, (0.0, 0.0, 0.0)), rules, dt, models, threads=1).advance(steps)


def mode(quick: bool) -> Outcome:  # noqa: ARG001
    """Quadratic mode in curved flows."""
    rows = []
    in_tube = 2.0 * FLOW / (np.pi * RADIUS**2)
    for table, source, allowed, speed, mu_f in (
        (ELEMENTS, OF_ELEMENTS, 0.05, in_tube, MU_F),
        (ANALYTICAL, OF_FORMULA, 0.01, 2.0963 * FLOW / WIDTH**2, MU_F),
        (SQUARE, OF_SQUARE, 0.05, in_tube, THINNED),
    ):
        areas, deformations, moduli = np.array(table).T
        ours = _cells(1e-12 * areas, 1e3 * moduli, speed, mu_f)
        for area, expected, modulus, one in zip(areas, deformations, moduli, ours, strict=True):
            title = f"cell in a cytometer, {area:.4g} µm², E = {modulus:.3g} kPa: deformation"
            rows.append(
                Row(title, float(one), float(expected), source, allowed, relative=True, kind="others")
            )
    rows += _drifts()
    return Outcome(rows, [], [SOURCES])


def _drifts() -> list[Row]:
    """Return the drifts at half of the radius of a pipe."""
    R, a, U, mu_f, mu_s = 1e-4, 1e-5, 1e-2, 1e-3, 10.0
    y, rows = 0.5 * R, []
    unit = 4.0 * U * U * y / R**4 * mu_f * a * a / mu_s
    p = spheres([(0.0, y, 0.0)], d=2.0 * a, rho=1000.0, mu=mu_s, poissons_ratio=0.4999)
    _advance(p, analytic.pipe(R, 0.5 * U), mu_f, 2e-5, 40, (FaxenCorrection(),))
    title = "drift across a pipe over γ g μ a²/μ_s: elastic sphere"
    rows.append(Row(title, float(p.v[0, 1]) / unit, -25.0 / 144.0, "theory, first order", 3e-3, True))
    numbers = {0.5: -0.057993, 1.0: 0.037500, 2.0: 0.061830}
    for ratio, expected in numbers.items():
        d = drops([(0.0, y, 0.0)], d=2.0 * a, rho=1000.0, gamma=mu_s * a, eta=ratio * mu_f)
        _advance(d, analytic.pipe(R, 0.5 * U), mu_f, 1e-4, 40)
        title = f"drift across a pipe over γ g μ a³/σ: drop, λ = {ratio:g}"
        rows.append(Row(title, float(d.v[0, 1]) / unit, expected, "theory, first order", 3e-3, True))
    return rows
