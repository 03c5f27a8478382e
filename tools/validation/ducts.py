"""Lift by inertia of the fluid and by walls in a plane channel (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

from foamprb.body.lift import (
    LONG,
    PIPE,
    PLANE_CHANNEL,
    SHORT,
    balances,
    duct_coefficient,
    hinges,
    rectangle_coefficient,
    rectangles,
)
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import DuctLift
from foamprb.cloud.patches import Stick
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst
from validation.references import rectangle, tube
from validation.references.duct import coefficient
from validation.runs import follow

QUADRATURE = "modes along the walls, first order in Re"
MODES = "modes along and around, first order in Re"
MU, RHO, RADIUS, HEIGHT = 1e-3, 1000.0, 5e-6, 1e-4
STARTS = np.array([0.15, 0.25, 0.35, 0.45])
"""Distances from the lower wall over the height."""


def _paths(Ca: float, rate: float, inertia: bool, times: Floats) -> Floats:
    """Return distances from the lower wall over the height, (m, n), of neutral bodies at times (m,), s.

    ``rate`` is the shear rate at the walls, 1/s.
    """
    flow = analytic.slit(HEIGHT, rate * HEIGHT / 6.0)
    x = np.zeros((len(STARTS), 3))
    x[:, 2] = HEIGHT * STARTS
    p = spheres(x, d=2.0 * RADIUS, rho=RHO, mu=MU * rate / Ca, poissons_ratio=0.4999)
    middle = (0.0, 0.0, 0.5 * HEIGHT)
    lift = DuctLift(
        shape="channel", origin=middle, direction=(0.0, 0.0, 1.0), size=middle[2],
        shearRate=rate if inertia else 0.0,
    )  # fmt: skip
    models = Models(
        integrator="stokes", forces=(lift,), surroundings=(WallLift(cutOff=25.0, mobility=False),), stride=20
    )
    cloud = Cloud(p, flow, Medium(MU, RHO, (0.0, 0.0, 0.0)), [Stick(), Stick()], 1e-4, models, threads=1)
    return follow(cloud, times, lambda c: c.particles.x[:, 2] / HEIGHT)


def _own(rate: float, times: Floats) -> Floats:
    """Return the paths of rigid spheres, 6π μ_f R dz/dt = C ρ_f γ̇² R⁴."""
    s, C = np.transpose(PLANE_CHANNEL)
    scale = RHO * (rate * RADIUS) ** 2 * RADIUS / (6.0 * np.pi * MU * HEIGHT)

    def speed(_t: float, z: Floats) -> Floats:
        return np.asarray(scale * np.sign(z - 0.5) * np.interp(np.abs(2.0 * z - 1.0), s, C))

    answer = solve_ivp(speed, (0.0, float(times[-1])), STARTS, "LSODA", times, rtol=1e-9, atol=1e-12)
    return np.asarray(answer.y.T)


def focusing(quick: bool) -> Outcome:
    """Focusing in plane channel."""
    (place,) = balances(PLANE_CHANNEL)
    table = hinges(PLANE_CHANNEL)
    rows = [
        Row(f"C at s = {s:g}", float(duct_coefficient(s, table)), coefficient(s), QUADRATURE, 1e-3)
        for s in (0.1, 0.33, 0.5, 0.77, 0.9)
    ]
    rows += [
        Row("quadrature of C near the wall, s = 0.9995", coefficient(0.9995), -55.0 * np.pi / 96.0,
            "Cox & Hsu (1977), one wall", 3e-3, True),
        Row("s at which C = 0", place, 0.62, "cubic after Vasseur & Cox (1976), as in the code arb", 0.02),
    ]  # fmt: skip
    if quick:
        return Outcome(rows, [], [])
    pipe = hinges(PIPE)
    rows += [
        Row(f"pipe: C at s = {s:g}", float(duct_coefficient(s, pipe)), tube.coefficient(s, n), MODES, 3e-3)
        for s, n in ((0.1, 24), (0.3, 24), (0.5, 24), (0.6, 48), (0.7, 48))
    ]
    (place,) = balances(PIPE)
    rows.append(Row("pipe: s at which C = 0", place, 0.6, "Segré & Silberberg (1962)", None, kind="measured"))
    rate, times = 1e4, np.linspace(0.0, 0.1, 41)[1:]
    ours, reference = _paths(1e-4, rate, True, times), _own(rate, times)
    for k, start in enumerate(STARTS):
        name = f"rigid, from {start:g} H: distance from the wall over H, worst of all times"
        rows.append(worst(name, ours[:, k], reference[:, k], "6π μ_f R v = C ρ_f γ̇² R⁴ by LSODA", 1e-3))
    for Ca in (0.01, 0.1, 0.3):
        end = _paths(Ca, rate, True, np.array([5.0]))[0]
        rows.append(Row(f"Ca = {Ca:g} at the wall, both lifts: the same", float(end.mean()), None, "–"))
        rows.append(
            Row(
                f"Ca = {Ca:g}: spread over the starts", float(np.ptp(end)), 0.0, "one place", 1e-4, kind="own"
            )
        )
    late = np.linspace(0.0, 20.0, 41)
    alone = _paths(0.2, 1e3, False, late[1:])
    rising = float(np.diff(np.vstack([STARTS, alone]), axis=0).min())
    rows.append(Row("Ca = 0.2, wallLift alone: smallest rise in 0.5 s", max(0.0, -rising), 0.0, "sign", 1e-9))
    rows.append(
        Row("the same: distance from the wall after 20 s, from 0.15 H", float(alone[-1, 0]), None, "–")
    )
    figure = Figure(
        "ductLift",
        "Neutral bodies of 10 µm in a channel of 100 µm: rigid ones with ductLift (10⁴ 1/s at the walls; "
        "markers: LSODA), and soft ones with wallLift alone (10³ 1/s).",
        [
            Panel(
                "t [s]",
                "z/H",
                [Curve(times, ours[:, k], "foamprb" if k == 0 else "", colour=k) for k in range(len(STARTS))]
                + [Curve(times[::4], reference[::4, k], "", "reference", k) for k in range(len(STARTS))],
            ),
            Panel(
                "t [s]",
                "z/H",
                [
                    Curve(late, np.append(start, alone[:, k]), "Ca = 0.2" if k == 0 else "", colour=k)
                    for k, start in enumerate(STARTS)
                ],
            ),
        ],
    )
    return Outcome(rows, [figure], [_REMARK])


_REMARK = (
    "Soft bodies gather nearer to the middle than rigid ones, as both lifts act. There is no reference for "
    "the sum of the two lifts."
)


HOOD = "Hood, Lee & Roper (2015), tables of Zenodo 833532, 832328, 833521"
_POINTS = ((1, 0.125, 0.125, 3.96), (1, 0.25, 0.0, 6.25), (1, 0.25, 0.125, 4.93), (2, 0.1875, 0.0, 5.50),
           (2, 0.375, 0.0, -5.25), (2, 0.25, 0.25, 4.25))  # fmt: skip
"""Aspect ratio, places along the force and across it over the shorter side, and c₄ of the force
c₄ ρ_f U² R⁴/H² with the largest velocity U. In a square it is the mean of two equivalent places, which differ
by 2 %."""


def rectangular(quick: bool) -> Outcome:
    """Lift in rectangular ducts."""
    rows = []
    for A, z, y, theirs in _POINTS:
        U = rectangle.profile(np.zeros(1), np.zeros(1), A)[0][0, 0]
        name = f"{A}:1, c₄ at {z:g} along the force and {y:g} across it"
        c = _across(A, z, y) * (2.0 * rectangle.wall_rate(A) / U) ** 2
        rows.append(Row(name, c, theirs, HOOD, 0.4, kind="others"))
    zeros = {
        "square, middle of a side": (brentq(lambda t: _across(1, t, 0.0), 0.25, 0.45), 0.348),
        "2:1, middle of a long side": (brentq(lambda t: _across(2, t, 0.0), 0.25, 0.45), 0.324),
        "2:1, middle of a short side": (brentq(_along, 0.6, 0.95), 0.819),
        "4:1, middle of a long side": (brentq(lambda t: _across(4, t, 0.0), 0.25, 0.45), 0.306),
    }
    rows += [
        Row(f"{name}: place of balance over the shorter side", float(ours), theirs, HOOD, 0.02, kind="others")
        for name, (ours, theirs) in zeros.items()
    ]  # fmt: skip
    places = np.array([[0.0, 0.25], [0.25, 0.5], [0.5, 0.55], [0.35, 0.7]])
    for place, own in zip(places, rectangle.coefficients(places, 1.0, (24, 24)), strict=True):
        ours = _across(1, 0.5 * place[1], 0.5 * place[0])
        name = f"square, C across at ({place[0]:g}, {place[1]:g})"
        rows.append(Row(name, ours, float(own[1]), QUADRATURE, 3e-3))
    if not quick:
        (own,) = rectangle.coefficients(np.array([[0.0, 0.4]]), 8.0, (80, 28))
        name = "8:1, quadrature in the middle, s = 0.4"
        rows.append(Row(name, float(own[1]), coefficient(0.4), "quadrature of the plane channel", 1e-3, True))
    return Outcome(rows, [], [])


def _across(A: int, z: float, y: float) -> float:
    """Return C of the shorter direction; z along the force and y across it over the shorter side."""
    return float(rectangle_coefficient(2.0 * z, 2.0 * y / A, rectangles()[A][1], LONG))


def _along(y: float) -> float:
    """Return C of the longer direction in a 2:1 duct in the middle of the other."""
    return float(rectangle_coefficient(y, 0.0, rectangles()[2][0], SHORT))
