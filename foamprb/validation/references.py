"""What the validation compares with: closed forms and solutions by scipy, independent of foamprb's own code.

Nothing here uses the code that it checks: the integrals are Gauss–Legendre sums, the differential equations
are solved by :func:`scipy.integrate.solve_ivp`, the steady states by root finding. Vectors are arrays (3,),
tensors (3, 3). Where no unit is given, lengths are in radii of the sphere at rest and stresses and rates in
any consistent units, as with the fluid's viscosity and the shear rate both 1.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp
from scipy.optimize import brentq, root

Floats = NDArray[np.float64]

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(160)
_S = 0.5 * (_NODES + 1.0)
_DS = 0.5 * _WEIGHTS


# --- Integrals over the exterior of an ellipsoid ------------------------------------------------------------


class Integrals(NamedTuple):
    """Jeffery's integrals (B.2), (B.4), (B.9) of semi-axes a, b, c, each with one entry per axis."""

    first: Floats
    """α₀, β₀, γ₀."""
    ring: Floats
    """α₀°, β₀°, γ₀°."""
    star: Floats
    """α₀*, β₀*, γ₀*."""
    chi: float
    """χ."""


def integrals(axes: Floats) -> Integrals:
    """Jeffery's integrals by quadrature.

    With λ = g²(1 − s²)/s², g³ = abc, each is a smooth integral over s in (0, 1); 160 Gauss–Legendre nodes
    give it to 1e-12 for axis ratios up to 30.

    Parameters
    ----------
    axes
        Semi-axes (3,).
    """
    g2 = float(np.prod(axes)) ** (2.0 / 3.0)
    q = g2 + np.multiply.outer(axes**2 - g2, _S**2)
    common = 2.0 * g2 * _DS / np.sqrt(np.prod(q, axis=0))
    s2 = _S**2
    pairs = np.stack([q[1] * q[2], q[2] * q[0], q[0] * q[1]])
    return Integrals(
        (common * s2 / q).sum(axis=1),
        (common * s2**2 / pairs).sum(axis=1),
        (common * g2 * s2 * (1.0 - s2) / pairs).sum(axis=1),
        float(common.sum()),
    )


def resistances(axes: Floats) -> Floats:
    """Principal resistances of an ellipsoid in units of length, K_a = 16π/(χ + α_a r_a²) (Oberbeck 1876)."""
    g = integrals(axes)
    return 16.0 * np.pi / (g.chi + g.first * axes**2)


def prolate_resistances(axes: Floats) -> Floats:
    """π r_min k of the paper's (D.1), (D.2), with λ the ratio of the longest to the shortest semi-axis.

    Below λ = 1.01 the printed forms lose their digits; there the spheroid's exact resistances are taken.
    """
    longest, shortest = int(np.argmax(axes)), float(np.min(axes))
    r = float(axes[longest]) / shortest
    if r < 1.01:
        k = resistances(np.array([r, 1.0, 1.0])) / np.pi
        along, across = float(k[0]), float(k[1])
    else:
        w = np.sqrt(r * r - 1.0)
        log = np.log(r + w)
        along = 8.0 * w**3 / ((2.0 * r * r - 1.0) * log - r * w)
        across = 16.0 * w**3 / ((2.0 * r * r - 3.0) * log + r * w)
    k = np.full(3, across)
    k[longest] = along
    return np.pi * shortest * k


# --- Traction -----------------------------------------------------------------------------------------------


def diagonal_response(axes: Floats) -> Floats:
    """The matrix M, (3, 3), of s̃_aa = Σ_b M_ab d_bb for unit viscosity (B.3), (B.5)."""
    x, y, z = integrals(axes).star
    n = 8.0 / (6.0 * (x * y + y * z + z * x) * np.prod(axes))
    return np.asarray(n * np.array([[2 * x, -y, -z], [-x, 2 * y, -z], [-x, -y, 2 * z]]))


