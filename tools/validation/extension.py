"""Extension and volume: beyond the paper's figures."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Outcome, Panel, Row
from validation.references.extension import EXTENSIONS, steady_compressible_extension
from validation.references.extension import steady_extension as exact_steady_extension
from validation.runs import (
    NEARLY_INCOMPRESSIBLE,
    advance_to,
    follow,
    measures,
    unit_cloud,
)

BALANCE = "balance −p + μ_f s̃_aa(d_f) = σ_aa by scipy.optimize"
CLOSED = "closed form"
QUADRATURE = "Oberbeck's resistances by quadrature, closed-form motion"


def steady_extension(quick: bool) -> Outcome:
    """Steady axes in extension."""
    largest = {"uniaxial": 0.30, "planar": 0.24, "biaxial": 0.13}
    rows, panels = [], []
    for name, rates in EXTENSIONS.items():
        Ca = largest[name] * (np.array([0.2, 0.6]) if quick else np.linspace(0.1, 1.0, 10))
        cloud = unit_cloud(analytic.linear(np.diag(rates)), Ca, 2e-3, 4e-4, Models(integrator="paper"))
        advance_to(cloud, 10.0 if quick else 60.0)
        ours = np.linalg.norm(cloud.particles.F.reshape(-1, 3, 3), axis=2)
        expected = np.array([exact_steady_extension(rates, c) for c in Ca])
        shown = range(len(Ca)) if quick else (0, 4, 9)
        rows += [
            Row(
                f"{name}, Ca = {Ca[i]:.3g}: r{k + 1}/R",
                float(ours[i, k]),
                float(expected[i, k]),
                BALANCE,
                1e-4,
            )
            for i in shown
            for k in range(3)
        ]
        fine = np.linspace(largest[name] / 30.0, largest[name], 12)
        markers = np.array([exact_steady_extension(rates, c) for c in fine])
        curves = []
        for k in range(3):
            curves.append(
                Curve(np.append(0.0, Ca), np.append(1.0, ours[:, k]), f"foamprb, axis {k + 1}", colour=k)
            )
            curves.append(Curve(fine, markers[:, k], "balance" if k == 0 else "", "reference", k))
        panels.append(Panel(f"Ca = μ_f ε̇/μ_s, {name}", "r/R", curves))
    figure = Figure(
        "extension",
        "Steady semi-axes; ε̇ is the largest positive principal rate of diag(1, −½, −½), "
        "diag(1, −1, 0), diag(1, 1, −2).",
        panels,
    )
    remarks = [
        "Beyond Ca of about 0.32 (uniaxial), 0.26 (planar) and 0.14 (biaxial) the load exceeds the "
        "resistance of a neo-Hooke solid, and there is no steady shape."
    ]
    return Outcome(rows, [figure], remarks)


def volume(quick: bool) -> Outcome:
    """Conservation of volume."""
    rows = []
    Ca = np.array([0.1, 0.4])
    cloud = unit_cloud(analytic.shear(1.0), Ca, 2e-3, 4e-4, Models(integrator="paper"))
    times = np.linspace(0.25, 10.0, 40)
    drift = follow(cloud, times, lambda c: measures(c)["J"])
    for i, c in enumerate(Ca):
        k = int(np.argmax(abs(drift[:, i] - 1.0)))
        rows.append(
            Row(
                f"shear, Ca = {c:g}, ν = {NEARLY_INCOMPRESSIBLE}: J, worst of all times",
                float(drift[k, i]),
                1.0,
                "incompressible limit",
                5e-6,
            )
        )
    bodies = unit_cloud(analytic.shear(1.0), Ca, 1e-3, 0.02, Models(integrator="stokes"))
    advance_to(bodies, 10.0)
    for c, j in zip(Ca, measures(bodies)["J"], strict=True):
        rows.append(Row(f"shear, Ca = {c:g}, integrator stokes: J at γ̇t = 10", float(j), 1.0, CLOSED, 1e-10))
    for nu in (0.49, 0.499):
        cloud = unit_cloud(
            analytic.linear(np.diag(EXTENSIONS["planar"])),
            [0.1],
            2e-3,
            4e-4,
            Models(integrator="paper"),
            nu,
        )
        advance_to(cloud, 10.0)
        axes = steady_compressible_extension(EXTENSIONS["planar"], 0.1, nu)
        rows.append(
            Row(
                f"planar extension, Ca = 0.1, ν = {nu}: J − 1",
                float(measures(cloud)["J"][0] - 1.0),
                float(np.prod(axes) - 1.0),
                BALANCE,
                1e-3,
                True,
            )
        )
    figure = Figure(
        "volume",
        f"Volume in simple shear, ν = {NEARLY_INCOMPRESSIBLE}.",
        [
            Panel(
                "γ̇t",
                "J − 1",
                [Curve(times, drift[:, i] - 1.0, f"foamprb, Ca = {c:g}", colour=i) for i, c in enumerate(Ca)],
            ),
        ],
    )
    remarks = [
        "The printed 2 d_s of the traction (27) contains the dilation with the wrong sign: +2/3 tr(d_s) "
        "on each axis instead of −4/3 tr(d_s) of the exact flow around an expanding sphere. Without "
        "inertia the volume would then grow without bound. foamprb uses 2 dev d_s − 4/3 tr(d_s) I; both "
        "agree if the particle keeps its volume.",
        "Two more formulas are misprinted: the elastic stress (24) is μ (F − F⁻ᵀ) + λ ln J F⁻ᵀ, and the "
        "traction as a Piola stress J σ̃ F⁻ᵀ; the paper has F⁻¹ in both. With F⁻¹, P·Fᵀ would not be "
        "symmetric, and σ̃ not the traction on the deformed surface.",
    ]
    return Outcome(rows, [] if quick else [figure], remarks)
