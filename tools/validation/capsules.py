"""Capsules whose membrane slides, and equivalent solids (beyond the paper)."""

from __future__ import annotations

import warnings
from collections.abc import Mapping

import numpy as np

from foamprb.body.material import modulus_of_capsule
from foamprb.body.membrane import least_tensions, name_of, poissons_ratio_of
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Status
from foamprb.cloud.tracker import Models
from foamprb.errors import FailedParticlesWarning
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row
from validation.runs import advance_to, follow, gradients, shear_shapes, unit_cloud

THEORY = "Barthès-Biesel (1980), small deformation"
FIRST_ORDER = "Barthès-Biesel & Rallison (1981), first order in Ca_s"
TILT = "our own closed form of the first order, with two amplitudes"
BALANCE = "the steady equations of the body, by Newton's method"
RATIOS = {0.5: 0.6, 1.0 / 3.0: 4.0 / 7.0, 0.9: 1.9 / 2.9}
"""ν_s, and μ R/G_s."""
NUMBERS = np.array([0.0375, 0.075, 0.15, 0.3, 0.6])
"""Ca_s = μ_f γ̇ R/G_s of the published points; their own numbers have 3 G_s in place of G_s."""
BASILISK = "solver Basilisk, fine grid"
PUBLISHED = {
    BASILISK: (0.0810, 0.1546, 0.2625, 0.3813, 0.4959),
    "Doddi & Bagchi (2008)": (0.083, 0.161, 0.275, 0.392, 0.495),
    "Ramanujan & Pozrikidis (1998)": (np.nan, np.nan, 0.261, 0.385, 0.500),
}
"""Steady D of neo-Hookean capsules whose liquid is as viscous as the fluid; papers' read off figures."""
READING = 0.005
"""Accuracy with which they are read off."""
ALLOWED = 0.05
"""Difference of D to them: so much do they differ from each other at Ca_s = 0.15."""
ANGLES = (40.13, 36.16, 30.25, 24.84, 19.47)
"""Inclination, °, of the steady capsules of Basilisk."""
TIMES = (0.25, 0.5, 1.0, 2.0, 3.0, 5.0)
STARTS = {
    0.15: (0.1055, 0.1724, 0.2351, 0.2612, 0.2629, 0.2627),
    0.6: (0.1194, 0.2229, 0.3686, 0.4798, 0.4970, 0.4954),
}
"""D of Basilisk's capsules at these times after the start of the shear, by Ca_s."""
NEO_HOOKE, SKALAK_1, SKALAK_10 = ("neoHookean", 0.0), ("Skalak", 1.0), ("Skalak", 10.0)
STEADY: Mapping[tuple[tuple[str, float], float], tuple[tuple[float, float, float], ...]] = {
    (NEO_HOOKE, 0.2): (
        (0.0790, 41.93, 0.4978), (0.1592, 38.83, 0.4911), (0.2854, 33.99, 0.4722), (0.4187, 28.80, 0.4405),
        (0.5578, 23.10, 0.3912),
    ),
    (NEO_HOOKE, 1.0): (
        (0.0784, 40.52, 0.4939), (0.1552, 36.18, 0.4765), (0.2702, 29.88, 0.4320), (0.3880, 23.80, 0.3692),
        (0.5038, 18.26, 0.2976),
    ),
    (NEO_HOOKE, 5.0): (
        (0.0736, 34.13, 0.4780), (0.1286, 26.35, 0.4376), (0.1914, 17.97, 0.3771), (0.2437, 11.20, 0.3236),
        (0.2768, 6.43, 0.2907),
    ),
    (SKALAK_1, 1.0): (
        (0.0765, 40.63, 0.4942), (0.1431, 36.86, 0.4799), (0.2346, 31.80, 0.4478), (0.3301, 26.73, 0.4017),
        (0.4211, 22.16, 0.3494),
    ),
    (SKALAK_10, 1.0): (
        (0.0660, 41.22, 0.4957), (0.1129, 38.56, 0.4874), (0.1702, 35.34, 0.4719), (0.2340, 31.83, 0.4481),
        (0.3044, 28.07, 0.4152),
    ),
}  # fmt: skip
"""D, inclination, °, and tank-treading frequency over γ̇ by law and viscosity ratio, by a separate program."""