def traction_stress(F: Floats, l_f: Floats, l_s: Floats, traction: str = "roscoe") -> Floats:
    """Roscoe's (or Jeffery's) σ̃/μ_f of a body with deformation gradient F, p = 0, inertial frame.

    (25) to (27) and Appendix B, with 2 dev d_s − 4/3 tr(d_s) I for the printed 2 d_s.

    Parameters
    ----------
    F, l_f, l_s
        Deformation gradient, and velocity gradients ∂u_i/∂x_j of fluid and body, each (3, 3).
    """
    U, axes, _ = np.linalg.svd(F)
    d_f, w_f = _parts(U.T @ l_f @ U)
    d_s, w_s = _parts(U.T @ l_s @ U)
    if traction == "jeffery":
        d_s = np.zeros((3, 3))
    e_s = d_s - np.trace(d_s) / 3.0 * np.eye(3)
    d, w = d_f - np.trace(d_f) / 3.0 * np.eye(3) - e_s, w_f - w_s
    g = integrals(axes)
    s = np.diag(diagonal_response(axes) @ np.diag(d))
    volume = np.prod(axes)
    # (B.6)–(B.8) for the pair of axes i, j, of which k is the third: H_ij couples to d_ji and w_ji.
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        n = 2.0 * g.ring[k] * (axes[i] ** 2 * g.first[i] + axes[j] ** 2 * g.first[j])
        s[i, j] = 8.0 / volume * (g.first[i] * d[j, i] - axes[j] ** 2 * g.ring[k] * w[j, i]) / n
        s[j, i] = 8.0 / volume * (g.first[j] * d[j, i] + axes[i] ** 2 * g.ring[k] * w[j, i]) / n
    # A, B, C of (B.5) are s_aa abc/8, and p̃ = p + 4 (α₀A + β₀B + γ₀C) of (B.1).
    pressure = 0.5 * volume * float(g.first @ np.diag(s))
    stress = s + 2.0 * e_s - (pressure + 4.0 / 3.0 * np.trace(d_s)) * np.eye(3)
    return np.asarray(U @ stress @ U.T)


def _parts(l: Floats) -> tuple[Floats, Floats]:
    return 0.5 * (l + l.T), 0.5 * (l - l.T)


# --- The body without inertia -------------------------------------------------------------------------------


def inertialess_rate(F: Floats, l_f: Floats, Ca: float, viscosity_ratio: float = 0.0) -> Floats:
    """Velocity gradient l_s/γ̇ of an incompressible neo-Hooke body without inertia, (3, 3).

    The balance σ̃(F, l_s; l_f) = σ(F) solved in the particle frame, where it decouples; a Kelvin–Voigt solid
    adds 2 η_s d_s to its stress.

    Parameters
    ----------
    F
        Deformation gradient, det F = 1.
    l_f
        Velocity gradient of the fluid, in units of γ̇.
    Ca
        μ_f γ̇/μ_s.
    viscosity_ratio
        η_s/μ_f of the solid.
    """
    U, axes, _ = np.linalg.svd(F)
    d_f, w_f = _parts(U.T @ l_f @ U)
    g = integrals(axes)
    volume = np.prod(axes)
    keep = 1.0 - viscosity_ratio
    l_s = np.zeros((3, 3))
    for i, j, k in ((0, 1, 2), (1, 2, 0), (2, 0, 1)):
        a2, b2 = axes[i] ** 2, axes[j] ** 2
        delta = keep * d_f[j, i] / (keep - 2.0 / (volume * g.ring[k] * (a2 + b2)))
        spin = w_f[j, i] + (a2 - b2) / (a2 + b2) * delta
        l_s[j, i] = d_f[j, i] - delta + spin
        l_s[i, j] = d_f[j, i] - delta - spin
    M = diagonal_response(axes)
    # Three balances −p + M·(d_f − d_s) + 2 (1 − η_s/μ_f) d_s = λ²/Ca, and Σ d_s = 0.
    system = np.zeros((4, 4))
    system[:3, :3] = 2.0 * keep * np.eye(3) - M
    system[:3, 3] = -1.0
    system[3, :3] = 1.0
    load = np.append(axes**2 / Ca - M @ np.diag(d_f), 0.0)
    l_s += np.diag(np.linalg.solve(system, load)[:3])
    return np.asarray(U @ l_s @ U.T)


