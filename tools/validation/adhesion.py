"""Adhesion to a wall by bonds (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.body.brownian import BOLTZMANN
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Adhere
from foamprb.cloud.state import Status, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Outcome, Row

R, MU, K_ON, K_OFF, X_B, T = 2e-6, 1e-3, 2.0, 1.0, 4e-10, 300.0
REMARK = (
    "Spheres of radius 2 µm that lie on a wall in shear; k_on = 2 1/s, x_b = 0.4 nm. Allowed are four "
    "standard errors of a share."
)


def shares(quick: bool) -> Outcome:
    """Adhesion by bonds."""
    n = 1000 if quick else 20000
    rows = []
    for rate, k_off in ((0.0, 0.0), (0.0, K_OFF), (100.0, K_OFF), (300.0, K_OFF)):
        p = spheres(np.tile([0.0, 0.0, R * (1.0 + 1e-7)], (n, 1)), d=2.0 * R, rho=1200.0, mu=100.0)
        patch = Adhere(kOn=K_ON, kOff=k_off, xb=X_B, T=T)
        flow, water = analytic.shear_over_wall(rate), Medium(MU, 1000.0, (0.0, 0.0, -9.81))
        cloud = Cloud(p, flow, water, [patch], 2e-3, Models(integrator="stokes"), threads=1)
        force = 1.7005 * 6.0 * np.pi * MU * R * R * rate
        k = k_off * np.exp(force * X_B / (BOLTZMANN * T))
        for t in (0.2, 1.0):
            cloud.advance(round(t / cloud.dt) - cloud.step)
            ours = float(np.mean(p.status == Status.STUCK))
            expected = K_ON / (K_ON + k) * (1.0 - np.exp(-(K_ON + k) * t))
            allowed = 4.0 * np.sqrt(expected * (1.0 - expected) / n)
            title = f"γ̇ = {rate:g} 1/s, k_off = {k_off:g} 1/s: share stuck after {t:g} s"
            rows.append(Row(title, ours, float(expected), "Bell (1978)", float(allowed)))
    return Outcome(rows, [], [REMARK])
