"""Largest values on the paths of particles, and how many are beyond the range of the model."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from foamprb.body.material import MATERIALS
from foamprb.body.membrane import law_of, least_tensions
from foamprb.body.quadratic import steady_amplitude, steady_amplitude_of_drop
from foamprb.cloud.measures import shapes
from foamprb.cloud.state import Particles, Status
from foamprb.cloud.surroundings.largest import LARGEST
from foamprb.cloud.tracker import Models
from foamprb.flow.base import NEAR
from foamprb.run.checks import SMALL_REYNOLDS

Floats = NDArray[np.float64]

_LARGE_BULLET = 0.2
"""ε up to which the quadratic mode, of first order in the strain, was compared with finite elements."""
CURVED, _AT_AXIS = 0.1, 1.0
"""Curvature numbers from which the second mode of a shape counts, and of bodies that contain an axis."""
_MANY_CURVED, _MANY_AT_AXIS = 0.05, 0.01
"""Shares of such bodies from which the quadratic mode is proposed."""
_COMPRESSED = 0.01
"""Compression of a membrane over G_s above which it is reported."""
_EDGES = np.hstack([0.0, np.logspace(-12.0, 12.0, 2401), np.inf])
"""Bounds of the classes from which quantiles are taken."""
_MOST_LISTED = 10
_CLOSENESS = "closeness"
COLUMNS = {
    "maxD": "largest D",
    "maxShearRate": "largest shear rate, 1/s",
    "maxShearStress": "largest shear stress, Pa",
    "maxReynolds": "Reynolds number",
    "curvatureNumber": "curvature number",
    "maxBulletAmplitude": "bullet amplitude",
}
"""Largest values by the columns of ``fates``."""
_LINES = {**COLUMNS, _CLOSENESS: "smallest gap/radius"}


def are_curved(numbers: Floats) -> bool:
    """Return True if the quadratic mode is proposed for bodies with these largest curvature numbers."""
    return _need_mode(
        len(numbers), int(np.count_nonzero(numbers > CURVED)), int(np.count_nonzero(numbers > _AT_AXIS))
    )


def _need_mode(n: int, curved: int, at_axis: int) -> bool:
    return curved > _MANY_CURVED * n or at_axis > _MANY_AT_AXIS * n


def limits_of(material: str) -> dict[str, float]:
    """Return the limits of the model for bodies of a material, by the columns of ``fates``."""
    try:
        compared = MATERIALS[material].compared
    except KeyError:
        # Of a record: a solid of a user.
        compared = np.inf
    return {
        "maxD": compared,
        "maxReynolds": SMALL_REYNOLDS,
        "curvatureNumber": CURVED,
        "maxBulletAmplitude": _LARGE_BULLET,
    }


def mode_of(models: Models) -> bool | None:
    """Return whether bodies have the quadratic mode; None for membranes, of which none is known."""
    return None if MATERIALS[models.material].slides else models.has_quadratic


def path_values(
    p: Particles, rho: float, quadratic: bool | None, D: Floats | None = None
) -> dict[str, Floats]:
    """Return the largest values on the paths of particles by the names of their columns; NaN before release.

    Parameters
    ----------
    rho
        Density of the fluid, kg/m³.
    quadratic
        See :func:`mode_of`.
    D
        Taylor's deformation at the ends of the paths.
    """
    D = shapes(p)[1] if D is None else D
    columns = np.where(p.status == Status.PENDING, np.nan, p.largest.T)
    rate, stress = columns[LARGEST.shear_rate], columns[LARGEST.shear_stress]
    with np.errstate(divide="ignore", invalid="ignore"):
        # That where the stress is largest.
        mu = stress / rate
        gap = 1.0 / columns[LARGEST.closeness] - 1.0
    steady = np.full(p.size, np.nan) if quadratic is None else steady_amplitudes(p, mu)
    gap[(p.status == Status.STUCK) & (columns[LARGEST.closeness] > 0.0)] = 0.0
    return {
        "maxD": np.where(p.status == Status.PENDING, np.nan, np.fmax(columns[LARGEST.D], D)),
        "maxShearRate": rate,
        "maxShearStress": stress,
        "maxReynolds": np.where(rate == 0.0, 0.0, rho * 4.0 * p.R**2 * rate / mu),
        "minGap": gap,
        "curvatureNumber": curvature_numbers(p),
        "maxBulletAmplitude": columns[LARGEST.bullet] if quadratic else steady,
    }


def curvature_numbers(p: Particles) -> Floats:
    """Return a ⟨|S|⟩/⟨|E|⟩ on the paths of particles; NaN where the flow was not sampled.

    In a steady state this is ¹⁶⁄₇ |B|/|A| for a solid, 3.2 to 3.5 |B|/|A| for a drop.
    """
    with np.errstate(divide="ignore", invalid="ignore"):
        numbers: Floats = p.curved[:, 0] / p.curved[:, 1]
    return numbers


def steady_amplitudes(p: Particles, mu: Floats) -> Floats:
    """Return ε of the steady shape in the mean curvature on the paths, in a fluid of viscosity μ_f, Pa s."""
    with np.errstate(divide="ignore", invalid="ignore"):
        aS = p.curved[:, 0] / p.curved[:, 2]
        solid = steady_amplitude(mu, p.steady_modulus, p.eta, p.gamma / p.R, aS)
        drop = steady_amplitude_of_drop(mu, p.eta / mu, p.mu, aS)
    return np.asarray(np.where(p.drop > 0, drop, solid))


class Excess(NamedTuple):
    """Particles beyond a limit."""

    n: int
    first: tuple[int, ...]
    """The smallest numbers of them."""

    @classmethod
    def of(cls, numbers: NDArray[np.int64]) -> Excess:
        """Return the particles with some numbers."""
        return cls(len(numbers), tuple(np.sort(numbers)[:_MOST_LISTED].tolist()))

    def __str__(self) -> str:
        """Return the numbers as text."""
        more = ", …" if self.n > len(self.first) else ""
        return f"particle{'s' if self.n > 1 else ''} {', '.join(map(str, self.first))}{more}"


def excesses(numbers: NDArray[np.int64], values: Mapping[str, Floats], material: str) -> dict[str, Excess]:
    """Return the particles beyond each limit, from largest values on their paths."""
    return {name: Excess.of(numbers[values[name] > limit]) for name, limit in limits_of(material).items()}


def warnings_of(n: int, beyond: Mapping[str, Excess], material: str) -> list[str]:
    """Return a sentence for each limit of the model that some of n particles exceeded."""
    compared = limits_of(material)["maxD"]
    texts = {
        "maxD": f"D beyond {compared:g}, the largest with which {material} was compared",
        "maxBulletAmplitude": f"a bullet amplitude beyond {_LARGE_BULLET:g}, where a theory of first "
        "order in the strain ends",
    }
    return [
        f"{beyond[name].n} of {n} particles reached {text}: {beyond[name]} (column {name} of fates)."
        for name, text in texts.items()
        if beyond[name].n
    ]


def _wrinkled(p: Particles, material: str) -> tuple[int, float]:
    """Return how many membranes are compressed, and their least tension over G_s."""
    kind = MATERIALS[material]
    if kind.fluid or not kind.slides:
        return 0, 0.0
    tensions = least_tensions(p.F, *law_of(material))
    compressed = tensions[tensions < -_COMPRESSED]
    return len(compressed), float(compressed.min(initial=0.0))


class PathRecord(NamedTuple):
    """Distributions of the largest values on the paths of released particles."""

    n: int
    counts: Mapping[str, NDArray[np.int64]]
    """Number of particles in each class."""
    largest: Mapping[str, float]
    beyond: Mapping[str, Excess]
    """Particles beyond the limit of a column."""
    at_axis: int
    """Number of particles that stay within a radius of an axis, or of other places without strain."""
    wrinkled: tuple[int, float] = (0, 0.0)
    """Number of capsules with a compressed membrane at the end, and the least principal tension over G_s."""

    @classmethod
    def of(cls, p: Particles, rho: float, models: Models) -> PathRecord:
        """Return the record of some particles in a fluid of density ``rho``, kg/m³."""
        p = p.take(np.flatnonzero(p.status != Status.PENDING))
        values = path_values(p, rho, mode_of(models))
        values[_CLOSENESS] = 1.0 / (1.0 + values["minGap"])
        # Sums, unlike quantiles, are the same for any distribution of the particles.
        counts = {name: np.histogram(values[name], _EDGES)[0] for name in _LINES}
        return cls(
            p.size,
            counts,
            {name: float(np.fmax.reduce(values[name], initial=0.0)) for name in _LINES},
            excesses(p.number, values, models.material),
            int(np.count_nonzero(values["curvatureNumber"] > _AT_AXIS)),
            _wrinkled(p, models.material),
        )

    @classmethod
    def total(cls, records: Sequence[PathRecord]) -> PathRecord:
        """Return the record of the particles of several records."""
        beyond = {}
        for name in records[0].beyond:
            parts = [record.beyond[name] for record in records]
            first = sorted(number for part in parts for number in part.first)
            beyond[name] = Excess(sum(part.n for part in parts), tuple(first[:_MOST_LISTED]))
        return cls(
            sum(record.n for record in records),
            {name: np.sum([record.counts[name] for record in records], axis=0) for name in _LINES},
            {name: max(record.largest[name] for record in records) for name in _LINES},
            beyond,
            sum(record.at_axis for record in records),
            (
                sum(record.wrinkled[0] for record in records),
                min(record.wrinkled[1] for record in records),
            ),
        )

    def warnings(self, material: str) -> list[str]:
        """Return :func:`warnings_of`, and a sentence about membranes that wrinkle."""
        n, least = self.wrinkled
        wrinkled = (
            f"{n} of {self.n} capsules have a membrane that is compressed at the end, by up to {-least:.2g} "
            "G_s: it wrinkles there, which the model leaves out."
        )
        return [*warnings_of(self.n, self.beyond, material), *([wrinkled] if n else [])]

    def lines(self, affine: bool) -> list[str]:
        """Return lines with median, 99 % quantile and largest value; ``affine`` without a quadratic mode."""
        lines = []
        for name, text in _LINES.items():
            title = f"steady {text}" if affine and name == "maxBulletAmplitude" else text
            below, most = self.counts[name].cumsum(), self.largest[name]
            if below[-1] == 0:
                continue
            half, nearly = (
                min(_EDGES[np.searchsorted(below, share * below[-1]) + 1], most) for share in (0.5, 0.99)
            )
            if name == _CLOSENESS:
                # Classes begin at 0, which is no gap below NEAR.
                gaps = (f"{min(NEAR, 1.0 / max(x, 1e-9) - 1.0):.3g}" for x in (half, nearly, most))
                lines.append("{:24s} 50 % above {}, 99 % above {}, at least {}".format(title, *gaps))
            else:
                shares = f"50 % below {half:.3g}, 99 % below {nearly:.3g}, at most {most:.3g}"
                lines.append(f"{title:24s} {shares}")
        return lines

    def advice(self) -> str:
        """Return a proposal of the quadratic mode for affine bodies; empty if few bodies need it."""
        curved = self.beyond["curvatureNumber"].n
        if not _need_mode(self.n, curved, self.at_axis):
            return ""
        return (
            f"{curved} of {self.n} particles have curvature numbers over {CURVED:g}; {self.at_axis} of them "
            "stay within a radius of an axis. subModels { shapeModel quadratic; } computes the second mode "
            "of their shapes, here with a steady bullet amplitude of up to "
            f"{self.largest['maxBulletAmplitude']:.2g}."
        )
