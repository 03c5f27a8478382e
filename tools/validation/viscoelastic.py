"""Kelvin–Voigt solids in simple shear (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, compared, worst, worst_of_each
from validation.references.roscoe import roscoe_at
from validation.references.shear import SHEAR, inertialess_history, inertialess_rate, shear_shape
from validation.runs import advance_to, follow, shear_shapes, unit_cloud

ROSCOE = "Roscoe (1967), viscoelastic sphere, steady algebraic solution"
ODE = "inertialess equations by solve_ivp"
NAMES = ("D", "b/a", "c/a", "θ [deg]", "|ω_s3|/γ̇")
ALLOWED = (1e-4, 1e-4, 1e-4, 0.01, 1e-4)
RATIOS = (0.5, 1.0, 5.0, 20.0)
CAPILLARY = np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.8])


def _steady(integrator: str, Ca: Floats, ratio: float, end: float) -> Floats:
    """Return shapes (n, 5) at the time ``end``; γ̇ τ_s = 1e-6."""
    models = Models(integrator=integrator, tolerance=1e-6)
    cloud = unit_cloud(analytic.shear(1.0), Ca, 1e-6, 0.05, models, eta=ratio)
    advance_to(cloud, end)
    return shear_shapes(cloud)


def steady(quick: bool) -> Outcome:
    """Viscoelastic spheres in shear."""
    rows = []
    angles: list[Curve] = []
    shapes: list[Curve] = []
    Ca = CAPILLARY[[2, 4]] if quick else CAPILLARY
    for colour, ratio in enumerate((0.5, 5.0) if quick else RATIOS):
        roscoe = np.array([roscoe_at(c, ratio) for c in Ca])
        # The shape swings about the steady one, damped as exp(−t/τ), τ = Ca (3/2 + η_s/μ_f).
        end = 20.0 * (1.5 + ratio) * float(Ca.max())
        for integrator in ("stokes", "rosenbrock"):
            ours = _steady(integrator, Ca, ratio, max(end, 20.0))
            title = f"η_s/μ_f = {ratio:g}, {integrator}: {{}}, worst of Ca = {Ca[0]:g} to {Ca[-1]:g}"
            rows += worst_of_each(title, NAMES, ours, roscoe, ROSCOE, ALLOWED)
        labels = f"foamprb, η_s/μ_f = {ratio:g}", "Roscoe (1967)" if colour == 0 else ""
        for curves, k in ((shapes, 0), (angles, 3)):
            curves += compared(Ca, ours[:, k], roscoe[:, k], labels, colour)

    times = np.linspace(0.25, 5.0 if quick else 15.0, 20 if quick else 60)
    Ca_t, ratio_t = 0.4, 5.0
    expected = np.array(
        [
            shear_shape(F, inertialess_rate(F, SHEAR, Ca_t, ratio_t))
            for F in inertialess_history(SHEAR, Ca_t, times, ratio_t)
        ]
    )
    history: list[Curve] = [Curve(times, expected[:, 0], "solve_ivp", "reference")]
    for colour, integrator in enumerate(("stokes", "rosenbrock")):
        cloud = unit_cloud(
            analytic.shear(1.0), Ca_t, 1e-6, 0.05, Models(integrator=integrator, tolerance=1e-6), eta=ratio_t
        )
        ours = follow(cloud, times, shear_shapes)[:, 0]
        history.append(Curve(times, ours[:, 0], f"foamprb, {integrator}", colour=colour))
        title = f"η_s/μ_f = {ratio_t:g}, Ca = {Ca_t:g}, {integrator}: {{}}, worst of all times"
        for k in (0, 2, 3):
            row = title.format(NAMES[k]), ours[:, k], expected[:, k]
            rows.append(worst(*row, ODE, 10.0 * ALLOWED[k]))
    figure = Figure(
        "viscoelastic",
        f"Kelvin–Voigt spheres: steady deformation and angle, and the start with Ca = {Ca_t:g} and "
        f"η_s/μ_f = {ratio_t:g}.",
        [
            Panel("Ca = μ_f γ̇/μ_s", "D", shapes),
            Panel("Ca = μ_f γ̇/μ_s", "θ [deg]", angles),
            Panel("γ̇t", "D", history),
        ],
    )
    return Outcome(rows, [figure], [])
