"""The laminar pipe (Sect. 5.4, Figs. 10 to 14)."""

from __future__ import annotations

from functools import cache
from pathlib import Path
from typing import Any

import numpy as np

from foamprb.cloud.state import Status
from foamprb.cloud.tracker import Models
from foamprb.flow.base import Flow
from validation.case import Curve, Figure, Floats, Outcome, Panel, Row, worst, worst_of_each
from validation.references.inertia import RigidHistory, SoftHistory, rigid_sphere
from validation.runs import (
    DIAMETER,
    MU_F,
    PIPE_RADIUS,
    RHO_S,
    SETTLING,
    START,
    WALL_RATE,
    air_around,
    history,
    measures,
    pipe_cloud,
    soft_in_pipe,
)

RIGID = "rigid sphere's equations of motion by solve_ivp"
SOFT = "equations of motion (33) by solve_ivp"
PRINTED = "the paper, Sect. 5.4.2"
PRINTED_DISTANCE = 9165.0
CASE = Path(__file__).parents[2] / "cases" / "pipe"
CAPILLARY = np.array([1e-4, *np.arange(0.05, 1.001, 0.05)])
SHOWN = (0.25, 0.5, 0.75, 1.0)
REFERENCES = (("oberbeck", SHOWN), ("brennerProlate", (0.25, 1.0)))
_END = 0.4


def _models(drag: str = "oberbeck", integrator: str = "paper") -> Models:
    return Models(drag=drag, touching="centre", integrator=integrator, tolerance=1e-5, roughness_share=0.0)


def rigid(quick: bool) -> Outcome:
    """Quasi-rigid particle in pipe."""
    end, dt = (0.01, 2e-6) if quick else (0.1, 1e-6)
    # Close together where the particle starts, then evenly.
    times = np.concatenate(
        [np.linspace(0.0, 5e-4, 26)[1:], np.arange(5e-4, end + 1e-9, 5e-4 if quick else 2.5e-4)[1:]]
    )
    times = np.round(times / dt) * dt
    ours = history(pipe_cloud(1e-4, dt, _models()), times)
    reference = rigid_sphere(DIAMETER / 2.0, RHO_S, air_around(), START, np.append(0.0, times))
    # The half axis that starts along x₁ turns about x₃; ours is the first column of F, all but rigid.
    axis = ours.F[:, 0, :2, 0]
    cosines = axis / np.linalg.norm(axis, axis=1, keepdims=True)
    expected = np.stack([np.cos(reference.angle[1:]), np.sin(reference.angle[1:])], axis=1)
    unit = MU_F * WALL_RATE * DIAMETER**3
    torque, reference_torque = abs(ours.torque[:, 0]) / unit, abs(reference.torque[1:]) / unit
    spin, reference_spin = abs(ours.spin[:, 0]) / WALL_RATE, abs(reference.spin[1:]) / WALL_RATE
    title = "cosine of a half axis with {}, worst of all times"
    rows = [
        *worst_of_each(title, ("x₁", "x₂"), cosines, expected, RIGID, (0.02, 0.02)),
        worst("|ω_s3|/γ̇_max, worst of all times", spin, reference_spin, RIGID, 5e-3),
        worst(f"|ω_s3|/γ̇_max at {end:g} s", spin[-1:], reference_spin[-1:], RIGID, 1e-4),
        worst("M/(μ_f γ̇_max d³), worst of all times", torque, reference_torque, RIGID, 0.03),
        worst(f"x₁/d at {end:g} s", ours.x[-1:, 0, 0], reference.x[-1:, 0], RIGID, 1.0, DIAMETER),
        worst(f"v₂/v_set at {end:g} s", ours.v[-1:, 0, 1], reference.v[-1:, 1], RIGID, 1e-4, SETTLING),
        Row(
            "|ω_s3| after the spin-up, at 1 ms [1/s]",
            float(WALL_RATE * spin[np.argmin(abs(times - 1e-3))]),
            363.0,
            "the paper's text, Sect. 5.4.1",
            1.5,
            kind="others",
            note="half of the shear rate 725.9 1/s there, not l_f12 itself as the text has it",
        ),
    ]
    sparse = np.r_[0:25:4, 25 : len(times) : 25]
    start = times <= 5e-4
    late = times >= max(end - 0.02, 5e-4)
    markers = np.flatnonzero(late)[::2]
    of_axes = [
        Curve(times[late], cosines[late, 0], "foamprb, x₁"),
        Curve(times[late], cosines[late, 1], "foamprb, x₂", colour=1),
        Curve(times[markers], expected[markers, 0], "rigid sphere, x₁", "reference"),
        Curve(times[markers], expected[markers, 1], "rigid sphere, x₂", "reference", 1),
    ]
    panels = [Panel("t [s]", "direction cosine", of_axes)]

    def pair(y: Floats, own_y: Floats, label: str, shown: Any = slice(None), marks: Any = sparse) -> Panel:
        curves = [
            Curve(times[shown], y[shown], "foamprb, Ca = 1e-4"),
            Curve(times[marks], own_y[marks], "rigid sphere", "reference"),
        ]
        return Panel("t [s]", label, curves)

    figures = [
        Figure("pipe-cosines", "Fig. 11: direction cosines of a half axis (the end of the run).", panels),
        Figure(
            "pipe-rigid",
            "Fig. 12: angular velocity and torque, at the start and over the whole run.",
            [
                pair(spin, reference_spin, "|ω_s3|/γ̇_max", start, start),
                pair(spin, reference_spin, "|ω_s3|/γ̇_max"),
                pair(torque, reference_torque, "M/(μ_f γ̇_max d³)", start, start),
            ],
        ),
    ]
    return Outcome(rows, figures, [])


