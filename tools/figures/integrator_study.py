"""Comparison of methods for the shape: errors of a step, and steps at a tolerance, in plain numpy.

Bodies of Ca from 1e-5 to 2, spheres and 2:1 ellipsoids at rest, in gradients that are steady, suddenly
started, oscillating, pulsating and turning. The methods are ROS2 with its estimate, the
W-method ROS34PW2, two Rosenbrock methods that need an exact Jacobian, and the pair of order 3(2) of
:mod:`foamprb.body.exponential_runge_kutta`. An error is that of the elastic strain, relative to it, or of
the attitude, whichever is larger (:mod:`foamprb.body.error_control`). Work is the number of evaluations
of frame, integrals and traction, and of samples of the flow. Writes ``integrator_study.csv``,
``integrator_steps.csv``, ``integrator_pipe.csv`` and ``integrator_study.png``.

    python tools/figures/integrator_study.py --output docs
"""

from __future__ import annotations

import argparse
from collections.abc import Callable
from math import pi, sqrt
from pathlib import Path
from types import SimpleNamespace
from typing import Any, NamedTuple

import numpy as np

from foamprb.body import error_control as control
from foamprb.body import exponential_runge_kutta as pair
from foamprb.body import relaxation, stokes, turning
from foamprb.body.drag import oberbeck, reduced_gravity
from foamprb.body.ellipsoid import integrals
from foamprb.body.material import finger, metric_at_rest
from foamprb.body.rosenbrock import Elasticity, elasticity, kirchhoff
from foamprb.body.slip import balanced_slip
from foamprb.body.tensor import (
    add,
    add_identity,
    det,
    dot,
    dot_vector,
    from_frame,
    inverse,
    principal_frame,
    refined_frame,
    scale,
    skew,
    stretches_in_frame,
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.results.tables import write_table

Array = np.ndarray
TOLERANCE = 1e-4
CA = np.array([1e-5, 1e-4, 1e-3, 1e-2, 0.03, 0.1, 0.3, 0.5, 2.0])
IDENTITY = (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


# --- Bodies and flows ---------------------------------------------------------------------------------------


class Bodies(NamedTuple):
    """Bodies; every entry is an array, or a tuple of arrays."""

    mu: Array
    M: tuple
    R: Array
    rho: Array


class Fluid(NamedTuple):
    """Fluid around the bodies."""

    mu: float
    rho: float
    gravity: tuple[float, float, float]


PLAIN = Fluid(1.0, 0.0, (0.0, 0.0, 0.0))
AIR = Fluid(1.208 * 1.491e-5, 1.208, (0.0, -9.81, 0.0))

Flow = Callable[[Array, tuple], tuple[tuple, tuple, tuple]]
"""Function of time and position that returns u, ∇u and ∂u/∂t."""


def take(bodies: Bodies, rows: Array) -> Bodies:
    """Return some of the bodies."""
    return Bodies(bodies.mu[rows], pick(bodies.M, rows), bodies.R[rows], bodies.rho[rows])


def pick(values: tuple, rows: Array) -> tuple:
    """Return rows of each component."""
    return tuple(x[rows] for x in values)


def spread(tensor: Any, n: int) -> tuple:
    """Return a tensor or vector for n equal bodies."""
    return tuple(np.full(n, float(x)) for x in np.ravel(tensor))


REST = {"sphere": (1.0, 1.0, 1.0), "prolate": (2.0, 1.0, 1.0), "oblate": (1.0, 2.0, 2.0)}


def at_rest(kind: str) -> Array:
    """Return F₀ of a body with axes in general directions."""
    axes = np.array(REST[kind]) / np.prod(REST[kind]) ** (1 / 3)
    R = np.linalg.qr(np.random.default_rng(5).normal(size=(3, 3)))[0]
    return R @ np.diag(axes) @ R.T


def unit_bodies(Ca: Array, kind: str) -> tuple[Bodies, tuple]:
    """Return bodies for a flow of unit shear rate and viscosity, and their deformation gradients at rest."""
    n = len(Ca)
    F0 = spread(at_rest(kind), n)
    return Bodies(1.0 / Ca, metric_at_rest(F0), np.ones(n), np.ones(n)), F0


SHEAR = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])


def _turning(t: Array) -> Array:
    c, s, z = np.cos(0.7 * t), np.sin(0.7 * t), 0.0 * t
    R = np.stack([c, -s, z, s, c, z, z, z, z + 1.0], -1).reshape(*np.shape(t), 3, 3)
    return R @ np.diag([0.5, -0.5, 0.0]) @ np.swapaxes(R, -1, -2)


