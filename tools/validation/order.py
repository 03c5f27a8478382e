"""Temporal order of accuracy of the integrators."""

from __future__ import annotations

import math

import numpy as np

from foamprb.cloud.integrators.registry import INTEGRATORS
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row
from validation.references.shear import SHEAR, inertialess_history
from validation.runs import (
    DIAMETER,
    advance_to,
    pipe_cloud,
    soft_in_pipe,
    unit_cloud,
)


def _with_inertia(name: str, steps: Floats) -> Floats:
    """Return the error of x/d and F in the pipe after 2 ms, for each step, s."""
    end, Ca = 2e-3, 0.5
    body = soft_in_pipe(Ca, np.array([0.0, end]))
    errors = []
    for dt in steps:
        cloud = pipe_cloud(Ca, float(dt), Models(integrator=name, tolerance=math.inf))
        advance_to(cloud, end)
        p = cloud.particles
        miss = [*(p.x[0] - body.x[-1]) / DIAMETER, *(p.F[0] - body.F[-1].ravel())]
        errors.append(np.linalg.norm(miss))
    return np.array(errors)


def _without_inertia(name: str, steps: Floats) -> Floats:
    """Return the error of F in simple shear at γ̇t = 2 without inertia, for each step in 1/γ̇."""
    body = inertialess_history(SHEAR, 0.4, np.array([2.0]))[-1]
    errors = []
    for dt in steps:
        cloud = unit_cloud(
            analytic.shear(1.0), 0.4, 1e-6, float(dt), Models(integrator=name, tolerance=math.inf)
        )
        advance_to(cloud, 2.0)
        errors.append(np.linalg.norm(cloud.particles.F[0] - body.ravel()))
    return np.array(errors)


def order(quick: bool) -> Outcome:
    """Order of integrators."""
    rows = []
    inertial: list[Curve] = []
    inertialess: list[Curve] = []
    for colour, (name, integrator) in enumerate(INTEGRATORS.items()):
        slow = not integrator.inertia
        first = 0.1 if slow else (8e-5 if integrator.adaptive else 2e-5)
        # Of third order, a sixth halving comes near to the accuracy of the reference.
        halved = 4.0 if quick else (5.0 if integrator.adaptive else 6.0)
        steps = first * 0.5 ** np.arange(halved)
        errors = _without_inertia(name, steps) if slow else _with_inertia(name, steps)
        slopes = np.log2(errors[:-1] / errors[1:])
        flow = "simple shear, Ca = 0.4, γ̇t = 2" if slow else "pipe, Ca = 0.5, 2 ms"
        rows.append(
            Row(
                f"{name}: order ({flow})",
                float(slopes[-1]),
                float(integrator.order),
                "error against solve_ivp over Δt",
                0.15,
            )
        )
        target = inertialess if slow else inertial
        target.append(Curve(steps, errors, f"{name}", colour=colour))
        guide = errors[0] * (steps / steps[0]) ** integrator.order
        target.append(Curve(steps, guide, f"order {integrator.order}", "guide", colour))
    panels = [Panel("Δt [s]", "error of x/d and F", inertial, "log")]
    if inertialess:
        panels.append(Panel("γ̇Δt", "error of F", inertialess, "log"))
    return Outcome(
        rows, [Figure("order", "Error against the solution by solve_ivp, fixed steps.", panels)], []
    )
