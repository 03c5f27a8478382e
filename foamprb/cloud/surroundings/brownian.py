"""Brownian motion: random force and stress of the fluid's molecules on a particle.

The formulas are those of :mod:`foamprb.body.brownian`. Force and stress are drawn with the resistances at the
start of one or more tracking steps, and are constant in space's axes during these. The response of the
particle follows its present resistances.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from foamprb.body.brownian import (
    BOLTZMANN,
    deviates,
    random_force,
    random_stress,
    response,
    shape_resistance,
)
from foamprb.body.error_control import largest, longest_step
from foamprb.body.stokes import Mobility, mobility
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    add,
    ddot,
    dot,
    dot_vector,
    from_frame,
    inner,
    plus_scaled,
    scale,
    scale_vector,
    select,
    to_frame,
    transpose,
    vector_dot,
)
from foamprb.body.wall import hindered_resistance
from foamprb.cloud.block import (
    Medium,
    Scratch,
    at,
    choose,
    choose3,
    load3,
    load9,
    load_integrals,
    store3,
    store9,
    viscosity_at,
)
from foamprb.cloud.elastic import hindrance_by_walls, resistances, volume_at_rest
from foamprb.cloud.integrators.adaptive import during
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import bounce_along, turn_along
from foamprb.cloud.pressing import is_strained_by_load, push_of, stress_of
from foamprb.cloud.state import Particles
from foamprb.cloud.surroundings.base import (
    Remarks,
    Stage,
    Surrounding,
    Survey,
    add3,
    add9,
    thermal_force,
    thermal_gradient,
)
from foamprb.cloud.surroundings.wall_lift import (
    before_lift,
    deficit_in_step,
    mobility_in_step,
    near,
    strain_by_steady_load,
)
from foamprb.compile.link import Slots, separate, traced
from foamprb.dictionary.constraints import Meaning, Positive, Seed
from foamprb.flow.base import NEAR, Patch

Numbers: TypeAlias = tuple[float, np.uint64, float]
"""k_B T, seed, and 1 if the shape fluctuates, else 0."""

LARGE_STRAIN = 0.3
"""Thermal strain above which the user is warned."""
LONG_STEP = 0.1
"""√(2 D Δt) over the room of a particle above which the user is warned."""
_SHARE_OF_GAP, _HELD_TURN = 0.2, 0.002
"""√(2 D t) over the gap, and D_R t, up to which random numbers may hold for longer than a tracking step."""
_STIFFER = 30.0
"""Growth with z² of the viscosity by elasticity of bodies that relax within a step."""
_KIND = np.uint64(1)
"""Second word of the key of these random numbers; the seed is the first."""


class BrownianRows(NamedTuple):
    """Action of the molecules on a particle during some tracking steps."""

    number: Annotated[int, Row(1, "", "number in the cloud", of="number")]
    drawn: Annotated[int, Row(1, "", "tracking step, from 1 on, for which numbers were drawn last")]
    duration: Annotated[
        int,
        Row(
            1,
            "s",
            "how long the force lasts; 0 once it is computed",
        ),
    ]
    three: Annotated[int, Row(3, "1", "normal deviates of the force")]
    nine: Annotated[int, Row(9, "1", "normal deviates of the stress")]
    thermal_force: Annotated[int, Row(3, "N", "force of the molecules")]
    thermal_stress: Annotated[int, Row(9, "Pa", "stress of the molecules")]
    thermal_gradient: Annotated[int, Row(9, "1/s", "gradient whose traction is that stress")]
    held_time: Annotated[int, Row(1, "s", "how long force and stress last")]


thermal = offsets(BrownianRows)


def draw(
    _flow: object, s: Scratch, i: int, step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Draw the random numbers of lane i, which hold for the time that remains."""
    block = s.block
    if block[thermal.drawn * LANES + i] != step + 1.0 and remaining > 0.0:
        block[thermal.drawn * LANES + i] = step + 1.0
        block[thermal.duration * LANES + i] = remaining
        number = np.uint64(block[thermal.number * LANES + i])
        three, nine = deviates(number, np.uint64(step), (coefficients[1], _KIND))
        store3(block, thermal.three, i, three)
        store9(block, thermal.nine, i, nine)


