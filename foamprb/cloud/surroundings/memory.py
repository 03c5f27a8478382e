"""Memory of solids: the metric of their elastic strain, which fades towards the present shape.

The formulas are those of :mod:`foamprb.body.memory`. Before each evaluation of a body's equations the row of
the metric takes that of the evaluated shape, so that the integrators need no other change. The faded strains
are a part of the state; they are advanced where the next step starts.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from typing import Annotated, Any, ClassVar, NamedTuple

import numpy as np

from foamprb.body.exponential_runge_kutta import NODE
from foamprb.body.inertial_runge_kutta import over_b
from foamprb.body.memory import (
    Six,
    accumulated,
    error_of_power_law,
    faded,
    faded_metric,
    fading,
    fading_stress,
    metric_strain,
    part_of_step,
    range_of_power_law,
    six_of,
    strain_rate,
    symmetric,
    whole_step,
)
from foamprb.body.relaxation import Relaxation
from foamprb.body.rosenbrock import Elasticity, Stiffness
from foamprb.body.stokes import Mobility, velocity_gradient
from foamprb.body.tensor import ZERO, Tensor, add, dot, from_frame, scale, select
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import Medium, at, load9, store9
from foamprb.cloud.integrators.adaptive import SHARE_OF_MEMORY
from foamprb.cloud.integrators.base import Integrator
from foamprb.cloud.integrators.rosenbrock import with_fading as with_inertial_fading
from foamprb.cloud.integrators.stokes import gradient_at_end, gradient_by_slope, with_fading
from foamprb.cloud.layout import LANES, MOST_TIMES, Block, Row, offsets
from foamprb.cloud.motion import mirror_memory
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey
from foamprb.compile.link import Slots, traced
from foamprb.errors import InputError

__all__ = ["FadingMemory"]


_LARGE_ERROR = 0.02
"""Relative error of a power law above which the user is warned."""
_BEYOND = 1.05
"""Shear rate over the largest one of a power law, above which the user is warned."""
_SHORT = 0.1
"""Longest step over Δt below which the user is warned."""


class MemoryRows(NamedTuple):
    """Strain at the start and on the way of a step."""

    metric_strain: Annotated[int, Row(6, "1", "X at the start of the step")]
    node_strain: Annotated[int, Row(6, "1", "X at the node of the step")]
    metric_rate: Annotated[int, Row(6, "1/s", "rate of the metric there, while the shape stays")]
    faded_once: Annotated[int, Row(1, "", "1 once a step has started, else 0")]
    faded_to: Annotated[int, Row(1, "s", "time to which the strains have faded")]
    at_node: Annotated[int, Row(1, "", "1 if the next shape is that at the node, else 0")]


past = offsets(MemoryRows)


@cache
def rows_for(n_times: int) -> Any:
    """Return the declaration of further rows of a solid with so many relaxation times."""
    shares = Row(n_times, "1", "shares g_k of the modulus", of="memoryShares", columns=True)
    rates = Row(n_times, "1/s", "rates 1/T_k, falling", of="memoryRates", columns=True)
    declared: list[tuple[str, Any]] = [
        ("faded", Annotated[int, Row(6 * n_times, "1", "faded strains D_k", of="memory", saved=True)]),
        ("memory_share", Annotated[int, shares]),
        ("memory_rate", Annotated[int, rates]),
    ]
    return NamedTuple("TimesRows", declared)


def load6(block: Block, row: int, i: int) -> Six:
    """Return the symmetric tensor in six rows of lane i."""
    k = row * LANES + i
    return (
        block[k], block[k + LANES], block[k + 2 * LANES],
        block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES],
    )  # fmt: skip


def store6(block: Block, row: int, i: int, v: Six) -> None:
    """Store a symmetric tensor in six rows of lane i."""
    k = row * LANES + i
    block[k], block[k + LANES], block[k + 2 * LANES] = v[0], v[1], v[2]
    block[k + 3 * LANES], block[k + 4 * LANES], block[k + 5 * LANES] = v[3], v[4], v[5]


def scaled6(factor: Any, v: Six) -> Six:
    """Return a multiple of a symmetric tensor."""
    return factor * v[0], factor * v[1], factor * v[2], factor * v[3], factor * v[4], factor * v[5]


@cache
def stages_for(n_times: int) -> tuple[Callable[..., None], Callable[..., None]]:
    """Return the stage that stores the metric, and the function that mirrors strains, for so many times."""
    times = offsets(rows_for(n_times))

    @traced
    def fade_stage(block: Block) -> None:
        # Advance the strains to the start of a step, and store the metric there.
        for i in range(LANES):
            F0, F, t = load9(block, at.F0, i), load9(block, at.new_F, i), block[at.t * LANES + i]
            # A particle that has just been loaded is at its time.
            elapsed = t - block[past.faded_to * LANES + i]
            h = select(block[past.faded_once * LANES + i] > 0.0, elapsed, 0.0)
            before, X = load6(block, past.metric_strain, i), metric_strain(F, F0)
            slope = scaled6(h, strain_rate(F, load9(block, at.A, i)))
            total = change = scaled6(0.0, X)
            for k in range(n_times):
                rate = block[(times.memory_rate + k) * LANES + i]
                share = block[(times.memory_share + k) * LANES + i]
                D = faded(load6(block, times.faded + 6 * k, i), before, X, slope, whole_step(h * rate))
                store6(block, times.faded + 6 * k, i, D)
                total, change = accumulated(total, share, D), fading(change, share, rate, X, D)
            store9(block, at.M, i, faded_metric(F0, total))
            store6(block, past.metric_strain, i, X)
            store6(block, past.metric_rate, i, change)
            block[past.faded_once * LANES + i] = 1.0
            block[past.faded_to * LANES + i] = t
            block[past.at_node * LANES + i] = 1.0

    @traced
    def follow_stage(block: Block) -> None:
        # Store the metric of the shape that is evaluated: at the node of the step, then at its end.
        for i in range(LANES):
            F0, h = load9(block, at.F0, i), block[at.dt * LANES + i]
            at_node = block[past.at_node * LANES + i] > 0.0
            passed = select(at_node, NODE * h, h)
            before, X = load6(block, past.metric_strain, i), metric_strain(load9(block, at.new_F, i), F0)
            there, total = load6(block, past.node_strain, i), scaled6(0.0, X)
            for k in range(n_times):
                w = part_of_step(passed * block[(times.memory_rate + k) * LANES + i], at_node)
                D = faded(load6(block, times.faded + 6 * k, i), before, there, X, w)
                total = accumulated(total, block[(times.memory_share + k) * LANES + i], D)
            store9(block, at.M, i, faded_metric(F0, total))
            store6(block, past.node_strain, i, X)
            block[past.at_node * LANES + i] = 0.0

    def remember(block: Block, _medium: Medium, share: float, _coefficients: object) -> None:
        if share == 0.0:
            fade_stage(block)
        else:
            follow_stage(block)

    def mirror_strains(block: Block, i: int, turn: Tensor) -> None:
        for k in range(n_times):
            mirror6(block, times.faded + 6 * k, i, turn)
        mirror6(block, past.metric_strain, i, turn)

    return remember, mirror_strains


def gradient_with_fading(
    block: Block, i: int, turning: Tensor, m: Mobility, e: Elasticity, G: Tensor, mu_f: Any
) -> Tensor:
    """Return the rate of change of l_s by turning and by the metric that fades, 1/s²."""
    stress = scale(1.0 / mu_f, fading_stress(e, G, load6(block, past.metric_rate, i)))
    return add(turning, velocity_gradient(m, stress, ZERO))


def smooth_gradient_at_end(
    _l_end: Tensor, Q: Tensor, n: Relaxation, Omega: Tensor, l_s: Tensor, change: Tensor, last: Tensor
) -> Tensor:
    """Return l_s at the end of a step of order 3 by its slope, 1/s.

    That of the last evaluation is by the stiffness times its error, which the memory would amplify.
    """
    return from_frame(Q, gradient_by_slope(n, Omega, l_s, change, last))


def acceleration_with_fading(
    block: Block, i: int, turning: Tensor, n: Stiffness, e: Elasticity, G: Tensor, c: Any
) -> Tensor:
    """Return the rate of change of dl_s/dt by turning and by the metric that fades, 1/s³."""
    stress = fading_stress(e, G, load6(block, past.metric_rate, i))
    return add(turning, over_b(n.b, scale(-c, stress)))


def mirror6(block: Block, row: int, i: int, turn: Tensor) -> None:
    """Mirror the symmetric tensor in six rows of lane i."""
    store6(block, row, i, six_of(dot(turn, dot(symmetric(load6(block, row, i)), turn))))


@dataclass(frozen=True, kw_only=True)
class FadingMemory(Surrounding):
    """Memory of solids, see :func:`foamprb.with_relaxation`; a cloud whose particles have times adds it."""

    n_times: int
    power_law: bool = False
    """Whether the third parameter of the solid is the exponent of a power law."""

    each_step: ClassVar = False
    surveys: ClassVar = ("k", "memoryRates", "x", "host", "t")
    switches: ClassVar = {"updates_end": 1}

    def __post_init__(self) -> None:
        if self.n_times > MOST_TIMES:
            raise InputError(f"the solid has {self.n_times} relaxation times. Allowed: up to {MOST_TIMES}")

    @property
    def rows(self) -> tuple[type[tuple[int, ...]], ...]:  # type: ignore[override]
        """Declaration of its rows."""
        return MemoryRows, rows_for(self.n_times)

    @property
    def stages(self) -> tuple[Stage, ...]:  # type: ignore[override]
        """The metric of the shape that is evaluated."""
        return (Stage("properties", stages_for(self.n_times)[0], reads=(at.new_F,), writes=(at.M,)),)

    def slots(self, inertia: bool) -> Slots:
        """Return how fading changes the rates, and how mirrors turn the strains."""
        fading: Slots = (
            {with_inertial_fading: acceleration_with_fading}
            if inertia
            else {with_fading: gradient_with_fading, gradient_at_end: smooth_gradient_at_end}
        )
        return {**fading, mirror_memory: stages_for(self.n_times)[1]}

    def refuses(self, integrator: Integrator, liquid: bool) -> str:
        """Refuse drops, and ``paper``, which has no update at the end of a call."""
        if liquid:
            return "relaxation holds for solids, not for drops"
        if integrator.name == "paper":
            return "a solid with relaxation needs the integrator stokes or rosenbrock, not paper"
        return ""

    def remarks(self, survey: Survey) -> Remarks:
        """Note the relaxation times and the error of a power law; warn of times much shorter than Δt."""
        rates = survey.p.memoryRates
        rates = rates[rates > 0.0]
        if not len(rates):
            return Remarks()
        shortest, longest = 1.0 / float(rates.max()), 1.0 / float(rates.min())
        notes, warnings = [f"{'relaxation times [s]':24s} {shortest:.3g} to {longest:.3g}"], []
        if self.power_law:
            times = np.geomspace(shortest, longest, self.n_times)
            error = error_of_power_law(np.quantile(survey.p.k, (0.0, 0.5, 1.0)), times)
            low, high = range_of_power_law(times)
            notes.append(f"{'power law [1/s]':24s} within {100.0 * error:.2g} % from {low:.3g} to {high:.3g}")
            if error > _LARGE_ERROR:
                warnings.append(
                    f"the power law holds within {100.0 * error:.2g} % only, as endTime is "
                    f"{high / low:.2g} deltaT. Up to 1e7 deltaT it holds within {100.0 * _LARGE_ERROR:g} %."
                )
            p = survey.p.take(np.flatnonzero(survey.p.host >= 0))
            l = (
                survey.flow.sample(p.x, p.host, float(p.t[0]))[1].reshape(-1, 9)
                if p.size
                else np.zeros((1, 9))
            )
            gradients: Any = tuple(l.T)
            rate = float(np.max(shear_rate(gradients)))
            if rate > _BEYOND * high:
                warnings.append(
                    f"the shear rate at particles is up to {rate:.3g} 1/s where they start: the power law "
                    f"holds up to {high:.3g} 1/s, that is 1/deltaT. Needed: deltaT up to {1.0 / rate:.2g}."
                )
        step = SHARE_OF_MEMORY * shortest
        if step < _SHORT * survey.dt:
            warnings.append(
                f"the shortest relaxation time is {shortest:.3g} s: steps are at most {step:.3g} s, "
                f"{survey.dt / step:.3g} in a deltaT. A modulus that relaxes so fast is a viscosity, modulus "
                "times time."
            )
        return Remarks(notes, warnings)