GRADIENTS: dict[str, Callable[[Array], Array]] = {
    "shear": lambda t: np.broadcast_to(SHEAR, (*np.shape(t), 3, 3)),
    "oscillating": lambda t: np.cos(t)[..., None, None] * SHEAR,
    "pulsating": lambda t: (1.0 + 0.5 * np.sin(t))[..., None, None] * SHEAR,
    "turning": _turning,
}


def uniform(gradient: Callable[[Array], Array]) -> Flow:
    """Return a flow with a uniform gradient, relative to the body."""

    def flow(t: Array, _x: tuple) -> tuple[tuple, tuple, tuple]:
        zero = (0.0 * t,) * 3
        L = gradient(t)
        return zero, tuple(L[..., i, j] for i in range(3) for j in range(3)), zero

    return flow


def pipe(radius: float, wall_rate: float) -> Flow:
    """Return Poiseuille's flow along x."""
    k = wall_rate / (2.0 * radius)

    def flow(t: Array, x: tuple) -> tuple[tuple, tuple, tuple]:
        z = 0.0 * t
        u = k * (radius**2 - x[1] ** 2 - x[2] ** 2)
        return (u, z, z), (z, -2.0 * k * x[1], -2.0 * k * x[2], z, z, z, z, z, z), (z, z, z)

    return flow


# --- One evaluation -----------------------------------------------------------------------------------------


def evaluate(bodies: Bodies, fluid: Fluid, F: tuple, l_f: tuple, Q: tuple | None = None) -> SimpleNamespace:
    """Evaluate frame, integrals, mobility, and the body's velocity gradient in its frame."""
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
    s.g = integrals(s.stretches)
    s.m = stokes.mobility(s.stretches, s.g, 0.0)
    s.b_e = finger(dot(s.Q, F), bodies.M)
    zero = 0.0 * bodies.mu
    s.sigma = scale(1.0 / fluid.mu, kirchhoff(s.b_e, 1.0 + zero, bodies.mu, zero, zero))
    s.l_f = to_frame(s.Q, l_f)
    s.l = stokes.velocity_gradient(s.m, s.sigma, s.l_f)
    return s


def solid(bodies: Bodies, s: SimpleNamespace) -> Any:
    """Return the elasticity without the resistance to dilation, which the pressure replaces."""
    zero = 0.0 * bodies.mu
    return elasticity((s.b_e[0], s.b_e[4], s.b_e[8]), 1.0 + zero, bodies.mu, zero, zero, zero)


def seen(s: SimpleNamespace, l_f: tuple) -> tuple:
    """Return l_s by a velocity gradient of the fluid alone, in the frame."""
    return stokes.velocity_gradient(s.m, scale(0.0, l_f), to_frame(s.Q, l_f))


def drag_rate(bodies: Bodies, fluid: Fluid, s: SimpleNamespace) -> tuple:
    """Return μ_f K_a/m, 1/s."""
    c = fluid.mu / (4.0 / 3.0 * pi * bodies.R**2 * bodies.rho)
    k = oberbeck(s.stretches, s.g)
    return c * k[0], c * k[1], c * k[2]


def _to(x: tuple, *parts: tuple[Any, tuple]) -> tuple:
    return tuple(x[i] + sum(k * v[i] for k, v in parts) for i in range(3))


# --- The pair of order 3(2) ---------------------------------------------------------------------------------


class Step(NamedTuple):
    """Result of a step."""

    x: tuple
    F: tuple
    error: Array
    factor: Array
    evaluations: Array
    samples: Array


