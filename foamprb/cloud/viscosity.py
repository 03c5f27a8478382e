"""Viscosity of a fluid in which it varies, at the barycentres of particles.

``Medium.mu`` is a number, or one of the models below: a law of the shear rate, a field of the flow, or two
phases, whose density varies, too. In a loop a model is the first of the surroundings. It stores μ_f in rows
of its own, from which :func:`foamprb.cloud.block.viscosity_at` then reads it. Elsewhere :func:`viscosity_of`
evaluates it.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import astuple, dataclass
from typing import Annotated, Any, ClassVar, NamedTuple, Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

import foamprb.body.viscosity as laws
from foamprb.body.choice import choice
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    Vector,
    inner,
    minus,
    scale_vector,
    select,
)
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.block import (
    LocalMedium,
    Medium,
    Scratch,
    at,
    load3,
    load9,
    local_medium,
    store3,
    viscosity_at,
)
from foamprb.cloud.layout import LANES, Block, Row, offsets
from foamprb.cloud.state import Particles
from foamprb.cloud.surroundings.base import Remarks, Stage, Surrounding, Survey
from foamprb.cloud.surroundings.quadratic import Numbers, QuadraticInVarying, QuadraticSolid
from foamprb.compile.link import Slots, traced
from foamprb.flow.base import Patch, Sampled
from foamprb.flow.kernels import viscosity
from foamprb.flow.nodes import NodeValues

Floats: TypeAlias = NDArray[np.float64]

_NOTED, _SURVEYED = 1.2, 1000
"""Ratio of viscosities over a body from which the log has it; bodies that are surveyed."""


class ViscosityRows(NamedTuple):
    """Viscosity of the fluid at a particle."""

    mu_f: Annotated[int, Row(1, "Pa s", "where the shape is evaluated", 1.0)]


class FieldRows(NamedTuple):
    """The same, and the field at the start of a step."""

    mu_f: Annotated[int, Row(1, "Pa s", "where the shape is evaluated", 1.0)]
    mu_there: Annotated[int, Row(1, "Pa s", "field where the step starts, in the middle of its time", 1.0)]
    mu_slope: Annotated[int, Row(3, "Pa s/m", "its gradient")]


class MixtureRows(NamedTuple):
    """Viscosity and density, and the volume fraction of the first phase at the start of a step."""

    mu_f: Annotated[int, Row(1, "Pa s", "where the shape is evaluated", 1.0)]
    rho_f: Annotated[int, Row(1, "kg/m3", "density there", 1.0)]
    fraction: Annotated[int, Row(1, "1", "where the step starts, in the middle of its time", 1.0)]
    fraction_slope: Annotated[int, Row(3, "1/m", "its gradient")]


fluid = offsets(FieldRows)
"""Offsets of the rows; all declarations begin with the same row."""
mixture = offsets(MixtureRows)
"""The same of a mixture."""


def felt_viscosity(block: Block, i: int, _medium: Medium) -> Scalar:
    """Return μ_f at the barycentre of lane i, Pa s."""
    return block[fluid.mu_f * LANES + i]


def mixed_medium(block: Block, i: int, medium: Medium) -> LocalMedium:
    """Return the medium with ρ_f at the barycentre of lane i."""
    return LocalMedium(medium.mu, block[mixture.rho_f * LANES + i], medium.gravity, medium.forces)


@choice
def law(_rate: Scalar, *_coefficients: Scalar) -> Scalar:
    """Return μ_f at a shear rate by the law of the fluid, Pa s."""
    raise NotImplementedError


@traced
def evaluate_law(block: Block, _medium: Medium, _share: float, coefficients: Numbers) -> None:
    """Compute μ_f of all lanes from the velocity gradient of the flow."""
    for i in range(LANES):
        rate = shear_rate(load9(block, at.l, i))
        block[fluid.mu_f * LANES + i] = law(rate, *coefficients)


def start_law(
    _flow: object, s: Scratch, i: int, _step: int, _remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Compute μ_f where a step of lane i starts, for the other models' updates."""
    s.block[fluid.mu_f * LANES + i] = law(shear_rate(load9(s.block, at.l, i)), *coefficients)