def inertialess_history(
    l_f: Floats, Ca: float, times: Floats, viscosity_ratio: float = 0.0, tolerance: float = 1e-11
) -> Floats:
    """Deformation gradients (n, 3, 3) at rising times in units of 1/γ̇, from a sphere at time 0."""

    def rate(_t: float, y: Floats) -> Floats:
        F = y.reshape(3, 3)
        return (inertialess_rate(F, l_f, Ca, viscosity_ratio) @ F).ravel()

    answer = solve_ivp(
        rate, (0.0, float(times[-1])), np.eye(3).ravel(), "DOP853", times, rtol=tolerance, atol=tolerance
    )
    return np.asarray(answer.y.T.reshape(-1, 3, 3))


class ShearShape(NamedTuple):
    """A body in the shear flow u₁ = γ̇ x₂."""

    deformation: float
    """D = (a − b)/(a + b), a and b the axes in the plane of shear."""
    b_over_a: float
    c_over_a: float
    """c along the vorticity."""
    angle: float
    """θ of the long axis to the flow, degrees."""
    spin: float
    """|ω_s3|/γ̇, ω_s the axial vector of skew l_s."""


def shear_shape(F: Floats, l_s: Floats) -> ShearShape:
    """Shape of a body with deformation gradient F and velocity gradient l_s in units of γ̇, each (3, 3)."""
    values, vectors = np.linalg.eigh((F @ F.T)[:2, :2])
    b, a = np.sqrt(values)
    c = np.linalg.norm(F[2])
    angle = np.degrees(np.arctan(vectors[1, 1] / vectors[0, 1]))
    return ShearShape(
        (a - b) / (a + b), b / a, float(c / a), float(angle), abs(0.5 * (l_s[1, 0] - l_s[0, 1]))
    )


