"""What is reported of a particle: shape, orientation, rotation and load, derived from its state."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.spatial.transform import Rotation

from foamprb.body.ellipsoid import integrals, sorted_frame, taylor_deformation
from foamprb.body.tensor import (
    Tensor,
    add,
    axial,
    ddot,
    det,
    dev,
    dot,
    from_frame,
    inverse,
    principal_frame,
    scale,
    skew,
    sym,
    to_frame,
)
from foamprb.body.traction import disturbance
from foamprb.cloud.state import Particles, Status
from foamprb.flow.base import Flow, Sampled

Floats = NDArray[np.float64]


class Context(NamedTuple):
    """Particles with what several measures need of them."""

    particles: Particles
    F: Tensor
    frame: Tensor
    """Particle frame, axes in falling order of length."""
    stretches: tuple[Floats, Floats, Floats]
    """In the same order."""
    l_f: Tensor
    """∂u_i/∂x_j of the fluid, 1/s; NaN where the fluid is unknown."""
    rows: NDArray[np.int64]
    """Row numbers in the whole cloud."""
    time: float
    mu: float
    """Viscosity of the fluid, Pa s."""


class Measure(NamedTuple):
    """A reported quantity: its unit, and the function that computes it for all particles."""

    unit: str
    value: Callable[[Context], NDArray[Any]]


def _deformation_gradient(c: Context) -> Floats:
    """F·F₀⁻¹, from the shape at rest."""
    F0: Tensor = tuple(c.particles.F0.T)
    return np.stack(dot(c.F, inverse(F0)), axis=1)


def _glyph(c: Context) -> Floats:
    """Columns of R F one after the other: what ParaView's Tensor Glyph draws as the deformed unit sphere."""
    return np.stack([c.particles.R * c.F[3 * i + j] for j in range(3) for i in range(3)], axis=1)


def _orientation(c: Context) -> Floats:
    """Unit quaternion (w, x, y, z) of the rotation that carries the fixed axes onto the particle's."""
    Q = np.stack(c.frame, axis=1).reshape(-1, 3, 3)
    return Rotation.from_matrix(Q.transpose(0, 2, 1)).as_quat(canonical=True, scalar_first=True)


def _stresslet(c: Context) -> Floats:
    """S = V μ_f dev sym s̃(d, w), the body's extra stress times volume, xx yy zz xy yz xz (Batchelor 1970).

    s̃ is Jeffery's disturbance (B.5), the far field of which is the stresslet.
    """
    A: Tensor = tuple(c.particles.A.T)
    l_s = to_frame(c.frame, dot(A, inverse(c.F)))
    l_f = to_frame(c.frame, c.l_f)
    d, w = dev(add(sym(l_f), scale(-1.0, sym(l_s)))), add(skew(l_f), scale(-1.0, skew(l_s)))
    s, _ = disturbance(c.stretches, integrals(c.stretches), d, w)
    volume = 4.0 / 3.0 * np.pi * c.particles.R**3 * det(c.F)
    S = from_frame(c.frame, scale(volume * c.mu, dev(sym(s))))
    return np.stack([S[0], S[4], S[8], S[1], S[5], S[2]], axis=1)


def _angular_velocity(c: Context) -> Floats:
    """ω_s, the axial vector of w_s = skw(A F⁻¹) (A.3)."""
    A: Tensor = tuple(c.particles.A.T)
    return np.stack(axial(skew(dot(A, inverse(c.F)))), axis=1)


def shear_rate(l_f: Tensor) -> Any:
    """Shear rate γ̇ = √(2 d_f:d_f) of a velocity gradient, 1/s."""
    d = sym(l_f)
    return np.sqrt(2.0 * ddot(d, d))


def shear_rate_at(flow: Flow, p: Particles, time: float) -> Floats:
    """Shear rate γ̇ of the flow where the particles are, at ``time`` (s), (n,), 1/s."""
    l_f: Tensor = tuple(flow.sample(p.x, p.host, time)[1].reshape(-1, 9).T)  # type: ignore[assignment]
    return np.asarray(shear_rate(l_f))


def _semi_axes(c: Context) -> Floats:
    return np.stack(c.stretches, axis=1) * c.particles.R[:, None]


MEASURES: dict[str, Measure] = {
    "U": Measure("m/s", lambda c: c.particles.v),
    "d": Measure("m", lambda c: 2.0 * c.particles.R),
    "rho": Measure("kg/m3", lambda c: c.particles.rho),
    "age": Measure("s", lambda c: c.particles.t - c.particles.t0),
    "origId": Measure("", lambda c: c.rows),
    "active": Measure("", lambda c: c.particles.status == Status.ACTIVE),
    "deformationGradient": Measure("1", _deformation_gradient),
    "glyph": Measure("m", _glyph),
    "semiAxes": Measure("m", _semi_axes),
    "orientation": Measure("1", _orientation),
    "taylorDeformation": Measure("1", lambda c: taylor_deformation(c.stretches[0], c.stretches[2])),
    "stresslet": Measure("N m", _stresslet),
    "J": Measure("1", lambda c: det(c.F)),
    "angularVelocity": Measure("1/s", _angular_velocity),
    "shearRate": Measure("1/s", lambda c: shear_rate(c.l_f)),
    "capillaryNumber": Measure("1", lambda c: c.mu * shear_rate(c.l_f) / c.particles.mu),
    "status": Measure("", lambda c: c.particles.status),
    "reason": Measure("", lambda c: c.particles.reason),
    "patch": Measure("", lambda c: c.particles.patch),
    "injector": Measure("", lambda c: c.particles.injector),
}
"""Every reported quantity by the name under which it is written, OpenFOAM's where it has one.

``taylorDeformation`` is that of the longest and the shortest axis; ``capillaryNumber`` is that of the shear
rate where the particle is.
"""


def context(
    particles: Particles, flow: Sampled, mu: float, time: float, ids: NDArray[np.int64] | None = None
) -> Context:
    """Prepare the injected particles of a cloud for measuring.

    Parameters
    ----------
    particles
        The whole cloud, or a part of it.
    flow
        The flow around them.
    mu
        Viscosity of the fluid, Pa s.
    time
        Time of the state, s.
    ids
        Row numbers of a part in the whole cloud.
    """
    rows = np.flatnonzero(particles.status != Status.PENDING)
    p = particles.take(rows)
    F: Tensor = tuple(p.F.T)
    frame, stretches = sorted_frame(*principal_frame(F))
    gradient = np.full((len(rows), 9), np.nan)
    known = (p.host >= 0) & np.isfinite(p.x).all(axis=1)
    if known.any():
        gradient[known] = flow.sample(p.x[known], p.host[known], time)[1].reshape(-1, 9)
    l_f: Tensor = tuple(gradient.T)  # type: ignore[assignment]
    return Context(p, F, frame, stretches, l_f, rows if ids is None else ids[rows], time, mu)


def measure(c: Context) -> dict[str, NDArray[Any]]:
    """All of :data:`MEASURES`, by name."""
    return {name: np.asarray(m.value(c)) for name, m in MEASURES.items()}
