"""Deterministic lateral displacement of rigid spheres by arrays of round posts (beyond the paper)."""

from __future__ import annotations

import numpy as np
from scipy.optimize import brentq

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.base import Surrounding
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.surroundings.wall_lift import WallLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row

GAP, SPEED, STEP = 1e-5, 1e-3, 2e-5
"""m, half the spacing; m/s; s, in which the fluid goes 0.002 of the gap."""
SLOPES = (0.05, 0.1, 0.2, 1.0 / 3.0)
INGLIS = "parabola between the posts, b² (3 − 2b) = ε, Inglis et al. (2006)"
DAVIS = "1.4 ε^0.48, fitted to measurements, Davis (2008)"


def _array(slope: float, shifted: bool) -> analytic.AnalyticFlow:
    """Return the flow along x through rows that rise by ``slope``, or in the frame of a square array."""
    if shifted:
        return analytic.posts(2.0 * GAP, GAP, (SPEED, 0.0), 2.0 * GAP * slope)
    return analytic.posts(2.0 * GAP, GAP, (SPEED, -slope * SPEED))


def _stream(slope: float, shifted: bool) -> float:
    """Return twice the width of the stream next to a post, the share ``slope`` of the flow through a gap."""
    flow = _array(slope, shifted)
    nodes, weights = np.polynomial.legendre.leggauss(40)

    def flux(width: float) -> float:
        x = np.zeros((len(nodes), 3))
        x[:, 1] = GAP * (0.5 + 0.5 * width * (1.0 + nodes))
        return width * float(weights @ flow.sample(x, flow.locate(x), 0.0)[0][:, 0])

    return 2.0 * float(brentq(lambda b: flux(b) - slope * flux(1.0), 1e-3, 1.0))


def _crossed(slope: float, shifted: bool, sizes: Floats, around: tuple[Surrounding, ...]) -> Floats:
    """Return which of the spheres of these diameters over the gap cross the rows."""
    x = np.tile([0.0, GAP, 0.0], (len(sizes), 1))
    p = spheres(x, d=sizes * GAP, rho=1000.0, mu=1e4)
    models = Models(integrator="stokes", surroundings=around)
    medium = Medium(1e-3, 1000.0, (0.0, 0.0, 0.0))
    cloud = Cloud(p, _array(slope, shifted), medium, [Rebound(e=0.0)], STEP, models, threads=1)
    period = round(2.0 * GAP / (SPEED * slope * STEP))
    cloud.advance(period)
    start = p.x.copy()
    cloud.advance(2 * period)
    way = p.x - start
    path = way[:, 1] / way[:, 0] - (slope if shifted else 0.0)
    return np.asarray(path < -0.5 * slope)


def critical(
    slope: float, shifted: bool, low: float, high: float, n: int, around: tuple[Surrounding, ...] = ()
) -> tuple[float, float]:
    """Return the critical diameter over the gap and half of the step between n diameters from low to high."""
    sizes = np.linspace(low, high, n)
    crossed = _crossed(slope, shifted, sizes, around)
    half = 0.5 * (sizes[1] - sizes[0])
    if crossed.all() or not crossed.any():
        return float("nan"), half
    return float(sizes[crossed].max() + half), half


def displacement(quick: bool) -> Outcome:
    """Deterministic lateral displacement."""
    rows, sliding, hindered = [], [], []
    for slope in SLOPES[2:3] if quick else SLOPES:
        parabola = 2.0 * float(brentq(lambda b, slope=slope: b * b * (3.0 - 2.0 * b) - slope, 0.0, 1.0))
        davis = 1.4 * slope**0.48
        for shifted in (False, True):
            name = (
                f"{'rows shifted' if shifted else 'square'}, ε = {slope:.3g}: critical diameter over the gap"
            )
            stream = _stream(slope, shifted)
            ours, half = critical(slope, shifted, 0.95 * stream, 1.05 * stream, 21)
            rows += [
                Row(
                    name, ours, stream, "stream next to a post in the same flow", 0.015, True, our_error=half
                ),
                Row(
                    name,
                    ours,
                    parabola,
                    INGLIS,
                    0.05,
                    True,
                    kind="others",
                    our_error=half,
                    note="" if slope > 0.15 else "the flow between round posts is flatter",
                ),
            ]
            if not shifted:
                sliding.append((slope, ours, parabola, davis))
        if not quick:
            ours, half = critical(
                slope, False, davis, min(1.8 * davis, 0.98), 31, (FaxenCorrection(), WallLift())
            )
            name = f"square, ε = {slope:.3g}, with lag and hindrance: the same"
            if not np.isnan(ours):
                rows.append(Row(name, ours, davis, DAVIS, 0.1, True, kind="measured", our_error=half))
            hindered.append(ours)
    if quick:
        return Outcome(rows, [], [])
    e, square, parabolas, fit = np.array(sliding).T
    figure = Figure(
        "dld",
        "Critical diameters of rigid spheres in a square array of posts, half a spacing wide.",
        [Panel("slope ε", "diameter/gap", [
            Curve(e, square, "point contact"), Curve(e, np.array(hindered), "lag and hindrance", colour=1),
            Curve(e, parabolas, "Inglis", "guide"), Curve(e, fit, "Davis", "reference", 1),
        ])],
    )  # fmt: skip
    return Outcome(rows, [figure], [_REMARK])


_REMARK = (
    "Spheres that slide on the posts and else go with the fluid at their centres are bumped if half of "
    "their diameter exceeds the width of the stream next to a post. Between round posts that are as "
    "wide as the gap the flow is flatter than a parabola, so that the critical diameter is 2 to 9 % "
    "smaller than Inglis'. Davis' fit lies between point contact and the model with lag and hindrance "
    "by the posts, which takes them as planes and has a least gap of 0.01 radii; at ε = 1/3 the latter "
    "has no sharp critical diameter. In a device posts end at floor and ceiling and are rough: neither "
    "is in the model."
)
