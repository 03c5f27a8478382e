"""Settling: beyond the paper's figures."""

from __future__ import annotations

import numpy as np
from scipy.spatial.transform import Rotation

from foamprb.body.drag import DRAGS
from foamprb.body.ellipsoid import integrals
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import set_rest_shape, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst
from validation.references.ellipsoid import prolate_resistances, resistances
from validation.references.extension import (
    EXTENSIONS,
    settling_in_extension,
    steady_compressible_extension,
)
from validation.references.inertia import DRAGS as REFERENCE_DRAGS
from validation.runs import (
    DIAMETER,
    GRAVITY,
    MU_F,
    RHO_F,
    RHO_S,
    SETTLING,
    advance_to,
)

QUADRATURE = "Oberbeck's resistances by quadrature, closed-form motion"
TERMINAL = "Oberbeck's resistances by quadrature"
SPHEROID = "closed-form resistances of a prolate spheroid (D.1), (D.2)"

SHAPES = ((5.0, 3.0, 1.0), (2.0, 1.5, 1.0), (1.0, 10.0, 3.0), (3.0, 3.0, 1.0))
ORIENTATIONS = 8


def _terminal(integrator: str, ratios: Floats, axes: Floats) -> Floats:
    """Return velocities (n, 3) over those of spheres of equal volume, after 30 response times."""
    n = len(axes)
    p = spheres(np.zeros((n, 3)), d=DIAMETER, rho=RHO_S, mu=100.0)
    set_rest_shape(p, ratios, axes)
    still = analytic.linear(np.zeros((3, 3)))
    air = Medium(MU_F, RHO_F, (0.0, -GRAVITY, 0.0))
    # The paper's scheme is stable below 1.5 times the shape's relaxation time, 6e-5 s.
    dt = 2e-5 if integrator == "paper" else 1e-4
    cloud = Cloud(p, still, air, (), dt, Models(integrator=integrator, tolerance=1e-6), threads=1)
    advance_to(cloud, 0.024)
    return np.asarray(p.v / SETTLING)


def _expected(resistances: Floats, axes: Floats) -> Floats:
    """Return the expected ones by resistances (n, 3) over the radius: v = Σ e_a e_a·f_G/(μ_f K_a)."""
    along = np.einsum("naj,j->na", axes, np.array([0.0, -6.0 * np.pi, 0.0]))
    return np.asarray(np.einsum("na,naj->nj", along / resistances, axes))


def _ellipsoids(quick: bool) -> tuple[list[Row], list[Figure]]:
    """Compare ellipsoids at rest in every orientation, and the oblique drift of spheroids."""
    rows: list[Row] = []
    turns = Rotation.random(ORIENTATIONS * len(SHAPES), rng=np.random.default_rng(20)).as_matrix()
    ratios = np.repeat(np.array(SHAPES), ORIENTATIONS, axis=0)
    semi_axes = ratios / np.cbrt(ratios.prod(axis=1, keepdims=True))
    expected = _expected(np.array([resistances(a) for a in semi_axes]), turns)
    for integrator in ("stokes",) if quick else ("stokes", "rosenbrock", "paper"):
        v = _terminal(integrator, ratios, turns)
        for i, shape in enumerate(SHAPES):
            part = slice(i * ORIENTATIONS, (i + 1) * ORIENTATIONS)
            name = "{:g}:{:g}:{:g}".format(*shape) + f" at rest, {integrator}: component of v/v_sphere"
            rows.append(
                worst(
                    f"{name}, worst of {ORIENTATIONS} orientations",
                    v[part].ravel(),
                    expected[part].ravel(),
                    TERMINAL,
                    1e-6,
                )
            )

    angles = np.linspace(0.0, 90.0, 31)
    curves: list[Curve] = []
    for colour, r in enumerate((2.0, 5.0, 20.0)):
        # The axis leans by the angle from the vertical.
        turned = Rotation.from_rotvec(np.outer(angles + 90.0, [0.0, 0.0, 1.0]), degrees=True)
        bodies = np.broadcast_to((r, 1.0, 1.0), (len(angles), 3))
        v = _terminal("stokes", bodies, turned.as_matrix().transpose(0, 2, 1))
        drift = np.degrees(np.arctan2(abs(v[:, 0]), -v[:, 1]))
        along, across, _ = prolate_resistances(np.array([r, 1.0, 1.0]))
        a = np.radians(angles)
        exact = np.degrees(
            np.arctan2((1 / along - 1 / across) * np.sin(a) * np.cos(a),
                       np.cos(a) ** 2 / along + np.sin(a) ** 2 / across)
        )  # fmt: skip
        rows.append(worst(f"{r:g}:1:1, drift from the vertical [deg], worst of all leans", drift, exact,
                          SPHEROID, 1e-5))  # fmt: skip
        labels = f"foamprb, aspect ratio {r:g}", "closed form" if colour == 0 else ""
        curves += compared(angles, drift, exact, labels, colour, 2)
    figure = Figure(
        "settling",
        "Oblique settling of prolate spheroids in a fluid at rest.",
        [Panel("lean of the axis from the vertical [deg]", "drift from the vertical [deg]", curves)],
    )
    return rows, [figure]


