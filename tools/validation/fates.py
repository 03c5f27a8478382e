"""Rupture and release at limits (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, spheres
from foamprb.cloud.surroundings.fates import FateLimits, Fates
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Flow
from validation.case import Outcome, Row

MU, RATE = 1e-3, 10.0
REMARK = "A fate is that of the first step at whose start a limit is reached: at most one step late."


def _carried(p: Particles, flow: Flow, dt: float, fates: Fates) -> Particles:
    models = Models(integrator="stokes", surroundings=(fates,))
    Cloud(p, flow, Medium(MU, 1000.0, (0.0, 0.0, 0.0)), (), dt, models, threads=1).advance(round(0.3 / dt))
    return p


def limits(quick: bool) -> Outcome:
    """Rupture and release."""
    dt = 1e-3 if quick else 1e-4
    flow = analytic.linear(np.diag([RATE, -0.5 * RATE, -0.5 * RATE]))
    stress = MU * np.sqrt(3.0) * RATE
    rows = []
    for stretch in (1.5, 4.0):
        # As viscous as the fluid, with hardly an elasticity, a body deforms as the fluid.
        p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1e-9, eta=MU, poissons_ratio=0.4999)
        t = _carried(p, flow, dt, Fates(ruptured=FateLimits(stretch=stretch))).t[0]
        rows.append(Row(f"rupture at the stretch {stretch:g}: t [s]", t, np.log(stretch) / RATE, "ln λ/ε̇",
                        1.01 * dt))  # fmt: skip
    # A stiff body relaxes by exp(−t/τ), τ = 3 μ_f/(2 μ_s), to the elastic stress of 15/2 μ_f ε̇.
    p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1.0, poissons_ratio=0.4999)
    dt_fast, most = 0.01 * 1.5 * MU, 7.5 * MU * RATE
    t = _carried(p, flow, dt_fast, Fates(ruptured=FateLimits(stress=0.5 * most))).t[0]
    rows.append(Row("rupture at half of the steady elastic stress: t [s]", t, 1.5 * MU * np.log(2.0),
                    "small strains", 0.05 * 1.5 * MU))  # fmt: skip
    for share in (0.1, 0.2):
        p = spheres(np.zeros((1, 3)), d=1e-5, rho=1000.0, mu=1.0, poissons_ratio=0.4999)
        t = _carried(p, flow, dt, Fates(released=FateLimits(dose=share * stress))).t[0]
        rows.append(Row(f"release at the dose {share:g} s · μ γ̇: t [s]", t, share, "dose over stress",
                        1.01 * dt))  # fmt: skip
    return Outcome(rows, [], [REMARK])