def hold_of_molecules(block: Block, i: int, medium: Medium, coefficients: Numbers) -> float:
    """Return how long force and stress on lane i may be constant, s.

    The particle then moves by a share of the gap to a wall, and turns little, by itself or with the fluid.
    """
    R, kT = block[at.R * LANES + i], coefficients[0]
    D = kT / (6.0 * math.pi * medium.mu * R)
    room = _SHARE_OF_GAP * min(block[at.clearance * LANES + i], NEAR * R)
    longest = 0.5 * min(room * room / D, longest_step(load9(block, during.start_l, i)))
    if coefficients[2] > 0.0:
        longest = min(longest, _HELD_TURN * 8.0 * math.pi * medium.mu * R * R * R / kT)
    # A viscosity that varies is not known before a step.
    return longest if longest > 0.0 else 0.0


def act(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:
    """Compute force and stress of the lanes whose random numbers are new, and the gradient of the stress."""
    new = 0
    for i in range(LANES):
        new += block[thermal.duration * LANES + i] > 0.0
    if new > 0 and share == 0.0:
        force_stage(block, medium, coefficients[0])
    gradient_stage(block, medium, coefficients[2])


@traced
def force_stage(block: Block, medium: Medium, kT: float) -> None:
    """Compute force and stress of the lanes whose random numbers are new."""
    for i in range(LANES):
        duration = block[thermal.duration * LANES + i]
        fresh = duration > 0.0
        mu_f = viscosity_at(block, i, medium)
        size = np.sqrt(2.0 * kT * mu_f / select(fresh, duration, 1.0))
        Q, stretches = load9(block, at.Q, i), load3(block, at.stretch, i)
        K = hindered_resistance(resistances(block, i), hindrance_by_walls(block, i))
        f = vector_dot(random_force(K, size, load3(block, thermal.three, i)), Q)
        volume = volume_at_rest(block, i) * stretches[0] * stretches[1] * stretches[2]
        r = shape_resistance(stretches, load_integrals(block, i), block[at.eta * LANES + i] / mu_f)
        relaxing = 2.0 * block[at.mu * LANES + i] / mu_f * select(fresh, duration, 0.0)
        T = from_frame(Q, random_stress(r, size / np.sqrt(volume), load9(block, thermal.nine, i), relaxing))
        store3(block, thermal.thermal_force, i, choose3(fresh, f, load3(block, thermal.thermal_force, i)))
        store9(block, thermal.thermal_stress, i, choose(fresh, T, load9(block, thermal.thermal_stress, i)))
        block[thermal.held_time * LANES + i] = select(fresh, duration, block[thermal.held_time * LANES + i])
        block[thermal.duration * LANES + i] = 0.0


@traced
def gradient_stage(block: Block, medium: Medium, shape: float) -> None:
    """Compute the gradient whose traction on the body at rest is the stress, unless only the force acts."""
    deforms = shape > 0.0
    for i in range(LANES):
        Q, stretches = load9(block, at.Q, i), load3(block, at.stretch, i)
        T = to_frame(Q, load9(block, thermal.thermal_stress, i))
        c = 1.0 / viscosity_at(block, i, medium)
        l = response(shape_resistance(stretches, load_integrals(block, i), 1.0), scale(c, T))
        store9(block, thermal.thermal_gradient, i, choose(deforms, from_frame(Q, l), scale(0.0, l)))


@traced
def apply_force(block: Block, medium: Medium, share: float, coefficients: Numbers) -> None:  # noqa: ARG001
    """Change u and l so that the fluid exerts the force and stress of the molecules.

    The velocity is u + K⁻¹·f_B/μ_f, with K without walls: the hindrance by walls is applied by ``wallLift``.
    """
    for i in range(LANES):
        c = 1.0 / viscosity_at(block, i, medium)
        Q, k = load9(block, at.Q, i), resistances(block, i)
        f = dot_vector(Q, load3(block, thermal.thermal_force, i))
        add3(block, at.u, i, vector_dot((c * f[0] / k[0], c * f[1] / k[1], c * f[2] / k[2]), Q))
        add9(block, at.l, i, load9(block, thermal.thermal_gradient, i))


@separate
def turn_force(block: Block, i: int, turn: Tensor) -> None:
    """Rotate or mirror force and stress on lane i, together with the particle."""
    store3(block, thermal.thermal_force, i, dot_vector(turn, load3(block, thermal.thermal_force, i)))
    T = load9(block, thermal.thermal_stress, i)
    store9(block, thermal.thermal_stress, i, dot(turn, dot(T, transpose(turn))))


@separate
def mirror_force(block: Block, i: int, n: Vector) -> None:
    """Mirror the part of force and stress that drives lane i into a wall of normal n."""
    c = push_of(block, i, n, block[thermal.held_time * LANES + i])
    f, T = load3(block, thermal.thermal_force, i), load9(block, thermal.thermal_stress, i)
    volume = volume_at_rest(block, i)
    # The mobility is symmetric: the rate of the gap by f and T is the power of these in the push.
    by_force, by_stress = inner(c.v, f), volume * ddot(c.l, T)
    if block[at.clearance * LANES + i] == math.inf:
        # A point to walls.
        N = -2.0 * min(by_force, 0.0) / inner(c.v, n)
    else:
        N = -2.0 * min(by_force + by_stress, 0.0) / c.rate
        store9(block, thermal.thermal_stress, i, add(T, stress_of(scale_vector(N, n), c.r, volume)))
    store3(block, thermal.thermal_force, i, plus_scaled(f, N, n))


def gradient_of_molecules(block: Block, i: int) -> Tensor:
    """Return the gradient by which their stress acts on lane i, 1/s."""
    return load9(block, thermal.thermal_gradient, i)


def mobility_of_held(block: Block, i: int, medium: Medium, stretches: Vector) -> Mobility:
    """Return the mobility of a solid in the stresslet near walls, see :func:`deficit_of_held`."""
    return mobility(stretches, load_integrals(block, i), 1.0 - deficit_of_held(block, i, medium))


def deficit_of_held(block: Block, i: int, medium: Medium) -> Scalar:
    """Return 1 − η/μ_f with a viscosity by elasticity, where molecules or a load strain the body most.

    When numbers are drawn the elastic stress is still that of the ones before. It relaxes in the first part
    of a step h = z μ_f/μ_s with z > 1, which the path does not resolve. The walls then reflect the stresslet
    of a rigid body. The image of the load strains it anew at each place that molecules drive it to.
    """
    mu_f = viscosity_at(block, i, medium)
    by_molecules, flow = load9(block, thermal.thermal_gradient, i), load9(block, at.l, i)
    image = load9(block, near.load_gradient, i)
    p, q = ddot(by_molecules, by_molecules) + ddot(image, image), ddot(flow, flow)
    h = select(block[during.remaining * LANES + i] > 0.0, block[at.dt * LANES + i], 0.0)
    z = block[at.mu * LANES + i] * h / mu_f
    return 1.0 - block[at.eta * LANES + i] / mu_f - p / (p + q + 1e-300) * z * (1.0 + _STIFFER * z)


def is_stiff_near_walls(block: Block, i: int) -> bool:
    """Return whether a wall hinders lane i and reactions do not strain it: it relaxes while numbers hold."""
    stiff = block[at.mu * LANES + i] * block[thermal.held_time * LANES + i] > block[at.fluid * LANES + i]
    return bool(stiff and largest(hindrance_by_walls(block, i)) > 0.0)


def force_of_molecules(block: Block, i: int) -> Vector:
    """Return the force on lane i, N."""
    return load3(block, thermal.thermal_force, i)


@dataclass(frozen=True, kw_only=True)
class BrownianMotion(Surrounding):
    """Random force and stress of the fluid's molecules: ``BrownianMotion { T 293.15; }``."""

    T: Annotated[float, Positive, Meaning("temperature", "K")]
    seed: Seed = 1
    shape: Annotated[bool, Meaning("whether molecules also turn and deform the particle")] = True

    rows: ClassVar = (BrownianRows,)
    each_step: ClassVar = False
    surveys: ClassVar = ("R", "rho", "mu")
    switches: ClassVar = {"reflects_steps": 1}
    stages: ClassVar = (
        Stage("start", draw, writes=(thermal.three, thermal.nine)),
        Stage("hold", hold_of_molecules),
        Stage(
            "properties",
            act,
            writes=(thermal.thermal_force, thermal.thermal_stress, thermal.thermal_gradient),
        ),
        Stage("fluid", apply_force, reads=(thermal.thermal_force,), adds=(at.u, at.l)),
    )

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return k_B T, J; the seed; whether the shape fluctuates."""
        return BOLTZMANN * self.T, np.uint64(self.seed), float(self.shape)

    def slots(self, inertia: bool) -> Slots:
        """Return force and gradient, which walls hinder and reflect, and how mirrors and walls turn them."""
        held: Slots = {
            before_lift: strain_by_steady_load,
            mobility_in_step: mobility_of_held,
            deficit_in_step: deficit_of_held,
            is_strained_by_load: is_stiff_near_walls,
        }
        return {
            **({} if inertia else held),
            thermal_force: force_of_molecules,
            thermal_gradient: gradient_of_molecules,
            turn_along: turn_force,
            bounce_along: mirror_force,
        }

    def refuses(self, integrator: Integrator, liquid: bool) -> str:
        """Refuse ``paper``, whose resistances are those at the start of the step, and drops.

        Resistances and thermal strain hold for solids.
        """
        if integrator.name == "paper":
            return "BrownianMotion needs the integrator stokes or rosenbrock, not paper"
        return "BrownianMotion holds for solids, not for drops or vesicles" if liquid else ""

    def remarks(self, survey: Survey) -> Remarks:
        """Note the range of the thermal strain; warn if it is too large, and of steps too long for walls."""
        if survey.p.size == 0:
            return Remarks()
        strains, long_step = self._strain(survey.p), self._long_step(survey)
        notes = (f"{'thermal strain':24s} {strains.min():.3g} to {strains.max():.3g}",)
        strain = float(np.median(strains)) if self.shape else 0.0
        large = (
            f"molecules deform the particles by a strain of {strain:.2g} (median), which may hide that of "
            "the flow: they are too small or too soft. BrownianMotion { shape no; } deforms them by the "
            "flow alone."
        )
        warnings = tuple(filter(None, (large if strain > LARGE_STRAIN else "", long_step)))
        return Remarks(notes, warnings, long_step)

    def _long_step(self, survey: Survey) -> str:
        """Return a warning if √(2 D Δt) is long for the scale of heights or for the gap between walls."""
        p, flow, medium, dt, _ = survey
        kT, g = BOLTZMANN * self.T, float(np.linalg.norm(medium.gravity))
        steps = np.sqrt(2.0 * kT / (6.0 * math.pi * medium.mu * p.R) * dt)
        weight = np.abs(p.rho - medium.rho) * (4.0 / 3.0 * math.pi * g) * p.R**3
        with np.errstate(divide="ignore"):
            rooms = np.minimum(kT / weight, np.maximum(flow.width - 2.0 * p.R, 1e-300))
        worst = int(np.argmax(steps / rooms))
        step, room = float(steps[worst]), float(rooms[worst])
        if step <= LONG_STEP * room:
            return ""
        return (
            f"molecules move particles by {step:.2g} m in a step, more than {LONG_STEP:g} of the {room:.2g} "
            "m that their weight or the walls leave them: their distribution at walls is inaccurate. Use "
            f"deltaT < {dt * (LONG_STEP * room / step) ** 2:.2g}."
        )

    def _strain(self, p: Particles) -> NDArray[np.float64]:
        """Return √(5 k_B T/(2 μ_s V)) of each particle."""
        volume = 4.0 / 3.0 * math.pi * p.R**3
        return np.asarray(np.sqrt(2.5 * BOLTZMANN * self.T / (p.mu * volume)))
