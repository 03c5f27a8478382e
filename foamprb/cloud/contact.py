"""Contacts with patches: when they happen, records of rebounds and passages, and normals of walls."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.choice import choice
from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.block import REBOUND_NUMBERS, Scratch, at, load3, load9
from foamprb.cloud.layout import LANES, Block
from foamprb.cloud.state import Particles
from foamprb.compile.link import Slots, kernel, separate
from foamprb.flow.analytic import gap_free
from foamprb.flow.kernels import normal, walk

Contact: TypeAlias = tuple[float, int, int]
"""Gap, m, patch and triangle; infinite, −1 and −1 for none."""

CROWDED = 2
"""Value of :attr:`~foamprb.cloud.block.Scratch.outgrown`: the buffer of rebounds is full."""


_HALVINGS = 50


def on_cubic(s: float, d: float, a: float, b: float) -> float:
    """Return the way after the share s of a step on Hermite's cubic.

    ``d`` is the way of the whole step; ``a`` and ``b`` are the excess over it of the velocities at start and
    end, times the step.
    """
    return s * (d + (1.0 - s) * ((1.0 - s) * a - s * b))


def slope_on_cubic(s: float, d: float, a: float, b: float) -> float:
    """Return the derivative of :func:`on_cubic` by s."""
    return d + (1.0 - s) * (1.0 - 3.0 * s) * a - s * (2.0 - 3.0 * s) * b


def first_contact(before: float, after: float, a: float, b: float) -> float:
    """Return the share of a step after which a body meets a wall.

    ``before`` > 0 and ``after`` <= 0 are the gaps at start and end, m; ``a`` and ``b`` are those of
    :func:`on_cubic` along the normal of the wall.
    """
    low, high = 0.0, 1.0
    for _ in range(_HALVINGS):
        middle = 0.5 * (low + high)
        if before + on_cubic(middle, after - before, a, b) > 0.0:
            low = middle
        else:
            high = middle
    return low


@choice
def mode_in(_block: Block, _i: int, _F: Tensor) -> Any:
    """Return the mode of lane i for :func:`foamprb.body.quadratic.swelling`; nothing for ellipsoids."""
    return ()


@choice
def mode_of(_p: Particles, _k: int, _F: Tensor) -> Any:
    """Return the same of particle k."""
    return ()


@choice
def gap(
    flow: object,
    host: int,
    x: Vector,
    F: Tensor,
    R: float,
    mode: Any,
    t: float,  # noqa: ARG001
) -> tuple[float, int, int]:
    """Return gap, m, patch and triangle of the wall nearest to a body, of a flow's unpacked arrays."""
    return gap_free(flow, host, x, F, R, mode)


@kernel
def gap_of_lane(
    _flow: object, _block: Block, _i: int, _host: int, _x: Vector, _F: Tensor, _t: float
) -> Contact:
    """Return gap, patch and triangle of the wall nearest to the body in lane i, at x in a host with F."""
    return math.inf, -1, -1


@kernel
def gap_of_particle(
    _flow: object, _p: Particles, _k: int, _host: int, _x: Vector, _F: Tensor, _t: float
) -> Contact:
    """Return the same of particle k."""
    return math.inf, -1, -1


def _gap_of_lane(flow: object, block: Block, i: int, host: int, x: Vector, F: Tensor, t: float) -> Contact:
    clearance, patch, triangle = gap(flow, host, x, F, block[at.R * LANES + i], mode_in(block, i, F), t)
    return clearance, int(patch), int(triangle)


def _gap_of_particle(
    flow: object, p: Particles, k: int, host: int, x: Vector, F: Tensor, t: float
) -> Contact:
    clearance, patch, triangle = gap(flow, host, x, F, p.R[k], mode_of(p, k, F), t)
    return clearance, int(patch), int(triangle)


GAPS: Slots = {
    gap_of_lane: _gap_of_lane,
    gap_of_particle: _gap_of_particle,
}
"""The functions behind both slots, where bodies meet walls by their surface or their centre (:func:`gap`)."""


def gaps_of(flow: object, p: Particles, gaps: NDArray[np.float64]) -> None:
    """Store the gaps, (n,), m, between bodies where they are and the walls nearest to them."""
    for k in range(len(gaps)):
        f = p.F[k]
        F: Tensor = (f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8])
        x: Vector = (p.x[k, 0], p.x[k, 1], p.x[k, 2])
        gaps[k] = gap_of_particle(flow, p, k, p.host[k], x, F, p.t[k])[0]


