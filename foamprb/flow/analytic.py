"""Flows in closed form, behind the same interface as a mesh: for tests, validation and first steps.

A flow gives the particle loop a tuple of numbers (:meth:`arrays`) and plain functions of it
(:attr:`kernels`): ``sample``, ``walk``, ``gap``, ``normal`` and ``recover``; see
:mod:`foamprb.flow.walk` for what each returns.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from foamprb.body.ellipsoid import reach
from foamprb.body.tensor import Tensor, Vector
from foamprb.errors import InputError
from foamprb.flow.base import Floats, Ints, Patch, PatchFaces, Tetrahedra

_FREE = -1


class LinearArrays(NamedTuple):
    """u = u0 + l·x, everywhere."""

    u0: Floats
    l: Floats


def sample_linear(flow: LinearArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, its gradient ∂u_i/∂x_j, 1/s, and ∂u/∂t = 0, m/s²."""
    g = flow.l
    L = (g[0], g[1], g[2], g[3], g[4], g[5], g[6], g[7], g[8])
    u = (
        flow.u0[0] + L[0] * x[0] + L[1] * x[1] + L[2] * x[2],
        flow.u0[1] + L[3] * x[0] + L[4] * x[1] + L[5] * x[2],
        flow.u0[2] + L[6] * x[0] + L[7] * x[1] + L[8] * x[2],
    )
    return u, L, (0.0, 0.0, 0.0)


