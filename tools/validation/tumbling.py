"""Soft prolate bodies in simple shear: tumbling, trembling and swinging (beyond the paper)."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.optimize import minimize_scalar

from foamprb.cloud.tracker import Models, available_threads
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst
from validation.references import soft
from validation.references.shear import SHEAR
from validation.runs import unit_cloud

ODE = "inertialess equations by solve_ivp, dense force balance"
SMALL = "small deformation: ⅘ (r − 1)/(r + 1)"
RATIOS = np.array([1.1, 1.2, 1.5, 1.75, 2.0, 2.25, 2.5, 3.0])
CHECKED = (1.2, 2.0, 3.0)
END = 44.0
_STEP = 0.05


class Transitions(NamedTuple):
    """Capillary numbers at which the motion of a prolate body changes, (n,) for n aspect ratios."""

    turning: Floats
    """Ca₁: below it the body tumbles."""
    positive: Floats
    """Ca₂: above it its longest axis stays between the flow and the velocity's gradient."""


def small_deformation(ratio: Floats) -> Floats:
    """Return Ca₁ = Ca₂ of a nearly spherical, nearly rigid body.

    To first order its deformation in the plane is the sum of 5/4 Ca at 45°, which the flow holds, and of the
    shape at rest, (r − 1)/(r + 1), which turns with the material. It turns with the longer of the two.
    """
    return np.asarray(0.8 * (ratio - 1.0) / (ratio + 1.0))


def _paths(
    ratio: Floats, Ca: Floats, end: float = END, tolerance: float = 2e-6
) -> tuple[Floats, Floats, Floats]:
    """Return times (m,), and curves (m, n) of :func:`references.soft.in_plane`; released along the flow."""
    shapes = np.column_stack([ratio, np.ones_like(ratio), np.ones_like(ratio)])
    models = Models(integrator="stokes", tolerance=tolerance)
    cloud = unit_cloud(analytic.shear(1.0), Ca, 1e-6, _STEP, models, ratios=shapes)
    cloud.threads = available_threads()
    times, path = [0.0], [soft.in_plane(cloud.particles.F.reshape(-1, 3, 3))]
    for _ in range(round(end / _STEP)):
        cloud.advance(1)
        times.append(cloud.time)
        path.append(soft.in_plane(cloud.particles.F.reshape(-1, 3, 3)))
    return np.array(times), np.array([p[0] for p in path]), np.array([p[1] for p in path])


def _passages(times: Floats, along: Floats, across: Floats) -> soft.Passages:
    """Return :func:`references.soft.passages` of the curve of one body, (m,) each."""
    late = times > 0.5 * END
    t, x, y = times[late], CubicSpline(times[late], along[late]), CubicSpline(times[late], across[late])
    k = int(np.argmin(np.hypot(along[late], across[late])[1:-1])) + 1
    near = minimize_scalar(
        lambda s: float(np.hypot(x(s), y(s))), bounds=(t[k - 1], t[k + 1]), method="bounded"
    )
    at = near.x
    nearest = soft.signed_distance((float(x(at)), float(y(at))), (float(x(at, 1)), float(y(at, 1))))
    flat = y.derivative().roots(extrapolate=False)
    return soft.Passages(nearest, float(y(flat).min()))


def _root(Ca: Floats, values: Floats) -> float:
    """Return the zero of values that rise with Ca, by a cubic spline."""
    roots = CubicSpline(Ca, values).roots(extrapolate=False)
    return float(roots[0]) if len(roots) else np.nan


def transitions(ratios: Floats) -> Transitions:
    """Return Ca₁ and Ca₂ of each aspect ratio: a search among 12 values of Ca, then among 6 around each."""
    guess = small_deformation(ratios)
    first = guess[:, None] * np.linspace(0.7, 1.8, 12)
    coarse = _search(ratios, first)
    fine = np.empty((len(ratios), 12))
    for i, Ca in enumerate(first):
        width = Ca[1] - Ca[0]
        for part, at in ((slice(0, 6), coarse.turning[i]), (slice(6, 12), coarse.positive[i])):
            fine[i, part] = at + width * np.linspace(-0.5, 0.5, 6)
    return _search(ratios, fine)


def _search(ratios: Floats, Ca: Floats) -> Transitions:
    """Return the transitions among the given capillary numbers, (n, k)."""
    n, k = Ca.shape
    times, along, across = _paths(np.repeat(ratios, k), Ca.ravel())
    passages = [_passages(times, along[:, j], across[:, j]) for j in range(n * k)]
    nearest = np.array([p.nearest for p in passages]).reshape(n, k)
    lowest = np.array([p.lowest for p in passages]).reshape(n, k)
    turning, positive = [], []
    for row, b, y in zip(Ca, nearest, lowest, strict=True):
        order = np.argsort(row)
        turning.append(_root(row[order], b[order]))
        positive.append(_root(row[order], y[order]))
    return Transitions(np.array(turning), np.array(positive))


def _angles(along: Floats, across: Floats) -> Floats:
    """Return θ, degrees, continuous through turns."""
    return np.asarray(np.degrees(0.5 * np.unwrap(np.arctan2(across, along), axis=0)))