SHEAR = np.array([[0.0, 1.0, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])
"""Velocity gradient of the simple shear l₁₂ = γ̇ in units of γ̇."""

TABLE = {
    0.01: ShearShape(0.01250, 0.97531, 0.98760, 44.570, 0.50012),
    0.1: ShearShape(0.12392, 0.77949, 0.88485, 40.733, 0.51242),
    0.4: ShearShape(0.44314, 0.38587, 0.64198, 29.397, 0.68281),
}
"""Steady simple shear by Ca, from an independent high-order solution, rounded as written."""

TRANSIENT_TABLE = {1.0: (0.4494, 0.6927, 34.86), 3.0: (0.3833, 0.6410, 29.62)}
"""b/a, c/a and θ (degrees) at Ca = 0.4 by γ̇t, from the same solution."""


def steady_shear(Ca: float, viscosity_ratio: float = 0.0) -> ShearShape:
    """Steady shape in simple shear: the end of a long transient of :func:`inertialess_history`."""
    end = 30.0 + 120.0 * Ca * (1.0 + viscosity_ratio)
    F = inertialess_history(SHEAR, Ca, np.array([end]), viscosity_ratio)
    return shear_shape(F[-1], inertialess_rate(F[-1], SHEAR, Ca, viscosity_ratio))


def tank_treading_rate(l_s: Floats) -> float:
    """Roscoe's ν/γ̇ of a steady body: the eigenvalues of l_s in the plane are ±iν."""
    return float(np.sqrt(np.linalg.det(l_s[:2, :2])))


# --- Roscoe's steady solution -------------------------------------------------------------------------------


class Roscoe(NamedTuple):
    """Roscoe's (1967) steady viscoelastic ellipsoid in simple shear, for one pair of semi-axes."""

    axes: Floats
    """a₁ > a₃ > a₂, of product 1; a₁ and a₂ in the plane of shear."""
    angle: float
    """θ, degrees."""
    Ca: float
    """η₀ γ̇/μ₁; infinite where a viscous solid is never stretched so far."""


def _roscoe_integrals(axes: Floats) -> tuple[float, float, float]:
    """I, J and K of Roscoe (1967) from g₁″, g₂″, g₃″ and g₃′."""
    g = integrals(axes)
    g1, g2, g3 = g.star
    n = g2 * g3 + g3 * g1 + g1 * g2
    a1, a2, _ = axes**2
    return 0.4 * (g1 + g2) / n, 0.4 * (g1 - g2) / n, float((a1 + a2) / (5.0 * g.ring[2] * a1 * a2))


def roscoe(a1: float, viscosity_ratio: float = 0.0) -> Roscoe:
    """Roscoe's solution for the longest semi-axis a₁ > 1, by his algebraic equations.

    R. Roscoe, On the rheology of a suspension of viscoelastic spheres in a viscous liquid, J. Fluid Mech. 28
    (1967) 273–293, as restated for semi-axes of product 1.

    Parameters
    ----------
    viscosity_ratio
        η₁/η₀ of solid and fluid.
    """

    def axes(a2: float) -> Floats:
        return np.array([a1, a2, 1.0 / (a1 * a2)])

    def balance(a2: float) -> float:
        I, Jr, _ = _roscoe_integrals(axes(a2))
        return float((a1**2 + a2**2 - 2.0 / (a1 * a2) ** 2) * I - Jr * (a1**2 - a2**2))

    a2 = float(brentq(balance, 0.2 / a1, 1.0 - 1e-12, xtol=1e-15, rtol=1e-14))
    I, _, K = _roscoe_integrals(axes(a2))
    # In units of η₀/μ₁: σ = 5/2, τ = 3/2 + η₁/η₀.
    sigma, tau = 2.5, 1.5 + viscosity_ratio
    q = (tau - sigma) / (K * sigma)
    s, d = a1**2 + a2**2, a1**2 - a2**2
    cosine = d / s * (1.0 + q * (s / (2.0 * a1 * a2)) ** 2) / (1.0 + q * (d / (2.0 * a1 * a2)) ** 2)
    if not abs(cosine) < 1.0:
        return Roscoe(axes(a2), 0.0, np.inf)
    double = float(np.arccos(cosine))
    return Roscoe(axes(a2), float(np.degrees(double)) / 2.0, float(d / (2.0 * I * sigma * np.sin(double))))


def roscoe_at(Ca: float, viscosity_ratio: float = 0.0) -> ShearShape:
    """Roscoe's solution at a capillary number η₀γ̇/μ₁.

    The spin follows from his ν: the steady l_s carries the ellipse into itself, so that in its axes it has
    the components l₁₂ = ν a/b and l₂₁ = −ν b/a, and |ω_s3| = ν (a² + b²)/(2ab).
    """

    # 1/Ca falls through zero where a viscous solid can be stretched no further.
    def miss(a: float) -> float:
        return 1.0 / roscoe(a, viscosity_ratio).Ca - 1.0 / Ca

    a1 = float(brentq(miss, 1.0 + 1e-4 * Ca, 6.0, xtol=1e-14))
    found = roscoe(a1, viscosity_ratio)
    a, b, c = found.axes
    nu = roscoe_frequency(a, b, found.angle)
    return ShearShape((a - b) / (a + b), b / a, c / a, found.angle, nu * (a * a + b * b) / (2 * a * b))


def roscoe_frequency(a: float, b: float, angle: float) -> float:
    """Roscoe's ν/γ̇ = (a² + b²)/(2ab) · [1 − (a² − b²)/(a² + b²) cos 2θ]/2, θ in degrees."""
    a2, b2 = a * a, b * b
    return float(
        (a2 + b2) / (2 * a * b) * (1.0 - (a2 - b2) / (a2 + b2) * np.cos(2 * np.radians(angle))) / 2.0
    )


# --- Extension ----------------------------------------------------------------------------------------------

EXTENSIONS = {
    "uniaxial": np.array([1.0, -0.5, -0.5]),
    "planar": np.array([1.0, -1.0, 0.0]),
    "biaxial": np.array([1.0, 1.0, -2.0]),
}
"""Principal rates of deformation in units of the largest positive one."""


def steady_extension(rates: Floats, Ca: float) -> Floats:
    """Steady semi-axes (3,) of an incompressible neo-Hooke sphere in an extension.

    The body is at rest, d_s = 0, and along each principal axis −p + s̃_aa(d_f) = λ_a²/Ca. The branch that
    starts from the sphere is followed in Ca.

    Parameters
    ----------
    rates
        Principal rates (3,) in units of ε̇, of sum 0.
    Ca
        μ_f ε̇/μ_s.

    Raises
    ------
    ValueError
        If there is no steady shape: the extension pulls harder than the solid can hold.
    """
    logs = np.zeros(2)
    for part in np.linspace(0.0, Ca, 21)[1:]:
        logs = _balanced(rates, float(part), logs)
    return np.asarray(np.exp(np.append(logs, -logs.sum())))


def _balanced(rates: Floats, Ca: float, start: Floats) -> Floats:
    def imbalance(logs: Floats) -> Floats:
        axes = np.exp(np.append(logs, -logs.sum()))
        stress = Ca * diagonal_response(axes) @ rates - axes**2
        return np.asarray(stress[:2] - stress[2])

    found = root(imbalance, start, tol=1e-14)
    if not np.abs(imbalance(found.x)).max() < 1e-10:
        raise ValueError(f"no steady shape at Ca = {Ca:g}")
    return np.asarray(found.x)


def steady_compressible_extension(rates: Floats, Ca: float, poissons_ratio: float) -> Floats:
    """As :func:`steady_extension` for the quasi-incompressible solid (24) of the given Poisson's ratio.

    p̃ is 4 (α₀A + β₀B + γ₀C) with p = 0, so that the volume follows from the balance.
    """
    ratio = 2.0 * poissons_ratio / (1.0 - 2.0 * poissons_ratio)

    def imbalance(logs: Floats) -> Floats:
        axes = np.exp(logs)
        load = np.diag(traction_stress(np.diag(axes), np.diag(rates), np.zeros((3, 3))))
        return np.asarray(Ca * np.prod(axes) * load - (axes**2 - 1.0) - ratio * logs.sum())

    found = root(imbalance, np.log(steady_extension(rates, Ca)), tol=1e-14)
    if not np.abs(imbalance(found.x)).max() < 1e-9:
        raise ValueError(f"no steady shape at Ca = {Ca:g}")
    return np.asarray(np.exp(found.x))


# --- Particles with inertia ---------------------------------------------------------------------------------

FlowAt = Callable[[Floats], tuple[Floats, Floats]]
"""u (3,), m/s, and ∂u_i/∂x_j (3, 3), 1/s, at a point (3,), m."""


class Surroundings(NamedTuple):
    """The fluid's viscosity, Pa s, and density, kg/m³; gravity (3,), m/s²; and the flow."""

    mu: float
    rho: float
    gravity: Floats
    flow: FlowAt


def poiseuille(radius: float, mean_velocity: float) -> FlowAt:
    """u₁ = 2U (1 − r²/a²) in a pipe along x₁."""

    def flow(x: Floats) -> tuple[Floats, Floats]:
        k = 2.0 * mean_velocity / radius**2
        gradient = np.zeros((3, 3))
        gradient[0, 1:] = -2.0 * k * x[1:]
        return np.array([2.0 * mean_velocity - k * float(x[1:] @ x[1:]), 0.0, 0.0]), gradient

    return flow


def uniform_gradient(gradient: Floats) -> FlowAt:
    """u = l·x."""
    return lambda x: (gradient @ x, gradient)


def relaxation_time(R: float, rho: float, mu_f: float) -> float:
    """ρ_s R²/(15 μ_f), s: of the spin of a rigid sphere, m (2/5) R² over 8π μ_f R³."""
    return rho * R * R / (15.0 * mu_f)


class RigidHistory(NamedTuple):
    """A rigid sphere at n times."""

    t: Floats
    """(n,), s."""
    x: Floats
    """(n, 3), m."""
    v: Floats
    """(n, 3), m/s."""
    angle: Floats
    """(n,) turned about the third axis, rad."""
    spin: Floats
    """(n,) angular velocity about the third axis, 1/s."""
    torque: Floats
    """(n,) torque of the fluid about the third axis, 8π μ_f R³ (½ rot u − ω), N m."""


def rigid_sphere(
    R: float, rho: float, around: Surroundings, start: Floats, times: Floats, floor: float | None = None
) -> RigidHistory:
    """A rigid sphere released at rest: Stokes drag, weight less buoyancy, and the torque of Stokes flow.

    m dv/dt = 6π μ_f R (u − v) + (ρ_s − ρ_f) vol g, (2/5) m R² dω/dt = 8π μ_f R³ (½ rot u − ω), in a plane.

    Parameters
    ----------
    start
        Position of release (3,), m.
    times
        Rising, from 0, s.
    floor
        Height x₂, m, at which its centre lands; the history ends there, with the landing as its last time.
    """
    drag_rate = 9.0 * around.mu / (2.0 * rho * R * R)
    spin_rate = 1.0 / relaxation_time(R, rho, around.mu)
    weight = (1.0 - around.rho / rho) * around.gravity

    def vorticity(x: Floats) -> float:
        gradient = around.flow(x)[1]
        return float(0.5 * (gradient[1, 0] - gradient[0, 1]))

    def rate(_t: float, y: Floats) -> Floats:
        u, _ = around.flow(y[:3])
        a = drag_rate * (u - y[3:6]) + weight
        return np.concatenate([y[3:6], a, [y[7], spin_rate * (vorticity(y[:3]) - y[7])]])

    y0 = np.concatenate([start, np.zeros(5)])
    t, y = _solve(rate, y0, times, floor, "DOP853", 1e-11, np.full(8, 1e-15))
    x, spin = y[:, :3], y[:, 7]
    inertia = 8.0 * np.pi / 15.0 * rho * R**5
    torque = inertia * spin_rate * (np.array([vorticity(p) for p in x]) - spin)
    return RigidHistory(t, x, y[:, 3:6], y[:, 6], spin, torque)


def _solve(
    rate: Callable[[float, Floats], Floats],
    y0: Floats,
    times: Floats,
    floor: float | None,
    method: Literal["DOP853", "BDF"],
    rtol: float,
    atol: Floats,
) -> tuple[Floats, Floats]:
    """Times (n,) and states (n, m), up to the landing if there is a floor."""

    def height(_t: float, y: Floats) -> float:
        return float(y[1] - (-np.inf if floor is None else floor))

    event: Any = height
    event.terminal = True
    # The implicit method's numerical Jacobian overflows, harmlessly, where a component acts on nothing.
    with np.errstate(over="ignore"):
        answer: Any = solve_ivp(
            rate, (0.0, float(times[-1])), y0, method, times, events=None if floor is None else event,
            rtol=rtol, atol=atol,
        )  # fmt: skip
    t, y = answer.t, answer.y.T
    if floor is not None and len(answer.t_events[0]):
        t = np.append(t, answer.t_events[0][0])
        y = np.vstack([y, answer.y_events[0][0]])
    return np.asarray(t), np.asarray(y)


class SoftHistory(NamedTuple):
    """A soft body at n times."""

    t: Floats
    """(n,), s."""
    x: Floats
    """(n, 3), m."""
    v: Floats
    """(n, 3), m/s."""
    F: Floats
    """(n, 3, 3)."""
    A: Floats
    """(n, 3, 3) dF/dt, 1/s."""


DRAGS = {"oberbeck": resistances, "brennerProlate": prolate_resistances}
"""Principal resistances by the name of the drag law."""


def soft_sphere(
    R: float,
    rho: float,
    mu: float,
    poissons_ratio: float,
    around: Surroundings,
    start: Floats,
    times: Floats,
    drag: str = "oberbeck",
    floor: float | None = None,
    tolerance: float = 1e-7,
) -> SoftHistory:
    """A soft sphere with all its inertia, released at rest: the equations of motion (33), implicitly.

    Parameters
    ----------
    R, rho, mu, poissons_ratio
        Radius (m), density (kg/m³), shear modulus (Pa) and Poisson's ratio.
    around, start, times, floor
        As for :func:`rigid_sphere`.
    drag
        A name in :data:`DRAGS`.
    tolerance
        Relative, of the solver.
    """
    factor = 5.0 / (rho * R * R)
    lame = 2.0 * mu * poissons_ratio / (1.0 - 2.0 * poissons_ratio)
    mass_per_length = 4.0 / 3.0 * np.pi * R * R * rho
    resistance = DRAGS[drag]
    unit = relaxation_time(R, rho, around.mu)

    def rate(_t: float, y: Floats) -> Floats:
        x, v = y[:3], y[3:6] / unit
        F, A = y[6:15].reshape(3, 3), y[15:].reshape(3, 3) / unit
        u, l_f = around.flow(x * R)
        inverse, J = np.linalg.inv(F), float(np.linalg.det(F))
        U, axes, _ = np.linalg.svd(F)
        K = U @ np.diag(resistance(axes)) @ U.T
        dv = around.mu / mass_per_length * K @ (u / R - v) + (1.0 - J * around.rho / rho) * around.gravity / R
        load = around.mu * traction_stress(F, l_f, A @ inverse)
        P = mu * (F - inverse.T) + lame * np.log(J) * inverse.T
        dA = factor * (J * load @ inverse.T - P)
        return np.concatenate([v, unit * dv, A.ravel(), unit * dA.ravel()])

    y0 = np.concatenate([start / R, np.zeros(3), np.eye(3).ravel(), np.zeros(9)])
    bottom = None if floor is None else floor / R
    t, y = _solve(rate, y0, times, bottom, "BDF", tolerance, np.full(24, 0.1 * tolerance))
    shape = (len(t), 3, 3)
    return SoftHistory(
        t, y[:, :3] * R, y[:, 3:6] * R / unit, y[:, 6:15].reshape(shape), y[:, 15:].reshape(shape) / unit
    )


def settling_in_extension(
    K: Floats, mass: float, mu_f: float, rates: Floats, acceleration: Floats, t: float
) -> tuple[Floats, Floats]:
    """Position and velocity (3,) of a body of steady shape released at the origin of u = diag(rates)·x.

    Along each axis x″ + k x′ − k ε̇ x = a with k = μ_f K/m has the solution
    x = a/(k ε̇) · [(r₁ e^{r₂t} − r₂ e^{r₁t})/(r₁ − r₂) − 1], r² + k r − k ε̇ = 0.

    Parameters
    ----------
    K
        Principal resistances (3,), m, along the axes of the extension.
    mass, mu_f
        kg, Pa s.
    rates
        Principal rates (3,), 1/s.
    acceleration
        Of gravity less buoyancy (3,), m/s².
    """
    k = mu_f * K / mass
    with np.errstate(invalid="ignore", divide="ignore"):
        spread = np.sqrt(k * k + 4.0 * k * rates)
        r1, r2 = 0.5 * (spread - k), -0.5 * (spread + k)
        e1, e2 = np.exp(r1 * t), np.exp(r2 * t)
        x = acceleration / (k * rates) * ((r1 * e2 - r2 * e1) / (r1 - r2) - 1.0)
        v = acceleration / (k * rates) * r1 * r2 * (e2 - e1) / (r1 - r2)
    still = rates == 0.0
    decay = np.exp(-k * t)
    x = np.where(still, acceleration / k * (t - (1.0 - decay) / k), x)
    v = np.where(still, acceleration / k * (1.0 - decay), v)
    return x, v