def walk_free(flow: Any, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Nothing is in the way."""
    return host, 1.0, _FREE, -1


def gap_free(flow: Any, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """No wall is near."""
    return math.inf, _FREE, -1


def normal_free(flow: Any, triangle: int, x: Vector) -> Vector:
    """No wall has a normal."""
    return 0.0, 0.0, 0.0


def cross_free(flow: Any, triangle: int, x: Vector) -> tuple[int, Vector, Tensor]:
    """No patch is coupled to another."""
    return 0, x, (1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 1.0)


def recover_free(flow: Any, x: Vector) -> int:
    """The flow is everywhere."""
    return 0


class PipeArrays(NamedTuple):
    """Poiseuille flow along x in a circular pipe."""

    radius: float
    mean_velocity: float
    length: float


_WALL, _INLET, _OUTLET = 0, 1, 2


def sample_pipe(flow: PipeArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """u = 2 U (1 − r²/a²), m/s, its gradient, 1/s, and ∂u/∂t = 0, m/s²."""
    k = 2.0 * flow.mean_velocity / (flow.radius * flow.radius)
    r2 = x[1] * x[1] + x[2] * x[2]
    u = (2.0 * flow.mean_velocity - k * r2, 0.0, 0.0)
    l = (0.0, -2.0 * k * x[1], -2.0 * k * x[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    return u, l, (0.0, 0.0, 0.0)


class WomersleyArrays(NamedTuple):
    """Poiseuille flow along x in a circular pipe, and an oscillation of its pressure gradient."""

    radius: float
    mean_velocity: float
    length: float
    amplitude: float
    """Of −(∂p/∂x)/ρ over ω, m/s."""
    omega: float
    """1/s."""
    phase: float
    real: Floats
    """Coefficients of the powers of r²/a² in the profile 1 − J₀(i^{3/2} α r/a)/J₀(i^{3/2} α)."""
    imaginary: Floats


def sample_womersley(flow: WomersleyArrays, host: int, x: Vector, t: float) -> tuple[Vector, Tensor, Vector]:
    """Velocity, m/s, its gradient, 1/s, and ∂u/∂t, m/s²."""
    scale = 1.0 / (flow.radius * flow.radius)
    s = scale * (x[1] * x[1] + x[2] * x[2])
    f, g, df, dg = 0.0 * s, 0.0 * s, 0.0 * s, 0.0 * s
    for k in range(flow.real.shape[0] - 1, -1, -1):
        df, dg = df * s + f, dg * s + g
        f, g = f * s + flow.real[k], g * s + flow.imaginary[k]
    a = flow.omega * t + flow.phase
    cosine, sine = math.cos(a), math.sin(a)
    w = flow.amplitude
    u = 2.0 * flow.mean_velocity * (1.0 - s) + w * (f * sine + g * cosine)
    slope = 2.0 * scale * (w * (df * sine + dg * cosine) - 2.0 * flow.mean_velocity)
    u_t = w * flow.omega * (f * cosine - g * sine)
    return (u, 0.0, 0.0), (0.0, slope * x[1], slope * x[2], 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), (u_t, 0.0, 0.0)


def walk_pipe(flow: PipeArrays, host: int, x0: Vector, x1: Vector) -> tuple[int, float, int, int]:
    """Where the segment from x0 to x1 first leaves the pipe."""
    fraction, patch = 1.0, _FREE
    dx, dy, dz = x1[0] - x0[0], x1[1] - x0[1], x1[2] - x0[2]
    if x1[0] < 0.0:
        fraction, patch = max(-x0[0] / dx, 0.0), _INLET
    elif x1[0] > flow.length:
        fraction, patch = max((flow.length - x0[0]) / dx, 0.0), _OUTLET
    if x1[1] * x1[1] + x1[2] * x1[2] > flow.radius * flow.radius:
        a = dy * dy + dz * dz
        b = x0[1] * dy + x0[2] * dz
        c = min(x0[1] * x0[1] + x0[2] * x0[2] - flow.radius * flow.radius, 0.0)
        # The root of a f² + 2 b f + c that lies ahead, without cancellation.
        root = math.sqrt(b * b - a * c)
        hit = -c / (b + root) if b > 0.0 else (root - b) / a
        if hit <= fraction:
            fraction, patch = hit, _WALL
    return host, fraction, patch, patch


def gap_pipe(flow: PipeArrays, host: int, x: Vector, F: Tensor, R: float) -> tuple[float, int, int]:
    """Clearance between the ellipsoid and the wall's tangent plane, m."""
    n = normal_pipe(flow, _WALL, x)
    r = math.sqrt(x[1] * x[1] + x[2] * x[2])
    return flow.radius - r - reach(R, F, n), _WALL, _WALL


def normal_pipe(flow: PipeArrays, triangle: int, x: Vector) -> Vector:
    """Unit normal into the fluid, of the wall or of an end."""
    if triangle == _INLET:
        return 1.0, 0.0, 0.0
    if triangle == _OUTLET:
        return -1.0, 0.0, 0.0
    r = math.sqrt(x[1] * x[1] + x[2] * x[2]) + 1e-300
    return 0.0, -x[1] / r, -x[2] / r


def everywhere(points: Floats) -> NDArray[np.bool_]:
    """True for each point of shape (n, 3)."""
    return np.ones(len(points), dtype=bool)


class AnalyticFlow:
    """A flow in closed form.

    Parameters
    ----------
    parameters
        The tuple that the kernels read.
    kernels
        The functions ``sample``, ``walk``, ``gap``, ``normal``, ``recover``.
    patches
        Boundaries, if any.
    inside
        Tells for points of shape (n, 3) which lie in the flow.
    """

    def __init__(
        self,
        parameters: Any,
        kernels: dict[str, Callable[..., Any]],
        patches: Sequence[Patch] = (),
        inside: Callable[[Floats], NDArray[np.bool_]] = everywhere,
    ) -> None:
        self._parameters = parameters
        self._inside = inside
        self.kernels = kernels
        self.patches = tuple(patches)
        self.notes: tuple[str, ...] = ()
        self.span = (-math.inf, math.inf)

    def load(self, start: float, end: float) -> float:  # noqa: ARG002
        """Return infinity: the flow is known at all times."""
        return math.inf

    def arrays(self, reach: float, touchable: Sequence[int]) -> Any:  # noqa: ARG002
        """Numbers that the kernels read; walls are exact, at any ``reach``."""
        return self._parameters

    def move(self, place: Callable[[NDArray[Any]], NDArray[Any]]) -> None:
        """There is nothing large."""

    def traits(self) -> Mapping[str, ArrayLike]:
        """The parameters, by name."""
        names: Mapping[str, ArrayLike] = self._parameters._asdict()
        return names

    def locate(self, points: Floats) -> Ints:
        """0 for each point of shape (n, 3) in the flow, −1 for one outside."""
        inside = self._inside(points)
        return np.where(inside, 0, -1).astype(np.int32)

    def sample(self, points: Floats, hosts: Ints, t: float) -> tuple[Floats, Floats]:  # noqa: ARG002
        """Velocities (n, 3), m/s, and gradients ∂u_i/∂x_j (n, 3, 3), 1/s, at points (n, 3) at time t, s."""
        u, gradient, _ = self.kernels["sample"](self._parameters, 0, tuple(points.T), t)
        zeros = np.zeros(len(points))
        return (
            np.stack([c + zeros for c in u], axis=1),
            np.stack([c + zeros for c in gradient], axis=1).reshape(-1, 3, 3),
        )

    def patch_faces(self, name: str, t: float) -> PatchFaces:  # noqa: ARG002
        """Refuse: a flow in closed form has no faces.

        Raises
        ------
        InputError
            Always.
        """
        raise InputError(f"patch {name}: a flow in closed form has no faces to inject from.")

    def cell_zone(self, name: str | None) -> Tetrahedra:
        """Refuse: a flow in closed form has no cells.

        Raises
        ------
        InputError
            Always.
        """
        what = "all cells" if name is None else f"cellZone {name}"
        raise InputError(f"{what}: a flow in closed form has no cells to inject into.")

    def cell_size(self, hosts: Ints) -> Floats:
        """Infinite: there are no cells."""
        return np.full(np.shape(hosts), np.inf)


def linear(gradient: ArrayLike, u0: ArrayLike = (0.0, 0.0, 0.0)) -> AnalyticFlow:
    """u = u0 + l·x with a constant gradient l_ij = ∂u_i/∂x_j, 1/s, of shape (3, 3)."""
    g = np.ascontiguousarray(np.reshape(gradient, 9), dtype=float)
    kernels: dict[str, Callable[..., Any]] = {
        "sample": sample_linear,
        "walk": walk_free,
        "gap": gap_free,
        "normal": normal_free,
        "recover": recover_free,
    }
    return AnalyticFlow(LinearArrays(np.asarray(u0, dtype=float), g), kernels)


def shear(rate: float) -> AnalyticFlow:
    """Simple shear u₁ = γ̇ x₂ (Sect. 5.3)."""
    return linear([[0.0, rate, 0.0], [0.0, 0.0, 0.0], [0.0, 0.0, 0.0]])


def rotation(rate: float) -> AnalyticFlow:
    """Pure rotation l₁₂ = −l₂₁ = γ̇/2 about the negative third axis (Sect. 5.1)."""
    return linear([[0.0, rate / 2, 0.0], [-rate / 2, 0.0, 0.0], [0.0, 0.0, 0.0]])


def extension(rate: float) -> AnalyticFlow:
    """Uniaxial extension along the first axis, l = rate · diag(1, −½, −½)."""
    return linear(np.diag([rate, -rate / 2, -rate / 2]))


def pipe(radius: float, mean_velocity: float, length: float = math.inf) -> AnalyticFlow:
    """Poiseuille flow in a pipe along x from x = 0, with patches wall, inlet and outlet.

    Parameters
    ----------
    radius, length
        m; an infinite length has no outlet to reach.
    mean_velocity
        m/s; the wall shear rate is 4 U/radius.
    """
    return _in_pipe(PipeArrays(float(radius), float(mean_velocity), float(length)), sample_pipe)


_MOST_WOMERSLEY = 30.0


def womersley(
    radius: float,
    nu: float,
    period: float,
    amplitude: float,
    mean_velocity: float = 0.0,
    phase: float = 0.0,
    length: float = math.inf,
) -> AnalyticFlow:
    """Pulsatile flow in a pipe along x from x = 0, with patches wall, inlet and outlet.

    The pressure gradient −(∂p/∂x)/ρ is 8 ν U/a² + amplitude · cos(2π t/period + phase); the flow is that long
    after any start (Womersley, J. Physiol. 127, 553, 1955).

    Parameters
    ----------
    radius, length
        m; an infinite length has no outlet to reach.
    nu
        Kinematic viscosity, m²/s.
    period
        s.
    amplitude
        Of the pressure gradient over the density, m/s².
    mean_velocity
        Over section and time, U, m/s.
    phase
        rad.

    Raises
    ------
    ValueError
        If the Womersley number a √(ω/ν) exceeds 30, where the series of the Bessel function loses digits.
    """
    omega = 2.0 * math.pi / period
    alpha = radius * math.sqrt(omega / nu)
    if alpha > _MOST_WOMERSLEY:
        raise ValueError(f"Womersley number {alpha:.3g} > {_MOST_WOMERSLEY:g}")
    # J₀(i^{3/2} α s) = Σ (i α² s²/4)ᵏ/(k!)²
    terms = [1.0 + 0.0j]
    while abs(terms[-1]) > 1e-20 * max(map(abs, terms)):
        terms.append(terms[-1] * 0.25j * alpha**2 / len(terms) ** 2)
    profile = -np.array(terms) / sum(terms)
    profile[0] += 1.0
    parameters = WomersleyArrays(
        float(radius), float(mean_velocity), float(length), amplitude / omega, omega, float(phase),
        np.ascontiguousarray(profile.real), np.ascontiguousarray(profile.imag),
    )  # fmt: skip
    return _in_pipe(parameters, sample_womersley)


def _in_pipe(parameters: Any, sample: Callable[..., Any]) -> AnalyticFlow:
    """A flow along x in a pipe whose radius and length are among the parameters."""

    def inside(points: Floats) -> NDArray[np.bool_]:
        r2: Floats = points[:, 1] ** 2 + points[:, 2] ** 2
        within: NDArray[np.bool_] = r2 <= parameters.radius**2
        within &= (points[:, 0] >= 0) & (points[:, 0] <= parameters.length)
        return within

    return AnalyticFlow(
        parameters,
        {
            "sample": sample,
            "walk": walk_pipe,
            "gap": gap_pipe,
            "normal": normal_pipe,
            "recover": recover_free,
        },
        (Patch("wall", "wall"), Patch("inlet", "patch"), Patch("outlet", "patch")),
        inside,
    )
