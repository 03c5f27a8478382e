"""Rigid sphere near a plane wall: exact solutions in bispherical coordinates.

z = c sinh ξ/(cosh ξ − cos η), ρ = c sin η/(cosh ξ − cos η): the wall is ξ = 0, the sphere of radius 1 is
ξ = α with h = cosh α and c = sinh α. With harmonic functions Q, U₀, U₂ and w (Dean & O'Neill 1963),

    u_ρ = [½ ρQ + ½(U₀ + U₂)] cos φ,   u_φ = ½(U₂ − U₀) sin φ,   u_z = [½ zQ + w] cos φ,   p = Q cos φ

solve Stokes' equations of viscosity 1 if div u = 0. The divergence is harmonic, so it vanishes everywhere if
it does on both surfaces. The velocity there gives U₀, U₂ and w from Q, and the divergence there gives Q.

Across the wall the flow has a stream function ψ, u_z = −ψ_ρ/ρ and u_ρ = ψ_z/ρ, with modes in ξ for each
of P_{n−1}(cos η) − P_{n+1}(cos η) (Stimson & Jeffery 1926). Their values and slopes on the sphere follow from
those of ψ.
"""

from __future__ import annotations

from functools import cache
from typing import NamedTuple

import numpy as np

from validation.references import Floats


class Motion(NamedTuple):
    """Motion of a sphere along the wall."""

    speed: float
    """In shear, free of force and torque, over γ̇h."""
    spin: float
    """Over γ̇/2."""
    mobility: float
    """Speed by a force, free of torque, over that without the wall."""
    drag: float
    """Drag in translation without rotation, over that without the wall."""
    curved: float
    """Speed in the flow z² along the wall, free of force and torque, over h²."""


class Across(NamedTuple):
    """Motion of a sphere across the wall, free of force."""

    stagnation: float
    """Speed in the flow u_z = −z² that turns away from the wall, over that of the flow."""
    strain: float
    """Speed over the strain rate u_z = D (z − h) of its own surface, in a fluid at rest, and the radius."""


@cache
def sphere_across_wall(h: float) -> Across:
    """Return the motion of a sphere whose centre is h > 1 radii above the wall, to six digits."""
    n = np.arange(1, int(max(40, 30.0 / np.arccosh(h))) + 1)
    x, weights = np.polynomial.legendre.leggauss(3 * len(n) + 100)
    sine, c = np.sqrt(1.0 - x * x), np.sqrt(h * h - 1.0)
    to = h - x
    rho, z = c * sine / to, c * c / to
    rho_xi, z_xi = -c * rho / to, (h * to - c * c) * c / to**2
    P = np.polynomial.legendre.legvander(x, len(n) + 1).T
    modes = (P[:-2] - P[2:]) * (weights / (1.0 - x * x) * (0.5 * n * (n + 1) / (2 * n + 1))[:, None])
    # Modes of even exponents that vanish with their slopes on the wall, over exp((n + 3/2) α).
    p, q, alpha = n - 0.5, n + 1.5, np.arccosh(h)
    a, b, d = np.exp(-2.0 * alpha), np.exp(-(p + q) * alpha), np.exp(-2.0 * q * alpha)
    cosh_p, sinh_p, cosh_q, sinh_q = 0.5 * (a + b), 0.5 * (a - b), 0.5 * (1.0 + d), 0.5 * (1.0 - d)
    first, slope = cosh_p - cosh_q, p * sinh_p - q * sinh_q
    second, slope_2 = q * sinh_p - p * sinh_q, p * q * first

    def force(psi: Floats, along: Floats, across: Floats) -> float:
        value = modes @ (to**1.5 * psi)
        by_xi = rho * (along * z_xi - across * rho_xi)
        rate = modes @ (1.5 * c * np.sqrt(to) * psi + to**1.5 * by_xi)
        strength = (first * rate - slope * value) / (first * slope_2 - second * slope)
        return float(((2 * n + 1) * strength * np.exp(-q * alpha)).sum())

    by_motion = force(-0.5 * rho**2, 0.0 * z, 1.0 + 0.0 * z)
    by_flow = force(0.5 * (rho * z) ** 2, rho * z, -z * z)
    by_strain = force(-0.5 * rho**2 * (z - h), -0.5 * rho, z - h)
    return Across(-by_flow / by_motion / (h * h), -by_strain / by_motion)