def sample_field(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Store the field and its gradient at the position of lane i."""
    block = s.block
    mu, slope = viscosity(flow, s.host[i], load3(block, at.x, i), _middle(block, i, remaining))
    block[fluid.mu_there * LANES + i] = block[fluid.mu_f * LANES + i] = coefficients[0] * mu
    store3(block, fluid.mu_slope, i, scale_vector(coefficients[0], slope))


def _middle(block: Block, i: int, remaining: float) -> float:
    """Return the middle of the time of a step, so that the error of a constant value is of second order."""
    return block[at.t * LANES + i] + (0.5 * block[at.dt * LANES + i] if remaining > 0.0 else 0.0)  # type: ignore[no-any-return]


@traced
def evaluate_field(block: Block, _medium: Medium, share: float, _coefficients: object) -> None:
    """Compute μ_f of all lanes on their way, from the field where their steps start."""
    for i in range(LANES):
        mu = block[fluid.mu_there * LANES + i]
        # At the start of a step new_x is not known.
        way = inner(minus(load3(block, at.new_x, i), load3(block, at.x, i)), load3(block, fluid.mu_slope, i))
        there = mu + select(share > 0.0, share * way, 0.0)
        block[fluid.mu_f * LANES + i] = np.maximum(0.5 * mu, np.minimum(2.0 * mu, there))


def sample_fraction(
    flow: object, s: Scratch, i: int, _step: int, remaining: float, _medium: Medium, coefficients: Numbers
) -> None:
    """Store the volume fraction and its gradient at the position of lane i, and the fluid there."""
    block = s.block
    a, slope = viscosity(flow, s.host[i], load3(block, at.x, i), _middle(block, i, remaining))
    block[mixture.fraction * LANES + i] = a
    store3(block, mixture.fraction_slope, i, slope)
    store_mixture(block, i, a, coefficients)


def store_mixture(block: Block, i: int, fraction: Scalar, coefficients: Numbers) -> None:
    """Store μ_f and ρ_f of lane i."""
    a = np.maximum(0.0, np.minimum(1.0, fraction))
    mu, other_mu, rho, other_rho = coefficients
    block[fluid.mu_f * LANES + i] = other_mu + a * (mu - other_mu)
    block[mixture.rho_f * LANES + i] = other_rho + a * (rho - other_rho)


@traced
def evaluate_mixture(block: Block, _medium: Medium, share: float, coefficients: Numbers) -> None:
    """Compute μ_f and ρ_f of all lanes on their way."""
    for i in range(LANES):
        # At the start of a step new_x is not known.
        way = minus(load3(block, at.new_x, i), load3(block, at.x, i))
        more = select(share > 0.0, share * inner(way, load3(block, mixture.fraction_slope, i)), 0.0)
        store_mixture(block, i, block[mixture.fraction * LANES + i] + more, coefficients)


def law_beside(_flow: object, _host: int, _x: Vector, _t: float, l: Tensor, coefficients: Numbers) -> Scalar:
    """Return μ_f by the gradient at a point, Pa s."""
    return law(shear_rate(l), *coefficients)


def field_beside(flow: object, host: int, x: Vector, t: float, _l: Tensor, coefficients: Numbers) -> Scalar:
    """Return μ_f of the field at a point, Pa s."""
    return coefficients[0] * viscosity(flow, host, x, t)[0]


def mixture_beside(flow: object, host: int, x: Vector, t: float, _l: Tensor, coefficients: Numbers) -> Scalar:
    """Return μ_f of the phases at a point, Pa s."""
    a = np.maximum(0.0, np.minimum(1.0, viscosity(flow, host, x, t)[0]))
    return coefficients[1] + a * (coefficients[0] - coefficients[1])


@dataclass(frozen=True, kw_only=True)
class VaryingViscosity(Surrounding):
    """A viscosity that varies in the flow."""

    beside: ClassVar[Callable[..., Any]]
    """``beside(flow, host, x, t, l, coefficients) -> mu``: μ_f at a point near a body, Pa s."""

    def slots(self, inertia: bool) -> Slots:  # noqa: ARG002
        """Return the functions that read its rows."""
        return {viscosity_at: felt_viscosity}

    def of(self, flow: object, x: Floats, hosts: NDArray[np.int32], rate: Floats, t: float) -> Floats:
        """Return μ_f, (n,), Pa s, at points in their hosts and the shear rates there, at time t, s."""
        raise NotImplementedError

    def at_rate(self, rate: float) -> float:
        """Return μ_f, Pa s, at a shear rate, 1/s; a field returns its mean."""
        raise NotImplementedError

    def remarks(self, survey: Survey) -> Remarks:
        """Note by how much the viscosity varies over bodies at their start, if by more than a fifth."""
        p = survey.p.take(
            np.flatnonzero((survey.p.host >= 0) & np.isfinite(survey.p.x).all(axis=1))[:_SURVEYED]
        )
        if not p.size:
            return Remarks()
        values, t = [], float(p.t[0])
        for e in np.concatenate([np.eye(3), -np.eye(3)]):
            x = p.x + p.R[:, None] * e
            hosts, mu = survey.flow.locate(x), np.full(p.size, np.nan)
            inside = hosts >= 0
            l = survey.flow.sample(x[inside], hosts[inside], t)[1].reshape(-1, 9)
            mu[inside] = viscosity_of(self, survey.flow, x[inside], hosts[inside], l, t)
            values.append(mu)
        l = survey.flow.sample(p.x, p.host, t)[1].reshape(-1, 9)
        centre = np.asarray(viscosity_of(self, survey.flow, p.x, p.host, l, t))
        ratio = np.fmax.reduce([*values, centre]) / np.fmin.reduce([*values, centre])
        if not (n := np.count_nonzero(ratio > _NOTED)):
            return Remarks()
        return Remarks((
            f"viscosity: it varies over {n} of {p.size} bodies by more than a fifth, at their start: by a "
            f"factor of {np.median(ratio):.3g} (median), {ratio.max():.3g} (largest)",
        ))  # fmt: skip

    def at_nodes(self, values: NodeValues) -> Floats:
        """Return μ_f at nodes of a flow, Pa s."""
        raise NotImplementedError


@dataclass(frozen=True, kw_only=True)
class RateViscosity(laws.RateLaw, VaryingViscosity):
    """A law of the shear rate."""

    rows: ClassVar = (ViscosityRows,)
    each_step: ClassVar = False
    beside: ClassVar = staticmethod(law_beside)
    stages: ClassVar = (
        Stage("start", start_law, writes=(fluid.mu_f,), before=(at.l,)),
        Stage("properties", evaluate_law, writes=(fluid.mu_f,), before=(at.l,)),
    )

    @classmethod
    def of_kinematic(cls, coefficients: Mapping[str, float], rho: float) -> Self:
        """Return the law by OpenFOAM's coefficients, of the kinematic viscosity, and the density, kg/m³."""
        named = {name.replace("nu", "mu"): value for name, value in coefficients.items()}
        return cls(**{name: rho * v if name in cls.by_density else v for name, v in named.items()})

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return the coefficients of the law."""
        return tuple(map(float, astuple(self)))

    def slots(self, inertia: bool) -> Slots:
        """Return also the law."""
        return {**super().slots(inertia), law: type(self).law}

    def of(self, flow: Any, x: Floats, hosts: NDArray[np.int32], rate: Floats, t: float) -> Floats:  # noqa: ARG002
        """See :meth:`VaryingViscosity.of`."""
        return np.asarray(self.at(rate))

    def at_rate(self, rate: float) -> float:
        """See :meth:`VaryingViscosity.at_rate`."""
        return float(self.at(rate))

    def at_nodes(self, values: NodeValues) -> Floats:
        """See :meth:`VaryingViscosity.at_nodes`."""
        return np.asarray(self.at(np.asarray(shear_rate(tuple(values.l.T)))))


class PowerLaw(laws.PowerLaw, RateViscosity):
    """k γ̇ⁿ⁻¹ between two limits, OpenFOAM's ``powerLaw``: k in Pa sⁿ, limits in Pa s."""


class CrossPowerLaw(laws.CrossPowerLaw, RateViscosity):
    """μ∞ + (μ₀ − μ∞)/(1 + (m γ̇)ⁿ), OpenFOAM's ``CrossPowerLaw``: μ in Pa s, m in s."""


class BirdCarreau(laws.BirdCarreau, RateViscosity):
    """μ∞ + (μ₀ − μ∞)(1 + (k γ̇)ᵃ)^((n − 1)/a), OpenFOAM's ``BirdCarreau``: μ in Pa s, k in s."""


class HerschelBulkley(laws.HerschelBulkley, RateViscosity):
    """(τ₀ + k γ̇ⁿ)/γ̇, at most μ₀, OpenFOAM's ``HerschelBulkley``: μ₀ in Pa s, τ₀ in Pa, k in Pa sⁿ."""


class Casson(laws.Casson, RateViscosity):
    """(√(τ₀/γ̇) + √m)² between two limits, OpenFOAM's ``Casson``: m and limits in Pa s, τ₀ in Pa."""


RATE_LAWS: dict[str, type[RateViscosity]] = {
    "BirdCarreau": BirdCarreau,
    "Casson": Casson,
    "CrossPowerLaw": CrossPowerLaw,
    "HerschelBulkley": HerschelBulkley,
    "powerLaw": PowerLaw,
}
"""By OpenFOAM's names."""


@dataclass(frozen=True, kw_only=True)
class FieldViscosity(VaryingViscosity):
    """A field that the flow has read, times a factor: the density if the field is kinematic."""

    factor: float = 1.0
    mean: float
    """Mean over the cells, Pa s."""

    rows: ClassVar = (FieldRows,)
    kernels: ClassVar = ("viscosity",)
    beside: ClassVar = staticmethod(field_beside)
    stages: ClassVar = (
        Stage("start", sample_field, writes=(fluid.mu_f,)),
        Stage("properties", evaluate_field, writes=(fluid.mu_f,)),
    )

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return the factor."""
        return (float(self.factor),)

    def of(self, flow: Any, x: Floats, hosts: NDArray[np.int32], rate: Floats, t: float) -> Floats:  # noqa: ARG002
        """See :meth:`VaryingViscosity.of`."""
        return np.asarray(self.factor * flow.viscosity(x, hosts, t))

    def at_rate(self, rate: float) -> float:  # noqa: ARG002
        """See :meth:`VaryingViscosity.at_rate`."""
        return self.mean

    def at_nodes(self, values: NodeValues) -> Floats:
        """See :meth:`VaryingViscosity.at_nodes`."""
        return np.asarray(self.factor * values.viscosity)


@dataclass(frozen=True, kw_only=True)
class PhaseMixture(VaryingViscosity):
    """Viscosity and density of two phases, weighted with the fraction of the first, a field of the flow."""

    mu: tuple[float, float]
    """Of the phases, Pa s."""
    rho: tuple[float, float]
    """Of the phases, kg/m³."""
    mean: float
    """Mean viscosity over the cells, Pa s."""

    rows: ClassVar = (MixtureRows,)
    kernels: ClassVar = ("viscosity",)
    beside: ClassVar = staticmethod(mixture_beside)
    stages: ClassVar = (
        Stage("start", sample_fraction, writes=(fluid.mu_f, mixture.rho_f)),
        Stage("properties", evaluate_mixture, writes=(fluid.mu_f, mixture.rho_f)),
    )

    def slots(self, inertia: bool) -> Slots:
        """Return also the density."""
        return {**super().slots(inertia), local_medium: mixed_medium}

    def coefficients(self, patches: Sequence[Patch]) -> Numbers:  # noqa: ARG002
        """Return viscosities and densities."""
        return tuple(map(float, (*self.mu, *self.rho)))

    def of(self, flow: Any, x: Floats, hosts: NDArray[np.int32], rate: Floats, t: float) -> Floats:  # noqa: ARG002
        """See :meth:`VaryingViscosity.of`."""
        return _weighted(self.mu, flow.viscosity(x, hosts, t))

    def at_rate(self, rate: float) -> float:  # noqa: ARG002
        """See :meth:`VaryingViscosity.at_rate`."""
        return self.mean

    def at_nodes(self, values: NodeValues) -> Floats:
        """See :meth:`VaryingViscosity.at_nodes`."""
        return _weighted(self.mu, values.viscosity)

    def density_at_nodes(self, values: NodeValues) -> Floats:
        """Return ρ_f at nodes of a flow, kg/m³."""
        return _weighted(self.rho, values.viscosity)

    def density_of(self, flow: Any, x: Floats, hosts: NDArray[np.int32], t: float) -> Floats:
        """Return ρ_f, (n,), kg/m³, at points in their hosts, at time t, s."""
        return _weighted(self.rho, flow.viscosity(x, hosts, t))


def _weighted(values: tuple[float, float], fraction: Floats) -> Floats:
    return np.asarray(values[1] + fraction * (values[0] - values[1]))


def model_of(mu: float | VaryingViscosity) -> tuple[VaryingViscosity, ...]:
    """Return the model of a viscosity, none for a constant."""
    return (mu,) if isinstance(mu, VaryingViscosity) else ()


def in_fluid(model: Surrounding, mu: float | VaryingViscosity) -> Surrounding:
    """Return a model of the surroundings as it acts in a fluid: the mode of solids depends on it."""
    if isinstance(mu, VaryingViscosity) and type(model) is QuadraticSolid:
        return QuadraticInVarying(fluid=mu, beside=type(mu).beside, n_times=model.n_times)
    return model


def viscosity_of(
    mu: float | VaryingViscosity, flow: object, x: Floats, hosts: NDArray[Any], l_f: Floats, t: float | Floats
) -> float | Floats:
    """Return μ_f, Pa s, at points in their hosts, NaN where l_f is; a constant as it is.

    Parameters
    ----------
    mu
        Viscosity, Pa s, or a model of it.
    flow, x, hosts, t
        The flow, points (n, 3), m, their hosts, and the times, s, one for all or (n,).
    l_f
        ∂u_i/∂x_j there, (n, 9), 1/s.
    """
    if not isinstance(mu, VaryingViscosity):
        return mu
    rate = np.asarray(shear_rate(tuple(l_f.T)))
    finite, mu_f = np.isfinite(rate), np.full(len(x), np.nan)
    times = t[finite] if isinstance(t, np.ndarray) else t
    mu_f[finite] = mu.of(flow, x[finite], hosts[finite], rate[finite], times)
    return mu_f


def medium_at(medium: Medium, flow: Sampled, p: Particles, t: float) -> Medium:
    """Return the medium with the viscosity at particles at time t, s: (n,), or the number if constant.

    Likewise the density of a mixture. Where the flow is unknown, they are the medians.
    """
    if not isinstance(medium.mu, VaryingViscosity):
        return medium
    inside = np.flatnonzero((p.host >= 0) & np.isfinite(p.x).all(axis=1))
    mu, rho = np.full(p.size, medium.mu.at_rate(1.0)), np.full(p.size, medium.rho)
    if len(inside):
        x, hosts = p.x[inside], p.host[inside]
        l = flow.sample(x, hosts, t)[1].reshape(-1, 9)
        values = viscosity_of(medium.mu, flow, x, hosts, l, t)
        mu[:] = np.median(values)
        mu[inside] = values
        if isinstance(medium.mu, PhaseMixture):
            values = medium.mu.density_of(flow, x, hosts, t)
            rho[:] = np.median(values)
            rho[inside] = values
    return medium._replace(mu=mu, rho=rho)


def viscosity_at_rate(mu: float | VaryingViscosity, rate: float | None) -> float:
    """Return μ_f at a shear rate, 1/s, Pa s; a constant as it is."""
    return mu.at_rate(1.0 if rate is None else rate) if isinstance(mu, VaryingViscosity) else mu


def viscosity_at_nodes(mu: float | VaryingViscosity, values: NodeValues) -> float | Floats:
    """Return μ_f at nodes of a flow, Pa s; a constant as it is."""
    return mu.at_nodes(values) if isinstance(mu, VaryingViscosity) else mu