def settling(quick: bool) -> Outcome:
    """Settling."""
    R = DIAMETER / 2.0
    p = spheres([[0.0, 0.0, 0.0]], d=DIAMETER, rho=RHO_S, mu=100.0)
    still = analytic.linear(np.zeros((3, 3)))
    air = Medium(MU_F, RHO_F, (0.0, -GRAVITY, 0.0))
    cloud = Cloud(p, still, air, (), 2e-5, Models(integrator="paper"), threads=1)
    cloud.advance(1000)
    rows = [
        Row(
            "sphere: velocity [m/s]",
            float(-p.v[0, 1]),
            SETTLING,
            "Stokes: d² (ρ_s − ρ_f) g/(18 μ_f)",
            1e-8,
            True,
        )
    ]

    # A planar extension keeps the body triaxial; gravity acts along one of its axes after the other.
    Ca, rate, t = 0.2, 300.0, 2e-3
    axes = steady_compressible_extension(EXTENSIONS["planar"], Ca, 0.499)
    rates = rate * EXTENSIONS["planar"]
    mass = 4.0 / 3.0 * np.pi * R**3 * RHO_S
    for drag in ["oberbeck"] if quick else REFERENCE_DRAGS:
        K = REFERENCE_DRAGS[drag](axes) * R
        for k in range(3):
            g = np.zeros(3)
            g[k] = -GRAVITY
            speeds = []
            for dt in (4e-6, 2e-6):
                p = spheres([[0.0, 0.0, 0.0]], d=DIAMETER, rho=RHO_S, mu=MU_F * rate / Ca)
                p.F[:] = np.diag(axes).ravel()
                medium = Medium(MU_F, RHO_F, (float(g[0]), float(g[1]), float(g[2])))
                flow = analytic.linear(np.diag(rates))
                cloud = Cloud(p, flow, medium, (), dt, Models(drag=drag, integrator="paper"), threads=1)
                advance_to(cloud, t)
                speeds.append(float(p.v[0, k]))
            a = (1.0 - float(np.prod(axes)) * RHO_F / RHO_S) * g
            expected = settling_in_extension(K, mass, MU_F, rates, a, t)[1][k]
            name = f"deformed body, gravity along axis {k + 1}, {drag}: velocity [m/s]"
            # Δt → 0 from two steps of a first-order scheme.
            rows.append(Row(name, 2.0 * speeds[1] - speeds[0], float(expected), QUADRATURE, 1e-4, True))
    for shape in ((5.0, 3.0, 1.0), (2.0, 1.0, 1.0)):
        ours = np.array(DRAGS["oberbeck"](shape, integrals(shape))) / np.pi
        expected_k = resistances(np.array(shape)) / np.pi
        rows += [
            Row(
                "resistance {:g}:{:g}:{:g}, K_{}/(π r_min)".format(*shape, k + 1),
                float(ours[k]),
                float(expected_k[k]),
                "Oberbeck's resistances by quadrature",
                1e-10,
                True,
            )
            for k in range(3)
        ]
    printed = (15.501, 17.066, 20.565)
    ours = np.array(DRAGS["oberbeck"]((5.0, 3.0, 1.0), integrals((5.0, 3.0, 1.0)))) / np.pi
    rows += [
        Row(
            f"resistance 5:3:1, K_{k + 1}/(π r_min)",
            float(ours[k]),
            printed[k],
            "Štrakl et al. 2022",
            2e-3,
            True,
            kind="others",
        )
        for k in range(3)
    ]
    more, figures = _ellipsoids(quick)
    return Outcome(rows + more, figures, [])
