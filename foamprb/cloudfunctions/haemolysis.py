"""Damage to red blood cells, by power laws of stress and exposure time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import SAMPLE_INTERVAL, STATUS_NAMES, Memory, ObservedCloud, Rows
from foamprb.cloudfunctions.rows import close_ended, names_of, open_rows
from foamprb.dictionary.constraints import AtLeastOne, Choice, Meaning, Positive
from foamprb.errors import InputError
from foamprb.results.tables import write_table

__all__ = ["POWER_LAWS", "Haemolysis", "PowerLaw", "effective_shear_rate", "index_of_haemolysis"]

Floats = NDArray[np.float64]


class PowerLaw(NamedTuple):
    """Share of haemoglobin that is set free, A τ^α t^β, in per cent, with τ in Pa and t in s."""

    A: float
    alpha: float
    beta: float


POWER_LAWS: dict[str, PowerLaw] = {
    "Giersiepen": PowerLaw(3.62e-5, 2.416, 0.785),
    "Song": PowerLaw(1.8e-6, 1.991, 0.765),
    "Zhang": PowerLaw(1.228e-5, 1.9918, 0.6606),
    "Ding": PowerLaw(3.458e-6, 2.0639, 0.2777),
}
"""Published constants: of Giersiepen et al. (1990), Song et al. (2003), Zhang et al. (2011), and Ding et al.
(2015), for human blood."""


def index_of_haemolysis(law: PowerLaw, dose: Floats) -> Floats:
    """Per cent of haemoglobin set free, A (∫τ^{α/β} dt)^β.

    Parameters
    ----------
    law
        Its constants.
    dose
        ∫τ^{α/β} dt, with τ in Pa and t in s.

    For a constant stress this is A τ^α t^β, into however many parts the time is divided (Goubergrits & Affeld
    2004).
    """
    return np.asarray(law.A * dose**law.beta)


def effective_shear_rate(D: Floats, f1: float, f2: float) -> Floats:
    """Shear rate, 1/s, that deforms a droplet so far in steady shear: 2 f₁ D/((1 − D²) f₂).

    So it is in the morphology equation of Arora, Behr & Pasquali (Artif. Organs 28, 1002, 2004), where
    vorticity turns the droplet as much as strain deforms it (f₃ = f₂).

    Parameters
    ----------
    D
        Taylor's deformation.
    f1, f2
        Rate of recovery, 1/s, and of deformation, 1.
    """
    return np.asarray(2.0 * f1 * D / ((1.0 - D * D) * f2))


@dataclass(frozen=True)
class Haemolysis:
    """Damage to red blood cells on each path, A (∫τ^{α/β} dt)^β: ``haemolysis.csv``; means in ``means.csv``.

    τ is the scalar stress of the fluid at the particle, μ_f γ̇, or that of the shear that would deform Arora's
    droplet as far as the particle is. The integral is a trapezoidal sum over the samples. Where the law says
    more than 100 %, 100 is written.
    """

    constants: Annotated[
        str,
        Choice((*POWER_LAWS, "own")),
        Meaning("of the power law; `own` with A, alpha and beta"),
    ]
    stress: Annotated[
        Literal["fluid", "deformation"],
        Meaning("`fluid`: μ_f γ̇; `deformation`: by Taylor's D of the particle"),
    ] = "fluid"
    A: Annotated[
        float | None, Positive, Meaning("factor of `own` constants", "% Pa^−α s^−β", "with `own` required")
    ] = None
    alpha: Annotated[
        float | None, Positive, Meaning("exponent of the stress", "1", "with `own` required")
    ] = None
    beta: Annotated[float | None, Positive, Meaning("exponent of the time", "1", "with `own` required")] = (
        None
    )
    f1: Annotated[
        float, Positive, Meaning("rate of recovery of Arora's droplet, for `deformation`", "1/s")
    ] = 5.0
    f2: Annotated[float, Positive, Meaning("its coefficient of deformation", "1")] = 4.2298e-4
    sampleInterval: Annotated[int, AtLeastOne, SAMPLE_INTERVAL] = 1

    def __post_init__(self) -> None:
        given = [name for name in ("A", "alpha", "beta") if getattr(self, name) is not None]
        if self.constants == "own" and len(given) < 3:
            raise InputError("has constants own, which need A, alpha and beta")
        if self.constants != "own" and given:
            raise InputError(f"has the constants of {self.constants} and {given[0]}; constants own takes it")

    @property
    def law(self) -> PowerLaw:
        """The constants."""
        if self.constants == "own":
            return PowerLaw(float(self.A or 0.0), float(self.alpha or 0.0), float(self.beta or 0.0))
        return POWER_LAWS[self.constants]

    @property
    def interval(self) -> int:
        """Steps between two samples."""
        return self.sampleInterval

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the stress of all particles at the start, and integrals of zero."""
        p = cloud.particles
        return {
            "closed": np.zeros(p.size, dtype=bool),
            "t": p.t.copy(),
            "rate": self._rate(cloud, np.arange(p.size)),
            "dose": np.zeros(p.size),
            "history": np.empty((0, 4)),
        }

    def sample(self, memory: Memory, cloud: ObservedCloud) -> None:
        """Add the time since the last sample to the integrals."""
        p = cloud.particles
        rows = open_rows(memory, p)
        rate = self._rate(cloud, rows)
        # A particle that the mesh has lost is where the flow is not known.
        rate = np.where(np.isfinite(rate), rate, memory["rate"][rows])
        memory["dose"][rows] += 0.5 * (p.t[rows] - memory["t"][rows]) * (memory["rate"][rows] + rate)
        memory["t"][rows], memory["rate"][rows] = p.t[rows], rate
        close_ended(memory, p, rows)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the damage of all particles that were released, and the means by injection model."""
        p = cloud.particles
        rows = np.flatnonzero(p.status != Status.PENDING)
        # The laws go on beyond the stresses that they were fitted to; there is no more than all of it.
        index = np.minimum(index_of_haemolysis(self.law, memory["dose"]), 100.0)
        write_table(
            folder / f"haemolysis.{cloud.tables}",
            {"id": rows, "injector": names_of(cloud.injectors, p.injector[rows]),
             "fate": names_of(STATUS_NAMES, p.status[rows]), "residenceTime": (memory["t"] - p.t0)[rows],
             "haemolysis": index[rows]},
        )  # fmt: skip
        lines = []
        for number in range(len(cloud.injectors)):
            own = rows[(p.injector[rows] == number) & (p.status[rows] != Status.FAILED)]
            lines.append([cloud.time, number, len(own), index[own].mean() if len(own) else np.nan])
        memory["history"] = np.concatenate([memory["history"], np.reshape(lines, (-1, 4))])
        time, injector, n, mean = memory["history"].T
        write_table(
            folder / f"means.{cloud.tables}",
            {"time": time, "injector": names_of(cloud.injectors, injector.astype(np.int64)),
             "parcels": n.astype(np.int64), "haemolysis": mean},
        )  # fmt: skip

    def _rate(self, cloud: ObservedCloud, rows: Rows) -> Floats:
        """τ^{α/β} of particles."""
        mu, law = cloud.cloud.medium.mu, self.law
        if self.stress == "fluid":
            (gamma,) = cloud.measure(rows, "shearRate")
        else:
            gamma = effective_shear_rate(cloud.measure(rows, "taylorDeformation")[0], self.f1, self.f2)
        return np.asarray((mu * gamma) ** (law.alpha / law.beta))
