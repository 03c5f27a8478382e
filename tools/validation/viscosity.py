"""Carriers whose viscosity varies (beyond the paper)."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np
from scipy.integrate import solve_ivp

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import BirdCarreau, PowerLaw
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst
from validation.references.shear import inertialess_rate, shear_shape, steady_shear
from validation.runs import NEARLY_INCOMPRESSIBLE, REST, advance_to, follow, gradients, measures, shear_shapes

K, N, TAU, A = 0.5, 0.6, 1.0, 1e-3
"""Pa sⁿ, 1; stress at the wall of the pipe, Pa, and its radius, m."""
MU_S = 10.0
"""Shear modulus of the bodies, Pa."""
BLOOD = BirdCarreau(mu0=0.056, muInf=0.00345, k=3.313, n=0.3568)
"""Cho and Kensey (1991)."""
CHO = {1.0: 0.027098, 10.0: 0.008979, 100.0: 0.004708, 1000.0: 0.003736}
"""Pa s by shear rate, 1/s."""
PIPE = {0.25: (0.31498, 0.79370), 0.5: (1.0, 0.5), 1.0: (3.17480, 0.31498)}
"""γ̇, 1/s, and μ_f, Pa s, by r/a, in closed form."""
ODE = "inertialess equations with μ_f(γ̇(t)) by solve_ivp"


def pipe_velocity(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return the velocity of a power-law fluid in a pipe along x, m/s, unbounded."""
    r = math.sqrt(y * y + z * z) / 1e-3
    return 0.375 * 2.0 ** (5.0 / 3.0) * 1e-3 * (1.0 - r ** (8.0 / 3.0)), 0.0 * x, 0.0 * x


def sink_velocity(x: float, y: float, z: float) -> tuple[float, float, float]:
    """Return the velocity towards a point sink of 1 m³/s over 4π, m/s."""
    c = -1.0 / (x * x + y * y + z * z) ** 1.5
    return c * x, c * y, c * z


def _bodies(flow: analytic.AnalyticFlow, x: Floats, law: PowerLaw, models: Models, dt: float) -> Cloud:
    p = spheres(x, d=1e-5, rho=1000.0, mu=MU_S, poissons_ratio=NEARLY_INCOMPRESSIBLE)
    return Cloud(p, flow, Medium(law, 1000.0, REST), (), dt, models, threads=1)


def _pipe(integrators: Sequence[str]) -> list[Row]:
    """Compare steady bodies in a power-law pipe, where Ca is the stress over μ_s, whatever n is."""
    rows: list[Row] = []
    x = np.array([(0.0, 1e-3 * r, 0.0) for r in PIPE])
    for integrator in integrators:
        cloud = _bodies(
            analytic.function(pipe_velocity), x, PowerLaw(k=K, n=N),
            Models(integrator=integrator, tolerance=1e-7), 0.05,
        )  # fmt: skip
        advance_to(cloud, 10.0)
        ours, rate = shear_shapes(cloud)[:, 0], measures(cloud)["shearRate"]
        mu = measures(cloud)["capillaryNumber"] * MU_S / rate
        for i, (r, (known_rate, known_mu)) in enumerate(PIPE.items()):
            where = f"power-law pipe, {integrator}, r/a = {r:g}"
            if integrator == "stokes":
                rows.append(Row(f"{where}: γ̇ [1/s]", rate[i], known_rate, "closed form", 5e-6))
                rows.append(Row(f"{where}: μ_f [Pa s]", mu[i], known_mu, "closed form", 5e-6))
            expected = float(steady_shear(r * TAU / MU_S)[0])
            rows.append(Row(f"{where}: D", ours[i], expected, "Ca = τ/μ_s, by solve_ivp", 2e-6))
    return rows


def _on_the_way(law: PowerLaw, models: Models, start: float, times: Floats) -> Floats:
    """Return D of a body on its way to the sink, (n,)."""
    x, dt = np.array([(start, 0.0, 0.0)]), float(times[0]) / 4.0
    cloud = _bodies(analytic.function(sink_velocity), x, law, models, dt)
    return follow(cloud, times, lambda c: shear_shape(gradients(c.particles)[0][0], np.eye(3))[0])


def _sink(quick: bool, integrators: Sequence[str]) -> tuple[list[Row], Figure]:
    """Compare bodies that approach a sink: the shear rate rises by a factor of 20, and the fluid thins."""
    law, start = PowerLaw(k=8.0, n=0.4), 1.0
    times = np.linspace(0.0, 0.3166, 8 if quick else 30)[1:]

    def derivative(t: float, F: Floats) -> Floats:
        r3 = start**3 - 3.0 * t
        l = np.diag([2.0, -1.0, -1.0]) / r3
        rate = math.sqrt(12.0) / r3
        return np.asarray(
            inertialess_rate(F.reshape(3, 3), l, law.k * rate ** (law.n - 1.0) / MU_S) @ F.reshape(3, 3)
        ).ravel()

    expected = solve_ivp(
        derivative, (0.0, times[-1]), np.eye(3).ravel(), t_eval=times, rtol=1e-10, atol=1e-12
    )
    reference = np.array([shear_shape(F.reshape(3, 3), np.eye(3))[0] for F in expected.y.T])
    rows, curves = [], [Curve(times, reference, "solve_ivp", "reference")]
    for colour, integrator in enumerate(integrators):
        ours = _on_the_way(law, Models(integrator=integrator, tolerance=1e-6), start, times)
        curves.append(Curve(times, ours, f"foamprb, {integrator}", colour=colour))
        rows.append(worst(f"towards a sink, {integrator}: D, worst of all times", ours, reference, ODE, 1e-4))
    constant = PowerLaw(k=law.at_rate(math.sqrt(12.0)), n=1.0)
    ours = _on_the_way(constant, Models(integrator="stokes"), start, times)
    curves.append(Curve(times, ours, "viscosity of the start", "guide"))
    figure = Figure(
        "carrier",
        "Soft body on its way to a sink in a power-law fluid of n = 0.4; the shear rate rises 20 times.",
        [Panel("t [s]", "D", curves)],
    )
    return rows, figure


def carriers(quick: bool) -> Outcome:
    """Shear-thinning fluids."""
    rows = [
        Row(
            f"BirdCarreau of blood, γ̇ = {rate:g} 1/s: μ_f [Pa s]",
            BLOOD.at_rate(rate),
            expected,
            "closed form",
            5e-7,
        )
        for rate, expected in CHO.items()
    ]
    integrators = ("stokes", "rosenbrock")[: 1 if quick else 2]
    more, figure = _sink(quick, integrators)
    return Outcome([*rows, *_pipe(integrators), *more], [figure], [])
