"""Damage to red blood cells on each path: how the cells deform, and what they release."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from pathlib import Path
from typing import Annotated, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.morphology import Rates, morphology_step
from foamprb.cloud.patches import Interaction
from foamprb.cloud.state import Particles, Status
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    ContactObserver,
    Memory,
    ObservedCloud,
    Rows,
    SampledFunction,
    SampleInterval,
    append,
    names_of,
    passages,
    per_particle,
    table,
)
from foamprb.dictionary.constraints import Choice, Meaning, Positive
from foamprb.errors import InputError
from foamprb.results.tables import Rows as TableRows
from foamprb.results.tables import rows_of, write_rows, write_table

__all__ = [
    "POWER_LAWS",
    "Haemolysis",
    "PowerLaw",
    "effective_shear_rate",
    "index_of_haemolysis",
    "pore_area",
    "relaxed",
]

log = logging.getLogger("foamprb")

Floats = NDArray[np.float64]


class PowerLaw(NamedTuple):
    """Released share of haemoglobin, A τ^α t^β, in per cent, with τ in Pa and t in s."""

    A: float
    alpha: float
    beta: float
    least: float = 0.0
    """Smallest stress of the experiments, Pa."""
    most: float = math.inf
    """Largest stress of the experiments, Pa."""
    longest: float = math.inf
    """Longest exposure of the experiments, s."""


POWER_LAWS: dict[str, PowerLaw] = {
    "Giersiepen": PowerLaw(3.62e-5, 2.416, 0.785, 0.0, 255.0, 0.7),
    "Song": PowerLaw(1.8e-6, 1.991, 0.765, 0.0, 700.0, 0.7),
    "Zhang": PowerLaw(1.228e-5, 1.9918, 0.6606, 50.0, 320.0, 1.5),
    "Ding": PowerLaw(3.458e-6, 2.0639, 0.2777, 25.0, 320.0, 1.5),
    "DingPorcine": PowerLaw(6.701e-4, 1.0981, 0.2778, 25.0, 320.0, 1.5),
    "DingBovine": PowerLaw(9.772e-5, 1.4445, 0.2076, 25.0, 320.0, 1.5),
}
"""Published constants: of Giersiepen et al. (1990), for human blood; Song et al. (2003), porcine; Zhang et
al. (2011), ovine; and Ding et al. (2015), human, porcine and bovine."""

PORE_RATE, PORE_EXPONENT = 2.187e-6, 0.9289
"""h and k of dIH/dt = h (μ G_f)^k A_p(G), IH as a share, μ G_f in Pa: human blood (Dirkes & Behr 2026)."""
_PORES = (-13.41, 37.31, -48.91, 32.39, 0.63, -0.16)
"""Coefficients of A_p, a polynomial of G/42 000, the highest power first."""
FIRST_PORES, MOST_PORES = 3750.0, 42_000.0
"""Shear rates, 1/s: below the first there are no pores, beyond the second no further ones."""
_LONGEST = 0.1
"""Longest step of a cell's state times the rate at which it changes."""


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


def pore_area(G: Floats) -> Floats:
    """Return A_p(G), the area of the membrane's pores at the effective shear rate G, 1/s."""
    area = np.polyval(_PORES, np.minimum(G, MOST_PORES) / MOST_PORES)
    return np.where(G < FIRST_PORES, 0.0, area)


def relaxed(G: Floats, rate0: Floats, rate1: Floats, h: Floats, f1: float) -> Floats:
    """Return the G of dG/dt = f₁ (G_f − G) after a time h, s, with G_f linear from ``rate0`` to ``rate1``."""
    lag = (rate1 - rate0) / np.maximum(f1 * h, 1e-300)
    return rate1 - lag + (G - rate0 + lag) * np.exp(-f1 * h)


