"""Capillary numbers at which drops break up, for docs/models/drops.md: ours, and those of Stokes flow.

A drop as viscous as the fluid adds −(1/8πμ) ∫ 2σH n·G dA to the velocity of the flow. Its shape is
ln r = Σ c Y with the harmonics of even degree; the flow is increased until no steady shape follows.
"""

from __future__ import annotations

import argparse

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import brentq
from scipy.special import gammaln, lpmv

from foamprb.body.morphology import drop_growth

Floats = NDArray[np.float64]
FLOWS = {
    "shear": np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.0], [1.0, 0.0, 0.0]]),
    "extension": np.diag([-0.5, -0.5, 1.0]),
}
NUMBERS = {
    "shear": (0.3, 0.4, 0.42, 0.44),
    "extension": (0.06, 0.1, 0.115, 0.125),
}
BROKEN, STEADY, MOST = 3.6, 2e-4, 80.0
"""Largest radius, rate of change of the harmonics at which a shape is steady, and time in μ_f R/σ."""


class Drop:
    """A drop of radius, viscosity and surface tension 1 in a fluid of viscosity 1."""

    def __init__(self, degree: int, rings: int, around: int) -> None:
        x, weights = np.polynomial.legendre.leggauss(rings)
        theta, phi = np.meshgrid(np.arccos(x), 2.0 * np.pi * np.arange(around) / around, indexing="ij")
        t, p = theta.ravel(), phi.ravel()
        self.weights = np.repeat(weights, around) * (2.0 * np.pi / around)
        self.terms = _harmonics(degree, t, p)
        self.c = np.zeros(self.terms[0].shape[1])
        self.sine, self.cosine = np.sin(t)[:, None], np.cos(t)[:, None]
        zero, cos, sin = np.zeros_like(self.sine), np.cos(p)[:, None], np.sin(p)[:, None]
        self.e_r = np.hstack([self.sine * cos, self.sine * sin, self.cosine])
        self.e_t = np.hstack([self.cosine * cos, self.cosine * sin, -self.sine])
        self.e_p = np.hstack([-sin, cos, zero])

    def rates(self, gradient: Floats) -> Floats:
        """Return the rates of change of the coefficients in a linear flow."""
        q, q_t, q_p, q_tt, q_tp, q_pp = (term @ self.c for term in self.terms)
        r = np.exp(q)[:, None]
        r_t, r_p = r * q_t[:, None], r * q_p[:, None]
        r_tt, r_tp, r_pp = (r * a[:, None] for a in (q_tt + q_t * q_t, q_tp + q_t * q_p, q_pp + q_p * q_p))
        e_r, e_t, e_p, s, c = self.e_r, self.e_t, self.e_p, self.sine, self.cosine
        x, x_t, x_p = r * e_r, r_t * e_r + r * e_t, r_p * e_r + r * s * e_p
        x_tt = (r_tt - r) * e_r + 2.0 * r_t * e_t
        x_tp = r_tp * e_r + r_p * e_t + (r_t * s + r * c) * e_p
        x_pp = r_pp * e_r + 2.0 * r_p * s * e_p - r * s * (s * e_r + c * e_t)
        n = np.cross(x_t, x_p)
        area = np.linalg.norm(n, axis=1)
        n /= area[:, None]
        E, F, G = ((a * b).sum(axis=1) for a, b in ((x_t, x_t), (x_t, x_p), (x_p, x_p)))
        e, f, g = ((a * n).sum(axis=1) for a in (x_tt, x_tp, x_pp))
        # Twice the mean curvature; its value at the target may be subtracted, as ∫ n·G dA = 0.
        bend = (2.0 * f * F - e * G - g * E) / (E * G - F * F)
        way = x[:, None] - x[None]
        distance = np.linalg.norm(way, axis=2)
        np.fill_diagonal(distance, np.inf)
        strength = (bend[None] - bend[:, None]) * (area / s[:, 0] * self.weights) / distance
        along = (way * n[None]).sum(axis=2) * strength / distance**2
        u = x @ gradient.T - (strength @ n + (along[:, :, None] * way).sum(axis=1)) / (8.0 * np.pi)
        slope = e_r - r_t / r * e_t - r_p / (r * s) * e_p
        return np.asarray(self.terms[0].T @ (self.weights * (u * slope).sum(axis=1) / r[:, 0]))

    def step(self, gradient: Floats, h: float) -> float:
        """Take a step of the midpoint rule; return the largest rate."""
        start = self.c
        self.c = start + 0.5 * h * self.rates(gradient)
        rates = self.rates(gradient)
        self.c = start + h * rates
        volume = (self.weights * self.radii() ** 3).sum() / (4.0 * np.pi)
        self.c[0] -= np.log(volume) / 3.0 * np.sqrt(4.0 * np.pi)
        return float(abs(rates).max())

    def radii(self) -> Floats:
        """Return the distances of the points from the centre."""
        return np.asarray(np.exp(self.terms[0] @ self.c))


