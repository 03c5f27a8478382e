"""Pure rotation (Sect. 5.1, Fig. 4)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Outcome, Panel, Row, worst
from validation.references.inertia import Surroundings, rigid_sphere, uniform_gradient
from validation.runs import advance_to, history, measures, unit_cloud

FLUID = "spin of the fluid, which a body without inertia shares"
RIGID = "rigid sphere's equation of motion by solve_ivp"


def spin_up(quick: bool) -> Outcome:
    """Spin-up in pure rotation."""
    # Re = γ̇ d²/ν_f = 0.1 (53) with ρ_s = ρ_f: τ_s γ̇ = Re/60. Rates in units of γ̇, lengths of R.
    reynolds = 0.1
    tau = reynolds / 60.0
    dt = tau / (500.0 if quick else 2000.0)
    times = np.linspace(0.0, 8.0 * tau, 9 if quick else 41)[1:]
    cloud = unit_cloud(analytic.rotation(1.0), 1e-4, tau, dt, Models(integrator="paper"), 0.49)
    ours = history(cloud, times)
    gradient = np.array([[0.0, 0.5, 0.0], [-0.5, 0.0, 0.0], [0.0, 0.0, 0.0]])
    around = Surroundings(1.0, 15.0 * tau, np.zeros(3), uniform_gradient(gradient))
    rigid = rigid_sphere(1.0, 15.0 * tau, around, np.zeros(3), np.append(0.0, times))
    # M/(μ_f γ̇ d³) with d = 2.
    torque, expected = abs(ours.torque[:, 0]) / 8.0, abs(rigid.torque[1:]) / 8.0
    spin, expected_spin = abs(ours.spin[:, 0]), abs(rigid.spin[1:])
    allowed = 2e-3 if quick else 5e-4
    rows = [
        worst("|ω_s3|/γ̇, worst of all times", spin, expected_spin, RIGID, allowed),
        worst("M/(μ_f γ̇ d³), worst of all times", torque, expected, RIGID, 4.0 * allowed),
        worst("|ω_s3|/γ̇ at the end", spin[-1:], expected_spin[-1:], RIGID, 1e-4),
    ]
    # Steps a hundred times those of the paper's scheme, and no inertia at all.
    models = Models(integrator="rosenbrock", tolerance=1e-6)
    cloud = unit_cloud(analytic.rotation(1.0), 1e-4, tau, tau / 4.0, models, 0.49)
    coarse = history(cloud, tau * np.arange(1.0, 9.0))
    reference = rigid_sphere(1.0, 15.0 * tau, around, np.zeros(3), np.append(0.0, coarse.t))
    name = "|ω_s3|/γ̇, rosenbrock, worst of all times"
    rows.append(worst(name, abs(coarse.spin[:, 0]), abs(reference.spin[1:]), RIGID, 1e-3))
    cloud = unit_cloud(analytic.rotation(1.0), 1e-4, tau, 0.05, Models(integrator="stokes"), 0.49)
    advance_to(cloud, 1.0)
    rate = abs(float(measures(cloud)["angularVelocity"][0, 2]))
    rows.append(Row("|ω_s3|/γ̇ at γ̇t = 1, stokes", rate, 0.5, FLUID, 1e-6))
    t = np.append(0.0, times)
    figure = Figure(
        "rotation",
        "Fig. 4: Ca = 1e-4, Re = 0.1, ρ_s = ρ_f, started from rest.",
        [
            Panel(
                "γ̇t",
                "|ω_s3|/γ̇",
                [
                    Curve(times, spin, "foamprb, Ca = 1e-4"),
                    Curve(t, abs(rigid.spin), "rigid sphere", "reference"),
                ],
            ),
            Panel(
                "γ̇t",
                "M/(μ_f γ̇ d³)",
                [
                    Curve(times, torque, "foamprb, Ca = 1e-4"),
                    Curve(t, abs(rigid.torque) / 8.0, "rigid sphere", "reference"),
                ],
            ),
        ],
    )
    remarks = [
        "The paper does not print the density ratio of this case. With ρ_s = ρ_f the relaxation time of "
        "the spin is τ_s = ρ_s R²/(15 μ_f) = Re/(60 γ̇). As functions of t/τ_s the curves do not depend "
        "on the ratio."
    ]
    return Outcome(rows, [figure], remarks)
