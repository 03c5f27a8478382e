"""Margination of measured cells in a channel: how far they come to the axis (beyond the paper).

``python tools/validation/margination.py`` prints the numbers of docs/tutorials/shear-cytometry.md,
in some minutes. Cells at the inlet are those of histograms of R. Gerum et al., eLife 11 (2022) e78823, read
from the vectors of ``figures/figure_margination_histogram.pdf`` in github.com/fabrylab/Deformation_Cytometer.
They drift by the quadratic mode, in the middle plane of a square channel; walls are left out.
"""

from __future__ import annotations

import argparse
import sys
from pathlib import Path
from typing import Any

import numpy as np
from scipy.sparse import coo_matrix
from scipy.sparse.linalg import spsolve

from foamprb.body.memory import times_of_power_law
from foamprb.body.viscosity import cross_power_law
from foamprb.cloud.block import Medium
from foamprb.cloud.cloud import Cloud
from foamprb.cloud.state import spheres
from foamprb.cloud.surroundings.faxen import FaxenCorrection
from foamprb.cloud.tracker import Models
from foamprb.cloud.viscosity import CrossPowerLaw
from foamprb.flow import analytic
from foamprb.run.release import with_power_law

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from validation.case import Floats
from validation.cytometry import ALGINATE, ALPHA, LENGTH, WIDTH, K

RADIUS = 8.4e-6
"""Of a cell at rest, m: half of the median of √(4 area/π) of 21 281 cells."""
INLET = {
    1: (0.1020, 0.1723, 0.1422, 0.1364, 0.1198, 0.0970, 0.1204, 0.1044, 0.0055),
    2: (0.0942, 0.1545, 0.1469, 0.1381, 0.1403, 0.1091, 0.1018, 0.1133, 0.0019),
    3: (0.0813, 0.1509, 0.1539, 0.1527, 0.1326, 0.1177, 0.0996, 0.1069, 0.0045),
}
"""By pressure, bar: shares of the cells at the inlet by |y|, in bins of 10.526 µm around 0."""
PLACES = 1e-6 * np.array([4.0, 10.0, 20.0, 30.0, 40.0, 50.0, 60.0, 70.0, 80.0])
"""Distances from the axis at which the drift is computed, m."""
_APART = 1e-3
"""Distance of channels that are computed together, m."""
_STEPS = 2000
"""Of 1 ms; the last fifth has the drift."""
MEASURED = {1: (0.775, 0.009), 2: (0.868, 0.010), 3: (0.861, 0.008)}
"""By pressure, bar: mean |y| at the outlet over that at the inlet, and its standard error."""
_BIN = 200e-6 / 19.0
_TERMS = 5


def velocity_in_channel(pressure: float, law: dict[str, float], n: int = 60) -> tuple[float, ...]:
    """Return the coefficients of :func:`channels_flow`, of ∇·(μ ∇u) = −Δp/L in a square, by finite volumes.

    ``pressure`` is Δp, Pa; ``law`` that of :func:`cross_power_law`; a quarter of the square has n × n cells.
    """
    h, half = 0.5 * WIDTH / n, 0.5 * WIDTH
    index = np.arange(n * n).reshape(n, n)
    u = np.zeros((n, n))
    for _ in range(60):
        # The velocity is even at the axis and 0 at the wall.
        padded_y = np.concatenate([u[:1], u, -u[-1:]])
        padded_z = np.concatenate([u[:, :1], u, -u[:, -1:]], axis=1)
        dy, dz = np.gradient(padded_y, h, axis=0)[1:-1], np.gradient(padded_z, h, axis=1)[:, 1:-1]
        mu = cross_power_law(np.hypot(dy, dz), **law)
        rows: list[Any] = []
        columns: list[Any] = []
        values: list[Any] = []
        diagonal = np.zeros((n, n))
        for a, b in ((np.s_[:-1, :], np.s_[1:, :]), (np.s_[:, :-1], np.s_[:, 1:])):
            face = 2.0 * mu[a] * mu[b] / (mu[a] + mu[b])
            for p, q in ((a, b), (b, a)):
                rows.append(index[p].ravel())
                columns.append(index[q].ravel())
                values.append(-face.ravel())
                diagonal[p] += face
        diagonal[-1, :] += 2.0 * mu[-1, :]
        diagonal[:, -1] += 2.0 * mu[:, -1]
        rows.append(index.ravel())
        columns.append(index.ravel())
        values.append(diagonal.ravel())
        A = coo_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns)))).tocsr()
        new = spsolve(A, np.full(n * n, h * h * pressure / LENGTH)).reshape(n, n)
        change, u = np.abs(new - u).max() / new.max(), new
        if change < 1e-8:
            break
    y = ((np.arange(n) + 0.5) * h / half) ** 2
    base = (1.0 - y)[:, None] * (1.0 - y)
    terms = [base * np.multiply.outer(y**i, y**j) for i in range(_TERMS) for j in range(_TERMS)]
    M = np.reshape(terms, (_TERMS**2, -1)).T
    c = np.linalg.lstsq(M, u.ravel(), rcond=None)[0]
    return tuple(c.tolist())


