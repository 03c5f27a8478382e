"""Damage to red blood cells on each path: how the cells deform, and what they release."""

from __future__ import annotations

import logging
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated, ClassVar, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.morphology import Rates, morphology_step
from foamprb.body.tensor import (
    Scalar,
    Tensor,
    add,
    add_identity,
    ddot,
    det,
    dot,
    inverse,
    scale,
    select,
    trace,
    transpose,
)
from foamprb.body.viscosity import shear_rate
from foamprb.cloud.paths import Steps, step, tensor_of
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.viscosity import viscosity_of
from foamprb.cloudfunctions.base import (
    STATUS_NAMES,
    Memory,
    ObservedCloud,
    PathFunction,
    append,
    names_of,
    per_particle,
    table,
)
from foamprb.compile.link import compiled
from foamprb.dictionary.constraints import Choice, Meaning, Positive
from foamprb.errors import InputError
from foamprb.results.tables import Rows as TableRows
from foamprb.results.tables import rows_of, write_rows, write_table

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


class Pores(NamedTuple):
    """Constants of dIH/dt = h (μ G_f)^k A_p(G), IH as a share, μ G_f in Pa."""

    of_strain: tuple[float, float]
    """h and k for cells that remember the flow."""
    of_stress: tuple[float, float]
    """h and k for G = G_f."""


SPECIES: dict[str, Pores] = {
    "human": Pores((2.187e-6, 0.9271), (1.157e-6, 1.0309)),
    "ovine": Pores((3.292e-7, 1.4424), (1.816e-7, 1.5399)),
    "porcine": Pores((1.556e-6, 1.0268), (8.941e-7, 1.1165)),
    "bovine": Pores((4.386e-6, 0.8411), (2.552e-6, 0.9289)),
}
"""Fits by Dirkes & Behr (2026) to the experiments of Ding et al. (2015), with μ of 3.5 mPa s for human blood
and 3 mPa s for the others, as their repositories HemTracer and bpc_hemolysis have them."""
_PORES = (-13.4134, 37.3125, -48.9149, 32.3921, 0.6332, -0.1593)
"""Coefficients of A_p, a polynomial of G/42 000, the highest power first."""
FIRST_PORES, MOST_PORES = 3750.0, 42_000.0
"""Shear rates, 1/s: below the first there are no pores, beyond the second no further ones."""
_LONGEST = 0.1
"""Longest step of a cell's state times the rate at which it changes."""
_AT_REST: dict[str, list[float]] = {
    "fluid": [], "KelvinVoigt": [0.0], "morphology": [1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0]
}  # fmt: skip
"""State of a cell at rest: none, its effective shear rate (1/s), or its morphology tensor."""
_KINDS = tuple(_AT_REST)
_FLUID, _KELVIN_VOIGT, _MORPHOLOGY = 0, 1, 2


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


def effective_shear_rate(D: Scalar, f1: Scalar, f2: Scalar) -> Scalar:
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
    return 2.0 * f1 * D / ((1.0 - D * D) * f2)


def pore_area(G: Scalar) -> Scalar:
    """Return A_p(G), the area of the membrane's pores at the effective shear rate G, 1/s."""
    a, b, c, d, e, f = _PORES
    x = np.minimum(G, MOST_PORES) / MOST_PORES
    return select(G < FIRST_PORES, 0.0, ((((a * x + b) * x + c) * x + d) * x + e) * x + f)


def relaxed(G: Scalar, rate0: Scalar, rate1: Scalar, h: Scalar, f1: Scalar) -> Scalar:
    """Return the G of dG/dt = f₁ (G_f − G) after a time h, s, with G_f linear from ``rate0`` to ``rate1``."""
    lag = (rate1 - rate0) / np.maximum(f1 * h, 1e-300)
    return rate1 - lag + (G - rate0 + lag) * np.exp(-f1 * h)


