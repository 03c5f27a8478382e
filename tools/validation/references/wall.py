"""Bodies near a plane no-slip wall, and Brownian motion: independent of foamprb's own code.

The wall is the plane x₃ = 0 with the fluid above it; the fluid's viscosity is 1, and so is, where not said
otherwise, the radius of the sphere of the body's volume. Vectors are arrays (3,), tensors (3, 3).
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from validation.references import Floats, soft

IDENTITY = np.eye(3)
NORMAL = np.array([0.0, 0.0, 1.0])
SHEAR_OVER_WALL = np.outer([1.0, 0.0, 0.0], NORMAL)
"""∂u_i/∂x_j of u₁ = γ̇ x₃, γ̇ = 1."""
_MIRROR = np.array([1.0, 1.0, -1.0])

# --- Published numbers --------------------------------------------------------------------------------------

GOLDMAN_COX_BRENNER = ((10.0677, 1.0591), (3.7622, 1.1738), (2.3524, 1.3079), (1.5431, 1.5675))
"""h/R, and the drag on a sphere that moves along the wall without turning, over 6πμRU (1967, Table 2)."""


def brenner_drag(h: float, terms: int = 200) -> float:
    """Return the drag on a sphere moving towards the wall, over 6πμRU, by Brenner's (1961) series.

    (4/3) sinh α Σ n(n+1)/((2n−1)(2n+3)) [(2 sinh mα + m sinh 2α)/(4 sinh²(mα/2) − m² sinh²α) − 1], m = 2n+1,
    with cosh α = h/R.
    """
    alpha = np.arccosh(h)
    n = np.arange(1.0, terms + 1.0)
    m = 2.0 * n + 1.0
    # Divided by exp(2n+1)α, that nothing overflows.
    scale = np.exp(-m * alpha)
    above = 1.0 - scale**2 + m * np.sinh(2.0 * alpha) * scale
    below = (1.0 - scale) ** 2 - m**2 * np.sinh(alpha) ** 2 * scale
    series = n * (n + 1.0) / ((2.0 * n - 1.0) * (2.0 * n + 3.0)) * (above / below - 1.0)
    return float(4.0 / 3.0 * np.sinh(alpha) * series.sum())


SLIT_DRAG = {
    "midway": (-1.004, 0.0, 0.418, 0.21, -0.169),
    "a quarter of the way": (-0.6526, 0.0, 0.1475, -0.131, -0.0644),
}
"""Coefficients of the powers of R/h in the mobility along two walls over that without, h the distance from
the nearer wall (Faxén 1922; Happel & Brenner 1965, 7-4.27 and 7-4.28)."""


def slit_mobility(place: str, e: float) -> float:
    """Return the relative mobility of a sphere along two walls, e = R/h, at a place of :data:`SLIT_DRAG`."""
    return 1.0 + float(sum(c * e ** (k + 1) for k, c in enumerate(SLIT_DRAG[place])))


# --- Lift ---------------------------------------------------------------------------------------------------


def lift_coefficient(Ca: float) -> float:
    """Return k = v₃ h²/(γ̇ R³) of a neo-Hooke body in steady shear, far above the wall.

    −9 S₃₃/(64π μ γ̇ R³) (Smart & Leighton 1991) with the stresslet of the solid's side
    (:func:`validation.references.soft.particle_stress`).
    """
    body = soft.Body(Ca)
    F = soft.steady(SHEAR_OVER_WALL, body)
    return float(-3.0 / 16.0 * soft.particle_stress(F, SHEAR_OVER_WALL, body)[2, 2])


def lifted_height(start: float, k: float, t: float) -> float:
    """Return the wall distance after γ̇t, (h₀³ + 3 k γ̇t)^{1/3}, of a body lifted by the point stresslet."""
    return float(np.cbrt(start**3 + 3.0 * k * t))


# --- Stokes flow above the wall -----------------------------------------------------------------------------


def stokeslet(r: Floats) -> Floats:
    """Return the velocity u_i at r from a unit force along j at the origin, (..., 3, 3), without walls."""
    d = np.linalg.norm(r, axis=-1)[..., None, None]
    return np.asarray((IDENTITY / d + r[..., :, None] * r[..., None, :] / d**3) / (8.0 * np.pi))


def image(x: Floats, y: Floats) -> Floats:
    """Return the image of the Stokeslet at y behind the wall, at x, (..., 3, 3) (Blake 1971).

    A Stokeslet at the mirror point turned round, and a source doublet and a Stokes doublet there, of the
    strengths 2h² and 2h, h = y₃.
    """
    h = y[..., 2, None]
    R = x - y * _MIRROR
    d = np.linalg.norm(R, axis=-1, keepdims=True)
    up = R[..., 2:]
    doublets = np.empty((*np.broadcast_shapes(x.shape, y.shape), 3))
    for j in range(3):
        e, along = IDENTITY[j], R[..., j, None]
        source = e / d**3 - 3.0 * R * along / d**5
        stokes = (e * up + R * e[2] - NORMAL * along) / d**3 - 3.0 * R * up * along / d**5
        doublets[..., j] = 2.0 * h * _MIRROR[j] * (h * source - stokes)
    return np.asarray(doublets / (8.0 * np.pi) - stokeslet(R))


class Motion(NamedTuple):
    """Of a body without inertia near the wall."""

    v: Floats
    """Velocity of its centre."""
    l: Floats
    """Its velocity gradient ∂u_i/∂x_j."""
    stresslet: Floats
    """Batchelor's."""