def channels_flow(c: tuple[float, ...]) -> Any:
    """Return the flows along x in square channels around y = 0, z = 0, 1 mm, 2 mm …, without their walls."""
    half = 0.5 * WIDTH

    def velocity(x: float, y: float, z: float) -> tuple[float, float, float]:
        number = int(min(max(z / _APART + 0.5, 0.0), 2.0))
        first, away = 25 * number, z - _APART * number
        Y, Z = y * y / (half * half), away * away / (half * half)
        total = 0.0
        for i in range(4, -1, -1):
            inner = 0.0
            for j in range(4, -1, -1):
                inner = inner * Z + c[first + 5 * i + j]
            total = total * Y + inner
        return (1.0 - Y) * (1.0 - Z) * total, 0.0 * x, 0.0 * x

    return analytic.function(velocity, length=1e-4)


def drifts() -> tuple[Floats, Floats]:
    """Return dy/dx of cells at :data:`PLACES` in the middle plane at 1, 2 and 3 bar, (3, n), and their D."""
    c = [velocity_in_channel(1e5 * bar, ALGINATE) for bar in INLET]
    x = np.zeros((3, len(PLACES), 3))
    x[..., 1], x[..., 2] = PLACES, _APART * np.arange(3.0)[:, None]
    p = spheres(x.reshape(-1, 3), d=2.0 * RADIUS, rho=1e3, mu=1.0, poissons_ratio=0.4999)
    n = p.size
    p = with_power_law(p, np.full(n, K), np.full(n, ALPHA), times_of_power_law(1e-3, 10.0), 1.0)
    models = Models(
        integrator="stokes", shape="quadratic", surroundings=(FaxenCorrection(),), forces=(), stride=None,
        tolerance=1e-3,
    )  # fmt: skip
    fluid = CrossPowerLaw(mu0=ALGINATE["mu0"], muInf=0.0, m=ALGINATE["m"], n=ALGINATE["n"])
    flow = channels_flow(tuple(v for each in c for v in each))
    cloud = Cloud(p, flow, Medium(fluid, 1e3, (0.0, 0.0, 0.0)), (), 1e-3, models)
    cloud.advance(_STEPS - _STEPS // 5)
    before = cloud.particles.x.copy()
    cloud.advance(_STEPS // 5)
    way = cloud.particles.x - before
    return (way[:, 1] / way[:, 0]).reshape(3, -1), cloud.particles.D.reshape(3, -1)


def contraction(pressure: int, slope: Floats) -> float:
    """Return mean |y| at the outlet over that at the inlet, for dy/dx at :data:`PLACES`, (n,)."""
    share = (np.arange(40) + 0.5) / 40.0
    edges = _BIN * np.maximum(np.arange(10) - 0.5, 0.0)
    y = (edges[:-1, None] + share * np.diff(edges)[:, None]).ravel()
    weight = np.repeat(INLET[pressure], 40)
    start, n = weight @ y, 500
    for _ in range(n):
        # Near the axis dy/dx is proportional to y.
        rate = np.interp(y, PLACES, slope / PLACES)
        middle = y * (1.0 + 0.5 * LENGTH / n * rate)
        y = y + LENGTH / n * middle * np.interp(middle, PLACES, slope / PLACES)
    return float(weight @ y / start)


def main() -> None:
    """Print the contraction by the model beside the measured one."""
    parser = argparse.ArgumentParser(description=(__doc__ or "").splitlines()[0], add_help=False)
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    for bar, slope, deformation in zip(INLET, *drifts(), strict=True):
        ours, (measured, error) = contraction(bar, slope), MEASURED[bar]
        print(
            f"{bar} bar: mean |y| at the outlet over that at the inlet {ours:.3f}, measured {measured} ± "
            f"{error}; -ln {-np.log(ours):.3f}, {-np.log(measured):.3f}; D up to {deformation.max():.2f}"
        )


if __name__ == "__main__":
    main()
