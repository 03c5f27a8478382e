"""Particles of a run at their start, made part by part in the order of their numbers."""

from __future__ import annotations

import logging
import math
import sys
import zlib
from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray

from foamprb.body.compressibility import lame_from_bulk_modulus, sufficient_bulk_modulus
from foamprb.body.material import MATERIALS, lame_parameter, modulus_of_capsule
from foamprb.body.memory import series_of_power_law, times_of_power_law
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import find_hosts
from foamprb.cloud.communicator import parts_of
from foamprb.cloud.injection.distribution import Distribution, draw
from foamprb.cloud.injection.models import Places, given_shear_modulus, pending, start_of_injection
from foamprb.cloud.measures import shear_rate_at
from foamprb.cloud.state import Particles, set_excess_area, with_relaxation
from foamprb.cloud.viscosity import medium_at, viscosity_at_rate
from foamprb.dictionary.positions import read_positions
from foamprb.errors import InputError
from foamprb.flow.base import Flow
from foamprb.run.room import Room
from foamprb.settings.injections import InjectionSettings, Solid

Floats = NDArray[np.float64]
log = logging.getLogger("foamprb")


def lame_of(solid: Solid, mu: Floats, largest_stress: Callable[[], float]) -> Floats:
    """Return λ_s, Pa, for shear moduli μ_s, Pa, and the largest viscous stress around the bodies, Pa."""
    if solid.poissonsRatio is not None:
        return np.asarray(lame_parameter(mu, solid.poissonsRatio))
    bulk = solid.bulkModulus
    if bulk is None:
        bulk = sufficient_bulk_modulus(mu, largest_stress())
    return np.asarray(lame_from_bulk_modulus(bulk, mu))


def number_of_times(injections: Sequence[InjectionSettings], span: tuple[float, float]) -> int:
    """Return the largest number of relaxation times of the solids; 0 without memory.

    ``span`` is the shortest and the longest time of the run, s.
    """
    solids = [injection.solid for injection in injections]
    prony = [len(solid.relaxation.times) for solid in solids if solid.relaxation]
    power_law = any(MATERIALS[solid.type].power_law for solid in solids)
    return max([*prony, *([len(times_of_power_law(*span))] if power_law else []), 0])


def with_power_law(
    p: Particles, k: Floats, alpha: Floats, times: Floats, frequency: float | Floats
) -> Particles:
    """Return particles whose solid is a power law, and has their viscosity beside that of its series.

    Parameters
    ----------
    k, alpha
        G(t) = k (ω₀t)^(−α), (n,), Pa and 1.
    times
        Relaxation times of the series, s.
    frequency
        ω₀/2π, Hz.
    """
    series, k = series_of_power_law(alpha, times), k * frequency**-alpha
    p.mu[:], p.k[:] = k * series.elastic, alpha
    p.eta[:] += k * series.viscosity
    return with_relaxation(p, k[:, None] * series.moduli, times)


class Release:
    """Places of all particles of a run, from which their states follow part by part.

    The particles do not depend on the size of the parts.

    Parameters
    ----------
    injections
        Settings of the injection models.
    flow, medium
        The flow, and its viscosity, density and gravity.
    span
        Shortest and longest time of the run, s.
    end
        End of the run, s. The last particles of all are left out if they are due then or later.
    walls
        Indices of the patches from which models with ``clearance`` keep bodies away.

    Raises
    ------
    InputError
        If an injection model cannot release particles in the flow.
    """

    def __init__(
        self,
        injections: Sequence[InjectionSettings],
        flow: Flow,
        medium: Medium,
        span: tuple[float, float] = (1e-3, 1.0),
        end: float = math.inf,
        walls: Sequence[int] = (),
    ) -> None:
        self.n_times = number_of_times(injections, span)
        self._sources = [
            _Source(i, injection, flow, medium, times_of_power_law(*span), self.n_times, walls)
            for i, injection in enumerate(injections)
        ]
        self.late = self._sources[-1].leave_out(end) if self._sources else 0
        """Number of particles that are left out."""
        self.size = sum(source.size for source in self._sources)

    def parts(self, most: int = sys.maxsize) -> Iterator[Particles]:
        """Yield the particles in the order of their numbers, at most so many together.

        Raises
        ------
        InputError
            If a stiffness is not positive, or a particle lies outside the flow.
        """
        first = 0
        for source in self._sources:
            for p in source.parts(most):
                p.number[:] = first + np.arange(p.size)
                first += p.size
                yield p