@cache
def sphere_along_wall(h: float) -> Motion:
    """Return the motion of a sphere whose centre is h > 1 radii above the wall, to four digits."""
    wall, sphere = _surfaces(h, int(max(60, 18.0 / np.arccosh(h))))
    rho, z = (np.concatenate([getattr(wall, k), getattr(sphere, k)]) for k in ("rho", "z"))
    by_Q, by_U0, by_U2, by_w = (
        np.vstack(parts) for parts in zip(wall.divergence(), sphere.divergence(), strict=True)
    )
    # Where nothing moves, U₀ = U₂ = −½ ρQ and w = −½ zQ.
    system = by_Q - 0.5 * ((by_U0 + by_U2) * rho + by_w * z)
    weights = np.concatenate([wall.scale, sphere.scale])

    def load(along: Floats, across: Floats, drift: float, curved: float = 0.0) -> Floats:
        """Return force and torque of a flow with u_x = ``along``, u_z = ``across`` cos φ on the sphere.

        ``drift`` z + ``curved`` z² is added to u_x afterwards, which removes the motion from the sphere.
        """
        U0, w = np.concatenate([0.0 * along, 2.0 * along]), np.concatenate([0.0 * across, across])
        Q = np.linalg.lstsq(system * weights[:, None], -(by_U0 @ U0 + by_w @ w) * weights, rcond=1e-14)[0]
        U0, U2, w = U0 - 0.5 * rho * Q, -0.5 * rho * Q, w - 0.5 * z * Q
        return sphere.load(h, Q, U0, U2, w, drift, curved)

    r = sphere.z - h
    # Translation, rotation about y, and shear past the sphere at rest.
    loads = load(1.0 + 0.0 * r, 0.0 * r, 0.0), load(r, -sphere.rho, -1.0), load(-sphere.z, 0.0 * r, 1.0)
    resistance = np.stack(loads[:2], axis=1)
    U, spin = np.linalg.solve(resistance, -loads[2])
    by_force = np.linalg.solve(resistance, [-6.0 * np.pi, 0.0])
    curved = np.linalg.solve(resistance, -load(-(sphere.z**2), 0.0 * r, 0.0, 1.0))[0] / (h * h)
    drag = -loads[0][0] / (6.0 * np.pi)
    return Motion(float(U / h), float(2.0 * spin), float(by_force[0]), float(drag), float(curved))


class _Harmonic(NamedTuple):
    """Matrices (n, 2n) from the values of a harmonic function on both surfaces to one of them."""

    value: Floats
    xi: Floats
    """Derivative by ξ."""
    rho: Floats
    z: Floats


class _Surface(NamedTuple):
    """Wall or sphere, at Gauss' points in x = cos η."""

    x: Floats
    weights: Floats
    cosh: float
    sinh: float
    rho: Floats
    z: Floats
    functions: tuple[_Harmonic, ...]
    """Of the orders 0, 1 and 2 in φ."""

    @property
    def scale(self) -> Floats:
        """Weights of the divergence in the sum of its squares."""
        return np.asarray(np.sqrt(self.weights) * (self.cosh - self.x))

    def divergence(self) -> tuple[Floats, Floats, Floats, Floats]:
        """Return the matrices from Q, U₀, U₂ and w to div u/cos φ."""
        f0, f1, f2 = self.functions
        rho, z = self.rho[:, None], self.z[:, None]
        by_Q = 1.5 * f1.value + 0.5 * (rho * f1.rho + z * f1.z)
        return by_Q, 0.5 * f0.rho, 0.5 * (f2.rho + 2.0 / rho * f2.value), f1.z

    def load(
        self, h: float, Q: Floats, U0: Floats, U2: Floats, w: Floats, drift: float, curved: float
    ) -> Floats:
        """Return force along x and torque about y of the sphere: of the traction −p n + ∂u/∂n.

        A ``drift`` of 1 adds the shear flow (z, 0, 0), so that the fluid rests on the sphere; one of −1 takes
        off the sphere's rotation. ``curved`` of 1 adds the flow (z², 0, 0), so that the fluid rests too.
        """
        f0, f1, f2 = self.functions
        c, n = self.sinh, len(self.x)
        p = Q[n:]
        metric = c / (self.cosh - self.x)
        d_rho, d_z = -self.rho * metric, (self.cosh * (self.cosh - self.x) - c * c) / c * metric**2
        du_rho = 0.5 * (d_rho * p + self.rho * (f1.xi @ Q) + f0.xi @ U0 + f2.xi @ U2)
        du_phi = 0.5 * (f2.xi @ U2 - f0.xi @ U0)
        du_z = 0.5 * (d_z * p + self.z * (f1.xi @ Q)) + f1.xi @ w
        n_rho, n_z = self.rho, self.z - h
        p = p + 2.0 * curved * self.rho
        t_x = -n_rho * p - (du_rho - du_phi) / metric + 2.0 * (drift + 2.0 * curved * self.z) * n_z
        t_z = -n_z * p - du_z / metric - min(drift, 0.0) * n_rho
        area = np.pi * metric**2 * self.weights
        return np.array([(area * t_x).sum(), (area * (n_z * t_x - n_rho * t_z)).sum()])


