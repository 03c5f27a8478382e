"""Kernels of a flow as the particle loop calls them; the defaults are those of an unbounded flow.

Each is a :func:`foamprb.compile.link.kernel`, behind which :attr:`foamprb.flow.base.Flow.kernels` puts the
function of the same name. ``flow`` is the packed tuple of :meth:`foamprb.flow.base.Flow.arrays`, and ``host``
the piece of the flow (a tetrahedron) that holds x. Lengths are in m, times in s. A flow at rest may leave the
times out of the parameters of its functions.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import lru_cache
from typing import Any

from foamprb.body.faxen import Curvature
from foamprb.body.tensor import Tensor, Vector
from foamprb.compile.link import Function, conform, kernel, link, packed
from foamprb.flow.base import NO_PLANES, Floats, Planes, Turbulence

__all__ = [
    "behind",
    "cell_volume",
    "cross",
    "curvature",
    "inlined",
    "linked_with",
    "named",
    "normal",
    "parabola",
    "recover",
    "ride",
    "rotation_at",
    "sample",
    "sample_ahead",
    "turbulence",
    "viscosity",
    "walk",
    "walk_on",
    "wall_speeds",
    "wall_velocity",
    "walls",
]

_ZERO: Vector = (0.0, 0.0, 0.0)
_UNIT: Tensor = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


@kernel
def sample(flow: object, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return u, m/s, ∂u_i/∂x_j row by row, 1/s, and ∂u/∂t at the fixed point, m/s².

    u_t + l·v is the fluid's acceleration along a path of velocity v: a flow subtracts from u_t what l·v would
    count of jumps in u.
    """
    return _ZERO, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), _ZERO


