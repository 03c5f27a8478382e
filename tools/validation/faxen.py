"""Bodies in a pipe's curved flow, with Faxén's correction (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Escape
from foamprb.cloud.state import Particles, set_rest_shape, spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Outcome, Row
from validation.references import wall as ref

RADIUS, MEAN, R, MU_F = 1e-4, 1e-3, 1e-5, 1e-3
PLACES = (0.0, 0.3, 0.6)
"""Of the centres, over the pipe's radius."""


def lag(quick: bool) -> Outcome:
    """Faxén's correction in pipe."""
    rows = []
    unit = 2.0 * MEAN * (R / RADIUS) ** 2
    for place, velocity in zip(PLACES, _lags(_bodies(1e4)), strict=True):
        title = f"stiff sphere at {place:g} a: lag over u_max (R/a)²"
        rows.append(Row(title, velocity / unit, 2.0 / 3.0, "Happel & Brenner (1965)", 2e-3, relative=True))
    axes = np.array([1.5, 1.0, 1.0 / 1.5])
    p = _bodies(1e4)
    set_rest_shape(p, tuple(axes))
    theirs = _lag_around(axes)
    for place, velocity in zip(PLACES, _lags(p), strict=True):
        title = f"ellipsoid 1.5 : 1 : 0.67 along the pipe, at {place:g} a: lag over u_max (R/a)²"
        rows.append(Row(title, velocity / unit, theirs, "Stokes flow around it", 5e-3, relative=True))
    soft = _bodies(0.4)
    before = soft.x.copy()
    _advance(soft, 1e-4, 200 if quick else 2000)
    way = soft.x - before
    drift = float(np.abs(way[:, 1:]).max() / way[:, 0].max())
    title = f"soft bodies, stretched up to {np.linalg.norm(soft.F.reshape(-1, 3, 3), 2, (1, 2)).max():.2f}"
    rows.append(Row(f"{title}: way across over way along", drift, 0.0, "symmetry", 1e-10))
    return Outcome(rows, [], [])


def _bodies(mu: float) -> Particles:
    x = [(0.0, place * RADIUS, 0.0) for place in PLACES]
    return spheres(x, d=2.0 * R, rho=1.0, mu=mu, poissons_ratio=0.4999)


def _lags(p: Particles) -> list[float]:
    """Return the lags of the bodies behind the fluid at their centres, m/s."""
    _advance(p, 1e-7, 1)
    u, _ = analytic.pipe(RADIUS, MEAN).sample(p.x, p.host, 0.0)
    return [float(slower) for slower in u[:, 0] - p.v[:, 0]]


def _advance(p: Particles, dt: float, steps: int) -> None:
    flow = analytic.pipe(RADIUS, MEAN)
    models = Models(integrator="stokes", surroundings=(FaxenCorrection(),))
    rules = [Escape()] * len(flow.patches)
    Cloud(p, flow, Medium(MU_F, 1000.0, (0.0, 0.0, 0.0)), rules, dt, models, threads=1).advance(steps)


def _lag_around(axes: np.ndarray) -> float:
    """Return the lag over u_max (R/a)² of a body with semi-axes along x, y and z, in units of R."""
    body = ref.Ellipsoid(np.diag(axes), np.inf)
    u = np.zeros_like(body.x)
    # The lag is that of the quadratic part of the profile, which is the same everywhere.
    u[:, 0] = -(body.x[:, 1] ** 2 + body.x[:, 2] ** 2)
    v = np.linalg.solve(body.resistance(), body.moments(u)[0])
    return -float(v[0])
