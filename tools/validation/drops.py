"""Drops after Maffettone and Minale (beyond the paper)."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike
from scipy.optimize import brentq

from foamprb.body.morphology import drop_growth
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import drops as drops_at
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Flow
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst
from validation.references.drop import steady_stress
from validation.references.morphology import angle, of_drop, shapes, taylor
from validation.references.shear import SHEAR
from validation.runs import advance_to, follow, measures

ODE = "equation of S by LSODA"
GRACE = "Grace (1982), in the fit of de Bruijn (1989)"
RATIOS, NUMBERS = (0.1, 1.0, 5.0), np.array([0.1, 0.2, 0.3])


def _cloud(flow: Flow, Ca: ArrayLike, ratio: float, dt: float, gravity: float = 0.0) -> Cloud:
    """Return drops of radius 1 in a fluid of viscosity 1 and shear rate 1; the density is 1 more than its."""
    Ca = np.atleast_1d(np.asarray(Ca, dtype=float))
    p = drops_at(np.zeros((len(Ca), 3)), d=2.0, rho=1.000001e-4, gamma=1.0 / Ca, eta=ratio)
    medium = Medium(1.0, 1e-10, (0.0, 0.0, -gravity))
    return Cloud(p, flow, medium, (), dt, Models(material="drop", tolerance=1e-6), threads=1)


def _tensors(cloud: Cloud) -> Floats:
    F = cloud.particles.F.reshape(-1, 3, 3)
    return np.asarray(F @ F.transpose(0, 2, 1))


def _steady(ratio: float) -> tuple[list[Row], list[Curve]]:
    """Compare steady shapes in shear."""
    cloud = _cloud(analytic.shear(1.0), NUMBERS, ratio, 0.05)
    advance_to(cloud, 100.0)
    ours = _tensors(cloud)
    exact = [shapes(Ca * SHEAR, of_drop(ratio, Ca), np.array([400.0]))[0] for Ca in NUMBERS]
    expected = np.array(exact)
    rows = []
    for k, Ca in enumerate(NUMBERS):
        name = f"λ = {ratio:g}, Ca = {Ca:g}: "
        rows.append(Row(f"{name}D", taylor(ours)[k], taylor(expected)[k], ODE, 1e-6))
        rows.append(Row(f"{name}θ [deg]", angle(ours)[k], angle(expected)[k], ODE, 1e-3))
    volume = float(np.abs(np.linalg.det(ours) - 1.0).max())
    rows.append(Row(f"λ = {ratio:g}: |det S − 1|, worst", volume, 0.0, "the equation", 1e-13))
    colour = RATIOS.index(ratio)
    labels = f"foamprb, λ = {ratio:g}", "LSODA" if colour == 0 else ""
    return rows, [
        *compared(NUMBERS, taylor(ours), taylor(expected), labels, colour),
        Curve(NUMBERS, (19.0 * ratio + 16.0) / (16.0 * ratio + 16.0) * NUMBERS, "Taylor", "guide", colour),
    ]


def _transient(quick: bool) -> tuple[list[Row], list[Curve]]:
    """Compare the start of a shear, and an elongated drop that becomes round."""
    times = np.linspace(0.5, 4.0 if quick else 10.0, 8 if quick else 20)
    rows, curves = [], []
    for k, (name, l, start) in enumerate(
        (
            ("start of shear", SHEAR, np.eye(3)),
            ("relaxation", np.zeros((3, 3)), np.diag(np.exp([1.2, -0.4, -0.8]))),
        )
    ):
        # Time in μ_f R/σ at Ca = 0.3.
        cloud = _cloud(analytic.linear(l), 0.3, 1.0, 0.05)
        cloud.particles.F[:] = np.sqrt(start).ravel()
        ours = taylor(follow(cloud, times, _tensors)[:, 0])
        expected = taylor(shapes(0.3 * l, of_drop(1.0, 0.3 if k == 0 else 0.0), times / 0.3, start))
        rows.append(worst(f"{name}, λ = 1, μ_f R/σ = 0.3: D, worst of all times", ours, expected, ODE, 1e-4))
        curves += compared(times, ours, expected, (f"foamprb, {name}", "LSODA" if k == 0 else ""), k)
    return rows, curves


def _settling(ratio: float) -> list[Row]:
    """Compare the settling and the stress of nearly round drops."""
    cloud = _cloud(analytic.shear(1.0), 1e-3, ratio, 0.05, gravity=1.0)
    advance_to(cloud, 5.0)
    p = cloud.particles
    stokes = 2.0 / 9.0 * (p.rho[0] - cloud.medium.rho)
    speed = float(-p.v[0, 2] / stokes)
    stress = float(measures(cloud)["stresslet"][0, 3] / (4.0 / 3.0 * np.pi))
    by_hadamard = (3.0 + 3.0 * ratio) / (2.0 + 3.0 * ratio)
    by_taylor = (5.0 * ratio + 2.0) / (2.0 * ratio + 2.0)
    name = f"λ = {ratio:g}, Ca = 0.001: "
    return [
        Row(f"{name}settling speed over a solid's", speed, by_hadamard, "Hadamard, Rybczyński (1911)", 1e-3),
        Row(f"{name}shear stress over 2 μ_f E₁₂", stress, by_taylor, "Taylor (1932)", 1e-3),
    ]


def _normal_stresses(ratio: float) -> list[Row]:
    """Compare the stress of second order in shear and in uniaxial extension, over Ca μ_f γ̇ V."""
    Ca = 5e-4
    by_shear = _stress(analytic.shear(1.0), Ca, ratio)
    second = steady_stress(ratio).second
    N1 = (19.0 * ratio + 16.0) ** 2 / (40.0 * (ratio + 1.0) ** 2)
    N2 = -(19.0 * ratio + 16.0) * (29.0 * ratio**2 + 61.0 * ratio + 50.0) / (280.0 * (ratio + 1.0) ** 3)
    extension = analytic.linear(np.diag([-0.5, -0.5, 1.0]) / np.sqrt(3.0))
    by_extension = _stress(extension, Ca, ratio)
    first = (5.0 * ratio + 2.0) / (ratio + 1.0) / np.sqrt(3.0)
    name = f"λ = {ratio:g}, Ca = {Ca:g}: "
    theory = "Schowalter, Chaffey & Brenner (1968)"
    return [
        Row(f"{name}N₁/(Ca μ_f γ̇ V)", float(by_shear[0] - by_shear[1]) / Ca, N1, theory, 1e-2, True),
        Row(f"{name}N₂/(Ca μ_f γ̇ V)", float(by_shear[1] - by_shear[2]) / Ca, N2, theory, 1e-2, True),
        Row(f"{name}N₂ + N₁/2", N2 + 0.5 * N1, 0.25 * second, "perturbation of a sphere", 1e-12),
        Row(
            f"{name}stress of second order in extension",
            (float(by_extension[2]) - first) / Ca,
            second / 6.0,
            "perturbation of a sphere",
            1e-2,
            True,
        ),
    ]


def _stress(flow: Flow, Ca: float, ratio: float) -> Floats:
    """Return the steady stresslet over μ_f γ̇ V, (6,): xx yy zz xy yz xz."""
    cloud = _cloud(flow, Ca, ratio, 0.01)
    advance_to(cloud, 40.0 * Ca * (1.0 + ratio))
    return np.asarray(measures(cloud)["stresslet"][0] / (4.0 / 3.0 * np.pi))


def _breakup() -> list[Row]:
    """Compare the capillary numbers in simple shear beyond which a drop has no steady shape."""
    rows = []
    for ratio in (0.1, 0.3, 1.0, 2.0, 3.0):

        def excess(Ca: float, ratio: float = ratio) -> float:
            growing, limit = drop_growth(tuple(SHEAR.ravel()), ratio, Ca)
            return float(np.linalg.eigvals(np.reshape(growing, (3, 3))).real.max() - limit)

        log = np.log10(ratio)
        measured = 10.0 ** (-0.506 - 0.0994 * log + 0.124 * log**2 - 0.115 / (log - np.log10(4.08)))
        title = f"λ = {ratio:g}: critical Ca in simple shear"
        ours = float(brentq(excess, 1e-3, 50.0))
        rows.append(Row(title, ours, float(measured), GRACE, 0.2, relative=True, kind="measured"))
    return rows


def steady(quick: bool) -> Outcome:
    """Drops in shear flow."""
    rows: list[Row] = []
    curves: list[Curve] = []
    for ratio in RATIOS[:2] if quick else RATIOS:
        more, lines = _steady(ratio)
        rows += more
        curves += lines
        rows += [*_settling(ratio), *_normal_stresses(ratio)]
    rows += _breakup()
    more, lines = _transient(quick)
    figure = Figure(
        "drops",
        "Steady drops in simple shear; the start of a shear, and an elongated drop that becomes round.",
        [Panel("Ca = μ_f γ̇ R/σ", "D", curves), Panel("γ̇ t", "D", lines)],
    )
    return Outcome([*rows, *more], [figure], [_REMARK])


_REMARK = (
    "The model of Maffettone and Minale (1998) is compared with an independent solution of its equation, and "
    "with the exact results for nearly round drops; breakup with the experiments of Grace."
)