@kernel
def walk(
    flow: object, host: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """Follow the segment from x0 at t0 to x1 at t1.

    Returns
    -------
    host, fraction, patch, triangle
        Where it ends; the fraction at which it crosses a patch; this patch, −1 if it crosses none, −2 after
        a failure; the triangle that it crosses.
    """
    return host, 1.0, -1, -1


@kernel
def walk_on(
    flow: object, host: int, ahead: int, x0: Vector, t0: float, x1: Vector, t1: float
) -> tuple[int, float, int, int]:
    """Return :func:`walk`; an earlier path from x0 to a point near x1 ended in ``ahead``."""
    return walk(flow, host, x0, t0, x1, t1)


def _ahead_by(walk: Function, sample: Function) -> Function:
    def sample_ahead(
        flow: object, host: int, x0: Vector, t0: float, x1: Vector, t1: float
    ) -> tuple[int, float, int, Vector, Tensor, Vector]:
        """Return the flow at the end of the segment from x0 at t0 to x1 at t1.

        Returns
        -------
        host, room, entered, u, l, u_t
            The host of x1, or the last one on the way; the distance along each axis, m, within which this
            host certainly holds any point around x1; the number of cells on the way; the flow there.
        """
        reached, _, patch, _ = walk(flow, host, x0, t0, x1, t1)
        last = host if patch == -2 else reached
        u, l, u_t = sample(flow, last, x1, t1)
        return last, 0.0, 0, u, l, u_t

    return sample_ahead


sample_ahead = kernel(_ahead_by(walk, sample))


@kernel
def parabola(flow: object, host: int, t0: float, t1: float) -> tuple[float, float, Tensor, Tensor, Tensor]:
    """Return the gradient over a step as a parabola in time, in flows that know it better than by samples.

    Returns
    -------
    The end of the step, s, t1 or earlier; the longest next step, s; ∂u_i/∂x_j at the start, in the middle
    and at the end, 1/s.
    """
    zero = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return t1, math.inf, zero, zero, zero


@kernel
def walls(flow: object, host: int, x: Vector, cut: float, chosen: Floats, t: float) -> Planes:
    """Return the walls nearer to x than ``cut``, of the patches for which ``chosen`` is 1."""
    return NO_PLANES


@kernel
def wall_speeds(flow: object, host: int, x: Vector, planes: Planes, t: float) -> Vector:
    """Return the velocities of the three ``planes`` around x along their normals, m/s."""
    return _ZERO


@kernel
def normal(flow: object, triangle: int, x: Vector, t: float) -> Vector:
    """Return the unit normal into the fluid of a triangle of the boundary."""
    return _ZERO


@kernel
def wall_velocity(flow: object, triangle: int, x: Vector, t: float) -> Vector:
    """Return the velocity of the wall at x on a triangle of the boundary, m/s."""
    return _ZERO


@kernel
def cross(flow: object, triangle: int, x: Vector, t: float) -> tuple[int, Vector, Tensor]:
    """Return host, place and rotation of a particle that meets a triangle of a coupled patch at x."""
    return 0, x, _UNIT


@kernel
def recover(flow: object, x: Vector, t: float) -> int:
    """Return the host of a point, found without a hint; −1 outside."""
    return 0


@kernel
def ride(flow: object, host: int, x: Vector, t0: float, t1: float) -> tuple[Vector, Tensor, Vector]:
    """Return place, m, turn and velocity, m/s, at t1 of what sticks to the mesh and was at x at t0."""
    return x, _UNIT, _ZERO


@kernel
def cell_volume(flow: object, host: int) -> float:
    """Return the volume of the cell of a host, m³."""
    return math.inf


@kernel
def turbulence(flow: object, host: int, x: Vector, t: float) -> Turbulence:
    """Return k, ε, ∇k and ∇(k²/3ε)."""
    return 0.0, 0.0, _ZERO, _ZERO


@kernel
def viscosity(flow: object, host: int, x: Vector, t: float) -> tuple[float, Vector]:
    """Return a field of the viscosity, Pa s, or of a phase's fraction, and its gradient; NaN if unknown."""
    return math.nan, _ZERO


@kernel
def rotation_at(flow: object, host: int) -> tuple[Vector, Vector]:
    """Return the angular velocity, 1/s, and a point of the axis of the frame of a host."""
    return _ZERO, _ZERO


@kernel
def curvature(flow: object, host: int, x: Vector, t: float) -> Curvature:
    """Return the second derivatives u_xx, u_yy, u_zz, u_xy, u_yz and u_xz, 1/(m s)."""
    return _ZERO, _ZERO, _ZERO, _ZERO, _ZERO, _ZERO


_OTHERS = ("behind", "inlined", "linked_with", "named")
_BY_NAME = {name: globals()[name] for name in __all__ if name not in _OTHERS}


def behind(kernels: Mapping[str, Function]) -> dict[Function, Function]:
    """Return the functions of a flow by the kernels of this module."""
    return {_BY_NAME[name]: function for name, function in kernels.items() if name in _BY_NAME}


def inlined(kernels: Mapping[str, Function]) -> tuple[Function, Function, Function | None]:
    """Return ``sample``, ``sample_ahead`` and ``parabola`` of a flow as kernels have them, to be inlined.

    Their first argument is not packed. The last one is None in most flows.
    """
    own = {name: conform(_BY_NAME[name], function) for name, function in kernels.items() if name in _BY_NAME}
    start = own.get("sample", sample)
    ahead = own.get("sample_ahead") or _ahead_by(own.get("walk", walk), start)
    return start, ahead, own.get("parabola")


def named(*functions: Function) -> dict[str, Function]:
    """Return functions of a flow by their names, those of the kernels."""
    return {function.__name__: function for function in functions}


def linked_with(kernels: Mapping[str, Function], arrays: Any, entry: Function) -> tuple[Any, Any]:
    """Return a compiled function that calls kernels of a flow, and its packed argument ``flow``."""
    flow = packed(arrays)
    return _linked(entry, frozenset(kernels.items()), getattr(flow, "layout", None)), flow


# Linking costs as much as sampling some thousands of particles.
@lru_cache(maxsize=64)
def _linked(entry: Function, kernels: frozenset[tuple[str, Function]], layout: Any) -> Any:
    return link(entry, slots=behind(dict(kernels)), flow=layout)