@cache
def _soft(Ca: float, drag: str, end: float = _END) -> SoftHistory:
    return soft_in_pipe(Ca, np.linspace(0.0, end, 81), drag, -PIPE_RADIUS, 1e-6)


@cache
def _rigid_fall() -> RigidHistory:
    return rigid_sphere(DIAMETER / 2.0, RHO_S, air_around(), START, np.linspace(0.0, _END, 81), -PIPE_RADIUS)


def _spin(F: Floats, A: Floats) -> Floats:
    l_s = A @ np.linalg.inv(F)
    return np.asarray(0.5 * (l_s[..., 1, 0] - l_s[..., 0, 1]))


def _landing(
    Ca: Floats, drag: str, dt: float, flow: Flow | None = None, integrator: str = "paper"
) -> tuple[Floats, Floats, Floats]:
    """Return the distance over diameter, time (s) and |ω_s3| (1/s) of the landing, each (n,)."""
    cloud = pipe_cloud(Ca, dt, _models(drag, integrator), flow)
    cloud.advance(round(_END / dt))
    p = cloud.particles
    landed = p.status == Status.STUCK
    spin = abs(measures(cloud)["angularVelocity"][:, 2])
    return tuple(np.where(landed, q, np.nan) for q in (p.x[:, 0] / DIAMETER, p.t, spin))  # type: ignore[return-value]