def pair_step(
    bodies: Bodies, fluid: Fluid, flow: Flow, t: Array, x: tuple, F: tuple, h: Array, tolerance: float
) -> Step:
    """Take a step of the pair; with ``tolerance`` 0 every step is of order 3."""

    def slip(s: SimpleNamespace, u: tuple, L: tuple, u_t: tuple) -> tuple:
        Du = _to(u_t, (1.0, dot_vector(L, u)))
        rate = drag_rate(bodies, fluid, s)
        steady = reduced_gravity(np.ones_like(h), bodies.rho, fluid.rho, fluid.gravity)
        return balanced_slip(s.Q, rate, steady, steady, 1.0, Du, L)

    u0, L0, dudt0 = flow(t, x)
    s = evaluate(bodies, fluid, F, L0)
    Q, G = s.Q, dot(s.Q, F)
    slip0 = slip(s, u0, L0, dudt0)
    v0 = _to(u0, (1.0, slip0))
    a0 = _to(dudt0, (1.0, dot_vector(L0, v0)))
    u1, L1, dudt1 = flow(t + h, _to(x, (h, v0), (0.5 * h * h, a0)))

    def rate_at(Omega: tuple, L: tuple) -> tuple[tuple, SimpleNamespace]:
        new = dot(transpose(Q), dot(pair.group_exponential(Omega), G))
        e = evaluate(bodies, fluid, new, L, Q)
        return pair.algebra_rate(Omega, to_frame(dot(Q, transpose(e.Q)), e.l)), e

    e = solid(bodies, s)
    n = relaxation.relaxation(s.m, e, fluid.mu)
    quarter, whole = relaxation.responses(n, h)
    dL = add(L1, scale(-1.0, L0))
    change = seen(s, dL)
    w = turning.turning_gradient(s.stretches, s.m, e, fluid.mu, s.l, s.l_f, s.sigma)
    first = pair.first_argument(n, quarter, h, s.l, change, w)
    g, c = rate_at(first, add(L0, scale(pair.NODE, dL)))
    k = pair.slope(n, first, g, s.l, scale(pair.NODE, change), 1.0 / pair.NODE)
    two, by_fluid, own = pair.second_order(n, whole, h, s.l, change, k)
    strain = control.strain_scale(s.b_e, two)
    size = control.share_of_slope(h, relaxation.fastest(n), L0) * control.relative_size(own, s.b_e, strain)
    size = size + control.FLUID_SHARE * control.relative_size(by_fluid, s.b_e, strain)
    third = ~(size <= tolerance)

    middle = flow(t + 0.5 * h, _to(x, (0.5 * h, v0), (0.125 * h * h, a0)))[1]
    bend = seen(s, scale(2.0, add(add(L1, L0), scale(-2.0, middle))))
    last = pair.last_argument(n, whole, h, s.l, change, bend, k, w)
    g, _ = rate_at(last, L1)
    three = pair.third_order(n, whole, h, s.l, change, bend, k, pair.slope(n, last, g, s.l, change, 1.0))
    difference = control.relative_size(add(three, scale(-1.0, two)), s.b_e, strain)

    slip_change = _to(slip(c, u0, L0, dudt0), (-1.0, slip0))
    v1 = _to(u1, (1.0, slip0), (1.0 / pair.NODE, slip_change))
    a1 = _to(dudt1, (1.0, dot_vector(L1, v1)))
    way = h * np.sqrt(v0[0] ** 2 + v0[1] ** 2 + v0[2] ** 2) + bodies.R
    path = control.chord_error(h, way, a0, a1)
    new = dot(
        transpose(Q),
        dot(pair.group_exponential(tuple(np.where(third, *p) for p in zip(three, two, strict=True))), G),
    )
    by_path = control.path_factor(path, tolerance or TOLERANCE)
    factor = np.array(
        [
            control.step_factor(*row, tolerance or TOLERANCE)
            for row in zip(third, difference, by_path, strict=True)
        ]
    )
    return Step(
        _to(x, (0.5 * h, v0), (0.5 * h, v1), (h * h / 12.0, a0), (-h * h / 12.0, a1)),
        stokes.isochoric(new, det(new)),
        np.maximum(np.where(third, difference ** (4.0 / 3.0), 0.0), path),
        factor,
        np.where(third, 3, 2),
        np.where(third, 3, 2),
    )


# --- Rosenbrock methods -------------------------------------------------------------------------------------


class Tableau(NamedTuple):
    """(1 − γhJ) k_i = f(y + h Σ α_ij k_j) + hJ Σ γ_ij k_j + h γ_i ∂f/∂t, y' = y + h Σ b_i k_i."""

    A: Array
    G: Array
    b: Array
    second: Array


def _table(A: list, G: list, b: list, second: list) -> Tableau:
    return Tableau(*(np.array(part, float) for part in (A, G, b, second)))


