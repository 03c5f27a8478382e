"""Rigid ellipsoids in shear: Jeffery's orbits (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.interpolate import CubicSpline
from scipy.spatial.transform import Rotation

from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst
from validation.references import rigid
from validation.references.shear import SHEAR
from validation.runs import IDENTITY, principal_axes, unit_cloud

PERIOD = "Jeffery (1922): 2π (r + 1/r)"
ORBIT = "Jeffery (1922): closed orbit"
TRIAXIAL = "Jeffery's equations of a rigid ellipsoid by solve_ivp"

SPHEROIDS = (2.0, 3.0, 5.0, 10.0, 1.0 / 3.0)
TRIAXIALS = ((3.0, 2.0, 1.0), (2.0, 1.0, 1.4))
CAPILLARY = 1e-5
TURN = Rotation.from_rotvec([0.3, -0.8, 1.1]).as_matrix()
"""From the axes of the flow to those of the bodies whose orbits lie out of the plane of shear."""


def _paths(integrator: str, end: float) -> tuple[Floats, Floats, Floats]:
    """Return times (m,), semi-axes (m, n, 3) and axes (m, n, 3, 3), as rows in rising order of length.

    First the spheroids with their axis along the flow, then turned, then the triaxial bodies, turned.
    """
    spheroids = [(r, 1.0, 1.0) for r in SPHEROIDS]
    ratios = np.array(2 * spheroids + list(TRIAXIALS))
    axes = np.array(len(spheroids) * [IDENTITY] + (len(ratios) - len(spheroids)) * [TURN])
    dt = 0.05
    # γ̇ τ_s = 1e-6, where inertia turns the orbits by less than round-off of what is shown.
    models = Models(integrator=integrator, tolerance=1e-6)
    cloud = unit_cloud(
        analytic.shear(1.0), np.full(len(ratios), CAPILLARY), 1e-6, dt, models, ratios=ratios, axes=axes
    )
    shapes = [principal_axes(cloud.particles)]
    times = [0.0]
    for _ in range(round(end / (4.0 * dt))):
        cloud.advance(4)
        shapes.append(principal_axes(cloud.particles))
        times.append(cloud.time)
    return np.array(times), np.array([f[0] for f in shapes]), np.array([f[1] for f in shapes])


def _symmetry_axis(ratio: float, axes: Floats) -> Floats:
    """Return the axis of a spheroid, (m, 3), among rows in rising order of length (m, 3, 3)."""
    return axes[:, 2 if ratio > 1.0 else 0]


def _period(times: Floats, axis: Floats) -> float:
    """Return twice the mean time between half turns of an axis (m, 3) in the plane of shear."""
    turned = -np.unwrap(np.arctan2(axis[:, 1], axis[:, 0]), period=np.pi)
    turned -= turned[0]
    halves = np.arange(1, int(turned[-1] / np.pi) + 1)
    at = CubicSpline(turned, times)(np.pi * halves)
    return float(2.0 * at[-1] / halves[-1])


def orbits(quick: bool) -> Outcome:
    """Jeffery's orbits."""
    rows = []
    curves: list[Curve] = []
    paths: list[Curve] = []
    end = 32.0 if quick else 65.0
    for integrator in ("stokes", "rosenbrock"):
        times, lengths, axes = _paths(integrator, end)
        n = len(SPHEROIDS)
        for i, r in enumerate(SPHEROIDS):
            period = rigid.jeffery_period(r)
            if period / 2.0 < end:
                ours = _period(times, _symmetry_axis(r, axes[:, i]))
                name = f"r = {r:.3g}, {integrator}: period γ̇T in the plane of shear"
                rows.append(Row(name, ours, period, PERIOD, 1e-4, True))
        for i, r in enumerate(SPHEROIDS):
            p = _symmetry_axis(r, axes[:, n + i])
            expected = rigid.jeffery_axis(p[0], r, times)
            C = rigid.orbit_constant(p, r)
            name = f"r = {r:.3g}, {integrator}, out of the plane"
            rows += [
                worst(f"{name}: orbit constant over its start", C / C[0], np.ones_like(C), ORBIT, 1e-3),
                Row(
                    f"{name}: angle to the exact axis [deg], worst of all times",
                    float(np.degrees(np.arccos(np.minimum(abs((p * expected).sum(1)), 1.0))).max()),
                    0.0,
                    ORBIT,
                    0.1,
                ),
            ]
            if integrator == "stokes":
                signed = p * np.sign((p * expected).sum(1))[:, None]
                paths.append(Curve(signed[:, 0], signed[:, 1], f"r = {r:.3g}", colour=i))
                sparse = slice(None, None, 6)
                paths.append(Curve(expected[sparse, 0], expected[sparse, 1], "", "reference", i))
        for i, shape in enumerate(TRIAXIALS):
            Q = axes[:, 2 * n + i]
            order = np.argsort(shape)
            expected = rigid.rigid_axes(np.array(shape)[order], Q[0], SHEAR, times)
            # Axes have no sign: the worst of the three angles at each time.
            cosines = np.abs(np.einsum("mai,mai->ma", Q, expected)).min(axis=1)
            rows.append(
                Row(
                    "{:g}:{:g}:{:g}, ".format(*shape)
                    + f"{integrator}: angle of an axis [deg], worst of all times",
                    float(np.degrees(np.arccos(np.minimum(cosines, 1.0))).max()),
                    0.0,
                    TRIAXIAL,
                    0.2,
                )
            )
            if integrator == "stokes":
                label = "{:g}:{:g}:{:g}".format(*shape)
                curves.append(Curve(times, abs(Q[:, 2, 0]), f"foamprb, {label}", colour=i))
                sparse = slice(None, None, 6)
                mark = "solve_ivp"
                curves.append(Curve(times[sparse], abs(expected[sparse, 2, 0]), mark, "reference", i))
        at_rest = np.sort(np.array([(r, 1.0, 1.0) for r in SPHEROIDS]), axis=1)
        at_rest /= np.cbrt(at_rest.prod(axis=1, keepdims=True))
        rows.append(
            Row(
                f"{integrator}: semi-axes over those at rest − 1, worst of the spheroids and times",
                float(abs(lengths[:, :n] / at_rest - 1.0).max()),
                0.0,
                "rigid body",
                3e-4,
            )
        )
    figure = Figure(
        "jeffery",
        f"Axes of quasi-rigid bodies, Ca = {CAPILLARY:g}: spheroids (left, seen along the vorticity) and the "
        "longest axis of triaxial bodies (right).",
        [Panel("p₁", "p₂", paths, "equal"), Panel("γ̇t", "|p₁|", curves)],
    )
    remarks = [
        f"The bodies are soft solids of Ca = {CAPILLARY:g} with ellipsoids as rest shapes. Their small "
        "softness makes the orbit's constant drift in proportion to Ca, for a prolate body towards the "
        "plane of shear and for an oblate one towards the vorticity; for a rigid body it is constant. The "
        "motion of a body with three different axes is not periodic (Hinch & Leal 1979)."
    ]
    return Outcome(rows, [figure], remarks)