@dataclass(frozen=True)
class Haemolysis(PathFunction):
    """Damage to red blood cells on each path: ``haemolysis.csv``; means in ``means.csv``.

    The stress is τ = μ G, with the shear rate G of the fluid or an effective one of a cell that remembers the
    flow. The damage is A (∫τ^{α/β} dt)^β, or that of pores. Values above 100 % are written as 100.
    """

    constants: Annotated[
        str,
        Choice((*POWER_LAWS, "pores", "own")),
        Meaning(
            "of the power law; `pores` of the membrane; `own` with A, alpha and beta",
            values={
                name: f"{law.A:g} % (τ in Pa)^{law.alpha:g} (t in s)^{law.beta:g}, "
                f"of experiments from {law.least:g} to {law.most:g} Pa"
                for name, law in POWER_LAWS.items()
            },
        ),
    ]
    stress: Annotated[
        Literal["fluid", "KelvinVoigt", "morphology"],
        Meaning("`fluid`: μ γ̇; else of a [cell](models/haemolysis.md) that remembers the flow"),
    ] = "fluid"
    species: Annotated[
        str | None, Choice(SPECIES), Meaning("blood of the `pores`", default="human", values={})
    ] = None
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

    arrays: ClassVar = {
        **PathFunction.arrays,
        **dict.fromkeys(("dose", "peak", "cell"), per_particle),
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
        if self.species is not None and self.constants != "pores":
            raise InputError(f"has the constants of {self.constants} and species; constants pores takes it")

    @property
    def law(self) -> PowerLaw:
        """The constants; for pores the share is integrated without a power, within their range."""
        if self.constants == "own":
            return PowerLaw(float(self.A or 0.0), float(self.alpha or 0.0), float(self.beta or 0.0))
        if self.constants == "pores":
            return POWER_LAWS["Ding"]._replace(A=100.0, alpha=1.0, beta=1.0)
        return POWER_LAWS[self.constants]

    def begin(self, cloud: ObservedCloud) -> Memory:
        """Return cells at rest; raise InputError for a turning frame."""
        if self.stress == "morphology" and bool(getattr(cloud.cloud.flow, "rotating", ())):
            raise InputError("stress morphology does not turn with rotating zones: use KelvinVoigt")
        return super().begin(cloud)

    def initial(self, cloud: ObservedCloud) -> Memory:
        """Return integrals of zero, cells at rest and an empty table."""
        n = cloud.particles.size
        return {
            "dose": np.zeros(n),
            "history": np.empty((0, 4)),
            "peak": np.zeros(n),
            "warned": np.zeros(1),
            "cell": np.tile(_AT_REST[self.stress], (n, 1)),
        }

    @property
    def needs(self) -> frozenset[str]:
        """See :class:`PathFunction`."""
        return frozenset({"l0", "l1", "F0", "F1"} if self.stress == "morphology" else {"l0", "l1"})

    def add(self, memory: Memory, cloud: ObservedCloud, steps: Steps, fresh: NDArray[np.bool_]) -> None:
        """Advance the cells over the steps, and add to the integrals."""
        mu = np.empty((2, steps.n))
        for end, x in enumerate(steps.x):
            flow, l = cloud.cloud.flow, steps.both("l")[end]
            mu_f = viscosity_of(cloud.cloud.medium.mu, flow, x, steps.hosts[end], l, steps.t[end])
            mu[end] = mu_f if self.mu is None else self.mu
        # A step that a coupled patch divides has a host at one of its ends only.
        mu = np.where(np.isnan(mu), mu[::-1], mu)
        kind, h, exponent = _KINDS.index(self.stress), 0.0, self.law.alpha / self.law.beta
        if self.constants == "pores":
            pores = SPECIES[self.species or "human"]
            h, exponent = pores.of_stress if self.stress == "fluid" else pores.of_strain
        sums = memory["dose"], memory["peak"], memory["cell"]
        compiled(_harm)(steps.tables, fresh, mu, kind, h, exponent, self.f1, self.f2, *sums)

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


def _harm(
    tables: Floats,
    fresh: NDArray[np.bool_],
    mu: Floats,
    kind: int,
    pores: float,
    exponent: float,
    f1: float,
    f2: float,
    dose: Floats,
    peak: Floats,
    cell: Floats,
) -> None:
    """Add steps to the doses of their particles, Pa^exponent s, and to the largest stresses, Pa.

    ``pores`` is the h of pores, for which the dose is the share released; 0 for a power law.
    Cells with a memory are advanced in sub-steps of two halves each: Simpson's rule. ``mu`` is the viscosity
    at starts and ends, (2, n).
    """
    k = -1
    for steps in tables:
        for i in range(steps.shape[1]):
            k += 1
            if fresh[k]:
                row = int(steps[step.row, i])
                viscosity = mu[0, k], mu[1, k]
                _add_step(steps, i, viscosity, kind, pores, exponent, f1, f2, dose, peak, cell, row)


def _add_step(
    steps: Floats,
    k: int,
    viscosity: tuple[float, float],
    kind: int,
    pores: float,
    exponent: float,
    f1: float,
    f2: float,
    dose: Floats,
    peak: Floats,
    cell: Floats,
    row: int,
) -> None:
    """Add step k of a table to the row of its particle, see :func:`_harm`."""
    h = steps[step.t1, k] - steps[step.t0, k]
    l0, l1 = tensor_of(steps, step.l0, k), tensor_of(steps, step.l1, k)
    m0, m1 = viscosity
    # The flow is unknown at a particle that the mesh has lost, the viscosity at a coupled patch.
    l1 = l0 if math.isnan(l1[0]) else l1
    m0 = m1 if math.isnan(m0) else m0
    m1 = m0 if math.isnan(m1) else m1
    G0, G1 = shear_rate(l0), shear_rate(l1)
    if kind == _FLUID:
        dose[row] += 0.5 * h * (_rate(G0, m0, G0, pores, exponent) + _rate(G1, m1, G1, pores, exponent))
        peak[row] = max(peak[row], m0 * G0, m1 * G1)
        return
    if kind == _MORPHOLOGY and steps[step.passed, k] > 0.0:
        turn = dot(tensor_of(steps, step.F0, k), inverse(tensor_of(steps, step.F1, k - 1)))
        store_cell(cell, row, dot(turn, dot(load_cell(cell, row), transpose(turn))))
    n = max(math.ceil(h * (f1 + f2 * max(G0, G1)) / _LONGEST), 1)
    length = h / n
    rate = _rate(_effective(cell, row, kind, f1, f2), m0, G0, pores, exponent)
    for part in range(n):
        total, factor = rate, 4.0
        for half in range(2):
            a, b = (part + 0.5 * half) / n, (part + 0.5 * (half + 1)) / n
            g = _advance(cell, row, kind, l0, l1, (G0, G1), (a, b), 0.5 * length, f1, f2)
            mu = m0 + b * (m1 - m0)
            rate = _rate(g, mu, G0 + b * (G1 - G0), pores, exponent)
            total, factor = total + factor * rate, 1.0
        dose[row] += length / 6.0 * total
        peak[row] = max(peak[row], mu * g)


def _rate(G: float, mu: float, G_f: float, pores: float, exponent: float) -> float:
    """Return the rate of the dose at the effective shear rate G in the fluid of shear rate G_f, 1/s."""
    if pores > 0.0:
        return pores * (mu * G_f) ** exponent * pore_area(G)  # type: ignore[no-any-return]
    return float((mu * G) ** exponent)


def _effective(cell: Floats, row: int, kind: int, f1: float, f2: float) -> float:
    """Return the effective shear rate of a cell, 1/s."""
    if kind == _KELVIN_VOIGT:
        return cell[row, 0]  # type: ignore[no-any-return]
    return float(effective_shear_rate(_deformation(load_cell(cell, row)), f1, f2))


def _advance(
    cell: Floats,
    row: int,
    kind: int,
    l0: Tensor,
    l1: Tensor,
    G: tuple[float, float],
    shares: tuple[float, float],
    h: float,
    f1: float,
    f2: float,
) -> float:
    """Advance a cell by h, s, between two shares of a step; return its effective shear rate, 1/s.

    ``l0``, ``l1`` and ``G`` are the gradients of the fluid and its shear rates at both ends of the step, 1/s.
    """
    (a, b), (G0, G1) = shares, G
    if kind == _KELVIN_VOIGT:
        cell[row, 0] = relaxed(cell[row, 0], G0 + a * (G1 - G0), G0 + b * (G1 - G0), h, f1)
    else:
        first, last = mixed(l0, l1, a), mixed(l0, l1, b)
        S = morphology_step(load_cell(cell, row), first, last, h, Rates(f1, f2, f2))
        store_cell(cell, row, S)
    return _effective(cell, row, kind, f1, f2)


def load_cell(cell: Floats, row: int) -> Tensor:
    """Return the morphology tensor of a cell."""
    return (
        cell[row, 0], cell[row, 1], cell[row, 2], cell[row, 3], cell[row, 4],
        cell[row, 5], cell[row, 6], cell[row, 7], cell[row, 8],
    )  # fmt: skip


def store_cell(cell: Floats, row: int, S: Tensor) -> None:
    """Store the morphology tensor of a cell."""
    for c in range(9):
        cell[row, c] = S[c]


def mixed(S: Tensor, T: Tensor, share: float) -> Tensor:
    """Return S + share (T − S)."""
    return add(scale(1.0 - share, S), scale(share, T))


def _deformation(S: Tensor) -> float:
    """Return Taylor's D of the ellipsoid whose squared semi-axes are the eigenvalues of S."""
    mean = trace(S) / 3.0
    B = add_identity(S, -mean)
    size = math.sqrt(ddot(B, B) / 6.0)
    if size == 0.0:
        return 0.0
    angle = math.acos(min(max(0.5 * det(B) / size**3, -1.0), 1.0)) / 3.0
    largest, least = 2.0 * math.cos(angle), 2.0 * math.cos(angle + 2.0 * math.pi / 3.0)
    a, c = math.sqrt(mean + size * largest), math.sqrt(mean + size * least)
    return size * (largest - least) / ((a + c) * (a + c))