_G2, _SMALL, _G3, _GP = (
    1.0 + 1.0 / sqrt(2.0),
    1.0 - 1.0 / sqrt(2.0),
    0.43586652150845900,
    (3.0 + sqrt(3.0)) / 6.0,
)
ROS2 = _table([[0, 0], [1, 0]], [[_G2, 0], [-2 * _G2, _G2]], [0.5, 0.5], [1, 0])
"""Verwer, Spee, Blom & Hundsdorfer 1999."""
TABLEAUS = {
    "ROS2, γ = 0.29": _table([[0, 0], [1, 0]], [[_SMALL, 0], [-2 * _SMALL, _SMALL]], [0.5, 0.5], [1, 0]),
    # Lang & Verwer 2001
    "ROS3P": _table(
        [[0, 0, 0], [1, 0, 0], [1, 0, 0]],
        [[_GP, 0, 0], [-1, _GP, 0], [-_GP, 0.5 - 2 * _GP, _GP]],
        [2 / 3, 0, 1 / 3],
        [1 / 3, 1 / 3, 1 / 3],
    ),
    # Sandu, Verwer, Blom, Spee, Carmichael & Potra 1997
    "Rodas3": _table(
        [[0, 0, 0, 0], [0, 0, 0, 0], [1, 0, 0, 0], [0.75, -0.25, 0.5, 0]],
        [[0.5, 0, 0, 0], [1, 0.5, 0, 0], [-0.25, -0.25, 0.5, 0], [1 / 12, 1 / 12, -2 / 3, 0.5]],
        [5 / 6, -1 / 6, -1 / 6, 0.5],
        [0.75, -0.25, 0.5, 0],
    ),
    # Rang & Angermann 2005
    "ROS34PW2": _table(
        [
            [0, 0, 0, 0],
            [0.87173304301691801, 0, 0, 0],
            [0.84457060015369423, -0.11299064236484185, 0, 0],
            [0, 0, 1, 0],
        ],
        [
            [_G3, 0, 0, 0],
            [-0.87173304301691801, _G3, 0, 0],
            [-0.90338057013044082, 0.054180672388095326, _G3, 0],
            [0.24212380706095346, -1.2232505839045147, 0.54526025533510214, _G3],
        ],
        [0.24212380706095346, -1.2232505839045147, 1.5452602553351020, _G3],
        [0.37810903145819369, -0.096042292212423178, 0.5, 0.21793326075422950],
    ),
}


def fourth_order_exponential(K: tuple) -> tuple:
    """Return exp K to fourth order: (1 − k)⁻¹·(1 + k) with k = K/2 − K³/24, a Cayley transform."""
    half = add(scale(0.5, K), scale(-1.0 / 24.0, dot(dot(K, K), K)))
    return dot(inverse(add_identity(scale(-1.0, half), 1.0)), add_identity(half, 1.0))


def solve_inertialess(m: stokes.Mobility, e: Elasticity, gh: Array, mu_f: float, r: tuple) -> tuple:
    """Return Y of Y − γh (∂l_s/∂τ)(δτ(Y)) = r, δτ the change of elastic stress along H = Y F.

    ``m`` and ``e`` are mobility and elasticity at the start of the step, ``gh`` is γh, s, ``mu_f`` the
    viscosity of the fluid, Pa s, and ``r`` a rate of F times F⁻¹, 1/s.
    """
    h = gh / mu_f
    # Columns of slopes belong to ln e_c, which Y_cc changes.
    M = add_identity(scale(-h, dot(m.normal, e.slopes)), 1.0)
    d = dot_vector(inverse(M), (r[0], r[4], r[8]))
    x, y, z = e.squares
    Y23, Y32 = _solve_pair(0.5 * h * e.shear[0] * m.compliance[0], m.slip[0], y, z, r[5], r[7])
    Y13, Y31 = _solve_pair(0.5 * h * e.shear[1] * m.compliance[1], m.slip[1], x, z, r[2], r[6])
    Y12, Y21 = _solve_pair(0.5 * h * e.shear[2] * m.compliance[2], m.slip[2], x, y, r[1], r[3])
    return (d[0], Y12, Y13, Y21, d[1], Y23, Y31, Y32, d[2])


def _solve_pair(c: Array, slip: Array, bi: Array, bj: Array, rij: Array, rji: Array) -> tuple[Array, Array]:
    p, q = c * (1.0 + slip), c * (1.0 - slip)
    m11, m12, m21, m22 = 1.0 + p * bj, p * bi, q * bj, 1.0 + q * bi
    d = 1.0 / (m11 * m22 - m12 * m21)
    return d * (m22 * rij - m12 * rji), d * (m11 * rji - m21 * rij)


