"""Simple shear (Sect. 5.3, Figs. 6 to 9)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst, worst_of_each
from validation.references.extension import EXTENSIONS, steady_extension
from validation.references.roscoe import roscoe_at, roscoe_frequency
from validation.references.shear import (
    SHEAR,
    STEADY_SHAPES,
    TRANSIENT_SHAPES,
    inertialess_history,
    inertialess_rate,
    shear_shape,
    steady_shear,
    tank_treading_rate,
)
from validation.runs import (
    advance_to,
    follow,
    gradients,
    measures,
    shear_shapes,
    unit_cloud,
    without_inertia,
)

ROSCOE = "Roscoe (1967), steady algebraic solution"
TABLE = "high-order inertialess solution, tabulated"
ODE = "inertialess equations by solve_ivp"
PLANAR = "balance of principal stresses by scipy.optimize"

NAMES = ("D", "b/a", "c/a", "θ [deg]", "|ω_s3|/γ̇")
ALLOWED = (1e-4, 1e-4, 1e-4, 0.01, 1e-4)


def _limit(Ca: Floats, end: float, traction: str = "roscoe", stokes: float = 2e-3) -> Floats:
    """Return shapes (n, 5) at the time ``end`` in the limit of no inertia, with the paper's integrator."""
    runs = []
    for s in (stokes, stokes / 2):
        cloud = unit_cloud(analytic.shear(1.0), Ca, s, 0.2 * s, Models(traction=traction, integrator="paper"))
        advance_to(cloud, end)
        runs.append(shear_shapes(cloud))
    return without_inertia(*runs)


def steady(quick: bool) -> Outcome:
    """Steady shape in shear."""
    Ca = np.array([0.01, 0.1, 0.4] if quick else [0.01, 0.05, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1.0])
    ours = _limit(Ca, 20.0 if quick else 60.0)
    if not quick:
        # Twice as soft takes five times as long to become steady.
        Ca, ours = np.append(Ca, 2.0), np.vstack([ours, _limit(np.array([2.0]), 250.0)])
    roscoe = np.array([roscoe_at(c) for c in Ca])
    rows = [
        Row(f"Ca = {c:g}: {name}", float(ours[i, k]), float(roscoe[i, k]), ROSCOE, ALLOWED[k])
        for i, c in enumerate(Ca)
        for k, name in enumerate(NAMES)
    ]
    for c, shape in STEADY_SHAPES.items():
        i = int(np.flatnonzero(Ca == c)[0])
        rows += [
            Row(f"Ca = {c:g}: {name}", float(ours[i, k]), shape[k], TABLE, ALLOWED[k])
            for k, name in enumerate(NAMES)
        ]
    for integrator in ("stokes", "rosenbrock"):
        models = Models(integrator=integrator, tolerance=1e-7)
        cloud = unit_cloud(analytic.shear(1.0), Ca, 1e-6, 0.02, models)
        advance_to(cloud, 20.0 if quick else 250.0)
        direct = shear_shapes(cloud)
        title = f"{{}}, {integrator}, worst of all Ca"
        rows += worst_of_each(title, NAMES, direct, roscoe, ROSCOE, ALLOWED)

    Ca_j = np.array([0.01, 0.1] if quick else [0.01, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4])
    # Jeffery's traction does not damp a change of shape, so that the last of it goes slowly.
    jeffery = _limit(Ca_j, 20.0 if quick else 150.0, "jeffery")
    # Without d_s and in a steady state the symmetric part of s̃ balances the elastic stress only if d_f is
    # coaxial with the body: at 45°, in a planar extension of rate γ̇/2.
    planar = np.array([steady_extension(EXTENSIONS["planar"], 0.5 * c) for c in Ca_j])
    D_j = (planar[:, 0] - planar[:, 1]) / (planar[:, 0] + planar[:, 1])
    for i, c in enumerate(Ca_j):
        rows.append(
            Row(f"Ca = {c:g}: D, Jeffery's traction", float(jeffery[i, 0]), float(D_j[i]), PLANAR, 1e-4)
        )
    rows.append(
        worst(
            "θ [deg], Jeffery's traction, worst of all Ca",
            jeffery[:, 3],
            np.full(len(Ca_j), 45.0),
            "symmetry",
            0.01,
        )
    )

    fine = np.linspace(0.01, float(Ca.max()), 40)
    curve = np.array([roscoe_at(c) for c in fine])
    dense = Ca if quick else np.linspace(0.02, 1.0, 33)
    line = ours if quick else _limit(dense, 60.0)

    def panel(k: int, label: str) -> Panel:
        table = np.array([[c, shape[k]] for c, shape in STEADY_SHAPES.items()])
        shown = fine <= 1.0
        return Panel(
            "Ca",
            label,
            [
                Curve(dense, line[:, k], "foamprb, Roscoe's traction"),
                Curve(fine[shown], curve[shown, k], "Roscoe (1967)", "reference"),
                Curve(table[:, 0], table[:, 1], "table", "reference", 2),
            ],
        )

    first, angle = panel(0, "D"), panel(3, "θ [deg]")
    first.curves.extend(
        [
            Curve(Ca_j, jeffery[:, 0], "foamprb, Jeffery's traction", colour=1),
            Curve(Ca_j, D_j, "Jeffery: balance at 45°", "reference", 1),
        ]
    )
    angle.curves.append(Curve(Ca_j, jeffery[:, 3], "foamprb, Jeffery's traction", colour=1))
    figures = [
        Figure(
            "shear-shape", "Fig. 6: steady shape in simple shear.", [first, panel(1, "b/a"), panel(2, "c/a")]
        ),
        Figure(
            "shear-angle",
            "Fig. 7: steady angle and angular velocity of the material.",
            [angle, panel(4, "|ω_s3|/γ̇")],
        ),
    ]
    remarks = [
        "The inertialess limit of the paper's integrator is extrapolated from shape Stokes numbers 2e-3 "
        "and 1e-3. For small Ca the deformation is 5/4 Ca; the paper, after Gao et al., rounds this to "
        "Ca. With Jeffery's traction alone there is no steady shape above a capillary number of about "
        "0.5."
    ]
    return Outcome(rows, figures, remarks)