def _surfaces(h: float, n: int) -> tuple[_Surface, _Surface]:
    """Return the wall and the sphere with n points each."""
    x, weights = np.polynomial.legendre.leggauss(n)
    sine, c = np.sqrt(1.0 - x * x), np.sqrt(h * h - 1.0)
    functions: list[list[_Harmonic]] = [[], []]
    for m in range(3):
        P, slope = (a.T for a in _legendre(n, m, x))
        k = m + np.arange(n) + 0.5
        kα = np.minimum(k * np.arccosh(h), 300.0)
        # From values on the surfaces to the coefficients of functions that are 1 on one, 0 on the other.
        roots = np.sqrt(1.0 - x), np.sqrt(h - x)
        analysis = [(P * weights[:, None] / root[:, None]).T for root in roots]
        for side, (cosh, sinh, root) in enumerate(((1.0, 0.0, roots[0]), (h, c, roots[1]))):
            near, far = k / np.tanh(kα), k / np.sinh(kα)
            on_wall, on_sphere = ((-near, far), (-far, near))[side]
            terms = root[:, None] * P
            value, by_eta = np.zeros((n, 2 * n)), np.zeros((n, 2 * n))
            own = slice(side * n, (side + 1) * n)
            value[:, own] = np.eye(n)
            by_x = root[:, None] * slope - P / (2.0 * root[:, None])
            by_eta[:, own] = -sine[:, None] * (by_x @ analysis[side])
            by_xi = np.hstack([(terms * on_wall) @ analysis[0], (terms * on_sphere) @ analysis[1]])
            by_xi[:, own] += (sinh / (2.0 * root))[:, None] * (P @ analysis[side])
            a, b = (1.0 - cosh * x)[:, None] / c, (sinh * sine)[:, None] / c
            functions[side].append(_Harmonic(value, by_xi, -b * by_xi - a * by_eta, a * by_xi - b * by_eta))
    at_wall = _Surface(x, weights, 1.0, 0.0, c * sine / (1.0 - x), 0.0 * x, tuple(functions[0]))
    return at_wall, _Surface(x, weights, h, c, c * sine / (h - x), c * c / (h - x), tuple(functions[1]))


def _legendre(n: int, m: int, x: Floats) -> tuple[Floats, Floats]:
    """Return the orthonormal P_k^m(x), k = m … m + n − 1, and their derivatives, (n, len(x)) each."""
    P = np.zeros((n, len(x)))
    norm = 0.5 * np.prod([(2.0 * k + 1.0) / (2.0 * k) for k in range(1, m + 1)])
    P[0] = np.sqrt(norm) * (1.0 - x * x) ** (m / 2)
    P[1] = np.sqrt(2.0 * m + 3.0) * x * P[0]
    for j in range(2, n):
        k = m + j
        b = np.sqrt(((k - 1.0) ** 2 - m * m) / (4.0 * (k - 1.0) ** 2 - 1.0))
        P[j] = np.sqrt((4.0 * k * k - 1.0) / (k * k - m * m)) * (x * P[j - 1] - b * P[j - 2])
    degree = (m + np.arange(n, dtype=float))[:, None]
    before = (2.0 * degree + 1.0) * (degree**2 - m * m) / (2.0 * degree - 1.0)
    lower = np.sqrt(before) * np.roll(P, 1, axis=0)
    lower[0] = 0.0
    return P, (degree * x * P - lower) / (x * x - 1.0)
