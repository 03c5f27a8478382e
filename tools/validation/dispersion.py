"""Dispersion by eddies: their velocities, Taylor's dispersion, crossing, and decaying turbulence."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from foamprb.body.tensor import Vector
from foamprb.body.turbulence import BETA_STAR
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, spheres
from foamprb.cloud.surroundings.dispersion import StochasticDispersion
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Floats, Turbulence
from validation.case import Curve, Figure, Outcome, Panel, Row

SIGMA, LIFE = 1.0, 1.0
"""√(2k/3), m/s, and k/ε, s."""
K = 1.5 * SIGMA**2
LENGTH = 10.0
"""In which k falls by a factor e, m."""
_R, _MU_F, _G = 5e-4, 1e-3, 9.81


class EddyArrays(NamedTuple):
    """A uniform flow with k = K exp(−x/L) and ε = k/T."""

    u0: Floats
    l: Floats
    decay: float
    """1/L, 1/m."""


def turbulence(flow: EddyArrays, host: int, x: Vector, t: float) -> Turbulence:  # noqa: ARG001
    """Return k, ε, ∇k and ∇(k²/3ε)."""
    k = K * np.exp(-flow.decay * x[0])
    slope = -flow.decay * k
    return k, k / LIFE, (slope, 0.0, 0.0), (LIFE / 3.0 * slope, 0.0, 0.0)


def dispersion(quick: bool) -> Outcome:
    """Turbulent dispersion."""
    n = 4000 if quick else 20000
    # Four standard errors of a variance of three components.
    allowed = 4.0 * float(np.sqrt(2.0 / (3 * n)))
    rows = []
    p = _carried(n, 1, 0.001)
    rows.append(
        Row(
            "⟨u'²⟩ of each component over 2k/3",
            float((p.eddy**2).mean() / SIGMA**2),
            1.0,
            "isotropy",
            allowed,
        )
    )
    dt = 0.05
    p, cloud = _released(n, dt)
    times, variances = [], []
    while cloud.step < 100:
        cloud.advance(5)
        times.append(cloud.time)
        variances.append(float((p.x**2).mean()))
    t, variance = np.array(times), np.array(variances)
    taylor = _taylor(t)
    for at in (0.5, 1.0, 2.0, 5.0):
        k = int(np.argmin(np.abs(t - at)))
        rows.append(
            Row(
                f"⟨x²⟩/(σT)² at t = {at:g} T", variance[k], taylor[k], "Taylor (1922)", allowed, relative=True
            )
        )
    p = _carried(n, 20, 3.0)
    rows.append(
        Row("⟨x²⟩/(σ²Tt) with steps of 3 T", float((p.x**2).mean() / 60.0), 1.0, "σ²T t", allowed)
    )  # fmt: skip
    slip = 5.0 * SIGMA
    share = BETA_STAR**0.75 * float(np.sqrt(K)) / slip
    p = _carried(n, 500, 0.01, settling=slip)
    rows.append(
        Row("settling at 5σ: ⟨y²⟩/(σ²Tt)", float((p.x[:, :2] ** 2).mean() / 5.0), share, "length over slip",
            1.5 * allowed + 0.04, relative=True)
    )  # fmt: skip
    error = 4.0 / float(np.sqrt(10.0 * n))
    for corrected, expected in ((False, 0.0), (True, -K * LIFE / 3.0 / LENGTH)):
        p = _carried(n, 40, 0.25, decay=1.0 / LENGTH, model=StochasticDispersion(driftCorrection=corrected))
        drift = float(p.x[:, 0].mean()) / 10.0
        title = "decaying k: mean velocity of tracers"
        if corrected:
            rows.append(Row(f"{title}, corrected", drift, expected, "∇(k²/3ε)", error + 0.01))
        else:
            rows.append(Row(f"{title} over σ", drift, expected, "Itô's walk", error))
    figure = Figure(
        "dispersion",
        "Dispersion of tracers by eddies of one lifetime T: ours, and Taylor's.",
        [
            Panel(
                "t/T",
                "⟨x²⟩/(σT)²",
                [Curve(t, variance, "ours"), Curve(t, taylor, "Taylor (1922)", "reference")],
            )
        ],
    )
    remark = (
        "Allowed are four standard errors of the mean. Crossing eddies adds 4 %, as the first eddy starts "
        "with the particle at rest, and the corrected drift 0.01, as it changes along the path."
    )
    return Outcome(rows, [figure], [remark])


def _taylor(t: Floats) -> Floats:
    """Return ⟨x²⟩ of successive eddies of lifetime T: σ² (m T² + (t − m T)²), m = ⌊t/T⌋."""
    lives = np.floor(t / LIFE + 1e-9)
    spread: Floats = SIGMA**2 * (lives * LIFE**2 + (t - lives * LIFE) ** 2)
    return spread


def _released(
    n: int, dt: float, *, settling: float = 0.0, decay: float = 0.0, model: Any = None
) -> tuple[Particles, Cloud]:
    """Return spheres at the origin: settling ones if a speed is given, else tracers."""
    flow = EddyArrays(np.zeros(3), np.zeros(9), decay)
    kernels: dict[str, Any] = {**analytic.linear(np.zeros((3, 3))).kernels, "turbulence": turbulence}
    heavier = 9.0 * _MU_F * settling / (2.0 * _G * _R**2)
    p = spheres(np.zeros((n, 3)), d=2.0 * _R, rho=1000.0 + heavier, mu=1e4, poissons_ratio=0.4999)
    medium = Medium(_MU_F, 1000.0, (0.0, 0.0, -_G if settling else 0.0))
    models = Models(integrator="stokes", surroundings=(model or StochasticDispersion(),))
    return p, Cloud(p, analytic.AnalyticFlow(flow, kernels), medium, (), dt, models, threads=1)


def _carried(n: int, steps: int, dt: float, **options: Any) -> Particles:
    p, cloud = _released(n, dt, **options)
    cloud.advance(steps)
    return p