def w_increment(
    table: Tableau, bodies: Bodies, fluid: Fluid, flow: Flow, t: Array, x: tuple, F: tuple, h: Array
) -> tuple[tuple, tuple, tuple]:
    """Return Ω of a Rosenbrock method on the group with ∂f/∂t, and the frame and F in it."""
    L0 = flow(t, x)[1]
    s = evaluate(bodies, fluid, F, L0)
    Q, G = s.Q, dot(s.Q, F)
    e = solid(bodies, s)
    n = relaxation.relaxation(s.m, e, fluid.mu)
    tiny = 1e-4 * h
    dL = scale(1.0 / (2.0 * tiny), add(flow(t + tiny, x)[1], scale(-1.0, flow(t - tiny, x)[1])))
    by_time = seen(s, dL)
    nothing = scale(0.0, s.l)
    k: list[tuple] = []
    known: list[tuple[Array, tuple]] = []
    for i in range(len(table.b)):
        row = table.A[i]
        found = [g for other, g in known if np.array_equal(other, row)]
        if found:
            g = found[0]
        elif not row.any():
            g = s.l
        else:
            Omega = nothing
            for j in range(i):
                Omega = add(Omega, scale(row[j] * h, k[j]))
            new = dot(transpose(Q), dot(pair.group_exponential(Omega), G))
            c = evaluate(bodies, fluid, new, flow(t + row.sum() * h, x)[1], Q)
            g = pair.algebra_rate(Omega, to_frame(dot(Q, transpose(c.Q)), c.l))
        known.append((row, g))
        coupled = nothing
        for j in range(i):
            coupled = add(coupled, scale(table.G[i, j], k[j]))
        r = add(add(g, scale(h, relaxation.relaxing(n, coupled))), scale(h * table.G[i].sum(), by_time))
        k.append(solve_inertialess(s.m, e, table.G[i, i] * h, fluid.mu, r))
    Omega = nothing
    for j, weight in enumerate(table.b):
        Omega = add(Omega, scale(weight * h, k[j]))
    return Omega, Q, G


def w_step(table: Tableau, *args: Any) -> tuple:
    """Return F after a step of :func:`w_increment`."""
    Omega, Q, G = w_increment(table, *args)
    new = dot(transpose(Q), dot(pair.group_exponential(Omega), G))
    return stokes.isochoric(new, det(new))


def exact_step(*args: Any) -> tuple:
    """Return F by 32 steps of ROS34PW2."""
    bodies, fluid, flow, t, x, F, h = args
    for i in range(32):
        F = w_step(TABLEAUS["ROS34PW2"], bodies, fluid, flow, t + i * h / 32, x, F, h / 32)
    return F


def present_step(
    bodies: Bodies, fluid: Fluid, flow: Flow, t: Array, x: tuple, F: tuple, h: Array, tolerance: float
) -> Step:
    """Take a step of ROS2 without ∂f/∂t, with the estimate of the first-order solution."""
    gh = _G2 * h

    def velocity(s: SimpleNamespace, u: tuple) -> tuple:
        a = dot_vector(s.Q, reduced_gravity(np.ones_like(h), bodies.rho, fluid.rho, fluid.gravity))
        r = drag_rate(bodies, fluid, s)
        return _to(u, (1.0, vector_dot((a[0] / r[0], a[1] / r[1], a[2] / r[2]), s.Q)))

    u0, L0, _ = flow(t, x)
    s = evaluate(bodies, fluid, F, L0)
    e = solid(bodies, s)
    k1 = from_frame(s.Q, solve_inertialess(s.m, e, gh, fluid.mu, s.l))
    v0 = velocity(s, u0)
    u1, L1, _ = flow(t + h, _to(x, (h, v0)))
    c = evaluate(bodies, fluid, dot(fourth_order_exponential(scale(h, k1)), F), L1, s.Q)
    v1 = velocity(c, u1)
    r = to_frame(s.Q, add(from_frame(c.Q, c.l), scale(-2.0, k1)))
    k2 = from_frame(s.Q, solve_inertialess(s.m, e, gh, fluid.mu, r))
    new = dot(fourth_order_exponential(add(scale(1.5 * h, k1), scale(0.5 * h, k2))), F)
    bend = sum(abs(v1[i] - v0[i]) for i in range(3))
    way = sum(abs(v0[i]) for i in range(3)) + bodies.R / h
    error = np.maximum(0.5 * h * control.largest(add(k1, k2)), 0.5 * bend / way)
    factor = np.clip(0.9 * np.sqrt(tolerance / (error + 1e-300)), 0.2, 4.0)
    twos = np.full(len(h), 2)
    return Step(
        _to(x, (0.5 * h, v0), (0.5 * h, v1)), stokes.isochoric(new, det(new)), error, factor, twos, twos
    )