def _cloud(Ca_s: Floats, law: tuple[str, float], ratio: float = 1.0) -> Cloud:
    """Return capsules of radius 1 in a shear of rate 1 of a fluid of viscosity 1."""
    mu = modulus_of_capsule(1.0 / Ca_s, poissons_ratio_of(*law), 1.0)
    models = Models(integrator="stokes", tolerance=1e-7, material=name_of(*law))
    return unit_cloud(analytic.shear(1.0), 1.0 / mu, 1e-6, 0.025, models, eta=ratio)


def _shapes(cloud: Cloud) -> Floats:
    """Return D, inclination, °, and tank-treading frequency over γ̇, (n, 3), of capsules in shear."""
    _, l_s = gradients(cloud.particles)
    return np.column_stack([shear_shapes(cloud)[:, [0, 3]], np.sqrt(np.linalg.det(l_s[:, :2, :2]))])


def _steady(Ca_s: Floats, law: tuple[str, float], ratio: float, end: float) -> Floats:
    """Return :func:`_shapes`, and the least principal tension over G_s, (n, 4)."""
    cloud = _cloud(Ca_s, law, ratio)
    advance_to(cloud, end)
    return np.column_stack([_shapes(cloud), least_tensions(cloud.particles.F, *law)])


def _ends() -> list[Row]:
    """Return rows of the smallest Ca_s at which neo-Hookean capsules leave the table after the start."""
    rows, numbers = [], np.arange(0.5, 1.0, 0.02)
    for ratio in (0.2, 1.0):
        cloud = _cloud(numbers, NEO_HOOKE, ratio)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FailedParticlesWarning)
            advance_to(cloud, 20.0)
        first = float(numbers[cloud.particles.status == Status.FAILED][0])
        rows.append(
            Row(f"neoHookean, λ = {ratio:g}: Ca_s from which capsules leave the table", first, None, "")
        )
    return rows


def _small() -> list[Row]:
    """Return rows of small deformation: of equivalent solids, and of membranes."""
    rows, small = [], 1e-3
    for nu_s, ratio in RATIOS.items():
        name = f"law small, ν_s = {nu_s:.3g}: "
        rows.append(Row(f"{name}μ R/G_s", modulus_of_capsule(1.0, nu_s, 1.0), ratio, THEORY, 1e-12))
        cloud = unit_cloud(
            analytic.shear(1.0), small / ratio, 1e-6, 0.02, Models(integrator="stokes", tolerance=1e-7)
        )
        advance_to(cloud, 1.0)
        slope = 1.25 * (2.0 + nu_s) / (1.0 + nu_s)
        found = float(shear_shapes(cloud)[0, 0]) / small
        rows.append(Row(f"{name}D/Ca_s at Ca_s = {small:g}", found, slope, THEORY, 1e-4, True))
    tiny = 1e-4
    for ratio in (0.2, 1.0, 5.0):
        D, angle, *_ = _steady(np.array([tiny]), NEO_HOOKE, ratio, 1.0)[0]
        name = f"neoHookean, λ = {ratio:g}: "
        rows.append(
            Row(
                f"{name}D/Ca_s at Ca_s = {tiny:g}",
                D / tiny,
                25.0 / 12.0,
                FIRST_ORDER,
                1e-4,
                True,
                kind="others",
            )
        )
        tilt, exact = np.radians(45.0 - angle) / tiny, (276.0 + 209.0 * ratio) / 240.0
        note = "affine motion: (3 + 2λ)/2.4"
        rows.append(Row(f"{name}(π/4 − θ)/Ca_s", tilt, exact, TILT, 0.08, True, note))
        rows.append(
            Row(f"{name}(π/4 − θ)/Ca_s", tilt, (3.0 + 2.0 * ratio) / 2.4, "affine motion", 1e-3, True)
        )
    return rows


