"""Cloud runs shared by the cases."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from foamprb.body.ellipsoid import integrals
from foamprb.body.tensor import Tensor, det, dot, from_frame, inverse, to_frame
from foamprb.body.traction import TRACTIONS
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.measures import context, measure
from foamprb.cloud.patches import Escape, Stick
from foamprb.cloud.state import Particles, Status, set_rest_shape, spheres
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from foamprb.flow.base import Flow
from validation.case import Floats
from validation.references.inertia import SoftHistory, Surroundings, poiseuille, soft_sphere
from validation.references.shear import shear_shape

NEARLY_INCOMPRESSIBLE = 0.499999
"""Poisson's ratio of the runs that are compared with incompressible solutions."""

REST = (0.0, 0.0, 0.0)
IDENTITY = np.eye(3)


def unit_cloud(
    flow: Flow,
    Ca: ArrayLike,
    stokes: float,
    dt: float,
    models: Models | None = None,
    poissons_ratio: float = NEARLY_INCOMPRESSIBLE,
    *,
    ratios: ArrayLike = (1.0, 1.0, 1.0),
    axes: ArrayLike = IDENTITY,
    eta: ArrayLike = 0.0,
    tension: ArrayLike = 0.0,
) -> Cloud:
    """Return a cloud of bodies of the volume of a unit sphere at the origin, fluid viscosity 1, no gravity.

    Parameters
    ----------
    flow
        With rates of order 1.
    Ca
        (n,), μ_f/μ_s.
    stokes
        Shape Stokes number τ_s, which gives the density of solid and fluid.
    dt
        Time step.
    ratios, axes
        Of the shape at rest, as :func:`foamprb.cloud.state.set_rest_shape` takes them.
    eta, tension
        η_s/μ_f and γ/(R μ_f).
    """
    Ca = np.atleast_1d(np.asarray(Ca, dtype=float))
    rho = 15.0 * stokes
    p = spheres(
        np.zeros((len(Ca), 3)),
        d=2.0,
        rho=rho,
        mu=1.0 / Ca,
        poissons_ratio=poissons_ratio,
        eta=eta,
        gamma=tension,
    )
    set_rest_shape(p, ratios, axes)
    return Cloud(p, flow, Medium(1.0, rho, REST), (), dt, models or Models(integrator="paper"), threads=1)


def advance_to(cloud: Cloud, t: float) -> None:
    """Advance a cloud to the time step nearest to t, s."""
    cloud.advance(round(t / cloud.dt) - cloud.step)


def follow(cloud: Cloud, times: Floats, value: Callable[[Cloud], Any]) -> Floats:
    """Advance a cloud to the steps nearest to times (m,), s; return its ``value`` at each, (m, …)."""
    values = []
    for t in times:
        advance_to(cloud, float(t))
        values.append(np.array(value(cloud)))
    return np.array(values)


def gradients(p: Particles) -> tuple[Floats, Floats]:
    """Return deformation gradients F and velocity gradients l_s = A·F⁻¹ (1/s), each (n, 3, 3)."""
    F = p.F.reshape(-1, 3, 3)
    return F, p.A.reshape(-1, 3, 3) @ np.linalg.inv(F)


def principal_axes(p: Particles) -> tuple[Floats, Floats]:
    """Return Semi-axes over R in rising order, (n, 3), and their directions as rows, (n, 3, 3)."""
    F = p.F.reshape(-1, 3, 3)
    squares, vectors = np.linalg.eigh(F @ F.transpose(0, 2, 1))
    return np.sqrt(squares), vectors.transpose(0, 2, 1)


def shear_shapes(cloud: Cloud) -> Floats:
    """Return rows (n, 5) of :func:`shear_shape` for particles in a shear of rate 1."""
    F, l_s = gradients(cloud.particles)
    return np.array([shear_shape(f, g) for f, g in zip(F, l_s, strict=True)])


def without_inertia(coarse: Floats, fine: Floats) -> Floats:
    """Return the limit of zero shape Stokes number, from two runs, the second with half of it."""
    return 2.0 * fine - coarse


def measures(cloud: Cloud) -> dict[str, Any]:
    """Return all measures of a cloud, by name."""
    return measure(context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time))