def soft(quick: bool) -> Outcome:
    """Soft particles in pipe."""
    if quick:
        return _soft_start()
    rows, figures = [], []
    dt = 5e-6
    fall = _rigid_fall()
    final_rigid, distance = abs(float(fall.spin[-1])), float(fall.x[-1, 0] / DIAMETER)
    curves: list[Curve] = []
    spins: list[Curve] = []
    differences = {}
    for colour, (drag, stiffness) in enumerate(REFERENCES):
        x, t, spin = _landing(CAPILLARY, drag, dt)
        differences[drag] = x[-1] - x[int(np.argmin(abs(CAPILLARY - 0.25)))]
        rows.append(Row(f"Ca = 0.0001, {drag}: distance/d", float(x[0]), distance, RIGID, 1e-3, True))
        rows.append(Row(f"Ca = 0.0001, {drag}: time [s]", float(t[0]), float(fall.t[-1]), RIGID, 1e-3, True))
        points = []
        for Ca in stiffness:
            i = int(np.argmin(abs(CAPILLARY - Ca)))
            reference = _soft(Ca, drag)
            reference_spin = abs(float(_spin(reference.F[-1], reference.A[-1])))
            points.append((Ca, reference.x[-1, 0] / DIAMETER, reference_spin))
            name = f"Ca = {Ca:g}, {drag}: "
            rows += [
                Row(name + "distance/d", float(x[i]), float(reference.x[-1, 0] / DIAMETER), SOFT, 1e-3, True),
                Row(name + "time [s]", float(t[i]), float(reference.t[-1]), SOFT, 1e-3, True),
                Row(
                    name + "|ω_s3| on landing/rigid",
                    float(spin[i] / final_rigid),
                    reference_spin / final_rigid,
                    SOFT,
                    2e-3,
                ),
            ]
        references = np.array(points)
        curves += [
            Curve(CAPILLARY, x, f"foamprb, {drag}", colour=colour),
            Curve(references[:, 0], references[:, 1], f"solve_ivp, {drag}", "reference", colour),
        ]
        spins += [
            Curve(CAPILLARY, spin / final_rigid, f"foamprb, {drag}", colour=colour),
            Curve(
                references[:, 0], references[:, 2] / final_rigid, f"solve_ivp, {drag}", "reference", colour
            ),
        ]
    rows += [
        Row("rigid sphere: distance/d", distance, 8989.0, "closed form", 1.0, note="reference"),
        Row("rigid sphere: time [s]", float(fall.t[-1]), 0.2327, "closed form", 1e-4, note="reference"),
        *(
            Row(quantity, value, printed, PRINTED, 0.01, True, "not reproduced", kind="others")
            for quantity, value, printed in (
                ("rigid sphere: distance/d", distance, PRINTED_DISTANCE),
                *((f"distance of Ca = 1 less that of 0.25, over d, {drag}", float(value), 9866.0)
                  for drag, value in differences.items()),
            )
        ),
    ]  # fmt: skip
    rows += _of_third_order()
    ends = np.array([CAPILLARY[0], CAPILLARY[-1]])
    curves += [
        Curve(ends, np.full(2, fall.x[-1, 0] / DIAMETER), "rigid sphere", "guide"),
        Curve(ends, np.full(2, PRINTED_DISTANCE), "rigid, the paper's print", "guide", 1),
    ]
    figures.append(
        Figure(
            "pipe-distance",
            "Fig. 14: landing distance and angular velocity on landing.",
            [
                Panel("Ca at the wall shear rate", "x₁ max/d", curves),
                Panel("Ca at the wall shear rate", "|ω_s3|/|ω_s3 rigid|", spins),
            ],
        )
    )
    figures += _trajectories(dt)
    remarks = [
        "The paper prints 9165 diameters for the rigid sphere; its own numbers give 8989 (0.2327 s). Its "
        "soft particles were computed with a resistance surrogate for triaxial bodies that it does not "
        "print, so its distances for Ca ≥ 0.25 cannot be reproduced digit by digit. With the exact drag "
        "(`oberbeck`) the distance increases with Ca from the start. With the prolate surrogate of the "
        "paper's Appendix D (`brennerProlate`) it is at first below the rigid one, as in the paper's Fig. "
        "14, with its minimum between Ca = 0.3 and 0.35.",
        "The text's Re = 1 contradicts its own shear rates, which belong to a mean velocity of 0.485 m/s "
        "and Re = 137; the case uses these.",
    ]
    return Outcome(rows, figures, remarks)


def _of_third_order() -> list[Row]:
    """Compare landing distances of the integrators of order 3(2)."""
    rows = []
    Ca = np.array([1e-4, *SHOWN])
    for integrator in ("rosenbrock", "stokes"):
        x, t, _ = _landing(Ca, "oberbeck", 1e-3, integrator=integrator)
        for i, c in enumerate(Ca):
            reference = _rigid_fall() if i == 0 else _soft(c, "oberbeck")
            source = RIGID if i == 0 else SOFT
            # Without inertia the shape and the barycentre are ahead by γ̇ τ_s, 0.055 at the wall.
            informs = integrator == "stokes"
            rows += [
                Row(
                    f"Ca = {c:g}, oberbeck, {integrator}: {name}",
                    float(value),
                    float(expected),
                    source,
                    None if informs else 1e-3,
                    True,
                    note="without the particle's inertia" if informs else "",
                )
                for name, value, expected in (
                    ("distance/d", x[i], reference.x[-1, 0] / DIAMETER),
                    ("time [s]", t[i], reference.t[-1]),
                )
            ]
    return rows