# --- Measures -----------------------------------------------------------------------------------------------


def distance(bodies: Bodies, F: tuple, exact: tuple) -> Array:
    """Return the error of F as in :mod:`foamprb.body.error_control`: relative strain, or attitude."""
    b_e = finger(exact, bodies.M)
    strain = control.strain_scale(b_e, scale(0.0, b_e))
    change = control.largest(add(finger(F, bodies.M), scale(-1.0, b_e)))
    return np.maximum(change / strain, control.largest(skew(dot(F, inverse(exact)))))


def local_errors(h: float, times: tuple[float, ...]) -> list[tuple]:
    """Return rows of body, gradient, method, Ca, time, error of one step h from the exact state."""
    rows = []
    x = spread(np.zeros(3), len(CA))
    steps = np.full(len(CA), h)
    for kind in REST:
        for name, gradient in GRADIENTS.items():
            flow = uniform(gradient)
            bodies, F = unit_bodies(CA, kind)
            now = 0.0
            for time in times:
                parts = int(np.ceil((time - now) / 0.05))
                for i in range(parts):
                    d = np.full(len(CA), (time - now) / parts)
                    F = pair_step(bodies, PLAIN, flow, now + i * d, x, F, d, 0.0).F
                now = time
                t = np.full(len(CA), time)
                args = (bodies, PLAIN, flow, t, x, F, steps)
                exact = exact_step(*args)
                found = {"ROS2": present_step(*args, np.inf).F}
                found |= {method: w_step(table, *args) for method, table in TABLEAUS.items()}
                found["pair, order 2"] = pair_step(*args, np.inf).F
                found["pair, order 3"] = pair_step(*args, 0.0).F
                for method, value in found.items():
                    for Ca, error in zip(CA, distance(bodies, value, exact), strict=True):
                        rows.append((kind, name, method, float(Ca), time, float(error)))
    return rows


class Run(NamedTuple):
    """Final state and work of adaptive steps."""

    x: tuple
    F: tuple
    steps: Array
    rejected: Array
    evaluations: Array
    samples: Array
    probes: list[tuple[int, float]]


def advance(
    step: Callable[..., Step], bodies: Bodies, fluid: Fluid, flow: Flow, x: tuple, F: tuple, end: float,
    dt: float, tolerance: float, probe: int = 0,
) -> Run:  # fmt: skip
    """Take adaptive steps of each body within tracking steps dt.

    The compiled loop divides the remaining time into equal steps, and its steps grow more slowly.

    Parameters
    ----------
    probe
        Interval in accepted rounds at which the error of the steps is measured; 0 for never.
    """
    n = len(bodies.mu)
    t, size, current, last = np.zeros(n), np.full(n, dt), np.zeros(n, int), round(end / dt)
    x, F = (tuple(np.array(a, float) for a in v) for v in (x, F))
    steps, rejected, evaluations, samples = np.zeros((4, n), int)
    probes: list[tuple[int, float]] = []
    rounds = 0
    while (rows := np.flatnonzero(current < last)).size:
        rest = (current[rows] + 1) * dt - t[rows]
        some, here, shape = take(bodies, rows), pick(x, rows), pick(F, rows)
        if step is pair_step:
            size[rows] = np.minimum(size[rows], control.longest_step(flow(t[rows], here)[1]))
        h = np.where(size[rows] >= rest - 1e-6 * dt, rest, np.minimum(size[rows], 0.5 * rest))
        s = step(some, fluid, flow, t[rows], here, shape, h, tolerance)
        good = s.error <= tolerance
        evaluations[rows] += s.evaluations
        samples[rows] += s.samples
        steps[rows] += good
        rejected[rows] += ~good
        rounds += 1
        if probe and rounds % probe == 0:
            exact = exact_step(some, fluid, flow, t[rows], here, shape, h)
            # Steps that Δt cuts short say nothing of the tolerance.
            told = good & (h < rest)
            probes += [
                (int(i), float(e))
                for i, e, ok in zip(rows, distance(some, s.F, exact), told, strict=True)
                if ok
            ]
        size[rows[~good]] = (h * s.factor)[~good]
        on = rows[good]
        for target, source in ((x, s.x), (F, s.F)):
            for a, b in zip(target, source, strict=True):
                a[on] = b[good]
        later = t[on] + h[good]
        whole = later >= (current[on] + 1) * dt - 1e-6 * dt
        new = (h * s.factor)[good]
        size[on] = np.minimum(dt, np.where(whole, np.maximum(new, size[on]), new))
        t[on] = np.where(whole, (current[on] + 1) * dt, later)
        current[on] += whole
    return Run(x, F, steps, rejected, evaluations, samples, probes)