def torque(cloud: Cloud) -> Floats:
    """Return the torque of the traction about the barycentre, (n, 3), N m.

    ∫ x × σ̃·n dA of the uniform σ̃ over the ellipsoid is M_i = ε_ijk σ̃_kj vol.
    """
    c = context(cloud.particles, cloud.flow, cloud.medium.mu, cloud.time)
    A: Tensor = tuple(c.particles.A.T)
    l_s = dot(A, inverse(c.F))
    law = TRACTIONS[cloud.models.traction]
    stress = law(c.stretches, integrals(c.stretches), to_frame(c.frame, c.l_f), to_frame(c.frame, l_s))
    s = from_frame(c.frame, stress)
    volume = cloud.medium.mu * 4.0 / 3.0 * np.pi * c.particles.R**3 * det(c.F)
    return np.stack([volume * (s[7] - s[5]), volume * (s[2] - s[6]), volume * (s[3] - s[1])], axis=1)


# --- The paper's pipe ---------------------------------------------------------------------------------------

RHO_F, NU_F, RHO_S, DIAMETER = 1.208, 1.491e-5, 2560.0, 5e-6
PIPE_RADIUS, WALL_RATE, GRAVITY = 2.1e-3, 923.8, 9.81
MEAN_VELOCITY = WALL_RATE * PIPE_RADIUS / 4.0
MU_F = RHO_F * NU_F
START = np.array([0.0, -1.65e-3, 0.0])
SETTLING = DIAMETER**2 * (RHO_S - RHO_F) * GRAVITY / (18.0 * MU_F)
POISSONS_RATIO = 0.499


def pipe_cloud(Ca: ArrayLike, dt: float, models: Models, flow: Flow | None = None) -> Cloud:
    """Return the particles of Sect. 5.4 in the exact pipe, or in a given flow."""
    flow = flow or analytic.pipe(PIPE_RADIUS, MEAN_VELOCITY)
    Ca = np.atleast_1d(np.asarray(Ca, dtype=float))
    p = spheres(
        np.tile(START, (len(Ca), 1)),
        d=DIAMETER,
        rho=RHO_S,
        mu=MU_F * WALL_RATE / Ca,
        poissons_ratio=POISSONS_RATIO,
    )
    walls = [Stick() if patch.type == "wall" else Escape() for patch in flow.patches]
    return Cloud(p, flow, Medium(MU_F, RHO_F, (0.0, -GRAVITY, 0.0)), walls, dt, models)


def air_around() -> Surroundings:
    """Return the air in the exact pipe, for the references."""
    flow = poiseuille(PIPE_RADIUS, MEAN_VELOCITY)
    return Surroundings(MU_F, RHO_F, np.array([0.0, -GRAVITY, 0.0]), flow)


def soft_in_pipe(
    Ca: float,
    times: Floats,
    drag: str = "oberbeck",
    floor: float | None = None,
    tolerance: float = 1e-9,
) -> SoftHistory:
    """Return the reference for the paper's particle in the exact pipe, from rest, at ``times`` (m,), s.

    ``Ca`` is that at the wall; the rest as of :func:`validation.references.inertia.soft_sphere`.
    """
    mu = MU_F * WALL_RATE / Ca
    return soft_sphere(
        DIAMETER / 2.0, RHO_S, mu, POISSONS_RATIO, air_around(), START, times, drag, floor, tolerance
    )


class History(NamedTuple):
    """A cloud at m times; a particle that has landed is left out, as NaN."""

    t: Floats
    """(m,), s."""
    x: Floats
    """(m, n, 3), m."""
    v: Floats
    """(m, n, 3), m/s."""
    F: Floats
    """(m, n, 3, 3)."""
    spin: Floats
    """(m, n) angular velocity about the third axis, 1/s."""
    torque: Floats
    """(m, n) about the third axis, N m."""


def history(cloud: Cloud, times: Floats) -> History:
    """Advance a cloud through the steps nearest to the given times (m,), s."""
    states: list[tuple[Any, ...]] = []
    for t in times:
        advance_to(cloud, float(t))
        p = cloud.particles
        gone = p.status != Status.ACTIVE
        state = [
            p.x,
            p.v,
            p.F.reshape(-1, 3, 3),
            measures(cloud)["angularVelocity"][:, 2],
            torque(cloud)[:, 2],
        ]
        moving = [np.array(a) for a in state]
        for a in moving:
            a[gone] = np.nan
        states.append((cloud.time, *moving))
    return History(*(np.array(column) for column in zip(*states, strict=True)))
