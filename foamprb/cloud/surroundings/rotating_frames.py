"""Rotating zones: accelerations in the frame of a rotor.

Positions, velocities and shapes are relative to the rotor, in whose frame the flow is steady. There, the
fluid's acceleration in the frame at rest is

    Du/Dt = l·u + 2 Ω × u + Ω × (Ω × r),

with relative u and l. A body that settles through the fluid with w has Du/Dt + l·w + 2 Ω × w.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple

import numpy as np

from foamprb.body.tensor import Tensor, Vector, dot_vector, minus, plus, vector_product
from foamprb.cloud.block import (
    Medium,
    Scratch,
    at,
    load3,
    load9,
    store3,
)
from foamprb.cloud.integrators.adaptive import during, end_acceleration, fluid_acceleration
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.stokes import slip_by_forces, slip_of_body
from foamprb.cloud.layout import Block, Row, offsets
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey
from foamprb.compile.link import Slots
from foamprb.flow.kernels import rotation_at


class FrameRows(NamedTuple):
    """Rotating frame of a particle."""

    spin: Annotated[int, Row(3, "1/s", "angular velocity of the frame")]
    axis_point: Annotated[int, Row(3, "m", "point on its axis")]


frames = offsets(FrameRows)


def turning_acceleration(spin: Vector, r: Vector, u: Vector) -> Vector:
    """Return 2 Ω × u + Ω × (Ω × r), m/s²."""
    c, p = vector_product(spin, u), vector_product(spin, vector_product(spin, r))
    return 2.0 * c[0] + p[0], 2.0 * c[1] + p[1], 2.0 * c[2] + p[2]


def enter_frame(
    flow: object, s: Scratch, i: int, _step: int, _rest: float, _medium: Medium, _coefficients: object
) -> None:
    """Add the acceleration of the frame of its host to Du/Dt of lane i."""
    block = s.block
    spin, origin = rotation_at(flow, s.host[i])
    x, a = load3(block, at.x, i), load3(block, at.DuDt, i)
    r = minus(x, origin)
    c = turning_acceleration(spin, r, load3(block, at.u, i))
    store3(block, at.DuDt, i, plus(a, c))
    store3(block, frames.spin, i, spin)
    store3(block, frames.axis_point, i, origin)


def stays_in_frame(flow: object, s: Scratch, i: int, _medium: Medium, _coefficients: object) -> float:
    """Return 0 for a step of lane i from one frame to another, else 1."""
    spin, _ = rotation_at(flow, s.ahead[i])
    return 1.0 if spin == load3(s.block, frames.spin, i) else 0.0


def fluid_acceleration_in_frame(block: Block, i: int, v: Vector) -> Vector:
    """Return l·v, m/s²: the rate of change of u along a path with velocity v in a steady flow."""
    return dot_vector(load9(block, during.start_l, i), v)


def end_acceleration_in_frame(block: Block, i: int) -> Vector:
    """Return Du/Dt of the fluid at the end of the step, m/s²."""
    u, x, o = load3(block, during.end_u, i), load3(block, at.new_x, i), load3(block, frames.axis_point, i)
    w = dot_vector(load9(block, during.end_l, i), u)
    r = minus(x, o)
    c = turning_acceleration(load3(block, frames.spin, i), r, u)
    return plus(w, c)


def slip_in_frame(block: Block, i: int, medium: Medium, l_f: Tensor, Du_Dt: Vector) -> Vector:
    """Return the velocity relative to the fluid of the shape in the block, m/s."""
    w = load3(block, frames.spin, i)
    l = (
        l_f[0], l_f[1] - 2.0 * w[2], l_f[2] + 2.0 * w[1],
        l_f[3] + 2.0 * w[2], l_f[4], l_f[5] - 2.0 * w[0],
        l_f[6] - 2.0 * w[1], l_f[7] + 2.0 * w[0], l_f[8],
    )  # fmt: skip
    return slip_by_forces(block, i, medium, l, Du_Dt)


@dataclass(frozen=True, kw_only=True)
class RotatingFrames(Surrounding):
    """Rotating zones, in the frames of their rotors."""

    rows: ClassVar = (FrameRows,)
    each_step: ClassVar = False
    surveys: ClassVar = ()
    stages: ClassVar = (
        Stage("start", enter_frame, reads=(at.x, at.u), writes=(frames.spin,), adds=(at.DuDt,)),
        Stage("accept", stays_in_frame),
    )

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the accelerations in a rotating frame, for the integrator without inertia."""
        return {
            fluid_acceleration: fluid_acceleration_in_frame,
            end_acceleration: end_acceleration_in_frame,
            slip_of_body: slip_in_frame,
        }

    def refuses(self, integrator: Integrator, liquid: bool) -> str:  # noqa: ARG002
        """Refuse integrators with inertia: their velocities would have to change with the frame."""
        if integrator.inertia:
            return (
                f"the flow has rotating zones (MRFProperties), which need the integrator stokes, not "
                f"{integrator.name}: set integrationSchemes/shape stokes, or solution/rotatingZones absolute"
            )
        return ""

    def remarks(self, survey: Survey) -> Remarks:
        """Warn of gravity that is not along the axis of a zone."""
        warnings = []
        g = np.array(survey.medium.gravity)
        for zone in getattr(survey.flow, "rotating", ()):
            omega = np.array(zone.omega)
            if np.linalg.norm(np.cross(omega, g)) > 1e-6 * np.linalg.norm(omega) * np.linalg.norm(g):
                warnings.append(
                    f"gravity is not along the axis of the rotating zone {zone.name}: in the rotor's frame "
                    "it should rotate, but here its direction is constant."
                )
        return Remarks(warnings=warnings)
