"""The stress of dilute suspensions: stresslets of rigid and soft bodies (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from foamprb.cloud.cloud import Cloud
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst, worst_of_each
from validation.references import rigid, soft
from validation.references.shear import SHEAR
from validation.runs import advance_to, follow, measures, principal_axes, unit_cloud

EINSTEIN = "Einstein (1906, 1911)"
ROSCOE = "Roscoe (1967): stress of the solid in his steady ellipsoid"
SPHEROID = "resistance functions of a spheroid (Kim & Karrila 1991), Jeffery's orbit"
SMALL = "first order in Ca: a corotational Kelvin–Voigt element"
ODE = "inertialess equations by solve_ivp, stress of the solid"
NAMES = ("[η]", "N₁/(μ_f γ̇ φ)", "N₂/(μ_f γ̇ φ)")
STIFF = 1e-5
"""Ca of bodies that count as rigid."""
GIVEN = {0.05: (2.4870, 0.624), 0.1: (2.4483, 1.241), 0.4: (1.7828, 4.525)}
"""[η] and N₁ at some Ca, of an independent quadrature."""
QUADRATURE = "independent quadrature, to the digits that are given"
VOLUME = 4.0 / 3.0 * np.pi


def stresslets(cloud: Cloud) -> Floats:
    """Return stresslets over μ_f and the volume, (n, 3, 3), 1/s."""
    xx, yy, zz, xy, yz, xz = measures(cloud)["stresslet"].T
    S = np.stack([xx, xy, xz, xy, yy, yz, xz, yz, zz], axis=1).reshape(-1, 3, 3)
    return np.asarray(S / (VOLUME * cloud.medium.mu))


def _spheroids(quick: bool) -> tuple[list[Row], Figure]:
    """Compare rigid spheroids on Jeffery orbits."""
    rows: list[Row] = []
    curves: list[Curve] = []
    ratios = np.array([2.0, 5.0, 10.0])
    leaning = Rotation.from_rotvec([0.3, -0.8, 1.1]).as_matrix()
    shapes = np.tile(np.column_stack([ratios, np.ones(3), np.ones(3)]), (2, 1))
    axes = np.array(3 * [np.eye(3)] + 3 * [leaning])
    models = Models(integrator="stokes", tolerance=np.inf)
    times = np.arange(0.16, 4.0 if quick else 16.5, 0.16)
    cloud = unit_cloud(analytic.shear(1.0), np.full(6, STIFF), 1e-6, 0.008, models, ratios=shapes, axes=axes)
    ours, theirs = [], []
    for t in times:
        advance_to(cloud, float(t))
        ours.append(stresslets(cloud))
        # Of the body as it lies: an orbit's small error in time is not one of the stress.
        p = principal_axes(cloud.particles)[1][:, 2]
        theirs.append([rigid.spheroid_stresslet(r, a, SHEAR) for r, a in zip(shapes[:, 0], p, strict=True)])
    stresses, expected = np.array(ours), np.array(theirs)
    for i in range(6):
        plane = "in the plane of shear" if i < 3 else "out of the plane"
        size = float(abs(expected[:, i]).max())
        rows.append(
            worst(
                f"rigid spheroid, r = {shapes[i, 0]:g}, {plane}: component of S/(μ_f γ̇ V) over its largest",
                stresses[:, i].ravel(),
                expected[:, i].ravel(),
                SPHEROID,
                1e-3,
                size,
            )
        )
        if i < 3:
            exact = rigid.jeffery_axis(np.array([1.0, 0.0, 0.0]), shapes[i, 0], times)
            closed = [rigid.spheroid_stresslet(shapes[i, 0], a, SHEAR)[0, 1] for a in exact]
            labels = f"foamprb, r = {shapes[i, 0]:g}", "closed form"
            curves += compared(times, stresses[:, i, 0, 1], np.array(closed), labels, i, 4)
    figure = Figure(
        "stresslet",
        "Rigid spheroids that tumble in the plane of shear: contribution of each to the shear stress, per "
        "volume.",
        [Panel("γ̇t", "S₁₂/(μ_f γ̇ V)", curves)],
    )
    return rows, figure


def _average(quick: bool) -> list[Row]:
    """Compare the intrinsic viscosity of a tumbling rigid spheroid, averaged over its period."""
    rows = []
    for r in (2.0,) if quick else (2.0, 5.0):
        period = rigid.jeffery_period(r)
        n = 200
        dt = period / (4 * n)
        start = round(1.0 / dt)
        models = Models(integrator="stokes", tolerance=1e-6)
        cloud = unit_cloud(analytic.shear(1.0), STIFF, 1e-6, dt, models, ratios=(r, 1.0, 1.0))
        cloud.advance(start)
        total = 0.0
        # The stress has half that period, and the trapezoidal rule is exact for a periodic function.
        for _ in range(n):
            cloud.advance(2)
            total += float(stresslets(cloud)[0, 0, 1]) / n
        psi = 2.0 * np.pi * np.arange(n) / n
        axes = np.stack([r * np.sin(psi), np.cos(psi), np.zeros(n)], axis=1)
        axes /= np.linalg.norm(axes, axis=1, keepdims=True)
        reference = np.mean([rigid.spheroid_stresslet(r, a, SHEAR)[0, 1] for a in axes])
        name = f"rigid spheroid, r = {r:g}, in the plane of shear: [η] over a period"
        rows.append(Row(name, total, float(reference), SPHEROID, 1e-3, True))
    return rows


def stress(quick: bool) -> Outcome:
    """Stress of dilute suspensions."""
    rows = []
    models = Models(integrator="stokes", tolerance=1e-6)
    stiff = unit_cloud(analytic.shear(1.0), STIFF, 1e-6, 0.02, models)
    advance_to(stiff, 1.0)
    einstein = stresslets(stiff)[0]
    rows.append(Row("rigid sphere: [η]", float(einstein[0, 1]), 2.5, EINSTEIN, 1e-3))

    Ca = np.array([0.1, 0.4]) if quick else np.array([0.02, 0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0, 1.5, 2.0])
    panels: list[list[Curve]] = [[], [], []]
    for colour, ratio in enumerate((0.0,) if quick else (0.0, 1.0, 5.0)):
        expected = np.array([soft.roscoe_rheology(c, ratio) for c in Ca])
        for integrator in ("stokes", "rosenbrock"):
            own_models = Models(integrator=integrator, tolerance=1e-6)
            cloud = unit_cloud(analytic.shear(1.0), Ca, 1e-6, 0.05, own_models, eta=ratio)
            # Twice as soft takes five times as long to become steady.
            advance_to(cloud, 25.0 if quick else 250.0 if ratio == 0.0 else 20.0 * (1.5 + ratio) * Ca[-1])
            ours = np.array([soft.rheology(S) for S in stresslets(cloud)])
            # S is the small difference of large stresses where the solid is stiff.
            title = f"spheres, η_s/μ_f = {ratio:g}, {integrator}: {{}}, worst of Ca to {Ca[-1]:g}"
            rows += worst_of_each(title, NAMES, ours, expected, ROSCOE, (1e-3,) * 3)
        fine = np.linspace(0.01, float(Ca[-1]), 40)
        line = np.array([soft.roscoe_rheology(c, ratio) for c in fine])
        for k in range(3):
            panels[k].append(Curve(Ca, ours[:, k], f"foamprb, η_s/μ_f = {ratio:g}", colour=colour))
            name = "Roscoe (1967)" if colour == 0 else ""
            panels[k].append(Curve(fine, line[:, k], name, "reference", colour))

    numbers = np.array(sorted(GIVEN))
    cloud = unit_cloud(analytic.shear(1.0), numbers, 1e-6, 0.05, Models(integrator="stokes", tolerance=1e-7))
    advance_to(cloud, 60.0)
    ours = np.array([soft.rheology(S) for S in stresslets(cloud)])
    exact = np.array([GIVEN[c] for c in numbers])
    title = "spheres: {}, worst of Ca = 0.05, 0.1, 0.4"
    rows += worst_of_each(title, NAMES, ours, exact, QUADRATURE, (6e-4,) * 2)

    small = np.array([0.01, 0.02])
    cloud = unit_cloud(analytic.shear(1.0), small, 1e-6, 0.02, Models(integrator="stokes", tolerance=1e-7))
    advance_to(cloud, 5.0)
    near = np.array([soft.rheology(S) for S in stresslets(cloud)])
    slope = np.log2((2.5 - near[1, 0]) / (2.5 - near[0, 0]))
    rows += [
        Row("small Ca: N₁/(μ_f γ̇ φ Ca), Ca = 0.01", float(near[0, 1] / 0.01), 12.5, SMALL, 0.02),
        Row("small Ca: order in Ca at which [η] falls from 5/2", float(slope), 2.0, "symmetry", 0.02),
    ]

    times = np.linspace(0.5, 6.0 if quick else 20.0, 12 if quick else 40)
    body = soft.Body(0.2, soft.stretched((2.0, 1.0, 1.0)))
    exact = np.array([soft.particle_stress(F, SHEAR, body) for F in soft.deformation(SHEAR, body, times)])
    cloud = unit_cloud(
        analytic.shear(1.0),
        0.2,
        1e-6,
        0.05,
        Models(integrator="stokes", tolerance=1e-7),
        ratios=(2.0, 1.0, 1.0),
    )
    path = follow(cloud, times, stresslets)[:, 0]
    rows.append(
        worst(
            "soft spheroid, r = 2, Ca = 0.2, tumbling: component of S/(μ_f γ̇ V), worst of all times",
            path.ravel(),
            exact.ravel(),
            ODE,
            1e-3,
        )
    )
    more, figure = _spheroids(quick)
    rows += more + _average(quick)
    labels = ("[η]", "N₁/(μ_f γ̇ φ)", "N₂/(μ_f γ̇ φ)")
    figures = [
        Figure(
            "suspension",
            "Dilute suspensions of Kelvin–Voigt spheres in simple shear: intrinsic viscosity and normal "
            "stress differences per volume fraction φ.",
            [Panel("Ca = μ_f γ̇/μ_s", label, c) for label, c in zip(labels, panels, strict=True)],
        ),
        figure,
    ]
    return Outcome(rows, figures, _REMARKS)


_REMARKS = [
    "The suspension is dilute: each particle is in the undisturbed flow, and the stress is −p I + 2 μ_f "
    "d_f + n S with n particles per volume, V n = φ. foamprb computes S on the fluid's side, as the "
    "strength of Jeffery's far field. The reference for soft spheres computes it on the solid's side, "
    "from the stress in Roscoe's ellipsoid and the motion of its material, without integrals of the flow.",
    "To first order in the strain a soft sphere is a corotational Kelvin–Voigt element, S/(V μ_f) = 5 E "
    "(1 − i Ca)/(1 + 3/2 i Ca) with i a quarter turn in the plane of strain: [η] = 5/2 and N₁ = 25/2 Ca "
    "for small Ca. Soft suspensions are shear-thinning, and beyond Ca of about 0.9 elastic spheres lower "
    "the viscosity below that of the fluid; Gao, Hu & Ponte Castañeda (2012) report a negative intrinsic "
    "viscosity of sufficiently soft particles.",
    "The stress of a stiff body is its strain over Ca, so an error ε of a step is one of ε/Ca in S. The "
    f"rigid spheroids have Ca = {STIFF:g} and steps of 0.008/γ̇; the remaining difference is that of this "
    "small elasticity, proportional to Ca, and independent of the step.",
]
