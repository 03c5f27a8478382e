"""The extensional device (Sect. 5.2, Fig. 5): beads along its axis."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import Any, NamedTuple

import numpy as np
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline

from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import Gravity, PressureGradient
from foamprb.cloud.state import spheres
from foamprb.cloud.tracker import Models
from foamprb.flow.analytic import FunctionFlow, gap_free
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst
from validation.references import soft

TABLE = Path(__file__).with_name("extension_axis.csv")
"""The flow on the axis that OpenFOAM computes for cases/extension, by its axis.py."""
MESHES = ("coarse", "medium", "fine")
MU_F, RHO, DIAMETER = 0.97, 970.0, 30e-6
MODULI = {"soft": 4e4, "stiff": 4e5}
"""The beads' shear moduli, Pa."""
STATIONS = 1e-6 * np.array([1300.0, 1400.0, 1450.0, 1500.0, 1525.0, 1550.0, 1600.0, 1650.0])
"""x, m. The cone reaches from 1500 to 1560 µm."""
TRACKED = {1300.0: 0.00937, 1450.0: 0.04863, 1500.0: 0.07144, 1525.0: 0.07659, 1600.0: 0.03432}
"""D of the bead ``soft`` by x, µm, in the whole flow on the fine mesh: cases/extension/README.md."""

ODE = "inertialess equations along the axis by solve_ivp"
SMALL = "theory of small deformation along the axis by solve_ivp"
QUASISTATIC = "quasi-static small deformation, D = 15/8 (μ_f/μ_s) ∂u₁/∂x₁"
LIMIT = "extrapolated to no mesh width"
WHOLE = "cases/extension/check.py: the whole flow, fine mesh"


class Axis(NamedTuple):
    """The flow on the axis at evenly spaced points, as the kernel reads it."""

    start: float
    """x of the first point, m."""
    spacing: float
    """m."""
    u: Floats
    """(n,), m/s."""
    rate: Floats
    """∂u₁/∂x₁, (n,), 1/s."""


def read_axis(mesh: str) -> Axis:
    """Return the table of a mesh."""
    table = np.genfromtxt(TABLE, delimiter=",", names=True, deletechars="")
    x = table["x"]
    return Axis(float(x[0]), float(x[1] - x[0]), table[f"u_{mesh}"], table[f"rate_{mesh}"])


def sample_axis(flow: Axis, _host: int, x: Vector, _t: float) -> tuple[Vector, Tensor, Vector]:
    """Return velocity, m/s, gradient, 1/s, and ∂u/∂t = 0, m/s²: linear between points, axisymmetric."""
    place = (x[0] - flow.start) / flow.spacing
    i = min(max(int(place), 0), len(flow.u) - 2)
    f = place - i
    u = (1.0 - f) * flow.u[i] + f * flow.u[i + 1]
    g = (1.0 - f) * flow.rate[i] + f * flow.rate[i + 1]
    across = -0.5 * g
    l = (g, 0.0, 0.0, 0.0, across, 0.0, 0.0, 0.0, across)
    return (u, across * x[1], across * x[2]), l, (0.0, 0.0, 0.0)


def axis_flow(table: Axis) -> FunctionFlow:
    """Return the flow near the axis."""
    kernels: dict[str, Callable[..., Any]] = {
        "sample": sample_axis,
        "gap": gap_free,
    }
    return FunctionFlow(table, kernels)


class Track(NamedTuple):
    """The beads where they came by."""

    t: Floats
    """(m,), s."""
    x: Floats
    """(m, n), m."""
    D: Floats
    """(a − c)/(a + c) of the longest and the shortest semi-axis, (m, n)."""