class Rebounds(NamedTuple):
    """Records of n rebounds, in the order of their times.

    A passage of a coupled patch has two records, of the state before and of the state after it.
    """

    number: NDArray[np.int64]
    """Numbers of the particles in the whole cloud, (n,)."""
    patch: NDArray[np.int64]
    """Patches, (n,)."""
    t: NDArray[np.float64]
    """Times, (n,), s."""
    x: NDArray[np.float64]
    """Positions of the centres, (n, 3), m."""
    v: NDArray[np.float64]
    """Velocities before the rebounds, (n, 3), m/s."""
    n: NDArray[np.float64]
    """Unit normals of the walls, into the fluid, (n, 3)."""
    F: NDArray[np.float64]
    """Deformation gradients, (n, 9); of integrator ``paper`` at the end of the step."""


@separate
def record_contact(s: Scratch, i: int, patch: int, t: float, x: Vector, n: Vector) -> None:
    """Record the state of the particle in lane i at a patch; no-op without a buffer.

    A rebound is recorded before the velocity changes, a passage of a coupled patch before and after it.

    Parameters
    ----------
    t, x
        Time, s, and position of its centre, m.
    n
        Unit normal of the wall, into the fluid; 0 at a coupled patch.
    """
    if s.rebounds.shape[0] == 0:
        return
    k = s.noted[0]
    if k >= s.rebounds.shape[0]:
        s.outgrown[0] = CROWDED
        return
    s.noted[0] = k + 1
    b, v, F = s.rebounds, load3(s.block, at.v, i), load9(s.block, at.F, i)
    b[k, 0], b[k, 1], b[k, 2] = s.number[i], patch, t
    b[k, 3], b[k, 4], b[k, 5] = x[0], x[1], x[2]
    b[k, 6], b[k, 7], b[k, 8] = v[0], v[1], v[2]
    b[k, 9], b[k, 10], b[k, 11] = n[0], n[1], n[2]
    b[k, 12], b[k, 13], b[k, 14] = F[0], F[1], F[2]
    b[k, 15], b[k, 16], b[k, 17] = F[3], F[4], F[5]
    b[k, 18], b[k, 19], b[k, 20] = F[6], F[7], F[8]


def in_order(rows: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return rows of :func:`record_contact`, (n, 21), sorted by time, then by particle number."""
    joined = np.concatenate([np.empty((0, REBOUND_NUMBERS)), *rows])
    return joined[np.lexsort((joined[:, 0], joined[:, 2]))]


def rebounds_of(rows: NDArray[np.float64]) -> Rebounds:
    """Return the records in rows of :func:`record_contact`."""
    integers = rows[:, :2].astype(np.int64)
    return Rebounds(
        integers[:, 0], integers[:, 1], rows[:, 2], rows[:, 3:6], rows[:, 6:9], rows[:, 9:12], rows[:, 12:]
    )


def contact_normals(flow: object, p: Particles, rows: NDArray[Any], normals: NDArray[Any]) -> None:
    """Find the normals, into the fluid, of the walls on which the particles of some rows have ended.

    The normal is that of the nearest wall if it belongs to the particle's patch, otherwise of the face that
    its path would cross within a radius; NaN where neither is found.
    """
    for i in range(len(rows)):
        k = rows[i]
        x: Vector = (p.x[k, 0], p.x[k, 1], p.x[k, 2])
        f = p.F[k]
        F: Tensor = (f[0], f[1], f[2], f[3], f[4], f[5], f[6], f[7], f[8])
        R, t = p.R[k], p.t[k]
        _, patch, triangle = gap_of_particle(flow, p, k, p.host[k], x, F, t)
        if patch != p.patch[k]:
            vx, vy, vz = p.v[k, 0], p.v[k, 1], p.v[k, 2]
            c = R / (math.sqrt(vx * vx + vy * vy + vz * vz) + 1e-300)
            ahead = (x[0] + c * vx, x[1] + c * vy, x[2] + c * vz)
            _, _, patch, triangle = walk(flow, p.host[k], x, t, ahead, t)
        if patch == p.patch[k] and patch >= 0:
            n = normal(flow, triangle, x, t)
            normals[i, 0], normals[i, 1], normals[i, 2] = n[0], n[1], n[2]
        else:
            normals[i, 0] = normals[i, 1] = normals[i, 2] = math.nan