def formulas(quick: bool) -> Outcome:
    """References for shear."""
    pairs = (
        [(0.1, 0.0), (0.4, 0.0), (0.4, 0.5)]
        if quick
        else [(Ca, ratio) for ratio in (0.0, 0.5, 1.0, 3.0) for Ca in (0.1, 0.4, 1.0)]
    )
    rows = []
    for Ca, ratio in pairs:
        solved, algebra = steady_shear(Ca, ratio), roscoe_at(Ca, ratio)
        for k in (1, 2, 3):
            name = f"Ca = {Ca:g}, η_s/μ_f = {ratio:g}: {NAMES[k]}"
            rows.append(Row(name, solved[k], algebra[k], ROSCOE, (1e-4, 1e-4, 1e-4, 0.01)[k]))
    for Ca, shape in STEADY_SHAPES.items():
        algebra = roscoe_at(Ca)
        for k in (1, 2, 3):
            rows.append(
                Row(f"Ca = {Ca:g}: {NAMES[k]}", algebra[k], shape[k], TABLE, (1e-5, 1e-5, 1e-5, 1e-3)[k])
            )
    remarks = [
        "“Ours” denotes the reference solution by solve_ivp, or Roscoe's algebra in comparisons with the "
        "table: this case uses only the references. Roscoe's formulas agree with both to all digits; they "
        "need no correction."
    ]
    return Outcome(rows, [], remarks)


def transient(quick: bool) -> Outcome:
    """Transient shape in shear."""
    times = np.linspace(0.2, 3.0 if quick else 10.0, 15 if quick else 50)
    runs = []
    for s in (2e-3, 1e-3):
        cloud = unit_cloud(analytic.shear(1.0), 0.4, s, 0.2 * s, Models(integrator="paper"))
        runs.append(follow(cloud, times, shear_shapes)[:, 0])
    ours = without_inertia(*runs)
    F = inertialess_history(SHEAR, 0.4, times)
    expected = np.array([shear_shape(f, inertialess_rate(f, SHEAR, 0.4)) for f in F])
    # Two extrapolated levels leave errors of second order in the Stokes number, largest at the start.
    allowed = (2e-4, 2e-4, 2e-4, 0.02, 2e-4)
    span = f"worst of γ̇t = {times[0]:g} to {times[-1]:g}"
    rows = worst_of_each(f"{{}}, {span}", NAMES, ours, expected, ODE, allowed)
    for integrator in ("stokes", "rosenbrock"):
        models = Models(integrator=integrator, tolerance=1e-6)
        cloud = unit_cloud(analytic.shear(1.0), 0.4, 1e-6, 0.02, models)
        direct = follow(cloud, times, shear_shapes)[:, 0]
        rows += worst_of_each(f"{{}}, {integrator}, {span}", NAMES, direct, expected, ODE, allowed)
    for t, shape in TRANSIENT_SHAPES.items():
        i = int(np.argmin(abs(times - t)))
        for k, value in zip((1, 2, 3), shape, strict=True):
            rows.append(Row(f"γ̇t = {t:g}: {NAMES[k]}", float(ours[i, k]), value, TABLE, allowed[k]))
    panels = [
        Panel(
            "γ̇t",
            label,
            compared(times, ours[:, k], expected[:, k], (f"foamprb, {label}", f"solve_ivp, {label}"), k, 2),
        )
        for k, label in ((1, "b/a"), (2, "c/a"), (3, "θ [deg]"))
    ]
    return Outcome(rows, [Figure("shear-transient", "Fig. 8: Ca = 0.4, started as a sphere.", panels)], [])