def _harmonics(degree: int, t: Floats, p: Floats) -> list[Floats]:
    """Return the real harmonics, and their derivatives by t, p, tt, tp and pp, (points, terms) each."""
    columns: list[tuple[Floats, ...]] = []
    small = 1e-4
    for n in range(0, degree + 1, 2):
        for m in range(n + 1):
            norm = np.sqrt((2 * n + 1) / (4.0 * np.pi) * np.exp(gammaln(n - m + 1) - gammaln(n + m + 1)))
            norm *= np.sqrt(2.0) if m else 1.0
            f, after, before = (norm * lpmv(m, n, np.cos(t + d)) for d in (0.0, small, -small))
            f_t = (after - before) / (2.0 * small)
            f_tt = (m * m / np.sin(t) ** 2 - n * (n + 1)) * f - f_t / np.tan(t)
            for g, g_p in ((np.cos(m * p), -m * np.sin(m * p)), (np.sin(m * p), m * np.cos(m * p)))[
                : 1 + (m > 0)
            ]:
                columns.append((f * g, f_t * g, f * g_p, f_tt * g, f_t * g_p, -m * m * f * g))
    return [np.stack(part, axis=1) for part in zip(*columns, strict=True)]


def stokes(name: str, degree: int, rings: int, around: int) -> None:
    """Print the steady shapes in Stokes flow up to the first capillary number without one."""
    drop = Drop(degree, rings, around)
    for Ca in NUMBERS[name]:
        time, longest, rate = 0.0, 1.0, np.inf
        while rate > STEADY and time < MOST and longest < BROKEN:
            rate, time = drop.step(Ca * FLOWS[name], 0.15), time + 0.15
            longest = float(drop.radii().max())
        state = "breaks up" if not longest < BROKEN else "steady" if rate <= STEADY else "slow"
        print(f"{name}, Ca = {Ca:g}: {state}, longest radius {longest:.3f} R", flush=True)
        if state == "breaks up":
            return


def ours(gradient: Floats, ratio: float) -> float:
    """Return the capillary number of the model, infinite if it always has a steady shape."""

    def excess(Ca: float) -> float:
        growing, limit = drop_growth(tuple(gradient.ravel()), ratio, Ca)  # type: ignore[arg-type]
        return float(np.linalg.eigvals(np.reshape(growing, (3, 3))).real.max() - limit)

    return float(brentq(excess, 1e-3, 50.0)) if excess(50.0) > 0.0 else np.inf


def main() -> None:
    """Print the numbers."""
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawTextHelpFormatter, add_help=False
    )
    parser.add_argument("-help", "--help", action="help", help="show this text and stop")
    parser.add_argument("-stokes", action="store_true", help="also in Stokes flow, which takes half an hour")
    parsed = parser.parse_args()
    for name, gradient in FLOWS.items():
        numbers = ", ".join(f"{ours(gradient, ratio):.3f}" for ratio in (0.1, 1.0, 2.0, 3.0, 5.0))
        print(f"{name}, model, λ = 0.1, 1, 2, 3, 5: {numbers}")
    if parsed.stokes:
        stokes("extension", 10, 24, 24)
        stokes("shear", 14, 24, 48)


if __name__ == "__main__":
    main()