class Ellipsoid:
    """Stokes flow about an ellipsoid above the wall, or without it.

    The flow is that of forces inside the body, chosen so that the velocity is given at points of the surface
    in the sense of least squares (method of fundamental solutions). Bodies whose axes differ by less than two
    times are resolved to some 1e-4; the gap must be a tenth of the radius or more.

    Parameters
    ----------
    F
        Deformation gradient from the unit sphere, (3, 3).
    h
        Distance of the centre from the wall; infinite without it.
    depth
        Of the unit sphere on which the forces lie before F is applied.
    """

    def __init__(self, F: Floats, h: float, points: int = 480, forces: int = 240, depth: float = 0.7) -> None:
        self.F, self.h = F, h
        self.x = _even_points(points) @ F.T
        self._y = depth * _even_points(forces) @ F.T
        x, y = self.x[:, None], self._y[None]
        G = stokeslet(x - y)
        if np.isfinite(h):
            G += image(x + h * NORMAL, y + h * NORMAL)
        self._inverse = np.linalg.pinv(G.transpose(0, 2, 1, 3).reshape(3 * points, 3 * forces), rcond=1e-13)

    def moments(self, u: Floats) -> tuple[Floats, Floats]:
        """Sum (3,) and first moment Σ f y (3, 3) of the forces, for velocities (points, 3) of the surface."""
        f = (self._inverse @ u.ravel()).reshape(-1, 3)
        return f.sum(axis=0), f.T @ self._y

    def resistance(self) -> Floats:
        """Return the force on the fluid for unit velocities of the body without rotation, (3, 3)."""
        return np.stack([self.moments(np.tile(e, (len(self.x), 1)))[0] for e in IDENTITY], axis=1)

    def free_motion(self, stress: Floats | None, gradient: Floats, force: Floats | None = None) -> Motion:
        """Return motion and deformation of the body in the flow u = l·(x − wall), free of torque.

        It deforms affinely, keeps its volume, and carries the stress of its solid: S = V (dev σ − 2 d_s).

        Parameters
        ----------
        stress
            Cauchy stress σ of the solid, (3, 3); none for a rigid body.
        gradient
            l, (3, 3), that vanishes along the wall.
        force
            That acts on the body, none by default.
        """
        n = 6 if stress is None else 11
        modes = _MODES[:n]
        centre = gradient @ NORMAL * self.h if np.isfinite(self.h) else np.zeros(3)
        answers = [self.moments(v + self.x @ l.T) for v, l in modes]
        load = self.moments(-(centre + self.x @ gradient.T))
        volume = 4.0 / 3.0 * np.pi * np.linalg.det(self.F)

        def balance(f: Floats, moment: Floats, l: Floats) -> Floats:
            D = _stresslet(moment) + volume * (l + l.T)
            torque = [moment[2, 1] - moment[1, 2], moment[0, 2] - moment[2, 0], moment[1, 0] - moment[0, 1]]
            return np.array([*f, *torque, D[0, 0], D[1, 1], D[0, 1], D[0, 2], D[1, 2]])[:n]

        system = np.stack([balance(f, m, l) for (f, m), (_, l) in zip(answers, modes, strict=True)], axis=1)
        right = -balance(*load, np.zeros((3, 3)))
        right[:3] += 0.0 if force is None else force
        if stress is not None:
            s = volume * (stress - np.trace(stress) / 3.0 * IDENTITY)
            right[6:] += s[0, 0], s[1, 1], s[0, 1], s[0, 2], s[1, 2]
        q = np.linalg.solve(system, right)
        v = sum(a * mode[0] for a, mode in zip(q, modes, strict=True))
        l = sum(a * mode[1] for a, mode in zip(q, modes, strict=True))
        moment = load[1] + sum(a * m for a, (_, m) in zip(q, answers, strict=True))
        return Motion(np.asarray(v), np.asarray(l), _stresslet(moment))


