"""Steps of the pair of order 3(2) in plain numpy, for bodies of radius 1 in a fluid of viscosity 1."""

from __future__ import annotations

from collections.abc import Callable
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from foamprb.body import error_control as control
from foamprb.body import exponential_runge_kutta as pair
from foamprb.body import relaxation, stokes, turning
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import finger, metric_at_rest
from foamprb.body.rosenbrock import elasticity, kirchhoff
from foamprb.body.tensor import (
    add,
    det,
    dot,
    inverse,
    principal_frame,
    refined_frame,
    scale,
    skew,
    stretches_in_frame,
    to_frame,
    transpose,
)

Array = np.ndarray
CA = np.array([1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 0.5, 2.0])
REST = {"sphere": (1.0, 1.0, 1.0), "prolate": (2.0, 1.0, 1.0), "oblate": (1.0, 2.0, 2.0)}
SHEAR = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])


class Bodies(NamedTuple):
    """Moduli and metrics of the rest shapes; every entry is an array, or a tuple of arrays."""

    mu: Array
    M: tuple


class Step(NamedTuple):
    """Result of a step."""

    F: tuple
    error: Array
    evaluations: Array


def shear(t: Array) -> Array:
    """Return the gradient of a steady shear at times (n,)."""
    return np.broadcast_to(SHEAR, (*np.shape(t), 3, 3))


def turning_strain(t: Array) -> Array:
    """Return a planar extension that turns, at times (n,)."""
    c, s, z = np.cos(0.7 * t), np.sin(0.7 * t), 0.0 * t
    R = np.stack([c, -s, z, s, c, z, z, z, z + 1.0], -1).reshape(*np.shape(t), 3, 3)
    return R @ np.diag([0.5, -0.5, 0.0]) @ np.swapaxes(R, -1, -2)


def unit_bodies(Ca: Array, kind: str) -> tuple[Bodies, tuple]:
    """Return bodies with axes in general directions, and their deformation gradients at rest."""
    axes = np.array(REST[kind]) / np.prod(REST[kind]) ** (1 / 3)
    R = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    F0 = tuple(np.full(len(Ca), x) for x in (R @ np.diag(axes) @ R.T).ravel())
    return Bodies(1.0 / Ca, metric_at_rest(F0)), F0


def evaluate(bodies: Bodies, F: tuple, l_f: tuple, Q: tuple | None = None) -> SimpleNamespace:
    """Evaluate frame, mobility, stress, and the body's velocity gradient in its frame."""
    s = SimpleNamespace()
    if Q is None:
        s.Q, s.stretches = principal_frame(F)
    else:
        s.Q = refined_frame(F, Q)
        for _ in range(10):
            s.stretches, skewness = stretches_in_frame(F, s.Q)
            if not np.max(skewness) > 1e-24:
                break
            s.Q = refined_frame(F, s.Q)
    s.m = stokes.mobility(s.stretches, integrals(s.stretches), 0.0)
    s.b_e = finger(dot(s.Q, F), bodies.M)
    zero = 0.0 * bodies.mu
    s.sigma = kirchhoff(s.b_e, 1.0 + zero, bodies.mu, zero, zero)
    s.l_f = to_frame(s.Q, l_f)
    s.l = stokes.velocity_gradient(s.m, s.sigma, s.l_f)
    return s


def pair_step(
    bodies: Bodies, gradient: Callable[[Array], Array], t: Array, F: tuple, h: Array, tolerance: float
) -> Step:
    """Take a step; with ``tolerance`` 0 all bodies take order 3, with infinity order 2."""

    def at(times: Array) -> tuple:
        return tuple(np.moveaxis(gradient(times), (-2, -1), (0, 1)).reshape(9, -1))

    L0, middle, L1 = (at(t + share * h) for share in (0.0, 0.5, 1.0))
    s = evaluate(bodies, F, L0)
    Q, G = s.Q, dot(s.Q, F)

    def rate_at(Omega: tuple, L: tuple) -> tuple:
        new = dot(transpose(Q), dot(pair.group_exponential(Omega), G))
        e = evaluate(bodies, new, L, Q)
        return pair.algebra_rate(Omega, to_frame(dot(Q, transpose(e.Q)), e.l))

    def seen(l_f: tuple) -> tuple:
        return stokes.velocity_gradient(s.m, scale(0.0, l_f), to_frame(Q, l_f))

    zero = 0.0 * bodies.mu
    # The pressure replaces the resistance to dilation.
    e = elasticity((s.b_e[0], s.b_e[4], s.b_e[8]), 1.0 + zero, bodies.mu, zero, zero, zero)
    n = relaxation.relaxation(s.m, e, 1.0)
    quarter, whole = relaxation.responses(n, h)
    dL = add(L1, scale(-1.0, L0))
    change = seen(dL)
    w = turning.turning_gradient(s.stretches, s.m, e, 1.0, s.l, s.l_f, s.sigma)
    first = pair.first_argument(n, quarter, h, s.l, change, w)
    g = rate_at(first, add(L0, scale(pair.NODE, dL)))
    k = pair.slope(n, first, g, s.l, scale(pair.NODE, change), 1.0 / pair.NODE)
    two, by_fluid, own = pair.second_order(n, whole, h, s.l, change, k)
    strain = control.strain_scale(s.b_e, two)
    size = control.share_of_slope(h, relaxation.fastest(n), L0) * control.relative_size(own, s.b_e, strain)
    size = size + control.FLUID_SHARE * control.relative_size(by_fluid, s.b_e, strain)
    third = ~(size <= tolerance)

    bend = seen(scale(2.0, add(add(L1, L0), scale(-2.0, middle))))
    last = pair.last_argument(n, whole, h, s.l, change, bend, k, w)
    slope = pair.slope(n, last, rate_at(last, L1), s.l, change, 1.0)
    three = pair.third_order(n, whole, h, s.l, change, bend, k, slope)
    difference = control.relative_size(add(three, scale(-1.0, two)), s.b_e, strain)
    Omega = tuple(np.where(third, *p) for p in zip(three, two, strict=True))
    new = dot(transpose(Q), dot(pair.group_exponential(Omega), G))
    error = np.where(third, difference ** (4.0 / 3.0), 0.0)
    return Step(stokes.isochoric(new, det(new)), error, np.where(third, 3, 2))


def steps(
    bodies: Bodies, F: tuple, gradient: Any, n: int, h: Any, tolerance: float, start: float = 0.0
) -> tuple:
    """Return F after n steps h."""
    size = np.full(len(bodies.mu), h)
    for i in range(n):
        F = pair_step(bodies, gradient, start + i * size, F, size, tolerance).F
    return F


def distance(bodies: Bodies, F: tuple, exact: tuple) -> Array:
    """Return the error of F as in :mod:`foamprb.body.error_control`: relative strain, or attitude."""
    b_e = finger(exact, bodies.M)
    strain = control.strain_scale(b_e, scale(0.0, b_e))
    change = control.largest(add(finger(F, bodies.M), scale(-1.0, b_e)))
    return np.maximum(change / strain, control.largest(skew(dot(F, inverse(exact)))))