class _Source:
    """One injection model; see :class:`Release`."""

    def __init__(
        self,
        index: int,
        injection: InjectionSettings,
        flow: Flow,
        medium: Medium,
        times: Floats,
        n_times: int,
        walls: Sequence[int],
    ) -> None:
        self._index, self._injection, self._flow, self._medium = index, injection, flow, medium
        self._times, self._n_times = times, n_times
        solid = injection.solid
        try:
            self._places = self._find_places(walls)
            self._values = self._places.columns
            mu = viscosity_at_rate(medium.mu, solid.referenceShearRate)
            self._stiffness = given_shear_modulus(
                self._values, solid.poissonsRatio, mu, solid.referenceShearRate
            )
            if injection.sizeDistribution is None and "d" not in self._values:
                raise InputError("sizeDistribution is missing, and the file of positions has no column d.")
            kind = MATERIALS[solid.type]
            if self._stiffness is not None and (kind.liquid or kind.membrane or kind.power_law):
                raise InputError(
                    f"the file of positions gives a stiffness, which the solid {solid.type} does not have."
                )
        except InputError as error:
            raise InputError(f"injection model {injection.name}: {error}") from error
        self.size = len(self._places.t)

    def _find_places(self, walls: Sequence[int]) -> Places:
        """Return the places of release; with ``clearance``, bodies have room there."""
        injection, arguments = self._injection, (self._flow, self._random(), read_positions)
        model: Any = injection.model
        if not getattr(model, "clearance", False):
            return injection.model.places(*arguments)
        room = Room(injection, self._flow, walls, self._random("size"), self._random("shape"))
        places: Places = model.places(*arguments, room.fit)
        log.info("    injection model %s: %d of %d places had no room and were drawn anew",
                 injection.name, room.moved, len(places.t))  # fmt: skip
        return places

    def leave_out(self, end: float) -> int:
        """Leave out the last particles if they are due at ``end`` (s) or later, but for one; return how many.

        The others do not depend on ``end``.
        """
        entering = np.flatnonzero(self._places.t < end)
        size = self.size
        self.size = max(int(entering[-1]) + 1 if len(entering) else 0, min(1, size))
        return size - self.size

    def parts(self, most: int) -> Iterator[Particles]:
        """Yield the particles, at most so many together, but for their numbers."""
        solid, size = self._injection.solid, self._injection.sizeDistribution or 0.0
        streams = {key: self._random(key) for key in ("size", "rho", "viscosity", "surfaceTension", "shape")}
        stiff, membrane = self._random("stiffness"), self._random("stiffness")
        exponents = self._random("alpha")
        for start in range(0, self.size, most):
            rows = slice(start, min(start + most, self.size))
            p = pending(self._places, rows)

            def values(name: str, quantity: float | Distribution, key: str) -> Floats:
                """Return the values in the file of positions, or random ones."""
                column = self._values.get(name)
                return draw(quantity, p.size, streams[key]) if column is None else column[rows]  # noqa: B023

            p.R[:] = 0.5 * values("d", size, "size")
            p.rho[:] = values("rho", self._injection.rho0, "rho")
            p.mu[:] = (
                draw(solid.shearModulus, p.size, stiff) if self._stiffness is None else self._stiffness[rows]
            )
            p.eta[:] = values("viscosity", solid.viscosity, "viscosity")
            p.gamma[:] = values("surfaceTension", solid.surfaceTension, "surfaceTension")
            p.k[:] = self._injection.parameter
            if MATERIALS[solid.material].fluid:
                set_excess_area(p, solid.excessArea, solid.bendingModulus)
            elif MATERIALS[solid.type].membrane:
                G_s = draw(solid.surfaceShearModulus or 0.0, p.size, membrane)
                p.mu[:] = modulus_of_capsule(G_s, solid.surfacePoissonsRatio, p.R)
            if MATERIALS[solid.type].liquid:
                p.mu[:], p.gamma[:], p.drop[:] = p.gamma / p.R, 0.0, 1
            if MATERIALS[solid.type].power_law:
                k, alpha = draw(solid.k or 0.0, p.size, stiff), draw(solid.alpha or 0.0, p.size, exponents)
                p = with_power_law(p, k, alpha, self._times, solid.referenceFrequency)
            self._injection.shape.form(p, streams["shape"])
            p.injector[:] = self._index
            self._refuse_moduli(p)
            if self._n_times and not MATERIALS[solid.type].power_law:
                prony = solid.relaxation
                moduli, times = (prony.moduli, prony.times) if prony else ((), ())
                p = with_relaxation(p, moduli, times, self._n_times)
            stress = self._viscous_stress(p)
            p.Ca[:] = stress / p.mu
            p.lame[:] = lame_of(solid, p.mu, lambda: self._largest_stress)
            find_hosts(p, self._flow)
            yield p

    def _viscous_stress(self, p: Particles) -> Any:
        """Return μ_f γ̇, Pa, at particles, or at the reference shear rate."""
        rate = self._injection.solid.referenceShearRate
        if rate is not None:
            return viscosity_at_rate(self._medium.mu, rate) * rate
        start = start_of_injection(self._injection.model, self._flow)
        mu = medium_at(self._medium, self._flow, p, start).mu
        return mu * shear_rate_at(self._flow, p, start)

    @cached_property
    def _largest_stress(self) -> float:
        """Largest viscous stress around the particles, Pa."""
        parts = (pending(self._places, rows) for rows in parts_of(len(self._places.t)))
        return max(float(np.max(self._viscous_stress(p), initial=0.0)) for p in parts)

    def _refuse_moduli(self, p: Particles) -> None:
        """Raise InputError if a stiffness is not a positive number."""
        wrong = ~((p.mu > 0.0) & (p.mu < math.inf))
        if wrong.any():
            solid = self._injection.solid
            what = "tension over radius" if MATERIALS[solid.type].liquid else "shear modulus"
            mu = viscosity_at_rate(self._medium.mu, solid.referenceShearRate)
            raise InputError(
                f"injection model {self._injection.name}: the {what} of {np.count_nonzero(wrong)} of "
                f"{p.size} particles is {p.mu[wrong][0]:g}, no positive number; the fluid has {mu:g} Pa s."
            )

    def _random(self, *names: str) -> np.random.Generator:
        """Return a generator whose seed depends on the names of the injection model and a quantity alone."""
        return np.random.default_rng([zlib.crc32(name.encode()) for name in (self._injection.name, *names)])
