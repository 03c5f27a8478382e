"""Migration of soft bodies against their weight in vertical flows (beyond the paper)."""

from __future__ import annotations

import numpy as np

from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.patches import Rebound
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row
from validation.references.ellipsoid import resistances
from validation.references.roscoe import roscoe_at

SIGNS = "Förtsch et al. (2017), simulated capsules"
SMALL = "slightly deformed sphere (Brenner 1964)"
ROSCOE = "Roscoe's ellipsoid and Oberbeck's resistances by quadrature"
R, MU_F, RHO, RATE = 1e-3, 1.0, 1000.0, 1.0
HEIGHT = 40.0 * R


def _drifts(flow: analytic.AnalyticFlow, Ca: Floats, heights: Floats, excess: Floats) -> Floats:
    """Return velocities across the flow over the settling speed of a sphere, (n,); gravity acts along x.

    Parameters
    ----------
    Ca
        μ_f γ̇/μ_s with the rate ``RATE``.
    heights
        Places z, m.
    excess
        Differences of the densities, kg/m³.
    """
    x = np.zeros((len(Ca), 3))
    x[:, 2] = heights
    p = spheres(x, d=2.0 * R, rho=RHO + excess, mu=MU_F * RATE / Ca, poissons_ratio=0.4999)
    medium = Medium(MU_F, RHO, (9.81, 0.0, 0.0))
    walls = [Rebound()] * len(flow.patches)
    Cloud(p, flow, medium, walls, 0.02, Models(integrator="stokes", tolerance=1e-7), threads=1).advance(1000)
    return np.asarray(p.v[:, 2] / (2.0 / 9.0 * R**2 * abs(excess) * 9.81 / MU_F))


def slit(quick: bool) -> Outcome:
    """Migration against weight in vertical slits."""
    rows = []
    for way, flow in (("down", 1.0), ("up", -1.0)):
        profile = analytic.slit(HEIGHT, flow * RATE * HEIGHT / 6.0)
        drifts = _drifts(profile, np.full(2, 0.1), np.full(2, 0.25 * HEIGHT), np.array([1.0, -1.0]))
        for kind, excess, drift in zip(("heavy", "light"), (1.0, -1.0), drifts, strict=True):
            title = f"{kind} bodies, flow {way}: sign of the drift, 1 to the centre"
            rows.append(Row(title, float(np.sign(drift)), flow * excess, SIGNS, 0.0, kind="others"))
    shear = analytic.linear(RATE * np.outer([1.0, 0.0, 0.0], [0.0, 0.0, 1.0]))
    Ca = np.array([1e-3, 0.02, 0.05, 0.1, 0.2, 0.4])[:: 2 if quick else 1]
    ours = _drifts(shear, Ca, np.zeros(len(Ca)), np.ones(len(Ca)))
    rows.append(Row(f"Ca = {Ca[0]:g}: v/(Ca v_s)", float(ours[0] / Ca[0]), 0.25, SMALL, 1e-3, relative=True))
    expected = np.array([_of_ellipsoid(c) for c in Ca])
    for c, drift, other in zip(Ca[1:], ours[1:], expected[1:], strict=True):
        rows.append(Row(f"Ca = {c:g}: v/v_s", float(drift), float(other), ROSCOE, 1e-3, relative=True))
    curves = [
        Curve(Ca, ours, "foamprb"),
        Curve(Ca, expected, "Roscoe's ellipsoid", "reference"),
        Curve(Ca, 0.25 * Ca, "Ca/4", "guide"),
    ]
    panel = Panel("Ca = μ_f γ̇/μ_s", "v/v_s", curves)
    return Outcome(
        rows, [Figure("migration", "Drift of a soft body across a vertical shear.", [panel])], [REMARK]
    )


def _of_ellipsoid(Ca: float) -> float:
    """Return the drift over v_s of Roscoe's steady ellipsoid, whose weight acts along the flow."""
    _, b, c, angle, _ = roscoe_at(Ca)
    axes = np.array([1.0, b, c])
    axes /= np.cbrt(np.prod(axes))
    along, across, _ = 6.0 * np.pi / resistances(axes)
    t = np.radians(angle)
    return float((along - across) * np.sin(t) * np.cos(t))


REMARK = (
    "A body that sinks or rises in a vertical shear moves across it, since the flow tilts its long axis. For "
    "small deformation v = Ca v_s/4, with the settling speed v_s of the sphere: the strain of the body is "
    "⁵⁄₄ Ca, and the mobility of a slightly deformed sphere changes by a fifth of its strain. The simulated "
    "capsules are bead models (arXiv:1704.06590), whose abstract states the four signs; their velocities are "
    "in figures that could not be read."
)
