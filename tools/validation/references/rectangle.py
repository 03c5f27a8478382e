"""Lift by inertia of the fluid on a small neutral sphere in a rectangular duct, by modes along the duct.

As in :mod:`validation.references.tube`, the sphere's stresslet in the flow U(y, z) makes a Stokes flow v,
whose inertia f = (U − U₀) ∂v/∂x + v·∇U pushes the sphere with −6πa ρ ∫ G·f dV, where G is the Stokes flow
of a unit force across. Both flows vanish on the walls. The section is |y| < A, |z| < 1, and U is 1 − z² for
A → ∞.

For each wave number k along the duct a flow is (iX, Y, Z) exp(ikx) with the pressure p:

    (k² − ∇²) X + k p = f_X,   (k² − ∇²) (Y, Z) + ∇p = (f_Y, f_Z),   −k X + ∂Y/∂y + ∂Z/∂z = 0.

It is the flow in infinite space (Bessel functions K) less a smooth flow with the same values on the walls,
which a spectral method of Legendre polynomials solves. One factorisation of a wave number serves all places.
"""

from __future__ import annotations

from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.polynomial import legendre
from scipy.linalg import cho_factor, cho_solve, eigh
from scipy.special import k0, k1

from validation.case import Floats

_TERMS = (np.arange(300) + 0.5) * np.pi
_NODES, _WEIGHTS = legendre.leggauss(12)
_WAVES, _WAVE_WEIGHTS = legendre.leggauss(6)
_PANELS = (0.0, 1e-4, 1e-3, 1e-2, 0.05, 0.2, 0.6, 1.0)
"""Parts of the distance from the sphere to a wall, dense at the sphere."""


def profile(y: Floats, z: Floats, A: float) -> tuple[Floats, Floats, Floats]:
    """Return U, ∂U/∂y and ∂U/∂z, each (n, m), at the points y (n,) by z (m,)."""
    k = _TERMS[:, None]
    weights = np.where(np.arange(len(_TERMS)) % 2, -4.0, 4.0)[:, None] / k**3
    decay = np.exp(-k * (A - np.abs(y)))
    mirror = np.exp(-2.0 * k * np.abs(y))
    side = weights * decay / (1.0 + np.exp(-2.0 * k * A))
    even, odd = side * (1.0 + mirror), side * (1.0 - mirror) * np.sign(y)
    U = 1.0 - z * z - even.T @ np.cos(k * z)
    return U, -(k * odd).T @ np.cos(k * z), -2.0 * z + (k * even).T @ np.sin(k * z)


def wall_rate(A: float) -> float:
    """Return the shear rate in the middle of the long walls; 2 for A → ∞."""
    return -float(profile(np.zeros(1), np.ones(1), A)[2][0, 0])


class _Line(NamedTuple):
    """One direction of the section, |x| < length."""

    length: float
    nodes: Floats
    """(n + 1,), of Gauss, Legendre and Lobatto."""
    mass: Floats
    stiffness: Floats
    """(n + 1, n + 1)."""
    squares: Floats
    vectors: Floats
    """Eigenvalues (n − 1,) and eigenvectors within the walls, (n − 1, n − 1)."""
    values: Floats
    slopes: Floats
    """∫ P_m φ dx and ∫ P_m φ' dx of Legendre's polynomials with the functions of nodes, (n − 1, n + 1)."""

    def at(self, x: Floats) -> Floats:
        """Return the matrix (m, n + 1) that interpolates from the nodes to x (m,)."""
        n = len(self.nodes) - 1
        return np.asarray(np.linalg.solve(legendre.legvander(self.nodes / self.length, n).T,
                                          legendre.legvander(x / self.length, n).T).T)  # fmt: skip


