"""Dispersion of particles by the eddies of a turbulent flow that is given by its mean.

The formulas are those of :mod:`foamprb.body.turbulence`. An eddy's velocity is constant in space's axes over
a tracking step. At the start of a tracking step a particle may leave its eddy.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated, ClassVar, Literal, NamedTuple, TypeAlias

import numpy as np

from foamprb.body.philox import normals, philox
from foamprb.body.tensor import (
    Tensor,
    Vector,
    dot_vector,
    inner,
    minus,
    norm,
    plus,
    plus_scaled,
    scale_vector,
)
from foamprb.body.turbulence import (
    crossing_rate,
    direction,
    eddy_time,
    fluctuation_size,
    kolmogorov_length,
    kolmogorov_rate,
    lasting,
)
from foamprb.cloud.block import Medium, Scratch, at, load3, store3
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.motion import bounce_along, turn_along
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey
from foamprb.compile.link import Slots, separate, traced
from foamprb.dictionary.constraints import Meaning, Seed
from foamprb.flow.base import Floats, Flow, Patch
from foamprb.flow.kernels import turbulence
from foamprb.flow.nodes import NodeValues

Numbers: TypeAlias = tuple[np.uint64, float, float]
"""Seed, how velocities are drawn, and the factor of the drift correction."""

_KIND = np.uint64(2)
"""Second word of the key of these random numbers; the seed is the first."""
_LOW, _HALF = np.uint64(0xFFFFFFFF), np.uint64(32)


class EddyRows(NamedTuple):
    """Present eddy of a particle."""

    eddy_number: Annotated[int, Row(1, "", "number in the cloud", of="number")]
    eddy_velocity: Annotated[
        int, Row(3, "m/s", "velocity of its eddy relative to the mean flow", of="eddy", saved=True)
    ]
    eddy_time: Annotated[
        int, Row(1, "s", "remaining life of its eddy, or the eddy's age", of="eddyTime", saved=True)
    ]
    updated: Annotated[int, Row(1, "", "tracking step, from 1 on, of the last update")]
    drift: Annotated[int, Row(3, "m/s", "correction that keeps evenly spread particles evenly spread")]


eddies = offsets(EddyRows)


def update_eddy(
    flow: object, s: Scratch, i: int, step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Draw the next eddy of lane i at the start of a tracking step, if the particle has left the last one."""
    seed, kind, corrected = coefficients
    block = s.block
    if block[eddies.updated * LANES + i] == step + 1.0 or remaining <= 0.0:
        return
    block[eddies.updated * LANES + i] = step + 1.0
    x, t = load3(block, at.x, i), block[at.t * LANES + i]
    k, epsilon, slope, drift = turbulence(flow, s.host[i], x, t)
    k, epsilon = max(k, 0.0), max(epsilon, 0.0)
    u, v, w = load3(block, at.u, i), load3(block, at.v, i), load3(block, eddies.eddy_velocity, i)
    rate = crossing_rate(k, norm(minus(minus(v, u), w)))
    left, life = block[eddies.eddy_time * LANES + i], eddy_time(k, epsilon) / rate
    size = fluctuation_size(k)
    if kind == OPENFOAM:
        # In this model eddy_time is the age of the eddy.
        new, left = after_openfoam(left, life, remaining)
        if remaining >= life:
            store3(block, eddies.eddy_velocity, i, (0.0, 0.0, 0.0))
    else:
        new = left <= 0.5 * remaining * rate
        if new:
            n, share = lasting(life, remaining)
            left = n * remaining * rate
            size *= share if kind == NORMAL else 1.0
        left -= remaining * rate
    if new:
        number, counter = np.uint64(block[eddies.eddy_number * LANES + i]), np.uint64(step)
        words = philox((number & _LOW, number >> _HALF, counter & _LOW, counter >> _HALF), (seed, _KIND))
        w = eddy_velocity(normals(words), kind, slope)
        store3(block, eddies.eddy_velocity, i, scale_vector(size, w))
    block[eddies.eddy_time * LANES + i] = left
    store3(block, eddies.drift, i, scale_vector(corrected, drift))


NORMAL, OPENFOAM, DOWN, DOWN_OR_UP = 0.0, 1.0, 2.0, 3.0
"""How an eddy's velocity is drawn: by components; a length in a random direction; along −∇k; along ±∇k."""


def after_openfoam(age: float, life: float, step: float) -> tuple[bool, float]:
    """Return whether a particle enters a new eddy in OpenFOAM 1912, and the new age of its eddy, s.

    It does when its eddy is older than the local eddy life. Where that is shorter than a step there are no
    eddies.
    """
    if step >= life:
        return False, 1e30
    new = age + step > life
    return new, 0.0 if new else age + step


def eddy_velocity(xi: tuple[float, float, float, float], kind: float, slope: Vector) -> Vector:
    """Return the velocity of an eddy over √(2k/3), from four normal deviates and ∇k."""
    if kind == NORMAL:
        return xi[0], xi[1], xi[2]
    size = abs(xi[3]) if kind < DOWN_OR_UP else xi[3]
    n = direction((xi[0], xi[1], xi[2])) if kind == OPENFOAM else direction(slope)
    return scale_vector(size if kind == OPENFOAM else -size, n)


@traced
def add_eddies(block: Block, _medium: Medium, _share: float, _coefficients: object) -> None:
    """Add the velocity of the eddies to that of the mean flow."""
    for i in range(LANES):
        u, w, c = load3(block, at.u, i), load3(block, eddies.eddy_velocity, i), load3(block, eddies.drift, i)
        store3(block, at.u, i, plus(plus(u, w), c))