def adaptive(end: float, dt: float) -> tuple[list[tuple], dict[str, list[tuple[float, float]]]]:
    """Return steps and errors at a tolerance, and errors of single steps over the tolerance, by method."""
    rows: list[tuple] = []
    ratios: dict[str, list[tuple[float, float]]] = {}
    for kind in ("sphere", "prolate"):
        for name, gradient in GRADIENTS.items():
            flow = uniform(gradient)
            bodies, F0 = unit_bodies(CA, kind)
            x = spread(np.zeros(3), len(CA))
            exact = advance(pair_step, bodies, PLAIN, flow, x, F0, end, 0.25, 1e-7).F
            for method, step, tolerance in (
                ("ROS2", present_step, TOLERANCE),
                ("pair", pair_step, 10 * TOLERANCE),
                ("pair", pair_step, TOLERANCE),
                ("pair", pair_step, 0.1 * TOLERANCE),
            ):
                every = 60 if method == "ROS2" else 4
                r = advance(step, bodies, PLAIN, flow, x, F0, end, dt, tolerance, every)
                error = distance(bodies, r.F, exact)
                for i, Ca in enumerate(CA):
                    told = [e / tolerance for j, e in r.probes if j == i]
                    rows.append(
                        (kind, name, method, tolerance, float(Ca), int(r.steps[i]), int(r.rejected[i]),
                         int(r.evaluations[i]), int(r.samples[i]), float(error[i]),
                         float(np.median(told)) if told else np.nan)
                    )  # fmt: skip
                if tolerance == TOLERANCE:
                    ratios.setdefault(method, []).extend((float(CA[i]), e / tolerance) for i, e in r.probes)
    return rows, ratios


def in_pipe(end: float = 0.01, dt: float = 1e-4) -> list[tuple]:
    """Return steps and evaluations per Δt and errors of 5 µm particles in the air pipe at twelve radii.

    The step of ROS2 neglects the acceleration of a particle that settles through a shear, so its path
    differs.
    """
    radius, n = 2.1e-3, 12
    r = radius * np.linspace(0.05, 0.985, n)
    flow = pipe(radius, 923.8)
    rows = []
    for Ca in (0.01, 0.5, 2.0):
        M = spread(np.eye(3), n)
        bodies = Bodies(np.full(n, AIR.mu * 923.8 / Ca), M, np.full(n, 2.5e-6), np.full(n, 2560.0))
        start = (np.zeros(n), r, np.zeros(n)), spread(np.eye(3), n)
        exact = advance(pair_step, bodies, AIR, flow, *start, end, dt, 1e-7)
        for method, step in (("ROS2", present_step), ("pair", pair_step)):
            run = advance(step, bodies, AIR, flow, *start, end, dt, TOLERANCE)
            error = distance(bodies, run.F, exact.F)
            off = np.sqrt(sum((a - b) ** 2 for a, b in zip(run.x, exact.x, strict=True))) / 2.5e-6
            per = end / dt
            for i in range(n):
                work = (run.steps[i] / per, run.evaluations[i] / per, run.samples[i] / per, error[i], off[i])
                rows.append((Ca, method, float(r[i] / radius), *map(float, work)))
    return rows


# --- Output -------------------------------------------------------------------------------------------------