def _histories(quick: bool) -> tuple[list[Row], list[Curve], list[Curve]]:
    """Compare one body of aspect ratio 2 in each regime with the reference."""
    rows: list[Row] = []
    angles: list[Curve] = []
    lengths: list[Curve] = []
    Ca = np.array([0.1, 0.29, 0.6])
    end = 12.0 if quick else 24.0
    times, along, across = _paths(np.full(3, 2.0), Ca, end, 1e-7)
    theta, size = _angles(along, across), np.hypot(along, across)
    marks = np.arange(0, len(times), 10)
    for i, (c, motion) in enumerate(zip(Ca, ("tumbling", "trembling", "swinging"), strict=True)):
        F = soft.deformation(SHEAR, soft.Body(c, soft.stretched((2.0, 1.0, 1.0))), times[marks][1:])
        x, y = soft.in_plane(np.concatenate([soft.stretched((2.0, 1.0, 1.0))[None], F]))
        name = f"r = 2, Ca = {c:g}, {motion}: "
        rows += [
            worst(name + "b₁₁ − b₂₂, worst of all times", along[marks, i], x, ODE, 1e-4),
            worst(name + "2 b₁₂, worst of all times", across[marks, i], y, ODE, 1e-4),
        ]
        label = f"foamprb, Ca = {c:g}, {motion}"
        angles += [
            Curve(times, theta[:, i], label, colour=i),
            Curve(times[marks], _angles(x, y), "solve_ivp", "reference", i),
        ]
        lengths += [
            Curve(times, size[:, i], label, colour=i),
            Curve(times[marks], np.hypot(x, y), "solve_ivp", "reference", i),
        ]
    return rows, angles, lengths


def regimes(quick: bool) -> Outcome:
    """Tumbling, trembling, swinging."""
    ratios = np.array([2.0]) if quick else RATIOS
    limits = transitions(ratios)
    rows = []
    for r in (2.0,) if quick else CHECKED:
        i = int(np.argmin(abs(ratios - r)))
        Ca1, Ca2 = float(limits.turning[i]), float(limits.positive[i])
        reference = soft.transition(lambda p: p.nearest, r, 0.97 * Ca1, 1.03 * Ca1)
        rows.append(Row(f"r = {r:g}: Ca₁, tumbling to trembling", Ca1, reference, ODE, 1e-4))
        if not quick:
            reference = soft.transition(lambda p: p.lowest, r, 0.97 * Ca2, 1.03 * Ca2)
            rows.append(Row(f"r = {r:g}: Ca₂, trembling to swinging", Ca2, reference, ODE, 1e-4))
    if not quick:
        round_one = np.array([1.02])
        nearly = transitions(round_one)
        expected = float(small_deformation(round_one)[0])
        rows += [
            Row(f"r = 1.02: {name}", float(value[0]), expected, SMALL, 0.02, True)
            for name, value in (("Ca₁", nearly.turning), ("Ca₂", nearly.positive))
        ]
    more, angles, lengths = _histories(quick)
    rows += more
    figures = [
        Figure(
            "tumbling",
            "Aspect ratio 2 at rest, released along the flow: angle θ of the longest axis in the plane of "
            "shear, and the difference a² − b² of the squared semi-axes there.",
            [Panel("γ̇t", "θ [deg]", angles), Panel("γ̇t", "(a² − b²)/R²", lengths)],
        )
    ]
    if not quick:
        fine = np.linspace(1.0, 3.0, 50)
        figures.append(
            Figure(
                "tumbling-map",
                "Motions of a prolate neo-Hooke body in simple shear: tumbling below Ca₁, trembling "
                "between, swinging above Ca₂.",
                [
                    Panel(
                        "aspect ratio at rest",
                        "Ca = μ_f γ̇/μ_s",
                        [
                            Curve(ratios, limits.turning, "Ca₁, foamprb", colour=0),
                            Curve(ratios, limits.positive, "Ca₂, foamprb", colour=1),
                            Curve(fine, small_deformation(fine), "small deformation", "guide"),
                            *_checked(rows),
                        ],
                    )
                ],
            )
        )
    return Outcome(rows, figures, _REMARKS)


def _checked(rows: list[Row]) -> list[Curve]:
    """Return the reference's transitions among the rows."""
    curves = []
    for colour, word in enumerate(("tumbling to", "trembling to")):
        at = np.array([[r, row.reference] for r in CHECKED for row in rows
                       if word in row.quantity and row.quantity.startswith(f"r = {r:g}:")])  # fmt: skip
        curves.append(Curve(at[:, 0], at[:, 1], "solve_ivp", "reference", colour))
    return curves


_REMARKS = [
    "The axis lies in the plane of shear. θ is the angle between the flow and the longest axis of the "
    "body's section by that plane. Tumbling: θ decreases through half turn after half turn, as for a "
    "rigid body. Trembling: θ oscillates to both sides of the flow without full turns. Swinging (an "
    "oscillating tank-treading): θ oscillates and stays positive. The vector (b₁₁ − b₂₂, 2 b₁₂), b = "
    "F·Fᵀ, of length a² − b² at the angle 2θ, describes a closed curve: around the origin in tumbling, "
    "beside it and across the flow's direction in trembling, above it in swinging. At Ca₁ the section is "
    "circular at one instant; at Ca₂ its axis touches the flow direction.",
    "Gao, Hu & Ponte Castañeda (Phys. Rev. Lett. 108, 058302, 2012), who found the trembling of elastic "
    "particles, distinguish tumbling and trembling by full turns; their boundary is Ca₁. Swinging is "
    "distinguished for capsules and red cells (Abkarian, Faivre & Viallat, Phys. Rev. Lett. 98, 188302, "
    "2007). The boundaries printed in these papers, and in that of Sanagavarapu, Subramanian & Nott (J. "
    "Fluid Mech., 2022) on the same bodies, were not available for comparison. The reference for the "
    "numbers above is an integration that shares only the model with foamprb.",
    "A body whose rest shape is no sphere has no steady shape in shear: the rest shape rotates with the "
    "material.",
]