@separate
def turn_eddy(block: Block, i: int, turn: Tensor) -> None:
    """Rotate or mirror the eddy of lane i, together with the particle."""
    store3(block, eddies.eddy_velocity, i, dot_vector(turn, load3(block, eddies.eddy_velocity, i)))


@separate
def reflect_eddy(block: Block, i: int, n: Vector) -> None:
    """Reflect the eddy of lane i at a wall of normal n that the particle bounces off."""
    w = load3(block, eddies.eddy_velocity, i)
    towards = -2.0 * min(inner(w, n), 0.0)
    store3(block, eddies.eddy_velocity, i, plus_scaled(w, towards, n))


@dataclass(frozen=True, kw_only=True)
class Dispersion(Surrounding):
    """Dispersion by eddies."""

    seed: Seed = 1

    rows: ClassVar = (EddyRows,)
    surveys: ClassVar = ("R", "mu")
    stages: ClassVar = (
        Stage("start", update_eddy, writes=(eddies.eddy_velocity, eddies.drift), before=(at.u,)),
        Stage("fluid", add_eddies, reads=(eddies.eddy_velocity, eddies.drift), adds=(at.u,)),
    )

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the functions by which mirrors, walls and coupled patches change the eddy."""
        return {turn_along: turn_eddy, bounce_along: reflect_eddy}

    def remarks(self, survey: Survey) -> Remarks:
        """Note the ranges of the eddies' velocities and lives.

        Warn of deformation by eddies, which is not modelled, and of steps too long for the eddies.
        """
        if survey.arrays is None or len(survey.flow.at_some_nodes().turbulence) == 0:
            return Remarks()
        return Remarks(self._notes(survey.flow), self._warnings(survey))

    def _notes(self, flow: Flow) -> Sequence[str]:
        some = flow.at_some_nodes()
        names, ends = ("fluctuation [m/s]", "eddy time [s]", "epsilon [m2/s3]"), flow.ends_at_nodes(_eddies)
        return [
            f"{name:24s} {low:.3g} to {high:.3g}, median {np.median(values):.3g}"
            for name, (low, high), values in zip(names, ends, _eddies(some), strict=True)
            if len(values)
        ]

    def _warnings(self, survey: Survey) -> Sequence[str]:
        p, flow, medium, dt, _ = survey
        if p.size == 0:
            return ()
        some = flow.at_some_nodes()
        mu = float(np.median(medium.mu))
        nu = float(np.median(medium.mu / medium.rho))
        k, epsilon = np.maximum(some.turbulence[:, :2], 0.0).T
        worst, usual = flow.ends_at_nodes(_eddies)[2][1], np.median(epsilon)
        warnings = []
        if worst > 0.0:
            rate, length = kolmogorov_rate(worst, nu), kolmogorov_length(worst, nu)
            warnings.append(
                "eddies move particles but do not deform them. The shear rate of the smallest, "
                f"sqrt(epsilon/nu), is {kolmogorov_rate(usual, nu):.3g} (median) to {rate:.3g} 1/s, a "
                f"capillary number of up to {mu * rate / p.mu.min():.3g}; their smallest size is "
                f"{length:.3g} m, {length / (2.0 * p.R.max()):.3g} diameters."
            )
        time = np.median(eddy_time(k, epsilon))
        if 0.0 < time < _FEWEST * dt:
            warnings.append(
                f"deltaT is {dt / time:.3g} of the eddies' median life of {time:.3g} s: the dispersion is "
                f"right, but the velocities of particles are not. Use deltaT < {time / _FEWEST:.3g} s."
            )
        return warnings


def _eddies(values: NodeValues) -> tuple[Floats, Floats, Floats]:
    """Return the velocities of eddies, their lives if they have one, and ε."""
    k, epsilon = np.maximum(values.turbulence[:, :2], 0.0).T
    time = eddy_time(k, epsilon)
    return fluctuation_size(k), time[time > 0.0], epsilon


_FEWEST = 5.0
"""Minimum life of an eddy, in steps."""


@dataclass(frozen=True, kw_only=True)
class StochasticDispersion(Dispersion):
    """Eddies of random velocity and direction: `dispersionModel stochasticDispersionRAS;`."""

    fluctuations: Annotated[
        Literal["normal", "OpenFOAM"],
        Meaning(
            "`normal`: each component has the variance 2k/3; `OpenFOAM`: drawn as by OpenFOAM 1912, with a "
            "third of this variance"
        ),
    ] = "normal"
    driftCorrection: Annotated[
        bool,
        Meaning("whether ∇(k²/3ε) is added to the velocity, lest particles accumulate where k is low"),
    ] = False

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return the seed, how velocities are drawn, and the factor of the drift correction."""
        kind = NORMAL if self.fluctuations == "normal" else OPENFOAM
        # A third of the variance disperses a third as much.
        share = 1.0 if self.fluctuations == "normal" else 1.0 / 3.0
        return np.uint64(self.seed), kind, share * float(self.driftCorrection)


@dataclass(frozen=True, kw_only=True)
class GradientDispersion(Dispersion):
    """Eddies that move down the gradient of k: `dispersionModel gradientDispersionRAS;`."""

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:
        """Return the seed, how velocities are drawn, and no drift."""
        flat = any(patch.type == "empty" for patch in patches)
        return np.uint64(self.seed), DOWN_OR_UP if flat else DOWN, 0.0


DISPERSIONS: dict[str, type[Dispersion]] = {
    "stochasticDispersionRAS": StochasticDispersion,
    "gradientDispersionRAS": GradientDispersion,
}
"""By the word that ``dispersionModel`` selects."""