def _line(n: int, length: float) -> _Line:
    """Return a direction with n + 1 nodes."""
    last = legendre.Legendre.basis(n)
    x = np.concatenate([[-1.0], np.sort(last.deriv().roots().real), [1.0]])
    mass = 2.0 / (n * (n + 1) * last(x) ** 2) * length
    vander = legendre.legvander(x, n)
    derivatives = np.array([legendre.legval(x, legendre.legder(row)) for row in np.eye(n + 1)]).T
    D = np.linalg.solve(vander.T, derivatives.T).T / length
    stiffness = D.T @ (mass[:, None] * D)
    inner = slice(1, n)
    squares, vectors = eigh(stiffness[inner, inner], np.diag(mass[inner]))
    # The products have degrees of at most 2n − 1, which the rule of Lobatto integrates exactly.
    tests = vander[:, : n - 1].T * np.sqrt(np.arange(n - 1) + 0.5)[:, None] * mass
    return _Line(length, length * x, mass, stiffness, squares, vectors, tests, tests @ D)


class _Modes:
    """Stokes flow of one wave number with given velocities on the walls."""

    def __init__(self, k: float, y: _Line, z: _Line) -> None:
        self.k, self.lines = k, (y, z)
        inner = slice(1, -1)
        self.reduced = [
            (-k, y.values[:, inner] @ y.vectors, z.values[:, inner] @ z.vectors),
            (1.0, y.slopes[:, inner] @ y.vectors, z.values[:, inner] @ z.vectors),
            (1.0, y.values[:, inner] @ y.vectors, z.slopes[:, inner] @ z.vectors),
        ]
        self.inverse = 1.0 / (k * k + y.squares[:, None] + z.squares)
        self.factors = []
        for part in ((0, 0), (0, 1), (1, 0), (1, 1)):
            total: Any = 0.0
            for weight, a, b in self.reduced:
                a, b = a[part[0] :: 2], b[part[1] :: 2]
                # Σ a_ip a_kp (Σ b_jq b_lq inverse_pq), a product of (i k) × p and p × (j l).
                sums = np.einsum("jq,pq,lq->pjl", b, self.inverse, b, optimize=True)
                product = (a[:, None] * a[None]).reshape(-1, a.shape[1]) @ sums.reshape(len(sums), -1)
                n, m = len(a), len(b)
                total = total + weight * weight * product.reshape(n, n, m, m).transpose(0, 2, 1, 3)
            n = total.shape[0] * total.shape[1]
            total = total.reshape(n, n)
            self.factors.append((part, cho_factor(total)))

    def solve(self, walls: Floats) -> Floats:
        """Return X, Y, Z at the nodes, (m, 3, n, n'), from their values on the walls; others are 0."""
        y, z = self.lines
        source = self.k * y.values @ walls[:, 0] @ z.values.T
        source -= y.slopes @ walls[:, 1] @ z.values.T + y.values @ walls[:, 2] @ z.slopes.T
        load = self.k**2 * y.mass[:, None] * walls * z.mass
        load += y.stiffness @ walls * z.mass + y.mass[:, None] * (walls @ z.stiffness)
        load = -y.vectors.T @ load[:, :, 1:-1, 1:-1] @ z.vectors
        particular = load * self.inverse
        for c, (w, a, b) in enumerate(self.reduced):
            source -= w * a @ particular[:, c] @ b.T
        p = np.empty_like(source)
        for (i, j), factor in self.factors:
            part = source[:, i::2, j::2]
            p[:, i::2, j::2] = cho_solve(factor, part.reshape(len(part), -1).T).T.reshape(part.shape)
        flow = walls.copy()
        for c, (w, a, b) in enumerate(self.reduced):
            within = (load[:, c] + w * (a.T @ p @ b)) * self.inverse
            flow[:, c, 1:-1, 1:-1] += y.vectors @ within @ z.vectors.T
        return flow


def _unbounded(k: float, y: Floats, z: Floats) -> Floats:
    """Return X, Y, Z, (4, 3, …), of unit forces along y and z and of the stresslets xy and xz."""
    r = np.hypot(y, z)
    g, slope = k0(k * r) / (2.0 * np.pi), -k * k1(k * r) / (2.0 * np.pi * r)
    # h has (k² − ∇²) h = g; its derivatives.
    h_y, h_z = -0.5 * y * g, -0.5 * z * g
    bend = -0.5 * slope
    h_yy, h_yz, h_zz = y * y * bend - 0.5 * g, y * z * bend, z * z * bend - 0.5 * g
    return np.array([
        [k * h_y, g + h_yy, h_yz],
        [k * h_z, h_yz, g + h_zz],
        [2.0 * k * k * h_y - y * slope, k * g + 2.0 * k * h_yy, 2.0 * k * h_yz],
        [2.0 * k * k * h_z - z * slope, 2.0 * k * h_yz, k * g + 2.0 * k * h_zz],
    ])  # fmt: skip