@dataclass(frozen=True)
class Haemolysis(SampledFunction, ContactObserver):
    """Damage to red blood cells on each path: ``haemolysis.csv``; means in ``means.csv``.

    The stress is τ = μ G, with the shear rate G of the fluid or an effective one of a cell that remembers the
    flow. The damage is A (∫τ^{α/β} dt)^β, or that of pores. Values above 100 % are written as 100.
    """

    constants: Annotated[
        str,
        Choice((*POWER_LAWS, "pores", "own")),
        Meaning("of the power law; `pores` of the membrane; `own` with A, alpha and beta"),
    ]
    stress: Annotated[
        Literal["fluid", "KelvinVoigt", "morphology"],
        Meaning("`fluid`: μ γ̇; else of a [cell](models/haemolysis.md) that remembers the flow"),
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
    f1: Annotated[float, Positive, Meaning("rate at which a cell recovers", "1/s")] = 5.0
    f2: Annotated[
        float, Positive, Meaning("effect of strain and of vorticity on its shape, for `morphology`", "1")
    ] = 4.2298e-4
    mu: Annotated[
        float | None, Positive, Meaning("viscosity of whole blood, for τ", "Pa s", "that of the fluid")
    ] = None
    sampleInterval: SampleInterval = 1

    arrays: ClassVar = {
        **SampledFunction.arrays,
        **dict.fromkeys(("fluid", "mu", "rate", "l", "dose", "peak", "cell"), per_particle),
        "history": table,
        "warned": table,
    }

    def __post_init__(self) -> None:
        entries = [name for name in ("A", "alpha", "beta") if getattr(self, name) is not None]
        if self.constants == "own" and len(entries) < 3:
            raise InputError("has constants own, which need A, alpha and beta")
        if self.constants != "own" and entries:
            raise InputError(
                f"has the constants of {self.constants} and {entries[0]}; constants own takes it"
            )
        if self.constants == "pores" and self.stress == "fluid":
            raise InputError("has constants pores, which need stress KelvinVoigt or morphology, not fluid")

    @property
    def law(self) -> PowerLaw:
        """The constants; for pores the share is integrated without a power, within their range."""
        if self.constants == "own":
            return PowerLaw(float(self.A or 0.0), float(self.alpha or 0.0), float(self.beta or 0.0))
        if self.constants == "pores":
            return POWER_LAWS["Ding"]._replace(A=100.0, alpha=1.0, beta=1.0)
        return POWER_LAWS[self.constants]

    def _rate(self, G: Floats, fluid: Memory) -> Floats:
        """Return the rate of the dose at the effective shear rate, 1/s, in the fluid."""
        if self.constants == "pores":
            return PORE_RATE * (fluid["mu"] * fluid["fluid"]) ** PORE_EXPONENT * pore_area(G)
        return np.asarray((fluid["mu"] * G) ** (self.law.alpha / self.law.beta))

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return the first sample, and cells at rest; raise InputError for a turning frame."""
        if self.stress == "morphology" and bool(getattr(cloud.cloud.flow, "rotating", ())):
            raise InputError("stress morphology does not turn with rotating zones: use KelvinVoigt")
        return super().begin(cloud)

    def observe(self, cloud: ObservedCloud, rows: Rows) -> Memory:
        """Return the rate of the dose by the fluid's stress, or what a cell feels of the fluid."""
        gamma, mu, gradient = cloud.measure(
            rows, "shearRate", lambda c: c.mu, lambda c: np.stack(c.l_f, axis=1)
        )
        fluid: Memory = {"fluid": gamma, "mu": mu if self.mu is None else np.full(len(rows), self.mu)}
        if self.stress == "fluid":
            return {"rate": self._rate(gamma, fluid)}
        return {**fluid, "l": gradient} if self.stress == "morphology" else fluid

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero, cells at rest and an empty table."""
        n = cloud.particles.size
        memory = {
            "dose": np.zeros(n),
            "history": np.empty((0, 4)),
            "peak": np.zeros(n),
            "warned": np.zeros(1),
        }
        if self.stress == "KelvinVoigt":
            memory["cell"] = np.zeros((n, 1))
        if self.stress == "morphology":
            memory["cell"] = np.tile(np.eye(3).ravel(), (n, 1))
        return memory

    def needs_rebounds(self, interactions: Mapping[str, Interaction]) -> bool:
        """Return whether there are coupled patches, at which the shape of a cell turns."""
        return self.stress == "morphology" and super().needs_rebounds(interactions)

    def record_rebounds(self, memory: Memory, cloud: ObservedCloud, rows: NDArray[np.float64]) -> None:
        """Turn shapes, and the gradients of the last sample, with the particles at coupled patches."""
        if self.stress != "morphology":
            return
        for before, after in passages(cloud, rows):
            turn = after.F.reshape(-1, 3, 3) @ np.linalg.inv(before.F.reshape(-1, 3, 3))
            for name in ("cell", "l"):
                T = memory[name][after.number].reshape(-1, 3, 3)
                memory[name][after.number] = (turn @ T @ turn.transpose(0, 2, 1)).reshape(-1, 9)

    def add(self, memory: Memory, cloud: ObservedCloud, rows: Rows, now: Memory) -> None:  # noqa: ARG002
        """Advance the cells to the present sample, and add to the integrals."""
        h = now["t"] - memory["t"][rows]
        # The flow is unknown at a particle that the mesh has lost.
        for name in now:
            now[name] = np.where(np.isfinite(now[name]), now[name], memory[name][rows])
        if self.stress == "fluid":
            rate = now["rate"]
            memory["dose"][rows] += 0.5 * h * (memory["rate"][rows] + rate)
            memory["peak"][rows] = np.maximum(memory["peak"][rows], rate ** (self.law.beta / self.law.alpha))
            return
        self._advance(memory, rows, now, h)

    def _advance(self, memory: Memory, rows: Rows, now: Memory, h: Floats) -> None:
        """Advance cells with a memory by h, s, in sub-steps of two halves each: Simpson's rule."""
        before: Memory = {name: memory[name][rows] for name in now if name != "t"}
        fastest = self.f1 + self.f2 * np.maximum(before["fluid"], now["fluid"])
        steps = np.maximum(np.ceil(h * fastest / _LONGEST), 1.0)
        cell = memory["cell"][rows]
        G, dose, peak = self._effective(cell), np.zeros(len(rows)), memory["peak"][rows]
        some = np.arange(len(rows))
        for k in range(int(steps.max(initial=0.0))):
            some = some[k < steps[some]]
            n, length = steps[some], h[some] / steps[some]
            ends: list[Memory] = [
                {name: _between(before[name][some], now[name][some], (k + share) / n) for name in before}
                for share in (0.0, 0.5, 1.0)
            ]
            rates = [self._rate(G[some], ends[0])]
            for first, last in pairwise(ends):
                cell[some] = self._step(cell[some], first, last, 0.5 * length)
                G[some] = self._effective(cell[some])
                rates.append(self._rate(G[some], last))
            dose[some] += length / 6.0 * (rates[0] + 4.0 * rates[1] + rates[2])
            peak[some] = np.maximum(peak[some], ends[-1]["mu"] * G[some])
        memory["dose"][rows] += dose
        memory["peak"][rows], memory["cell"][rows] = peak, cell

    def _step(self, cell: Floats, first: Memory, last: Memory, h: Floats) -> Floats:
        """Return the state of cells after a time h, s, from the fluid at its start and its end."""
        if self.stress == "KelvinVoigt":
            return relaxed(cell[:, 0], first["fluid"], last["fluid"], h, self.f1)[:, None]
        S, l0, l1 = (tuple(T.T) for T in (cell, first["l"], last["l"]))
        rates = Rates(self.f1, self.f2, self.f2)
        return np.stack(morphology_step(S, l0, l1, h, rates), axis=1)

    def _effective(self, cell: Floats) -> Floats:
        """Return the effective shear rate of cells, 1/s."""
        if self.stress == "KelvinVoigt":
            return np.array(cell[:, 0])
        axes = np.sqrt(np.linalg.eigvalsh(cell.reshape(-1, 3, 3)))
        return effective_shear_rate((axes[:, 2] - axes[:, 0]) / (axes[:, 2] + axes[:, 0]), self.f1, self.f2)

    def write(self, memory: Memory, cloud: ObservedCloud, folder: Path) -> None:
        """Write the damage of all particles that were released, and the means by injection model."""
        damages: list[_Damage] = []
        injectors = cloud.names["injector"]

        def rows() -> Iterator[TableRows]:
            for damage in cloud.map(self._damage, injectors):
                damages.append(damage._replace(rows=TableRows((), b"")))
                yield damage.rows

        write_rows(folder / "haemolysis.csv", rows())
        self._warn(memory, damages, folder.name)
        lines = []
        for number in range(len(injectors)):
            indices = np.concatenate([damage.indices[number] for damage in damages])
            lines.append([cloud.time, number, len(indices), indices.mean() if len(indices) else np.nan])
        time, injector, n, mean = append(memory, "history", lines).T
        write_table(
            folder / "means.csv",
            {"time": time, "injector": names_of(injectors, injector),
             "parcels": n.astype(np.int64), "haemolysis": mean},
        )  # fmt: skip

    def _damage(self, p: Particles, memory: Memory, injectors: Sequence[str]) -> _Damage:
        """Return the damage of some particles."""
        rows = np.flatnonzero(p.status != Status.PENDING)
        # The laws exceed 100 % beyond the stresses of their fits.
        index = np.minimum(index_of_haemolysis(self.law, memory["dose"]), 100.0)[rows]
        times, peak = (memory["t"] - p.t0)[rows], memory["peak"][rows]
        sound, injector = p.status[rows] != Status.FAILED, p.injector[rows]
        return _Damage(
            rows_of(
                {"id": p.number[rows], "injector": names_of(injectors, injector),
                 "fate": names_of(STATUS_NAMES, p.status[rows]), "residenceTime": times,
                 "haemolysis": index}
            ),
            [index[sound & (injector == number)] for number in range(len(injectors))],
            len(rows),
            int(np.count_nonzero((peak > self.law.most) | (times > self.law.longest))),
            float(peak.max(initial=-np.inf)),
            float(times.max(initial=-np.inf)),
        )  # fmt: skip

    def _warn(self, memory: Memory, damages: Sequence[_Damage], name: str) -> None:
        """Warn, once in a run, of stresses and times beyond the experiments of the constants."""
        beyond = sum(damage.beyond for damage in damages)
        if not beyond or memory["warned"][0]:
            return
        memory["warned"] = np.ones(1)
        log.warning(
            "cloudFunctions/%s: %d of %d particles are beyond the range of the constants %s, stresses from "
            "%g to %g Pa and times up to %g s: their largest stress is %.3g Pa, the longest time %.3g s.",
            name, beyond, sum(damage.released for damage in damages), self.constants, self.law.least,
            self.law.most, self.law.longest, max(damage.peak for damage in damages),
            max(damage.longest for damage in damages),
        )  # fmt: skip


class _Damage(NamedTuple):
    """Damage of some particles."""

    rows: TableRows
    """Of the released particles."""
    indices: list[Floats]
    """Index of haemolysis of the sound ones of each injection model, %."""
    released: int
    beyond: int
    """Number beyond the range of the constants."""
    peak: float
    """Largest stress, Pa."""
    longest: float
    """Longest time, s."""


def _between(a: Floats, b: Floats, share: Floats) -> Floats:
    """Return a + share (b − a), row by row."""
    s = share if a.ndim == 1 else share[:, None]
    return np.asarray(a + s * (b - a))
