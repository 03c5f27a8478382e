"""Swimmers: displacement of active Brownian particles (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.body.brownian import BOLTZMANN
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import swimming_direction
from foamprb.cloud.state import set_rest_shape, spheres
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.brownian import BrownianMotion
from foamprb.cloud.surroundings.swimming import Swimming
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Outcome, Row

R, V, T, MU_F = 0.5e-6, 20e-6, 298.15, 0.89e-3
KT = BOLTZMANN * T
TURNS, MOVES = KT / (8.0 * np.pi * MU_F * R**3), KT / (6.0 * np.pi * MU_F * R)
TIMES = (0.1, 1.0, 10.0)
REMARK = (
    "Bacteria of radius 0.5 µm that swim at 20 µm/s in water at 25 °C. Allowed are four standard errors; the "
    "time step adds less than half a per cent."
)


def squares(n: int, dt: float, models: tuple[Surrounding, ...]) -> list[tuple[float, float]]:
    """Return the mean square displacements at :data:`TIMES`, m², and their standard errors."""
    p = spheres(np.zeros((n, 3)), d=2.0 * R, rho=1000.0, mu=1e5, poissons_ratio=0.4999)
    flow, water = analytic.linear(np.zeros((3, 3))), Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
    cloud = Cloud(p, flow, water, (), dt, Models(integrator="stokes", surroundings=models), threads=1)
    means = []
    for t in TIMES:
        cloud.advance(round(t / dt) - cloud.step)
        each = (p.x**2).sum(axis=1)
        means.append((float(each.mean()), float(each.std() / np.sqrt(n))))
    return means


def expected(t: float, molecules: bool) -> float:
    """Return 2 v²/(2D_R)² (2D_R t − 1 + exp(−2D_R t)), and 6 D t with molecules, m²."""
    x = 2.0 * TURNS * t
    return float(2.0 * (V / (2.0 * TURNS)) ** 2 * (x + np.expm1(-x)) + 6.0 * MOVES * t * molecules)


def swimmers(quick: bool) -> Outcome:
    """Diffusion of swimmers."""
    n, dt = (1000, 2e-2) if quick else (10000, 2e-3)
    rows = []
    for molecules, name in ((True, "BrownianMotion"), (False, "rotationalDiffusivity")):
        swimming = Swimming(speed=V, rotationalDiffusivity=0.0 if molecules else TURNS)
        models = (BrownianMotion(T=T), swimming) if molecules else (swimming,)
        for t, (ours, error) in zip(TIMES, squares(n, dt, models), strict=True):
            reference = expected(t, molecules)
            allowed = 4.0 * error / reference + 1.5 * TURNS * dt
            rows.append(
                Row(f"{name}, {t:g} s: ⟨Δx²⟩ [m²]", ours, reference, "Howse et al. (2007)", allowed,
                    relative=True)
            )  # fmt: skip
    return Outcome([*rows, _turning()], [], [REMARK])


def _turning() -> Row:
    """Compare the direction of a spheroid 3 : 1 in shear with Jeffery's orbit."""
    ratio, rate, t = 3.0, 10.0, 0.5
    p = spheres(np.zeros((1, 3)), d=2.0 * R, rho=1000.0, mu=1e5, poissons_ratio=0.4999)
    set_rest_shape(p, (1.0, ratio, 1.0))
    flow, water = analytic.shear(rate), Medium(MU_F, 1000.0, (0.0, 0.0, 0.0))
    models = Models(integrator="stokes", surroundings=(Swimming(speed=V, direction=(0.0, 1.0, 0.0)),))
    Cloud(p, flow, water, (), 1e-3, models, threads=1).advance(500)
    x, y, _ = swimming_direction(p)[0]
    angle = np.arctan(ratio * np.tan(rate * t / (ratio + 1.0 / ratio)))
    return Row("spheroid 3 : 1, angle to the gradient [rad]", float(np.arctan2(x, y)), float(angle),
               "Jeffery (1922)", 1e-4)  # fmt: skip