def steady(quick: bool) -> Outcome:
    """Capsules in shear flow."""
    rows = _small()
    fine = np.union1d(np.linspace(0.01, 0.6, 8 if quick else 40), NUMBERS)
    at, end = np.searchsorted(fine, NUMBERS), 30.0 if quick else 60.0
    curves = {}
    for (law, ratio), table in STEADY.items():
        if quick and law != NEO_HOOKE:
            continue
        shapes = curves[law, ratio] = _steady(fine, law, ratio, end)
        for Ca, found, steady_values in zip(NUMBERS, shapes[at], table, strict=True):
            name = f"{name_of(*law).removeprefix('capsule ')}, λ = {ratio:g}, Ca_s = {Ca:g}: "
            for what, value, reference, allowed in zip(
                ("D", "θ, °", "ω/γ̇"), found[:3].tolist(), steady_values, (5e-4, 0.05, 5e-4), strict=True
            ):
                rows.append(Row(f"{name}{what}", value, reference, BALANCE, allowed))
            if ratio == 1.0:
                rows.append(Row(f"{name}least tension over G_s", float(found[3]), None, ""))
    ours = curves[NEO_HOOKE, 1.0]
    rows += _others(ours[at, :3]) + _ends()
    cloud = _cloud(np.array([*STARTS]), NEO_HOOKE)
    start = follow(cloud, np.array(TIMES), lambda cloud: shear_shapes(cloud)[:, 0])
    for k, (Ca, expected) in enumerate(STARTS.items()):
        for t, D, reference in zip(TIMES, start[:, k].tolist(), expected, strict=True):
            rows.append(
                Row(f"start, Ca_s = {Ca:g}, γ̇t = {t:g}: D", D, reference, BASILISK, 0.06, True, kind="others")
            )
    figure = Figure(
        "capsules",
        "Steady deformation in simple shear of capsules whose liquid is as viscous as the fluid.",
        [Panel("Ca_s = μ_f γ̇ R/G_s", "D", _curves(fine, curves))],
    )
    return Outcome(rows, [figure], [_REMARK])


def _others(ours: Floats) -> list[Row]:
    """Return rows of steady neo-Hookean capsules beside those that others computed."""
    rows = []
    for source, values in PUBLISHED.items():
        error = None if source == BASILISK else READING
        for Ca, (D, _, _), value in zip(NUMBERS, ours, values, strict=True):
            if np.isfinite(value):
                name = f"Ca_s = {Ca:g}: D"
                rows.append(
                    Row(name, float(D), value, source, ALLOWED, True, kind="others", reference_error=error)
                )
    for Ca, (_, angle, _), value in zip(NUMBERS, ours, ANGLES, strict=True):
        rows.append(Row(f"Ca_s = {Ca:g}: θ, °", float(angle), value, BASILISK, 1.3, kind="others"))
    return rows


def _curves(fine: Floats, curves: Mapping[tuple[tuple[str, float], float], Floats]) -> list[Curve]:
    drawn = [
        Curve(fine, shapes[:, 0], name_of(*law).removeprefix("capsule "), colour=k)
        for k, ((law, ratio), shapes) in enumerate(curves.items())
        if ratio == 1.0
    ]
    points = [
        Curve(NUMBERS, np.array(D), source, "reference", 1 + k)
        for k, (source, D) in enumerate(PUBLISHED.items())
    ]
    small = fine[fine < 0.25]
    return [*drawn, *points, Curve(small, 25.0 / 12.0 * small, "25/12 Ca_s", "guide", 1)]


_REMARK = (
    "The published points are of neo-Hookean capsules. The tests of the solver Basilisk list them "
    "(`huet/tests/lagrangian_caps/data/nh_shear_3d`), those of the papers as read off figures. For Skalak's "
    "law, other viscosity ratios and tank-treading frequencies no published table could be read: their rows "
    "compare the same equations."
)
