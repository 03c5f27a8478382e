"""Damage to red blood cells, by power laws of stress and exposure time."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.cloud.state import Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    SampleInterval,
    append,
    names_of,
)
from foamprb.dictionary.constraints import Choice, Meaning, Positive
from foamprb.errors import InputError
from foamprb.results.tables import write_table

__all__ = ["POWER_LAWS", "Haemolysis", "PowerLaw", "effective_shear_rate", "index_of_haemolysis"]

Floats = NDArray[np.float64]


class PowerLaw(NamedTuple):
    """Released share of haemoglobin, A τ^α t^β, in per cent, with τ in Pa and t in s."""

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
    """Return the per cent of haemoglobin released, A (∫τ^{α/β} dt)^β.

    Parameters
    ----------
    law
        Its constants.
    dose
        ∫τ^{α/β} dt, with τ in Pa and t in s.

    For a constant stress this is A τ^α t^β for any number of time steps (Goubergrits & Affeld 2004).
    """
    return np.asarray(law.A * dose**law.beta)


def effective_shear_rate(D: Floats, f1: float, f2: float) -> Floats:
    """Return the shear rate, 1/s, of the steady shear in which a droplet has the deformation D.

    It is 2 f₁ D/((1 − D²) f₂), by the morphology equation of Arora, Behr & Pasquali (Artif. Organs 28, 1002,
    2004) with equal effects of vorticity and strain (f₃ = f₂).

    Parameters
    ----------
    D
        Taylor's deformation.
    f1, f2
        Rate of recovery, 1/s, and of deformation, 1.
    """
    return np.asarray(2.0 * f1 * D / ((1.0 - D * D) * f2))


@dataclass(frozen=True)
class Haemolysis(SampledFunction):
    """Damage to red blood cells on each path, A (∫τ^{α/β} dt)^β: ``haemolysis.csv``; means in ``means.csv``.

    τ is the scalar stress of the fluid at the particle, μ_f γ̇, or that of the shear in which Arora's droplet
    has the deformation of the particle. The integral is a trapezoidal sum over the samples. Values above
    100 % are written as 100.
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
    sampleInterval: SampleInterval = 1

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

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return τ^{α/β}."""
        if self.stress == "fluid":
            (gamma,) = cloud.measure(rows, "shearRate")
        else:
            gamma = effective_shear_rate(cloud.measure(rows, "taylorDeformation")[0], self.f1, self.f2)
        return {"rate": (cloud.cloud.medium.mu * gamma) ** (self.law.alpha / self.law.beta)}

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero and an empty table."""
        return {"dose": np.zeros(cloud.particles.size), "history": np.empty((0, 4))}

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:  # noqa: ARG002
        """Add the time since the last sample to the integrals."""
        h, before = now["t"] - memory["t"][rows], memory["rate"][rows]
        # The flow is unknown at a particle that the mesh has lost.
        now["rate"] = np.where(np.isfinite(now["rate"]), now["rate"], before)
        memory["dose"][rows] += 0.5 * h * (before + now["rate"])

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the damage of all particles that were released, and the means by injection model."""
        p = cloud.particles
        rows = np.flatnonzero(p.status != Status.PENDING)
        # The laws exceed 100 % beyond the stresses of their fits.
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
        time, injector, n, mean = append(memory, "history", lines).T
        write_table(
            folder / f"means.{cloud.tables}",
            {"time": time, "injector": names_of(cloud.injectors, injector),
             "parcels": n.astype(np.int64), "haemolysis": mean},
        )  # fmt: skip
