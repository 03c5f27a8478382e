"""Stress of capsules whose membrane slides under its tangential load; writes ``foamprb/body/membrane.txt``.

A point X of the unit sphere moves within the membrane to m(X) on the sphere, and with the body to x = V m, V
diagonal with the stretches exp h_i. E = ∫ w(C) dΩ is the energy of the surface metric C of X → x, per
G_s R². Fluid and liquid load the membrane by T·n with a uniform T. Their virtual work is that of the
membrane for affine and for sliding motions:

    T_i = dev (3/4π) ∂E/∂h_i,        ∂E/∂m·δm = ∫ m·T·δm dΩ_m  for every sliding δm.

m = y/|y|, where y_i is X_i times a polynomial of degree 2 in the squares of the other two components.
Newton's method follows the solution from the sphere outwards, for 7 angles of h and 16 sizes (2/3 Σ h²)^½ up
to 0.8.
The coefficients of φ₁ and φ₂ (:mod:`foamprb.body.membrane`) are fitted to T with its exact modulus at rest.
"""

from __future__ import annotations

import argparse
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

Floats = NDArray[np.float64]
Law = Callable[[Any, Any], Any]

ROOT = Path(__file__).resolve().parents[2]
FILE = ROOT / "foamprb/body/membrane.txt"
TABLED = (0.0, 0.5, 1.0, 2.0, 5.0, 10.0, 20.0, 50.0)
"""Values of Skalak's C."""
SIZES = np.arange(1, 17) * 0.05
_GAUSS, _DEGREE, _STEP, _SHIFT = 10, 2, 1e-30, 1e-6


def neo_hookean(I: Any, J: Any) -> Any:
    """Return w/G_s = ½(I + 1/J − 3) for I = tr C and J = det C."""
    return 0.5 * (I + 1.0 / J - 3.0)


def skalak(C: float) -> Law:
    """Return Skalak's w/G_s = ¼(i₁² + 2i₁ − 2i₂ + C i₂²), i₁ = I − 2, i₂ = J − 1."""

    def energy(I: Any, J: Any) -> Any:
        i1, i2 = I - 2.0, J - 1.0
        return 0.25 * (i1 * i1 + 2.0 * i1 - 2.0 * i2 + C * i2 * i2)

    return energy


def fields(X: Any) -> Any:
    """Return the fields y of unit coefficients at points (…, 3), (K, …, 3)."""
    q, all_fields = X * X, []
    for i, a, b in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        for total in range(_DEGREE + 1):
            for p in range(total + 1):
                y = np.zeros_like(X)
                y[..., i] = X[..., i] * q[..., a] ** p * q[..., b] ** (total - p)
                all_fields.append(y)
    return np.array(all_fields)


class Membrane:
    """Membrane on an ellipsoid; unknowns are coefficients of the tangential parts of the fields."""

    def __init__(self, energy: Law) -> None:
        self._energy = energy
        z, w = np.polynomial.legendre.leggauss(_GAUSS)
        u, w = 0.5 * (z + 1.0), 0.5 * w
        c, phi = (x.ravel() for x in np.meshgrid(u, 0.5 * np.pi * u, indexing="ij"))
        self._weights = 4.0 * np.pi * np.outer(w, w).ravel()
        s = np.sqrt(1.0 - c * c)
        X = np.stack([s * np.cos(phi), s * np.sin(phi), c], axis=-1)
        e = np.stack(
            [
                np.stack([c * np.cos(phi), c * np.sin(phi), -s], axis=-1),
                np.stack([-np.sin(phi), np.cos(phi), 0.0 * c], axis=-1),
            ]
        )
        B, dB = fields(X), fields(X + 1e-30j * e).imag / 1e-30
        tangential = B - X * (B * X).sum(axis=-1, keepdims=True)
        values, vectors = np.linalg.eigh(np.einsum("n,kni,lni->kl", self._weights, tangential, tangential))
        Z = vectors[:, values > 1e-7 * values.max()].T
        self._y0, self._dy0 = X, e
        self._B, self._dB = np.tensordot(Z, B, 1), np.tensordot(Z, dB, 1)
        self.n_unknowns = len(Z)

    def _map(self, q: Any) -> tuple[Any, Any]:
        """Return m and its two derivatives for unknowns q, (..., K)."""
        y, dy = self._y0 + np.tensordot(q, self._B, 1), self._dy0 + np.tensordot(q, self._dB, 1)
        r = np.sqrt((y * y).sum(axis=-1, keepdims=True))
        m = y / r
        m_, r_ = m[..., None, :, :], r[..., None, :, :]
        return m, (dy - m_ * (m_ * dy).sum(axis=-1, keepdims=True)) / r_

    def _metric(self, dm: Any, h: Any) -> tuple[Any, Any]:
        """Return tr C and det C of the map to the ellipsoid with log stretches h, (…, 3)."""
        f = dm * np.exp(h)[..., None, None, :]
        a, b = f[..., 0, :, :], f[..., 1, :, :]
        aa, ab, bb = (a * a).sum(axis=-1), (a * b).sum(axis=-1), (b * b).sum(axis=-1)
        return aa + bb, aa * bb - ab * ab

    def _energies(self, dm: Any, h: Any) -> Any:
        return self._energy(*self._metric(dm, h)) @ self._weights

    def stress(self, q: Floats, h: Floats) -> Floats:
        """Return the principal T, G_s/R."""
        _, dm = self._map(q)
        slopes = self._energies(dm, h + 1j * _STEP * np.eye(3)).imag / _STEP
        T: Floats = slopes * 3.0 / (4.0 * np.pi)
        return T - T.mean()

    def residual(self, q: Floats, h: Floats) -> Floats:
        """Return what the balance of sliding lacks, (K,)."""
        T = self.stress(q, h)
        m, dm = self._map(q)
        m_ih, dm_ih = self._map(q + 1j * _STEP * np.eye(self.n_unknowns))
        slopes = self._energies(dm_ih, h).imag / _STEP
        area = self._weights * np.sqrt(self._metric(dm, np.zeros(3))[1])
        return np.asarray(slopes - ((m * T) * (m_ih.imag / _STEP)).sum(axis=-1) @ area)

    def slide(self, q: Floats, h: Floats) -> Floats:
        """Return the unknowns at h from those nearby."""
        for _ in range(20):
            r = self.residual(q, h)
            if np.linalg.norm(r) < 1e-9:
                return q
            columns = [(self.residual(q + _SHIFT * e, h) - r) / _SHIFT for e in np.eye(self.n_unknowns)]
            step = -np.linalg.solve(np.array(columns).T, r)
            q = q + step * min(1.0, 0.3 / np.abs(step).max())
        raise ArithmeticError(f"no solution at h = {h}")

    def tensions(self, q: Floats, h: Floats) -> Floats:
        """Return the principal tensions at the points, (n, 2), G_s."""
        I, J = self._metric(self._map(q)[1], h)
        root = np.sqrt(np.maximum(0.25 * I * I - J, 0.0))
        squares = np.stack([0.5 * I + root, 0.5 * I - root], axis=-1)
        I_slope = self._energy(I + 1j * _STEP, J).imag / _STEP
        J_slope = self._energy(I, J + 1j * _STEP).imag / _STEP
        area = np.sqrt(J)[:, None]
        return np.asarray(2.0 * (I_slope[:, None] * squares + J_slope[:, None] * J[:, None]) / area)

    def table(self) -> Iterator[tuple[Floats, Floats, float]]:
        """Yield h, T and the least principal tension of all shapes."""
        third = 2.0 * np.pi / 3.0
        for psi in np.radians(range(0, 61, 10)):
            direction, q = np.cos([psi, psi - third, psi + third]), np.zeros(self.n_unknowns)
            for size in SIZES:
                h = size * direction
                q = self.slide(q, h)
                yield h, self.stress(q, h), float(self.tensions(q, h).min())


