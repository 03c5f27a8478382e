"""Forces on the barycentre beside drag and weight (beyond the paper): of pressure, virtual mass, lift."""

from __future__ import annotations

from typing import NamedTuple

import numpy as np
from scipy.integrate import solve_ivp

from foamprb.body.tensor import Tensor, Vector
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.forces import Force, Gravity, PressureGradient, VirtualMass
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.saffman_mei import SaffmanMeiLift
from foamprb.cloud.tracker import Models
from foamprb.flow import analytic
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, compared, worst
from validation.runs import follow

ODE = "Maxey & Riley (1983) without history, by solve_ivp"
CLOSED = "closed form"
MU_F, RHO_F, DIAMETER = 1e-3, 1000.0, 2e-4
KERNELS = {"drag": (0.0, 0.0), "with pressure gradient": (1.0, 0.0), "with both": (1.0, 0.5)}
"""Pressure gradient and virtual mass coefficient."""


class Swing(NamedTuple):
    """u = (U + g x₂) cos ωt along the first axis: a uniform and a sheared oscillation."""

    speed: float
    """U, m/s."""
    rate: float
    """g, 1/s."""
    omega: float
    """ω, 1/s."""


def sample_swing(flow: Swing, _host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Return the velocity, m/s, its gradient, 1/s, and ∂u/∂t, m/s²."""
    c, s = np.cos(flow.omega * t), np.sin(flow.omega * t)
    u = flow.speed + flow.rate * x[1]
    l = (0.0, flow.rate * c, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return (u * c, 0.0, 0.0), l, (-flow.omega * u * s, 0.0, 0.0)


def _swing(flow: Swing) -> analytic.AnalyticFlow:
    kernels = dict(analytic.linear(np.zeros((3, 3))).kernels)
    return analytic.AnalyticFlow(flow, {**kernels, "sample": sample_swing})


def sphere_path(
    kernel: tuple[float, float], rho: float, flow: object, start: Floats, times: Floats, g: Floats
) -> Floats:
    """Return position and velocity, (m, 6), of a rigid sphere at times (m,), s.

    (m + C m_f) dv/dt = (m − m_f) g + (p + C) m_f Du/Dt + 3π μ_f d (u − v), with Du/Dt taken at the sphere.

    Parameters
    ----------
    kernel
        p and C.
    rho
        Density of the sphere, kg/m³.
    flow
        Gives u, ∂u/∂x (3, 3) and ∂u/∂t at a point and a time.
    start
        Position and velocity (6,).
    g
        Gravity (3,), m/s².
    """
    p, C = kernel
    ratio = RHO_F / rho
    drag = 18.0 * MU_F / (rho * DIAMETER**2)

    def rate(t: float, y: Floats) -> Floats:
        u, gradient, change = flow(y[:3], t)  # type: ignore[operator]
        acceleration = change + gradient @ u
        force = (1.0 - ratio) * g + (p + C) * ratio * acceleration + drag * (u - y[3:])
        return np.concatenate([y[3:], force / (1.0 + C * ratio)])

    answer = solve_ivp(rate, (0.0, float(times[-1])), start, "DOP853", times, rtol=1e-11, atol=1e-14)
    return np.asarray(answer.y.T)


def _forces(p: float, C: float) -> tuple[Force, ...]:
    """Return gravity, and forces with a non-zero coefficient."""
    more = ((p, PressureGradient()), (C, VirtualMass(Cvm=C)))
    return (Gravity(), *(force for coefficient, force in more if coefficient))


def _run(
    flow: analytic.AnalyticFlow, rho: float, kernel: tuple[float, float], integrator: str, dt: float,
    start: Floats, times: Floats, g: Floats,
) -> Floats:  # fmt: skip
    """Return the position and velocity (m, 6) of a quasi-rigid sphere."""
    p = spheres(start[None, :3], d=DIAMETER, rho=rho, mu=1e3)
    p.v[:] = start[3:]
    medium = Medium(MU_F, RHO_F, (float(g[0]), float(g[1]), float(g[2])))
    models = Models(integrator=integrator, tolerance=1e-7, forces=_forces(*kernel))
    cloud = Cloud(p, flow, medium, (), dt, models, threads=1)
    return follow(cloud, times, lambda _: np.concatenate([p.x[0], p.v[0]]))


def _lift() -> list[Row]:
    """Return the drift of a sphere of 50 µm that settles along a shear flow of 1000 1/s in water."""
    R, rate = 25e-6, 1000.0
    saffman = 6.46 / (6.0 * np.pi) * R * np.sqrt(rate * RHO_F / MU_F)
    rows = []
    for slip, name in ((1e-8, "Saffman (1965)"), (1e-3, "Mei (1992)")):
        p = spheres(np.zeros((1, 3)), d=2.0 * R, rho=1e-6, mu=1e5)
        g = -4.5 * MU_F * slip / (R * R * RHO_F)
        models = Models(integrator="stokes", surroundings=(SaffmanMeiLift(),))
        Cloud(
            p, analytic.shear(rate), Medium(MU_F, RHO_F, (g, 0.0, 0.0)), (), 1e-9, models, threads=1
        ).advance(1)
        v = p.v[0]
        Re = 2.0 * R * RHO_F * np.hypot(v[0], v[1]) / MU_F
        a = 0.3314 * np.sqrt(2.0 * R * R * rate * RHO_F / MU_F / Re)
        factor = 1.0 if slip < 1e-6 else (1.0 - a) * np.exp(-0.1 * Re) + a
        title = f"lift, slip without it {slip:g} m/s: drift over slip along the flow"
        rows.append(Row(title, -v[1] / v[0], factor * saffman, name, 5e-5, relative=True))
    return rows


def _start_of_lift() -> Row:
    """Return the start of a sphere from rest, which settles along a shear flow, in 16 relaxation times."""
    R, rate, rho, g = 25e-6, 1000.0, 1.0, 7.2e-3
    times = np.linspace(0.0, 16.0, 33)[1:] * 2.0 * R * R * rho / (9.0 * MU_F)
    drag = 4.5 * MU_F / (R * R * rho)

    def acceleration(_t: float, y: Floats) -> Floats:
        w = y[2:] - np.array([rate * y[1], 0.0])
        Re = 2.0 * R * RHO_F * np.hypot(*w) / MU_F + 1e-30
        a = 0.3314 * np.sqrt(2.0 * R * R * rate * RHO_F / MU_F / Re)
        factor = (1.0 - a) * np.exp(-0.1 * Re) + a
        lift = 6.46 * factor * R * R * np.sqrt(RHO_F * MU_F * rate) / (4.0 / 3.0 * np.pi * R**3 * rho)
        # ω is −γ̇ along the third axis.
        return np.concatenate([
            y[2:], -drag * w + lift * np.array([w[1], -w[0]]) + np.array([(1.0 - RHO_F / rho) * -g, 0.0])
        ])  # fmt: skip

    expected = solve_ivp(acceleration, (0.0, times[-1]), np.zeros(4), "Radau", times, rtol=1e-9, atol=1e-16)
    p = spheres(np.zeros((1, 3)), d=2.0 * R, rho=rho, mu=1e5)
    models = Models(integrator="rosenbrock", tolerance=1e-6, surroundings=(SaffmanMeiLift(),))
    medium = Medium(MU_F, RHO_F, (-g, 0.0, 0.0))
    cloud = Cloud(p, analytic.shear(rate), medium, (), times[0] / 10.0, models, threads=1)
    drift = follow(cloud, times, lambda _: p.v[0, 1])
    title = "lift, rosenbrock, from rest: drift over the largest, worst of all times"
    scale = float(np.abs(expected.y[3]).max())
    return worst(title, drift, expected.y[3], "drag and lift by Radau", 1e-3, scale)


def forces(quick: bool) -> Outcome:
    """Pressure gradient, virtual mass."""
    rows = _lift() if quick else [*_lift(), _start_of_lift()]
    turns: list[Curve] = []
    swings: list[Curve] = []
    omega, radius = 50.0, 1e-2
    spin = omega * np.array([[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
    gravity = np.array([0.0, 0.0, -9.81])
    # Du/Dt and so the terminal slip change over a turn; the paper's scheme is of first order.
    integrators = [("rosenbrock", 1e-3, 1e-4), ("paper", 1e-5, 5e-3)][: 1 if quick else 2]
    kernels = {name: KERNELS[name] for name in ("drag", "with both")} if quick else KERNELS

    def whirl(x: Floats, _t: float) -> tuple[Floats, Floats, Floats]:
        return spin @ x, spin, np.zeros(3)

    times = np.linspace(0.0, 0.05 if quick else 0.1, 11 if quick else 21)[1:]
    start = np.array([radius, 0.0, 0.0, 0.0, omega * radius, 0.0])
    for rho in (400.0, 2500.0):
        for colour, (name, force) in enumerate(kernels.items()):
            reference = sphere_path(force, rho, whirl, start, times, gravity)
            for integrator, dt, allowed in integrators:
                ours = _run(analytic.linear(spin), rho, force, integrator, dt, start, times, gravity)
                title = f"rotating fluid, ρ_s = {rho:g}, {name}, {integrator}"
                rows += [
                    worst(f"{title}: x/r₀, worst of all times", (ours[:, :3] / radius).ravel(),
                          (reference[:, :3] / radius).ravel(), ODE, allowed),
                ]  # fmt: skip
                if integrator == "rosenbrock":
                    label = f"foamprb, ρ_s = {rho:g}, {name}"
                    away = np.hypot(ours[:, 0], ours[:, 1]) / radius
                    exact = np.hypot(reference[:, 0], reference[:, 1]) / radius
                    shade = colour + (3 if rho > RHO_F else 0)
                    turns += compared(times, away, exact, (label, ""), shade, 2)
    # Neutral and with the pressure gradient, a sphere is a piece of the fluid.
    for integrator, dt, allowed in integrators:
        ours = _run(analytic.linear(spin), RHO_F, (1.0, 0.5), integrator, dt, start, times[-1:], np.zeros(3))
        radii = float(np.hypot(ours[0, 0], ours[0, 1]) / radius)
        rows.append(Row(f"rotating fluid, ρ_s = ρ_f, {integrator}: r/r₀", radii, 1.0, CLOSED, allowed))

    swing = Swing(0.05, 20.0, 300.0)

    def oscillation(x: Floats, t: float) -> tuple[Floats, Floats, Floats]:
        u, l, change = sample_swing(swing, 0, (x[0], x[1], x[2]), t)
        return np.array(u), np.array(l).reshape(3, 3), np.array(change)

    period = 2.0 * np.pi / swing.omega
    times = 5e-4 * np.arange(1.0, 33.0 if quick else 97.0)
    down = np.array([0.0, -9.81, 0.0])
    start = np.array([0.0, 0.0, 0.0, swing.speed, 0.0, 0.0])
    for rho in (400.0, 2500.0):
        for colour, (name, force) in enumerate(kernels.items()):
            reference = sphere_path(force, rho, oscillation, start, times, down)
            for integrator, dt, allowed in integrators:
                step = min(dt, 5e-4)
                ours = _run(_swing(swing), rho, force, integrator, step, start, times, down)
                rows.append(
                    worst(
                        f"oscillating fluid, ρ_s = {rho:g}, {name}, {integrator}: v/U, worst of all times",
                        (ours[:, 3:] / swing.speed).ravel(),
                        (reference[:, 3:] / swing.speed).ravel(),
                        ODE,
                        allowed,
                    )
                )
                if integrator == "rosenbrock" and rho > RHO_F:
                    speeds = ours[:, 3] / swing.speed, reference[:, 3] / swing.speed
                    swings += compared(times / period, *speeds, (f"foamprb, {name}", ""), colour, 3)
    figure = Figure(
        "forces",
        "A sphere of 0.2 mm in water: distance from the axis of a rotating fluid over that at the start, and "
        "velocity in an oscillating one (ρ_s = 2500 kg/m³); markers: solve_ivp.",
        [Panel("t [s]", "r/r₀", turns), Panel("t/period", "v₁/U", swings)],
    )
    return Outcome(rows, [figure], _REMARKS)


_REMARKS = [
    "Both sides leave out Basset's history force, Faxén's corrections and lift. The history "
    "force is significant where the fluid's acceleration is: for a light particle these forces reduce the "
    "error but do not remove it.",
]
