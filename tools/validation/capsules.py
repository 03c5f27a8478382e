"""Capsules as equivalent solids (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.body.material import modulus_of_capsule
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row
from validation.runs import advance_to, shear_shapes, unit_cloud

THEORY = "Barthès-Biesel (1980), small deformation"
RATIOS = {0.5: 0.6, 1.0 / 3.0: 4.0 / 7.0, 0.9: 1.9 / 2.9}
"""ν_s, and μ R/G_s."""
NUMBERS = np.array([0.0375, 0.075, 0.15, 0.3, 0.6])
"""Ca_s = μ_f γ̇ R/G_s of the published points; their own numbers have 3 G_s in place of G_s."""
PUBLISHED = {
    "Doddi & Bagchi (2008)": (0.083, 0.161, 0.275, 0.392, 0.495),
    "Ramanujan & Pozrikidis (1998)": (np.nan, np.nan, 0.261, 0.385, 0.500),
}
"""Steady D of neo-Hookean capsules whose liquid has the fluid's viscosity, read off the papers' figures."""
READING = 0.005
"""Accuracy with which they are read off."""
CLOSE = {0.0375: 0.08, 0.075: 0.08, 0.15: 0.15}
"""Ca_s up to which the solid is a good approximation, and the allowed difference."""


def _deformations(Ca_s: Floats, nu_s: float, end: float) -> Floats:
    """Return D (n,) of capsules of radius 1 in a shear of rate 1 of a fluid of viscosity 1."""
    mu = modulus_of_capsule(1.0 / Ca_s, nu_s, 1.0)
    cloud = unit_cloud(analytic.shear(1.0), 1.0 / mu, 1e-6, 0.02, Models(integrator="stokes", tolerance=1e-7))
    advance_to(cloud, end)
    return np.asarray(shear_shapes(cloud)[:, 0])


def steady(quick: bool) -> Outcome:
    """Capsules in shear flow."""
    rows, small = [], 1e-3
    for nu_s, ratio in RATIOS.items():
        name = f"ν_s = {nu_s:.3g}: "
        rows.append(Row(f"{name}μ R/G_s", modulus_of_capsule(1.0, nu_s, 1.0), ratio, THEORY, 1e-12))
        found = float(_deformations(np.array([small]), nu_s, 1.0)[0]) / small
        slope = 1.25 * (2.0 + nu_s) / (1.0 + nu_s)
        rows.append(Row(f"{name}D/Ca_s at Ca_s = {small:g}", found, slope, THEORY, 1e-4, True))
    fine = np.union1d(np.linspace(0.01, 0.6, 8 if quick else 40), NUMBERS)
    curve = _deformations(fine, 0.5, 20.0 if quick else 60.0)
    ours = curve[np.searchsorted(fine, NUMBERS)]
    colours = {source: k + 1 for k, source in enumerate(PUBLISHED)}
    for Ca, D, *published in zip(NUMBERS, ours, *PUBLISHED.values(), strict=True):
        for source, value in zip(PUBLISHED, published, strict=True):
            if np.isfinite(value):
                note = "" if Ca in CLOSE else "no capsule any more"
                rows.append(
                    Row(f"Ca_s = {Ca:g}: D", float(D), value, source, CLOSE.get(float(Ca)), True, note,
                        kind="others", reference_error=READING)
                )  # fmt: skip
    small_numbers = fine[fine < 0.25]
    curves = [
        Curve(fine, curve, "foamprb, ν_s = 1/2"),
        *(Curve(NUMBERS, np.array(D), s, "reference", colours[s]) for s, D in PUBLISHED.items()),
        Curve(small_numbers, 25.0 / 12.0 * small_numbers, "25/12 Ca_s", "guide", 1),
    ]
    figure = Figure(
        "capsules",
        "Steady deformation in simple shear of a neo-Hookean capsule and of the solid in its place.",
        [Panel("Ca_s = μ_f γ̇ R/G_s", "D", curves)],
    )
    return Outcome(rows, [figure], [_REMARK])


_REMARK = (
    "A membrane stiffens with its deformation more than the solid that is equivalent for small deformation. "
    "The published points are those that the tests of the solver Basilisk list (`huet/tests/lagrangian_caps/"
    "data/nh_shear_3d`), read off figures."
)