def plot(
    local: list[tuple], steps: list[tuple], ratios: dict[str, list[tuple[float, float]]], file: Path
) -> None:
    """Plot errors of a step by method, errors over the tolerance, and work against error."""
    import matplotlib as mpl

    mpl.use("Agg")
    from matplotlib import pyplot as plt

    figure, panels = plt.subplots(1, 3, figsize=(13, 4.2), layout="constrained")
    methods = list(dict.fromkeys(row[2] for row in local))
    for method in methods:
        values = [
            np.sqrt(
                np.mean([row[5] ** 2 for row in local if row[2] == method and row[3] == Ca and row[4] > 0])
            )
            for Ca in CA
        ]
        panels[0].loglog(CA, values, "o-", ms=3, lw=2 if "pair" in method else 1, label=method)
    panels[0].set(xlabel="Ca", ylabel="error of a step, γ̇h = 0.1", title="all bodies and gradients")
    panels[0].legend(frameon=False, fontsize=7)

    for shift, (method, found) in zip((0.85, 1.18), ratios.items(), strict=True):
        for Ca in CA:
            told = [e for c, e in found if c == Ca]
            if told:
                low, middle, high = np.percentile(told, [10, 50, 90])
                panels[1].plot([Ca * shift] * 2, [low, high], "C0" if method == "ROS2" else "C3", lw=2)
                panels[1].plot(Ca * shift, middle, "o", color="C0" if method == "ROS2" else "C3", ms=4)
    panels[1].axhspan(0.1, 1.0, color="0.9", zorder=0)
    panels[1].set(
        xscale="log", yscale="log", xlabel="Ca", ylabel="measured error of a step over the tolerance",
        title="10, 50 and 90 % of the steps; blue ROS2, red pair", ylim=(1e-4, 1e4),
    )  # fmt: skip

    for method, colour in (("ROS2", "C0"), ("pair", "C3")):
        for Ca, mark in ((1e-4, "s"), (0.5, "o"), (2.0, "^")):
            chosen = [row for row in steps if row[2] == method and row[4] == Ca]
            panels[2].loglog([row[7] for row in chosen], [row[9] for row in chosen], mark, color=colour, ms=4,
                             label=f"{method}, Ca = {Ca:g}")  # fmt: skip
    panels[2].set(
        xlabel="evaluations in ten shear times", ylabel="error at the end", title="tolerance 1e-3 to 1e-5"
    )
    panels[2].legend(frameon=False, fontsize=7)
    for panel in panels:
        panel.grid(alpha=0.3)
    figure.savefig(file, dpi=130)


def table(names: tuple[str, ...], rows: list[tuple]) -> dict[str, list]:
    """Return columns by name."""
    return dict(zip(names, map(list, zip(*rows, strict=True)), strict=True))


def main() -> None:
    """Compute, write, print a summary and plot."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("--output", type=Path, default=Path("docs"))
    parser.add_argument("--end", type=float, default=10.0, help="shear times of the adaptive runs")
    arguments = parser.parse_args()
    output: Path = arguments.output
    output.mkdir(parents=True, exist_ok=True)

    local = local_errors(0.1, (0.0, 0.5, 1.3, 2.7))
    write_table(
        output / "integrator_study.csv",
        table(("body", "gradient", "method", "Ca", "time", "error"), local),
    )
    print("error of a step, gamma h = 0.1: root mean square over bodies and gradients, later steps")
    for method in dict.fromkeys(row[2] for row in local):
        line = [
            np.sqrt(
                np.mean([row[5] ** 2 for row in local if row[2] == method and row[3] == Ca and row[4] > 0])
            )
            for Ca in CA
        ]
        print(f"{method:>16}", " ".join(f"{value:7.0e}" for value in line))

    steps, ratios = adaptive(arguments.end, 10.0)
    names = ("body", "gradient", "method", "tolerance", "Ca", "steps", "rejected", "evaluations", "samples",
             "error at the end", "median error of a step over the tolerance")  # fmt: skip
    write_table(output / "integrator_steps.csv", table(names, steps))
    for kind, name in dict.fromkeys(row[:2] for row in steps):
        print(f"{kind}, {name}: evaluations (error at the end) by Ca")
        for method, tolerance in (("ROS2", 1e-4), ("pair", 1e-3), ("pair", 1e-4), ("pair", 1e-5)):
            chosen = [
                row for row in steps if row[:3] == (kind, name, method) and np.isclose(row[3], tolerance)
            ]
            print(f"{method:>8} {tolerance:.0e}", " ".join(f"{row[7]:5d} ({row[9]:.0e})" for row in chosen))
    for method, found in ratios.items():
        told = np.array([e for _, e in found])
        above, inside = np.mean(told > 1), np.mean((told >= 0.1) & (told <= 1.0))
        print(f"{method}: error of a step above the tolerance {above:.1%}, in 1/10 to 1 {inside:.1%}")

    found = in_pipe()
    work = ("steps per dt", "evaluations per dt", "samples per dt")
    names = ("Ca", "method", "r/R", *work, "error of the shape", "error of the place over the radius")
    write_table(output / "integrator_pipe.csv", table(names, found))
    for Ca, method in dict.fromkeys(row[:2] for row in found):
        chosen = [row for row in found if row[:2] == (Ca, method)]
        print(f"pipe, Ca {Ca:g}, {method}: evaluations per dt", " ".join(f"{row[4]:.1f}" for row in chosen))
    plot(local, steps, ratios, output / "integrator_study.png")


if __name__ == "__main__":
    main()
