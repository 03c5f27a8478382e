"""Rotating zones: soft spheres in Couette flow between cylinders, in a rotating frame."""

from __future__ import annotations

from typing import Any, NamedTuple

import numpy as np

from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import Particles, spheres
from foamprb.cloud.surroundings.rotating_frames import RotatingFrames
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Floats
from validation.case import Outcome, Row

A, B = 1.0, 3.0
"""Of u_θ = A r + B/r, 1/s and m²/s."""
OMEGA, END = 4.0, 2.0
"""Ω of the frame, 1/s, and how long the spheres are carried, s."""
_MU_F = 1e-3


class CouetteArrays(NamedTuple):
    """Couette's flow, and the frame in which it is seen."""

    omega: float
    """Of the frame, about z, 1/s."""


def sample(flow: CouetteArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:  # noqa: ARG001
    """Return the velocity relative to the frame, m/s, its gradient, 1/s, and ∂u/∂t = 0."""
    square = x[0] * x[0] + x[1] * x[1]
    f = A + B / square - flow.omega
    fx, fy = -2.0 * B * x[0] / (square * square), -2.0 * B * x[1] / (square * square)
    u = (-f * x[1], f * x[0], 0.0)
    l = (-fx * x[1], -f - fy * x[1], 0.0, f + fx * x[0], fy * x[0], 0.0, 0.0, 0.0, 0.0)
    return u, l, (0.0, 0.0, 0.0)


def rotation_at(flow: CouetteArrays, host: int) -> tuple[Vector, Vector]:  # noqa: ARG001
    """Return Ω, and a point of the axis."""
    return (0.0, 0.0, flow.omega), (0.0, 0.0, 0.0)


def carried(omega: float, rho: float, steps: int = 200) -> Particles:
    """Return soft spheres at several radii after motion in the frame that rotates with ω."""
    kernels: dict[str, Any] = {
        **analytic.linear(np.zeros((3, 3))).kernels,
        "sample": sample,
        "rotation_at": rotation_at,
    }
    radii = np.linspace(1.0, 2.0, 5)
    x = np.stack([radii, 0.3 * radii, 0.0 * radii], axis=1)
    p = spheres(x, d=1e-3, rho=rho, mu=0.05, poissons_ratio=0.4999)
    surroundings = (RotatingFrames(),) if omega else ()
    models = Models(integrator="stokes", surroundings=surroundings, tolerance=1e-6)
    flow, medium = (
        analytic.AnalyticFlow(CouetteArrays(omega), kernels),
        Medium(_MU_F, 1000.0, (0.0, 0.0, 0.0)),
    )
    Cloud(p, flow, medium, (), END / steps, models, threads=1).advance(steps)
    return p


def turned(angle: float) -> Floats:
    """Return the rotation about z by an angle."""
    c, s = np.cos(angle), np.sin(angle)
    return np.array([[c, -s, 0.0], [s, c, 0.0], [0.0, 0.0, 1.0]])


def differences(rho: float, steps: int = 200) -> tuple[float, float]:
    """Return the largest differences of places, m, and of F between both frames, after rotation back."""
    room, rotor = carried(0.0, rho, steps), carried(OMEGA, rho, steps)
    R = turned(OMEGA * END)
    F = np.einsum("ij,njk->nik", R, rotor.F.reshape(-1, 3, 3)) - room.F.reshape(-1, 3, 3)
    return float(np.abs(rotor.x @ R.T - room.x).max()), float(np.abs(F).max())


def frames(quick: bool) -> Outcome:
    """Couette flow, rotating frame."""
    rows = []
    for rho in (1000.0, 3000.0):
        place, shape = differences(rho, 200 if quick else 400)
        title = f"rho_s = {rho:g} kg/m3"
        rows.append(Row(f"{title}: places, m", place, 0.0, "the frame at rest", 2e-5, kind="own"))
        rows.append(Row(f"{title}: F", shape, 0.0, "the frame at rest", 1e-4, kind="own"))
    out = float(np.linalg.norm(carried(0.0, 3000.0).x, axis=1).min())
    remark = (
        "Drag alone balances the centrifugal force, so both drift outwards: the heavier from 1.04 m to "
        f"{out:.3g} m at least. Without centrifugal and Coriolis force in the rotating frame they would "
        "not."
    )
    return Outcome(rows, [], [remark])