def tank_treading(quick: bool) -> Outcome:
    """Tank-treading."""
    Ca = 0.3
    end = 45.0 if quick else 90.0
    times = np.arange(0.05, end, 0.05)
    points, periods = [], []
    for s in (2e-3, 1e-3):
        cloud = unit_cloud(analytic.shear(1.0), Ca, s, 0.25 * s, Models(integrator="paper"))
        points.append(follow(cloud, times, _point))
        periods.append(_period(times, points[-1]))
    period = 2.0 * periods[1] - periods[0]
    exact = roscoe_at(Ca)
    a = (exact.b_over_a * exact.c_over_a) ** (-1.0 / 3.0)
    nu = roscoe_frequency(a, a * exact.b_over_a, exact.angle)
    marks = np.arange(0.5, 16.0, 0.5)
    solution = inertialess_history(SHEAR, Ca, np.append(marks, 60.0))
    own_nu = tank_treading_rate(inertialess_rate(solution[-1], SHEAR, Ca))
    rows = [
        Row("period γ̇T", period, 2.0 * np.pi / nu, "Roscoe's frequency ν of his steady ellipse", 1e-3),
        Row("period γ̇T", period, 2.0 * np.pi / own_nu, "eigenvalues of l_s, inertialess solve_ivp", 1e-3),
    ]
    for integrator in ("stokes",) if quick else ("stokes", "rosenbrock"):
        models = Models(integrator=integrator, tolerance=1e-6)
        cloud = unit_cloud(analytic.shear(1.0), Ca, 1e-6, 0.05, models)
        own_period = _period(times, follow(cloud, times, _point))
        source = "Roscoe's frequency ν of his steady ellipse"
        rows.append(Row(f"period γ̇T, {integrator}", own_period, 2.0 * np.pi / nu, source, 1e-3))
        circulation = float(measures(cloud)["circulation"][0])
        rows.append(Row(f"circulation/γ̇, {integrator}", circulation, nu, source, 1e-6))
    fine = without_inertia(*points)
    shown = times <= 16.0
    at = [solution[:-1, i, 0] for i in (0, 1)]
    values, vectors = np.linalg.eigh((solution[-1] @ solution[-1].T)[:2, :2])
    phi = np.linspace(0.0, 2.0 * np.pi, 100)
    outline = vectors @ (np.sqrt(values)[:, None] * np.stack([np.cos(phi), np.sin(phi)]))
    figure = Figure(
        "tank-treading",
        "Fig. 9: path of the material point that starts at (R, 0, 0), Ca = 0.3.",
        [
            Panel(
                "x₁/R",
                "x₂/R",
                [
                    Curve(fine[shown, 0], fine[shown, 1], "foamprb"),
                    Curve(at[0], at[1], "solve_ivp, every γ̇t = 0.5", "reference"),
                    Curve(outline[0], outline[1], "steady outline", "guide"),
                ],
                "equal",
            ),
            Panel(
                "γ̇t",
                "x₁/R",
                [
                    Curve(times[shown], fine[shown, 0], "foamprb"),
                    Curve(marks, at[0], "solve_ivp", "reference"),
                ],
            ),
        ],
    )
    return Outcome(rows, [figure], [])


def _point(cloud: Cloud) -> Floats:
    """Return the place (2,) of the material point that was at (R, 0, 0) at rest."""
    return gradients(cloud.particles)[0][0, :2, 0]


def _period(times: Floats, path: Floats) -> float:
    """Return the mean time between downward passages of x₂ = 0 of a path (m, 2) of a steady shape."""
    y = path[:, 1]
    k = np.flatnonzero((y[:-1] > 0.0) & (y[1:] <= 0.0) & (times[:-1] > 12.0))
    passages = []
    for i in k:
        # The cubic through four samples.
        poly = np.polynomial.Polynomial.fit(times[i - 1 : i + 3], y[i - 1 : i + 3], 3)
        roots = poly.roots()
        real = roots[abs(roots.imag) < 1e-9].real
        passages.append(float(real[np.argmin(abs(real - times[i]))]))
    return float((passages[-1] - passages[0]) / (len(passages) - 1))