def velocity_away(h: float, F: Floats = IDENTITY) -> float:
    """Return the velocity of a rigid body over that of the flow, which turns away from the wall as x₃²."""
    body = Ellipsoid(F, h, 960, 480, depth=0.8 if h < 1.3 * np.linalg.norm(F[2]) else 0.7)
    z = body.x[:, 2] + h
    flow = np.stack([-body.x[:, 0] * z, -body.x[:, 1] * z, z * z], axis=1)
    return float(body.moments(flow)[0][2] / (body.resistance()[2, 2] * h * h))


def _stresslet(moment: Floats) -> Floats:
    S = -0.5 * (moment + moment.T)
    return np.asarray(S - np.trace(S) / 3.0 * IDENTITY)


def _modes() -> list[tuple[Floats, Floats]]:
    """Return velocity and gradient of three translations, three rotations and five strains."""
    zero = np.zeros((3, 3))
    modes = [(e, zero) for e in IDENTITY]
    pairs = ((2, 1), (0, 2), (1, 0))
    for sign in (-1.0, 1.0):
        for i, j in pairs:
            l = np.zeros((3, 3))
            l[i, j], l[j, i] = 1.0, sign
            modes.append((np.zeros(3), l))
    modes += [(np.zeros(3), np.diag(d)) for d in ([1.0, -1.0, 0.0], [0.0, 1.0, -1.0])]
    return modes


_MODES = _modes()


def _even_points(n: int) -> Floats:
    """Return points (n, 3) distributed over the unit sphere along a Fibonacci spiral."""
    k = np.arange(n) + 0.5
    z, phi = 1.0 - 2.0 * k / n, np.pi * (1.0 + np.sqrt(5.0)) * k
    r = np.sqrt(1.0 - z * z)
    return np.stack([r * np.cos(phi), r * np.sin(phi), z], axis=1)


# --- Molecules ----------------------------------------------------------------------------------------------


def perrin_translation(ratio: float) -> tuple[float, float]:
    """Return the relative resistance of a spheroid along and across its axis (Perrin 1936).

    Parameters
    ----------
    ratio
        Semi-axis of revolution over the other, not 1.
    """
    S, b = _perrin(ratio)
    a = ratio * b
    along = 16.0 * (a * a - b * b) / ((2.0 * a * a - b * b) * S - 2.0 * a)
    across = 32.0 * (a * a - b * b) / ((2.0 * a * a - 3.0 * b * b) * S + 2.0 * a)
    return along / 6.0, across / 6.0


def perrin_rotation(ratio: float) -> tuple[float, float]:
    """Return the relative resistance to rotation about the axis, and about one across (Perrin 1934)."""
    S, b = _perrin(ratio)
    a = ratio * b
    about = 32.0 / 3.0 * (a * a - b * b) * b * b / (2.0 * a - b * b * S)
    across = 32.0 / 3.0 * (a**4 - b**4) / ((2.0 * a * a - b * b) * S - 2.0 * a)
    return about / 8.0, across / 8.0


def _perrin(ratio: float) -> tuple[float, float]:
    """Return Perrin's integral S and the semi-axis across, for a spheroid of the unit sphere's volume."""
    b = ratio ** (-1.0 / 3.0)
    a = ratio * b
    e = np.sqrt(abs(a * a - b * b))
    S = 2.0 / e * (np.log((a + e) / b) if ratio > 1.0 else np.arctan(e / a))
    return float(S), float(b)


def mean_shape_energy(kT: float) -> float:
    """Return the mean stored energy over kT of a fluctuating incompressible neo-Hooke body.

    The mean of w = ½(λ₁² + λ₂² + λ₃² − 3) over all F of det F = 1 with the weight exp(−w/kT); the measure of
    the stretches is Π |λ_i² − λ_j²| dln λ₁ dln λ₂.

    Parameters
    ----------
    kT
        Over the shear modulus and the volume.
    """
    ends = 12.0 * np.sqrt(kT)
    x, y = np.meshgrid(*2 * [np.linspace(-ends, ends, 801)])
    squares = np.exp(2.0 * np.stack([x, y, -x - y]))
    w = 0.5 * (squares.sum(axis=0) - 3.0)
    measure = np.exp(-w / kT)
    for i, j in ((0, 1), (1, 2), (2, 0)):
        measure = measure * abs(squares[i] - squares[j])
    return float((w * measure).sum() / measure.sum() / kT)