def track(table: Axis, integrator: str) -> Track:
    """Carry the beads from the start of the table to its end."""
    n = len(MODULI)
    start = np.zeros((n, 3))
    start[:, 0] = table.start
    p = spheres(start, d=DIAMETER, rho=RHO, mu=list(MODULI.values()), poissons_ratio=0.499999)
    p.v[:, 0] = table.u[0]
    # The beads are as dense as the liquid: without its pressure gradient they would lag behind it.
    forces = (Gravity(), PressureGradient())
    models = Models(integrator=integrator, tolerance=1e-6, forces=forces)
    medium = Medium(MU_F, RHO, (0.0, 0.0, 0.0))
    cloud = Cloud(p, axis_flow(table), medium, (), 1e-5, models, threads=1)
    end = table.start + (len(table.u) - 2) * table.spacing
    t, x, D = [], [], []
    while p.x[:, 0].max() < end:
        t.append(cloud.time)
        x.append(p.x[:, 0].copy())
        D.append(_deformation(p.F.reshape(-1, 3, 3)))
        cloud.advance(1)
    return Track(np.array(t), np.array(x), np.array(D))


def _deformation(F: Floats) -> Floats:
    """Return (a − c)/(a + c) of the longest and the shortest semi-axis, (n,), of F (n, 3, 3)."""
    a, _, c = soft.semi_axes(F).T
    return np.asarray((a - c) / (a + c))


def _at(x: float, table: Axis) -> tuple[float, float]:
    """Return u and ∂u₁/∂x₁ at x, m: linear between points, constant beyond the ends."""
    last = len(table.u) - 1
    place = min(max((x - table.start) / table.spacing, 0.0), float(last))
    i = min(int(place), last - 1)
    f = place - i
    u, rate = ((1.0 - f) * values[i] + f * values[i + 1] for values in (table.u, table.rate))
    return float(u), float(rate)


def nonlinear(table: Axis, mu: float, times: Floats) -> Floats:
    """Return D (m,) at times (m,), s, of an incompressible neo-Hooke sphere moving with the liquid."""
    body = soft.Body(MU_F / mu)

    def rate(_t: float, y: Floats) -> Floats:
        u, g = _at(y[9], table)
        F = y[:9].reshape(3, 3)
        l_s = soft.velocity_gradient(F, g * np.diag([1.0, -0.5, -0.5]), body)
        return np.append((l_s @ F).ravel(), u)

    start = np.append(np.eye(3).ravel(), table.start)
    absolute = np.append(np.full(9, 1e-9), 1e-12)
    # The tables have kinks, over which the steps must not leap.
    answer = solve_ivp(
        rate, (0.0, float(times[-1])), start, "LSODA", times, rtol=1e-7, atol=absolute, max_step=1e-4
    )
    return _deformation(answer.y[:9].T.reshape(-1, 3, 3))


def small(table: Axis, mu: float, times: Floats) -> Floats:
    """Return D (m,) at times (m,), s, to first order in the strain ε along the axis.

    Its rate of strain is 5/3 d_f − σ′/(3 μ_f), σ′ = 2 μ ε, so that ε relaxes towards (5/2)(μ_f/μ) ∂u/∂x with
    the time constant (3/2) μ_f/μ; D = 3/4 ε.
    """
    relaxation = 1.5 * MU_F / mu

    def rate(_t: float, y: Floats) -> list[float]:
        u, g = _at(y[1], table)
        return [(2.5 * MU_F / mu * g - y[0]) / relaxation, u]

    span, start = (0.0, float(times[-1])), [0.0, table.start]
    answer = solve_ivp(rate, span, start, "LSODA", times, rtol=1e-8, atol=1e-12, max_step=1e-4)
    return np.asarray(0.75 * answer.y[0])


def _largest(x: Floats, D: Floats) -> float:
    """Return the largest D of a bead, by a cubic spline through its places (m,)."""
    spline = CubicSpline(x, D)
    at = spline.derivative().roots(extrapolate=False)
    return float(spline(at).max())