def fitted(h: Floats, T: Floats) -> tuple[Floats, float]:
    """Return c₁ and c₂, (20,), of T/μ (n, 3), and the largest error over |T|/μ."""
    b = np.exp(2.0 * h)
    X, Y = np.log(b.sum(axis=1) / 3.0), np.log((1.0 / b).sum(axis=1) / 3.0)
    powers = [X**i * Y ** (total - i) for total in range(4) for i in range(total + 1)]
    columns = np.array([[p[:, None] * t for p in powers] for t in (b, -1.0 / b)])
    columns -= columns.mean(axis=-1, keepdims=True)
    scale = np.linalg.norm(T, axis=1)
    first, second = columns / scale[:, None]
    # At rest φ₁ + φ₂ = 1.
    free = np.concatenate([[first[0] - second[0]], first[1:], second[1:]]).reshape(19, -1)
    target = (T / scale[:, None] - second[0]).ravel()
    size = np.linalg.norm(free, axis=1)
    c = np.linalg.lstsq((free / size[:, None]).T, target, rcond=1e-13)[0] / size
    error = np.linalg.norm((c @ free - target).reshape(-1, 3), axis=1).max()
    return np.concatenate([c[:10], [1.0 - c[0]], c[10:]]), float(error)


def row_of(C: float) -> tuple[Floats, float]:
    """Return a row of the file for C, NaN for neo-Hooke's law, and the error of the fit."""
    law = neo_hookean if np.isnan(C) else skalak(C)
    kappa = 3.0 if np.isnan(C) else 1.0 + 2.0 * C
    h, T, least = (np.array(column) for column in zip(*Membrane(law).table(), strict=True))
    c, error = fitted(h, T * (3.0 * kappa + 1.0) / (2.0 * kappa))
    return np.concatenate([[C], c, least]), error


def text_of(rows: list[Floats]) -> str:
    """Return the text of the file."""
    lines = [
        f"{row[0]:g} {' '.join(f'{x:.6f}' for x in row[1:21])} {' '.join(f'{x:.4f}' for x in row[21:])}"
        for row in rows
    ]
    return f"{_HEAD}{chr(10).join(lines)}\n"


def main() -> None:
    """Write the file and print the errors."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.parse_args()
    rows = []
    for C in (np.nan, *TABLED):
        row, error = row_of(C)
        rows.append(row)
        print(f"C = {C:g}: largest error of T {error:.2e}", flush=True)
    FILE.write_text(text_of(rows))


_HEAD = """# Membranes of foamprb.body.membrane, by tools/figures/membrane.py: C of Skalak's law, nan for
# neo-Hooke's; c_1 and c_2; the least principal tension over G_s, for the angles 0, 10, ... 60 degrees of the
# log stretches and for each the sizes 0.05, 0.1, ... 0.8.
"""

if __name__ == "__main__":
    main()
