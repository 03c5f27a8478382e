"""Brownian motion: diffusion of spheres and spheroids, and fluctuations of shapes (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.body.brownian import BOLTZMANN
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, set_rest_shape, spheres
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Outcome, Row
from validation.references import wall as ref

R, MU_F, T = 0.5e-6, 1e-3, 300.0
KT = BOLTZMANN * T


def brownian(quick: bool) -> Outcome:
    """Brownian motion at rest."""
    n = 4000 if quick else 40000
    # Four standard errors of a variance.
    allowed = 4.0 * float(np.sqrt(2.0 / n))
    D = KT / (6.0 * np.pi * MU_F * R)
    dt = 1e-4
    rows = []
    p = _carried(_beads(n), 1, dt)
    variance = float((p.x**2).mean() / (2.0 * D * dt))
    rows.append(
        Row("sphere: ⟨Δx²⟩/(2DΔt), mean of the components", variance, 1.0, "Einstein (1905)", allowed)
    )
    for ratio in (3.0, 1.0 / 3.0):
        p = _beads(n)
        set_rest_shape(p, (ratio, 1.0, 1.0))
        x = (_carried(p, 1, dt).x ** 2).mean(axis=0) / (2.0 * D * dt)
        along, across = ref.perrin_translation(ratio)
        title, source = f"spheroid 1 : {1.0 / ratio:.3g}", "Perrin (1936)"
        rows.append(Row(f"{title}, along its axis", float(x[0]), 1.0 / along, source, allowed, relative=True))
        rows.append(Row(f"{title}, across", float(x[1]), 1.0 / across, source, allowed, relative=True))
    mu = 50.0
    volume = 4.0 / 3.0 * np.pi * R**3
    p = _carried(_beads(n // 4, mu), 100, 0.1 * 1.5 * MU_F / mu)
    F = p.F.reshape(-1, 3, 3)
    energy = float((0.5 * mu * volume * (np.einsum("nij,nij->n", F, F) - 3.0) / KT).mean())
    expected = ref.mean_shape_energy(KT / (mu * volume))
    spread = 4.0 * float(np.sqrt(0.4 / (n // 4))) + 0.03
    rows.append(
        Row("soft spheres: mean stored energy over kT", energy, expected, "integral over the shapes", spread,
            relative=True)
    )  # fmt: skip
    remark = "Allowed are four standard errors of the mean; the time step of the energy adds 3 %."
    return Outcome(rows, [], [remark])


def _beads(n: int, mu: float = 1e4) -> Particles:
    return spheres(np.zeros((n, 3)), d=2.0 * R, rho=1000.0, mu=mu, poissons_ratio=0.4999)


def _carried(p: Particles, steps: int, dt: float) -> Particles:
    models = Models(integrator="stokes", surroundings=(BrownianMotion(T=T),))
    flow, water = analytic.linear(np.zeros((3, 3))), Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
    Cloud(p, flow, water, (), dt, models, threads=1).advance(steps)
    return p