def _quarter(length: float) -> tuple[Floats, Floats]:
    """Return points and weights from 0 to ``length``, dense at 0."""
    edges = length * np.array(_PANELS)
    middle, half = 0.5 * (edges[1:] + edges[:-1])[:, None], 0.5 * np.diff(edges)[:, None]
    return (middle + half * _NODES).ravel(), (half * _WEIGHTS).ravel()


def _place(k: float, flow: Floats, place: Floats, y: _Line, z: _Line) -> Floats:
    """Return ∫ [−k (U − U₀) (X̂X + ŶY + ẐZ) + X̂ v·∇U] dA, (2, 2), of each force and stresslet at a place."""
    total = np.zeros((2, 2))
    U0 = profile(place[:1], place[1:], y.length)[0]
    for sign_y in (-1.0, 1.0):
        reach = y.length - sign_y * place[0]
        a, weights_a = _quarter(min(reach, 25.0 / k))
        at_y = y.at(place[0] + sign_y * a)
        for sign_z in (-1.0, 1.0):
            b, weights_b = _quarter(min(z.length - sign_z * place[1], 25.0 / k))
            fields = _unbounded(k, sign_y * a[:, None], sign_z * b[None, :])
            fields -= at_y @ flow @ z.at(place[1] + sign_z * b).T
            U, U_y, U_z = profile(place[0] + sign_y * a, place[1] + sign_z * b, y.length)
            weights = weights_a[:, None] * weights_b
            forces, stresslets = fields[:2], fields[2:]
            total -= k * np.einsum("icyz,jcyz,yz->ij", forces, stresslets, (U - U0) * weights, optimize=True)
            carried = stresslets[:, 1] * U_y + stresslets[:, 2] * U_z
            total += np.einsum("iyz,jyz,yz->ij", forces[:, 0], carried, weights, optimize=True)
    return total


def coefficients(places: Floats, A: float, orders: tuple[int, int], most: float = 96.0) -> Floats:
    """Return C_y and C_z, (n, 2), of C ρ_f γ̇² R⁴ outwards with the shear rate γ̇ of :func:`wall_rate`.

    Parameters
    ----------
    places
        (n, 2), y and z over half of the short side.
    A
        Long side over the short one.
    orders
        Of the polynomials along y and z.
    most
        Largest wave number; the sum is continued as 1/k².
    """
    y, z = _line(orders[0], A), _line(orders[1], 1.0)
    edges = [0.0, *(most / 2.0**n for n in range(8, -1, -1))]
    sums, last = np.zeros((len(places), 2, 2)), np.zeros((len(places), 2, 2))
    waves = [
        (0.5 * (low + high) + 0.5 * (high - low) * x, 0.5 * (high - low) * w)
        for low, high in pairwise(edges)
        for x, w in zip(_WAVES, _WAVE_WEIGHTS, strict=True)
    ]
    rim = np.ones((len(y.nodes), len(z.nodes)), dtype=bool)
    rim[1:-1, 1:-1] = False
    on_y, on_z = (grid[rim] for grid in np.meshgrid(y.nodes, z.nodes, indexing="ij"))
    for k, weight in [*waves, (most, 0.0)]:
        walls = np.zeros((len(places), 4, 3, *rim.shape))
        for place, values in zip(places, walls, strict=True):
            values[:, :, rim] = _unbounded(k, on_y - place[0], on_z - place[1])
        flows = _Modes(k, y, z).solve(walls.reshape(-1, 3, *rim.shape)).reshape(walls.shape)
        for i, place in enumerate(places):
            last[i] = _place(k, flows[i], place, y, z)
            sums[i] += weight * last[i]
    sums += most * last
    gradients = np.array([[g[0, 0] for g in profile(p[:1], p[1:], A)[1:]] for p in places])
    return np.asarray(-20.0 * np.pi / wall_rate(A) ** 2 * np.einsum("nij,nj->ni", sums, gradients))