def _soft_start() -> Outcome:
    """Compute the first 4 ms of the particle with Ca = 0.5."""
    end = 4e-3
    reference = _soft(0.5, "oberbeck", end)
    states = []
    for dt in (8e-6, 4e-6):
        ours = history(pipe_cloud(0.5, dt, _models()), np.array([end]))
        states.append(np.concatenate([ours.x[0, 0] / DIAMETER, ours.F[0, 0].ravel()]))
    limit = 2.0 * states[1] - states[0]
    return Outcome(
        [
            Row("Ca = 0.5: x₁/d at 4 ms", float(limit[0]), float(reference.x[-1, 0] / DIAMETER), SOFT, 0.02),
            Row("Ca = 0.5: x₂/d at 4 ms", float(limit[1]), float(reference.x[-1, 1] / DIAMETER), SOFT, 0.002),
            worst("Ca = 0.5: worst component of F at 4 ms", limit[3:], reference.F[-1].ravel(), SOFT, 1e-3),
        ],
        [],
        [],
    )


def _trajectories(dt: float) -> list[Figure]:
    Ca = np.array([1e-4, *SHOWN])
    times = np.linspace(0.0, 0.32, 161)[1:]
    ours = history(pipe_cloud(Ca, dt, _models()), times)
    unit = DIAMETER / SETTLING
    axes = ("x₁/d", "x₂/d"), ("t v_set/d", "v₁/v_set"), ("t v_set/d", "v₂/v_set")
    panels = [Panel(*names, []) for names in axes]
    for i, c in enumerate(Ca):
        reference = _rigid_fall() if i == 0 else _soft(c, "oberbeck")
        later = reference.t > 0.0
        t, v = reference.t[later][::4] / unit, reference.v[later][::4] / SETTLING
        paths = ours.x[:, i] / DIAMETER, reference.x[::4] / DIAMETER
        curves = (
            (*paths[0].T[:2], *paths[1].T[:2]),
            *((ours.t / unit, ours.v[:, i, k] / SETTLING, t, v[:, k]) for k in range(2)),
        )
        for panel, (x, y, x_reference, y_reference) in zip(panels, curves, strict=True):
            label = "solve_ivp (rigid for 1e-4)" if i == 0 else ""
            panel.curves.append(Curve(x, y, f"foamprb, Ca = {c:g}", colour=i))
            panel.curves.append(Curve(x_reference, y_reference, label, "reference", i))
    caption = "Fig. 13: trajectories and velocities, exact pipe, drag oberbeck."
    return [Figure("pipe-paths", caption, panels)]


def openfoam(quick: bool) -> Outcome:
    """OpenFOAM pipe."""
    if not (CASE / "constant" / "polyMesh").is_dir():
        note = "skipped: cases/pipe is not beside the package; clone the repository to run it"
        return Outcome([Row("landing distance", None, None, SOFT, note=note)], [], [])
    from foamprb.flow.read.openfoam import read_case

    flow = read_case(CASE)
    rows = []
    curves: list[Curve] = []
    Ca = np.array([1e-4] if quick else [1e-4, 0.25, 0.5, 0.75, 1.0])
    for colour, (drag, stiffness) in enumerate(REFERENCES[:1] if quick else REFERENCES):
        x, _, _ = _landing(Ca, drag, 2e-5 if quick else 1e-5, flow)
        references = {1e-4: float(_rigid_fall().x[-1, 0] / DIAMETER)}
        if not quick:
            references |= {c: float(_soft(c, drag).x[-1, 0] / DIAMETER) for c in stiffness}
        for c, value in references.items():
            i = int(np.argmin(abs(Ca - c)))
            source = RIGID if c == 1e-4 else SOFT
            # The coarse mesh holds the parabola to 0.2 % (rms) of the mean velocity.
            rows.append(
                Row(
                    f"Ca = {c:g}, {drag}: distance/d", float(x[i]), value, f"{source}, exact pipe", 5e-3, True
                )
            )
        at, exact = np.array(list(references.items())).T
        curves.append(Curve(Ca, x, f"foamprb, OpenFOAM's flow, {drag}", colour=colour))
        curves.append(Curve(at, exact, f"solve_ivp, exact pipe, {drag}", "reference", colour))
    panel = Panel("Ca at the wall shear rate", "x₁ max/d", curves)
    caption = "Landing distance in cases/pipe (coarse mesh, 9216 cells)."
    return Outcome(rows, [Figure("pipe-openfoam", caption, [panel])], [])