def beads(quick: bool) -> Outcome:
    """Beads in extensional device."""
    rows: list[Row] = []
    table = read_axis("fine")
    path = track(table, "stokes")
    every = np.arange(0, len(path.t), 8 if quick else 2)
    exact = {name: nonlinear(table, mu, path.t[every]) for name, mu in MODULI.items()}
    # With inertia the shape lags by γ̇ τ_s of up to 2.5e-5.
    for integrator, allowed in (("stokes", 1e-5), ("rosenbrock", 1e-4))[: 1 if quick else 2]:
        other = track(table, integrator)
        for i, name in enumerate(MODULI):
            D = other.D[every[every < len(other.D)], i]
            title = f"{name}, {integrator}: D, worst of all times"
            rows.append(worst(title, D, exact[name][: len(D)], ODE, allowed))
    theory = {name: small(table, mu, path.t) for name, mu in MODULI.items()}
    peak = int(np.argmax(path.D[:, 1]))
    rate = _at(path.x[peak, 1], table)[1]
    rows += [
        # The next order is D² with a factor of order 1.
        Row("stiff: largest D", float(path.D[peak, 1]), float(theory["stiff"][peak]), SMALL, 1e-4),
        worst("stiff: D, worst of all times", path.D[:, 1], theory["stiff"], SMALL, 1e-4),
        worst("soft: D, worst of all times", path.D[:, 0], theory["soft"], SMALL, 1e-2),
        # The strain lags behind by its time constant over that of the flow, about 0.02 for the rate's own.
        Row(
            "stiff: largest D",
            float(path.D[peak, 1]),
            1.875 * MU_F / MODULI["stiff"] * rate,
            QUASISTATIC,
            0.01,
            True,
        ),
    ]
    soft_bead = CubicSpline(path.x[:, 0], path.D[:, 0])
    rows += [
        # Off the axis the whole flow is not quite free of divergence.
        Row(f"soft: D at x₁ = {x:g} µm", float(soft_bead(1e-6 * x)), D, WHOLE, 3e-4, kind="own")
        for x, D in TRACKED.items()
    ]
    levels = [track(read_axis(mesh), "stokes") for mesh in MESHES[:-1]] + [path]
    largest = [_largest(level.x[:, 0], level.D[:, 0]) for level in levels]
    a, b, c = largest
    limit = c + (c - b) / (1.5**2 - 1.0)
    rows += [
        Row(
            "soft: order of the largest D in the mesh's width",
            float(np.log((b - a) / (c - b)) / np.log(1.5)),
            2.0,
            "three meshes, each refined by 3/2",
            0.5,
            kind="own",
        ),
        *[
            Row(f"soft: largest D on the mesh {mesh}", D, limit, LIMIT, 0.02, True, kind="own")
            for mesh, D in zip(MESHES, largest, strict=True)
        ],
    ]
    nodes = 1e6 * (table.start + table.spacing * np.arange(len(table.u), dtype=float))
    curves = [
        curve
        for i, name in enumerate(MODULI)
        for curve in (
            Curve(1e6 * path.x[:, i], path.D[:, i], f"foamprb, {name}", colour=i),
            Curve(1e6 * path.x[::12, i], theory[name][::12], "small deformation", "reference", i),
        )
    ]
    figure = Figure(
        "extension-device",
        "Fig. 5: velocity gradient on the axis of cases/extension (fine mesh), and the deformation "
        "D = (a − c)/(a + c) of its beads of 4e4 Pa (soft) and 4e5 Pa (stiff).",
        [
            Panel("x₁ [µm]", "∂u₁/∂x₁ [1/s]", [Curve(nodes, table.rate, "OpenFOAM, fine mesh")]),
            Panel("x₁ [µm]", "D", curves),
        ],
    )
    return Outcome(rows, [figure], _REMARKS)


_REMARKS = [
    "The paper prints the lengths of the device (700 µm and 234 µm wide, 1500, 60 and 117 µm long), but "
    "not the shape of the contraction, the liquid, the flow rate, or the bead's size and stiffness; its "
    "Fig. 5 uses velocity and gradient of Villone et al. and tabulates neither. The paper's D therefore "
    "cannot be reproduced number by number. This case checks the model in such a flow: the contraction is "
    "a straight cone, the liquid a silicone oil, and the beads are those of `cases/extension`. The "
    "printed release at x₃(0) = 1000 mm can only mean 1000 µm.",
    "This case needs no OpenFOAM: `extension_axis.csv` holds u₁ and ∂u₁/∂x₁ on the axis, computed by "
    "OpenFOAM on three meshes and interpolated by foamprb (`cases/extension/axis.py`). Near the axis the "
    "flow is axisymmetric and free of divergence.",
]
