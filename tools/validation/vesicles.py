"""Vesicles: fluid membranes of constant area (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import quad

from foamprb.cloud.state import set_excess_area
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row
from validation.runs import advance_to, gradients, principal_axes, shear_shapes, unit_cloud

KELLER = "Keller & Skalak (1982), for the same shape"
BALANCE = "the steady equations of the body, by Newton's method"
STEADY = {
    0.2: ((1.2065, 0.8546, 0.9699), (38.287, 35.309, 31.730, 28.236, 24.746, 21.162)),
    0.5: ((1.3621, 0.7905, 0.9287), (34.431, 30.127, 25.206, 20.515, 15.722, 10.176)),
    1.0: ((1.5747, 0.7308, 0.8690), (30.165, 24.895, 19.256, 13.977, 8.055)),
}
"""Semi-axes (the last along the vorticity), and inclinations, °, at some λ, by the excess area."""
RATIOS = (0.2, 1.0, 2.0, 3.0, 4.0, 5.0)
NEAR = (0.96, 0.98)
"""Viscosity ratios over the critical one from which it is extrapolated."""


def overlap(axes: Floats) -> float:
    """Return g = ∫ ds/((a₁² + s)(a₂² + s) Δ) over s ≥ 0, Δ² = Π (a_i² + s), for a₁a₂a₃ = 1."""
    a, b, c = (x * x for x in axes)

    def integrand(u: float) -> float:
        # s = (1 − u)/u, finite at both ends.
        s = (1.0 - u) / u
        return float(((a + s) * (b + s)) ** -1.5 * (c + s) ** -0.5 / u**2)

    return float(quad(integrand, 0.0, 1.0, epsabs=1e-12)[0])


def inclination(axes: Floats, ratio: float) -> float:
    """Return the steady angle, °, of an ellipsoid whose surface treads; NaN where it tumbles."""
    r, f2 = axes[0] / axes[1], 0.5 * overlap(axes) * (axes[0] ** 2 + axes[1] ** 2)
    f0, f1 = 2.0 / (r + 1.0 / r), 0.5 * (r - 1.0 / r)
    B = f0 * (f1 + 1.0 / (f1 * (1.0 + f2 * (ratio - 1.0))))
    return float(np.degrees(0.5 * np.arccos(1.0 / B))) if B > 1.0 else np.nan


def _steady(excess: float, ratios: Floats, end: float) -> tuple[Floats, Floats]:
    """Return semi-axes (n, 3), along the flow, across and along the vorticity, and angles, °."""
    models = Models(integrator="stokes", tolerance=1e-7, material="capsule fluid")
    cloud = unit_cloud(analytic.shear(1.0), np.ones(len(ratios)), 1e-6, 0.02, models, eta=ratios)
    set_excess_area(cloud.particles, excess)
    advance_to(cloud, end)
    F, _ = gradients(cloud.particles)
    axes, _ = principal_axes(cloud.particles)
    across = np.linalg.norm(F[:, 2], axis=1)
    return np.column_stack([axes[:, 2], 1.0 / (axes[:, 2] * across), across]), shear_shapes(cloud)[:, 3]


def treading(quick: bool) -> Outcome:
    """Vesicles in shear flow."""
    rows, curves, end = [], [], 40.0 if quick else 100.0
    for k, (excess, (shape, angles)) in enumerate(STEADY.items()):
        ratios = np.array(RATIOS[: len(angles)])
        axes, found = _steady(excess, ratios, end)
        name = f"excess area {excess:g}"
        for axis, ours, expected in zip(("a₁", "a₂", "a₃"), axes[1].tolist(), shape, strict=True):
            rows.append(Row(f"{name}, λ = 1: {axis}/R", ours, expected, BALANCE, 1e-3))
        for ratio, ours, own, expected in zip(ratios.tolist(), found.tolist(), axes, angles, strict=True):
            quantity = f"{name}, λ = {ratio:g}: θ, °"
            rows.append(Row(quantity, ours, expected, BALANCE, 0.01))
            rows.append(Row(quantity, ours, inclination(own, ratio), KELLER, 0.01, kind="others"))
        critical = 1.0 + 2.0 / (overlap(axes[1]) * (axes[1, 0] ** 2 - axes[1, 1] ** 2))
        near = critical * np.array(NEAR)
        squares = np.sin(np.radians(_steady(excess, near, 5.0 * end)[1])) ** 2
        limit = near[1] + squares[1] * (near[1] - near[0]) / (squares[0] - squares[1])
        rows.append(
            Row(f"{name}: λ from which θ = 0", float(limit), critical, KELLER, 1e-3, True, kind="others")
        )
        fine = np.linspace(0.1, critical, 200)
        theory = np.array([inclination(axes[1], float(x)) for x in fine])
        curves += [Curve(fine, theory, f"Keller & Skalak, {name}", "guide", k)]
        curves += [Curve(ratios, found, f"foamprb, {name}", "reference", k)]
    figure = Figure(
        "vesicles",
        "Inclination of tank-treading vesicles in simple shear.",
        [Panel("viscosity ratio λ", "θ, °", curves)],
    )
    return Outcome(rows, [figure], [_REMARK])


_REMARK = (
    "The shape of a vesicle in steady shear does not depend on the viscosity inside. Keller and Skalak's "
    "balance of power is that of a body whose tension keeps its area. The angles agree to the error of the "
    "steps."
)
